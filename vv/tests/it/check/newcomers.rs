//! What newcomers write, and what they are told to write: a part of the hint is enough.

use super::compiled;

#[track_caller]
fn check(text: &str, message: &str, hint: &str) {
    let c = compiled(text);
    let d = c.diagnostics.first().expect("a diagnostic");
    assert_eq!(d.message, message);
    assert!(d.hints.iter().any(|h| h.message.contains(hint)), "{:?}", d.hints);
    assert_eq!(c.diagnostics.len(), 1, "{:?}", c.diagnostics);
}

/// A statement in a rule, where `p` is a vertex, `n` a vec and `i` an int.
#[track_caller]
fn check_statement(statement: &str, message: &str, hint: &str) {
    check(&format!("edge {{ double len; }}; void f(mesh& S, vertex p, vec n, int i) {{ {statement} }}"), message, hint);
}

#[test]
fn functions_that_a_file_has_which_comes_with_vv() {
    for (file, function) in [
        ("insert.vv", "insert"),
        ("split.vv", "split"),
        ("solids.vv", "is_empty"),
        ("solids.vv", "tetrahedron"),
        ("solids.vv", "cube"),
        ("solids.vv", "octahedron"),
        ("solids.vv", "icosahedron"),
        ("solids.vv", "solid"),
        ("ptq.vv", "ptq"),
        ("ptt.vv", "ptt"),
        ("pqq.vv", "pqq"),
        ("dqq.vv", "dqq"),
    ] {
        let text = format!("void step(mesh& S) {{ {function}(S); }}");
        let message = format!("there is no function `{function}`");
        check(&text, &message, &format!("`#include \"{file}\"`"));
        let included = compiled(&format!("#include \"{file}\"\n{text}"));
        assert!(!included.diagnostics.iter().any(|d| d.message == message), "{file} has no {function}");
    }
}

#[test]
fn properties_of_faces() {
    let message = "only vertices, edges and meshes have properties";
    check("face { vec color; };", message, "at a vertex in its middle");
    check("faces { double area = 1; }; void step(mesh& S) { }", message, "computed from its corners");
}

#[test]
fn properties_that_are_vectors() {
    check_statement("p$color = n;", "vertices have no property `color`", "`vertex { vec color; };`");
    check_statement("p$heat = i;", "vertices have no property `heat`", "`vertex { double heat = 0; };`");
}

#[test]
fn edges_with_a_comma() {
    check_statement("print (p, any in p)$len;", "expected `|`, found `,`", "an edge is written `(p|q)`");
    check_statement("n = (1, 2, 3);", "expected `)`, found `,`", "`vec(x, y, z)`");
}

#[test]
fn functions_of_vertices_in_place_of_positions() {
    let hint = "of positions: `distance(p$pos, (any in p)$pos)`";
    check_statement("print distance(p, (any in p));", "`distance` does not take (vertex, vertex)", hint);
    check_statement("print cross(n, p);", "`cross` does not take (vec, vertex)", "`cross(n, p$pos)`");
}

#[test]
fn texts_that_are_joined() {
    let hint = "`print \"n is \", i;`";
    check_statement("print \"n is \" + i;", "texts cannot be joined", hint);
}

#[test]
fn numbers_added_to_vectors() {
    let hint = "`vec(i, i, i)`";
    check_statement("n = n + i;", "`+` does not work on a `vec` and an `int`", hint);
}

#[test]
fn sizes_of_meshes() {
    let hint = "`forall v in S n += 1;` those of a mesh";
    check_statement("print S.size();", "vv has no functions that belong to values", hint);
}

#[test]
fn old_meshes() {
    let message = "a mesh has no old members, its vertices have old rings and properties";
    check_statement("forall v in `S print v;", message, "the mesh as it is");
}

#[test]
fn properties_inside_functions() {
    let message = "properties are declared outside of functions";
    check_statement("vertex { double age; };", message, "move `vertex { … };` before the functions");
    check_statement("edge { double age; };", message, "move `edge { … };` before the functions");
    check_statement("mesh { int age; }", message, "move `mesh { … };` before the functions");
}

#[test]
fn rings_as_properties_and_values() {
    let hint = "`make r nb_of v;`";
    check_statement("print p$ring;", "vertices have no property `ring`", hint);
    check_statement("ring r = p; print r;", "this is a `vertex`, not a `ring`", "`ring r; forall x in p add x to r;`");
    check_statement("print any in neighbors(p);", "there is no function `neighbors`", "`forall q in p`");
}

#[test]
fn loops_and_numbers_of_other_languages() {
    check_statement("foreach (q in S) { print q; }", "vv loops over sets and rings with `forall`", "`forall p in S`");
    check_statement("double d = infinity; print d;", "`infinity` is not declared", "`1.0 / 0.0`");
    check_statement("i = inf; print i;", "`inf` is not declared", "ints have none");
    check_statement("print infinity();", "there is no function `infinity`", "`1.0 / 0.0`");
}

#[test]
fn functions_of_other_languages() {
    for (call, name, hint) in [
        ("n = mix(n, n, 0.5);", "mix", "`a + t * (b - a)`"),
        ("print cos(radians(i));", "radians", "`x * pi / 180.0`"),
        ("print sign(n.x);", "sign", "`x < 0.0 ? -1.0 : 1.0`"),
        ("print rand();", "rand", "`random()`"),
        ("print norm(n);", "norm", "`length(v)`"),
        ("merge(S, S);", "merge", "`merge S with T;`"),
        ("assert(i == 3);", "assert", "`if (!condition) print"),
    ] {
        check_statement(call, &format!("there is no function `{name}`"), hint);
    }
    check_statement("print M_PI;", "`M_PI` is not declared", "write `pi`");
    check_statement("forall e in edges print e;", "`edges` is not declared", "if (p < q) continue;");
    check_statement("n = vec(1, 2);", "`vec` does not take (int, int)", "`vec(x, y, 0)`");
    check_statement("print max(i, 2, 3);", "`max` does not take (int, int, int)", "`max(a, max(b, c))`");
    check_statement("print length(i);", "`length` does not take (int)", "`abs(x)`");
    check_statement("print length(n, n);", "`length` does not take (vec, vec)", "`distance(a, b)`");
}

#[test]
fn functions_that_belong_to_values() {
    let message = "vv has no functions that belong to values";
    check_statement("print p$pos.length();", message, "write `length(p$pos)`");
    check_statement("print n.dot(2.0 * n);", message, "write `dot(n, 2.0 * n)`");
    check_statement("print n.dot();", message, "write `dot(n)`");
    check_statement("print Math.sqrt(n.x);", message, "write `sqrt(n.x)`");
    check_statement("print n.normalized();", message, "write `normalize(n)`");
    check_statement("print n.dot(2.0", message, "write `dot(n");
}

#[test]
fn functions_whose_names_are_words_of_others() {
    let own = |call: &str| format!("void foreach(vertex p) {{ }} void assert(bool b) {{ }} step {{ {call} }}");
    let found = compiled(&own("forall p in S foreach(p); assert(true);")).diagnostics;
    assert!(found.is_empty(), "{found:?}");
    let message = "vv loops over sets and rings with `forall`";
    check(&own("foreach (p in S) print p;"), message, "write `forall p in S`");
    check(&own("foreach (vertex p : S) { print p; }"), message, "write `forall p in S`");
}

#[test]
fn rings_and_sets_that_are_mixed_up() {
    check_statement("remove p from p;", "this is a `vertex`, not a `mesh`", "write `erase p from p;`");
    check_statement("add p to p;", "this is a `vertex`, not a `mesh`", "`splice p after a in p;`");
    let message = "one vertex stands here, and the list before it";
    check_statement("make p nb_of {p};", message, "write `make {a, b, c} nb_of v`");
    check_statement("make {p} nb of {p};", message, "write `make {a, b, c} nb_of v`");
}

#[test]
fn questions_in_other_words() {
    check_statement("if (p is in S) print p;", "expected `)`, found `is`", "`is x in v`");
    check_statement("if (p not in S) print p;", "expected `)`, found `not`", "`!is x in v` denies it");
    check_statement("if (p is null) print p;", "expected `)`, found `is`", "compare with `==`");
    check_statement("elif (i == 3) { print p; }", "`elif (…) {` begins no statement", "write `else if`");
    check_statement("Print \"p\";", "unknown word `Print`", "did you mean `print`?");
}
