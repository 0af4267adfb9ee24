//! Slots four at a time, in lanes of vectors: loaded, searched, compared and shifted.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{ConstantData, Endianness, InstBuilder, MemFlagsData, Value, types};

use super::Translator;
use crate::engine::native::context;

/// The first slot of lanes that holds something: how many bits stand for those before it, and how many bits for one.
#[derive(Debug, Clone, Copy)]
pub(super) struct First {
    bits: Value,
    each: u32,
}

impl Translator<'_, '_> {
    /// Slots from an address on, which nothing aligns, an even number; lanes beyond them are null.
    pub(super) fn lanes(&mut self, start: Value, width: i64, flags: MemFlagsData) -> Vec<Value> {
        let flags = unaligned(flags);
        let whole = (0..width / 4).map(|k| self.b.ins().load(types::I32X4, flags, start, 16 * k as i32));
        let mut lanes: Vec<Value> = whole.collect();
        if width % 4 != 0 {
            let two = self.b.ins().load(types::I64, flags, start, 16 * lanes.len() as i32);
            let two = self.b.ins().scalar_to_vector(types::I64X2, two);
            lanes.push(self.b.ins().bitcast(types::I32X4, little_endian(), two));
        }
        lanes
    }

    /// Stores the lanes of one of the parts in which [`Translator::lanes`] loads slots: a load of what two stores wrote has
    /// to wait until both are in the cache.
    pub(super) fn store_lanes(&mut self, mut lanes: Value, k: u32, start: Value, width: i64, flags: MemFlagsData) {
        if i64::from(4 * k + 4) > width {
            let two = self.b.ins().bitcast(types::F64X2, little_endian(), lanes);
            lanes = self.b.ins().extractlane(two, 0);
        }
        self.b.ins().store(unaligned(flags), lanes, start, 16 * k as i32);
    }

    /// The first slot of the lanes that holds `x`.
    pub(super) fn first_match(&mut self, lanes: &[Value], x: Value) -> First {
        let (bits, each) = self.matches(lanes, x);
        First { bits: self.b.ins().ctz(bits), each }
    }

    /// A bit, or two, for each slot that holds `x`, i64, and how many.
    pub(super) fn matches(&mut self, lanes: &[Value], x: Value) -> (Value, u32) {
        let mut equal = self.lanes_with(lanes, x);
        let mut each = 1;
        if equal.len() > 1 {
            equal = self.narrowed(&equal);
            each = 2;
        }
        if equal.len() > 1 {
            equal = self.narrowed(&equal);
            each = 1;
        }
        let lanes = if each == 2 { self.b.ins().bitcast(types::I8X16, little_endian(), equal[0]) } else { equal[0] };
        (self.b.ins().vhigh_bits(types::I64, lanes), each)
    }

    /// Whether it is none of the first `len` slots.
    pub(super) fn is_beyond(&mut self, first: First, len: Value) -> Value {
        let mut end = self.wide(len);
        if first.each == 2 {
            end = self.b.ins().iadd(end, end);
        }
        self.b.ins().icmp(IntCC::UnsignedGreaterThanOrEqual, first.bits, end)
    }

    /// Bytes before it; no place in the lanes if there is none.
    pub(super) fn bytes_before(&mut self, first: First) -> Value {
        self.b.ins().ishl_imm_u(first.bits, if first.each == 2 { 1 } else { 2 })
    }

    /// Lanes of half the width, two by two.
    fn narrowed(&mut self, lanes: &[Value]) -> Vec<Value> {
        lanes.chunks(2).map(|pair| self.b.ins().snarrow(pair[0], pair[pair.len() - 1])).collect()
    }

    /// `first`, `first + 1`, …
    pub(super) fn lane_numbers(&mut self, first: u32) -> Value {
        let bytes: Vec<u8> = (first..first + 4).flat_map(u32::to_le_bytes).collect();
        let constant = self.b.func.dfg.constants.insert(ConstantData::from(bytes));
        self.b.ins().vconst(types::I32X4, constant)
    }

    /// How many bytes stand before each of the slots from `first` on. They are loaded, for Cranelift would keep constants
    /// on the stack.
    pub(super) fn lane_offsets(&mut self, first: u32) -> Value {
        let (flags, context) = (unaligned(self.regions.context), self.context);
        self.b.ins().load(types::I32X4, flags, context, context::OFFSETS + 4 * first as i32)
    }

    /// Which lanes hold `x`.
    pub(super) fn lanes_with(&mut self, lanes: &[Value], x: Value) -> Vec<Value> {
        let x = self.b.ins().splat(types::I32X4, x);
        lanes.iter().map(|&lane| self.b.ins().icmp(IntCC::Equal, x, lane)).collect()
    }

    /// Which of the slots of so many lanes stands so many bytes from the first.
    pub(super) fn lanes_at(&mut self, lanes: usize, at: Value) -> Vec<Value> {
        let at = self.lanes_of_offset(at);
        (0..lanes)
            .map(|k| {
                let offsets = self.lane_offsets(4 * k as u32);
                self.b.ins().icmp(IntCC::Equal, at, offsets)
            })
            .collect()
    }

    /// Which of the four slots from `first` on are, or stand behind, the one that stands so many bytes from the first of
    /// all.
    pub(super) fn lanes_from(&mut self, at: Value, first: u32) -> Value {
        self.lanes_of_row(at, 0, first)
    }

    /// Which of them stand behind it.
    pub(super) fn lanes_behind(&mut self, at: Value, first: u32) -> Value {
        self.lanes_of_row(at, 1, first)
    }

    fn lanes_of_row(&mut self, at: Value, rows_on: i32, first: u32) -> Value {
        let row = self.b.ins().imul_imm_s(at, i64::from(context::FROM_ROW / 4));
        let base = self.b.ins().iadd(self.context, row);
        let flags = unaligned(self.regions.context);
        let offset = context::FROM + rows_on * context::FROM_ROW + 4 * first as i32;
        let lanes = self.b.ins().load(types::I32X4, flags, base, offset);
        let zero = self.int32(0);
        let zeros = self.b.ins().splat(types::I32X4, zero);
        self.b.ins().icmp(IntCC::SignedLessThan, lanes, zeros)
    }

    /// An offset in bytes in all lanes.
    pub(super) fn lanes_of_offset(&mut self, offset: Value) -> Value {
        let offset = self.b.ins().ireduce(types::I32, offset);
        self.b.ins().splat(types::I32X4, offset)
    }

    /// Four slots, from one on; any slots of the four at the end for those before the first and behind the last. They are
    /// put together and not loaded: a load would wait for the stores of an edit just before.
    pub(super) fn four(&mut self, lanes: &[Value], first: i64) -> Value {
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

    /// Lane i becomes lane i + by, once round.
    fn rotated(&mut self, lanes: Value, by: u8) -> Value {
        let bytes = self.b.ins().bitcast(types::I8X16, little_endian(), lanes);
        let mask: Vec<u8> = (0..16).map(|i| (i + 4 * by) % 16).collect();
        let mask = self.b.func.dfg.immediates.push(ConstantData::from(mask));
        let rotated = self.b.ins().shuffle(bytes, bytes, mask);
        self.b.ins().bitcast(types::I32X4, little_endian(), rotated)
    }

    /// Comparisons that put each lane beside each other one.
    pub(super) fn pairs_of_lanes(&mut self, lanes: &[Value]) -> Vec<(Value, Value)> {
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
    pub(super) fn any_equal(&mut self, pairs: &[(Value, Value)]) -> Value {
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
}

/// A kind of memory, for loads and stores of more than one slot.
pub(super) fn unaligned(flags: MemFlagsData) -> MemFlagsData {
    MemFlagsData::new().with_notrap().with_alias_region(flags.alias_region())
}

/// The order of lanes in memory, for looking at them as lanes of another width.
pub(super) fn little_endian() -> MemFlagsData {
    MemFlagsData::new().with_endianness(Endianness::Little)
}
