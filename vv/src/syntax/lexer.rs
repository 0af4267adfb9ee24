//! From text to tokens. Takes what the printed page holds as well as what a keyboard does.

mod numbering;

use std::ops::Range;

use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span};

/// What a token is; punctuation goes by the name of its sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Kind {
    /// A name or a word of the language; which, only the parser knows.
    Word,
    Int,
    Double,
    /// A string literal with its quotes.
    Text,
    /// The old-value mark.
    Old,
    Hash,
    OpenParen,
    CloseParen,
    OpenBrace,
    CloseBrace,
    OpenBracket,
    CloseBracket,
    Comma,
    Semicolon,
    Colon,
    DoubleColon,
    Question,
    Dollar,
    Dot,
    Arrow,
    Bar,
    Ampersand,
    Assign,
    AddAssign,
    SubtractAssign,
    MultiplyAssign,
    DivideAssign,
    RemainderAssign,
    Plus,
    Minus,
    Star,
    Slash,
    Percent,
    PlusPlus,
    MinusMinus,
    Not,
    And,
    Or,
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    /// `<<`, `>>`, `^`, `~`: signs of C++ that vv has not.
    Foreign,
    /// What no token begins with; already reported.
    Unknown,
    End,
}

/// A stretch of text.
#[derive(Debug, Clone, Copy)]
pub(super) struct Token {
    pub kind: Kind,
    pub start: u32,
    pub end: u32,
    /// First of its line.
    pub new_line: bool,
}

/// What the lexer made of a text.
pub(super) struct Lexed {
    /// In order; the last one is [`Kind::End`], and only it.
    pub tokens: Vec<Token>,
    /// Comments and line numbers, in order.
    pub skipped: Vec<Range<u32>>,
    pub diagnostics: Vec<Diagnostic>,
}

/// The signs, longer ones before those they begin with.
const SIGNS: &[(&str, Kind)] = &[
    ("::", Kind::DoubleColon),
    ("->", Kind::Arrow),
    ("+=", Kind::AddAssign),
    ("-=", Kind::SubtractAssign),
    ("*=", Kind::MultiplyAssign),
    ("/=", Kind::DivideAssign),
    ("%=", Kind::RemainderAssign),
    ("++", Kind::PlusPlus),
    ("--", Kind::MinusMinus),
    ("&&", Kind::And),
    ("||", Kind::Or),
    ("==", Kind::Equal),
    ("!=", Kind::NotEqual),
    ("<=", Kind::LessEqual),
    (">=", Kind::GreaterEqual),
    ("<<", Kind::Foreign),
    (">>", Kind::Foreign),
    ("#", Kind::Hash),
    ("(", Kind::OpenParen),
    (")", Kind::CloseParen),
    ("{", Kind::OpenBrace),
    ("}", Kind::CloseBrace),
    ("[", Kind::OpenBracket),
    ("]", Kind::CloseBracket),
    (",", Kind::Comma),
    (";", Kind::Semicolon),
    (":", Kind::Colon),
    ("?", Kind::Question),
    ("$", Kind::Dollar),
    (".", Kind::Dot),
    ("|", Kind::Bar),
    ("&", Kind::Ampersand),
    ("=", Kind::Assign),
    ("+", Kind::Plus),
    ("-", Kind::Minus),
    ("*", Kind::Star),
    ("/", Kind::Slash),
    ("%", Kind::Percent),
    ("!", Kind::Not),
    ("<", Kind::Less),
    (">", Kind::Greater),
    ("^", Kind::Foreign),
    ("~", Kind::Foreign),
];

/// Signs that people and word processors write for others. Those of the printed paper ([`plain`]) pass without a word.
const LOOKALIKES: &[(char, &str, Kind)] = &[
    ('≤', "<=", Kind::LessEqual),
    ('≥', ">=", Kind::GreaterEqual),
    ('≠', "!=", Kind::NotEqual),
    ('×', "*", Kind::Star),
    ('·', "*", Kind::Star),
    ('÷', "/", Kind::Slash),
    ('∧', "&&", Kind::And),
    ('∨', "||", Kind::Or),
    ('¬', "!", Kind::Not),
    ('；', ";", Kind::Semicolon),
    ('，', ",", Kind::Comma),
    ('（', "(", Kind::OpenParen),
    ('）', ")", Kind::CloseParen),
    ('∅', "null", Kind::Unknown),
    ('∞', "1.0/0.0", Kind::Unknown),
];

/// Cuts a text into tokens.
pub(super) fn lex(file: FileId, text: &str) -> Lexed {
    let mut lexer = Lexer {
        file,
        text,
        at: 0,
        new_line: true,
        tokens: Vec::with_capacity(text.len() / 4 + 1),
        skipped: Vec::new(),
        diagnostics: Vec::new(),
    };
    lexer.run();
    Lexed { tokens: lexer.tokens, skipped: lexer.skipped, diagnostics: lexer.diagnostics }
}

/// The keyboard's sign for one of the printed page.
fn plain(c: char) -> char {
    match c {
        '−' | '–' | '—' | '‐' | '‑' | '－' => '-',
        '∗' | '⁎' => '*',
        '‘' | '’' | '‛' | '´' | '\'' => '`',
        '∣' => '|',
        _ => c,
    }
}

/// Space, also of the kinds that come with pasted text.
fn is_space(c: char) -> bool {
    c.is_whitespace() || matches!(c, '\0' | '\u{feff}' | '\u{200b}'..='\u{200d}' | '\u{2060}')
}

fn is_word_start(c: char) -> bool {
    c == '_' || c.is_alphabetic()
}

fn is_word(c: char) -> bool {
    c == '_' || c.is_alphanumeric()
}

struct Lexer<'t> {
    file: FileId,
    text: &'t str,
    at: usize,
    new_line: bool,
    tokens: Vec<Token>,
    skipped: Vec<Range<u32>>,
    diagnostics: Vec<Diagnostic>,
}

impl Lexer<'_> {
    fn run(&mut self) {
        let numbers = numbering::find(self.text);
        let mut numbers = numbers.into_iter().peekable();
        let mut first_number = None;
        while let Some(c) = self.peek() {
            while numbers.next_if(|n| n.start < self.at).is_some() {}
            if let Some(number) = numbers.next_if(|n| n.start == self.at) {
                self.at = number.end;
                let span = self.span(number.start);
                first_number.get_or_insert(span);
                self.skipped.push(span.start..span.end);
                continue;
            }
            let start = self.at;
            match c {
                '\n' | '\r' => {
                    self.at += 1;
                    self.new_line = true;
                }
                _ if is_space(c) => self.at += c.len_utf8(),
                '/' if self.rest().starts_with("//") => {
                    self.at += self.rest().find('\n').unwrap_or(self.rest().len());
                    self.skipped.push(start as u32..self.at as u32);
                }
                '/' if self.rest().starts_with("/*") => self.block_comment(),
                '"' | '“' | '”' => self.string(c),
                _ if is_word_start(c) => {
                    self.take_while(is_word);
                    self.push(Kind::Word, start);
                }
                '0'..='9' => self.number(),
                '.' if self.rest()[1..].starts_with(|c: char| c.is_ascii_digit()) => self.number(),
                '‖' | '∥' => {
                    self.at += c.len_utf8();
                    self.push(Kind::Or, start);
                }
                _ if plain(c) == '`' => {
                    self.at += c.len_utf8();
                    self.push(Kind::Old, start);
                }
                _ => self.sign(),
            }
        }
        let end = self.text.len();
        self.push(Kind::End, end);
        if let Some(span) = first_number {
            let message = "skipped the line numbers of a listing pasted from print";
            self.diagnostics.push(Diagnostic::new(crate::diagnostic::Severity::Note, Some(span), message));
        }
    }

    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn take_while(&mut self, accept: impl Fn(char) -> bool) {
        let rest = self.rest();
        self.at += rest.find(|c| !accept(c)).unwrap_or(rest.len());
    }

    fn span(&self, start: usize) -> Span {
        Span::new(self.file, start as u32, self.at as u32)
    }

    fn push(&mut self, kind: Kind, start: usize) {
        self.tokens.push(Token { kind, start: start as u32, end: self.at as u32, new_line: self.new_line });
        self.new_line = false;
    }

    fn block_comment(&mut self) {
        let start = self.at;
        match self.rest()[2..].find("*/") {
            Some(length) => self.at += length + 4,
            None => {
                self.at = self.text.len();
                let opening = Span::new(self.file, start as u32, start as u32 + 2);
                self.diagnostics
                    .push(Diagnostic::error(opening, "this comment is never closed").hint("close it with `*/`"));
            }
        }
        // What follows on the line on which a comment ends counts as first of it: it may begin a statement.
        self.new_line |= self.text[start..self.at].contains('\n');
        self.skipped.push(start as u32..self.at as u32);
    }

    fn string(&mut self, opening: char) {
        let start = self.at;
        self.at += opening.len_utf8();
        let closes = |c: char| if opening == '"' { c == '"' } else { matches!(c, '"' | '“' | '”') };
        let mut closed = false;
        while let Some(c) = self.peek() {
            if c == '\n' || c == '\r' {
                break;
            }
            self.at += c.len_utf8();
            if closes(c) {
                closed = true;
                break;
            }
            if c == '\\'
                && let Some(escaped) = self.peek().filter(|&c| c != '\n' && c != '\r')
            {
                self.at += escaped.len_utf8();
            }
        }
        if !closed {
            // The `;` at the end of the line was hardly meant to be part of it.
            let inside = self.text[start..self.at].trim_end_matches([';', ')', ' ', '\t']);
            self.at = start + inside.len().max(opening.len_utf8());
            let span = self.span(start);
            let end = Span { start: span.end, ..span };
            self.diagnostics.push(Diagnostic::error(span, "this string is not closed on its line").fix(
                "close it with `\"`",
                end,
                "\"",
            ));
        }
        self.push(Kind::Text, start);
    }

    fn number(&mut self) {
        let start = self.at;
        let mut kind = Kind::Int;
        self.take_while(|c| c.is_ascii_digit());
        if self.peek() == Some('.') {
            kind = Kind::Double;
            self.at += 1;
            self.take_while(|c| c.is_ascii_digit());
        }
        if let Some(exponent) = exponent(self.rest()) {
            kind = Kind::Double;
            self.at += exponent;
        }
        let end = self.at;
        self.take_while(is_word);
        if self.at > end {
            let suffix = &self.text[end..self.at];
            let span = Span::new(self.file, end as u32, self.at as u32);
            let error = if matches!(suffix, "f" | "F" | "l" | "L" | "u" | "U" | "ul" | "UL") {
                Diagnostic::error(span, "numbers have no suffix in vv").fix("leave it out", span, "")
            } else {
                let whole = self.span(start);
                Diagnostic::error(whole, format!("`{}` is not a number", &self.text[start..self.at]))
                    .hint("numbers are decimal: `42`, `0.125`, `1.5e-3`")
            };
            self.diagnostics.push(error);
        }
        self.tokens.push(Token { kind, start: start as u32, end: end as u32, new_line: self.new_line });
        self.new_line = false;
    }

    fn sign(&mut self) {
        let start = self.at;
        let mut two = self.rest().chars();
        let (Some(first), second) = (two.next(), two.next()) else { return };
        let mut typed = String::from(plain(first));
        typed.extend(second.map(plain));
        if let Some(&(sign, kind)) = SIGNS.iter().find(|(sign, _)| typed.starts_with(sign)) {
            let characters = self.rest().chars().take(sign.len());
            self.at += characters.map(char::len_utf8).sum::<usize>();
            self.push(kind, start);
            return;
        }
        self.at += first.len_utf8();
        if let Some(&(_, meant, kind)) = LOOKALIKES.iter().find(|(c, ..)| *c == first) {
            let span = self.span(start);
            self.diagnostics.push(Diagnostic::error(span, format!("vv does not know the sign `{first}`")).fix(
                format!("write `{meant}`"),
                span,
                meant,
            ));
            self.push(kind, start);
            return;
        }
        self.take_while(|c| !c.is_ascii() && !is_space(c) && !is_word(c) && plain(c) == c && c != '‖');
        let span = self.span(start);
        let shown: String = self.text[start..self.at].chars().take(20).flat_map(char::escape_debug).collect();
        self.diagnostics.push(Diagnostic::error(span, format!("vv does not know the sign `{shown}`")));
        self.push(Kind::Unknown, start);
    }
}

/// Length of an exponent at the beginning of `text`, if there is one.
fn exponent(text: &str) -> Option<usize> {
    let digits = text.strip_prefix(['e', 'E'])?;
    let unsigned = digits.strip_prefix(['+', '-', '−', '–']).unwrap_or(digits);
    let count = unsigned.bytes().take_while(u8::is_ascii_digit).count();
    (count > 0).then(|| text.len() - unsigned.len() + count)
}
