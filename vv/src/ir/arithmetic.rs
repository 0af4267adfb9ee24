//! What operators and conversions compute, for the checker's constants and for every engine.

use super::{Binary, Comparison, Conversion, Unary};
use crate::mesh::Value;

/// Why there is no result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum ArithmeticError {
    /// The result is no 64-bit integer.
    #[error("the result does not fit into an int")]
    Overflow,
    /// `/ 0` or `% 0` on ints.
    #[error("this divides by zero")]
    DivisionByZero,
    /// A double that is NaN or too large.
    #[error("this does not fit into an int")]
    NoInt,
    /// Operands of other types than the operation's; a checked program has none.
    #[error("this operation has operands of other types")]
    Types,
}

use ArithmeticError::{DivisionByZero, NoInt, Overflow, Types};

/// Converts a value.
///
/// # Errors
/// [`NoInt`] for a double that truncates to no 64-bit integer.
#[inline]
pub fn convert(conversion: Conversion, value: Value) -> Result<Value, ArithmeticError> {
    Ok(match (conversion, value) {
        (Conversion::BoolToInt, Value::Bool(b)) => Value::Int(i64::from(b)),
        (Conversion::BoolToDouble, Value::Bool(b)) => Value::Double(f64::from(u8::from(b))),
        (Conversion::IntToDouble, Value::Int(i)) => Value::Double(i as f64),
        (Conversion::DoubleToInt, Value::Double(x)) => {
            // Both bounds are doubles, and every double between them truncates into the range.
            let fits = (-9_223_372_036_854_775_808.0..9_223_372_036_854_775_808.0).contains(&x);
            Value::Int(fits.then_some(x as i64).ok_or(NoInt)?)
        }
        (Conversion::IntToBool, Value::Int(i)) => Value::Bool(i != 0),
        (Conversion::DoubleToBool, Value::Double(x)) => Value::Bool(x != 0.0),
        (Conversion::VertexToBool, Value::Vertex(v)) => Value::Bool(v.is_some()),
        _ => return Err(Types),
    })
}

/// The result of a one-operand operation.
///
/// # Errors
/// [`Overflow`] for the negative of the smallest int.
#[inline]
pub fn unary(op: Unary, value: Value) -> Result<Value, ArithmeticError> {
    Ok(match (op, value) {
        (Unary::NegateInt, Value::Int(i)) => Value::Int(i.checked_neg().ok_or(Overflow)?),
        (Unary::NegateDouble, Value::Double(x)) => Value::Double(-x),
        (Unary::NegateVec, Value::Vec(v)) => Value::Vec(-v),
        (Unary::Not, Value::Bool(b)) => Value::Bool(!b),
        _ => return Err(Types),
    })
}

/// The result of a two-operand operation.
///
/// # Errors
/// [`Overflow`] and [`DivisionByZero`] on ints. The smallest int `/ -1` and `% -1` overflow.
#[inline]
pub fn binary(op: Binary, left: Value, right: Value) -> Result<Value, ArithmeticError> {
    use Value::{Bool, Double, Int, Vec, Vertex};
    Ok(match (op, left, right) {
        (Binary::AddInt, Int(a), Int(b)) => Int(a.checked_add(b).ok_or(Overflow)?),
        (Binary::SubtractInt, Int(a), Int(b)) => Int(a.checked_sub(b).ok_or(Overflow)?),
        (Binary::MultiplyInt, Int(a), Int(b)) => Int(a.checked_mul(b).ok_or(Overflow)?),
        (Binary::DivideInt | Binary::RemainderInt, Int(_), Int(0)) => return Err(DivisionByZero),
        (Binary::DivideInt, Int(a), Int(b)) => Int(a.checked_div(b).ok_or(Overflow)?),
        (Binary::RemainderInt, Int(a), Int(b)) => Int(a.checked_rem(b).ok_or(Overflow)?),
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
        _ => return Err(Types),
    })
}

#[inline]
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
