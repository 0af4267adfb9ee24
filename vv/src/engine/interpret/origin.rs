//! Where nulls come from: recorded only while a run that failed on a null is repeated.

use std::rc::Rc;

use rustc_hash::FxHashMap;

use super::fault::Fault;
use super::place::Target;
use super::ring::Source;
use super::{FailureKind, Machine};
use crate::engine::text;
use crate::mesh::{Value, Vertex};
use crate::source::Span;

/// Places whose nulls are remembered; beyond, messages do without the label.
const REMEMBERED: usize = 1 << 20;

/// The origins of the nulls that are alive.
#[derive(Default)]
pub(super) struct Trace {
    /// Of the null that was computed last. An expression whose value is null leaves its origin here, and whoever
    /// refuses or stores the value does so before another null is computed.
    last: Option<Rc<Origin>>,
    /// Of the nulls that variables and properties hold.
    stored: FxHashMap<Target, Rc<Origin>>,
}

struct Origin {
    span: Span,
    reason: Reason,
}

/// Why a value is null.
pub(super) enum Reason {
    /// The word `null`.
    Written,
    /// A variable declared without a value.
    Declared,
    /// `any in v`
    Empty { ring: Whose },
    /// A look-up that found a gap beside x, or that did not find x. `shown` is the ring.
    Lookup { x: Option<Vertex>, ring: Whose, found: bool, forward: bool, shown: String },
    /// Read from there, where it was not stored in this step.
    Held { target: Target },
}

/// Where a null was found.
pub(super) struct Whose {
    /// As messages call it.
    name: String,
    /// Of a vertex, and whether its old ring.
    vertex: Option<(Vertex, bool)>,
}

impl Machine<'_> {
    pub(super) fn whose(&self, source: Source) -> Whose {
        let vertex = match source {
            Source::Of { v, old } => Some((v, old)),
            Source::Variable { .. } => None,
        };
        Whose { name: self.ring_name(source), vertex }
    }

    /// The null value, with its origin if origins are wanted.
    #[inline]
    pub(super) fn null(&mut self, span: Span, reason: impl FnOnce(&Self) -> Reason) -> Value {
        if self.trace.is_some() {
            let origin = Rc::new(Origin { span, reason: reason(self) });
            if let Some(trace) = &mut self.trace {
                trace.last = Some(origin);
            }
        }
        Value::Vertex(None)
    }

    /// `value` was read from `target`.
    #[inline]
    pub(super) fn trace_load(&mut self, value: Value, target: Target, span: Span) {
        if let Some(trace) = &mut self.trace
            && value == Value::Vertex(None)
        {
            let new = || Rc::new(Origin { span, reason: Reason::Held { target } });
            trace.last = Some(trace.stored.get(&target).map_or_else(new, Rc::clone));
        }
    }

    /// `value`, computed last, was stored to `target`.
    #[inline]
    pub(super) fn trace_store(&mut self, value: Value, target: Target) {
        if let Some(trace) = &mut self.trace
            && value == Value::Vertex(None)
            && let Some(origin) = &trace.last
            && trace.stored.len() < REMEMBERED
        {
            trace.stored.insert(target, Rc::clone(origin));
        }
    }

    /// An error about the null that was computed last.
    #[cold]
    pub(super) fn fail_on_null(&self, span: Span, message: impl Into<String>) -> Box<Fault> {
        let mut fault = self.fail_with(FailureKind::Program, span, message);
        fault.of_null = true;
        let Some(origin) = self.trace.as_ref().and_then(|t| t.last.as_ref()) else { return fault };
        let code = self.code(origin.span);
        match &origin.reason {
            Reason::Written => fault.label(origin.span, "null is written here"),
            Reason::Declared => fault.label(origin.span, format!("`{code}` is declared here without a vertex")),
            Reason::Empty { ring: Whose { name, vertex: Some((v, _)) } } => fault
                .label(origin.span, format!("`{code}` is null here: {v} has no neighbours"))
                .about([*v])
                .evidence(format!("{name}: empty")),
            Reason::Empty { ring: Whose { name, vertex: None } } => {
                fault.label(origin.span, format!("`{code}` is null here: `{name}` is empty"))
            }
            Reason::Lookup { x, ring: Whose { name, vertex: None }, shown, .. } => {
                let sought = x.map_or_else(|| "null".to_owned(), |x| x.to_string());
                fault
                    .label(origin.span, format!("`{code}` is null here: {sought} is not in `{name}`"))
                    .evidence(format!("{name}: {shown}"))
                    .about(*x)
            }
            Reason::Lookup { x, ring: Whose { name, vertex: Some((v, old)) }, found, forward, shown } => {
                let why = match (x, found) {
                    (None, _) => format!("the {name} has no gap"),
                    (Some(x), false) => format!("{x} is not in the {name}"),
                    (Some(x), true) if *forward => format!("a hole follows {x} in the {name}"),
                    (Some(x), true) => format!("a hole precedes {x} in the {name}"),
                };
                let mut fault = fault
                    .label(origin.span, format!("`{code}` is null here: {why}"))
                    .evidence(format!("{name}: {shown}"))
                    .about(std::iter::once(*v).chain(*x));
                if *found {
                    fault = fault.hint(format!("{v} lies on a boundary: test `{code} == null` first"));
                } else if x.is_some() && !old && self.old.holds(*v) && self.old.mesh.ring(*v).contains(*x) {
                    let old_ring = text::ring(self.old.mesh.ring(*v), *x);
                    fault = fault.evidence(format!("old ring of {v}: {old_ring}"));
                    fault = fault.hint("the old ring holds it: is that the one meant, with a ` before the vertex?");
                }
                fault
            }
            Reason::Held { target } => {
                let (held, vertices) = self.describe(*target);
                let was_old =
                    matches!(target, Target::VertexProperty { old: true, .. } | Target::EdgeProperty { old: true, .. });
                let why =
                    if was_old { "it was so when synchronized" } else { "no vertex was stored there in this step" };
                fault.label(origin.span, format!("{held} is null: {why}")).about(vertices)
            }
        }
    }

    fn describe(&self, target: Target) -> (String, Vec<Vertex>) {
        let name = |names: &[crate::ir::PropertyDeclaration], i: u32| {
            names.get(i as usize).map(|p| format!("${}", p.name)).unwrap_or_default()
        };
        let old_mark = |old| if old { "the old " } else { "" };
        match target {
            Target::VertexProperty { property, v, old } => {
                (format!("{}{v}{}", old_mark(old), name(&self.program.vertex_properties, property)), vec![v])
            }
            Target::EdgeProperty { property, ends: [p, q], old } => {
                let name = name(&self.program.edge_properties, property);
                (format!("{}({p}|{q}){name}", old_mark(old)), vec![p, q])
            }
            Target::MeshProperty { property, .. } => {
                (format!("the mesh's {}", name(&self.program.mesh_properties, property)), Vec::new())
            }
            Target::Local(_) | Target::Position { .. } => ("this".to_owned(), Vec::new()),
        }
    }

    /// The text of a place, to be quoted: one line, cut where it is long.
    pub(super) fn code(&self, span: Span) -> String {
        let words: Vec<&str> = self.program.sources.text(span).split_whitespace().collect();
        let text = words.join(" ");
        let text = without_parentheses(&text);
        match text.char_indices().nth(60) {
            Some((end, _)) => format!("{} …", &text[..end]),
            None => text.to_owned(),
        }
    }

    /// The ring as evidence: `ring of v2: v5 v7 ∅`.
    pub(super) fn ring_evidence(&self, v: Vertex, x: Option<Vertex>) -> String {
        format!("ring of {v}: {}", text::ring(self.mesh.ring(v), x))
    }
}

/// `(a)` is quoted as `a`, `(a) + (b)` as it is.
fn without_parentheses(text: &str) -> &str {
    let Some(inner) = text.strip_prefix('(').and_then(|t| t.strip_suffix(')')) else { return text };
    let mut open = 0;
    for c in inner.chars() {
        open += i32::from(c == '(') - i32::from(c == ')');
        if open < 0 {
            return text;
        }
    }
    inner
}
