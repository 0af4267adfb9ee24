//! The masks of every scheme, on every valence from 3 to 12 inside and on every number of sectors at a boundary.

use std::f64::consts::TAU;

use glam::DVec3;
use vv::mesh::Value;

use super::published::{self, Curve, Refined};
use super::surface::{Around, Surface, star, wire};
use super::{Scheme, compare};

/// Inner vertices of valence 3 to 12 and boundary vertices of 1 to 8 sectors, in a regular neighbourhood `size` wide.
fn stars(around: Around, size: usize) -> impl Iterator<Item = (String, Surface)> {
    let inner = (3..=12).map(move |n| (format!("valence {n}"), star(n, size, around, false)));
    let boundary = (1..=8).map(move |k| (format!("{k} sectors at the boundary"), star(k, size, around, true)));
    inner.chain(boundary)
}

#[track_caller]
fn check(name: &str, scheme: &Scheme, surface: &Surface, expected: &Refined) {
    let result = scheme.measure(&surface.mesh()).and_then(|measured| compare(&measured, expected));
    if let Err(difference) = result {
        panic!("{name}: {difference}");
    }
}

#[test]
fn loop_() {
    let scheme = Scheme::new("loop.vv", "loop");
    for (name, surface) in stars(Around::Triangles, 2) {
        check(&name, &scheme, &surface, &published::loop_(&surface, false));
    }
}

#[test]
fn loop_of_the_paper() {
    let scheme = Scheme::new("paper-loop.vv", "loop");
    for name in ["octahedron.obj", "tetrahedron.obj", "icosahedron.obj", "tetrapod.obj"] {
        let surface = Surface::asset(name);
        check(name, &scheme, &surface, &published::loop_(&surface, false));
    }
}

#[test]
fn loop_with_nothing_sharp() {
    let scheme = Scheme::new("loop-creases.vv", "loop_creases");
    for (name, surface) in stars(Around::Triangles, 2) {
        check(&name, &scheme, &surface, &published::loop_(&surface, false));
    }
}

#[test]
fn loop_with_tangents_at_the_boundary() {
    let scheme = Scheme::new("loop-creases.vv", "loop_creases").with("smooth_boundary", Value::Bool(true));
    for (name, surface) in stars(Around::Triangles, 2) {
        check(&name, &scheme, &surface, &published::loop_(&surface, true));
    }
}

/// Sharp edges at the middle of a star, none, one, two and more of them, and a sharp middle.
fn creased(around: Around) -> impl Iterator<Item = (String, Surface)> {
    let edges: [&[f64]; 12] = [
        &[1.0],
        &[0.4],
        &[2.0, 2.0],
        &[0.25, 1.5],
        &[0.3, 0.5],
        &[1.0, 1.0],
        &[10.0, 0.5],
        &[3.0, 3.0, 3.0],
        &[0.5, 2.0, 2.0],
        &[0.5, 0.75, 2.0],
        &[0.1, 0.2, 0.9],
        &[10.0, 10.0, 0.5, 1.0],
    ];
    let corners = [0.0, 0.0, 0.0, 0.5, 1.0, 2.5];
    edges.into_iter().enumerate().flat_map(move |(i, sharp)| {
        [false, true].map(|open| {
            let mut surface = star(if open { 4 } else { 5 }, 2, around, open);
            let ring = surface.neighbours(0);
            let inner = ring.iter().filter(|&&q| !surface.is_boundary_edge(0, q));
            surface.sharpness = inner.zip(sharp).map(|(&q, &s)| ((0, q), s)).collect();
            let corner = corners[(i + usize::from(open)) % corners.len()];
            surface.sharp_vertices.insert(0, corner);
            (format!("{sharp:?}, {corner}, open {open}"), surface)
        })
    })
}

#[test]
fn loop_with_creases() {
    let scheme = Scheme::new("loop-creases.vv", "loop_creases");
    for (name, surface) in creased(Around::Triangles) {
        check(&name, &scheme, &surface, &published::loop_(&surface, false));
    }
}

#[test]
fn butterfly() {
    let scheme = Scheme::new("butterfly.vv", "butterfly");
    for (name, surface) in stars(Around::Triangles, 2) {
        check(&name, &scheme, &surface, &published::butterfly(&surface));
    }
    for name in ["octahedron.obj", "icosahedron.obj", "tetrapod.obj", "cube-open.obj"] {
        let surface = Surface::asset(name);
        check(name, &scheme, &surface, &published::butterfly(&surface));
    }
}

#[test]
fn butterfly_of_the_paper() {
    let scheme = Scheme::new("paper-butterfly.vv", "butterfly");
    let surface = Surface::asset("torus.obj"); // its valences are 6
    check("torus", &scheme, &surface, &published::butterfly(&surface));
}

#[test]
fn sqrt3() {
    let scheme = Scheme::new("sqrt3.vv", "sqrt3");
    for (name, surface) in stars(Around::Triangles, 2) {
        check(&name, &scheme, &surface, &published::sqrt3(&surface, false));
        let once = scheme.step(&surface.mesh()).unwrap();
        let twice = scheme.measure(&once).and_then(|m| compare(&m, &published::sqrt3(&Surface::of(&once), true)));
        twice.unwrap_or_else(|difference| panic!("{name}, second step: {difference}"));
    }
}

#[test]
fn sqrt3_of_the_paper() {
    let scheme = Scheme::new("paper-sqrt3.vv", "sqrt3");
    for name in ["octahedron.obj", "tetrahedron.obj", "icosahedron.obj", "tetrapod.obj"] {
        let surface = Surface::asset(name);
        check(name, &scheme, &surface, &published::sqrt3(&surface, false));
    }
}

#[test]
fn midedge() {
    let scheme = Scheme::new("midedge.vv", "midedge");
    for (name, surface) in stars(Around::Triangles, 2).chain(stars(Around::Quads, 2)) {
        check(&name, &scheme, &surface, &published::midedge(&surface));
    }
    for name in ["dodecahedron.obj", "genus-2-quads.obj"] {
        let surface = Surface::asset(name);
        check(name, &scheme, &surface, &published::midedge(&surface));
    }
}

#[test]
fn limits() {
    let scheme = Scheme::new("limit.vv", "loop_limit");
    for (name, surface) in stars(Around::Triangles, 2) {
        check(&name, &scheme, &surface, &published::loop_limit(&surface));
    }
    let scheme = Scheme::new("limit.vv", "catmull_clark_limit");
    for (name, surface) in stars(Around::Quads, 2) {
        check(&name, &scheme, &surface, &published::catmull_clark_limit(&surface));
    }
}

#[test]
fn smoothing() {
    let scheme = Scheme::new("smooth.vv", "laplace").with("lambda", Value::Double(0.25));
    for (name, surface) in stars(Around::Quads, 2) {
        check(&name, &scheme, &surface, &published::laplace(&surface, 0.25));
    }
}

/// Polygons, closed and open, and three wires that meet.
fn curves() -> Vec<(String, Curve)> {
    let closed = (3..8).map(|n| (format!("closed {n}"), (0..n).map(|i| vec![(i + n - 1) % n, (i + 1) % n]).collect()));
    let neighbours =
        |n: usize, i: usize| [i.checked_sub(1), (i + 1 < n).then_some(i + 1)].into_iter().flatten().collect();
    let open = (2..7).map(|n| (format!("open {n}"), (0..n).map(|i| neighbours(n, i)).collect()));
    let fork = vec![vec![1, 2, 3], vec![0, 4], vec![0, 5], vec![0, 6], vec![1], vec![2], vec![3]];
    closed.chain(open).chain([("a fork".to_owned(), fork)]).collect()
}

#[track_caller]
fn check_curve(rule: &'static str, published: impl Fn(&Curve) -> Refined) {
    let scheme = Scheme::new("curves.vv", rule);
    for (name, curve) in curves() {
        let result = scheme.measure(&wire(&curve)).and_then(|measured| compare(&measured, &published(&curve)));
        if let Err(difference) = result {
            panic!("{name}: {difference}");
        }
    }
}

#[test]
fn cubic_curves() {
    check_curve("cubic", published::cubic);
}

#[test]
fn four_point_curves() {
    check_curve("four_point", |curve| published::four_point(curve, 1.0 / 16.0));
}

#[test]
fn chaikin_curves() {
    check_curve("chaikin", published::chaikin);
}

#[test]
fn conway_operators() {
    type Operator = &'static dyn Fn(&Surface) -> Refined;
    let (dual, kis, ambo): (Operator, Operator, Operator) = (&published::dual, &published::kis, &published::midedge);
    let (gyro, truncate): (Operator, Operator) = (&published::gyro, &published::truncate);
    let table: [(&str, &[Operator]); 13] = [
        ("dual", &[dual]),
        ("kis", &[kis]),
        ("ambo", &[ambo]),
        ("gyro", &[gyro]),
        ("truncate", &[truncate]),
        ("join", &[dual, ambo]),
        ("expand", &[ambo, ambo]),
        ("ortho", &[dual, ambo, dual, ambo]),
        ("bevel", &[truncate, ambo]),
        ("meta", &[kis, dual, ambo]),
        ("zip", &[dual, kis]),
        ("needle", &[kis, dual]),
        ("snub", &[dual, gyro, dual]),
    ];
    for (rule, operators) in table {
        let scheme = Scheme::new("conway.vv", rule);
        for name in ["tetrahedron.obj", "cube.obj", "octahedron.obj"] {
            let surface = Surface::asset(name);
            check(&format!("{rule} {name}"), &scheme, &surface, &published::compose(&surface, operators));
        }
    }
}

/// The five that stand for themselves, beside holes.
#[test]
fn conway_operators_at_a_boundary() {
    type Operator = fn(&Surface) -> Refined;
    let table: [(&str, Operator); 4] = [
        ("dual", published::dual),
        ("kis", published::kis),
        ("gyro", published::gyro),
        ("truncate", published::truncate),
    ];
    for (rule, operator) in table {
        let scheme = Scheme::new("conway.vv", rule);
        for (k, around) in [(2, Around::Quads), (3, Around::Triangles), (5, Around::Quads)] {
            let surface = star(k, 2, around, true);
            check(&format!("{rule} {k}"), &scheme, &surface, &operator(&surface));
        }
    }
}

#[test]
fn four_eight() {
    let scheme = Scheme::new("four-eight.vv", "four_eight");
    for (name, surface) in stars(Around::Triangles, 1).chain(stars(Around::Quads, 1)) {
        check(&name, &scheme, &surface, &published::four_eight(&surface, true));
        let mut mesh = surface.mesh();
        for step in 2..=3 {
            mesh = scheme.steps(&mesh, 1);
            let expected = published::four_eight(&Surface::of(&mesh), false);
            let result = scheme.measure(&mesh).and_then(|measured| compare(&measured, &expected));
            result.unwrap_or_else(|difference| panic!("{name}, step {step}: {difference}"));
        }
    }
}

/// Stars of quads and of triangles, and polygons of many corners.
fn polygons(size: usize) -> impl Iterator<Item = (String, Surface)> {
    let assets =
        ["dodecahedron.obj", "genus-2-quads.obj", "cube-open.obj"].map(|name| (name.to_owned(), Surface::asset(name)));
    stars(Around::Quads, size).chain(stars(Around::Triangles, 2)).chain(assets)
}

#[test]
fn catmull_clark() {
    let scheme = Scheme::new("catmull-clark.vv", "catmull_clark");
    for (name, surface) in polygons(2) {
        check(&name, &scheme, &surface, &published::catmull_clark(&surface));
    }
}

#[test]
fn doo_sabin() {
    for chaikin in [false, true] {
        let scheme = Scheme::new("doo-sabin.vv", "doo_sabin").with("chaikin", Value::Bool(chaikin));
        for (name, surface) in polygons(2) {
            check(&format!("{name}, {chaikin}"), &scheme, &surface, &published::doo_sabin(&surface, chaikin));
        }
    }
}

/// Stars of quads of which each other is cut into two triangles.
fn halves() -> impl Iterator<Item = (String, Surface)> {
    stars(Around::Quads, 2).map(|(name, surface)| {
        let mut faces = Vec::new();
        for (i, face) in surface.faces.iter().enumerate() {
            match face[..] {
                [a, b, c, d] if i % 3 == 1 => faces.extend([vec![a, b, c], vec![a, c, d]]),
                _ => faces.push(face.clone()),
            }
        }
        (format!("{name}, some quads cut"), Surface::new(surface.points, faces))
    })
}

/// Around a vertex `triangles` triangles, then `quads` quads, on a plane.
fn fan(triangles: usize, quads: usize) -> Surface {
    let mut points = vec![DVec3::ZERO];
    let mut faces = Vec::new();
    let n = triangles + quads;
    let spoke = |i: usize| 1 + i % n;
    let angle = |i: f64| DVec3::new((TAU * i / n as f64).cos(), (TAU * i / n as f64).sin(), 0.0);
    points.extend((0..n).map(|i| angle(i as f64)));
    for i in 0..n {
        if i < triangles {
            faces.push(vec![0, spoke(i), spoke(i + 1)]);
        } else {
            points.push(2.0 * angle(i as f64 + 0.5));
            faces.push(vec![0, spoke(i), points.len() - 1, spoke(i + 1)]);
        }
    }
    Surface::new(points, faces)
}

#[test]
fn quad_triangle() {
    let fans = (3..8).flat_map(|n| (1..n).map(move |q| (format!("{q} quads of {n}"), fan(n - q, q))));
    for smooth in [true, false] {
        let scheme = Scheme::new("quad-triangle.vv", "quad_triangle").with("smooth_boundary", Value::Bool(smooth));
        let surfaces = polygons(2).chain(halves());
        for (name, surface) in surfaces.chain(fans.clone().filter(|_| smooth)) {
            check(&name, &scheme, &surface, &published::quad_triangle(&surface, smooth));
        }
    }
}
