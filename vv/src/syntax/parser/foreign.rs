//! Statements that begin with a word of another language, or a mistyped one.

use super::super::lexer::Kind;
use super::super::tree::StmtKind;
use super::super::words;
use super::Parser;
use crate::diagnostic::Diagnostic;

impl Parser<'_> {
    /// What was probably meant by a first word that must be one of the algebra, going by what follows: `forall` for
    /// `forll` and `foreach`. For `addx to S` there is only a message.
    pub(super) fn corrected<'w>(&mut self, word: &'w str) -> &'w str {
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
    pub(super) fn foreign(&mut self) -> StmtKind {
        let (start, word, span) = (self.at, self.word(), self.here());
        let next = self.kind_at(start + 1);
        if self.panicking {
            self.synchronize();
            return StmtKind::Empty;
        }
        if word == "edge" && next == Kind::OpenBrace {
            self.properties_here(span, word);
            self.synchronize();
            return StmtKind::Empty;
        }
        let qualified = if word == "std" && next == Kind::DoubleColon { self.word_at(start + 2) } else { "" };
        let construct = match qualified {
            "cout" | "cerr" | "printf" => words::foreign_construct(qualified),
            "" => {
                let always = matches!(word, "switch" | "catch" | "throw" | "goto" | "assert" | "printf" | "foreach");
                // `foreach(v);` may be a call of a function of that name.
                let over = |behind| self.kind_at(behind) == Kind::Semicolon;
                let is_call =
                    matches!(word, "foreach" | "assert") && self.behind_parentheses(start + 1).is_some_and(over);
                let begins = match next {
                    Kind::Word => !self.token(start + 1).new_line,
                    Kind::OpenBrace | Kind::Foreign | Kind::Less => true,
                    Kind::OpenParen => always && !is_call,
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
            while self.word() == "catch" && word == "try" {
                self.synchronize();
            }
            return StmtKind::Empty;
        }
        // `whlie (a) { … }`
        if next == Kind::OpenParen
            && let Some(behind) = self.behind_parentheses(start + 1)
            && self.kind_at(behind) == Kind::OpenBrace
        {
            let error = Diagnostic::error(span, format!("`{word} (…) {{` begins no statement"));
            self.fail(match words::similar(word, ["if", "while", "for", "forall"]) {
                _ if matches!(word, "elif" | "elsif" | "elseif") => error.fix("write `else if`", span, "else if"),
                Some(meant) => error.fix(format!("did you mean `{meant}`?"), span, meant),
                None => error,
            });
            self.synchronize();
            return StmtKind::Empty;
        }
        if next == Kind::Word && !self.token(start + 1).new_line && !words::is_infix(self.word_at(start + 1)) {
            if let Some(kind) = self.foreign_declaration() {
                return kind;
            }
            if let Some(meant) = words::similar(word, words::RESERVED.iter().copied()) {
                let error = Diagnostic::error(span, format!("unknown word `{word}`"));
                self.fail(error.fix(format!("did you mean `{meant}`?"), span, meant));
                self.synchronize();
                return StmtKind::Empty;
            }
            if matches!(self.kind_at(start + 2), Kind::Semicolon | Kind::Assign | Kind::Comma) {
                let error = Diagnostic::error(span, format!("`{word}` is not a type of vv"));
                self.fail(error.hint("the types are `bool`, `int`, `double`, `vec`, `vertex`, `mesh` and `ring`"));
                self.synchronize();
                return StmtKind::Empty;
            }
        }
        self.expression_statement()
    }
}
