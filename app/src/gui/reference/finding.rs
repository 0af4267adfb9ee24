//! Words that are looked for in a page: marked, counted, and brought in sight one after the other.

use eframe::egui::text::{CCursor, LayoutJob};
use eframe::egui::{Rect, Response, Shape, Stroke, StrokeKind, Ui, vec2};

use crate::gui::editor::matches;

/// Points around a place that are in sight with it.
const AROUND: f32 = 50.0;

/// What is looked for, and how far.
#[derive(Default)]
pub struct Finding {
    query: String,
    /// Places passed so far, and on the whole page as shown last.
    passed: usize,
    all: usize,
    /// The one that stands out.
    chosen: usize,
    /// It shall be brought in sight.
    go: bool,
    /// Where it was met on the page.
    met: Option<Rect>,
}

impl Finding {
    /// Begins a page. Something new is looked for from its beginning on.
    pub fn begin(&mut self, query: &str) {
        self.passed = 0;
        if self.query != query {
            (self.query, self.chosen, self.all) = (query.to_owned(), 0, 0);
            self.go = !query.is_empty();
        }
    }

    /// To the next place, or back, round the end.
    pub fn step(&mut self, back: bool) {
        if self.all > 0 {
            self.chosen = (self.chosen + if back { self.all - 1 } else { 1 }) % self.all;
            self.go = true;
        }
    }

    /// Ends the page, in the area that moves it.
    pub fn end(&mut self, ui: &Ui) {
        if let Some(rect) = self.met.take() {
            ui.scroll_to_rect(rect, None);
        }
        if self.all != self.passed {
            self.all = self.passed;
            ui.ctx().request_repaint(); // the count stands above
        }
        self.chosen = self.chosen.min(self.all.saturating_sub(1));
        self.go = false;
    }

    /// `2 of 5`, once something is looked for.
    pub fn count(&self) -> Option<String> {
        match (self.query.is_empty(), self.all) {
            (true, _) => None,
            (false, 0) => Some("none".to_owned()),
            (false, all) => Some(format!("{} of {all}", self.chosen + 1)),
        }
    }

    /// Shows a text with the places marked in it.
    pub fn label(&mut self, ui: &mut Ui, mut job: LayoutJob) -> Response {
        let places = matches(&job.text, &self.query, false);
        if places.is_empty() {
            return ui.label(job);
        }
        let text = job.text.clone();
        job.wrap.max_width = job.wrap.max_width.min(ui.available_width());
        let behind = ui.painter().add(Shape::Noop);
        let galley = ui.painter().layout_job(job);
        let response = ui.label(std::sync::Arc::clone(&galley));
        let color = ui.visuals().warn_fg_color;
        let mut marks = Vec::new();
        for place in places {
            let is_chosen = self.passed == self.chosen;
            self.passed += 1;
            let at = |byte: usize| galley.pos_from_cursor(CCursor::new(text[..byte].chars().count()));
            let (from, to) = (at(place.start), at(place.end));
            // What is broken is marked on its first line.
            let right = if to.top() > from.top() { galley.rect.right() } else { to.left() };
            let rect = Rect::from_min_max(from.min, from.max.max(eframe::egui::pos2(right, from.bottom())));
            let rect = rect.translate(response.rect.min.to_vec2());
            marks.push(Shape::rect_filled(rect, 2.0, color.gamma_multiply(0.3)));
            if is_chosen {
                let edge = Stroke::new(1.2, color);
                marks.push(Shape::rect_stroke(rect.expand(1.0), 2.0, edge, StrokeKind::Outside));
                if std::mem::take(&mut self.go) {
                    let rect = rect.expand2(vec2(20.0, AROUND));
                    // A block of code that is moved sideways keeps what is asked of it, up and down as well, to itself.
                    ui.scroll_to_rect(rect, None);
                    self.met = Some(rect);
                }
            }
        }
        ui.painter().set(behind, Shape::Vec(marks));
        response
    }
}
