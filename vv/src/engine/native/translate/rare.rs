//! Calls that are hardly ever made: of the runtime where code that works in line meets what it leaves alone.
//!
//! They shall cost nothing where they are not made. So such a call leaves all registers as they are, and wants no value
//! in a certain one: no value in use around it is kept on the stack for its sake. Operands and result go through the
//! context, whose address is read from itself, for as an operand the one that all code uses would be wanted in the first
//! operand's register. What stands between code and runtime function takes them there and keeps the registers.

use cranelift_codegen::ir::{AbiParam, Function, InstBuilder, MemFlagsData, Signature, Value, types};
use cranelift_codegen::isa::CallConv;
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};
use cranelift_jit::JITModule;
use cranelift_module::{FuncId, Linkage, Module};

use super::{Refused, Symbol, Translated, Translator};
use crate::engine::native::context;

impl Translator<'_, '_> {
    /// As [`Translator::call`], where code hardly ever comes.
    pub(super) fn call_rarely(&mut self, symbol: Symbol, operands: &[Value]) -> Translated<Option<Value>> {
        let id = match self.unit.rare.get(&symbol) {
            Some(&id) => id,
            None => {
                let name = format!("rarely {}", symbol.name());
                let id = self.module.declare_function(&name, Linkage::Local, &signature());
                let id = id.map_err(|e| Refused(e.to_string()))?;
                self.unit.rare.insert(symbol, id);
                id
            }
        };
        if let Some(span) = self.ask_rarely {
            self.poll(span);
        }
        for (i, &x) in operands.iter().enumerate() {
            self.store_context(x, context::OPERANDS + 8 * i as i32);
        }
        let function = self.function_ref(id);
        let this = self.load_context(types::I64, context::THIS);
        self.b.ins().call(function, &[this]);
        Ok(symbol.result().map(|ty| self.load_context(ty, context::RESULT)))
    }

    /// As [`Translator::call_or_fail`], where code hardly ever comes.
    pub(super) fn call_rarely_or_fail(&mut self, symbol: Symbol, operands: &[Value]) -> Translated<()> {
        if let Some(status) = self.call_rarely(symbol, operands)? {
            self.fail_if(status);
        }
        Ok(())
    }
}

fn signature() -> Signature {
    let mut signature = Signature::new(CallConv::PreserveAll);
    signature.params.push(AbiParam::new(types::I64));
    signature
}

/// What stands between code and a runtime function.
pub(in super::super) fn between(
    symbol: Symbol,
    callee: FuncId,
    module: &mut JITModule,
    function: &mut Function,
    builder: &mut FunctionBuilderContext,
) {
    function.signature = signature();
    let callee = module.declare_func_in_func(callee, function);
    let mut b = FunctionBuilder::new(function, builder);
    let entry = b.create_block();
    b.append_block_params_for_function_params(entry);
    b.switch_to_block(entry);
    b.seal_block(entry);
    let context = b.block_params(entry)[0];
    let flags = MemFlagsData::trusted();
    let mut operands = vec![context];
    for (i, &ty) in symbol.operands().iter().skip(1).enumerate() {
        operands.push(b.ins().load(ty, flags, context, context::OPERANDS + 8 * i as i32));
    }
    let call = b.ins().call(callee, &operands);
    if let Some(&result) = b.inst_results(call).first() {
        b.ins().store(flags, result, context, context::RESULT);
    }
    b.ins().return_(&[]);
    b.finalize(module.target_config());
}
