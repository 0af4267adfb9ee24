//! What expressions and statements become: every conversion and kind of operation is explicit.

use vv::ir::{Argument, Compound, Expr, ExprKind, Function, Item, Place, Program, Ring, Stmt, StmtKind, Type};

use super::compiled;

/// Checks a statement in a function with the parameters below; shows what becomes of it.
#[track_caller]
fn check(statement: &str, expected: &str) {
    let text = format!(
        "vertex {{ double age; int kind; }};
         edge {{ double sharpness = 1; }};
         mesh {{ int generation; }};
         const double k = 1;
         void f(mesh& S, vertex p, vertex q, bool b, int i, double x, vec n) {{ {statement} }}
         vertex g(int& i, double x, mesh M) {{ i++; print x, M; return null; }}"
    );
    let c = compiled(&text);
    let errors: Vec<_> = c.diagnostics.iter().filter(|d| d.severity == vv::diagnostic::Severity::Error).collect();
    let program = c.program.as_ref().unwrap_or_else(|| panic!("{errors:?}"));
    let f = program.functions.first().expect("f");
    assert_eq!(Printer { program, f }.statements(&f.body), expected);
}

struct Printer<'p> {
    program: &'p Program,
    f: &'p Function,
}

impl Printer<'_> {
    fn statements(&self, statements: &[Stmt]) -> String {
        statements.iter().map(|s| self.statement(s)).collect::<Vec<_>>().join(" ")
    }

    fn statement(&self, s: &Stmt) -> String {
        let local = |l: &vv::ir::LocalId| self.f.locals[l.0 as usize].name.clone();
        match &s.kind {
            StmtKind::Declare { local: l, init: Some(init) } => format!("{} := {};", local(l), self.expr(init)),
            StmtKind::Declare { local: l, init: None } => format!("{} := zero;", local(l)),
            StmtKind::Expr(e) => format!("{};", self.expr(e)),
            StmtKind::Block(inner) => format!("{{ {} }}", self.statements(inner)),
            StmtKind::If { condition, then, otherwise } => format!(
                "if {} {{ {} }} else {{ {} }}",
                self.expr(condition),
                self.statements(then),
                self.statements(otherwise)
            ),
            StmtKind::Loop { condition, body, update, body_first } => {
                let condition = condition.as_ref().map_or("true".to_owned(), |c| self.expr(c));
                let update: Vec<_> = update.iter().map(|u| self.expr(u)).collect();
                let word = if *body_first { "do-while" } else { "while" };
                format!("{word} {condition} update [{}] {{ {} }}", update.join(", "), self.statements(body))
            }
            StmtKind::ForallSet { local: l, set, body, .. } => {
                format!("forall {} in set {} {{ {} }}", local(l), self.expr(set), self.statements(body))
            }
            StmtKind::ForallRing { local: l, follower, ring, from, body } => {
                let follower = follower.as_ref().map_or(String::new(), |l| format!(", {}", local(l)));
                let from = from.as_ref().map_or(String::new(), |from| {
                    let next = from.next.as_ref().map_or(String::new(), |next| format!(", {}", self.expr(next)));
                    format!(" from {}{next}", self.expr(&from.corner))
                });
                format!("forall {}{follower} in {}{from} {{ {} }}", local(l), self.ring(ring), self.statements(body))
            }
            StmtKind::ForallFaces { local: l, set, body } => {
                format!("forall {} in faces {} {{ {} }}", local(l), self.expr(set), self.statements(body))
            }
            StmtKind::MakeRing { ring, of } => format!("make {} of {};", local(ring), self.expr(of)),
            StmtKind::Append { vertex, ring } => format!("append {} to {};", self.expr(vertex), local(ring)),
            StmtKind::Make { items, of } => {
                let items: Vec<_> = items.iter().map(|i| self.item(i)).collect();
                format!("make {{{}}} of {};", items.join(", "), self.expr(of))
            }
            StmtKind::Erase { item, from } => format!("erase {} from {};", self.item(item), self.ring(from)),
            other => format!("{other:?}"),
        }
    }

    fn ring(&self, ring: &Ring) -> String {
        match ring {
            Ring::Of { vertex, old } => format!("{}ring({})", if *old { "old " } else { "" }, self.expr(vertex)),
            Ring::Variable { local, .. } => self.f.locals[local.0 as usize].name.clone(),
        }
    }

    fn item(&self, item: &Item) -> String {
        match item {
            Item::Gap(_) => "gap".to_owned(),
            Item::Vertex(e) => self.expr(e),
        }
    }

    fn place(&self, place: &Place) -> String {
        let mark = |old: &bool| if *old { "old " } else { "" };
        match place {
            Place::Local(l) => self.f.locals[l.0 as usize].name.clone(),
            Place::Position { vertex, old } => format!("{}{}$pos", mark(old), self.expr(vertex)),
            Place::VertexProperty { property, vertex, old } => {
                let name = &self.program.vertex_properties[*property as usize].name;
                format!("{}{}${name}", mark(old), self.expr(vertex))
            }
            Place::EdgeProperty { property, ends: [p, q], old } => {
                let name = &self.program.edge_properties[*property as usize].name;
                format!("{}({}|{})${name}", mark(old), self.expr(p), self.expr(q))
            }
            Place::MeshProperty { property, set } => {
                let name = &self.program.mesh_properties[*property as usize].name;
                format!("{}${name}", self.f.locals[set.0 as usize].name)
            }
            Place::Coordinate(base, axis) => format!("{}.{}", self.place(base), ["x", "y", "z"][*axis as usize]),
        }
    }

    fn expr(&self, e: &Expr) -> String {
        let list = |es: &[&Expr]| es.iter().map(|e| self.expr(e)).collect::<Vec<_>>().join(", ");
        match &e.kind {
            ExprKind::Constant(value) => {
                assert_eq!(e.ty, Type::Value(value.ty()));
                format!("{value:?}").replace("Vertex(None)", "null")
            }
            ExprKind::Local(l) => self.f.locals[l.0 as usize].name.clone(),
            ExprKind::Global(g) => self.program.globals[g.0 as usize].name.clone(),
            ExprKind::Load(place) => self.place(place),
            ExprKind::Convert(c, inner) => format!("{c:?}({})", self.expr(inner)),
            ExprKind::Unary(op, inner) => format!("{op:?}({})", self.expr(inner)),
            ExprKind::Binary(op, a, b) => format!("{}({})", format!("{op:?}").replace(['(', ')'], ""), list(&[a, b])),
            ExprKind::And(a, b) => format!("And({})", list(&[a, b])),
            ExprKind::Or(a, b) => format!("Or({})", list(&[a, b])),
            ExprKind::Conditional(c, a, b) => format!("Conditional({})", list(&[c, a, b])),
            ExprKind::Coordinate(inner, axis) => format!("{}.{}", self.expr(inner), ["x", "y", "z"][*axis as usize]),
            ExprKind::Call(f, arguments) => {
                let arguments: Vec<_> = arguments
                    .iter()
                    .map(|a| match a {
                        Argument::Value(e) => self.expr(e),
                        Argument::Reference(l) => format!("&{}", self.f.locals[l.0 as usize].name),
                    })
                    .collect();
                format!("{}({})", self.program.functions[f.0 as usize].name, arguments.join(", "))
            }
            ExprKind::Builtin(f, arguments) => format!("{}({})", f.name(), list(&arguments.iter().collect::<Vec<_>>())),
            ExprKind::Assign { place, op, value } => {
                let op = op.as_ref().map_or(String::new(), |Compound { op, widen, narrow }| {
                    let conversion = |c: &Option<_>| c.map_or(String::new(), |c: vv::ir::Conversion| format!("{c:?} "));
                    format!("{}{op:?} {}", conversion(widen), conversion(narrow))
                });
                format!("{} {op}= {}", self.place(place), self.expr(value))
            }
            ExprKind::Step(place, by, position) => format!("{by:?} {position:?} {}", self.place(place)),
            ExprKind::AssignSet(l, set) => format!("{} = set {}", self.f.locals[l.0 as usize].name, self.expr(set)),
            ExprKind::AssignRing(l, ring) => format!("{} = ring {}", self.f.locals[l.0 as usize].name, self.expr(ring)),
            ExprKind::Create => "create".to_owned(),
            ExprKind::Any(ring) => format!("any({})", self.ring(ring)),
            ExprKind::Next(item, ring) => format!("next({}, {})", self.item(item), self.ring(ring)),
            ExprKind::Previous(item, ring) => format!("previous({}, {})", self.item(item), self.ring(ring)),
            ExprKind::IsInRing(item, ring) => format!("is({}, {})", self.item(item), self.ring(ring)),
            ExprKind::IsInSet(v, set) => format!("is({}, set {})", self.expr(v), self.expr(set)),
            ExprKind::Valence(ring) => format!("valence({})", self.ring(ring)),
            ExprKind::Gaps(ring) => format!("gaps({})", self.ring(ring)),
        }
    }
}

#[test]
fn declarations() {
    check("double d = valence p;", "d := IntToDouble(valence(ring(p)));");
    check("double d = 2, e;", "d := Double(2.0); e := zero;");
    check("vertex v;", "v := create;");
    check("vertex v = null;", "v := null;");
    check("mesh P = S, E, F;", "P := S; E := zero; F := zero;");
    check("vec v(1, x, i);", "v := vec(Double(1.0), x, IntToDouble(i));");
}

#[test]
fn arithmetic_widens_to_the_wider_operand() {
    check("x = i + x;", "x = AddDouble(IntToDouble(i), x);");
    check("i = b + b;", "i = AddInt(BoolToInt(b), BoolToInt(b));");
    check("x = b * x;", "x = MultiplyDouble(BoolToDouble(b), x);");
    check("i = 7 / 2 % i;", "i = RemainderInt(DivideInt(Int(7), Int(2)), i);");
    check("x = -b;", "x = IntToDouble(NegateInt(BoolToInt(b)));");
}

#[test]
fn vectors_are_scaled_by_doubles() {
    check(
        "n = 2 * n * i / b;",
        "n = DivideVec(MultiplyVec(ScaleByDouble(Double(2.0), n), IntToDouble(i)), BoolToDouble(b));",
    );
    check("p$pos *= 1.0 - x;", "p$pos MultiplyVec = SubtractDouble(Double(1.0), x);");
    check("p$pos += k * `q$pos;", "p$pos AddVec = ScaleByDouble(k, old q$pos);");
}

#[test]
fn comparisons() {
    check("b = p < q;", "b = CompareVertexLess(p, q);");
    check("b = p == null;", "b = CompareVertexEqual(p, null);");
    check("b = i < x;", "b = CompareDoubleLess(IntToDouble(i), x);");
    check("b = b == i;", "b = CompareIntEqual(BoolToInt(b), i);");
    check("b = b != true;", "b = CompareBoolNotEqual(b, Bool(true));");
    check("b = n != n;", "b = CompareVecNotEqual(n, n);");
}

#[test]
fn conditions() {
    check("if (i) ; else ;", "if IntToBool(i) {  } else {  }");
    check("b = p && !q || x;", "b = Or(And(VertexToBool(p), Not(VertexToBool(q))), DoubleToBool(x));");
    check("while (1) break;", "while Bool(true) update [] { Break }");
    check("x = p ? i : x;", "x = Conditional(VertexToBool(p), IntToDouble(i), x);");
    check("p = b ? null : q;", "p = Conditional(b, null, q);");
}

#[test]
fn loops() {
    check(
        "for (int j = 0; j < 3; j++) i += j;",
        "{ j := Int(0); while CompareIntLess(j, Int(3)) update [Up After j] { i AddInt = j; } }",
    );
    check("do i++; while (b);", "do-while b update [] { Up After i; }");
    check("forall v in S v$age = 1;", "forall v in set S { v$age = Double(1.0); }");
    check("forall v in `p forall w in v ;", "forall v in old ring(p) { forall w in ring(v) {  } }");
}

#[test]
fn stores_convert_to_the_type_of_the_place() {
    check("i = x;", "i = DoubleToInt(x);");
    check("i *= x;", "i IntToDouble MultiplyDouble DoubleToInt = x;");
    check("b += 1;", "b BoolToInt AddInt IntToBool = Int(1);");
    check("x += i;", "x AddDouble = IntToDouble(i);");
    check("p$pos.x = i;", "p$pos.x = IntToDouble(i);");
    check("p$kind = --i;", "p$kind = Down Before i;");
    check("x = i = b;", "x = IntToDouble(i = BoolToInt(b));");
    check("S$generation++;", "Up After S$generation;");
    check("(p|q)$sharpness /= 2;", "(p|q)$sharpness DivideDouble = Double(2.0);");
    check("S = S;", "S = set S;");
}

#[test]
fn explicit_conversions() {
    check("i = int(x) + int(b);", "i = AddInt(DoubleToInt(x), BoolToInt(b));");
    check("x = double(i / 2);", "x = IntToDouble(DivideInt(i, Int(2)));");
    check("b = bool(p);", "b = VertexToBool(p);");
}

#[test]
fn coordinates_are_read_where_they_are() {
    check("x = n.y;", "x = n.y;");
    check("x = `p$pos.z;", "x = old p$pos.z;");
    check("x = (n + n).x;", "x = AddVec(n, n).x;");
}

#[test]
fn functions_of_the_language_take_the_nearest_types() {
    check("i = max(i, b);", "i = max(i, BoolToInt(b));");
    check("x = max(i, x);", "x = max(IntToDouble(i), x);");
    check("x = pow(2, i);", "x = pow(Double(2.0), IntToDouble(i));");
    check("x = abs(x) + cos(tau);", "x = AddDouble(abs(x), cos(Double(6.283185307179586)));");
}

#[test]
fn calls_pass_values_and_variables() {
    check("p = g(i, i, S);", "p = g(&i, IntToDouble(i), S);");
}

#[test]
fn rings_and_gaps() {
    check(
        "make {nextto p in q, null, (null), prevto null in p} nb_of q;",
        "make {next(p, ring(q)), gap, gap, previous(gap, ring(p))} of q;",
    );
    check("b = is p in S || is p in `q;", "b = Or(is(p, set S), is(p, old ring(q)));");
    check("erase any in `(nextto p in `q) from p;", "erase any(old ring(next(p, old ring(q)))) from ring(p);");
    check("b = is null in S;", "b = is(null, set S);");
    check("i = gaps p + valence `p;", "i = AddInt(gaps(ring(p)), valence(old ring(p)));");
}
