//! Variables of type ring: lists of vertices, kept by the runtime as long as the function that declares them runs. Their
//! ends are edited in line.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{InstBuilder, Value, types};

use super::known::Bounds;
use super::{Storage, Symbol, Translated, Translator, wrong_type};
use crate::engine::native::Mutation;
use crate::engine::native::context;
use crate::ir::{Expr, ExprKind, LocalId};
use crate::source::Span;

impl<'p> Translator<'_, 'p> {
    pub(super) fn new_list(&mut self) -> Value {
        match self.call(Symbol::ListNew, &[]) {
            Some(index) => {
                self.fail_if_no_set(index);
                index
            }
            None => self.int32(0),
        }
    }

    pub(super) fn drop_lists(&mut self, mark: Option<Value>) {
        if let Some(mark) = mark {
            self.call(Symbol::ListDrop, &[mark]);
        }
    }

    /// Index of the list behind a variable.
    pub(super) fn list_of(&self, local: LocalId) -> Translated<Value> {
        match self.storage(local)? {
            Storage::List(index) => Ok(index),
            _ => Err(wrong_type()),
        }
    }

    /// Where the vertices of a variable lie.
    pub(super) fn list_bounds(&mut self, local: LocalId) -> Translated<Bounds> {
        match self.storage(local)? {
            Storage::Face(bounds, _) => Ok(bounds),
            Storage::List(index) => Ok(self.bounds_of_list(index)),
            _ => Err(wrong_type()),
        }
    }

    pub(super) fn declare_list(&mut self, local: LocalId, init: Option<&'p Expr>) -> Translated<()> {
        match init {
            Some(e) => self.assign_list(local, e),
            None => {
                let index = self.list_of(local)?;
                let list = self.list_address(index);
                let zero = self.b.ins().iconst(types::I64, 0);
                let flags = self.regions.lists;
                self.b.ins().store(flags, zero, list, context::LIST_LEN);
                Ok(())
            }
        }
    }

    pub(super) fn assign_list(&mut self, local: LocalId, value: &'p Expr) -> Translated<()> {
        let (Bounds { start, len, .. }, mark) = self.list(value)?;
        let index = self.list_of(local)?;
        if !self.mutated(Mutation::AssignsNoRing) {
            self.call_or_fail(Symbol::ListAssign, &[index, start, len]);
        }
        self.drop_lists(mark);
        Ok(())
    }

    /// `add v to r`
    pub(super) fn append(&mut self, vertex: &'p Expr, ring: LocalId) -> Translated<()> {
        let v = self.vertex_not_null(vertex)?;
        let index = self.list_of(ring)?;
        if self.mutated(Mutation::AppendsNothing) {
            return Ok(());
        }
        let list = self.list_address(index);
        let flags = self.regions.lists;
        let len = self.b.ins().load(types::I64, flags, list, context::LIST_LEN);
        let capacity = self.b.ins().load(types::I64, flags, list, context::LIST_CAPACITY);
        let room = self.b.ins().icmp(IntCC::UnsignedLessThan, len, capacity);
        let [fast, slow, done] = [(); 3].map(|()| self.b.create_block());
        self.b.set_cold_block(slow);
        self.b.ins().brif(room, fast, &[], slow, &[]);
        self.continue_in(fast);
        let start = self.b.ins().load(types::I64, flags, list, context::LIST_START);
        let bytes = self.b.ins().ishl_imm_u(len, 2);
        let place = self.b.ins().iadd(start, bytes);
        let listed = self.regions.listed;
        self.b.ins().store(listed, v, place, 0);
        let len = self.b.ins().iadd_imm_s(len, 1);
        self.b.ins().store(flags, len, list, context::LIST_LEN);
        self.b.ins().jump(done, &[]);
        self.continue_in(slow);
        self.call_rarely_or_fail(Symbol::ListPush, &[index, v])?;
        self.b.ins().jump(done, &[]);
        self.continue_in(done);
        Ok(())
    }

    /// Edits a list in the runtime.
    pub(super) fn edit_list(&mut self, symbol: Symbol, operands: &[Value]) -> Translated<()> {
        if !self.mutated(Mutation::EditsNoRing) {
            self.call_or_fail(symbol, operands);
        }
        Ok(())
    }

    /// Where the vertices lie that an expression of type ring names, and how many lists to keep when they are no longer
    /// needed.
    pub(super) fn list(&mut self, e: &'p Expr) -> Translated<(Bounds, Option<Value>)> {
        if let ExprKind::Local(local) = e.kind {
            return Ok((self.list_bounds(local)?, None));
        }
        let mark = self.load_context(types::I64, context::LIST_COUNT);
        let bounds = match &e.kind {
            ExprKind::Conditional(condition, a, b) => {
                let holds = self.condition(condition)?;
                let [yes, no] = [(); 2].map(|()| self.b.create_block());
                let (done, result) = self.block_with(&[types::I64, types::I32]);
                self.b.ins().brif(holds, yes, &[], no, &[]);
                for (block, arm) in [(yes, a), (no, b)] {
                    self.continue_in(block);
                    self.known.enter();
                    let (Bounds { start, len, .. }, _) = self.list(arm)?;
                    self.known.leave();
                    self.jump_with(done, &[start, len]);
                }
                self.continue_in(done);
                Bounds { start: result[0], len: result[1], flags: self.regions.listed }
            }
            ExprKind::Call(function, arguments) => {
                self.call_function(*function, arguments, e.span)?;
                let index = self.call(Symbol::ListTake, &[]).ok_or_else(wrong_type)?;
                self.fail_if_no_set(index);
                self.bounds_of_list(index)
            }
            _ => return Err(wrong_type()),
        };
        Ok((bounds, Some(mark)))
    }

    /// A list of its own with what an expression of type ring names.
    pub(super) fn copied_list(&mut self, e: &'p Expr) -> Translated<Value> {
        let (Bounds { start, len, .. }, _) = self.list(e)?;
        let index = self.call(Symbol::ListCopy, &[start, len]).ok_or_else(wrong_type)?;
        self.fail_if_no_set(index);
        Ok(index)
    }

    pub(super) fn return_list(&mut self, e: &'p Expr) -> Translated<()> {
        let (Bounds { start, len, .. }, mark) = self.list(e)?;
        self.call_or_fail(Symbol::ListReturn, &[start, len]);
        self.drop_lists(mark);
        Ok(())
    }

    pub(super) fn print_list(&mut self, e: &'p Expr, span: Span) -> Translated<()> {
        let (Bounds { start, len, .. }, mark) = self.list(e)?;
        self.call_or_fail_or_stop(Symbol::PrintList, &[start, len], span);
        self.drop_lists(mark);
        Ok(())
    }

    fn list_address(&mut self, index: Value) -> Value {
        let lists = self.load_context(types::I64, context::LISTS);
        let index = self.b.ins().uextend(types::I64, index);
        let offset = self.b.ins().imul_imm_s(index, context::LIST_SIZE);
        self.b.ins().iadd(lists, offset)
    }

    fn bounds_of_list(&mut self, index: Value) -> Bounds {
        let list = self.list_address(index);
        let flags = self.regions.lists;
        let start = self.b.ins().load(types::I64, flags, list, context::LIST_START);
        // No list has more vertices than an i32 can count.
        let len = self.b.ins().load(types::I32, flags, list, context::LIST_LEN);
        Bounds { start, len, flags: self.regions.listed }
    }
}
