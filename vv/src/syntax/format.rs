//! The one way to lay a program out.
//!
//! Lines stay as they were broken: where a statement ends and where it goes on is a matter of sense, and the language
//! knows lines, too. What is made the same everywhere is how far they are indented and where spaces stand.
//!
//! - A line that begins a statement stands two spaces deeper than the line that begins what the statement belongs to.
//! - A line that goes on stands under the first thing in the bracket that is open, or after the `=` (its operator, if it
//!   begins with one, before that), or four spaces deeper.
//! - `*`, `/`, `%`, `+` and `-` stand close or apart, as they were written, but the same on both sides.
//! - At most one empty line in a row. Comments at the ends of lines that stood below each other still do.
//! - Signs of the printed page become those of the keyboard; line numbers of a listing go.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::lexer::{Kind, Token};
use super::parser::{Parsed, Role, parse};
use super::tree::{Ast, Block, Item, Stmt, StmtKind};
use super::words;
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::FileId;

const INDENT: usize = 2;
const GOES_ON: usize = 4;

/// Lays a program out. The tokens stay what they are, line by line, and so do the comments: it means what it meant.
/// Formatting twice changes nothing more. Linear in the length of the text, times the depth of the deepest nesting.
///
/// # Errors
/// What is wrong with a text that cannot be read without doubt.
pub fn format(text: &str) -> Result<String, Vec<Diagnostic>> {
    let parsed = parse(FileId::MAIN, text);
    if parsed.diagnostics.iter().any(|d| d.severity == Severity::Error) {
        return Err(parsed.diagnostics);
    }
    let mut outline = Outline { tokens: &parsed.tokens, text, places: BTreeMap::new(), blocks: BTreeSet::new() };
    outline.ast(&parsed.ast);
    let mut layout = Layout::new(text, &parsed, &outline);
    layout.lines();
    Ok(layout.finish())
}

/// Where lines that begin with a certain token stand: deeper by so many steps than the line in which something begins.
struct Under {
    /// Where that begins; `None` for the margin.
    owner: Option<u32>,
    steps: usize,
}

/// What the tree says of the layout.
struct Outline<'t> {
    tokens: &'t [Token],
    text: &'t str,
    places: BTreeMap<u32, Under>,
    /// Braces around statements or properties; the others are lists.
    blocks: BTreeSet<u32>,
}

impl<'t> Outline<'t> {
    fn ast(&mut self, ast: &Ast) {
        for item in &ast.items {
            match item {
                Item::Include { span, .. } => self.item(span.start),
                Item::Constant(declaration) => self.item(declaration.span.start),
                Item::Param(param) => self.item(param.span.start),
                Item::Function(function) => {
                    self.item(function.span.start);
                    if let Some(body) = &function.body {
                        self.block(body, function.span.start);
                    }
                }
                Item::Phase { name, body } => {
                    self.item(name.span.start);
                    self.block(body, name.span.start);
                }
                Item::Properties { fields, span, .. } => {
                    self.item(span.start);
                    let inside = self.index(span.start)..self.index(span.end);
                    let of_kind = |kind| self.tokens[inside.clone()].iter().filter(move |t| t.kind == kind);
                    let (open, close) = (of_kind(Kind::OpenBrace).next(), of_kind(Kind::CloseBrace).next_back());
                    let (open, close) = (open.map(|t| t.start), close.map(|t| t.start));
                    self.braces(open, close, span.start);
                    for field in fields {
                        self.place(field.span.start, span.start, 1);
                    }
                }
            }
        }
    }

    /// The token that begins at or after a place.
    fn index(&self, at: u32) -> usize {
        self.tokens.partition_point(|t| t.start < at)
    }

    fn word(&self, index: usize) -> &'t str {
        let token = self.tokens[index];
        if token.kind == Kind::Word { &self.text[token.start as usize..token.end as usize] } else { "" }
    }

    /// An item begins with the words that stand before its type.
    fn item(&mut self, start: u32) {
        let mut first = self.index(start);
        while first > 0
            && (matches!(self.word(first - 1), "static" | "const" | "param" | "include")
                || self.tokens[first - 1].kind == Kind::Hash)
        {
            first -= 1;
        }
        self.places.insert(self.tokens[first].start, Under { owner: None, steps: 0 });
    }

    fn place(&mut self, at: u32, owner: u32, steps: usize) {
        self.places.insert(at, Under { owner: Some(owner), steps });
    }

    fn braces(&mut self, open: Option<u32>, close: Option<u32>, owner: u32) {
        for brace in [open, close].into_iter().flatten() {
            self.blocks.insert(brace);
            // A block that belongs to nothing begins itself, where it was put already.
            if brace != owner {
                self.place(brace, owner, 0);
            }
        }
    }

    fn block(&mut self, block: &Block, owner: u32) {
        if let Some(span) = block.span {
            self.braces(Some(span.start), span.end.checked_sub(1), owner);
        }
        for statement in &block.statements {
            self.place(statement.span.start, owner, 1);
            self.statement(statement);
        }
    }

    /// What a loop or a condition is about.
    fn body(&mut self, body: &Stmt, owner: u32) {
        match &body.kind {
            StmtKind::Block(block) => self.block(block, owner),
            _ => {
                self.place(body.span.start, owner, 1);
                self.statement(body);
            }
        }
    }

    fn statement(&mut self, statement: &Stmt) {
        let owner = statement.span.start;
        match &statement.kind {
            StmtKind::Block(block) => self.block(block, owner),
            StmtKind::If { then, otherwise, .. } => {
                self.body(then, owner);
                if let Some(otherwise) = otherwise {
                    self.word_before(otherwise.span.start, owner);
                    self.body(otherwise, owner);
                }
            }
            StmtKind::While { body, .. } | StmtKind::For { body, .. } => self.body(body, owner),
            StmtKind::Forall(forall) => self.body(&forall.body, owner),
            StmtKind::DoWhile { body, .. } => {
                self.body(body, owner);
                let after = self.index(body.span.end);
                self.place(self.tokens[after].start, owner, 0);
            }
            _ => {}
        }
    }

    /// `else`
    fn word_before(&mut self, at: u32, owner: u32) {
        if let Some(before) = self.index(at).checked_sub(1) {
            self.place(self.tokens[before].start, owner, 0);
        }
    }
}

/// A token, or a comment.
#[derive(Clone, Copy)]
enum Piece {
    Token(usize),
    Comment,
}

/// A line of the result.
struct Line {
    /// Where its first piece began.
    start: u32,
    indent: usize,
    /// With its indentation.
    text: String,
    /// A comment at its end: what it says, the column where it stood, and how far from the code.
    comment: Option<(String, usize, usize)>,
    /// An empty line comes before.
    apart: bool,
}

/// A bracket that is open.
struct Open {
    block: bool,
    /// Where what is inside begins, if it begins in this line.
    column: Option<usize>,
    /// Indentation of the line.
    indent: usize,
}

struct Layout<'t> {
    text: &'t str,
    tokens: &'t [Token],
    roles: &'t [Option<Role>],
    outline: &'t Outline<'t>,
    pieces: Vec<(Range<usize>, Piece)>,
    /// Whether a value ends with the token, so that `-` behind it takes away.
    ends_value: Vec<bool>,
    /// Whether the token is an opening or closing brace of a list.
    is_list: Vec<bool>,
    lines: Vec<Line>,
    open: Vec<Open>,
    /// Indentation of the line in which the last statement began.
    statement: usize,
    /// Where that goes on, if that is after a `=`.
    value: Option<usize>,
}

impl<'t> Layout<'t> {
    fn new(text: &'t str, parsed: &'t Parsed, outline: &'t Outline<'t>) -> Self {
        let tokens = &parsed.tokens;
        let range = |t: &Token| t.start as usize..t.end as usize;
        let words = tokens.iter().enumerate().filter(|(_, t)| t.kind != Kind::End);
        let mut pieces: Vec<_> = words.map(|(i, t)| (range(t), Piece::Token(i))).collect();
        // What else was skipped are line numbers.
        let skipped = parsed.skipped.iter().map(|s| s.start as usize..s.end as usize);
        pieces.extend(skipped.filter(|s| text[s.clone()].starts_with('/')).map(|s| (s, Piece::Comment)));
        pieces.sort_by_key(|(range, _)| range.start);
        let mut layout = Self {
            text,
            tokens,
            roles: &parsed.roles,
            outline,
            pieces,
            ends_value: Vec::with_capacity(tokens.len()),
            is_list: Vec::with_capacity(tokens.len()),
            lines: Vec::new(),
            open: Vec::new(),
            statement: 0,
            value: None,
        };
        layout.classify();
        layout
    }

    fn classify(&mut self) {
        let mut braces = Vec::new();
        for (i, token) in self.tokens.iter().enumerate() {
            let after_value = i > 0 && self.ends_value[i - 1];
            self.ends_value.push(match token.kind {
                Kind::Int | Kind::Double | Kind::Text | Kind::CloseParen | Kind::CloseBracket => true,
                Kind::PlusPlus | Kind::MinusMinus => after_value,
                Kind::Word => {
                    let word = self.word(i);
                    let is_value = matches!(word, "null" | "true" | "false");
                    self.roles[i] != Some(Role::Algebra) && (is_value || !words::is_reserved(word))
                }
                _ => false,
            });
            self.is_list.push(match token.kind {
                Kind::OpenBrace => {
                    braces.push(!self.outline.blocks.contains(&token.start));
                    braces.last() == Some(&true)
                }
                Kind::CloseBrace => braces.pop() == Some(true),
                _ => false,
            });
        }
    }

    fn word(&self, i: usize) -> &'t str {
        let token = self.tokens[i];
        if token.kind == Kind::Word { &self.text[token.start as usize..token.end as usize] } else { "" }
    }

    fn lines(&mut self) {
        let mut first = 0;
        let mut breaks = 0;
        while first < self.pieces.len() {
            let mut last = first + 1;
            let mut next = 0;
            while last < self.pieces.len() {
                next = line_breaks(&self.text[self.pieces[last - 1].0.end..self.pieces[last].0.start]);
                if next > 0 {
                    break;
                }
                last += 1;
            }
            self.line(first..last, breaks > 1);
            (first, breaks) = (last, next);
        }
    }

    fn line(&mut self, pieces: Range<usize>, apart: bool) {
        let start = self.pieces[pieces.start].0.start as u32;
        let indent = self.indent(pieces.start);
        let mut line = Line { start, indent, text: " ".repeat(indent), comment: None, apart };
        // What begins in this line is deeper than this line: known before its tokens are looked at.
        self.lines.push(line.shape());
        for at in pieces.clone() {
            let (range, piece) = self.pieces[at].clone();
            let written = &self.text[range.clone()];
            let gap = if at > pieces.start { self.gap(at) } else { 0 };
            match piece {
                Piece::Comment if written.starts_with("//") && at > pieces.start => {
                    let before = self.text[..self.pieces[at - 1].0.end].rsplit(['\n', '\r']).next().unwrap_or_default();
                    let column = before.chars().count() + range.start - self.pieces[at - 1].0.end;
                    let gap = (range.start - self.pieces[at - 1].0.end).max(1);
                    line.comment = Some((written.trim_end().to_owned(), column, gap));
                }
                Piece::Comment => {
                    line.text.extend(std::iter::repeat_n(' ', gap));
                    line.text.push_str(written.trim_end());
                }
                Piece::Token(i) => {
                    line.text.extend(std::iter::repeat_n(' ', gap));
                    line.text.push_str(sign(self.tokens[i].kind, written));
                    let followed = at + 1 < pieces.end && matches!(self.pieces[at + 1].1, Piece::Token(_));
                    if self.outline.places.contains_key(&self.tokens[i].start) {
                        (self.statement, self.value) = (indent, None);
                    }
                    self.hold(i, &line, followed);
                }
            }
        }
        self.lines.pop();
        self.lines.push(line);
    }

    fn is_operator(&self, i: usize) -> bool {
        use Kind::{
            And, Equal, Greater, GreaterEqual, Less, LessEqual, Minus, NotEqual, Or, Percent, Plus, Slash, Star,
        };
        match self.tokens[i].kind {
            Plus | Minus => !self.is_prefix(i),
            Star | Slash | Percent | And | Or | Equal | NotEqual | Less | LessEqual | Greater | GreaterEqual => true,
            _ => false,
        }
    }

    /// Keeps what further lines stand under.
    fn hold(&mut self, i: usize, line: &Line, followed: bool) {
        match self.tokens[i].kind {
            Kind::Assign if followed && self.open.last().is_none_or(|open| open.block) => {
                let written = line.text.rsplit('\n').next().unwrap_or_default();
                self.value = Some(written.chars().count() + 1);
            }
            Kind::OpenParen | Kind::OpenBracket | Kind::OpenBrace => {
                let block = self.tokens[i].kind == Kind::OpenBrace && !self.is_list[i];
                let written = line.text.rsplit('\n').next().unwrap_or_default();
                let column = followed.then(|| written.chars().count());
                self.open.push(Open { block, column, indent: line.indent });
            }
            Kind::CloseParen | Kind::CloseBracket | Kind::CloseBrace => {
                self.open.pop();
            }
            _ => {}
        }
    }

    /// How far a line is indented that begins with this piece.
    fn indent(&self, piece: usize) -> usize {
        let token =
            self.pieces[piece..].iter().find_map(|(_, p)| if let Piece::Token(i) = p { Some(*i) } else { None });
        let is_comment = matches!(self.pieces[piece].1, Piece::Comment);
        let Some(i) = token else { return 0 };
        let token = self.tokens[i];
        let closes = matches!(token.kind, Kind::CloseParen | Kind::CloseBracket | Kind::CloseBrace);
        if let Some(under) = self.outline.places.get(&token.start) {
            // A comment before a closing brace belongs inside.
            let steps = under.steps + usize::from(is_comment && token.kind == Kind::CloseBrace);
            return under.owner.map_or(0, |owner| self.indent_at(owner)) + INDENT * steps;
        }
        match self.open.last().filter(|open| !open.block) {
            Some(Open { column: Some(column), .. }) => *column,
            Some(Open { indent, .. }) if closes && !is_comment => *indent,
            Some(Open { indent, .. }) => indent + INDENT,
            None => match self.value {
                Some(column) if self.is_operator(i) => {
                    let written = &self.text[token.start as usize..token.end as usize];
                    column.saturating_sub(sign(token.kind, written).len() + 1)
                }
                Some(column) => column,
                None => self.statement + GOES_ON,
            },
        }
    }

    /// Indentation of the line in which something stands.
    fn indent_at(&self, at: u32) -> usize {
        let after = self.lines.partition_point(|line| line.start <= at);
        after.checked_sub(1).map_or(0, |i| self.lines[i].indent)
    }

    /// Spaces before a piece that is not the first of its line.
    fn gap(&self, at: usize) -> usize {
        let (before, here) = (&self.pieces[at - 1], &self.pieces[at]);
        let apart = usize::from(before.0.end < here.0.start);
        match (before.1, here.1) {
            (Piece::Token(a), Piece::Token(b)) => usize::from(self.spaced(a, b)),
            _ => apart,
        }
    }

    /// Whether a space stands between two neighbours in a line.
    fn spaced(&self, a: usize, b: usize) -> bool {
        use Kind::{
            Ampersand, Bar, CloseBrace, CloseBracket, CloseParen, Comma, Dollar, Dot, Hash, Int, Minus, MinusMinus,
            Old, OpenBrace, OpenBracket, OpenParen, Plus, PlusPlus, Semicolon, Word,
        };
        let (x, y) = (self.tokens[a].kind, self.tokens[b].kind);
        let prefix = |i| self.is_prefix(i);
        let written_apart = self.tokens[a].end < self.tokens[b].start;
        match (x, y) {
            // Or they would become another sign, or a number.
            (Minus | MinusMinus, Minus | MinusMinus) | (Plus | PlusPlus, Plus | PlusPlus) if prefix(b) => true,
            (Int, Dot) => written_apart,
            _ if matches!(x, OpenParen | OpenBracket | Dollar | Dot | Old | Hash | Bar) || prefix(a) => false,
            _ if matches!(y, CloseParen | CloseBracket | Dollar | Dot | Comma | Semicolon | Ampersand | Bar) => false,
            (PlusPlus | MinusMinus, _) if self.ends_value[a] && y == OpenParen => true,
            (_, PlusPlus | MinusMinus) => !self.ends_value[a],
            (OpenBrace, CloseBrace) => !self.is_list[b],
            (OpenBrace, _) => !self.is_list[a],
            (_, CloseBrace) => !self.is_list[b],
            // What a loop is about begins here: this is no call.
            (Word, OpenParen) if self.outline.places.contains_key(&self.tokens[b].start) => true,
            (Word, OpenParen) => {
                let word = self.word(a);
                let called = self.roles[a] != Some(Role::Algebra)
                    && (!words::is_reserved(word) || words::reserved_type(word).is_some());
                !called && (word != "print" || written_apart)
            }
            _ => !(self.close(a) || self.close(b)),
        }
    }

    fn is_prefix(&self, i: usize) -> bool {
        let may_be =
            matches!(self.tokens[i].kind, Kind::Minus | Kind::Plus | Kind::Not | Kind::PlusPlus | Kind::MinusMinus);
        may_be && (i == 0 || !self.ends_value[i - 1])
    }

    /// Whether an operator of arithmetic was written without spaces.
    fn close(&self, i: usize) -> bool {
        let computes =
            matches!(self.tokens[i].kind, Kind::Star | Kind::Slash | Kind::Percent | Kind::Plus | Kind::Minus);
        let touches =
            |a: usize, b: usize| self.tokens.get(a).zip(self.tokens.get(b)).is_some_and(|(a, b)| a.end == b.start);
        computes && i > 0 && !self.is_prefix(i) && touches(i - 1, i) && touches(i, i + 1)
    }

    /// Puts comments at the ends of lines below each other, and all together.
    fn finish(mut self) -> String {
        let mut first = 0;
        while first < self.lines.len() {
            let column = |line: &Line| line.comment.as_ref().map(|(_, column, _)| *column);
            let Some(here) = column(&self.lines[first]) else {
                first += 1;
                continue;
            };
            let rest = &self.lines[first + 1..];
            let more = rest.iter().take_while(|line| column(line) == Some(here) && !line.apart).count();
            let group = &mut self.lines[first..=first + more];
            let width = |line: &Line| line.text.rsplit('\n').next().unwrap_or_default().chars().count();
            let widest = group.iter().map(&width).max().unwrap_or(0);
            let gap = group.iter().filter_map(|line| Some(line.comment.as_ref()?.2)).min().unwrap_or(1);
            for line in group {
                if let Some((comment, ..)) = line.comment.take() {
                    let room = widest + gap - width(line);
                    line.text.extend(std::iter::repeat_n(' ', room));
                    line.text.push_str(&comment);
                }
            }
            first += more + 1;
        }
        let mut text = String::with_capacity(self.text.len());
        for line in &self.lines {
            if line.apart {
                text.push('\n');
            }
            text.push_str(&line.text);
            text.push('\n');
        }
        text
    }
}

impl Line {
    /// The line without what is in it.
    fn shape(&self) -> Self {
        Self { start: self.start, indent: self.indent, text: String::new(), comment: None, apart: self.apart }
    }
}

/// How many lines end in white space.
fn line_breaks(space: &str) -> usize {
    let carriage_returns = space.matches('\r').count() - space.matches("\r\n").count();
    space.matches('\n').count() + carriage_returns
}

/// The keyboard's sign for one of the printed page.
fn sign(kind: Kind, written: &str) -> &str {
    match kind {
        Kind::Old => "`",
        _ if written.is_ascii() => written,
        Kind::Minus => "-",
        Kind::MinusMinus => "--",
        Kind::SubtractAssign => "-=",
        Kind::Star => "*",
        Kind::MultiplyAssign => "*=",
        Kind::Bar => "|",
        Kind::Or => "||",
        Kind::Arrow => "->",
        _ => written,
    }
}
