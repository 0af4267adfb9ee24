//! Diagnostics for people: the lines of the text with marks below them.

use std::borrow::Cow;

use codespan_reporting::diagnostic as codespan;
use codespan_reporting::files::SimpleFiles;
use codespan_reporting::term::termcolor::{Ansi, NoColor};
use codespan_reporting::term::{self, Config};

use super::{Diagnostic, Severity};
use crate::source::{Sources, Span};

/// Calls of a run-time error that are shown; of more than that only the innermost and the outermost.
const MOST_CALLS: usize = 8;

/// Vertices that are listed.
const MOST_VERTICES: usize = 10;

pub(super) fn render(diagnostics: &[Diagnostic], sources: &Sources, color: bool) -> String {
    let mut files = SimpleFiles::new();
    for file in sources.files() {
        files.add(printable(&file.name).into_owned(), printable(&file.text));
    }
    let config = Config::default();
    let mut written = Vec::new();
    for diagnostic in diagnostics {
        let shown = convert(diagnostic, sources);
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

fn convert(diagnostic: &Diagnostic, sources: &Sources) -> codespan::Diagnostic<usize> {
    let severity = match diagnostic.severity {
        Severity::Note => codespan::Severity::Note,
        Severity::Warning => codespan::Severity::Warning,
        Severity::Error => codespan::Severity::Error,
    };
    let mut labels = Vec::new();
    let mut notes = Vec::new();
    let mut label = |style, span: Span, message: String| {
        if let Some(range) = range(span, sources) {
            let label = codespan::Label::new(style, span.file.0 as usize, range);
            labels.push(label.with_message(printable(&message).into_owned()));
        }
    };
    if let Some(span) = diagnostic.span {
        label(codespan::LabelStyle::Primary, span, String::new());
    }
    for (span, message) in &diagnostic.labels {
        label(codespan::LabelStyle::Secondary, *span, message.clone());
    }
    let calls = &diagnostic.calls;
    for (i, (function, span)) in calls.iter().enumerate() {
        if i + 1 < MOST_CALLS || i + 1 == calls.len() {
            label(codespan::LabelStyle::Secondary, *span, format!("`{function}` is called from here"));
        }
    }
    notes.extend(diagnostic.evidence.iter().cloned());
    if calls.len() > MOST_CALLS {
        notes.push(format!("{} more calls are open between these", calls.len() - MOST_CALLS));
    }
    notes.extend(vertices(diagnostic));
    notes.extend(diagnostic.hints.iter().map(|hint| format!("help: {}", hint.message)));
    codespan::Diagnostic::new(severity)
        .with_message(printable(&diagnostic.message))
        .with_labels(labels)
        .with_notes(notes.iter().map(|note| printable(note).into_owned()).collect())
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

/// The bytes of a span, moved into its text and onto whole characters.
fn range(span: Span, sources: &Sources) -> Option<std::ops::Range<usize>> {
    let text = &sources.file(span.file)?.text;
    let floor = |offset: u32| {
        let offset = (offset as usize).min(text.len());
        (0..=offset).rev().find(|&o| text.is_char_boundary(o)).unwrap_or(0)
    };
    let (start, end) = (floor(span.start), floor(span.end));
    Some(start..end.max(start))
}
