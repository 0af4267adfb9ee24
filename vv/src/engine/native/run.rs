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
//! - Lists and faces keep their vertices where they are until the list itself is edited; a loop walks a copy of a list
//!   that its body may edit. The runtime reads only as many vertices as compiled code took from a list.
//! - The arrays are not shared with another mesh while compiled code runs: [`own`] copies those that are.
//! - A panic does not cross compiled frames: [`guard`] turns it into a status.
//! - What is asked for early ([`super::ahead`]) is reached through heads of vertices that are clamped to those that have
//!   one, null too, and slots within their rings, or fewer than [`PADDING`](super::context::PADDING) behind them; corners are
//!   read up to [`CORNERS_AHEAD`](super::context::CORNERS_AHEAD) behind the last, where there are so many. The asking itself
//!   is a prefetch, which reads nothing and takes any address.
//! - The native stack is bounded: every compiled function that is called asks whether there is room left.
//! - Threads that do parts of a parallel loop ([`parallel`]) have a context each, with words and a stack limit of its own; all
//!   else that it leads to they share. Compiled code stores there only to its context, its frames, and to values of the
//!   vertex of the round, of which a set has each once: that no round stores elsewhere, or reads of others what rounds
//!   store, is found as it is translated ([`super::parallel`]), or one thread does them all. The runtime only reads, rings,
//!   old and edge values, sets ([`reading`]), and never a column that rounds may store to; what would change the run is
//!   refused ([`is_part`]). The thread that began the loop waits, and holds no reference to the run.
#![expect(unsafe_code, reason = "compiled code and what it shares with the runtime; the argument stands above")]

mod builtins;
mod edges;
mod keep;
mod lists;
mod memory;
mod parallel;
mod print;
mod rings;
mod sets;
mod symbols;
#[cfg(all(test, target_os = "linux"))]
mod tests;

use std::mem::ManuallyDrop;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;

use cranelift_jit::JITModule;
use cranelift_module::FuncId;

use super::context::{Context, Layout, Memo, RawList, RawSet, byte_offset, status};
use super::effects::OldReads;
use crate::builtins::Random;
use crate::engine::{Output, Settings};
use crate::ir::{FunctionId, Program};
use crate::mesh::{Mesh, Value, Values, Vertex, VertexSet};

pub use keep::keep_freed_memory;
use lists::List;
use parallel::{Rounds, is_part};
pub(super) use print::type_number;
pub(super) use symbols::{Symbol, symbols};

/// Room for what compiled functions need on the native stack, all open calls together.
const STACK: usize = 16 << 20;

/// What the runtime's own functions may need of it.
const RUNTIME_STACK: usize = 512 << 10;

/// Meshes of so many vertices and more lie in no cache. Tests, whose meshes are small, ask ahead in all.
const FAR: usize = if cfg!(debug_assertions) { 1 } else { 1 << 17 };

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

/// A module that gives its memory back.
pub(super) struct Owned(ManuallyDrop<JITModule>);

impl Owned {
    pub(super) fn new(module: JITModule) -> Self {
        Self(ManuallyDrop::new(module))
    }

    pub(super) fn module(&mut self) -> &mut JITModule {
        &mut self.0
    }
}

impl Drop for Owned {
    fn drop(&mut self) {
        // SAFETY: it is taken once, here. Nothing runs in it, for running borrows the `Executable` that holds it, and
        // pointers into it are kept nowhere else.
        unsafe { ManuallyDrop::take(&mut self.0).free_memory() };
    }
}

/// Machine code that can be run.
pub(super) struct Executable {
    /// Holds the code; the mutex makes it shareable between threads, and is never locked.
    _module: Mutex<Owned>,
    globals: Entry,
    rules: Vec<(FunctionId, Entry)>,
    rounds: Vec<Rounds>,
}

impl Executable {
    /// Of a module whose definitions are final, the function that computes the globals, those of rules, and those that are
    /// rounds of parallel loops, with whether many threads may do them at once.
    pub(super) fn new(
        module: Owned,
        globals: FuncId,
        rules: &[(FunctionId, FuncId)],
        rounds: &[(FuncId, bool)],
    ) -> Self {
        let entry = |id| {
            // SAFETY: these functions were compiled with the signature of `Entry`: the checker lets only functions of
            // one mesh be rules. Their code stays until `self` is dropped, and calls go through `run`, which borrows it.
            unsafe { std::mem::transmute::<*const u8, Entry>(module.0.get_finalized_function(id)) }
        };
        let globals = entry(globals);
        let rules = rules.iter().map(|&(function, id)| (function, entry(id))).collect();
        let rounds = rounds.iter().map(|&(id, apart)| {
            // SAFETY: as above, with the signature of rounds.
            unsafe { Rounds::new(module.0.get_finalized_function(id), apart) }
        });
        let rounds = rounds.collect();
        Self { _module: Mutex::new(module), globals, rules, rounds }
    }

    /// Of the rounds of parallel loops, in order: whether many threads may do them.
    #[cfg(test)]
    pub(super) fn rounds(&self) -> impl Iterator<Item = bool> {
        self.rounds.iter().map(|r| r.apart)
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
    /// Whether it splices vertices into rings.
    pub(super) grows: bool,
    /// Whether it assigns sets.
    pub(super) replaces: bool,
    /// Whether it edits rings.
    pub(super) edits: bool,
    pub(super) settings: &'a Settings,
}

/// The state of a run that compiled code sees only through the [`Context`].
pub(super) struct Run<'a> {
    fixed: Fixed<'a>,
    rounds: &'a [Rounds],
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
    /// Variables of type ring.
    lists: Vec<List>,
    /// Room for more.
    spare_lists: Vec<List>,
    raw_lists: Vec<RawList>,
    returned_list: List,
    /// Faces that loops walk: corners, and where each face ends.
    walked_faces: Vec<(Vec<Vertex>, Vec<u32>)>,
    /// Copies of rings that loops walk while they edit them, and buffers for more.
    walks: Vec<List>,
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
        lists: Vec::new(),
        spare_lists: Vec::new(),
        raw_lists: Vec::new(),
        returned_list: Vec::new(),
        walked_faces: Vec::new(),
        walks: Vec::new(),
        random: Random::new(fixed.settings.seed, generation),
        lines: Vec::new(),
        printed: 0,
        calls: Vec::new(),
        output,
        fixed,
        rounds: &code.rounds,
    };
    run.fill_memos();
    if !run.own() || !run.give_parameters() {
        return End::Repeat;
    }
    let run_pointer = std::ptr::from_mut(&mut run);
    // SAFETY: the block of words is as long as the layout says, at least a header; nothing else refers to it.
    unsafe {
        (*context).run = run_pointer.cast();
        (*context).this = context;
        (*context).stop = (*run_pointer).fixed.settings.stop.flag().as_ptr();
        (*context).over = (&raw const (*context).nothing).cast();
        (*context).asks_ahead = u64::from((*run_pointer).mesh.vertex_count() >= FAR);
        (*context).offsets = std::array::from_fn(|i| 4 * i as u32);
        (*context).from = std::array::from_fn(|at| std::array::from_fn(|i| if i < at { 0 } else { u32::MAX }));
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
    fn set_word(&mut self, word: usize, value: u64) {
        debug_assert!(word < self.fixed.layout.words());
        // SAFETY: the block has that many words.
        unsafe { *self.context.cast::<u8>().add(byte_offset(word) as usize).cast::<u64>() = value };
    }
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

/// As [`guard`], for work that changes nothing: many threads may do it at once.
fn reading<T>(context: *mut Context, otherwise: T, work: impl FnOnce(&Run<'_>) -> Option<T>) -> T {
    // While threads do parts of a loop the arrays are as they were taken from compiled code when it began.
    if is_part(context) { looking(context, otherwise, work) } else { guard(context, otherwise, |run| work(run)) }
}

/// As [`reading`], for work that looks at no array that compiled code may have made longer.
fn looking<T>(context: *mut Context, otherwise: T, work: impl FnOnce(&Run<'_>) -> Option<T>) -> T {
    // SAFETY: the run is alive, and nobody borrows it but to read while compiled code runs.
    let run = unsafe { &*(*context).run.cast::<Run<'_>>() };
    quiet(otherwise, || work(run))
}

/// Work that needs no run. `None` and a panic are `otherwise`.
fn quiet<T>(otherwise: T, work: impl FnOnce() -> Option<T>) -> T {
    catch_unwind(AssertUnwindSafe(work)).ok().flatten().unwrap_or(otherwise)
}

/// As [`guard`], for work that leaves the arrays alone.
fn light<T>(context: *mut Context, otherwise: T, work: impl FnOnce(&mut Run<'_>) -> Option<T>) -> T {
    if is_part(context) {
        return otherwise;
    }
    // SAFETY: compiled code passes the context it was given, whose run is alive and not borrowed while it runs.
    let run = unsafe { &mut *(*context).run.cast::<Run<'_>>() };
    quiet(otherwise, || work(run))
}

/// The words through which operands and results go.
fn value_words<'a>(run: &mut Run<'_>) -> &'a mut [u64; 12] {
    words_in(run.context)
}

/// As [`value_words`], of the context that a runtime function was given.
fn words_in<'a>(context: *mut Context) -> &'a mut [u64; 12] {
    // SAFETY: the context outlives the work of a runtime function, and nothing else refers to its words meanwhile.
    unsafe { &mut (*context).value }
}

/// Notes the site of a call that is being left because the run was stopped in it.
pub(super) extern "C" fn unwind(context: *mut Context, site: u32) {
    light(context, (), |run| {
        run.calls.push(site as usize);
        Some(())
    });
}
