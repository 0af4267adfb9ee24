use glam::{DVec2, DVec3};
use vv::mesh::faces::{Faces, faces};
use vv::mesh::{Mesh, Vertex};
use vv::stop::Stop;

use super::super::tests::{ARROW, CUBE, OCTAHEDRON, mesh};
use super::super::{Scene, Sphere, Style};
use super::*;
use crate::camera::Camera;

fn indexed(mesh: &Mesh) -> (Scene, Faces) {
    let faces = faces(mesh, &Stop::new()).unwrap();
    let scene = Scene::new(mesh, &faces, None, &Stop::new()).unwrap();
    scene.build_index();
    (scene, faces)
}

/// Looks at `to` from `from`; up to a twentieth of the distance is near.
fn pointer(from: [f64; 3], to: [f64; 3]) -> Pointer {
    let (origin, to) = (DVec3::from(from), DVec3::from(to));
    Pointer { ray: Ray { origin, direction: (to - origin).normalize() }, spread: 0.05, opaque: true, cut: None }
}

/// `face v1 v2 v3 v4 | edge v1 v2 | vertex v1`; what is not near stands in brackets.
fn show(picked: Option<Picked>, faces: &Faces) -> String {
    let Some(picked) = picked else { return "nothing".to_owned() };
    let mut parts = Vec::new();
    if let Some(face) = picked.face {
        parts.push(faces.get(face).iter().fold("face".to_owned(), |text, v| format!("{text} {v}")));
    }
    let mut part = |text: String, distance: f64| parts.push(if distance <= 1.0 { text } else { format!("({text})") });
    if let Some(Near { what: [a, b], distance, .. }) = picked.edge {
        part(format!("edge {a} {b}"), distance);
    }
    if let Some(Near { what, distance, .. }) = picked.vertex {
        part(format!("vertex {what}"), distance);
    }
    parts.join(" | ")
}

#[track_caller]
fn check(mesh: &Mesh, pointer: Pointer, expected: &str) {
    let (scene, faces) = indexed(mesh);
    assert_eq!(show(scene.pick(&pointer), &faces), expected);
}

#[test]
fn a_face_is_picked_with_the_edge_and_the_corner_nearest_to_the_pointer() {
    let cube = mesh(CUBE);
    check(&cube, pointer([0.0, 0.0, 9.0], [0.5, 0.2, 1.0]), "face v1 v2 v3 v4 | (edge v2 v3) | (vertex v3)");
    check(&cube, pointer([0.0, 0.0, 9.0], [0.9, 0.2, 1.0]), "face v1 v2 v3 v4 | edge v2 v3 | (vertex v3)");
    check(&cube, pointer([0.0, 0.0, 9.0], [0.9, 0.95, 1.0]), "face v1 v2 v3 v4 | edge v3 v4 | vertex v3");
    // From inside as well.
    check(&cube, pointer([0.0, 0.0, 0.0], [-1.0, 0.5, 0.1]), "face v1 v4 v8 v5 | (edge v4 v8) | (vertex v4)");
}

#[test]
fn beside_the_surface_its_edges_and_vertices_are_still_picked() {
    let cube = mesh(CUBE);
    check(&cube, pointer([0.0, 0.0, 9.0], [1.1, 0.2, 1.0]), "edge v2 v3");
    check(&cube, pointer([0.0, 0.0, 9.0], [1.1, 1.1, 1.0]), "edge v3 v7 | vertex v3");
    check(&cube, pointer([0.0, 0.0, 9.0], [2.0, 0.2, 1.0]), "nothing");
    check(&cube, pointer([0.0, 0.0, 9.0], [0.0, 0.0, 18.0]), "nothing");
}

#[test]
fn faces_hide_what_is_behind_them() {
    let cube = mesh(CUBE);
    // v5 shows through the face in front of it.
    let mut pointer = Pointer { spread: 0.02, ..pointer([0.0, 0.0, 9.0], [-1.0, -1.0, -1.0]) };
    check(&cube, pointer, "face v1 v2 v3 v4 | (edge v1 v2) | (vertex v1)");
    pointer.opaque = false;
    check(&cube, pointer, "face v1 v2 v3 v4 | edge v5 v8 | vertex v5");
}

#[test]
fn cuts_through_a_polygon_are_no_edges() {
    let arrow = mesh(ARROW);
    // Near the cut from v1 to v3, in the middle of the face.
    check(&arrow, pointer([1.5, 0.0, 9.0], [1.5, 0.0, 0.0]), "face v1 v2 v3 v4 v5 | (edge v1 v2) | (vertex v1)");
    check(&arrow, pointer([3.2, 0.0, 9.0], [3.2, 0.0, 0.0]), "edge v2 v3 | vertex v3");
}

#[test]
fn edges_and_vertices_without_faces_are_picked() {
    let mut mesh = Mesh::new();
    let [a, b, c] = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| {
        let v = mesh.create().unwrap();
        mesh.set_position(v, p);
        v
    });
    mesh.make(a, &[Some(b)]).unwrap();
    mesh.make(b, &[Some(a)]).unwrap();
    mesh.set = [a, b, c].into_iter().collect();
    check(&mesh, pointer([0.0, 0.0, 5.0], [0.5, 0.1, 0.0]), "edge v1 v2");
    check(&mesh, pointer([0.0, 0.0, 5.0], [0.0, 0.9, 0.0]), "vertex v3");
    let (scene, _) = indexed(&mesh);
    assert_eq!(scene.pick(&pointer([0.0, 0.0, 5.0], [0.1, 0.9, 0.0])).unwrap().point, DVec3::Y);
}

#[test]
fn nothing_is_found_before_the_index_is_built_and_nothing_in_an_empty_scene() {
    let mesh = mesh(CUBE);
    let scene = Scene::new(&mesh, &faces(&mesh, &Stop::new()).unwrap(), None, &Stop::new()).unwrap();
    let at = pointer([0.0, 0.0, 9.0], [0.5, 0.2, 1.0]);
    assert_eq!(scene.pick(&at), None);
    scene.build_index();
    assert!(scene.pick(&at).is_some());
    check(&Mesh::new(), at, "nothing");
}

/// A numbered stream of numbers between 0 and 1.
fn noise(seed: u64) -> f64 {
    let x = (seed.wrapping_add(1)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    ((x ^ (x >> 27)) >> 11) as f64 / (1u64 << 53) as f64
}

/// Rough ground of triangles, far from the origin.
fn ground(n: u64) -> Mesh {
    let mut obj = String::new();
    for i in 0..n * n {
        obj += &format!("v {} {} {}\n", 1000 + i % n, i / n, noise(i));
    }
    for i in (0..n * (n - 1)).filter(|i| i % n < n - 1) {
        obj += &format!("f {} {} {}\nf {} {} {}\n", i + 1, i + 2, i + n + 2, i + 1, i + n + 2, i + n + 1);
    }
    mesh(&obj)
}

/// What is found without looking at all is what is found by looking at all.
#[test]
fn the_nearest_are_the_nearest_of_all() {
    let mesh = ground(30);
    let (scene, faces) = indexed(&mesh);
    let mut hits = 0;
    for i in 0..400u64 {
        let random = |k: u64| noise(10_000 + 7 * i + k);
        let from = [1000.0 + 40.0 * random(0) - 5.0, 40.0 * random(1) - 5.0, 3.0 + 20.0 * random(2)];
        let to = [1000.0 + 32.0 * random(3) - 1.0, 32.0 * random(4) - 1.0, 0.5];
        let pointer = Pointer { spread: 0.01 + 0.1 * random(5), ..pointer(from, to) };
        let picked = scene.pick(&pointer);
        let ray = pointer.ray;
        let corners = |f: &[Vertex]| [0, 1, 2].map(|k| mesh.position(f[k]));
        let met = faces.iter().enumerate().filter_map(|(i, f)| Some((meet(ray, corners(f))?, i)));
        let first = met.min_by(|a, b| a.0.total_cmp(&b.0));
        let limit = first.map_or(f64::INFINITY, |(t, _)| t + 1e-4);
        assert_eq!(picked.and_then(|p| p.face), first.map(|(_, face)| face), "{pointer:?}");
        hits += usize::from(first.is_some());
        let beside = |p: DVec3| {
            let depth = (p - ray.origin).dot(ray.direction);
            (p.distance(ray.origin + depth * ray.direction) / (pointer.spread * depth), depth)
        };
        let allowed = |v: &Vertex| first.is_some_and(|(_, face)| faces.get(face).contains(v));
        let nearest = mesh.vertices().filter(|v| {
            let (distance, depth) = beside(mesh.position(*v));
            depth > 0.0 && (allowed(v) || (distance <= 1.0 && depth <= limit))
        });
        let nearest = nearest.map(|v| beside(mesh.position(v)).0).min_by(f64::total_cmp);
        let found = picked.and_then(|p| p.vertex).map(|near| near.distance);
        match (nearest, found) {
            (Some(a), Some(b)) => assert!((a - b).abs() < 1e-3 * a.max(1.0), "{a} {b} {pointer:?}"),
            (a, b) => assert_eq!(a.is_some(), b.is_some(), "{pointer:?}"),
        }
    }
    assert!((100..400).contains(&hits), "{hits}");
}

#[test]
fn fitting_by_the_farthest_points_is_fitting_all() {
    for (mesh, control) in [(ground(20), mesh(OCTAHEDRON)), (mesh(CUBE), ground(5)), (mesh(ARROW), mesh(CUBE))] {
        let of = |mesh| faces(mesh, &Stop::new()).unwrap();
        let scene = Scene::new(&mesh, &of(&mesh), Some((&control, &of(&control))), &Stop::new()).unwrap();
        let style = |control| Style { control, ..Style::default() };
        let views = |scene: &Scene| {
            let camera = Camera::standard(Sphere { center: DVec3::ZERO, radius: 1.0 }, 1.0);
            let turned = camera.orbit(DVec2::ZERO, DVec2::new(1.0, -0.3));
            [(camera, false, 1.6), (camera, true, 0.5), (turned, false, 1.0), (turned, true, 2.0)]
                .map(|(camera, control, aspect)| scene.fit(camera, &style(control), aspect))
        };
        let all = views(&scene);
        scene.build_index();
        for (a, b) in all.into_iter().zip(views(&scene)) {
            let size = scene.bounds(&style(true)).radius;
            assert!(
                a.pivot.distance(b.pivot) < 1e-9 * size && (a.distance - b.distance).abs() < 1e-9 * size,
                "{a:?} {b:?}"
            );
        }
    }
}

#[test]
fn scenes_and_indices_are_the_same_for_any_number_of_threads() {
    let mesh = ground(60);
    let made = [1, 2, 5].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| format!("{:?}", indexed(&mesh).0))
    });
    assert!(made[0] == made[1] && made[0] == made[2]);
}

#[test]
fn what_is_cut_away_is_not_meant_and_hides_nothing() {
    let (scene, _) = indexed(&mesh(OCTAHEDRON));
    let whole = pointer([0.2, 0.2, 9.0], [0.2, 0.2, 0.0]);
    let front = scene.pick(&whole).unwrap();
    assert!(front.point.z > 0.5);
    let open = Pointer { cut: Some(Plane { normal: DVec3::Z, place: 0.0 }), ..whole };
    let back = scene.pick(&open).unwrap();
    assert!(back.point.z < -0.5, "{}", back.point);
    assert_ne!(front.face, back.face);
    let behind = Pointer { cut: Some(Plane { normal: DVec3::NEG_Z, place: 0.0 }), ..whole };
    assert_eq!(scene.pick(&behind).unwrap().face, front.face);
    let all = Pointer { cut: Some(Plane { normal: DVec3::Z, place: -2.0 }), ..whole };
    assert!(scene.pick(&all).is_none());
    assert!(scene.hides(whole.ray, None, DVec3::new(0.2, 0.2, 0.0), 1e-3));
    assert!(!scene.hides(whole.ray, open.cut, DVec3::new(0.2, 0.2, 0.0), 1e-3));
}

#[test]
fn distances_and_cuts_are_in_units_of_the_world() {
    let mut cube = mesh(CUBE);
    cube.vertices().for_each(|v| cube.set_position(v, 100.0 * cube.position(v)));
    let (scene, _) = indexed(&cube);
    let whole = pointer([50.0, 20.0, 900.0], [50.0, 20.0, 0.0]);
    let at = |cut| scene.pick(&Pointer { cut, ..whole }).unwrap().point.z.round();
    let plane = |place| Some(Plane { normal: DVec3::Z, place });
    assert_eq!([at(None), at(plane(101.0)), at(plane(50.0))], [100.0, 100.0, -100.0]);
    let hides = |z: f64| scene.hides(whole.ray, None, DVec3::new(50.0, 20.0, z), 1.0);
    assert_eq!([hides(50.0), hides(99.5)], [true, false]);
}

#[test]
fn an_edge_between_two_faces_that_cannot_be_drawn_is_picked() {
    let mut pair = mesh("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 5 6 3\n");
    let corners: Vec<Vertex> = pair.vertices().collect();
    [corners[0], corners[4]].into_iter().for_each(|v| pair.set_position(v, DVec3::NAN));
    check(&pair, pointer([1.0, 0.5, 5.0], [1.0, 0.5, 0.0]), "edge v2 v3");
}
