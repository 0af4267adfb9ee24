//! Visiting all parts of a body.

use super::{Argument, Expr, ExprKind, Item, Place, PrintItem, Ring, Stmt, StmtKind};

/// A stack with less room left than this grows.
const RED_ZONE: usize = 256 << 10;

/// By so much.
const STACK_SEGMENT: usize = 4 << 20;

/// A part of a program.
pub(crate) enum Node<'a> {
    Stmt(&'a Stmt),
    Expr(&'a Expr),
    Place(&'a Place),
    Ring(&'a Ring),
}

/// Visits statements and all that is in them.
pub(crate) fn each<'a>(body: &'a [Stmt], visit: &mut dyn FnMut(Node<'a>)) {
    for s in body {
        stacker::maybe_grow(RED_ZONE, STACK_SEGMENT, || each_in_statement(s, visit));
    }
}

fn each_in_statement<'a>(s: &'a Stmt, visit: &mut dyn FnMut(Node<'a>)) {
    visit(Node::Stmt(s));
    match &s.kind {
        StmtKind::Declare { init, .. } => {
            if let Some(e) = init {
                each_in(e, visit);
            }
        }
        StmtKind::Expr(e) | StmtKind::Synchronize(e) => each_in(e, visit),
        StmtKind::Block(body) => each(body, visit),
        StmtKind::If { condition, then, otherwise } => {
            each_in(condition, visit);
            each(then, visit);
            each(otherwise, visit);
        }
        StmtKind::Loop { condition, body, update, .. } => {
            for e in condition.iter().chain(update) {
                each_in(e, visit);
            }
            each(body, visit);
        }
        StmtKind::ForallSet { set, body, .. } => {
            each_in(set, visit);
            each(body, visit);
        }
        StmtKind::ForallFaces { set, body, .. } => {
            each_in(set, visit);
            each(body, visit);
        }
        StmtKind::ForallRing { ring, from, body, .. } => {
            each_in_ring(ring, visit);
            if let Some(from) = from {
                each_in(&from.corner, visit);
                if let Some(next) = &from.next {
                    each_in(next, visit);
                }
            }
            each(body, visit);
        }
        StmtKind::Break | StmtKind::Continue => {}
        StmtKind::Return(e) => {
            if let Some(e) = e {
                each_in(e, visit);
            }
        }
        StmtKind::Make { items, of } => {
            for item in items {
                each_in_item(item, visit);
            }
            each_in(of, visit);
        }
        StmtKind::MakeRing { of, .. } => each_in(of, visit),
        StmtKind::Erase { item, from } => {
            each_in_item(item, visit);
            each_in_ring(from, visit);
        }
        StmtKind::Replace { item, with, ring } => {
            each_in_item(item, visit);
            each_in_item(with, visit);
            each_in_ring(ring, visit);
        }
        StmtKind::Splice { item, anchor, ring, .. } => {
            each_in_item(item, visit);
            each_in_item(anchor, visit);
            each_in_ring(ring, visit);
        }
        StmtKind::Add { vertex, .. } | StmtKind::Append { vertex, .. } | StmtKind::Remove { vertex, .. } => {
            each_in(vertex, visit);
        }
        StmtKind::Merge { other, .. } => each_in(other, visit),
        StmtKind::Print(items) => {
            for item in items {
                if let PrintItem::Value(e) = item {
                    each_in(e, visit);
                }
            }
        }
    }
}

fn each_in_item<'a>(item: &'a Item, visit: &mut dyn FnMut(Node<'a>)) {
    if let Item::Vertex(e) = item {
        each_in(e, visit);
    }
}

fn each_in_ring<'a>(ring: &'a Ring, visit: &mut dyn FnMut(Node<'a>)) {
    visit(Node::Ring(ring));
    if let Ring::Of { vertex, .. } = ring {
        each_in(vertex, visit);
    }
}

fn each_in_place<'a>(place: &'a Place, visit: &mut dyn FnMut(Node<'a>)) {
    visit(Node::Place(place));
    match place {
        Place::Local(_) | Place::MeshProperty { .. } => {}
        Place::Position { vertex, .. } | Place::VertexProperty { vertex, .. } => each_in(vertex, visit),
        Place::EdgeProperty { ends, .. } => {
            for e in ends {
                each_in(e, visit);
            }
        }
        Place::Coordinate(base, _) => each_in_place(base, visit),
    }
}

/// Visits an expression and all that is in it.
pub(crate) fn each_in<'a>(e: &'a Expr, visit: &mut dyn FnMut(Node<'a>)) {
    stacker::maybe_grow(RED_ZONE, STACK_SEGMENT, || each_in_expression(e, visit));
}

fn each_in_expression<'a>(e: &'a Expr, visit: &mut dyn FnMut(Node<'a>)) {
    visit(Node::Expr(e));
    match &e.kind {
        ExprKind::Constant(_) | ExprKind::Local(_) | ExprKind::Global(_) | ExprKind::Create => {}
        ExprKind::Load(place) | ExprKind::Step(place, ..) => each_in_place(place, visit),
        ExprKind::Convert(_, a) | ExprKind::Unary(_, a) | ExprKind::Coordinate(a, _) => each_in(a, visit),
        ExprKind::AssignSet(_, a) | ExprKind::AssignRing(_, a) => each_in(a, visit),
        ExprKind::Binary(_, a, b) | ExprKind::And(a, b) | ExprKind::Or(a, b) | ExprKind::IsInSet(a, b) => {
            each_in(a, visit);
            each_in(b, visit);
        }
        ExprKind::Conditional(a, b, c) => {
            each_in(a, visit);
            each_in(b, visit);
            each_in(c, visit);
        }
        ExprKind::Call(_, arguments) => {
            for argument in arguments {
                if let Argument::Value(e) = argument {
                    each_in(e, visit);
                }
            }
        }
        ExprKind::Builtin(_, arguments) => {
            for e in arguments {
                each_in(e, visit);
            }
        }
        ExprKind::Assign { place, value, .. } => {
            each_in_place(place, visit);
            each_in(value, visit);
        }
        ExprKind::Any(ring) | ExprKind::Valence(ring) | ExprKind::Gaps(ring) => each_in_ring(ring, visit),
        ExprKind::Next(item, ring) | ExprKind::Previous(item, ring) | ExprKind::IsInRing(item, ring) => {
            each_in_item(item, visit);
            each_in_ring(ring, visit);
        }
    }
}
