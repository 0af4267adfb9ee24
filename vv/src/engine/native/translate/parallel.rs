//! Loops whose rounds do not depend on one another: the rounds become a function, which the runtime calls once or, on many
//! threads, for some members each.
//!
//! The function takes the context, addresses of the first member and behind the last, and where the values lie of variables
//! that are declared outside; these nobody assigns meanwhile.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{
    AbiParam, InstBuilder, MemFlagsData, Signature, StackSlotData, StackSlotKind, Value, types,
};
use cranelift_module::{FuncId, Linkage, Module};

use super::walk::Rounds;
use super::{Frame, Refused, Storage, Symbol, Translated, Translator, Unit, Val, Walk, wrong_type};
use crate::engine::native::Mutation;
use crate::engine::native::ahead::Ahead;
use crate::engine::native::context::status;
use crate::engine::native::effects::Keeping;
use crate::engine::native::parallel::{Column, Outside, Seen};
use crate::ir::{Function, LocalId, Stmt, Type};
use crate::source::Span;

/// Rounds that are still to be translated.
pub(in super::super) struct Apart<'p> {
    pub(in super::super) id: FuncId,
    /// The function that they stand in.
    function: &'p Function,
    name: String,
    /// Where its variables live there.
    storage: Vec<Storage>,
    local: LocalId,
    body: &'p [Stmt],
    span: Span,
    outside: Outside,
}

/// A variable of another function takes so many bytes at most.
const CAPTURE: u32 = 24;

pub(in super::super) fn signature(mut signature: Signature) -> Signature {
    signature.params.extend([types::I64; 4].map(AbiParam::new));
    signature.returns.push(AbiParam::new(types::I32));
    signature
}

impl<'p> Translator<'_, 'p> {
    /// Calls the rounds of a loop over so many members, if they can be a function of their own.
    pub(super) fn call_rounds(
        &mut self,
        local: LocalId,
        body: &'p [Stmt],
        first: Value,
        count: Value,
        span: Span,
    ) -> Translated<bool> {
        let frame = self.frame()?;
        let (function, storage) = (frame.function, frame.storage.clone());
        let Some(outside) = Outside::of(self.program, &self.unit.facts, function, local, body) else {
            return Ok(false);
        };
        let data = StackSlotData::new(StackSlotKind::ExplicitSlot, CAPTURE * (outside.captured.len() as u32).max(1), 3);
        let slot = self.b.create_sized_stack_slot(data);
        let environment = self.b.ins().stack_addr(types::I64, slot, 0);
        let flags = self.regions.locals;
        for (i, &captured) in outside.captured.iter().enumerate() {
            let mut value = match self.storage(captured)? {
                Storage::Set(index) => Val::One(index),
                Storage::Memory(address) => Val::One(address),
                _ => self.read_local(captured)?,
            };
            if self.mutated(Mutation::CapturesZeros)
                && let Ok(x) = value.one()
                && self.b.func.dfg.value_type(x) == types::F64
            {
                value = Val::One(self.b.ins().f64const(0.0));
            }
            self.store_value(value, flags, environment, CAPTURE as i32 * i as i32);
        }
        let index = self.unit.rounds;
        self.unit.rounds += 1;
        let signature = signature(self.module.make_signature());
        let id = self.module.declare_function(&format!("rounds{index}"), Linkage::Local, &signature);
        let id = id.map_err(|e| Refused(e.to_string()))?;
        let name = self.name.clone();
        self.unit.apart.push(Apart { id, function, name, storage, local, body, span, outside });
        let index = self.int32(index);
        let status = self.call(Symbol::Parallel, &[index, first, count, environment]).ok_or_else(wrong_type)?;
        self.fail_or_stop_if(status, span);
        Ok(true)
    }

    /// Translates such rounds; says whether threads may do them.
    pub(in super::super) fn rounds(mut self, apart: Apart<'p>) -> Translated<bool> {
        let Apart { function, storage, local, body, span, outside, .. } = apart;
        self.watches = true;
        let entry = self.b.current_block().ok_or_else(wrong_type)?;
        let &[_, mut first, mut end, environment] = self.b.block_params(entry) else { return Err(wrong_type()) };
        self.ask_for_stack();
        let flags = self.regions.locals;
        let mut own = Vec::with_capacity(storage.len());
        for (i, (variable, was)) in function.locals.iter().zip(storage).enumerate() {
            let captured = outside.captured.iter().position(|l| l.0 as usize == i);
            let at = CAPTURE as i32 * captured.unwrap_or(0) as i32;
            own.push(match (variable.ty, was) {
                (Type::Mesh, _) if captured.is_some() => {
                    Storage::Set(self.b.ins().load(types::I32, flags, environment, at))
                }
                (Type::Value(_), Storage::Memory(_)) if captured.is_some() => {
                    Storage::Memory(self.b.ins().load(types::I64, flags, environment, at))
                }
                (Type::Value(ty), _) if captured.is_some() => {
                    Storage::Fixed(self.load_value(ty, flags, environment, at))
                }
                (Type::Value(ty), Storage::Variables(..)) => self.allocate(ty, Keeping::Variable),
                (Type::Value(ty), Storage::Memory(_)) => self.allocate(ty, Keeping::Memory),
                _ => Storage::None,
            });
        }
        let frame = Frame { function, storage: own, call: None, exit: None, result: Vec::new(), loops: Vec::new() };
        self.frames.push(frame);
        if self.mutated(Mutation::RoundsSkipTheFirst) {
            first = self.less_one(first, end, false);
        }
        if self.mutated(Mutation::RoundsLeaveOutTheLast) {
            end = self.less_one(first, end, true);
        }
        let exit = self.b.create_block();
        let members: MemFlagsData = self.regions.members;
        let rounds = Rounds::over_set(local, first, end, members, span);
        let ahead = Ahead::of_set(self.program, local, body);
        let ask = |t: &mut Self, at| t.ask_ahead(&ahead, at, end, members);
        self.seen = Some((None, Seen { read: outside.read, ..Seen::default() }));
        self.walk(&rounds, Walk::Nothing, exit, body, ask, |t, sides| {
            t.in_turn = sides.first().map(|&(v, _)| v);
            if let Some((own, _)) = &mut t.seen {
                *own = t.in_turn;
            }
        })?;
        self.continue_in(exit);
        let done = self.b.ins().iconst(types::I32, i64::from(status::DONE));
        self.b.ins().return_(&[done]);
        let is_apart = self.seen.take().is_some_and(|(_, seen)| seen.is_apart());
        self.finish();
        Ok(is_apart)
    }

    /// One end of some members without the one that stands there, if there is one.
    fn less_one(&mut self, first: Value, end: Value, last: bool) -> Value {
        let none = self.b.ins().icmp(IntCC::Equal, first, end);
        let (from, by) = if last { (end, -4) } else { (first, 4) };
        let less = self.b.ins().iadd_imm_s(from, by);
        self.b.ins().select(none, from, less)
    }

    /// Notes that a value of a vertex is read, or stored to.
    pub(super) fn see(&mut self, column: Column, v: Value, stores: bool) {
        if let Some((own, seen)) = &mut self.seen {
            match (*own == Some(v), stores) {
                (true, true) => {
                    seen.stored.insert(column);
                }
                (true, false) => {}
                (false, true) => seen.strays = true,
                (false, false) => {
                    seen.read.insert(column);
                }
            }
        }
    }
}

/// The next rounds that are to be translated.
pub(in super::super) fn next<'p>(unit: &mut Unit<'p>) -> Option<Apart<'p>> {
    if unit.apart.is_empty() { None } else { Some(unit.apart.remove(0)) }
}

impl Apart<'_> {
    /// The name of the function that the rounds stand in.
    pub(in super::super) fn name(&self) -> &str {
        &self.name
    }
}
