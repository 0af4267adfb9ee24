//! One mesh in arrays.

use glam::{DVec3, Vec2, Vec3};

use vv::io::COLOR;
use vv::mesh::faces::Faces;
use vv::mesh::triangulate::{Triangulator, newell};
use vv::mesh::{Mesh, Values, Vertex};
use vv::stop::{Stop, Stopped};

/// A vertex as the GPU reads it: five words.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Corner {
    /// In scene units.
    pub position: [f32; 3],
    /// Normal of the surface around the vertex, packed by `pack`; the zero word where there is no surface.
    pub normal: u32,
    /// Normal of the face this corner speaks for, packed.
    pub face_normal: u32,
}

/// One mesh, ready for the GPU.
///
/// Flat shading needs one value for each face without tripling the vertices: the first corner of a triangle speaks for
/// it (the *provoking vertex*). Every face has a corner of its own; where all corners at a vertex speak for faces
/// already, the vertex gets another corner, so there are about as many corners as faces.
#[derive(Debug, Clone, Default)]
pub struct Part {
    /// First one for each vertex — those without edges first —, then what the faces need in addition.
    pub corners: Vec<Corner>,
    /// The colours of the corners as [`pack_color`] packs them, if vertices have colours; else none.
    pub colors: Vec<u32>,
    /// How many of `corners` stand for vertices.
    pub vertex_count: u32,
    /// How many of these have no edge, and are therefore drawn even where others are not.
    pub lonely_count: u32,
    /// Three corners each, counter-clockwise seen from outside; the first speaks for the face.
    pub triangles: Vec<[u32; 3]>,
    /// The vertices at the ends of each edge: edges between two faces first, then those of the boundary and those
    /// without any face.
    pub edges: Vec<[u32; 2]>,
    /// How many of `edges` lie between two faces.
    pub inner_edge_count: u32,
    /// Mean length of the edges in scene units; 0 without edges.
    pub mean_edge: f32,
    /// Length of the longest edge between two faces in scene units.
    pub longest_inner_edge: f32,
}

/// What is filled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fill {
    Faces,
    Nothing,
}

const NONE: u32 = u32::MAX;

impl Part {
    pub(super) fn new(
        mesh: &Mesh,
        faces: &Faces,
        to_scene: &dyn Fn(DVec3) -> Option<DVec3>,
        fill: Fill,
        stop: &Stop,
    ) -> Result<Self, Stopped> {
        let mut part = Self::default();
        let places = part.add_vertices(mesh, to_scene);
        part.add_edges(mesh, faces, &places, stop)?;
        if fill == Fill::Faces {
            let further = part.add_faces(faces, &places, stop)?;
            part.add_colors(mesh, &places, &further);
        }
        Ok(part)
    }

    /// Fills in the corners that stand for vertices; returns which stands for which vertex.
    fn add_vertices(&mut self, mesh: &Mesh, to_scene: &dyn Fn(DVec3) -> Option<DVec3>) -> Places {
        let mut places = Places { of: vec![NONE; mesh.vertex_count()], positions: Vec::new() };
        places.positions.reserve(mesh.vertex_count());
        for lonely in [true, false] {
            for (v, &p) in mesh.vertices().zip(mesh.positions()) {
                if (mesh.ring(v).valence() == 0) == lonely
                    && let Some(p) = to_scene(p)
                {
                    places.of[v.index()] = index(places.positions.len());
                    places.positions.push(p);
                }
            }
            if lonely {
                self.lonely_count = index(places.positions.len());
            }
        }
        self.vertex_count = index(places.positions.len());
        let corner = |p: &DVec3| Corner { position: p.as_vec3().to_array(), normal: 0, face_normal: 0 };
        self.corners = places.positions.iter().map(corner).collect();
        places
    }

    /// Each pair of neighbours once.
    fn add_edges(&mut self, mesh: &Mesh, faces: &Faces, places: &Places, stop: &Stop) -> Result<(), Stopped> {
        let mut outer = Vec::new();
        let (mut total, mut longest) = (0.0, 0.0f64);
        for_each_edge(mesh, faces, stop, |p, q, sides| {
            let (Some(a), Some(b)) = (places.get(p), places.get(q)) else { return };
            let length = places.positions[a as usize].distance(places.positions[b as usize]);
            total += length;
            if sides == Sides::Both {
                longest = longest.max(length);
                self.edges.push([a, b]);
            } else {
                outer.push([a, b]);
            }
        })?;
        self.inner_edge_count = index(self.edges.len());
        self.edges.append(&mut outer);
        self.mean_edge = if self.edges.is_empty() { 0.0 } else { (total / self.edges.len() as f64) as f32 };
        self.longest_inner_edge = longest as f32;
        Ok(())
    }

    /// Triangles, and normals of faces and vertices. Returns the vertex for which each further corner stands, by its
    /// corner.
    fn add_faces(&mut self, faces: &Faces, places: &Places, stop: &Stop) -> Result<Vec<u32>, Stopped> {
        let mut normals = vec![DVec3::ZERO; self.corners.len()];
        let mut speaks = vec![false; self.corners.len()];
        let mut extra: Vec<u32> = Vec::new(); // the vertex of each further corner
        let mut triangulator = Triangulator::default();
        let (mut points, mut ends, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        let mut speakers: Vec<u32> = Vec::new();
        for face in faces.iter().filter(|f| f.len() > 2) {
            stop.check()?;
            ends.clear();
            ends.extend(face.iter().filter_map(|&v| places.get(v)));
            if ends.len() < face.len() {
                continue; // a corner that cannot be drawn
            }
            points.clear();
            points.extend(ends.iter().map(|&i| places.positions[i as usize]));
            let area = newell(&points);
            let normal = area.normalize_or_zero();
            triangulator.triangles(&points, area, &mut triangles);
            add_corner_normals(&points, &ends, normal, &mut normals);

            // A corner of each triangle speaks for this face: one that does already, one that speaks for none, a new
            // one. Fans need one in all.
            speakers.clear();
            speakers.resize(ends.len(), NONE);
            let packed = pack(normal.as_vec3());
            for t in &triangles {
                let ready = t.iter().position(|&i| speakers[i as usize] != NONE);
                let first = ready.or_else(|| t.iter().position(|&i| !speaks[ends[i as usize] as usize])).unwrap_or(0);
                let [a, b, c] = [t[first], t[(first + 1) % 3], t[(first + 2) % 3]].map(|i| i as usize);
                if speakers[a] == NONE {
                    let vertex = ends[a] as usize;
                    let corner = if speaks[vertex] { self.corners.len() } else { vertex };
                    if corner == vertex {
                        speaks[vertex] = true;
                    } else {
                        extra.push(ends[a]);
                        self.corners.push(self.corners[vertex]);
                    }
                    self.corners[corner].face_normal = packed;
                    speakers[a] = index(corner);
                }
                self.triangles.push([speakers[a], ends[b], ends[c]]);
            }
        }
        let (own, further) = self.corners.split_at_mut(normals.len());
        for (corner, normal) in own.iter_mut().zip(&normals) {
            corner.normal = normal.try_normalize().map_or(0, |n| pack(n.as_vec3()));
        }
        for (corner, &vertex) in further.iter_mut().zip(&extra) {
            corner.normal = own[vertex as usize].normal;
        }
        Ok(extra)
    }

    /// Colours of vertices, if they have some, and of the further corners.
    fn add_colors(&mut self, mesh: &Mesh, places: &Places, further: &[u32]) {
        let column = mesh.vertex_properties().iter().find_map(|property| match &property.values {
            Values::Vec(colors) if property.name == COLOR => Some(colors),
            _ => None,
        });
        let Some(column) = column else { return };
        self.colors = vec![0; self.vertex_count as usize];
        for (&place, &color) in places.of.iter().zip(column.iter()).filter(|&(&place, _)| place != NONE) {
            self.colors[place as usize] = pack_color(color);
        }
        let colors = &mut self.colors;
        further.iter().for_each(|&vertex| colors.push(colors[vertex as usize]));
    }
}

/// Where vertices stand among the corners, and their positions in scene units.
struct Places {
    of: Vec<u32>,
    positions: Vec<DVec3>,
}

impl Places {
    fn get(&self, v: Vertex) -> Option<u32> {
        self.of.get(v.index()).copied().filter(|&i| i != NONE)
    }
}

/// On how many sides an edge has a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sides {
    Both,
    OneOrNone,
}

/// Each pair of neighbours once, in order of the older, then the younger vertex. It has a face on one side if some face
/// walks it from the older to the younger, on the other if some face walks it back.
///
/// Collects what rings and faces say of each pair, sorted into one bucket for each older vertex: linear, but for the
/// sorting of large buckets.
fn for_each_edge(
    mesh: &Mesh,
    faces: &Faces,
    stop: &Stop,
    mut edge: impl FnMut(Vertex, Vertex, Sides),
) -> Result<(), Stopped> {
    const THERE: u64 = 1;
    const BACK: u64 = 2;
    const FLAGS: u32 = 2; // bits below the younger vertex
    let n = mesh.vertex_count();
    let each = |found: &mut dyn FnMut(Vertex, Vertex, u64)| -> Result<(), Stopped> {
        let mut pair = |p: Vertex, q: Vertex, walked| match (p < q, walked) {
            _ if p == q || p.index().max(q.index()) >= n => {}
            (true, false) => found(p, q, 0),
            (false, false) => found(q, p, 0),
            (true, true) => found(p, q, THERE),
            (false, true) => found(q, p, BACK),
        };
        for p in mesh.vertices() {
            stop.check()?;
            mesh.ring(p).vertices().for_each(|q| pair(p, q, false));
        }
        for face in faces.iter().filter(|f| f.len() > 2) {
            stop.check()?;
            let mut before = face[face.len() - 1];
            for &v in face {
                pair(before, v, true);
                before = v;
            }
        }
        Ok(())
    };
    let mut ends = vec![0usize; n];
    each(&mut |older, _, _| ends[older.index()] += 1)?;
    let mut sum = 0;
    for end in &mut ends {
        sum += std::mem::replace(end, sum); // where the bucket starts; moves on to its end as it is filled
    }
    let mut entries = vec![0u64; sum];
    each(&mut |older, younger, flags| {
        let end = &mut ends[older.index()];
        entries[*end] = ((younger.index() as u64) << FLAGS) | flags;
        *end += 1;
    })?;
    let mut start = 0;
    for (p, &end) in mesh.vertices().zip(&ends) {
        stop.check()?;
        let bucket = &mut entries[start..end];
        bucket.sort_unstable();
        for same in bucket.chunk_by(|a, b| a >> FLAGS == b >> FLAGS) {
            let flags = same.iter().fold(0, |flags, entry| flags | (entry & (THERE | BACK)));
            if let Some(q) = Vertex::from_index((same[0] >> FLAGS) as usize) {
                edge(p, q, if flags == THERE | BACK { Sides::Both } else { Sides::OneOrNone });
            }
        }
        start = end;
    }
    Ok(())
}

/// Adds a polygon's normal to its corners, weighted by `sin α / (|a| |b|)`, where `a` and `b` are the sides that meet
/// at the corner and α is the angle between them. With these weights normals are exact on a sphere, however its faces
/// are shaped (N. Max, "Weights for computing vertex normals from facet normals", 1999).
fn add_corner_normals(points: &[DVec3], ends: &[u32], normal: DVec3, normals: &mut [DVec3]) {
    let n = points.len();
    for i in 0..n {
        let p = points[i];
        let (a, b) = (points[if i == 0 { n - 1 } else { i - 1 }] - p, points[if i + 1 == n { 0 } else { i + 1 }] - p);
        let weight = a.cross(b).length() / (a.length_squared() * b.length_squared());
        if weight.is_finite() {
            normals[ends[i] as usize] += weight * normal;
        }
    }
}

/// Packs a unit vector into two signed 16-bit numbers: the octahedron around the unit ball, unfolded onto a square.
/// Never gives the zero word.
#[must_use]
pub fn pack(n: Vec3) -> u32 {
    let n = n / n.abs().element_sum().max(f32::MIN_POSITIVE);
    let square = if n.z >= 0.0 { Vec2::new(n.x, n.y) } else { (1.0 - Vec2::new(n.y, n.x).abs()) * sign(n.truncate()) };
    let [x, y] = square.to_array().map(|c| (c.clamp(-1.0, 1.0) * 32767.0).round() as i16);
    match (u32::from(y.cast_unsigned()) << 16) | u32::from(x.cast_unsigned()) {
        0 => 1,
        word => word,
    }
}

/// Packs red, green and blue from 0 to 1 (sRGB) into bytes, red lowest. What is no number is 0.
#[must_use]
pub fn pack_color(color: DVec3) -> u32 {
    let [r, g, b] = color.to_array().map(|c| (c * 255.0).round() as u8);
    u32::from_le_bytes([r, g, b, u8::MAX])
}

fn sign(v: Vec2) -> Vec2 {
    Vec2::select(v.cmpge(Vec2::ZERO), Vec2::ONE, Vec2::NEG_ONE)
}

/// Meshes are limited to `u32` handles, so this loses nothing.
fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(NONE)
}
