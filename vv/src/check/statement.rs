//! Statements. Each tells whether the one after it can be reached.

use crate::diagnostic::{Diagnostic, Severity};
use crate::ir::{self, Expr, ExprKind, Item, LocalId, Passing, Place, PrintItem, Ring, Stmt, StmtKind, Type};
use crate::mesh::{Type as ValueType, Value};
use crate::source::Span;
use crate::syntax::tree::{self, ExprKind as Tree, StmtKind as TreeStmt};

use super::body::{NewLocal, Role};
use super::expression::has_effect;
use super::leaving::{leaves_loop, leaving};
use super::operator::{a, type_of};
use super::place::{Domain, bare};
use super::{Checker, with_stack};

const VERTEX: Type = Type::Value(ValueType::Vertex);

impl<'a> Checker<'a> {
    /// Statements in a row; false if the end of the row cannot be reached.
    pub(super) fn statements(&mut self, statements: &'a [tree::Stmt], out: &mut Vec<Stmt>) -> bool {
        let mut reached = true;
        let mut told = false;
        for statement in statements {
            if !reached && !told && !matches!(statement.kind, TreeStmt::Empty) {
                told = true;
                self.report(Diagnostic::warning(statement.span, "this is never reached"));
            }
            reached &= self.statement(statement, out);
        }
        reached
    }

    /// The body of a loop or a branch: its own scope, which `open` has opened if it declares a variable for it.
    fn inner(&mut self, statement: &'a tree::Stmt) -> (Vec<Stmt>, bool) {
        let mut out = Vec::new();
        let reached = match &statement.kind {
            TreeStmt::Block(block) => self.statements(&block.statements, &mut out),
            _ => self.statement(statement, &mut out),
        };
        (out, reached)
    }

    fn branch(&mut self, statement: &'a tree::Stmt) -> (Vec<Stmt>, bool) {
        self.open_scope();
        let result = self.inner(statement);
        self.close_scope();
        result
    }

    fn statement(&mut self, s: &'a tree::Stmt, out: &mut Vec<Stmt>) -> bool {
        with_stack(|| self.statement_node(s, out))
    }

    fn statement_node(&mut self, s: &'a tree::Stmt, out: &mut Vec<Stmt>) -> bool {
        let span = s.span;
        let kind = match &s.kind {
            TreeStmt::Empty => None,
            TreeStmt::Block(block) => {
                let mut inner = Vec::new();
                self.open_scope();
                let reached = self.statements(&block.statements, &mut inner);
                self.close_scope();
                out.push(Stmt { kind: StmtKind::Block(inner), span });
                return reached;
            }
            TreeStmt::Declare(declaration) => {
                self.declaration(declaration, out);
                None
            }
            TreeStmt::Expr(e) => self.expression_statement(e),
            TreeStmt::If { condition, then, otherwise } => {
                let condition = self.condition(condition);
                let (then, then_reached) = self.branch(then);
                let (otherwise, otherwise_reached) =
                    otherwise.as_ref().map_or_else(|| (Vec::new(), true), |o| self.branch(o));
                if let Some(condition) = condition {
                    out.push(Stmt { kind: StmtKind::If { condition, then, otherwise }, span });
                }
                return then_reached || otherwise_reached;
            }
            TreeStmt::While { condition, body } => {
                let condition = self.condition(condition);
                let asked = self.asked(condition.as_ref());
                let body = self.loop_body(body);
                self.warn_of_idle_loop(condition.as_ref(), &asked, &body.0);
                return self.close_loop(Some(condition), Vec::new(), body, false, span, out);
            }
            TreeStmt::DoWhile { body, condition } => {
                let body = self.loop_body(body);
                let condition = self.condition(condition);
                return self.close_loop(Some(condition), Vec::new(), body, true, span, out);
            }
            TreeStmt::For { init, condition, update, body } => {
                return self.for_loop(init.as_deref(), condition.as_ref(), update, body, span, out);
            }
            TreeStmt::Forall(forall) => self.forall(forall),
            TreeStmt::Break | TreeStmt::Continue => {
                let is_break = matches!(s.kind, TreeStmt::Break);
                if self.body.loops == 0 {
                    let word = if is_break { "break" } else { "continue" };
                    self.report(Diagnostic::error(span, format!("there is no loop around this `{word}`")));
                    return true;
                }
                out.push(Stmt { kind: if is_break { StmtKind::Break } else { StmtKind::Continue }, span });
                return false;
            }
            TreeStmt::Return(value) => {
                if let Some(value) = self.return_value(value.as_ref(), span) {
                    out.push(Stmt { kind: StmtKind::Return(value), span });
                }
                return false;
            }
            TreeStmt::Make { items, .. } if items.len() == 1 && self.named_ring(&items[0]).is_some() => {
                let item = &items[0];
                let error = Diagnostic::error(item.span, "this is a `ring`, and a list holds vertices");
                self.report(error.hint(format!("write `make {} nb_of v;` without braces", self.text(item.span))));
                None
            }
            TreeStmt::Make { items, of } => {
                let items: Vec<_> = items.iter().map(|item| self.item(item)).collect();
                let of = self.ring_taker(of);
                items.into_iter().collect::<Option<_>>().zip(of).map(|(items, of)| StmtKind::Make { items, of })
            }
            TreeStmt::MakeRing { ring, of } => {
                let (ring, of) = (self.made_ring(ring), self.ring_taker(of));
                ring.zip(of).map(|(ring, of)| StmtKind::MakeRing { ring, of })
            }
            TreeStmt::Erase { item, from } => {
                let ([item], from) = self.edit([item], from);
                item.zip(from).map(|(item, from)| StmtKind::Erase { item, from })
            }
            TreeStmt::Replace { item, with, ring } => {
                let ([item, with], ring) = self.edit([item, with], ring);
                item.zip(with).zip(ring).map(|((item, with), ring)| StmtKind::Replace { item, with, ring })
            }
            TreeStmt::Splice { item, side, anchor, ring } => {
                let ([item, anchor], ring) = self.edit([item, anchor], ring);
                let parts = item.zip(anchor).zip(ring);
                parts.map(|((item, anchor), ring)| StmtKind::Splice { item, side: *side, anchor, ring })
            }
            TreeStmt::Synchronize(set) => {
                self.body.effects.synchronizes.get_or_insert(span);
                self.mesh(set).map(StmtKind::Synchronize)
            }
            TreeStmt::Add { vertex, set } => self.add(vertex, set),
            TreeStmt::Remove { vertex, set } => {
                if let Some((text, ring)) = self.named_ring(set) {
                    let vertex = self.text(vertex.span);
                    let error = Diagnostic::error(set.span, "this is a `ring`, not a `mesh`");
                    self.report(error.hint(format!("write `erase {vertex} from {text};`")));
                    self.body.mention(ring);
                    return true;
                }
                if self.is_vertex(set) {
                    let (vertex, of) = (self.text(vertex.span), self.text(set.span));
                    let error = Diagnostic::error(set.span, "this is a `vertex`, not a `mesh`");
                    self.report(error.hint(format!("write `erase {vertex} from {of};`")));
                    return true;
                }
                let (vertex, set) = (self.vertex(vertex), self.set(set));
                vertex.zip(set).map(|(vertex, set)| StmtKind::Remove { vertex, set })
            }
            TreeStmt::Merge { set, .. } if self.named_ring(set).is_some() => {
                let text = self.text(set.span);
                let error = Diagnostic::error(set.span, "this is a `ring`, and meshes are merged");
                self.report(error.hint(format!("rings grow vertex by vertex: `add v to {text};`")));
                None
            }
            TreeStmt::Merge { set, other } => {
                let (set, other) = (self.set(set), self.merged(set, other));
                set.zip(other).map(|(set, other)| StmtKind::Merge { set, other })
            }
            TreeStmt::Print(items) => {
                let items: Vec<_> = items.iter().map(|item| self.print_item(item)).collect();
                items.into_iter().collect::<Option<_>>().map(StmtKind::Print)
            }
        };
        if let Some(kind) = kind {
            out.push(Stmt { kind, span });
        }
        true
    }

    /// Items and the ring that they are looked for in or put into; `None` for what is faulty.
    fn edit<const N: usize>(
        &mut self,
        items: [&'a tree::Expr; N],
        ring: &'a tree::Expr,
    ) -> ([Option<Item>; N], Option<Ring>) {
        let items = items.map(|item| self.item(item));
        let ring = self.edited(ring);
        let items = items.map(|item| match &ring {
            Some(ring) => item.filter(|item| self.fits(item, ring).is_some()),
            None => item,
        });
        (items, ring)
    }

    /// The ring variable that is named, with its name.
    fn named_ring(&self, e: &'a tree::Expr) -> Option<(&'a str, LocalId)> {
        let Tree::Name(name) = &bare(e).kind else { return None };
        let id = self.body.find(name)?;
        (self.body.type_of(id) == Some(Type::Ring)).then_some((name, id))
    }

    /// Whether a variable is named that is a vertex.
    fn is_vertex(&mut self, e: &'a tree::Expr) -> bool {
        let Tree::Name(name) = &bare(e).kind else { return false };
        let id = self.body.find(name).filter(|&id| self.body.type_of(id) == Some(VERTEX));
        if let Some(id) = id {
            self.body.mention(id);
        }
        id.is_some()
    }

    fn add(&mut self, vertex: &'a tree::Expr, set: &'a tree::Expr) -> Option<StmtKind> {
        if let Tree::Name(name) = &bare(vertex).kind
            && let Some(id) = self.body.find(name)
            && self.body.type_of(id) == Some(Type::Mesh)
        {
            self.body.mention(id);
            let text = self.text(set.span);
            return self.fail(
                Diagnostic::error(vertex.span, format!("`{name}` is a mesh, and vertices are added"))
                    .hint(format!("write `merge {text} with {name};`")),
            );
        }
        if self.is_vertex(set) {
            let (vertex, of) = (self.text(vertex.span), self.text(set.span));
            let error = Diagnostic::error(set.span, "this is a `vertex`, not a `mesh`");
            return self.fail(error.hint(format!("into the ring of {of}: `splice {vertex} after a in {of};`")));
        }
        let (vertex, to) = (self.vertex(vertex), self.collection(set));
        vertex.zip(to).map(|(vertex, (id, ty))| match ty {
            Type::Ring => StmtKind::Append { vertex, ring: id },
            _ => StmtKind::Add { vertex, set: id },
        })
    }

    fn merged(&mut self, set: &'a tree::Expr, other: &'a tree::Expr) -> Option<Expr> {
        let mesh = self.expression(other)?;
        if mesh.ty == VERTEX {
            let (text, set) = (self.text(other.span), self.text(set.span));
            return self.fail(
                Diagnostic::error(mesh.span, "this is a vertex, and meshes are merged")
                    .hint(format!("write `add {text} to {set};`")),
            );
        }
        if mesh.ty == Type::Mesh { Some(mesh) } else { self.mismatch(&mesh, Type::Mesh) }
    }

    fn print_item(&mut self, e: &'a tree::Expr) -> Option<PrintItem> {
        if let Tree::Text(text) = &bare(e).kind {
            return Some(PrintItem::Text(text.clone()));
        }
        let value = self.expression(e)?;
        if value.ty == Type::Void {
            return self.fail(Diagnostic::error(e.span, "this gives no value to print"));
        }
        Some(PrintItem::Value(value))
    }

    fn declaration(&mut self, declaration: &'a tree::Declaration, out: &mut Vec<Stmt>) {
        let ty = Some(type_of(declaration.ty.kind)).filter(|&t| t != Type::Void);
        if ty.is_none() {
            self.report(Diagnostic::error(declaration.ty.span, "a variable cannot be `void`"));
        }
        for d in &declaration.declarators {
            // The name is visible only after its first value.
            let init = d.init.as_ref().map(|init| match ty {
                Some(ty @ (Type::Mesh | Type::Ring)) => self.whole(init, ty),
                Some(Type::Value(ty)) => {
                    let value = if ty == ValueType::Vertex { self.expression(init) } else { self.value(init) };
                    value.and_then(|value| match value.ty {
                        Type::Value(_) => self.implicitly(value, ty),
                        _ => self.mismatch(&value, Type::Value(ty)),
                    })
                }
                Some(Type::Void) | None => self.expression(init),
            });
            let new = NewLocal {
                name: &d.name.text,
                span: d.name.span,
                ty,
                role: Role::Local,
                is_const: declaration.is_const,
            };
            let local = self.declare(new);
            if declaration.is_const && init.is_none() {
                self.report(Diagnostic::error(d.name.span, format!("the constant `{}` needs a value", d.name.text)));
            }
            let creates = init.is_none() && ty == Some(VERTEX);
            if creates {
                self.body.set_created(local);
            }
            let init = match init {
                Some(None) => continue,
                Some(Some(init)) => {
                    if !has_effect(&init) {
                        self.body.set_droppable(local);
                    }
                    Some(init)
                }
                None => {
                    self.body.set_droppable(local);
                    creates.then_some(Expr { kind: ExprKind::Create, ty: VERTEX, span: d.name.span })
                }
            };
            let span = match &d.init {
                Some(init) => d.name.span.to(init.span),
                None => d.name.span,
            };
            out.push(Stmt { kind: StmtKind::Declare { local, init }, span });
        }
    }

    fn expression_statement(&mut self, e: &'a tree::Expr) -> Option<StmtKind> {
        let checked = self.expression(e)?;
        if let ExprKind::Assign { place, op: None, .. } = &checked.kind
            && let Place::Local(id) = **place
            && self.body.is_created_and_first_mentioned(id)
            && let Some(declared) = self.body.local(id).map(|l| l.span)
        {
            let name = self.body.name(id);
            self.report(
                Diagnostic::warning(e.span, format!("the vertex that `vertex {name};` created is lost here"))
                    .label(declared, "created here")
                    .fix(
                        format!("`vertex {name} = null;` creates none, nor does declaring it with its value"),
                        declared,
                        format!("{name} = null"),
                    ),
            );
        }
        if !has_effect(&checked) {
            let error = Diagnostic::warning(e.span, "this is computed, but has no effect");
            let error = match &bare(e).kind {
                Tree::Binary { op: tree::BinaryOp::Equal, left, .. } => {
                    error.hint(format!("to store a value write `{} = …;`", self.text(left.span)))
                }
                _ => error,
            };
            self.report(error);
        }
        // A mesh or ring without effect is of no use to engines.
        let useless = matches!(checked.ty, Type::Mesh | Type::Ring) && !has_effect(&checked);
        (!useless).then_some(StmtKind::Expr(checked))
    }

    /// `Some(None)` is a return without a value.
    fn return_value(&mut self, value: Option<&'a tree::Expr>, span: Span) -> Option<Option<Expr>> {
        let function = self.body.function?;
        let signature = self.signatures.get(function.0 as usize)?;
        let (name, returns, promised) = (signature.name, signature.returns, signature.return_span);
        match (value, returns) {
            (None, Type::Void) => Some(None),
            (None, _) => self.fail(
                Diagnostic::error(span, format!("`{name}` must return {} here", a(returns)))
                    .label(promised, "promised here"),
            ),
            (Some(value), Type::Void) => {
                self.expression(value)?;
                self.fail(
                    Diagnostic::error(value.span, format!("`{name}` returns nothing"))
                        .label(promised, "to return a value, name its type here instead of `void`"),
                )
            }
            (Some(value), Type::Mesh | Type::Ring) => self.whole(value, returns).map(Some),
            (Some(value), Type::Value(ty)) => {
                let value = self.expression(value)?;
                match value.ty {
                    Type::Value(_) => self.implicitly(value, ty).map(Some),
                    Type::Mesh | Type::Ring | Type::Void => self.mismatch(&value, returns),
                }
            }
        }
    }

    fn loop_body(&mut self, body: &'a tree::Stmt) -> (Vec<Stmt>, bool) {
        self.body.loops += 1;
        let result = self.branch(body);
        self.body.loops -= 1;
        result
    }

    /// Gives out a loop; `condition` is `None` if there is none, `Some(None)` if it is faulty.
    fn close_loop(
        &mut self,
        condition: Option<Option<Expr>>,
        update: Vec<Expr>,
        (body, reached): (Vec<Stmt>, bool),
        body_first: bool,
        span: Span,
        out: &mut Vec<Stmt>,
    ) -> bool {
        let endless = match &condition {
            None => true,
            Some(None) => return true,
            Some(Some(c)) => matches!(c.kind, ExprKind::Constant(Value::Bool(true))),
        };
        let leaves = leaves_loop(&body);
        // `do { return x; } while (…)` never asks its condition.
        let never_asks = body_first && !reached && !leaves.continues;
        let falls_through = leaves.breaks || !(endless || never_asks);
        out.push(Stmt { kind: StmtKind::Loop { condition: condition.flatten(), body, update, body_first }, span });
        falls_through
    }

    /// The variables that a condition asks, with how often they have been changed so far; none if it asks anything else
    /// that may change.
    fn asked(&self, condition: Option<&Expr>) -> Vec<(LocalId, u32)> {
        let mut asked = Vec::new();
        let mut open: Vec<&Expr> = condition.into_iter().collect();
        while let Some(e) = open.pop() {
            match &e.kind {
                ExprKind::Constant(_) | ExprKind::Global(_) => {}
                ExprKind::Local(id) => asked.push((*id, self.body.changes(*id))),
                ExprKind::Convert(_, e) | ExprKind::Unary(_, e) => open.push(e),
                ExprKind::Binary(_, a, b) | ExprKind::And(a, b) | ExprKind::Or(a, b) => open.extend([&**a, &**b]),
                _ => return Vec::new(),
            }
        }
        asked
    }

    /// Warns of a loop that goes on for ever if it goes on at all.
    fn warn_of_idle_loop(&mut self, condition: Option<&Expr>, asked: &[(LocalId, u32)], body: &[Stmt]) {
        let changed = asked.iter().any(|&(id, changes)| self.body.changes(id) != changes);
        // What is faulty may have been the change, and one reference may be the same variable as another.
        let faulty = self.diagnostics.iter().any(|d| d.severity == Severity::Error);
        let shared = asked.iter().any(|&(id, _)| self.is_reference(id));
        let Some(condition) =
            condition.filter(|_| !(asked.is_empty() || changed || faulty || shared || leaving(body).is_some()))
        else {
            return;
        };
        let mut names: Vec<String> = asked.iter().map(|&(id, _)| format!("`{}`", self.body.name(id))).collect();
        names.sort_unstable();
        names.dedup();
        let message = format!("nothing in this loop changes {}, so it never ends", names.join(" or "));
        self.report(Diagnostic::warning(condition.span, message));
    }

    fn is_reference(&self, id: LocalId) -> bool {
        let signature = self.body.function.and_then(|f| self.signatures.get(f.0 as usize));
        signature.and_then(|s| s.parameters.get(id.0 as usize)).is_some_and(|p| p.passing == Passing::Reference)
    }

    fn for_loop(
        &mut self,
        init: Option<&'a tree::Stmt>,
        condition: Option<&'a tree::Expr>,
        update: &'a [tree::Expr],
        body: &'a tree::Stmt,
        span: Span,
        out: &mut Vec<Stmt>,
    ) -> bool {
        self.open_scope();
        let mut inner = Vec::new();
        if let Some(init) = init {
            self.statement(init, &mut inner);
        }
        let condition = condition.map(|c| self.condition(c));
        let asked = self.asked(condition.as_ref().and_then(Option::as_ref));
        let update: Vec<Option<Expr>> = update.iter().map(|u| self.expression(u)).collect();
        self.body.loops += 1;
        let body = self.inner(body);
        self.body.loops -= 1;
        self.warn_of_idle_loop(condition.as_ref().and_then(Option::as_ref), &asked, &body.0);
        let update = update.into_iter().flatten().collect();
        let falls_through = self.close_loop(condition, update, body, false, span, &mut inner);
        self.close_scope();
        out.push(Stmt { kind: StmtKind::Block(inner), span });
        falls_through
    }

    fn forall(&mut self, forall: &'a tree::Forall) -> Option<StmtKind> {
        let tree::Forall { parallel, variable, follower, faces, over, from, body } = forall;
        let domain = match faces {
            Some(_) => self.faces_of(over).map(Walked::Faces),
            None => self.domain(over, None).map(|domain| match domain {
                Domain::Set(set) => Walked::Set(set),
                Domain::Ring(ring) => Walked::Ring(ring),
            }),
        };
        let from = from.as_ref().map(|f| (f, self.vertex(&f.corner), f.next.as_ref().map(|next| self.vertex(next))));
        self.open_scope();
        let (ty, role) = if faces.is_some() { (Type::Ring, Role::Face) } else { (VERTEX, Role::Forall) };
        let new = |name: &'a tree::Name| NewLocal {
            name: &name.text,
            span: name.span,
            ty: Some(ty),
            role,
            is_const: role == Role::Face,
        };
        let local = self.declare(new(variable));
        let second = follower.as_ref().map(|name| self.declare(new(name)));
        self.body.loops += 1;
        let (body, _) = self.inner(body);
        self.body.loops -= 1;
        self.close_scope();
        let from = match from {
            Some((tree, corner, next)) => {
                let next = next.map_or(Some(None), |next| next.map(Some));
                Some((tree.corner.span, ir::From { corner: corner?, next: next? }))
            }
            None => None,
        };
        let domain = domain?;
        if let Some(span) = parallel
            && !matches!(domain, Walked::Set(_))
        {
            let error = Diagnostic::error(*span, "parallel rounds are those over the vertices of a mesh");
            return self.fail(error.hint("leave `parallel` out here, and put it before a `forall` round about"));
        }
        if !matches!(domain, Walked::Ring(_)) {
            let set = self.text(over.span);
            let walked = if faces.is_some() { "faces" } else { "the members" };
            if let Some(name) = follower {
                let error = Diagnostic::error(name.span, format!("{walked} of a mesh do not follow each other round"));
                return self.fail(
                    error.hint(format!("pairs are those of a face: `forall f in faces {set} forall p, q in f …`")),
                );
            }
            if let Some((span, _)) = from {
                let error = Diagnostic::error(
                    span,
                    format!("{walked} of a mesh do not go round, so there is nowhere to begin"),
                );
                return self.fail(error.hint("`from` says where a loop round a ring or face begins"));
            }
        }
        Some(match domain {
            Walked::Set(set) => StmtKind::ForallSet { parallel: parallel.is_some(), local, set, body },
            Walked::Faces(set) => StmtKind::ForallFaces { local, set, body },
            Walked::Ring(ring) => {
                StmtKind::ForallRing { local, follower: second, ring, from: from.map(|(_, from)| from), body }
            }
        })
    }

    /// The mesh whose faces are walked.
    fn faces_of(&mut self, e: &'a tree::Expr) -> Option<Expr> {
        if let Tree::Old(inner) = &bare(e).kind {
            let now = self.text(inner.span);
            let error = Diagnostic::error(e.span, "the faces of a mesh are walked as they are, not as they were");
            return self.fail(error.fix("leave the mark out", e.span, now));
        }
        let found = self.expression(e)?;
        if found.ty == VERTEX {
            let text = self.text(e.span);
            let error = Diagnostic::error(e.span, "this is a `vertex`, and faces are those of a mesh");
            return self
                .fail(error.hint(format!("the corners of the faces around a vertex are `forall a, b in {text}`")));
        }
        if found.ty == Type::Mesh { Some(found) } else { self.mismatch(&found, Type::Mesh) }
    }
}

/// What a `forall` walks.
enum Walked {
    Set(Expr),
    Faces(Expr),
    Ring(Ring),
}
