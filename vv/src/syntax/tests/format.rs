//! Layout as a specification: text in, text out.

use proptest::prelude::*;

use super::listings::ALL;
use super::{mended, sexpr};
use crate::source::FileId;
use crate::syntax::lexer::{Kind, lex};
use crate::syntax::{format, parse};

#[track_caller]
fn check(text: &str, expected: &str) {
    let formatted = format(text).unwrap_or_else(|diagnostics| panic!("{}", super::render(text, &diagnostics)));
    assert_eq!(formatted, expected, "\n{formatted}");
    assert_eq!(format(&formatted).as_deref(), Ok(expected), "again");
}

/// Statements in a function.
#[track_caller]
fn inside(text: &str, expected: &str) {
    let indented: String =
        expected.lines().map(|l| if l.is_empty() { "\n".to_owned() } else { format!("  {l}\n") }).collect();
    check(&format!("void f() {{\n{text}\n}}"), &format!("void f() {{\n{indented}}}\n"));
}

#[test]
fn statements_stand_two_deeper_than_what_they_belong_to() {
    check(
        "void f(mesh &S){\nforall p in S{\nif(p<q) continue ;\n      else {\nx=1;}\n}\n}",
        "void f(mesh& S) {\n  forall p in S {\n    if (p < q) continue;\n    else {\n      x = 1; }\n  }\n}\n",
    );
    inside("if (a)\nb = 1;\nelse\nb = 2;", "if (a)\n  b = 1;\nelse\n  b = 2;");
    inside(
        "if (a) {\nb = 1;\n} else if (c) {\nb = 2;\n} else {\nb = 3;\n}",
        "if (a) {\n  b = 1;\n} else if (c) {\n  b = 2;\n} else {\n  b = 3;\n}",
    );
    inside(
        "forall p in S forall q in p\nif (p < q)\nprint p;",
        "forall p in S forall q in p\n  if (p < q)\n    print p;",
    );
    inside("while (a)\n{\nb = 1;\n}", "while (a)\n{\n  b = 1;\n}");
    inside("do {\na = 1;\n}\nwhile (a < 2);", "do {\n  a = 1;\n}\nwhile (a < 2);");
    inside("{\na = 1;\n}", "{\n  a = 1;\n}");
}

#[test]
fn a_line_that_goes_on_stands_in_its_bracket_or_four_deeper() {
    inside(
        "make {nextto x in q, q,\nprevto x in q,\np} nb_of x;",
        "make {nextto x in q, q,\n      prevto x in q,\n      p} nb_of x;",
    );
    inside("x = a +\nb\n+ c;\nf(a)\n+ b;\nx=\na;", "x = a +\n    b\n  + c;\nf(a)\n    + b;\nx =\n    a;");
    inside("double w = 5.0\n- a;", "double w = 5.0\n         - a;");
    inside("x = f(\na,\nb\n);", "x = f(\n  a,\n  b\n);");
}

#[test]
fn items_stand_at_the_margin() {
    check(
        "  #include   \"a.vv\"\n\n\n\n  param   double w=0.5 in[0,1];\n const int n=3;\n vertex{double age=0;\nint kind;\n};\n static void f(){}\n step{\n}\n",
        "#include \"a.vv\"\n\nparam double w = 0.5 in [0, 1];\nconst int n = 3;\nvertex { double age = 0;\n  int kind;\n};\nstatic void f() { }\nstep {\n}\n",
    );
}

#[test]
fn spaces_stand_where_signs_need_them() {
    inside("x=-a- -b+ ++c--;", "x = -a - -b + ++c--;");
    inside("x = 1.0/16.0*a + b /c;", "x = 1.0/16.0*a + b / c;");
    inside("(p | q) $ sharpness/=2;", "(p|q)$sharpness /= 2;");
    inside("x$pos=` p $pos +`( nextto q in `p )$pos . x;", "x$pos = `p$pos + `(nextto q in `p)$pos.x;");
    inside("for(int i=0;i<n;++i) print( i,\"  a\" );", "for (int i = 0; i < n; ++i) print(i, \"  a\");");
    inside("forall x in p(p|x)$sharpness=1;", "forall x in p (p|x)$sharpness = 1;");
    inside("return(a)?b:! c;", "return (a) ? b : !c;");
    inside("make{ p,q }nb_of x;make {} nb_of y;{}", "make {p, q} nb_of x; make {} nb_of y; { }");
    inside("vec v=vec (1,2,3);int i=int(2.5);", "vec v = vec(1, 2, 3); int i = int(2.5);");
    inside("if (! is null in x&&a||b) {}", "if (!is null in x && a || b) { }");
}

#[test]
fn comments_stay_and_stand_with_what_they_speak_of() {
    check(
        "//  a  \n\n/* b\n   c */\nvoid f() {\n// d\nx = 1;// e\ny = 22; // f\n// g\n}\n// h",
        "//  a\n\n/* b\n   c */\nvoid f() {\n  // d\n  x = 1; // e\n  y = 22; // f\n  // g\n}\n// h\n",
    );
    inside(
        "x = 1;      // one\nyyy = 2;    // two\nz = a /* b */ + c;",
        "x = 1;      // one\nyyy = 2;    // two\nz = a /* b */ + c;",
    );
    inside("x=1;   // one\nyy=2;  // two", "x = 1;   // one\nyy = 2;  // two");
}

#[test]
fn empty_lines_stand_alone_and_ends_are_bare() {
    check("\n\n\nvoid f() { }  \r\n\r\n\r\n\r\nvoid g() { }\n\n", "void f() { }\n\nvoid g() { }\n");
    check("", "");
    check("// only this", "// only this\n");
}

#[test]
fn a_listing_from_the_paper_becomes_a_program() {
    check(
        "1 void f(mesh& S) {\n2 synchronize S;\n3 forall q in ‘p {\n4 x$pos = 1.0 − ‘p$pos ∗ w;\n5 }\n6 }\n",
        "void f(mesh& S) {\n  synchronize S;\n  forall q in `p {\n    x$pos = 1.0 - `p$pos * w;\n  }\n}\n",
    );
}

#[test]
fn a_text_with_errors_is_left_alone() {
    let diagnostics = format("void f() { x = ; }").unwrap_err();
    assert_eq!(diagnostics.len(), 1);
}

/// What may not change: the tokens with their lines, the comments.
fn sense(text: &str) -> (Vec<(Kind, String, bool)>, Vec<String>) {
    let lexed = lex(FileId::MAIN, text);
    let of = |start: u32, end: u32| text[start as usize..end as usize].to_owned();
    let tokens = lexed.tokens.iter().filter(|t| t.kind != Kind::End).map(|t| {
        let word = matches!(t.kind, Kind::Word | Kind::Int | Kind::Double | Kind::Text);
        (t.kind, if word { of(t.start, t.end) } else { String::new() }, t.new_line)
    });
    let comments = lexed.skipped.iter().map(|s| of(s.start, s.end)).filter(|c| c.starts_with('/'));
    (tokens.collect(), comments.map(|c| c.trim_end().to_owned()).collect())
}

fn keeps_sense(text: &str) -> Result<(), TestCaseError> {
    let Ok(formatted) = format(text) else { return Ok(()) };
    prop_assert_eq!(sense(&formatted), sense(text), "{}\n{}", text, formatted);
    let tree = |text| sexpr::ast(&parse(FileId::MAIN, text).0);
    prop_assert_eq!(tree(&formatted), tree(text));
    let again = format(&formatted);
    prop_assert_eq!(again.as_deref(), Ok(formatted.as_str()), "{}", text);
    Ok(())
}

/// Texts whose white space, comments and line ends are about to be stirred.
fn texts() -> Vec<String> {
    let mut texts: Vec<String> = ALL.iter().map(|text| mended(text, &parse(FileId::MAIN, text).1)).collect();
    texts.push(
        "#include \"a.vv\"\nparam double w = 1.0/16.0 in [-1, 0.5e-3];\nvertex { double age = 0; int kind; };\n\
         static int g(const vertex& p, int n) { return n > 0 ? -n-- : +n - -1 - - - 1; }\nstep {\n  do { if (!a) b -= 1; else if (c) { } \
         else d++; } while (a && b || `(p|q)$s.x < 2 / 3%4); // end\n  for (;;) { break; }\n  make {nextto x in q, q} nb_of x; \
         splice null after a in v; print \"a  b\", -1 . x;\n}\n"
            .to_owned(),
    );
    texts
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    #[test]
    fn layout_never_changes_the_sense(which in 0..6_usize, seeds in prop::collection::vec(0..40_u8, 1..400)) {
        let text = &texts()[which];
        let lexed = lex(FileId::MAIN, text);
        let mut stirred = String::new();
        for (i, token) in lexed.tokens.iter().enumerate() {
            stirred.push_str(match seeds[i % seeds.len()] {
                0 | 1 => "\n",
                2 => "\n\n\n   ",
                3 => " // words\n",
                4 => "  /* more\n words */",
                5 => "\t",
                6 => "\r\n\r\n",
                7..15 => "",
                _ => " ",
            });
            stirred.push_str(&text[token.start as usize..token.end as usize]);
        }
        keeps_sense(&stirred)?;
    }

    #[test]
    fn no_text_loses_its_sense(text in super::robust::soup()) {
        keeps_sense(&text)?;
        keeps_sense(&format!("void f() {{ {text} }}"))?;
    }
}
