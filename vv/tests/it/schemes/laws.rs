//! What schemes keep: topology, affine maps, the lattice, polynomials, limit positions, handedness.

use std::f64::consts::PI;

use glam::{DMat3, DVec3, dvec3};
use vv::mesh::Mesh;
use vv::mesh::faces::faces;
use vv::mesh::statistics::{Statistics, statistics};
use vv::stop::Stop;

use super::surface::{Around, Surface, star};
use super::{Scheme, isomorphic, shape};

fn count(mesh: &Mesh) -> Statistics {
    let stop = Stop::new();
    statistics(mesh, &faces(mesh, &stop).unwrap(), &stop).unwrap()
}

const TRIANGLES: [&str; 5] = ["octahedron.obj", "torus.obj", "genus-2.obj", "cube-open.obj", "tetrapod.obj"];
const QUADS: [&str; 4] = ["cube.obj", "torus-quads.obj", "genus-2-quads.obj", "cube-open-quads.obj"];

/// Every scheme that refines a mesh and keeps its boundary, with the meshes it is for.
fn refining() -> Vec<(&'static str, &'static str, &'static [&'static str])> {
    vec![
        ("loop.vv", "loop", &TRIANGLES),
        ("loop-creases.vv", "loop_creases", &TRIANGLES),
        ("catmull-clark-creases.vv", "catmull_clark_creases", &QUADS),
        ("butterfly.vv", "butterfly", &TRIANGLES),
        ("sqrt3.vv", "sqrt3", &TRIANGLES),
        ("catmull-clark.vv", "catmull_clark", &QUADS),
        ("quad-triangle.vv", "quad_triangle", &TRIANGLES),
        ("quad-triangle.vv", "quad_triangle", &QUADS),
        ("four-eight.vv", "four_eight", &TRIANGLES),
        ("four-eight.vv", "four_eight", &QUADS),
        ("conway.vv", "kis", &QUADS),
        ("conway.vv", "gyro", &QUADS),
    ]
}

/// All schemes without handedness, those that shrink open meshes and those that keep the faces, too.
fn all() -> Vec<(&'static str, &'static str, &'static [&'static str])> {
    let mut all = refining();
    all.retain(|(_, rule, _)| *rule != "gyro");
    all.extend([
        ("conway.vv", "dual", &QUADS[..3]),
        ("conway.vv", "truncate", &QUADS),
        ("conway.vv", "bevel", &QUADS),
        ("catmull-clark.vv", "catmull_clark", &TRIANGLES[..]),
        ("doo-sabin.vv", "doo_sabin", &QUADS),
        ("midedge.vv", "midedge", &TRIANGLES),
        ("midedge.vv", "midedge", &QUADS),
        ("limit.vv", "loop_limit", &TRIANGLES),
        ("limit.vv", "catmull_clark_limit", &QUADS),
        ("smooth.vv", "laplace", &TRIANGLES),
        ("smooth.vv", "taubin", &QUADS),
    ]);
    all
}

/// Positions that have no symmetry.
fn shaken(mesh: &Mesh) -> Mesh {
    let mut shaken = mesh.clone();
    for (i, v) in mesh.vertices().enumerate() {
        let noise = [1.0, 2.0, 3.0].map(|k| (k * (i + 1) as f64 * 0.7390851332).sin() * 0.05);
        shaken.set_position(v, mesh.position(v) + DVec3::from_array(noise));
    }
    shaken
}

fn moved(mesh: &Mesh, map: impl Fn(DVec3) -> DVec3) -> Mesh {
    let mut moved = mesh.clone();
    mesh.vertices().for_each(|v| moved.set_position(v, map(mesh.position(v))));
    moved
}

#[test]
fn refinement_keeps_the_topology() {
    for (file, rule, meshes) in refining() {
        let scheme = Scheme::new(file, rule);
        for name in meshes {
            let mesh = Surface::asset(name).mesh();
            let (before, after) = (count(&mesh), count(&scheme.steps(&mesh, 2)));
            assert!(after.valid, "{file} {name}");
            let of = |s: &Statistics| (s.components, s.euler_characteristic, s.boundary_loops, s.genus);
            assert_eq!(of(&after), of(&before), "{file} {name}");
        }
    }
}

/// Faces after two steps, for each before.
#[test]
fn refinement_multiplies_the_faces() {
    for (file, rule, meshes, factor) in [
        ("loop.vv", "loop", &TRIANGLES[..], 16),
        ("butterfly.vv", "butterfly", &TRIANGLES, 16),
        ("sqrt3.vv", "sqrt3", &TRIANGLES, 9),
        ("catmull-clark.vv", "catmull_clark", &QUADS, 16),
    ] {
        let scheme = Scheme::new(file, rule);
        for name in meshes {
            let mesh = Surface::asset(name).mesh();
            assert_eq!(count(&scheme.steps(&mesh, 2)).faces, factor * count(&mesh).faces, "{file} {name}");
        }
    }
}

/// Of a triangle with more than one edge along a hole none is cut in three.
#[test]
fn sqrt3_may_begin_with_the_step_that_trisects() {
    let scheme = Scheme::changed("sqrt3.vv", "sqrt3", "% 2 == 1", "% 2 == 0");
    for name in ["square-open.obj", "grid-open.obj", "cube-open.obj", "torus.obj"] {
        let mesh = Surface::asset(name).mesh();
        let (before, after) = (count(&mesh), count(&scheme.steps(&mesh, 1)));
        let of = |s: &Statistics| (s.components, s.boundary_loops, s.euler_characteristic);
        assert_eq!(of(&after), of(&before), "{name}");
        assert_eq!(after.face_degrees.iter().map(|d| d.0).collect::<Vec<_>>(), [3], "{name}");
    }
}

#[test]
fn affine_maps_commute_with_schemes() {
    let matrix = DMat3::from_cols(dvec3(1.0, 0.3, -0.2), dvec3(-0.4, 0.8, 0.5), dvec3(0.1, -0.7, 1.2));
    let map = |p: DVec3| matrix * p + dvec3(3.0, -1.0, 2.0);
    for (file, rule, meshes) in all() {
        let scheme = Scheme::new(file, rule);
        for name in meshes {
            let mesh = shaken(&Surface::asset(name).mesh());
            let [a, b] = [scheme.steps(&moved(&mesh, map), 1), moved(&scheme.steps(&mesh, 1), map)];
            let far = a.positions().iter().zip(b.positions()).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            assert!(far < 1e-12, "{file} {name}: {far}");
        }
    }
}

/// In the middle of a regular flat mesh every vertex lands on the lattice `fineness` times as fine.
#[test]
fn flat_regular_meshes_stay_on_a_lattice() {
    let triangles = DMat3::from_cols(DVec3::X, dvec3(0.5, 0.75f64.sqrt(), 0.0), DVec3::Z);
    for (file, rule, around, fineness) in [
        ("loop.vv", "loop", Around::Triangles, 2.0),
        ("butterfly.vv", "butterfly", Around::Triangles, 2.0),
        ("sqrt3.vv", "sqrt3", Around::Triangles, 3.0),
        ("catmull-clark.vv", "catmull_clark", Around::Quads, 2.0),
        ("doo-sabin.vv", "doo_sabin", Around::Quads, 4.0),
        ("quad-triangle.vv", "quad_triangle", Around::Quads, 2.0),
        ("quad-triangle.vv", "quad_triangle", Around::Triangles, 2.0),
        ("midedge.vv", "midedge", Around::Triangles, 2.0),
        ("midedge.vv", "midedge", Around::Quads, 2.0),
        ("four-eight.vv", "four_eight", Around::Quads, 2.0),
        ("conway.vv", "dual", Around::Triangles, 3.0),
        ("conway.vv", "expand", Around::Quads, 4.0),
        ("limit.vv", "loop_limit", Around::Triangles, 1.0),
        ("limit.vv", "catmull_clark_limit", Around::Quads, 1.0),
    ] {
        let (sectors, basis) = if around == Around::Quads { (4, DMat3::IDENTITY) } else { (6, triangles) };
        let result = Scheme::new(file, rule).steps(&star(sectors, 4, around, false).mesh(), 1);
        let middle: Vec<_> = result.positions().iter().filter(|p| p.length() < 1.6).collect();
        assert!(middle.len() >= 7, "{file}");
        for p in middle {
            let lattice = basis.inverse() * *p * fineness;
            assert!((lattice - lattice.round()).length() < 1e-12, "{file} {rule}: {p}");
        }
    }
}

/// The butterfly reproduces cubic polynomials on regular meshes, the four-point curve on even steps.
#[test]
fn interpolating_schemes_reproduce_cubics() {
    let height = |p: DVec3| 0.3 * p.x.powi(3) - p.x * p.x * p.y + 0.7 * p.y.powi(3) - p.x * p.y + p.y + 2.0;
    let mesh = moved(&star(6, 4, Around::Triangles, false).mesh(), |p| dvec3(p.x, p.y, height(p)));
    let result = Scheme::new("butterfly.vv", "butterfly").steps(&mesh, 1);
    for p in result.positions().iter().filter(|p| p.truncate().length() < 2.0) {
        assert!((p.z - height(*p)).abs() < 1e-12, "{p}");
    }
}

/// A step does not move limit positions, and many steps come to them.
#[test]
fn steps_converge_to_the_limit() {
    for (file, rule, limit, meshes) in [
        ("loop.vv", "loop", "loop_limit", &TRIANGLES[..]),
        ("catmull-clark.vv", "catmull_clark", "catmull_clark_limit", &QUADS),
    ] {
        let (scheme, limit) = (Scheme::new(file, rule), Scheme::new("limit.vv", limit));
        for name in meshes {
            let mesh = shaken(&Surface::asset(name).mesh());
            let aim = limit.steps(&mesh, 1);
            let distance = |mesh: &Mesh| {
                let pairs = aim.positions().iter().zip(mesh.positions());
                pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
            };
            let once = scheme.steps(&mesh, 1);
            let again = distance(&limit.steps(&once, 1));
            assert!(again < 1e-12, "{file} {name}: the limit moves by {again}");
            let [before, after] = [distance(&once), distance(&scheme.steps(&once, 1))];
            assert!(after < 0.5 * before, "{file} {name}: {before}, then {after}");
        }
    }
}

/// The mesh in a mirror: every ring the other way round.
fn mirrored(mesh: &Mesh) -> Mesh {
    let mut mirrored = moved(mesh, |p| p * dvec3(-1.0, 1.0, 1.0));
    for v in mesh.vertices() {
        let ring: Vec<_> = mesh.ring(v).slots().iter().rev().copied().collect();
        mirrored.make(v, &ring).unwrap();
    }
    mirrored
}

/// Whether a mesh and its image give a result and its image.
fn keeps_mirror_images(scheme: &Scheme, mesh: &Mesh) -> bool {
    let [a, b] = [mirrored(&scheme.steps(mesh, 1)), scheme.steps(&mirrored(mesh), 1)];
    isomorphic(&shape(&a), &shape(&b), 1e-9).is_ok()
}

#[test]
fn schemes_that_have_no_handedness_commute_with_a_mirror() {
    for (file, rule, meshes) in all() {
        let scheme = Scheme::new(file, rule);
        for name in meshes {
            assert!(keeps_mirror_images(&scheme, &shaken(&Surface::asset(name).mesh())), "{file} {name}");
        }
    }
}

#[test]
fn gyro_and_snub_have_a_handedness() {
    for rule in ["gyro", "snub"] {
        let scheme = Scheme::new("conway.vv", rule);
        for name in ["cube.obj", "tetrapod.obj"] {
            let mesh = shaken(&Surface::asset(name).mesh());
            assert!(!keeps_mirror_images(&scheme, &mesh), "{rule} {name}");
        }
    }
}

#[test]
fn the_other_hand_of_gyro_gives_the_mirror_image() {
    let right = Scheme::new("conway.vv", "gyro");
    let hand = |pair: &str, place: &str| {
        format!(
            "forall {pair} in f {{
      if (!is p in S) continue;
      c$pos += 3.0 * p$pos / valence f;
      splice c {place} p in x;"
        )
    };
    let left = Scheme::changed("conway.vv", "gyro", &hand("p, x", "before"), &hand("x, p", "after"));
    let mesh = shaken(&Surface::asset("cube.obj").mesh());
    let [a, b] = [mirrored(&right.steps(&mesh, 1)), left.steps(&mirrored(&mesh), 1)];
    isomorphic(&shape(&a), &shape(&b), 1e-9).unwrap();
}

fn corner(mesh: &Mesh, a: usize, p: usize, q: usize) -> f64 {
    let at = |v: usize| mesh.positions()[v];
    (at(p) - at(a)).angle_between(at(q) - at(a))
}

/// Flips to Delaunay keep the vertices and the number of edges, and end where no edge sees more than half a turn.
#[test]
fn flips_end_in_a_delaunay_triangulation() {
    let scheme = Scheme::new("delaunay.vv", "delaunay");
    for (k, open) in [(12, false), (5, true), (7, false)] {
        let stretched = moved(&star(k, 3, Around::Triangles, open).mesh(), |p| dvec3(p.x, 0.3 * p.y + 0.1 * p.x, 0.0));
        let mesh = moved(&shaken(&stretched), |p| p.with_z(0.0));
        let bad = |mesh: &Mesh| {
            let surface = Surface::of(mesh);
            let sees = |&(p, q): &(usize, usize)| match (surface.across(p, q), surface.across(q, p)) {
                (Some(a), Some(b)) => corner(mesh, a, p, q) + corner(mesh, b, p, q) > PI + 1e-9,
                _ => false,
            };
            surface.edges().iter().filter(|e| sees(e)).count()
        };
        let flipped = scheme.steps(&mesh, 20);
        assert!(bad(&mesh) > 5 && bad(&flipped) == 0, "{} {}", bad(&mesh), bad(&flipped));
        assert_eq!(flipped.positions(), mesh.positions());
        assert_eq!(count(&flipped).edges, count(&mesh).edges);
        assert!(count(&flipped).valid);
    }
}
