//! What compiled code and the runtime share: one block of memory, a header and words whose number the program decides.

use std::mem::offset_of;

use crate::builtins::Builtin;
use crate::ir::Program;
use crate::mesh::{self, Head};

/// The header. Compiled code reads and writes it at fixed offsets; pointers and capacities are made anew by the runtime
/// whenever an array may have moved.
#[repr(C)]
pub(super) struct Context {
    /// The [`super::run::Run`] behind it.
    pub(super) run: *mut u8,
    /// Not zero once a stop was requested.
    pub(super) stop: *const u8,
    /// Not zero once another thread gave up the rounds of the loop that both are in.
    pub(super) over: *const u8,
    /// Below this address a function may not begin.
    pub(super) stack_limit: usize,
    /// Calls open, and how many may be.
    pub(super) depth: u64,
    pub(super) max_depth: u64,
    pub(super) heads: *mut Head,
    pub(super) slots: *mut u32,
    pub(super) positions: *mut f64,
    /// Vertices there are, and that all per-vertex arrays have room for.
    pub(super) vertex_count: u64,
    pub(super) vertex_capacity: u64,
    /// Slots in use, and that compiled code may use of the arena beside [`PADDING`]: none if values lie beside them.
    pub(super) slot_len: u64,
    pub(super) slot_capacity: u64,
    /// Whether values lie beside the slots: then only the runtime edits rings.
    pub(super) has_edge_values: u64,
    /// One less than a vertex is below this where compiled code may edit rings that end in it: all are but null, or none.
    pub(super) edit_limit: u64,
    /// Whether rings may have gaps or values beside them: if not, compiled code may edit any. Once there are some it stays so.
    pub(super) gaps_or_edge_values: u64,
    /// Whether the mesh is so large that compiled code asks for what it will touch, 0 or 1.
    pub(super) asks_ahead: u64,
    /// By how many slots a ring may be edited that has at most so many: as many, and 0 where that has to be asked first.
    pub(super) edit_within: [u32; 18],
    pub(super) old_heads: *const Head,
    pub(super) old_slots: *const u32,
    pub(super) old_positions: *const f64,
    /// All vertices of smaller index have an old value; others are asked for.
    pub(super) old_prefix: u64,
    pub(super) sets: *mut RawSet,
    pub(super) set_count: u64,
    pub(super) lists: *mut RawList,
    pub(super) list_count: u64,
    /// Copies of rings that loops walk while they edit them.
    pub(super) walk_count: u64,
    /// Where compiled code was stopped, an index of its sites.
    pub(super) site: u64,
    /// Operands and results of runtime functions, results of compiled ones.
    pub(super) value: [u64; 12],
    /// Operands behind the first, and the result, of runtime functions that are called rarely.
    pub(super) operands: [u64; 4],
    pub(super) result: u64,
    /// The context itself.
    pub(super) this: *mut Context,
    /// A ring of nulls around what is in no ring. Nobody writes it.
    pub(super) nothing: [u32; 4],
    /// How many bytes stand before each of the first slots of a ring.
    pub(super) offsets: [u32; 16],
    /// For each place in a ring, lanes that are all ones from there on. Nobody writes it.
    pub(super) from: [[u32; 16]; 17],
}

/// A set whose members compiled code may push.
#[repr(C)]
#[derive(Clone, Copy)]
pub(super) struct RawSet {
    pub(super) order: *mut u32,
    pub(super) len: u64,
    /// 0 where only the runtime may add: the first member, too.
    pub(super) capacity: u64,
    /// The first member and the largest one: where `len` is the distance between them and one, all between are members,
    /// whatever `capacity` is. 1 and 0 for an empty set.
    pub(super) first: u64,
    pub(super) last: u64,
}

/// A variable of type ring, which compiled code may push to.
#[repr(C)]
#[derive(Clone, Copy)]
pub(super) struct RawList {
    pub(super) start: *mut u32,
    pub(super) len: u64,
    /// What there is room for beside [`PADDING`].
    pub(super) capacity: u64,
}

pub(super) use crate::mesh::PADDING;

/// Corners of faces are asked for when so many are still to be walked before, and so many more follow the last.
pub(super) const CORNERS_AHEAD: usize = 64;

/// Room for a ring of `len` slots that may grow: as many as are edited at once, see `edit_widths` of the translator.
pub(super) fn room_for(len: u32) -> u32 {
    match len {
        0 => 0,
        1..=6 => 6,
        _ => len.div_ceil(4).saturating_mul(4),
    }
}

/// Operands and results of a pure function at one of its calls.
pub(super) struct Memo {
    pub(super) builtin: Builtin,
    /// The first of its [`MEMO_ENTRIES`] times [`MEMO_WORDS`].
    pub(super) word: usize,
}

/// Where the words behind the header lie.
pub(super) struct Layout {
    vertex_columns: usize,
    old_vertex_columns: usize,
    globals: usize,
    given: usize,
    memos: usize,
    words: usize,
}

const HEADER: usize = size_of::<Context>() / 8;
const GLOBAL_WORDS: usize = 3;
/// Two operands and the result.
pub(super) const MEMO_WORDS: usize = 3;

/// How many calls a memo remembers, a power of two: operands choose which.
pub(super) const MEMO_ENTRIES: usize = 64;

impl Layout {
    pub(super) fn new(program: &Program) -> Self {
        let vertex_columns = HEADER;
        let old_vertex_columns = vertex_columns + program.vertex_properties.len();
        let globals = old_vertex_columns + program.vertex_properties.len();
        let given = globals + GLOBAL_WORDS * program.globals.len();
        let memos = given + program.globals.len();
        Self { vertex_columns, old_vertex_columns, globals, given, memos, words: memos }
    }

    /// Makes room for one more memo.
    pub(super) fn add_memo(&mut self) -> usize {
        let words = MEMO_WORDS * MEMO_ENTRIES;
        self.words += words;
        (self.words - words - self.memos) / words
    }

    /// Words of the whole block.
    pub(super) fn words(&self) -> usize {
        self.words
    }

    pub(super) fn vertex_column(&self, property: usize, old: bool) -> usize {
        if old { self.old_vertex_columns + property } else { self.vertex_columns + property }
    }

    pub(super) fn global(&self, index: usize) -> usize {
        self.globals + GLOBAL_WORDS * index
    }

    pub(super) fn given(&self, index: usize) -> usize {
        self.given + index
    }

    pub(super) fn memo(&self, index: usize) -> usize {
        self.memos + MEMO_WORDS * MEMO_ENTRIES * index
    }
}

/// Bytes of a row of [`Context::from`].
pub(super) const FROM_ROW: i32 = 64;

/// Byte offset of a word.
pub(super) fn byte_offset(word: usize) -> i32 {
    (8 * word) as i32
}

/// Bytes of a value in a column.
pub(super) fn value_size(ty: mesh::Type) -> i64 {
    match ty {
        mesh::Type::Bool => 1,
        mesh::Type::Vertex => 4,
        mesh::Type::Int | mesh::Type::Double => 8,
        mesh::Type::Vec => 24,
    }
}

/// Byte offsets of the header's fields.
macro_rules! offsets {
    ($($name:ident $field:ident)*) => {
        $(pub(super) const $name: i32 = offset_of!(Context, $field) as i32;)*
    };
}

offsets! {
    STOP stop
    OVER over
    STACK_LIMIT stack_limit
    DEPTH depth
    MAX_DEPTH max_depth
    HEADS heads
    SLOTS slots
    POSITIONS positions
    VERTEX_COUNT vertex_count
    VERTEX_CAPACITY vertex_capacity
    SLOT_LEN slot_len
    SLOT_CAPACITY slot_capacity
    HAS_EDGE_VALUES has_edge_values
    EDIT_LIMIT edit_limit
    GAPS_OR_EDGE_VALUES gaps_or_edge_values
    EDIT_WITHIN edit_within
    FROM from
    ASKS_AHEAD asks_ahead
    OLD_HEADS old_heads
    OLD_SLOTS old_slots
    OLD_POSITIONS old_positions
    OLD_PREFIX old_prefix
    SETS sets
    SET_COUNT set_count
    LISTS lists
    LIST_COUNT list_count
    WALK_COUNT walk_count
    SITE site
    VALUE value
    OPERANDS operands
    RESULT result
    THIS this
    NOTHING nothing
    OFFSETS offsets
}

pub(super) const HEAD_SIZE: i64 = size_of::<Head>() as i64;
pub(super) const HEAD_OFFSET: i32 = offset_of!(Head, offset) as i32;
pub(super) const HEAD_LEN: i32 = offset_of!(Head, len) as i32;
pub(super) const HEAD_CAPACITY: i32 = offset_of!(Head, capacity) as i32;

pub(super) const LIST_SIZE: i64 = size_of::<RawList>() as i64;
pub(super) const LIST_START: i32 = offset_of!(RawList, start) as i32;
pub(super) const LIST_LEN: i32 = offset_of!(RawList, len) as i32;
pub(super) const LIST_CAPACITY: i32 = offset_of!(RawList, capacity) as i32;

pub(super) const SET_SIZE: i64 = size_of::<RawSet>() as i64;
pub(super) const SET_ORDER: i32 = offset_of!(RawSet, order) as i32;
pub(super) const SET_LEN: i32 = offset_of!(RawSet, len) as i32;
pub(super) const SET_CAPACITY: i32 = offset_of!(RawSet, capacity) as i32;
pub(super) const SET_FIRST: i32 = offset_of!(RawSet, first) as i32;
pub(super) const SET_LAST: i32 = offset_of!(RawSet, last) as i32;

/// What a compiled function returns.
pub(super) mod status {
    /// It came to its end.
    pub(crate) const DONE: u32 = 0;
    /// It cannot go on; the interpreter says why, or does it.
    pub(crate) const REPEAT: u32 = 1;
    /// A stop was requested, at [`super::Context::site`].
    pub(crate) const STOPPED: u32 = 2;
    /// The output was closed, at [`super::Context::site`].
    pub(crate) const CLOSED: u32 = 3;
}
