//! Rings and faces as values: programs with what is said of them below their lines.

use super::check;

#[test]
fn rings() {
    check(
        r#"
vertex { ring path; };
//       ^^^^ error: a property cannot be of type `ring`
const ring k = 1;
//    ^^^^ error: a constant cannot be of type `ring`
void f(mesh& S, vertex v, ring r, const ring& s) {
  ring t = v, u = 0, w = s;
//         ^ error: this is a `vertex`, not a `ring`
//                ^ error: this is an `int`, not a `ring`
  t = r; u = w;
  t += v;
//^^^^^^ error: `+=` does not work on a ring
  t++;
//^ error: a ring can only be assigned to as a whole: `t = …;`
  add v to s;
//         ^ error: `s` cannot be changed: it is `const`
  erase v from s;
//             ^ error: `s` cannot be changed: it is `const`
  add null to r;
//    ^^^^ error: `null` is no vertex that this could be done with
  add r to t;
//    ^ error: this is a `ring`, not a `vertex`
  remove v from r;
//              ^ error: this is a `ring`, not a `mesh`
  erase v from S;
//             ^ error: this is a `mesh`, and rings are edited
  merge r with t;
//      ^ error: this is a `ring`, and meshes are merged
  erase null from r; replace v with null in r; splice null after v in r;
//      ^^^^ error: a `ring` has no gaps, only the ring of a vertex may have some
//                                  ^^^^ error: a `ring` has no gaps, only the ring of a vertex may have some
//                                                    ^^^^ error: a `ring` has no gaps, only the ring of a vertex may have some
  print gaps r, is null in r, nextto null in r;
//      ^^^^^^ error: a `ring` has no gaps, only the ring of a vertex may have some
//                 ^^^^ error: a `ring` has no gaps, only the ring of a vertex may have some
//                                   ^^^^ error: a `ring` has no gaps, only the ring of a vertex may have some
  print r == t, !r, r$pos, valence `r, r ? 1 : 2;
//      ^ error: a ring is no value to compute with
//           ^ error: a ring is no value to compute with
//               ^ error: a ring is no value to compute with
//                  ^^^^^ error: vertices, edges and meshes have properties, a `ring` has none
//                                 ^^ error: a `ring` has no old value, it is a value itself
//                                     ^ error: a ring is no value to compute with
  make v nb_of v;
//     ^ error: this is a `vertex`, not a list or a `ring`
  make {r} nb_of v;
//      ^ error: this is a `ring`, and a list holds vertices
  make {v} nb_of r;
//               ^ error: a `ring` is no vertex, so it has no neighbours
  make S nb_of v;
//     ^ error: this is a `mesh`, not a `ring`
  print valence g(r), true ? r : t;
//              ^^^^ error: rings are walked, asked and used through variables
  print g(v), h(s);
//        ^ error: this is a `vertex`, not a `ring`
//              ^ error: `s` cannot be changed: it is `const`
}
ring g(ring r) { if (valence r > 2) return any in r; return r; }
//                                         ^^^^^^^^ error: this is a `vertex`, not a `ring`
int h(ring& r) { return valence r; }
"#,
    );
}

#[test]
fn loops_over_faces_and_pairs() {
    check(
        r#"
void f(mesh& S, vertex v, ring r) {
  forall f in faces S {
    add v to f;
//           ^ error: `f` cannot be changed: it is the face of a `forall`
    f = r;
//  ^ error: `f` cannot be changed: it is the face of a `forall`
    g(f);
//    ^ error: `f` cannot be changed: it is the face of a `forall`
    splice v before v in f;
//                       ^ error: `f` cannot be changed: it is the face of a `forall`
    print f$pos;
//        ^^^^^ error: vertices, edges and meshes have properties, a `ring` has none
    add f to S;
//      ^ error: this is a `ring`, not a `vertex`
    g(r); r = f;
  }
  forall f in faces v print f;
//                  ^ error: this is a `vertex`, and faces are those of a mesh
  forall f in faces r print f;
//                  ^ error: this is a `ring`, not a `mesh`
  forall f in faces `S print f;
//                  ^^ error: the faces of a mesh are walked as they are, not as they were
  forall f in faces { print f; }
//            ^^^^^ error: `faces` is not declared
  forall f in S.faces print f;
//              ^^^^^ error: a `mesh` has no `.faces`
  print len(r);
//      ^^^ error: there is no function `len`
  forall p, q in S print p, q;
//          ^ error: the members of a mesh do not follow each other round
  forall p in S from v print p;
//                   ^ error: the members of a mesh do not go round, so there is nowhere to begin
  forall f in faces S from v print f;
//                         ^ error: faces of a mesh do not go round, so there is nowhere to begin
  forall p, p in r print p;
//          ^ error: there is a variable `p` already
  forall p, q in r from null print p, q;
//                      ^^^^ error: `null` is no vertex that this could be done with
  forall p in r from p print p;
//                   ^ error: `p` is not declared
  forall p, q in `r from v, v print p, q;
//               ^^ error: a `ring` has no old value, it is a value itself
}
void g(ring& r) { add any in r to r; }
"#,
    );
}
