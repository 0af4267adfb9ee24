//! Expressions.

use cranelift_codegen::ir::condcodes::{FloatCC, IntCC};
use cranelift_codegen::ir::{InstBuilder, Type as ClifType, Value, types};
use cranelift_module::Module;

use super::{Frame, Storage, Symbol, Translated, Translator, Val, clif_types, wrong_type};
use crate::builtins::{Builtin, Code};
use crate::engine::native::context::{self, Memo};
use crate::engine::native::{Mutation, RED_ZONE, STACK_SEGMENT};
use crate::ir::{
    Argument, Binary, Comparison, Conversion, Expr, ExprKind, Function, FunctionId, Item, Ring, Stmt, StmtKind, Type,
    Unary,
};
use crate::mesh;
use crate::source::Span;

impl<'p> Translator<'_, 'p> {
    pub(super) fn expression(&mut self, e: &'p Expr) -> Translated<Val> {
        stacker::maybe_grow(RED_ZONE, STACK_SEGMENT, || self.expression_here(e))
    }

    /// An expression of type bool.
    pub(super) fn condition(&mut self, e: &'p Expr) -> Translated<Value> {
        self.expression(e)?.one()
    }

    /// An expression of type vertex.
    pub(super) fn vertex(&mut self, e: &'p Expr) -> Translated<Value> {
        self.expression(e)?.one()
    }

    fn expression_here(&mut self, e: &'p Expr) -> Translated<Val> {
        match &e.kind {
            ExprKind::Constant(value) => self.constant(*value),
            ExprKind::Local(local) => self.read_local(*local),
            ExprKind::Global(id) => {
                let global = self.program.globals.get(id.0 as usize).ok_or_else(wrong_type)?;
                if let (ExprKind::Constant(value), None) = (&global.init.kind, &global.param) {
                    return self.constant(*value);
                }
                let offset = context::byte_offset(self.unit.layout.global(id.0 as usize));
                let (flags, context) = (self.regions.context, self.context);
                Ok(self.load_value(global.ty, flags, context, offset))
            }
            ExprKind::Load(place) => self.load(place),
            ExprKind::Convert(conversion, a) => {
                let a = self.expression(a)?;
                self.convert(*conversion, a)
            }
            ExprKind::Unary(op, a) => {
                let a = self.expression(a)?;
                self.unary(*op, a)
            }
            ExprKind::Binary(op, a, b) => {
                let a = self.expression(a)?;
                let b = self.expression(b)?;
                self.binary(*op, a, b)
            }
            ExprKind::And(a, b) => self.short_circuit(a, b, false),
            ExprKind::Or(a, b) => self.short_circuit(a, b, true),
            ExprKind::Conditional(condition, a, b) => self.conditional(condition, a, b),
            ExprKind::Coordinate(a, axis) => {
                let parts = self.expression(a)?.vec()?;
                Ok(Val::One(parts[usize::from((*axis).min(2))]))
            }
            ExprKind::Call(function, arguments) => self.call_function(*function, arguments, e.span),
            ExprKind::Builtin(builtin, arguments) => {
                let mut values = Vec::with_capacity(arguments.len());
                for argument in arguments {
                    values.push(self.expression(argument)?);
                }
                self.builtin(*builtin, &values)
            }
            ExprKind::Assign { place, op, value } => self.assign(place, op.as_ref(), value),
            ExprKind::Step(place, step, position) => self.step(place, *step, *position),
            ExprKind::AssignSet(local, value) => {
                let (other, mark) = self.set(value)?;
                let set = self.set_of(*local)?;
                if !self.mutated(Mutation::AssignsNoSet) {
                    self.call_or_fail(Symbol::SetAssign, &[set, other]);
                }
                self.drop_sets(mark);
                Ok(Val::Void)
            }
            ExprKind::Create => Ok(Val::One(self.create()?)),
            ExprKind::Any(ring) => {
                let v = self.ring_owner(ring)?;
                Ok(Val::One(self.any(v, ring.old)))
            }
            ExprKind::Next(item, ring) => self.look_up(item, ring, true),
            ExprKind::Previous(item, ring) => self.look_up(item, ring, false),
            ExprKind::IsInRing(item, ring) => {
                let x = self.sought(item)?;
                let v = self.ring_owner(ring)?;
                if x.is_none() {
                    return Ok(Val::One(self.has_gap(v, ring.old)));
                }
                let found = self.find(x, v, ring.old);
                let certain = self.b.ins().iconst(types::I8, 1);
                let is = found.found.unwrap_or(certain);
                Ok(Val::One(self.inverted_if(is, Mutation::IsInRingInverted)))
            }
            ExprKind::IsInSet(vertex, set) => self.is_in_set(vertex, set),
            ExprKind::Valence(ring) => {
                let v = self.ring_owner(ring)?;
                let mut gaps = self.gaps(v, ring.old);
                if self.mutated(Mutation::ForgetsGapsOfValence) {
                    gaps = self.int32(0);
                }
                let len = self.bounds(v, ring.old).len;
                let n = self.b.ins().isub(len, gaps);
                Ok(Val::One(self.b.ins().uextend(types::I64, n)))
            }
            ExprKind::Gaps(ring) => {
                let v = self.ring_owner(ring)?;
                let gaps = self.gaps(v, ring.old);
                Ok(Val::One(self.b.ins().uextend(types::I64, gaps)))
            }
        }
    }

    pub(super) fn constant(&mut self, value: mesh::Value) -> Translated<Val> {
        Ok(match value {
            mesh::Value::Bool(b) => Val::One(self.b.ins().iconst(types::I8, i64::from(b))),
            mesh::Value::Int(i) => Val::One(self.b.ins().iconst(types::I64, i)),
            mesh::Value::Double(x) => Val::One(self.b.ins().f64const(x)),
            mesh::Value::Vec(v) => Val::Vec(v.to_array().map(|x| self.b.ins().f64const(x))),
            mesh::Value::Vertex(None) => Val::One(self.int32(0)),
            mesh::Value::Vertex(Some(_)) => return Err(wrong_type()),
        })
    }

    fn look_up(&mut self, item: &'p Item, ring: &'p Ring, forward: bool) -> Translated<Val> {
        let x = self.sought(item)?;
        let v = self.ring_owner(ring)?;
        let old = ring.old && !self.mutated(Mutation::OldRingIsNew);
        let found = self.find(x, v, old);
        Ok(Val::One(self.neighbour(found, forward, old)))
    }

    fn is_in_set(&mut self, vertex: &'p Expr, set: &'p Expr) -> Translated<Val> {
        let v = self.vertex(vertex)?;
        let (set, mark) = self.set(set)?;
        let ask = self.b.create_block();
        let (done, is) = self.block_with(&[types::I8]);
        let no = self.b.ins().iconst(types::I8, 0);
        self.b.ins().brif(v, ask, &[], done, &[no.into()]);
        self.continue_in(ask);
        let contains = self.call(Symbol::SetContains, &[set, v]).ok_or_else(wrong_type)?;
        let contains = self.b.ins().ireduce(types::I8, contains);
        let contains = self.inverted_if(contains, Mutation::IsInSetInverted);
        self.jump_with(done, &[contains]);
        self.continue_in(done);
        self.drop_sets(mark);
        Ok(Val::One(is[0]))
    }

    fn short_circuit(&mut self, a: &'p Expr, b: &'p Expr, decides: bool) -> Translated<Val> {
        let first = self.condition(a)?;
        let decides = decides != self.mutated(Mutation::AndIsOr);
        let more = self.b.create_block();
        let (done, result) = self.block_with(&[types::I8]);
        if decides {
            self.b.ins().brif(first, done, &[first.into()], more, &[]);
        } else {
            self.b.ins().brif(first, more, &[], done, &[first.into()]);
        }
        self.continue_in(more);
        self.known.enter();
        let second = self.condition(b)?;
        self.known.leave();
        self.jump_with(done, &[second]);
        self.continue_in(done);
        Ok(Val::One(result[0]))
    }

    fn conditional(&mut self, condition: &'p Expr, a: &'p Expr, b: &'p Expr) -> Translated<Val> {
        let holds = self.condition(condition)?;
        let [yes, no] = [(); 2].map(|()| self.b.create_block());
        let result_types: &[ClifType] = match a.ty {
            Type::Value(ty) => clif_types(ty),
            _ => &[],
        };
        let (done, result) = self.block_with(result_types);
        self.b.ins().brif(holds, yes, &[], no, &[]);
        let (a, b) = if self.mutated(Mutation::ConditionalIsSwapped) { (b, a) } else { (a, b) };
        for (block, arm) in [(yes, a), (no, b)] {
            self.continue_in(block);
            self.known.enter();
            let value = self.expression(arm)?;
            self.known.leave();
            self.jump_with(done, value.parts());
        }
        self.continue_in(done);
        Ok(Val::from_parts(&result))
    }

    pub(super) fn convert(&mut self, conversion: Conversion, a: Val) -> Translated<Val> {
        let mut a = a.one()?;
        if conversion == Conversion::DoubleToInt && self.mutated(Mutation::DoubleToIntRounds) {
            a = self.b.ins().nearest(a);
        }
        let [minus_one, unsigned] =
            [Mutation::BoolIsMinusOne, Mutation::IntToDoubleUnsigned].map(|mutation| self.mutated(mutation));
        let b = &mut self.b;
        Ok(Val::One(match conversion {
            Conversion::BoolToInt if minus_one => {
                let wide = b.ins().uextend(types::I64, a);
                b.ins().ineg(wide)
            }
            Conversion::IntToDouble if unsigned => b.ins().fcvt_from_uint(types::F64, a),
            Conversion::BoolToInt => b.ins().uextend(types::I64, a),
            Conversion::BoolToDouble => {
                let wide = b.ins().uextend(types::I64, a);
                b.ins().fcvt_from_sint(types::F64, wide)
            }
            Conversion::IntToDouble => b.ins().fcvt_from_sint(types::F64, a),
            Conversion::DoubleToInt => {
                let low = b.ins().f64const(-9_223_372_036_854_775_808.0);
                let high = b.ins().f64const(9_223_372_036_854_775_808.0);
                let above = b.ins().fcmp(FloatCC::GreaterThanOrEqual, a, low);
                let below = b.ins().fcmp(FloatCC::LessThan, a, high);
                let fits = b.ins().band(above, below);
                let bad = b.ins().icmp_imm_s(IntCC::Equal, fits, 0);
                self.fail_if(bad);
                self.b.ins().fcvt_to_sint_sat(types::I64, a)
            }
            Conversion::IntToBool => b.ins().icmp_imm_s(IntCC::NotEqual, a, 0),
            Conversion::DoubleToBool => {
                let zero = b.ins().f64const(0.0);
                b.ins().fcmp(FloatCC::NotEqual, a, zero)
            }
            Conversion::VertexToBool => b.ins().icmp_imm_s(IntCC::NotEqual, a, 0),
        }))
    }

    fn unary(&mut self, op: Unary, a: Val) -> Translated<Val> {
        Ok(match op {
            Unary::NegateInt => {
                let a = a.one()?;
                let bad = self.b.ins().icmp_imm_s(IntCC::Equal, a, i64::MIN);
                self.fail_if(bad);
                Val::One(self.b.ins().ineg(a))
            }
            Unary::NegateDouble | Unary::NegateVec if self.mutated(Mutation::NegatesNothing) => a,
            Unary::Not if self.mutated(Mutation::NotDoesNothing) => a,
            Unary::NegateDouble => Val::One(self.b.ins().fneg(a.one()?)),
            Unary::NegateVec => Val::Vec(a.vec()?.map(|x| self.b.ins().fneg(x))),
            Unary::Not => Val::One(self.b.ins().bxor_imm_u(a.one()?, 1)),
        })
    }

    pub(super) fn binary(&mut self, op: Binary, a: Val, b: Val) -> Translated<Val> {
        match op {
            Binary::AddInt | Binary::SubtractInt | Binary::MultiplyInt => {
                let (a, b) = (a.one()?, b.one()?);
                let (result, overflow) = match op {
                    Binary::AddInt if self.mutated(Mutation::IntSumIsDifference) => self.b.ins().ssub_overflow(a, b),
                    Binary::AddInt => self.b.ins().sadd_overflow(a, b),
                    Binary::SubtractInt => self.b.ins().ssub_overflow(a, b),
                    _ => self.b.ins().smul_overflow(a, b),
                };
                self.fail_if(overflow);
                Ok(Val::One(result))
            }
            Binary::DivideInt | Binary::RemainderInt => {
                let (a, b) = (a.one()?, b.one()?);
                let zero = self.b.ins().icmp_imm_s(IntCC::Equal, b, 0);
                let smallest = self.b.ins().icmp_imm_s(IntCC::Equal, a, i64::MIN);
                let minus_one = self.b.ins().icmp_imm_s(IntCC::Equal, b, -1);
                let overflow = self.b.ins().band(smallest, minus_one);
                let bad = self.b.ins().bor(zero, overflow);
                self.fail_if(bad);
                if self.mutated(Mutation::DividesIntsByOne) {
                    return Ok(Val::One(a));
                }
                let divide = op == Binary::DivideInt;
                Ok(Val::One(if divide { self.b.ins().sdiv(a, b) } else { self.b.ins().srem(a, b) }))
            }
            Binary::AddDouble | Binary::SubtractDouble | Binary::MultiplyDouble | Binary::DivideDouble => {
                Ok(Val::One(self.arithmetic(op, a.one()?, b.one()?)))
            }
            Binary::AddVec | Binary::SubtractVec => {
                let op = if op == Binary::AddVec { Binary::AddDouble } else { Binary::SubtractDouble };
                let (a, b) = (a.vec()?, b.vec()?);
                Ok(Val::Vec([0, 1, 2].map(|k| self.arithmetic(op, a[k], b[k]))))
            }
            Binary::MultiplyVec | Binary::DivideVec => {
                let op = if op == Binary::MultiplyVec { Binary::MultiplyDouble } else { Binary::DivideDouble };
                let (a, b) = (a.vec()?, b.one()?);
                Ok(Val::Vec(a.map(|x| self.arithmetic(op, x, b))))
            }
            Binary::ScaleByDouble => {
                let (a, b) = (a.one()?, b.vec()?);
                Ok(Val::Vec(b.map(|x| self.arithmetic(Binary::MultiplyDouble, a, x))))
            }
            Binary::CompareInt(c) => {
                let is = self.b.ins().icmp(signed(c), a.one()?, b.one()?);
                Ok(Val::One(self.inverted_if(is, Mutation::ComparesIntsInverted)))
            }
            Binary::CompareDouble(c) => {
                let is = self.b.ins().fcmp(float(c), a.one()?, b.one()?);
                Ok(Val::One(self.inverted_if(is, Mutation::ComparesDoublesInverted)))
            }
            Binary::CompareVertex(c) => {
                let is = self.b.ins().icmp(unsigned(c), a.one()?, b.one()?);
                Ok(Val::One(self.inverted_if(is, Mutation::ComparesVerticesInverted)))
            }
            Binary::CompareBool(c) => {
                let is = self.b.ins().icmp(unsigned(c), a.one()?, b.one()?);
                Ok(Val::One(self.inverted_if(is, Mutation::ComparesBoolsInverted)))
            }
            Binary::CompareVec(c) => {
                let (a, b) = (a.vec()?, b.vec()?);
                let [x, y, z] = [0, 1, 2].map(|k| self.b.ins().fcmp(FloatCC::Equal, a[k], b[k]));
                let xy = self.b.ins().band(x, y);
                let mut equal = self.b.ins().band(xy, z);
                if self.mutated(Mutation::ComparesVecsByX) {
                    equal = x;
                }
                let unequal = c == Comparison::NotEqual;
                Ok(Val::One(if unequal { self.b.ins().bxor_imm_u(equal, 1) } else { equal }))
            }
        }
    }

    /// A bool, the other one where that is to be wrong.
    fn inverted_if(&mut self, is: Value, mutation: Mutation) -> Value {
        if self.mutated(mutation) { self.b.ins().bxor_imm_u(is, 1) } else { is }
    }

    fn arithmetic(&mut self, op: Binary, a: Value, b: Value) -> Value {
        match op {
            Binary::AddDouble => self.b.ins().fadd(a, b),
            Binary::SubtractDouble if self.mutated(Mutation::DifferenceIsSwapped) => self.b.ins().fsub(b, a),
            Binary::SubtractDouble => self.b.ins().fsub(a, b),
            Binary::MultiplyDouble if self.mutated(Mutation::ProductIsSum) => self.b.ins().fadd(a, b),
            Binary::MultiplyDouble => self.b.ins().fmul(a, b),
            _ if self.mutated(Mutation::QuotientIsProduct) => self.b.ins().fmul(a, b),
            _ => self.b.ins().fdiv(a, b),
        }
    }

    fn builtin(&mut self, builtin: Builtin, arguments: &[Val]) -> Translated<Val> {
        if let Some(result) = self.builtin_in_line(builtin, arguments)? {
            return Ok(result);
        }
        match (builtin.code(), arguments) {
            (Code::D1(f), &[x]) => return Ok(Val::One(self.remembered(builtin, f as usize, &[x.one()?])?)),
            (Code::D2(f), &[x, y]) => {
                return Ok(Val::One(self.remembered(builtin, f as usize, &[x.one()?, y.one()?])?));
            }
            _ => {}
        }
        let mut at = 0;
        for value in arguments {
            self.store_words_at(*value, at);
            at += value.parts().len();
        }
        let index = Builtin::all().position(|b| b == builtin).ok_or_else(wrong_type)?;
        let index = self.int32(index as u32);
        self.call_or_fail(Symbol::CallBuiltin, &[index]);
        Ok(self.load_words(builtin.returns()))
    }

    /// Functions that are an instruction or two, each with the operations of the table in their order.
    fn builtin_in_line(&mut self, builtin: Builtin, arguments: &[Val]) -> Translated<Option<Val>> {
        Ok(Some(match (builtin.name(), builtin.code(), arguments) {
            ("sqrt", Code::D1(_), &[x]) => Val::One(self.b.ins().sqrt(x.one()?)),
            ("fabs" | "abs", Code::D1(_), &[x]) => Val::One(self.b.ins().fabs(x.one()?)),
            ("floor", Code::D1(_), &[x]) => Val::One(self.b.ins().floor(x.one()?)),
            ("ceil", Code::D1(_), &[x]) => Val::One(self.b.ins().ceil(x.one()?)),
            ("trunc", Code::D1(_), &[x]) => Val::One(self.b.ins().trunc(x.one()?)),
            ("min" | "max", Code::D2(_), &[a, b]) => {
                let (a, b) = (a.one()?, b.one()?);
                let min = (builtin.name() == "min") != self.mutated(Mutation::MinIsMax);
                let takes_b = if min {
                    self.b.ins().fcmp(FloatCC::LessThan, b, a)
                } else {
                    self.b.ins().fcmp(FloatCC::LessThan, a, b)
                };
                Val::One(self.b.ins().select(takes_b, b, a))
            }
            ("min" | "max", Code::I2(_), &[a, b]) => {
                let (a, b) = (a.one()?, b.one()?);
                let min = (builtin.name() == "min") != self.mutated(Mutation::MinIsMax);
                Val::One(if min { self.b.ins().smin(a, b) } else { self.b.ins().smax(a, b) })
            }
            ("vec", Code::VecFromD3(_), &[x, y, z]) => Val::Vec([x.one()?, y.one()?, z.one()?]),
            ("dot", Code::DFromVec2(_), &[a, b]) => Val::One(self.dot(a.vec()?, b.vec()?)),
            ("cross", Code::Vec2(_), &[a, b]) => {
                let (a, b) = (a.vec()?, b.vec()?);
                Val::Vec([(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
                    let (i, j) = if self.mutated(Mutation::CrossIsNegated) { (j, i) } else { (i, j) };
                    let first = self.b.ins().fmul(a[i], b[j]);
                    let second = self.b.ins().fmul(a[j], b[i]);
                    self.b.ins().fsub(first, second)
                }))
            }
            ("length", Code::DFromVec1(_), &[v]) => Val::One(self.length(v.vec()?)),
            ("distance", Code::DFromVec2(_), &[a, b]) => {
                let (a, b) = (a.vec()?, b.vec()?);
                let d = [0, 1, 2].map(|k| self.b.ins().fsub(a[k], b[k]));
                Val::One(self.length(d))
            }
            ("normalize", Code::Vec1(_), &[v]) => {
                let v = v.vec()?;
                let length = self.length(v);
                let zero = self.b.ins().f64const(0.0);
                let none = self.b.ins().fcmp(FloatCC::Equal, length, zero);
                Val::Vec(v.map(|x| {
                    let scaled = self.b.ins().fdiv(x, length);
                    self.b.ins().select(none, zero, scaled)
                }))
            }
            _ => return Ok(None),
        }))
    }

    fn dot(&mut self, a: [Value; 3], b: [Value; 3]) -> Value {
        let [x, y, z] = [0, 1, 2].map(|k| self.b.ins().fmul(a[k], b[k]));
        let xy = self.b.ins().fadd(x, y);
        if self.mutated(Mutation::DotForgetsZ) {
            return xy;
        }
        self.b.ins().fadd(xy, z)
    }

    fn length(&mut self, v: [Value; 3]) -> Value {
        let square = self.dot(v, v);
        self.b.ins().sqrt(square)
    }

    /// Calls a function of one or two doubles, unless its operands are those of the last time.
    ///
    /// In refinement the same few valences ask for the same cosines again and again.
    fn remembered(&mut self, builtin: Builtin, function: usize, operands: &[Value]) -> Translated<Value> {
        let memo = self.unit.layout.add_memo();
        let word = self.unit.layout.memo(memo);
        let offset = context::byte_offset(word);
        self.unit.memos.push(Memo { builtin, word });
        let mut same = self.b.ins().iconst(types::I8, 1);
        let mut all = vec![self.b.ins().iconst(types::I64, function as i64)];
        let mut bits = Vec::new();
        for (k, &x) in operands.iter().enumerate() {
            let x_bits = self.b.ins().bitcast(types::I64, cranelift_codegen::ir::MemFlagsData::new(), x);
            let last = self.load_context(types::I64, offset + 8 * k as i32);
            let equal = self.b.ins().icmp(IntCC::Equal, x_bits, last);
            same = if k == 0 { equal } else { self.b.ins().band(same, equal) };
            bits.push(x_bits);
            all.push(x);
        }
        if self.mutated(Mutation::MemoIsStale) {
            same = self.b.ins().iconst(types::I8, 1);
        }
        let [again, compute] = [(); 2].map(|()| self.b.create_block());
        let (done, result) = self.block_with(&[types::F64]);
        self.b.ins().brif(same, again, &[], compute, &[]);
        self.continue_in(again);
        let kept = self.load_context(types::F64, offset + 16);
        self.jump_with(done, &[kept]);
        self.continue_in(compute);
        let symbol = if operands.len() == 1 { Symbol::CallD1 } else { Symbol::CallD2 };
        let computed = self.call_with(symbol, &all).ok_or_else(wrong_type)?;
        for (k, &x_bits) in bits.iter().enumerate() {
            self.store_context(x_bits, offset + 8 * k as i32);
        }
        self.store_context(computed, offset + 16);
        self.jump_with(done, &[computed]);
        self.continue_in(done);
        Ok(result[0])
    }

    /// Calls a function of the program, or lets its code stand here.
    pub(super) fn call_function(&mut self, id: FunctionId, arguments: &'p [Argument], span: Span) -> Translated<Val> {
        let function = self.program.function(id).ok_or_else(wrong_type)?;
        let facts = self.unit.facts.function(id).ok_or_else(wrong_type)?;
        let (inline, effects) = (facts.inline, facts.effects);
        if inline {
            return self.stand_in(id, function, arguments, span);
        }
        let mut mark = None;
        let mut operands = vec![self.context];
        for argument in arguments {
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
                Argument::Value(e) => operands.extend_from_slice(self.expression(e)?.parts()),
                Argument::Reference(local) => match self.address_of(*local)? {
                    Storage::Memory(address) => operands.push(address),
                    Storage::Set(index) => operands.push(index),
                    _ => return Err(wrong_type()),
                },
            }
        }
        if self.mutated(Mutation::CallsWithZeros) {
            for operand in operands.iter_mut().skip(1) {
                if self.b.func.dfg.value_type(*operand) == types::F64 {
                    *operand = self.b.ins().f64const(0.0);
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
        self.leave_to(status, left);
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
        }
        if effects.synchronizes {
            self.known.forget_rings(true);
        }
        let result = match function.returns {
            Type::Value(ty) => self.load_words(ty),
            _ => Val::Void,
        };
        self.drop_sets(mark);
        Ok(result)
    }

    fn leave_to(&mut self, bad: Value, to: cranelift_codegen::ir::Block) {
        self.leave_if(bad, to);
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
        let mut storage = Vec::with_capacity(function.locals.len());
        for (i, argument) in arguments.iter().enumerate() {
            let place = match argument {
                Argument::Value(e) => {
                    let value = self.expression(e)?;
                    let Some(Type::Value(ty)) = function.locals.get(i).map(|l| l.ty) else { return Err(wrong_type()) };
                    let place = self.allocate(ty, keeping[i]);
                    self.define(place, ty, value)
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
        let parts: Vec<Value> = result.into_iter().map(|v| self.b.use_var(v)).collect();
        Ok(Val::from_parts(&parts))
    }
}

/// Whether the only `return` is the last statement, if there is one.
fn returns_only_at_its_end(body: &[Stmt]) -> bool {
    let mut returns = 0;
    crate::engine::native::effects::each(body, &mut |node| {
        if let crate::engine::native::effects::Node::Stmt(s) = node {
            returns += usize::from(matches!(s.kind, StmtKind::Return(_)));
        }
    });
    returns == 0 || returns == 1 && matches!(body.last().map(|s| &s.kind), Some(StmtKind::Return(_)))
}

fn signed(c: Comparison) -> IntCC {
    match c {
        Comparison::Less => IntCC::SignedLessThan,
        Comparison::LessEqual => IntCC::SignedLessThanOrEqual,
        Comparison::Greater => IntCC::SignedGreaterThan,
        Comparison::GreaterEqual => IntCC::SignedGreaterThanOrEqual,
        Comparison::Equal => IntCC::Equal,
        Comparison::NotEqual => IntCC::NotEqual,
    }
}

fn unsigned(c: Comparison) -> IntCC {
    match c {
        Comparison::Less => IntCC::UnsignedLessThan,
        Comparison::LessEqual => IntCC::UnsignedLessThanOrEqual,
        Comparison::Greater => IntCC::UnsignedGreaterThan,
        Comparison::GreaterEqual => IntCC::UnsignedGreaterThanOrEqual,
        Comparison::Equal => IntCC::Equal,
        Comparison::NotEqual => IntCC::NotEqual,
    }
}

fn float(c: Comparison) -> FloatCC {
    match c {
        Comparison::Less => FloatCC::LessThan,
        Comparison::LessEqual => FloatCC::LessThanOrEqual,
        Comparison::Greater => FloatCC::GreaterThan,
        Comparison::GreaterEqual => FloatCC::GreaterThanOrEqual,
        Comparison::Equal => FloatCC::Equal,
        Comparison::NotEqual => FloatCC::NotEqual,
    }
}
