//! What is wrong, and where.

use std::ops::Range;
use std::sync::Arc;

use vv::Compilation;
use vv::diagnostic::{Diagnostic, Severity};
use vv::source::{FileId, Position, Sources, Span};

/// A diagnostic with its place looked up.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// What is wrong.
    pub diagnostic: Diagnostic,
    /// Where; `None` for what concerns a mesh or a step as a whole.
    pub place: Option<Place>,
    /// Other places that explain this one, with what is said there.
    pub labels: Vec<(Place, String)>,
    /// The generation whose vertices it names, if any: of a step that failed, the one before.
    pub generation: Option<u64>,
}

impl Problem {
    /// All of it, to be passed on: place and message in a line, then what explains it.
    #[must_use]
    pub fn to_text(&self) -> String {
        let at = |place: &Place| format!("{}:{}:{}", place.file, place.start.line, place.start.column);
        let severity = match self.diagnostic.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        };
        let place = self.place.as_ref().map_or_else(String::new, |place| format!("{}: ", at(place)));
        let mut text = format!("{place}{severity}: {}", self.diagnostic.message);
        for (place, what) in &self.labels {
            text += &format!("\n  {}: {what}", at(place));
        }
        for fact in &self.diagnostic.evidence {
            text += &format!("\n  {fact}");
        }
        for hint in &self.diagnostic.hints {
            text += &format!("\n  hint: {}", hint.message);
        }
        text
    }
}

/// A stretch of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The file's name.
    pub file: String,
    /// Whether it is the text in the editor.
    pub own: bool,
    /// Its first character.
    pub start: Position,
    /// Bytes of the file.
    pub range: Range<usize>,
}

/// What compiling, reading the mesh, running and writing it found.
#[derive(Debug, Clone, Default)]
pub struct Problems {
    compiled: Vec<Problem>,
    mesh: Vec<Problem>,
    ran: Vec<Problem>,
    written: Vec<Problem>,
}

impl Problems {
    /// All of them: of the text, of the mesh, of the run, of what was written of it.
    pub fn iter(&self) -> impl Iterator<Item = &Problem> {
        self.compiled.iter().chain(&self.mesh).chain(&self.ran).chain(&self.written)
    }

    /// How many there are of a severity.
    #[must_use]
    pub fn count(&self, severity: Severity) -> usize {
        self.iter().filter(|p| p.diagnostic.severity == severity).count()
    }

    /// The error to tell of first.
    #[must_use]
    pub fn first_error(&self) -> Option<&Problem> {
        self.iter().find(|p| p.diagnostic.severity == Severity::Error)
    }

    pub(super) fn compiled(&mut self, compilation: &Compilation) {
        self.compiled = located(&compilation.diagnostics, &compilation.sources, None);
        self.ran.clear();
        self.written.clear();
    }

    /// `lost` is what the mesh says and the program cannot hold; `sources` are the program's.
    pub(super) fn mesh_read(&mut self, name: &str, diagnostics: &[Diagnostic], lost: &[Diagnostic], sources: &Sources) {
        self.mesh = located(diagnostics, &Sources::default(), Some(0));
        for problem in &mut self.mesh {
            problem.diagnostic.message = format!("{name}: {}", problem.diagnostic.message);
        }
        self.mesh.extend(located(lost, sources, None));
    }

    pub(super) fn ran(&mut self, diagnostics: &[Diagnostic], sources: &Arc<Sources>, generation: u64) {
        self.ran = located(diagnostics, sources, Some(generation));
    }

    /// Until something is computed or saved anew.
    pub(super) fn written(&mut self, diagnostics: &[Diagnostic]) {
        self.written = located(diagnostics, &Sources::default(), None);
    }
}

fn located(diagnostics: &[Diagnostic], sources: &Sources, generation: Option<u64>) -> Vec<Problem> {
    let place = |span: Span| {
        let (file, start, _) = sources.locate(span)?;
        let range = span.start as usize..span.end as usize;
        Some(Place { file: crate::document::file_name(file.as_ref()), own: span.file == FileId::MAIN, start, range })
    };
    let labels =
        |d: &Diagnostic| d.labels.iter().filter_map(|(span, text)| Some((place(*span)?, text.clone()))).collect();
    let problem = |d: &Diagnostic| Problem {
        diagnostic: d.clone(),
        place: d.span.and_then(place),
        labels: labels(d),
        generation,
    };
    diagnostics.iter().map(problem).collect()
}
