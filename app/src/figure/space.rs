//! From the world into the space of the picture, and what of it is seen at all.
//!
//! The space of the picture has x to the right and y upwards, ±1 at the upper and lower edge, and z towards the eye, 0 at
//! the pivot and in the same unit there:
//!
//! ```text
//!   orthographic   x = x'/h          y = y'/h          z = (z' + d)/h
//!   perspective    x = x' d/(w h)    y = y' d/(w h)    z = (d²/w − d)/h        w = −z'
//! ```
//!
//! with view coordinates (x', y', z'), d the distance of the pivot and h half the height of what is seen there. The second
//! map is projective: lines stay lines, planes stay planes, and what is nearer on a line of sight stays nearer. So all that
//! follows may think that it looks along −z, whatever the camera.

use glam::{DQuat, DVec3};

use crate::camera::Camera;
use crate::scene::{Cut, Plane, Sphere};

/// No vertex: a point that clipping made.
pub(super) const NONE: u32 = u32::MAX;

/// A point in view coordinates and the vertex that it is, else [`NONE`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub at: DVec3,
    pub vertex: u32,
}

/// What lies before all planes is seen.
#[derive(Debug)]
pub(super) struct Space {
    turn: DQuat,
    pivot: DVec3,
    distance: f64,
    half_height: f64,
    parallel: bool,
    /// Normal, in view coordinates, and offset: seen where n · p + o ≥ 0.
    planes: Vec<(DVec3, f64)>,
    /// The last of them, if it is a cut.
    cut: Option<(DVec3, f64)>,
}

impl Space {
    /// Of a picture of this width over height; `bounds` is what the place of the cut is measured by.
    pub fn new(camera: &Camera, aspect: f64, cut: &Cut, bounds: Sphere) -> Self {
        let slope = (camera.field_of_view / 2.0).tan();
        let half_height = camera.distance * slope;
        let (x, y) = (DVec3::X, DVec3::Y);
        let mut planes = if camera.orthographic {
            vec![(x, half_height * aspect), (-x, half_height * aspect), (y, half_height), (-y, half_height)]
        } else {
            let (side, up) = (DVec3::NEG_Z * slope * aspect, DVec3::NEG_Z * slope);
            vec![(DVec3::NEG_Z, -camera.near()), (x + side, 0.0), (side - x, 0.0), (y + up, 0.0), (up - y, 0.0)]
        };
        let mut space = Self {
            turn: camera.world_from_view.conjugate(),
            pivot: camera.pivot,
            distance: camera.distance,
            half_height,
            parallel: camera.orthographic,
            planes: Vec::new(),
            cut: None,
        };
        if let Some(Plane { normal, place }) = cut.plane(bounds, camera) {
            let point = space.view(normal * place);
            let normal = space.turn * normal;
            space.cut = Some((-normal, normal.dot(point)));
            planes.extend(space.cut);
        }
        space.planes = planes;
        space
    }

    /// View coordinates.
    pub fn view(&self, world: DVec3) -> DVec3 {
        self.turn * (world - self.pivot) - DVec3::new(0.0, 0.0, self.distance)
    }

    /// The space of the picture, of what is seen.
    pub fn project(&self, view: DVec3) -> DVec3 {
        let (d, h) = (self.distance, self.half_height);
        if self.parallel {
            return DVec3::new(view.x, view.y, view.z + d) / h;
        }
        let nearness = d / -view.z;
        DVec3::new(view.x * nearness, view.y * nearness, d * nearness - d) / h
    }

    /// Where the axes of the world point.
    pub fn axes(&self) -> [DVec3; 3] {
        DVec3::AXES.map(|axis| self.turn * axis)
    }

    /// The direction to the eye from a point.
    pub fn to_eye(&self, view: DVec3) -> DVec3 {
        if self.parallel { DVec3::Z } else { -view }
    }

    /// Whether a point is seen.
    pub fn holds(&self, p: DVec3) -> bool {
        self.planes.iter().all(|&(normal, offset)| normal.dot(p) + offset >= 0.0)
    }

    /// Whether a line that clipping left lies along the cut.
    pub fn is_cut(&self, ends: [Point; 2]) -> bool {
        let made = ends.iter().any(|p| p.vertex == NONE);
        let on = |(normal, offset): (DVec3, f64)| {
            ends.iter().all(|p| (normal.dot(p.at) + offset).abs() < 1e-9 * self.half_height)
        };
        made && self.cut.is_some_and(on)
    }

    /// What is seen of a line.
    pub fn clip_line(&self, mut ends: [Point; 2]) -> Option<[Point; 2]> {
        for &(normal, offset) in &self.planes {
            let [f, g] = ends.map(|p| normal.dot(p.at) + offset);
            let between = || between(&ends[0], &ends[1], f, g);
            match (f >= 0.0, g >= 0.0) {
                (true, true) => {}
                (false, false) => return None,
                (true, false) => ends[1] = between(),
                (false, true) => ends[0] = between(),
            }
        }
        Some(ends)
    }

    /// Leaves of a convex polygon what is seen. `scratch` is memory.
    pub fn clip(&self, polygon: &mut Vec<Point>, scratch: &mut Vec<Point>) {
        for &(normal, offset) in &self.planes {
            let side = |p: &Point| normal.dot(p.at) + offset;
            if polygon.iter().all(|p| side(p) >= 0.0) {
                continue;
            }
            scratch.clear();
            for (i, p) in polygon.iter().enumerate() {
                let q = &polygon[(i + 1) % polygon.len()];
                let (f, g) = (side(p), side(q));
                if f >= 0.0 {
                    scratch.push(*p);
                }
                if (f >= 0.0) != (g >= 0.0) {
                    scratch.push(between(p, q, f, g));
                }
            }
            std::mem::swap(polygon, scratch);
        }
    }
}

/// Where the line between two points on different sides meets the plane; the same from either end.
fn between(p: &Point, q: &Point, f: f64, g: f64) -> Point {
    let at = if f < g { q.at + (p.at - q.at) * (g / (g - f)) } else { p.at + (q.at - p.at) * (f / (f - g)) };
    Point { at, vertex: NONE }
}
