//! What schemes keep: topology, affine maps, the lattice, polynomials, limit positions, handedness.

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
        ("butterfly.vv", "butterfly", &TRIANGLES),
        ("sqrt3.vv", "sqrt3", &TRIANGLES),
    ]
}

/// All schemes, those that shrink open meshes and those that keep the faces, too.
fn all() -> Vec<(&'static str, &'static str, &'static [&'static str])> {
    let mut all = refining();
    all.extend([
        ("midedge.vv", "midedge", &TRIANGLES[..]),
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
    for (file, rule, factor) in [("loop.vv", "loop", 16), ("butterfly.vv", "butterfly", 16), ("sqrt3.vv", "sqrt3", 9)] {
        let scheme = Scheme::new(file, rule);
        for name in TRIANGLES {
            let mesh = Surface::asset(name).mesh();
            assert_eq!(count(&scheme.steps(&mesh, 2)).faces, factor * count(&mesh).faces, "{file} {name}");
        }
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
        ("midedge.vv", "midedge", Around::Triangles, 2.0),
        ("midedge.vv", "midedge", Around::Quads, 2.0),
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
    for (file, rule, limit, meshes) in [("loop.vv", "loop", "loop_limit", TRIANGLES)] {
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
