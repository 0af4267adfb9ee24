//! Rings and old values: what compiled code leaves to the runtime.

use super::super::context::PADDING;
use super::{Context, Run, guard, looking, reading, status, vertex, words_in};
use crate::mesh::{Mesh, Ring, Vertex};

impl Run<'_> {
    fn ring(&self, v: Vertex, old: bool) -> Ring<'_> {
        if old { self.old.ring(v) } else { self.mesh.ring(v) }
    }

    fn holds(&self, v: Vertex) -> bool {
        self.held.get(v.index()).copied().unwrap_or(false)
    }

    fn synchronize(&mut self, set: usize, pristine: bool) -> Option<()> {
        let members = self.sets.get(set)?.members.clone();
        if !members.is_empty() {
            self.fixed.settings.stop.check().ok()?;
        }
        let universe = self.mesh.vertex_count();
        let covered = members.iter().filter(|&v| self.holds(v)).count();
        let held = self.held.iter().filter(|&&h| h).count();
        if covered == held && 2 * members.len() >= universe {
            if pristine && self.mesh.vertex_count() == self.before.vertex_count() {
                // Nothing was written yet: the mesh as it came is the old one.
                self.old = self.before.clone();
                let slots = self.old.arrays().slots;
                if slots.capacity() < slots.len() + PADDING {
                    let room = slots.len() + PADDING;
                    if self.fixed.old_reads.rings {
                        slots.edit_with_capacity(room);
                    }
                }
            } else {
                if !self.allows(self.mesh.bytes()) {
                    return None;
                }
                self.old = self.mesh.clone();
                self.own().then_some(())?;
            }
        } else {
            if held == 0 {
                self.old = blank(&self.mesh);
            }
            for (i, v) in members.iter().enumerate() {
                if i % 4096 == 0 && (self.fixed.settings.stop.check().is_err() || !self.allows(4096 * 64)) {
                    return None;
                }
                self.mesh.copy_vertex_into(v, &mut self.old).ok()?;
            }
            // The copy may be shorter than the universe; what lies behind its end has no old value.
            let slots = self.old.arrays().slots;
            let room = slots.len() + PADDING;
            slots.edit_with_capacity(room);
        }
        self.held.resize(universe.max(self.held.len()), false);
        for v in members.iter() {
            if let Some(held) = self.held.get_mut(v.index()) {
                *held = true;
            }
        }
        let prefix = self.held.iter().take_while(|&&h| h).count();
        // SAFETY: the context is valid and compiled code waits.
        unsafe { (*self.context).old_prefix = prefix as u64 };
        self.leave_old();
        Some(())
    }
}

/// An empty universe with the properties of a mesh.
fn blank(mesh: &Mesh) -> Mesh {
    let mut blank = Mesh::new();
    for property in mesh.vertex_properties() {
        blank.declare_vertex_property(&property.name, property.default);
    }
    for property in mesh.edge_properties() {
        blank.declare_edge_property(&property.name, property.default);
    }
    blank
}

pub(super) extern "C" fn synchronize(context: *mut Context, set: u32, pristine: u32) -> u32 {
    guard(context, status::REPEAT, |run| run.synchronize(set as usize, pristine != 0).map(|()| status::DONE))
}

/// Whether a vertex has an old value.
pub(super) extern "C" fn holds(context: *mut Context, v: u32) -> u32 {
    looking(context, 0, |run| Some(u32::from(run.holds(vertex(v)?))))
}

/// `make` with `n` items at `items`, 0 for gaps.
pub(super) extern "C" fn make(context: *mut Context, v: u32, items: *const u32, n: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        // SAFETY: compiled code has written that many items there.
        let items = unsafe { std::slice::from_raw_parts(items, n as usize) };
        let items: Vec<Option<Vertex>> = items.iter().map(|&x| vertex(x)).collect();
        run.grow_slots_for(items.len())?;
        run.mesh.make(vertex(v)?, &items).ok()?;
        run.look_for_a_gap(vertex(v)?);
        Some(status::DONE)
    })
}

impl Run<'_> {
    /// Room so that a ring that must move can move to twice its size or to `len`.
    fn grow_slots_for(&mut self, len: usize) -> Option<()> {
        let slots = self.mesh.arrays().slots;
        let needed = 2 * len + 16;
        if slots.capacity() < slots.len() + needed + PADDING { self.grow_slots(needed) } else { Some(()) }
    }

    /// A ring was edited that may have got a gap.
    fn look_for_a_gap(&mut self, v: Vertex) {
        if self.mesh.ring(v).slots().last() == Some(&None) {
            self.note_gaps_or_edge_values();
        }
    }

    fn len(&self, v: u32) -> usize {
        vertex(v).map_or(0, |v| self.mesh.ring(v).slots().len())
    }
}

/// `erase`, 0 is the gap.
pub(super) extern "C" fn erase(context: *mut Context, x: u32, v: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        run.mesh.erase(vertex(x), vertex(v)?);
        Some(status::DONE)
    })
}

/// `replace`, 0 is the gap on either side.
pub(super) extern "C" fn replace(context: *mut Context, a: u32, x: u32, v: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        run.mesh.replace(vertex(a), vertex(x), vertex(v)?).ok()?;
        run.look_for_a_gap(vertex(v)?);
        Some(status::DONE)
    })
}

/// `splice`, 0 is the gap on either side.
pub(super) extern "C" fn splice(context: *mut Context, x: u32, a: u32, v: u32, before: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        run.grow_slots_for(run.len(v) + 1)?;
        let (x, a, v) = (vertex(x), vertex(a), vertex(v)?);
        let done = if before != 0 { run.mesh.splice_before(x, a, v) } else { run.mesh.splice_after(x, a, v) };
        done.ok()?;
        run.look_for_a_gap(v);
        Some(status::DONE)
    })
}

/// Where `x` (0 is the gap) stands in a ring, -1 if it does not.
pub(super) extern "C" fn find(context: *mut Context, x: u32, v: u32, old: u32) -> i32 {
    reading(context, -1, |run| {
        let i = run.ring(vertex(v)?, old != 0).find(vertex(x))?;
        i32::try_from(i).ok()
    })
}

/// How many gaps a ring has.
pub(super) extern "C" fn gaps(context: *mut Context, v: u32, old: u32) -> u32 {
    reading(context, 0, |run| Some(run.ring(vertex(v)?, old != 0).gaps() as u32))
}

/// An edge property between two vertices, into the words.
pub(super) extern "C" fn edge_load(context: *mut Context, property: u32, p: u32, q: u32, old: u32) -> u32 {
    reading(context, status::REPEAT, |run| {
        words_in(context)[..3].copy_from_slice(&run.edge_words(property, p, q, old != 0)?);
        Some(status::DONE)
    })
}

/// An edge property between two vertices, from the words.
pub(super) extern "C" fn edge_store(context: *mut Context, property: u32, p: u32, q: u32) -> u32 {
    guard(context, status::REPEAT, |run| run.edge_store(property, p, q).map(|()| status::DONE))
}
