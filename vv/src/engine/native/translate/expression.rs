//! Expressions.

use cranelift_codegen::ir::condcodes::{FloatCC, IntCC};
use cranelift_codegen::ir::{ConstantData, InstBuilder, Type as ClifType, Value, types};

use super::known::{Fact, Found, Key};
use super::ring::Source;
use super::{Symbol, Translated, Translator, Val, clif_types, wrong_type};
use crate::engine::native::context;
use crate::engine::native::{Mutation, RED_ZONE, STACK_SEGMENT};
use crate::ir::{Binary, Comparison, Conversion, Expr, ExprKind, Item, Ring, Type, Unary};
use crate::mesh;

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
                let v = self.expression(a)?.vec()?;
                Ok(Val::One(self.coordinate(v, *axis)))
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
            ExprKind::AssignRing(local, value) => {
                self.assign_list(*local, value)?;
                Ok(Val::Void)
            }
            ExprKind::Create => Ok(Val::One(self.create()?)),
            ExprKind::Any(ring) => {
                let source = self.source(ring)?;
                let bounds = self.bounds_of(source)?;
                let first = self.any(bounds);
                self.learn_that_it_stands_in(first, source);
                if let Source::Of { v, old } = source {
                    // Who looks for it has made sure that it is not null.
                    let at = self.b.ins().iconst(types::I64, 0);
                    let found = Found {
                        start: bounds.start,
                        bytes: self.bytes_of(bounds.len),
                        at,
                        here: None,
                        certain: true,
                        flags: bounds.flags,
                    };
                    self.known.learn(Key::Find { x: first, v, old }, Fact::Found(found));
                }
                Ok(Val::One(first))
            }
            ExprKind::Next(item, ring) => self.look_up(item, ring, true),
            ExprKind::Previous(item, ring) => self.look_up(item, ring, false),
            ExprKind::IsInRing(item, ring) => {
                let x = self.sought(item)?;
                let source = self.source(ring)?;
                if let (None, Source::Of { v, old }) = (x, source) {
                    return Ok(Val::One(self.has_gap(v, old)));
                }
                let found = self.find(x, source)?;
                let is = self.is_found(found);
                Ok(Val::One(self.inverted_if(is, Mutation::IsInRingInverted)))
            }
            ExprKind::IsInSet(vertex, set) => self.is_in_set(vertex, set),
            ExprKind::Valence(ring) => {
                let source = self.source(ring)?;
                let len = self.bounds_of(source)?.len;
                let n = match source {
                    Source::Of { v, old } if !self.mutated(Mutation::ForgetsGapsOfValence) => {
                        let gaps = self.gaps(v, old)?;
                        self.b.ins().isub(len, gaps)
                    }
                    _ => len,
                };
                Ok(Val::One(self.b.ins().uextend(types::I64, n)))
            }
            ExprKind::Gaps(ring) => {
                let Source::Of { v, old } = self.source(ring)? else { return Err(wrong_type()) };
                let gaps = self.gaps(v, old)?;
                Ok(Val::One(self.b.ins().uextend(types::I64, gaps)))
            }
        }
    }

    pub(super) fn constant(&mut self, value: mesh::Value) -> Translated<Val> {
        Ok(match value {
            mesh::Value::Bool(b) => Val::One(self.b.ins().iconst(types::I8, i64::from(b))),
            mesh::Value::Int(i) => Val::One(self.b.ins().iconst(types::I64, i)),
            mesh::Value::Double(x) => Val::One(self.b.ins().f64const(x)),
            mesh::Value::Vec(v) => {
                let bytes: Vec<u8> = [v.x, v.y].iter().flat_map(|x| x.to_bits().to_le_bytes()).collect();
                let xy = self.b.func.dfg.constants.insert(ConstantData::from(bytes));
                Val::Vec([self.b.ins().vconst(types::F64X2, xy), self.b.ins().f64const(v.z)])
            }
            mesh::Value::Vertex(None) => Val::One(self.int32(0)),
            mesh::Value::Vertex(Some(_)) => return Err(wrong_type()),
        })
    }

    fn look_up(&mut self, item: &'p Item, ring: &'p Ring, forward: bool) -> Translated<Val> {
        let x = self.sought(item)?;
        let mut source = self.source(ring)?;
        if let Source::Of { old, .. } = &mut source {
            *old &= !self.mutated(Mutation::OldRingIsNew);
        }
        let found = self.find(x, source)?;
        let (y, place) = self.neighbour(found, forward);
        self.learn_that_it_stands_in(y, source);
        self.known.learn(Key::Met(y), Fact::Holds);
        if let (Some(x), Source::Of { v, old: false }) = (x, source) {
            let place = if self.mutated(Mutation::StandsBesideItself) { found.at } else { place };
            self.known.learn(Key::Beside(y), Fact::Beside { x, v, at: found.at, place });
        }
        Ok(Val::One(y))
    }

    /// What a ring holds, or null, is not the ring's vertex.
    fn learn_that_it_stands_in(&mut self, x: Value, source: Source) {
        if let Source::Of { v, .. } = source {
            self.known.learn_that_differ(x, v);
        }
    }

    fn short_circuit(&mut self, a: &'p Expr, b: &'p Expr, decides: bool) -> Translated<Val> {
        let decides = decides != self.mutated(Mutation::AndIsOr);
        if let Some((less, [a, b], limit)) = both_against_one(a, b) {
            // The smaller one is smaller if one is, the larger if both are; and the other way round.
            let [a, b, limit] = [self.vertex(a)?, self.vertex(b)?, self.vertex(limit)?];
            let smaller = (less == decides) != self.mutated(Mutation::SmallerIsLarger);
            let one = if smaller { self.b.ins().umin(a, b) } else { self.b.ins().umax(a, b) };
            let c = if less { IntCC::UnsignedLessThan } else { IntCC::UnsignedGreaterThan };
            return Ok(Val::One(self.b.ins().icmp(c, one, limit)));
        }
        let first = self.condition(a)?;
        if compares_only(b) {
            // It can be computed for nothing, and two ways that are hard to foresee become one.
            let second = self.condition(b)?;
            let both = if decides { self.b.ins().bor(first, second) } else { self.b.ins().band(first, second) };
            return Ok(Val::One(both));
        }
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
                Ok(Val::Vec([0, 1].map(|k| self.arithmetic(op, a[k], b[k]))))
            }
            Binary::MultiplyVec | Binary::DivideVec => {
                let op = if op == Binary::MultiplyVec { Binary::MultiplyDouble } else { Binary::DivideDouble };
                let (a, b) = (a.vec()?, b.one()?);
                let both = self.b.ins().splat(types::F64X2, b);
                Ok(Val::Vec([self.arithmetic(op, a[0], both), self.arithmetic(op, a[1], b)]))
            }
            Binary::ScaleByDouble => {
                let (a, b) = (a.one()?, b.vec()?);
                let both = self.b.ins().splat(types::F64X2, a);
                let op = Binary::MultiplyDouble;
                Ok(Val::Vec([self.arithmetic(op, both, b[0]), self.arithmetic(op, a, b[1])]))
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
                let (a, b) = (self.coordinates(a.vec()?), self.coordinates(b.vec()?));
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
    pub(super) fn inverted_if(&mut self, is: Value, mutation: Mutation) -> Value {
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

/// Two variables, both asked whether they are less (or both whether they are greater) than a third.
fn both_against_one<'p>(a: &'p Expr, b: &'p Expr) -> Option<(bool, [&'p Expr; 2], &'p Expr)> {
    let (ExprKind::Binary(op, x, limit), ExprKind::Binary(other, y, same)) = (&a.kind, &b.kind) else { return None };
    let less = match op {
        Binary::CompareVertex(Comparison::Less) => true,
        Binary::CompareVertex(Comparison::Greater) => false,
        _ => return None,
    };
    let local = |e: &Expr| if let ExprKind::Local(local) = e.kind { Some(local) } else { None };
    let fits = op == other && local(limit) == local(same) && [x, y, limit].iter().all(|e| local(e).is_some());
    fits.then_some((less, [&**x, &**y], &**limit))
}

/// Whether a condition compares variables and constants and nothing else: so it is cheap, and nothing goes wrong in it.
fn compares_only(e: &Expr) -> bool {
    let is_at_hand = |e: &Expr| matches!(e.kind, ExprKind::Local(_) | ExprKind::Constant(_));
    match &e.kind {
        ExprKind::Binary(op, a, b) => {
            use Binary::{CompareBool, CompareDouble, CompareInt, CompareVertex};
            let compares = matches!(op, CompareBool(_) | CompareDouble(_) | CompareInt(_) | CompareVertex(_));
            compares && is_at_hand(a) && is_at_hand(b)
        }
        ExprKind::Unary(Unary::Not, a) => compares_only(a),
        ExprKind::And(a, b) | ExprKind::Or(a, b) => compares_only(a) && compares_only(b),
        _ => is_at_hand(e),
    }
}
