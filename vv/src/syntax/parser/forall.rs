//! `forall`: sets, rings, pairs round a ring, faces.

use super::super::lexer::Kind;
use super::super::tree::{Expr, ExprKind, Forall, From, Name, StmtKind};
use super::super::words;
use super::{Parser, Role, Tall};
use crate::diagnostic::Diagnostic;
use crate::source::Span;

impl Parser<'_> {
    /// `parallel forall p in S …`
    pub(super) fn parallel(&mut self) -> StmtKind {
        let span = self.here();
        self.bump_as(Role::Algebra);
        let next = self.here();
        let error = Diagnostic::error(span, "only the rounds of a `forall` can be parallel");
        match self.word() {
            "forall" => return self.forall(Some(span), false),
            "for" | "foreach" if self.kind_at(self.at + 1) != Kind::OpenParen => {
                self.mend(error.fix("write `parallel forall p in S`", next, "forall"));
            }
            "for" | "foreach" => {
                self.mend(error.hint("write `parallel forall p in S { … }`"));
                return StmtKind::Empty;
            }
            _ => {
                let before = Span { end: next.start, ..next };
                self.mend(error.fix("write `parallel forall p in S`", before, "forall "));
                return self.forall_of(Some(span), true);
            }
        }
        self.forall(Some(span), true)
    }

    /// ``forall q in `p …``; `lenient`: what stands there instead was reported already.
    pub(super) fn forall(&mut self, parallel: Option<Span>, lenient: bool) -> StmtKind {
        self.bump_as(Role::Algebra);
        self.forall_of(parallel, lenient)
    }

    /// What follows the word.
    fn forall_of(&mut self, parallel: Option<Span>, lenient: bool) -> StmtKind {
        if self.word() == words::PARALLEL
            && self.kind_at(self.at + 1) == Kind::Word
            && self.word_at(self.at + 1) != "in"
        {
            let error = Diagnostic::error(self.here(), "`parallel` stands before `forall`");
            self.mend(error.hint("write `parallel forall p in S { … }`"));
            self.bump_as(Role::Algebra);
        }
        let open = self.at;
        let mut parentheses = self.eat(Kind::OpenParen);
        if parentheses && !lenient {
            let span = self.previous();
            self.mend(Diagnostic::error(span, "`forall` takes no parentheses").hint("write `forall p in S { … }`"));
        }
        let variable = self.loop_variable(lenient);
        let follower = self.eat(Kind::Comma).then(|| self.loop_variable(lenient));
        if !self.panicking && self.kind() == Kind::Comma {
            let error = Diagnostic::error(self.here(), "a `forall` has one variable, or two that follow each other");
            self.mend(error.hint("write `forall p in S { … }` or `forall p, q in f { … }`"));
            while self.eat(Kind::Comma) {
                self.loop_variable(true);
            }
        }
        // `forall (p, q) in f`
        if parentheses && self.kind() == Kind::CloseParen && self.word_at(self.at + 1) == "in" {
            self.bump();
            parentheses = false;
        }
        let (faces, over) = self.walked(&variable, lenient);
        let from = self.from();
        if parentheses {
            self.close(Kind::CloseParen, open);
        }
        self.recover_header();
        let body = *self.body("the loop");
        StmtKind::Forall(Box::new(Forall { parallel, variable, follower, faces, over, from, body }))
    }

    fn loop_variable(&mut self, lenient: bool) -> Name {
        if self.typed_name_at(self.at) {
            let span = self.here();
            let error =
                Diagnostic::error(span, "the variable of a `forall` needs no type, it has that of what is walked");
            let with_space = Span { end: self.span_at(self.at + 1).start, ..span };
            if !lenient {
                self.mend(error.fix("leave the type out", with_space, ""));
            }
            self.bump_as(Role::Type);
        }
        self.name("the loop's variable")
    }

    /// `in faces S`
    fn walked(&mut self, variable: &Name, lenient: bool) -> (Option<Span>, Expr) {
        if self.panicking {
            return (None, self.error_expression().expr);
        }
        let span = self.here();
        match self.kind() {
            Kind::Word if self.word() == "in" => self.bump_as(Role::Algebra),
            Kind::Colon => {
                if !lenient {
                    self.mend(Diagnostic::error(span, "expected `in`, found `:`").fix("write `in`", span, "in"));
                }
                self.bump();
            }
            Kind::Word if self.word() == "from" && self.operand_at(self.at + 1) => {
                let error = Diagnostic::error(span, "expected `in`, found `from`");
                let name = &variable.text;
                self.fail(
                    error.hint(format!("where the round begins comes last: `forall {name} in r from p {{ … }}`")),
                );
                return (None, self.error_expression().expr);
            }
            _ => {
                let name = ExprKind::Name(variable.text.clone());
                let mut left = Tall { expr: Expr { kind: name, span: variable.span }, height: 1 };
                return (None, self.second(&mut left, "in", "`forall p in S { … }`").expr);
            }
        }
        (self.faces(), self.over())
    }

    /// The word `faces` before a set. A set may have this name: `forall v in faces add v to S`.
    fn faces(&mut self) -> Option<Span> {
        let (at, word, span) = (self.at, self.word(), self.here());
        let behind = at + 1;
        let body = words::STATEMENTS.contains(&self.word_at(behind)) && self.begins_operation(behind);
        if !self.begins_operation(at) || self.token(behind).new_line || body || self.edge_at(behind) {
            return None;
        }
        if word != words::FACES {
            // `forall f in face S {`
            let named = self.kind_at(behind) == Kind::Word && self.kind_at(behind + 1) == Kind::OpenBrace;
            if !named {
                return None;
            }
            let error = Diagnostic::error(span, format!("unknown word `{word}`"));
            if matches!(word, "vertices" | "edges") {
                let set = self.word_at(behind);
                self.mend(error.hint(if word == "edges" {
                    format!("each edge once is `forall p in {set} forall q in p {{ if (p < q) continue; … }}`")
                } else {
                    format!("`forall p in {set}` walks vertices")
                }));
                self.bump();
                return None;
            }
            words::similar(word, [words::FACES])?;
            self.mend(error.fix(format!("did you mean `{}`?", words::FACES), span, words::FACES));
        }
        self.bump_as(Role::Algebra);
        Some(span)
    }

    /// `from p, q`
    fn from(&mut self) -> Option<From> {
        if self.panicking || self.word() != "from" || !self.operand_at(self.at + 1) {
            return None;
        }
        self.bump_as(Role::Algebra);
        let corner = self.over();
        // `from p q {`
        let forgotten = self.kind() == Kind::Word && self.kind_at(self.at + 1) == Kind::OpenBrace;
        if forgotten && !self.panicking && self.operand_at(self.at) {
            let after = self.after_previous();
            let error = Diagnostic::error(self.previous(), "expected `,` after this");
            self.mend(error.fix("write `from p, q`", after, ","));
        } else if !self.eat(Kind::Comma) {
            return Some(From { corner, next: None });
        }
        if !self.operand_at(self.at) {
            let error = Diagnostic::error(self.here(), format!("expected a vertex, found {}", self.found()));
            self.fail(error.hint("write `forall x in f from p, q { … }`"));
        }
        Some(From { corner, next: Some(self.over()) })
    }

    /// Whether `type name` stands at a token, where a loop's variable is to be named.
    pub(super) fn typed_name_at(&self, at: usize) -> bool {
        let (word, name) = (self.word_at(at), self.word_at(at + 1));
        let is_type = words::any_type(word).is_some() || words::foreign_type(word).is_some();
        is_type && !name.is_empty() && (name != "in" || self.word_at(at + 2) == "in")
    }
}
