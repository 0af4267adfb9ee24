//! One mesh in arrays.

mod edges;
mod normals;
mod pack;

use glam::DVec3;

use vv::io::COLOR;
use vv::mesh::faces::Faces;
use vv::mesh::triangulate::{Triangulator, newell};
use vv::mesh::{Mesh, Values, Vertex};
use vv::stop::{Stop, Stopped};

use edges::{Sides, Walked};
pub use pack::{pack, pack_color, unpack};

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
    /// The number of the face of each triangle; those of a face follow each other.
    pub triangle_faces: Vec<u32>,
    /// Which sides of each triangle are edges, not cuts through a face: bit 0 for the side from the first corner to the
    /// second, and so on.
    pub triangle_sides: Vec<u8>,
    /// Whether there are triangles of all faces.
    pub(super) all_filled: bool,
    /// The vertex of each corner.
    pub owners: Vec<Vertex>,
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
    /// The vertex at a corner.
    #[must_use]
    pub fn vertex(&self, corner: u32) -> Option<Vertex> {
        self.owners.get(corner as usize).copied()
    }

    pub(super) fn new(
        mesh: &Mesh,
        faces: &Faces,
        to_scene: &(dyn Fn(DVec3) -> Option<DVec3> + Sync),
        fill: Fill,
        stop: &Stop,
    ) -> Result<Self, Stopped> {
        let mut part = Self::default();
        let places = part.add_vertices(mesh, to_scene);
        let mut lines = Self::default();
        // What the one writes the other does not read.
        let (edges, surface) = rayon::join(
            || lines.add_edges(mesh, faces, &places, stop),
            || match fill {
                Fill::Nothing => (Ok(()), Ok(Vec::new())),
                Fill::Faces => rayon::join(
                    || part.add_faces(faces, &places, stop),
                    || normals::vertex_normals(faces, &places, stop),
                ),
            },
        );
        edges.and(surface.0)?;
        let normals = surface.1?;
        if fill == Fill::Faces {
            part.set_normals(&normals, &places);
            part.add_colors(mesh);
        }
        let Self { edges, inner_edge_count, mean_edge, longest_inner_edge, .. } = lines;
        Ok(Self { edges, inner_edge_count, mean_edge, longest_inner_edge, ..part })
    }

    /// Fills in the corners that stand for vertices; returns which stands for which vertex.
    fn add_vertices(&mut self, mesh: &Mesh, to_scene: &(dyn Fn(DVec3) -> Option<DVec3> + Sync)) -> Places {
        let mut places = Places { of: vec![NONE; mesh.vertex_count()], positions: Vec::new() };
        places.positions.reserve(mesh.vertex_count());
        self.owners.reserve(mesh.vertex_count());
        for lonely in [true, false] {
            for (v, &p) in mesh.vertices().zip(mesh.positions()) {
                if (mesh.ring(v).valence() == 0) == lonely
                    && let Some(p) = to_scene(p)
                {
                    places.of[v.index()] = index(places.positions.len());
                    places.positions.push(p);
                    self.owners.push(v);
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
        let walked = Walked::new(mesh, faces, stop)?;
        self.edges.reserve(faces.corners().len() / 2);
        walked.for_each_edge(mesh, stop, |p, q, sides| {
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

    /// Triangles, and normals of faces.
    fn add_faces(&mut self, faces: &Faces, places: &Places, stop: &Stop) -> Result<(), Stopped> {
        self.corners.reserve(faces.len().saturating_sub(self.corners.len()));
        let triangles = faces.corners().len().saturating_sub(2 * faces.len());
        self.triangles.reserve(triangles);
        self.triangle_faces.reserve(triangles);
        self.triangle_sides.reserve(triangles);
        let mut filling = Filling { speaks: vec![false; self.corners.len()], extra: Vec::new(), part: self };
        let mut polygon = Polygon::default();
        let mut filled = 0;
        for (number, face) in (0..).zip(faces.iter()) {
            stop.check()?;
            match *face {
                [] | [_] | [_, _] => filled += 1,
                [a, b, c] => {
                    if let (Some(a), Some(b), Some(c)) = (places.get(a), places.get(b), places.get(c)) {
                        filling.add_triangle(number, [a, b, c], places);
                        filled += 1;
                    }
                }
                _ => {
                    polygon.ends.clear();
                    polygon.ends.extend(face.iter().filter_map(|&v| places.get(v)));
                    if polygon.ends.len() == face.len() {
                        filling.add_polygon(number, &mut polygon, places);
                        filled += 1;
                    }
                }
            }
        }
        let extra = filling.extra;
        self.all_filled = filled == faces.len();
        let owners = extra.iter().filter_map(|&vertex| self.vertex(vertex)).collect::<Vec<_>>();
        self.owners.extend(owners);
        Ok(())
    }

    /// Gives each corner the normal of its vertex.
    fn set_normals(&mut self, normals: &[u32], places: &Places) {
        let (own, further) = self.corners.split_at_mut(normals.len());
        own.iter_mut().zip(normals).for_each(|(corner, &normal)| corner.normal = normal);
        let owners = self.owners.iter().skip(normals.len());
        for (corner, &owner) in further.iter_mut().zip(owners) {
            corner.normal = places.get(owner).map_or(0, |i| normals[i as usize]);
        }
    }

    /// Colours of the corners, if the vertices have some.
    fn add_colors(&mut self, mesh: &Mesh) {
        let column = mesh.vertex_properties().iter().find_map(|property| match &property.values {
            Values::Vec(colors) if property.name == COLOR => Some(colors),
            _ => None,
        });
        let Some(column) = column else { return };
        let color = |v: &Vertex| column.get(v.index()).map_or(0, |&color| pack_color(color));
        self.colors = self.owners.iter().map(color).collect();
    }
}

/// Faces on their way into a part.
struct Filling<'a> {
    part: &'a mut Part,
    /// Whether the corner of each vertex speaks for a face.
    speaks: Vec<bool>,
    /// The vertex of each further corner.
    extra: Vec<u32>,
}

/// What a polygon with more than three corners needs; kept from one to the next.
#[derive(Default)]
struct Polygon {
    ends: Vec<u32>,
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    speakers: Vec<u32>,
    triangulator: Triangulator,
}

impl Filling<'_> {
    fn add_triangle(&mut self, face: u32, ends: [u32; 3], places: &Places) {
        let [a, b, c] = ends.map(|i| places.positions[i as usize]);
        let area = (c - a).cross(a - b);
        let normal = pack(area.normalize_or_zero().as_vec3());
        let first = ends.iter().position(|&end| !self.speaks[end as usize]).unwrap_or(0);
        let [a, b, c] = [ends[first], ends[(first + 1) % 3], ends[(first + 2) % 3]];
        let speaker = self.speaker(a, normal);
        self.push([speaker, b, c], face, 0b111);
    }

    fn add_polygon(&mut self, face: u32, polygon: &mut Polygon, places: &Places) {
        let Polygon { ends, points, triangles, speakers, triangulator } = polygon;
        points.clear();
        points.extend(ends.iter().map(|&i| places.positions[i as usize]));
        let area = newell(points);
        triangulator.triangles(points, area, triangles);
        let normal = area.normalize_or_zero();
        let n = points.len();
        // A corner of each triangle speaks for this face: one that does already, one that speaks for none, a new one. Fans
        // need one in all.
        speakers.clear();
        speakers.resize(n, NONE);
        let packed = pack(normal.as_vec3());
        for t in triangles {
            let ready = t.iter().position(|&i| speakers[i as usize] != NONE);
            let first = ready.or_else(|| t.iter().position(|&i| !self.speaks[ends[i as usize] as usize])).unwrap_or(0);
            let [a, b, c] = [t[first], t[(first + 1) % 3], t[(first + 2) % 3]].map(|i| i as usize);
            if speakers[a] == NONE {
                speakers[a] = self.speaker(ends[a], packed);
            }
            let follows = |i: usize, j: usize| u8::from(j == if i + 1 == n { 0 } else { i + 1 });
            let sides = follows(a, b) | follows(b, c) << 1 | follows(c, a) << 2;
            self.push([speakers[a], ends[b], ends[c]], face, sides);
        }
    }

    fn push(&mut self, triangle: [u32; 3], face: u32, sides: u8) {
        self.part.triangles.push(triangle);
        self.part.triangle_faces.push(face);
        self.part.triangle_sides.push(sides);
    }

    /// A corner at a vertex that speaks for a face with this normal: its own, or a further one if that speaks already.
    fn speaker(&mut self, vertex: u32, face_normal: u32) -> u32 {
        let corners = &mut self.part.corners;
        if std::mem::replace(&mut self.speaks[vertex as usize], true) {
            self.extra.push(vertex);
            corners.push(Corner { face_normal, ..corners[vertex as usize] });
            return index(corners.len() - 1);
        }
        corners[vertex as usize].face_normal = face_normal;
        vertex
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

/// Meshes are limited to `u32` handles, so this loses nothing.
fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(NONE)
}
