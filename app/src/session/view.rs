//! Where the camera is, and how it comes to another place.

use std::time::{Duration, Instant};

use glam::{DQuat, DVec2};
use vv::diagnostic::Severity;

use super::Session;
use crate::camera::{Camera, Up};
use crate::command::{Toward, ViewAction};
use crate::navigation::{Navigation, Turning};
use crate::viewpoint::{self, Viewpoint};

/// How long the camera glides.
const GLIDE: Duration = Duration::from_millis(180);
/// Pictures follow each other this fast meanwhile.
const FRAME: Duration = Duration::from_millis(8);
/// What was asked for from the clipboard comes in this time, or there is nothing.
const CLIPBOARD: Duration = Duration::from_millis(800);

/// By how much a key turns, in radians.
const TURN: f64 = std::f64::consts::PI / 12.0;
/// By how much a key shifts, in halves of the picture's height.
const SHIFT: f64 = 0.2;
/// By how much a key zooms.
const ZOOM: f64 = 1.25;

/// The camera on its way.
#[derive(Clone)]
pub(super) struct Flight {
    from: Camera,
    to: Camera,
    since: Instant,
}

impl Session {
    /// Where the camera will be when it has come to rest.
    #[must_use]
    pub fn aim(&self) -> Camera {
        self.flight.as_ref().map_or(self.document.camera, |flight| flight.to)
    }

    /// Whether the camera is on its way.
    #[must_use]
    pub fn glides(&self) -> bool {
        self.flight.is_some()
    }

    /// Whether a viewpoint was asked for from the clipboard.
    #[must_use]
    pub fn awaits_viewpoint(&self) -> bool {
        self.awaited.is_some_and(|since| since.elapsed() < CLIPBOARD)
    }

    /// The viewpoint to look from at first, instead of the standard one.
    pub fn look_from(&mut self, viewpoint: Viewpoint) {
        match viewpoint {
            Viewpoint::At(camera) => {
                self.set_camera(camera);
                self.fit = false;
            }
            Viewpoint::From { side, orthographic, up } => {
                self.set_camera(Camera { orthographic, ..self.document.camera.from_side(side, up) });
                self.fit = true;
            }
        }
    }

    pub(super) fn set_camera(&mut self, camera: Camera) {
        self.flight = None;
        self.document.camera = camera;
    }

    /// Glides there, or jumps.
    pub(super) fn glide_to(&mut self, camera: Camera) {
        let from = self.document.camera;
        if !self.navigation.glide || !camera.is_finite() {
            self.set_camera(camera);
        } else if camera != self.aim() {
            self.flight = Some(Flight { from, to: camera, since: Instant::now() });
        }
    }

    /// Moves the camera on its way; returns when to look again.
    pub(super) fn glide(&mut self) -> Option<Instant> {
        let Flight { from, to, since } = self.flight.as_ref()?;
        let t = since.elapsed().as_secs_f64() / GLIDE.as_secs_f64();
        let eased = t * t * (3.0 - 2.0 * t);
        self.document.camera = from.on_the_way(*to, if t < 1.0 { eased } else { 1.0 });
        if t >= 1.0 {
            self.flight = None;
            return Some(Instant::now()); // the last picture
        }
        Some(Instant::now() + FRAME)
    }

    /// Who saw all of it before, and not from nearer than that takes, sees all of it from `camera`, too.
    fn still_whole(&self, camera: Camera) -> Camera {
        let (Some((size, style)), Some(frame)) = (self.view, &self.frame) else { return camera };
        if !frame.scene.fits_at_once() {
            return camera;
        }
        let [before, after] = [self.aim(), camera].map(|from| frame.scene.fit(from, &style, size.aspect()));
        let apart = before.pivot.distance(self.aim().pivot) / before.distance;
        let (nearness, near) = (self.aim().distance / before.distance, 1e-3);
        // What just fits, fits from elsewhere, too, where its middle is another one.
        let just_fits = (nearness - 1.0).abs() < near && apart < near;
        let is_seen = nearness > 1.0 - near;
        if just_fits || is_seen && camera.distance < after.distance { after } else { camera }
    }

    /// Carries out what concerns the camera.
    pub(super) fn change_view(&mut self, action: ViewAction) {
        let (aim, Navigation { turning, up, .. }) = (self.aim(), self.navigation);
        match action {
            ViewAction::From(side) => {
                let camera = self.still_whole(aim.from_side(side, up));
                self.leading.turn(&aim, camera);
                self.glide_to(camera);
            }
            ViewAction::Orthographic => {
                let camera = self.still_whole(Camera { orthographic: !aim.orthographic, ..aim });
                self.leading.turn(&aim, camera);
                self.set_camera(camera);
            }
            ViewAction::Turn(toward) => {
                let by = TURN * toward.vector();
                self.glide_to(match turning {
                    Turning::Turntable => aim.turned(by.x, by.y, up),
                    Turning::Arcball => {
                        let turn = DQuat::from_rotation_y(by.x) * DQuat::from_rotation_x(-by.y);
                        Camera { world_from_view: (aim.world_from_view * turn).normalize(), ..aim }
                    }
                });
            }
            ViewAction::Shift(toward) => self.glide_to(aim.pan(DVec2::ZERO, SHIFT * toward.vector())),
            ViewAction::Nearer => self.zoom(aim, 1.0 / ZOOM),
            ViewAction::Farther => self.zoom(aim, ZOOM),
            ViewAction::Glide(camera) => self.glide_to(camera),
            ViewAction::Copy => {
                self.copied = Some(viewpoint::to_text(&aim));
                self.say(Severity::Note, "viewpoint copied");
            }
            ViewAction::Paste => {
                self.awaited = Some(Instant::now());
                self.asks_clipboard = true;
            }
            ViewAction::Show(text) => self.show_viewpoint(&text),
            ViewAction::Save(name) => {
                self.document.views.insert(name, aim);
            }
            ViewAction::Use(name) => {
                if let Some(camera) = self.document.views.get(&name) {
                    self.glide_to(*camera);
                }
            }
            ViewAction::Forget(name) => {
                self.document.views.remove(&name);
            }
            ViewAction::SetPreset(preset) => self.navigation.preset = preset,
            ViewAction::SetTurning(turning) => {
                self.navigation.turning = turning;
                if turning == Turning::Turntable {
                    self.glide_to(aim.turned(0.0, 0.0, up));
                }
            }
            ViewAction::SetUp(wanted) => {
                self.navigation.up = wanted;
                // What was seen from the front still is: only what is called the front has changed.
                if wanted != up {
                    self.glide_to(standing(aim, up, wanted));
                }
            }
            ViewAction::RenderOptions => self.render_options = !self.render_options,
            ViewAction::Gliding => self.navigation.glide = !self.navigation.glide,
        }
    }

    fn zoom(&mut self, aim: Camera, factor: f64) {
        if let Some(frame) = &self.frame {
            self.glide_to(aim.zoom(DVec2::ZERO, factor, frame.scene.bounds(&self.document.style)));
        }
    }

    fn show_viewpoint(&mut self, text: &str) {
        self.awaited = None;
        match viewpoint::parse(text) {
            Ok(Viewpoint::At(camera)) => {
                self.fit = false;
                self.glide_to(camera);
            }
            Ok(other) => self.look_from(other),
            Err(mistake) => {
                let column = text.get(..mistake.range.start).unwrap_or_default().chars().count() + 1;
                let what = format!("what was copied is no viewpoint: column {column}: {}", mistake.message);
                self.say(Severity::Error, what);
            }
        }
    }
}

/// The same side of things with another axis up.
fn standing(camera: Camera, from: Up, to: Up) -> Camera {
    let turn = DQuat::from_rotation_arc(from.axis(), to.axis());
    Camera { world_from_view: (turn * camera.world_from_view).normalize(), ..camera }
}

impl Toward {
    fn vector(self) -> DVec2 {
        match self {
            Self::Left => DVec2::NEG_X,
            Self::Right => DVec2::X,
            Self::Up => DVec2::Y,
            Self::Down => DVec2::NEG_Y,
        }
    }
}
