//! Which parts of edges are hidden, exactly.
//!
//! A point is hidden by a triangle if it lies inside the three planes through the sides along the lines of sight, and
//! beyond the plane of the triangle. All four distances are linear along an edge, so a triangle hides one interval of it,
//! and what is seen is the edge without the union of these. Where an edge pierces a face its interval ends there.
//!
//! *Rounding.* Coordinates are about 1, so distances are right to some 10⁻¹⁵ times the distance over the size of the
//! triangle. [`SLACK`], a ten-millionth of half the picture's height, lies far above that and above the rounding of files
//! in single precision, and far below what print can show. A triangle hides what lies farther behind its plane than that,
//! and as far outside its sides: what lies exactly behind an outline is hidden, what lies in a face is seen. Triangles that
//! are seen edge-on hide nothing. A triangle that has the edge as a side hides none of it; one that meets it in a vertex
//! has distances of exactly zero there, so no sliver at the vertex comes out wrong.

use glam::{DVec2, DVec3, Vec3Swizzles};
use rayon::prelude::*;

use super::boxes::Boxes;
use super::space::NONE;
use super::surface::{Edge, Triangle};

/// How far something must be off to be on the other side.
pub(super) const SLACK: f64 = 1e-7;

/// Hides what is behind.
#[derive(Debug)]
pub(super) struct Hider {
    shields: Vec<Shield>,
    pub boxes: Boxes,
}

/// A triangle with its planes.
#[derive(Debug)]
struct Shield {
    vertices: [u32; 3],
    whole: [u32; 3],
    /// A corner, and the normal towards the eye.
    corner: DVec3,
    normal: DVec3,
    /// For each side its inner normal in the picture, and its place.
    sides: [(DVec2, f64); 3],
}

/// Part of an edge, from 0 at its first end to 1.
pub(super) type Interval = (f64, f64);

impl Hider {
    pub fn new(triangles: &[Triangle]) -> Self {
        let shields: Vec<_> = triangles.par_iter().filter_map(|t| Some((Shield::new(t)?, t.corners))).collect();
        let (shields, corners): (Vec<_>, Vec<_>) = shields.into_iter().unzip();
        Self { shields, boxes: Boxes::new(&corners) }
    }

    /// What of the edge is hidden: intervals in order, apart from each other.
    pub fn hidden(&self, edge: &Edge) -> Vec<Interval> {
        let mut intervals = Vec::new();
        let [a, b] = edge.ends;
        self.boxes.before_line(a, b, |index| {
            let interval = self.shields[index as usize].hides(edge);
            intervals.extend(interval);
            interval != Some((0.0, 1.0))
        });
        union(intervals)
    }

    /// Whether a vertex is hidden.
    pub fn hides_vertex(&self, vertex: u32, at: DVec3) -> bool {
        let edge = Edge { ends: [at; 2], vertices: [vertex; 2], whole: [vertex; 2], class: super::Class::Inner };
        let mut hidden = false;
        self.boxes.before_line(at, at, |index| {
            hidden = self.shields[index as usize].hides(&edge).is_some();
            !hidden
        });
        hidden
    }
}

impl Shield {
    /// `None` if it is seen edge-on.
    fn new(triangle: &Triangle) -> Option<Self> {
        let [a, b, c] = triangle.corners;
        let normal = (b - a).cross(c - a);
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        if normal.z.abs() <= 1e-12 * longest.max(1e-3) || normal.z.abs() <= 1e-9 * normal.length() {
            return None;
        }
        let turn = normal.z.signum();
        let side = |p: DVec3, q: DVec3| {
            let inner = (q - p).xy().perp().normalize_or_zero() * turn;
            (inner, inner.dot(p.xy()))
        };
        Some(Self {
            vertices: triangle.vertices,
            whole: triangle.whole,
            corner: a,
            normal: normal.normalize() * turn,
            sides: [side(a, b), side(b, c), side(c, a)],
        })
    }

    fn hides(&self, edge: &Edge) -> Option<Interval> {
        if edge.whole.iter().all(|v| *v != NONE && self.whole.contains(v)) {
            return None;
        }
        let [a, b] = edge.ends;
        let [at_a, at_b] = edge.vertices.map(|v| self.vertices.iter().position(|&w| w == v && v != NONE));
        let mut interval = (0.0, 1.0);
        for (i, &(inner, place)) in self.sides.iter().enumerate() {
            let inside = |p: DVec3, corner: Option<usize>| {
                let on_side = corner.is_some_and(|c| c == i || c == (i + 1) % 3);
                if on_side { 0.0 } else { inner.dot(p.xy()) - place }
            };
            interval = positive(interval, inside(a, at_a) + SLACK, inside(b, at_b) + SLACK)?;
        }
        let behind = |p: DVec3| self.normal.dot(self.corner - p) - SLACK;
        match (at_a, at_b) {
            (None, None) => positive(interval, behind(a), behind(b)),
            (Some(_), None) => (behind(b) > 0.0).then_some(interval),
            (None, Some(_)) => (behind(a) > 0.0).then_some(interval),
            (Some(_), Some(_)) => None,
        }
    }
}

/// The part of an interval where what is `f` at 0 and `g` at 1 is positive.
fn positive((low, high): Interval, f: f64, g: f64) -> Option<Interval> {
    let (low, high) = match (f > 0.0, g > 0.0) {
        (true, true) => (low, high),
        (false, false) => return None,
        (true, false) => (low, high.min(f / (f - g))),
        (false, true) => (low.max(f / (f - g)), high),
    };
    (low < high).then_some((low, high))
}

/// Intervals in order, those that meet made one.
fn union(mut intervals: Vec<Interval>) -> Vec<Interval> {
    intervals.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut merged: Vec<Interval> = Vec::new();
    for (low, high) in intervals {
        match merged.last_mut() {
            Some(last) if low <= last.1 + 1e-12 => last.1 = last.1.max(high),
            _ => merged.push((low, high)),
        }
    }
    merged
}

/// What is left of 0 to 1.
pub(super) fn rest(intervals: &[Interval]) -> Vec<Interval> {
    let lows = std::iter::once(0.0).chain(intervals.iter().map(|i| i.1));
    let highs = intervals.iter().map(|i| i.0).chain(std::iter::once(1.0));
    lows.zip(highs).filter(|(low, high)| low < high).collect()
}
