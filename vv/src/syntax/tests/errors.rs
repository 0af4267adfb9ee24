//! Mistakes and what is said about them. Below a line stands what is reported there:
//! `// ^^^ error: message | hint | hint`. What is not announced must not come, what is announced must.

mod declarations;
mod foreign;
mod lexical;
mod punctuation;
mod words;

use super::mended;
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::{FileId, Sources};
use crate::syntax::parse;

/// One message: line and column (from 0), length in characters (on its first line), and what is said.
type Said = (usize, usize, usize, String);

fn announced(text: &str) -> Vec<Said> {
    let mut said = Vec::new();
    let mut target = 0;
    for (number, line) in text.lines().enumerate() {
        let marks = line.trim_start().strip_prefix("//").map(str::trim_start).filter(|rest| rest.starts_with('^'));
        let Some(marks) = marks else {
            target = number;
            continue;
        };
        let message = marks.trim_start_matches('^');
        let column = line.chars().count() - marks.chars().count();
        said.push((target, column, marks.len() - message.len(), message.trim().to_owned()));
    }
    said.sort();
    said
}

fn reported(text: &str, diagnostics: &[Diagnostic]) -> Vec<Said> {
    let mut sources = Sources::default();
    sources.add("test.vv", text);
    let lines: Vec<&str> = text.lines().collect();
    let said = diagnostics.iter().map(|d| {
        let (_, start, end) = d.span.and_then(|span| sources.locate(span)).expect("a place");
        let (line, column) = (start.line as usize - 1, start.column as usize - 1);
        let last = if end.line == start.line { end.column as usize - 1 } else { lines[line].chars().count() };
        let severity = match d.severity {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        let hints = d.hints.iter().map(|hint| format!(" | {}", hint.message)).collect::<String>();
        (line, column, (last - column).max(1), format!("{severity}: {}{hints}", d.message))
    });
    let mut said: Vec<_> = said.collect();
    said.sort();
    said
}

/// The text with what is reported, as it would have to be announced.
fn annotated(text: &str, said: &[Said]) -> String {
    let is_mark = |line: &str| line.trim_start().strip_prefix("//").is_some_and(|l| l.trim_start().starts_with('^'));
    let mut result = String::new();
    for (number, line) in text.lines().enumerate().filter(|(_, line)| !is_mark(line)) {
        result.push_str(line);
        result.push('\n');
        for (_, column, length, message) in said.iter().filter(|s| s.0 == number) {
            let indent = line.len() - line.trim_start().len();
            let indent = indent.min(column.saturating_sub(2));
            result.push_str(&format!(
                "{}//{}{} {message}\n",
                " ".repeat(indent),
                " ".repeat(column.saturating_sub(indent + 2)),
                "^".repeat(*length)
            ));
        }
    }
    result
}

/// The statements of a function.
#[track_caller]
fn check(text: &str) {
    check_file(&format!("    void f(mesh& S) {{{text}}}"));
}

#[track_caller]
fn check_file(text: &str) {
    let (_, diagnostics) = parse(FileId::MAIN, text);
    let said = reported(text, &diagnostics);
    assert!(announced(text) == said, "what is reported:\n{}", annotated(text, &said));
}

/// What the hints make of a mistaken text, which must then be free of errors.
#[track_caller]
fn check_fix(text: &str, expected: &str) {
    let whole = format!("void f(mesh& S) {{ {text} }}");
    let (_, diagnostics) = parse(FileId::MAIN, &whole);
    assert!(!diagnostics.is_empty(), "nothing is wrong with {text:?}");
    let mended = mended(&whole, &diagnostics);
    assert_eq!(mended, format!("void f(mesh& S) {{ {expected} }}"));
    super::statements(expected);
}

#[test]
fn hints_carry_the_edit_that_mends() {
    check_fix("a = b\n c = d;", "a = b;\n c = d;");
    check_fix("a = (b + c;", "a = (b + c);");
    check_fix("make {a, b nb_of x;", "make {a, b} nb_of x;");
    check_fix("merge Swith T;", "merge S with T;");
    check_fix("merge S withT;", "merge S with T;");
    check_fix("merge S and T;", "merge S with T;");
    check_fix("addx to S;", "add x to S;");
    check_fix("x = nextot q in p;", "x = nextto q in p;");
    check_fix("forll p in S { }", "forall p in S { }");
    check_fix("forall vertex p in S { }", "forall p in S { }");
    check_fix("parallel for p in S { }", "parallel forall p in S { }");
    check_fix("parallel foreach p in S { }", "parallel forall p in S { }");
    check_fix("parallel p in S { }", "parallel forall p in S { }");
    check_fix("if (a = b) c;", "if (a == b) c;");
    check_fix("if (a); { b; }", "if (a) { b; }");
    check_fix("double x == 3;", "double x = 3;");
    check_fix("a = b and not c;", "a = b && ! c;");
    check_fix("a = 1.0f ≤ 2;", "a = 1.0 <= 2;");
    check_fix("a = (double)n / (int)(b + c);", "a = double(n) / int(b + c);");
    check_fix("float x; auto v = any in p;", "double x; vertex v = any in p;");
    check_fix("a = p->pos;", "a = p$pos;");
    check_fix("a = std::sqrt(2.0);", "a = sqrt(2.0);");
    check_fix("vertex& q = NULL;", "vertex q = null;");
    check_fix("vec v = (1, 2, 3), w;", "vec v = vec(1, 2, 3), w;");
    check_fix("vertex v = any p;", "vertex v = any in p;");
    check_fix("print \"text;\n", "print \"text\";\n");
}

#[test]
fn hints_mend_directives() {
    let check = |text: &str, expected: &str| {
        let mended = mended(text, &parse(FileId::MAIN, text).1);
        assert_eq!(mended, expected);
        assert!(parse(FileId::MAIN, &mended).1.is_empty());
    };
    check("#include \"a.vv\"param int n = 1;\n", "#include \"a.vv\"\nparam int n = 1;\n");
    check("#include \"a.vv\"   #include \"b.vv\"\n", "#include \"a.vv\"\n#include \"b.vv\"\n");
    check("#include  insert.vv\nvoid f() { }\n", "#include \"insert.vv\"\nvoid f() { }\n");
    check("#pragma once\nvoid f() { }\n", "\nvoid f() { }\n");
}

/// The tree of a mended text is that of what was meant.
#[test]
fn mended_mistakes_are_read_as_meant() {
    for (mistaken, meant) in [
        ("a = b\n c = d;", "a = b;\n c = d;"),
        ("merge Swith T;", "merge S with T;"),
        ("x = nextot q in p;", "x = nextto q in p;"),
        ("for (vertex p : S) { a; }", "forall p in S { a; }"),
        ("float x = (double)n;", "double x = double(n);"),
        ("make {a, b nb_of x;", "make {a, b} nb_of x;"),
    ] {
        let (ast, diagnostics) = parse(FileId::MAIN, &format!("void f() {{ {mistaken} }}"));
        assert!(!diagnostics.is_empty(), "{mistaken}");
        assert_eq!(super::sexpr::ast(&ast), super::tree(&format!("void f() {{ {meant} }}")));
    }
}

/// Later parts of a program stay readable, so that names declared in a broken statement are not unknown.
#[test]
fn what_was_read_before_a_mistake_stays() {
    let (ast, diagnostics) =
        parse(FileId::MAIN, "void f(mesh S&) { vertex x = insert(p q), y; forall p in ) { a; } b; }");
    assert_eq!(diagnostics.len(), 3);
    assert_eq!(super::sexpr::ast(&ast), "(fn void f (mesh S) (vertex (= x <error>) y) (forall p <error> (block a)) b)");
}
