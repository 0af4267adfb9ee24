//! Values and statements: programs with what is said of them below their lines.

use vv::diagnostic::Severity;

use super::{check, compiled};

#[test]
fn fractions_do_not_get_lost_without_a_word() {
    check(
        r"
void f(mesh& S) {
  int i = 1.5;
//        ^^^ warning: the fraction of this `double` is lost in an `int`
  int j = 2.0, k = floor(2.5), l = int(2.5);
  i += 0.5;
//^^^^^^^^ warning: the fraction of the result is lost in an `int`
  j *= 2;
  return g(i / 2.0);
//       ^^^^^^^^^^ error: `f` returns nothing
//         ^^^^^^^ warning: the fraction of this `double` is lost in an `int`
}
int g(int i) { return i * 0.5; }
//                    ^^^^^^^ warning: the fraction of this `double` is lost in an `int`
",
    );
}

#[test]
fn division_of_ints_in_a_double() {
    check(
        r"
void f(mesh& S, int i, int j) {
  double h = 1/2, third = -1/3 + i, exact = 4/2, meant = double(1/2);
//           ^^^ warning: `1/2` divides ints, so its fraction is lost before it becomes a double
//                        ^^^^ warning: `-1/3` divides ints, so its fraction is lost before it becomes a double
  h = i / 2;
//    ^^^^^ warning: `i / 2` divides ints, so its fraction is lost before it becomes a double
  h = 1 / i;
//    ^^^^^ warning: `1 / i` divides ints, so its fraction is lost before it becomes a double
  h = i / j;
//    ^^^^^ warning: `i / j` divides ints, so its fraction is lost before it becomes a double
  h += 1 - (1/2);
//         ^^^^^ warning: `(1/2)` divides ints, so its fraction is lost before it becomes a double
  h = pow(1/2, 2) + 1/2.0;
//        ^^^ warning: `1/2` divides ints, so its fraction is lost before it becomes a double
  i = 1 / 2;
  print h, third, exact, meant, 1/2;
}
",
    );
}

#[test]
fn values_of_the_wrong_type() {
    check(
        r#"
void f(mesh& S) {
  vertex v = 0;
//           ^ error: this is an `int`, not a `vertex`
  vec p = 0;
//        ^ error: this is an `int`, not a `vec`
  p = v;
//    ^ error: this is a `vertex`, not a `vec`
  double h = p;
//           ^ error: this is a `vec`, not a `double`
  h = S;
//    ^ error: a mesh is no value to compute with
  S = v;
//    ^ error: this is a `vertex`, not a `mesh`
  v = S;
//    ^ error: a mesh is no value to compute with
  bool b = p;
//         ^ error: this is a `vec`, not a `bool`
  h = f(S);
//    ^^^^ error: this gives no value
  h = "text";
//    ^^^^^^ error: a text can only be printed
  int i = v;
//        ^ error: this is a `vertex`, not an `int`
  h = null;
//    ^^^^ error: this is a `vertex`, not a `double`
}
"#,
    );
}

#[test]
fn operators_that_do_not_fit() {
    check(
        r"
void f(mesh& S, vec a, vertex v, double d, int i) {
  print a * a, a + d, d / a, a < a, a * v;
//      ^^^^^ error: `*` does not work on a `vec` and a `vec`
//             ^^^^^ error: `+` does not work on a `vec` and a `double`
//                    ^^^^^ error: `/` does not work on a `double` and a `vec`
//                           ^^^^^ error: `<` does not work on a `vec` and a `vec`
//                                  ^^^^^ error: `*` does not work on a `vec` and a `vertex`
  print d % 2, v + v, -v, v == 0, 0 != v, v == i;
//      ^^^^^ error: `%` does not work on a `double` and an `int`
//             ^^^^^ error: `+` does not work on a `vertex` and a `vertex`
//                    ^^ error: `-` needs a number or a `vec`, not a `vertex`
//                        ^^^^^^ error: `==` does not work on a `vertex` and an `int`
//                                ^^^^^^ error: `!=` does not work on an `int` and a `vertex`
//                                        ^^^^^^ error: `==` does not work on a `vertex` and an `int`
  print S == S, !a, !S, a && d;
//      ^ error: a mesh is no value to compute with
//           ^ error: a mesh is no value to compute with
//               ^ error: this is a `vec`, not a `bool`
//                   ^ error: a mesh is no value to compute with
//                      ^ error: this is a `vec`, not a `bool`
  d *= a;
//^^^^^^ error: the result is a `vec`, which a `double` cannot hold
  i += a;
//^^^^^^ error: `+` does not work on an `int` and a `vec`
  v += v;
//^^^^^^ error: `+` does not work on a `vertex` and a `vertex`
  a += d;
//^^^^^^ error: `+` does not work on a `vec` and a `double`
  a %= 2;
//^^^^^^ error: `%` does not work on a `vec` and an `int`
  S += S;
//^^^^^^ error: `+=` does not work on a mesh
  S -= S;
//^^^^^^ error: `-=` does not work on a mesh
}
",
    );
}

#[test]
fn operators_that_fit() {
    check(
        r"
void f(mesh& S, vec a, vertex v, double d, int i, bool b) {
  print a + a, a - a, 2 * a, a * i, a / b, -a, +a, a == a, a != a;
  print d + i, i % 2, i / 2, -b, b + b, b < b, b == i, d < i;
  print v < v, v >= null, v == v, null != v, !v, !d, v && i || b;
  a *= d;
  a /= i;
  a += a;
  b += 1;
  d += b;
}
",
    );
}

#[test]
fn coordinates() {
    check(
        r"
  vertex { int kind; };
void f(mesh& S, vec a, vertex v) {
  print a.x, vec(1, 2, 3).z, v$pos.y, (a + a).x;
  print a.w, v.x, v.pos, v.kind, v.age, S.size, 1.5.x, a$x, a$kind;
//        ^ error: a `vec` has x, y and z, but no `w`
//             ^ error: a `vertex` has no `.x`, only a `vec` has
//                  ^^^ error: a `vertex` has no `.pos`
//                         ^^^^ error: a `vertex` has no `.kind`
//                                 ^^^ error: a `vertex` has no `.age`
//                                        ^^^^ error: a `mesh` has no `.size`
//                                                  ^ error: a `double` has no `.x`, only a `vec` has
//                                                     ^^^ error: vertices, edges and meshes have properties, a `vec` has none
//                                                          ^^^^^^ error: vertices, edges and meshes have properties, a `vec` has none
  v$pos.x.y = 1;
//        ^ error: a `double` has no `.y`, only a `vec` has
  v$kind.x = 1;
//       ^ error: an `int` has no `.x`, only a `vec` has
}
",
    );
}

#[test]
fn what_cannot_be_changed() {
    check(
        r"
  const double k = 1;
  param double w = 1;
void f(mesh& S, const mesh& T, const int c, vertex v) {
  const double l = 2;
  const int m;
//          ^ error: the constant `m` needs a value
  k = 2;
//^ error: `k` cannot be changed: it is a constant
  w = 2;
//^ error: `w` cannot be changed: it is a parameter, set from outside
  l = 3;
//^ error: `l` cannot be changed: it is `const`
  c++;
//^ error: `c` cannot be changed: it is `const`
  tau += 1;
//^^^ error: `tau` cannot be changed: it is a constant
  T = S;
//^ error: `T` cannot be changed: it is `const`
  add v to T;
//         ^ error: `T` cannot be changed: it is `const`
  merge T with S;
//      ^ error: `T` cannot be changed: it is `const`
  1 = 2;
//^ error: nothing can be stored here
  vec(1, 2, 3).x = 1;
//^^^^^^^^^^^^ error: nothing can be stored here
  S++;
//^ error: a mesh can only be assigned to as a whole: `S = …;`
  S = S = S;
//    ^^^^^ error: this gives no value
  l + c = 3;
//^^^^^ error: nothing can be stored here
  (l) = 4;
// ^ error: `l` cannot be changed: it is `const`
  bool b = true;
  b++;
//^^^ error: `++` counts, and a `bool` cannot
  v$pos++;
//^^^^^^^ error: `++` counts, and a `vec` cannot
}
",
    );
}

#[test]
fn what_can_be_changed() {
    check(
        r"
  vertex { int kind; bool seen; };
  edge { double sharpness = 0; };
  mesh { int generation = 0; vec centre; };
void f(mesh& S, const vertex v, int i) {
  v$pos = vec(0, 0, 0);
  v$pos.x = 1;
  v$kind++;
  (any in v)$seen = true;
  (v|any in v)$sharpness *= 0.5;
  S$generation += 1;
  S$centre.y -= 0.5;
  forall q in v q = any in q;
  i = i++ + --i;
  (i) = 3;
  S = S;
}
",
    );
}

#[test]
fn old_values_are_read_only() {
    check(
        r"
  edge { double s = 0; };
  mesh { int generation = 0; };
void f(mesh& S) {
  synchronize S;
  forall p in S {
    `p = null;
//  ^^ error: an old value can be read, not kept: a vertex has no old self of its own
    `p$pos = vec(0, 0, 0);
//  ^^^^^^ error: old values can only be read
    `p$pos.x += 1;
//  ^^^^^^ error: old values can only be read
    erase p from `p;
//               ^^ error: an old ring can only be read
    make {p} nb_of `p;
//                 ^^ error: an old ring can only be read
    `(p|p)$s = 1;
//  ^^^^^^^^ error: old values can only be read
    print `S$generation, `(p|p), (p|p);
//        ^^ error: `synchronize` keeps no old properties of a mesh
//                       ^^^^^^ error: an edge has values, but is none
//                               ^^^^^ error: an edge has values, but is none
  }
  forall p in `S print p;
//            ^^ error: a mesh has no old members, its vertices have old rings and properties
}
",
    );
}

#[test]
fn old_vertices_cannot_be_kept() {
    check(
        r"
void f(mesh& S) {
  synchronize S;
  forall p in S {
    vertex a = `p;
//             ^^ error: an old value can be read, not kept: a vertex has no old self of its own
    g(`p);
//    ^^ error: an old value can be read, not kept: a vertex has no old self of its own
    make {`p} nb_of p;
//        ^^ error: an old value can be read, not kept: a vertex has no old self of its own
    print a, `p, nextto `p in p, (`p|p)$s;
//           ^^ error: an old value can be read, not kept: a vertex has no old self of its own
//                      ^^ error: an old value can be read, not kept: a vertex has no old self of its own
//                                ^^ error: an old value can be read, not kept: a vertex has no old self of its own
//                                      ^ error: edges have no property `s`
  }
}
void g(vertex v) { print v; }
",
    );
}

#[test]
fn old_values_can_be_read() {
    check(
        r"
  vertex { int age; };
  edge { double s = 0; };
void f(mesh& S) {
  synchronize S;
  forall p in S {
    print `p$pos, (`p)$pos, `(p)$age, `(any in `p)$pos.x, `(p|any in p)$s;
    print valence `p, gaps `p, any in `p, is p in `p, nextto p in `p, prevto p in (`p);
    forall q in `p print q;
  }
}
",
    );
}

#[test]
fn old_values_that_nothing_has_made() {
    check(
        r"
void f(mesh& S) {
  forall p in S p$pos = `p$pos + offset(p);
//                      ^^ warning: there is no old value here: nothing has called `synchronize`
}
vec offset(vertex p) {
  return `p$pos + (any in `p)$pos;
//       ^^ warning: there is no old value here: nothing has called `synchronize`
}
",
    );
}

#[test]
fn old_values_that_nothing_reads() {
    check(
        r"
void smooth(mesh& S) {
  synchronize S;
//^^^^^^^^^^^^^^ warning: nothing reads the old values that this makes
  forall p in S forall q in p p$pos = q$pos;
}
void other(mesh& S) { synchronize S; forall p in S p$pos = `p$pos; }
",
    );
    check(
        r#"
#include "host.vv"
vec vertex_point(vertex p) { return p$pos; }
void f(mesh& S) { refine(S); }
"#,
    );
    check(
        r"
void f(mesh& S) {
  synchronize S;
  forall p in S print `p$age;
//                       ^^^ error: vertices have no property `age`
}
",
    );
    let unread = compiled("void f(mesh& S) { synchronize S; forall p in S print `; }");
    assert!(unread.diagnostics.iter().all(|d| d.severity == Severity::Error), "{:?}", unread.diagnostics);
}

#[test]
fn old_values_that_another_function_makes() {
    check(
        r"
static void prepare(mesh& S) { synchronize S; }
void f(mesh& S) {
  prepare(S);
  forall p in S p$pos = offset(p);
}
vec offset(vertex p) { return `p$pos; }
static vec library(vertex p) { return `p$pos; }
",
    );
}

#[test]
fn null_is_no_vertex() {
    check(
        r"
void f(mesh& S, vertex v) {
  print null$pos, any in null, valence null, nextto v in null;
//      ^^^^ error: `null` has no position and no properties
//                       ^^^^ error: `null` is no vertex that this could be done with
//                                     ^^^^ error: `null` is no vertex that this could be done with
//                                                       ^^^^ error: `null` is no vertex that this could be done with
  forall q in null print q;
//            ^^^^ error: `null` is no vertex that this could be done with
  make {v} nb_of null;
//               ^^^^ error: `null` is no vertex that this could be done with
  add null to S;
//    ^^^^ error: `null` is no vertex that this could be done with
  remove null from S;
//       ^^^^ error: `null` is no vertex that this could be done with
}
",
    );
}

#[test]
fn null_as_a_gap() {
    check(
        r"
void f(mesh& S, vertex v) {
  make {v, null} nb_of any in v;
  erase null from v;
  replace null with null in v;
  splice null after null in v;
  print is null in v, is null in S, nextto null in v, prevto (null) in v;
}
",
    );
}

#[test]
fn sets() {
    check(
        r"
void f(mesh& S, vertex v) {
  mesh T = S, E;
  add S to T;
//    ^ error: `S` is a mesh, and vertices are added
  merge S with v;
//             ^ error: this is a vertex, and meshes are merged
  merge v with S;
//      ^ error: this is a `vertex`, not a `mesh`
  add v to v;
//         ^ error: this is a `vertex`, not a `mesh`
  add v to boundary(S);
//         ^^^^^^^^^^^ error: this mesh is no variable, so nobody would see the change
  merge boundary(S) with T;
//      ^^^^^^^^^^^ error: this mesh is no variable, so nobody would see the change
  merge T with boundary(S);
  S = boundary(T);
  synchronize v;
//            ^ error: this is a `vertex`, not a `mesh`
  synchronize boundary(S);
  forall x in boundary(S) print x;
  forall x in 3 print x;
//            ^ error: this is an `int`, no mesh, vertex or ring
  print S, is v in boundary(S), is v in T, any in S, valence S;
//                                                ^ error: this is a `mesh`, not a `vertex`
//                                                           ^ error: this is a `mesh`, not a `vertex`
  print S + 1, S ? 1 : 2, E;
//      ^ error: a mesh is no value to compute with
//             ^ error: a mesh is no value to compute with
}
mesh boundary(const mesh& S) {
  mesh B;
  forall p in S if (gaps p > 0) add p to B;
  return B;
}
",
    );
}

#[test]
fn a_created_vertex_that_is_lost() {
    check(
        r"
void f(mesh& S, vertex p) {
  vertex a;
  a = any in p;
//^^^^^^^^^^^^ warning: the vertex that `vertex a;` created is lost here
  vertex b;
  b = g(b);
  vertex c;
  if (a) c = a;
  vertex d = a;
  d = b;
  vertex e;
  e$pos = vec(0, 0, 0);
  e = d;
  while (c) { vertex x; x = c; c = any in x; }
//                      ^^^^^ warning: the vertex that `vertex x;` created is lost here
}
vertex g(vertex v) { return v; }
",
    );
}

#[test]
fn statements_without_effect() {
    check(
        r#"
void f(mesh& S, vertex v, int i) {
  i == 1;
//^^^^^^ warning: this is computed, but has no effect
  v;
//^ warning: this is computed, but has no effect
  S;
//^ warning: this is computed, but has no effect
  nextto v in v;
//^^^^^^^^^^^^^ warning: this is computed, but has no effect
  i ? i++ : 0;
  i && i++;
  random();
  "text";
//^^^^^^ error: a text can only be printed
  v$pos;
//^^^^^ warning: this is computed, but has no effect
}
"#,
    );
}

#[test]
fn conditions() {
    check(
        r#"
void f(mesh& S, int i, double x, vertex v, vec p) {
  if (i) print 1;
  while (x--) print 2;
  do print 3; while (v);
  for (; p; ) print 4;
//       ^ error: this is a `vec`, not a `bool`
  if (S) print 5;
//    ^ error: a mesh is no value to compute with
  if ("text") print 6;
//    ^^^^^^ error: a text can only be printed
  if (f(S, i, x, v, p)) print 7;
//    ^^^^^^^^^^^^^^^^ error: this gives no value
  print v ? 1 : 2.5, v ? v : null, v ? p : 1, v ? g() : g();
//                                 ^^^^^^^^^ error: `? :` cannot choose between a `vec` and an `int`
//                                            ^^^^^^^^^^^^^ error: `? :` chooses between values, and these give none
  print g(), "text", S;
//      ^^^ error: this gives no value to print
}
void g() {}
"#,
    );
}
