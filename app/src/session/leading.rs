//! A mesh that grows out of the picture takes the camera with it.
//!
//! Who saw all of the mesh before a step wants to see all of it afterwards; who has come nearer is left where he is. Going
//! back leads the camera back, too.

use super::Session;
use crate::camera::Camera;
use crate::render::Size;
use crate::scene::Style;
use crate::worker::Frame;

/// Where the camera was led.
#[derive(Default)]
pub(super) struct Leading {
    /// The mesh that was shown before was seen whole; the one that is shown now is not looked at yet.
    due: Option<Change>,
    /// Where it was before it was led away, the first place first.
    from: Vec<Camera>,
    /// Where it was led last. Elsewhere somebody has put it.
    to: Option<Camera>,
}

/// What came after what was shown.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Change {
    Step,
    /// An earlier generation, or what another text or other parameters make.
    Other,
}

impl Leading {
    /// Whether the camera is where it was led. Who turns it to see another side, or in another projection, has put it
    /// nowhere else.
    fn is_at(&self, camera: &Camera) -> bool {
        self.to.is_some_and(|to| as_seen(&to, camera) == *camera)
    }

    /// The camera goes from one place to another to show as much from another side or in another projection.
    pub(super) fn turn(&mut self, from: &Camera, to: Camera) {
        if self.is_at(from) {
            self.to = Some(to);
        }
    }
}

/// The camera at its place as another looks: from the same side, in the same projection.
fn as_seen(camera: &Camera, like: &Camera) -> Camera {
    Camera { world_from_view: like.world_from_view, orthographic: like.orthographic, ..*camera }
}

impl Session {
    /// To be called before another frame is shown.
    pub(super) fn remember_sight(&mut self, next: &Frame) {
        if self.fit {
            self.leading = Leading::default();
            return;
        }
        let (Some((size, style)), Some(frame)) = (self.view, &self.frame) else { return };
        let (now, then) = (&frame.request, &next.request);
        let steps = now.recipe == then.recipe && then.generation > now.generation;
        let change = if steps { Change::Step } else { Change::Other };
        let scene = &frame.scene;
        let is_whole =
            frame.mesh.vertex_count() > 0 && scene.fits_at_once() && scene.is_whole(&self.aim(), &style, size.aspect());
        // What came too fast to be looked at was not seen; what was turned out of the picture was not left on purpose.
        if is_whole || self.leading.due.is_some() || self.leading.is_at(&self.aim()) {
            self.leading.due = Some(change);
        }
    }

    /// Where the camera shall go, if the mesh has left the picture, `below` of whose height is covered at the lower edge, or
    /// has come back.
    pub fn lead(&mut self, size: Size, style: &Style, below: f64) -> Option<Camera> {
        let change = self.leading.due?;
        let scene = &self.frame.as_ref().filter(|frame| frame.scene.fits_at_once())?.scene;
        let (aim, aspect) = (self.aim(), size.aspect());
        let shows = |camera: &Camera| scene.is_whole(camera, style, aspect);
        let is_whole = shows(&aim);
        let leading = &mut self.leading;
        leading.due = None;
        if !leading.is_at(&aim) {
            leading.from.clear();
        }
        let to = if is_whole {
            let back = leading.from.iter().position(|way| shows(&as_seen(way, &aim)));
            let back = back.filter(|_| change == Change::Other)?;
            as_seen(&leading.from.drain(back..).next()?, &aim)
        } else {
            leading.from.push(aim);
            // Never nearer: what has only gone aside is followed there.
            let fitted = aim.fit_above(below, aspect, |camera, aspect| scene.fit(camera, style, aspect));
            Camera { distance: fitted.distance.max(aim.distance), ..fitted }
        };
        leading.to = Some(to);
        Some(to)
    }
}
