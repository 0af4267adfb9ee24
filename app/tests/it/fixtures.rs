//! Meshes by name.

use glam::DVec3;

use app::scene::Scene;
use vv::mesh::build::{Polygons, build};
use vv::mesh::faces::faces;
use vv::mesh::{Mesh, Vertex};
use vv::stop::Stop;

/// A mesh of polygons over vertices numbered from 0.
pub fn mesh(positions: &[[f64; 3]], polygons: &[&[u32]]) -> Mesh {
    let mut all = Polygons::new(positions.iter().map(|&p| DVec3::from(p)).collect());
    for polygon in polygons {
        all.push(polygon.iter().copied(), None).unwrap();
    }
    build(all, true, &Stop::new()).unwrap().0
}

pub fn scene(mesh: &Mesh) -> Scene {
    Scene::new(mesh, &faces(mesh, &Stop::new()).unwrap(), None, &Stop::new()).unwrap()
}

/// The scene of a mesh with the control mesh it came from.
pub fn scene_with_control(mesh: &Mesh, control: &Mesh) -> Scene {
    let of = |mesh| faces(mesh, &Stop::new()).unwrap();
    Scene::new(mesh, &of(mesh), Some((control, &of(control))), &Stop::new()).unwrap()
}

pub fn octahedron() -> Mesh {
    let positions =
        [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let triangles: [&[u32]; 8] =
        [&[2, 4, 0], &[2, 0, 5], &[2, 5, 1], &[2, 1, 4], &[3, 0, 4], &[3, 5, 0], &[3, 1, 5], &[3, 4, 1]];
    mesh(&positions, &triangles)
}

const CUBE: [[f64; 3]; 8] = [
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
];

pub fn cube() -> Mesh {
    mesh(&CUBE, &[&[0, 1, 2, 3], &[5, 4, 7, 6], &[4, 0, 3, 7], &[1, 5, 6, 2], &[4, 5, 1, 0], &[3, 2, 6, 7]])
}

/// A cube without lid.
pub fn box_without_lid() -> Mesh {
    mesh(&CUBE, &[&[0, 1, 2, 3], &[5, 4, 7, 6], &[4, 0, 3, 7], &[1, 5, 6, 2], &[4, 5, 1, 0]])
}

/// A torus of `n` by `m` quadrilaterals.
pub fn torus(n: u32, m: u32) -> Mesh {
    let mut positions = Vec::new();
    let mut polygons = Vec::new();
    for i in 0..n {
        for j in 0..m {
            let (u, v) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(m));
            let (u, v) = (u * std::f64::consts::TAU, v * std::f64::consts::TAU);
            let r = 1.0 + 0.42 * v.cos();
            positions.push([r * u.sin(), 0.42 * v.sin(), r * u.cos()]);
            let at = |i: u32, j: u32| (i % n) * m + j % m;
            polygons.push([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    mesh(&positions, &polygons.iter().map(|p| p.as_slice()).collect::<Vec<_>>())
}

/// A ball of `rows` rows of quadrilaterals with triangles at the poles.
pub fn ball(rows: u32) -> Mesh {
    let columns = 2 * rows;
    let mut positions = vec![[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]];
    for i in 1..rows {
        let (s, c) = (f64::from(i) / f64::from(rows) * std::f64::consts::PI).sin_cos();
        for j in 0..columns {
            let (a, b) = (f64::from(j) / f64::from(columns) * std::f64::consts::TAU).sin_cos();
            positions.push([s * a, c, s * b]);
        }
    }
    let at = |i: u32, j: u32| 2 + (i - 1) * columns + j % columns;
    let mut polygons: Vec<Vec<u32>> = Vec::new();
    for j in 0..columns {
        polygons.push(vec![0, at(1, j), at(1, j + 1)]);
        polygons.push(vec![1, at(rows - 1, j + 1), at(rows - 1, j)]);
        for i in 1..rows - 1 {
            polygons.push(vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    mesh(&positions, &polygons.iter().map(Vec::as_slice).collect::<Vec<_>>())
}

/// A slab whose upper and lower side are concave: the letter E.
pub fn letter() -> Mesh {
    let outline = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [2.5, 2.0],
        [2.5, 3.0],
        [1.0, 3.0],
        [1.0, 4.0],
        [3.0, 4.0],
        [3.0, 5.0],
        [0.0, 5.0],
    ];
    let n = outline.len() as u32;
    let positions: Vec<[f64; 3]> =
        [1.0, 0.0].iter().flat_map(|&z| outline.iter().map(move |&[x, y]| [x, y, z])).collect();
    let mut polygons: Vec<Vec<u32>> = vec![(0..n).collect(), (n..2 * n).rev().collect()];
    polygons.extend((0..n).map(|i| vec![i, i + n, (i + 1) % n + n, (i + 1) % n]));
    mesh(&positions, &polygons.iter().map(Vec::as_slice).collect::<Vec<_>>())
}

/// A square of `n` by `n` quadrilaterals over a hilly ground, seen from both sides.
pub fn hills(n: u32) -> Mesh {
    let mut positions = Vec::new();
    let mut polygons = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            let (x, z) = (f64::from(i) / f64::from(n) * 2.0 - 1.0, f64::from(j) / f64::from(n) * 2.0 - 1.0);
            positions.push([x, 0.3 * (3.0 * x).sin() * (2.5 * z).cos(), z]);
            let at = |i: u32, j: u32| i * (n + 1) + j;
            if i < n && j < n {
                polygons.push([at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)]);
            }
        }
    }
    mesh(&positions, &polygons.iter().map(|p| p.as_slice()).collect::<Vec<_>>())
}

/// A triangle, an edge that belongs to no face and hangs at one of its corners, and a vertex without neighbours.
pub fn dangling() -> Mesh {
    let mut mesh = mesh(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[&[0, 1, 2]]);
    let corner = mesh.vertices().nth(1).unwrap();
    let end = lonely(&mut mesh, [1.5, 1.0, 0.0]);
    lonely(&mut mesh, [1.5, 0.0, 0.5]);
    mesh.splice_after(Some(end), None, corner).unwrap();
    mesh.splice_after(None, Some(end), corner).unwrap();
    mesh.make(end, &[Some(corner), None]).unwrap();
    mesh
}

/// Adds a vertex without neighbours.
pub fn lonely(mesh: &mut Mesh, position: [f64; 3]) -> Vertex {
    let v = mesh.create().unwrap();
    mesh.set_position(v, position.into());
    mesh.set.add(v);
    v
}
