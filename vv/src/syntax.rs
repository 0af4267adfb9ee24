//! From text to tree: never fails, never panics; what could not be read is reported.

mod format;
mod highlight;
mod lexer;
mod parser;
pub mod tree;
mod words;

#[cfg(test)]
mod tests;

use crate::diagnostic::Diagnostic;
use crate::source::FileId;
use tree::Ast;

/// Reads a text. The tree holds what could be made of it; it is whole if no diagnostic is an error. Linear in the
/// length of the text; at most 100 diagnostics.
#[must_use]
pub fn parse(file: FileId, text: &str) -> (Ast, Vec<Diagnostic>) {
    let parsed = parser::parse(file, text);
    (parsed.ast, parsed.diagnostics)
}

/// The words of the language, also those that can be names.
pub fn all_words() -> impl Iterator<Item = &'static str> {
    let lists = [words::RESERVED, words::STATEMENTS, words::PREFIXES, words::INFIXES];
    lists.into_iter().flatten().copied().chain([words::FACES])
}

/// Whether something can be called so.
#[must_use]
pub fn is_name(word: &str) -> bool {
    let is_alike = word.starts_with(|c: char| c == '_' || c.is_alphabetic());
    is_alike && word.chars().all(|c| c == '_' || c.is_alphanumeric()) && !words::is_reserved(word)
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

pub use format::format;
pub use highlight::highlight;
