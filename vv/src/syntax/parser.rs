//! From tokens to tree, by recursive descent.
//!
//! After an error the parser is *panicking*: it says nothing more and winds up whatever it is in, until a place is
//! found from which the text makes sense again — a closing bracket, the end of the statement, the next item. So one
//! mistake gives one message, and what was read before it stays in the tree. A *mended* mistake, one whose meaning is
//! plain (a missing `;`, a cast, a lost space), is reported without panicking.

mod algebra;
mod declarations;
mod expressions;
mod forall;
mod foreign;
mod items;
mod statements;

use super::lexer::{Kind, Lexed, Token, lex};
use super::tree::{Ast, Expr, ExprKind, Name, TypeKind, TypeName};
use super::words;
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::{FileId, Span};

/// How deep statements and expressions may nest, and how tall the tree of an expression may grow. Whoever walks the
/// tree by recursion relies on it.
pub(super) const DEEPEST: u32 = 200;

/// More errors than that are of no use to anyone.
const MOST_DIAGNOSTICS: usize = 100;

/// What the parser took a word for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// A word of the algebra.
    Algebra,
    /// The name of a type.
    Type,
}

/// What became of a text.
pub(super) struct Parsed {
    pub ast: Ast,
    pub diagnostics: Vec<Diagnostic>,
    pub tokens: Vec<Token>,
    /// Comments and line numbers.
    pub skipped: Vec<std::ops::Range<u32>>,
    /// For each token that was read as one.
    pub roles: Vec<Option<Role>>,
}

/// Reads a text.
pub(super) fn parse(file: FileId, text: &str) -> Parsed {
    let Lexed { tokens, skipped, diagnostics } = lex(file, text);
    let roles = vec![None; tokens.len()];
    let mut parser = Parser {
        file,
        text,
        tokens,
        roles,
        at: 0,
        depth: 0,
        panicking: false,
        too_deep: false,
        gave_up: false,
        unclosed: false,
        diagnostics,
    };
    let ast = parser.file();
    let Parser { tokens, roles, mut diagnostics, .. } = parser;
    diagnostics.sort_by_key(|d| d.span.map(|s| (s.start, s.end)));
    if diagnostics.len() > MOST_DIAGNOSTICS {
        diagnostics.truncate(MOST_DIAGNOSTICS);
        diagnostics.push(Diagnostic::new(Severity::Note, None, "there are more errors than are shown here"));
    }
    Parsed { ast, diagnostics, tokens, skipped, roles }
}

/// An expression and the height of its tree.
struct Tall {
    expr: Expr,
    height: u32,
}

struct Parser<'t> {
    file: FileId,
    text: &'t str,
    tokens: Vec<Token>,
    roles: Vec<Option<Role>>,
    at: usize,
    depth: u32,
    panicking: bool,
    /// "nested too deeply" was said; once is enough.
    too_deep: bool,
    /// The text is too deep to go on with; nothing more is said.
    gave_up: bool,
    /// A missing `}` was reported; the blocks around it are over, too.
    unclosed: bool,
    diagnostics: Vec<Diagnostic>,
}

impl<'t> Parser<'t> {
    // Looking at tokens

    fn token(&self, at: usize) -> Token {
        // The last token is the end; there is always one.
        self.tokens[at.min(self.tokens.len() - 1)]
    }

    fn kind(&self) -> Kind {
        self.token(self.at).kind
    }

    fn kind_at(&self, at: usize) -> Kind {
        self.token(at).kind
    }

    fn text_at(&self, at: usize) -> &'t str {
        let token = self.token(at);
        &self.text[token.start as usize..token.end as usize]
    }

    /// The word at a token, empty if it is none.
    fn word_at(&self, at: usize) -> &'t str {
        if self.kind_at(at) == Kind::Word { self.text_at(at) } else { "" }
    }

    fn word(&self) -> &'t str {
        self.word_at(self.at)
    }

    fn is_end(&self) -> bool {
        self.kind() == Kind::End
    }

    /// Whether a value can begin at a token.
    fn operand_at(&self, at: usize) -> bool {
        match self.kind_at(at) {
            Kind::Int | Kind::Double | Kind::Text | Kind::Old | Kind::OpenParen => true,
            Kind::Word => {
                let word = self.text_at(at);
                let is_value = matches!(word, "null" | "true" | "false") || words::any_type(word).is_some();
                (is_value || !words::is_reserved(word)) && !(self.token(at).new_line && words::leads(word))
            }
            _ => false,
        }
    }

    fn span_at(&self, at: usize) -> Span {
        let token = self.token(at);
        Span::new(self.file, token.start, token.end)
    }

    /// The current token, or the last one where the text is over.
    fn here(&self) -> Span {
        if self.is_end() { self.previous() } else { self.span_at(self.at) }
    }

    /// The token before the current one.
    fn previous(&self) -> Span {
        self.span_at(self.at.saturating_sub(1))
    }

    /// From a token to the one before the current one.
    fn since(&self, start: usize) -> Span {
        let from = self.span_at(start);
        if self.at > start { from.to(self.previous()) } else { Span { end: from.start, ..from } }
    }

    fn source(&self, span: Span) -> &'t str {
        self.text.get(span.start as usize..span.end as usize).unwrap_or("")
    }

    // Taking tokens

    fn bump(&mut self) {
        if !self.is_end() {
            self.at += 1;
        }
    }

    fn bump_as(&mut self, role: Role) {
        if let Some(r) = self.roles.get_mut(self.at) {
            *r = Some(role);
        }
        self.bump();
    }

    fn eat(&mut self, kind: Kind) -> bool {
        let found = self.kind() == kind && !self.panicking;
        if found {
            self.bump();
        }
        found
    }

    fn eat_word(&mut self, word: &str) -> bool {
        let found = self.word() == word && !self.panicking;
        if found {
            self.bump();
        }
        found
    }

    /// A name; `what` it names is said if there is none.
    fn name(&mut self, what: &str) -> Name {
        let span = self.here();
        let word = self.word();
        if !self.panicking && !word.is_empty() && !words::is_reserved(word) {
            self.bump();
            return Name { text: word.to_owned(), span };
        }
        if words::is_reserved(word) {
            let message = format!("`{word}` is a word of the language and cannot be the name of {what}");
            self.fail(Diagnostic::error(span, message).hint("choose another name"));
        } else {
            self.unexpected(&format!("the name of {what}"));
        }
        Name { text: String::new(), span }
    }

    /// A type, if one stands here.
    fn type_name(&mut self) -> Option<TypeName> {
        let kind = words::any_type(self.word())?;
        let span = self.here();
        self.bump_as(Role::Type);
        Some(TypeName { kind, span })
    }

    // Saying what is wrong

    /// Reports a mistake whose meaning is plain.
    fn mend(&mut self, diagnostic: Diagnostic) {
        if !self.panicking && !self.gave_up {
            self.diagnostics.push(diagnostic);
        }
    }

    /// Reports a mistake and gives up on the construct.
    fn fail(&mut self, diagnostic: Diagnostic) {
        // What the lexer could not read it has reported already.
        if !self.panicking && !self.gave_up && self.kind() != Kind::Unknown {
            self.diagnostics.push(diagnostic);
        }
        self.panicking = true;
    }

    /// Reports that something else was expected here, with what can be guessed from what stands here.
    fn unexpected(&mut self, expected: &str) {
        let diagnostic = Diagnostic::error(self.here(), format!("expected {expected}, found {}", self.found()));
        let diagnostic = self.guess(diagnostic);
        self.fail(diagnostic);
    }

    /// The current token in words.
    fn found(&self) -> String {
        match self.kind() {
            Kind::End => "the end of the file".to_owned(),
            Kind::Text => "a string".to_owned(),
            Kind::Int | Kind::Double => format!("the number `{}`", shorten(self.text_at(self.at))),
            _ => format!("`{}`", shorten(self.text_at(self.at))),
        }
    }

    fn guess(&self, diagnostic: Diagnostic) -> Diagnostic {
        let (here, before) = (self.here(), self.previous());
        let earlier = if self.at == 0 { "" } else { self.word_at(self.at - 1) };
        match (self.kind(), self.text_at(self.at)) {
            (Kind::Word, "in" | "is") if matches!(earlier, "nextto" | "prevto" | "is") => {
                diagnostic.hint(format!("name a vertex between `{earlier}` and `in`"))
            }
            (Kind::Word, "is") if self.word_at(self.at + 1) == "null" => {
                diagnostic.fix("compare with `==`", here, "==")
            }
            (Kind::Word, "in" | "is") => diagnostic.hint("membership is asked with `is x in v`"),
            (Kind::Word, "not") if self.word_at(self.at + 1) == "in" => {
                diagnostic.hint("membership is asked with `is x in v`, and `!is x in v` denies it")
            }
            (Kind::Word, "nb" | "nb_of") => {
                diagnostic.hint("the ring of a vertex is set with `make {a, b, c} nb_of v`")
            }
            (Kind::Word, word) if !earlier.is_empty() && !words::is_reserved(word) => {
                let known = words::STATEMENTS.iter().chain(words::PREFIXES).copied();
                match (words::foreign_construct(earlier), words::similar(earlier, known)) {
                    (Some((message, _)), _) => diagnostic.hint(message),
                    (_, Some(meant)) => diagnostic.fix(format!("did you mean `{meant}`?"), before, meant),
                    _ => diagnostic,
                }
            }
            (Kind::Bar, _) => diagnostic.hint("an edge is written `(p|q)`, with parentheses; vv has no bit operations"),
            (Kind::Ampersand, _) => diagnostic.hint("write `&&` for and; vv has no bit operations and no addresses"),
            (Kind::Foreign, "<<") => diagnostic.hint("write `print a, b;`; vv has no bit operations"),
            (Kind::Foreign, _) => diagnostic.hint("vv has no bit operations; powers are written `pow(x, 2.0)`"),
            (Kind::OpenBracket, _) => {
                diagnostic.hint("vv has neither arrays nor lambdas; keep values as properties of vertices: `v$name`")
            }
            (Kind::OpenBrace, _) if self.follows(&[Kind::Assign, Kind::Comma, Kind::OpenParen]) => {
                diagnostic.hint("a vector is written `vec(x, y, z)`")
            }
            (Kind::Arrow, _) => diagnostic.fix("properties are written `v$name`", here, "$"),
            (Kind::DoubleColon, _) => diagnostic.hint("vv has no namespaces"),
            (Kind::Old, _) => diagnostic.hint("the old-value mark stands before a name: `` `v$pos ``"),
            (Kind::Less, _) if self.text_at(self.at.wrapping_sub(1)) == "=" => {
                diagnostic.fix("write `<=`", before.to(here), "<=")
            }
            (Kind::Greater, _) if self.text_at(self.at.wrapping_sub(1)) == "=" => {
                diagnostic.fix("write `>=`", before.to(here), ">=")
            }
            (Kind::Assign, _) if matches!(self.text_at(self.at.wrapping_sub(1)), "==" | "!=") => {
                diagnostic.hint("write `==` or `!=`")
            }
            _ => diagnostic,
        }
    }

    fn follows(&self, kinds: &[Kind]) -> bool {
        self.at > 0 && kinds.contains(&self.kind_at(self.at - 1))
    }

    // Finding back

    /// Takes the bracket that closes the one at token `open`; if it is not there, goes on behind it where it can be
    /// found in the same statement. Whether nothing was left out.
    fn close(&mut self, close: Kind, open: usize) -> bool {
        self.close_list(close, open, false)
    }

    /// As [`Parser::close`]; `in_list`: there might have been a comma, too.
    fn close_list(&mut self, close: Kind, open: usize, in_list: bool) -> bool {
        if self.eat(close) {
            return true;
        }
        let sign = if close == Kind::CloseParen { ")" } else { "]" };
        let opening = self.span_at(open);
        if !self.panicking && self.statement_is_over() {
            let end = self.after_previous();
            let message = format!("expected `{sign}` after this");
            self.mend(Diagnostic::error(self.previous(), message).label(opening, "to close this").fix(
                format!("write `{sign}`"),
                end,
                sign,
            ));
            return true;
        }
        if !self.panicking {
            let comma = if in_list { "`,` or " } else { "" };
            let message = format!("expected {comma}`{sign}`, found {}", self.found());
            let diagnostic = self.guess(Diagnostic::error(self.here(), message).label(opening, "to close this"));
            self.fail(diagnostic);
        }
        let mut depth = 0;
        loop {
            match self.kind() {
                kind if kind == close && depth == 0 => {
                    self.bump();
                    self.panicking = false;
                    return false;
                }
                Kind::OpenParen | Kind::OpenBracket => depth += 1,
                Kind::CloseParen | Kind::CloseBracket if depth > 0 => depth -= 1,
                _ if self.statement_is_over() => return false,
                _ => {}
            }
            self.bump();
        }
    }

    /// Whether what stands here cannot belong to an expression that has begun.
    fn statement_is_over(&self) -> bool {
        match self.kind() {
            Kind::Semicolon | Kind::OpenBrace | Kind::CloseBrace | Kind::End => true,
            Kind::Word => self.token(self.at).new_line && words::leads(self.word()),
            _ => false,
        }
    }

    fn after_previous(&self) -> Span {
        let previous = self.previous();
        Span { start: previous.end, ..previous }
    }

    /// Takes the `;` that ends a statement. Forgives one that is missing at the end of a line, and finds the end of a
    /// statement that went wrong.
    fn end_statement(&mut self) {
        if self.eat(Kind::Semicolon) {
            return;
        }
        let new_line = self.token(self.at).new_line && (self.kind() == Kind::Word || self.kind() == Kind::Hash);
        let over = self.statement_is_over() && self.kind() != Kind::OpenBrace;
        if !self.panicking && (new_line || over || words::leads(self.word())) && !self.is_mistyped() {
            let end = self.after_previous();
            self.mend(Diagnostic::error(self.previous(), "expected `;` after this").fix("write `;`", end, ";"));
            return;
        }
        if !self.panicking {
            self.unexpected("`;`");
        }
        self.synchronize();
    }

    /// Whether the word before is probably a word of the algebra with a slip in it.
    fn is_mistyped(&self) -> bool {
        let earlier = if self.at == 0 { "" } else { self.word_at(self.at - 1) };
        let known = words::STATEMENTS.iter().chain(words::PREFIXES).copied();
        !self.token(self.at).new_line && self.kind() == Kind::Word && words::similar(earlier, known).is_some()
    }

    /// Skips to the end of the statement that went wrong: behind its `;` or block, before the `}` around it, or before
    /// a line that begins a statement.
    fn synchronize(&mut self) {
        self.panicking = false;
        let start = self.at;
        let mut depth = 0;
        loop {
            match self.kind() {
                Kind::End => return,
                Kind::Semicolon if depth == 0 => return self.bump(),
                Kind::OpenBrace => depth += 1,
                Kind::CloseBrace if depth == 0 => return,
                Kind::CloseBrace => {
                    depth -= 1;
                    if depth == 0 {
                        return self.bump();
                    }
                }
                _ if depth == 0 && self.at > start && self.statement_is_over() => return,
                _ => {}
            }
            self.bump();
        }
    }

    // Bounds

    /// Whether another level of nesting is too much; says so.
    fn enter(&mut self) -> bool {
        if self.depth >= DEEPEST {
            self.say_too_deep(self.here());
            self.panicking = true;
            return false;
        }
        self.depth += 1;
        true
    }

    fn leave(&mut self) {
        self.depth -= 1;
    }

    fn say_too_deep(&mut self, span: Span) {
        if !self.too_deep && !self.panicking {
            self.too_deep = true;
            let message = format!("nested too deeply, more than {DEEPEST} levels");
            self.diagnostics.push(Diagnostic::error(span, message).hint("give parts of it names of their own"));
        }
    }

    /// A node above others, of which the tallest is `below` high. One that would grow too tall is dropped.
    fn tall(&mut self, kind: ExprKind, span: Span, below: u32) -> Tall {
        if below >= DEEPEST {
            self.say_too_deep(span);
            return Tall { expr: Expr { kind: ExprKind::Error, span }, height: 1 };
        }
        Tall { expr: Expr { kind, span }, height: below + 1 }
    }

    fn error_expression(&self) -> Tall {
        Tall { expr: Expr { kind: ExprKind::Error, span: self.here() }, height: 1 }
    }

    /// The end of the bracketed text that begins at token `open`: the token behind its closing bracket, `None` if the
    /// statement ends first.
    fn behind_parentheses(&self, open: usize) -> Option<usize> {
        let mut depth = 0_u32;
        for at in open..self.tokens.len() {
            match self.kind_at(at) {
                Kind::OpenParen => depth += 1,
                Kind::CloseParen => {
                    depth = depth.saturating_sub(1);
                    if depth == 0 {
                        return Some(at + 1);
                    }
                }
                Kind::Semicolon | Kind::OpenBrace | Kind::CloseBrace | Kind::End => return None,
                Kind::Word if self.token(at).new_line && words::leads(self.text_at(at)) => return None,
                _ => {}
            }
        }
        None
    }

    /// The token behind the `}` for a `{` in the same statement, or where the statement ends.
    fn behind_braces(&self, open: usize) -> usize {
        let ends = |at: usize| matches!(self.kind_at(at), Kind::CloseBrace | Kind::Semicolon | Kind::End);
        let end = (open..self.tokens.len()).find(|&at| ends(at)).unwrap_or(open);
        if self.kind_at(end) == Kind::CloseBrace { end + 1 } else { end }
    }

    fn call(kind: TypeKind, span: Span, arguments: Vec<Expr>) -> ExprKind {
        ExprKind::Call { callee: Name { text: words::name(kind).to_owned(), span }, arguments }
    }
}

/// Calls `f`, on more stack if little is left: the depth is bounded, but who calls us may run on a small stack.
fn grow<R>(f: impl FnOnce() -> R) -> R {
    stacker::maybe_grow(256 << 10, 4 << 20, f)
}

/// A text that fits into a sentence.
fn shorten(text: &str) -> String {
    const MOST: usize = 40;
    let mut short: String = text.chars().take(MOST).flat_map(char::escape_debug).collect();
    if text.chars().nth(MOST).is_some() {
        short.push('…');
    }
    short
}
