//! The tree as an S-expression, compact enough to be read in a test.

use crate::syntax::tree::*;

pub fn ast(ast: &Ast) -> String {
    ast.items.iter().map(item).collect::<Vec<_>>().join("\n")
}

fn list(head: &str, parts: impl IntoIterator<Item = String>) -> String {
    let mut text = format!("({head}");
    for part in parts {
        text.push(' ');
        text.push_str(&part);
    }
    text.push(')');
    text
}

fn ty(ty: TypeName) -> String {
    format!("{:?}", ty.kind).to_lowercase()
}

fn item(item: &Item) -> String {
    match item {
        Item::Include { path, .. } => format!("(include {path:?})"),
        Item::Function(f) => {
            let head = if f.is_static { "static fn" } else { "fn" };
            let parameters: Vec<_> = f.parameters.iter().map(parameter).collect();
            let head = format!("{head} {} {} ({})", ty(f.return_type), f.name.text, parameters.join(", "));
            match &f.body {
                Some(body) => list(&head, body.statements.iter().map(stmt)),
                None => format!("(declared {head})"),
            }
        }
        Item::Phase { name, body } => list(&name.text, body.statements.iter().map(stmt)),
        Item::Properties { element, fields, .. } => {
            list(&format!("properties {}", format!("{element:?}").to_lowercase()), fields.iter().map(declaration))
        }
        Item::Constant(d) => declaration(d),
        Item::Param(p) => {
            let range = p.range.iter().map(|(low, high)| format!("[{} {}]", expr(low), expr(high)));
            list(&format!("param {} {} {}", ty(p.ty), p.name.text, expr(&p.value)), range)
        }
    }
}

fn parameter(p: &Parameter) -> String {
    let constant = if p.is_const { "const " } else { "" };
    let reference = if p.by_reference { "&" } else { "" };
    format!("{constant}{}{reference} {}", ty(p.ty), p.name.text)
}

fn declaration(d: &Declaration) -> String {
    let head = format!("{}{}", if d.is_const { "const " } else { "" }, ty(d.ty));
    list(
        &head,
        d.declarators.iter().map(|d| match &d.init {
            Some(init) => format!("(= {} {})", d.name.text, expr(init)),
            None => d.name.text.clone(),
        }),
    )
}

pub fn stmt(s: &Stmt) -> String {
    match &s.kind {
        StmtKind::Empty => "()".to_owned(),
        StmtKind::Block(b) => list("block", b.statements.iter().map(stmt)),
        StmtKind::Declare(d) => declaration(d),
        StmtKind::Expr(e) => expr(e),
        StmtKind::If { condition, then, otherwise } => {
            list("if", [expr(condition), stmt(then)].into_iter().chain(otherwise.iter().map(|s| stmt(s))))
        }
        StmtKind::While { condition, body } => list("while", [expr(condition), stmt(body)]),
        StmtKind::DoWhile { body, condition } => list("do", [stmt(body), expr(condition)]),
        StmtKind::For { init, condition, update, body } => list(
            "for",
            [
                init.as_ref().map_or("()".to_owned(), |s| stmt(s)),
                condition.as_ref().map_or("()".to_owned(), expr),
                list("update", update.iter().map(expr)),
                stmt(body),
            ],
        ),
        StmtKind::Forall(f) => {
            let over = if f.faces.is_some() { list("faces", [expr(&f.over)]) } else { expr(&f.over) };
            let from = f.from.as_ref().map(|f| list("from", std::iter::once(&f.corner).chain(&f.next).map(expr)));
            let follower = f.follower.as_ref().map(|f| f.text.clone());
            let head = std::iter::once(f.variable.text.clone()).chain(follower);
            list(
                if f.parallel.is_some() { "parallel-forall" } else { "forall" },
                head.chain([over]).chain(from).chain([stmt(&f.body)]),
            )
        }
        StmtKind::Break => "(break)".to_owned(),
        StmtKind::Continue => "(continue)".to_owned(),
        StmtKind::Return(value) => list("return", value.iter().map(expr)),
        StmtKind::Make { items, of } => format!("(make [{}] {})", all(items), expr(of)),
        StmtKind::MakeRing { ring, of } => list("make", [expr(ring), expr(of)]),
        StmtKind::Erase { item, from } => list("erase", [expr(item), expr(from)]),
        StmtKind::Replace { item, with, ring } => list("replace", [expr(item), expr(with), expr(ring)]),
        StmtKind::Splice { item, side, anchor, ring } => {
            list("splice", [expr(item), format!("{side:?}").to_lowercase(), expr(anchor), expr(ring)])
        }
        StmtKind::Synchronize(set) => list("synchronize", [expr(set)]),
        StmtKind::Add { vertex, set } => list("add", [expr(vertex), expr(set)]),
        StmtKind::Remove { vertex, set } => list("remove", [expr(vertex), expr(set)]),
        StmtKind::Merge { set, other } => list("merge", [expr(set), expr(other)]),
        StmtKind::Print(items) => list("print", items.iter().map(expr)),
    }
}

fn all(list: &[Expr]) -> String {
    list.iter().map(expr).collect::<Vec<_>>().join(" ")
}

/// Parentheses of the text show as `(paren …)` only where nothing else needs them.
pub fn expr(e: &Expr) -> String {
    let op = |op: &BinaryOp| match op {
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
    };
    match &e.kind {
        ExprKind::Bool(b) => b.to_string(),
        ExprKind::Int(i) => i.to_string(),
        ExprKind::Double(x) => format!("{x:?}"),
        ExprKind::Text(t) => format!("{t:?}"),
        ExprKind::Null => "null".to_owned(),
        ExprKind::Name(n) => n.clone(),
        ExprKind::Old(of) => format!("`{}", expr(of)),
        ExprKind::Edge(p, q) => format!("({}|{})", expr(p), expr(q)),
        ExprKind::Property { of, name } => format!("{}${}", expr(of), name.text),
        ExprKind::Field { of, name } => format!("{}.{}", expr(of), name.text),
        ExprKind::Call { callee, arguments } => list(&format!("call {}", callee.text), arguments.iter().map(expr)),
        ExprKind::Unary { op, operand } => {
            let op = match op {
                UnaryOp::Minus => "-",
                UnaryOp::Plus => "+",
                UnaryOp::Not => "!",
            };
            list(op, [expr(operand)])
        }
        ExprKind::Binary { op: o, left, right } => list(op(o), [expr(left), expr(right)]),
        ExprKind::Conditional { condition, then, otherwise } => {
            list("?", [expr(condition), expr(then), expr(otherwise)])
        }
        ExprKind::Assign { op: o, target, value } => {
            list(&format!("{}=", o.as_ref().map_or("", op)), [expr(target), expr(value)])
        }
        ExprKind::Step { target, by, position } => {
            let sign = if *by == Step::Up { "++" } else { "--" };
            let head = if *position == StepPosition::Before { sign.to_owned() } else { format!("post{sign}") };
            list(&head, [expr(target)])
        }
        ExprKind::Any { ring } => list("any", [expr(ring)]),
        ExprKind::Next { item, ring } => list("nextto", [expr(item), expr(ring)]),
        ExprKind::Previous { item, ring } => list("prevto", [expr(item), expr(ring)]),
        ExprKind::Is { item, of } => list("is", [expr(item), expr(of)]),
        ExprKind::Valence { ring } => list("valence", [expr(ring)]),
        ExprKind::Gaps { ring } => list("gaps", [expr(ring)]),
        ExprKind::Paren(inner) => {
            let inner = expr(inner);
            if inner.starts_with('(') { inner } else { format!("({inner})") }
        }
        ExprKind::Error => "<error>".to_owned(),
    }
}
