use super::*;

const PROGRAM: &str = "\
#include \"insert.vv\"
// How far it rises.
param double lift = 0.5 in [0, 2];
vertex { int born = 0; };
edge { double sharpness; };
mesh { int generation; };
// Makes the surface finer.
// Twice.
void refine(mesh& S, int times) {
  mesh NV;
  forall p in S {
    double here = lift;
    p$born = S$generation;
    forall q in `p (p|q)$sharpness = here;
  }
}
";

/// Completes at `|`, which is taken out; shows the labels.
#[track_caller]
fn complete(text: &str) -> Vec<String> {
    let at = text.find('¦').expect("a place");
    let text = text.replace('¦', "");
    let assist = Assist::new(text, ["vertex insert(vertex p, vertex q) { vertex x; return x; }"]);
    assist.complete(at).entries.into_iter().map(|e| e.label).collect()
}

fn within(line: &str) -> Vec<String> {
    complete(&PROGRAM.replace("    double here = lift;\n", &format!("    double here = lift;\n    {line}\n")))
}

#[test]
fn names_in_reach_come_first() {
    let all = within("¦");
    assert_eq!(all[..4], ["here", "p", "NV", "times"], "{all:?}");
    assert!(!all.contains(&"q".to_owned()), "not in its loop");
    assert_eq!(within("x = nex¦"), ["nextto"]);
    assert_eq!(within("ins¦"), ["insert"]);
    assert_eq!(within("ti¦"), ["times"]);
    assert_eq!(complete("int late; void f() { l¦ int later; }")[..1], ["late"]);
}

#[test]
fn properties_are_those_of_what_has_them() {
    assert_eq!(within("p$¦"), ["pos", "born"]);
    assert_eq!(within("`p$b¦"), ["born"]);
    assert_eq!(within("S$¦"), ["generation"]);
    assert_eq!(within("(p|q)$¦"), ["sharpness"]);
    assert_eq!(within("p$pos.¦"), ["x", "y", "z"]);
}

#[test]
fn statements_are_offered_where_they_can_begin() {
    assert_eq!(within("for¦"), ["for", "forall"], "what is written out already comes first");
    assert_eq!(within("x = for¦"), [""; 0]);
    assert_eq!(within("if (a) sy¦"), ["synchronize", "synchronise"]);
}

#[test]
fn nothing_is_offered_in_texts_comments_and_numbers() {
    for line in ["// fo¦", "print \"fo¦\";", "x = 1.5e¦;", "/* fo¦ */"] {
        assert_eq!(within(line), [""; 0], "{line}");
    }
}

#[test]
fn a_word_that_is_written_out_is_not_offered() {
    assert_eq!(within("synchronize¦"), [""; 0]);
}

/// What the word at `¦` means: usage, then doc.
#[track_caller]
fn means(at: &str, usage: &str, doc: &str) {
    let word = at.replace('¦', "");
    let at = PROGRAM.find(&word).expect("in the program") + at.find('¦').expect("a place");
    let meaning = Assist::new(PROGRAM, []).meaning(at).expect("a meaning");
    assert_eq!((meaning.usage.as_str(), meaning.doc.as_str()), (usage, doc));
}

#[test]
fn words_are_explained() {
    means("¦lift;", "param double lift = 0.5 in [0, 2]", "How far it rises.");
    means("¦refine", "void refine(mesh& S, int times)", "Makes the surface finer. Twice.");
    means("p¦$born", "int born = 0 of every vertex", "");
    means("¦NV", "mesh NV", "");
    means("¦p$born", "vertex p", "the vertex that the loop is at");
    means("forall q in `¦p", "vertex p", "the vertex that the loop is at");
    let text = "void f() { double x = pow(tau, 2); }";
    let meaning = |word| Assist::new(text, []).meaning(text.find(word).expect("there")).map(|m| m.usage);
    assert_eq!(meaning("pow"), Some("double pow(double base, double exponent)".to_owned()));
    assert_eq!(meaning("tau"), Some("double tau = 6.283185307179586".to_owned()));
    assert_eq!(meaning("2"), None);
}

#[test]
fn names_lead_to_their_declarations() {
    let assist = Assist::new(PROGRAM, []);
    let at = PROGRAM.find("= here").expect("there") + 2;
    let declared = assist.declaration(at).expect("declared");
    assert_eq!(&PROGRAM[declared.start - 7..declared.end], "double here");
}

#[test]
fn brackets_belong_together() {
    let text = "f(a[1], \")\") }";
    let assist = Assist::new(text, []);
    assert_eq!(assist.brackets(1), Some([1..2, 11..12]));
    assert_eq!(assist.brackets(12), Some([1..2, 11..12]));
    assert_eq!(assist.brackets(4), Some([3..4, 5..6]));
    assert_eq!(assist.brackets(14), Some([13..14, 13..14]), "alone");
    assert_eq!(assist.brackets(9), None, "in a text");
}

#[track_caller]
fn moved(text: &str, units: i64, expected: &str) {
    let at = text.find('¦').expect("a place");
    let text = text.replace('¦', "");
    let number = number_at(&text, at).expect("a number");
    let result = format!("{}{}{}", &text[..number.range.start], number.moved(units), &text[number.range.end..]);
    assert_eq!(result, expected);
}

#[test]
fn numbers_move_by_their_last_digit() {
    moved("x = ¦1.25;", 3, "x = 1.28;");
    moved("x = 0.0¦5;", -6, "x = -0.01;");
    moved("x = -0¦.01;", 3, "x = 0.02;");
    moved("x = 9¦;", 1, "x = 10;");
    moved("x = 2¦.;", 1, "x = 2.1;");
    moved("x = 1.5¦e-3;", 1, "x = 1.6e-3;");
    moved("x = a-1¦;", -3, "x = a-0;");
    moved("x = a - 1¦;", -3, "x = a - -2;");
    assert_eq!(number_at("x = p1;", 6), None);
    assert_eq!(number_at("99999999999999999999", 1), None);
}

#[test]
fn every_word_of_the_language_is_explained() {
    for word in crate::syntax::all_words() {
        assert!(words::find(word).is_some(), "`{word}` is not explained");
    }
}

/// Where the program names what the word at `¦` names, each as its line from there on.
#[track_caller]
fn used(text: &str, expected: &[&str]) {
    let at = text.find('¦').expect("a place");
    let text = text.replace('¦', "");
    let assist = Assist::new(text.as_str(), []);
    let uses = assist.symbol_at(at).map(|(_, symbol)| assist.uses(symbol)).unwrap_or_default();
    let found: Vec<&str> = uses.iter().map(|r| text[r.start..].lines().next().unwrap_or_default()).collect();
    assert_eq!(found, expected);
}

#[test]
fn a_name_is_found_wherever_it_means_the_same() {
    used("int ¦a = 1;\nint f(int a) { return a; }\nint g() { return\na; }", &["a = 1;", "a; }"]);
    used("int a = 1;\nint f(int ¦a) { return\na; }\nint g() { return a; }", &["a) { return", "a; }"]);
    used("int ¦f();\nint f() { return f(); }", &["f();", "f() { return f(); }", "f(); }"]);
    used("double x¦ = 1;\nvoid f(vec p) { p.x = x; }", &["x = 1;", "x; }"]);
    used("vertex { int n; };\nmesh { int n; };\nvoid f(mesh& S) { forall v in S v$¦n =\nS$n; }", &["n; };", "n ="]);
    used("void f() { ¦sin(1); }", &[]);
}
