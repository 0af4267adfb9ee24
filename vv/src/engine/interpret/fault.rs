//! Run-time errors: located, with the open calls.

use super::Machine;
use crate::diagnostic::Diagnostic;
use crate::engine::{Failure, FailureKind, text};
use crate::mesh::{Mesh, Vertex};
use crate::source::Span;

/// Open calls that a message lists at either end; those between are counted.
const CALLS_SHOWN: usize = 8;

/// Vertices of a message of which it is told how they were before the step.
const VERTICES_TOLD: usize = 4;

/// A failure on its way out, and what to do about it.
pub(super) struct Fault {
    pub(super) failure: Failure,
    /// A null is at fault: where it came from is worth a second run.
    pub(super) of_null: bool,
}

pub(super) type Run<T> = Result<T, Box<Fault>>;

impl Fault {
    fn with(mut self: Box<Self>, change: impl FnOnce(Diagnostic) -> Diagnostic) -> Box<Self> {
        let empty = Diagnostic::new(self.failure.diagnostic.severity, None, String::new());
        let diagnostic = std::mem::replace(&mut *self.failure.diagnostic, empty);
        *self.failure.diagnostic = change(diagnostic);
        self
    }

    pub(super) fn evidence(self: Box<Self>, fact: impl Into<String>) -> Box<Self> {
        self.with(|d| d.evidence(fact))
    }

    pub(super) fn hint(self: Box<Self>, message: impl Into<String>) -> Box<Self> {
        self.with(|d| d.hint(message))
    }

    pub(super) fn label(self: Box<Self>, span: Span, message: impl Into<String>) -> Box<Self> {
        self.with(|d| d.label(span, message))
    }

    pub(super) fn about(self: Box<Self>, vertices: impl IntoIterator<Item = Vertex>) -> Box<Self> {
        self.with(|mut d| {
            for v in vertices {
                if !d.vertices.contains(&v) {
                    d.vertices.push(v);
                }
            }
            d
        })
    }
}

impl Machine<'_> {
    #[cold]
    pub(super) fn fail_with(&self, kind: FailureKind, span: Span, message: impl Into<String>) -> Box<Fault> {
        let open = self.frames.iter().rev().filter_map(|f| Some((f.function.name.clone(), f.call?)));
        let depth = self.frames.len().saturating_sub(1);
        let diagnostic = with_calls(Diagnostic::error(span, message), depth, open);
        Box::new(Fault { failure: Failure { kind, diagnostic: Box::new(diagnostic) }, of_null: false })
    }

    /// Adds how the vertices of a message were before the step, where the step has changed their rings or made them: what
    /// is seen of the mesh is from then.
    #[cold]
    pub(super) fn tell_what_was(&self, mut fault: Box<Fault>, before: &Mesh) -> Box<Fault> {
        let vertices = fault.failure.diagnostic.vertices.clone();
        // Where there was nothing, all is new.
        for v in vertices.into_iter().take(VERTICES_TOLD).filter(|_| before.vertex_count() > 0) {
            if v.index() >= before.vertex_count() {
                fault = fault.evidence(format!("{v} was made in this step"));
            } else if before.ring(v) != self.mesh.ring(v) {
                let was = format!("ring of {v}: {}", text::ring(before.ring(v), None));
                // Often the old ring was quoted, which says it.
                if !fault.failure.diagnostic.evidence.iter().any(|fact| fact.ends_with(&was)) {
                    fault = fault.evidence(format!("before the step, {was}"));
                }
            }
        }
        fault
    }
}

/// Lists the calls that are open, innermost first, those in the middle left out where they are many.
pub(in crate::engine) fn with_calls(
    mut diagnostic: Diagnostic,
    depth: usize,
    open: impl Iterator<Item = (String, Span)>,
) -> Diagnostic {
    if depth <= 2 * CALLS_SHOWN {
        diagnostic.calls = open.collect();
        return diagnostic;
    }
    let ends = |&(i, _): &(usize, _)| i < CALLS_SHOWN || i >= depth - CALLS_SHOWN;
    diagnostic.calls = open.enumerate().filter(ends).map(|(_, call)| call).collect();
    let left_out = depth - 2 * CALLS_SHOWN;
    diagnostic.evidence(format!("{depth} calls are open; {left_out} in the middle are not listed"))
}
