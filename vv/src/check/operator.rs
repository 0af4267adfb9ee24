//! Types: what operators take and give, and which conversions are made without being asked for.

use crate::builtins::type_name;
use crate::diagnostic::Diagnostic;
use crate::ir::arithmetic::convert;
use crate::ir::{Binary, Comparison, Conversion, Expr, ExprKind, Type, Unary};
use crate::mesh::{Type as ValueType, Value};
use crate::source::Span;
use crate::syntax::tree::{BinaryOp, TypeKind};

use super::Checker;

pub(super) fn type_of(kind: TypeKind) -> Type {
    match kind {
        TypeKind::Void => Type::Void,
        TypeKind::Mesh => Type::Mesh,
        TypeKind::Ring => Type::Ring,
        TypeKind::Bool => Type::Value(ValueType::Bool),
        TypeKind::Int => Type::Value(ValueType::Int),
        TypeKind::Double => Type::Value(ValueType::Double),
        TypeKind::Vec => Type::Value(ValueType::Vec),
        TypeKind::Vertex => Type::Value(ValueType::Vertex),
    }
}

pub(super) fn value_type(kind: TypeKind) -> Option<ValueType> {
    match type_of(kind) {
        Type::Value(ty) => Some(ty),
        Type::Void | Type::Mesh | Type::Ring => None,
    }
}

/// What a type is called in messages.
pub(super) fn name(ty: Type) -> &'static str {
    match ty {
        Type::Void => "void",
        Type::Mesh => "mesh",
        Type::Ring => "ring",
        Type::Value(ty) => type_name(ty),
    }
}

/// A type with its article.
pub(super) fn a(ty: Type) -> String {
    let name = name(ty);
    let article = if name == "int" { "an" } else { "a" };
    format!("{article} `{name}`")
}

pub(super) fn symbol(op: BinaryOp) -> &'static str {
    match op {
        BinaryOp::Add => "+",
        BinaryOp::Subtract => "-",
        BinaryOp::Multiply => "*",
        BinaryOp::Divide => "/",
        BinaryOp::Remainder => "%",
        BinaryOp::Less => "<",
        BinaryOp::LessEqual => "<=",
        BinaryOp::Greater => ">",
        BinaryOp::GreaterEqual => ">=",
        BinaryOp::Equal => "==",
        BinaryOp::NotEqual => "!=",
        BinaryOp::And => "&&",
        BinaryOp::Or => "||",
    }
}

/// The operation an operator means for two types: operands are converted to `left` and `right` first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Operation {
    pub(super) op: Binary,
    pub(super) left: ValueType,
    pub(super) right: ValueType,
    pub(super) result: ValueType,
}

/// bool counts as int, and int as double beside a double; `None` where one of them is no number.
pub(super) fn common_number(a: ValueType, b: ValueType) -> Option<ValueType> {
    use ValueType::{Bool, Double, Int};
    match (a, b) {
        (Bool | Int, Bool | Int) => Some(Int),
        (Bool | Int | Double, Bool | Int | Double) => Some(Double),
        _ => None,
    }
}

/// `&&` and `||` are not among them: they do not compute both sides.
pub(super) fn operation(op: BinaryOp, left: ValueType, right: ValueType) -> Option<Operation> {
    use ValueType::{Bool, Double, Int, Vec, Vertex};
    let both = |ty, op, result| Some(Operation { op, left: ty, right: ty, result });
    let number = common_number(left, right);
    let arithmetic = |int, double, vec: Option<Binary>| match (number, vec) {
        (Some(Int), _) => both(Int, int, Int),
        (Some(_), _) => both(Double, double, Double),
        (None, Some(op)) if left == Vec && right == Vec => both(Vec, op, Vec),
        _ => None,
    };
    let scalar = |ty| matches!(ty, Bool | Int | Double);
    match op {
        BinaryOp::Add => arithmetic(Binary::AddInt, Binary::AddDouble, Some(Binary::AddVec)),
        BinaryOp::Subtract => arithmetic(Binary::SubtractInt, Binary::SubtractDouble, Some(Binary::SubtractVec)),
        BinaryOp::Multiply if left == Vec && scalar(right) => {
            Some(Operation { op: Binary::MultiplyVec, left: Vec, right: Double, result: Vec })
        }
        BinaryOp::Multiply if scalar(left) && right == Vec => {
            Some(Operation { op: Binary::ScaleByDouble, left: Double, right: Vec, result: Vec })
        }
        BinaryOp::Multiply => arithmetic(Binary::MultiplyInt, Binary::MultiplyDouble, None),
        BinaryOp::Divide if left == Vec && scalar(right) => {
            Some(Operation { op: Binary::DivideVec, left: Vec, right: Double, result: Vec })
        }
        BinaryOp::Divide => arithmetic(Binary::DivideInt, Binary::DivideDouble, None),
        BinaryOp::Remainder if number == Some(Int) => both(Int, Binary::RemainderInt, Int),
        BinaryOp::Remainder | BinaryOp::And | BinaryOp::Or => None,
        BinaryOp::Less => ordered(Comparison::Less, left, right),
        BinaryOp::LessEqual => ordered(Comparison::LessEqual, left, right),
        BinaryOp::Greater => ordered(Comparison::Greater, left, right),
        BinaryOp::GreaterEqual => ordered(Comparison::GreaterEqual, left, right),
        BinaryOp::Equal | BinaryOp::NotEqual => {
            let c = if op == BinaryOp::Equal { Comparison::Equal } else { Comparison::NotEqual };
            match (left, right) {
                (Bool, Bool) => both(Bool, Binary::CompareBool(c), Bool),
                (Vec, Vec) => both(Vec, Binary::CompareVec(c), Bool),
                (Vertex, Vertex) | (Bool | Int | Double, Bool | Int | Double) => ordered(c, left, right),
                _ => None,
            }
        }
    }
}

fn ordered(c: Comparison, left: ValueType, right: ValueType) -> Option<Operation> {
    use ValueType::{Bool, Int, Vertex};
    if left == Vertex && right == Vertex {
        return Some(Operation { op: Binary::CompareVertex(c), left, right, result: Bool });
    }
    let ty = common_number(left, right)?;
    let op = if ty == Int { Binary::CompareInt(c) } else { Binary::CompareDouble(c) };
    Some(Operation { op, left: ty, right: ty, result: Bool })
}

/// How a value of one type becomes one of another, if it can.
pub(super) enum Way {
    Same,
    By(Conversion),
    None,
}

pub(super) fn way(from: ValueType, to: ValueType) -> Way {
    use ValueType::{Bool, Double, Int, Vertex};
    match (from, to) {
        _ if from == to => Way::Same,
        (Bool, Int) => Way::By(Conversion::BoolToInt),
        (Bool, Double) => Way::By(Conversion::BoolToDouble),
        (Int, Double) => Way::By(Conversion::IntToDouble),
        (Double, Int) => Way::By(Conversion::DoubleToInt),
        (Int, Bool) => Way::By(Conversion::IntToBool),
        (Double, Bool) => Way::By(Conversion::DoubleToBool),
        (Vertex, Bool) => Way::By(Conversion::VertexToBool),
        _ => Way::None,
    }
}

/// Converts; literals are converted at once. The types fit.
pub(super) fn converted(conversion: Conversion, e: Expr, to: ValueType) -> Expr {
    let span = e.span;
    let ty = Type::Value(to);
    if let ExprKind::Constant(value) = &e.kind
        && let Ok(value) = convert(conversion, *value)
    {
        return Expr { kind: ExprKind::Constant(value), ty, span };
    }
    Expr { kind: ExprKind::Convert(conversion, Box::new(e)), ty, span }
}

/// Functions of type double whose values have no fraction.
const WHOLE: [&str; 4] = ["floor", "ceil", "round", "trunc"];

impl<'a> Checker<'a> {
    /// A value where one of type `to` is needed, converted if that may be done without being asked for.
    pub(super) fn implicitly(&mut self, e: Expr, to: ValueType) -> Option<Expr> {
        let Type::Value(from) = e.ty else { return None };
        match way(from, to) {
            Way::Same => Some(e),
            Way::By(conversion) => {
                self.warn_of_loss(conversion, &e);
                Some(converted(conversion, e, to))
            }
            Way::None => self.mismatch(&e, Type::Value(to)),
        }
    }

    /// As a condition.
    pub(super) fn truth(&mut self, e: Expr) -> Option<Expr> {
        self.implicitly(e, ValueType::Bool)
    }

    /// As `int(e)` and its like.
    pub(super) fn explicitly(&mut self, e: Expr, to: ValueType) -> Option<Expr> {
        let Type::Value(from) = e.ty else { return None };
        match way(from, to) {
            Way::Same => Some(e),
            Way::By(conversion) => Some(converted(conversion, e, to)),
            Way::None => self.mismatch(&e, Type::Value(to)),
        }
    }

    /// Reports that `e` is not of the type needed.
    pub(super) fn mismatch<T>(&mut self, e: &Expr, wanted: Type) -> Option<T> {
        if e.ty == Type::Void {
            return self.fail(Diagnostic::error(e.span, "this gives no value"));
        }
        let zero = matches!(e.kind, ExprKind::Constant(Value::Int(0)));
        let text = self.text(e.span);
        let vertex = Type::Value(ValueType::Vertex);
        let error = Diagnostic::error(e.span, format!("this is {}, not {}", a(e.ty), a(wanted)));
        let vec = Type::Value(ValueType::Vec);
        let error = match (e.ty, wanted) {
            _ if wanted == vertex && zero => error.fix("no vertex is `null`", e.span, "null"),
            _ if wanted == vec && zero => error.fix("write `vec(0, 0, 0)`", e.span, "vec(0, 0, 0)"),
            _ if e.ty == vertex && wanted == vec => {
                error.fix(format!("its position is `{text}$pos`"), e.span, format!("{text}$pos"))
            }
            (Type::Mesh, _) if wanted == vertex => error.hint(format!(
                "`forall p in {text}` walks the vertices of a mesh, `forall p in {text} n += 1;` counts them"
            )),
            (Type::Ring, _) if wanted == vertex => {
                error.hint(format!("`forall p in {text}` walks the vertices of a ring"))
            }
            (_, Type::Ring) if e.ty == vertex => {
                error.hint(format!("`ring r; forall x in {text} add x to r;` copies the ring of {text}"))
            }
            (Type::Value(ValueType::Vec), Type::Value(ValueType::Double)) => {
                error.hint("take a coordinate, `.x`, or its `length`")
            }
            _ => error,
        };
        self.fail(error)
    }

    fn warn_of_loss(&mut self, conversion: Conversion, e: &Expr) {
        match conversion {
            Conversion::DoubleToInt => {
                let whole = match &e.kind {
                    ExprKind::Constant(Value::Double(x)) => libm::trunc(*x) == *x,
                    ExprKind::Builtin(f, _) => WHOLE.contains(&f.name()),
                    _ => false,
                };
                if !whole {
                    let text = self.text(e.span);
                    self.report(Diagnostic::warning(e.span, "the fraction of this `double` is lost in an `int`").fix(
                        format!("write `int({text})` if that is meant"),
                        e.span,
                        format!("int({text})"),
                    ));
                }
            }
            Conversion::IntToDouble => self.warn_of_whole_division(e),
            _ => {}
        }
    }

    /// `1/2` is 0: where the result becomes a double, that is hardly meant.
    fn warn_of_whole_division(&mut self, e: &Expr) {
        match &e.kind {
            ExprKind::Binary(Binary::DivideInt, left, right) => {
                if let (Some(a), Some(b)) = (literal(left), literal(right))
                    && a.checked_rem(b).is_none_or(|rest| rest == 0)
                {
                    return;
                }
                let (text, fixed) = (self.text(e.span), self.as_double_division(e.span, left, right));
                let whole = if text.starts_with('(') { format!("double{text}") } else { format!("double({text})") };
                self.report(
                    Diagnostic::warning(
                        e.span,
                        format!("`{text}` divides ints, so its fraction is lost before it becomes a double"),
                    )
                    .fix(
                        format!("write `{fixed}`, or `{whole}` if the whole part is meant"),
                        e.span,
                        fixed,
                    ),
                );
            }
            ExprKind::Binary(Binary::AddInt | Binary::SubtractInt | Binary::MultiplyInt, left, right) => {
                self.warn_of_whole_division(left);
                self.warn_of_whole_division(right);
            }
            ExprKind::Conditional(_, then, otherwise) => {
                self.warn_of_whole_division(then);
                self.warn_of_whole_division(otherwise);
            }
            ExprKind::Unary(Unary::NegateInt, inner) => self.warn_of_whole_division(inner),
            _ => {}
        }
    }

    fn as_double_division(&self, span: Span, left: &Expr, right: &Expr) -> String {
        let digits = |e: &Expr| self.text(e.span).bytes().all(|b| b.is_ascii_digit());
        let (left_text, right_text) = (self.text(left.span), self.text(right.span));
        let between = self.text(Span { start: left.span.end, end: right.span.start, ..span });
        let right_fixed = if digits(right) { format!("{right_text}.0") } else { right_text.to_owned() };
        let left_fixed = match (digits(left), digits(right)) {
            (true, _) => format!("{left_text}.0"),
            (false, true) => left_text.to_owned(),
            (false, false) => format!("double({left_text})"),
        };
        // Parentheses around the division belong to its span.
        let (before, after) = (Span { end: left.span.start, ..span }, Span { start: right.span.end, ..span });
        format!("{}{left_fixed}{between}{right_fixed}{}", self.text(before), self.text(after))
    }
}

/// The value of an int literal, with its sign.
fn literal(e: &Expr) -> Option<i64> {
    match &e.kind {
        ExprKind::Constant(Value::Int(i)) => Some(*i),
        ExprKind::Unary(Unary::NegateInt, inner) => literal(inner)?.checked_neg(),
        _ => None,
    }
}
