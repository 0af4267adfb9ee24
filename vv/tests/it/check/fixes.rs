//! Edits that hints offer.

use super::compiled;

/// Carries out the first edit that the first diagnostic offers; what comes out checks without a word.
#[track_caller]
fn check(before: &str, after: &str) {
    let c = compiled(before);
    let d = c.diagnostics.first().expect("a diagnostic");
    let (span, replacement) = d.hints.iter().find_map(|h| h.edit.clone()).expect("a fix");
    let mut text = before.to_owned();
    text.replace_range(span.start as usize..span.end as usize, &replacement);
    assert_eq!(text, after, "{:?}", d.hints);
    let c = compiled(after);
    assert!(c.diagnostics.is_empty(), "{:?}", c.diagnostics);
}

/// The same with a statement in a rule, where `p` and `q` are vertices, `x` a double, `i` an int and `n` a vec.
#[track_caller]
fn check_statement(before: &str, after: &str) {
    let program = |statement: &str| {
        format!(
            "vertex {{ double age; }};
             void f(mesh& S, vertex p, vertex q, double x, int i, vec n) {{ synchronize S; {statement} }}"
        )
    };
    check(&program(before), &program(after));
}

#[test]
fn a_wrong_ring_becomes_that_of_the_loop() {
    let listing = |ring: &str| {
        format!(
            "void loop(mesh& S) {{
               forall x in S {{
                 vertex p = any in x;
                 vertex q = nextto p in {ring};
                 make {{nextto x in q, q, prevto x in q, nextto x in p, p, prevto x in p}} nb_of x;
               }}
             }}"
        )
    };
    check(&listing("v"), &listing("x"));
    // That of the loop, though another was declared after it.
    let erased =
        |ring: &str| format!("void f(mesh& S) {{ forall p in S {{ vertex q = any in p; erase q from {ring}; }} }}");
    check(&erased("unknown"), &erased("p"));
}

#[test]
fn mistyped_names() {
    check_statement("double weight = 1; print wieght;", "double weight = 1; print weight;");
    check_statement("print tua, x;", "print tau, x;");
    check_statement("print lenght(n);", "print length(n);");
    check_statement("forall v in s print v;", "forall v in S print v;");
}

#[test]
fn mistyped_properties() {
    check_statement("p$aeg = 1;", "p$age = 1;");
    check_statement("p$position = n;", "p$pos = n;");
}

#[test]
fn points_for_dollars() {
    check_statement("p.age = 1;", "p$age = 1;");
    check_statement("p.x = 1;", "p$pos.x = 1;");
    check_statement("n = p.pos;", "n = p$pos;");
    check_statement("n = p;", "n = p$pos;");
}

#[test]
fn zero_for_null() {
    check_statement("p = 0;", "p = null;");
    check_statement("if (p == 0) print 1;", "if (p == null) print 1;");
    check_statement("n = 0;", "n = vec(0, 0, 0);");
}

#[test]
fn divisions_of_ints() {
    check_statement("x = 1/2;", "x = 1.0/2.0;");
    check_statement("x = x / (1/2);", "x = x / (1.0/2.0);");
    check_statement("x = 1 / i;", "x = 1.0 / i;");
    check_statement("x = i / 2;", "x = i / 2.0;");
    check_statement("x = i / i;", "x = double(i) / i;");
    check_statement("x = valence p / 2;", "x = valence p / 2.0;");
}

#[test]
fn fractions() {
    check_statement("i = x * 2;", "i = int(x * 2);");
    check_statement("print x % 2;", "print fmod(x, 2);");
}

#[test]
fn old_values() {
    check_statement("p = `q;", "p = q;");
    check_statement("`p$pos = n;", "p$pos = n;");
    check_statement("erase p from `q;", "erase p from q;");
    check_statement("forall v in `S print v;", "forall v in S print v;");
}

#[test]
fn created_vertices() {
    check_statement("vertex v; v = p; print v;", "vertex v = null; v = p; print v;");
}

#[test]
fn constants() {
    check("double k = 1; void f(mesh& S) { print k; }", "const double k = 1; void f(mesh& S) { print k; }");
}

#[test]
fn steps() {
    check("void f(mesh S) { forall p in S print p; }", "void f(mesh& S) { forall p in S print p; }");
}
