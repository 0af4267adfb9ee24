//! Statements, and the declarations among them.

use super::super::lexer::Kind;
use super::super::tree::{
    BinaryOp, Block, Declaration, Declarator, Expr, ExprKind, Name, Side, Stmt, StmtKind, TypeKind, TypeName, UnaryOp,
};
use super::super::words;
use super::{Parser, Role, Tall, grow};
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

    /// Whether a function with its body begins at a token: `type name(…) {`.
    pub(super) fn function_at(&self, at: usize) -> bool {
        if !self.token(at).new_line || words::any_type(self.word_at(at)).is_none() {
            return false;
        }
        let name = at + 1;
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
        if word == "const" || self.declaration_at(start) {
            let declaration = self.declaration();
            self.end_statement();
            return StmtKind::Declare(declaration);
        }
        if self.kind_at(start + 1) == Kind::Word || matches!(word, "make" | "switch" | "struct" | "try") {
            word = self.corrected(word);
        }
        self.algebra(word).unwrap_or_else(|| self.foreign())
    }

    /// Whether the statement is one of the algebra: its word is one, and an operand follows.
    fn algebra(&mut self, word: &str) -> Option<StmtKind> {
        if self.panicking {
            return None;
        }
        let start = self.at;
        let word = words::STATEMENTS.iter().copied().find(|w| *w == word)?;
        let next = self.kind_at(start + 1);
        let applies = match word {
            "forall" => self.operand_at(start + 1) || next == Kind::Word,
            "make" => next == Kind::OpenBrace || self.operand_at(start + 1) && next != Kind::OpenParen,
            "print" => {
                self.operand_at(start + 1) || matches!(next, Kind::Minus | Kind::Not | Kind::Plus | Kind::Semicolon)
            }
            "synchronize" | "synchronise" => self.operand_at(start + 1),
            // `add(p, q)` may be a call of a function of that name.
            _ if next == Kind::OpenParen => {
                self.behind_parentheses(start + 1).is_some_and(|behind| self.kind_at(behind) == Kind::Word)
            }
            _ => self.operand_at(start + 1),
        };
        if !applies {
            return None;
        }
        if word == "forall" {
            return Some(self.forall(false));
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
        let second = self.second(&mut first, word, form);
        (first.expr, second.expr)
    }

    /// ``forall q in `p …``; `lenient`: what C++ has instead was reported already.
    fn forall(&mut self, lenient: bool) -> StmtKind {
        self.bump_as(Role::Algebra);
        let open = self.at;
        let parentheses = self.eat(Kind::OpenParen);
        if parentheses && !lenient {
            let span = self.previous();
            self.mend(Diagnostic::error(span, "`forall` takes no parentheses").hint("write `forall p in S { … }`"));
        }
        if words::reserved_type(self.word()).is_some() && self.kind_at(self.at + 1) == Kind::Word {
            let span = self.here();
            let error = Diagnostic::error(span, "the variable of a `forall` needs no type, it is a vertex");
            let with_space = Span { end: self.span_at(self.at + 1).start, ..span };
            if !lenient {
                self.mend(error.fix("leave the type out", with_space, ""));
            }
            self.bump_as(Role::Type);
        }
        let variable = self.name("the loop's variable");
        if !self.panicking && self.kind() == Kind::Comma {
            let span = self.here();
            self.mend(Diagnostic::error(span, "a `forall` has one variable").hint("write `forall p in S { … }`"));
            while self.eat(Kind::Comma) {
                self.name("the loop's variable");
            }
        }
        let over = if self.panicking {
            self.error_expression().expr
        } else if self.word() == "in" {
            self.bump_as(Role::Algebra);
            self.over()
        } else if self.kind() == Kind::Colon {
            let span = self.here();
            if !lenient {
                self.mend(Diagnostic::error(span, "expected `in`, found `:`").fix("write `in`", span, "in"));
            }
            self.bump();
            self.over()
        } else {
            let name = ExprKind::Name(variable.text.clone());
            let mut left = Tall { expr: Expr { kind: name, span: variable.span }, height: 1 };
            self.second(&mut left, "in", "`forall p in S { … }`").expr
        };
        if parentheses {
            self.close(Kind::CloseParen, open);
        }
        self.recover_header();
        let body = self.body("the loop");
        StmtKind::Forall { variable, over, body }
    }

    /// After the head of a loop or branch went wrong: goes on with the body if that can be found.
    fn recover_header(&mut self) {
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
            if !self.eat(Kind::CloseBrace) {
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
        } else {
            let message = format!("expected `{{` after `make`, found {}", self.found());
            self.fail(Diagnostic::error(self.here(), message).hint("write `make {a, b, c} nb_of v`"));
        }
        let list = Expr { kind: ExprKind::Error, span: self.since(open) };
        let of = self.second(&mut Tall { expr: list, height: 1 }, "nb_of", "`make {a, b, c} nb_of v`").expr;
        StmtKind::Make { items, of }
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
            self.close(Kind::CloseParen, open);
            return StmtKind::Print(items);
        }
        StmtKind::Print(self.list(Kind::Semicolon).0)
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
        let name =
            head + usize::from(words::any_type(self.word_at(head)).is_some() && self.kind_at(head + 1) == Kind::Word);
        let over = self.word_at(name + 1) == "in" || self.kind_at(name + 1) == Kind::Colon;
        if self.kind_at(name) == Kind::Word && over {
            let span = self.here();
            let message = "vv loops over sets and rings with `forall`";
            self.mend(Diagnostic::error(span, message).fix("write `forall p in S`", span, "forall"));
            return self.forall(true);
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
    fn body(&mut self, of: &str) -> Box<Stmt> {
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

    /// Whether a declaration begins at a token. `vec`, `point` and `vector` may be variables: they are types where a
    /// name follows.
    pub(super) fn declaration_at(&self, at: usize) -> bool {
        let word = self.word_at(at);
        let next = self.kind_at(at + 1);
        if words::reserved_type(word).is_some() {
            return next != Kind::OpenParen;
        }
        let named = self.kind_at(at + 1) == Kind::Word && !self.token(at + 1).new_line;
        words::any_type(word).is_some() && (named || (next == Kind::Ampersand && self.kind_at(at + 2) == Kind::Word))
    }

    /// `[const] type a = e, b(e), c` without its `;`.
    pub(super) fn declaration(&mut self) -> Declaration {
        let start = self.at;
        let is_const = self.eat_word("const");
        let Some(ty) = self.type_name() else {
            let span = self.here();
            match words::foreign_type(self.word()) {
                Some((meant, _)) => {
                    let message = format!("`{}` is not a type of vv", self.word());
                    self.fail(Diagnostic::error(span, message).hint(format!("write `{meant}`")));
                }
                None => self.unexpected("a type after `const`"),
            }
            let ty = TypeName { kind: TypeKind::Void, span };
            return Declaration { is_const, ty, declarators: Vec::new(), span: self.since(start) };
        };
        if matches!(self.kind(), Kind::Ampersand | Kind::And | Kind::Star) {
            let sign = self.here();
            let what = if self.kind() == Kind::Star { "pointers" } else { "variables that refer to others" };
            let error = Diagnostic::error(sign, format!("vv has no {what}"));
            self.mend(error.fix("leave it out: a vertex is a handle already", sign, ""));
            self.bump();
        } else if self.kind() == Kind::Less {
            self.fail(
                Diagnostic::error(self.here(), "vv has no templates and no containers")
                    .hint("sets of vertices are of type `mesh`; values are kept as properties: `v$name`"),
            );
        }
        let declarators = self.declarators(ty);
        Declaration { is_const, ty, declarators, span: self.since(start) }
    }

    pub(super) fn declarators(&mut self, ty: TypeName) -> Vec<Declarator> {
        let mut declarators = Vec::new();
        while !self.panicking {
            let name = self.name("a variable");
            if name.text.is_empty() {
                break;
            }
            let init = self.initializer(ty, &name);
            declarators.push(Declarator { name, init });
            if !self.eat(Kind::Comma) {
                break;
            }
            if self.declaration_at(self.at) && self.kind_at(self.at + 1) == Kind::Word {
                let span = self.here();
                let message = "the type stands once, before the first of several variables";
                self.mend(Diagnostic::error(span, message).fix("leave it out", span, ""));
                self.bump_as(Role::Type);
            }
        }
        declarators
    }

    fn initializer(&mut self, ty: TypeName, name: &Name) -> Option<Expr> {
        let open = self.at;
        match self.kind() {
            Kind::Assign => {
                self.bump();
                Some(self.expression())
            }
            Kind::OpenParen => {
                self.bump();
                let (mut arguments, _) = self.list(Kind::CloseParen);
                self.close(Kind::CloseParen, open);
                let span = ty.span.to(self.previous());
                match arguments.len() {
                    1 => arguments.pop(),
                    _ if ty.kind == TypeKind::Vec => Some(Expr { kind: Self::call(ty.kind, ty.span, arguments), span }),
                    n => {
                        let span = self.since(open);
                        let message = format!("`{}` takes one value, not {n}", name.text);
                        self.mend(Diagnostic::error(span, message).hint("write `type name = value;`"));
                        Some(Expr { kind: ExprKind::Error, span })
                    }
                }
            }
            Kind::OpenBracket => {
                let error = Diagnostic::error(self.here(), "vv has no arrays");
                self.fail(error.hint("keep values as properties: `vertex { double age = 0; };` and `v$age`"));
                None
            }
            Kind::Equal => {
                let span = self.here();
                self.mend(Diagnostic::error(span, "expected `=`, found `==`").fix("write `=`", span, "="));
                self.bump();
                Some(self.expression())
            }
            _ => None,
        }
    }

    /// What was probably meant by a first word that must be one of the algebra, going by what follows: `forall` for
    /// `forll` and `foreach`. For `addx to S` there is only a message.
    fn corrected<'w>(&mut self, word: &'w str) -> &'w str {
        let (start, span) = (self.at, self.here());
        let is_known = words::STATEMENTS.contains(&word) || words::foreign_type(word).is_some();
        if is_known || self.token(start + 1).new_line {
            return word;
        }
        let statements = words::STATEMENTS.iter().copied();
        let glued = statements.clone().find(|w| word.len() > w.len() && word.starts_with(w));
        let message = format!("unknown word `{word}`");
        let meant = if word == "foreach" { Some("forall") } else { words::similar(word, statements) };
        if let Some(first) = glued.filter(|_| words::is_infix(self.word_at(start + 1))) {
            let apart = format!("{first} {}", &word[first.len()..]);
            self.fail(Diagnostic::error(span, message).fix(format!("write `{apart}`"), span, apart));
        } else if let Some(meant) = meant {
            self.mend(Diagnostic::error(span, message).fix(format!("did you mean `{meant}`?"), span, meant));
            return meant;
        }
        word
    }

    /// What C++ has and vv has not; an expression if it is none of that.
    fn foreign(&mut self) -> StmtKind {
        let (start, word, span) = (self.at, self.word(), self.here());
        let next = self.kind_at(start + 1);
        if self.panicking {
            self.synchronize();
            return StmtKind::Empty;
        }
        let qualified = if word == "std" && next == Kind::DoubleColon { self.word_at(start + 2) } else { "" };
        let construct = match qualified {
            "cout" | "cerr" | "printf" => words::foreign_construct(qualified),
            "" => {
                let always = matches!(word, "switch" | "catch" | "throw" | "goto" | "assert" | "printf");
                let begins = match next {
                    Kind::Word => !self.token(start + 1).new_line,
                    Kind::OpenBrace | Kind::Foreign | Kind::Less => true,
                    Kind::OpenParen => always,
                    _ => false,
                };
                words::foreign_construct(word).filter(|_| begins)
            }
            "string" => words::foreign_construct("string"),
            _ if self.kind_at(start + 3) == Kind::Less => Some((
                "vv has no containers",
                "sets of vertices are of type `mesh`; values are kept as properties: `v$name`",
            )),
            _ => None,
        };
        if let Some((message, hint)) = construct {
            self.fail(Diagnostic::error(span, message).hint(hint));
            self.synchronize();
            return StmtKind::Empty;
        }
        if next == Kind::Word && !self.token(start + 1).new_line && !words::is_infix(self.word_at(start + 1)) {
            if let Some(kind) = self.foreign_declaration() {
                return kind;
            }
            if matches!(self.kind_at(start + 2), Kind::Semicolon | Kind::Assign | Kind::Comma) {
                let error = Diagnostic::error(span, format!("`{word}` is not a type of vv"));
                self.fail(error.hint("the types are `bool`, `int`, `double`, `vec`, `vertex` and `mesh`"));
                self.synchronize();
                return StmtKind::Empty;
            }
        }
        self.expression_statement()
    }

    /// `float x = 1.0;`, `auto p = any in v;`, read with the type that is meant.
    fn foreign_declaration(&mut self) -> Option<StmtKind> {
        let (start, word, span) = (self.at, self.word(), self.here());
        let (meant, kind) = words::foreign_type(word)?;
        let message = format!("`{word}` is not a type of vv");
        let error = Diagnostic::error(span, message);
        self.mend(match kind {
            Some(_) => error.fix(format!("write `{meant}`"), span, meant),
            None => error.hint("the types are `bool`, `int`, `double`, `vec`, `vertex` and `mesh`"),
        });
        self.bump_as(Role::Type);
        let mut ty = TypeName { kind: kind.unwrap_or(TypeKind::Vertex), span };
        let declarators = self.declarators(ty);
        if kind.is_none()
            && let Some(init) = declarators.first().and_then(|d| d.init.as_ref())
        {
            ty.kind = likely_type(init);
        }
        self.end_statement();
        Some(StmtKind::Declare(Declaration { is_const: false, ty, declarators, span: self.since(start) }))
    }
}

/// The type that a value probably has, going by its form alone.
fn likely_type(value: &Expr) -> TypeKind {
    match &value.kind {
        ExprKind::Bool(_) | ExprKind::Is { .. } | ExprKind::Unary { op: UnaryOp::Not, .. } => TypeKind::Bool,
        ExprKind::Int(_) | ExprKind::Valence { .. } | ExprKind::Gaps { .. } => TypeKind::Int,
        ExprKind::Any { .. } | ExprKind::Next { .. } | ExprKind::Previous { .. } | ExprKind::Null => TypeKind::Vertex,
        ExprKind::Name(_) => TypeKind::Vertex,
        ExprKind::Property { name, .. } if name.text == "pos" => TypeKind::Vec,
        ExprKind::Call { callee, .. } => words::any_type(&callee.text).unwrap_or(match callee.text.as_str() {
            "insert" => TypeKind::Vertex,
            _ => TypeKind::Double,
        }),
        ExprKind::Binary { op, left, .. } => match op {
            BinaryOp::And | BinaryOp::Or | BinaryOp::Equal | BinaryOp::NotEqual => TypeKind::Bool,
            BinaryOp::Less | BinaryOp::LessEqual | BinaryOp::Greater | BinaryOp::GreaterEqual => TypeKind::Bool,
            _ => likely_type(left),
        },
        ExprKind::Paren(inner) => likely_type(inner),
        _ => TypeKind::Double,
    }
}
