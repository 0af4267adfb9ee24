//! Rings made whole.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, InstBuilder, StackSlotData, StackSlotKind, Value, types};

use super::edit::Ways;
use super::known::{Bounds, Key};
use super::lanes::unaligned;
use super::{Symbol, Translated, Translator, wrong_type};
use crate::engine::native::Mutation;
use crate::engine::native::context::{self, room_for};
use crate::ir::{Expr, Item, LocalId};

/// Rings made of more items than this are left to the runtime.
const MAKE_LIMIT: usize = 12;

impl<'p> Translator<'_, 'p> {
    pub(super) fn make(&mut self, items: &'p [Item], of: &'p Expr) -> Translated<()> {
        let mut list = Vec::with_capacity(items.len());
        for item in items {
            list.push(self.put(item)?);
        }
        if self.mutated(Mutation::MakesReversed) {
            list.reverse();
        }
        let v = self.vertex_not_null(of)?;
        let done = self.b.create_block();
        let slow = self.b.create_block();
        self.b.set_cold_block(slow);
        let vertices: Option<Vec<Value>> = list.iter().copied().collect();
        match vertices {
            Some(vertices) if vertices.len() <= MAKE_LIMIT => {
                self.make_in_place(&vertices, v, slow);
                self.b.ins().jump(done, &[]);
            }
            _ => {
                self.b.ins().jump(slow, &[]);
            }
        }
        self.continue_in(slow);
        let n = u32::try_from(list.len()).map_err(|_| wrong_type())?;
        let slot = self.b.create_sized_stack_slot(StackSlotData::new(StackSlotKind::ExplicitSlot, 4 * n.max(1), 2));
        for (i, &x) in list.iter().enumerate() {
            let x = self.or_null(x);
            self.b.ins().stack_store(types::I64, x, slot, 4 * i as i32);
        }
        let address = self.b.ins().stack_addr(types::I64, slot, 0);
        let n = self.int32(n);
        self.call_rarely_or_fail(Symbol::Make, &[v, address, n])?;
        self.b.ins().jump(done, &[]);
        self.continue_in(done);
        self.known.forget_ring(v);
        self.known.made(v);
        let vertices: Vec<Value> = list.iter().copied().flatten().collect();
        self.known.made_of(&vertices, v);
        for &x in &list {
            self.note_put(x, v);
        }
        Ok(())
    }

    /// `make r nb_of v`
    pub(super) fn make_ring(&mut self, ring: LocalId, of: &'p Expr) -> Translated<()> {
        let v = self.vertex_not_null(of)?;
        let from = self.list_bounds(ring)?;
        let operands = [v, from.start, from.len];
        self.edit(Symbol::Make, v, &operands, |t, Ways { slow, done }| {
            let edge_values = t.load_context(types::I64, context::HAS_EDGE_VALUES);
            t.leave_if(edge_values, slow);
            for width in [4, 8] {
                let [here, longer] = [(); 2].map(|()| t.b.create_block());
                let long = t.b.ins().icmp_imm_s(IntCC::UnsignedGreaterThan, from.len, width);
                t.b.ins().brif(long, longer, &[], here, &[]);
                t.continue_in(here);
                t.make_ring_in_place(from, v, width, slow);
                t.b.ins().jump(done, &[]);
                t.continue_in(longer);
            }
            t.b.ins().jump(slow, &[]);
        })?;
        self.known.made(v);
        self.known.put_any(v);
        Ok(())
    }

    /// Makes a ring of the vertices of a list of at most `width`.
    fn make_ring_in_place(&mut self, from: Bounds, v: Value, width: i64, slow: Block) {
        let lanes = self.lanes(from.start, width, from.flags);
        let end = self.b.ins().splat(types::I32X4, from.len);
        let mut used = Vec::new();
        let mut items = Vec::new();
        for (k, &lane) in lanes.iter().enumerate() {
            let numbers = self.lane_numbers(4 * k as u32);
            let within = self.b.ins().icmp(IntCC::SignedLessThan, numbers, end);
            // Lanes behind the end differ from every vertex and from each other.
            let others = self.b.ins().bnot(numbers);
            items.push(self.b.ins().bitselect(within, lane, others));
            used.push(within);
        }
        let itself = self.b.ins().splat(types::I32X4, v);
        let mut pairs = self.pairs_of_lanes(&items);
        pairs.extend(items.iter().map(|&x| (x, itself)));
        let bad = self.any_equal(&pairs);
        self.leave_if(bad, slow);
        let head = self.head(v, false);
        let heads = self.regions.heads;
        let capacity = self.b.ins().load(types::I32, heads, head, context::HEAD_CAPACITY);
        let offset = self.b.ins().load(types::I32, heads, head, context::HEAD_OFFSET);
        let kept = self.slot_address(offset, false);
        let fits = self.b.ins().icmp(IntCC::UnsignedGreaterThanOrEqual, capacity, from.len);
        let (store, start) = self.block_with(&[types::I64]);
        let fresh = self.b.create_block();
        self.b.ins().brif(fits, store, &[kept.into()], fresh, &[]);
        self.continue_in(fresh);
        let least = self.int32(self.unit.facts.fresh_capacity);
        let mut room = self.b.ins().umax(from.len, least);
        if self.unit.facts.grows {
            // As `room_for`.
            let more = self.b.ins().iadd_imm_s(room, 3);
            let rounded = self.b.ins().band_imm_s(more, !3);
            let short = self.b.ins().icmp_imm_s(IntCC::UnsignedLessThanOrEqual, room, 6);
            room = self.b.ins().select(short, room, rounded);
        }
        let taken = self.take_slots(head, room, slow);
        let slots = unaligned(self.regions.slots);
        let zero = self.int32(0);
        let gaps = self.b.ins().splat(types::I32X4, zero);
        // As many as the room is at most.
        for k in 0..self.unit.facts.fresh_capacity.max(8).div_ceil(4) as i32 {
            self.b.ins().store(slots, gaps, taken, 16 * k);
        }
        self.jump_with(store, &[taken]);
        self.continue_in(store);
        let there = self.lanes(start[0], width, self.regions.slots);
        for (k, ((lane, within), there)) in lanes.into_iter().zip(used).zip(there).enumerate() {
            let result = self.b.ins().bitselect(within, lane, there);
            if !self.mutated(Mutation::MakesNoRing) {
                self.b.ins().store(slots, result, start[0], 16 * k as i32);
            }
        }
        self.b.ins().store(heads, from.len, head, context::HEAD_LEN);
    }

    /// Makes a ring of vertices, or goes to `slow` with nothing done.
    fn make_in_place(&mut self, items: &[Value], v: Value, slow: Block) {
        let k = items.len();
        if !self.known.is_bare(v) {
            let edge_values = self.load_context(types::I64, context::HAS_EDGE_VALUES);
            self.leave_if(edge_values, slow);
        }
        let lanes = if k > 3 { self.packed(items, v) } else { Vec::new() };
        let bad = if k > 3 { Some(self.not_a_ring_of_lanes(&lanes, items, v)) } else { self.not_a_ring(items, v) };
        if let Some(bad) = bad {
            self.leave_if(bad, slow);
        }
        let head = self.head(v, false);
        let (heads, slots) = (self.regions.heads, self.regions.slots);
        let start = if self.known.is_bare(v) {
            self.take_slots_for(k, head, slow)
        } else {
            let capacity = self.b.ins().load(types::I32, heads, head, context::HEAD_CAPACITY);
            let offset = self.b.ins().load(types::I32, heads, head, context::HEAD_OFFSET);
            let kept = self.slot_address(offset, false);
            let (store, start) = self.block_with(&[types::I64]);
            let fresh = self.b.create_block();
            let fits = self.b.ins().icmp_imm_s(IntCC::UnsignedGreaterThanOrEqual, capacity, k as i64);
            self.b.ins().brif(fits, store, &[kept.into()], fresh, &[]);
            self.continue_in(fresh);
            self.leave_if(capacity, slow);
            let taken = self.take_slots_for(k, head, slow);
            self.jump_with(store, &[taken]);
            self.continue_in(store);
            start[0]
        };
        let whole = lanes.len().min(k / 4);
        for (i, &four) in lanes[..whole].iter().enumerate() {
            self.b.ins().store(unaligned(slots), four, start, 16 * i as i32);
        }
        for (i, &x) in items.iter().enumerate().skip(4 * whole) {
            self.b.ins().store(slots, x, start, 4 * i as i32);
        }
        let len = self.int32(k as u32);
        self.b.ins().store(heads, len, head, context::HEAD_LEN);
    }

    /// Takes slots for a ring of `k`, with gaps in those that it leaves; to `slow` if there are edge values.
    fn take_slots_for(&mut self, k: usize, head: Value, slow: Block) -> Value {
        let mut room = (k as u32).max(self.unit.facts.fresh_capacity);
        if self.unit.facts.grows {
            room = room_for(room);
        }
        let room = i64::from(room);
        let capacity = self.b.ins().iconst(types::I32, room);
        let start = self.take_slots(head, capacity, slow);
        let [one, two] = [types::I32, types::I64].map(|ty| self.b.ins().iconst(ty, 0));
        let mut i = k as i64;
        while i < room {
            let (gaps, n) = if i + 1 < room { (two, 2) } else { (one, 1) };
            self.b.ins().store(unaligned(self.regions.slots), gaps, start, 4 * i as i32);
            i += n;
        }
        start
    }

    /// Not zero where a few items are no ring of `v`: null, `v` itself, one twice. `None` if they are sure to be one.
    fn not_a_ring(&mut self, items: &[Value], v: Value) -> Option<Value> {
        let mut bad = Vec::new();
        for (i, &x) in items.iter().enumerate() {
            if !self.known.holds(Key::NotNull(x)) {
                bad.push(self.b.ins().icmp_imm_s(IntCC::Equal, x, 0));
            }
            for &y in items[..i].iter().chain(std::iter::once(&v)) {
                if !self.known.differ(x, y) {
                    bad.push(self.b.ins().icmp(IntCC::Equal, x, y));
                }
            }
        }
        bad.into_iter().reduce(|a, b| self.b.ins().bor(a, b))
    }

    /// Items by fours; where that leaves lanes, `v` follows, null, and then what differs from every vertex and from each
    /// other.
    fn packed(&mut self, items: &[Value], v: Value) -> Vec<Value> {
        let padding = [0, !1].map(|none| self.int32(none));
        let all: Vec<Value> = items.iter().copied().chain([v]).chain(padding).collect();
        let fours = items.len().div_ceil(4);
        (0..fours)
            .map(|k| {
                let four = &all[4 * k..4 * k + 4];
                let first = self.b.ins().scalar_to_vector(types::I32X4, four[0]);
                (1..4).fold(first, |lanes, i| self.b.ins().insertlane(lanes, four[usize::from(i)], i))
            })
            .collect()
    }

    /// [`Translator::not_a_ring`], four comparisons at a time.
    fn not_a_ring_of_lanes(&mut self, lanes: &[Value], items: &[Value], v: Value) -> Value {
        let mut pairs = self.pairs_of_lanes(lanes);
        let free = 4 * lanes.len() - items.len();
        let mut others = Vec::new();
        if free < 1 && !items.iter().all(|&x| self.known.differ(x, v)) {
            others.push(v);
        }
        if free < 2 && !items.iter().all(|&x| self.known.holds(Key::NotNull(x))) {
            others.push(self.int32(0));
        }
        for other in others {
            let other = self.b.ins().splat(types::I32X4, other);
            pairs.extend(lanes.iter().map(|&x| (x, other)));
        }
        self.any_equal(&pairs)
    }
}
