//! What would do nothing, and what would never end.

use super::{check, compiled};

#[test]
fn copies_that_are_changed_for_nothing() {
    check(
        r"
static void grow(vertex p, mesh N) { vertex x; add x to N; add p to N; }
//                         ^^^^ warning: `N` is a copy, and nobody sees what is done to it
static void take(vertex p, ring r) { add p to r; }
//                         ^^^^ warning: `r` is a copy, and nobody sees what is done to it
static void fill(mesh& N) { vertex x; add x to N; }
static mesh with(mesh N, vertex p) { add p to N; return N; }
static void show(mesh N, vertex p) { add p to N; forall q in N print q; }
void step(mesh& S) {
  mesh N;
  ring r;
  forall p in S { grow(p, N); take(p, r); fill(N); show(N, p); }
  merge S with with(N, any in r);
}
",
    );
}

#[test]
fn sets_that_are_filled_and_not_used() {
    check(
        r"
void step(mesh& S) {
  mesh NV, done, given;
//     ^^ warning: `NV` is filled, but not used
  ring r;
//     ^ warning: `r` is filled, but not used
  forall p in S {
    vertex x;
    add x to NV;
    if (is p in done) continue;
    add p to done;
    add p to r;
    fill(given);
  }
  mesh _kept = S;
  add any_of(S) to _kept;
}
static void fill(mesh& N) { vertex x; add x to N; }
static vertex any_of(mesh N) { forall v in N return v; return null; }
",
    );
}

#[test]
fn loops_that_never_end() {
    check(
        r"
param int rounds = 3;
void step(mesh& S) {
  int i = 0, j = 0;
  while (i < rounds) j++;
//       ^^^^^^^^^^ warning: nothing in this loop changes `i`, so it never ends
  for (int k = 0; k < 3 && !(j > 4); i++) forall p in S print p;
//                ^^^^^^^^^^^^^^^^^ warning: nothing in this loop changes `j` or `k`, so it never ends
  while (i < rounds) i++;
  while (i < rounds) change(i);
  while (i < rounds) { if (j > 3) break; j++; }
  while (i < rounds) { forall p in S return; }
  while (i < rounds) { forall p in S { if (j > 3) break; } j++; }
//       ^^^^^^^^^^ warning: nothing in this loop changes `i`, so it never ends
  while (true) { if (j++ > 3) break; }
  for (int k = 0; k < 3; k++) j--;
  vec v;
  while (v.x < 1) v.x += 1;
  vertex first = null;
  while (first == null) forall p in S first = p;
}
static void change(int& i) { i++; }
static void same(int& i, int& j) { while (i < 3) j++; }
",
    );
}

#[test]
fn what_is_faulty_may_have_been_the_change() {
    check(
        r"
void step(mesh& S) {
  int i = 0;
  while (i < 3) k++;
//              ^ error: `k` is not declared
}
",
    );
}

#[test]
fn one_copied_mesh_gives_one_message() {
    check(
        r"
void step(mesh S) { vertex x; add x to S; }
//        ^^^^ warning: `step` gets a copy of the mesh, so it is no step of the modeler
",
    );
}

#[test]
fn programs_that_ship_do_nothing_in_vain() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/programs");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let c = compiled(&std::fs::read_to_string(&path).unwrap());
        assert!(c.diagnostics.is_empty(), "{}: {:?}", path.display(), c.diagnostics);
    }
}
