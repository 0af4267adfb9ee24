//! Vertex sets.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{InstBuilder, Value, types};

use super::{Symbol, Translated, Translator, Val, wrong_type};
use crate::engine::native::Mutation;
use crate::engine::native::context;
use crate::ir::{Expr, ExprKind};

impl<'p> Translator<'_, 'p> {
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

    pub(super) fn is_in_set(&mut self, vertex: &'p Expr, set: &'p Expr) -> Translated<Val> {
        let v = self.vertex(vertex)?;
        let (set, mark) = self.set(set)?;
        let [ask, count, call] = [(); 3].map(|()| self.b.create_block());
        self.b.set_cold_block(call);
        let (done, is) = self.block_with(&[types::I8]);
        let no = self.b.ins().iconst(types::I8, 0);
        self.b.ins().brif(v, ask, &[], done, &[no.into()]);
        self.continue_in(ask);
        let set_address = self.set_address(set);
        let flags = self.regions.sets;
        let [len, first, last] = [context::SET_LEN, context::SET_FIRST, context::SET_LAST]
            .map(|offset| self.b.ins().load(types::I64, flags, set_address, offset));
        let distance = self.b.ins().isub(last, first);
        let all = self.b.ins().iadd_imm_s(distance, 1);
        let dense = self.b.ins().icmp(IntCC::Equal, all, len);
        self.b.ins().brif(dense, count, &[], call, &[]);
        self.continue_in(count);
        let wide = self.wide(v);
        let place = self.b.ins().isub(wide, first);
        let within = self.b.ins().icmp(IntCC::UnsignedLessThan, place, len);
        let within = self.inverted_if(within, Mutation::IsInSetInverted);
        self.jump_with(done, &[within]);
        self.continue_in(call);
        let contains = self.call_rarely(Symbol::SetContains, &[set, v])?.ok_or_else(wrong_type)?;
        let contains = self.b.ins().ireduce(types::I8, contains);
        let contains = self.inverted_if(contains, Mutation::IsInSetInverted);
        self.jump_with(done, &[contains]);
        self.continue_in(done);
        self.drop_sets(mark);
        Ok(Val::One(is[0]))
    }

    fn set_address(&mut self, set: Value) -> Value {
        let sets = self.load_context(types::I64, context::SETS);
        let index = self.b.ins().uextend(types::I64, set);
        let offset = self.b.ins().imul_imm_s(index, context::SET_SIZE);
        self.b.ins().iadd(sets, offset)
    }

    /// `add`: pushes in line where the vertex is larger than all members and there is room.
    pub(super) fn add(&mut self, v: Value, set: Value) -> Translated<()> {
        let set_address = self.set_address(set);
        let flags = self.regions.sets;
        let len = self.b.ins().load(types::I64, flags, set_address, context::SET_LEN);
        let capacity = self.b.ins().load(types::I64, flags, set_address, context::SET_CAPACITY);
        let last = self.b.ins().load(types::I64, flags, set_address, context::SET_LAST);
        let wide = self.wide(v);
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
        self.call_rarely_or_fail(Symbol::SetAdd, &[set, v])?;
        self.b.ins().jump(done, &[]);
        self.continue_in(done);
        Ok(())
    }
}
