//! Diagnostics for people: the lines of the text with marks below them.

use std::borrow::Cow;

use codespan_reporting::diagnostic as codespan;
use codespan_reporting::term::termcolor::{Ansi, NoColor};
use codespan_reporting::term::{self, Config};

use super::excerpt::Excerpts;
use super::{Diagnostic, Severity};
use crate::source::{Sources, Span};

/// Calls of a run-time error that are shown; of more than that only the innermost and the outermost.
const MOST_CALLS: usize = 8;

/// Characters of a fact that are shown, such as of the ring of a vertex with thousands of neighbours.
const MOST_SIGNS: usize = 400;

/// Vertices that are listed.
const MOST_VERTICES: usize = 10;

pub(super) fn render(diagnostics: &[Diagnostic], sources: &Sources, color: bool) -> String {
    let config = Config::default();
    let mut written = Vec::new();
    for diagnostic in diagnostics {
        let marks = marks(diagnostic);
        let spans: Vec<Span> = marks.iter().map(|mark| mark.span).collect();
        let files = Excerpts::new(sources, &spans);
        let shown = convert(diagnostic, &marks, &files);
        let before = written.len();
        let result = if color {
            term::emit_to_write_style(&mut Ansi::new(&mut written), &config, &files, &shown)
        } else {
            term::emit_to_write_style(&mut NoColor::new(&mut written), &config, &files, &shown)
        };
        if result.is_err() {
            written.truncate(before);
            written.extend_from_slice(super::machine::short(diagnostic, sources).as_bytes());
        }
    }
    String::from_utf8(written).unwrap_or_default()
}

/// The text with signs that steer a terminal, or turn the direction of writing, replaced by others of the same length:
/// what a program's text holds must not act on the terminal it is shown on.
pub(super) fn printable(text: &str) -> Cow<'_, str> {
    let steers = |c: char| {
        (c.is_control() && !matches!(c, '\n' | '\r' | '\t'))
            || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{200e}' | '\u{200f}' | '\u{feff}')
    };
    if !text.contains(steers) {
        return Cow::Borrowed(text);
    }
    let replace = |c: char| match c.len_utf8() {
        _ if !steers(c) => c,
        1 => '?',
        2 => '¿',
        _ => '\u{fffd}',
    };
    Cow::Owned(text.chars().map(replace).collect())
}

/// A place that is shown, with what is said there.
struct Mark {
    style: codespan::LabelStyle,
    span: Span,
    message: String,
    /// How often the same is said there.
    times: usize,
}

/// What is shown of a message, the most important first.
fn marks(diagnostic: &Diagnostic) -> Vec<Mark> {
    let mut marks: Vec<Mark> = Vec::new();
    let mut mark = |style, span, message: String| {
        let same = marks.iter_mut().find(|mark| mark.span == span && mark.style == style && mark.message == message);
        match same {
            Some(same) => same.times += 1,
            None => marks.push(Mark { style, span, message, times: 1 }),
        }
    };
    if let Some(span) = diagnostic.span {
        mark(codespan::LabelStyle::Primary, span, String::new());
    }
    for (span, message) in &diagnostic.labels {
        mark(codespan::LabelStyle::Secondary, *span, message.clone());
    }
    let calls = &diagnostic.calls;
    for (i, (function, span)) in calls.iter().enumerate() {
        if i + 1 < MOST_CALLS || i + 1 == calls.len() {
            mark(codespan::LabelStyle::Secondary, *span, format!("`{function}` is called from here"));
        }
    }
    marks
}

fn convert(diagnostic: &Diagnostic, marks: &[Mark], files: &Excerpts<'_>) -> codespan::Diagnostic<usize> {
    let severity = match diagnostic.severity {
        Severity::Note => codespan::Severity::Note,
        Severity::Warning => codespan::Severity::Warning,
        Severity::Error => codespan::Severity::Error,
    };
    let label = |mark: &Mark| {
        let message = match mark.times {
            1 => mark.message.clone(),
            n => format!("{}, {n} times", mark.message),
        };
        let label = codespan::Label::new(mark.style, mark.span.file.0 as usize, files.range(mark.span)?);
        Some(label.with_message(printable(&message)))
    };
    let mut notes = diagnostic.evidence.clone();
    // How many there are, a run-time error says itself if it does not list them all.
    if diagnostic.calls.len() > MOST_CALLS {
        notes.push("calls between these are not shown".to_owned());
    }
    notes.extend(vertices(diagnostic));
    notes.extend(diagnostic.hints.iter().map(|hint| format!("help: {}", hint.message)));
    codespan::Diagnostic::new(severity)
        .with_message(printable(&diagnostic.message))
        .with_labels(marks.iter().filter_map(label).collect())
        .with_notes(notes.iter().map(|note| brief(&printable(note))).collect())
}

fn brief(note: &str) -> String {
    match note.char_indices().nth(MOST_SIGNS) {
        Some((end, _)) => format!("{}…", &note[..end]),
        None => note.to_owned(),
    }
}

/// The vertices that the sentences do not name anyway.
fn vertices(diagnostic: &Diagnostic) -> Option<String> {
    let said = diagnostic.evidence.iter().chain([&diagnostic.message]);
    let words: Vec<&str> = said.flat_map(|s| s.split(|c: char| !c.is_alphanumeric())).collect();
    let names: Vec<String> = diagnostic.vertices.iter().map(ToString::to_string).collect();
    let silent: Vec<&str> = names.iter().map(String::as_str).filter(|name| !words.contains(name)).collect();
    let list = silent.iter().take(MOST_VERTICES).copied().collect::<Vec<_>>().join(", ");
    match silent.len() {
        0 => None,
        n if n > MOST_VERTICES => Some(format!("at {list} and {} more", n - MOST_VERTICES)),
        _ => Some(format!("at {list}")),
    }
}
