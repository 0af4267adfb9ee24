//! Rings: finding, walking and editing them. Rings of up to eight slots are searched with two vector comparisons; what
//! is rare (longer rings, gaps, edge values, rings that must move) is left to the runtime.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, InstBuilder, MemFlagsData, Value, types};

use super::known::{Bounds, Fact, Found, Key};
use super::{Symbol, Translated, Translator};
use crate::engine::native::Mutation;
use crate::engine::native::context;
use crate::ir::{Expr, Item, LocalId, Ring};

/// A ring whose owner is computed.
#[derive(Debug, Clone, Copy)]
pub(super) enum Source {
    Of { v: Value, old: bool },
    Variable(LocalId),
}

impl<'p> Translator<'_, 'p> {
    /// The vertex whose ring is meant, not null and with an old value if that is meant, or the variable.
    pub(super) fn source(&mut self, ring: &'p Ring) -> Translated<Source> {
        Ok(match ring {
            Ring::Of { vertex, old } => {
                let v = self.vertex(vertex)?;
                if *old {
                    self.held(v)?;
                } else {
                    self.not_null(v);
                }
                Source::Of { v, old: *old }
            }
            Ring::Variable { local, .. } => Source::Variable(*local),
        })
    }

    /// Where a ring lies.
    pub(super) fn bounds_of(&mut self, source: Source) -> Translated<Bounds> {
        match source {
            Source::Of { v, old } => Ok(self.bounds(v, old)),
            Source::Variable(local) => self.list_bounds(local),
        }
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

    /// An expression of type vertex that may not be null.
    pub(super) fn vertex_not_null(&mut self, e: &'p Expr) -> Translated<Value> {
        let v = self.vertex(e)?;
        self.not_null(v);
        Ok(v)
    }

    pub(super) fn or_null(&mut self, x: Option<Value>) -> Value {
        match x {
            Some(x) => x,
            None => self.int32(0),
        }
    }

    pub(super) fn not_null(&mut self, v: Value) {
        if !self.known.holds(Key::NotNull(v)) {
            let null = self.b.ins().icmp_imm_s(IntCC::Equal, v, 0);
            self.fail_if(null);
            self.known.is_not_null(v);
        }
    }

    /// Fails unless a vertex is not null and has an old value.
    pub(super) fn held(&mut self, v: Value) -> Translated<()> {
        if self.known.holds(Key::Held(v)) {
            return Ok(());
        }
        let wide = self.wide(v);
        let prefix = self.load_context(types::I64, context::OLD_PREFIX);
        let beyond = if self.known.holds(Key::NotNull(v)) {
            self.b.ins().icmp(IntCC::UnsignedGreaterThan, wide, prefix)
        } else {
            // Null is beyond all, too.
            let index = self.b.ins().iadd_imm_s(wide, -1);
            self.b.ins().icmp(IntCC::UnsignedGreaterThanOrEqual, index, prefix)
        };
        let ask = self.b.create_block();
        self.b.set_cold_block(ask);
        let next = self.b.create_block();
        self.b.ins().brif(beyond, ask, &[], next, &[]);
        self.continue_in(ask);
        if let Some(holds) = self.call_rarely(Symbol::Holds, &[v])? {
            let fail = self.fail;
            self.b.ins().brif(holds, next, &[], fail, &[]);
        }
        self.continue_in(next);
        self.known.is_not_null(v);
        self.known.learn(Key::Held(v), Fact::Holds);
        Ok(())
    }

    /// Address of an element of an array with one per vertex; offsets from it are the element's own.
    pub(super) fn element(&mut self, base: Value, v: Value, size: i64) -> Value {
        let wide = self.wide(v);
        let offset = self.b.ins().imul_imm_s(wide, size);
        let behind = self.b.ins().iadd(base, offset);
        self.b.ins().iadd_imm_s(behind, -size)
    }

    /// A number of 32 bits, without sign, that is loaded in 64, which costs nothing and saves widening it.
    pub(super) fn load_number(&mut self, flags: MemFlagsData, address: Value, offset: i32) -> Value {
        let wide = self.b.ins().uload32(flags, address, offset);
        let narrow = self.b.ins().ireduce(types::I32, wide);
        self.known.learn(Key::Wide(narrow), Fact::Is(wide));
        narrow
    }

    /// A number of 32 bits, without sign, in 64.
    pub(super) fn wide(&mut self, x: Value) -> Value {
        match self.known.get(Key::Wide(x)) {
            Some(Fact::Is(wide)) => wide,
            _ => self.b.ins().uextend(types::I64, x),
        }
    }

    pub(super) fn head(&mut self, v: Value, old: bool) -> Value {
        let base = self.load_context(types::I64, if old { context::OLD_HEADS } else { context::HEADS });
        self.element(base, v, context::HEAD_SIZE)
    }

    pub(super) fn bounds(&mut self, v: Value, old: bool) -> Bounds {
        if let Some(Fact::Bounds(bounds)) = self.known.get(Key::Bounds { v, old }) {
            return bounds;
        }
        let (offset, len) = match self.known.get(Key::Lies(v)) {
            Some(Fact::Lies { offset, len }) if !old => (offset, len),
            _ => {
                let head = self.head(v, old);
                let flags = if old { self.regions.old } else { self.regions.heads };
                let offset = self.load_number(flags, head, context::HEAD_OFFSET);
                let len = self.load_number(flags, head, context::HEAD_LEN);
                if !old {
                    self.known.learn(Key::Lies(v), Fact::Lies { offset, len });
                }
                (offset, len)
            }
        };
        let start = self.slot_address(offset, old);
        let bounds = Bounds { start, len, flags: if old { self.regions.old } else { self.regions.slots } };
        self.known.learn(Key::Bounds { v, old }, Fact::Bounds(bounds));
        bounds
    }

    pub(super) fn slot_address(&mut self, offset: Value, old: bool) -> Value {
        let base = self.load_context(types::I64, if old { context::OLD_SLOTS } else { context::SLOTS });
        let wide = self.wide(offset);
        let bytes = self.b.ins().ishl_imm_u(wide, 2);
        self.b.ins().iadd(base, bytes)
    }

    /// Bytes of so many slots.
    pub(super) fn bytes_of(&mut self, slots: Value) -> Value {
        let wide = self.wide(slots);
        self.b.ins().ishl_imm_u(wide, 2)
    }

    pub(super) fn load_slot(&mut self, start: Value, offset: Value, flags: MemFlagsData) -> Value {
        let address = self.b.ins().iadd(start, offset);
        self.load_number(flags, address, 0)
    }

    /// Rings up to these lengths are searched and edited in line, four slots at a time. A refinement that doubles
    /// valences before it halves them again meets the longest.
    pub(super) fn widths(&self) -> &'static [i64] {
        if self.unit.facts.fresh_capacity <= 4 { &[4, 8] } else { &[8, 12, 16] }
    }

    /// By how many slots rings are edited in line, as rings of programs that splice have room: those that have room for the
    /// first of the next group are of that one.
    pub(super) fn edit_widths(&self) -> &'static [&'static [i64]] {
        if self.unit.facts.fresh_capacity <= 4 { &[&[4], &[8]] } else { &[&[6, 8], &[12, 16]] }
    }

    /// For each width: goes on, in a block of its own, where a ring has at most so many slots but for `less`. Beyond the
    /// last it goes to `slow`.
    pub(super) fn by_width(
        &mut self,
        widths: &[i64],
        len: Value,
        less: i64,
        slow: Block,
        mut work: impl FnMut(&mut Self, i64),
    ) {
        for &width in widths {
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
    pub(super) fn find(&mut self, x: Option<Value>, source: Source) -> Translated<Found> {
        if let (Some(x), Source::Of { v, old }) = (x, source)
            && let Some(Fact::Found(found)) = self.known.get(Key::Find { x, v, old })
        {
            return Ok(found);
        }
        let Bounds { start, len, flags } = self.bounds_of(source)?;
        let bytes = self.bytes_of(len);
        if let (Some(x), Source::Of { v, old: false }) = (x, source)
            && let Some(at) = self.known.place(x, v)
        {
            let found = Found { start, bytes, at, here: None, certain: true, flags };
            self.known.learn(Key::Find { x, v, old: false }, Fact::Found(found));
            return Ok(found);
        }
        let (done, results) = self.block_with(&[types::I64, types::I64]);
        let [slow, missing] = [(); 2].map(|()| self.b.create_block());
        self.b.set_cold_block(slow);
        if let Some(x) = x {
            // Rings that grow and shrink while they are searched are searched in one way, which the machine foresees.
            let changes = self.unit.facts.grows && matches!(source, Source::Of { old: false, .. });
            let widths = if changes { &[12, 16] } else { self.widths() };
            self.by_width(widths, len, 0, slow, |t, width| {
                let lanes = t.lanes(start, width, flags);
                let first = t.first_match(&lanes, x);
                let absent = t.is_beyond(first, len);
                let at = t.bytes_before(first);
                t.b.ins().brif(absent, missing, &[], done, &[start.into(), at.into()]);
            });
        } else {
            self.b.ins().jump(slow, &[]);
        }
        self.continue_in(slow);
        let sought = self.or_null(x);
        let index = match source {
            Source::Of { v, old } => {
                let of_old = self.int32(u32::from(old));
                self.call_rarely(Symbol::Find, &[sought, v, of_old])?
            }
            Source::Variable(_) => self.call_rarely(Symbol::ListFind, &[start, len, sought])?,
        };
        let index = index.unwrap_or(sought);
        let found = self.b.ins().icmp_imm_s(IntCC::SignedGreaterThanOrEqual, index, 0);
        let at = self.bytes_of(index);
        self.b.ins().brif(found, done, &[start.into(), at.into()], missing, &[]);
        self.continue_in(missing);
        let nothing = self.nothing();
        let middle = self.b.ins().iconst(types::I64, 4);
        self.jump_with(done, &[nothing, middle]);
        self.continue_in(done);
        let found = Found { start: results[0], bytes, at: results[1], here: None, certain: false, flags };
        if let (Some(x), Source::Of { v, old }) = (x, source) {
            self.known.learn(Key::Find { x, v, old }, Fact::Found(found));
        }
        Ok(found)
    }

    /// Where what is not there is said to stand, in the middle of nulls: so what follows and what precedes it is null.
    fn nothing(&mut self) -> Value {
        self.b.ins().iadd_imm_s(self.context, i64::from(context::NOTHING))
    }

    /// Whether it is there.
    pub(super) fn is_found(&mut self, found: Found) -> Value {
        if found.certain {
            return self.b.ins().iconst(types::I8, 1);
        }
        let nothing = self.nothing();
        self.b.ins().icmp(IntCC::NotEqual, found.start, nothing)
    }

    /// What follows or precedes, with its place, bytes from the start; null if it is not there.
    pub(super) fn neighbour(&mut self, found: Found, forward: bool) -> (Value, Value) {
        let forward = forward != self.mutated(Mutation::NextIsPrevious);
        if let Some((at, end)) = found.here {
            let address = if forward { self.after(at, found.start, end) } else { self.before(at, found.start, end) };
            let place = self.b.ins().isub(address, found.start);
            return (self.load_number(found.flags, address, 0), place);
        }
        let place = if forward {
            let zero = self.b.ins().iconst(types::I64, 0);
            let next = self.b.ins().iadd_imm_s(found.at, 4);
            let last = self.b.ins().icmp(IntCC::Equal, next, found.bytes);
            self.b.ins().select(last, zero, next)
        } else {
            let from = self.b.ins().select(found.at, found.at, found.bytes);
            self.b.ins().iadd_imm_s(from, -4)
        };
        (self.load_slot(found.start, place, found.flags), place)
    }

    /// The start of a ring, null if it is empty.
    pub(super) fn any(&mut self, Bounds { start, len, flags }: Bounds) -> Value {
        let mut place = self.b.ins().iconst(types::I64, 0);
        if self.mutated(Mutation::AnyIsLast) {
            let bytes = self.bytes_of(len);
            let last = self.b.ins().iadd_imm_s(bytes, -4);
            place = self.b.ins().select(len, last, place);
        }
        let first = self.load_slot(start, place, flags);
        let null = self.int32(0);
        self.b.ins().select(len, first, null)
    }

    /// Whether a ring ends in a gap, that is, has one.
    pub(super) fn has_gap(&mut self, v: Value, old: bool) -> Value {
        let Bounds { start, len, flags } = self.bounds(v, old);
        let zero = self.b.ins().iconst(types::I64, 0);
        let bytes = self.bytes_of(len);
        let last = self.b.ins().iadd_imm_s(bytes, -4);
        let last = self.b.ins().select(len, last, zero);
        let last = self.load_slot(start, last, flags);
        let gap = self.b.ins().icmp_imm_s(IntCC::Equal, last, 0);
        let some = self.b.ins().icmp_imm_s(IntCC::NotEqual, len, 0);
        self.b.ins().band(gap, some)
    }

    /// How many gaps, i32.
    pub(super) fn gaps(&mut self, v: Value, old: bool) -> Translated<Value> {
        if let Some(Fact::Is(gaps)) = self.known.get(Key::Gaps { v, old }) {
            return Ok(gaps);
        }
        let gap = self.has_gap(v, old);
        let (done, results) = self.block_with(&[types::I32]);
        let count = self.b.create_block();
        let none = self.b.create_block();
        self.b.set_cold_block(count);
        self.b.ins().brif(gap, count, &[], none, &[]);
        self.continue_in(count);
        let of_old = self.int32(u32::from(old));
        let gaps = self.call_rarely(Symbol::Gaps, &[v, of_old])?.unwrap_or(of_old);
        self.jump_with(done, &[gaps]);
        self.continue_in(none);
        let zero = self.int32(0);
        self.jump_with(done, &[zero]);
        self.continue_in(done);
        self.known.learn(Key::Gaps { v, old }, Fact::Is(results[0]));
        Ok(results[0])
    }
}
