//! Edits of rings.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, InstBuilder, Value, types};

use super::known::{Bounds, Fact, Key};
use super::ring::Source;
use super::{Symbol, Translated, Translator};
use crate::engine::native::Mutation;
use crate::engine::native::context;
use crate::ir::{Item, Ring, Side};

/// Where code that edits in line goes: to the runtime, with nothing done, or on, with all done.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ways {
    pub(super) slow: Block,
    pub(super) done: Block,
}

/// Which slots are looked through for what may be in a ring already.
#[derive(Debug, Clone, Copy)]
enum Held {
    /// So many: those behind are another ring's.
    Up(Value),
    /// All, whatever the ring's length: behind its end lies what once was in it, which is hardly ever met, and then the
    /// runtime asks again.
    All,
}

/// What lies behind the end of a ring in the slots that are edited.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Behind {
    /// Room of its own.
    Room,
    Others,
}

impl<'p> Translator<'_, 'p> {
    /// What is put into a ring: `None` where the word `null` is written.
    pub(super) fn put(&mut self, item: &'p Item) -> Translated<Option<Value>> {
        Ok(match item {
            Item::Gap(_) => None,
            Item::Vertex(e) => Some(self.vertex(e)?),
        })
    }

    /// What is put into a ring, of which only that of a vertex takes a gap.
    fn put_in(&mut self, item: &'p Item, ring: &Ring) -> Translated<Option<Value>> {
        let x = self.put(item)?;
        if let (Some(x), Ring::Variable { .. }) = (x, ring) {
            self.not_null(x);
        }
        Ok(x)
    }

    pub(super) fn replace(&mut self, item: &'p Item, with: &'p Item, ring: &'p Ring) -> Translated<()> {
        let a = self.sought(item)?;
        let x = self.put_in(with, ring)?;
        let v = match self.source(ring)? {
            Source::Of { v, .. } => v,
            Source::Variable(local) => {
                let operands = [self.list_of(local)?, self.or_null(a), self.or_null(x)];
                return self.edit_list(Symbol::ListReplace, &operands);
            }
        };
        let operands = [self.or_null(a), self.or_null(x), v];
        self.edit(Symbol::Replace, v, &operands, |t, ways| {
            if let (Some(a), Some(x)) = (a, x) {
                t.replace_in_place(a, x, v, ways);
            } else {
                t.b.ins().jump(ways.slow, &[]);
            }
        })?;
        self.note_put(x, v);
        Ok(())
    }

    /// Puts a vertex in the place of another.
    fn replace_in_place(&mut self, a: Value, x: Value, v: Value, Ways { slow, done }: Ways) {
        let Bounds { start, len, flags } = self.bounds(v, false);
        if let Some(Fact::Found(was)) = self.known.get(Key::Find { x: a, v, old: true })
            && was.certain
            && self.known.is_absent(x, v)
            && self.known.differ(x, v)
        {
            self.replace_where_it_stood(was.at, a, x, Bounds { start, len, flags }, done);
        }
        self.by_width(self.widths(), len, 0, slow, |t, width| {
            let lanes = t.lanes(start, width, flags);
            let at = t.place_to_edit(&lanes, a, v, len, done);
            t.leave_unless_it_may_enter(&lanes, x, v, Held::Up(len), slow);
            if !t.mutated(Mutation::ReplacesNothing) {
                // Stores as wide as the loads that will follow, for narrow ones would hold those up.
                let place = t.lanes_of_offset(at);
                let new = t.b.ins().splat(types::I32X4, x);
                for (k, lane) in (0..).zip(lanes) {
                    let offsets = t.lane_offsets(4 * k);
                    let here = t.b.ins().icmp(IntCC::Equal, place, offsets);
                    let result = t.b.ins().bitselect(here, new, lane);
                    t.store_lanes(result, k, start, width, flags);
                }
            }
            t.b.ins().jump(done, &[]);
        });
    }

    /// Puts a vertex that may enter in the place of another, if that stands where it stood when rings were made old.
    fn replace_where_it_stood(&mut self, at: Value, a: Value, x: Value, ring: Bounds, done: Block) {
        let [look, store, search] = [(); 3].map(|()| self.b.create_block());
        let bytes = self.bytes_of(ring.len);
        let within = self.b.ins().icmp(IntCC::UnsignedLessThan, at, bytes);
        self.b.ins().brif(within, look, &[], search, &[]);
        self.continue_in(look);
        let address = self.b.ins().iadd(ring.start, at);
        let there = self.b.ins().load(types::I32, ring.flags, address, 0);
        let stood = if self.mutated(Mutation::StandsWhereItStood) { there } else { a };
        let same = self.b.ins().icmp(IntCC::Equal, there, stood);
        self.b.ins().brif(same, store, &[], search, &[]);
        self.continue_in(store);
        if !self.mutated(Mutation::ReplacesNothing) {
            self.b.ins().store(ring.flags, x, address, 0);
        }
        self.b.ins().jump(done, &[]);
        self.continue_in(search);
    }

    /// Where `a` stands in the ring of `v`, all of whose slots are in the lanes, bytes from its start; on to `done` if it does
    /// not.
    fn place_to_edit(&mut self, lanes: &[Value], a: Value, v: Value, len: Value, done: Block) -> Value {
        if let Some(at) = self.known.place(a, v) {
            return at;
        }
        let first = self.first_match(lanes, a);
        let absent = self.is_beyond(first, len);
        self.leave_if(absent, done);
        self.bytes_before(first)
    }

    /// Goes to `slow` where `x` is null, stands in the ring of `v` already, or is `v` itself.
    fn leave_unless_it_may_enter(&mut self, lanes: &[Value], x: Value, v: Value, held: Held, slow: Block) {
        if !self.known.is_absent(x, v) {
            let twice = match held {
                Held::Up(len) => {
                    let first = self.first_match(lanes, x);
                    let beyond = self.is_beyond(first, len);
                    self.b.ins().icmp_imm_s(IntCC::Equal, beyond, 0)
                }
                Held::All => self.matches(lanes, x).0,
            };
            self.leave_if(twice, slow);
        }
        if !self.known.differ(x, v) {
            let itself = self.b.ins().icmp(IntCC::Equal, x, v);
            self.leave_if(itself, slow);
        }
        if !self.known.holds(Key::NotNull(x)) {
            let null = self.b.ins().icmp_imm_s(IntCC::Equal, x, 0);
            self.leave_if(null, slow);
        }
    }

    pub(super) fn splice(&mut self, item: &'p Item, side: Side, anchor: &'p Item, ring: &'p Ring) -> Translated<()> {
        let x = self.put_in(item, ring)?;
        let a = self.sought(anchor)?;
        let before = self.int32(u32::from(side == Side::Before));
        let v = match self.source(ring)? {
            Source::Of { v, .. } => v,
            Source::Variable(local) => {
                let operands = [self.list_of(local)?, self.or_null(x), self.or_null(a), before];
                return self.edit_list(Symbol::ListSplice, &operands);
            }
        };
        let operands = [self.or_null(x), self.or_null(a), v, before];
        self.edit(Symbol::Splice, v, &operands, |t, ways| {
            if let (Some(x), Some(a)) = (x, a) {
                t.splice_in_place(x, side, a, v, ways);
            } else {
                t.b.ins().jump(ways.slow, &[]);
            }
        })?;
        self.note_put(x, v);
        Ok(())
    }

    /// Splices a vertex into a ring without gaps that has room.
    fn splice_in_place(&mut self, x: Value, side: Side, a: Value, v: Value, ways: Ways) {
        let Ways { slow, done } = ways;
        let ring = self.bounds(v, false);
        let Bounds { start, len, flags } = ring;
        self.by_room(v, ring, 1, slow, |t, width| {
            let lanes = t.lanes(start, width, flags);
            let at = t.place_to_edit(&lanes, a, v, len, done);
            t.leave_unless_it_may_enter(&lanes, x, v, Held::All, slow);
            let after = (side == Side::After) != t.mutated(Mutation::SplicesOnTheOtherSide);
            // The slot behind which x shall stand: that before the first is the last.
            let (here, at) = if after {
                (t.lanes_with(&lanes, a), at)
            } else {
                let bytes = t.bytes_of(len);
                let behind = t.b.ins().select(at, at, bytes);
                let at = t.b.ins().iadd_imm_s(behind, -4);
                (t.lanes_at(lanes.len(), at), at)
            };
            // With x in its place, all lanes behind it take what stands before them. So does what lies behind the ring.
            let new = t.b.ins().splat(types::I32X4, x);
            let put: Vec<Value> =
                lanes.iter().zip(here).map(|(&lane, here)| t.b.ins().bitselect(here, new, lane)).collect();
            for (k, lane) in (0..).zip(lanes) {
                let shifted = t.four(&put, 4 * i64::from(k) - 1);
                let behind = t.lanes_behind(at, 4 * k);
                let result = t.b.ins().bitselect(behind, shifted, lane);
                t.store_lanes(result, k, start, width, flags);
            }
            let len = t.b.ins().iadd_imm_s(len, 1);
            let head = t.head(v, false);
            t.b.ins().store(t.regions.heads, len, head, context::HEAD_LEN);
            t.b.ins().jump(done, &[]);
        });
    }

    /// Goes on, in a block of its own, by the room that a ring has, with how many slots are edited at once: it has room for so
    /// many, is shorter by `less` at least, and ends in no gap; else to `slow`. Rings keep their room while their lengths
    /// change, so that which way this goes is foreseen by the machine.
    fn by_room(&mut self, v: Value, ring: Bounds, less: i64, slow: Block, mut work: impl FnMut(&mut Self, i64)) {
        let (head, heads) = (self.head(v, false), self.regions.heads);
        let capacity = self.b.ins().load(types::I32, heads, head, context::HEAD_CAPACITY);
        let rooms = self.edit_widths();
        for (i, widths) in rooms.iter().enumerate() {
            let larger = rooms.get(i + 1).map(|next| {
                let [here, larger] = [(); 2].map(|()| self.b.create_block());
                let fewer = self.b.ins().icmp_imm_s(IntCC::UnsignedLessThan, capacity, next[0]);
                self.b.ins().brif(fewer, here, &[], larger, &[]);
                self.continue_in(here);
                larger
            });
            for (j, &width) in widths.iter().enumerate() {
                let longer = if j + 1 < widths.len() { self.b.create_block() } else { slow };
                if (i == 0 || j > 0) && !self.mutated(Mutation::IgnoresRoom) {
                    let tight = self.b.ins().icmp_imm_s(IntCC::UnsignedLessThan, capacity, width);
                    self.leave_if(tight, slow);
                }
                self.leave_unless_within(ring, width, less, longer, slow);
                work(self, width);
                if longer != slow {
                    self.continue_in(longer);
                }
            }
            if let Some(larger) = larger {
                self.continue_in(larger);
            }
        }
    }

    /// Goes to `longer` where a ring is longer than `width` but for `less`, and to `slow` where it ends in a gap.
    fn leave_unless_within(&mut self, ring: Bounds, width: i64, less: i64, longer: Block, slow: Block) {
        if self.mutated(Mutation::IgnoresRoom) {
            return self.leave_if_gap_or_edge_values(ring, slow);
        }
        // No ring is within 0, which stands there once rings may have gaps.
        let within = self.load_context(types::I32, context::EDIT_WITHIN + 4 * width as i32);
        let beyond = if less == 0 { IntCC::UnsignedGreaterThan } else { IntCC::UnsignedGreaterThanOrEqual };
        let beyond = self.b.ins().icmp(beyond, ring.len, within);
        let [ask, next] = [(); 2].map(|()| self.b.create_block());
        self.b.set_cold_block(ask);
        self.b.ins().brif(beyond, ask, &[], next, &[]);
        self.continue_in(ask);
        let long = self.b.ins().icmp_imm_s(IntCC::UnsignedGreaterThan, ring.len, width - less);
        self.leave_if(long, longer);
        let empty = self.b.ins().icmp_imm_s(IntCC::Equal, ring.len, 0);
        self.leave_if(empty, slow); // it has no last slot to look at
        self.leave_if_it_ends_in_a_gap(ring, slow);
        self.b.ins().jump(next, &[]);
        self.continue_in(next);
    }

    /// Gives a ring a fresh run of slots, which the caller writes all: the runtime takes slots in use for written. The
    /// result is where it lies; up to [`context::PADDING`] slots behind it may be written too.
    pub(super) fn take_slots(&mut self, head: Value, room: Value, slow: Block) -> Value {
        let used = self.load_context(types::I64, context::SLOT_LEN);
        let wide = self.wide(room);
        let end = self.b.ins().iadd(used, wide);
        let limit = self.load_context(types::I64, context::SLOT_CAPACITY);
        let full = self.b.ins().icmp(IntCC::UnsignedGreaterThan, end, limit);
        self.leave_if(full, slow);
        self.store_context(end, context::SLOT_LEN);
        let offset = self.b.ins().ireduce(types::I32, used);
        let heads = self.regions.heads;
        self.b.ins().store(heads, offset, head, context::HEAD_OFFSET);
        self.b.ins().store(heads, room, head, context::HEAD_CAPACITY);
        let start = self.slot_address(offset, false);
        self.ask_to_write(start);
        start
    }

    /// Goes to `slow` where a ring, which is not empty, ends in a gap, or values lie beside rings: if any ring of the mesh
    /// may, this one is asked.
    fn leave_if_gap_or_edge_values(&mut self, ring: Bounds, slow: Block) {
        let may = self.load_context(types::I64, context::GAPS_OR_EDGE_VALUES);
        let [ask, next] = [(); 2].map(|()| self.b.create_block());
        self.b.set_cold_block(ask);
        self.b.ins().brif(may, ask, &[], next, &[]);
        self.continue_in(ask);
        self.leave_if_it_ends_in_a_gap(ring, slow);
        self.b.ins().jump(next, &[]);
        self.continue_in(next);
    }

    /// Goes to `slow` where a ring, which is not empty, ends in a gap, or values lie beside rings.
    fn leave_if_it_ends_in_a_gap(&mut self, ring: Bounds, slow: Block) {
        let bytes = self.bytes_of(ring.len);
        let end = self.b.ins().iadd(ring.start, bytes);
        let last = self.b.ins().uload32(self.regions.slots, end, -4);
        let last = self.b.ins().iadd_imm_s(last, -1);
        let limit = self.load_context(types::I64, context::EDIT_LIMIT);
        let bad = self.b.ins().icmp(IntCC::UnsignedGreaterThanOrEqual, last, limit);
        if !self.mutated(Mutation::IgnoresGaps) {
            self.leave_if(bad, slow);
        }
    }

    pub(super) fn erase(&mut self, item: &'p Item, from: &'p Ring) -> Translated<()> {
        let x = self.sought(item)?;
        let v = match self.source(from)? {
            Source::Of { v, .. } => v,
            Source::Variable(local) => {
                let operands = [self.list_of(local)?, self.or_null(x)];
                return self.edit_list(Symbol::ListErase, &operands);
            }
        };
        let operands = [self.or_null(x), v];
        self.edit(Symbol::Erase, v, &operands, |t, ways| match x {
            Some(x) => t.erase_in_place(x, v, ways),
            None => {
                t.b.ins().jump(ways.slow, &[]);
            }
        })
    }

    /// Takes a vertex out of a ring without gaps.
    fn erase_in_place(&mut self, x: Value, v: Value, ways: Ways) {
        let ring = self.bounds(v, false);
        if self.unit.facts.grows {
            self.by_room(v, ring, 0, ways.slow, |t, width| t.erase_lanes(x, v, ring, width, Behind::Room, ways));
        } else {
            self.by_width(self.widths(), ring.len, 0, ways.slow, |t, width| {
                t.leave_if_gap_or_edge_values(ring, ways.slow);
                t.erase_lanes(x, v, ring, width, Behind::Others, ways);
            });
        }
    }

    /// Takes a vertex out of a ring that is edited by so many slots.
    fn erase_lanes(&mut self, x: Value, v: Value, ring: Bounds, width: i64, behind: Behind, ways: Ways) {
        let Bounds { start, len, flags } = ring;
        let lanes = self.lanes(start, width, flags);
        let at = self.place_to_edit(&lanes, x, v, len, ways.done);
        let end = (behind == Behind::Others).then(|| {
            let bytes = self.bytes_of(len);
            let last = self.b.ins().iadd_imm_s(bytes, -4);
            self.lanes_of_offset(last)
        });
        // Lanes from `at` on take what stands behind them.
        for (k, &lane) in (0..).zip(&lanes) {
            let shifted = self.four(&lanes, 4 * i64::from(k) + 1);
            let from = self.lanes_from(at, 4 * k);
            let mut result = self.b.ins().bitselect(from, shifted, lane);
            if let Some(end) = end {
                // Those behind the ring get back what they hold.
                let offsets = self.lane_offsets(4 * k);
                let within = self.b.ins().icmp(IntCC::SignedGreaterThan, end, offsets);
                result = self.b.ins().bitselect(within, result, lane);
            }
            self.store_lanes(result, k, start, width, flags);
        }
        let len = self.b.ins().iadd_imm_s(len, -1);
        if !self.mutated(Mutation::ErasesNothing) {
            let (head, heads) = (self.head(v, false), self.regions.heads);
            self.b.ins().store(heads, len, head, context::HEAD_LEN);
        }
        self.b.ins().jump(ways.done, &[]);
    }

    pub(super) fn note_put(&mut self, x: Option<Value>, v: Value) {
        if !self.mutated(Mutation::ForgetsWhatWasPut) {
            self.known.put(x, v);
        }
    }

    /// Edits the ring of `v` in line where `in_line` finds it can, else in the runtime.
    pub(super) fn edit(
        &mut self,
        symbol: Symbol,
        v: Value,
        operands: &[Value],
        in_line: impl FnOnce(&mut Self, Ways),
    ) -> Translated<()> {
        let ways = Ways { slow: self.b.create_block(), done: self.b.create_block() };
        self.b.set_cold_block(ways.slow);
        in_line(self, ways);
        self.continue_in(ways.slow);
        self.call_rarely_or_fail(symbol, operands)?;
        self.b.ins().jump(ways.done, &[]);
        self.continue_in(ways.done);
        if self.mutated(Mutation::EditsMoveNothing) {
            self.known.forget_addresses();
        } else {
            self.known.forget_ring(v);
        }
        Ok(())
    }
}
