//! The operations of Tables 1 and 2 of the paper, with the notes below Table 2.

use super::{check_body, check_ring};

#[test]
fn table_1_sets() {
    check_body(
        "mesh T; add b to T; add a to T; add b to T; print T;
         remove b from T; print T; remove f from T; print T;
         mesh U = T; add c to U; add d to U; merge T with U; print T, U;",
        "{v2, v1}
         {v1}
         {v1}
         {v1, v3, v4}{v1, v3, v4}",
    );
    check_body(
        "mesh T, U; add a to T; add b to T; U = T; remove a from T; print T, \" \", U;
         print is a in T, is a in U, is null in U;",
        "{v2} {v1, v2}
         falsetruefalse",
    );
}

#[test]
fn creation_orders_vertices() {
    check_body("print a < b, b < a, a <= a, a == a, a != b, b >= a, b > a;", "truefalsetruetruetruetruetrue");
    check_body("vertex n = null; print n < a, n == null, n > a, n <= null;", "truetruefalsetrue");
}

#[test]
fn selection() {
    check_body(
        "make {a, b, c, d, e} nb_of f;
         print any in f, nextto b in f, prevto b in f, nextto e in f, prevto a in f;
         print is a in f, is f in f, is f in a, valence f, valence a, gaps f;",
        "v1v3v1v1v5
         truefalsefalse500",
    );
}

#[test]
fn note_1_any_of_an_empty_neighbourhood_is_null() {
    check_body("print any in a;", "null");
}

#[test]
fn note_2_next_and_previous_of_no_neighbour_are_null() {
    check_body("make {a, b} nb_of f; print nextto c in f, prevto c in f, nextto a in b;", "nullnullnull");
}

#[test]
fn note_3_make_refuses_the_vertex_itself_and_duplicates() {
    check_body(
        "make {a, f, b} nb_of f;",
        "error 2:10 `f`: v6 cannot be its own neighbour
         = to be made the ring of v6: v1 v6 v2
         = ring of v6: empty
         about v6",
    );
    check_body(
        "make {b, c} nb_of f;
         make {a, b, a} nb_of f;",
        "error 3:22 `a`: v1 is listed twice
         at 3:16 `a`: v1 here too
         = to be made the ring of v6: v1 v2 v1
         = ring of v6: v2 v3
         about v6 v1",
    );
}

#[test]
fn editing() {
    check_ring("a, b, c", "erase a from f", "v2 v3");
    check_ring("a, b, c", "erase b from f", "v1 v3");
    check_ring("a, b, c", "replace b with d in f", "v1 v4 v3");
    check_ring("a, b, c", "replace a with d in f", "v4 v2 v3");
    check_ring("a, b, c", "splice d after a in f", "v1 v4 v2 v3");
    check_ring("a, b, c", "splice d before b in f", "v1 v4 v2 v3");
    check_ring("a, b, c", "splice d before a in f", "v1 v2 v3 v4");
    check_ring("a, b, c", "splice d after c in f", "v1 v2 v3 v4");
    check_ring("a, b, c", "make {d, e} nb_of f", "v4 v5");
    check_ring("a, b, c", "make {} nb_of f", "");
}

#[test]
fn notes_4_and_5_absent_operands_have_no_effect() {
    check_ring("a, b", "erase c from f", "v1 v2");
    check_ring("a, b", "replace c with d in f", "v1 v2");
    check_ring("a, b", "splice d after c in f", "v1 v2");
    check_ring("a, b", "splice d before c in f", "v1 v2");
    check_ring("a, b", "replace a with a in f", "v1 v2");
    check_ring("a, b", "replace c with a in f", "v1 v2");
    check_ring("a, b", "replace c with f in f", "v1 v2");
    check_ring("a, b", "splice f after c in f", "v1 v2");
}

#[test]
fn note_5_a_vertex_enters_a_ring_once_and_never_its_own() {
    let check = |edit: &str, expected: &str| check_body(&format!("make {{a, b}} nb_of f;\n{edit};"), expected);
    check(
        "replace a with f in f",
        "error 3:16 `f`: v6 cannot be its own neighbour
         = ring of v6: v1 v2
         about v6",
    );
    check(
        "replace a with b in f",
        "error 3:16 `b`: v2 stands in the ring of v6 already
         = ring of v6: v1 v2
         ? ask first whether they are neighbours: `is x in v`
         about v6 v2",
    );
    check(
        "splice f after b in f",
        "error 3:8 `f`: v6 cannot be its own neighbour
         = ring of v6: v1 v2
         about v6",
    );
    check(
        "splice a before b in f",
        "error 3:8 `a`: v1 stands in the ring of v6 already
         = ring of v6: v1 v2
         ? ask first whether they are neighbours: `is x in v`
         about v6 v1",
    );
}

#[test]
fn items_come_before_the_vertex_whose_ring_it_is() {
    super::check(
        "vertex say(vertex v) { print v; return v; }
         void step(mesh& S) {
           vertex a, b, c;
           make {say(a), say(b)} nb_of say(c);
           replace say(a) with null in say(c);
           splice say(a) after say(b) in say(c);
           erase say(b) from say(c);
           bool x = is say(a) in say(c);
         }",
        "v1\nv2\nv3\nv1\nv3\nv1\nv2\nv3\nv2\nv3\nv1\nv3",
    );
}
