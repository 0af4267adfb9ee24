//! Classes of tokens, for colouring.

use std::ops::Range;

use super::TokenClass;
use super::lexer::Kind;
use super::parser::{Parsed, Role, parse};
use super::words;
use crate::source::FileId;

/// Classes of the tokens of a text in order, as byte ranges; white space is left out. Never fails, half-written text
/// is coloured as far as it goes. Linear in the length of the text.
#[must_use]
pub fn highlight(text: &str) -> Vec<(Range<usize>, TokenClass)> {
    let Parsed { tokens, skipped, roles, .. } = parse(FileId::MAIN, text);
    let mut classes = Vec::with_capacity(tokens.len() + skipped.len());
    let mut skipped = skipped.into_iter().map(|s| s.start as usize..s.end as usize).peekable();
    for (i, token) in tokens.iter().enumerate() {
        let range = token.start as usize..token.end as usize;
        while let Some(comment) = skipped.next_if(|s| s.start <= range.start) {
            classes.push((comment, TokenClass::Comment));
        }
        let kind = |i: usize| tokens.get(i).map_or(Kind::End, |t| t.kind);
        let before = if i == 0 { Kind::End } else { kind(i - 1) };
        let class = match token.kind {
            Kind::End => continue,
            Kind::Int | Kind::Double => TokenClass::Literal,
            Kind::Text => TokenClass::Text,
            Kind::Old => TokenClass::Old,
            Kind::Hash => TokenClass::Directive,
            Kind::Unknown => TokenClass::Error,
            Kind::Dollar if kind(i + 1) == Kind::Word => TokenClass::Property,
            Kind::Word => {
                let word = &text[range.clone()];
                word_class(word, roles.get(i).copied().flatten(), before, kind(i + 1))
            }
            _ => TokenClass::Punctuation,
        };
        classes.push((range, class));
    }
    classes
}

fn word_class(word: &str, role: Option<Role>, before: Kind, behind: Kind) -> TokenClass {
    match word {
        _ if before == Kind::Dollar => TokenClass::Property,
        "include" if before == Kind::Hash => TokenClass::Directive,
        "true" | "false" | "null" | "tau" => TokenClass::Literal,
        _ if words::reserved_type(word).is_some() || role == Some(Role::Type) => TokenClass::Type,
        _ if words::is_reserved(word) => TokenClass::Keyword,
        _ if role == Some(Role::Algebra) => TokenClass::Algebra,
        _ if behind == Kind::OpenParen => TokenClass::Function,
        _ => TokenClass::Name,
    }
}
