//! Whether a camera sees a scene.

use glam::Vec3;

use super::{Scene, Style};
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

    /// Whether nothing of what `style` shows can lie in the picture: the ball around it is beyond one of its sides.
    #[must_use]
    pub fn is_out_of_sight(&self, camera: &Camera, style: &Style, aspect: f64) -> bool {
        let ball = self.bounds(style);
        camera.sides(aspect).iter().any(|side| side.beyond(ball.center) > ball.radius)
    }
}
