//! `synchronize` and old values.

use super::{OCTAHEDRON, check, check_body};

#[test]
fn old_values_stay_as_they_were() {
    check(
        &format!(
            "vertex {{ int n = 7; }}; edge {{ double s = 0.5; }};
             {OCTAHEDRON} void step(mesh& S) {{
               vertex x;
               forall p in S {{ x = p; break; }}
               vertex q = any in x;
               synchronize S;
               x$pos = vec(5, 5, 5); x$n = 8; (x|q)$s = 2;
               erase q from x;
               print `x$pos, x$pos, `x$n, x$n, `(x|q)$s, (x|q)$s;
               print valence `x, valence x, any in `x, any in x, is q in `x, is q in x;
               print nextto q in `x, prevto q in `x, nextto q in x == null;
               forall r in `x print r;
             }}"
        ),
        "(1, 0, 0)(5, 5, 5)780.52
         43v2v3truefalse
         v3v6true
         v2
         v3
         v5
         v6",
    );
}

#[test]
fn the_last_synchronize_of_a_set_that_held_the_vertex_wins() {
    check_body(
        "mesh A, B; add a to A; add b to B; add a to B;
         a$pos.x = 1; b$pos.x = 1; synchronize A; synchronize B;
         a$pos.x = 2; b$pos.x = 2; synchronize A;
         a$pos.x = 3; print `a$pos.x, `b$pos.x;
         synchronize B; print `a$pos.x, `b$pos.x;",
        "21
         32",
    );
}

#[test]
fn small_and_large_sets_are_copied_alike() {
    // Of six vertices one is few and five are many: the copies are made differently and must be the same.
    let text = |first: &str, second: &str| {
        format!(
            "mesh One, Five; add a to One; add a to Five; add b to Five; add c to Five; add d to Five; add e to Five;
             make {{b, c, null}} nb_of a; synchronize {first};
             a$pos.x = 1; erase c from a; synchronize {second};
             a$pos.x = 2; make {{d}} nb_of a;
             print `a$pos.x, valence `a, gaps `a, any in `a, nextto b in `a;"
        )
    };
    for (first, second) in [("One", "One"), ("One", "Five"), ("Five", "One"), ("Five", "Five")] {
        check_body(&text(first, second), "111v2null");
    }
}

#[test]
fn a_called_function_that_synchronizes_overwrites_its_callers_values() {
    check(
        "static void inner(mesh& S) { synchronize S; }
         void step(mesh& S) {
           vertex a; add a to S; synchronize S; a$pos.x = 1; inner(S); print `a$pos.x;
         }",
        "1",
    );
}

#[test]
fn old_rings_hold_current_vertices() {
    check_body(
        "mesh A; add a to A; make {b} nb_of a; synchronize A; b$pos.x = 4;
         forall q in `a print q$pos.x; print (any in `a)$pos.x;",
        "4
         4",
    );
}

#[test]
fn old_values_of_expressions() {
    check_body(
        "mesh A; add a to A; add b to A; make {b, c} nb_of a; make {a} nb_of b; synchronize A;
         b$pos.x = 1; a$pos.x = 1; make {c, b} nb_of a;
         print `(nextto c in `a)$pos.x, (nextto c in `a)$pos.x, nextto (nextto c in `a) in a;",
        "01v3",
    );
}

#[test]
fn what_was_never_synchronized_has_no_old_value() {
    check_body(
        "print `b$pos;",
        "error 2:7 ``b$pos`: v2 has no old value
         = nothing has been synchronized in this step
         ? `synchronize` its set first
         about v2",
    );
    check_body(
        "mesh A; add a to A; synchronize A;
         print valence `b;",
        "error 3:25 `b`: v2 has no old value
         at 2:21 `synchronize A;`: v2 was not in this set, nor in one synchronized before
         ? `synchronize` a set that holds it
         about v2",
    );
    check_body(
        "mesh A; add a to A; synchronize A;
         vertex x; forall q in `x print q;",
        "error 3:33 `x`: v7 has no old value
         at 2:21 `synchronize A;`: v7 was created after this
         ? `synchronize` again after it was created, or leave it out here
         about v7",
    );
    check(
        "edge { double s = 1; };
         void step(mesh& S) {
           vertex a, b; mesh A; add a to A; make {b} nb_of a; make {a} nb_of b; synchronize A; (a|b)$s = 2;
           print (a|b)$s;
           print `(a|b)$s;
         }",
        "2
         error 5:18 ``(a|b)$s`: v2 has no old value
         at 3:81 `synchronize A;`: v2 was not in this set, nor in one synchronized before
         ? `synchronize` a set that holds it
         about v2",
    );
}

#[test]
fn old_values_do_not_outlive_the_step() {
    let text = "void start(mesh& S) { vertex a; add a to S; synchronize S; forall p in S print `p$pos; }
                void step(mesh& S) {
                  forall p in S print `p$pos; }";
    check(
        text,
        "(0, 0, 0)
         error 3:39 ``p$pos`: v1 has no old value
         = nothing has been synchronized in this step
         ? `synchronize` its set first
         about v1",
    );
}
