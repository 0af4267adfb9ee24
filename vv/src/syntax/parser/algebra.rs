//! The algebra: its statements and queries.

use super::super::lexer::Kind;
use super::super::tree::{Expr, ExprKind, Side, StmtKind};
use super::super::words;
use super::{Parser, Role, Tall};
use crate::diagnostic::Diagnostic;
use crate::source::Span;

impl Parser<'_> {
    /// Whether the statement is one of the algebra: its word is one, and an operand follows.
    pub(super) fn algebra(&mut self, word: &str) -> Option<StmtKind> {
        if self.panicking {
            return None;
        }
        let start = self.at;
        let word = words::STATEMENTS.iter().copied().find(|w| *w == word)?;
        let next = self.kind_at(start + 1);
        let applies = match word {
            "forall" => self.operand_at(start + 1) || next == Kind::Word,
            words::PARALLEL => {
                matches!(self.word_at(start + 1), "forall" | "for" | "foreach") || self.word_at(start + 2) == "in"
            }
            "make" => next == Kind::OpenBrace || self.operand_at(start + 1) && next != Kind::OpenParen,
            "print" => {
                self.operand_at(start + 1) || matches!(next, Kind::Minus | Kind::Not | Kind::Plus | Kind::Semicolon)
            }
            "synchronize" | "synchronise" => self.operand_at(start + 1),
            // `add(p, q)` may be a call of a function of that name.
            _ if next == Kind::OpenParen => {
                self.behind_parentheses(start + 1).is_some_and(|mut behind| {
                    while self.kind_at(behind) == Kind::Dollar {
                        behind += 2; // `add (any in v)$mate to S`
                    }
                    self.kind_at(behind) == Kind::Word
                })
            }
            _ => self.operand_at(start + 1),
        };
        if !applies {
            return None;
        }
        match word {
            "forall" => return Some(self.forall(None, false)),
            words::PARALLEL => return Some(self.parallel()),
            _ => {}
        }
        self.bump_as(Role::Algebra);
        let kind = match word {
            "make" => self.make(),
            "print" => self.print(start),
            "synchronize" | "synchronise" => StmtKind::Synchronize(self.operand()),
            "erase" => {
                let (item, from) = self.pair("from", "`erase x from v`");
                StmtKind::Erase { item, from }
            }
            "add" => {
                let (vertex, set) = self.pair("to", "`add v to S`");
                StmtKind::Add { vertex, set }
            }
            "remove" => {
                let (vertex, set) = self.pair("from", "`remove v from S`");
                StmtKind::Remove { vertex, set }
            }
            "merge" => {
                let (set, other) = self.pair("with", "`merge S with T`");
                StmtKind::Merge { set, other }
            }
            "replace" => {
                let mut item = self.unary();
                let mut with = self.second(&mut item, "with", "`replace a with x in v`");
                let ring = self.second(&mut with, "in", "`replace a with x in v`");
                StmtKind::Replace { item: item.expr, with: with.expr, ring: ring.expr }
            }
            _ => {
                let form = "`splice x after a in v`";
                let mut item = self.unary();
                let side = if self.word() == "before" { Side::Before } else { Side::After };
                let word = if side == Side::Before { "before" } else { "after" };
                let mut anchor = self.second(&mut item, word, form);
                let ring = self.second(&mut anchor, "in", form);
                StmtKind::Splice { item: item.expr, side, anchor: anchor.expr, ring: ring.expr }
            }
        };
        self.end_statement();
        Some(kind)
    }

    fn pair(&mut self, word: &'static str, form: &str) -> (Expr, Expr) {
        let mut first = self.unary();
        if !self.panicking && self.kind() == Kind::Comma {
            let error = Diagnostic::error(self.here(), format!("expected `{word}`, found `,`"));
            self.fail(error.hint(format!("one at a time: {form}")));
        }
        let second = self.second(&mut first, word, form);
        (first.expr, second.expr)
    }

    /// After the head of a loop or branch went wrong: goes on with the body if that can be found.
    pub(super) fn recover_header(&mut self) {
        while self.panicking && !self.statement_is_over() {
            self.bump();
        }
        if self.kind() == Kind::OpenBrace {
            self.panicking = false;
        }
    }

    /// `{a, b, c} nb_of v`
    fn make(&mut self) -> StmtKind {
        let open = self.at;
        let mut items = Vec::new();
        if self.eat(Kind::OpenBrace) {
            items = self.list(Kind::CloseBrace).0;
            if !self.panicking && self.at_infix("nb_of") {
                let (opening, end) = (self.span_at(open), self.after_previous());
                self.mend(
                    Diagnostic::error(self.previous(), "expected `}` after this")
                        .label(opening, "the list begins here")
                        .fix("write `}`", end, "}"),
                );
            } else if !self.eat(Kind::CloseBrace) {
                if !self.panicking {
                    let opening = self.span_at(open);
                    let error = Diagnostic::error(
                        self.here(),
                        format!("expected `,` or `}}` in the list of `make`, found {}", self.found()),
                    );
                    let error = self.guess(error.label(opening, "the list begins here"));
                    self.fail(error);
                }
                while !matches!(self.kind(), Kind::CloseBrace | Kind::OpenBrace | Kind::Semicolon | Kind::End) {
                    self.bump();
                }
                if self.kind() == Kind::CloseBrace && matches!(self.word_at(self.at + 1), "nb" | "nb_of") {
                    self.panicking = false;
                    self.bump();
                }
            }
        } else if self.kind() == Kind::Word && matches!(self.word_at(open + 1), "nb" | "nb_of" | "of" | "to" | "in") {
            let mut ring = self.unary();
            if self.say_list_comes_first() {
                return StmtKind::Empty;
            }
            let of = self.second(&mut ring, "nb_of", "`make r nb_of v`").expr;
            return StmtKind::MakeRing { ring: ring.expr, of };
        } else {
            let message = format!("expected `{{` after `make`, found {}", self.found());
            self.fail(Diagnostic::error(self.here(), message).hint("write `make {a, b, c} nb_of v`"));
        }
        self.say_list_comes_first();
        let list = Expr { kind: ExprKind::Error, span: self.since(open) };
        let of = self.second(&mut Tall { expr: list, height: 1 }, "nb_of", "`make {a, b, c} nb_of v`").expr;
        StmtKind::Make { items, of }
    }

    /// `make v nb_of {a, b}` the wrong way round, or with two lists.
    fn say_list_comes_first(&mut self) -> bool {
        let behind = self.at + if self.word() == "nb" { 2 } else { 1 };
        let is_list = !self.panicking && self.at_infix("nb_of") && self.kind_at(behind) == Kind::OpenBrace;
        if is_list {
            let error = Diagnostic::error(self.span_at(behind), "one vertex stands here, and the list before it");
            self.fail(error.hint("write `make {a, b, c} nb_of v`"));
        }
        is_list
    }

    /// `print a, "b";` and `print(a, "b");`
    fn print(&mut self, start: usize) -> StmtKind {
        if self.kind() == Kind::Semicolon {
            return StmtKind::Print(Vec::new());
        }
        let open = start + 1;
        let behind = self.behind_parentheses(open).filter(|_| self.kind() == Kind::OpenParen && !self.edge_at(open));
        let is_call = behind.is_some_and(|behind| match self.kind_at(behind) {
            Kind::Semicolon | Kind::CloseBrace | Kind::End => true,
            _ => self.token(behind).new_line && self.kind_at(behind) == Kind::Word,
        });
        if is_call {
            self.bump();
            let items = self.list(Kind::CloseParen).0;
            self.close_list(Kind::CloseParen, open, true);
            return StmtKind::Print(items);
        }
        StmtKind::Print(self.list(Kind::Semicolon).0)
    }

    /// The second operand of a word of the algebra such as `nextto left word operand`. Mends `Swith`, `withT`, and a
    /// word that is nearly the right one.
    pub(super) fn second(&mut self, left: &mut Tall, word: &'static str, form: &str) -> Tall {
        if self.panicking {
            return self.error_expression();
        }
        if self.at_infix(word) {
            self.take_infix();
            return self.unary();
        }
        // `is any in S`, where `any` is a variable after all.
        if word == "in"
            && let ExprKind::Any { ring } = &mut left.expr.kind
        {
            let ring = std::mem::replace(&mut **ring, Expr { kind: ExprKind::Error, span: left.expr.span });
            let span = Span { end: left.expr.span.start + 3, ..left.expr.span };
            left.expr = Expr { kind: ExprKind::Name("any".to_owned()), span };
            return Tall { expr: ring, height: left.height };
        }
        let here = self.here();
        if let ExprKind::Name(name) = &mut left.expr.kind
            && let Some(rest) = name.strip_suffix(word).filter(|rest| !rest.is_empty())
            && self.operand_at(self.at)
        {
            let rest = rest.to_owned();
            let glued = left.expr.span;
            self.mend(Diagnostic::error(glued, format!("expected `{word}`: a space is missing in `{name}`")).fix(
                format!("write `{rest} {word}`"),
                glued,
                format!("{rest} {word}"),
            ));
            left.expr.span.end -= word.len() as u32;
            *name = rest;
            return self.unary();
        }
        let found = self.word();
        if let Some(rest) = found.strip_prefix(word).filter(|rest| !rest.is_empty()) {
            self.mend(Diagnostic::error(here, format!("expected `{word}`: a space is missing in `{found}`")).fix(
                format!("write `{word} {rest}`"),
                here,
                format!("{word} {rest}"),
            ));
            self.bump();
            let name = Span { start: here.start + word.len() as u32, ..here };
            let name = self.tall(ExprKind::Name(rest.to_owned()), name, 0);
            return self.postfix(name, false);
        }
        // In `splice x in v` the `in` is right and something before it is missing.
        let nearly = (words::is_infix(found) && (found != "in" || matches!(word, "to" | "from")))
            || matches!(found, "and" | "by" | "of" | "into" | "on" | "at" | "nbof")
            || words::similar(found, [word]).is_some();
        let behind = self.at + 1;
        if nearly && self.operand_at(behind) && !self.token(behind).new_line {
            self.mend(Diagnostic::error(here, format!("expected `{word}`, found `{found}`")).fix(
                format!("write {form}"),
                here,
                word,
            ));
            self.bump();
            return self.unary();
        }
        if self.kind() == Kind::Word {
            let known = words::PREFIXES.iter().chain(words::STATEMENTS).copied();
            let earlier = self.word_at(self.at.saturating_sub(1));
            if words::similar(earlier, known).is_some() {
                self.unexpected(&format!("`{word}`"));
                return self.error_expression();
            }
        }
        let message = format!("expected `{word}`, found {}", self.found());
        self.fail(Diagnostic::error(here, message).hint(format!("write {form}")));
        self.error_expression()
    }

    /// Whether a word between operands stands here; `nb of` is `nb_of`.
    fn at_infix(&self, word: &str) -> bool {
        self.word() == word || (word == "nb_of" && self.word() == "nb" && self.word_at(self.at + 1) == "of")
    }

    fn take_infix(&mut self) {
        let two = self.word() == "nb";
        self.bump_as(Role::Algebra);
        if two {
            self.bump_as(Role::Algebra);
        }
    }

    /// The queries of the algebra, and what else begins with a word.
    pub(super) fn query(&mut self, before_body: bool) -> Tall {
        let start = self.at;
        let mut word = self.word();
        let behind = start + 1;
        let beside = self.kind_at(behind) == Kind::Word && !self.token(behind).new_line;
        if word == words::FACES && !before_body && beside && self.begins_operation(start) {
            let set = self.word_at(behind);
            let error = Diagnostic::error(self.here(), "faces are walked, and are no value");
            self.fail(error.hint(format!("write `forall f in faces {set} {{ … }}`")));
            return self.error_expression();
        }
        if !words::PREFIXES.contains(&word) && self.begins_operation(start) && !self.token(start + 1).new_line {
            // `nextot q in p`: nothing else makes sense.
            let is_call = self.kind_at(start + 1) == Kind::OpenParen;
            if !is_call && let Some(meant) = words::similar(word, words::PREFIXES.iter().copied()) {
                let here = self.here();
                let message = format!("unknown word `{word}`");
                self.mend(Diagnostic::error(here, message).fix(format!("did you mean `{meant}`?"), here, meant));
                word = meant;
            }
        }
        let applies = if word == "any" {
            self.word_at(start + 1) == "in" && self.operand_at(start + 2)
        } else {
            words::PREFIXES.contains(&word) && self.begins_operation(start)
        };
        let lacks_in = word == "any" && !applies && !before_body && self.begins_operation(start);
        if lacks_in && self.kind_at(start + 1) != Kind::OpenParen && !self.token(start + 1).new_line {
            let here = self.here();
            self.mend(Diagnostic::error(here, "expected `in` after `any`").fix("write `any in v`", here, "any in"));
        } else if !applies {
            let primary = self.primary();
            return self.postfix(primary, before_body);
        }
        if !self.enter() {
            return self.error_expression();
        }
        self.bump_as(Role::Algebra);
        let result = self.operation(start, word, before_body);
        self.leave();
        result
    }

    /// What stands behind a word of the algebra such as `nextto`.
    fn operation(&mut self, start: usize, word: &str, before_body: bool) -> Tall {
        let begin = self.span_at(start);
        match word {
            "any" => {
                if self.at_infix("in") {
                    self.take_infix();
                }
                let ring = self.unary_before(before_body);
                let span = begin.to(ring.expr.span);
                self.tall(ExprKind::Any { ring: Box::new(ring.expr) }, span, ring.height)
            }
            "valence" | "gaps" => {
                let ring = self.unary_before(before_body);
                let span = begin.to(ring.expr.span);
                let (height, ring) = (ring.height, Box::new(ring.expr));
                let kind = if word == "gaps" { ExprKind::Gaps { ring } } else { ExprKind::Valence { ring } };
                self.tall(kind, span, height)
            }
            _ => {
                let mut item = self.unary();
                let ring = self.second(&mut item, "in", &format!("`{word} x in v`"));
                let span = begin.to(ring.expr.span);
                let height = item.height.max(ring.height);
                let (item, ring) = (Box::new(item.expr), Box::new(ring.expr));
                let kind = match word {
                    "nextto" => ExprKind::Next { item, ring },
                    "prevto" => ExprKind::Previous { item, ring },
                    _ => ExprKind::Is { item, of: ring },
                };
                self.tall(kind, span, height)
            }
        }
    }

    /// Whether an operand follows the word at a token. A word such as `in` is one only before another such word.
    pub(super) fn begins_operation(&self, at: usize) -> bool {
        self.operand_at(at + 1) && (!words::is_infix(self.word_at(at + 1)) || words::is_infix(self.word_at(at + 2)))
    }
}
