//! Loops.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, InstBuilder, StackSlotData, StackSlotKind, Value, types};

use super::known::{Bounds, Fact, Found, Key};
use super::ring::WIDTHS;
use super::{Loop, Symbol, Translated, Translator, Val, Walk, wrong_type};
use crate::engine::native::Mutation;
use crate::engine::native::context;
use crate::engine::native::effects::{Effects, Node, each_in};
use crate::ir::{Expr, ExprKind, LocalId, Ring, Stmt};
use crate::source::Span;

impl<'p> Translator<'_, 'p> {
    pub(super) fn repeat(
        &mut self,
        condition: Option<&'p Expr>,
        body: &'p [Stmt],
        update: &'p [Expr],
        body_first: bool,
        span: Span,
    ) -> Translated<bool> {
        let span = condition.map_or(span, |c| c.span);
        self.forget(self.unit.facts.effects_of(body, update, condition));
        let [head, round, next, exit] = [(); 4].map(|()| self.b.create_block());
        // The condition stands twice, before the first round and at the end of each, unless it is long.
        let twice = condition.is_some_and(is_short);
        match condition {
            Some(c) if !body_first && twice => {
                self.known.enter();
                let holds = self.condition(c)?;
                self.known.leave();
                self.b.ins().brif(holds, round, &[], exit, &[]);
            }
            Some(_) if !body_first => {
                self.b.ins().jump(head, &[]);
            }
            _ => {
                self.b.ins().jump(round, &[]);
            }
        }
        self.b.switch_to_block(round);
        self.known.enter();
        self.poll(span);
        self.frame_mut()?.loops.push(Loop { next, exit, walk: Walk::Nothing });
        let goes_on = self.block(body)?;
        self.frame_mut()?.loops.pop();
        if goes_on {
            self.b.ins().jump(next, &[]);
        }
        self.known.leave();
        self.b.switch_to_block(next);
        self.b.seal_block(next);
        self.known.enter();
        for e in update {
            self.expression(e)?;
        }
        match condition {
            Some(c) if twice => {
                let holds = self.condition(c)?;
                self.b.ins().brif(holds, round, &[], exit, &[]);
            }
            Some(_) => {
                self.b.ins().jump(head, &[]);
            }
            None => {
                self.b.ins().jump(round, &[]);
            }
        }
        self.known.leave();
        self.b.switch_to_block(head);
        self.b.seal_block(head);
        match condition {
            Some(c) if !twice => {
                self.known.enter();
                let holds = self.condition(c)?;
                self.known.leave();
                self.b.ins().brif(holds, round, &[], exit, &[]);
            }
            _ => {
                self.b.ins().jump(exit, &[]);
            }
        }
        self.b.seal_block(round);
        self.continue_in(exit);
        // `while (true)` without a `break` has an exit that no one takes; what follows is compiled, and never runs.
        Ok(true)
    }

    pub(super) fn for_set(&mut self, local: LocalId, set: &'p Expr, body: &'p [Stmt]) -> Translated<()> {
        let span = set.span;
        let (index, mark) = self.set(set)?;
        let depth = self.call(Symbol::SetWalk, &[index]).ok_or_else(wrong_type)?;
        let none = self.b.ins().icmp_imm_s(IntCC::Equal, depth, -1);
        self.fail_if(none);
        let first = self.load_context(types::I64, context::VALUE);
        let count = self.load_context(types::I64, context::VALUE + 8);
        self.drop_sets(mark);
        let bytes = self.b.ins().ishl_imm_u(count, 2);
        let end = self.b.ins().iadd(first, bytes);
        self.forget(self.unit.facts.effects_of(body, &[], None));
        let exit = self.b.create_block();
        let flags = self.regions.members;
        self.walk(local, first, end, span, Walk::Set(depth), exit, body, |t, at| {
            t.b.ins().load(types::I32, flags, at, 0)
        })?;
        self.continue_in(exit);
        self.call(Symbol::SetWalkEnd, &[depth]);
        Ok(())
    }

    pub(super) fn for_ring(&mut self, local: LocalId, ring: &'p Ring, body: &'p [Stmt]) -> Translated<()> {
        let span = ring.span();
        let v = self.ring_owner(ring)?;
        let effects = self.unit.facts.effects_of(body, &[], None);
        let moves = if ring.is_old() { effects.synchronizes } else { effects.edits };
        let exit = self.b.create_block();
        if moves {
            let count = self.load_context(types::I64, context::WALK_COUNT);
            let [first, end] = self.copy_ring(v, ring.is_old());
            self.forget(effects);
            let flags = self.regions.locals;
            self.walk(local, first, end, span, Walk::Ring(count), exit, body, |t, at| {
                t.b.ins().load(types::I32, flags, at, 0)
            })?;
            self.continue_in(exit);
            self.store_context(count, context::WALK_COUNT);
            return Ok(());
        }
        let bounds = self.bounds(v, ring.is_old());
        let bytes = self.bytes_of(bounds.len);
        let end = self.b.ins().iadd(bounds.start, bytes);
        self.forget(effects);
        let flags = if ring.is_old() { self.regions.old } else { self.regions.slots };
        let old = ring.is_old();
        self.walk(local, bounds.start, end, span, Walk::Nothing, exit, body, |t, at| {
            let q = t.b.ins().load(types::I32, flags, at, 0);
            let at = t.b.ins().isub(at, bounds.start);
            let found = Found { start: bounds.start, bytes, at, found: None };
            t.known.learn(Key::Find { x: q, v, old }, Fact::Found(found));
            q
        })?;
        self.continue_in(exit);
        Ok(())
    }

    /// Copies a ring to where no edit reaches it: into the function's frame if it is short. From where to where it lies.
    fn copy_ring(&mut self, v: Value, old: bool) -> [Value; 2] {
        let Bounds { start, len } = self.bounds(v, old);
        let longest = WIDTHS[WIDTHS.len() - 1] as u32;
        let frame = self.b.create_sized_stack_slot(StackSlotData::new(StackSlotKind::ExplicitSlot, 4 * longest, 4));
        let copy = self.b.ins().stack_addr(types::I64, frame, 0);
        let (ready, bounds) = self.block_with(&[types::I64; 2]);
        let slow = self.b.create_block();
        self.b.set_cold_block(slow);
        let bytes = self.bytes_of(len);
        let end = self.b.ins().iadd(copy, bytes);
        self.by_width(len, 0, slow, |t, width| {
            let flags = t.regions.locals;
            for (k, lane) in t.lanes(start, width, old).into_iter().enumerate() {
                t.b.ins().store(flags, lane, copy, 16 * k as i32);
            }
            t.jump_with(ready, &[copy, end]);
        });
        self.continue_in(slow);
        let of_old = self.int32(u32::from(old));
        self.call_or_fail(Symbol::Walk, &[v, of_old]);
        let [first, end] = [0, 8].map(|k| self.load_context(types::I64, context::VALUE + k));
        self.jump_with(ready, &[first, end]);
        self.continue_in(ready);
        [bounds[0], bounds[1]]
    }

    /// Walks from `first` to `end`, addresses of vertices or gaps. `load` gives the vertex.
    #[expect(clippy::too_many_arguments, reason = "the one loop of all walks")]
    fn walk(
        &mut self,
        local: LocalId,
        first: Value,
        end: Value,
        span: Span,
        walk: Walk,
        exit: Block,
        body: &'p [Stmt],
        load: impl FnOnce(&mut Self, Value) -> Value,
    ) -> Translated<()> {
        let (round, at) = self.block_with(&[types::I64]);
        let at = at[0];
        let next = self.b.create_block();
        let empty = self.b.ins().icmp(IntCC::Equal, first, end);
        self.b.ins().brif(empty, exit, &[], round, &[first.into()]);
        self.b.switch_to_block(round);
        self.known.enter();
        let v = load(self, at);
        let hole = self.b.ins().icmp_imm_s(IntCC::Equal, v, 0);
        self.leave_if(hole, next);
        if self.mutated(Mutation::LoopsSkipTheSecond) {
            let second = self.b.ins().iadd_imm_s(first, 4);
            let skip = self.b.ins().icmp(IntCC::Equal, at, second);
            self.leave_if(skip, next);
        }
        self.known.learn(Key::NotNull(v), Fact::Holds);
        self.poll(span);
        self.define_local(local, Val::One(v))?;
        self.frame_mut()?.loops.push(Loop { next, exit, walk });
        let goes_on = self.block(body)?;
        self.frame_mut()?.loops.pop();
        if goes_on {
            self.b.ins().jump(next, &[]);
        }
        self.known.leave();
        self.continue_in(next);
        let after = self.b.ins().iadd_imm_s(at, 4);
        let last = self.b.ins().icmp(IntCC::Equal, after, end);
        self.b.ins().brif(last, exit, &[], round, &[after.into()]);
        self.b.seal_block(round);
        Ok(())
    }

    /// What a loop does is forgotten before it begins, for it holds for its second round.
    fn forget(&mut self, effects: Effects) {
        if effects.edits {
            self.known.forget_rings(false);
        }
        if effects.synchronizes {
            self.known.forget_rings(true);
        }
    }
}

/// Whether a condition is cheap to have twice.
fn is_short(e: &Expr) -> bool {
    let mut size = 0;
    let mut calls = false;
    each_in(e, &mut |node| {
        size += 1;
        if let Node::Expr(e) = node {
            calls |= matches!(e.kind, ExprKind::Call(..));
        }
    });
    size <= 16 && !calls
}
