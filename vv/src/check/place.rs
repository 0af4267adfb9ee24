//! Names, properties, rings and what is looked for in them.

use crate::builtins::NUMBERS;
use crate::diagnostic::Diagnostic;
use crate::ir::{Expr, ExprKind, GlobalId, Item, LocalId, Place, Ring, Type};
use crate::mesh::{Type as ValueType, Value};
use crate::source::Span;
use crate::syntax::tree::{self, Element, ExprKind as Tree};

use super::Checker;
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

    /// The ring that is read, `v` or `` `v ``; a name that is unknown hardly means that of `item`.
    pub(super) fn ring(&mut self, e: &'a tree::Expr, item: Option<&'a tree::Expr>) -> Option<Ring> {
        let (inner, old) = self.without_mark(e);
        let vertex = self.vertex_but(inner, name_of(item))?;
        Some(Ring { vertex: Box::new(vertex), old })
    }

    /// What `forall` walks and `is` asks: a mesh or a ring.
    pub(super) fn domain(&mut self, e: &'a tree::Expr, item: Option<&'a tree::Expr>) -> Option<Domain> {
        let (inner, old) = self.without_mark(e);
        let found = self.operand(inner, name_of(item))?;
        match found.ty {
            Type::Mesh if !old => Some(Domain::Set(found)),
            VERTEX => Some(Domain::Ring(Ring { vertex: Box::new(self.only_true_vertex(found)?), old })),
            Type::Mesh => {
                self.fail(
                    Diagnostic::error(e.span, "a mesh has no old members, its vertices have old rings and properties")
                        .fix("the mesh as it is", e.span, self.text(inner.span)),
                )
            }
            other => self.fail(Diagnostic::error(found.span, format!("this is {}, no mesh and no vertex", a(other)))),
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
                self.fail(if is_vec && matches!(name.text.as_str(), "x" | "y" | "z") {
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
                Named::Local(..) => {
                    self.fail(Diagnostic::error(e.span, "a mesh can only be assigned to as a whole: `S = T;`"))
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
            return Some(());
        }
        let (name, declared) = (self.body.name(id), self.body.local(id).map_or(span, |l| l.span));
        self.fail(
            Diagnostic::error(span, format!("`{name}` cannot be changed: it is `const`"))
                .label(declared, "declared here"),
        )
    }

    /// A mesh variable that can be changed.
    pub(super) fn set(&mut self, e: &'a tree::Expr) -> Option<LocalId> {
        let e = bare(e);
        let Tree::Name(name) = &e.kind else {
            let mesh = self.expression(e)?;
            return if mesh.ty == Type::Mesh {
                self.fail(Diagnostic::error(e.span, "this mesh is no variable, so nobody would see the change"))
            } else {
                self.mismatch(&mesh, Type::Mesh)
            };
        };
        let named = self.name_expression(name, e.span, Wanted::Any)?;
        let (ExprKind::Local(id), Type::Mesh) = (&named.kind, named.ty) else {
            return self.mismatch(&named, Type::Mesh);
        };
        let id = *id;
        self.changeable(id, e.span)?;
        Some(id)
    }

    /// A mesh of any kind.
    pub(super) fn mesh(&mut self, e: &'a tree::Expr) -> Option<Expr> {
        let mesh = self.expression(e)?;
        if mesh.ty == Type::Mesh { Some(mesh) } else { self.mismatch(&mesh, Type::Mesh) }
    }
}
