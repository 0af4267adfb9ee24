//! Properties of vertices, edges and meshes.

use vv::engine::Settings;

use super::{check, run_with};

#[test]
fn every_type_has_its_default() {
    check(
        "vertex { bool b; int i; double d; vec v; vertex x; int n = 3; vec w = vec(1, 2, 3); };
         void step(mesh& S) {
           vertex a;
           print a$b, a$i, a$d, a$v, a$x, a$n, a$w;
           a$b = true; a$i = 1; a$d = 2; a$v = vec(1, 1, 1); a$x = a; a$n += 2; a$w.y = 9; a$w.z *= 2;
           print a$b, a$i, a$d, a$v, a$x, a$n, a$w;
         }",
        "false00(0, 0, 0)null3(1, 2, 3)
         true12(1, 1, 1)v15(1, 9, 6)",
    );
}

#[test]
fn an_edge_has_one_value_for_both_directions() {
    check(
        "edge { double s = 0.5; int n; };
         void step(mesh& S) {
           vertex a, b, c; make {b, c} nb_of a; make {a} nb_of b;
           print (a|b)$s, (b|a)$s; (b|a)$s = 2; print (a|b)$s, (b|a)$s, (a|c)$s; (a|b)$n++; print (a|b)$n;
         }",
        "0.50.5\n220.5\n1",
    );
}

#[test]
fn replace_hands_an_edges_value_on_and_make_keeps_it() {
    check(
        "edge { double s; };
         vertex insert(vertex p, vertex q) {
           vertex x; make {p, q} nb_of x; replace p with x in q; replace q with x in p; return x;
         }
         void step(mesh& S) {
           vertex a, b, c; make {b} nb_of a; make {a} nb_of b; (a|b)$s = 3;
           vertex x = insert(a, b);
           print (a|x)$s, (x|b)$s;
           make {c, x} nb_of a; print (a|x)$s, (a|c)$s;
         }",
        "33\n30",
    );
}

#[test]
fn without_an_edge_there_is_no_edge_property() {
    check(
        "edge { double s; };
         void step(mesh& S) {
           vertex a, b; make {b, null} nb_of a; erase b from a;
           (a|b)$s = 1;
         }",
        "error 4:12 `(a|b)$s = 1`: there is no edge between v1 and v2
         = ring of v1: empty
         = ring of v2: empty
         about v1 v2",
    );
}

#[test]
fn mesh_properties_belong_to_the_variable() {
    check(
        "mesh { int n = 1; };
         static void count(mesh T) { T$n += 1; print T$n; }
         static void count_it(mesh& T) { T$n += 1; }
         void step(mesh& S) {
           S$n = 5; mesh T = S, U; print T$n; T$n = 8; S = T; merge S with T; print S$n;
           count(S); print S$n; count_it(S); print S$n, U$n;
         }",
        "1\n5\n6\n5\n61",
    );
}

#[test]
fn properties_last_from_step_to_step() {
    let text = "vertex { int age; }; mesh { int generation; };
                void start(mesh& S) { vertex a; add a to S; }
                void step(mesh& S) { forall v in S { v$age += 2; print v$age; } S$generation++; print S$generation; }";
    assert_eq!(run_with(text, 3, &Settings::default()).0, ["2", "1", "4", "2", "6", "3"]);
}
