//! From text to tree: never fails, never panics; what could not be read is reported.

pub mod tree;

use crate::diagnostic::Diagnostic;
use crate::source::FileId;
use tree::Ast;

/// Reads a text. The tree holds what could be made of it; it is whole if no diagnostic is an error.
#[must_use]
pub fn parse(_file: FileId, _text: &str) -> (Ast, Vec<Diagnostic>) {
    (Ast::default(), Vec::new())
}

/// What a stretch of text is, for colouring.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TokenClass {
    /// `if`, `return`, `const`, …
    Keyword,
    /// `forall`, `nextto`, `splice`, … where they are words of the algebra and not names.
    Algebra,
    /// `vertex`, `double`, …
    Type,
    /// A name followed by `(`.
    Function,
    /// `$pos`
    Property,
    /// `` ` `` and its forms.
    Old,
    /// Any other name.
    Name,
    /// A number, `true`, `false`, `null`, `tau`.
    Literal,
    /// A string.
    Text,
    /// A comment.
    Comment,
    /// `#include`
    Directive,
    /// Operators and brackets.
    Punctuation,
    /// What no token begins with.
    Error,
}

/// Classes of the tokens of a text in order, as byte ranges; white space is left out. Never fails.
#[must_use]
pub fn highlight(_text: &str) -> Vec<(std::ops::Range<usize>, TokenClass)> {
    Vec::new()
}
