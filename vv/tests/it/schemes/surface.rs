//! Polygons over numbered vertices, which is how published rules speak of meshes, and figures to try them on.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use glam::{DVec3, dvec3};
use vv::io::{Format, ReadOptions, read};
use vv::mesh::build::{Polygons, build};
use vv::mesh::faces::faces;
use vv::mesh::{Mesh, Value, Vertex};
use vv::stop::Stop;

use super::assets_folder;
use super::published::Curve;

/// A polygon mesh whose vertices have one fan each. Corners are counter-clockwise.
pub struct Surface {
    pub points: Vec<DVec3>,
    pub faces: Vec<Vec<usize>>,
    /// Face and place of the corner at p whose next is q, by (p, q).
    corners: BTreeMap<(usize, usize), (usize, usize)>,
    /// Sharpness by (p, q), p < q; zero if it is not there.
    pub sharpness: BTreeMap<(usize, usize), f64>,
    /// Sharpness by vertex.
    pub sharp_vertices: BTreeMap<usize, f64>,
}

impl Surface {
    pub fn new(points: Vec<DVec3>, faces: Vec<Vec<usize>>) -> Self {
        let mut corners = BTreeMap::new();
        for (f, face) in faces.iter().enumerate() {
            for (i, &p) in face.iter().enumerate() {
                corners.insert((p, face[(i + 1) % face.len()]), (f, i));
            }
        }
        Self { points, faces, corners, sharpness: BTreeMap::new(), sharp_vertices: BTreeMap::new() }
    }

    pub fn of(mesh: &Mesh) -> Self {
        let found = faces(mesh, &Stop::new()).unwrap();
        let faces = found.iter().map(|f| f.iter().map(|v| v.index()).collect()).collect();
        Self::new(mesh.positions().to_vec(), faces)
    }

    #[track_caller]
    pub fn asset(name: &str) -> Self {
        let bytes = std::fs::read(assets_folder().join("meshes").join(name)).unwrap();
        let (mesh, warnings) = read(&bytes, Format::Obj, &ReadOptions::default()).unwrap();
        assert_eq!(warnings, [], "{name}");
        Self::of(&mesh)
    }

    #[track_caller]
    pub fn mesh(&self) -> Mesh {
        let mut polygons = Polygons::new(self.points.clone());
        for face in &self.faces {
            polygons.push(face.iter().map(|&v| v as u32), None).unwrap();
        }
        let (mut mesh, warnings) = build(polygons, true, &Stop::new()).unwrap();
        assert_eq!(warnings, []);
        let sharpness = mesh.declare_edge_property("sharpness", Value::Double(0.0));
        let vertex = |v: usize| Vertex::from_index(v).unwrap();
        for (&(p, q), &s) in &self.sharpness {
            assert!(mesh.set_edge_value(sharpness, vertex(p), vertex(q), Value::Double(s)));
        }
        let sharpness = mesh.declare_vertex_property("sharpness", Value::Double(0.0));
        for (&v, &s) in &self.sharp_vertices {
            mesh.set_vertex_value(sharpness, vertex(v), Value::Double(s));
        }
        mesh
    }

    /// The face left of p→q and the place of p in it.
    pub fn corner(&self, p: usize, q: usize) -> Option<(usize, usize)> {
        self.corners.get(&(p, q)).copied()
    }

    /// What follows q in the face left of p→q: in a triangle the vertex across the edge.
    pub fn across(&self, p: usize, q: usize) -> Option<usize> {
        let (f, i) = self.corner(p, q)?;
        Some(self.faces[f][(i + 2) % self.faces[f].len()])
    }

    /// Each edge once, p < q.
    pub fn edges(&self) -> Vec<(usize, usize)> {
        let both = self.corners.keys().map(|&(p, q)| (p.min(q), p.max(q)));
        let mut edges: Vec<_> = both.collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    pub fn is_boundary_edge(&self, p: usize, q: usize) -> bool {
        self.corner(p, q).is_none() || self.corner(q, p).is_none()
    }

    /// Neighbours counter-clockwise; at a boundary vertex from boundary to boundary.
    pub fn neighbours(&self, v: usize) -> Vec<usize> {
        let leaving = || self.corners.range((v, 0)..(v + 1, 0)).map(|(&(_, q), _)| q);
        let first = leaving().find(|&q| self.corner(q, v).is_none()).or(leaving().next()).unwrap();
        let mut ring = vec![first];
        while let Some((f, i)) = self.corner(v, ring[ring.len() - 1]) {
            let before = self.faces[f][(i + self.faces[f].len() - 1) % self.faces[f].len()];
            if before == first {
                break;
            }
            ring.push(before);
        }
        ring
    }

    /// The two neighbours along the boundary, if v lies there.
    pub fn boundary(&self, v: usize) -> Option<[usize; 2]> {
        let ring = self.neighbours(v);
        let ends = [ring[0], ring[ring.len() - 1]];
        ends.iter().all(|&q| self.is_boundary_edge(v, q)).then_some(ends)
    }
}

/// What is around the middle of a [`star`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Around {
    Triangles,
    Quads,
}

/// `sectors` sectors of a regular grid, `size` edges wide, around vertex 0: all round it, or, if `open`, half round it,
/// so that it lies on the boundary. All other vertices are regular.
pub fn star(sectors: usize, size: usize, around: Around, open: bool) -> Surface {
    let rays = if open { sectors + 1 } else { sectors };
    let mut number = BTreeMap::new();
    let mut points = vec![DVec3::ZERO];
    let ray = |s: usize| {
        let angle = s as f64 / sectors as f64 * if open { PI } else { TAU };
        dvec3(angle.cos(), angle.sin(), 0.0)
    };
    let mut vertex = |s: usize, i: usize, j: usize| {
        let key = match (i, j) {
            (0, 0) => return 0,
            (0, j) => ((s + 1) % rays, j, 0),
            _ => (s, i, j),
        };
        *number.entry(key).or_insert_with(|| {
            points.push(ray(s) * i as f64 + ray(s + 1) * j as f64);
            points.len() - 1
        })
    };
    let mut faces = Vec::new();
    for (s, i, j) in (0..sectors).flat_map(|s| (0..size).flat_map(move |i| (0..size).map(move |j| (s, i, j)))) {
        let [a, b] = [(0, 0), (1, 0)].map(|(di, dj)| (s, i + di, j + dj));
        let [c, d] = [(1, 1), (0, 1)].map(|(di, dj)| (s, i + di, j + dj));
        let mut push = |corners: &[(usize, usize, usize)]| {
            faces.push(corners.iter().map(|&(s, i, j)| vertex(s, i, j)).collect());
        };
        match around {
            Around::Quads => push(&[a, b, c, d]),
            Around::Triangles => {
                if i + j < size {
                    push(&[a, b, d]);
                }
                if i + j + 1 < size {
                    push(&[b, c, d]);
                }
            }
        }
    }
    Surface::new(points, faces)
}

/// A wire: a hole on either side of each edge.
pub fn wire(curve: &Curve) -> Mesh {
    let mut mesh = Mesh::new();
    for _ in curve {
        let v = mesh.create().unwrap();
        mesh.set.add(v);
    }
    let vertices: Vec<_> = mesh.vertices().collect();
    for (neighbours, &v) in curve.iter().zip(&vertices) {
        let items: Vec<_> = neighbours.iter().flat_map(|&q| [Some(vertices[q]), None]).collect();
        mesh.make(v, &items).unwrap();
    }
    mesh
}
