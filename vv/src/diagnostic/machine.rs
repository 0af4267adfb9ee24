//! Diagnostics for other programs: one line each.

use serde::Serialize;

use super::{Diagnostic, Hint, Severity};
use crate::source::{Sources, Span};

/// `file:line:column: error: message`
pub(super) fn short(diagnostic: &Diagnostic, sources: &Sources) -> String {
    let place = diagnostic.span.and_then(|span| sources.locate(span));
    let place = place.map(|(file, start, _)| format!("{file}:{}:{}: ", start.line, start.column));
    let line = format!("{}{}: {}", place.unwrap_or_default(), word(diagnostic.severity), diagnostic.message);
    super::human::printable(&line).replace(['\n', '\r'], " ") + "\n"
}

/// How a severity is written.
pub(super) fn word(severity: Severity) -> &'static str {
    match severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    }
}

/// One JSON object. Lines and columns count from 1, columns in characters; ends are exclusive. What has no place in the
/// texts has `null` for file, lines and columns.
pub(super) fn json(diagnostic: &Diagnostic, sources: &Sources) -> String {
    let object = Object {
        severity: diagnostic.severity,
        message: &diagnostic.message,
        place: Place::of(diagnostic.span, sources),
        labels: diagnostic
            .labels
            .iter()
            .map(|(span, message)| Label { place: Place::of(Some(*span), sources), message })
            .collect(),
        evidence: &diagnostic.evidence,
        hints: diagnostic.hints.iter().map(|hint| HintObject::of(hint, sources)).collect(),
        vertices: diagnostic.vertices.iter().map(ToString::to_string).collect(),
        calls: diagnostic
            .calls
            .iter()
            .map(|(function, span)| Call { function, place: Place::of(Some(*span), sources) })
            .collect(),
    };
    // Strings, numbers and lists of them cannot fail to serialize.
    serde_json::to_string(&object).unwrap_or_default() + "\n"
}

#[derive(Serialize)]
struct Object<'d> {
    severity: Severity,
    message: &'d str,
    #[serde(flatten)]
    place: Place<'d>,
    labels: Vec<Label<'d>>,
    evidence: &'d [String],
    hints: Vec<HintObject<'d>>,
    vertices: Vec<String>,
    calls: Vec<Call<'d>>,
}

#[derive(Serialize)]
struct Place<'d> {
    file: Option<&'d str>,
    line: Option<u32>,
    column: Option<u32>,
    end_line: Option<u32>,
    end_column: Option<u32>,
}

impl<'d> Place<'d> {
    fn of(span: Option<Span>, sources: &'d Sources) -> Self {
        let located = span.and_then(|span| sources.locate(span));
        Self {
            file: located.map(|(file, ..)| file),
            line: located.map(|(_, start, _)| start.line),
            column: located.map(|(_, start, _)| start.column),
            end_line: located.map(|(.., end)| end.line),
            end_column: located.map(|(.., end)| end.column),
        }
    }
}

#[derive(Serialize)]
struct Label<'d> {
    #[serde(flatten)]
    place: Place<'d>,
    message: &'d str,
}

#[derive(Serialize)]
struct Call<'d> {
    function: &'d str,
    #[serde(flatten)]
    place: Place<'d>,
}

#[derive(Serialize)]
struct HintObject<'d> {
    message: &'d str,
    edit: Option<Edit<'d>>,
}

#[derive(Serialize)]
struct Edit<'d> {
    #[serde(flatten)]
    place: Place<'d>,
    replacement: &'d str,
}

impl<'d> HintObject<'d> {
    fn of(hint: &'d Hint, sources: &'d Sources) -> Self {
        let edit = hint.edit.as_ref();
        let edit = edit.map(|(span, replacement)| Edit { place: Place::of(Some(*span), sources), replacement });
        Self { message: &hint.message, edit }
    }
}
