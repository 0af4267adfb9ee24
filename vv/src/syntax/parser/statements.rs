//! Statements.

use super::super::lexer::Kind;
use super::super::tree::{Block, Expr, ExprKind, Stmt, StmtKind};
use super::super::words;
use super::{Parser, grow};
use crate::diagnostic::Diagnostic;
use crate::source::Span;

impl Parser<'_> {
    /// `{ … }`; `what` it is the body of is said if it is missing.
    pub(super) fn block(&mut self, what: &str) -> Block {
        let open = self.at;
        if !self.eat(Kind::OpenBrace) {
            self.unexpected(&format!("`{{` of {what}"));
            return Block::default();
        }
        let mut statements = Vec::new();
        loop {
            match self.kind() {
                Kind::CloseBrace => {
                    self.bump();
                    break;
                }
                Kind::End => {
                    self.say_unclosed(open, None);
                    break;
                }
                Kind::Word if self.unclosed || self.function_at(self.at) => {
                    self.say_unclosed(open, Some(self.at));
                    break;
                }
                _ => {}
            }
            let before = self.at;
            statements.push(self.statement());
            if self.panicking {
                self.synchronize();
            }
            if self.at == before {
                self.bump();
            }
        }
        Block { statements, span: Some(self.since(open)) }
    }

    fn say_unclosed(&mut self, open: usize, function: Option<usize>) {
        if !self.unclosed {
            self.unclosed = true;
            let opening = self.span_at(open);
            let error = Diagnostic::error(opening, "this `{` is never closed");
            self.mend(match function {
                Some(at) => error.label(self.span_at(at), "a function begins here, and functions do not nest"),
                None => error,
            });
        }
    }

    /// Whether a function with its body begins at a token: `type name(…) {`, `static` or not.
    pub(super) fn function_at(&self, at: usize) -> bool {
        if !self.token(at).new_line {
            return false;
        }
        let ty = if self.word_at(at) == "static" { at + 1 } else { at };
        if words::any_type(self.word_at(ty)).is_none() {
            return false;
        }
        self.signature_at(ty + 1)
    }

    /// Whether a token is the name in `name(…) {`.
    fn signature_at(&self, name: usize) -> bool {
        self.kind_at(name) == Kind::Word
            && self.kind_at(name + 1) == Kind::OpenParen
            && self.behind_parentheses(name + 1).is_some_and(|behind| self.kind_at(behind) == Kind::OpenBrace)
    }

    /// One statement with its `;`.
    pub(super) fn statement(&mut self) -> Stmt {
        let start = self.at;
        if !self.enter() {
            self.gave_up = true;
            self.at = self.tokens.len() - 1;
            return Stmt { kind: StmtKind::Empty, span: self.since(start) };
        }
        let kind = grow(|| self.statement_kind());
        self.leave();
        Stmt { kind, span: self.since(start) }
    }

    fn statement_kind(&mut self) -> StmtKind {
        match self.kind() {
            Kind::Semicolon => {
                self.bump();
                StmtKind::Empty
            }
            Kind::OpenBrace => StmtKind::Block(self.block("a block")),
            Kind::Word => self.worded(),
            Kind::CloseBrace | Kind::End => {
                self.unexpected("a statement");
                self.panicking = false;
                StmtKind::Empty
            }
            Kind::Hash => {
                self.fail(
                    Diagnostic::error(self.here(), "`#` has no place inside a function")
                        .hint("`#include \"file.vv\"` stands at the top of the file"),
                );
                self.synchronize();
                StmtKind::Empty
            }
            _ => self.expression_statement(),
        }
    }

    /// A statement that begins with a word.
    fn worded(&mut self) -> StmtKind {
        let start = self.at;
        let mut word = self.word();
        match word {
            "if" => return self.branch(),
            "while" => {
                self.bump();
                let condition = self.condition("while (p != q) …");
                let body = self.body("the loop");
                return StmtKind::While { condition, body };
            }
            "do" => return self.do_while(),
            "for" => return self.counted_loop(),
            "break" | "continue" => {
                self.bump();
                self.end_statement();
                return if word == "break" { StmtKind::Break } else { StmtKind::Continue };
            }
            "return" => {
                self.bump();
                let value = self.operand_at(self.at) || !self.statement_is_over();
                let value = value.then(|| self.expression());
                self.end_statement();
                return StmtKind::Return(value);
            }
            "else" => {
                let error = Diagnostic::error(self.here(), "this `else` belongs to no `if`");
                self.mend(error.hint("an `if` with several statements needs braces: `if (…) { … } else { … }`"));
                self.bump();
                return self.statement().kind;
            }
            "static" => {
                let here = self.here();
                let error = Diagnostic::error(here, "vv has no static variables, they would survive an undo");
                self.mend(error.hint("keep state as a property of the mesh: `mesh { int generation = 0; };`"));
                self.bump();
                return if self.is_end() { StmtKind::Empty } else { self.statement().kind };
            }
            _ => {}
        }
        // On a line of its own it would have ended the block: see `function_at`.
        if words::any_type(word).is_some() && self.signature_at(start + 1) {
            let name = self.span_at(start + 1);
            let error = Diagnostic::error(name, "functions do not nest");
            self.mend(error.hint("write this one before or after the function it stands in"));
            self.at = self.behind_parentheses(start + 2).unwrap_or(start + 1);
            let _ = self.block("the function");
            return StmtKind::Empty;
        }
        if word == "const" || self.declaration_at(start) {
            let declaration = self.declaration();
            self.end_statement();
            return StmtKind::Declare(declaration);
        }
        let next = self.kind_at(start + 1);
        if matches!(next, Kind::Word | Kind::Text) || matches!(word, "make" | "switch" | "struct" | "try") {
            word = self.corrected(word);
        }
        self.algebra(word).unwrap_or_else(|| self.foreign())
    }

    fn branch(&mut self) -> StmtKind {
        self.bump();
        let condition = self.condition("if (p < q) …");
        let then = self.body("the `if`");
        let otherwise = (!self.panicking && self.word() == "else").then(|| {
            self.bump();
            self.body("the `else`")
        });
        StmtKind::If { condition, then, otherwise }
    }

    fn do_while(&mut self) -> StmtKind {
        self.bump();
        let body = self.body("the loop");
        let condition = if self.eat_word("while") {
            self.condition("do { … } while (p != q);")
        } else {
            self.unexpected("`while` after the body of the `do`");
            self.error_expression().expr
        };
        self.end_statement();
        StmtKind::DoWhile { body, condition }
    }

    fn counted_loop(&mut self) -> StmtKind {
        let start = self.at;
        let open = start + 1;
        let head = if self.kind_at(open) == Kind::OpenParen { open + 1 } else { open };
        let name = head + usize::from(self.typed_name_at(head));
        let over = self.word_at(name + 1) == "in" || self.kind_at(name + 1) == Kind::Colon;
        if self.kind_at(name) == Kind::Word && over {
            let span = self.here();
            let message = "vv loops over sets and rings with `forall`";
            self.mend(Diagnostic::error(span, message).fix("write `forall p in S`", span, "forall"));
            return self.forall(None, true);
        }
        self.bump();
        if !self.eat(Kind::OpenParen) {
            self.unexpected("`(` after `for`");
        }
        let init = if self.panicking || self.eat(Kind::Semicolon) {
            None
        } else {
            let begin = self.at;
            let kind = if self.word() == "const" || self.declaration_at(begin) {
                StmtKind::Declare(self.declaration())
            } else {
                StmtKind::Expr(self.expression())
            };
            let span = self.since(begin);
            self.separator();
            Some(Box::new(Stmt { kind, span }))
        };
        let condition = (!self.panicking && self.kind() != Kind::Semicolon).then(|| self.expression());
        self.separator();
        let mut update = Vec::new();
        if !self.panicking && self.kind() != Kind::CloseParen {
            update = self.list(Kind::CloseParen).0;
        }
        if self.panicking {
            self.skip_for_header();
        } else {
            self.close(Kind::CloseParen, open);
        }
        self.recover_header();
        let body = self.body("the loop");
        StmtKind::For { init, condition, update, body }
    }

    /// A `;` in the head of a `for`.
    fn separator(&mut self) {
        if !self.eat(Kind::Semicolon) && !self.panicking {
            let message = format!("expected `;`, found {}", self.found());
            let error = Diagnostic::error(self.here(), message);
            self.fail(error.hint("write `for (int i = 0; i < n; i++)`"));
        }
    }

    /// Skips the rest of a broken head of a `for`, semicolons and all.
    fn skip_for_header(&mut self) {
        let mut depth = 0;
        loop {
            match self.kind() {
                Kind::CloseParen if depth == 0 => {
                    self.bump();
                    self.panicking = false;
                    return;
                }
                Kind::OpenParen => depth += 1,
                Kind::CloseParen => depth -= 1,
                Kind::Semicolon => {}
                _ if self.statement_is_over() => return,
                _ => {}
            }
            self.bump();
        }
    }

    /// `(condition)`
    fn condition(&mut self, form: &str) -> Expr {
        let open = self.at;
        if !self.eat(Kind::OpenParen) {
            let message = format!("expected `(`, found {}", self.found());
            self.fail(Diagnostic::error(self.here(), message).hint(format!("write `{form}`")));
            self.recover_header();
            return self.error_expression().expr;
        }
        let condition = self.expression();
        if let ExprKind::Assign { op: None, target, value } = &condition.kind
            && !self.panicking
        {
            let sign = Span { start: target.span.end, end: value.span.start, ..condition.span };
            let warning = Diagnostic::warning(condition.span, "this condition stores a value, it does not compare");
            self.mend(warning.fix("compare with `==`", sign, " == "));
        }
        self.close(Kind::CloseParen, open);
        self.recover_header();
        condition
    }

    /// The statement a loop or branch applies to.
    pub(super) fn body(&mut self, of: &str) -> Box<Stmt> {
        if self.panicking {
            let span = self.here();
            return Box::new(Stmt { kind: StmtKind::Empty, span });
        }
        let body = self.statement();
        if body.kind == StmtKind::Empty && self.kind() == Kind::OpenBrace && !self.panicking {
            let message = format!("this `;` is all that {of} applies to, the block behind it stands alone");
            self.mend(Diagnostic::warning(body.span, message).fix("leave out the `;`", body.span, ""));
        }
        Box::new(body)
    }

    pub(super) fn expression_statement(&mut self) -> StmtKind {
        let expression = self.expression();
        self.end_statement();
        StmtKind::Expr(expression)
    }
}
