//! Parallel loops: what rounds may not do, and what they may.

use vv::source::Span;

use super::{check, compiled};

#[test]
fn values_of_others_are_read_as_they_were() {
    check(
        r"
vertex { double u; double du; };
void step(mesh& S) {
  synchronize S;
  parallel forall p in S p$pos = `p$pos;
  parallel forall p in S forall q in `p p$pos += `q$pos;
  parallel forall p in S forall q in p p$pos += q$pos;
//                                              ^ error: another round may be changing `q$pos`
  parallel forall p in S p$pos.x = (any in p)$pos.y;
//                                 ^^^^^^^^^^ error: another round may be changing `(any in p)$pos`
  parallel forall p in S forall q in p { p$du += q$u; p$pos.z = q$u; }
  parallel forall p in S { p$u += p$du; p$u *= 2; }
}
",
    );
}

#[test]
fn a_round_changes_its_own_vertex_only() {
    check(
        r"
vertex { double u; };
edge { double e; };
mesh { int m; };
void step(mesh& S) {
  int n;
  ring r;
  vertex top;
  parallel forall p in S { forall q in p q$u = 1; }
//                                       ^ error: a parallel round changes values of its own vertex, `p`, and of no other
  parallel forall p in S { n += 1; }
//                         ^^^^^^ error: `n` is one for all parallel rounds, so none may change it
  parallel forall p in S { top = p; }
//                         ^^^^^^^ error: `top` is one for all parallel rounds, so none may change it
  parallel forall p in S { add p to r; }
//                         ^^^^^^^^^^^ error: `r` is one for all parallel rounds, so none may change it
  parallel forall p in S { p = any in p; p$u = 1; }
//                         ^^^^^^^^^^^^ error: `p` is the vertex of the parallel round, and stays so
  parallel forall p in S { (p|any in p)$e = 1; }
//                         ^^^^^^^^^^^^^^^^^^ error: a parallel round changes no values of edges, for two rounds meet at each
  parallel forall p in S { S$m = 1; }
//                         ^^^^^^^ error: a parallel round changes no values of a mesh, which all share
  parallel forall p in S { erase any in p from p; }
//                         ^^^^^^^^^^^^^^^^^^^^^^ error: a parallel round edits no rings of vertices
  parallel forall p in S { vertex x; p$u = x$u; }
//                                ^ error: a parallel round makes no vertices
  parallel forall p in S { remove p from S; }
//                         ^^^^^^^^^^^^^^^^ error: a parallel round adds to no mesh and takes from none
  parallel forall p in S { synchronize S; }
//                         ^^^^^^^^^^^^^^ error: a parallel round makes no old values: they are those before the loop
  parallel forall p in S { print p; }
//                         ^^^^^^^^ error: a parallel round prints nothing, for rounds have no order
  parallel forall p in S { p$u = random(); }
//                               ^^^^^^^^ error: random numbers come in an order, and parallel rounds have none
  parallel forall p in S { if (p$u > 1) break; }
//                                      ^^^^^^ error: a parallel round leaves neither the loop nor the function
  parallel forall p in S { forall q in p if (q$u > 1) return; }
//                                                    ^^^^^^^ error: a parallel round leaves neither the loop nor the function
  print r;
}
",
    );
}

#[test]
fn a_round_has_variables_of_its_own() {
    check(
        r"
vertex { double u; vec flow; };
void step(mesh& S) {
  double most = 3;
  parallel forall p in S {
    if (gaps p > 0) continue;
    double sum = 0;
    int n = 0;
    ring r;
    forall q in p {
      if (q == null) break;
      n++;
      sum += most * n;
      add q to r;
      vertex last = q;
      last = any in last;
    }
    erase any in r from r;
    replace any in r with p in r;
    p$u = sum / n;
    p$flow.x = valence r;
  }
}
",
    );
}

#[test]
fn functions_keep_to_the_same() {
    check(
        r"
vertex { double u; };
static void mark(vertex v) { v$u = 1; }
static void mark_next(vertex v) { v = any in v; v$u = 1; }
static double around(vertex v) { double sum = 0; forall q in v sum += q$u; return sum; }
static void count(int& n) { n += 1; }
static void deep(vertex v) { mark(v); }
static void put(vertex& v, double u) { v$u = u; }
static void lead(vertex& v, vertex& w) { w = any in w; v$u = 1; }
static void lead_on(vertex v) { lead(v, v); }
static int many(vertex v, int k) { if (k > 0) return many(v, k - 1); print v; return 1; }
void step(mesh& S) {
  int n;
  parallel forall p in S { mark(p); deep(p); put(p, 2); }
  parallel forall p in S { vertex q = null; lead(p, q); }
  parallel forall p in S { lead(p, p); }
//                         ^^^^^^^^^^ error: `p` is the vertex of the parallel round, and stays so
  parallel forall p in S { lead_on(p); }
//                         ^^^^^^^^^^ error: a parallel round changes values of its own vertex, `p`, and of no other
  parallel forall p in S { mark(any in p); }
//                         ^^^^^^^^^^^^^^ error: a parallel round changes values of its own vertex, `p`, and of no other
  parallel forall p in S { mark_next(p); }
//                         ^^^^^^^^^^^^ error: a parallel round changes values of its own vertex, `p`, and of no other
  parallel forall p in S { p$pos.x = around(p); }
  parallel forall p in S { p$u = around(p); }
//                               ^^^^^^^^^ error: another round may be changing `q$u`
  parallel forall p in S { int m; count(m); p$u = m; }
  parallel forall p in S { count(n); }
//                         ^^^^^^^^ error: `n` is one for all parallel rounds, so none may change it
  parallel forall p in S { p$u = many(p, 3); }
//                               ^^^^^^^^^^ error: a parallel round prints nothing, for rounds have no order
}
",
    );
}

#[test]
fn only_rounds_over_a_mesh_are_parallel() {
    check(
        r"
void step(mesh& S) {
  parallel forall f in faces S { }
//^^^^^^^^ error: parallel rounds are those over the vertices of a mesh
  forall p in S parallel forall q in p { }
//              ^^^^^^^^ error: parallel rounds are those over the vertices of a mesh
}
",
    );
}

#[test]
fn the_mark_of_old_values_is_offered() {
    let c = compiled("void step(mesh& S) { synchronize S; parallel forall p in S forall q in p p$pos += q$pos; }");
    let (span, text) = c.diagnostics[0].hints[0].edit.clone().unwrap();
    assert_eq!((c.sources.text(Span { end: span.end + 5, ..span }), text.as_str()), ("q$pos", "`"));
    assert_eq!(
        c.diagnostics[0].hints[0].message,
        "ask for what it was: `` `q$pos ``, after `synchronize` before the loop"
    );
}

#[test]
fn the_mark_of_old_values_is_put_before_what_it_is_to_mark() {
    #[track_caller]
    fn check(value: &str, expected: &str) {
        let text = |value: &str| {
            format!(
                "vertex {{ vertex mate = null; }};\nvertex of(vertex v) {{ return v; }}\n\
                 void step(mesh& S) {{ synchronize S; parallel forall p in S p$pos = {value}; }}"
            )
        };
        let c = compiled(&text(value));
        let (span, replacement) = c.diagnostics[0].hints[0].edit.clone().unwrap();
        let mut mended = text(value);
        mended.replace_range(span.start as usize..span.end as usize, &replacement);
        assert_eq!(mended, text(expected));
        assert_eq!(compiled(&mended).diagnostics.len(), 0, "{mended}");
    }
    check("(any in p)$pos", "`(any in p)$pos");
    check("p$mate$pos", "`(p$mate)$pos");
    check("`p$mate$pos", "`(`p$mate)$pos");
    check("of(p)$pos", "`(of(p))$pos");
}

#[test]
fn parallel_is_a_name_where_no_loop_follows() {
    let c = compiled(
        "vertex { int parallel = 2; }; void step(mesh& S) { int parallel = 1; parallel = 2; \
                      forall p in S { p$parallel = parallel; } }",
    );
    assert!(c.diagnostics.is_empty(), "{:?}", c.diagnostics);
}
