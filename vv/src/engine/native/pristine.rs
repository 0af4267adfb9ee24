//! Where it is sure that nothing was written to the mesh yet: what is made old there is the mesh as the run found it.

use super::effects::Order;
use crate::ir::visit::{Node, each_in};
use crate::ir::{Argument, Expr, ExprKind, FunctionId, Program, Stmt, StmtKind};

/// Which functions begin with the mesh as the run found it, wherever they are called: rules that no function calls, and
/// what is called once, by one of these, before anything else.
pub(super) fn functions(program: &Program, order: &Order, calls: &[u32]) -> Vec<bool> {
    let is_root = |i: usize| program.rules.iter().chain(&program.start).any(|f| f.0 as usize == i);
    let mut pristine: Vec<bool> = (0..program.functions.len()).map(|i| is_root(i) && calls[i] == 0).collect();
    for &i in order.sorted.iter().rev().filter(|&&i| !order.cyclic[i]) {
        if pristine[i]
            && let Some(called) = first_call(&program.functions[i].body)
            && calls[called.0 as usize] == 1
            && !is_root(called.0 as usize)
        {
            pristine[called.0 as usize] = true;
        }
    }
    pristine
}

/// The function that is called before anything else is done.
fn first_call(body: &[Stmt]) -> Option<FunctionId> {
    let first = body.iter().find(|s| !is_quiet(s))?;
    if let StmtKind::Block(body) = &first.kind { first_call(body) } else { quiet_call(first) }
}

/// Whether a statement is sure to leave the mesh as it is and to run once: a declaration that only computes.
pub(super) fn is_quiet(s: &Stmt) -> bool {
    match &s.kind {
        StmtKind::Block(body) => body.iter().all(is_quiet),
        StmtKind::Declare { init, .. } => init.as_ref().is_none_or(only_computes),
        _ => false,
    }
}

/// The function that a statement calls and nothing else, operands that only compute apart.
pub(super) fn quiet_call(s: &Stmt) -> Option<FunctionId> {
    match &s.kind {
        StmtKind::Expr(Expr { kind: ExprKind::Call(function, arguments), .. }) => {
            let quiet = |a: &Argument| match a {
                Argument::Value(e) => only_computes(e),
                Argument::Reference(_) => true,
            };
            arguments.iter().all(quiet).then_some(*function)
        }
        _ => None,
    }
}

fn only_computes(e: &Expr) -> bool {
    let mut quiet = true;
    each_in(e, &mut |node| {
        if let Node::Expr(e) = node {
            use ExprKind::{Assign, Call, Create, Step};
            quiet &= !matches!(e.kind, Call(..) | Create | Assign { .. } | Step(..));
        }
    });
    quiet
}
