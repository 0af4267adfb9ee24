//! A run of compiled code, and the functions it calls where it does not do the work itself.
//!
//! # Why this is sound
//!
//! Compiled code works on the arrays of the run's [`Mesh`] through raw pointers in the [`Context`]. It stores only
//! inside them:
//!
//! - Every vertex it meets lies in the universe. Vertices come from the mesh, whose rings, columns and sets are looked
//!   through before the run ([`names_only_its_own`]), and from creation; a run forgets none. So an index into an array
//!   with an element per vertex is in bounds, and null is asked for before each.
//! - A head names a run of slots inside the arena, an invariant of rings that compiled code keeps: it enters at most
//!   `capacity` vertices, and takes fresh runs only where the arena has room.
//! - New vertices and slots are written into the spare capacity of the vectors; the runtime sets their lengths to what
//!   was written before it touches them ([`Run::enter`]) and makes all pointers anew before it returns
//!   ([`Run::leave`]), for it may have moved them. Compiled code keeps no pointer into the arrays across a call that
//!   may move them.
//! - The arrays are not shared with another mesh while compiled code runs: [`own`] copies those that are.
//! - A panic does not cross compiled frames: [`guard`] turns it into a status.
//! - The native stack is bounded: every compiled function that is called asks whether there is room left.
#![expect(unsafe_code, reason = "compiled code and what it shares with the runtime; the argument stands above")]

mod edges;
mod print;
mod rings;
mod sets;
mod symbols;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;

use cranelift_jit::JITModule;
use cranelift_module::FuncId;

use super::context::{Context, Layout, MEMO_WORDS, Memo, PADDING, RawSet, byte_offset, status};
use super::effects::OldReads;
use crate::builtins::{Builtin, Random};
use crate::engine::{Output, Settings};
use crate::ir::{FunctionId, Program};
use crate::mesh::{Column, Mesh, Value, Values, Vertex, VertexSet};

pub(super) use print::type_number;
pub(super) use symbols::{Symbol, symbols};

/// Room for what compiled functions need on the native stack, all open calls together.
const STACK: usize = 16 << 20;

/// What the runtime's own functions may need of it.
const RUNTIME_STACK: usize = 512 << 10;

/// Bytes a vertex needs beside its properties, when memory is counted.
const VERTEX_BYTES: usize = 12 + 24 + 6 * 4;

/// How a run ended.
pub(super) enum End {
    Done(Mesh),
    /// The interpreter shall do it, or say why it cannot be done.
    Repeat,
    /// At a site, called from sites.
    Stopped(usize, Vec<usize>),
    Closed(usize, Vec<usize>),
}

/// What compiled code is called as: a rule with the index of its set, the globals with anything.
type Entry = extern "C" fn(*mut Context, u32) -> u32;

/// Machine code, as long as it is in use.
pub(super) struct Executable {
    /// Taken when it is dropped.
    module: Mutex<Option<JITModule>>,
    globals: Entry,
    rules: Vec<(FunctionId, Entry)>,
}

impl Executable {
    /// Of a module whose definitions are final, the function that computes the globals, and those of rules.
    pub(super) fn new(module: JITModule, globals: FuncId, rules: &[(FunctionId, FuncId)]) -> Self {
        let entry = |id| {
            // SAFETY: these functions were compiled with the signature of `Entry`: the checker lets only functions of
            // one mesh be rules. Their code stays until `self` is dropped, and calls go through `run`, which borrows it.
            unsafe { std::mem::transmute::<*const u8, Entry>(module.get_finalized_function(id)) }
        };
        let globals = entry(globals);
        let rules = rules.iter().map(|&(function, id)| (function, entry(id))).collect();
        Self { module: Mutex::new(Some(module)), globals, rules }
    }
}

impl Drop for Executable {
    fn drop(&mut self) {
        let module = self.module.get_mut().map_or_else(|e| e.into_inner().take(), Option::take);
        if let Some(module) = module {
            // SAFETY: nothing runs in it, for running borrows `self`, and no pointer into it is kept elsewhere.
            unsafe { module.free_memory() };
        }
    }
}

/// A variable of type mesh.
#[derive(Clone, Default)]
struct Set {
    members: VertexSet,
    /// Values of the program's mesh properties.
    properties: Vec<Value>,
}

/// What does not change while a program runs.
pub(super) struct Fixed<'a> {
    pub(super) program: &'a Program,
    pub(super) layout: &'a Layout,
    pub(super) old_reads: &'a OldReads,
    pub(super) texts: &'a [String],
    pub(super) memos: &'a [Memo],
    /// Whether it may create vertices.
    pub(super) creates: bool,
    pub(super) settings: &'a Settings,
}

/// The state of a run that compiled code sees only through the [`Context`].
pub(super) struct Run<'a> {
    fixed: Fixed<'a>,
    output: &'a mut dyn Output,
    context: *mut Context,
    mesh: Mesh,
    /// The mesh as it was before the run, with the program's properties.
    before: Mesh,
    vertex_columns: Vec<usize>,
    edge_columns: Vec<usize>,
    mesh_columns: Vec<usize>,
    old: Mesh,
    /// Which vertices have an old value, behind [`Context::old_prefix`] if that is not 0.
    held: Vec<bool>,
    sets: Vec<Set>,
    raw_sets: Vec<RawSet>,
    returned: Option<Set>,
    /// Sets that loops walk.
    walked: Vec<VertexSet>,
    /// Rings that loops walk while they edit them.
    walk: Vec<Vertex>,
    random: Random,
    lines: Vec<String>,
    printed: usize,
    /// Sites of the calls that were open when the run was stopped, innermost first.
    calls: Vec<usize>,
}

/// Runs compiled code: what computes the globals first, then a rule.
pub(super) fn run(
    fixed: Fixed<'_>,
    code: &Executable,
    function: FunctionId,
    mesh: &Mesh,
    generation: u64,
    output: &mut dyn Output,
) -> End {
    let Some(&(_, rule)) = code.rules.iter().find(|(id, _)| *id == function) else { return End::Repeat };
    let globals = code.globals;
    if !names_only_its_own(mesh) {
        return End::Repeat;
    }
    let program = fixed.program;
    let mut mesh = mesh.clone();
    let vertex_columns: Vec<usize> =
        program.vertex_properties.iter().map(|p| mesh.declare_vertex_property(&p.name, p.default)).collect();
    let edge_columns: Vec<usize> =
        program.edge_properties.iter().map(|p| mesh.declare_edge_property(&p.name, p.default)).collect();
    let mesh_columns: Vec<usize> =
        program.mesh_properties.iter().map(|p| mesh.declare_mesh_property(&p.name, p.default)).collect();
    let before = mesh.clone();
    let members = std::mem::take(&mut mesh.set);
    let value_of = |i: &usize| mesh.mesh_properties().get(*i).map_or(Value::Bool(false), |(_, value)| *value);
    let properties = mesh_columns.iter().map(value_of).collect();
    let mut words = vec![0_u64; fixed.layout.words()];
    let context = words.as_mut_ptr().cast::<Context>();
    let mut run = Run {
        context,
        mesh,
        before,
        vertex_columns,
        edge_columns,
        mesh_columns,
        old: Mesh::new(),
        held: Vec::new(),
        sets: vec![Set { members, properties }],
        raw_sets: Vec::new(),
        returned: None,
        walked: Vec::new(),
        walk: Vec::new(),
        random: Random::new(fixed.settings.seed, generation),
        lines: Vec::new(),
        printed: 0,
        calls: Vec::new(),
        output,
        fixed,
    };
    run.fill_memos();
    if !run.own() || !run.give_parameters() {
        return End::Repeat;
    }
    let run_pointer = std::ptr::from_mut(&mut run);
    // SAFETY: the block of words is as long as the layout says, at least a header; nothing else refers to it.
    unsafe {
        (*context).run = run_pointer.cast();
        (*context).stop = (*run_pointer).fixed.settings.stop.flag().as_ptr();
        (*context).max_depth = u64::from((*run_pointer).fixed.settings.limits.max_call_depth);
    }
    // SAFETY: `run` lives until the end of this function and is used through this pointer alone until compiled code has
    // returned.
    let status = stacker::grow(STACK, || unsafe {
        (*run_pointer).leave();
        (*context).stack_limit = stack_limit();
        match globals(context, 0) {
            status::DONE => {
                (*context).depth = 0;
                rule(context, 0)
            }
            other => other,
        }
    });
    // SAFETY: as above; compiled code has returned.
    let site = unsafe { (*context).site } as usize;
    run.enter();
    match status {
        status::DONE => End::Done(run.finish()),
        status::STOPPED => End::Stopped(site, run.calls),
        status::CLOSED => End::Closed(site, run.calls),
        _ => End::Repeat,
    }
}

/// An address that leaves [`RUNTIME_STACK`] of the stack that was just made.
fn stack_limit() -> usize {
    let here = 0_u8;
    std::ptr::from_ref(&here).addr() - (STACK - RUNTIME_STACK)
}

/// Whether every vertex that the mesh names exists in it. A mesh whose makers kept to their own handles is so.
fn names_only_its_own(mesh: &Mesh) -> bool {
    let n = mesh.vertex_count();
    let largest = n.checked_sub(1).and_then(Vertex::from_index);
    let fits = |x: Option<Vertex>| x <= largest;
    let column_fits = |values: &Values| match values {
        Values::Vertex(c) => c.iter().all(|&x| fits(x)),
        _ => true,
    };
    // One pass over the arena without a branch per slot.
    mesh.slots().iter().fold(true, |ok, &x| ok & fits(x))
        && mesh.positions().len() == n
        && mesh.set.order().iter().fold(true, |ok, &x| ok & fits(x))
        && mesh.vertex_properties().iter().chain(mesh.edge_properties()).all(|p| column_fits(&p.values))
        && mesh.mesh_properties().iter().all(|(_, value)| !matches!(value, Value::Vertex(x) if !fits(*x)))
}

impl Run<'_> {
    /// Copies arrays that others share; `false` if there is not enough memory allowed for that.
    fn own(&mut self) -> bool {
        let n = self.mesh.vertex_count();
        if self.mesh.bytes() > self.fixed.settings.limits.max_bytes {
            return false;
        }
        let has_edge_values = !self.mesh.edge_properties().is_empty();
        let slots = self.mesh.slots().len();
        let (mut vertex_room, mut slot_room) = (n, slots);
        // Refinement ends with four times as many; pages that are not touched cost nothing.
        let each = VERTEX_BYTES + 8 * self.vertex_columns.len();
        if self.fixed.creates && self.allows(4 * n * each + 16 * slots) {
            (vertex_room, slot_room) = (4 * n + 64, 4 * slots + 512);
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
        unsafe { (*self.context).has_edge_values = u64::from(has_edge_values) };
        true
    }

    /// Stores the values given for parameters; `false` if one does not fit, or is a vertex of who knows where.
    fn give_parameters(&mut self) -> bool {
        for (id, value) in &self.fixed.settings.params {
            let index = id.0 as usize;
            let Some(global) = self.fixed.program.globals.get(index).filter(|g| g.param.is_some()) else { continue };
            let Some(value) = crate::engine::interpret::convert_to(*value, global.ty) else { return false };
            let Some(words) = words_of(value).filter(|_| !matches!(value, Value::Vertex(Some(_)))) else {
                return false;
            };
            for (i, word) in words.into_iter().enumerate() {
                self.set_word(self.fixed.layout.global(index) + i, word);
            }
            self.set_word(self.fixed.layout.given(index), 1);
        }
        true
    }

    /// Lets every memo begin with the function's value at 0.
    fn fill_memos(&mut self) {
        for memo in self.fixed.memos {
            let zeros = [Value::Double(0.0); 2];
            let operands = zeros.get(..memo.builtin.parameters().len()).unwrap_or(&zeros);
            let at_zero = memo.builtin.apply(operands, &mut Random::new(0, 0));
            if let Some(Value::Double(y)) = at_zero {
                self.set_word(memo.word + MEMO_WORDS - 1, y.to_bits());
            }
        }
    }

    fn set_word(&mut self, word: usize, value: u64) {
        debug_assert!(word < self.fixed.layout.words());
        // SAFETY: the block has that many words.
        unsafe { *self.context.cast::<u8>().add(byte_offset(word) as usize).cast::<u64>() = value };
    }

    /// Takes the arrays back from compiled code: their lengths become what it has written.
    fn enter(&mut self) {
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
    fn leave(&mut self) {
        // SAFETY: as in `enter`.
        let context = unsafe { &mut *self.context };
        let max_vertices = self.fixed.settings.limits.max_vertices.min(u32::MAX as usize - 1);
        let arrays = self.mesh.arrays();
        let mut capacity = arrays.heads.capacity().min(arrays.positions.capacity());
        context.vertex_count = arrays.heads.len() as u64;
        context.heads = arrays.heads.edit().as_mut_ptr();
        context.positions = arrays.positions.edit().as_mut_ptr().cast();
        context.slot_len = arrays.slots.len() as u64;
        context.slot_capacity = arrays.slots.capacity().saturating_sub(PADDING).min(u32::MAX as usize) as u64;
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
        context.walk = self.walk.as_ptr().cast();
        context.walk_len = self.walk.len() as u64;
        self.leave_sets();
    }

    fn leave_sets(&mut self) {
        self.raw_sets.clear();
        for set in &mut self.sets {
            let closed = RawSet { order: std::ptr::null_mut(), len: 0, capacity: 0, last: u64::from(u32::MAX) };
            let raw = match set.members.ascending() {
                Some(order) => RawSet {
                    len: order.len() as u64,
                    capacity: order.capacity() as u64,
                    last: order.last().copied().flatten().map_or(0, |v| v.index() as u64 + 1),
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
    fn leave_old(&mut self) {
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
    fn allows(&self, more: usize) -> bool {
        let sets: usize = self.sets.iter().map(|s| s.members.bytes()).sum();
        let walked: usize = self.walked.iter().map(VertexSet::bytes).sum();
        let used = self.mesh.bytes() + self.old.bytes() + sets + walked + self.printed + 4 * self.walk.capacity();
        used.saturating_add(more) <= self.fixed.settings.limits.max_bytes
    }

    /// Makes room for at least one more vertex.
    fn grow_vertices(&mut self) -> Option<()> {
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
    fn grow_slots(&mut self, more: usize) -> Option<()> {
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
    fn finish(mut self) -> Mesh {
        let Some(set) = self.sets.into_iter().next() else { return self.mesh };
        self.mesh.set = set.members;
        for (index, value) in self.mesh_columns.into_iter().zip(set.properties) {
            self.mesh.set_mesh_value(index, value);
        }
        let arrays = self.mesh.arrays();
        let (n, slots) = (arrays.heads.len(), arrays.slots.len());
        // What was reserved and not used goes back.
        arrays.heads.edit().shrink_to(n);
        arrays.positions.edit().shrink_to(n);
        arrays.slots.edit().shrink_to(slots + PADDING);
        for property in arrays.vertex_properties {
            shrink_values(&mut property.values);
        }
        self.mesh
    }
}

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

/// Makes an array unshared, with room for so many elements.
fn own_column<T: Copy>(column: &mut Column<T>, capacity: usize) {
    let capacity = capacity.max(column.len());
    if column.is_shared() {
        let mut copy: Vec<T> = Vec::with_capacity(capacity);
        advise_huge_pages(copy.as_ptr().cast(), capacity * size_of::<T>());
        copy.extend_from_slice(column);
        *column = Column::from(copy);
    } else if column.capacity() < capacity {
        let values = column.edit();
        values.reserve_exact(capacity - values.len());
        advise_huge_pages(values.as_ptr().cast(), capacity * size_of::<T>());
    }
}

fn own_values(values: &mut Values, capacity: usize) {
    on_column!(values, c => own_column(c, capacity));
}

/// Asks for large pages where an array is large: first touch of small ones takes as long as all the rest of a step.
#[cfg(target_os = "linux")]
fn advise_huge_pages(start: *const u8, bytes: usize) {
    const PAGE: usize = 4096;
    if bytes < 4 << 20 {
        return;
    }
    let first = start.addr().next_multiple_of(PAGE);
    let end = (start.addr() + bytes) & !(PAGE - 1);
    if end > first {
        let address = start.with_addr(first).cast_mut().cast();
        // SAFETY: the range lies within an array that is ours, and the advice changes no contents. Refusal is no harm.
        unsafe { libc::madvise(address, end - first, libc::MADV_HUGEPAGE) };
    }
}

#[cfg(not(target_os = "linux"))]
fn advise_huge_pages(_start: *const u8, _bytes: usize) {}

fn shrink_values(values: &mut Values) {
    on_column!(values, c => c.edit().shrink_to_fit());
}

fn raw_column(values: &mut Values) -> (*mut u8, usize) {
    on_column!(values, c => (c.edit().as_mut_ptr().cast(), c.capacity()))
}

fn column_pointer(values: &Values) -> *const u8 {
    fn pointer<T>(c: &Column<T>) -> *const u8 {
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

/// A value as words: bits of doubles, handles from 1.
fn words_of(value: Value) -> Option<[u64; 3]> {
    Some(match value {
        Value::Bool(b) => [u64::from(b), 0, 0],
        Value::Int(i) => [i.cast_unsigned(), 0, 0],
        Value::Double(x) => [x.to_bits(), 0, 0],
        Value::Vec(v) => v.to_array().map(f64::to_bits),
        Value::Vertex(v) => [v.map_or(0, |v| v.index() as u64 + 1), 0, 0],
    })
}

/// The value of a type in words.
fn value_of(ty: crate::mesh::Type, words: &[u64]) -> Value {
    use crate::mesh::Type;
    let word = |i: usize| words.get(i).copied().unwrap_or(0);
    match ty {
        Type::Bool => Value::Bool(word(0) & 0xff != 0),
        Type::Int => Value::Int(word(0).cast_signed()),
        Type::Double => Value::Double(f64::from_bits(word(0))),
        Type::Vec => {
            Value::Vec(glam::DVec3::new(f64::from_bits(word(0)), f64::from_bits(word(1)), f64::from_bits(word(2))))
        }
        Type::Vertex => Value::Vertex(vertex(word(0) as u32)),
    }
}

/// The vertex behind a handle of compiled code, 0 is null.
fn vertex(handle: u32) -> Option<Vertex> {
    Vertex::from_index((handle as usize).checked_sub(1)?)
}

/// Does the work of a runtime function: takes the arrays, does it, hands them back. `None` and a panic are `otherwise`.
fn guard<T>(context: *mut Context, otherwise: T, work: impl FnOnce(&mut Run<'_>) -> Option<T>) -> T {
    light(context, otherwise, |run| {
        run.enter();
        let result = work(run);
        run.leave();
        result
    })
}

/// As [`guard`], for work that leaves the arrays alone.
fn light<T>(context: *mut Context, otherwise: T, work: impl FnOnce(&mut Run<'_>) -> Option<T>) -> T {
    // SAFETY: compiled code passes the context it was given, whose run is alive and not borrowed while it runs.
    let run = unsafe { &mut *(*context).run.cast::<Run<'_>>() };
    catch_unwind(AssertUnwindSafe(|| work(run))).ok().flatten().unwrap_or(otherwise)
}

/// The words through which operands and results go.
fn value_words<'a>(run: &mut Run<'_>) -> &'a mut [u64; 12] {
    // SAFETY: the context outlives the work of a runtime function, and nothing else refers to its words meanwhile.
    unsafe { &mut (*run.context).value }
}

pub(super) extern "C" fn grow_vertices(context: *mut Context) -> u32 {
    guard(context, status::REPEAT, |run| run.grow_vertices().map(|()| status::DONE))
}

pub(super) extern "C" fn grow_slots(context: *mut Context, more: u64) -> u32 {
    guard(context, status::REPEAT, |run| run.grow_slots(more as usize).map(|()| status::DONE))
}

/// Notes the site of a call that is being left because the run was stopped in it.
pub(super) extern "C" fn unwind(context: *mut Context, site: u32) {
    light(context, (), |run| {
        run.calls.push(site as usize);
        Some(())
    });
}

/// Calls a builtin with operands in the words, one or three each.
pub(super) extern "C" fn call_builtin(context: *mut Context, index: u32) -> u32 {
    light(context, status::REPEAT, |run| {
        let builtin = Builtin::all().nth(index as usize)?;
        let words = value_words(run);
        let mut arguments = [Value::Bool(false); 4];
        let mut at = 0;
        for (argument, &ty) in arguments.iter_mut().zip(builtin.parameters()) {
            *argument = value_of(ty, words.get(at..)?);
            at += if ty == crate::mesh::Type::Vec { 3 } else { 1 };
        }
        let result = builtin.apply(arguments.get(..builtin.parameters().len())?, &mut run.random)?;
        words[..3].copy_from_slice(&words_of(result)?);
        Some(status::DONE)
    })
}

/// Calls a function of one double by its address.
pub(super) extern "C" fn call_d1(function: usize, x: f64) -> f64 {
    // SAFETY: the address was taken from a function of this type when the program was compiled.
    let function = unsafe { std::mem::transmute::<usize, fn(f64) -> f64>(function) };
    catch_unwind(|| function(x)).unwrap_or(f64::NAN)
}

/// Calls a function of two doubles by its address.
pub(super) extern "C" fn call_d2(function: usize, x: f64, y: f64) -> f64 {
    // SAFETY: as in `call_d1`.
    let function = unsafe { std::mem::transmute::<usize, fn(f64, f64) -> f64>(function) };
    catch_unwind(|| function(x, y)).unwrap_or(f64::NAN)
}
