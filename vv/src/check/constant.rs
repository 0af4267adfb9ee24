//! Values of file scope, computed with what a program computes with.

use crate::builtins::{Code, Random};
use crate::diagnostic::Diagnostic;
use crate::ir::{Binary, Comparison, Conversion, Expr, ExprKind, Unary};
use crate::mesh::Value;
use crate::source::Span;

use super::{Checker, GlobalValue, with_stack};

/// Why there is no value; `None` if that was reported already.
type Fault = Option<(Span, &'static str)>;

impl Checker<'_> {
    /// The value of an expression at file scope while no parameter is given from outside. Reports why there is none.
    pub(super) fn constant(&mut self, e: &Expr) -> GlobalValue {
        let mut varies = false;
        let value = match self.evaluate(e, &mut varies) {
            Ok(value) => Some(value),
            Err(Some((span, why))) => self.fail(Diagnostic::error(span, why)),
            Err(None) => None,
        };
        GlobalValue { value, varies }
    }

    fn evaluate(&self, e: &Expr, varies: &mut bool) -> Result<Value, Fault> {
        with_stack(|| self.evaluate_node(e, varies))
    }

    fn evaluate_node(&self, e: &Expr, varies: &mut bool) -> Result<Value, Fault> {
        let fault = |why| Some((e.span, why));
        let overflow = fault("this overflows");
        Ok(match &e.kind {
            ExprKind::Constant(value) => *value,
            ExprKind::Global(id) => {
                let global = self.defaults.get(id.0 as usize).ok_or(None)?;
                *varies |= global.varies;
                global.value.ok_or(None)?
            }
            ExprKind::Convert(conversion, inner) => {
                let value = self.evaluate(inner, varies)?;
                convert(*conversion, value).ok_or(fault("this does not fit into an int"))?
            }
            ExprKind::Unary(op, inner) => unary(*op, self.evaluate(inner, varies)?).ok_or(overflow)?,
            ExprKind::Binary(op, left, right) => {
                let (left, right) = (self.evaluate(left, varies)?, self.evaluate(right, varies)?);
                if matches!(op, Binary::DivideInt | Binary::RemainderInt) && right == Value::Int(0) {
                    return Err(fault("this divides by zero"));
                }
                binary(*op, left, right).ok_or(overflow)?
            }
            ExprKind::And(left, right) => {
                if self.evaluate(left, varies)? == Value::Bool(false) {
                    Value::Bool(false)
                } else {
                    self.evaluate(right, varies)?
                }
            }
            ExprKind::Or(left, right) => {
                if self.evaluate(left, varies)? == Value::Bool(true) {
                    Value::Bool(true)
                } else {
                    self.evaluate(right, varies)?
                }
            }
            ExprKind::Conditional(condition, then, otherwise) => {
                let chosen = if self.evaluate(condition, varies)? == Value::Bool(true) { then } else { otherwise };
                self.evaluate(chosen, varies)?
            }
            ExprKind::Coordinate(inner, axis) => match self.evaluate(inner, varies)? {
                Value::Vec(v) => Value::Double(v.to_array().get(*axis as usize).copied().ok_or(None)?),
                _ => return Err(None),
            },
            ExprKind::Builtin(builtin, arguments) => {
                if matches!(builtin.code(), Code::Random | Code::RandomBetween) {
                    return Err(fault("a constant cannot be random"));
                }
                let values = arguments.iter().map(|a| self.evaluate(a, varies)).collect::<Result<Vec<_>, _>>()?;
                builtin.apply(&values, &mut Random::new(0, 0)).ok_or(overflow)?
            }
            _ => return Err(fault("this is no constant")),
        })
    }
}

/// `None` for a double that is no int.
pub(super) fn convert(conversion: Conversion, value: Value) -> Option<Value> {
    Some(match (conversion, value) {
        (Conversion::BoolToInt, Value::Bool(b)) => Value::Int(i64::from(b)),
        (Conversion::BoolToDouble, Value::Bool(b)) => Value::Double(f64::from(u8::from(b))),
        (Conversion::IntToDouble, Value::Int(i)) => Value::Double(i as f64),
        (Conversion::DoubleToInt, Value::Double(x)) => {
            // -2⁶³ ≤ x < 2⁶³; both bounds are doubles.
            let fits = (-9_223_372_036_854_775_808.0..9_223_372_036_854_775_808.0).contains(&x);
            Value::Int(fits.then_some(x as i64)?)
        }
        (Conversion::IntToBool, Value::Int(i)) => Value::Bool(i != 0),
        (Conversion::DoubleToBool, Value::Double(x)) => Value::Bool(x != 0.0),
        (Conversion::VertexToBool, Value::Vertex(v)) => Value::Bool(v.is_some()),
        _ => return None,
    })
}

/// `None` on overflow.
fn unary(op: Unary, value: Value) -> Option<Value> {
    Some(match (op, value) {
        (Unary::NegateInt, Value::Int(i)) => Value::Int(i.checked_neg()?),
        (Unary::NegateDouble, Value::Double(x)) => Value::Double(-x),
        (Unary::NegateVec, Value::Vec(v)) => Value::Vec(-v),
        (Unary::Not, Value::Bool(b)) => Value::Bool(!b),
        _ => return None,
    })
}

/// `None` on overflow or division by zero.
fn binary(op: Binary, left: Value, right: Value) -> Option<Value> {
    use Value::{Bool, Double, Int, Vec, Vertex};
    Some(match (op, left, right) {
        (Binary::AddInt, Int(a), Int(b)) => Int(a.checked_add(b)?),
        (Binary::SubtractInt, Int(a), Int(b)) => Int(a.checked_sub(b)?),
        (Binary::MultiplyInt, Int(a), Int(b)) => Int(a.checked_mul(b)?),
        (Binary::DivideInt, Int(a), Int(b)) => Int(a.checked_div(b)?),
        (Binary::RemainderInt, Int(a), Int(b)) => Int(a.checked_rem(b)?),
        (Binary::AddDouble, Double(a), Double(b)) => Double(a + b),
        (Binary::SubtractDouble, Double(a), Double(b)) => Double(a - b),
        (Binary::MultiplyDouble, Double(a), Double(b)) => Double(a * b),
        (Binary::DivideDouble, Double(a), Double(b)) => Double(a / b),
        (Binary::AddVec, Vec(a), Vec(b)) => Vec(a + b),
        (Binary::SubtractVec, Vec(a), Vec(b)) => Vec(a - b),
        (Binary::MultiplyVec, Vec(a), Double(b)) => Vec(a * b),
        (Binary::ScaleByDouble, Double(a), Vec(b)) => Vec(a * b),
        (Binary::DivideVec, Vec(a), Double(b)) => Vec(a / b),
        (Binary::CompareInt(c), Int(a), Int(b)) => Bool(compare(c, &a, &b)),
        (Binary::CompareDouble(c), Double(a), Double(b)) => Bool(compare(c, &a, &b)),
        (Binary::CompareVertex(c), Vertex(a), Vertex(b)) => Bool(compare(c, &a, &b)),
        (Binary::CompareBool(c), Bool(a), Bool(b)) => Bool(compare(c, &a, &b)),
        (Binary::CompareVec(Comparison::NotEqual), Vec(a), Vec(b)) => Bool(a != b),
        (Binary::CompareVec(_), Vec(a), Vec(b)) => Bool(a == b),
        _ => return None,
    })
}

fn compare<T: PartialOrd>(comparison: Comparison, a: &T, b: &T) -> bool {
    match comparison {
        Comparison::Less => a < b,
        Comparison::LessEqual => a <= b,
        Comparison::Greater => a > b,
        Comparison::GreaterEqual => a >= b,
        Comparison::Equal => a == b,
        Comparison::NotEqual => a != b,
    }
}
