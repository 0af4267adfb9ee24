//! Calls of functions of the program.

use cranelift_codegen::ir::{InstBuilder, Value, types};
use cranelift_module::Module;

use super::known::Bounds;
use super::{Frame, Orbit, Storage, Symbol, Translated, Translator, Val, clif_types, wrong_type};
use crate::engine::native::Mutation;
use crate::engine::native::context;
use crate::engine::native::effects::Keeping;
use crate::ir::visit::{Node, each};
use crate::ir::{Argument, ExprKind, Function, FunctionId, Stmt, StmtKind, Type};
use crate::source::Span;

impl<'p> Translator<'_, 'p> {
    /// Calls a function of the program, or lets its code stand here.
    pub(super) fn call_function(&mut self, id: FunctionId, arguments: &'p [Argument], span: Span) -> Translated<Val> {
        let function = self.program.function(id).ok_or_else(wrong_type)?;
        let facts = self.unit.facts.function(id).ok_or_else(wrong_type)?;
        let (inline, effects, keeping) = (facts.inline, facts.effects, facts.keeping.clone());
        if inline {
            return self.stand_in(id, function, arguments, span);
        }
        let (mut mark, mut list_mark) = (None, None);
        let mut operands = vec![self.context];
        for (i, argument) in arguments.iter().enumerate() {
            match argument {
                Argument::Value(e) if e.ty == Type::Mesh => {
                    if mark.is_none() {
                        mark = Some(self.load_context(types::I64, context::SET_COUNT));
                    }
                    let (set, _) = self.set(e)?;
                    let copy = self.call(Symbol::SetCopy, &[set]).ok_or_else(wrong_type)?;
                    self.fail_if_no_set(copy);
                    operands.push(copy);
                }
                Argument::Value(e) if e.ty == Type::Ring && keeping.get(i) == Some(&Keeping::Face) => {
                    let (Bounds { start, len, .. }, mark) = self.list(e)?;
                    list_mark = list_mark.or(mark);
                    operands.extend([start, len]);
                }
                Argument::Value(e) if e.ty == Type::Ring => {
                    if list_mark.is_none() {
                        list_mark = Some(self.load_context(types::I64, context::LIST_COUNT));
                    }
                    let list = self.copied_list(e)?;
                    operands.push(list);
                }
                Argument::Value(e) => operands.extend_from_slice(self.expression(e)?.parts()),
                Argument::Reference(local) => match self.address_of(*local)? {
                    Storage::Memory(address) => operands.push(address),
                    Storage::Set(index) | Storage::List(index) => operands.push(index),
                    _ => return Err(wrong_type()),
                },
            }
        }
        if self.mutated(Mutation::CallsWithZeros) {
            for operand in operands.iter_mut().skip(1) {
                match self.b.func.dfg.value_type(*operand) {
                    types::F64 => *operand = self.b.ins().f64const(0.0),
                    types::F64X2 => *operand = self.b.ins().fsub(*operand, *operand),
                    _ => {}
                }
            }
        }
        self.poll(span);
        let callee = match self.function_refs.get(&id) {
            Some(&f) => f,
            None => {
                let compiled = self.unit.functions.get(&id).copied().ok_or_else(wrong_type)?;
                let f = self.module.declare_func_in_func(compiled, self.b.func);
                self.function_refs.insert(id, f);
                f
            }
        };
        let call = self.b.ins().call(callee, &operands);
        let status = self.b.inst_results(call)[0];
        let left = self.b.create_block();
        self.b.set_cold_block(left);
        self.leave_if(status, left);
        let site = self.site(span);
        let (current, next) = (left, self.b.current_block());
        self.continue_in(current);
        let site = self.int32(site);
        self.call(Symbol::Unwind, &[site]);
        self.b.ins().return_(&[status]);
        if let Some(next) = next {
            self.b.switch_to_block(next);
        }
        if effects.edits {
            self.known.forget_rings(false);
            if !self.mutated(Mutation::ForgetsWhatCallsPut) {
                self.known.forget_new();
            }
        }
        if effects.synchronizes {
            self.known.forget_rings(true);
        }
        let result = match function.returns {
            Type::Value(ty) => self.load_words(ty),
            _ => Val::Void,
        };
        self.drop_sets(mark);
        self.drop_lists(list_mark);
        Ok(result)
    }

    /// Translates the statements of a function in place of its call.
    fn stand_in(
        &mut self,
        id: FunctionId,
        function: &'p Function,
        arguments: &'p [Argument],
        span: Span,
    ) -> Translated<Val> {
        let keeping = self.unit.facts.function(id).ok_or_else(wrong_type)?.keeping.clone();
        let mut list_mark = None;
        let mut storage = Vec::with_capacity(function.locals.len());
        for (i, argument) in arguments.iter().enumerate() {
            let place = match argument {
                Argument::Value(e) if e.ty == Type::Ring => {
                    let orbit = match e.kind {
                        ExprKind::Local(local) => match self.storage(local)? {
                            Storage::Face(_, orbit) => orbit,
                            _ => Orbit::No,
                        },
                        _ => Orbit::No,
                    };
                    let (bounds, mark) = self.list(e)?;
                    list_mark = list_mark.or(mark);
                    Storage::Face(bounds, orbit)
                }
                Argument::Value(e) => {
                    let value = self.expression(e)?;
                    let Some(Type::Value(ty)) = function.locals.get(i).map(|l| l.ty) else { return Err(wrong_type()) };
                    let place = self.allocate(ty, keeping[i]);
                    self.define(place, value)
                }
                // The caller's variable itself.
                Argument::Reference(local) => self.address_of(*local)?,
            };
            storage.push(place);
        }
        for (local, &keeping) in function.locals.iter().zip(&keeping).skip(arguments.len()) {
            let place = match local.ty {
                Type::Value(ty) => self.allocate(ty, keeping),
                _ => Storage::None,
            };
            storage.push(place);
        }
        let straight = returns_only_at_its_end(&function.body);
        let exit = if straight { None } else { Some(self.b.create_block()) };
        let result: Vec<_> = match function.returns {
            Type::Value(ty) => clif_types(ty).iter().map(|&t| self.b.declare_var(t)).collect(),
            _ => Vec::new(),
        };
        let frame = Frame { function, storage, call: Some(span), exit, result: result.clone(), loops: Vec::new() };
        self.frames.push(frame);
        if !straight {
            self.known.enter();
        }
        let goes_on = self.block(&function.body)?;
        if !straight {
            self.known.leave();
        }
        self.frames.pop();
        if let Some(exit) = exit {
            if goes_on {
                self.b.ins().jump(exit, &[]);
            }
            self.continue_in(exit);
        }
        self.drop_lists(list_mark);
        let parts: Vec<Value> = result.into_iter().map(|v| self.b.use_var(v)).collect();
        Ok(Val::from_parts(&parts))
    }
}

/// Whether the only `return` is the last statement, if there is one.
fn returns_only_at_its_end(body: &[Stmt]) -> bool {
    let mut returns = 0;
    each(body, &mut |node| {
        if let Node::Stmt(s) = node {
            returns += usize::from(matches!(s.kind, StmtKind::Return(_)));
        }
    });
    returns == 0 || returns == 1 && matches!(body.last().map(|s| &s.kind), Some(StmtKind::Return(_)))
}
