//! Asking for what later rounds of a loop will touch, see [`crate::engine::native::ahead`].
//!
//! At the head of a round, in meshes that caches do not hold: the ring of the vertex of a round far ahead is read, and
//! heads and positions of its neighbours are asked for; of a round half as far ahead, whose neighbours' heads have come,
//! the neighbours' rings. At the head of a round over a ring, in all meshes: the position of what stands some slots behind.
//! What asks is a prefetch, which waits for nothing and never fails. A load would do harm: what
//! follows it cannot retire before it has come.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, InstBuilder, MemFlagsData, TrapCode, Value, types};

use super::Translator;
use crate::engine::native::ahead::{Ahead, Touched};
use crate::engine::native::context::{self, CORNERS_AHEAD};

/// Marks loads of one byte of which nothing is wanted: they become prefetches, which Cranelift does not have.
pub(in super::super) const PREFETCH: TrapCode = TrapCode::unwrap_user(1);

/// Whether they can, see [`crate::engine::native::prefetch`].
const CAN_PREFETCH: bool = cfg!(target_arch = "x86_64");

/// Neighbours are asked for so many rounds before they are met, their rings half as many.
const ROUNDS: i64 = 48;

/// Positions of what is in rings are asked for so many slots before they are met: fewer than may be read behind the last ring.
const SLOTS_AHEAD: i32 = context::PADDING as i32 - 4;

/// How many neighbours are asked for, of vertices that have so many. Where two are met, as round the vertex that splits an
/// edge, rounds are so short that the machine is with the next ones by itself.
const FEWEST: i64 = 3;
const MOST: i64 = 16;

/// Bytes by which is asked for what will be written.
const WRITTEN_AHEAD: i32 = 1024;

/// Where the context has the arrays as they are, and as they were.
const HEADS: [i32; 2] = [context::HEADS, context::OLD_HEADS];
const SLOTS: [i32; 2] = [context::SLOTS, context::OLD_SLOTS];
const POSITIONS: [i32; 2] = [context::POSITIONS, context::OLD_POSITIONS];

/// Where rings are, as they are or were.
struct Rings {
    heads: Value,
    slots: Value,
    /// The first vertex, and the last if there are vertices that have none.
    first: Value,
    last: Option<Value>,
    old: bool,
}

impl Translator<'_, '_> {
    /// At the head of a round over a set: asks for what stands round vertices some rounds ahead. `at` is the address of
    /// this round's vertex, `end` that behind the last.
    pub(super) fn ask_ahead(&mut self, ahead: &Ahead, at: Value, end: Value, flags: MemFlagsData) {
        let around = ahead.around;
        if !CAN_PREFETCH || !around.iter().any(|t| t.any()) {
            return;
        }
        let olds = around[1].any() || around.iter().any(|t| t.rings[1] || t.positions[1]);
        let go = self.begin_asking(olds);
        let last = self.b.ins().iadd_imm_s(end, -4);
        for (old, touched) in [(false, around[0]), (true, around[1])] {
            if touched.any() {
                let own = self.rings_of(old);
                let columns = self.columns(touched);
                let few = self.b.create_block();
                self.b.set_cold_block(few);
                let v = self.vertex_ahead(at, last, ROUNDS, flags);
                self.each_neighbour(v, &own, few, |t, q| t.ask_for(q, &columns));
                let rings = self.rings(touched);
                if !rings.is_empty() {
                    let v = self.vertex_ahead(at, last, ROUNDS / 2, flags);
                    self.each_neighbour(v, &own, few, |t, q| t.ask_for_rings(q, &rings));
                }
                self.b.ins().jump(few, &[]);
                self.continue_in(few);
            }
        }
        self.b.ins().jump(go, &[]);
        self.continue_in(go);
    }

    /// At the head of a round over a face that a loop over faces walks: as [`Translator::ask_ahead`] of the corners that
    /// follow, behind which there are some more.
    pub(super) fn ask_for_corners(&mut self, touched: Touched, at: Value, flags: MemFlagsData) {
        if !CAN_PREFETCH || !touched.any() {
            return;
        }
        let go = self.begin_asking(touched.rings[1] || touched.positions[1]);
        let q = self.b.ins().uload32(flags, at, 4 * CORNERS_AHEAD as i32);
        let columns = self.columns(touched);
        self.ask_for(q, &columns);
        let rings = self.rings(touched);
        if !rings.is_empty() {
            let q = self.b.ins().uload32(flags, at, 2 * CORNERS_AHEAD as i32);
            self.ask_for_rings(q, &rings);
        }
        self.b.ins().jump(go, &[]);
        self.continue_in(go);
    }

    /// At the head of a round over the ring of a vertex that a loop over a set walks: asks for positions, as they are and as
    /// they were, of what is met some rounds later, in the ring behind it, too, which mostly is the next vertex' own.
    pub(super) fn ask_for_positions(&mut self, positions: [bool; 2], at: Value, flags: MemFlagsData) {
        let touched = Touched { positions, ..Touched::default() };
        if !CAN_PREFETCH || !touched.any() {
            return;
        }
        let q = self.b.ins().uload32(flags, at, 4 * SLOTS_AHEAD);
        let columns = self.columns(touched);
        self.ask_for(q, &columns);
    }

    /// Begins code that is skipped in meshes that caches hold, and where old values are meant and there are none.
    fn begin_asking(&mut self, olds: bool) -> Block {
        let [ask, go] = [(); 2].map(|()| self.b.create_block());
        let mut far = self.load_context(types::I64, context::ASKS_AHEAD);
        if olds {
            let prefix = self.load_context(types::I64, context::OLD_PREFIX);
            far = self.b.ins().umin(far, prefix);
        }
        self.b.ins().brif(far, ask, &[], go, &[]);
        self.b.set_cold_block(ask);
        self.continue_in(ask);
        go
    }

    /// The vertex of a later round, the last if there are not so many, 64 bits.
    fn vertex_ahead(&mut self, at: Value, last: Value, rounds: i64, flags: MemFlagsData) -> Value {
        let ahead = self.b.ins().iadd_imm_s(at, 4 * rounds);
        let ahead = self.b.ins().umin(ahead, last);
        self.b.ins().uload32(flags, ahead, 0)
    }

    /// For each vertex in a ring, gaps included, 64 bits; goes to `few` if there are few.
    fn each_neighbour(&mut self, v: Value, rings: &Rings, few: Block, work: impl FnOnce(&mut Self, Value)) {
        let (start, len) = self.ring_within(v, rings);
        let is_few = self.b.ins().icmp_imm_s(IntCC::UnsignedLessThan, len, FEWEST);
        self.leave_if(is_few, few);
        let most = self.b.ins().iconst(types::I64, MOST);
        let len = self.b.ins().umin(len, most);
        let bytes = self.b.ins().ishl_imm_u(len, 2);
        let end = self.b.ins().iadd(start, bytes);
        let (round, at) = self.block_with(&[types::I64]);
        let done = self.b.create_block();
        self.b.set_cold_block(round);
        self.b.set_cold_block(done);
        self.b.ins().jump(round, &[start.into()]);
        self.b.switch_to_block(round);
        let flags = if rings.old { self.regions.old } else { self.regions.slots };
        let q = self.b.ins().uload32(flags, at[0], 0);
        work(self, q);
        let after = self.b.ins().iadd_imm_s(at[0], 4);
        let more = self.b.ins().icmp(IntCC::UnsignedLessThan, after, end);
        self.b.ins().brif(more, round, &[after.into()], done, &[]);
        self.b.seal_block(round);
        self.continue_in(done);
    }

    /// What [`Translator::ask_for`] needs of the arrays.
    fn columns(&mut self, touched: Touched) -> Vec<(Value, i64)> {
        let head = context::HEAD_SIZE;
        let position = context::value_size(crate::mesh::Type::Vec);
        let mut columns = Vec::new();
        for old in [0, 1] {
            for (touched, base, size) in
                [(touched.rings[old], HEADS[old], head), (touched.positions[old], POSITIONS[old], position)]
            {
                if touched {
                    columns.push((self.load_context(types::I64, base), size));
                }
            }
        }
        columns
    }

    /// Asks for heads and positions of a vertex, or what lies before the first if it is null.
    fn ask_for(&mut self, q: Value, columns: &[(Value, i64)]) {
        for &(base, size) in columns {
            let offset = self.b.ins().imul_imm_s(q, size);
            let behind = self.b.ins().iadd(base, offset);
            self.prefetch(behind, -size as i32);
        }
    }

    /// What [`Translator::ask_for_rings`] needs of the arrays.
    fn rings(&mut self, touched: Touched) -> Vec<Rings> {
        [false, true].into_iter().filter(|&old| touched.rings[usize::from(old)]).map(|old| self.rings_of(old)).collect()
    }

    fn rings_of(&mut self, old: bool) -> Rings {
        let of = usize::from(old);
        let [heads, slots] = [HEADS[of], SLOTS[of]].map(|base| self.load_context(types::I64, base));
        let last = old.then(|| self.load_context(types::I64, context::OLD_PREFIX));
        let first = self.b.ins().iconst(types::I64, 1);
        Rings { heads, slots, first, last, old }
    }

    /// Asks for the rings of a vertex, whose heads are read.
    fn ask_for_rings(&mut self, q: Value, rings: &[Rings]) {
        for rings in rings {
            let (start, _) = self.ring_within(q, rings);
            self.prefetch(start, 0);
        }
    }

    /// Address and length of the ring of a vertex, or of one that has one if it is null or has none.
    fn ring_within(&mut self, v: Value, &Rings { heads, slots, first, last, old }: &Rings) -> (Value, Value) {
        let mut v = self.b.ins().umax(v, first);
        if let Some(last) = last {
            v = self.b.ins().umin(v, last);
        }
        let flags = if old { self.regions.old } else { self.regions.heads };
        let bytes = self.b.ins().imul_imm_s(v, context::HEAD_SIZE);
        let behind = self.b.ins().iadd(heads, bytes);
        let [offset, len] = [context::HEAD_OFFSET, context::HEAD_LEN]
            .map(|field| self.b.ins().uload32(flags, behind, field - context::HEAD_SIZE as i32));
        let bytes = self.b.ins().ishl_imm_u(offset, 2);
        (self.b.ins().iadd(slots, bytes), len)
    }

    /// Asks for what follows a place that an array is written at, one element after the other: memory that comes from no
    /// cache, for nobody has read it.
    pub(super) fn ask_to_write(&mut self, address: Value) {
        if CAN_PREFETCH {
            self.prefetch(address, WRITTEN_AHEAD);
        }
    }

    fn prefetch(&mut self, address: Value, offset: i32) {
        let flags = MemFlagsData::new().with_trap_code(Some(PREFETCH));
        self.b.ins().uload8(types::I32, flags, address, offset);
    }
}
