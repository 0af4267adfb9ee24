//! The syntax as a specification: text in; tree, messages or classes out.

mod errors;
mod format;
mod lexical;
mod listings;
mod robust;
mod sexpr;
mod trees;

use super::parse;
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::{FileId, Sources};

/// The tree of a text that must be free of errors, as an S-expression.
#[track_caller]
fn tree(text: &str) -> String {
    let (ast, diagnostics) = parse(FileId::MAIN, text);
    let errors: Vec<_> = diagnostics.iter().filter(|d| d.severity != Severity::Note).collect();
    assert!(errors.is_empty(), "unexpected diagnostics for\n{text}\n{}", render(text, &diagnostics));
    sexpr::ast(&ast)
}

/// The tree of the statements of a function.
#[track_caller]
fn statements(text: &str) -> String {
    let tree = tree(&format!("void f() {{\n{text}\n}}"));
    tree.strip_prefix("(fn void f ()").and_then(|t| t.strip_suffix(')')).unwrap_or(&tree).trim().to_owned()
}

fn render(text: &str, diagnostics: &[Diagnostic]) -> String {
    let mut sources = Sources::default();
    sources.add("test.vv", text);
    crate::diagnostic::render(diagnostics, &sources, crate::diagnostic::Form::Human { color: false })
}

/// The text after all edits of hints were carried out.
fn mended(text: &str, diagnostics: &[Diagnostic]) -> String {
    let mut edits: Vec<_> = diagnostics.iter().flat_map(|d| &d.hints).filter_map(|h| h.edit.clone()).collect();
    edits.sort_by_key(|(span, _)| std::cmp::Reverse((span.start, span.end)));
    let mut text = text.to_owned();
    for (span, replacement) in edits {
        text.replace_range(span.start as usize..span.end as usize, &replacement);
    }
    text
}
