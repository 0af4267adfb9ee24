//! Expressions.

use crate::builtins::{Builtin, Code, type_name};
use crate::diagnostic::Diagnostic;
use crate::ir::{
    Argument, Compound, Expr, ExprKind, FunctionId, Item, Passing, Place, Ring, Step, StepPosition, Type, Unary,
};
use crate::mesh::{Type as ValueType, Value};
use crate::source::Span;
use crate::syntax::tree::{self, BinaryOp, ExprKind as Tree, UnaryOp};

use super::operator::{Way, a, common_number, operation, symbol, way};
use super::place::{Domain, Named, Typed, bare};
use super::suggest::Wanted;
use super::{Checker, with_stack};

const BOOL: Type = Type::Value(ValueType::Bool);
const INT: Type = Type::Value(ValueType::Int);
const DOUBLE: Type = Type::Value(ValueType::Double);
const VERTEX: Type = Type::Value(ValueType::Vertex);

impl<'a> Checker<'a> {
    /// An expression of any type.
    pub(super) fn expression(&mut self, e: &'a tree::Expr) -> Option<Expr> {
        with_stack(|| self.node(e))
    }

    /// An expression that has a value: no mesh, not void.
    pub(super) fn value(&mut self, e: &'a tree::Expr) -> Option<Expr> {
        let e = self.expression(e)?;
        match e.ty {
            Type::Value(_) => Some(e),
            Type::Mesh => self.fail(Diagnostic::error(e.span, "a mesh is no value to compute with")),
            Type::Ring => {
                let text = self.text(e.span);
                let error = Diagnostic::error(e.span, "a ring is no value to compute with");
                self.fail(error.hint(format!("ask it: `valence {text}`, `any in {text}`, `is v in {text}`")))
            }
            Type::Void => self.fail(Diagnostic::error(e.span, "this gives no value")),
        }
    }

    pub(super) fn condition(&mut self, e: &'a tree::Expr) -> Option<Expr> {
        let e = self.value(e)?;
        self.truth(e)
    }

    fn node(&mut self, e: &'a tree::Expr) -> Option<Expr> {
        let span = e.span;
        let expr = |kind, ty| Some(Expr { kind, ty, span });
        let constant = |value: Value| expr(ExprKind::Constant(value), Type::Value(value.ty()));
        match &e.kind {
            Tree::Bool(b) => constant(Value::Bool(*b)),
            Tree::Int(i) => constant(Value::Int(*i)),
            Tree::Double(x) => constant(Value::Double(*x)),
            Tree::Null => constant(Value::Vertex(None)),
            Tree::Text(_) => self.fail(Diagnostic::error(span, "a text can only be printed")),
            Tree::Name(name) => self.name_expression(name, span, Wanted::Any),
            Tree::Paren(inner) => self.expression(inner).map(|e| Expr { span, ..e }),
            Tree::Old(inner) => self.misplaced_old(inner, span),
            Tree::Edge(..) => {
                self.fail(Diagnostic::error(span, "an edge has values, but is none").hint("name one: `(p|q)$name`"))
            }
            Tree::Property { of, name } => {
                let Typed { place, ty } = self.property(of, name)?;
                expr(ExprKind::Load(Box::new(place)), Type::Value(ty))
            }
            Tree::Field { of, name } => {
                let of = self.expression(of)?;
                let axis = self.axis(&of, name)?;
                let kind = match of.kind {
                    ExprKind::Local(id) => {
                        ExprKind::Load(Box::new(Place::Coordinate(Box::new(Place::Local(id)), axis)))
                    }
                    ExprKind::Load(place) => ExprKind::Load(Box::new(Place::Coordinate(place, axis))),
                    _ => ExprKind::Coordinate(Box::new(of), axis),
                };
                expr(kind, DOUBLE)
            }
            Tree::Call { callee, arguments } => self.call(callee, arguments, span),
            Tree::Unary { op, operand } => self.unary(*op, operand, span),
            Tree::Binary { op: op @ (BinaryOp::And | BinaryOp::Or), left, right } => {
                let (left, right) = (self.value(left), self.value(right));
                let (left, right) = (left.and_then(|e| self.truth(e)), right.and_then(|e| self.truth(e)));
                let (left, right) = (Box::new(left?), Box::new(right?));
                expr(if *op == BinaryOp::And { ExprKind::And(left, right) } else { ExprKind::Or(left, right) }, BOOL)
            }
            Tree::Binary { op, left, right } => self.binary(*op, left, right, span),
            Tree::Conditional { condition, then, otherwise } => self.conditional(condition, then, otherwise, span),
            Tree::Assign { op, target, value } => self.assign(*op, target, value, span),
            Tree::Step { target, by, position } => self.step(target, *by, *position, span),
            Tree::Any { ring } => {
                let ring = self.ring(ring, None)?;
                expr(ExprKind::Any(ring), VERTEX)
            }
            Tree::Next { item, ring } => {
                let (item, ring) = self.look_up(item, ring)?;
                expr(ExprKind::Next(Box::new(item), ring), VERTEX)
            }
            Tree::Previous { item, ring } => {
                let (item, ring) = self.look_up(item, ring)?;
                expr(ExprKind::Previous(Box::new(item), ring), VERTEX)
            }
            Tree::Is { item, of } => self.is(item, of, span),
            Tree::Valence { ring } => {
                let ring = self.ring(ring, None)?;
                expr(ExprKind::Valence(ring), INT)
            }
            Tree::Gaps { ring } => {
                let ring = self.ring(ring, None)?;
                self.fits(&Item::Gap(span), &ring)?;
                expr(ExprKind::Gaps(ring), INT)
            }
            Tree::Error => None,
        }
    }

    /// What is looked for, and where.
    fn look_up(&mut self, item: &'a tree::Expr, ring: &'a tree::Expr) -> Option<(Item, Ring)> {
        let (item_ir, ring) = (self.item(item), self.ring(ring, Some(item)));
        let (item, ring) = (item_ir?, ring?);
        self.fits(&item, &ring)?;
        Some((item, ring))
    }

    /// `is x in v` asks a ring, `is v in S` a set, in which null never is.
    fn is(&mut self, item: &'a tree::Expr, of: &'a tree::Expr, span: Span) -> Option<Expr> {
        let (item_ir, domain) = (self.item(item), self.domain(of, Some(item)));
        let kind = match (domain?, item_ir?) {
            (Domain::Ring(ring), item) => {
                self.fits(&item, &ring)?;
                ExprKind::IsInRing(Box::new(item), ring)
            }
            (Domain::Set(set), Item::Vertex(v)) => ExprKind::IsInSet(Box::new(v), Box::new(set)),
            (Domain::Set(set), Item::Gap(span)) => {
                let null = Expr { kind: ExprKind::Constant(Value::Vertex(None)), ty: VERTEX, span };
                ExprKind::IsInSet(Box::new(null), Box::new(set))
            }
        };
        Some(Expr { kind, ty: BOOL, span })
    }

    fn unary(&mut self, op: UnaryOp, operand: &'a tree::Expr, span: Span) -> Option<Expr> {
        let e = self.value(operand)?;
        let Type::Value(ty) = e.ty else { return None };
        let apply = |op, e: Expr| {
            let ty = e.ty;
            Some(Expr { kind: ExprKind::Unary(op, Box::new(e)), ty, span })
        };
        match (op, ty) {
            (UnaryOp::Not, _) => {
                let e = self.truth(e)?;
                apply(Unary::Not, e)
            }
            (_, ValueType::Vertex) => {
                let sign = if op == UnaryOp::Minus { "-" } else { "+" };
                self.fail(Diagnostic::error(span, format!("`{sign}` needs a number or a `vec`, not a `vertex`")))
            }
            (_, ValueType::Bool) => {
                let e = self.implicitly(e, ValueType::Int)?;
                if op == UnaryOp::Plus { Some(e) } else { apply(Unary::NegateInt, e) }
            }
            (UnaryOp::Plus, _) => Some(e),
            (UnaryOp::Minus, ValueType::Int) => apply(Unary::NegateInt, e),
            (UnaryOp::Minus, ValueType::Double) => apply(Unary::NegateDouble, e),
            (UnaryOp::Minus, ValueType::Vec) => apply(Unary::NegateVec, e),
        }
    }

    fn binary(&mut self, op: BinaryOp, left: &'a tree::Expr, right: &'a tree::Expr, span: Span) -> Option<Expr> {
        if op == BinaryOp::Add && [left, right].iter().any(|e| matches!(bare(e).kind, Tree::Text(_))) {
            let error = Diagnostic::error(span, "texts cannot be joined");
            let parts = format!("{}, {}", self.text(left.span), self.text(right.span));
            return self.fail(error.hint(format!("`print` writes one thing after the other: `print {parts};`")));
        }
        let (left, right) = (self.value(left), self.value(right));
        let (left, right) = (left?, right?);
        let (Type::Value(l), Type::Value(r)) = (left.ty, right.ty) else { return None };
        let Some(operation) = operation(op, l, r) else { return self.no_operation(op, &left, &right, span) };
        let (left, right) = (self.implicitly(left, operation.left)?, self.implicitly(right, operation.right)?);
        let kind = ExprKind::Binary(operation.op, Box::new(left), Box::new(right));
        Some(Expr { kind, ty: Type::Value(operation.result), span })
    }

    /// Reports that an operator does not work on two types.
    fn no_operation<T>(&mut self, op: BinaryOp, left: &Expr, right: &Expr, span: Span) -> Option<T> {
        let (l, r) = (left.ty, right.ty);
        let (left_text, right_text) = (self.text(left.span), self.text(right.span));
        let error = Diagnostic::error(span, format!("`{}` does not work on {} and {}", symbol(op), a(l), a(r)));
        let vec = Type::Value(ValueType::Vec);
        let zero = |e: &Expr| matches!(e.kind, ExprKind::Constant(Value::Int(0)));
        let error = match op {
            BinaryOp::Remainder if common(l, r) => {
                let fixed = format!("fmod({left_text}, {right_text})");
                error.fix(format!("for doubles write `{fixed}`"), span, fixed)
            }
            BinaryOp::Multiply if l == vec && r == vec => {
                error.hint("the scalar product is `dot(a, b)`, the vector product `cross(a, b)`")
            }
            BinaryOp::Equal | BinaryOp::NotEqual if l == VERTEX && zero(right) => {
                error.fix("no vertex is `null`", right.span, "null")
            }
            BinaryOp::Equal | BinaryOp::NotEqual if r == VERTEX && zero(left) => {
                error.fix("no vertex is `null`", left.span, "null")
            }
            BinaryOp::Less | BinaryOp::LessEqual | BinaryOp::Greater | BinaryOp::GreaterEqual
                if l == vec && r == vec =>
            {
                error.hint("compare coordinates or lengths")
            }
            BinaryOp::Add | BinaryOp::Subtract | BinaryOp::Multiply | BinaryOp::Divide
                if l == VERTEX || r == VERTEX =>
            {
                error.hint("positions are computed with: `v$pos`")
            }
            BinaryOp::Add | BinaryOp::Subtract if l == vec && common(r, r) => {
                error.hint(format!("to each coordinate: `vec({right_text}, {right_text}, {right_text})`"))
            }
            _ => error,
        };
        self.fail(error)
    }

    fn conditional(
        &mut self,
        condition: &'a tree::Expr,
        then: &'a tree::Expr,
        otherwise: &'a tree::Expr,
        span: Span,
    ) -> Option<Expr> {
        let condition = self.condition(condition);
        let (then, otherwise) = (self.expression(then), self.expression(otherwise));
        let (mut then, mut otherwise) = (then?, otherwise?);
        if let (Type::Value(a), Type::Value(b)) = (then.ty, otherwise.ty)
            && a != b
            && let Some(common) = common_number(a, b)
        {
            then = self.implicitly(then, common)?;
            otherwise = self.implicitly(otherwise, common)?;
        }
        let ty = then.ty;
        if ty != otherwise.ty {
            return self.fail(Diagnostic::error(
                span,
                format!("`? :` cannot choose between {} and {}", a(ty), a(otherwise.ty)),
            ));
        }
        if ty == Type::Void {
            return self
                .fail(Diagnostic::error(span, "`? :` chooses between values, and these give none").hint("use `if`"));
        }
        let kind = ExprKind::Conditional(Box::new(condition?), Box::new(then), Box::new(otherwise));
        Some(Expr { kind, ty, span })
    }

    fn assign(
        &mut self,
        op: Option<BinaryOp>,
        target: &'a tree::Expr,
        value: &'a tree::Expr,
        span: Span,
    ) -> Option<Expr> {
        if let Tree::Name(name) = &bare(target).kind
            && let Some(id) = self.body.find(name)
            && let Some(ty @ (Type::Mesh | Type::Ring)) = self.body.type_of(id)
        {
            self.body.mention(id);
            let changeable = self.changeable(id, target.span);
            if let Some(op) = op {
                let text = self.text(value.span);
                let what = if ty == Type::Mesh { "mesh" } else { "ring" };
                let error = Diagnostic::error(span, format!("`{}=` does not work on a {what}", symbol(op)));
                return self.fail(match op {
                    BinaryOp::Add if ty == Type::Ring => error.hint(format!("write `add {text} to {name};`")),
                    BinaryOp::Add => {
                        error.hint(format!("write `merge {name} with {text};` or `add {text} to {name};`"))
                    }
                    _ => error,
                });
            }
            let value = Box::new(self.whole(value, ty)?);
            changeable?;
            let kind = if ty == Type::Mesh { ExprKind::AssignSet(id, value) } else { ExprKind::AssignRing(id, value) };
            return Some(Expr { kind, ty: Type::Void, span });
        }
        let (place, value) = (self.target(target), self.value(value));
        let (Typed { place, ty }, value) = (place?, value?);
        let Some(op) = op else {
            let value = Box::new(self.implicitly(value, ty)?);
            let kind = ExprKind::Assign { place: Box::new(place), op: None, value };
            return Some(Expr { kind, ty: Type::Value(ty), span });
        };
        let Type::Value(right) = value.ty else { return None };
        let stored = Expr { kind: ExprKind::Constant(Value::zero(ty)), ty: Type::Value(ty), span: target.span };
        let Some(operation) = operation(op, ty, right) else { return self.no_operation(op, &stored, &value, span) };
        let value = Box::new(self.implicitly(value, operation.right)?);
        let widen = match way(ty, operation.left) {
            Way::By(conversion) => Some(conversion),
            Way::Same | Way::None => None,
        };
        let narrow = match way(operation.result, ty) {
            Way::Same => None,
            Way::By(conversion) => {
                if ty == ValueType::Int {
                    self.report(
                        Diagnostic::warning(span, "the fraction of the result is lost in an `int`")
                            .hint("declare the variable `double`, or convert what is stored: `i = int(…)`"),
                    );
                }
                Some(conversion)
            }
            Way::None => {
                return self.fail(Diagnostic::error(
                    span,
                    format!(
                        "the result is {}, which {} cannot hold",
                        a(Type::Value(operation.result)),
                        a(Type::Value(ty))
                    ),
                ));
            }
        };
        let op = Some(Compound { op: operation.op, widen, narrow });
        Some(Expr { kind: ExprKind::Assign { place: Box::new(place), op, value }, ty: Type::Value(ty), span })
    }

    fn step(&mut self, target: &'a tree::Expr, by: Step, position: StepPosition, span: Span) -> Option<Expr> {
        let Typed { place, ty } = self.target(target)?;
        if !matches!(ty, ValueType::Int | ValueType::Double) {
            let sign = if by == Step::Up { "++" } else { "--" };
            return self.fail(Diagnostic::error(span, format!("`{sign}` counts, and {} cannot", a(Type::Value(ty)))));
        }
        Some(Expr { kind: ExprKind::Step(Box::new(place), by, position), ty: Type::Value(ty), span })
    }

    fn call(&mut self, callee: &'a tree::Name, arguments: &'a [tree::Expr], span: Span) -> Option<Expr> {
        let name = callee.text.as_str();
        if let Some(&function) = self.function_names.get(name) {
            return self.call_function(function, callee, arguments, span);
        }
        let conversion = match name {
            "bool" => Some(ValueType::Bool),
            "int" => Some(ValueType::Int),
            "double" => Some(ValueType::Double),
            _ => None,
        };
        if let Some(to) = conversion {
            let values: Vec<Option<Expr>> = arguments.iter().map(|a| self.value(a)).collect();
            let Ok([value]) = <[_; 1]>::try_from(values) else {
                return self.fail(Diagnostic::error(span, format!("`{name}(…)` converts one value")));
            };
            return self.explicitly(value?, to).map(|e| Expr { span, ..e });
        }
        let name = if matches!(name, "point" | "vector") { "vec" } else { name };
        let rows: Vec<Builtin> = Builtin::named(name).collect();
        if rows.is_empty() {
            for argument in arguments {
                let _ = self.expression(argument);
            }
            self.unknown_function(name, callee.span);
            return None;
        }
        let values: Vec<Option<Expr>> = arguments.iter().map(|a| self.value(a)).collect();
        let values: Vec<Expr> = values.into_iter().collect::<Option<_>>()?;
        self.call_builtin(&rows, name, values, span)
    }

    fn call_builtin(&mut self, rows: &[Builtin], name: &str, values: Vec<Expr>, span: Span) -> Option<Expr> {
        let types: Vec<ValueType> = values.iter().filter_map(|e| value_of(e.ty)).collect();
        let fitting = rows.iter().filter_map(|&row| Some((effort(&types, row.parameters())?, row)));
        let Some((_, builtin)) = fitting.min_by_key(|&(effort, _)| effort) else {
            let given: Vec<&str> = types.iter().map(|&t| type_name(t)).collect();
            let mut error = Diagnostic::error(span, format!("`{name}` does not take ({})", given.join(", ")));
            for row in rows {
                error = error.evidence(format!("`{row}`: {}", row.doc()));
            }
            let hint = match (name, types.len()) {
                ("vec", 2) => Some("in the plane z is 0: `vec(x, y, 0)`"),
                ("vec", 1) => Some("a vector has three coordinates: `vec(x, x, x)`"),
                ("min" | "max", 3..) => Some("of more than two: `min(a, min(b, c))`"),
                ("length", 1) if types[0] != ValueType::Vertex => Some("of numbers: `abs(x)`"),
                ("length", 2) => Some("between two positions: `distance(a, b)`"),
                _ => None,
            };
            if let Some(hint) = hint {
                error = error.hint(hint.replace("min", if name == "max" { "max" } else { "min" }));
            }
            // `distance(p, q)`, meant of the positions.
            let positions = types.iter().map(|&t| if t == ValueType::Vertex { ValueType::Vec } else { t });
            let positions: Vec<ValueType> = positions.collect();
            if positions != types && rows.iter().any(|row| effort(&positions, row.parameters()).is_some()) {
                let texts = values.iter().zip(&types).map(|(value, &ty)| match ty {
                    ValueType::Vertex => format!("{}$pos", self.text(value.span)),
                    _ => self.text(value.span).to_owned(),
                });
                let call = format!("{name}({})", texts.collect::<Vec<_>>().join(", "));
                error = error.fix(format!("of positions: `{call}`"), span, call);
            }
            return self.fail(error);
        };
        if self.body.file_scope && matches!(builtin.code(), Code::Random | Code::RandomBetween) {
            return self.fail(Diagnostic::error(span, "what stands at file scope cannot be random"));
        }
        let mut arguments = Vec::with_capacity(values.len());
        for (value, &ty) in values.into_iter().zip(builtin.parameters()) {
            arguments.push(self.implicitly(value, ty)?);
        }
        Some(Expr { kind: ExprKind::Builtin(builtin, arguments), ty: Type::Value(builtin.returns()), span })
    }

    fn call_function(
        &mut self,
        function: FunctionId,
        callee: &'a tree::Name,
        arguments: &'a [tree::Expr],
        span: Span,
    ) -> Option<Expr> {
        let name = callee.text.as_str();
        if self.body.file_scope {
            let values: Vec<Option<Expr>> = arguments.iter().map(|a| self.value(a)).collect();
            drop(values);
            return self.fail(
                Diagnostic::error(span, format!("`{name}` cannot be called at file scope"))
                    .hint("constants are computed from numbers, other constants and the functions of the language"),
            );
        }
        self.body.effects.calls.push(function);
        let signature = &self.signatures[function.0 as usize];
        let (returns, declared, count) = (signature.returns, signature.span, signature.parameters.len());
        let parameters: Vec<(Option<Type>, Passing, &str)> =
            signature.parameters.iter().map(|p| (p.ty, p.passing, p.name)).collect();
        if count != arguments.len() {
            for argument in arguments {
                let _ = self.expression(argument);
            }
            let noun = if count == 1 { "argument" } else { "arguments" };
            return self.fail(
                Diagnostic::error(span, format!("`{name}` takes {count} {noun}, not {}", arguments.len()))
                    .label(declared, "declared here"),
            );
        }
        let checked: Vec<Option<Argument>> = arguments
            .iter()
            .zip(parameters)
            .map(|(argument, (ty, passing, parameter))| match passing {
                Passing::Reference => self.reference(argument, ty, parameter, name),
                Passing::Value => self.passed_value(argument, ty),
            })
            .collect();
        let arguments = checked.into_iter().collect::<Option<Vec<_>>>()?;
        Some(Expr { kind: ExprKind::Call(function, arguments), ty: returns, span })
    }

    fn passed_value(&mut self, argument: &'a tree::Expr, ty: Option<Type>) -> Option<Argument> {
        if let Some(ty @ (Type::Mesh | Type::Ring)) = ty {
            return self.whole(argument, ty).map(Argument::Value);
        }
        let value = self.value(argument)?;
        let Type::Value(ty) = ty? else { return None };
        self.implicitly(value, ty).map(Argument::Value)
    }

    /// What a `T&` refers to: a variable of exactly that type.
    fn reference(
        &mut self,
        argument: &'a tree::Expr,
        ty: Option<Type>,
        parameter: &str,
        function: &str,
    ) -> Option<Argument> {
        let inner = bare(argument);
        let Tree::Name(name) = &inner.kind else {
            self.expression(inner)?;
            return self.fail(
                Diagnostic::error(
                    argument.span,
                    format!("`{function}` changes its `{parameter}`, so a variable must be given"),
                )
                .hint("keep the value in a variable and give that"),
            );
        };
        let named = self.named(name, inner.span, Wanted::Any)?;
        let ty = ty?;
        match named {
            Named::Local(id, found) if found == ty => {
                self.changeable(id, inner.span)?;
                self.body.mention(id);
                Some(Argument::Reference(id))
            }
            Named::Local(_, found) => self.fail(Diagnostic::error(
                inner.span,
                format!(
                    "`{function}` changes its `{parameter}`, so {} variable must be given, not {}",
                    a(ty),
                    a(found)
                ),
            )),
            Named::Global(..) | Named::Number(_) => self.fail(Diagnostic::error(
                inner.span,
                format!("`{function}` changes its `{parameter}`, and `{name}` cannot be changed"),
            )),
        }
    }
}

fn value_of(ty: Type) -> Option<ValueType> {
    match ty {
        Type::Value(ty) => Some(ty),
        Type::Void | Type::Mesh | Type::Ring => None,
    }
}

fn common(a: Type, b: Type) -> bool {
    matches!((value_of(a), value_of(b)), (Some(a), Some(b)) if common_number(a, b).is_some())
}

/// What it takes to turn arguments into parameters without loss; `None` if that is not possible.
fn effort(from: &[ValueType], to: &[ValueType]) -> Option<u32> {
    use ValueType::{Bool, Double, Int};
    if from.len() != to.len() {
        return None;
    }
    from.iter().zip(to).try_fold(0, |sum, pair| {
        Some(
            sum + match pair {
                (a, b) if a == b => 0,
                (Bool, Int) => 1,
                (Int, Double) => 2,
                (Bool, Double) => 3,
                _ => return None,
            },
        )
    })
}

/// Whether computing an expression does more than give its value.
pub(super) fn has_effect(e: &Expr) -> bool {
    match &e.kind {
        ExprKind::Assign { .. }
        | ExprKind::AssignSet(..)
        | ExprKind::AssignRing(..)
        | ExprKind::Step(..)
        | ExprKind::Call(..)
        | ExprKind::Create => true,
        ExprKind::Builtin(f, arguments) => {
            matches!(f.code(), Code::Random | Code::RandomBetween) || arguments.iter().any(has_effect)
        }
        ExprKind::Convert(_, a) | ExprKind::Unary(_, a) | ExprKind::Coordinate(a, _) => has_effect(a),
        ExprKind::Binary(_, a, b) | ExprKind::And(a, b) | ExprKind::Or(a, b) | ExprKind::IsInSet(a, b) => {
            has_effect(a) || has_effect(b)
        }
        ExprKind::Conditional(a, b, c) => has_effect(a) || has_effect(b) || has_effect(c),
        ExprKind::Any(ring) | ExprKind::Valence(ring) | ExprKind::Gaps(ring) => ring_has_effect(ring),
        ExprKind::Next(item, ring) | ExprKind::Previous(item, ring) | ExprKind::IsInRing(item, ring) => {
            let item = match &**item {
                Item::Vertex(e) => has_effect(e),
                Item::Gap(_) => false,
            };
            item || ring_has_effect(ring)
        }
        ExprKind::Constant(_) | ExprKind::Local(_) | ExprKind::Global(_) => false,
        ExprKind::Load(place) => place_has_effect(place),
    }
}

fn ring_has_effect(ring: &Ring) -> bool {
    match ring {
        Ring::Of { vertex, .. } => has_effect(vertex),
        Ring::Variable { .. } => false,
    }
}

fn place_has_effect(place: &Place) -> bool {
    match place {
        Place::Local(_) | Place::MeshProperty { .. } => false,
        Place::Position { vertex, .. } | Place::VertexProperty { vertex, .. } => has_effect(vertex),
        Place::EdgeProperty { ends: [p, q], .. } => has_effect(p) || has_effect(q),
        Place::Coordinate(base, _) => place_has_effect(base),
    }
}
