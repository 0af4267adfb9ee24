//! Rings as values, faces, pairs, and loops that begin somewhere.

use super::{OCTAHEDRON, SQUARE, check, check_body};

#[test]
fn a_ring_grows_and_is_asked_like_that_of_a_vertex() {
    check_body(
        "ring r; print r, valence r, any in r, nextto a in r;
         add a to r; add b to r; add c to r;
         print r, valence r, any in r, nextto c in r, prevto a in r, is b in r, is d in r, nextto d in r;",
        "{}0nullnull
         {v1, v2, v3}3v1v1v3truefalsenull",
    );
}

#[test]
fn a_ring_is_edited_like_that_of_a_vertex() {
    let edited = |edit: &str, expected: &str| {
        check_body(&format!("ring r; add a to r; add b to r; add c to r; {edit}; print r;"), expected);
    };
    edited("erase a from r", "{v2, v3}");
    edited("erase c from r", "{v1, v2}");
    edited("erase d from r", "{v1, v2, v3}");
    edited("replace b with d in r", "{v1, v4, v3}");
    edited("replace d with b in r", "{v1, v2, v3}");
    edited("splice d after a in r", "{v1, v4, v2, v3}");
    edited("splice d after c in r", "{v1, v2, v3, v4}");
    edited("splice d before b in r", "{v1, v4, v2, v3}");
    edited("splice d before a in r", "{v1, v2, v3, v4}");
    edited("splice e before d in r", "{v1, v2, v3}");
}

#[test]
fn a_ring_may_hold_a_vertex_twice_and_the_first_is_found() {
    check_body(
        "ring r; add a to r; add b to r; add a to r; add c to r;
         print nextto a in r, prevto a in r;
         splice d after a in r; print r;
         replace a with e in r; print r;
         erase a from r; print r;",
        "v2v3
         {v1, v4, v2, v1, v3}
         {v5, v4, v2, v1, v3}
         {v5, v4, v2, v3}",
    );
}

#[test]
fn a_ring_is_a_value() {
    check(
        "ring with(ring r, vertex v) { add v to r; return r; }
         void extend(ring& r, vertex v) { add v to r; }
         ring either(bool first, ring r, ring s) { return first ? r : s; }
         void step(mesh& S) {
           vertex a, b, c;
           ring r; add a to r;
           ring s = r;
           add b to s;
           print r, s, with(r, c), r;
           extend(r, c);
           print r, s, either(true, r, s), either(false, r, s);
           r = s; erase a from s;
           print r, s;
           r = r;
           for (int i = 0; i < 2; i++) { ring t; add a to t; print t; }
         }",
        "{v1}{v1, v2}{v1, v3}{v1}
         {v1, v3}{v1, v2}{v1, v3}{v1, v2}
         {v1, v2}{v2}
         {v1}
         {v1}",
    );
}

#[test]
fn a_ring_becomes_that_of_a_vertex() {
    check_body(
        "ring r; add a to r; add b to r; add c to r;
         make r nb_of f;
         forall x in f print x;
         ring none; make none nb_of f; print valence f;",
        "v1\nv2\nv3\n0",
    );
}

#[test]
fn a_ring_that_no_vertex_can_have_is_refused() {
    check_body(
        "ring r; add a to r; add b to r; add a to r; make r nb_of c;",
        "error 2:45 `make r nb_of c;`: v1 is listed twice
         = to be made the ring of v3: v1 v2 v1
         = ring of v3: empty
         about v3 v1",
    );
    check_body(
        "ring r; add a to r; make r nb_of a;",
        "error 2:21 `make r nb_of a;`: v1 cannot be its own neighbour
         = to be made the ring of v1: v1
         = ring of v1: empty
         about v1",
    );
}

#[test]
fn a_ring_holds_no_null() {
    check_body(
        "ring r; vertex n = any in a; add n to r;",
        "error 2:34 `n`: null cannot be added to a ring
         at 2:20 `any in a`: `any in a` is null here: v1 has no neighbours
         = ring of v1: empty
         about v1",
    );
    check_body(
        "ring r; add a to r; replace a with any in b in r;",
        "error 2:36 `any in b`: null cannot be put into a ring
         at 2:36 `any in b`: `any in b` is null here: v2 has no neighbours
         = ring of v2: empty
         about v2",
    );
    check_body(
        "ring r; print (nextto a in r)$pos;",
        "error 2:15 `(nextto a in r)$pos`: null has no position
         at 2:15 `(nextto a in r)`: `nextto a in r` is null here: v1 is not in `r`
         = r: empty
         about v1",
    );
    check_body(
        "ring r; print (any in r)$pos;",
        "error 2:15 `(any in r)$pos`: null has no position
         at 2:15 `(any in r)`: `any in r` is null here: `r` is empty",
    );
}

#[test]
fn a_loop_walks_the_ring_as_it_stood() {
    check_body(
        "ring r; add a to r; add b to r;
         forall x in r { add x to r; if (x == a) erase b from r; print x; }
         print r;",
        "v1\nv2\n{v1, v1, v2}",
    );
}

#[test]
fn pairs_follow_each_other_once_round() {
    check_body(
        "ring r; add a to r; add b to r; add a to r; add c to r;
         forall p, q in r print p, q;
         ring one; add d to one;
         forall p, q in one print p, q;
         ring none;
         forall p, q in none print p, q;",
        "v1v2\nv2v1\nv1v3\nv3v1\nv4v4",
    );
}

#[test]
fn pairs_of_neighbours_do_not_cross_a_gap() {
    check_body("make {a, b, c} nb_of f; forall p, q in f print p, q;", "v1v2\nv2v3\nv3v1");
    check_body("make {a, b, null, c, null} nb_of f; forall p, q in f print p, q;", "v1v2");
    check_body("make {a} nb_of f; forall p, q in f print p, q;", "v1v1");
    check_body("make {a, null} nb_of f; forall p, q in f print p, q;", "");
}

#[test]
fn pairs_of_old_neighbours() {
    check(
        &format!(
            "{SQUARE}void step(mesh& S) {{
               synchronize S;
               vertex a = null; forall v in S {{ a = v; break; }}
               erase null from a;
               forall p, q in `a print p, q;
               forall p, q in a print p, \" \", q;
             }}"
        ),
        "v2v3\nv3v4\nv2 v3\nv3 v4\nv4 v2",
    );
}

#[test]
fn a_loop_may_begin_anywhere_in_a_ring() {
    check_body(
        "ring r; add a to r; add b to r; add a to r; add c to r;
         forall x in r from c print x;
         print;
         forall x in r from a, c print x;
         print;
         forall x, y in r from a print x, y;
         print;
         make {a, b, null, c, null} nb_of f;
         forall x in f from b print x;
         print;
         forall x, y in f from b print x, y;",
        "v3\nv1\nv2\nv1\n\nv1\nv3\nv1\nv2\n\nv1v2\nv2v1\nv1v3\nv3v1\n\nv2\nv3\nv1\n\nv1v2",
    );
}

#[test]
fn a_loop_cannot_begin_where_nothing_is() {
    check_body(
        "ring r; add a to r; add b to r; forall x in r from c print x;",
        "error 2:52 `c`: v3 is not in `r`
         = r: v1 v2
         about v3",
    );
    check_body(
        "ring r; add a to r; add b to r; add c to r; forall x in r from a, c print x;",
        "error 2:64 `a, c`: v3 does not follow v1 in `r`
         = r: v1 v2 v3
         about v1 v3",
    );
    check_body(
        "make {a, b, null} nb_of f; forall x in f from b, a print x;",
        "error 2:47 `b, a`: v1 does not follow v2 in the ring of v6
         = ring of v6: v1 v2 ∅
         about v6 v2 v1",
    );
    check_body(
        "vertex n = null; forall x in f from n print x;",
        "error 2:37 `n`: a loop cannot begin at null
         at 2:12 `null`: null is written here",
    );
}

#[test]
fn every_face_once_from_its_oldest_corner() {
    check(
        &format!("{OCTAHEDRON}void step(mesh& S) {{ forall f in faces S print f; }}"),
        "{v1, v2, v3}
         {v1, v3, v5}
         {v1, v5, v6}
         {v1, v6, v2}
         {v2, v6, v4}
         {v2, v4, v3}
         {v3, v4, v5}
         {v4, v6, v5}",
    );
}

#[test]
fn a_hole_is_no_face() {
    check(
        &format!(
            "{SQUARE}void step(mesh& S) {{
               forall f in faces S forall p, q in f if (nextto q in p == null) print f, p, q;
               forall f in faces S print f;
             }}"
        ),
        "{v1, v2, v3}\n{v1, v3, v4}",
    );
}

#[test]
fn faces_are_those_of_the_members() {
    check(
        &format!(
            "{OCTAHEDRON}void step(mesh& S) {{
               mesh T; forall f in faces T print f;
               vertex X = null; forall v in S if (v$pos.x < 0) X = v;
               T = S; remove X from T;
               forall f in faces T print f;
             }}"
        ),
        "{v1, v2, v3}\n{v1, v3, v5}\n{v1, v5, v6}\n{v1, v6, v2}",
    );
}

#[test]
fn an_orbit_that_does_not_close_is_no_face() {
    check(
        &format!(
            "{OCTAHEDRON}void step(mesh& S) {{
               vertex x = null, y = null;
               forall v in S {{ if (v$pos.x > 0) x = v; if (v$pos.y > 0) y = v; }}
               erase x from y;
               forall f in faces S print f;
             }}"
        ),
        "{v1, v3, v5}\n{v1, v5, v6}\n{v2, v6, v4}\n{v2, v4, v3}\n{v3, v4, v5}\n{v4, v6, v5}",
    );
}

#[test]
fn faces_stay_as_they_stood_when_the_loop_began() {
    check(
        &format!(
            "{SQUARE}void step(mesh& S) {{
               mesh N; ring last;
               forall f in faces S {{
                 vertex c;
                 make f nb_of c;
                 forall p, q in f splice c after q in p;
                 add c to N; last = f;
               }}
               merge S with N;
               print last;
               forall f in faces S print f;
             }}"
        ),
        "{v1, v3, v4}
         {v1, v2, v5}
         {v1, v5, v3}
         {v1, v3, v6}
         {v1, v6, v4}
         {v2, v3, v5}
         {v3, v4, v6}",
    );
}

#[test]
fn a_face_may_visit_a_vertex_twice() {
    // A spike d inside a triangle abc hangs at a.
    check(
        "void step(mesh& S) {
           vertex a, b, c, d;
           make {b, d, c, null} nb_of a; make {c, a, null} nb_of b; make {a, b, null} nb_of c; make {a} nb_of d;
           add a to S; add b to S; add c to S; add d to S;
           forall f in faces S {
             print f;
             forall p, q in f { print p, q; forall x in f from p, q print \"  \", x; }
           }
         }",
        "{v1, v2, v3, v1, v4}
         v1v2
         v1
         v2
         v3
         v1
         v4
         v2v3
         v2
         v3
         v1
         v4
         v1
         v3v1
         v3
         v1
         v4
         v1
         v2
         v1v4
         v1
         v4
         v1
         v2
         v3
         v4v1
         v4
         v1
         v2
         v3
         v1",
    );
}

#[test]
fn loops_over_faces_break_continue_and_return() {
    check(
        &format!(
            "{OCTAHEDRON}
             ring first(mesh& S) {{ forall f in faces S return f; ring none; return none; }}
             void step(mesh& S) {{
               forall f in faces S {{ ring r = first(S); if (any in f == any in r) continue; print f; break; }}
               forall f in faces S {{ forall g in faces S {{ print g; break; }} print first(S); break; }}
             }}"
        ),
        "{v2, v6, v4}\n{v1, v2, v3}\n{v1, v2, v3}",
    );
}
