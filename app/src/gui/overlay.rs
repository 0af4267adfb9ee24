//! Drawing over the picture: points of the world as the camera sees them, in ink that is readable on any surface.
//!
//! What faces hide is drawn faintly. Lines are drawn over a wider, faint line of the opposite brightness.

use std::cell::RefCell;
use std::f32::consts::TAU;

use eframe::egui::{
    Align2, Color32, CornerRadius, FontId, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Ui, Vec2, pos2, vec2,
};
use glam::{DMat4, DVec2, DVec3};

use super::spread::{Spread, Wanted};
use crate::camera::{Camera, picture_point};
use crate::scene::{Plane, Scene, Style};

/// How faint what is hidden is.
const HIDDEN: f32 = 0.4;

/// Colours that tell what is what.
#[derive(Debug, Clone, Copy)]
pub struct Inks {
    /// What is selected.
    pub selected: Color32,
    /// What the pointer rests on.
    pub pointed: Color32,
    /// Neighbours, and their order.
    pub ring: Color32,
    /// What was before the step.
    pub old: Color32,
    /// The walk.
    pub walk: Color32,
    /// What is wrong.
    pub wrong: Color32,
    /// What is measured.
    pub measure: Color32,
    /// Over what matters less.
    veil: Color32,
    /// Around all of them.
    halo: Color32,
    /// Behind text.
    paper: Color32,
}

impl Inks {
    /// For dark or light surroundings.
    #[must_use]
    pub fn new(ui: &Ui) -> Self {
        let visuals = ui.visuals();
        let paper = visuals.window_fill.gamma_multiply(0.9);
        let halo = visuals.extreme_bg_color.gamma_multiply(0.75);
        let veil = visuals.extreme_bg_color.gamma_multiply(0.6);
        if visuals.dark_mode {
            let [selected, pointed, ring, old, walk, wrong, measure] = [
                Color32::from_rgb(0xff, 0x9f, 0x2e),
                Color32::from_rgb(0xff, 0xe1, 0x5a),
                Color32::from_rgb(0xa8, 0xe2, 0xff),
                Color32::from_rgb(0xc3, 0xb4, 0xf2),
                Color32::from_rgb(0xf0, 0x7c, 0xff),
                Color32::from_rgb(0xff, 0x5f, 0x57),
                Color32::from_rgb(0x7c, 0xe3, 0x8b),
            ];
            Self { selected, pointed, ring, old, walk, wrong, measure, veil, halo, paper }
        } else {
            let [selected, pointed, ring, old, walk, wrong, measure] = [
                Color32::from_rgb(0xd6, 0x5a, 0x00),
                Color32::from_rgb(0xf2, 0xa9, 0x00),
                Color32::from_rgb(0x0b, 0x5c, 0xc4),
                Color32::from_rgb(0x62, 0x47, 0xa6),
                Color32::from_rgb(0xa1, 0x1f, 0xbf),
                Color32::from_rgb(0xd1, 0x1a, 0x1a),
                Color32::from_rgb(0x16, 0x7a, 0x33),
            ];
            Self { selected, pointed, ring, old, walk, wrong, measure, veil, halo, paper }
        }
    }
}

/// A world point in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    /// Where it is seen.
    pub at: Pos2,
    /// Whether faces are before it.
    pub hidden: bool,
}

/// The picture to draw over.
pub struct Overlay<'a> {
    painter: Painter,
    rect: Rect,
    camera: Camera,
    scene: &'a Scene,
    opaque: bool,
    cut: Option<Plane>,
    clip_from_world: DMat4,
    /// Where the labels go that were asked for.
    spread: RefCell<Spread>,
    /// Its colours.
    pub inks: Inks,
}

impl<'a> Overlay<'a> {
    /// Over the picture that fills `rect`.
    #[must_use]
    pub fn new(ui: &Ui, rect: Rect, camera: Camera, scene: &'a Scene, style: &Style) -> Self {
        let aspect = f64::from(rect.width() / rect.height().max(1.0));
        Self {
            painter: ui.painter_at(rect),
            rect,
            camera,
            scene,
            opaque: style.faces,
            cut: scene.cut(style, &camera),
            clip_from_world: camera.clip_from_view(aspect) * camera.view_from_world(),
            spread: RefCell::default(),
            inks: Inks::new(ui),
        }
    }

    /// The camera's ray through a place of the window.
    #[must_use]
    pub fn ray(&self, at: Pos2) -> crate::camera::Ray {
        let of = |v: Vec2| DVec2::new(f64::from(v.x), f64::from(v.y));
        self.camera.ray(picture_point(of(at - self.rect.min), of(self.rect.size())))
    }

    /// Where the picture is.
    #[must_use]
    pub fn rect(&self) -> Rect {
        self.rect
    }

    /// What is cut away.
    #[must_use]
    pub fn cut(&self) -> Option<Plane> {
        self.cut
    }

    /// Where a point is seen; `None` behind the eye, far outside the picture, and for what is nowhere.
    #[must_use]
    pub fn see(&self, p: DVec3) -> Option<Spot> {
        let at = self.project(p)?;
        let hidden = self.opaque && self.scene.hides(self.ray(at), self.cut, p, 2e-3 * self.camera.distance);
        Some(Spot { at, hidden })
    }

    fn project(&self, p: DVec3) -> Option<Pos2> {
        /// Times the size of the picture; what is farther off has lost its meaning as a place.
        const FAR: f64 = 20.0;
        let clip = self.clip_from_world * p.extend(1.0);
        let place = DVec2::new(clip.x, clip.y) / clip.w;
        // Also false for what is not a number.
        let visible = clip.w > 0.0 && place.abs().max_element() < FAR;
        let half = self.rect.size() / 2.0;
        visible.then(|| self.rect.center() + vec2(place.x as f32 * half.x, -place.y as f32 * half.y))
    }

    fn faded(color: Color32, hidden: bool) -> Color32 {
        if hidden { color.gamma_multiply(HIDDEN) } else { color }
    }

    /// Both ends of a line, which is hidden if its middle is.
    fn ends(&self, a: DVec3, b: DVec3) -> Option<(Pos2, Pos2, bool)> {
        Some((self.project(a)?, self.project(b)?, self.see((a + b) / 2.0).is_some_and(|s| s.hidden)))
    }

    /// A line between two points of the world.
    pub fn line(&self, a: DVec3, b: DVec3, width: f32, color: Color32) {
        let Some((a, b, hidden)) = self.ends(a, b) else { return };
        self.stroke(&[a, b], width, color, hidden);
    }

    /// The same, dashed.
    pub fn dashed(&self, a: DVec3, b: DVec3, width: f32, color: Color32) {
        let Some((a, b)) = self.project(a).zip(self.project(b)) else { return };
        self.spread.borrow_mut().line(&[a, b]);
        self.painter.line_segment([a, b], Stroke::new(width + 2.0, self.inks.halo));
        self.painter.extend(Shape::dashed_line(&[a, b], Stroke::new(width, color), 6.0, 4.0));
    }

    /// The same, thin: for what was.
    pub fn past(&self, a: DVec3, b: DVec3, color: Color32) {
        let Some((a, b, hidden)) = self.ends(a, b) else { return };
        self.painter.line_segment([a, b], Stroke::new(3.0, Self::faded(self.inks.halo, hidden).gamma_multiply(0.6)));
        self.painter.extend(Shape::dashed_line(&[a, b], Stroke::new(1.4, Self::faded(color, hidden)), 4.0, 3.0));
    }

    /// An arrow between two points of the world, which leaves `margin` points of length free at either end.
    pub fn arrow(&self, a: DVec3, b: DVec3, margin: f32, width: f32, color: Color32) {
        let Some((a, b, hidden)) = self.ends(a, b) else { return };
        let along = b - a;
        if along.length() > 2.0 * margin + 4.0 {
            let d = along.normalized() * margin;
            self.screen_arrow(&[a + d, b - d], width, color, hidden);
        } else if along.length() > 4.0 {
            self.screen_arrow(&[a + along * 0.15, b - along * 0.15], width.min(1.5), color, hidden);
        }
    }

    /// An arrow along a curve through points of the world.
    pub fn curved_arrow(&self, points: &[DVec3], width: f32, color: Color32) {
        let spots: Option<Vec<Spot>> = points.iter().map(|&p| self.see(p)).collect();
        let Some(spots) = spots else { return };
        let hidden = spots.get(spots.len() / 2).is_some_and(|s| s.hidden);
        let places: Vec<Pos2> = spots.iter().map(|s| s.at).collect();
        self.screen_arrow(&places, width, color, hidden);
    }

    fn screen_arrow(&self, points: &[Pos2], width: f32, color: Color32, hidden: bool) {
        let [.., before, tip] = *points else { return };
        let length: f32 = points.windows(2).map(|w| w[0].distance(w[1])).sum();
        let size = (3.0 + 2.4 * width).min(0.6 * length);
        if size < 2.0 {
            return;
        }
        let direction = (tip - before).normalized();
        let (back, side) = (tip - direction * size, direction.rot90() * size * 0.5);
        // The line ends where the head begins, or it would blunt the tip.
        let mut shaft = points.to_vec();
        while shaft.len() > 2 && shaft[shaft.len() - 2].distance(tip) < size {
            shaft.remove(shaft.len() - 2);
        }
        if let Some(end) = shaft.last_mut() {
            *end = back;
        }
        self.stroke(&shaft, width, color, hidden);
        let color = Self::faded(color, hidden);
        let halo = Stroke::new(1.0, Self::faded(self.inks.halo, hidden));
        self.painter.add(Shape::convex_polygon(vec![tip, back + side, back - side], color, halo));
    }

    fn stroke(&self, points: &[Pos2], width: f32, color: Color32, hidden: bool) {
        self.spread.borrow_mut().line(points);
        let halo = Stroke::new(width + 2.0, Self::faded(self.inks.halo, hidden));
        self.painter.line(points.to_vec(), halo);
        self.painter.line(points.to_vec(), Stroke::new(width, Self::faded(color, hidden)));
    }

    /// A filled disc.
    pub fn disc(&self, p: DVec3, radius: f32, color: Color32) {
        let Some(spot) = self.see(p) else { return };
        self.spread.borrow_mut().mark(spot.at, radius);
        let halo = Stroke::new(1.5, Self::faded(self.inks.halo, spot.hidden));
        self.painter.circle(spot.at, radius, Self::faded(color, spot.hidden), halo);
    }

    /// A circle around a point.
    pub fn circle(&self, p: DVec3, radius: f32, width: f32, color: Color32) {
        let Some(spot) = self.see(p) else { return };
        self.spread.borrow_mut().mark(spot.at, radius);
        self.painter.circle_stroke(spot.at, radius, Stroke::new(width + 2.0, Self::faded(self.inks.halo, spot.hidden)));
        self.painter.circle_stroke(spot.at, radius, Stroke::new(width, Self::faded(color, spot.hidden)));
    }

    /// A glow around a point.
    pub fn glow(&self, p: DVec3, color: Color32) {
        let Some(spot) = self.see(p) else { return };
        for (radius, part) in [(13.0, 0.18), (10.0, 0.3), (7.0, 0.5)] {
            self.painter.circle_filled(spot.at, radius, Self::faded(color.gamma_multiply(part), spot.hidden));
        }
        self.painter.circle(spot.at, 4.0, Self::faded(color, spot.hidden), Stroke::new(1.0, self.inks.halo));
    }

    /// Makes fainter what is there so far.
    pub fn veil(&self) {
        self.painter.rect_filled(self.rect, 0.0, self.inks.veil);
    }

    /// A thin line through points, also where faces hide it.
    pub fn trail(&self, points: impl Iterator<Item = DVec3>, width: f32, color: Color32) {
        let places: Vec<Option<Pos2>> = points.map(|p| self.project(p)).collect();
        for seen in places.split(Option::is_none).filter(|seen| seen.len() > 1) {
            let seen: Vec<Pos2> = seen.iter().copied().flatten().collect();
            self.stroke(&seen, width, color, false);
        }
    }

    /// A polygon's outline and a faint filling, triangle by triangle.
    pub fn polygon(&self, points: &[DVec3], triangles: &[[u32; 3]], color: Color32) {
        let places: Option<Vec<Pos2>> = points.iter().map(|&p| self.project(p)).collect();
        let Some(places) = places else { return };
        let center = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
        let hidden = self.see(center).is_some_and(|s| s.hidden);
        let fill = Self::faded(color.gamma_multiply(0.28), hidden);
        let mut mesh = eframe::egui::Mesh::default();
        places.iter().for_each(|&p| mesh.colored_vertex(p, fill));
        triangles.iter().for_each(|&[a, b, c]| mesh.add_triangle(a, b, c));
        self.painter.add(mesh);
        let mut around = places;
        around.extend(around.first().copied());
        self.stroke(&around, 2.5, color, hidden);
    }

    /// Text beside a point, `aside` points of length away from it if that place is free: [`Overlay::write`] finds where.
    pub fn label(&self, p: DVec3, aside: Vec2, text: &str, color: Color32) {
        if let Some(Spot { at, hidden }) = self.see(p) {
            let text = text.to_owned();
            self.spread.borrow_mut().wanted.push(Wanted { at, aside, text, color, hidden, is_fixed: false });
        }
    }

    /// Text in the middle between two points.
    pub fn label_between(&self, a: DVec3, b: DVec3, text: &str, color: Color32) {
        if let Some((a, b)) = self.project(a).zip(self.project(b)) {
            let (at, aside, text) = (a + (b - a) / 2.0, Vec2::ZERO, text.to_owned());
            self.spread.borrow_mut().wanted.push(Wanted { at, aside, text, color, hidden: false, is_fixed: true });
        }
    }

    /// Writes the labels that were asked for, so that they hide neither each other nor marks nor arrows, as far as there
    /// is room; those asked for last come first. For the end of all drawing but of [`Overlay::tag`].
    pub fn write(&self) {
        self.write_caption();
        let font = FontId::proportional(12.0);
        let wanted = std::mem::take(&mut self.spread.borrow_mut().wanted);
        for Wanted { at, aside, text, color, hidden, is_fixed } in wanted.into_iter().rev() {
            let galley = self.painter.layout_no_wrap(text.clone(), font.clone(), color);
            let padding = vec2(4.0, 1.0);
            let size = galley.size() + 2.0 * padding;
            let Some(rect) = self.spread.borrow_mut().place(self.rect, at, aside, size, text, is_fixed) else {
                continue;
            };
            // What is there to be read must be readable wherever it is.
            let (opacity, color) = if hidden { (0.85, color.gamma_multiply(0.85)) } else { (1.0, color) };
            let paper = self.inks.paper.gamma_multiply(opacity);
            self.painter.rect(rect, CornerRadius::same(4), paper, Stroke::NONE, StrokeKind::Inside);
            self.painter.galley_with_override_text_color(rect.min + padding, galley, color);
        }
    }

    /// Small text at a point that is known to be seen, unless another label is there, or says the same.
    pub fn tag(&self, p: DVec3, text: &str, color: Color32) {
        if let Some(at) = self.project(p).filter(|at| self.rect.contains(*at)) {
            let galley = self.painter.layout_no_wrap(text.to_owned(), FontId::proportional(11.0), color);
            let padding = vec2(3.0, 0.0);
            let rect = Align2::CENTER_CENTER.anchor_size(at, galley.size() + 2.0 * padding);
            if self.spread.borrow().is_taken(at, rect, text) {
                return;
            }
            self.painter.rect_filled(rect, CornerRadius::same(4), self.inks.paper);
            self.painter.galley_with_override_text_color(rect.min + padding, galley, color);
        }
    }

    /// Text at the lower edge of the picture, which nothing covers.
    pub fn caption(&self, text: &str, color: Color32) {
        self.spread.borrow_mut().caption = Some((text.to_owned(), color));
    }

    fn write_caption(&self) {
        let Some((text, color)) = self.spread.borrow_mut().caption.take() else { return };
        let most = (self.rect.width() - 48.0).max(60.0);
        let galley = self.painter.layout(text, FontId::monospace(14.0), color, most);
        let padding = vec2(12.0, 6.0);
        let at = pos2(self.rect.center().x, self.rect.bottom() - 34.0);
        let rect = Align2::CENTER_BOTTOM.anchor_size(at, galley.size() + 2.0 * padding);
        self.spread.borrow_mut().keep_free(rect);
        let edge = Stroke::new(1.0, color.gamma_multiply(0.5));
        self.painter.rect(rect, CornerRadius::same(7), self.inks.paper, edge, StrokeKind::Inside);
        self.painter.galley(rect.min + padding, galley, color);
    }
}

/// Places evenly on a circle, from the top counter-clockwise, as rings go.
#[must_use]
pub fn around(center: Pos2, radius: f32, i: usize, count: usize) -> Pos2 {
    let angle = -TAU * (i as f32 / count.max(1) as f32 + 0.25);
    center + radius * vec2(angle.cos(), angle.sin())
}
