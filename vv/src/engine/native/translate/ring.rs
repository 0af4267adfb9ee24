//! Rings: finding, walking and editing them. Rings of up to eight slots are searched with two vector comparisons; what
//! is rare (longer rings, gaps, edge values, rings that must move) is left to the runtime.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{
    Block, ConstantData, Endianness, InstBuilder, MemFlagsData, StackSlotData, StackSlotKind, Value, types,
};

use super::known::{Bounds, Fact, Found, Key};
use super::{Symbol, Translated, Translator};
use crate::engine::native::Mutation;
use crate::engine::native::context;
use crate::ir::{Expr, Item, Ring, Side};
use crate::mesh::FRESH_CAPACITY;

/// Rings up to these lengths are searched and edited in line, four slots at a time. A refinement that doubles valences
/// before it halves them again meets the second.
const WIDTHS: [i64; 2] = [8, 16];

/// Rings made of more items than this are left to the runtime.
const MAKE_LIMIT: usize = 12;

impl<'p> Translator<'_, 'p> {
    /// The vertex whose ring is meant: not null, and with an old value if that is meant.
    pub(super) fn ring_owner(&mut self, ring: &'p Ring) -> Translated<Value> {
        let v = self.vertex(&ring.vertex)?;
        self.not_null(v);
        if ring.old {
            self.held(v);
        }
        Ok(v)
    }

    /// What is looked for: `None` for the gap.
    pub(super) fn sought(&mut self, item: &'p Item) -> Translated<Option<Value>> {
        Ok(match item {
            Item::Gap(_) => None,
            Item::Vertex(e) => {
                let v = self.vertex(e)?;
                self.not_null(v);
                Some(v)
            }
        })
    }

    /// What is put into a ring: `None` where the word `null` is written.
    fn put(&mut self, item: &'p Item) -> Translated<Option<Value>> {
        Ok(match item {
            Item::Gap(_) => None,
            Item::Vertex(e) => Some(self.vertex(e)?),
        })
    }

    /// An expression of type vertex that may not be null.
    pub(super) fn vertex_not_null(&mut self, e: &'p Expr) -> Translated<Value> {
        let v = self.vertex(e)?;
        self.not_null(v);
        Ok(v)
    }

    fn or_null(&mut self, x: Option<Value>) -> Value {
        match x {
            Some(x) => x,
            None => self.int32(0),
        }
    }

    pub(super) fn not_null(&mut self, v: Value) {
        if !self.known.holds(Key::NotNull(v)) {
            let null = self.b.ins().icmp_imm_s(IntCC::Equal, v, 0);
            self.fail_if(null);
            self.known.learn(Key::NotNull(v), Fact::Holds);
        }
    }

    /// Fails unless a vertex has an old value.
    pub(super) fn held(&mut self, v: Value) {
        if self.known.holds(Key::Held(v)) {
            return;
        }
        let wide = self.b.ins().uextend(types::I64, v);
        let prefix = self.load_context(types::I64, context::OLD_PREFIX);
        let beyond = self.b.ins().icmp(IntCC::UnsignedGreaterThan, wide, prefix);
        let ask = self.b.create_block();
        self.b.set_cold_block(ask);
        let next = self.b.create_block();
        self.b.ins().brif(beyond, ask, &[], next, &[]);
        self.continue_in(ask);
        if let Some(holds) = self.call(Symbol::Holds, &[v]) {
            let fail = self.fail;
            self.b.ins().brif(holds, next, &[], fail, &[]);
        }
        self.continue_in(next);
        self.known.learn(Key::Held(v), Fact::Holds);
    }

    /// Address of an element of an array with one per vertex; offsets from it are the element's own.
    pub(super) fn element(&mut self, base: Value, v: Value, size: i64) -> Value {
        let wide = self.b.ins().uextend(types::I64, v);
        let index = self.b.ins().iadd_imm_s(wide, -1);
        let offset = self.b.ins().imul_imm_s(index, size);
        self.b.ins().iadd(base, offset)
    }

    fn head(&mut self, v: Value, old: bool) -> Value {
        let base = self.load_context(types::I64, if old { context::OLD_HEADS } else { context::HEADS });
        self.element(base, v, context::HEAD_SIZE)
    }

    pub(super) fn bounds(&mut self, v: Value, old: bool) -> Bounds {
        if let Some(Fact::Bounds(bounds)) = self.known.get(Key::Bounds { v, old }) {
            return bounds;
        }
        let head = self.head(v, old);
        let flags = if old { self.regions.old } else { self.regions.heads };
        let offset = self.b.ins().load(types::I32, flags, head, context::HEAD_OFFSET);
        let len = self.b.ins().load(types::I32, flags, head, context::HEAD_LEN);
        let start = self.slot_address(offset, old);
        let bounds = Bounds { start, len };
        self.known.learn(Key::Bounds { v, old }, Fact::Bounds(bounds));
        bounds
    }

    fn slot_address(&mut self, offset: Value, old: bool) -> Value {
        let base = self.load_context(types::I64, if old { context::OLD_SLOTS } else { context::SLOTS });
        let wide = self.b.ins().uextend(types::I64, offset);
        let bytes = self.b.ins().ishl_imm_u(wide, 2);
        self.b.ins().iadd(base, bytes)
    }

    /// Bytes of so many slots.
    pub(super) fn bytes_of(&mut self, slots: Value) -> Value {
        let wide = self.b.ins().uextend(types::I64, slots);
        self.b.ins().ishl_imm_u(wide, 2)
    }

    pub(super) fn load_slot(&mut self, start: Value, offset: Value, old: bool) -> Value {
        let flags = if old { self.regions.old } else { self.regions.slots };
        let address = self.b.ins().iadd(start, offset);
        self.b.ins().load(types::I32, flags, address, 0)
    }

    /// Slots from an address on, which the arena does not align.
    fn lanes(&mut self, start: Value, width: i64, old: bool) -> Vec<Value> {
        let flags = self.unaligned(old);
        (0..width / 4).map(|k| self.b.ins().load(types::I32X4, flags, start, 16 * k as i32)).collect()
    }

    fn unaligned(&self, old: bool) -> MemFlagsData {
        let flags = if old { self.regions.old } else { self.regions.slots };
        MemFlagsData::new().with_notrap().with_alias_region(flags.alias_region())
    }

    /// A bit for each of the first `len` lanes that holds `x`.
    fn matches(&mut self, lanes: &[Value], x: Value, len: Value) -> Value {
        let x = self.b.ins().splat(types::I32X4, x);
        let mut all = None;
        for (k, &lane) in lanes.iter().enumerate() {
            let equal = self.b.ins().icmp(IntCC::Equal, lane, x);
            let bits = self.b.ins().vhigh_bits(types::I32, equal);
            all = Some(match all {
                None => bits,
                Some(low) => {
                    let high = self.b.ins().ishl_imm_u(bits, 4 * k as i64);
                    self.b.ins().bor(low, high)
                }
            });
        }
        let one = self.b.ins().iconst(types::I32, 1);
        let end = self.b.ins().ishl(one, len);
        let mask = self.b.ins().iadd_imm_s(end, -1);
        all.map_or(mask, |all| self.b.ins().band(all, mask))
    }

    /// For each width: goes on, in a block of its own, where a ring has at most so many slots but for `less`. Beyond the
    /// last it goes to `slow`.
    fn by_width(&mut self, len: Value, less: i64, slow: Block, mut work: impl FnMut(&mut Self, i64)) {
        for width in WIDTHS {
            let [here, longer] = [(); 2].map(|()| self.b.create_block());
            let long = self.b.ins().icmp_imm_s(IntCC::UnsignedGreaterThan, len, width - less);
            self.b.ins().brif(long, longer, &[], here, &[]);
            self.continue_in(here);
            work(self, width);
            self.continue_in(longer);
        }
        self.b.ins().jump(slow, &[]);
    }

    /// Searches a ring; `None` looks for the gap.
    pub(super) fn find(&mut self, x: Option<Value>, v: Value, old: bool) -> Found {
        if let Some(x) = x
            && let Some(Fact::Found(found)) = self.known.get(Key::Find { x, v, old })
        {
            return found;
        }
        let Bounds { start, len } = self.bounds(v, old);
        let (done, results) = self.block_with(&[types::I32]);
        let slow = self.b.create_block();
        self.b.set_cold_block(slow);
        if let Some(x) = x {
            self.by_width(len, 0, slow, |t, width| {
                let lanes = t.lanes(start, width, old);
                let bits = t.matches(&lanes, x, len);
                let index = t.b.ins().ctz(bits);
                let none = t.b.ins().iconst(types::I32, -1);
                let index = t.b.ins().select(bits, index, none);
                t.jump_with(done, &[index]);
            });
        } else {
            self.b.ins().jump(slow, &[]);
        }
        self.continue_in(slow);
        let sought = self.or_null(x);
        let of_old = self.int32(u32::from(old));
        let index = self.call(Symbol::Find, &[sought, v, of_old]).unwrap_or(sought);
        self.jump_with(done, &[index]);
        self.continue_in(done);
        let index = results[0];
        let found = self.b.ins().icmp_imm_s(IntCC::SignedGreaterThanOrEqual, index, 0);
        let zero = self.int32(0);
        let index = self.b.ins().select(found, index, zero);
        let at = self.bytes_of(index);
        let bytes = self.bytes_of(len);
        let found = Found { start, bytes, at, found: Some(found) };
        if let Some(x) = x {
            self.known.learn(Key::Find { x, v, old }, Fact::Found(found));
        }
        found
    }

    /// What follows or precedes; null if it is not there.
    pub(super) fn neighbour(&mut self, found: Found, forward: bool, old: bool) -> Value {
        let zero = self.b.ins().iconst(types::I64, 0);
        let forward = forward != self.mutated(Mutation::NextIsPrevious);
        let offset = if forward {
            let next = self.b.ins().iadd_imm_s(found.at, 4);
            let last = self.b.ins().icmp(IntCC::Equal, next, found.bytes);
            self.b.ins().select(last, zero, next)
        } else {
            let from = self.b.ins().select(found.at, found.at, found.bytes);
            self.b.ins().iadd_imm_s(from, -4)
        };
        match found.found {
            None => self.load_slot(found.start, offset, old),
            Some(is) => {
                let offset = self.b.ins().select(is, offset, zero);
                let y = self.load_slot(found.start, offset, old);
                let null = self.int32(0);
                self.b.ins().select(is, y, null)
            }
        }
    }

    /// The start of a ring, null if it is empty.
    pub(super) fn any(&mut self, v: Value, old: bool) -> Value {
        let Bounds { start, len } = self.bounds(v, old);
        let mut place = self.b.ins().iconst(types::I64, 0);
        if self.mutated(Mutation::AnyIsLast) {
            let bytes = self.bytes_of(len);
            let last = self.b.ins().iadd_imm_s(bytes, -4);
            place = self.b.ins().select(len, last, place);
        }
        let first = self.load_slot(start, place, old);
        let null = self.int32(0);
        self.b.ins().select(len, first, null)
    }

    /// Whether a ring ends in a gap, that is, has one.
    pub(super) fn has_gap(&mut self, v: Value, old: bool) -> Value {
        let Bounds { start, len } = self.bounds(v, old);
        let zero = self.b.ins().iconst(types::I64, 0);
        let bytes = self.bytes_of(len);
        let last = self.b.ins().iadd_imm_s(bytes, -4);
        let last = self.b.ins().select(len, last, zero);
        let last = self.load_slot(start, last, old);
        let gap = self.b.ins().icmp_imm_s(IntCC::Equal, last, 0);
        let some = self.b.ins().icmp_imm_s(IntCC::NotEqual, len, 0);
        self.b.ins().band(gap, some)
    }

    /// How many gaps, i32.
    pub(super) fn gaps(&mut self, v: Value, old: bool) -> Value {
        let gap = self.has_gap(v, old);
        let (done, results) = self.block_with(&[types::I32]);
        let count = self.b.create_block();
        let none = self.b.create_block();
        self.b.set_cold_block(count);
        self.b.ins().brif(gap, count, &[], none, &[]);
        self.continue_in(count);
        let of_old = self.int32(u32::from(old));
        let gaps = self.call(Symbol::Gaps, &[v, of_old]).unwrap_or(of_old);
        self.jump_with(done, &[gaps]);
        self.continue_in(none);
        let zero = self.int32(0);
        self.jump_with(done, &[zero]);
        self.continue_in(done);
        results[0]
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
        for (i, x) in list.into_iter().enumerate() {
            let x = self.or_null(x);
            self.b.ins().stack_store(types::I64, x, slot, 4 * i as i32);
        }
        let address = self.b.ins().stack_addr(types::I64, slot, 0);
        let n = self.int32(n);
        self.call_or_fail(Symbol::Make, &[v, address, n]);
        self.b.ins().jump(done, &[]);
        self.continue_in(done);
        self.known.forget_rings(false);
        Ok(())
    }

    /// Makes a ring of vertices, or goes to `slow` with nothing done.
    fn make_in_place(&mut self, items: &[Value], v: Value, slow: Block) {
        let k = items.len();
        let mut bad = self.load_context(types::I64, context::HAS_EDGE_VALUES);
        bad = self.b.ins().ireduce(types::I8, bad);
        for (i, &x) in items.iter().enumerate() {
            if !self.known.holds(Key::NotNull(x)) {
                let null = self.b.ins().icmp_imm_s(IntCC::Equal, x, 0);
                bad = self.b.ins().bor(bad, null);
            }
            for &y in items[..i].iter().chain(std::iter::once(&v)) {
                let same = self.b.ins().icmp(IntCC::Equal, x, y);
                bad = self.b.ins().bor(bad, same);
            }
        }
        self.leave_if(bad, slow);
        let head = self.head(v, false);
        let heads = self.regions.heads;
        let capacity = self.b.ins().load(types::I32, heads, head, context::HEAD_CAPACITY);
        let offset = self.b.ins().load(types::I32, heads, head, context::HEAD_OFFSET);
        let (store, at) = self.block_with(&[types::I32]);
        let fresh = self.b.create_block();
        let fits = self.b.ins().icmp_imm_s(IntCC::UnsignedGreaterThanOrEqual, capacity, k as i64);
        self.b.ins().brif(fits, store, &[offset.into()], fresh, &[]);
        self.continue_in(fresh);
        self.leave_if(capacity, slow);
        let room = (k as i64).max(i64::from(FRESH_CAPACITY));
        let used = self.load_context(types::I64, context::SLOT_LEN);
        let end = self.b.ins().iadd_imm_s(used, room);
        let limit = self.load_context(types::I64, context::SLOT_CAPACITY);
        let full = self.b.ins().icmp(IntCC::UnsignedGreaterThan, end, limit);
        self.leave_if(full, slow);
        self.store_context(end, context::SLOT_LEN);
        let offset = self.b.ins().ireduce(types::I32, used);
        let capacity = self.b.ins().iconst(types::I32, room);
        self.b.ins().store(heads, offset, head, context::HEAD_OFFSET);
        self.b.ins().store(heads, capacity, head, context::HEAD_CAPACITY);
        // The runtime takes all slots in use for written.
        let start = self.slot_address(offset, false);
        let slots = self.regions.slots;
        let zero = self.int32(0);
        for i in k as i64..room {
            self.b.ins().store(slots, zero, start, 4 * i as i32);
        }
        self.jump_with(store, &[offset]);
        self.continue_in(store);
        let start = self.slot_address(at[0], false);
        for (i, &x) in items.iter().enumerate() {
            self.b.ins().store(slots, x, start, 4 * i as i32);
        }
        let len = self.int32(k as u32);
        self.b.ins().store(heads, len, head, context::HEAD_LEN);
    }

    pub(super) fn replace(&mut self, item: &'p Item, with: &'p Item, ring: &'p Expr) -> Translated<()> {
        let a = self.sought(item)?;
        let x = self.put(with)?;
        let v = self.vertex_not_null(ring)?;
        let done = self.b.create_block();
        let slow = self.b.create_block();
        self.b.set_cold_block(slow);
        if let (Some(a), Some(x)) = (a, x) {
            let Bounds { start, len } = self.bounds(v, false);
            self.by_width(len, 0, slow, |t, width| {
                let lanes = t.lanes(start, width, false);
                let here = t.matches(&lanes, a, len);
                let there = t.matches(&lanes, x, len);
                let next = t.b.create_block();
                t.b.ins().brif(here, next, &[], done, &[]);
                t.continue_in(next);
                let bad = t.may_not_enter(x, there, v);
                t.leave_if(bad, slow);
                let index = t.b.ins().ctz(here);
                let at = t.bytes_of(index);
                let address = t.b.ins().iadd(start, at);
                let slots = t.regions.slots;
                if !t.mutated(Mutation::ReplacesNothing) {
                    t.b.ins().store(slots, x, address, 0);
                }
                t.b.ins().jump(done, &[]);
            });
        } else {
            self.b.ins().jump(slow, &[]);
        }
        self.continue_in(slow);
        let (a, x) = (self.or_null(a), self.or_null(x));
        self.call_or_fail(Symbol::Replace, &[a, x, v]);
        self.b.ins().jump(done, &[]);
        self.continue_in(done);
        self.known.forget_rings(false);
        Ok(())
    }

    /// Not zero where `x` is null, stands in the ring already (bits `there`), or is `v` itself.
    fn may_not_enter(&mut self, x: Value, there: Value, v: Value) -> Value {
        let twice = self.b.ins().icmp_imm_s(IntCC::NotEqual, there, 0);
        let itself = self.b.ins().icmp(IntCC::Equal, x, v);
        let bad = self.b.ins().bor(twice, itself);
        if self.known.holds(Key::NotNull(x)) {
            return bad;
        }
        let null = self.b.ins().icmp_imm_s(IntCC::Equal, x, 0);
        self.b.ins().bor(bad, null)
    }

    pub(super) fn splice(&mut self, item: &'p Item, side: Side, anchor: &'p Item, ring: &'p Expr) -> Translated<()> {
        let x = self.put(item)?;
        let a = self.sought(anchor)?;
        let v = self.vertex_not_null(ring)?;
        let done = self.b.create_block();
        let slow = self.b.create_block();
        self.b.set_cold_block(slow);
        if let (Some(x), Some(a)) = (x, a) {
            self.splice_in_place(x, side, a, v, [slow, done]);
        } else {
            self.b.ins().jump(slow, &[]);
        }
        self.continue_in(slow);
        let (x, a) = (self.or_null(x), self.or_null(a));
        let before = self.int32(u32::from(side == Side::Before));
        self.call_or_fail(Symbol::Splice, &[x, a, v, before]);
        self.b.ins().jump(done, &[]);
        self.continue_in(done);
        self.known.forget_rings(false);
        Ok(())
    }

    /// Splices a vertex into a ring without gaps that has room, or goes to `slow` with nothing done.
    fn splice_in_place(&mut self, x: Value, side: Side, a: Value, v: Value, [slow, done]: [Block; 2]) {
        let Bounds { start, len } = self.bounds(v, false);
        self.by_width(len, 1, slow, |t, width| {
            let lanes = t.lanes(start, width, false);
            let here = t.matches(&lanes, a, len);
            let there = t.matches(&lanes, x, len);
            let next = t.b.create_block();
            t.b.ins().brif(here, next, &[], done, &[]);
            t.continue_in(next);
            let head = t.head(v, false);
            let heads = t.regions.heads;
            let capacity = t.b.ins().load(types::I32, heads, head, context::HEAD_CAPACITY);
            let bad = t.may_not_enter(x, there, v);
            let full = t.b.ins().icmp(IntCC::Equal, capacity, len);
            let bad = t.b.ins().bor(bad, full);
            let bad = t.or_gap_or_edge_values(bad, v);
            t.leave_if(bad, slow);
            let index = t.b.ins().ctz(here);
            let after = (side == Side::After) != t.mutated(Mutation::SplicesOnTheOtherSide);
            let at = match if after { Side::After } else { Side::Before } {
                Side::After => t.b.ins().iadd_imm_s(index, 1),
                Side::Before => t.b.ins().select(index, index, len),
            };
            // Lanes behind `at` take what stands before them, `at` takes x.
            let mut shifted = vec![t.shift_lanes_up(lanes[0])];
            let before = t.b.ins().iadd_imm_s(start, 12);
            shifted.extend(t.lanes(before, width - 4, false));
            let end = t.b.ins().splat(types::I32X4, len);
            let place = t.b.ins().splat(types::I32X4, at);
            let new = t.b.ins().splat(types::I32X4, x);
            for (k, (shifted, lane)) in shifted.into_iter().zip(lanes).enumerate() {
                let numbers = t.lane_numbers(4 * k as u32);
                let behind = t.b.ins().icmp(IntCC::SignedGreaterThan, numbers, place);
                let within = t.b.ins().icmp(IntCC::SignedLessThanOrEqual, numbers, end);
                let moved = t.b.ins().band(behind, within);
                let result = t.b.ins().bitselect(moved, shifted, lane);
                let here = t.b.ins().icmp(IntCC::Equal, numbers, place);
                let result = t.b.ins().bitselect(here, new, result);
                // Lanes behind the ring get back what they hold, for it is another's.
                let flags = t.unaligned(false);
                t.b.ins().store(flags, result, start, 16 * k as i32);
            }
            let len = t.b.ins().iadd_imm_s(len, 1);
            t.b.ins().store(heads, len, head, context::HEAD_LEN);
            t.b.ins().jump(done, &[]);
        });
    }

    fn or_gap_or_edge_values(&mut self, bad: Value, v: Value) -> Value {
        let gap = self.has_gap(v, false);
        let bad = self.b.ins().bor(bad, gap);
        let edge_values = self.load_context(types::I64, context::HAS_EDGE_VALUES);
        let edge_values = self.b.ins().ireduce(types::I8, edge_values);
        self.b.ins().bor(bad, edge_values)
    }

    /// `first`, `first + 1`, …
    fn lane_numbers(&mut self, first: u32) -> Value {
        let bytes: Vec<u8> = (first..first + 4).flat_map(u32::to_le_bytes).collect();
        let constant = self.b.func.dfg.constants.insert(ConstantData::from(bytes));
        self.b.ins().vconst(types::I32X4, constant)
    }

    /// Lane i becomes lane i − 1; the first is of no use.
    fn shift_lanes_up(&mut self, lanes: Value) -> Value {
        let bytes = self.b.ins().bitcast(types::I8X16, little_endian(), lanes);
        let mask: Vec<u8> = [0, 1, 2, 3].into_iter().chain(0..12).collect();
        let mask = self.b.func.dfg.immediates.push(ConstantData::from(mask));
        let shifted = self.b.ins().shuffle(bytes, bytes, mask);
        self.b.ins().bitcast(types::I32X4, little_endian(), shifted)
    }

    pub(super) fn erase(&mut self, item: &'p Item, from: &'p Expr) -> Translated<()> {
        let x = self.sought(item)?;
        let v = self.vertex_not_null(from)?;
        let done = self.b.create_block();
        let slow = self.b.create_block();
        self.b.set_cold_block(slow);
        if let Some(x) = x {
            let Bounds { start, len } = self.bounds(v, false);
            self.by_width(len, 0, slow, |t, width| {
                let lanes = t.lanes(start, width, false);
                let here = t.matches(&lanes, x, len);
                let next = t.b.create_block();
                t.b.ins().brif(here, next, &[], done, &[]);
                t.continue_in(next);
                let zero = t.b.ins().iconst(types::I8, 0);
                let bad = t.or_gap_or_edge_values(zero, v);
                t.leave_if(bad, slow);
                let index = t.b.ins().ctz(here);
                // Lanes from `index` on take what stands behind them; those behind the ring get back what they hold.
                let behind = t.b.ins().iadd_imm_s(start, 4);
                let shifted = t.lanes(behind, width, false);
                let len = t.b.ins().iadd_imm_s(len, -1);
                let place = t.b.ins().splat(types::I32X4, index);
                let end = t.b.ins().splat(types::I32X4, len);
                for (k, (shifted, lane)) in shifted.into_iter().zip(lanes).enumerate() {
                    let numbers = t.lane_numbers(4 * k as u32);
                    let from = t.b.ins().icmp(IntCC::SignedGreaterThanOrEqual, numbers, place);
                    let within = t.b.ins().icmp(IntCC::SignedLessThan, numbers, end);
                    let moved = t.b.ins().band(from, within);
                    let result = t.b.ins().bitselect(moved, shifted, lane);
                    let flags = t.unaligned(false);
                    t.b.ins().store(flags, result, start, 16 * k as i32);
                }
                let head = t.head(v, false);
                let heads = t.regions.heads;
                if !t.mutated(Mutation::ErasesNothing) {
                    t.b.ins().store(heads, len, head, context::HEAD_LEN);
                }
                t.b.ins().jump(done, &[]);
            });
        } else {
            self.b.ins().jump(slow, &[]);
        }
        self.continue_in(slow);
        let x = self.or_null(x);
        self.call_or_fail(Symbol::Erase, &[x, v]);
        self.b.ins().jump(done, &[]);
        self.continue_in(done);
        self.known.forget_rings(false);
        Ok(())
    }
}

fn little_endian() -> MemFlagsData {
    MemFlagsData::new().with_endianness(Endianness::Little)
}
