//! Whether a camera sees a scene.

use glam::Vec3;

use super::{Plane, Scene, Style};
use crate::camera::Camera;

impl Scene {
    /// Whether all that `style` shows lies in a picture of this width over height, nothing being there included. Cost:
    /// linear in the vertices unless [`Scene::is_indexed`].
    #[must_use]
    pub fn is_whole(&self, camera: &Camera, style: &Style, aspect: f64) -> bool {
        let parts = &[&self.mesh, &self.control][..if style.control { 2 } else { 1 }];
        let sides = camera.sides(aspect);
        if let Some(indices) = self.index.get() {
            let mut seen = parts.iter().zip(indices.iter()).flat_map(|(part, index)| {
                sides.iter().filter_map(|side| Some((side, index.farthest(part, side.normal)?)))
            });
            return seen.all(|(side, p)| side.beyond(self.to_world(p)) <= 0.0);
        }
        let mut corners = parts.iter().flat_map(|part| &part.corners[..part.vertex_count as usize]);
        corners.all(|corner| {
            let p = self.to_world(Vec3::from(corner.position));
            sides.iter().all(|side| side.beyond(p) <= 0.0)
        })
    }

    /// Whether nothing of what `style` shows lies in the picture, as all of the mesh is beyond one of its sides, and all of
    /// the control mesh beyond one. Until [`Scene::is_indexed`] this tells only of balls around them.
    #[must_use]
    pub fn is_out_of_sight(&self, camera: &Camera, style: &Style, aspect: f64) -> bool {
        let sides = camera.sides(aspect);
        let Some(indices) = self.index.get() else {
            let ball = self.bounds(style);
            return sides.iter().any(|side| side.beyond(ball.center) > ball.radius);
        };
        let parts = &[&self.mesh, &self.control][..if style.control { 2 } else { 1 }];
        parts.iter().zip(indices.iter()).all(|(part, index)| {
            let beyond = |side: &Plane| {
                let nearest = index.farthest(part, -side.normal);
                nearest.is_none_or(|p| side.beyond(self.to_world(p)) > 0.0)
            };
            sides.iter().any(beyond)
        })
    }
}
