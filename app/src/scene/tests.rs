use glam::{DVec3, Vec2, Vec3};

use super::part::pack;
use super::*;
use vv::io::{Format, ReadOptions, read};
use vv::mesh::Vertex;
use vv::mesh::faces::faces;
use vv::stop::Stop;

pub(super) const OCTAHEDRON: &str = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
                          f 3 5 1\nf 3 1 6\nf 3 6 2\nf 3 2 5\nf 4 1 5\nf 4 6 1\nf 4 2 6\nf 4 5 2\n";
pub(super) const CUBE: &str = "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\n\
                    f 1 2 3 4\nf 6 5 8 7\nf 5 1 4 8\nf 2 6 7 3\nf 5 6 2 1\nf 4 3 7 8\n";
const TWO_TRIANGLES: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
/// A triangle and, beside it, an arrow head with five corners that all speak for something already.
pub(super) const ARROW: &str = "v 0 0 0\nv 4 -2 0\nv 3 0 0\nv 4 2 0\nv 0 4 0\nf 1 2 3 4 5\n";

pub(super) fn mesh(obj: &str) -> Mesh {
    read(obj.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap().0
}

fn scene_of(mesh: &Mesh) -> Scene {
    Scene::new(mesh, &faces(mesh, &Stop::new()).unwrap(), None, &Stop::new()).unwrap()
}

fn scene(obj: &str) -> Scene {
    scene_of(&mesh(obj))
}

/// The other way round than `pack`, as the shaders do it.
fn unpack(word: u32) -> Vec3 {
    let square = Vec2::new(f32::from(word as i16), f32::from((word >> 16) as i16)) / 32767.0;
    let z = 1.0 - square.x.abs() - square.y.abs();
    let below = Vec2::splat((-z).max(0.0));
    (square + Vec2::select(square.cmpge(Vec2::ZERO), -below, below)).extend(z).normalize()
}

/// Edges by the numbers of their vertices, from 1: those between two faces, then the others.
#[track_caller]
fn check_edges(mesh: &Mesh, inner: &[[u32; 2]], outer: &[[u32; 2]]) {
    let part = scene_of(mesh).mesh;
    let numbered: Vec<[u32; 2]> = part.edges.iter().map(|e| e.map(|i| i + 1)).collect();
    let (a, b) = numbered.split_at(part.inner_edge_count as usize);
    assert_eq!((a, b), (inner, outer));
}

/// The first corner of each triangle holds the normal of its face, which `expected` gives for its middle.
#[track_caller]
fn check_face_normals(scene: &Scene, expected: impl Fn(DVec3) -> DVec3) {
    assert!(!scene.mesh.triangles.is_empty());
    for t in &scene.mesh.triangles {
        let middle = t.map(|i| Vec3::from(scene.mesh.corners[i as usize].position)).into_iter().sum::<Vec3>() / 3.0;
        let normal = unpack(scene.mesh.corners[t[0] as usize].face_normal).as_dvec3();
        let expected = expected(scene.to_world(middle)).normalize();
        assert!(normal.distance(expected) < 1e-3, "{normal} at {middle} in place of {expected}");
    }
}

#[test]
fn nothing_makes_an_empty_scene() {
    let scene = scene_of(&Mesh::new());
    assert!(scene.mesh.corners.is_empty() && scene.mesh.triangles.is_empty() && scene.mesh.edges.is_empty());
    assert_eq!(scene.bounds(&Style::default()), Sphere { center: DVec3::ZERO, radius: 0.0 });
}

#[test]
fn edges_come_once_those_of_the_boundary_last() {
    check_edges(&mesh(TWO_TRIANGLES), &[[1, 3]], &[[1, 2], [1, 4], [2, 3], [3, 4]]);
    assert_eq!(scene(CUBE).mesh.edges.len(), 12);
    assert_eq!(scene(CUBE).mesh.inner_edge_count, 12);
}

#[test]
fn an_edge_that_only_one_end_names_is_drawn() {
    let mut mesh = mesh(TWO_TRIANGLES);
    let (v2, v4) = (Vertex::from_index(1).unwrap(), Vertex::from_index(3).unwrap());
    mesh.splice_after(Some(v2), None, v4).unwrap();
    assert!(scene_of(&mesh).mesh.edges.contains(&[1, 3]));
    // The same named by the older end.
    mesh.erase(Some(v2), v4);
    assert!(!scene_of(&mesh).mesh.edges.contains(&[1, 3]));
    mesh.splice_after(Some(v4), None, v2).unwrap();
    assert!(scene_of(&mesh).mesh.edges.contains(&[1, 3]));
}

#[test]
fn an_edge_by_itself_has_no_face() {
    let mut mesh = Mesh::new();
    let (p, q) = (mesh.create().unwrap(), mesh.create().unwrap());
    mesh.set_position(q, DVec3::X);
    mesh.make(p, &[Some(q)]).unwrap();
    mesh.make(q, &[Some(p)]).unwrap();
    mesh.set = [p, q].into_iter().collect();
    check_edges(&mesh, &[], &[[1, 2]]);
    assert!(scene_of(&mesh).mesh.triangles.is_empty());
}

#[test]
fn vertices_without_edges_come_first() {
    let mut mesh = mesh(TWO_TRIANGLES);
    let lonely = mesh.create().unwrap();
    mesh.set_position(lonely, DVec3::new(9.0, 0.0, 0.0));
    let scene = scene_of(&mesh);
    assert_eq!((scene.mesh.lonely_count, scene.mesh.vertex_count), (1, 5));
    let first = scene.to_world(scene.mesh.corners[0].position.into());
    assert!(first.distance(DVec3::new(9.0, 0.0, 0.0)) < 1e-6);
    assert_eq!(scene.mesh.edges[0], [1, 3], "between v1 and v3");
}

#[test]
fn each_triangle_knows_the_normal_of_its_face() {
    check_face_normals(&scene(OCTAHEDRON), DVec3::signum);
    check_face_normals(&scene(CUBE), |p| DVec3::select(p.abs().cmpge(DVec3::splat(0.99)), p, DVec3::ZERO));
    check_face_normals(&scene(TWO_TRIANGLES), |_| DVec3::Z);
    check_face_normals(&scene(ARROW), |_| DVec3::Z);
}

#[test]
fn faces_need_at_most_a_corner_each_beside_those_of_the_vertices() {
    assert_eq!(scene(CUBE).mesh.corners.len(), 8);
    assert_eq!(scene(OCTAHEDRON).mesh.corners.len(), 8);
    assert_eq!(scene(ARROW).mesh.corners.len(), 5);
}

#[test]
fn normals_of_vertices_on_a_sphere_are_those_of_the_sphere() {
    // A box that is no cube: its faces have different sizes.
    let mut mesh = mesh(CUBE);
    for v in mesh.vertices() {
        mesh.set_position(v, (mesh.position(v) * DVec3::new(1.0, 2.0, 5.0)).normalize());
    }
    let scene = scene_of(&mesh);
    for corner in &scene.mesh.corners {
        let expected = scene.to_world(corner.position.into()).normalize();
        assert!(unpack(corner.normal).as_dvec3().distance(expected) < 1e-3);
    }
}

#[test]
fn packing_a_normal_keeps_its_direction() {
    for i in 0..1000u16 {
        let (z, angle) = (f32::from(i) / 499.5 - 1.0, f32::from(i) * 2.4);
        let r = (1.0 - z * z).max(0.0).sqrt();
        let n = Vec3::new(r * angle.cos(), r * angle.sin(), z);
        assert!(unpack(pack(n)).distance(n) < 1e-4, "{n}");
    }
    for n in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z] {
        assert!(unpack(pack(n)).distance(n) < 1e-4, "{n}");
    }
}

#[test]
fn a_position_that_is_no_number_takes_its_faces_and_edges_along() {
    let mut mesh = mesh(CUBE);
    mesh.set_position(Vertex::from_index(0).unwrap(), DVec3::new(0.0, f64::NAN, 0.0));
    let scene = scene_of(&mesh);
    assert_eq!((scene.mesh.vertex_count, scene.mesh.edges.len(), scene.mesh.triangles.len()), (7, 9, 6));
    assert_eq!(scene.mesh.inner_edge_count, 9, "the surface is not open, only not all seen");
    assert!(scene.mesh.corners.iter().all(|c| c.position.iter().all(|x| x.is_finite())));
}

#[test]
fn faces_without_area_are_harmless() {
    let part = scene(&CUBE.replace("-1 ", "1 ").replace(" -1", " 1")).mesh;
    assert!(part.corners.iter().all(|c| c.position.iter().all(|x| x.is_finite())));
    assert_eq!(part.vertex_count, 8);
}

#[test]
fn far_away_meshes_keep_their_shape() {
    let mut mesh = mesh(CUBE);
    for v in mesh.vertices() {
        mesh.set_position(v, mesh.position(v) * 1e-3 + DVec3::splat(1e6));
    }
    let scene = scene_of(&mesh);
    assert!((scene.unit.log2() - scene.unit.log2().round()).abs() < 1e-12, "a power of two");
    for (corner, &p) in scene.mesh.corners.iter().zip(mesh.positions()) {
        assert!(scene.to_world(corner.position.into()).distance(p) < 1e-8);
        assert!(Vec3::from(corner.position).length() < 2.0);
    }
}

#[test]
fn the_control_mesh_counts_only_while_it_is_shown() {
    let [mesh, control] = [OCTAHEDRON, CUBE].map(mesh);
    let of = |mesh| faces(mesh, &Stop::new()).unwrap();
    let scene = Scene::new(&mesh, &of(&mesh), Some((&control, &of(&control))), &Stop::new()).unwrap();
    let radius = |control| scene.bounds(&Style { control, ..Style::default() }).radius;
    assert!((radius(false) - 1.0).abs() < 1e-12);
    assert!((radius(true) - 3f64.sqrt()).abs() < 1e-12);
    assert!(scene.control.triangles.is_empty());
    assert_eq!(scene.control.edges.len(), 12);
}

/// Looking neighbours up one by one would take the square of this.
#[test]
fn a_vertex_with_thirty_thousand_neighbours_takes_no_longer_than_others() {
    let n = 30_000;
    let mut obj = String::from("v 0 0 1\n");
    for i in 0..n {
        let (s, c) = (f64::from(i) / f64::from(n) * std::f64::consts::TAU).sin_cos();
        obj += &format!("v {c} {s} 0\n");
    }
    for i in 0..n {
        obj += &format!("f 1 {} {}\n", i + 2, (i + 1) % n + 2);
    }
    let scene = scene(&obj);
    assert_eq!(scene.mesh.triangles.len(), n as usize);
    assert_eq!((scene.mesh.inner_edge_count, scene.mesh.edges.len()), (n as u32, 2 * n as usize));
}

#[test]
fn a_scene_that_nobody_waits_for_is_given_up() {
    let mesh = mesh(OCTAHEDRON);
    let stop = Stop::new();
    let faces = faces(&mesh, &stop).unwrap();
    stop.request(Stopped::ByUser);
    assert!(matches!(Scene::new(&mesh, &faces, None, &stop), Err(Stopped::ByUser)));
}

#[test]
fn a_plane_keeps_the_part_of_a_ray_that_lies_before_it() {
    let plane = Plane { normal: DVec3::X, place: 1.0 };
    let kept = |x: f64, direction| plane.kept(Ray { origin: DVec3::X * x, direction });
    let far = f64::INFINITY;
    assert_eq!(
        [kept(0.0, DVec3::X), kept(0.0, DVec3::NEG_X), kept(0.0, DVec3::Y)],
        [[0.0, 1.0], [0.0, far], [0.0, far]]
    );
    assert_eq!(
        [kept(3.0, DVec3::NEG_X), kept(3.0, DVec3::X), kept(3.0, DVec3::Y)],
        [[2.0, far], [far, far], [far, far]]
    );
}

#[test]
fn a_scene_knows_its_lowest_place_and_its_longest_edge_between_faces() {
    // The first edges are long, the last ones short.
    let scene = scene("v 0 0 8\nv 1 0 -1\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n");
    assert_eq!(scene.lowest, DVec3::new(0.0, 0.0, -1.0));
    let longest = f64::from(scene.mesh.longest_inner_edge) * scene.unit;
    assert!((longest - 82f64.sqrt()).abs() < 1e-5, "{longest}");
    assert_eq!(scene_of(&Mesh::new()).lowest, DVec3::ZERO);
}
