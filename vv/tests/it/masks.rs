//! The masks that [`vv::masks`] finds, against the closed forms that were published, for all valences from 3 to 12.

use std::f64::consts::TAU;
use std::iter::once;
use std::ops::{Add, Mul, Sub};
use std::path::Path;

use vv::engine::{Engine, Machine, Settings};
use vv::masks::{Around, Class, Fault, Star, classes, fraction, judge, measure, measure_vertex, same_classes};
use vv::mesh::build::{Polygons, build};
use vv::mesh::{Mesh, Vertex};
use vv::stop::Stop;

fn machine(text: &str) -> Machine {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/programs");
    let mut include = |_: &str, path: &str| {
        let text = std::fs::read_to_string(folder.join(path)).map_err(|e| e.to_string())?;
        Ok(vv::Included { name: path.to_owned(), text })
    };
    let compilation = vv::compile("program", text, &mut include);
    assert_eq!(compilation.diagnostics, []);
    Machine::new(compilation.program.unwrap(), Engine::Native)
}

fn found(machine: &Machine, star: &Star) -> (Vec<Class>, Vec<Fault>) {
    let rule = machine.program().default_rule().unwrap();
    let masks = measure(machine, rule, &star.mesh, &Settings::default()).unwrap();
    (classes(star, &masks), masks.faults)
}

/// A weight, and the fraction that it is, if it is one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Weight {
    value: f64,
    fraction: Option<(i64, i64)>,
}

/// A fraction.
fn of(numerator: i64, denominator: usize) -> Weight {
    let (denominator, mut a, mut b) = (denominator as i64, numerator.abs(), denominator as i64);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    let fraction = Some((numerator / a.max(1), denominator / a.max(1)));
    Weight { value: numerator as f64 / denominator as f64, fraction }
}

/// The cosine of j/n of a whole turn: a fraction in all cases in which it is one (Niven).
fn cos(j: usize, n: usize) -> Weight {
    let value = (j as f64 * TAU / n as f64).cos();
    if !(12 * j).is_multiple_of(n) {
        return Weight { value, fraction: None };
    }
    match 12 * j / n % 12 {
        0 => of(1, 1),
        2 | 10 => of(1, 2),
        3 | 9 => of(0, 1),
        4 | 8 => of(-1, 2),
        6 => of(-1, 1),
        _ => Weight { value, fraction: None },
    }
}

impl Weight {
    fn with(self, other: Self, value: f64, exact: impl Fn((i64, i64), (i64, i64)) -> (i64, i64)) -> Self {
        let fraction = self.fraction.zip(other.fraction).map(|(a, b)| exact(a, b));
        match fraction {
            Some((numerator, denominator)) => Self { value, ..of(numerator, denominator as usize) },
            None => Self { value, fraction: None },
        }
    }

    /// As it is printed, if it is a fraction.
    fn text(self) -> Option<String> {
        let (numerator, denominator) = self.fraction?;
        Some(if denominator == 1 { numerator.to_string() } else { format!("{numerator}/{denominator}") })
    }
}

fn sum((a, b): (i64, i64), (c, d): (i64, i64)) -> (i64, i64) {
    (a * d + c * b, b * d)
}

fn product((a, b): (i64, i64), (c, d): (i64, i64)) -> (i64, i64) {
    (a * c, b * d)
}

impl Add for Weight {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.with(other, self.value + other.value, sum)
    }
}

impl Mul for Weight {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.with(other, self.value * other.value, product)
    }
}

impl Sub for Weight {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.with(other, self.value - other.value, |a, (c, d)| sum(a, (-c, d)))
    }
}

/// Masks as weights by name.
type Mask = Vec<(String, Weight)>;
type Expected = Vec<Mask>;

#[track_caller]
fn check(program: &str, around: Around, expected: impl Fn(usize) -> Expected) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/programs");
    let machine = machine(&std::fs::read_to_string(folder.join(program)).unwrap());
    for n in 3..=12 {
        let star = Star::new(n, around, false).unwrap();
        let (classes, faults) = found(&machine, &star);
        assert_eq!(faults, [], "{program}, valence {n}");
        let expected = expected(n);
        assert_eq!(classes.len(), expected.len(), "{program}, valence {n}: {classes:#?}");
        for expected in &expected {
            // A class shows one of its turns; the expected one is meant up to a turn.
            let turned: Vec<Mask> = (0..n).map(|by| turn(expected, by, n)).collect();
            let fits = |class: &&Class| {
                turned.iter().any(|expected| {
                    class.mask.len() == expected.len()
                        && expected.iter().all(|(name, weight)| {
                            let is = |w: f64| (w - weight.value).abs() <= 1e-12 && fraction(w) == weight.text();
                            class.mask.iter().any(|(v, w)| star.name(*v) == *name && is(*w))
                        })
                })
            };
            let class = classes
                .iter()
                .find(fits)
                .unwrap_or_else(|| panic!("{program}, valence {n}: no {expected:?} in {classes:#?}"));
            assert!(class.symmetric, "{program}, valence {n}: {class:?}");
        }
        let other = star.reversed().unwrap();
        assert!(same_classes(&classes, &found(&machine, &other).0), "{program}, valence {n}: the order matters");
    }
}

/// `q2+q3` turned by one is `q3+q4`.
fn turn(mask: &[(String, Weight)], by: usize, n: usize) -> Mask {
    let name = |name: &String| {
        let along = |part: &str| match part.split_once('q') {
            Some((times, ray)) => format!("{times}q{}", (ray.parse::<usize>().unwrap() - 1 + by) % n + 1),
            None => part.to_owned(),
        };
        name.split('+').map(along).collect::<Vec<_>>().join("+")
    };
    mask.iter().map(|(of, w)| (name(of), *w)).collect()
}

fn q(i: usize, n: usize) -> String {
    format!("q{}", (i - 1) % n + 1)
}

/// Across the face between two neighbours.
fn c(i: usize, n: usize) -> String {
    format!("{}+{}", q(i, n), q(i + 1, n))
}

fn p() -> String {
    "p".to_owned()
}

fn all(n: usize, name: impl Fn(usize, usize) -> String, weight: Weight) -> impl Iterator<Item = (String, Weight)> {
    (1..=n).map(move |i| (name(i, n), weight))
}

#[test]
fn loop_() {
    // Loop 1987: β = (5/8 − (3/8 + cos(τ/n)/4)²) / n
    check("loop.vv", Around::Triangles, |n| {
        let root = of(3, 8) + of(1, 4) * cos(1, n);
        let beta = of(1, n) * (of(5, 8) - root * root);
        let vertex = once((p(), of(1, 1) - of(n as i64, 1) * beta)).chain(all(n, q, beta)).collect();
        let edge = vec![(p(), of(3, 8)), (q(1, n), of(3, 8)), (q(2, n), of(1, 8)), (q(n, n), of(1, 8))];
        vec![vertex, edge]
    });
}

#[test]
fn sqrt3() {
    // Kobbelt 2000: α = (4 − 2 cos(τ/n)) / 9
    check("sqrt3.vv", Around::Triangles, |n| {
        let alpha = of(1, 9) * (of(4, 1) - of(2, 1) * cos(1, n));
        let vertex = once((p(), of(1, 1) - alpha)).chain(all(n, q, of(1, n) * alpha)).collect();
        vec![vertex, vec![(p(), of(1, 3)), (q(1, n), of(1, 3)), (q(2, n), of(1, 3))]]
    });
}

#[test]
fn butterfly() {
    // Zorin, Schröder and Sweldens 1996
    check("butterfly.vv", Around::Triangles, |n| {
        let edge = if n == 6 {
            let near = [(p(), of(1, 2)), (q(1, n), of(1, 2)), (q(2, n), of(1, 8)), (q(6, n), of(1, 8))];
            let far = [q(3, n), q(5, n), c(1, n), c(6, n)].map(|name| (name, of(-1, 16)));
            near.into_iter().chain(far).collect()
        } else {
            let weight = |j: usize| match (n, j) {
                (3, 0) => of(5, 12),
                (3, _) => of(-1, 12),
                (4, 0) => of(3, 8),
                (4, 2) => of(-1, 8),
                (4, _) => of(0, 1),
                _ => of(1, n) * (of(1, 4) + cos(j, n) + of(1, 2) * cos(2 * j, n)),
            };
            let around = (0..n).map(|j| (q(j + 1, n), weight(j))).filter(|(_, w)| w.value.abs() > 1e-12);
            once((p(), of(3, 4))).chain(around).collect()
        };
        vec![vec![(p(), of(1, 1))], edge]
    });
}

#[test]
fn catmull_clark() {
    // Catmull and Clark 1978
    check("catmull-clark.vv", Around::Quads, |n| {
        let vertex = once((p(), of(1, 1) - of(7, 4 * n)))
            .chain(all(n, q, of(3, 2 * n * n)))
            .chain(all(n, c, of(1, 4 * n * n)))
            .collect();
        let sides = [q(2, n), q(n, n), c(1, n), c(n, n)].map(|name| (name, of(1, 16)));
        let edge = [(p(), of(3, 8)), (q(1, n), of(3, 8))].into_iter().chain(sides).collect();
        let face = [p(), q(1, n), q(2, n), c(1, n)].map(|name| (name, of(1, 4))).into();
        vec![vertex, edge, face]
    });
}

#[test]
fn doo_sabin() {
    // Doo and Sabin 1978: in a quad 9/16, 3/16, 3/16, 1/16, whatever the valence
    check("doo-sabin.vv", Around::Quads, |n| {
        vec![vec![(p(), of(9, 16)), (q(1, n), of(3, 16)), (q(2, n), of(3, 16)), (c(1, n), of(1, 16))]]
    });
}

#[test]
fn doo_sabin_in_faces_of_any_size() {
    // 1/4 + 5/(4n) at the corner itself, (3 + 2 cos(jτ/n)) / (4n) at the j-th one from it
    let machine = machine(&shipped("programs", "doo-sabin.vv"));
    let rule = machine.program().default_rule().unwrap();
    for n in 3..=12 {
        let prism = prism(n);
        let masks = measure(&machine, rule, &prism, &Settings::default()).unwrap();
        assert_eq!(masks.faults, [], "{n} corners");
        // Of the vertices made in the upper face; a prism on a square is made of squares alone.
        let of_top = |mask: &&Vec<(Vertex, f64)>| mask.len() == n && mask.iter().all(|(v, _)| v.index() < n);
        let found: Vec<_> = masks.weights.iter().filter(of_top).collect();
        assert_eq!(found.len(), n, "{n} corners");
        for mask in found {
            let own = mask.iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap().0.index();
            for &(v, w) in mask {
                let expected = match (v.index() + n - own) % n {
                    0 => of(1, 4) + of(5, 4 * n),
                    j => of(1, 4 * n) * (of(3, 1) + of(2, 1) * cos(j, n)),
                };
                assert!((w - expected.value).abs() <= 1e-12, "{n} corners: {w}, not {expected:?}");
                assert_eq!(fraction(w), expected.text(), "{n} corners: {w}");
            }
        }
    }
}

/// Its upper face first.
fn prism(n: usize) -> Mesh {
    let corner = |i: usize, z: f64| {
        let angle = i as f64 * TAU / n as f64;
        glam::dvec3(angle.cos(), angle.sin(), z)
    };
    let points = (0..n).map(|i| corner(i, 1.0)).chain((0..n).map(|i| corner(i, 0.0))).collect();
    let mut polygons = Polygons::new(points);
    let (top, number) = (n as u32, |i: usize| (i % n) as u32);
    polygons.push((0..n).map(number), None).unwrap();
    polygons.push((0..n).rev().map(|i| top + number(i)), None).unwrap();
    for i in 0..n {
        let side = [number(i), top + number(i), top + number(i + 1), number(i + 1)];
        polygons.push(side, None).unwrap();
    }
    build(polygons, true, &Stop::new()).unwrap().0
}

#[test]
fn what_is_no_mask_is_said() {
    let star = Star::new(6, Around::Triangles, false).unwrap();
    let faults = |body: &str| found(&machine(&format!("void step(mesh& S) {{ {body} }}")), &star).1;
    assert_eq!(faults("forall v in S v$pos += 0.0 * v$pos;"), []);
    assert!(matches!(faults("forall v in S v$pos = 2.0 * v$pos;")[0], Fault::Sum { sum: 2.0, .. }));
    assert!(matches!(faults("forall v in S v$pos.z += 1;")[0], Fault::NotAffine { .. }));
    assert!(matches!(
        faults("forall v in S v$pos.z = v$pos.z * v$pos.z;")[0],
        Fault::Sum { .. } | Fault::NotAffine { .. }
    ));
    let moving = "forall v in S { if (v$pos.x > 3.4) { vertex q = any in v; erase q from v; erase v from q; } }";
    assert_eq!(faults(moving), [Fault::Connectivity]);
}

#[test]
fn the_order_of_vertices_is_found_to_matter() {
    // Each vertex goes half way to a neighbour; the later see where the earlier went.
    let greedy = machine("void step(mesh& S) { forall v in S { vertex q = any in v; v$pos = (v$pos + q$pos) / 2; } }");
    let star = Star::new(5, Around::Triangles, false).unwrap();
    let other = star.reversed().unwrap();
    assert!(!same_classes(&found(&greedy, &star).0, &found(&greedy, &other).0));
}

fn shipped(folder: &str, name: &str) -> String {
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets");
    std::fs::read_to_string(assets.join(folder).join(name)).unwrap()
}

fn mesh(name: &str) -> Mesh {
    vv::io::read(shipped("meshes", name).as_bytes(), vv::io::Format::Obj, &vv::io::ReadOptions::default()).unwrap().0
}

#[test]
fn the_mask_of_one_vertex_is_the_one_it_has_among_all() {
    for (program, name) in [
        ("loop.vv", "tetrapod.obj"),
        ("butterfly.vv", "icosahedron.obj"),
        ("sqrt3.vv", "torus.obj"),
        ("doo-sabin.vv", "cube-frame.obj"),
        ("catmull-clark.vv", "cube-open.obj"),
    ] {
        let (machine, mesh) = (machine(&shipped("programs", program)), mesh(name));
        let rule = machine.program().default_rule().unwrap();
        let all = measure(&machine, rule, &mesh, &Settings::default()).unwrap();
        assert_eq!(all.faults, []);
        let some = all.result.vertices().step_by(1 + all.result.vertex_count() / 12);
        for v in some {
            let mut one = measure_vertex(&machine, rule, &mesh, 1, v, &Settings::default()).unwrap();
            assert_eq!(one.faults, [], "{program}, {v}");
            one.weights.sort_by_key(|(v, _)| *v);
            let expected = &all.weights[v.index()];
            let names = |weights: &[(Vertex, f64)]| weights.iter().map(|(v, _)| *v).collect::<Vec<_>>();
            assert_eq!(names(&one.weights), names(expected), "{program}, {v}");
            for ((_, a), (_, b)) in one.weights.iter().zip(expected) {
                assert!((a - b).abs() < 1e-12, "{program}, {v}: {a} {b}");
            }
        }
    }
}

#[test]
fn of_one_vertex_it_is_said_what_is_no_mask() {
    let mesh = mesh("torus.obj");
    let of = |body: &str| {
        let machine = machine(&format!("void step(mesh& S) {{ {body} }}"));
        let rule = machine.program().default_rule().unwrap();
        let v = Vertex::from_index(7).unwrap();
        measure_vertex(&machine, rule, &mesh, 1, v, &Settings::default()).unwrap()
    };
    let kept = of("forall v in S v$pos += 0.0 * v$pos;");
    assert!(matches!(kept.weights[..], [(v, w)] if v == kept.vertex && (w - 1.0).abs() < 1e-12), "{kept:?}");
    assert_eq!(kept.faults, []);
    assert!(matches!(of("forall v in S v$pos = 2.0 * v$pos;").faults[..], [Fault::Sum { sum: 2.0, .. }]));
    assert!(matches!(of("forall v in S v$pos.z += 1;").faults[..], [Fault::NotAffine { .. }]));
    assert!(matches!(of("forall v in S v$pos = normalize(v$pos);").faults.last(), Some(Fault::NotAffine { .. })));
    let far = of("forall v in S if (v$pos.x > 3.4) { vertex q = any in v; erase q from v; erase v from q; }");
    assert_eq!(far.faults, [Fault::Connectivity]);
    // To the middle of all of them: they are not few, but all are found.
    let middle = "vec sum = vec(0, 0, 0); int n = 0; forall v in S { sum += v$pos; n = n + 1; } \
                  forall v in S v$pos = sum / n;";
    let middle = of(middle);
    assert_eq!((middle.weights.len(), middle.faults), (mesh.vertex_count(), vec![]));
}

#[test]
fn a_vertex_that_depends_on_too_many_has_no_mask() {
    let mut mesh = Mesh::new();
    for i in 0..2000 {
        let v = mesh.create().unwrap();
        mesh.set.add(v);
        mesh.set_position(v, glam::DVec3::splat(f64::from(i)));
    }
    let text = "void step(mesh& S) { vec sum = vec(0, 0, 0); forall v in S sum += v$pos; forall v in S v$pos = sum; }";
    let machine = machine(text);
    let rule = machine.program().default_rule().unwrap();
    let v = Vertex::from_index(0).unwrap();
    let mask = measure_vertex(&machine, rule, &mesh, 1, v, &Settings::default()).unwrap();
    assert!(matches!(mask.faults[..], [Fault::Wide { .. }]), "{:?}", mask.faults);
}

/// What depends on where vertices are shows only where they are elsewhere; and left is not right.
#[test]
fn of_a_star_it_is_said_what_is_no_mask() {
    let star = Star::new(6, Around::Triangles, false).unwrap();
    let judged = |body: &str| {
        let machine = machine(&format!("void step(mesh& S) {{ synchronize S; {body} }}"));
        let rule = machine.program().default_rule().unwrap();
        judge(&machine, rule, &star, &Settings::default()).unwrap().faults
    };
    let turned = "vec a = vec(0, 0, 0); forall q, r in `v a += 0.75 * `q$pos + 0.25 * `r$pos; v$pos = a / valence v;";
    assert_eq!(judged(&format!("forall v in S {{ {turned} }}")), []);
    let spiral = "vertex q = any in `v; v$pos = (2.0 * `v$pos + `q$pos + 3.0 * `(nextto q in `v)$pos) / 6.0;";
    assert!(judged(&format!("forall v in S {{ {spiral} }}")).contains(&Fault::Asymmetric));
    let torn = "forall v in S if (`v$pos.z < -1.1) { vertex q = any in v; erase q from v; erase v from q; }";
    assert_eq!(judged(torn)[0], Fault::Connectivity);
}
