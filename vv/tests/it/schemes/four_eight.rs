//! 4–8 subdivision from first principles, as no library makes such surfaces: masks from the refinement equation of its
//! box spline where the mesh is regular, and what its steps do in the long run where it is not and at boundaries.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};
use vv::mesh::faces::faces;
use vv::mesh::{Mesh, Vertex};
use vv::stop::Stop;

use super::surface::{Around, Surface, star};
use super::{Scheme, TOLERANCE};

fn scheme() -> Scheme {
    Scheme::new("four-eight.vv", "four_eight")
}

/// The four-direction box spline has the directions e₁, e₂, e₁+e₂ and e₁−e₂, each twice. The matrix of a step,
/// (1 1; 1 −1), maps the first two to the last two, and these to twice the first two. So of the quotient of the
/// transforms at either scale there stay two factors (1 + z)/2 for e₁ and for e₂; the determinant is 2.
fn box_spline_mask(i: f64, j: f64) -> f64 {
    let factor =
        |i: f64| [(0.0, 2.0 / 4.0), (1.0, 1.0 / 4.0)].iter().find(|(at, _)| *at == i.abs()).map_or(0.0, |f| f.1);
    2.0 * factor(i) * factor(j)
}

#[test]
fn regular_masks_are_those_of_the_four_direction_box_spline() {
    let scheme = scheme();
    let mut mesh = star(4, 3, Around::Quads, false).mesh();
    // From here to there, in the lattice that a step makes: the first turns the axes by an eighth, the second back.
    let lattices: [fn(DVec3) -> (f64, f64); 2] = [|d| (d.x + d.y, d.x - d.y), |d| (2.0 * d.x, 2.0 * d.y)];
    for (step, lattice) in lattices.into_iter().enumerate() {
        let measured = scheme.measure(&mesh).unwrap();
        let result = scheme.steps(&mesh, 1);
        let inner: Vec<_> = result.vertices().filter(|&v| result.position(v).abs().max_element() < 1.9).collect();
        assert!(inner.len() >= 25, "{}", inner.len());
        for x in inner {
            for (y, weight) in mesh.vertices().zip(&measured.masks[x.index()]) {
                let (i, j) = lattice(result.position(x) - mesh.position(y));
                let expected = box_spline_mask((i * 1e6).round() / 1e6, (j * 1e6).round() / 1e6);
                assert!((weight - expected).abs() < TOLERANCE, "step {step}, {x} of {y}: {weight}, {expected}");
            }
        }
        mesh = result;
    }
}

/// A step adds an eighth of the Laplacian to a cubic, in units of the edges that it finds.
#[test]
fn cubics_stay_cubics() {
    let height = |p: DVec3| 0.3 * p.x.powi(3) - p.x * p.x * p.y + 0.7 * p.y.powi(3) - p.x * p.y + 2.0 * p.y * p.y + 1.0;
    let laplacian = |p: DVec3| 1.8 * p.x - 2.0 * p.y + 4.2 * p.y + 4.0;
    let mut mesh = star(4, 4, Around::Quads, false).mesh();
    mesh.vertices().collect::<Vec<_>>().into_iter().for_each(|v| {
        let p = mesh.position(v);
        mesh.set_position(v, p.with_z(height(p)));
    });
    let mut added = 0.0;
    for square in [1.0, 0.5, 0.25, 0.125] {
        mesh = scheme().steps(&mesh, 1);
        added += square / 8.0;
        let inner: Vec<_> = mesh.positions().iter().filter(|p| p.truncate().abs().max_element() < 1.2).collect();
        assert!(inner.len() >= 9);
        for p in inner {
            let expected = height(*p) + added * laplacian(*p);
            assert!((p.z - expected).abs() < 1e-12, "{p}: {expected}");
        }
    }
}

/// The vertices up to `depth` edges from the first, ring by ring, in an order that goes by rings and begins at the right.
fn surroundings(mesh: &Mesh, depth: usize) -> Vec<Vertex> {
    let middle = mesh.vertices().next().unwrap();
    let right = |q: &Vertex| mesh.position(*q).x > 1e-9 && mesh.position(*q).y.abs() < 1e-9;
    let mut found = vec![(middle, mesh.ring(middle).vertices().find(right).unwrap())];
    let mut begin = 0;
    for _ in 0..depth {
        let level = begin..found.len();
        begin = found.len();
        for i in level {
            let (v, from) = found[i];
            let ring: Vec<_> = mesh.ring(v).vertices().collect();
            let at = ring.iter().position(|&q| q == from).unwrap();
            for &q in ring[at..].iter().chain(&ring[..at]) {
                if found.iter().all(|f| f.0 != q) {
                    found.push((q, v));
                }
            }
        }
    }
    found.into_iter().map(|f| f.0).collect()
}

/// What two steps make of numbers around a vertex with so many sectors, in the long run.
struct LongRun {
    /// By how much they shrink what turns once around the vertex, and all else but constants.
    once: f64,
    other: f64,
    /// Where the vertices of the triangles of the characteristic map lie.
    map: Vec<[DVec2; 3]>,
}

/// Power iteration: x and y turn once around the vertex, z has all other frequencies. Two steps find again around the
/// vertex what they were given, so that the same numbers can go on from there.
fn long_run(sectors: usize) -> LongRun {
    let scheme = scheme();
    let mut mesh = scheme.steps(&star(sectors, 2, Around::Quads, false).mesh(), 2);
    let shape = scheme.steps(&mesh, 2);
    let [before, after] = [&mesh, &shape].map(|mesh| surroundings(mesh, 4));
    assert_eq!(before.len(), after.len());
    mesh.vertices().collect::<Vec<_>>().into_iter().for_each(|v| {
        let p = mesh.position(v);
        let (r, angle) = (p.length(), p.y.atan2(p.x));
        let z = (2..=sectors / 2).map(|f| (f as f64 * angle).cos()).sum::<f64>();
        mesh.set_position(v, p.with_z(r * r * (1.0 + z)));
    });
    let (mut once, mut other) = (0.0, 0.0);
    for _ in 0..16 {
        let result = scheme.steps(&mesh, 2);
        let middle = result.position(after[0]);
        let values: Vec<_> = after.iter().map(|&v| result.position(v) - middle).collect();
        let largest = values.iter().fold(DVec3::ZERO, |m, p| m.max(p.abs()));
        (once, other) = (largest.x.max(largest.y), largest.z);
        for (&v, p) in before.iter().zip(&values) {
            mesh.set_position(v, *p / DVec3::new(once, once, other));
        }
    }
    let inner = &before[..before.len() - 1];
    let place: BTreeMap<Vertex, DVec2> = inner.iter().map(|&v| (v, mesh.position(v).truncate())).collect();
    let all = faces(&mesh, &Stop::new()).unwrap();
    let map = all.iter().filter_map(|f| {
        let corners: Option<Vec<_>> = f.iter().map(|v| place.get(v).copied()).collect();
        corners?.try_into().ok()
    });
    LongRun { once, other, map: map.collect() }
}

/// What turns once around a vertex shrinks least, and its characteristic map folds nowhere (Reif 1995).
#[test]
fn surfaces_have_tangent_planes_at_irregular_vertices() {
    for sectors in [3, 4, 5, 6, 8, 12] {
        let LongRun { once, other, map } = long_run(sectors);
        assert!(other < 0.95 * once && once < 0.8, "{sectors}: {once} {other}");
        if sectors == 4 {
            assert!((once - 0.5).abs() < 1e-9 && (other - 0.25).abs() < 1e-6, "{once} {other}");
        }
        // The characteristic map is regular, and goes round the vertex once.
        assert!(map.len() > 10 * sectors, "{}", map.len());
        for [a, b, c] in &map {
            assert!((b - a).perp_dot(c - a) > 0.0, "{sectors}: {a} {b} {c}");
        }
        let turn = map.iter().flat_map(|t| (0..3).map(|i| (t[i], t[(i + 1) % 3], t[(i + 2) % 3])));
        let turn: f64 = turn.filter(|(a, ..)| a.length() < 1e-9).map(|(_, b, c)| b.angle_to(c)).sum();
        assert!((turn - std::f64::consts::TAU).abs() < 1e-9, "{sectors}: {turn}");
    }
}

/// The boundary alone, in order.
fn boundary(mesh: &Mesh) -> Vec<DVec3> {
    let surface = Surface::of(mesh);
    let along = |v: usize| surface.boundary(v).map(|[a, b]| if surface.corner(v, a).is_some() { a } else { b });
    let first = (0..surface.points.len()).find(|&v| surface.boundary(v).is_some()).unwrap();
    let mut found = vec![first];
    while let Some(next) = along(found[found.len() - 1]).filter(|&v| v != first) {
        found.push(next);
    }
    found.into_iter().map(|v| surface.points[v]).collect()
}

/// Cubic B-splines by doubling each point and taking means of neighbours three times.
fn refined(points: &[DVec3]) -> Vec<DVec3> {
    let mut points: Vec<_> = points.iter().flat_map(|p| [*p, *p]).collect();
    for _ in 0..3 {
        let n = points.len();
        points = (0..n).map(|i| (points[i] + points[(i + 1) % n]) / 2.0).collect();
    }
    points
}

#[test]
fn boundaries_are_cubic_b_splines_whatever_is_inside() {
    let scheme = scheme();
    for around in [Around::Quads, Around::Triangles] {
        for sectors in [1, 2, 3, 5] {
            let mesh = star(sectors, 2, around, true).mesh();
            let mut expected = boundary(&mesh);
            for steps in [2, 4] {
                expected = refined(&expected);
                let found = boundary(&scheme.steps(&mesh, steps));
                assert_eq!(found.len(), expected.len(), "{around:?} {sectors}");
                for p in &found {
                    assert!(expected.iter().any(|e| e.distance(*p) < 1e-12), "{around:?} {sectors}: {p}");
                }
            }
        }
    }
}
