//! Expressions: operators by precedence, and the queries of the algebra.

use super::super::lexer::Kind;
use super::super::tree::{BinaryOp, Expr, ExprKind, Name, Step, StepPosition, TypeKind, UnaryOp};
use super::super::words;
use super::{Parser, Role, Tall, grow};
use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// Operators between operands, the loosest first; all of them group from the left.
#[rustfmt::skip]
const BINARY: &[(Kind, BinaryOp, u8)] = &[
    (Kind::Or,           BinaryOp::Or,           1),
    (Kind::And,          BinaryOp::And,          2),
    (Kind::Equal,        BinaryOp::Equal,        3),
    (Kind::NotEqual,     BinaryOp::NotEqual,     3),
    (Kind::Less,         BinaryOp::Less,         4),
    (Kind::LessEqual,    BinaryOp::LessEqual,    4),
    (Kind::Greater,      BinaryOp::Greater,      4),
    (Kind::GreaterEqual, BinaryOp::GreaterEqual, 4),
    (Kind::Plus,         BinaryOp::Add,          5),
    (Kind::Minus,        BinaryOp::Subtract,     5),
    (Kind::Star,         BinaryOp::Multiply,     6),
    (Kind::Slash,        BinaryOp::Divide,       6),
    (Kind::Percent,      BinaryOp::Remainder,    6),
];

/// Precedence of `<` and its like.
const COMPARISON: u8 = 4;

/// Operators that store, each with the operator it applies first.
#[rustfmt::skip]
const ASSIGNMENT: &[(Kind, Option<BinaryOp>)] = &[
    (Kind::Assign,          None),
    (Kind::AddAssign,       Some(BinaryOp::Add)),
    (Kind::SubtractAssign,  Some(BinaryOp::Subtract)),
    (Kind::MultiplyAssign,  Some(BinaryOp::Multiply)),
    (Kind::DivideAssign,    Some(BinaryOp::Divide)),
    (Kind::RemainderAssign, Some(BinaryOp::Remainder)),
];

impl Parser<'_> {
    /// Any expression, assignments among them.
    pub(super) fn expression(&mut self) -> Expr {
        self.assignment().expr
    }

    /// An operand of the algebra: what stands behind `in`, `after`, `with`, ….
    pub(super) fn operand(&mut self) -> Expr {
        self.unary().expr
    }

    /// An expression that is no assignment, as where `in` or `,` follows.
    pub(super) fn value(&mut self) -> Expr {
        self.conditional().expr
    }

    /// Expressions with commas between, up to `close`, which is left.
    pub(super) fn list(&mut self, close: Kind) -> (Vec<Expr>, u32) {
        let mut list = Vec::new();
        let mut height = 0;
        if self.kind() == close {
            return (list, height);
        }
        loop {
            let item = self.assignment();
            height = height.max(item.height);
            list.push(item.expr);
            if !self.eat(Kind::Comma) {
                return (list, height);
            }
        }
    }

    fn assignment(&mut self) -> Tall {
        if self.panicking || !self.enter() {
            return self.error_expression();
        }
        let result = grow(|| self.assignment_inside());
        self.leave();
        result
    }

    fn assignment_inside(&mut self) -> Tall {
        let left = self.conditional();
        let operator = ASSIGNMENT.iter().find(|(kind, _)| *kind == self.kind());
        let Some(&(_, op)) = operator.filter(|_| !self.panicking) else { return left };
        self.bump();
        let value = self.assignment();
        let span = left.expr.span.to(value.expr.span);
        let height = left.height.max(value.height);
        self.tall(ExprKind::Assign { op, target: Box::new(left.expr), value: Box::new(value.expr) }, span, height)
    }

    fn conditional(&mut self) -> Tall {
        let condition = self.binary(0);
        if !self.eat(Kind::Question) {
            return condition;
        }
        let then = self.assignment();
        if !self.eat(Kind::Colon) && !self.panicking {
            self.unexpected("`:` of the `? :`");
        }
        let otherwise = self.assignment();
        let span = condition.expr.span.to(otherwise.expr.span);
        let height = condition.height.max(then.height).max(otherwise.height);
        let (condition, then, otherwise) = (Box::new(condition.expr), Box::new(then.expr), Box::new(otherwise.expr));
        self.tall(ExprKind::Conditional { condition, then, otherwise }, span, height)
    }

    /// Operators that bind tighter than `loosest`.
    fn binary(&mut self, loosest: u8) -> Tall {
        let mut left = self.unary();
        let mut compared = false;
        while !self.panicking {
            let Some((op, precedence)) = self.binary_operator().filter(|&(_, precedence)| precedence > loosest) else {
                break;
            };
            let sign = self.here();
            if compared && precedence == COMPARISON {
                self.mend(Diagnostic::error(sign, "comparisons cannot be chained").hint("write `a < b && b < c`"));
            }
            compared = precedence == COMPARISON;
            self.bump();
            let right = self.binary(precedence);
            let span = left.expr.span.to(right.expr.span);
            let height = left.height.max(right.height);
            left = self.tall(
                ExprKind::Binary { op, left: Box::new(left.expr), right: Box::new(right.expr) },
                span,
                height,
            );
        }
        left
    }

    /// The operator that stands here. `and` and `or` are understood.
    fn binary_operator(&mut self) -> Option<(BinaryOp, u8)> {
        let spelled = match self.word() {
            "and" => Some(("&&", BinaryOp::And, 2)),
            "or" => Some(("||", BinaryOp::Or, 1)),
            _ => None,
        };
        if let Some((sign, op, precedence)) = spelled.filter(|_| self.operand_at(self.at + 1)) {
            let here = self.here();
            // An outer level may look at the same word again.
            if self.diagnostics.last().is_none_or(|d| d.span != Some(here)) {
                let message = format!("expected an operator, found `{}`", self.word());
                self.mend(Diagnostic::error(here, message).fix(format!("write `{sign}`"), here, sign));
            }
            return Some((op, precedence));
        }
        let kind = self.kind();
        BINARY.iter().find(|(k, ..)| *k == kind).map(|&(_, op, precedence)| (op, precedence))
    }

    pub(super) fn unary(&mut self) -> Tall {
        self.unary_before(false)
    }

    /// `before_body`: the body of a `forall` follows without braces, so `(` and `++` may belong to it.
    pub(super) fn unary_before(&mut self, before_body: bool) -> Tall {
        if self.panicking {
            return self.error_expression();
        }
        let start = self.at;
        match self.kind() {
            Kind::Minus => self.prefix(start, |operand| ExprKind::Unary { op: UnaryOp::Minus, operand }),
            Kind::Plus => self.prefix(start, |operand| ExprKind::Unary { op: UnaryOp::Plus, operand }),
            Kind::Not => self.prefix(start, |operand| ExprKind::Unary { op: UnaryOp::Not, operand }),
            Kind::PlusPlus => {
                self.prefix(start, |target| ExprKind::Step { target, by: Step::Up, position: StepPosition::Before })
            }
            Kind::MinusMinus => {
                self.prefix(start, |target| ExprKind::Step { target, by: Step::Down, position: StepPosition::Before })
            }
            Kind::Word => self.query(before_body),
            _ => {
                let primary = self.primary();
                self.postfix(primary, before_body)
            }
        }
    }

    fn prefix(&mut self, start: usize, build: impl FnOnce(Box<Expr>) -> ExprKind) -> Tall {
        if !self.enter() {
            return self.error_expression();
        }
        self.bump();
        let operand = self.unary();
        self.leave();
        let span = self.span_at(start).to(operand.expr.span);
        self.tall(build(Box::new(operand.expr)), span, operand.height)
    }

    /// The set or ring of a `forall`.
    pub(super) fn over(&mut self) -> Expr {
        self.unary_before(true).expr
    }

    pub(super) fn primary(&mut self) -> Tall {
        if self.panicking {
            return self.error_expression();
        }
        let span = self.here();
        match self.kind() {
            Kind::Int | Kind::Double => self.number(),
            Kind::Text => {
                let text = unescape(self.text_at(self.at));
                self.bump();
                let text = match text {
                    Ok(text) => text,
                    Err(unknown) => {
                        let message = format!("unknown escape `\\{}` in a string", unknown.escape_debug());
                        self.mend(Diagnostic::error(span, message).hint("known are `\\n`, `\\t`, `\\\"` and `\\\\`"));
                        String::new()
                    }
                };
                self.tall(ExprKind::Text(text), span, 0)
            }
            Kind::Old => self.old(),
            Kind::OpenParen => self.parentheses(),
            Kind::Word => self.name_or_call(),
            _ => {
                self.unexpected("a value");
                self.error_expression()
            }
        }
    }

    fn number(&mut self) -> Tall {
        let span = self.here();
        let is_int = self.kind() == Kind::Int;
        let text = self.text_at(self.at).replace(['−', '–'], "-");
        self.bump();
        let kind = if is_int {
            ExprKind::Int(text.parse().unwrap_or_else(|_| {
                let message = format!("this number is too large for `int`, which ends at {}", i64::MAX);
                self.mend(Diagnostic::error(span, message).fix("write a `double`", span, format!("{text}.0")));
                0
            }))
        } else {
            let value: f64 = text.parse().unwrap_or(f64::INFINITY);
            if value.is_infinite() {
                self.mend(Diagnostic::error(span, "this number is too large for `double`"));
            }
            ExprKind::Double(if value.is_infinite() { 0.0 } else { value })
        };
        self.tall(kind, span, 0)
    }

    /// `` `v ``, `` `(…) ``
    fn old(&mut self) -> Tall {
        let start = self.at;
        self.bump();
        let of = match self.kind() {
            Kind::OpenParen => self.parentheses(),
            Kind::Word if !words::is_reserved(self.word()) => {
                let span = self.here();
                let name = self.word().to_owned();
                self.bump();
                self.tall(ExprKind::Name(name), span, 0)
            }
            _ => {
                let diagnostic = Diagnostic::error(
                    self.here(),
                    format!("expected a name or `(` after the old-value mark, found {}", self.found()),
                );
                self.fail(diagnostic.hint("write `` `v$pos `` or `` `(nextto q in `p)$pos ``"));
                self.error_expression()
            }
        };
        if self.kind() == Kind::Old && !self.panicking && self.token(self.at).start == self.previous().end {
            let quoted = self.since(start).to(self.here());
            let text = self.source(self.previous()).to_owned();
            let message = "vv has no character literals; this sign marks old values";
            self.fail(Diagnostic::error(quoted, message).fix("write a string", quoted, format!("\"{text}\"")));
            self.bump();
            return self.error_expression();
        }
        let span = self.span_at(start).to(of.expr.span);
        self.tall(ExprKind::Old(Box::new(of.expr)), span, of.height)
    }

    /// `(inner)`, `(p|q)`, and the casts of C, which are understood.
    fn parentheses(&mut self) -> Tall {
        let open = self.at;
        self.bump();
        if words::reserved_type(self.word()).is_some() && self.kind_at(self.at + 1) == Kind::CloseParen {
            return self.cast(open);
        }
        let inner = self.assignment();
        let comma = self.kind() == Kind::Comma && !self.panicking;
        let behind = if comma { self.behind_parentheses(open) } else { None };
        let edge = behind.is_some_and(|behind| self.kind_at(behind) == Kind::Dollar);
        if comma && !edge {
            return self.coordinates(open, inner);
        }
        if edge {
            let here = self.here();
            self.mend(Diagnostic::error(here, "expected `|`, found `,`").fix("an edge is written `(p|q)`", here, "|"));
            self.bump();
        }
        let second = (edge || self.eat(Kind::Bar)).then(|| self.assignment());
        let closed = self.close(Kind::CloseParen, open);
        let span = self.since(open);
        match second {
            _ if !closed => self.tall(ExprKind::Error, span, 0),
            Some(second) => {
                let height = inner.height.max(second.height);
                self.tall(ExprKind::Edge(Box::new(inner.expr), Box::new(second.expr)), span, height)
            }
            None => self.tall(ExprKind::Paren(Box::new(inner.expr)), span, inner.height),
        }
    }

    /// `(x, y, z)`, meant as `vec(x, y, z)`.
    fn coordinates(&mut self, open: usize, first: Tall) -> Tall {
        let here = self.here();
        let opening = self.span_at(open);
        let error = Diagnostic::error(here, "expected `)`, found `,`").label(opening, "to close this");
        let before = Span { end: opening.start, ..opening };
        self.mend(error.fix("a vector is written `vec(x, y, z)`", before, "vec"));
        self.bump();
        let (rest, height) = self.list(Kind::CloseParen);
        let closed = self.close_list(Kind::CloseParen, open, true);
        let span = self.since(open);
        let arguments: Vec<Expr> = [first.expr].into_iter().chain(rest).collect();
        let kind = if closed { Self::call(TypeKind::Vec, opening, arguments) } else { ExprKind::Error };
        self.tall(kind, span, height.max(first.height))
    }

    /// `(double)n`, meant as `double(n)`.
    fn cast(&mut self, open: usize) -> Tall {
        let to = self.word();
        let callee = Name { text: to.to_owned(), span: self.here() };
        self.bump_as(Role::Type);
        self.bump();
        let operand = self.unary();
        let span = self.span_at(open).to(operand.expr.span);
        let text = self.source(operand.expr.span);
        let text = text.strip_prefix('(').and_then(|t| t.strip_suffix(')')).unwrap_or(text);
        let mended = format!("{to}({text})");
        self.mend(Diagnostic::error(span, "vv converts as a call does, not by a cast").fix(
            format!("write `{}`", super::shorten(&mended)),
            span,
            mended,
        ));
        let height = operand.height;
        self.tall(ExprKind::Call { callee, arguments: vec![operand.expr] }, span, height)
    }

    fn name_or_call(&mut self) -> Tall {
        let start = self.at;
        let span = self.here();
        let word = self.word();
        match word {
            "true" | "false" => {
                self.bump();
                return self.tall(ExprKind::Bool(word == "true"), span, 0);
            }
            "null" => {
                self.bump();
                return self.tall(ExprKind::Null, span, 0);
            }
            "nullptr" | "NULL" => {
                self.mend(Diagnostic::error(span, format!("`{word}` is `null` in vv")).fix(
                    "write `null`",
                    span,
                    "null",
                ));
                self.bump();
                return self.tall(ExprKind::Null, span, 0);
            }
            "not" if self.operand_at(start + 1) => {
                self.mend(Diagnostic::error(span, "unknown word `not`").fix("write `!`", span, "!"));
                return self.prefix(start, |operand| ExprKind::Unary { op: UnaryOp::Not, operand });
            }
            _ => {}
        }
        if self.kind_at(start + 1) == Kind::DoubleColon {
            let qualifier = span.to(self.span_at(start + 1));
            let message = "vv has no namespaces: its functions are there without a prefix";
            self.mend(Diagnostic::error(qualifier, message).fix("leave it out", qualifier, ""));
            self.bump();
            self.bump();
            return if self.kind() == Kind::Word && self.kind_at(self.at + 1) != Kind::DoubleColon {
                self.name_or_call()
            } else {
                self.unexpected("a name");
                self.error_expression()
            };
        }
        let is_call = self.kind_at(start + 1) == Kind::OpenParen;
        let converts = is_call && words::reserved_type(word).is_some();
        let next = self.kind_at(start + 1);
        if word == "new" && next == Kind::Word && !self.token(start + 1).new_line {
            let (message, hint) = words::foreign_construct(word).unwrap_or_default();
            self.fail(Diagnostic::error(span, message).hint(hint));
            return self.error_expression();
        }
        if matches!(word, "static_cast" | "dynamic_cast" | "reinterpret_cast") && next == Kind::Less {
            let error = Diagnostic::error(span, "vv converts as a call does, not by a cast");
            self.fail(error.hint("write `int(x)` or `double(n)`"));
            return self.error_expression();
        }
        if words::is_reserved(word) && !converts {
            self.unexpected("a value");
            return self.error_expression();
        }
        let follows = self.operand_at(start + 1) && !words::is_infix(self.word_at(start + 1));
        if words::is_infix(word) && follows && !is_call {
            let message = format!("expected a value before `{word}`");
            self.fail(Diagnostic::error(span, message));
            return self.error_expression();
        }
        if converts || (is_call && words::any_type(word).is_some()) {
            self.bump_as(Role::Type);
        } else {
            self.bump();
        }
        self.tall(ExprKind::Name(word.to_owned()), span, 0)
    }

    /// What may follow an operand: calls, `$name`, `.name`, `++`, `--`.
    pub(super) fn postfix(&mut self, mut of: Tall, before_body: bool) -> Tall {
        let begin = of.expr.span;
        while !self.panicking {
            let here = self.here();
            let start = self.at;
            match self.kind() {
                Kind::OpenParen => {
                    let ExprKind::Name(callee) = &of.expr.kind else { return of };
                    if before_body && self.edge_at(start) {
                        return of;
                    }
                    let callee = Name { text: callee.clone(), span: of.expr.span };
                    self.bump();
                    let (arguments, height) = self.list(Kind::CloseParen);
                    let closed = self.close_list(Kind::CloseParen, start, true);
                    let span = begin.to(self.previous());
                    // Of a broken list nobody shall count the arguments.
                    let call = if closed { ExprKind::Call { callee, arguments } } else { ExprKind::Error };
                    of = self.tall(call, span, height);
                }
                Kind::Dollar | Kind::Dot => {
                    let dollar = self.kind() == Kind::Dollar;
                    self.bump();
                    let name = Name { text: self.word().to_owned(), span: self.here() };
                    if name.text.is_empty() {
                        self.unexpected(if dollar { "the name of a property after `$`" } else { "`x`, `y` or `z`" });
                        return of;
                    }
                    self.bump();
                    if !dollar && self.kind() == Kind::OpenParen {
                        let owner = self.source(of.expr.span);
                        let end =
                            self.behind_parentheses(self.at).map_or(self.here(), |behind| self.span_at(behind - 1));
                        let inside = Span { start: self.here().end, end: end.start.max(self.here().end), ..begin };
                        let arguments = self.source(inside).trim();
                        let own = matches!(owner, "Math" | "math" | "std");
                        let all = [owner, arguments].into_iter().skip(usize::from(own)).filter(|text| !text.is_empty());
                        let all = all.collect::<Vec<_>>().join(", ");
                        let error = Diagnostic::error(name.span, "vv has no functions that belong to values");
                        self.fail(error.hint(match name.text.as_str() {
                            "add" | "push" | "push_back" | "append" | "insert" => format!("write `add v to {owner};`"),
                            "length" | "norm" | "magnitude" if owner.contains('$') => format!("write `length({owner})`"),
                            "normalized" | "normalized_copy" => format!("write `normalize({owner})`"),
                            "size" | "length" | "count" => format!(
                                "`valence {owner}` counts the vertices of a ring, `forall v in {owner} n += 1;` those of a mesh"
                            ),
                            other => format!("if there is such a function, write `{other}({all})`"),
                        }));
                        return self.error_expression();
                    }
                    let (span, height) = (begin.to(name.span), of.height);
                    let of_box = Box::new(of.expr);
                    let kind = if dollar {
                        ExprKind::Property { of: of_box, name }
                    } else {
                        ExprKind::Field { of: of_box, name }
                    };
                    of = self.tall(kind, span, height);
                }
                Kind::Arrow if self.kind_at(start + 1) == Kind::Word => {
                    let message = "vv has no pointers, so no `->`";
                    self.mend(Diagnostic::error(here, message).fix("properties are written `v$name`", here, "$"));
                    self.bump();
                    let name = Name { text: self.word().to_owned(), span: self.here() };
                    self.bump();
                    let (span, height) = (begin.to(name.span), of.height);
                    of = self.tall(ExprKind::Property { of: Box::new(of.expr), name }, span, height);
                }
                Kind::PlusPlus | Kind::MinusMinus if !before_body && !self.token(start).new_line => {
                    let by = if self.kind() == Kind::PlusPlus { Step::Up } else { Step::Down };
                    self.bump();
                    let (span, height) = (begin.to(here), of.height);
                    let target = Box::new(of.expr);
                    of = self.tall(ExprKind::Step { target, by, position: StepPosition::After }, span, height);
                }
                Kind::OpenBracket => {
                    self.unexpected("an operator");
                    return of;
                }
                _ => return of,
            }
        }
        of
    }

    /// Whether `(p|q)` begins at a token.
    pub(super) fn edge_at(&self, open: usize) -> bool {
        let end = self.behind_parentheses(open).unwrap_or(open);
        let mut depth = 0;
        (open..end).any(|at| {
            match self.kind_at(at) {
                Kind::OpenParen => depth += 1,
                Kind::CloseParen => depth -= 1,
                _ => {}
            }
            depth == 1 && self.kind_at(at) == Kind::Bar
        })
    }
}

/// The text of a literal without its quotes, escapes resolved; the character of an unknown escape otherwise.
fn unescape(literal: &str) -> Result<String, char> {
    let quote = |c: char| matches!(c, '"' | '“' | '”');
    let inner = literal.strip_prefix(quote).unwrap_or(literal);
    let mut text = String::with_capacity(inner.len());
    let mut characters = inner.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '\\' => match characters.next() {
                Some('n') => text.push('\n'),
                Some('t') => text.push('\t'),
                Some('r') => text.push('\r'),
                Some('0') => text.push('\0'),
                Some(c @ ('\\' | '\'')) => text.push(c),
                Some(c) if quote(c) => text.push(c),
                Some(c) => return Err(c),
                None => {}
            },
            // Only the closing quote is left bare.
            c if quote(c) && characters.peek().is_none() => {}
            c => text.push(c),
        }
    }
    Ok(text)
}
