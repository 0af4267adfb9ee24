//! Statements. Each says whether what follows it can be reached.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, InstBuilder, types};

use super::{Loop, Storage, Symbol, Translated, Translator, Val, Walk, wrong_type};
use crate::engine::native::Mutation;
use crate::engine::native::context::{self, status};
use crate::engine::native::pristine::{is_quiet, quiet_call};
use crate::engine::native::{RED_ZONE, STACK_SEGMENT};
use crate::ir::{Expr, ExprKind, LocalId, PrintItem, Stmt, StmtKind, Type};
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
        self.pristine &= is_quiet(s)
            || matches!(s.kind, StmtKind::Block(_) | StmtKind::Synchronize(_))
            || quiet_call(s).is_some_and(|f| self.unit.facts.function(f).is_some_and(|f| f.pristine));
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
            StmtKind::ForallSet { parallel, local, set, body } => {
                self.for_set(*parallel, *local, set, body)?;
            }
            StmtKind::ForallRing { local, follower, ring, from, body } => {
                self.for_ring(*local, *follower, ring, from.as_ref(), body)?;
            }
            StmtKind::ForallFaces { local, set, body } => self.for_faces(*local, set, body)?,
            StmtKind::MakeRing { ring, of } => self.make_ring(*ring, of)?,
            StmtKind::Append { vertex, ring } => self.append(vertex, *ring)?,
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
                let mut pristine = std::mem::take(&mut self.pristine) && matches!(set.kind, ExprKind::Local(_));
                pristine |= self.mutated(Mutation::OldIsAsItCame);
                let (set, mark) = self.set(set)?;
                let pristine = self.int32(u32::from(pristine));
                self.call_or_fail_or_stop(Symbol::Synchronize, &[set, pristine], s.span);
                self.drop_sets(mark);
                self.known.forget_rings(false);
                self.known.forget_rings(true);
            }
            StmtKind::Add { vertex, set } => {
                let v = self.vertex_not_null(vertex)?;
                let set = self.set_of(*set)?;
                if !self.mutated(Mutation::AddsNoMember) {
                    self.add(v, set)?;
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
                    Some(e) => {
                        self.prepare(e)?;
                        self.expression(e)?
                    }
                    None => self.constant(mesh::Value::zero(ty))?,
                };
                self.define_local(local, value)?;
            }
            Type::Ring => self.declare_list(local, init)?,
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

    /// `return`: gives back what open loops hold, and leaves the function or the code that stands in for it.
    fn leave(&mut self, value: Option<&'p Expr>) -> Translated<bool> {
        let value = match value {
            Some(e) if e.ty == Type::Mesh => {
                let (set, mark) = self.set(e)?;
                self.call_or_fail(Symbol::SetReturn, &[set]);
                self.drop_sets(mark);
                Val::Void
            }
            Some(e) if e.ty == Type::Ring => {
                self.return_list(e)?;
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
        let faces = walks.iter().find_map(|w| if let Walk::Faces(depth) = w { Some(*depth) } else { None });
        let rings = walks.iter().find_map(|w| if let Walk::Ring(count) = w { Some(*count) } else { None });
        if let Some(depth) = sets {
            self.call(Symbol::SetWalkEnd, &[depth]);
        }
        if let Some(depth) = faces {
            self.call(Symbol::FacesEnd, &[depth]);
        }
        if let Some(count) = rings {
            self.store_context(count, context::WALK_COUNT);
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
                    self.call_or_fail_or_stop(Symbol::PrintSet, &[set], span);
                    self.drop_sets(mark);
                }
                PrintItem::Value(e) if e.ty == Type::Ring => self.print_list(e, span)?,
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

    /// Whether a variable is declared as one whose address is known.
    pub(super) fn address_of(&self, local: LocalId) -> Translated<Storage> {
        self.storage(local)
    }
}
