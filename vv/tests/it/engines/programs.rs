//! Programs that use all of the language, and what compiled code may take for granted.

/// Uses every kind of expression and statement, with values that tell right from wrong.
pub const EVERYTHING: &str = r#"
vertex { double age = 1.5; vec dir = vec(1, 2, 3); int n = 4; bool flag = true; vertex mate; };
mesh { int generation = 3; vec centre; };
param int count = 5;
const double half = count / 2.0 - 2.0;

double longer(double x, double y) {
  double sum = 0;
  for (int i = 0; i < 12; i++) {
    if (i == 7) continue;
    if (i % 5 == 4) sum -= x / (i + 1.0); else sum += x * y + i;
    sum += sum > 100 ? -50 : floor(sum) / 8;
    sum = min(sum, 1e6) - max(-sum, -1e6) * 0.125 + abs(i - 6) + fabs(x) + clamp(y, 0, 1) + hypot(x, y);
  }
  return sum;
}
int factorial(int n) { return n <= 1 ? 1 : n * factorial(n - 1); }
double slow(double x, int n) { if (n == 0) return x; return slow(x * 0.5 - 1, n - 1) + x; }
vertex first(mesh& S) { forall v in S { if (valence v > 4) return v; } return null; }
mesh far(mesh S, double x) { mesh T; forall v in S { if (v$pos.x > x) add v to T; } return T; }
void swap(vertex& a, vertex& b) { vertex c = a; a = b; b = c; }
vertex insert(vertex p, vertex q) {
  vertex x; make {p, q} nb_of x; replace p with x in q; replace q with x in p; return x;
}

void step(mesh& S) {
  synchronize S;
  mesh T, U;
  print "begin ", count, " ", half, " ", longer(half, 0.75), " ", factorial(10), " ", slow(3, 20);
  forall p in S {
    p$n += valence p * 2 - gaps p; p$age *= 0.5 + p$pos.x; p$dir = cross(p$dir, p$pos) + -p$dir; p$mate = any in p;
    p$flag = is p in S && !(is p in T) || is null in p;
    p$pos.y += length(p$dir) + dot(p$dir, `p$pos) + distance(p$pos, `p$pos) + sin(p$age) + pow(p$age, 1.5) + sqrt(2);
    print p, p$n, " ", p$age, p$dir, p$mate, p$flag, p$pos, `p$pos, normalize(p$pos);
    forall q in `p {
      vertex a = nextto q in `p, b = prevto q in `p;
      print q, a, b, " ", p < q, a <= b, q != a, p == q, is q in p, gaps q;
      if (p < q) continue;
      if (is q in p && valence p > 2) {
        vertex x = insert(p, q);
        x$pos = 0.5 * `p$pos + `q$pos / 2;
        add x to T;
        print x, any in x, nextto p in x, prevto q in `p, nextto x in p, x$n, x$age, x$dir, x$flag, x$mate;
      }
    }
  }
  forall x in T {
    vertex p = any in x, q = nextto p in x;
    if (nextto x in q && prevto x in p) make {nextto x in q, q, prevto x in q, nextto x in p, p, prevto x in p} nb_of x;
  }
  vertex v = first(S), w = null;
  print v; vertex top = v; swap(v, w);
  print v, w, S$generation, S$centre;
  S$generation += 2; S$centre = vec(1, 2, 3); S$centre.z = 7;
  if (w) {
    vertex y;
    vertex z, u, k = any in w; splice y after k in w; splice z before y in w; splice u before k in w;
    make {k, w} nb_of z; splice y after k in z; splice u before w in z; erase k from z; forall q in z { print q; }
    erase k from w;
    splice null before y in w; erase null from w;
    forall q in w { erase q from w; print q, valence w, gaps w; }
    forall q in w { print q; }
    make {y, k, null} nb_of w;
    print valence w, gaps w, nextto null in w, prevto null in w;
  }
  U = far(T, -100); merge S with U; merge S with far(T, 0.25);
  remove top from U; forall x in T { remove x from U; if (x$n > 3) break; }
  print U, S, S$generation, S$centre;
  int i = 7; double d = 2.75; bool b = d > 2;
  i += 3; i -= 1; i *= 2; i /= 4; i %= 3; i++; --i; d++; d -= 0.5; i = d * 3; int j = b; double e = b;
  int minus = -7; double m = minus;
  print i, d, b, j, e, m, minus / 2, minus % 4, min(i, j), max(i, j), (bool)1, vec(1, 2, 3) == vec(1, 5, 3), b == (d > 1);
  do { i--; if (i < -3) break; if (i == 0) continue; print i; } while (i > -10);
}
"#;

/// Edge values, which go through splits, and rings that are edited beside them.
pub const EDGES: &str = r#"
edge { double s = 0.25; vec way; vertex via; };
void step(mesh& S) {
  synchronize S;
  forall p in S { forall q in p { (p|q)$s += p < q ? 1.5 : 0.125; (p|q)$way.y = (p|q)$s; (p|q)$via = p; } }
  forall p in S { forall q in `p {
    print p, q, `(p|q)$s, (q|p)$s, (p|q)$way, (p|q)$via;
    if (p < q) continue;
    vertex x; make {p, q} nb_of x; replace p with x in q; replace q with x in p;
    splice null after q in x; add x to S;
    print (p|x)$s, (x|q)$s; erase x from p; vertex f = any in p; if (f != null) splice x after f in p;
  } }
}
"#;

/// Rings as values, faces, pairs, and loops that begin somewhere.
pub const RINGS: &str = r#"
ring turned(ring r) { ring s; forall x in r from nextto any in r in r add x to s; return s; }
void grow(ring& r, vertex x) { add x to r; add any in r to r; }
void show(ring r) { print r, " ", valence r, any in r; }
void step(mesh& S) {
  synchronize S;
  mesh C;
  ring kept;
  int n = 0;
  forall f in faces S {
    ring r;
    vertex c;
    n++;
    show(f); print f, n, any in f;
    forall p, q in f {
      c$pos += p$pos * n + q$pos / 3;
      print p, q, nextto q in f, prevto p in f, is c in f;
      forall x in f from p, q { print x; if (x == q) break; }
      forall x, y in p from q { print x, y; }
      add q to r;
      if (p < q) splice c after q in p;
    }
    r = turned(r);
    print r, f, n % 2 == 0 ? r : f;
    if (n % 3 == 0) kept = r;
    make r nb_of c; add c to C;
    grow(r, c); print r, valence r;
    erase any in r from r; replace any in r with c in r; splice c before any in r in r; splice c after c in r;
    print r, is c in r, nextto c in r, prevto c in r;
    forall x in r { add c to r; if (valence r > 30) { print r; break; } }
  }
  forall p, q in kept from nextto any in kept in kept, prevto any in kept in kept print p, q;
  ring long;
  forall v in S { forall p, q in v { print v, p, q; add q to long; } forall p, q in `v print p, q; }
  print long, valence long, nextto any in long in long;
  vertex hub, far; ring eight;
  forall x in long { if (!(is x in eight) && valence eight < 8) add x to eight; }
  make eight nb_of hub; print hub; forall p, q in hub from any in eight print p, q;
  erase any in eight from eight; make eight nb_of hub; print valence hub; forall q in hub { erase q from hub; print q; }
  merge S with C;
  forall f in faces C show(f);
}
"#;

/// Parallel loops with all that their rounds may do.
pub const PARALLEL: &str = "
vertex { double u = 1; double du; int n; vertex mate; vec was; bool high; };
edge { double s = 2; };
mesh { double scale = 0.5; };
param int count = 3;

static vec mean(vertex p) { vec m; forall q in `p m += `q$pos; return m / (1.0 + valence `p); }
static void raise(vertex p, double x) { if (x > 1) { p$u += x; return; } p$n++; }
static void twice(double& x) { x *= 2; }
static double deep(vertex p, int n) { return n > 0 ? deep(any in p, n - 1) + 1 : `p$pos.x; }
static void grow(double& x, int n) { if (n > 0) { grow(x, n - 1); x += n; } }

void step(mesh& S) {
  double x = 1.25, z = 0.25; int k = 2; vec shift = vec(1, 2, 3); bool yes = true; vertex top; mesh T, N;
  forall p in S { p$u = x; x += 0.125; top = p; if (valence p > 2) add p to T; }
  remove any in top from T;
  grow(x, 3);
  synchronize S;
  parallel forall p in S {
    if (p == any in top) continue;
    p$pos = mean(p) + shift * S$scale;
    p$was = `p$pos;
    p$pos.y += z;
  }
  parallel forall p in S {
    double sum = 0; int m;
    forall q in p {
      if (is q in T) continue;
      sum += cos(tau / valence q) + pow(valence q, 1.5) + (p|q)$s;
      m += q < p;
      forall r in q { if (r == p) break; sum += `r$pos.y; }
    }
    p$du = sum; p$n += m + gaps p; p$high = yes && is top in p;
    p$mate = nextto any in p in p;
    forall q, r in `p from any in `p p$u += q$pos.x * r$pos.y;
  }
  parallel forall p in S {
    double y = p$du, w = x;
    grow(y, 2);
    twice(y);
    raise(p, clamp(y, -2, 2) + deep(p, count) + w);
    p$u /= hypot(z, length(p$pos));
  }
  parallel forall p in T {
    for (int i = 0; i < 4; i++) { if (i == 2) continue; p$n += i * k; }
    while (p$n > 10) p$n -= 3;
  }
  parallel forall p in N p$n = 1;
}
";

/// A mistake in these ends in no error, which would be found by the interpreter.
pub const APPENDED: &str = "
void step(mesh& S) {
  ring r;
  forall v in S { if (valence r < 5) add v to r; }
  print r;
  vertex v; make r nb_of v; add v to S;
  forall q in v print q;
}
";

/// What compiled code knows of new vertices and spares itself to ask: the first end in an error, the others do not.
/// `a`, `b` and `c` are a face of an octahedron.
pub const NEW: [&[&str]; 2] = [
    &[
        "vertex x; replace a with x in b; replace c with x in b;",
        "vertex x; splice x after a in b; splice x after c in b;",
        "vertex x; if (a < c) replace a with x in b; replace c with x in b;",
        "vertex x; if (a > c) print a; else replace a with x in b; replace c with x in b;",
        "vertex x; forall q in a splice x after any in b in b;",
        "vertex x; for (int i = 0; i < 2; i++) { if (i > 0) replace c with x in b; replace a with x in b; }",
        "vertex x; while (!(is x in b && valence x)) { make {a} nb_of x; replace any in b with x in b; \
         if (is a in x) replace nextto x in b with x in b; }",
        "vertex x, y; if (a < c) y = x; replace a with y in b; replace c with x in b;",
        "vertex x, y = a < c ? x : null; replace a with y in b; replace c with x in b;",
        "vertex x; a$mate = x; replace a with a$mate in b; replace c with x in b;",
        "vertex x; replace a with x in b; vertex y = prevto c in b; replace c with y in b;",
        "vertex x; put(x, b, 2); replace c with x in b;",
        "vertex x; put(x, b, 0); replace c with x in b;",
        "vertex x; ring r; add x to r; add c to r; make r nb_of b; replace c with x in b;",
        "vertex x, p = a < c ? b : c; replace a with x in p; replace c with x in b;",
        "vertex x, y; replace a with y in b; replace c with x in b; replace y with x in b;",
        "vertex x; make {x, a} nb_of b; replace a with x in b;",
        "vertex x; make {a, a} nb_of x;",
        "vertex x, y = a; make {a, y} nb_of x;",
        "vertex x, y = prevto b in a; make {y, prevto b in a} nb_of x;",
        "vertex x; make {a, x} nb_of x;",
        "vertex x; make {a, b, c, any in a, nextto any in a in a} nb_of x;",
        "vertex x; make {a, b, c, x, any in b} nb_of x;",
        "vertex x; make {a, b, c, a} nb_of x;",
        "vertex d = nextto c in a, e = prevto c in a, x; make {c, b, d, e} nb_of x;",
        "vertex d = nextto c in a, x; make {c, d, nextto c in a, b} nb_of x;",
        "replace a with b in b;",
        "synchronize S; vertex x; vec v = `a$pos + `x$pos;",
        "synchronize S; vertex x; vec v = `a$pos + `(nextto x in `a)$pos;",
        "vec v = `a$pos + `b$pos;",
        "replace a with any in b in b;",
        "forall q in b replace q with b in b;",
        "vertex x; make {b} nb_of x; replace b with x in x;",
        "vertex x, y = a > c ? b : x; make {c, b} nb_of y; replace b with x in y;",
        "vertex x; make {a, b, c} nb_of x; splice x after a in b; splice x after c in b;",
        "vertex x = nextto (nextto c in b) in a; erase a from x;",
        "vertex x = nextto c in a; erase b from x; splice c after b in a;",
    ],
    &[
        "vertex x; make {a, b} nb_of x; replace a with x in b; replace b with x in a; print any in x, nextto b in x;",
        "vertex x; make {a, b} nb_of x; make {c} nb_of x; make {b, c, a} nb_of x; erase c from x; print any in x;",
        "vertex x; erase a from x; make {a, b} nb_of x; erase a from x; make {c, a, b} nb_of x; print nextto c in x;",
        "vertex x; make {} nb_of x; make {a} nb_of x; print nextto a in x, prevto b in x;",
        "vertex x, y = a < c ? x : a; make {a} nb_of y; make {b, c} nb_of x; print any in x, nextto b in x;",
        "vertex x, y; make {x, a} nb_of y; make {y, a} nb_of x; replace a with b in x; replace a with x in b; print x, y;",
        "for (int i = 0; i < 3; i++) { vertex x; make {b, a} nb_of x; splice x after a in b; erase b from x; }",
        "vertex x; replace a with x in b; erase x from b; splice x before c in b; print any in b, nextto c in b;",
        "vertex x; put(x, b, 2); print is x in b;",
        "vertex x; make {a, nextto x in b} nb_of x; print valence x, gaps x;",
        "synchronize S; forall q in `a { vertex x; erase any in a from a; replace q with x in a; }",
        "synchronize S; forall q in `a { vertex x, y; splice y before any in a in a; replace q with x in a; }",
        "synchronize S; make {c, b} nb_of a; forall q in `a { vertex x; replace q with x in a; }",
        "synchronize S; make {} nb_of a; forall q in `a { vertex x; replace q with x in a; splice x after q in b; }",
        "synchronize S; vertex p = a < c ? b : c; forall q in `a { vertex x; replace q with x in p; replace p with x in a; }",
        "mesh T; add a to T; remove a from T; vertex x; add x to T; add b to T; print T, is x in T, is a in T, is c in T;",
        "a$mate = b; vec v = a$pos + a$mate$pos * 2 - (nextto a in b)$pos; b$pos = v.x * v + a$pos; print v, b$pos;",
        "vertex x; make {a, b, c, nextto x in a} nb_of x; print valence x, gaps x;",
        "vertex d = nextto b in a, e = nextto d in a, f = nextto e in a, g = prevto f in a; print d, e, f, g, prevto d in a;",
        "vertex d = nextto b in a, x; print nextto d in a; replace d with x in a; print prevto x in a, nextto x in a;",
        "vertex d = nextto b in a; print nextto d in a; erase b from a; print nextto d in a, prevto d in a;",
        "vertex d = prevto b in a; erase b from a; print nextto d in a; splice b before d in a; print nextto d in a;",
        "int g = gaps a; splice null after b in a; print g, gaps a, valence a, valence b; erase null from a; print gaps a;",
        "vertex d = nextto c in a, e = prevto c in a, x; make {c, a, d, e} nb_of x; print nextto a in x, nextto e in x;",
        "vertex x, y; make {a, b, c, y, nextto x in a, any in x} nb_of x; print valence x, gaps x;",
        "vertex x; make {a, b, c} nb_of x; splice x after a in b; splice x after b in c; splice x after c in a;",
        "vertex x = nextto c in a, y = prevto c in a; splice y after c in x; erase c from y; erase c from a; print any in a;",
        "vertex x = prevto b in a; erase b from x; erase b from a; erase a from b;",
        "vertex x = nextto c in a; erase a from x; erase b from a; erase c from a;",
        "vertex x = nextto c in a; erase a from x; vertex y; splice y before any in a in a; splice y after c in x; erase c from a;",
        "vertex x = nextto c in a, y = a < c ? a : c; erase a from x; erase b from y; erase c from a;",
        "vertex x = nextto c in a; erase a from x; make {c, b} nb_of a; vertex y; splice y after c in a; print nextto c in a;",
        "vertex x = nextto c in a; if (a < c) { erase a from x; erase b from a; } else erase x from a; print prevto c in a;",
        "vertex x = nextto c in a; print is a in x; vertex y; replace c with y in a; splice y after c in a; erase c from a;",
        "vertex x, y; make {a} nb_of x; make {b, c, a} nb_of y; vertex n = a; \
         for (int i = 0; i < 20; i++) { vertex z; splice z after n in x; print nextto z in x, prevto n in x; n = z; } \
         forall q in x { erase q from x; print valence x; forall r in x print r; } forall q in y print q;",
        "splice null after b in a; vertex x, y; make {b, c} nb_of x; erase b from x; erase c from x; splice y after b in x; \
         splice y before c in x; print valence x, y; make {b, c} nb_of x; splice y after b in x; print nextto b in x;",
        "forall p in a { vertex q = nextto p in a; print p < c || q < c, p < c && q < c, p > c || q > c, p > c && q > c; }",
        "vertex x, y; make {a} nb_of x; make {b, c, a} nb_of y; vertex n = a; splice null after b in a; \
         for (int i = 0; i < 20; i++) { vertex z; splice z after n in x; if (i % 3) splice z before b in a; n = z; } \
         forall q in x { if (q == a) continue; erase q from x; erase q from a; splice q after c in a; print prevto q in a; } forall q in a print q;",
        "vertex x; make {a, b, c} nb_of x; erase c from x; splice c after a in x; erase b from x; splice b before c in x; \
         erase a from x; splice a after b in x; forall q in x print q, nextto q in x, prevto q in x;",
        "synchronize S; forall q in `a { vertex d = nextto q in `a, x; make {a, q, d} nb_of x; splice x after q in d; \
         print nextto q in `a, prevto q in `a, any in x; }",
        "vertex x, y; make {a} nb_of x; make {b, c, a} nb_of y; vertex n = a; \
         for (int i = 0; i < 20; i++) { vertex z; splice z before n in x; n = i % 2 ? z : n; } forall q in x print q; \
         while (valence x) { vertex q = any in x; q = nextto q in x; q = nextto q in x; erase q from x; print q; } \
         forall q in y print q;",
    ],
];
