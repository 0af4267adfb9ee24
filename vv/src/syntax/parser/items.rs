//! What stands at file scope.

use super::super::lexer::Kind;
use super::super::tree::{Ast, Declaration, Element, Function, Item, Param, Parameter, TypeKind, TypeName};
use super::super::words;
use super::{Parser, Role};
use crate::diagnostic::Diagnostic;
use crate::source::Span;

impl Parser<'_> {
    /// The whole text.
    pub(super) fn file(&mut self) -> Ast {
        let mut items = Vec::new();
        while !self.is_end() {
            let before = self.at;
            items.extend(self.item());
            if self.panicking {
                self.skip_to_item(before);
            }
            self.unclosed = false;
            if self.at == before {
                self.bump();
            }
        }
        Ast { items }
    }

    fn item(&mut self) -> Option<Item> {
        let start = self.at;
        let word = self.word();
        let next = self.kind_at(start + 1);
        match (self.kind(), word) {
            (Kind::Semicolon, _) => {
                self.bump();
                None
            }
            (Kind::CloseBrace, _) => {
                self.mend(Diagnostic::error(self.here(), "this `}` closes nothing"));
                self.bump();
                None
            }
            (Kind::Hash, _) => self.directive(),
            (Kind::Word, "vertex" | "edge" | "mesh") if next == Kind::OpenBrace => Some(self.properties()),
            (Kind::Word, "start" | "step") if next == Kind::OpenBrace => {
                self.roles[start] = Some(Role::Algebra);
                let name = self.name("the block");
                let body = self.block(&format!("`{word}`"));
                Some(Item::Phase { name, body })
            }
            (Kind::Word, "param") if next == Kind::Word => Some(self.param()),
            (Kind::Word, "static" | "inline") => {
                if word == "inline" {
                    let span = self.here();
                    self.mend(Diagnostic::error(span, "vv has no `inline`").fix("leave it out", span, ""));
                }
                self.bump();
                if self.function_ahead() {
                    return self.function(word == "static");
                }
                self.mend(Diagnostic::error(self.span_at(start), "only functions can be `static`"));
                self.item()
            }
            (Kind::Word, "const") => Some(self.constant()),
            (Kind::Word, _) if self.function_ahead() => self.function(false),
            (Kind::Word, _) if self.declaration_at(start) => Some(self.constant()),
            _ => self.misplaced(),
        }
    }

    /// Something that is no item, read as one if it comes near to one.
    fn misplaced(&mut self) -> Option<Item> {
        let (start, word, span) = (self.at, self.word(), self.here());
        let next = self.kind_at(start + 1);
        let is_word = self.kind() == Kind::Word && !words::is_reserved(word);
        let is_pair = is_word && next == Kind::Word && !words::STATEMENTS.contains(&word);
        let construct = words::foreign_construct(word).filter(|_| match word {
            "struct" | "class" | "enum" | "union" | "namespace" => is_pair || next == Kind::OpenBrace,
            "face" | "faces" | "halfedge" => next == Kind::OpenBrace,
            "template" => next == Kind::Less,
            _ => is_pair,
        });
        if let Some((message, hint)) = construct {
            self.fail(Diagnostic::error(span, message).hint(hint));
            self.synchronize();
            return None;
        }
        // `float area(…)`, `viod f(…)`
        if is_pair && self.kind_at(start + 2) == Kind::OpenParen {
            let ty = self.almost_type(words::RESERVED[..6].iter().copied().chain(["vec", "ring"]));
            return self.function_of(false, ty);
        }
        if is_word && next == Kind::OpenParen && self.has_body_behind(start + 1) {
            let error = Diagnostic::error(span, format!("the function `{word}` does not say what it returns"));
            let before = Span { end: span.start, ..span };
            self.mend(error.fix("write `void` before it if it returns nothing", before, "void "));
            return self.function_of(false, TypeName { kind: TypeKind::Void, span: before });
        }
        if is_pair {
            let known = words::RESERVED[..6].iter().copied().chain(["vec", "ring", "param", "const", "static"]);
            let error = Diagnostic::error(span, format!("unknown word `{word}` at file scope"));
            let meant = words::foreign_type(word).map(|(meant, _)| meant).or_else(|| words::similar(word, known));
            self.fail(match meant.filter(|meant| !meant.contains(' ')) {
                Some(meant) => error.fix(format!("did you mean `{meant}`?"), span, meant),
                None => error.hint("a file holds functions, `const`, `param`, property blocks and `#include`"),
            });
            return None;
        }
        let error = Diagnostic::error(span, "statements stand inside functions");
        self.fail(if self.follows(&[Kind::CloseBrace]) {
            error.hint("if this belongs to the function above, there is a `}` too many before it")
        } else {
            error.hint("write `void name(mesh& S) { … }` around them")
        });
        None
    }

    /// A word that stands for a type, after saying so.
    fn almost_type<'w>(&mut self, types: impl IntoIterator<Item = &'w str>) -> TypeName {
        if let Some(ty) = self.foreign_type_name() {
            return ty;
        }
        let (word, span) = (self.word(), self.here());
        let error = Diagnostic::error(span, format!("`{word}` is not a type of vv"));
        let meant = words::similar(word, types);
        self.mend(match meant {
            Some(meant) => error.fix(format!("did you mean `{meant}`?"), span, meant),
            None => error.hint("the types are `void`, `bool`, `int`, `double`, `vec`, `vertex`, `mesh` and `ring`"),
        });
        self.bump_as(Role::Type);
        TypeName { kind: meant.and_then(words::any_type).unwrap_or(TypeKind::Void), span }
    }

    /// Whether `(…) {` begins at a token.
    fn has_body_behind(&self, open: usize) -> bool {
        self.behind_parentheses(open).is_some_and(|behind| self.kind_at(behind) == Kind::OpenBrace)
    }

    /// Whether a function begins here. `vec a(1, 2, 3);` is none.
    fn function_ahead(&self) -> bool {
        if words::any_type(self.word()).is_none() {
            return false;
        }
        let mut name = self.at + 1;
        while matches!(self.kind_at(name), Kind::Ampersand | Kind::Star) {
            name += 1;
        }
        let open = name + 1;
        if self.kind_at(name) != Kind::Word || self.kind_at(open) != Kind::OpenParen {
            return false;
        }
        let first = self.word_at(open + 1);
        let typed = words::any_type(first).is_some() && self.kind_at(open + 2) != Kind::OpenParen;
        let behind = self.behind_parentheses(open).map(|behind| self.kind_at(behind));
        typed
            || first == "const"
            || behind.is_none_or(|kind| kind == Kind::OpenBrace)
            || self.kind_at(open + 1) == Kind::CloseParen
    }

    fn function(&mut self, is_static: bool) -> Option<Item> {
        let return_type = self.type_name()?;
        self.function_of(is_static, return_type)
    }

    /// What follows the type that a function returns.
    fn function_of(&mut self, is_static: bool, return_type: TypeName) -> Option<Item> {
        let start = self.at;
        if matches!(self.kind(), Kind::Ampersand | Kind::Star) {
            let sign = self.here();
            let error = Diagnostic::error(sign, "functions return values, not references or pointers");
            self.mend(error.fix("leave it out", sign, ""));
            while matches!(self.kind(), Kind::Ampersand | Kind::Star) {
                self.bump();
            }
        }
        let name = self.name("a function");
        let open = self.at;
        self.eat(Kind::OpenParen);
        let parameters = self.parameters();
        self.close_list(Kind::CloseParen, open, true);
        let span = return_type.span.to(self.since(start));
        if self.eat_word("const") {
            let here = self.previous();
            self.mend(Diagnostic::error(here, "a function cannot be `const`").fix("leave it out", here, ""));
        }
        if self.eat(Kind::Semicolon) {
            return Some(Item::Function(Function { is_static, return_type, name, parameters, body: None, span }));
        }
        if self.kind() == Kind::OpenBrace {
            self.panicking = false;
        }
        let body = Some(self.block(&format!("the function `{}`", name.text)));
        Some(Item::Function(Function { is_static, return_type, name, parameters, body, span }))
    }

    fn parameters(&mut self) -> Vec<Parameter> {
        let mut parameters = Vec::new();
        if self.kind() == Kind::CloseParen {
            return parameters;
        }
        if self.word() == "void" && self.kind_at(self.at + 1) == Kind::CloseParen {
            self.bump_as(Role::Type);
            return parameters;
        }
        while !self.panicking && !self.statement_is_over() {
            parameters.extend(self.parameter());
            if !self.eat(Kind::Comma) {
                break;
            }
        }
        parameters
    }

    fn parameter(&mut self) -> Option<Parameter> {
        let start = self.at;
        let mut is_const = self.eat_word("const");
        let Some(ty) = self.type_name().or_else(|| self.foreign_type_name()) else {
            self.unexpected("the type of a parameter");
            return None;
        };
        is_const |= self.eat_word("const");
        let by_reference = self.eat(Kind::Ampersand);
        if self.kind() == Kind::Star {
            let sign = self.here();
            let error = Diagnostic::error(sign, "vv has no pointers");
            self.mend(error.fix("write `&` for a variable of the caller's", sign, "&"));
            self.bump();
        }
        let name = self.name("a parameter");
        let span = self.since(start);
        if self.kind() == Kind::Ampersand && !self.panicking {
            let both = name.span.to(self.here());
            let error = Diagnostic::error(self.here(), "the `&` stands before the name");
            self.mend(error.fix(format!("write `&{}`", name.text), both, format!("&{}", name.text)));
            self.bump();
        }
        if self.kind() == Kind::Assign && !self.panicking {
            let sign = self.here();
            let message = "parameters of functions have no default values";
            self.mend(Diagnostic::error(sign, message).hint("give the value in each call"));
            self.bump();
            self.value();
        }
        Some(Parameter { is_const, ty, by_reference, name, span })
    }

    /// `float`, read as `double`.
    pub(super) fn foreign_type_name(&mut self) -> Option<TypeName> {
        let (word, span) = (self.word(), self.here());
        let (meant, kind) = words::foreign_type(word)?;
        let kind = kind?;
        let error = Diagnostic::error(span, format!("`{word}` is not a type of vv"));
        self.mend(error.fix(format!("write `{meant}`"), span, meant));
        self.bump_as(Role::Type);
        Some(TypeName { kind, span })
    }

    fn constant(&mut self) -> Item {
        let declaration = self.declaration();
        self.end_statement();
        Item::Constant(declaration)
    }

    /// `vertex { double age = 0; int kind; };`
    fn properties(&mut self) -> Item {
        let start = self.at;
        let element = match self.word() {
            "vertex" => Element::Vertex,
            "edge" => Element::Edge,
            _ => Element::Mesh,
        };
        self.bump_as(Role::Type);
        let open = self.at;
        self.bump();
        let mut fields = Vec::new();
        while !matches!(self.kind(), Kind::CloseBrace | Kind::End) && !self.function_at(self.at) {
            let before = self.at;
            if self.eat(Kind::Semicolon) {
                continue;
            }
            if self.declaration_at(self.at) || self.word() == "const" {
                fields.push(self.declaration());
            } else if let Some(ty) = self.foreign_type_name() {
                let declarators = self.declarators(ty);
                fields.push(Declaration { is_const: false, ty, declarators, span: self.since(before) });
            } else if let Some((message, hint)) = words::foreign_construct(self.word()) {
                self.fail(Diagnostic::error(self.here(), message).hint(hint));
            } else {
                self.unexpected("a property such as `double age = 0;`");
            }
            self.end_statement();
            if self.at == before {
                self.bump();
            }
        }
        if !self.eat(Kind::CloseBrace) {
            self.mend(Diagnostic::error(self.span_at(open), "this `{` is never closed"));
        }
        let span = self.since(start);
        self.eat(Kind::Semicolon);
        Item::Properties { element, fields, span }
    }

    /// `param double w = 1.0/16.0 in [0, 0.125];`
    fn param(&mut self) -> Item {
        let start = self.at;
        self.bump_as(Role::Algebra);
        let form = "write `param double w = 0.5 in [0, 1];`";
        let ty = self.type_name().or_else(|| self.foreign_type_name());
        if ty.is_none() {
            self.fail(Diagnostic::error(self.here(), format!("expected a type, found {}", self.found())).hint(form));
        }
        let ty = ty.unwrap_or(TypeName { kind: TypeKind::Double, span: self.here() });
        let name = self.name("a parameter");
        let value = if self.eat(Kind::Assign) {
            self.value()
        } else {
            let message = format!("expected `=` and a value, found {}", self.found());
            self.fail(Diagnostic::error(self.here(), message).hint(form));
            self.error_expression().expr
        };
        let mut range = None;
        if !self.panicking && self.word() == "in" {
            self.bump_as(Role::Algebra);
            let open = self.at;
            if self.eat(Kind::OpenBracket) {
                let low = self.value();
                if !self.eat(Kind::Comma) && !self.panicking {
                    self.unexpected("`,` between the ends of the range");
                }
                let high = self.value();
                self.close(Kind::CloseBracket, open);
                range = Some((low, high));
            } else {
                let message = format!("expected `[`, found {}", self.found());
                self.fail(Diagnostic::error(self.here(), message).hint(form));
            }
        }
        self.end_statement();
        Item::Param(Param { ty, name, value, range, span: self.since(start) })
    }

    /// `#include "file.vv"`
    fn directive(&mut self) -> Option<Item> {
        let start = self.at;
        self.bump();
        let word = self.word();
        let path = self.kind_at(self.at + 1);
        if word == "include" && path == Kind::Text && !self.token(self.at + 1).new_line {
            self.bump();
            let span = self.here();
            let path = self.source(span).trim_matches(['"', '“', '”']).to_owned();
            self.bump();
            self.eat(Kind::Semicolon);
            self.end_line();
            return Some(Item::Include { path, span });
        }
        while !self.is_end() && !self.token(self.at).new_line {
            self.bump();
        }
        let line = self.since(start);
        let system = word == "include" && path == Kind::Less;
        self.mend(match word {
            "include" if system => Diagnostic::error(line, "vv has no header files, its functions are built in").fix(
                "leave this line out",
                line,
                "",
            ),
            "include" => {
                let error = Diagnostic::error(line, "expected a file name in quotes after `#include`");
                match self.source(line).split_once("include").map(|(_, name)| name.trim()) {
                    Some(name) if name.ends_with(".vv") && !name.contains(['"', ' ']) => {
                        error.fix("write it in quotes", line, format!("#include \"{name}\""))
                    }
                    _ => error.hint("write `#include \"insert.vv\"`"),
                }
            }
            "define" => Diagnostic::error(line, "vv has no macros")
                .hint("write `const double k = 0.5;`, or `param` for a slider"),
            _ => {
                let message = "vv has no preprocessor but `#include \"file.vv\"`";
                Diagnostic::error(line, message).fix("leave this line out", line, "")
            }
        });
        None
    }

    /// A line that nothing else stands on: what follows would look as if it belonged to it.
    fn end_line(&mut self) {
        if self.is_end() || self.token(self.at).new_line {
            return;
        }
        let (here, before) = (self.here(), self.after_previous());
        let between = Span { end: here.start, ..before };
        let error = Diagnostic::error(here, "expected the end of the line after `#include`");
        self.mend(error.fix("begin another line", between, "\n"));
    }

    /// Skips to where an item begins at the start of a line.
    fn skip_to_item(&mut self, begun: usize) {
        self.panicking = false;
        let mut depth = 0_u32;
        while !self.is_end() {
            let function = self.token(self.at).new_line && depth == 0 && self.function_ahead();
            let begins = depth == 0
                && self.token(self.at).new_line
                && match self.word() {
                    "static" | "const" => true,
                    "param" => self.kind_at(self.at + 1) == Kind::Word,
                    "vertex" | "edge" | "mesh" | "start" | "step" => self.kind_at(self.at + 1) == Kind::OpenBrace,
                    _ => self.kind() == Kind::Hash,
                };
            if self.at > begun && (function || begins || self.function_at(self.at)) {
                return;
            }
            match self.kind() {
                Kind::OpenBrace => depth += 1,
                Kind::CloseBrace => depth = depth.saturating_sub(1),
                _ => {}
            }
            self.bump();
        }
    }
}
