//! Statements. Each says whether what follows it can be reached.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, InstBuilder, Value, types};

use super::known::{Fact, Found, Key};
use super::{Loop, Storage, Symbol, Translated, Translator, Val, Walk, wrong_type};
use crate::engine::native::Mutation;
use crate::engine::native::context::{self, status};
use crate::engine::native::effects::{Effects, Node, each_in};
use crate::engine::native::{RED_ZONE, STACK_SEGMENT};
use crate::ir::{Expr, ExprKind, LocalId, PrintItem, Ring, Stmt, StmtKind, Type};
use crate::mesh;
use crate::source::Span;

impl<'p> Translator<'_, 'p> {
    pub(super) fn block(&mut self, statements: &'p [Stmt]) -> Translated<bool> {
        stacker::maybe_grow(RED_ZONE, STACK_SEGMENT, || {
            for s in statements {
                let quiet = self.pristine && is_quiet(s);
                let goes_on = self.statement(s)?;
                self.pristine = quiet;
                if !goes_on {
                    return Ok(false);
                }
            }
            Ok(true)
        })
    }

    /// Statements of which nothing that is learned holds afterwards.
    fn branch(&mut self, statements: &'p [Stmt]) -> Translated<bool> {
        self.known.enter();
        let goes_on = self.block(statements);
        self.known.leave();
        goes_on
    }

    fn statement(&mut self, s: &'p Stmt) -> Translated<bool> {
        self.pristine &= is_quiet(s) || matches!(s.kind, StmtKind::Block(_) | StmtKind::Synchronize(_));
        match &s.kind {
            StmtKind::Declare { local, init } => self.declare(*local, init.as_ref())?,
            StmtKind::Expr(e) => {
                self.expression(e)?;
            }
            StmtKind::Block(body) => return self.block(body),
            StmtKind::If { condition, then, otherwise } => {
                return self.choose(condition, then, otherwise);
            }
            StmtKind::Loop { condition, body, update, body_first } => {
                return self.repeat(condition.as_ref(), body, update, *body_first, s.span);
            }
            StmtKind::ForallSet { local, set, body } => {
                self.for_set(*local, set, body)?;
            }
            StmtKind::ForallRing { local, ring, body } => {
                self.for_ring(*local, ring, body)?;
            }
            StmtKind::Break => {
                let Loop { exit, next, .. } = self.innermost()?;
                let to = if self.mutated(Mutation::BreakIsContinue) { next } else { exit };
                self.b.ins().jump(to, &[]);
                return Ok(false);
            }
            StmtKind::Continue => {
                let next = self.innermost()?.next;
                self.b.ins().jump(next, &[]);
                return Ok(false);
            }
            StmtKind::Return(value) => return self.leave(value.as_ref()),
            StmtKind::Make { items, of } => self.make(items, of)?,
            StmtKind::Erase { item, from } => self.erase(item, from)?,
            StmtKind::Replace { item, with, ring } => self.replace(item, with, ring)?,
            StmtKind::Splice { item, side, anchor, ring } => self.splice(item, *side, anchor, ring)?,
            StmtKind::Synchronize(set) => {
                let pristine = std::mem::take(&mut self.pristine) && matches!(set.kind, ExprKind::Local(_));
                let (set, mark) = self.set(set)?;
                let pristine = self.int32(u32::from(pristine));
                self.call_or_fail(Symbol::Synchronize, &[set, pristine]);
                self.drop_sets(mark);
                self.known.forget_rings(false);
                self.known.forget_rings(true);
            }
            StmtKind::Add { vertex, set } => {
                let v = self.vertex_not_null(vertex)?;
                let set = self.set_of(*set)?;
                if !self.mutated(Mutation::AddsNoMember) {
                    self.add(v, set);
                }
            }
            StmtKind::Remove { vertex, set } => {
                let v = self.vertex_not_null(vertex)?;
                let set = self.set_of(*set)?;
                if !self.mutated(Mutation::RemovesNothing) {
                    self.call_or_fail(Symbol::SetRemove, &[set, v]);
                }
            }
            StmtKind::Merge { set, other } => {
                let (other, mark) = self.set(other)?;
                let set = self.set_of(*set)?;
                if !self.mutated(Mutation::MergesNothing) {
                    self.call_or_fail(Symbol::SetMerge, &[set, other]);
                }
                self.drop_sets(mark);
            }
            StmtKind::Print(items) => self.print(items, s.span)?,
        }
        Ok(true)
    }

    fn declare(&mut self, local: LocalId, init: Option<&'p Expr>) -> Translated<()> {
        let frame = self.frame()?;
        let ty = frame.function.locals.get(local.0 as usize).ok_or_else(wrong_type)?.ty;
        match ty {
            Type::Mesh => {
                let none = self.b.ins().iconst(types::I32, -1);
                let (other, mark) = match init {
                    Some(e) => self.set(e)?,
                    None => (none, None),
                };
                let set = self.set_of(local)?;
                self.call_or_fail(Symbol::SetDeclare, &[set, other]);
                self.drop_sets(mark);
            }
            Type::Value(ty) => {
                let value = match init {
                    Some(e) => self.expression(e)?,
                    None => self.constant(mesh::Value::zero(ty))?,
                };
                self.define_local(local, value)?;
            }
            Type::Void => {}
        }
        Ok(())
    }

    fn innermost(&self) -> Translated<Loop> {
        self.frame()?.loops.last().copied().ok_or_else(wrong_type)
    }

    fn choose(&mut self, condition: &'p Expr, then: &'p [Stmt], otherwise: &'p [Stmt]) -> Translated<bool> {
        let holds = self.condition(condition)?;
        let [yes, no, done] = [(); 3].map(|()| self.b.create_block());
        self.b.ins().brif(holds, yes, &[], no, &[]);
        let mut goes_on = false;
        for (block, body) in [(yes, then), (no, otherwise)] {
            self.continue_in(block);
            if self.branch(body)? {
                self.b.ins().jump(done, &[]);
                goes_on = true;
            }
        }
        self.go_on_in(done, goes_on);
        Ok(goes_on)
    }

    /// Goes on in a block that may turn out not to be reached.
    fn go_on_in(&mut self, block: Block, reached: bool) {
        if reached {
            self.continue_in(block);
        } else {
            self.b.seal_block(block);
        }
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

    fn repeat(
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

    fn for_set(&mut self, local: LocalId, set: &'p Expr, body: &'p [Stmt]) -> Translated<()> {
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

    fn for_ring(&mut self, local: LocalId, ring: &'p Ring, body: &'p [Stmt]) -> Translated<()> {
        let span = ring.vertex.span;
        let v = self.ring_owner(ring)?;
        let effects = self.unit.facts.effects_of(body, &[], None);
        let moves = if ring.old { effects.synchronizes } else { effects.edits };
        let exit = self.b.create_block();
        if moves {
            let of_old = self.int32(u32::from(ring.old));
            let start = self.call(Symbol::Walk, &[v, of_old]).ok_or_else(wrong_type)?;
            let none = self.b.ins().icmp_imm_s(IntCC::Equal, start, -1);
            self.fail_if(none);
            let end = self.load_context(types::I64, context::WALK_LEN);
            self.forget(effects);
            self.walk(local, start, end, span, Walk::Ring(start), exit, body, |t, at| {
                // The buffer may move while a round copies another ring.
                let base = t.load_context(types::I64, context::WALK);
                let offset = t.b.ins().ishl_imm_u(at, 2);
                let address = t.b.ins().iadd(base, offset);
                let flags = t.regions.members;
                t.b.ins().load(types::I32, flags, address, 0)
            })?;
            self.continue_in(exit);
            self.store_context(start, context::WALK_LEN);
            return Ok(());
        }
        let bounds = self.bounds(v, ring.old);
        let bytes = self.bytes_of(bounds.len);
        let end = self.b.ins().iadd(bounds.start, bytes);
        self.forget(effects);
        let flags = if ring.old { self.regions.old } else { self.regions.slots };
        let old = ring.old;
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

    /// Walks from `first` to `end`, addresses of vertices or, for copied rings, numbers. `load` gives the vertex.
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
        let stride = if matches!(walk, Walk::Ring(_)) { 1 } else { 4 };
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
            let second = self.b.ins().iadd_imm_s(first, stride);
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
        let after = self.b.ins().iadd_imm_s(at, stride);
        let last = self.b.ins().icmp(IntCC::Equal, after, end);
        self.b.ins().brif(last, exit, &[], round, &[after.into()]);
        self.b.seal_block(round);
        Ok(())
    }

    /// `return`: gives back what open loops hold, and leaves the function or the code that stands in for it.
    fn leave(&mut self, value: Option<&'p Expr>) -> Translated<bool> {
        let value = match value {
            Some(e) if e.ty == Type::Mesh => {
                let (set, mark) = self.set(e)?;
                self.call_or_fail(Symbol::SetReturn, &[set]);
                self.drop_sets(mark);
                Val::Void
            }
            Some(e) if self.mutated(Mutation::ReturnsEarlier) => {
                let Type::Value(ty) = e.ty else { return Err(wrong_type()) };
                self.constant(mesh::Value::zero(ty))?
            }
            Some(e) => self.expression(e)?,
            None => Val::Void,
        };
        let walks: Vec<Walk> = self.frame()?.loops.iter().map(|l| l.walk).collect();
        let sets = walks.iter().find_map(|w| if let Walk::Set(depth) = w { Some(*depth) } else { None });
        let rings = walks.iter().find_map(|w| if let Walk::Ring(start) = w { Some(*start) } else { None });
        if let Some(depth) = sets {
            self.call(Symbol::SetWalkEnd, &[depth]);
        }
        if let Some(start) = rings {
            self.store_context(start, context::WALK_LEN);
        }
        let frame = self.frame()?;
        let (inlined, exit, result) = (frame.call.is_some(), frame.exit, frame.result.clone());
        if inlined {
            for (&variable, &part) in result.iter().zip(value.parts()) {
                self.b.def_var(variable, part);
            }
            return Ok(match exit {
                Some(exit) => {
                    self.b.ins().jump(exit, &[]);
                    false
                }
                None => true,
            });
        }
        self.store_words(value);
        self.leave_function();
        Ok(false)
    }

    /// `add`: pushes in line where the vertex is larger than all members and there is room.
    fn add(&mut self, v: Value, set: Value) {
        let sets = self.load_context(types::I64, context::SETS);
        let index = self.b.ins().uextend(types::I64, set);
        let offset = self.b.ins().imul_imm_s(index, context::SET_SIZE);
        let set_address = self.b.ins().iadd(sets, offset);
        let flags = self.regions.sets;
        let len = self.b.ins().load(types::I64, flags, set_address, context::SET_LEN);
        let capacity = self.b.ins().load(types::I64, flags, set_address, context::SET_CAPACITY);
        let last = self.b.ins().load(types::I64, flags, set_address, context::SET_LAST);
        let wide = self.b.ins().uextend(types::I64, v);
        let above = self.b.ins().icmp(IntCC::UnsignedGreaterThan, wide, last);
        let room = self.b.ins().icmp(IntCC::UnsignedLessThan, len, capacity);
        let push = self.b.ins().band(above, room);
        let [fast, slow, done] = [(); 3].map(|()| self.b.create_block());
        self.b.set_cold_block(slow);
        self.b.ins().brif(push, fast, &[], slow, &[]);
        self.continue_in(fast);
        let order = self.b.ins().load(types::I64, flags, set_address, context::SET_ORDER);
        let bytes = self.b.ins().ishl_imm_u(len, 2);
        let place = self.b.ins().iadd(order, bytes);
        let members = self.regions.members;
        self.b.ins().store(members, v, place, 0);
        let len = self.b.ins().iadd_imm_s(len, 1);
        self.b.ins().store(flags, len, set_address, context::SET_LEN);
        self.b.ins().store(flags, wide, set_address, context::SET_LAST);
        self.b.ins().jump(done, &[]);
        self.continue_in(slow);
        self.call_or_fail(Symbol::SetAdd, &[set, v]);
        self.b.ins().jump(done, &[]);
        self.continue_in(done);
    }

    fn print(&mut self, items: &'p [PrintItem], span: Span) -> Translated<()> {
        self.call(Symbol::PrintBegin, &[]);
        for item in items {
            match item {
                PrintItem::Text(text) => {
                    self.unit.texts.push(text.clone());
                    let index = self.int32(self.unit.texts.len() as u32 - 1);
                    if !self.mutated(Mutation::PrintsNoText) {
                        self.call(Symbol::PrintText, &[index]);
                    }
                }
                PrintItem::Value(e) if e.ty == Type::Mesh => {
                    let (set, mark) = self.set(e)?;
                    self.call_or_fail(Symbol::PrintSet, &[set]);
                    self.drop_sets(mark);
                }
                PrintItem::Value(e) => {
                    let Type::Value(ty) = e.ty else { return Err(wrong_type()) };
                    let value = self.expression(e)?;
                    self.store_words(value);
                    let number = self.int32(crate::engine::native::run::type_number(ty));
                    self.call(Symbol::PrintValue, &[number]);
                }
            }
        }
        let result = self.call(Symbol::PrintEnd, &[]).ok_or_else(wrong_type)?;
        let closed = self.b.ins().icmp_imm_s(IntCC::Equal, result, i64::from(status::CLOSED));
        let [left, next] = [(); 2].map(|()| self.b.create_block());
        self.b.set_cold_block(left);
        self.b.ins().brif(closed, left, &[], next, &[]);
        self.continue_in(left);
        self.leave_with(status::CLOSED, span);
        self.continue_in(next);
        self.fail_if(result);
        Ok(())
    }

    /// Index of the set that an expression of type mesh names, and how many sets to keep when it is no longer needed.
    pub(super) fn set(&mut self, e: &'p Expr) -> Translated<(Value, Option<Value>)> {
        if let ExprKind::Local(local) = e.kind {
            return Ok((self.set_of(local)?, None));
        }
        let mark = self.load_context(types::I64, context::SET_COUNT);
        let index = match &e.kind {
            ExprKind::Conditional(condition, a, b) => {
                let holds = self.condition(condition)?;
                let [yes, no] = [(); 2].map(|()| self.b.create_block());
                let (done, index) = self.block_with(&[types::I32]);
                self.b.ins().brif(holds, yes, &[], no, &[]);
                for (block, arm) in [(yes, a), (no, b)] {
                    self.continue_in(block);
                    self.known.enter();
                    let (arm, _) = self.set(arm)?;
                    self.known.leave();
                    self.jump_with(done, &[arm]);
                }
                self.continue_in(done);
                index[0]
            }
            ExprKind::Call(function, arguments) => {
                self.call_function(*function, arguments, e.span)?;
                let index = self.call(Symbol::SetTake, &[]).ok_or_else(wrong_type)?;
                self.fail_if_no_set(index);
                index
            }
            _ => return Err(wrong_type()),
        };
        Ok((index, Some(mark)))
    }

    pub(super) fn drop_sets(&mut self, mark: Option<Value>) {
        if let Some(mark) = mark {
            self.call(Symbol::SetDrop, &[mark]);
        }
    }

    /// Whether a variable is declared as one whose address is known.
    pub(super) fn address_of(&self, local: LocalId) -> Translated<Storage> {
        self.storage(local)
    }
}

/// Whether a statement is sure to leave the mesh as it is and to run once: a declaration that only computes.
fn is_quiet(s: &Stmt) -> bool {
    match &s.kind {
        StmtKind::Block(body) => body.iter().all(is_quiet),
        StmtKind::Declare { init, .. } => {
            let mut quiet = true;
            if let Some(e) = init {
                each_in(e, &mut |node| {
                    if let Node::Expr(e) = node {
                        use ExprKind::{Assign, Call, Create, Step};
                        quiet &= !matches!(e.kind, Call(..) | Create | Assign { .. } | Step(..));
                    }
                });
            }
            quiet
        }
        _ => false,
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
