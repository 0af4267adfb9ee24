//! Declarations of variables, constants and properties.

use super::super::lexer::Kind;
use super::super::tree::{
    BinaryOp, Declaration, Declarator, Expr, ExprKind, Name, StmtKind, TypeKind, TypeName, UnaryOp,
};
use super::super::words;
use super::{Parser, Role};
use crate::diagnostic::Diagnostic;
use crate::source::Span;

impl Parser<'_> {
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
        let Some(ty) = self.type_name().or_else(|| self.foreign_type_name()) else {
            let span = self.here();
            let error = Diagnostic::error(span, format!("expected a type after `const`, found {}", self.found()));
            self.fail(error.hint("write `const double k = 0.5;`"));
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
        if matches!(ty.kind, TypeKind::Vertex | TypeKind::Mesh) && self.kind() == Kind::OpenBrace {
            self.properties_here(ty.span, if ty.kind == TypeKind::Mesh { "mesh" } else { "vertex" });
            return Declaration { is_const, ty, declarators: Vec::new(), span: self.since(start) };
        }
        let declarators = self.declarators(ty);
        Declaration { is_const, ty, declarators, span: self.since(start) }
    }

    /// Refuses `vertex { … };` among statements.
    pub(super) fn properties_here(&mut self, span: Span, block: &str) {
        let error = Diagnostic::error(span, "properties are declared outside of functions");
        self.fail(error.hint(format!("move `{block} {{ … }};` before the functions")));
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
            self.recover_declarator();
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

    /// After a broken initializer goes on with the next variable of the same declaration.
    fn recover_declarator(&mut self) {
        let ends = self.statement_is_over() || self.token(self.at).new_line || words::leads(self.word());
        if self.kind() == Kind::Comma || (ends && !self.panicking) || self.kind() == Kind::CloseParen {
            return;
        }
        self.unexpected("`;`");
        let mut depth = 0_u32;
        while !self.statement_is_over() {
            match self.kind() {
                Kind::OpenParen | Kind::OpenBracket => depth += 1,
                Kind::CloseParen | Kind::CloseBracket => depth = depth.saturating_sub(1),
                Kind::Comma if depth == 0 && self.declarator_at(self.at + 1) => {
                    self.panicking = false;
                    return;
                }
                _ => {}
            }
            self.bump();
        }
    }

    fn declarator_at(&self, at: usize) -> bool {
        self.kind_at(at) == Kind::Word
            && matches!(self.kind_at(at + 1), Kind::Assign | Kind::Comma | Kind::Semicolon | Kind::OpenParen)
    }

    fn initializer(&mut self, ty: TypeName, name: &Name) -> Option<Expr> {
        let open = self.at;
        match self.kind() {
            Kind::Assign if ty.kind == TypeKind::Ring && self.kind_at(open + 1) == Kind::OpenBrace => {
                let (span, name) = (self.span_at(open + 1), &name.text);
                let error = Diagnostic::error(span, "a ring is not written as a list");
                self.fail(error.hint(format!("it begins empty, `ring {name};`, and grows by `add v to {name};`")));
                self.at = self.behind_braces(open + 1);
                self.panicking = false;
                None
            }
            Kind::Assign => {
                self.bump();
                Some(self.expression())
            }
            Kind::OpenParen => {
                self.bump();
                let (mut arguments, _) = self.list(Kind::CloseParen);
                self.close_list(Kind::CloseParen, open, true);
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

    /// `float x = 1.0;`, `vertx v;`, `auto p = any in v;`, read with the type that is meant.
    pub(super) fn foreign_declaration(&mut self) -> Option<StmtKind> {
        let (start, word, span) = (self.at, self.word(), self.here());
        let message = format!("`{word}` is not a type of vv");
        let error = Diagnostic::error(span, message);
        let known = words::RESERVED[1..6].iter().copied().chain(["vec", "point", "vector", "ring"]);
        let similar = words::similar(word, known);
        let ty = if let Some(ty) = self.foreign_type_name() {
            ty
        } else if let Some((meant, kind)) = similar.and_then(|word| Some((word, words::any_type(word)?))) {
            self.mend(error.fix(format!("did you mean `{meant}`?"), span, meant));
            self.bump_as(Role::Type);
            TypeName { kind, span }
        } else if words::foreign_type(word).is_some() {
            return Some(self.automatic_declaration());
        } else {
            return None;
        };
        let declarators = self.declarators(ty);
        self.end_statement();
        Some(StmtKind::Declare(Declaration { is_const: false, ty, declarators, span: self.since(start) }))
    }

    /// `auto p = any in v;`
    fn automatic_declaration(&mut self) -> StmtKind {
        let (start, word, span) = (self.at, self.word(), self.here());
        let said = self.diagnostics.len();
        self.bump_as(Role::Type);
        let unknown = TypeName { kind: TypeKind::Vertex, span };
        let declarators = self.declarators(unknown);
        let error = Diagnostic::error(span, format!("vv has no `{word}`, a variable is declared with its type"));
        let init = declarators.first().and_then(|d| d.init.as_ref());
        let (error, ty) = match init.map(|init| TypeName { kind: likely_type(init), span }) {
            Some(ty) if self.diagnostics.len() == said && !self.panicking => {
                let name = words::name(ty.kind);
                (error.fix(format!("probably `{name}`"), span, name), ty)
            }
            _ => (error.hint("write `double x = …`, `vertex v = …`"), unknown),
        };
        if self.diagnostics.len() == said {
            self.diagnostics.push(error);
        }
        self.end_statement();
        StmtKind::Declare(Declaration { is_const: false, ty, declarators, span: self.since(start) })
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
