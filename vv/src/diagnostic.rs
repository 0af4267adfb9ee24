//! What is said to the user: one sentence at a place, with evidence and, where it can be guessed, a fix.

mod excerpt;
mod human;
mod machine;
#[cfg(test)]
mod tests;

use crate::mesh::Vertex;
use crate::source::Span;

/// How bad it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Worth knowing.
    Note,
    /// Runs, but probably not as meant.
    Warning,
    /// Does not run, or the step failed.
    Error,
}

/// A guess at the fix: a sentence, and the edit that would carry it out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hint {
    /// "write `merge S with NV`".
    pub message: String,
    /// Replace the text at the span by this.
    pub edit: Option<(Span, String)>,
}

/// A message to the user. Sentences begin in lower case and end without a full stop.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// Where; `None` only for messages about a mesh or the run as a whole.
    pub span: Option<Span>,
    /// One sentence.
    pub message: String,
    /// Other places that explain this one.
    pub labels: Vec<(Span, String)>,
    /// Facts that prove it: the ring as it stood, the two faces, ….
    pub evidence: Vec<String>,
    /// How it may be mended.
    pub hints: Vec<Hint>,
    /// The vertices it is about, to be shown on the mesh.
    pub vertices: Vec<Vertex>,
    /// Calls that were open at a run-time error, innermost first: function name and place of the call.
    pub calls: Vec<(String, Span)>,
}

impl Diagnostic {
    /// A message without further detail; the builders below add it.
    #[must_use]
    pub fn new(severity: Severity, span: Option<Span>, message: impl Into<String>) -> Self {
        Self {
            severity,
            span,
            message: message.into(),
            labels: Vec::new(),
            evidence: Vec::new(),
            hints: Vec::new(),
            vertices: Vec::new(),
            calls: Vec::new(),
        }
    }

    /// An error at a place.
    #[must_use]
    pub fn error(span: Span, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, Some(span), message)
    }

    /// A warning at a place.
    #[must_use]
    pub fn warning(span: Span, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, Some(span), message)
    }

    /// Adds a place that explains this one.
    #[must_use]
    pub fn label(mut self, span: Span, message: impl Into<String>) -> Self {
        self.labels.push((span, message.into()));
        self
    }

    /// Adds a fact, if it was not said yet.
    #[must_use]
    pub fn evidence(mut self, fact: impl Into<String>) -> Self {
        let fact = fact.into();
        if !self.evidence.contains(&fact) {
            self.evidence.push(fact);
        }
        self
    }

    /// Adds a hint without an edit.
    #[must_use]
    pub fn hint(mut self, message: impl Into<String>) -> Self {
        self.hints.push(Hint { message: message.into(), edit: None });
        self
    }

    /// Adds a hint with the edit that carries it out.
    #[must_use]
    pub fn fix(mut self, message: impl Into<String>, span: Span, replacement: impl Into<String>) -> Self {
        self.hints.push(Hint { message: message.into(), edit: Some((span, replacement.into())) });
        self
    }

    /// Names the vertices it is about.
    #[must_use]
    pub fn about(mut self, vertices: impl IntoIterator<Item = Vertex>) -> Self {
        self.vertices.extend(vertices);
        self
    }
}

/// How diagnostics are written out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// With the lines of the text, marks below them, evidence and hints.
    Human {
        /// ANSI colours.
        color: bool,
    },
    /// `file:line:column: error: message`, one line each.
    Short,
    /// One JSON object per line.
    Json,
}

/// Writes diagnostics out, each ended by a line end. Places outside the texts are left out.
#[must_use]
pub fn render(diagnostics: &[Diagnostic], sources: &crate::source::Sources, form: Form) -> String {
    match form {
        Form::Human { color } => human::render(diagnostics, sources, color),
        Form::Short => diagnostics.iter().map(|d| machine::short(d, sources)).collect(),
        Form::Json => diagnostics.iter().map(|d| machine::json(d, sources)).collect(),
    }
}
