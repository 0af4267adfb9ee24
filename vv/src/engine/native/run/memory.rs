//! The arrays of a run: made unshared, handed to compiled code and taken back, grown.

use super::super::context::{Context, PADDING, RawList, RawSet, room_for};
use super::{List, Run, guard, status};
use crate::mesh::{Column, Head, Mesh, Values, Vertex, VertexSet, spare};

/// Bytes a vertex needs beside its properties, when memory is counted.
const VERTEX_BYTES: usize = 12 + 24 + 6 * 4;

/// Runs `$body` with `$column` bound to the typed column inside `$values`.
macro_rules! on_column {
    ($values:expr, $column:ident => $body:expr) => {
        match $values {
            Values::Bool($column) => $body,
            Values::Int($column) => $body,
            Values::Double($column) => $body,
            Values::Vec($column) => $body,
            Values::Vertex($column) => $body,
        }
    };
}

impl Run<'_> {
    /// Copies arrays that others share; `false` if there is not enough memory allowed for that.
    pub(super) fn own(&mut self) -> bool {
        let n = self.mesh.vertex_count();
        if self.mesh.bytes() > self.fixed.settings.limits.max_bytes {
            return false;
        }
        let has_edge_values = !self.mesh.edge_properties().is_empty();
        let slots = self.mesh.slots().len();
        let (mut vertex_room, mut slot_room) = (n, slots);
        // Refinement ends with four times as many, or with as many besides if it makes a new set; pages that are not touched
        // cost nothing.
        let each = VERTEX_BYTES + 8 * self.vertex_columns.len();
        let times = if self.fixed.replaces { 5 } else { 4 };
        if self.fixed.creates && self.allows(times * (n * each + 4 * slots)) {
            (vertex_room, slot_room) = (times * n + 64, times * slots + 512);
        }
        let doubled = self.mesh.heads().iter().map(|head| room_for(2 * head.len) as usize).sum::<usize>();
        let grows = self.fixed.grows && !has_edge_values && u32::try_from(doubled).is_ok();
        if grows && self.allows(24 * n + 4 * slot_room.max(doubled)) {
            slot_room = slot_room.max(doubled);
            let (heads, slots) = with_double_room(&self.mesh, vertex_room, slot_room + PADDING);
            let arrays = self.mesh.arrays();
            (*arrays.heads, *arrays.slots) = (heads, slots);
        }
        let arrays = self.mesh.arrays();
        own_column(arrays.heads, vertex_room);
        own_column(arrays.slots, slot_room + PADDING);
        own_column(arrays.positions, vertex_room);
        for (i, property) in arrays.vertex_properties.iter_mut().enumerate() {
            let room = if self.vertex_columns.contains(&i) { vertex_room } else { n };
            own_values(&mut property.values, room);
        }
        for property in arrays.edge_properties {
            own_values(&mut property.values, 0);
        }
        // SAFETY: the context is a header at least.
        unsafe {
            (*self.context).has_edge_values = u64::from(has_edge_values);
            (*self.context).edit_limit = if has_edge_values { 0 } else { u64::MAX };
            (*self.context).edit_within = std::array::from_fn(|i| i as u32);
        }
        // Of the new arrays: that has them at hand for the run, which else waits for many that were written and left.
        let has_gap = |head: &Head| self.mesh.slots()[head.range()].last() == Some(&None);
        if has_edge_values || self.fixed.edits && self.mesh.heads().iter().any(has_gap) {
            self.note_gaps_or_edge_values();
        }
        true
    }

    /// From now on compiled code asks whether rings have gaps or values beside them.
    pub(super) fn note_gaps_or_edge_values(&mut self) {
        // SAFETY: the context is valid, and compiled code does not run.
        unsafe {
            (*self.context).gaps_or_edge_values = 1;
            (*self.context).edit_within = [0; _];
        };
    }

    /// Takes the arrays back from compiled code: their lengths become what it has written.
    pub(super) fn enter(&mut self) {
        // SAFETY: the context is valid, and compiled code, which is waiting, does not touch it.
        let context = unsafe { &*self.context };
        let (n, slots) = (context.vertex_count as usize, context.slot_len as usize);
        let arrays = self.mesh.arrays();
        let grown = arrays.heads.len() != n;
        if grown {
            // SAFETY: compiled code has written all elements up to `n`, which is within the capacity of these arrays
            // (`vertex_capacity` is the smallest of them).
            unsafe {
                arrays.heads.edit().set_len(n);
                arrays.positions.edit().set_len(n);
                for &column in &self.vertex_columns {
                    set_len(&mut arrays.vertex_properties[column].values, n);
                }
            }
            for property in arrays.vertex_properties {
                let default = property.default;
                if property.values.len() != n {
                    property.values.resize(n, default);
                }
            }
        }
        if arrays.slots.len() != slots {
            let column = arrays.slots.edit();
            let from = column.len();
            // SAFETY: `slots` and [`PADDING`] more are within the capacity. Compiled code takes runs of slots of which
            // it writes the first; the others are written here, so that all are initialised.
            unsafe {
                column.set_len(slots);
                debug_assert!(from <= slots);
            }
            for property in arrays.edge_properties {
                let default = property.default;
                property.values.resize(slots, default);
            }
        }
        for (list, raw) in self.lists.iter_mut().zip(&self.raw_lists) {
            // SAFETY: compiled code has written all vertices up to `len`, which is within the capacity.
            unsafe { list.set_len(raw.len as usize) };
        }
        for (set, raw) in self.sets.iter_mut().zip(&self.raw_sets) {
            if raw.capacity > 0
                && let Some(order) = set.members.ascending()
                && order.len() != raw.len as usize
            {
                // SAFETY: compiled code has written all members up to `len`, which is within the capacity.
                unsafe { order.set_len(raw.len as usize) };
            }
        }
    }

    /// Hands the arrays to compiled code.
    pub(super) fn leave(&mut self) {
        // SAFETY: as in `enter`.
        let context = unsafe { &mut *self.context };
        let max_vertices = self.fixed.settings.limits.max_vertices.min(u32::MAX as usize - 1);
        let arrays = self.mesh.arrays();
        let mut capacity = arrays.heads.capacity().min(arrays.positions.capacity());
        context.vertex_count = arrays.heads.len() as u64;
        context.heads = arrays.heads.edit().as_mut_ptr();
        context.positions = arrays.positions.edit().as_mut_ptr().cast();
        context.slot_len = arrays.slots.len() as u64;
        let slot_capacity = arrays.slots.capacity().saturating_sub(PADDING).min(u32::MAX as usize) as u64;
        context.slot_capacity = if context.has_edge_values == 0 { slot_capacity } else { 0 };
        context.slots = arrays.slots.edit().as_mut_ptr().cast();
        for (i, &column) in self.vertex_columns.iter().enumerate() {
            let values = &mut arrays.vertex_properties[column].values;
            let (pointer, room) = raw_column(values);
            capacity = capacity.min(room);
            let word = self.fixed.layout.vertex_column(i, false);
            // SAFETY: the block has that many words.
            unsafe { *self.context.cast::<*mut u8>().add(word) = pointer };
        }
        // SAFETY: as in `enter`.
        let context = unsafe { &mut *self.context };
        context.vertex_capacity = capacity.min(max_vertices) as u64;
        self.leave_sets();
        self.raw_lists.clear();
        self.raw_lists.extend(self.lists.iter_mut().map(|list| RawList {
            start: list.as_mut_ptr().cast(),
            len: list.len() as u64,
            capacity: list.capacity().saturating_sub(PADDING).min(i32::MAX as usize) as u64,
        }));
        // SAFETY: as in `enter`.
        let context = unsafe { &mut *self.context };
        context.lists = self.raw_lists.as_mut_ptr();
        context.list_count = self.raw_lists.len() as u64;
    }

    fn leave_sets(&mut self) {
        self.raw_sets.clear();
        for set in &mut self.sets {
            let number = |v: Vertex| v.index() as u64 + 1;
            let span = set.members.span();
            let closed = RawSet {
                order: std::ptr::null_mut(),
                len: span.map_or(u64::MAX, |(first, last)| number(last) - number(first) + 1),
                capacity: 0,
                first: span.map_or(1, |(first, _)| number(first)),
                last: span.map_or(0, |(_, last)| number(last)),
            };
            let raw = match set.members.ascending() {
                Some(order) => RawSet {
                    len: order.len() as u64,
                    capacity: if order.is_empty() { 0 } else { order.capacity() as u64 },
                    first: order.first().copied().flatten().map_or(1, number),
                    last: order.last().copied().flatten().map_or(0, number),
                    order: order.as_mut_ptr().cast(),
                },
                None => closed,
            };
            self.raw_sets.push(raw);
        }
        // SAFETY: as in `enter`.
        let context = unsafe { &mut *self.context };
        context.sets = self.raw_sets.as_mut_ptr();
        context.set_count = self.raw_sets.len() as u64;
    }

    /// Makes pointers to the old copies anew.
    pub(super) fn leave_old(&mut self) {
        // SAFETY: as in `enter`.
        let context = unsafe { &mut *self.context };
        context.old_positions = self.old.positions().as_ptr().cast();
        let vertex_columns: Vec<*const u8> =
            self.vertex_columns.iter().map(|&c| column_pointer(&self.old.vertex_properties()[c].values)).collect();
        context.old_heads = self.old.heads().as_ptr();
        context.old_slots = self.old.slots().as_ptr().cast();
        for (i, pointer) in vertex_columns.into_iter().enumerate() {
            let word = self.fixed.layout.vertex_column(i, true);
            // SAFETY: the block has that many words.
            unsafe { *self.context.cast::<*const u8>().add(word) = pointer };
        }
    }

    /// Whether so many bytes more are allowed.
    pub(super) fn allows(&self, more: usize) -> bool {
        let sets: usize = self.sets.iter().map(|s| s.members.bytes()).sum();
        let walked: usize = self.walked.iter().map(VertexSet::bytes).sum();
        let lists = self.lists.iter().chain(&self.walks).chain(&self.spare_lists).chain([&self.returned_list]);
        let lists: usize = lists.map(|list| 4 * list.capacity() + size_of::<List>()).sum();
        let faces: usize = self.walked_faces.iter().map(|(c, e)| 4 * (c.capacity() + e.capacity())).sum();
        let used = self.mesh.bytes() + self.old.bytes() + sets + walked + lists + faces + self.printed;
        used.saturating_add(more) <= self.fixed.settings.limits.max_bytes
    }

    /// Makes room for at least one more vertex.
    pub(super) fn grow_vertices(&mut self) -> Option<()> {
        let n = self.mesh.vertex_count();
        let max = self.fixed.settings.limits.max_vertices.min(u32::MAX as usize - 1);
        if n >= max {
            return None;
        }
        let each = VERTEX_BYTES + 8 * self.vertex_columns.len();
        // Half as much again at least; four times as many is what a refinement of triangles ends with.
        let wanted = [4 * n + 64, 2 * n, n + n / 2, n + 64].into_iter().map(|w| w.min(max));
        let capacity = wanted.filter(|&w| w > n).find(|w| self.allows((w - n).saturating_mul(each)))?;
        let arrays = self.mesh.arrays();
        own_column(arrays.heads, capacity);
        own_column(arrays.positions, capacity);
        for &column in &self.vertex_columns {
            own_values(&mut arrays.vertex_properties[column].values, capacity);
        }
        Some(())
    }

    /// Makes room for `more` slots.
    pub(super) fn grow_slots(&mut self, more: usize) -> Option<()> {
        let n = self.mesh.slots().len();
        if n + more > u32::MAX as usize {
            return None;
        }
        let wanted = [4 * n + 512, 2 * n + 64, n + n / 2 + 64, n + more].into_iter().filter(|&w| w >= n + more);
        let capacity = wanted.map(|w| w.min(u32::MAX as usize)).find(|w| self.allows(4 * (w - n)))?;
        own_column(self.mesh.arrays().slots, capacity + PADDING);
        Some(())
    }

    /// The rule's mesh with the result.
    pub(super) fn finish(mut self) -> Mesh {
        let Some(set) = self.sets.into_iter().next() else { return self.mesh };
        self.mesh.set = set.members;
        for (index, value) in self.mesh_columns.into_iter().zip(set.properties) {
            self.mesh.set_mesh_value(index, value);
        }
        let arrays = self.mesh.arrays();
        let (n, slots) = (arrays.heads.len(), arrays.slots.len());
        // What was reserved and not used goes back, unless it is little: then the array serves the next run as it is.
        shrink(arrays.heads, n);
        shrink(arrays.positions, n);
        shrink(arrays.slots, slots + PADDING);
        for property in arrays.vertex_properties {
            on_column!(&mut property.values, c => shrink(c, n));
        }
        self.mesh
    }
}

pub(super) extern "C" fn grow_vertices(context: *mut Context) -> u32 {
    guard(context, status::REPEAT, |run| run.grow_vertices().map(|()| status::DONE))
}

pub(super) extern "C" fn grow_slots(context: *mut Context, more: u64) -> u32 {
    guard(context, status::REPEAT, |run| run.grow_slots(more as usize).map(|()| status::DONE))
}

/// The rings of a mesh, one after the other in order, each with room for at least twice as many vertices: a program that
/// splices into most of them then moves none. `slots` are as many as they take, and [`PADDING`].
fn with_double_room(mesh: &Mesh, vertices: usize, slots: usize) -> (Column<Head>, Column<Option<Vertex>>) {
    let mut heads: Vec<Head> = spare(vertices);
    let mut arena: Vec<Option<Vertex>> = spare(slots);
    for head in mesh.heads() {
        let ring = mesh.slots().get(head.range()).unwrap_or(&[]);
        let capacity = room_for(2 * head.len);
        let offset = arena.len();
        heads.push(Head { offset: offset as u32, len: head.len, capacity });
        arena.extend_from_slice(ring);
        arena.resize(offset + capacity as usize, None);
    }
    (heads.into(), arena.into())
}

/// Makes an array unshared, with room for so many elements.
fn own_column<T: Copy + Send>(column: &mut Column<T>, capacity: usize) {
    let capacity = capacity.max(column.len());
    if column.is_shared() {
        let mut copy = spare(capacity);
        copy.extend_from_slice(column);
        *column = Column::from(copy);
    } else if column.capacity() < capacity {
        let values = column.edit();
        values.reserve_exact(capacity - values.len());
    }
}

fn own_values(values: &mut Values, capacity: usize) {
    on_column!(values, c => own_column(c, capacity));
}

fn shrink<T: Clone + Send>(column: &mut Column<T>, room: usize) {
    if column.capacity() - column.capacity() / 8 > room {
        column.edit().shrink_to(room);
    }
}

fn raw_column(values: &mut Values) -> (*mut u8, usize) {
    on_column!(values, c => (c.edit().as_mut_ptr().cast(), c.capacity()))
}

fn column_pointer(values: &Values) -> *const u8 {
    fn pointer<T: Send>(c: &Column<T>) -> *const u8 {
        c.as_ptr().cast()
    }
    on_column!(values, c => pointer(c))
}

/// Sets the length of a column.
///
/// # Safety
/// Its first `n` elements are written and within its capacity.
unsafe fn set_len(values: &mut Values, n: usize) {
    // SAFETY: as promised by the caller.
    on_column!(values, c => unsafe { c.edit().set_len(n) });
}
