//! Names, properties, rings and what is looked for in them.

use crate::builtins::NUMBERS;
use crate::diagnostic::Diagnostic;
use crate::ir::{Expr, ExprKind, GlobalId, Item, LocalId, Place, Ring, Type};
use crate::mesh::{Type as ValueType, Value};
use crate::source::Span;
use crate::syntax::tree::{self, Element, ExprKind as Tree};

use super::Checker;
use super::body::Role;
use super::operator::a;
use super::suggest::Wanted;

const VERTEX: Type = Type::Value(ValueType::Vertex);

/// What a name means.
pub(super) enum Named {
    Local(LocalId, Type),
    Global(GlobalId, ValueType),
    Number(f64),
}

/// A place with the type of what is stored there.
pub(super) struct Typed {
    pub(super) place: Place,
    pub(super) ty: ValueType,
}

/// What can be walked, and asked for a vertex.
pub(super) enum Domain {
    Set(Expr),
    Ring(Ring),
}

fn name_of(e: Option<&tree::Expr>) -> Option<&str> {
    match &bare(e?).kind {
        Tree::Name(name) => Some(name),
        _ => None,
    }
}

/// Without the parentheses around it.
pub(super) fn bare(mut e: &tree::Expr) -> &tree::Expr {
    while let Tree::Paren(inner) = &e.kind {
        e = inner;
    }
    e
}

impl<'a> Checker<'a> {
    pub(super) fn named(&mut self, name: &'a str, span: Span, wanted: Wanted<'a>) -> Option<Named> {
        if let Some(id) = self.body.find(name) {
            self.body.mention(id);
            return Some(Named::Local(id, self.body.type_of(id)?));
        }
        if let Some(global) = self.global_names.get(name) {
            if self.body.file_scope && !global.declared {
                let declared = global.span;
                return self.fail(
                    Diagnostic::error(span, format!("`{name}` has no value yet"))
                        .label(declared, "it is declared later"),
                );
            }
            let id = global.id?;
            return Some(Named::Global(id, self.globals.get(id.0 as usize)?.ty));
        }
        if let Some(number) = NUMBERS.iter().find(|n| n.name == name) {
            return Some(Named::Number(number.value));
        }
        self.unknown_name(name, span, wanted);
        None
    }

    pub(super) fn name_expression(&mut self, name: &'a str, span: Span, wanted: Wanted<'a>) -> Option<Expr> {
        let (kind, ty) = match self.named(name, span, wanted)? {
            Named::Local(id, ty) => (ExprKind::Local(id), ty),
            Named::Global(id, ty) => (ExprKind::Global(id), Type::Value(ty)),
            Named::Number(x) => (ExprKind::Constant(Value::Double(x)), Type::Value(ValueType::Double)),
        };
        Some(Expr { kind, ty, span })
    }

    /// A vertex, which the word `null` is not.
    pub(super) fn vertex(&mut self, e: &'a tree::Expr) -> Option<Expr> {
        self.vertex_but(e, None)
    }

    /// As [`Checker::vertex`]; an unknown name hardly means `except`.
    fn vertex_but(&mut self, e: &'a tree::Expr, except: Option<&'a str>) -> Option<Expr> {
        let vertex = self.operand(e, except)?;
        self.only_true_vertex(vertex)
    }

    /// A vertex or null.
    pub(super) fn vertex_or_null(&mut self, e: &'a tree::Expr) -> Option<Expr> {
        let vertex = self.operand(e, None)?;
        self.only_vertex(vertex)
    }

    /// An expression of any type where a vertex would do: an unknown name hardly means `except`.
    fn operand(&mut self, e: &'a tree::Expr, except: Option<&'a str>) -> Option<Expr> {
        let inner = bare(e);
        match &inner.kind {
            Tree::Name(name) => self.name_expression(name, inner.span, Wanted::Vertex { except }),
            _ => self.expression(e),
        }
    }

    fn only_true_vertex(&mut self, e: Expr) -> Option<Expr> {
        if matches!(e.kind, ExprKind::Constant(Value::Vertex(None))) {
            return self.fail(Diagnostic::error(e.span, "`null` is no vertex that this could be done with"));
        }
        self.only_vertex(e)
    }

    fn only_vertex(&mut self, e: Expr) -> Option<Expr> {
        if e.ty == VERTEX { Some(e) } else { self.mismatch(&e, VERTEX) }
    }

    /// What is looked for in a ring or put there; only the word `null` itself is a gap.
    pub(super) fn item(&mut self, e: &'a tree::Expr) -> Option<Item> {
        if let Tree::Null = bare(e).kind {
            return Some(Item::Gap(e.span));
        }
        self.vertex_or_null(e).map(Item::Vertex)
    }

    /// The ring that is read, `v`, `` `v `` or a variable; a name that is unknown hardly means that of `item`.
    pub(super) fn ring(&mut self, e: &'a tree::Expr, item: Option<&'a tree::Expr>) -> Option<Ring> {
        let (inner, old) = self.without_mark(e);
        let found = self.operand(inner, name_of(item))?;
        self.ring_of(found, old, e)
    }

    /// A vertex or ring as a ring. `e` is where it stands, with its mark.
    fn ring_of(&mut self, found: Expr, old: bool, e: &'a tree::Expr) -> Option<Ring> {
        if found.ty != Type::Ring {
            return Some(Ring::Of { vertex: Box::new(self.only_true_vertex(found)?), old });
        }
        if old {
            let text = self.text(found.span);
            let error = Diagnostic::error(e.span, "a `ring` has no old value, it is a value itself");
            return self.fail(error.fix("leave the mark out", e.span, text));
        }
        self.ring_variable(&found).map(|local| Ring::Variable { local, span: found.span })
    }

    fn ring_variable(&mut self, ring: &Expr) -> Option<LocalId> {
        match ring.kind {
            ExprKind::Local(local) => Some(local),
            _ => self.fail(
                Diagnostic::error(ring.span, "rings are walked, asked and used through variables")
                    .hint(format!("keep this one first: `ring r = {};`", self.text(ring.span))),
            ),
        }
    }

    /// The ring that is edited.
    pub(super) fn edited(&mut self, e: &'a tree::Expr) -> Option<Ring> {
        if let Tree::Old(inner) = &bare(e).kind {
            let now = self.text(inner.span);
            return self.fail(Diagnostic::error(e.span, "an old ring can only be read").fix(
                format!("the ring as it is now is that of `{now}`"),
                e.span,
                now,
            ));
        }
        let found = self.operand(e, None)?;
        if found.ty == Type::Mesh {
            let error = Diagnostic::error(found.span, "this is a `mesh`, and rings are edited");
            let text = self.text(found.span);
            return self
                .fail(error.hint(format!("members come and go by `add v to {text};` and `remove v from {text};`")));
        }
        let ring = self.ring_of(found, false, e)?;
        if let Ring::Variable { local, span } = ring {
            self.changeable(local, span)?;
        }
        Some(ring)
    }

    /// The vertex that gets a ring.
    pub(super) fn ring_taker(&mut self, e: &'a tree::Expr) -> Option<Expr> {
        match self.edited(e)? {
            Ring::Of { vertex, .. } => Some(*vertex),
            Ring::Variable { span, .. } => {
                let text = self.text(span);
                let error = Diagnostic::error(span, "a `ring` is no vertex, so it has no neighbours");
                self.fail(error.hint(format!("a ring begins empty, `ring {text};`, and grows by `add v to {text};`")))
            }
        }
    }

    /// The variable `r` of `make r nb_of v`.
    pub(super) fn made_ring(&mut self, e: &'a tree::Expr) -> Option<LocalId> {
        let found = self.expression(e)?;
        if found.ty == VERTEX {
            let text = self.text(e.span);
            let error = Diagnostic::error(e.span, "this is a `vertex`, not a list or a `ring`");
            return self.fail(error.fix("write a list", e.span, format!("{{{text}}}")));
        }
        if found.ty == Type::Ring { self.ring_variable(&found) } else { self.mismatch(&found, Type::Ring) }
    }

    /// Reports a gap where there can be none.
    pub(super) fn fits(&mut self, item: &Item, ring: &Ring) -> Option<()> {
        match (item, ring) {
            (Item::Gap(span), Ring::Variable { .. }) => {
                self.fail(Diagnostic::error(*span, "a `ring` has no gaps, only the ring of a vertex may have some"))
            }
            _ => Some(()),
        }
    }

    /// What `forall` walks and `is` asks: a mesh or a ring.
    pub(super) fn domain(&mut self, e: &'a tree::Expr, item: Option<&'a tree::Expr>) -> Option<Domain> {
        let read_before = self.body.effects.reads_old;
        let (inner, old) = self.without_mark(e);
        let found = self.operand(inner, name_of(item))?;
        match found.ty {
            Type::Mesh if !old => Some(Domain::Set(found)),
            VERTEX | Type::Ring => self.ring_of(found, old, e).map(Domain::Ring),
            Type::Mesh => {
                self.body.effects.reads_old = read_before;
                self.fail(
                    Diagnostic::error(e.span, "a mesh has no old members, its vertices have old rings and properties")
                        .fix("the mesh as it is", e.span, self.text(inner.span)),
                )
            }
            other => self.fail(Diagnostic::error(found.span, format!("this is {}, no mesh, vertex or ring", a(other)))),
        }
    }

    /// Takes the mark of an old value off; it is noted as read.
    fn without_mark(&mut self, e: &'a tree::Expr) -> (&'a tree::Expr, bool) {
        match &bare(e).kind {
            Tree::Old(inner) => {
                self.body.effects.reads_old.get_or_insert(e.span);
                (inner, true)
            }
            _ => (e, false),
        }
    }

    /// `` `v `` where it is no ring and nothing follows it.
    pub(super) fn misplaced_old<T>(&mut self, inner: &'a tree::Expr, span: Span) -> Option<T> {
        let text = self.text(inner.span);
        let error = match &bare(inner).kind {
            Tree::Edge(..) => Diagnostic::error(span, "an edge has values, but is none").hint("name one: `(p|q)$name`"),
            _ => Diagnostic::error(span, "an old value can be read, not kept: a vertex has no old self of its own")
                .hint(format!("read `` `{text}$pos ``, or its old ring, as in `` forall q in `{text} ``"))
                .fix(format!("the vertex itself is `{text}`"), span, text),
        };
        self.fail(error)
    }

    /// `of$name`
    pub(super) fn property(&mut self, of: &'a tree::Expr, name: &'a tree::Name) -> Option<Typed> {
        let (inner, old) = self.without_mark(of);
        if let Tree::Edge(p, q) = &bare(inner).kind {
            return self.edge_property(p, q, old, name);
        }
        let owner = self.operand(inner, None)?;
        match owner.ty {
            Type::Mesh => self.mesh_property(owner, old, of, name),
            VERTEX if matches!(owner.kind, ExprKind::Constant(_)) => {
                self.fail(Diagnostic::error(inner.span, "`null` has no position and no properties"))
            }
            VERTEX if name.text == "pos" => {
                Some(Typed { place: Place::Position { vertex: owner, old }, ty: ValueType::Vec })
            }
            VERTEX => {
                let (property, ty) = self.declared_property(Element::Vertex, name)?;
                Some(Typed { place: Place::VertexProperty { property, vertex: owner, old }, ty })
            }
            other => {
                let error = Diagnostic::error(
                    of.span.to(name.span),
                    format!("vertices, edges and meshes have properties, {} has none", a(other)),
                );
                let is_vec = other == Type::Value(ValueType::Vec);
                let text = self.text(inner.span);
                self.fail(if other == Type::Ring {
                    error.hint(format!("its vertices have: `forall p in {text} … p${} …`", name.text))
                } else if is_vec && matches!(name.text.as_str(), "x" | "y" | "z") {
                    error.hint(format!("a coordinate is written `.{}`", name.text))
                } else {
                    error
                })
            }
        }
    }

    fn edge_property(
        &mut self,
        p: &'a tree::Expr,
        q: &'a tree::Expr,
        old: bool,
        name: &'a tree::Name,
    ) -> Option<Typed> {
        let (p, q) = (self.vertex(p), self.vertex(q));
        let (property, ty) = self.declared_property(Element::Edge, name)?;
        Some(Typed { place: Place::EdgeProperty { property, ends: [p?, q?], old }, ty })
    }

    fn mesh_property(&mut self, owner: Expr, old: bool, of: &'a tree::Expr, name: &'a tree::Name) -> Option<Typed> {
        if old {
            return self.fail(Diagnostic::error(of.span, "`synchronize` keeps no old properties of a mesh"));
        }
        let ExprKind::Local(set) = owner.kind else {
            return self.fail(
                Diagnostic::error(of.span, "only a mesh variable has properties")
                    .hint("keep the mesh in a variable first: `mesh M = …;`"),
            );
        };
        let (property, ty) = self.declared_property(Element::Mesh, name)?;
        Some(Typed { place: Place::MeshProperty { property, set }, ty })
    }

    fn declared_property(&mut self, element: Element, name: &'a tree::Name) -> Option<(u32, ValueType)> {
        let properties = self.properties(element);
        let Some(&(_, index)) = properties.names.get(name.text.as_str()) else {
            self.unknown_property(element, &name.text, name.span);
            return None;
        };
        let index = index?;
        let ty = properties.declarations.get(index as usize)?.default.ty();
        Some((index, ty))
    }

    /// A coordinate's number.
    pub(super) fn axis(&mut self, of: &Expr, name: &'a tree::Name) -> Option<u8> {
        let text = name.text.as_str();
        let axis = match text {
            "x" => Some(0),
            "y" => Some(1),
            "z" => Some(2),
            _ => None,
        };
        if of.ty == Type::Value(ValueType::Vec) {
            return match axis {
                Some(axis) => Some(axis),
                None => self.fail(Diagnostic::error(name.span, format!("a `vec` has x, y and z, but no `{text}`"))),
            };
        }
        let only = if axis.is_some() { ", only a `vec` has" } else { "" };
        let error = Diagnostic::error(name.span, format!("{} has no `.{text}`{only}", a(of.ty)));
        let owner = self.text(of.span);
        let dot_and_name = Span { start: of.span.end, ..name.span };
        self.fail(match (of.ty, axis) {
            (VERTEX, Some(_)) => error.fix(format!("write `{owner}$pos.{text}`"), dot_and_name, format!("$pos.{text}")),
            (VERTEX, None) if text == "pos" || self.vertex_properties.names.contains_key(text) => {
                error.fix(format!("write `{owner}${text}`"), dot_and_name, format!("${text}"))
            }
            (Type::Mesh, _) if text == "faces" => error.hint(format!("write `forall f in faces {owner}`")),
            (Type::Mesh, _) if matches!(text, "vertices" | "edges") => {
                error.hint(format!("write `forall p in {owner}`"))
            }
            (Type::Mesh, _) if self.mesh_properties.names.contains_key(text) => {
                error.fix(format!("write `{owner}${text}`"), dot_and_name, format!("${text}"))
            }
            _ => error,
        })
    }

    /// Where something can be stored; reports what cannot be changed.
    pub(super) fn target(&mut self, e: &'a tree::Expr) -> Option<Typed> {
        let e = bare(e);
        match &e.kind {
            Tree::Name(name) => match self.named(name, e.span, Wanted::Any)? {
                Named::Local(id, Type::Value(ty)) => {
                    self.changeable(id, e.span)?;
                    Some(Typed { place: Place::Local(id), ty })
                }
                Named::Local(_, ty) => {
                    let whole = if ty == Type::Ring { "a ring" } else { "a mesh" };
                    let message = format!("{whole} can only be assigned to as a whole: `{name} = …;`");
                    self.fail(Diagnostic::error(e.span, message))
                }
                Named::Global(id, _) => {
                    let (declared, is_param) =
                        self.globals.get(id.0 as usize).map_or((e.span, false), |g| (g.span, g.param.is_some()));
                    let what = if is_param { "a parameter, set from outside" } else { "a constant" };
                    self.fail(
                        Diagnostic::error(e.span, format!("`{name}` cannot be changed: it is {what}"))
                            .label(declared, "declared here"),
                    )
                }
                Named::Number(_) => {
                    self.fail(Diagnostic::error(e.span, format!("`{name}` cannot be changed: it is a constant")))
                }
            },
            Tree::Property { of, name } => {
                let typed = self.property(of, name)?;
                match &typed.place {
                    Place::Position { old: true, .. }
                    | Place::VertexProperty { old: true, .. }
                    | Place::EdgeProperty { old: true, .. } => {
                        let owner = bare(of);
                        let now = match &owner.kind {
                            Tree::Old(inner) => self.text(inner.span),
                            _ => "",
                        };
                        self.fail(Diagnostic::error(e.span, "old values can only be read").fix(
                            format!("what is now is `{now}${}`", name.text),
                            of.span,
                            now,
                        ))
                    }
                    Place::MeshProperty { set, .. } => {
                        self.changeable(*set, of.span)?;
                        Some(typed)
                    }
                    _ => Some(typed),
                }
            }
            Tree::Field { of, name } => {
                let typed = self.target(of)?;
                let probe =
                    Expr { kind: ExprKind::Constant(Value::zero(typed.ty)), ty: Type::Value(typed.ty), span: of.span };
                let axis = self.axis(&probe, name)?;
                if matches!(typed.place, Place::Coordinate(..)) {
                    return None;
                }
                Some(Typed { place: Place::Coordinate(Box::new(typed.place), axis), ty: ValueType::Double })
            }
            Tree::Old(inner) => self.misplaced_old(inner, e.span),
            Tree::Error => None,
            _ => {
                self.expression(e)?;
                self.fail(
                    Diagnostic::error(e.span, "nothing can be stored here")
                        .hint("variables, properties and their coordinates can be changed"),
                )
            }
        }
    }

    /// Reports a variable declared `const`.
    pub(super) fn changeable(&mut self, id: LocalId, span: Span) -> Option<()> {
        if !self.body.is_const(id) {
            self.body.change(id);
            return Some(());
        }
        let (name, declared) = (self.body.name(id), self.body.local(id).map_or(span, |l| l.span));
        if self.body.role(id) == Some(Role::Face) {
            let error = Diagnostic::error(span, format!("`{name}` cannot be changed: it is the face of a `forall`"));
            return self.fail(error.label(declared, "walked here").hint(format!("change a copy: `ring r = {name};`")));
        }
        self.fail(
            Diagnostic::error(span, format!("`{name}` cannot be changed: it is `const`"))
                .label(declared, "declared here"),
        )
    }

    /// A mesh variable that can be changed.
    pub(super) fn set(&mut self, e: &'a tree::Expr) -> Option<LocalId> {
        match self.collection(e)? {
            (id, Type::Mesh) => Some(id),
            (id, ty) => {
                let e = bare(e);
                let found = Expr { kind: ExprKind::Local(id), ty, span: e.span };
                self.mismatch(&found, Type::Mesh)
            }
        }
    }

    /// A mesh or ring variable that can be changed.
    pub(super) fn collection(&mut self, e: &'a tree::Expr) -> Option<(LocalId, Type)> {
        let e = bare(e);
        let found = match &e.kind {
            Tree::Name(name) => self.name_expression(name, e.span, Wanted::Any)?,
            _ => self.expression(e)?,
        };
        match (&found.kind, found.ty) {
            (&ExprKind::Local(id), ty @ (Type::Mesh | Type::Ring)) => {
                self.changeable(id, e.span)?;
                Some((id, ty))
            }
            (_, Type::Mesh | Type::Ring) => {
                let what = if found.ty == Type::Mesh { "mesh" } else { "ring" };
                let message = format!("this {what} is no variable, so nobody would see the change");
                self.fail(Diagnostic::error(e.span, message))
            }
            _ => self.mismatch(&found, Type::Mesh),
        }
    }

    /// A mesh of any kind.
    pub(super) fn mesh(&mut self, e: &'a tree::Expr) -> Option<Expr> {
        self.whole(e, Type::Mesh)
    }

    /// An expression of type mesh or ring, whichever is wanted.
    pub(super) fn whole(&mut self, e: &'a tree::Expr, ty: Type) -> Option<Expr> {
        let found = self.expression(e)?;
        if found.ty == ty { Some(found) } else { self.mismatch(&found, ty) }
    }
}
