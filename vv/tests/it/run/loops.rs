//! Loops, over sets and rings that change meanwhile too.

use super::{check, check_body};

#[test]
fn forall_walks_the_set_as_it_stood() {
    check_body(
        "mesh T; add a to T; add b to T; add c to T;
         forall v in T { print v, T; remove b from T; add d to T; vertex x; add x to T; }
         print T;",
        "v1{v1, v2, v3}
         v2{v1, v3, v4, v7}
         v3{v1, v3, v4, v7, v8}
         {v1, v3, v4, v7, v8, v9}",
    );
}

#[test]
fn forall_walks_the_ring_as_it_stood() {
    check_body(
        "make {a, b, c} nb_of f;
         forall v in f { print v; erase b from f; splice d before any in f in f; make {e} nb_of f; }
         forall v in f print v;",
        "v1
         v2
         v3
         v5",
    );
}

#[test]
fn foralls_nest_over_the_same_set_and_ring() {
    check_body(
        "mesh T; add a to T; add b to T;
         forall v in T forall w in T print v, w;
         make {c, d} nb_of e;
         forall v in e forall w in e print v, w;",
        "v1v1\nv1v2\nv2v1\nv2v2\nv3v3\nv3v4\nv4v3\nv4v4",
    );
}

#[test]
fn the_variable_of_a_forall_can_be_changed() {
    check_body("mesh T; add a to T; add b to T; forall v in T { v = f; print v; }", "v6\nv6");
}

#[test]
fn break_continue_and_return_leave_any_loop() {
    check(
        "int find(vertex f) {
           int n = 0;
           forall x in f { if (n == 0) { n++; continue; } forall y in f { return n + 100; } }
           return n;
         }
         void step(mesh& S) {
           vertex a, b, c, f; make {a, b, c} nb_of f; add a to S; add b to S; add c to S;
           print find(f);
           forall x in f { forall y in f { if (y == b) break; print x, y; } }
           forall x in S { if (x == b) break; print x; }
           for (int i = 0; i < 9; i++) { if (i % 2 == 0) continue; if (i > 5) break; print i; }
           int j = 0;
           while (true) { j += 1; if (j < 3) continue; break; }
           print j;
           do { j -= 1; if (j == 1) continue; } while (j > 0);
           print j;
           do j = 5; while (false);
           print j;
           while (false) print j;
           for (;;) break;
         }",
        "101\nv1v1\nv2v1\nv3v1\nv1\n1\n3\n5\n3\n0\n5",
    );
}

#[test]
fn a_loop_after_a_returned_one_walks_its_own_ring() {
    check(
        "vertex first(vertex v) { forall x in v return x; return null; }
         void step(mesh& S) {
           vertex a, b, c; make {a, b} nb_of c; make {b} nb_of a;
           forall x in c { print first(c), first(a), x; }
         }",
        "v1v2v1\nv1v2v2",
    );
}

#[test]
fn declarations_in_loops_begin_anew() {
    check_body(
        "for (int i = 0; i < 2; i++) { int n; mesh T; vec p; n += 1; add a to T; p.x += 1; print n, T, p; }",
        "1{v1}(1, 0, 0)\n1{v1}(1, 0, 0)",
    );
}
