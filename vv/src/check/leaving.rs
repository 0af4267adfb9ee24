//! Statements that leave a loop or the function.

use crate::ir::{Stmt, StmtKind};

use super::with_stack;

/// The first statement that leaves the loop around it, or the function.
pub(super) fn leaving(body: &[Stmt]) -> Option<&Stmt> {
    with_stack(|| {
        body.iter().find_map(|s| match &s.kind {
            StmtKind::Break | StmtKind::Return(_) => Some(s),
            StmtKind::Block(inner) => leaving(inner),
            StmtKind::If { then, otherwise, .. } => leaving(then).or_else(|| leaving(otherwise)),
            StmtKind::Loop { body, .. }
            | StmtKind::ForallSet { body, .. }
            | StmtKind::ForallRing { body, .. }
            | StmtKind::ForallFaces { body, .. } => returning(body),
            _ => None,
        })
    })
}

/// What a loop's body does to the loop.
#[derive(Default)]
pub(super) struct Leaves {
    pub(super) breaks: bool,
    pub(super) continues: bool,
}

pub(super) fn leaves_loop(body: &[Stmt]) -> Leaves {
    let mut leaves = Leaves::default();
    let mut open: Vec<&[Stmt]> = vec![body];
    while let Some(statements) = open.pop() {
        for s in statements {
            match &s.kind {
                StmtKind::Break => leaves.breaks = true,
                StmtKind::Continue => leaves.continues = true,
                StmtKind::Block(inner) => open.push(inner),
                StmtKind::If { then, otherwise, .. } => open.extend([&then[..], &otherwise[..]]),
                _ => {}
            }
        }
    }
    leaves
}

/// The first `return`.
fn returning(body: &[Stmt]) -> Option<&Stmt> {
    with_stack(|| {
        body.iter().find_map(|s| match &s.kind {
            StmtKind::Return(_) => Some(s),
            StmtKind::Block(body)
            | StmtKind::Loop { body, .. }
            | StmtKind::ForallSet { body, .. }
            | StmtKind::ForallRing { body, .. }
            | StmtKind::ForallFaces { body, .. } => returning(body),
            StmtKind::If { then, otherwise, .. } => returning(then).or_else(|| returning(otherwise)),
            _ => None,
        })
    })
}
