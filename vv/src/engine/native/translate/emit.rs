//! What all translation is made of: blocks, calls of the runtime, places where a run may end.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, BlockArg, FuncRef, InstBuilder, MemFlagsData, Type as ClifType, Value, types};
use cranelift_module::{FuncId, Module};

use super::{Site, Symbol, Translator};
use crate::engine::native::context::{self, status};
use crate::source::Span;

impl Translator<'_, '_> {
    /// Goes on in a new block unless `bad` holds, which fails.
    pub(super) fn fail_if(&mut self, bad: Value) {
        let fail = self.fail;
        self.leave_if(bad, fail);
    }

    /// As [`Translator::fail_if`], behind work that asks itself whether the run shall stop: if it gave up for that, the run is
    /// stopped here.
    pub(super) fn fail_or_stop_if(&mut self, bad: Value, span: Span) {
        let [ask, next] = [(); 2].map(|()| self.b.create_block());
        self.b.set_cold_block(ask);
        self.b.ins().brif(bad, ask, &[], next, &[]);
        self.continue_in(ask);
        self.poll(span);
        let fail = self.fail;
        self.b.ins().jump(fail, &[]);
        self.continue_in(next);
    }

    pub(super) fn leave_if(&mut self, bad: Value, to: Block) {
        let next = self.b.create_block();
        if self.b.current_block().is_some_and(|block| self.b.func.layout.is_cold(block)) {
            self.b.set_cold_block(next);
        }
        self.b.ins().brif(bad, to, &[], next, &[]);
        self.b.switch_to_block(next);
        self.b.seal_block(next);
    }

    /// Calls a runtime function, whose first operand is the context.
    pub(super) fn call(&mut self, symbol: Symbol, operands: &[Value]) -> Option<Value> {
        let mut all = vec![self.context];
        all.extend_from_slice(operands);
        let id = self.unit.symbols.get(&symbol).copied()?;
        let function = self.function_ref(id);
        let call = self.b.ins().call(function, &all);
        self.b.inst_results(call).first().copied()
    }

    /// How the function that is being translated names another.
    pub(super) fn function_ref(&mut self, id: FuncId) -> FuncRef {
        let (module, func) = (&mut *self.module, &mut *self.b.func);
        *self.symbol_refs.entry(id).or_insert_with(|| module.declare_func_in_func(id, func))
    }

    /// Calls a runtime function that returns a status, and fails where that is not zero.
    pub(super) fn call_or_fail(&mut self, symbol: Symbol, operands: &[Value]) {
        if let Some(status) = self.call(symbol, operands) {
            self.fail_if(status);
        }
    }

    /// As [`Translator::call_or_fail`], of one that asks whether the run shall stop.
    pub(super) fn call_or_fail_or_stop(&mut self, symbol: Symbol, operands: &[Value], span: Span) {
        if let Some(status) = self.call(symbol, operands) {
            self.fail_or_stop_if(status, span);
        }
    }

    pub(super) fn new_set(&mut self) -> Value {
        match self.call(Symbol::SetNew, &[]) {
            Some(index) => {
                self.fail_if_no_set(index);
                index
            }
            None => self.int32(0),
        }
    }

    pub(super) fn fail_if_no_set(&mut self, index: Value) {
        let none = self.b.ins().icmp_imm_s(IntCC::Equal, index, -1);
        self.fail_if(none);
    }

    /// A place where the code may be stopped.
    pub(super) fn site(&mut self, span: Span) -> u32 {
        let calls = self.frames.iter().rev().filter_map(|f| Some((f.function.name.clone(), f.call?))).collect();
        self.unit.sites.push(Site { span, function: self.name.clone(), calls });
        self.unit.sites.len() as u32 - 1
    }

    /// Asks whether the run shall stop, and in rounds of a parallel loop whether others have made it give up.
    pub(super) fn poll(&mut self, span: Span) {
        self.poll_for(span, self.watches);
    }

    /// Asks whether the run shall stop, in a loop that comes to its end: others that have made it give up can wait for that.
    pub(super) fn poll_in_walk(&mut self, span: Span) {
        self.poll_for(span, false);
    }

    fn poll_for(&mut self, span: Span, watches: bool) {
        let flag = self.load_context(types::I64, context::STOP);
        // Another thread writes it, which the code generator does not know: where nothing is stored in between, it takes an
        // earlier load of the same place for this one. So each goes by an address of its own; x86 folds it away.
        let place = self.unit.sites.len() as i32;
        let base = self.b.ins().iadd_imm_s(flag, -i64::from(place));
        let mut stop = self.b.ins().load(types::I8, MemFlagsData::trusted(), base, place);
        if watches {
            let flag = self.load_context(types::I64, context::OVER);
            let base = self.b.ins().iadd_imm_s(flag, -i64::from(place));
            let over = self.b.ins().load(types::I8, MemFlagsData::trusted(), base, place);
            stop = self.b.ins().bor(stop, over);
        }
        let stopped = self.b.create_block();
        self.b.set_cold_block(stopped);
        let next = self.b.create_block();
        if self.b.current_block().is_some_and(|block| self.b.func.layout.is_cold(block)) {
            self.b.set_cold_block(next);
        }
        self.b.ins().brif(stop, stopped, &[], next, &[]);
        self.b.switch_to_block(stopped);
        self.b.seal_block(stopped);
        self.leave_with(status::STOPPED, span);
        self.b.switch_to_block(next);
        self.b.seal_block(next);
    }

    /// Leaves the function with a status that has a place.
    pub(super) fn leave_with(&mut self, status: u32, span: Span) {
        let site = self.site(span);
        let site = self.b.ins().iconst(types::I64, i64::from(site));
        self.store_context(site, context::SITE);
        let status = self.int32(status);
        self.b.ins().return_(&[status]);
    }

    /// A block that takes values of these types.
    pub(super) fn block_with(&mut self, types: &[ClifType]) -> (Block, Vec<Value>) {
        let block = self.b.create_block();
        let values = types.iter().map(|&t| self.b.append_block_param(block, t)).collect();
        (block, values)
    }

    pub(super) fn jump_with(&mut self, block: Block, values: &[Value]) {
        let values: Vec<BlockArg> = values.iter().map(|&v| BlockArg::Value(v)).collect();
        self.b.ins().jump(block, &values);
    }

    pub(super) fn continue_in(&mut self, block: Block) {
        self.b.switch_to_block(block);
        self.b.seal_block(block);
    }
}
