//! Changes a number by dragging: at a handle below it, or with Alt or Ctrl held at the number itself.
//!
//! Without a key, dragging in the text selects; so the handle stands outside the text. Alt is what the arrow keys need,
//! too; many window managers of Linux keep Alt with the mouse for themselves, so that Ctrl does the same.

use eframe::egui::{
    Area, CornerRadius, CursorIcon, Id, Order, Rect, Role, Sense, Shape, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2,
};
use vv::assist::Number;

/// Points of dragging for one unit of the last digit.
const POINTS: f32 = 5.0;
/// Seconds that the pointer rests on a number before the handle comes.
const REST: f32 = 0.25;

/// The handle while it is there.
pub struct Handle {
    number: Number,
    /// The number on the screen when the handle came.
    rect: Rect,
    /// The text then.
    text: String,
    /// Points dragged so far; `None` before.
    dragged: Option<f32>,
    units: i64,
    /// Whether the number itself is the handle.
    is_direct: bool,
}

/// Whether a key is held that makes numbers handles.
pub fn is_direct(ui: &Ui) -> bool {
    ui.input(|i| (i.modifiers.alt || i.modifiers.command) && !i.modifiers.shift)
}

impl Handle {
    /// Whether the pointer has rested long enough.
    pub fn may_come(ui: &Ui) -> bool {
        is_direct(ui) && ui.input(|i| !i.pointer.any_down())
            || ui.input(|i| i.pointer.time_since_last_movement() > REST && !i.pointer.any_down())
    }

    /// For a number on the screen.
    pub fn new(number: Number, rect: Rect, text: &str, is_direct: bool) -> Self {
        Self { number, rect, text: text.to_owned(), dragged: None, units: 0, is_direct }
    }

    /// Shows it. Returns the text with the number changed; `false` in `stays` when the pointer has left.
    pub fn show(&mut self, ui: &Ui, stays: &mut bool) -> Option<String> {
        let mut size = vec2(38.0, 17.0);
        let mut rect = Rect::from_min_size(pos2(self.rect.center().x - size.x / 2.0, self.rect.bottom() + 1.0), size);
        if self.is_direct {
            rect = self.rect.expand2(vec2(2.0, 0.0));
            size = rect.size();
        }
        let itself = self.is_direct;
        let area = Area::new(Id::unique("number handle")).order(Order::Foreground).fixed_pos(rect.min);
        let response = area.show(ui.ctx(), |ui| {
            let (rect, response) = ui.allocate_exact_size(size, Sense::drag());
            response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, "Change the number"));
            let active = response.hovered() || response.dragged();
            let visuals = ui.visuals();
            if itself {
                // The number stays to be read.
                let ink = visuals.hyperlink_color;
                ui.painter().rect(rect, 3, ink.gamma_multiply(0.18), Stroke::new(1.0, ink), StrokeKind::Outside);
                return response;
            }
            let fill = if active { visuals.selection.bg_fill } else { visuals.window_fill };
            let color = if active { visuals.selection.stroke.color } else { visuals.text_color() };
            let edge = if active { Stroke::NONE } else { visuals.window_stroke };
            ui.painter().rect(rect, CornerRadius::same(8), fill, edge, StrokeKind::Inside);
            let (c, stroke) = (rect.center(), Stroke::new(1.3, color));
            ui.painter().hline(c.x - 10.0..=c.x + 10.0, c.y, stroke);
            for side in [-1.0, 1.0] {
                let tip = pos2(c.x + side * 10.5, c.y);
                let points = [vec2(-side * 3.5, -3.5), vec2(0.0, 0.0), vec2(-side * 3.5, 3.5)].map(|d| tip + d);
                ui.painter().add(Shape::line(points.to_vec(), stroke));
            }
            response
        });
        let handle = response.inner.on_hover_cursor(CursorIcon::ResizeHorizontal);
        let handle = handle.on_hover_text("drag to change the number; with Shift ten times as fast");
        if handle.dragged() {
            ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
            let fast = if ui.input(|i| i.modifiers.shift) { 10.0 } else { 1.0 };
            let dragged = self.dragged.unwrap_or(0.0) + handle.drag_delta().x * fast;
            self.dragged = Some(dragged);
            let units = (dragged / POINTS).round() as i64;
            if units != self.units {
                self.units = units;
                let range = self.number.range.clone();
                let (before, behind) = (&self.text[..range.start], &self.text[range.end..]);
                return Some(format!("{before}{}{behind}", self.number.moved(units)));
            }
        } else {
            let near = self.rect.union(rect).expand(if self.is_direct { 0.0 } else { 4.0 });
            *stays = self.dragged.is_none()
                && self.is_direct == is_direct(ui)
                && ui.input(|i| i.pointer.hover_pos()).is_some_and(|pos| near.contains(pos));
        }
        None
    }

    /// Whether it is being dragged.
    pub fn is_dragged(&self) -> bool {
        self.dragged.is_some()
    }
}
