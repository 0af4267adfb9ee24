//! Names, functions and file scope: programs with what is said of them below their lines.

use super::check;

#[test]
fn a_wrong_ring_offers_the_vertex_of_the_loop() {
    check(
        r#"
#include "insert.vv"
void loop(mesh& S) {
  double pi2 = 6.2832;
  synchronize S;
  mesh NV;

  forall p in S {
    double n = valence p;
    double w = (5.0/8.0)/n
             - pow(3.0/8.0 + 1.0/4.0*cos(pi2/n), 2.0)/n;
    p$pos *= 1.0 - (n * w);
    forall q in `p {
      p$pos += w * `q$pos;
      if (p < q) continue;
      vertex x = insert(p, q);
      x$pos = 3.0/8.0 * `p$pos + 3.0/8.0 * `q$pos
            + 1.0/8.0 * `(nextto q in `p)$pos
            + 1.0/8.0 * `(prevto q in `p)$pos;
      add x to NV;
    }
  }
  forall x in NV {
    vertex p = any in x;
    vertex q = nextto p in v;
//                         ^ error: `v` is not declared
    make {nextto x in q, q, prevto x in q,
          nextto x in p, p, prevto x in p} nb_of x;
  }
  merge S with NV;
}
"#,
    );
}

#[test]
fn unknown_names_are_reported_once_a_function() {
    check(
        r"
  const double weight = 0.5;
void f(mesh& S) {
  double centre = 1;
  print center, wieght, tua, nothing;
//      ^^^^^^ error: `center` is not declared
//              ^^^^^^ error: `wieght` is not declared
//                      ^^^ error: `tua` is not declared
//                           ^^^^^^^ error: `nothing` is not declared
  print nothing, sin, helper;
//               ^^^ error: `sin` is not declared
//                    ^^^^^^ error: `helper` is not declared
  helper2();
//^^^^^^^ error: there is no function `helper2`
  heplerr();
//^^^^^^^ error: there is no function `heplerr`
  centre(1);
//^^^^^^ error: there is no function `centre`
  forall p in s print p$pos;
//            ^ error: `s` is not declared
}
void helper() { print nothing, weight; }
//                    ^^^^^^^ error: `nothing` is not declared
",
    );
}

#[test]
fn a_name_is_declared_once_in_a_scope() {
    check(
        r"
void f(mesh& S, int i) {
  int i = 1;
//    ^ error: there is a variable `i` already
  for (int k = 0; k < 3; k++) { int k = 7; print k; }
//                                  ^ error: there is a variable `k` already
  forall p in S { vertex p = null; print p; }
//                       ^ error: there is a variable `p` already
  int a = 1, a = 2;
//           ^ error: there is a variable `a` already
  print a, i;
}
",
    );
}

#[test]
fn inner_scopes_shadow_outer_ones() {
    check(
        r"
void f(mesh& S, int i) {
  { int i = 2; print i; }
  if (i) int i = 3;
//           ^ warning: `i` is never used
  while (i > 5) { double i = 1; print i; break; }
  forall p in S { forall p in p print p; }
  double sin = sin(1), tau = 6.28;
  print sin, tau;
}
",
    );
}

#[test]
fn a_name_is_visible_after_its_declaration_only() {
    check(
        r"
void f(mesh& S) {
  double x = x;
//           ^ error: `x` is not declared
  for (int k = 0; k < 3; k++) print k;
  forall p in S print p;
  print k, p, x;
//      ^ error: `k` is not declared
//         ^ error: `p` is not declared
}
",
    );
}

#[test]
fn every_path_returns() {
    check(
        r"
int a(int i) { if (i > 0) return 1; }
//                                  ^ error: `a` may end here without returning an `int`
int b(int i) { if (i > 0) return 1; else return 2; }
int c() { while (true) {} }
int d() { while (true) { break; } }
//                                ^ error: `d` may end here without returning an `int`
int e() { for (;;) { if (d()) break; } return 1; }
int f() { do { return 1; } while (d()); }
int g() { do { if (d()) continue; return 1; } while (d()); }
//                                                         ^ error: `g` may end here without returning an `int`
int h() { while (1) { while (true) { break; } } }
vertex i(vertex v) { forall q in v return q; }
//                                           ^ error: `i` may end here without returning a `vertex`
void j() { return 1; }
//                ^ error: `j` returns nothing
int k() { return; }
//        ^^^^^^^ error: `k` must return an `int` here
vertex l() { return 1.5; }
//                  ^^^ error: this is a `double`, not a `vertex`
mesh m(mesh& S) { return S; }
void n(mesh& S) { if (any in S) return; print 1; }
//                           ^ error: this is a `mesh`, not a `vertex`
",
    );
}

#[test]
fn what_is_never_reached() {
    check(
        r"
int f() { return 1; print 2; print 3; }
//                  ^^^^^^^^ warning: this is never reached
void g(mesh& S) { forall p in S { continue; print p; } }
//                                          ^^^^^^^^ warning: this is never reached
void h() { while (true) {} ; print 1; }
//                           ^^^^^^^^ warning: this is never reached
void i() { break; }
//         ^^^^^^ error: there is no loop around this `break`
void j() { while (true) { if (i2()) break; else continue; print 1; } continue; }
//                                                        ^^^^^^^^ warning: this is never reached
//                                                                   ^^^^^^^^^ error: there is no loop around this `continue`
bool i2() { { return true; } return false; }
//                           ^^^^^^^^^^^^^ warning: this is never reached
",
    );
}

#[test]
fn calls() {
    check(
        r"
double half(double x) { return x / 2; }
void change(int& i, vec& p, mesh& M) { i++; p.x = 1; merge M with M; }
void f(mesh& S, vertex v, double d) {
  int i = 0;
  const int c = 0;
  print half(1) + half() + half(1, 2), half(S);
//                ^^^^^^ error: `half` takes 1 argument, not 0
//                         ^^^^^^^^^^ error: `half` takes 1 argument, not 2
//                                          ^ error: a mesh is no value to compute with
  vec p = vec(0, 0, 0);
  change(i, p, S);
  change(d, p, S);
//       ^ error: `change` changes its `i`, so an `int` variable must be given, not a `double`
  change(c, p, S);
//       ^ error: `c` cannot be changed: it is `const`
  change(i + 1, p, copy(S));
//       ^^^^^ error: `change` changes its `i`, so a variable must be given
//                 ^^^^^^^ error: `change` changes its `M`, so a variable must be given
  change(i, tau, S);
//          ^^^ error: `change` changes its `p`, and `tau` cannot be changed
  change(i, v$pos, S);
//          ^^^^^ error: `change` changes its `p`, so a variable must be given
  print half(change(i, p, S));
//           ^^^^^^^^^^^^^^^ error: this gives no value
  half(1);
  copy(copy(S));
}
mesh copy(const mesh& S) { return S; }
",
    );
}

#[test]
fn functions_of_the_language() {
    check(
        r"
void f(mesh& S, vertex v, vec p) {
  print min(1, 2), min(1, 2.5), sin(true), abs(-1), dot(p, p), point(1, 2, 3), vector(1, 2, 3), random(1, 2);
  print min(p, p), clamp(1, 2), pow(2), random(0), vec(1, 2), vec(p), vec(v, 1, 2);
//      ^^^^^^^^^ error: `min` does not take (vec, vec)
//                 ^^^^^^^^^^^ error: `clamp` does not take (int, int)
//                              ^^^^^^ error: `pow` does not take (int)
//                                      ^^^^^^^^^ error: `random` does not take (int)
//                                                 ^^^^^^^^^ error: `vec` does not take (int, int)
//                                                            ^^^^^^ error: `vec` does not take (vec)
//                                                                    ^^^^^^^^^^^^ error: `vec` does not take (vertex, int, int)
  print double(1), int(1.5), bool(v), int(v), double(v), int(1, 2);
//                                        ^ error: this is a `vertex`, not an `int`
//                                                   ^ error: this is a `vertex`, not a `double`
//                                                       ^^^^^^^^^ error: `int(…)` converts one value
  random();
  sin(1.0);
//^^^^^^^^ warning: this is computed, but has no effect
}
",
    );
}

#[test]
fn a_program_may_define_a_function_of_the_language_itself() {
    check(
        r"
void f(mesh& S) { forall p in S forall q in p print distance(p, q); }
double distance(vertex p, vertex q) { return length(p$pos - q$pos); }
",
    );
}

#[test]
fn file_scope_keeps_nothing() {
    check(
        r"
  double state = 0;
//^^^^^^^^^^^^^^^^ error: a program keeps nothing at file scope but constants and parameters
  int counter;
//^^^^^^^^^^^ error: a program keeps nothing at file scope but constants and parameters
  mesh M;
//^^^^^^ error: a program keeps nothing at file scope but constants and parameters
void f(mesh& S) { state = 1; print counter, M; print state; }
",
    );
}

#[test]
fn constants() {
    check(
        r"
  const double a = b + 1, b = 2;
//                 ^ error: `b` has no value yet
  const double c = half(1), d = random(), e;
//                 ^^^^^^^ error: `half` cannot be called at file scope
//                              ^^^^^^^^ error: what stands at file scope cannot be random
//                                        ^ error: the constant `e` needs a value
  const vertex v = null;
//      ^^^^^^ error: a constant cannot be of type `vertex`
  const int z = 1 / 0, big = 9223372036854775807 + 1, nan = int(0.0 / 0.0);
//              ^^^^^ error: this divides by zero
//                           ^^^^^^^^^^^^^^^^^^^^^^^ error: the result does not fit into an int
//                                                          ^^^^^^^^^^^^^^ error: this does not fit into an int
  const int z = 2;
//          ^ error: there is a constant or parameter `z` already
  const double third = 1/3;
//                     ^^^ warning: `1/3` divides ints, so its fraction is lost before it becomes a double
  const vec up = normalize(vec(0, 0, 2)), right = cross(up, vec(0, 1, 0));
  const bool on = true && !false || up == right;
double half(double x) { return x / 2; }
void f(mesh& S) { print a, b, c, d, e, v, z, big, nan, third, up, right, on; }
",
    );
}

#[test]
fn parameters() {
    check(
        r"
  const double quarter = 1.0/4;
  param double w = 0.5 in [0, quarter];
//                 ^^^ error: the default `0.5` of `w` is outside its range
  param int n = 3 in [5, 1];
//                    ^^^^ error: the range is empty: it goes from low to high
  param bool on = true in [false, true];
//                         ^^^^^^^^^^^ error: only parameters of type `int` or `double` have a range
  param int steps = 2.5;
//                  ^^^ warning: the fraction of this `double` is lost in an `int`
  param double u = w * 2 in [0, w];
//                              ^ error: a range cannot depend on a parameter
  param vec x = vec(1, 2, 3);
  param vertex v = null;
//      ^^^^^^ error: a constant cannot be of type `vertex`
  param double w = 1;
//             ^ error: there is a constant or parameter `w` already
  param double k = 1 in [0, 10];
  param double ratio = 1 / (k - 1);
  param int inverse = 1 / int(k - 1);
//                    ^^^^^^^^^^^^^^ error: this divides by zero
",
    );
}

#[test]
fn property_blocks() {
    check(
        r"
  param double w = 1;
  const double k = 2;
  vertex { double age = w; int kind, kind; double pos; mesh m; vec up = vec(0, 0, 1); vertex mate; double l = k; };
//                      ^ error: the default of a property cannot depend on a parameter
//                                   ^^^^ error: there is a property `kind` already
//                                                ^^^ error: `pos` is the position, which every vertex has
//                                                     ^^^^ error: a property cannot be of type `mesh`
  vertex { bool kind; };
//              ^^^^ error: there is a property `kind` already
  edge { int kind = true; };
",
    );
}

#[test]
fn properties_that_are_not_there() {
    check(
        r"
  vertex { double age = 0; int kind; };
  edge { double sharpness = 0; };
  mesh { int generation = 0; };
void f(mesh& S) {
  S$generatoin++;
//  ^^^^^^^^^^ error: meshes have no property `generatoin`
  forall p in S {
    p$aeg = 2;
//    ^^^ error: vertices have no property `aeg`
    p$colour = 3;
//    ^^^^^^ error: vertices have no property `colour`
    p$position = vec(0, 0, 0);
//    ^^^^^^^^ error: vertices have no property `position`
    (p|p)$pos = vec(0, 0, 0);
//        ^^^ error: edges have no property `pos`
    (S|p)$sharpness = 1;
//   ^ error: this is a `mesh`, not a `vertex`
    p$generation = 1;
//    ^^^^^^^^^^ error: vertices have no property `generation`
    S$age = 1;
//    ^^^ error: meshes have no property `age`
    copy(S)$generation = 1;
//  ^^^^^^^ error: only a mesh variable has properties
  }
}
mesh copy(mesh S) { return S; }
",
    );
}

#[test]
fn functions_have_names_of_their_own() {
    check(
        r"
void f(mesh& S) {}
int f() { return 1; }
//  ^ error: there is a function `f` already
void start(int i) { print i; }
//   ^^^^^ error: `start` must be `void start(mesh& S)`
void g(void x, int a, int a) { print x, a; }
//     ^^^^ error: a parameter cannot be `void`
//                        ^ error: there is a variable `a` already
void h() { void x; print x; }
//         ^^^^ error: a variable cannot be `void`
",
    );
}

#[test]
fn blocks_of_the_original_language() {
    check(
        r"
start { vertex v; add v to S; }
step { synchronize S; forall p in S print `p$pos; int S = 1; print S; }
//                                                    ^ error: there is a variable `S` already
void step(mesh& S) {}
//   ^^^^ error: there is a function `step` already
",
    );
}

#[test]
fn unused_variables() {
    check(
        r"
void f(mesh& S, int unused_parameter) {
  vertex unused;
//       ^^^^^^ warning: `unused` is never used
  vertex kept = g(null);
  double never = 3, _quiet, assigned;
//       ^^^^^ warning: `never` is never used
  assigned = 1;
  forall p in S { mesh inner; }
//                     ^^^^^ warning: `inner` is never used
}
vertex g(vertex v) { return v; }
",
    );
}

#[test]
fn one_mistake_gives_one_message() {
    check(
        r"
void f(mesh& S) {
  vertex q = nextto nowhere in S;
//                  ^^^^^^^ error: `nowhere` is not declared
//                             ^ error: this is a `mesh`, not a `vertex`
  make {q, unknown, q} nb_of elsewhere;
//         ^^^^^^^ error: `unknown` is not declared
//                           ^^^^^^^^^ error: `elsewhere` is not declared
  double d = unknown + sin(unknown2) * 2 + (unknown3|q)$s;
//                         ^^^^^^^^ error: `unknown2` is not declared
//                                          ^^^^^^^^ error: `unknown3` is not declared
//                                                      ^ error: edges have no property `s`
  print d, unknown, q$pos + unknown4;
//                          ^^^^^^^^ error: `unknown4` is not declared
  forall p in unknown5 { print p$pos; }
//            ^^^^^^^^ error: `unknown5` is not declared
  foo(unknown6, 1 + S);
//^^^ error: there is no function `foo`
//    ^^^^^^^^ error: `unknown6` is not declared
//                  ^ error: a mesh is no value to compute with
  unknown7 = 3;
//^^^^^^^^ error: `unknown7` is not declared
  unknown7.x += 3;
  if (unknown7 && d) print 1;
}
",
    );
}

#[test]
fn a_step_takes_the_mesh_itself() {
    check(
        r"
void f(mesh S) { forall p in S print p; }
//     ^^^^ warning: `f` gets a copy of the mesh, so it is no step of the modeler
",
    );
    check("void f(const mesh& S) { forall p in S print p; }");
}

#[test]
fn files_that_are_not_there() {
    check(
        r#"
#include "insert.vv"
#include "missing.vv"
//       ^^^^^^^^^^^^ error: there is no file `missing.vv`
void f(mesh& S) { forall p in S insert(p, p); }
"#,
    );
}

#[test]
fn declared_functions_are_defined_by_the_program() {
    check(
        r#"
#include "host.vv"
void step(mesh& S) { refine(S); }
vec vertex_point(vertex p) { return `p$pos / 2.0; }
int later(int n);
int later(int number);
int later(int n) { return n > 0 ? later(n - 1) : 0; }
"#,
    );
    check(
        r#"
#include "host.vv"
//       ^^^^^^^^^ error: `host.vv` needs a function `vertex_point`, and there is none
void step(mesh& S) { refine(S); forall p in S p$pos = vertex_point(p, p); }
//                                                    ^^^^^^^^^^^^^^^^^^ error: `vertex_point` takes 1 argument, not 2
"#,
    );
    check(
        r#"
#include "host.vv"
void step(mesh& S) { refine(S); }
vec vertex_point(vertex& p) { return `p$pos / 2.0; }
//  ^^^^^^^^^^^^ error: `vertex_point` is declared otherwise: `vec vertex_point(vertex p)`
  int later(int n);
//^^^^^^^^^^^^^^^^ error: `later` is declared, but nowhere defined
int never(int n);
static int unused(int n) { return never(n); }
int used(int n) { return later(n); }
start { print used(3); }
"#,
    );
}

#[test]
fn files_may_declare_the_same_property() {
    check(
        r#"
#include "marks.vv"
vertex { double mark = 1; };
edge { double mark = 1; };
start { vertex v; v$mark = 2; add v to S; }
"#,
    );
    check(
        r#"
#include "marks.vv"
vertex { double mark = 2; int mark = 1; };
//              ^^^^ error: there is a property `mark` already
//                            ^^^^ error: there is a property `mark` already
start { vertex v; v$mark = 2; add v to S; }
"#,
    );
}
