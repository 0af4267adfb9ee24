//! Values of file scope, computed with what a program computes with.

use crate::builtins::Random;
use crate::diagnostic::Diagnostic;
use crate::ir::arithmetic::{ArithmeticError, binary, convert, unary};
use crate::ir::{Expr, ExprKind};
use crate::mesh::Value;
use crate::source::Span;

use super::{Checker, GlobalValue, with_stack};

/// Where and why there is no value; `None` if that was reported already.
type Fault = Option<(Span, String)>;

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
        let computed = |result: Result<Value, ArithmeticError>| result.map_err(|why| Some((e.span, why.to_string())));
        Ok(match &e.kind {
            ExprKind::Constant(value) => *value,
            ExprKind::Global(id) => {
                let global = self.defaults.get(id.0 as usize).ok_or(None)?;
                *varies |= global.varies;
                global.value.ok_or(None)?
            }
            ExprKind::Convert(conversion, inner) => computed(convert(*conversion, self.evaluate(inner, varies)?))?,
            ExprKind::Unary(op, inner) => computed(unary(*op, self.evaluate(inner, varies)?))?,
            ExprKind::Binary(op, left, right) => {
                let (left, right) = (self.evaluate(left, varies)?, self.evaluate(right, varies)?);
                computed(binary(*op, left, right))?
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
                let values = arguments.iter().map(|a| self.evaluate(a, varies)).collect::<Result<Vec<_>, _>>()?;
                // At file scope nothing is random: that was refused.
                match builtin.apply(&values, &mut Random::new(0, 0)) {
                    Some(value) => value,
                    None => computed(Err(ArithmeticError::Overflow))?,
                }
            }
            _ => return Err(Some((e.span, "this is no constant".to_owned()))),
        })
    }
}
