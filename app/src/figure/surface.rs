//! The triangles and edges of a scene in the space of the picture.

use glam::DVec3;

use vv::io::SHARPNESS;
use vv::mesh::{Mesh, Value};

use super::Class;
use super::space::{NONE, Point, Space};
use crate::scene::{Part, Scene};

/// A triangle, or a piece of one that clipping left.
#[derive(Debug, Clone, Copy)]
pub(super) struct Triangle {
    pub corners: [DVec3; 3],
    /// The vertices at its corners; [`NONE`] where it was clipped.
    pub vertices: [u32; 3],
    /// The vertices of the whole triangle.
    pub whole: [u32; 3],
    /// Which triangle of the scene.
    pub number: u32,
}

/// What is seen of an edge if nothing is before it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub ends: [DVec3; 2],
    /// The vertices at its ends; [`NONE`] where it was clipped.
    pub vertices: [u32; 2],
    /// The vertices of the whole edge.
    pub whole: [u32; 2],
    pub class: Class,
}

/// Everything, clipped.
#[derive(Debug, Default)]
pub(super) struct Surface {
    pub triangles: Vec<Triangle>,
    pub edges: Vec<Edge>,
    /// For each triangle of the scene whether its outer side is seen.
    pub fronts: Vec<bool>,
    /// The vertices that lie inside the picture.
    pub vertices: Vec<(u32, DVec3)>,
    /// All vertices in view coordinates.
    pub points: Vec<DVec3>,
    /// Which of them each vertex of the mesh is; [`NONE`] for those left out.
    pub corner_of: Vec<u32>,
}

impl Surface {
    pub fn new(scene: &Scene, mesh: &Mesh, space: &Space, with_control: bool) -> Self {
        let part = &scene.mesh;
        // Scenes are rounded to single precision; meshes are not.
        let vertices = &part.owners[..part.vertex_count as usize];
        let points: Vec<DVec3> = vertices.iter().map(|&v| space.view(mesh.position(v))).collect();
        let mut surface = Self::default();
        let mut corner_of = vec![NONE; mesh.vertex_count()];
        for (corner, v) in (0..).zip(vertices) {
            corner_of[v.index()] = corner;
        }
        let wholes: Vec<[u32; 3]> =
            part.triangles.iter().map(|t| t.map(|c| part.vertex(c).map_or(NONE, |v| corner_of[v.index()]))).collect();
        surface.add_triangles(&wholes, &points, space);
        surface.add_edges(part, mesh, &wholes, &points, space);
        if with_control {
            surface.add_control(scene, space);
        }
        let inside = (0..).zip(&points).filter(|(_, p)| space.holds(**p));
        surface.vertices = inside.map(|(v, p)| (v, space.project(*p))).collect();
        Self { points, corner_of, ..surface }
    }

    fn add_triangles(&mut self, wholes: &[[u32; 3]], points: &[DVec3], space: &Space) {
        let (mut polygon, mut scratch) = (Vec::new(), Vec::new());
        for (number, &whole) in (0..).zip(wholes) {
            let [a, b, c] = whole.map(|v| points[v as usize]);
            self.fronts.push((b - a).cross(c - a).dot(space.to_eye(a)) > 0.0);
            polygon.clear();
            polygon.extend(whole.map(|vertex| Point { at: points[vertex as usize], vertex }));
            space.clip(&mut polygon, &mut scratch);
            for (i, &p) in polygon.iter().enumerate() {
                let ends = [p, polygon[(i + 1) % polygon.len()]];
                if space.is_cut(ends) {
                    let ends = ends.map(|p| space.project(p.at));
                    self.edges.push(Edge { ends, vertices: [NONE; 2], whole: [NONE; 2], class: Class::Boundary });
                }
            }
            for i in 2..polygon.len() {
                let piece = [polygon[0], polygon[i - 1], polygon[i]];
                let (corners, vertices) = (piece.map(|p| space.project(p.at)), piece.map(|p| p.vertex));
                self.triangles.push(Triangle { corners, vertices, whole, number });
            }
        }
    }

    fn add_edges(&mut self, part: &Part, mesh: &Mesh, wholes: &[[u32; 3]], points: &[DVec3], space: &Space) {
        // The sides of triangles, those of the same edge together.
        let mut sides: Vec<([u32; 2], bool, bool)> = Vec::with_capacity(3 * wholes.len());
        for ((whole, &drawn), &front) in wholes.iter().zip(&part.triangle_sides).zip(&self.fronts) {
            for i in 0..3 {
                sides.push((ordered([whole[i], whole[(i + 1) % 3]]), drawn & (1 << i) == 0, front));
            }
        }
        sides.sort_unstable();
        let is_outline = |ends: [u32; 2]| {
            let from = sides.partition_point(|side| side.0 < ends);
            let around = sides[from..].iter().take_while(|side| side.0 == ends && !side.1);
            let mut fronts = around.map(|side| side.2);
            let first = fronts.next();
            fronts.any(|front| Some(front) != first)
        };
        let sharpness = mesh.edge_properties().iter().position(|property| property.name == SHARPNESS);
        let is_crease = |ends: [u32; 2]| {
            let [Some(p), Some(q)] = ends.map(|end| part.vertex(end)) else { return false };
            match sharpness.and_then(|s| mesh.edge_value(s, p, q)) {
                Some(Value::Double(x)) => x > 0.0,
                Some(Value::Int(x)) => x > 0,
                _ => false,
            }
        };
        for (number, &ends) in (0..).zip(&part.edges) {
            let ends = ordered(ends);
            let class = if is_crease(ends) {
                Class::Crease
            } else if number >= part.inner_edge_count {
                Class::Boundary
            } else if is_outline(ends) {
                Class::Outline
            } else {
                Class::Inner
            };
            self.add_edge(ends, points, class, space);
        }
        // A face that is not flat may have an outline inside.
        for pair in sides.windows(2) {
            if pair[0].0 == pair[1].0 && pair[0].1 && pair[0].2 != pair[1].2 {
                self.add_edge(pair[0].0, points, Class::Outline, space);
            }
        }
    }

    fn add_control(&mut self, scene: &Scene, space: &Space) {
        let control = &scene.control;
        let corners = &control.corners[..control.vertex_count as usize];
        let points: Vec<DVec3> = corners.iter().map(|c| space.view(scene.to_world(c.position.into()))).collect();
        let first = self.edges.len();
        for &ends in &control.edges {
            self.add_edge(ends, &points, Class::Control, space);
        }
        // These are vertices of another mesh.
        for edge in &mut self.edges[first..] {
            (edge.vertices, edge.whole) = ([NONE; 2], [NONE; 2]);
        }
    }

    fn add_edge(&mut self, whole: [u32; 2], points: &[DVec3], class: Class, space: &Space) {
        let ends = whole.map(|vertex| Point { at: points[vertex as usize], vertex });
        let Some(ends) = space.clip_line(ends) else { return };
        let vertices = ends.map(|p| p.vertex);
        self.edges.push(Edge { ends: ends.map(|p| space.project(p.at)), vertices, whole, class });
    }
}

fn ordered([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
