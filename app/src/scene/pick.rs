//! What lies under the pointer: found on the window's thread, in time that hardly grows with the mesh.

#[cfg(test)]
mod tests;

use glam::{DVec3, Vec3};
use vv::mesh::Vertex;

use super::tree::{Bounds, Tree};
use super::{Part, Plane, Scene};
use crate::camera::Ray;

/// A ray from the eye that has some width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pointer {
    /// From the eye through the pointer.
    pub ray: Ray,
    /// What is *near* the ray: up to this far from it, for each unit of length from the eye. See
    /// [`crate::camera::Camera::spread`].
    pub spread: f64,
    /// Whether faces hide what is behind them.
    pub opaque: bool,
    /// What is cut away, and so neither meant nor hides anything; in world units.
    pub cut: Option<Plane>,
}

/// What lies under the pointer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Picked {
    /// The point: on the face, else on the nearest vertex, else on the nearest edge. In world units.
    pub point: DVec3,
    /// The face that the ray meets first: its number in [`vv::mesh::faces::Faces`].
    pub face: Option<usize>,
    /// The edge nearest to the ray, the older end first: one that is near and not hidden, else one of the face.
    pub edge: Option<Near<[Vertex; 2]>>,
    /// The vertex nearest to the ray: one that is near and not hidden, else one of the face.
    pub vertex: Option<Near<Vertex>>,
}

/// Something beside the ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Near<T> {
    /// What it is.
    pub what: T,
    /// Its distance from the ray over what counts as near: up to 1 if it is near.
    pub distance: f64,
    /// Its point that is nearest to the ray, in world units.
    pub point: DVec3,
}

/// Finds things of a part by where they are: its triangles, then the edges that are sides of none, then the vertices
/// without edges.
#[derive(Debug, Default)]
pub(super) struct Index {
    tree: Tree,
}

impl Index {
    /// Cost: sorting the triangles, on all threads.
    pub fn new(part: &Part) -> Self {
        let count = part.triangles.len() + loose_edges(part).len() + part.lonely_count as usize;
        Self {
            tree: Tree::new(count, |thing| {
                ends(part, thing).iter().fold(Bounds::NOTHING, |b, &i| b.with(place(part, i)))
            }),
        }
    }

    /// The point of the part that lies farthest in a direction.
    pub fn farthest(&self, part: &Part, direction: DVec3) -> Option<Vec3> {
        let mut best: Option<(f64, Vec3)> = None;
        self.tree.farthest(direction, |thing| {
            let mut most = f64::NEG_INFINITY;
            for p in ends(part, thing).map(|i| place(part, i)) {
                let reach = p.as_dvec3().dot(direction);
                most = most.max(reach);
                if best.is_none_or(|(b, _)| reach > b) {
                    best = Some((reach, p));
                }
            }
            most
        });
        best.map(|(_, p)| p)
    }
}

/// The corners of a thing; an edge repeats one, a vertex has it three times.
fn ends(part: &Part, thing: usize) -> [u32; 3] {
    if let Some(&triangle) = part.triangles.get(thing) {
        return triangle;
    }
    let thing = thing - part.triangles.len();
    let edges = loose_edges(part);
    match edges.get(thing) {
        Some(&[a, b]) => [a, b, b],
        None => [(thing - edges.len()) as u32; 3],
    }
}

/// The edges that are perhaps no side of a triangle.
fn loose_edges(part: &Part) -> &[[u32; 2]] {
    let sides = if part.all_filled { part.inner_edge_count as usize } else { 0 };
    part.edges.get(sides..).unwrap_or(&[])
}

fn place(part: &Part, corner: u32) -> Vec3 {
    part.corners.get(corner as usize).map_or(Vec3::ZERO, |c| c.position.into())
}

impl Scene {
    /// What lies under the pointer of the mesh, nothing if neither a face nor anything near does. The control mesh is
    /// never meant. [`None`] too while [`Scene::is_indexed`] is not true yet.
    #[must_use]
    pub fn pick(&self, pointer: &Pointer) -> Option<Picked> {
        let [index, _] = &**self.index.get()?;
        let part = &self.mesh;
        // In scene units, where the tree lives.
        let ray = Ray { origin: (pointer.ray.origin - self.origin) / self.unit, ..pointer.ray };
        let cut = pointer.cut.map(|cut| cut.in_scene(self));
        let hit = first_hit(index, part, ray, kept(cut, ray));
        let mut search = Search { part, ray, cut, spread: pointer.spread, edge: None, vertex: None };
        if let Some((_, triangle)) = hit {
            search.look_at_face(triangle);
        }
        let limit = hit.filter(|_| pointer.opaque).map_or(f64::INFINITY, |(t, _)| t);
        let inverse = ray.direction.recip();
        let near = |b: Bounds| {
            let (low, high) = (b.low.as_dvec3(), b.high.as_dvec3());
            let farthest = (low - ray.origin).abs().max((high - ray.origin).abs()).length();
            b.entry(ray.origin, inverse, pointer.spread * farthest).filter(|&t| t - pointer.spread * farthest <= limit)
        };
        index.tree.along(near, |thing| {
            search.look_at(thing, limit);
            f64::INFINITY
        });
        let Search { edge, vertex, .. } = search;
        let world = |p: DVec3| self.origin + self.unit * p;
        let point = match (hit, vertex, edge) {
            (Some((t, _)), ..) => ray.origin + t * ray.direction,
            (None, Some((_, near)), _) => near.point,
            (None, None, Some((_, near))) => near.point,
            (None, None, None) => return None,
        };
        let outside = |near: Near<DVec3>| world(near.point);
        Some(Picked {
            point: world(point),
            face: hit.and_then(|(_, t)| part.triangle_faces.get(t)).map(|&face| face as usize),
            edge: edge.and_then(|([a, b], near)| {
                let (a, b) = (part.vertex(a)?, part.vertex(b)?);
                Some(Near { what: [a.min(b), a.max(b)], distance: near.distance, point: outside(near) })
            }),
            vertex: vertex.and_then(|(a, near)| {
                Some(Near { what: part.vertex(a)?, distance: near.distance, point: outside(near) })
            }),
        })
    }
}

impl Scene {
    /// Whether faces of the mesh lie before a point that is seen along a ray, by more than `slack` world units: what is
    /// nearer is the surface that it lies on. No while [`Scene::is_indexed`] is not true yet.
    #[must_use]
    pub fn hides(&self, sight: Ray, cut: Option<Plane>, point: DVec3, slack: f64) -> bool {
        let Some(indices) = self.index.get() else { return false };
        let ray = Ray { origin: (sight.origin - self.origin) / self.unit, ..sight };
        let distance = ((point - self.origin) / self.unit - ray.origin).dot(ray.direction);
        first_hit(&indices[0], &self.mesh, ray, kept(cut.map(|cut| cut.in_scene(self)), ray))
            .is_some_and(|(t, _)| t < distance - slack / self.unit)
    }
}

/// How far along a ray what is not cut away begins and ends.
fn kept(cut: Option<Plane>, ray: Ray) -> [f64; 2] {
    cut.map_or([0.0, f64::INFINITY], |cut| cut.kept(ray))
}

/// The triangle that a ray meets first between `begin` and `end`, and how far along.
fn first_hit(index: &Index, part: &Part, ray: Ray, [begin, end]: [f64; 2]) -> Option<(f64, usize)> {
    let mut first: Option<(f64, usize)> = None;
    let inverse = ray.direction.recip();
    index.tree.along(
        |bounds| bounds.entry(ray.origin, inverse, 0.0),
        |thing| {
            if let Some(&triangle) = part.triangles.get(thing)
                && let Some(t) = meet(ray, triangle.map(|i| place(part, i).as_dvec3()))
                && (begin..=end).contains(&t)
                && first.is_none_or(|(best, old)| (t, thing) < (best, old))
            {
                first = Some((t, thing));
            }
            first.map_or(f64::INFINITY, |(t, _)| t)
        },
    );
    first
}

/// How far along a ray meets a triangle, from either side. Möller and Trumbore, "Fast, minimum storage ray–triangle
/// intersection", 1997.
fn meet(ray: Ray, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let p = ray.direction.cross(ac);
    let determinant = ab.dot(p);
    let from = ray.origin - a;
    let u = from.dot(p) / determinant;
    let q = from.cross(ab);
    let v = ray.direction.dot(q) / determinant;
    let t = ac.dot(q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

/// Edges and vertices beside a ray: the nearest so far, by their corners.
struct Search<'a> {
    part: &'a Part,
    ray: Ray,
    cut: Option<Plane>,
    spread: f64,
    edge: Option<([u32; 2], Near<DVec3>)>,
    vertex: Option<(u32, Near<DVec3>)>,
}

impl Search<'_> {
    /// All vertices and edges of the face of a triangle.
    fn look_at_face(&mut self, triangle: usize) {
        let faces = &self.part.triangle_faces;
        let Some(face) = faces.get(triangle) else { return };
        let start = faces[..triangle].iter().rposition(|f| f != face).map_or(0, |i| i + 1);
        let len = faces[start..].iter().take_while(|&f| f == face).count();
        for t in start..start + len {
            self.look(t, f64::INFINITY, f64::INFINITY);
        }
    }

    /// What is near of a thing, up to the distance `limit` from the eye.
    fn look_at(&mut self, thing: usize, limit: f64) {
        self.look(thing, 1.0, limit);
    }

    fn look(&mut self, thing: usize, most: f64, limit: f64) {
        let corners = ends(self.part, thing);
        let points = corners.map(|i| place(self.part, i).as_dvec3());
        for (i, &corner) in corners.iter().enumerate() {
            let near = self.beside(points[i]);
            if near.distance <= most && self.depth(near.point) <= limit && closer(near, self.vertex.map(|(_, n)| n)) {
                self.vertex = Some((corner, near));
            }
        }
        let sides = match self.part.triangle_sides.get(thing) {
            Some(&sides) => sides,
            None if corners[0] != corners[1] => 1,
            None => 0,
        };
        for i in (0..3).filter(|i| sides >> i & 1 == 1) {
            let next = (i + 1) % 3;
            let near = self.beside(nearest_on_segment(self.ray, points[i], points[next]));
            if near.distance <= most && self.depth(near.point) <= limit && closer(near, self.edge.map(|(_, n)| n)) {
                self.edge = Some(([corners[i], corners[next]], near));
            }
        }
    }

    fn depth(&self, p: DVec3) -> f64 {
        (p - self.ray.origin).dot(self.ray.direction)
    }

    fn beside(&self, p: DVec3) -> Near<DVec3> {
        if self.cut.is_some_and(|cut| cut.beyond(p) > 0.0) {
            return Near { what: p, distance: f64::INFINITY, point: p }; // it is not there
        }
        let depth = self.depth(p);
        let aside = p.distance(self.ray.origin + depth * self.ray.direction);
        // What is behind the eye is infinitely far.
        let distance = if depth > 0.0 { aside / (self.spread * depth) } else { f64::INFINITY };
        Near { what: p, distance, point: p }
    }
}

/// Whether something is nearer than what there was; of what is seen at the same place, what is nearer to the eye is not
/// looked for: the first one found stays.
fn closer(near: Near<DVec3>, than: Option<Near<DVec3>>) -> bool {
    near.distance < f64::INFINITY && than.is_none_or(|than| near.distance < than.distance)
}

/// The point of a segment that is nearest to a ray.
fn nearest_on_segment(ray: Ray, a: DVec3, b: DVec3) -> DVec3 {
    let (along, from) = (b - a, a - ray.origin);
    let (uu, uv) = (along.length_squared(), along.dot(ray.direction));
    // Where the two lines are closest; a segment that points at the eye is seen at its nearer end.
    let across = uu - uv * uv;
    let s = (uv * from.dot(ray.direction) - along.dot(from)) / across;
    if s.is_nan() { a } else { a + s.clamp(0.0, 1.0) * along }
}
