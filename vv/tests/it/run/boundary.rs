//! The boundary: gaps in rings, and `null` as an operand.

use super::{SQUARE, check, check_body, check_ring};

#[test]
fn a_gap_is_no_neighbour() {
    check_body(
        "make {a, b, null} nb_of f; forall x in f print x; print gaps f, valence f, any in f;",
        "v1
         v2
         12v1",
    );
    check_body("make {null} nb_of f; print gaps f, valence f, any in f, is null in f;", "00nullfalse");
    check_body("make {a, null, b, null} nb_of f; print gaps f, valence f;", "22");
}

#[test]
fn a_ring_starts_after_its_first_gap_and_has_no_two_side_by_side() {
    check_ring("null, a, b", "", "v1 v2 -");
    check_ring("a, null, b", "", "v2 v1 -");
    check_ring("a, null, null, b", "", "v2 v1 -");
    check_ring("null, a, null", "", "v1 -");
    check_ring("null, null", "", "");
    check_ring("a, null, b, null", "", "v1 - v2 -");
    check_ring("a, null, b, null", "erase a from f", "v2 -");
}

#[test]
fn edits_with_the_word_null() {
    check_ring("a, b", "splice null after a in f", "v2 v1 -");
    check_ring("a, b", "splice null before a in f", "v1 v2 -");
    check_ring("a, b, null", "splice null after b in f", "v1 v2 -");
    check_ring("a, b, null", "erase null from f", "v1 v2");
    check_ring("a, b, c", "replace b with null in f", "v3 v1 -");
    check_ring("a, b, null", "replace null with c in f", "v1 v2 v3");
    check_ring("a, b, null", "replace null with null in f", "v1 v2 -");
    check_ring("a, b, null", "splice c after null in f", "v3 v1 v2 -");
    check_ring("a, b, null", "splice c before null in f", "v1 v2 v3 -");
    check_ring("a, b", "erase null from f", "v1 v2");
    check_ring("a, b", "replace null with c in f", "v1 v2");
}

#[test]
fn look_ups_with_the_word_null() {
    check_body(
        "make {a, b, null} nb_of f;
         print is null in f, nextto null in f, prevto null in f, nextto b in f, prevto a in f;
         make {a, b} nb_of f;
         print is null in f, nextto null in f, prevto null in f;",
        "truev1v2nullnull
         falsenullnull",
    );
}

#[test]
fn computed_nulls_put_into_a_ring_are_gaps() {
    check_ring("a, b", "vertex n = null; splice n after a in f", "v2 v1 -");
    check_ring("a, nextto c in f, b", "", "v2 v1 -");
    check_ring("a, b, c", "replace a with nextto d in f in f", "v2 v3 -");
    check_ring("a, b", "vertex n = any in d; replace a with (n ? c : n) in f", "v2 -");
}

#[test]
fn computed_nulls_are_never_looked_for() {
    let explained = |statement: &str, place: &str| {
        check_body(
            &format!("make {{a, b, null}} nb_of f; vertex n = any in a;\n{statement};"),
            &format!(
                "error 3:{place} `n`: this is null, and a ring is searched for a gap only where `null` is written
                 at 2:39 `any in a`: `any in a` is null here: v1 has no neighbours
                 = ring of v1: empty
                 about v1"
            ),
        );
    };
    explained("print is n in f", "10");
    explained("print nextto n in f", "14");
    explained("print prevto n in f", "14");
    explained("erase n from f", "7");
    explained("replace n with c in f", "9");
    explained("splice c after n in f", "16");
    explained("splice c before n in f", "17");
}

#[test]
fn a_hole_does_not_let_itself_be_jumped() {
    check(
        &format!(
            "{SQUARE}void step(mesh& S) {{
               forall p in S forall q in p if (p < q) print nextto (nextto q in p) in p;
             }}"
        ),
        "v4
         null
         error 9:68 `(nextto q in p)`: this is null, and a ring is searched for a gap only where `null` is written
         at 9:68 `(nextto q in p)`: `nextto q in p` is null here: a hole follows v4 in the ring of v1
         = ring of v1: v2 v3 v4 ∅
         ? v1 lies on a boundary: test `nextto q in p == null` first
         about v1 v4",
    );
}

#[test]
fn null_stands_for_no_vertex() {
    let check = |statement: &str, expected: &str| check_body(&format!("vertex n = null;\n{statement};"), expected);
    let at = "at 2:12 `null`: null is written here";
    check("print n$pos", &format!("error 3:7 `n$pos`: null has no position\n{at}"));
    check("n$pos = vec(1, 2, 3)", &format!("error 3:1 `n`: null has no position\n{at}"));
    check("print valence n", &format!("error 3:15 `n`: null has no neighbours\n{at}"));
    check("print gaps n", &format!("error 3:12 `n`: null has no neighbours\n{at}"));
    check("print any in n", &format!("error 3:14 `n`: null has no neighbours\n{at}"));
    check("print nextto a in n", &format!("error 3:19 `n`: null has no neighbours\n{at}"));
    check("print is a in n", &format!("error 3:15 `n`: null has no neighbours\n{at}"));
    check("forall x in n print x", &format!("error 3:13 `n`: null has no neighbours\n{at}"));
    check("make {a} nb_of n", &format!("error 3:16 `n`: null has no neighbours\n{at}"));
    check("erase a from n", &format!("error 3:14 `n`: null has no neighbours\n{at}"));
    check("replace a with b in n", &format!("error 3:21 `n`: null has no neighbours\n{at}"));
    check("splice a after b in n", &format!("error 3:21 `n`: null has no neighbours\n{at}"));
    check("add n to S", &format!("error 3:5 `n`: null cannot be added to a set\n{at}"));
    check("remove n from S", &format!("error 3:8 `n`: null cannot be removed from a set\n{at}"));
    check("print is n in S, n == null, !n, n ? 1 : 2, n < a", "falsetruetrue2true");
}

#[test]
fn the_origin_of_a_null_is_told() {
    let check = |statements: &str, expected: &str| check_body(&format!("{statements}\nprint n$pos;"), expected);
    let error = "error 3:7 `n$pos`: null has no position";
    check(
        "make {a, b} nb_of f; vertex n = nextto c in f;",
        &format!(
            "{error}
             at 2:33 `nextto c in f`: `nextto c in f` is null here: v3 is not in the ring of v6
             = ring of v6: v1 v2
             about v6 v3"
        ),
    );
    check(
        "make {a, b} nb_of f; vertex n = prevto null in f;",
        &format!(
            "{error}
             at 2:33 `prevto null in f`: `prevto null in f` is null here: the ring of v6 has no gap
             = ring of v6: v1 v2
             about v6"
        ),
    );
    check(
        "make {a, null} nb_of f; vertex m = prevto a in f, n = m;",
        &format!(
            "{error}
             at 2:36 `prevto a in f`: `prevto a in f` is null here: a hole precedes v1 in the ring of v6
             = ring of v6: v1 ∅
             ? v6 lies on a boundary: test `prevto a in f == null` first
             about v6 v1"
        ),
    );
    check("vertex n = a ? null : a;", &format!("{error}\nat 2:16 `null`: null is written here"));
}

#[test]
fn the_origin_is_found_through_calls_and_properties() {
    check(
        "vertex { vertex mate; };
         vertex after(vertex x, vertex v) { return nextto x in v; }
         vec place(vertex& v) { return v$pos; }
         void step(mesh& S) {
           vertex a, b;
           a$mate = after(b, a);
           vertex m = a$mate;
           print place(m);
         }",
        "error 3:40 `v$pos`: null has no position
         at 2:52 `nextto x in v`: `nextto x in v` is null here: v2 is not in the ring of v1
         = ring of v1: empty
         about v1 v2
         in place at 8:18 `place(m)`",
    );
    check(
        "vertex { vertex mate; }; mesh { vertex root; };
         void step(mesh& S) { vertex a; print a$mate; print S$root; print a$mate$pos; }",
        "null
         null
         error 2:75 `a$mate$pos`: null has no position
         at 2:75 `a$mate`: v1$mate is null: no vertex was stored there in this step
         about v1",
    );
}

#[test]
fn a_neighbour_that_only_the_old_ring_holds_is_pointed_out() {
    check_body(
        "mesh T; add f to T; make {a, b} nb_of f; synchronize T; replace a with c in f;
         print (nextto a in f)$pos;",
        "error 3:16 `(nextto a in f)$pos`: null has no position
         at 3:16 `(nextto a in f)`: `nextto a in f` is null here: v1 is not in the ring of v6
         = ring of v6: v3 v2
         = old ring of v6: v1 v2
         ? the old ring holds it: is that the one meant, with a ` before the vertex?
         about v6 v1",
    );
}
