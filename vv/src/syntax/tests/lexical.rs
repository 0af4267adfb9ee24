//! Tokens: what the printed page and other keyboards give, line numbers, and colours.

use super::{statements, tree};
use crate::source::FileId;
use crate::syntax::{TokenClass, highlight, parse};

#[track_caller]
fn check(text: &str, expected: &str) {
    assert_eq!(statements(text), expected);
}

#[test]
fn signs_of_the_printed_page() {
    check("x = −a – b ∗ c ‖ d;", "(= x (|| (- (- a) (* b c)) d))");
    check("x −= 1; x ∗= 2; x−−; −−x;", "(-= x 1) (*= x 2) (post-- x) (-- x)");
    check("x = 1.5e−3;", "(= x 0.0015)");
    check("print “text”;", "(print \"text\")");
}

#[test]
fn spaces_of_any_kind() {
    check("x\u{a0}=\u{2003}1\u{200b};\r\n\u{feff}y\t=\u{0}2;", "(= x 1) (= y 2)");
    assert_eq!(tree("\u{feff}void f() { }\r\n"), "(fn void f ())");
}

#[test]
fn comments() {
    check("a; // b; /* c\n d; /* e; // */ f; /**/ g; /* * / **/ h;", "a d f g h");
    check("a /* in */ = /* between\n */ b;", "(= a b)");
    assert_eq!(tree("// the end"), "");
}

#[test]
fn strings() {
    check(r#"print "a\n\t\"\\", "// no comment", "";"#, r#"(print "a\n\t\"\\" "// no comment" "")"#);
}

#[test]
fn names() {
    check("_x1 = αβ + p2;", "(= _x1 (+ αβ p2))");
}

/// Numbers in front of lines go only where they are the numbers of lines.
mod line_numbers {
    use super::*;

    #[track_caller]
    fn skipped(text: &str, expected: &[&str]) {
        let (_, diagnostics) = parse(FileId::MAIN, text);
        let messages: Vec<_> = diagnostics.iter().map(|d| d.message.as_str()).collect();
        let note = "skipped the line numbers of a listing pasted from print";
        let expected_messages: &[&str] = if expected.is_empty() { &[] } else { &[note] };
        assert_eq!(messages, expected_messages, "{text}");
        let classes = highlight(text).into_iter();
        let found: Vec<_> =
            classes.filter(|(_, class)| *class == TokenClass::Comment).map(|(range, _)| &text[range]).collect();
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn of_listings() {
        skipped("1 void f() {\n2 x = 1;\n3\n4 }", &["1", "2", "3", "4"]);
        skipped("\n\n  1 void f() {\n\n 2   x =\n 3 1;\n\n 4 }\n", &["1", "2", "3", "4"]);
        skipped("1 void f() { }", &["1"]);
    }

    #[test]
    fn of_a_part_of_a_listing() {
        skipped("void f() {\n9 x = 1;\n10 y = 2;\n11 z = 3;\n}", &["9", "10", "11"]);
        skipped("27 void f() {\n28 }", &["27", "28"]);
    }

    #[test]
    fn of_lines_that_were_broken() {
        skipped("1 void f() {\n2 x = 1\n+ 2;\n3 }", &["1", "2", "3"]);
        skipped("1 void f() {\n2 x =\n2 * y;\n3 }", &["1", "2", "3"]);
    }

    #[test]
    fn of_two_listings() {
        skipped("1 void f() {\n2 }\n1 void g() {\n2 }", &["1", "2", "1", "2"]);
    }

    #[test]
    fn not_numbers_of_the_program() {
        skipped("void f() {\nx = 1\n+\n2 * y;\n}", &[]);
        skipped("void f() {\nx = vec(\n1 + a,\n2 + b,\n3 + c);\n}", &[]);
        skipped("void f() {\nmake {p,\n q} nb_of\n x;\n}", &[]);
        assert_eq!(statements("x = vec(\n1 + a,\n2 + b,\n3 + c);"), "(= x (call vec (+ 1 a) (+ 2 b) (+ 3 c)))");
        assert_eq!(
            tree("1 void f() {\n2 x = 2 * 3\n3 + 4 *\n7 * y;\n4 }"),
            "(fn void f () (= x (+ (* 2 3) (* (* 4 7) y))))"
        );
    }

    #[test]
    fn not_inside_comments() {
        let text = "/*\n1 one;\n2 two;\n*/\nvoid f() { }";
        assert!(parse(FileId::MAIN, text).1.is_empty());
    }
}

/// Each token as `text:class`.
#[track_caller]
fn classes(text: &str, expected: &str) {
    let classes = highlight(text).into_iter();
    let shown = classes.map(|(range, class)| format!("{}:{}", &text[range], format!("{class:?}").to_lowercase()));
    let shown: Vec<_> = shown.filter(|s| !s.ends_with(":punctuation")).collect();
    assert_eq!(shown.join(" "), expected);
}

#[test]
fn colours() {
    classes(
        "void f(mesh& S) { if (tau < 1.5) return; }",
        "void:type f:function mesh:type S:name if:keyword tau:literal 1.5:literal return:keyword",
    );
    classes("#include \"a.vv\" // b", "#:directive include:directive \"a.vv\":text // b:comment");
    classes(
        "step { forall q in `p x$pos = null; }",
        "step:algebra forall:algebra q:name in:algebra `:old p:name x:name $:property pos:property null:literal",
    );
    classes(
        "param double w = 1 in [0, 1];",
        "param:algebra double:type w:name 1:literal in:algebra 0:literal 1:literal",
    );
    classes(
        "void f() { make {nextto x in q} nb of x; }",
        "void:type f:function make:algebra nextto:algebra x:name in:algebra q:name nb:algebra of:algebra x:name",
    );
    classes(
        "void f(ring r) { forall f in faces S forall p, q in f from a, b make r nb_of p; }",
        "void:type f:function ring:type r:name forall:algebra f:name in:algebra faces:algebra S:name forall:algebra \
         p:name q:name in:algebra f:name from:algebra a:name b:name make:algebra r:name nb_of:algebra p:name",
    );
    classes("void f() { @ }", "void:type f:function @:error");
}

/// A word of the algebra is coloured as one only where it is one.
#[test]
fn colours_of_words_that_are_names() {
    classes(
        "void f() { point in; point = any in in + step(add); }",
        "void:type f:function point:type in:name point:name any:algebra in:algebra in:name step:function add:name",
    );
    classes(
        "void f() { ring ring; forall from in faces { ring = from; } }",
        "void:type f:function ring:type ring:name forall:algebra from:name in:algebra faces:name ring:name from:name",
    );
}

/// While a program is being typed the rest keeps its colours.
#[test]
fn colours_of_half_written_text() {
    classes("void f( { forall p in", "void:type f:function forall:algebra p:name in:algebra");
    classes("void f() { x = nextto\nreturn x; }", "void:type f:function x:name nextto:name return:keyword x:name");
    classes("print \"abc", "print:name \"abc:text");
    classes("vertex v; /* abc", "vertex:type v:name /* abc:comment");
}
