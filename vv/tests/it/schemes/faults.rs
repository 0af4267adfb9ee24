//! The tests can fail: a wrong weight or a wrong ring in a program is found.

use super::published::{self, Refined};
use super::surface::{Around, Surface, star, wire};
use super::{Scheme, compare};

/// Whether a program with `from` changed to `to` still agrees on some star of few sectors, inside or at a boundary.
#[track_caller]
fn check(
    file: &str,
    rule: &'static str,
    around: Around,
    published: impl Fn(&Surface) -> Refined,
    faults: &[(&str, &str)],
) {
    let stars: Vec<_> = [(3, false), (4, false), (5, false), (6, false), (2, true), (4, true)]
        .into_iter()
        .map(|(n, open)| star(n, 2, around, open))
        .map(|surface| (surface.mesh(), published(&surface)))
        .collect();
    for &(from, to) in faults {
        let scheme = Scheme::changed(file, rule, from, to);
        let agrees = |(mesh, expected)| scheme.measure(mesh).and_then(|m| compare(&m, expected)).is_ok();
        assert!(!stars.iter().map(|(mesh, expected)| (mesh, expected)).all(agrees), "{file}: {to} is not noticed");
    }
}

#[test]
fn faults_in_loop_are_found() {
    let faults = [
        ("3.0/4.0", "3.0/4.1"),
        ("1.0/8.0", "1.0/8.0000001"),
        ("5.0/8.0", "5.0/8.1"),
        ("cos(tau/n)/4.0", "cos(tau/n)/3.0"),
        ("`p$pos + `q$pos) / 2.0", "`p$pos + `p$pos) / 2.0"),
        ("3.0/8.0 * (`p$pos", "4.0/8.0 * (`p$pos"),
        ("nextto x in q, q, prevto x in q", "prevto x in q, q, nextto x in q"),
        ("gaps `p == 1", "gaps `p == 2"),
    ];
    check("loop.vv", "loop", Around::Triangles, |s| published::loop_(s, false), &faults);
}

#[test]
fn faults_in_butterfly_are_found() {
    let faults = [
        ("3.0/4.0", "3.0/4.1"),
        ("1.0/4.0 + cos", "1.0/5.0 + cos"),
        ("-1.0/12.0", "-1.0/11.0"),
        ("-1.0/8.0 : 0.0", "-1.0/9.0 : 0.0"),
        ("9.0/16.0", "8.0/16.0"),
        ("nextto null in `p : prevto", "prevto null in `p : prevto"),
        ("wing(nextto a in `p", "wing(prevto a in `p"),
        ("`p$pos + `a$pos - `q$pos", "`p$pos"),
    ];
    check("butterfly.vv", "butterfly", Around::Triangles, published::butterfly, &faults);
}

#[test]
fn faults_in_sqrt3_are_found() {
    let faults = [
        ("4.0 - 2.0", "4.0 - 3.0"),
        ("/ 3.0", "/ 2.0"),
        ("prevto c in p, q", "nextto c in p, q"),
        ("forall q in `p sum", "forall q in p sum"),
    ];
    check("sqrt3.vv", "sqrt3", Around::Triangles, |s| published::sqrt3(s, false), &faults);
}

#[test]
fn faults_in_midedge_are_found() {
    let faults = [("/ 2.0", "/ 2.1"), ("make {a, b, c, d}", "make {b, a, c, d}")];
    check("midedge.vv", "midedge", Around::Quads, published::midedge, &faults);
}

#[test]
fn faults_in_catmull_clark_are_found() {
    let faults = [("(n - 2.0) * n", "(n - 3.0) * n"), ("/ 4.0", "/ 5.0"), ("s += f$pos", "s += 2.0 * f$pos")];
    check("catmull-clark.vv", "catmull_clark", Around::Quads, published::catmull_clark, &faults);
}

#[test]
fn faults_in_doo_sabin_are_found() {
    let faults = [("n + 5.0", "n + 4.0"), ("k += 1", "k += 0.5"), ("3.0 + 2.0", "3.0 + 3.0")];
    check("doo-sabin.vv", "doo_sabin", Around::Triangles, |s| published::doo_sabin(s, false), &faults);
}

#[test]
fn faults_in_quad_triangle_are_found() {
    let faults = [("2.0 * v$pos", "3.0 * v$pos"), ("q += 1", "q += 2"), ("4.0 + 2.0 * e", "4.0 + 3.0 * e")];
    check("quad-triangle.vv", "quad_triangle", Around::Quads, |s| published::quad_triangle(s, true), &faults);
}

#[test]
fn faults_in_conway_operators_are_found() {
    let faults =
        [("splice c before p in x", "splice c after p in x"), ("3.0 * p$pos / valence f", "p$pos / valence f")];
    check("conway.vv", "gyro", Around::Quads, published::gyro, &faults);
    let faults = [("/ valence f", "/ 4.1"), ("(prevto c in p) in c", "(nextto (nextto c in p) in p) in c")];
    check("conway.vv", "dual", Around::Quads, published::dual, &faults);
    let faults = [("nextto x in p, prevto x in p} nb_of x", "prevto x in p, nextto x in p} nb_of x")];
    check("conway.vv", "truncate", Around::Quads, published::truncate, &faults);
}

#[test]
fn faults_in_four_eight_are_found() {
    let faults = [("sum / kept", "sum / (kept + 1)"), ("p$pos / valence f", "p$pos / (valence f + 1)")];
    check("four-eight.vv", "four_eight", Around::Quads, |s| published::four_eight(s, true), &faults);
}

#[test]
fn faults_in_limits_are_found() {
    let faults = [("n + 3.0", "n + 2.0"), ("1.0/6.0", "1.0/5.0")];
    check("limit.vv", "loop_limit", Around::Triangles, published::loop_limit, &faults);
    let faults = [("4.0 * `q$pos", "3.0 * `q$pos"), ("n + 5.0", "n + 4.0")];
    check("limit.vv", "catmull_clark_limit", Around::Quads, published::catmull_clark_limit, &faults);
}

#[test]
fn faults_in_curves_are_found() {
    let curve = vec![vec![1], vec![0, 2], vec![1, 3], vec![2]];
    for (rule, expected, from, to) in [
        ("cubic", published::cubic(&curve), "3.0/4.0", "3.0/5.0"),
        ("four_point", published::four_point(&curve, 1.0 / 16.0), "2.0 * p$pos - q$pos", "p$pos"),
        ("chaikin", published::chaikin(&curve), "replace p with b in a;", ""),
    ] {
        let scheme = Scheme::changed("curves.vv", rule, from, to);
        let result = scheme.measure(&wire(&curve)).and_then(|measured| compare(&measured, &expected));
        assert!(result.is_err(), "{rule}: {to} is not noticed");
    }
}
