//! Loops.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, InstBuilder, MemFlagsData, StackSlotData, StackSlotKind, Value, types};

use super::known::{Bounds, Fact, Found, Key};
use super::ring::Source;
use super::{Loop, Orbit, Storage, Symbol, Translated, Translator, Val, Walk, wrong_type};
use crate::engine::native::Mutation;
use crate::engine::native::ahead::{Ahead, Touched};
use crate::engine::native::context;
use crate::engine::native::effects::Effects;
use crate::ir::visit::{Node, each, each_in};
use crate::ir::{Expr, ExprKind, From, LocalId, Place, Ring, Stmt, StmtKind, Type};
use crate::source::Span;

/// What a loop goes through: vertices from `first` to `end`, addresses.
pub(super) struct Rounds {
    local: LocalId,
    /// For what follows `local`.
    follower: Option<LocalId>,
    first: Value,
    end: Value,
    /// Where it begins and, once round, ends, if not at `first`.
    begin: Option<Value>,
    flags: MemFlagsData,
    /// Whether there may be gaps.
    gaps: bool,
    /// Whether a round takes so little that the whole loop is over before anybody waits for it, but for what is left to the
    /// runtime.
    brief: bool,
    span: Span,
}

impl Rounds {
    /// Through members of a set.
    pub(super) fn over_set(local: LocalId, first: Value, end: Value, flags: MemFlagsData, span: Span) -> Self {
        Self { local, follower: None, first, end, begin: None, flags, gaps: true, brief: false, span }
    }
}

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

    pub(super) fn for_set(
        &mut self,
        parallel: bool,
        local: LocalId,
        set: &'p Expr,
        body: &'p [Stmt],
    ) -> Translated<()> {
        let span = set.span;
        let (index, mark) = self.set(set)?;
        let depth = self.call(Symbol::SetWalk, &[index]).ok_or_else(wrong_type)?;
        let none = self.b.ins().icmp_imm_s(IntCC::Equal, depth, -1);
        self.fail_if(none);
        let first = self.load_context(types::I64, context::VALUE);
        let count = self.load_context(types::I64, context::VALUE + 8);
        self.drop_sets(mark);
        if parallel && self.call_rounds(local, body, first, count, span)? {
            self.call(Symbol::SetWalkEnd, &[depth]);
            return Ok(());
        }
        let bytes = self.b.ins().ishl_imm_u(count, 2);
        let end = self.b.ins().iadd(first, bytes);
        self.forget(self.unit.facts.effects_of(body, &[], None));
        let exit = self.b.create_block();
        let flags = self.regions.members;
        let rounds = Rounds::over_set(local, first, end, flags, span);
        let ahead = Ahead::of_set(self.program, local, body);
        let ask = |t: &mut Self, at| t.ask_ahead(&ahead, at, end, flags);
        let before = self.in_turn;
        self.walk(&rounds, Walk::Set(depth), exit, body, ask, |t, sides| t.in_turn = sides.first().map(|&(v, _)| v))?;
        self.in_turn = before;
        self.continue_in(exit);
        self.call(Symbol::SetWalkEnd, &[depth]);
        Ok(())
    }

    pub(super) fn for_ring(
        &mut self,
        local: LocalId,
        follower: Option<LocalId>,
        ring: &'p Ring,
        from: Option<&'p From>,
        body: &'p [Stmt],
    ) -> Translated<()> {
        let span = ring.span();
        let source = self.source(ring)?;
        let corner = match from {
            Some(from) => Some(self.corner(from)?),
            None => None,
        };
        let mut bounds = self.bounds_of(source)?;
        let begin = match corner {
            Some((p, q)) => Some(self.place_of(p, q, bounds)?),
            None => None,
        };
        let effects = self.unit.facts.effects_of(body, &[], None);
        let (moves, gaps) = match source {
            Source::Of { old: true, .. } => (effects.synchronizes, true),
            Source::Of { old: false, .. } => (effects.edits, true),
            Source::Variable(local) => {
                let face = matches!(self.storage(local)?, Storage::Face(..));
                (effects.lists && !face, false)
            }
        };
        let orbit = match source {
            Source::Variable(local) => matches!(self.storage(local)?, Storage::Face(_, Orbit::Yes)),
            Source::Of { .. } => false,
        };
        let exit = self.b.create_block();
        let bytes = self.bytes_of(bounds.len);
        let (walk, begin) = if moves {
            let count = self.load_context(types::I64, context::WALK_COUNT);
            let start = bounds.start;
            bounds = self.copy_ring(bounds)?;
            let begin = begin.map(|begin| {
                let at = self.b.ins().isub(begin, start);
                self.b.ins().iadd(bounds.start, at)
            });
            (Walk::Ring(count), begin)
        } else {
            (Walk::Nothing, begin)
        };
        let Bounds { start: first, flags, .. } = bounds;
        let end = self.b.ins().iadd(first, bytes);
        self.forget(effects);
        let rounds = Rounds { local, follower, first, end, begin, flags, gaps, brief: is_brief(body), span };
        let corners = if orbit && begin.is_none() { std::mem::take(&mut self.corners) } else { Touched::default() };
        let mut positions = [false; 2];
        if let (Ring::Of { vertex, old }, Source::Of { v, .. }) = (ring, source)
            && let ExprKind::Local(vertex) = vertex.kind
            && self.in_turn == Some(v)
            && !moves
        {
            let locals: Vec<LocalId> = std::iter::once(local).chain(follower).collect();
            positions = Ahead::of_ring(self.program, vertex, *old, &locals, body).positions;
        }
        let ask = |t: &mut Self, at| {
            t.ask_for_corners(corners, at, flags);
            t.ask_for_positions(positions, at, flags);
        };
        self.walk(&rounds, walk, exit, body, ask, |t, sides| {
            if let Source::Of { v, .. } = source {
                for &(x, _) in sides {
                    t.known.learn_that_differ(x, v);
                }
            }
            match source {
                Source::Of { v, old } if !moves => {
                    for &(x, at) in sides {
                        let here = Some((at, end));
                        let at = t.b.ins().isub(at, first);
                        let found = Found { start: first, bytes, at, here, certain: true, flags };
                        t.known.learn(Key::Find { x, v, old }, Fact::Found(found));
                    }
                }
                // A side of a face is a slot of its vertex' ring, in which its end stands once.
                Source::Variable(_) if orbit => {
                    if let &[(p, at), (q, _)] = sides {
                        t.known.learn(Key::Side { p, q, start: first }, Fact::At(at));
                    }
                }
                _ => {}
            }
        })?;
        self.continue_in(exit);
        if let Walk::Ring(count) = walk {
            self.store_context(count, context::WALK_COUNT);
        }
        Ok(())
    }

    /// Where a loop begins: at a vertex, perhaps where another follows.
    fn corner(&mut self, from: &'p From) -> Translated<(Value, Option<Value>)> {
        let p = self.vertex_not_null(&from.corner)?;
        let q = match &from.next {
            Some(q) => Some(self.vertex_not_null(q)?),
            None => None,
        };
        Ok((p, q))
    }

    /// Address of the first place in a ring where `p` stands, and where `q` follows it, or fails.
    fn place_of(&mut self, p: Value, q: Option<Value>, Bounds { start, len, .. }: Bounds) -> Translated<Value> {
        if self.mutated(Mutation::BeginsAtTheStart) {
            return Ok(start);
        }
        if let Some(q) = q
            && let Some(Fact::At(at)) = self.known.get(Key::Side { p, q, start })
        {
            return Ok(at);
        }
        let next = self.or_null(q);
        let index = self.call(Symbol::ListBegin, &[start, len, p, next]).ok_or_else(wrong_type)?;
        let none = self.b.ins().icmp_imm_s(IntCC::SignedLessThan, index, 0);
        self.fail_if(none);
        let at = self.bytes_of(index);
        Ok(self.b.ins().iadd(start, at))
    }

    /// Copies a ring to where no edit reaches it: into the function's frame if it is short.
    fn copy_ring(&mut self, Bounds { start, len, flags }: Bounds) -> Translated<Bounds> {
        let longest = self.widths().iter().fold(0, |a, &b| a.max(b)) as u32;
        let frame = self.b.create_sized_stack_slot(StackSlotData::new(StackSlotKind::ExplicitSlot, 4 * longest, 4));
        let copy = self.b.ins().stack_addr(types::I64, frame, 0);
        let (ready, address) = self.block_with(&[types::I64]);
        let slow = self.b.create_block();
        self.b.set_cold_block(slow);
        self.by_width(self.widths(), len, 0, slow, |t, width| {
            let locals = t.regions.locals;
            for (k, lane) in t.lanes(start, width, flags).into_iter().enumerate() {
                t.b.ins().store(locals, lane, copy, 16 * k as i32);
            }
            t.jump_with(ready, &[copy]);
        });
        self.continue_in(slow);
        self.call_rarely_or_fail(Symbol::Walk, &[start, len])?;
        let address_of_long = self.load_context(types::I64, context::VALUE);
        self.jump_with(ready, &[address_of_long]);
        self.continue_in(ready);
        Ok(Bounds { start: address[0], len, flags: self.regions.locals })
    }

    pub(super) fn for_faces(&mut self, local: LocalId, set: &'p Expr, body: &'p [Stmt]) -> Translated<()> {
        let (index, mark) = self.set(set)?;
        let depth = self.call(Symbol::Faces, &[index]).ok_or_else(wrong_type)?;
        let none = self.b.ins().icmp_imm_s(IntCC::Equal, depth, -1);
        self.fail_or_stop_if(none, set.span);
        let [corners, ends, last] = [0, 8, 16].map(|k| self.load_context(types::I64, context::VALUE + k));
        self.drop_sets(mark);
        self.forget(self.unit.facts.effects_of(body, &[], None));
        let zero = self.int32(0);
        let (round, at) = self.block_with(&[types::I64, types::I32]);
        let (at, begin) = (at[0], at[1]);
        let [next, exit] = [(); 2].map(|()| self.b.create_block());
        let empty = self.b.ins().icmp(IntCC::Equal, ends, last);
        self.b.ins().brif(empty, exit, &[], round, &[ends.into(), zero.into()]);
        self.b.switch_to_block(round);
        self.known.enter();
        let flags = self.regions.listed;
        let end = self.b.ins().load(types::I32, flags, at, 0);
        if self.mutated(Mutation::ForgetsTheSecondFace) {
            let second = self.b.ins().iadd_imm_s(ends, 4);
            let skip = self.b.ins().icmp(IntCC::Equal, at, second);
            self.leave_if(skip, next);
        }
        self.poll(set.span);
        let bytes = self.bytes_of(begin);
        let start = self.b.ins().iadd(corners, bytes);
        let len = self.b.ins().isub(end, begin);
        if let Some(storage) = self.frame_mut()?.storage.get_mut(local.0 as usize) {
            *storage = Storage::Face(Bounds { start, len, flags }, Orbit::Yes);
        }
        self.frame_mut()?.loops.push(Loop { next, exit, walk: Walk::Faces(depth) });
        let before = std::mem::replace(&mut self.corners, Ahead::of_faces(self.program, local, body).corners);
        let goes_on = self.block(body)?;
        self.corners = before;
        self.frame_mut()?.loops.pop();
        if goes_on {
            self.b.ins().jump(next, &[]);
        }
        self.known.leave();
        self.continue_in(next);
        let after = self.b.ins().iadd_imm_s(at, 4);
        let done = self.b.ins().icmp(IntCC::Equal, after, last);
        self.b.ins().brif(done, exit, &[], round, &[after.into(), end.into()]);
        self.b.seal_block(round);
        self.continue_in(exit);
        self.call(Symbol::FacesEnd, &[depth]);
        Ok(())
    }

    /// Goes through vertices. `ask` begins each round, with its address; `learn` is told each with its address, and the follower with its own.
    pub(super) fn walk(
        &mut self,
        rounds: &Rounds,
        walk: Walk,
        exit: Block,
        body: &'p [Stmt],
        ask: impl FnOnce(&mut Self, Value),
        learn: impl FnOnce(&mut Self, &[(Value, Value)]),
    ) -> Translated<()> {
        let &Rounds { local, follower, first, end, begin, flags, gaps, brief, span } = rounds;
        let begin_at = begin.unwrap_or(first);
        let (round, at) = self.block_with(&[types::I64]);
        let at = at[0];
        let next = self.b.create_block();
        let empty = self.b.ins().icmp(IntCC::Equal, first, end);
        self.b.ins().brif(empty, exit, &[], round, &[begin_at.into()]);
        self.b.switch_to_block(round);
        self.known.enter();
        ask(self, at);
        let v = self.walked_vertex(at, flags, gaps, next);
        let mut sides = vec![(v, at)];
        if follower.is_some() {
            let mut after = self.after(at, first, end);
            if self.mutated(Mutation::FollowsItself) {
                after = at;
            }
            let q = self.walked_vertex(after, flags, gaps, next);
            sides.push((q, after));
        }
        if self.mutated(Mutation::LoopsSkipTheSecond) {
            let second = self.b.ins().iadd_imm_s(first, 4);
            let skip = self.b.ins().icmp(IntCC::Equal, at, second);
            self.leave_if(skip, next);
        }
        learn(self, &sides);
        if !brief {
            self.poll_in_walk(span);
        }
        for (local, &(x, _)) in std::iter::once(local).chain(follower).zip(&sides) {
            self.define_local(local, Val::One(x))?;
        }
        self.frame_mut()?.loops.push(Loop { next, exit, walk });
        let ask = std::mem::replace(&mut self.ask_rarely, brief.then_some(span));
        let goes_on = self.block(body)?;
        self.ask_rarely = ask;
        self.frame_mut()?.loops.pop();
        if goes_on {
            self.b.ins().jump(next, &[]);
        }
        self.known.leave();
        self.continue_in(next);
        let (after, last) = match begin {
            Some(begin) => (self.after(at, first, end), begin),
            None => (self.b.ins().iadd_imm_s(at, 4), end),
        };
        let done = self.b.ins().icmp(IntCC::Equal, after, last);
        self.b.ins().brif(done, exit, &[], round, &[after.into()]);
        self.b.seal_block(round);
        Ok(())
    }

    /// The vertex at an address, which is not null; a gap goes on to `next`.
    fn walked_vertex(&mut self, at: Value, flags: MemFlagsData, gaps: bool, next: Block) -> Value {
        let v = self.load_number(flags, at, 0);
        if gaps {
            let hole = self.b.ins().icmp_imm_s(IntCC::Equal, v, 0);
            self.leave_if(hole, next);
        }
        self.known.learn(Key::NotNull(v), Fact::Holds);
        v
    }

    /// The address before another, once round.
    pub(super) fn before(&mut self, at: Value, first: Value, end: Value) -> Value {
        let begins = self.b.ins().icmp(IntCC::Equal, at, first);
        let behind = self.b.ins().select(begins, end, at);
        self.b.ins().iadd_imm_s(behind, -4)
    }

    /// The address after another, once round.
    pub(super) fn after(&mut self, at: Value, first: Value, end: Value) -> Value {
        let after = self.b.ins().iadd_imm_s(at, 4);
        let last = self.b.ins().icmp(IntCC::Equal, after, end);
        self.b.ins().select(last, first, after)
    }

    /// What a loop does is forgotten before it begins, for it holds for its second round.
    fn forget(&mut self, effects: Effects) {
        if effects.edits {
            self.known.forget_rings(false);
            if !self.mutated(Mutation::ForgetsWhatLoopsPut) {
                self.known.forget_new();
            }
        }
        if effects.synchronizes {
            self.known.forget_rings(true);
        }
    }
}

/// Whether statements are over soon, without loops: what they do takes no longer where rings are long or the mesh is large,
/// but for what is left to the runtime now and then.
fn is_brief(body: &[Stmt]) -> bool {
    let mut brief = true;
    each(body, &mut |node| {
        brief &= match node {
            Node::Stmt(s) => {
                use StmtKind::{Add, Block, Break, Continue, Declare, Erase, Expr, If, Make, Replace, Splice};
                matches!(
                    s.kind,
                    Add { .. }
                        | Block(_)
                        | Break
                        | Continue
                        | Declare { .. }
                        | Erase { .. }
                        | Expr(_)
                        | If { .. }
                        | Make { .. }
                        | Replace { .. }
                        | Splice { .. }
                )
            }
            Node::Expr(e) => {
                let is_value = !matches!(e.ty, Type::Mesh | Type::Ring | Type::Void);
                is_value && !matches!(e.kind, ExprKind::Call(..))
            }
            Node::Place(place) => !matches!(place, Place::EdgeProperty { .. }),
            Node::Ring(ring) => matches!(ring, Ring::Of { .. }),
        };
    });
    brief
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
