//! The five listings, as the paper prints them.

use super::{mended, render, tree};
use crate::diagnostic::Severity;
use crate::source::FileId;
use crate::syntax::parse;

const INSERT: &str = "\
1 vertex insert(vertex p, vertex q) {
2 vertex x;
3 make {p, q} nb of x;
4 replace p with x in q;
5 replace q with x in p;
6 return x;
7 }
";

const POLYHEDRAL: &str = "\
1 void polyhedral(mesh& S) {
2 synchronize S;
3 mesh NV;
4
5 forall p in S{
6 forall q in ‘p {
7 if (p < q) continue;
8 vertex x = insert(p, q);
9 x$pos = (p$pos + q$pos) / 2.0;

10 add x to NV;
11 }
12 }
13 forall x in NV {
14 vertex p = any in x;
15 vertex q = nextto p in x;
16 make {nextto x in q, q, prevto x in q,
17 nextto x in p, p, prevto x in p} nb of x;
18 }
19 merge Swith NV;
20 }
";

const LOOP: &str = "\
1 void loop(mesh& S) {
2 double pi2 = 6.2832;
3 synchronize S;
4 mesh NV;
5
6 forall p in S{
7 double n = valence p;
8 double w = (5.0/8.0)/n
9 −pow(3.0/8.0 + 1.0/4.0∗cos(pi2/n),2.0)/n;

10 p$pos ∗= 1.0 − (n ∗ w);
11 forall q in ‘p {
12 p$pos += w ∗ ‘q$pos;
13 if (p < q) continue;
14 vertex x = insert(p, q);
15 x$pos = 3.0/8.0 ∗ ‘p$pos + 3.0/8.0 ∗ ‘q$pos
16 + 1.0/8.0 ∗ ‘(nextto q in ‘p)$pos
17 + 1.0/8.0 ∗ ‘(prevto q in ‘p)$pos;
18 add x to NV;
19 }
20 }
21 forall x in NV {
22 vertex p = any in x;
23 vertex q = nextto p in v;
24 make {nextto x in q, q, prevto x in q,
25 nextto x in p, p, prevto x in p} nb of x;
26 }
27 merge Swith NV;
28 }
";

const BUTTERFLY: &str = "\
1 void butterfly(mesh& S) {
2 double k = 1.0/16.0, l = 1.0/8.0, m = 1.0/2.0;
3 synchronize S;
4 mesh NV;
5
6 forall p in S{
7 forall q in ‘p {
8 if (p < q) continue;
9 vertex x = insert(p, q);

10 x$pos = m ∗ ‘p$pos + m ∗ ‘q$pos
11 + l ∗ ‘(prevto q in ‘p)$pos
12 + l ∗ ‘(nextto q in ‘p)$pos
13 − k ∗ ‘(nextto (nextto q in ‘p) in ‘p)$pos
14 − k ∗ ‘(nextto (nextto p in ‘q) in ‘q)$pos
15 − k ∗ ‘(prevto (prevto q in ‘p) in ‘p)$pos
16 − k ∗ ‘(prevto (prevto p in ‘q) in ‘q)$pos;
17 add x to NV;
18 }
19 }
20 forall x in NV {
21 vertex p = any in x;
22 vertex q = nextto p in x;
23 make {nextto x in q, q, prevto x in q,
24 nextto x in p, p, prevto x in p} nb of x;
25 }
26 merge Swith NV;
27 }
";

const SQRT3: &str = "\
1 void sqrt3(mesh& S) {
2 double pi2 = 6.28;
3 synchronize S;
4 mesh NV;
5
6 forall p in S{
7 double n = valence ‘p;
8 double w = (4.0 - 2.0 * cos(pi2 / n)) / 9.0;
9 p$pos *= (1.0 - w);

10 forall r in ‘p {
11 p$pos += ‘r$pos * w / n;
12 vertex q = nextto r in ‘p;
13 if (r < p ‖ q < p) continue;
14 vertex c;
15 c$pos = (‘p$pos + ‘r$pos + ‘q$pos) / 3.0;
16 make {p, r, q} nb of c;
17 splice c after r in p;
18 splice c after q in r;
19 splice c after p in q;
20 add c to NV;
21 }
22 }
23 forall p in S{
24 forall q in ‘p {
25 if (q < p) continue;
26 vertex x = nextto q in p;
27 vertex y = prevto q in p;
28 splice y after p in x; splice x after q in y;
29 erase q from p; erase p from q;
30 }
31 }
32 merge Swith NV;
33 }
";

/// All texts that other tests take apart.
pub const ALL: [&str; 5] = [INSERT, POLYHEDRAL, LOOP, BUTTERFLY, SQRT3];

/// As printed the listing has one error, which offers the fix; mended it is the tree given here.
#[track_caller]
fn check(listing: &str, expected: &str) {
    let (ast, diagnostics) = parse(FileId::MAIN, listing);
    let notes: Vec<_> = diagnostics.iter().filter(|d| d.severity == Severity::Note).collect();
    assert_eq!(notes.len(), 1, "one note about the line numbers");
    let errors: Vec<_> = diagnostics.iter().filter(|d| d.severity != Severity::Note).collect();
    let fixed = mended(listing, &diagnostics);
    if listing == INSERT {
        assert!(errors.is_empty(), "{}", render(listing, &diagnostics));
    } else {
        assert_eq!(errors.len(), 1, "{}", render(listing, &diagnostics));
        assert_eq!(errors[0].message, "expected `with`: a space is missing in `Swith`");
        assert_eq!(fixed, listing.replace("Swith", "S with"));
    }
    let squeeze =
        |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ").replace("( ", "(").replace(" )", ")");
    assert_eq!(squeeze(&tree(&fixed)), squeeze(expected));
    assert_eq!(super::sexpr::ast(&ast), tree(&fixed), "as printed it is read as what is meant");
}

#[test]
fn insert() {
    check(
        INSERT,
        "(fn vertex insert (vertex p, vertex q)
            (vertex x)
            (make [p q] x)
            (replace p x q)
            (replace q x p)
            (return x))",
    );
}

const CLOSING_LOOP: &str = "
    (forall x NV (block
        (vertex (= p (any x)))
        (vertex (= q (nextto p x)))
        (make [(nextto x q) q (prevto x q) (nextto x p) p (prevto x p)] x)))
    (merge S NV)";

#[test]
fn polyhedral() {
    check(
        POLYHEDRAL,
        &format!(
            "(fn void polyhedral (mesh& S)
                (synchronize S)
                (mesh NV)
                (forall p S (block
                    (forall q `p (block
                        (if (< p q) (continue))
                        (vertex (= x (call insert p q)))
                        (= x$pos (/ (+ p$pos q$pos) 2.0))
                        (add x NV)))))
                {CLOSING_LOOP})"
        ),
    );
}

#[test]
fn loop_scheme() {
    check(
        LOOP,
        &format!(
            "(fn void loop (mesh& S)
                (double (= pi2 6.2832))
                (synchronize S)
                (mesh NV)
                (forall p S (block
                    (double (= n (valence p)))
                    (double (= w (- (/ (/ 5.0 8.0) n)
                        (/ (call pow (+ (/ 3.0 8.0) (* (/ 1.0 4.0) (call cos (/ pi2 n)))) 2.0) n))))
                    (*= p$pos (- 1.0 (* n w)))
                    (forall q `p (block
                        (+= p$pos (* w `q$pos))
                        (if (< p q) (continue))
                        (vertex (= x (call insert p q)))
                        (= x$pos (+ (+ (+ (* (/ 3.0 8.0) `p$pos) (* (/ 3.0 8.0) `q$pos))
                            (* (/ 1.0 8.0) `(nextto q `p)$pos)) (* (/ 1.0 8.0) `(prevto q `p)$pos)))
                        (add x NV)))))
                {})",
            CLOSING_LOOP.replace("(nextto p x)", "(nextto p v)")
        ),
    );
}

#[test]
fn butterfly() {
    check(
        BUTTERFLY,
        &format!(
            "(fn void butterfly (mesh& S)
                (double (= k (/ 1.0 16.0)) (= l (/ 1.0 8.0)) (= m (/ 1.0 2.0)))
                (synchronize S)
                (mesh NV)
                (forall p S (block
                    (forall q `p (block
                        (if (< p q) (continue))
                        (vertex (= x (call insert p q)))
                        (= x$pos (- (- (- (- (+ (+ (+ (* m `p$pos) (* m `q$pos))
                            (* l `(prevto q `p)$pos)) (* l `(nextto q `p)$pos))
                            (* k `(nextto (nextto q `p) `p)$pos)) (* k `(nextto (nextto p `q) `q)$pos))
                            (* k `(prevto (prevto q `p) `p)$pos)) (* k `(prevto (prevto p `q) `q)$pos)))
                        (add x NV)))))
                {CLOSING_LOOP})"
        ),
    );
}

#[test]
fn sqrt3() {
    check(
        SQRT3,
        "(fn void sqrt3 (mesh& S)
            (double (= pi2 6.28))
            (synchronize S)
            (mesh NV)
            (forall p S (block
                (double (= n (valence `p)))
                (double (= w (/ (- 4.0 (* 2.0 (call cos (/ pi2 n)))) 9.0)))
                (*= p$pos (- 1.0 w))
                (forall r `p (block
                    (+= p$pos (/ (* `r$pos w) n))
                    (vertex (= q (nextto r `p)))
                    (if (|| (< r p) (< q p)) (continue))
                    (vertex c)
                    (= c$pos (/ (+ (+ `p$pos `r$pos) `q$pos) 3.0))
                    (make [p r q] c)
                    (splice c after r p)
                    (splice c after q r)
                    (splice c after p q)
                    (add c NV)))))
            (forall p S (block
                (forall q `p (block
                    (if (< q p) (continue))
                    (vertex (= x (nextto q p)))
                    (vertex (= y (prevto q p)))
                    (splice y after p x) (splice x after q y)
                    (erase q p) (erase p q)))))
            (merge S NV))",
    );
}

/// `insert` pasted above another listing: the numbers begin anew.
#[test]
fn two_listings_in_one_file() {
    let text = format!("{INSERT}\n{}", POLYHEDRAL.replace("Swith", "S with"));
    let tree = tree(&text);
    assert!(tree.starts_with("(fn vertex insert") && tree.contains("\n(fn void polyhedral"), "{tree}");
}

/// A listing pasted below text that was typed.
#[test]
fn a_listing_below_other_text() {
    let text = format!("// the midpoint scheme\n#include \"insert.vv\"\n\n{}", POLYHEDRAL.replace("Swith", "S with"));
    assert!(tree(&text).starts_with("(include \"insert.vv\")\n(fn void polyhedral"));
}
