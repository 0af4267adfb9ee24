//! What dragging, scrolling and clicking make of the camera.

use eframe::egui::{
    CursorIcon, Event, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, Rect, Response, Ui, Vec2,
};
use glam::DVec2;

use super::super::clicks::NEAR;
use crate::camera::{Camera, picture_point};
use crate::navigation::{Hand, Navigation, Turning};
use crate::scene::{Plane, Pointer, Scene, Style};
use crate::trace;

/// Points that two fingers move to zoom by a factor of e.
const FINGERS: f64 = 200.0;

/// What a drag does from where it has begun, whatever keys are let go meanwhile.
#[derive(Debug, Default)]
pub struct Hands {
    holding: Option<(PointerButton, Hand, DVec2)>,
    /// Whether what is scrolled still comes from fingers, whose way egui smooths like that of a wheel.
    fingers: bool,
}

impl Hands {
    /// The camera that the hands make of this one, if they do anything.
    pub fn moved(
        &mut self,
        ui: &Ui,
        response: &Response,
        navigation: &Navigation,
        camera: Camera,
        scene: &Scene,
        style: &Style,
    ) -> Option<Camera> {
        let rect = response.rect;
        if let Some(moved) = self.dragged(ui, response, navigation, camera, scene, style) {
            return Some(moved);
        }
        let pointer = response.hover_pos()?;
        if response.double_clicked() {
            let _span = trace::span("window: picking");
            let pivot = scene.pick(&self::pointer(rect, pointer, &camera, scene.cut(style, &camera)))?.point;
            // The eye stays where it is in the direction it looks; only what it turns around changes.
            return Some(Camera { pivot, ..camera });
        }
        let at = place(rect, pointer);
        let fingers = fingers(ui);
        if fingers != Vec2::ZERO {
            self.fingers = true;
            let half = f64::from(rect.height().max(1.0)) / 2.0;
            let by = DVec2::new(f64::from(fingers.x), -f64::from(fingers.y)) / half;
            let modifiers = ui.input(|i| i.modifiers);
            return Some(if modifiers.ctrl || modifiers.command {
                camera.zoom(at, (-f64::from(fingers.y) / FINGERS).exp(), scene.bounds(style))
            } else if modifiers.shift {
                camera.pan(at, at + by)
            } else {
                turn(camera, navigation, DVec2::ZERO, by)
            });
        }
        let (scroll, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
        self.fingers &= scroll != 0.0;
        let scroll = if self.fingers { 0.0 } else { scroll };
        if scroll == 0.0 && pinch == 1.0 {
            return None;
        }
        let factor = (-f64::from(scroll) / 300.0).exp() / f64::from(pinch);
        Some(camera.zoom(at, factor, scene.bounds(style)))
    }

    fn dragged(
        &mut self,
        ui: &Ui,
        response: &Response,
        navigation: &Navigation,
        camera: Camera,
        scene: &Scene,
        style: &Style,
    ) -> Option<Camera> {
        let rect = response.rect;
        let (modifiers, delta) = ui.input(|i| (i.modifiers, i.pointer.delta()));
        if response.drag_started() {
            let held = [PointerButton::Primary, PointerButton::Middle, PointerButton::Secondary];
            let began = ui.input(|i| i.pointer.press_origin()).map_or(DVec2::ZERO, |pos| place(rect, pos));
            let grip = |button| Some((button, navigation.preset.hand(button, modifiers)?, began));
            self.holding = held.into_iter().filter(|&b| response.dragged_by(b)).find_map(grip);
        }
        let (button, hand, began) = self.holding?;
        if !response.dragged_by(button) {
            self.holding = None;
            return None;
        }
        ui.ctx().set_cursor_icon(match hand {
            Hand::Turn => CursorIcon::Grabbing,
            Hand::Pan => CursorIcon::AllScroll,
            Hand::Zoom => CursorIcon::ResizeVertical,
        });
        // The pointer may be far outside the window.
        let pointer = response.interact_pointer_pos().filter(|_| delta != Vec2::ZERO)?;
        let (from, to) = (place(rect, pointer - delta), place(rect, pointer));
        Some(match hand {
            Hand::Turn => turn(camera, navigation, from, to),
            Hand::Pan => camera.pan(from, to),
            Hand::Zoom => camera.zoom(began, (from - to).dot(DVec2::ONE).exp(), scene.bounds(style)),
        })
    }
}

fn turn(camera: Camera, navigation: &Navigation, from: DVec2, to: DVec2) -> Camera {
    match navigation.turning {
        Turning::Arcball => camera.orbit(from, to),
        Turning::Turntable => camera.turntable(from, to, navigation.up),
    }
}

/// What is meant by a place in the viewport.
pub fn pointer(rect: Rect, at: Pos2, camera: &Camera, cut: Option<Plane>) -> Pointer {
    let spread = camera.spread(f64::from(2.0 * NEAR / rect.height()));
    Pointer { ray: camera.ray(place(rect, at)), spread, opaque: true, cut }
}

fn place(rect: Rect, pos: Pos2) -> DVec2 {
    let of = |v: Vec2| DVec2::new(f64::from(v.x), f64::from(v.y));
    picture_point(of(pos - rect.min), of(rect.size()))
}

/// How far two fingers have moved on a trackpad.
fn fingers(ui: &Ui) -> Vec2 {
    ui.input(|i| {
        let moved = |event: &Event| match event {
            Event::MouseWheel { unit, source, delta, .. } if is_trackpad(*unit, *source) => *delta,
            _ => Vec2::ZERO,
        };
        i.raw.events.iter().map(moved).fold(Vec2::ZERO, |sum, delta| sum + delta)
    })
}

/// Where the system does not say, a trackpad is what tells of points: a wheel tells of lines.
fn is_trackpad(unit: MouseWheelUnit, source: MouseWheelSource) -> bool {
    match source {
        MouseWheelSource::Trackpad | MouseWheelSource::Momentum => true,
        MouseWheelSource::Wheel => false,
        MouseWheelSource::Unknown => unit == MouseWheelUnit::Point,
    }
}
