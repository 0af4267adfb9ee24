//! What texts mean.

use super::{statements, tree};

#[track_caller]
fn check(text: &str, expected: &str) {
    assert_eq!(statements(text), expected);
}

#[track_caller]
fn check_file(text: &str, expected: &str) {
    assert_eq!(tree(text), expected);
}

#[test]
fn operators_bind_as_in_cpp() {
    check("x = 1 + 2 * 3 - 4;", "(= x (- (+ 1 (* 2 3)) 4))");
    check("x = a / b / c % d;", "(= x (% (/ (/ a b) c) d))");
    check("x = -a * b;", "(= x (* (- a) b))");
    check("x = a < b == c >= d;", "(= x (== (< a b) (>= c d)))");
    check("x = a && b || !c && d != e;", "(= x (|| (&& a b) (&& (! c) (!= d e))))");
    check("x = a ? b : c ? d : e;", "(= x (? a b (? c d e)))");
    check("x = y = z += 1;", "(= x (= y (+= z 1)))");
    check("++i; i--; -+i; x = i++ + --j;", "(++ i) (post-- i) (- (+ i)) (= x (+ (post++ i) (-- j)))");
    check("x -= 1; x *= 2; x /= 3; x %= 4;", "(-= x 1) (*= x 2) (/= x 3) (%= x 4)");
    check("x = (a + b) * (c);", "(= x (* (+ a b) (c)))");
}

#[test]
fn numbers() {
    check("x = 0 + 42 + 9223372036854775807;", "(= x (+ (+ 0 42) 9223372036854775807))");
    check("x = 1. + .5 + 1.5e-3 + 2E+2 + 1e3;", "(= x (+ (+ (+ (+ 1.0 0.5) 0.0015) 200.0) 1000.0))");
    check("x = 010;", "(= x 10)");
}

#[test]
fn operands_of_the_algebra_are_unary() {
    check("x = nextto q in p == null;", "(= x (== (nextto q p) null))");
    check("x = 2 * valence p + 1;", "(= x (+ (* 2 (valence p)) 1))");
    check("x = is q in p && !is q in S;", "(= x (&& (is q p) (! (is q S))))");
    check("x = nextto nextto q in p in r;", "(= x (nextto (nextto q p) r))");
    check("x = nextto null in p$mother;", "(= x (nextto null p$mother))");
    check("x = (any in `v)$pos.x;", "(= x (any `v)$pos.x)");
    check("x = gaps p == 1 ? valence (p) : gaps(q);", "(= x (? (== (gaps p) 1) (valence (p)) (gaps (q))))");
    check("x = prevto insert(p, q) in `p;", "(= x (prevto (call insert p q) `p))");
}

#[test]
fn old_values_bind_tighter_than_properties() {
    check("x = `p$pos + 'q$pos + ‘r$pos + ’s$pos;", "(= x (+ (+ (+ `p$pos `q$pos) `r$pos) `s$pos))");
    check("x = `(nextto q in `p)$pos;", "(= x `(nextto q `p)$pos)");
    check("x = `(p|q)$sharpness;", "(= x `(p|q)$sharpness)");
}

#[test]
fn edges_carry_properties() {
    check(
        "(p|q)$sharpness = (nextto q in p | p)$sharpness - 1.0;",
        "(= (p|q)$sharpness (- ((nextto q p)|p)$sharpness 1.0))",
    );
    check("forall q in p (p|q)$sharpness = 0.0;", "(forall q p (= (p|q)$sharpness 0.0))");
    check("print (p|q)$sharpness;", "(print (p|q)$sharpness)");
}

#[test]
fn statements_of_the_algebra() {
    check(
        "make {} nb_of v; make {a} nb_of v; make {a, null, b} nb of v;",
        "(make [] v) (make [a] v) (make [a null b] v)",
    );
    check("erase any in v from v; erase null from `p$x;", "(erase (any v) v) (erase null `p$x)");
    check("replace null with x in v;", "(replace null x v)");
    check(
        "splice null after q in x; splice x before any in v in v;",
        "(splice null after q x) (splice x before (any v) v)",
    );
    check("synchronize S; synchronise S; synchronize (S);", "(synchronize S) (synchronize S) (synchronize (S))");
    check("add prevto q in p to S; add (p) to S; remove p from S;", "(add (prevto q p) S) (add (p) S) (remove p S)");
    check("merge S with T;", "(merge S T)");
    check("make r nb_of v; make in nb of nb;", "(make r v) (make in nb)");
    check("ring r, s = r; r = s;", "(ring r (= s r)) (= r s)");
    check(
        "print a, \"b\\n\", c; print(a, \"b\"); print (a + b) / 2; print -1; print; print();",
        "(print a \"b\\n\" c) (print a \"b\") (print (/ (+ a b) 2)) (print (- 1)) (print) (print)",
    );
}

#[test]
fn loops_and_branches() {
    check("forall q in `p p$pos += `q$pos;", "(forall q `p (+= p$pos `q$pos))");
    check("forall q in any in p ++n;", "(forall q (any p) (++ n))");
    check("forall q in insert(a, b) { }", "(forall q (call insert a b) (block))");
    check("forall p, q in f { }", "(forall p q f (block))");
    check("forall p, q in `v from a f(p, q);", "(forall p q `v (from a) (call f p q))");
    check("forall x in f from p, q c += 1;", "(forall x f (from p q) (+= c 1))");
    check("forall x in f from nextto p in v { }", "(forall x f (from (nextto p v)) (block))");
    check("forall f in faces S { }", "(forall f (faces S) (block))");
    check("forall f in faces part(S, 1) print f;", "(forall f (faces (call part S 1)) (print f))");
    check("if (a) if (b) x; else y; else { }", "(if a (if b x y) (block))");
    check(
        "while (true) { break; continue; return; return 1; }",
        "(while true (block (break) (continue) (return) (return 1)))",
    );
    check("do ++i; while (i < 3);", "(do (++ i) (< i 3))");
    check("for (int i = 0; i < n; i++) ;", "(for (int (= i 0)) (< i n) (update (post++ i)) ())");
    check("for (i = 0, 1; ; ) { }".replace(", 1", "").as_str(), "(for (= i 0) () (update) (block))");
    check("for (;;) { ; }", "(for () () (update) (block ()))");
    check("for (;; ++i, --j) f(i);", "(for () () (update (++ i) (-- j)) (call f i))");
}

#[test]
fn declarations() {
    check("double x = 0, y, z = x;", "(double (= x 0) y (= z x))");
    check("const double a = 1, b = 2;", "(const double (= a 1) (= b 2))");
    check(
        "vec a(1, 2, 3), b = vec(1, 2, 3); point c; vector d(a);",
        "(vec (= a (call vec 1 2 3)) (= b (call vec 1 2 3))) (vec c) (vec (= d a))",
    );
    check(
        "int i(3); vertex v; mesh M = S; bool b = true;",
        "(int (= i 3)) (vertex v) (mesh (= M S)) (bool (= b true))",
    );
    check(
        "x = double(i) + int(d) + point(1, 2, 3).x;",
        "(= x (+ (+ (call double i) (call int d)) (call point 1 2 3).x))",
    );
}

/// The words of the algebra are names where they cannot be anything else.
#[test]
fn words_are_contextual() {
    check(
        "vec point = vec(0, 0, 0); point = p$pos; point.x = 1;",
        "(vec (= point (call vec 0 0 0))) (= point p$pos) (= point.x 1)",
    );
    check(
        "int step = 1, in = 2, any = 3, add = 4; add = in + any * step;",
        "(int (= step 1) (= in 2) (= any 3) (= add 4)) (= add (+ in (* any step)))",
    );
    check(
        "vertex any; x = nextto any in p; if (is any in S) erase any from p;",
        "(vertex any) (= x (nextto any p)) (if (is any S) (erase any p))",
    );
    check("vertex in; forall in in S splice in after in in in;", "(vertex in) (forall in S (splice in after in in))");
    check(
        "print = 1; print += 2; print$x = 3; make = 4; merge++;",
        "(= print 1) (+= print 2) (= print$x 3) (= make 4) (post++ merge)",
    );
    check("add(p, q); erase(x); x = remove(p) + 1;", "(call add p q) (call erase x) (= x (+ (call remove p) 1))");
    check("add (any in v)$mate to S;", "(add (any v)$mate S)");
    check("valence = 3; x = valence * gaps - is;", "(= valence 3) (= x (- (* valence gaps) is))");
    check(
        "vertex to, from, with, after; add to to S; erase from from with; replace with with after in to;",
        "(vertex to from with after) (add to S) (erase from with) (replace with after to)",
    );
    check(
        "make {nb, of, nb_of} nb_of nb; x = start + param + edge;",
        "(make [nb of nb_of] nb) (= x (+ (+ start param) edge))",
    );
    check("S$mesh = p$vertex + p$in;", "(= S$mesh (+ p$vertex p$in))");
}

#[test]
fn items() {
    check_file("#include \"a/insert.vv\"\n#include \"b.vv\"", "(include \"a/insert.vv\")\n(include \"b.vv\")");
    check_file(
        "const double k = 1.0/16.0, l = 2; double m = 3;",
        "(const double (= k (/ 1.0 16.0)) (= l 2))\n(double (= m 3))",
    );
    check_file("vec up(0, 0, 1);", "(vec (= up (call vec 0 0 1)))");
    check_file(
        "param double w = 1.0/16.0 in [0, 0.125]; param int n = 3; param bool flag = true;",
        "(param double w (/ 1.0 16.0) [0 0.125])\n(param int n 3)\n(param bool flag true)",
    );
    check_file(
        "vertex { double age = 0; int kind, level = 1; };\nedge { double sharpness = 0; }\nmesh { int generation = 0; };",
        "(properties vertex (double (= age 0)) (int kind (= level 1)))\n(properties edge (double (= sharpness 0)))\n(properties mesh (int (= generation 0)))",
    );
    check_file("start { add p to S; }\nstep { synchronize S; }", "(start (add p S))\n(step (synchronize S))");
    check_file(
        "static vec mean(const vec& a, vec b, mesh &S) { return a; };",
        "(static fn vec mean (const vec& a, vec b, mesh& S) (return a))",
    );
    check_file("void f() { }\nint g(void) { return 1; }", "(fn void f ())\n(fn int g () (return 1))");
    check_file("", "");
    check_file(" // nothing\n /* at all */ ", "");
}
