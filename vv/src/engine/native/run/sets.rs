//! Vertex sets.

use super::{Context, Run, Set, guard, reading, status, value_words, vertex};
use crate::mesh::VertexSet;

impl Run<'_> {
    fn new_set(&mut self, members: VertexSet) -> u32 {
        let properties = self.fixed.program.mesh_properties.iter().map(|p| p.default).collect();
        self.sets.push(Set { members, properties });
        self.sets.len() as u32 - 1
    }

    fn members(&self, set: u32) -> Option<VertexSet> {
        Some(self.sets.get(set as usize)?.members.clone())
    }

    /// Makes room for more members of a set that compiled code pushes to: twice as many, or at once for all that there can
    /// be where that is large, for copying it again and again would touch fresh memory each time.
    fn grow_set(&mut self, set: u32) -> Option<()> {
        let vertices = self.mesh.arrays().heads.capacity();
        let len = self.sets.get(set as usize)?.members.len();
        let all = vertices.saturating_sub(len);
        let more = if len >= LARGE && all > 0 && self.allows(4 * all) { all } else { len.max(256) };
        self.allows(4 * more).then_some(())?;
        self.set_mut(set)?.members.ascending()?.reserve_exact(more);
        Some(())
    }

    fn set_mut(&mut self, set: u32) -> Option<&mut Set> {
        self.sets.get_mut(set as usize)
    }
}

const NO_SET: u32 = u32::MAX;

/// So many members are many.
const LARGE: usize = 1 << 14;

/// A new variable of type mesh.
pub(super) extern "C" fn set_new(context: *mut Context) -> u32 {
    guard(context, NO_SET, |run| Some(run.new_set(VertexSet::default())))
}

/// A copy of a set, members and properties.
pub(super) extern "C" fn set_copy(context: *mut Context, set: u32) -> u32 {
    guard(context, NO_SET, |run| {
        let copy = run.sets.get(set as usize)?.clone();
        run.sets.push(copy);
        Some(run.sets.len() as u32 - 1)
    })
}

/// Drops the sets from `count` on.
pub(super) extern "C" fn set_drop(context: *mut Context, count: u64) {
    guard(context, (), |run| {
        run.sets.truncate(count as usize);
        Some(())
    });
}

/// Declares a variable of type mesh: members of another or none ([`NO_SET`]), properties at their defaults.
pub(super) extern "C" fn set_declare(context: *mut Context, set: u32, other: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        let members = if other == NO_SET { VertexSet::default() } else { run.members(other)? };
        let program = run.fixed.program;
        let set = run.set_mut(set)?;
        set.members = members;
        set.properties = program.mesh_properties.iter().map(|p| p.default).collect();
        Some(status::DONE)
    })
}

/// `S = T`
pub(super) extern "C" fn set_assign(context: *mut Context, set: u32, other: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        let members = run.members(other)?;
        run.set_mut(set)?.members = members;
        Some(status::DONE)
    })
}

/// `merge S with T`
pub(super) extern "C" fn set_merge(context: *mut Context, set: u32, other: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        let members = run.members(other)?;
        run.allows(4 * members.len()).then_some(())?;
        run.set_mut(set)?.members.merge(&members);
        Some(status::DONE)
    })
}

/// `add v to S`
pub(super) extern "C" fn set_add(context: *mut Context, set: u32, v: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        let members = &mut run.set_mut(set)?.members;
        members.add(vertex(v)?);
        if members.ascending().is_some_and(|order| order.len() == order.capacity()) {
            run.grow_set(set)?;
        }
        Some(status::DONE)
    })
}

/// `remove v from S`
pub(super) extern "C" fn set_remove(context: *mut Context, set: u32, v: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        run.set_mut(set)?.members.remove(vertex(v)?);
        Some(status::DONE)
    })
}

/// `is v in S`; v is not null.
pub(super) extern "C" fn set_contains(context: *mut Context, set: u32, v: u32) -> u32 {
    reading(context, 0, |run| Some(u32::from(run.sets.get(set as usize)?.members.contains(vertex(v)?))))
}

/// Keeps a set for the caller.
pub(super) extern "C" fn set_return(context: *mut Context, set: u32) -> u32 {
    guard(context, status::REPEAT, |run| {
        run.returned = Some(run.sets.get(set as usize)?.clone());
        Some(status::DONE)
    })
}

/// The set that a call returned, as a set of its own.
pub(super) extern "C" fn set_take(context: *mut Context) -> u32 {
    guard(context, NO_SET, |run| {
        let set = run.returned.take().unwrap_or_default();
        run.sets.push(set);
        Some(run.sets.len() as u32 - 1)
    })
}

/// Begins to walk a set: address and number of its members into the words, the result is how many were walked before.
pub(super) extern "C" fn set_walk(context: *mut Context, set: u32) -> u64 {
    guard(context, u64::MAX, |run| {
        let members = run.members(set)?;
        let words = value_words(run);
        words[0] = members.order().as_ptr().addr() as u64;
        words[1] = members.order().len() as u64;
        run.walked.push(members);
        Some(run.walked.len() as u64 - 1)
    })
}

/// Ends walks: so many are left.
pub(super) extern "C" fn set_walk_end(context: *mut Context, count: u64) {
    guard(context, (), |run| {
        run.walked.truncate(count as usize);
        Some(())
    });
}
