//! Edits of rings.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, ConstantData, InstBuilder, StackSlotData, StackSlotKind, Value, types};

use super::known::{Bounds, Fact, Key};
use super::ring::{Source, little_endian, unaligned};
use super::{Symbol, Translated, Translator};
use crate::engine::native::Mutation;
use crate::engine::native::context::{self, room_for};
use crate::ir::{Expr, Item, LocalId, Ring, Side};

/// Rings made of more items than this are left to the runtime.
const MAKE_LIMIT: usize = 12;

/// Where code that edits in line goes: to the runtime, with nothing done, or on, with all done.
#[derive(Debug, Clone, Copy)]
struct Ways {
    slow: Block,
    done: Block,
}

impl<'p> Translator<'_, 'p> {
    /// What is put into a ring: `None` where the word `null` is written.
    fn put(&mut self, item: &'p Item) -> Translated<Option<Value>> {
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
        let n = u32::try_from(list.len()).map_err(|_| super::wrong_type())?;
        let slot = self.b.create_sized_stack_slot(StackSlotData::new(StackSlotKind::ExplicitSlot, 4 * n.max(1), 2));
        for (i, &x) in list.iter().enumerate() {
            let x = self.or_null(x);
            self.b.ins().stack_store(types::I64, x, slot, 4 * i as i32);
        }
        let address = self.b.ins().stack_addr(types::I64, slot, 0);
        let n = self.int32(n);
        self.call_or_fail(Symbol::Make, &[v, address, n]);
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
        });
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
        for k in 0..2 {
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

    /// Lane i becomes lane i + by, once round.
    fn rotated(&mut self, lanes: Value, by: u8) -> Value {
        let bytes = self.b.ins().bitcast(types::I8X16, little_endian(), lanes);
        let mask: Vec<u8> = (0..16).map(|i| (i + 4 * by) % 16).collect();
        let mask = self.b.func.dfg.immediates.push(ConstantData::from(mask));
        let rotated = self.b.ins().shuffle(bytes, bytes, mask);
        self.b.ins().bitcast(types::I32X4, little_endian(), rotated)
    }

    /// Makes a ring of vertices, or goes to `slow` with nothing done.
    fn make_in_place(&mut self, items: &[Value], v: Value, slow: Block) {
        let k = items.len();
        if !self.known.is_bare(v) {
            let edge_values = self.load_context(types::I64, context::HAS_EDGE_VALUES);
            self.leave_if(edge_values, slow);
        }
        let lanes = if k > 3 { self.packed(items, v) } else { Vec::new() };
        let bad = if k > 3 { Some(self.not_a_ring_of_lanes(&lanes, items)) } else { self.not_a_ring(items, v) };
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

    /// Items by fours; after the last `v`, null, and then lanes that differ from every vertex and from each other.
    fn packed(&mut self, items: &[Value], v: Value) -> Vec<Value> {
        let padding = [0, !1, !2].map(|none| self.int32(none));
        let all: Vec<Value> = items.iter().copied().chain([v]).chain(padding).collect();
        let fours = items.len() / 4 + 1;
        (0..fours)
            .map(|k| {
                let four = &all[4 * k..4 * k + 4];
                let first = self.b.ins().scalar_to_vector(types::I32X4, four[0]);
                (1..4).fold(first, |lanes, i| self.b.ins().insertlane(lanes, four[usize::from(i)], i))
            })
            .collect()
    }

    /// [`Translator::not_a_ring`], four comparisons at a time.
    fn not_a_ring_of_lanes(&mut self, lanes: &[Value], items: &[Value]) -> Value {
        let mut pairs = self.pairs_of_lanes(lanes);
        let has_null = items.len() + 1 < 4 * lanes.len();
        if !has_null && !items.iter().all(|&x| self.known.holds(Key::NotNull(x))) {
            let zero = self.int32(0);
            let nulls = self.b.ins().splat(types::I32X4, zero);
            pairs.extend(lanes.iter().map(|&x| (x, nulls)));
        }
        self.any_equal(&pairs)
    }

    /// Comparisons that put each lane beside each other one.
    fn pairs_of_lanes(&mut self, lanes: &[Value]) -> Vec<(Value, Value)> {
        let mut pairs = Vec::new();
        for (k, &x) in lanes.iter().enumerate() {
            pairs.extend([1, 2].map(|by| (x, self.rotated(x, by))));
            for &y in &lanes[..k] {
                pairs.extend([0, 1, 2, 3].map(|by| (x, if by == 0 { y } else { self.rotated(y, by) })));
            }
        }
        pairs
    }

    /// Whether any of the lanes is equal in any of the pairs.
    fn any_equal(&mut self, pairs: &[(Value, Value)]) -> Value {
        let mut same = None;
        for &(x, y) in pairs {
            let equal = self.b.ins().icmp(IntCC::Equal, x, y);
            same = Some(same.map_or(equal, |same| self.b.ins().bor(same, equal)));
        }
        match same {
            Some(same) => self.b.ins().vany_true(same),
            None => self.b.ins().iconst(types::I8, 0),
        }
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
        });
        self.note_put(x, v);
        Ok(())
    }

    /// Puts a vertex in the place of another.
    fn replace_in_place(&mut self, a: Value, x: Value, v: Value, Ways { slow, done }: Ways) {
        let Bounds { start, len, flags } = self.bounds(v, false);
        let bytes = self.bytes_of(len);
        if let Some(Fact::Found(was)) = self.known.get(Key::Find { x: a, v, old: true })
            && was.certain
            && self.known.is_absent(x, v)
            && self.known.differ(x, v)
        {
            self.replace_where_it_stood(was.at, a, x, Bounds { start, len, flags }, done);
        }
        self.by_width(self.widths(), len, 0, slow, |t, width| {
            let lanes = t.lanes(start, width, flags);
            let at = t.place_to_edit(&lanes, a, v, bytes, done);
            t.leave_unless_it_may_enter(&lanes, x, bytes, v, slow);
            if !t.mutated(Mutation::ReplacesNothing) {
                // Stores as wide as the loads that will follow, for narrow ones would hold those up.
                let place = t.lanes_of_offset(at);
                let new = t.b.ins().splat(types::I32X4, x);
                for (k, lane) in lanes.into_iter().enumerate() {
                    let offsets = t.lane_offsets(4 * k as u32);
                    let here = t.b.ins().icmp(IntCC::Equal, place, offsets);
                    let result = t.b.ins().bitselect(here, new, lane);
                    t.b.ins().store(unaligned(flags), result, start, 16 * k as i32);
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

    /// Where `a` stands in the ring of `v`, of so many bytes, which fills the first of the lanes; on to `done` if it does not.
    fn place_to_edit(&mut self, lanes: &[Value], a: Value, v: Value, bytes: Value, done: Block) -> Value {
        if let Some(at) = self.known.place(a, v) {
            return at;
        }
        let at = self.first_match(lanes, a);
        let absent = self.b.ins().icmp(IntCC::UnsignedGreaterThanOrEqual, at, bytes);
        self.leave_if(absent, done);
        at
    }

    /// Goes to `slow` where `x` is null, stands in the ring of `v` already, or is `v` itself.
    fn leave_unless_it_may_enter(&mut self, lanes: &[Value], x: Value, bytes: Value, v: Value, slow: Block) {
        if !self.known.is_absent(x, v) {
            let at = self.first_match(lanes, x);
            let twice = self.b.ins().icmp(IntCC::UnsignedLessThan, at, bytes);
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
        });
        self.note_put(x, v);
        Ok(())
    }

    /// Splices a vertex into a ring without gaps, which moves to twice the room if it has none left.
    fn splice_in_place(&mut self, x: Value, side: Side, a: Value, v: Value, Ways { slow, done }: Ways) {
        let Bounds { start, len, flags } = self.bounds(v, false);
        let bytes = self.bytes_of(len);
        self.by_width(self.edit_widths(), len, 1, slow, |t, width| {
            let lanes = t.lanes(start, (width + 3) & !3, flags);
            let at = t.place_to_edit(&lanes, a, v, bytes, done);
            t.leave_unless_it_may_enter(&lanes, x, bytes, v, slow);
            let head = t.head(v, false);
            let heads = t.regions.heads;
            let capacity = t.b.ins().load(types::I32, heads, head, context::HEAD_CAPACITY);
            t.leave_if_gap_or_edge_values(start, bytes, slow);
            let after = (side == Side::After) != t.mutated(Mutation::SplicesOnTheOtherSide);
            let at = match if after { Side::After } else { Side::Before } {
                Side::After => t.b.ins().iadd_imm_s(at, 4),
                Side::Before => t.b.ins().select(at, at, bytes),
            };
            // Lanes behind `at` take what stands before them, `at` takes x.
            let fours: Vec<(u32, Value, Value)> = fours(width)
                .map(|first| (first, t.four(&lanes, i64::from(first)), t.four(&lanes, i64::from(first) - 1)))
                .collect();
            let place = t.lanes_of_offset(at);
            let new = t.b.ins().splat(types::I32X4, x);
            let start = t.with_room(head, capacity, len, start, width, slow);
            for (first, lane, shifted) in fours {
                let offsets = t.lane_offsets(first);
                let behind = t.b.ins().icmp(IntCC::SignedGreaterThan, offsets, place);
                let result = t.b.ins().bitselect(behind, shifted, lane);
                let here = t.b.ins().icmp(IntCC::Equal, place, offsets);
                let result = t.b.ins().bitselect(here, new, result);
                t.b.ins().store(unaligned(flags), result, start, 4 * first as i32);
            }
            let len = t.b.ins().iadd_imm_s(len, 1);
            t.b.ins().store(heads, len, head, context::HEAD_LEN);
            t.b.ins().jump(done, &[]);
        });
    }

    /// Where a ring goes that becomes longer by one, to at most `width` slots, of which so many are then written: it stays
    /// at `start` if there is room for them, else, if it is full, it gets a fresh run of slots.
    fn with_room(&mut self, head: Value, capacity: Value, len: Value, start: Value, width: i64, slow: Block) -> Value {
        let fresh = self.b.create_block();
        self.b.set_cold_block(fresh);
        let (store, to) = self.block_with(&[types::I64]);
        let needed = if self.mutated(Mutation::IgnoresRoom) { 0 } else { width };
        let fits = self.b.ins().icmp_imm_s(IntCC::UnsignedGreaterThanOrEqual, capacity, needed);
        self.b.ins().brif(fits, store, &[start.into()], fresh, &[]);
        self.continue_in(fresh);
        let tight = self.b.ins().icmp(IntCC::NotEqual, capacity, len);
        self.leave_if(tight, slow);
        let twice = self.b.ins().ishl_imm_u(capacity, 1);
        let least = self.int32(self.unit.facts.fresh_capacity);
        let room = self.b.ins().umax(twice, least);
        let start = self.take_slots(head, room, slow);
        // The ring itself fills the first lanes.
        let flags = unaligned(self.regions.slots);
        // Loaded, for Cranelift would keep a constant on the stack, for all the rounds that have no need of it.
        let gaps = self.b.ins().load(types::I32X4, unaligned(self.regions.context), self.context, context::NOTHING);
        for k in width / 4..width / 2 {
            self.b.ins().store(flags, gaps, start, 16 * k as i32);
        }
        self.jump_with(store, &[start]);
        self.continue_in(store);
        to[0]
    }

    /// Gives a ring a fresh run of slots, which the caller writes all: the runtime takes slots in use for written. The
    /// result is where it lies; up to [`context::PADDING`] slots behind it may be written too.
    fn take_slots(&mut self, head: Value, room: Value, slow: Block) -> Value {
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
        self.slot_address(offset, false)
    }

    /// Goes to `slow` where a ring, which is not empty, ends in a gap, or values lie beside rings.
    fn leave_if_gap_or_edge_values(&mut self, start: Value, bytes: Value, slow: Block) {
        let end = self.b.ins().iadd(start, bytes);
        let last = self.b.ins().uload32(self.regions.slots, end, -4);
        let last = self.b.ins().iadd_imm_s(last, -1);
        let limit = self.load_context(types::I64, context::EDIT_LIMIT);
        let bad = self.b.ins().icmp(IntCC::UnsignedGreaterThanOrEqual, last, limit);
        self.leave_if(bad, slow);
    }

    /// An offset in bytes in all lanes.
    fn lanes_of_offset(&mut self, offset: Value) -> Value {
        let offset = self.b.ins().ireduce(types::I32, offset);
        self.b.ins().splat(types::I32X4, offset)
    }

    /// `first`, `first + 1`, …
    fn lane_numbers(&mut self, first: u32) -> Value {
        let bytes: Vec<u8> = (first..first + 4).flat_map(u32::to_le_bytes).collect();
        let constant = self.b.func.dfg.constants.insert(ConstantData::from(bytes));
        self.b.ins().vconst(types::I32X4, constant)
    }

    /// How many bytes stand before each of the slots from `first` on. They are loaded, for Cranelift would keep constants
    /// on the stack.
    fn lane_offsets(&mut self, first: u32) -> Value {
        let (flags, context) = (unaligned(self.regions.context), self.context);
        self.b.ins().load(types::I32X4, flags, context, context::OFFSETS + 4 * first as i32)
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
        });
        Ok(())
    }

    /// Takes a vertex out of a ring without gaps.
    fn erase_in_place(&mut self, x: Value, v: Value, Ways { slow, done }: Ways) {
        let Bounds { start, len, flags } = self.bounds(v, false);
        let bytes = self.bytes_of(len);
        let has_room = self.unit.facts.grows;
        let widths = if has_room { self.edit_widths() } else { self.widths() };
        self.by_width(widths, len, 0, slow, |t, width| {
            let lanes = t.lanes(start, (width + 3) & !3, flags);
            let at = t.place_to_edit(&lanes, x, v, bytes, done);
            t.leave_if_gap_or_edge_values(start, bytes, slow);
            let head = t.head(v, false);
            let heads = t.regions.heads;
            if has_room {
                let capacity = t.b.ins().load(types::I32, heads, head, context::HEAD_CAPACITY);
                let tight = t.b.ins().icmp_imm_s(IntCC::UnsignedLessThan, capacity, width);
                t.leave_if(tight, slow);
            }
            // Lanes from `at` on take what stands behind them.
            let fours: Vec<(u32, Value, Value)> = fours(width)
                .map(|first| (first, t.four(&lanes, i64::from(first)), t.four(&lanes, i64::from(first) + 1)))
                .collect();
            let before = t.b.ins().iadd_imm_s(at, -4);
            let last = t.b.ins().iadd_imm_s(bytes, -4);
            let [before, last] = [before, last].map(|x| t.lanes_of_offset(x));
            for (first, lane, shifted) in fours {
                let offsets = t.lane_offsets(first);
                let from = t.b.ins().icmp(IntCC::SignedGreaterThan, offsets, before);
                let mut result = t.b.ins().bitselect(from, shifted, lane);
                if !has_room {
                    // Those behind the ring, which are another's, get back what they hold.
                    let within = t.b.ins().icmp(IntCC::SignedGreaterThan, last, offsets);
                    result = t.b.ins().bitselect(within, result, lane);
                }
                t.b.ins().store(unaligned(flags), result, start, 4 * first as i32);
            }
            let len = t.b.ins().iadd_imm_s(len, -1);
            if !t.mutated(Mutation::ErasesNothing) {
                t.b.ins().store(heads, len, head, context::HEAD_LEN);
            }
            t.b.ins().jump(done, &[]);
        });
    }

    /// Four slots, from one on; any slots of the four at the end for those before the first and behind the last. They are
    /// put together and not loaded: a load would wait for the stores of an edit just before.
    fn four(&mut self, lanes: &[Value], first: i64) -> Value {
        let four = first.max(0) as usize / 4;
        let (low, high) = match (first, lanes.get(four + 1)) {
            (..0, _) | (_, None) => (lanes[four], lanes[four]),
            (_, Some(&high)) => (lanes[four], high),
        };
        let by = 4 * first.rem_euclid(4) as u8;
        if by == 0 {
            return low;
        }
        let [low, high] = [low, high].map(|x| self.b.ins().bitcast(types::I8X16, little_endian(), x));
        let mask = self.b.func.dfg.immediates.push(ConstantData::from((by..by + 16).collect::<Vec<u8>>()));
        let both = self.b.ins().shuffle(low, high, mask);
        self.b.ins().bitcast(types::I32X4, little_endian(), both)
    }

    fn note_put(&mut self, x: Option<Value>, v: Value) {
        if !self.mutated(Mutation::ForgetsWhatWasPut) {
            self.known.put(x, v);
        }
    }

    /// Edits the ring of `v` in line where `in_line` finds it can, else in the runtime.
    fn edit(&mut self, symbol: Symbol, v: Value, operands: &[Value], in_line: impl FnOnce(&mut Self, Ways)) {
        let ways = Ways { slow: self.b.create_block(), done: self.b.create_block() };
        self.b.set_cold_block(ways.slow);
        in_line(self, ways);
        self.continue_in(ways.slow);
        self.call_or_fail(symbol, operands);
        self.b.ins().jump(ways.done, &[]);
        self.continue_in(ways.done);
        if self.mutated(Mutation::EditsMoveNothing) {
            self.known.forget_addresses();
        } else {
            self.known.forget_ring(v);
        }
    }
}

/// The first slots of the fours that `width` slots are edited by; where two overlap, both come to the same.
fn fours(width: i64) -> impl Iterator<Item = u32> {
    (0..width as u32).step_by(4).map(move |first| first.min((width as u32).saturating_sub(4)))
}
