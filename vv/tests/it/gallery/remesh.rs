//! Remeshing and the coral: what must stay as it was, and what must become better.

use std::collections::HashMap;

use glam::DVec3;
use vv::mesh::Value;

use super::Show;

/// Lengths of edges, each twice.
fn lengths(show: &Show) -> Vec<f64> {
    let mesh = &show.mesh;
    let ends = mesh.set.iter().flat_map(|p| mesh.ring(p).vertices().map(move |q| (p, q)));
    ends.map(|(p, q)| mesh.position(p).distance(mesh.position(q))).collect()
}

/// The part of the vertices that have six neighbours.
fn regular(show: &Show) -> f64 {
    let six = show.mesh.set.iter().filter(|&v| show.mesh.ring(v).valence() == 6).count();
    six as f64 / show.mesh.set.len() as f64
}

/// The smallest angle of a triangle, as a sine: how thin the thinnest is.
fn thinnest(show: &Show) -> f64 {
    let corner = |f: &[DVec3], i: usize| {
        let (u, v) = (f[(i + 1) % 3] - f[i], f[(i + 2) % 3] - f[i]);
        u.cross(v).length() / (u.length() * v.length())
    };
    show.faces().iter().flat_map(|f| (0..3).map(|i| corner(f, i))).fold(1.0, f64::min)
}

/// The length of the edges that bend by more than 120 degrees, where triangles nearly lie upon each other.
fn folded(show: &Show) -> f64 {
    let faces = show.faces();
    let normal = |f: &[DVec3]| (f[1] - f[0]).cross(f[2] - f[0]).normalize();
    let sides = |f: &Vec<DVec3>| (0..3).map(|i| (f[i], f[(i + 1) % 3], normal(f))).collect::<Vec<_>>();
    let key = |p: DVec3, q: DVec3| [p, q].map(|p| p.to_array().map(f64::to_bits));
    let all: Vec<_> = faces.iter().flat_map(sides).collect();
    let normals: HashMap<_, _> = all.iter().map(|&(p, q, n)| (key(p, q), n)).collect();
    let bends = |&&(p, q, n): &&(DVec3, DVec3, DVec3)| normals.get(&key(q, p)).is_some_and(|m| n.dot(*m) < -0.5);
    all.iter().filter(bends).map(|(p, q, _)| p.distance(*q)).sum::<f64>() / 2.0
}

#[test]
fn remeshing_makes_edges_of_one_length_and_keeps_the_shape() {
    let before = Show::new("remesh.vv", &[]);
    let lengths_before = lengths(&before);
    let mean = 0.8 * lengths_before.iter().sum::<f64>() / lengths_before.len() as f64;
    let (volume, thin) = (before.volume(), thinnest(&before));
    let after = before.steps(8);
    let counts = after.statistics();
    assert!(counts.valid && counts.closed);
    assert_eq!(counts.euler_characteristic, 2);
    assert!(counts.face_degrees.iter().all(|&(n, _)| n == 3));
    let lengths = lengths(&after);
    let fitting = lengths.iter().filter(|&&l| l > 0.8 * mean && l < 4.0 / 3.0 * mean).count();
    assert!(fitting as f64 > 0.85 * lengths.len() as f64, "{fitting} of {}", lengths.len());
    assert!(regular(&after) > 0.7, "{}", regular(&after));
    assert!(thinnest(&after) > 1.4 * thin, "{} {thin}", thinnest(&after));
    assert!((after.volume() / volume - 1.0).abs() < 1e-3, "{} {volume}", after.volume());
}

/// Where nothing is a crease, edits give back what they take, or the next ones do where a triangle would turn over; so
/// coarse meshes do not shrink.
#[test]
fn remeshing_what_is_smooth_encloses_what_it_did() {
    for mesh in ["cube.obj", "tetrapod.obj", "torus.obj", "genus-2.obj", "pawn.obj"] {
        for size in [0.6, 0.8] {
            let params = [("crease", Value::Double(180.0)), ("size", Value::Double(size))];
            let before = Show::on_mesh(mesh, "remesh.vv", &params);
            let volume = before.volume();
            let after = before.steps(12);
            let owed = (0..).zip(after.mesh.mesh_properties()).find(|(_, (name, _))| name == "owed").unwrap().1.1;
            let Value::Double(owed) = owed else { panic!("{owed:?}") };
            super::assert_near(after.volume() + owed, volume);
            assert!(owed.abs() < 0.004 * volume, "{mesh}, {size}: {owed} of {volume}");
        }
    }
}

/// What edits beside a crease take, where nothing may move, is given back elsewhere.
#[test]
fn remeshing_beside_creases_encloses_what_it_did() {
    let before = Show::on_mesh("torus.obj", "remesh.vv", &[]);
    let volume = before.volume();
    super::assert_near(before.steps(30).volume(), volume);
}

/// Where hardly a vertex may move, no edit lays triangles upon each other, nor takes more than what one edit does.
#[test]
fn remeshing_makes_no_folds() {
    for (mesh, most) in [("elephant.obj", 1e-9), ("tetrapod.obj", 0.015)] {
        let before = Show::on_mesh(mesh, "remesh.vv", &[]);
        let (volume, folds) = (before.volume(), folded(&before));
        let after = before.steps(8);
        assert!(folded(&after) <= folds, "{mesh}: {} {folds}", folded(&after));
        assert!((after.volume() / volume - 1.0).abs() < most, "{mesh}: {} {volume}", after.volume());
    }
}

/// A cube stays a cube, and its corners and edges are where they were.
#[test]
fn remeshing_keeps_creases() {
    for mesh in ["cube.obj", "cube-frame.obj", "genus-2.obj"] {
        let before = Show::on_mesh(mesh, "remesh.vv", &[("size", Value::Double(0.5))]);
        let (volume, area) = (before.volume(), before.area());
        let after = before.steps(8);
        super::assert_near(after.volume(), volume);
        super::assert_near(after.area(), area);
    }
}

#[test]
fn remeshing_to_another_size_makes_as_many_triangles_as_fit() {
    let faces = |size: f64| Show::new("remesh.vv", &[("size", Value::Double(size))]).steps(6).statistics().faces as f64;
    let ratio = faces(0.7) / faces(1.4);
    assert!((3.2..4.8).contains(&ratio), "{ratio}");
}

#[test]
fn remeshing_keeps_handles_and_holes() {
    for (mesh, euler, boundary) in [("genus-2.obj", -2, 0), ("torus.obj", 0, 0), ("grid-open.obj", 1, 1)] {
        for size in [0.4, 2.0] {
            let counts = Show::on_mesh(mesh, "remesh.vv", &[("size", Value::Double(size))]).steps(5).statistics();
            assert!(counts.valid);
            assert_eq!((counts.euler_characteristic, counts.boundary_loops), (euler, boundary), "{mesh}");
        }
    }
}

#[test]
fn remeshing_makes_triangles_of_other_faces() {
    for (mesh, euler) in [("torus-quads.obj", 0), ("pawn.obj", 2), ("grid-open-quads.obj", 1)] {
        let counts = Show::on_mesh(mesh, "remesh.vv", &[]).steps(5).statistics();
        assert!(counts.valid && counts.face_degrees.iter().all(|&(n, _)| n == 3), "{mesh}");
        assert_eq!(counts.euler_characteristic, euler, "{mesh}");
    }
}

#[test]
fn remeshing_leaves_a_flat_sheet_flat_and_its_outline() {
    let before = Show::on_mesh("grid-open.obj", "remesh.vv", &[]);
    let area = before.area();
    let after = before.steps(6);
    super::assert_near(after.area(), area);
}

#[test]
fn a_coral_grows_four_vertices_on_each_bud() {
    let awake = [("sleep", Value::Double(0.0)), ("unrest", Value::Double(0.0)), ("rise", Value::Double(1.0))];
    // Of the octahedron the upper four faces, then all three of each head: none looks down yet.
    let mut show = Show::new("coral.vv", &awake);
    let (mut vertices, mut buds) = (6, 4);
    for _ in 0..2 {
        show.step();
        vertices += 4 * buds;
        let counts = show.statistics();
        assert!(counts.valid && counts.closed);
        assert_eq!((counts.vertices, counts.components, counts.genus), (vertices, 1, Some(0)));
        let young = show.mesh.set.iter().filter(|&v| show.value("bud", v) == Value::Bool(true)).count();
        assert_eq!(young, 4 * buds);
        buds *= 3;
    }
}

/// Three buds for one: without a bound there would be more than a million vertices in twelve steps.
#[test]
fn a_coral_grows_by_as_many_buds_as_it_has_vigour_for() {
    let params = [("vigour", Value::Int(50)), ("sleep", Value::Double(0.0)), ("rise", Value::Double(1.0))];
    let mut show = Show::new("coral.vv", &params).steps(4);
    let mut before = show.statistics().vertices;
    for _ in 0..8 {
        show.step();
        let now = show.statistics().vertices;
        let grown = (now - before) / 4;
        assert!((15..100).contains(&grown), "{grown}");
        before = now;
    }
}

#[test]
fn a_coral_that_sleeps_stays() {
    let counts = Show::new("coral.vv", &[("sleep", Value::Double(1.0))]).steps(2).statistics();
    assert_eq!((counts.vertices, counts.faces), (6, 8));
}
