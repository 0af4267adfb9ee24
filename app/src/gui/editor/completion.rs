//! What can stand at the cursor, in a list below it.

use std::ops::Range;

use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    Align2, Area, Frame, Id, Key, Margin, Modifiers, Order, Pos2, Rect, Role, ScrollArea, Sense, TextStyle, Ui,
    WidgetInfo, pos2, vec2,
};
use vv::assist::{Completion, Completions};

use super::super::theme;
use super::change::{Change, replace};

const ROWS: usize = 9;
const ROW: f32 = 20.0;
const WIDTH: f32 = 360.0;

/// The list while it is open.
pub struct Popup {
    completions: Completions,
    selected: usize,
    /// The selection was moved, so that Enter means it.
    moved: bool,
}

impl Popup {
    /// A list of what there is; `None` if there is nothing.
    pub fn new(completions: Completions) -> Option<Self> {
        (!completions.entries.is_empty()).then_some(Self { completions, selected: 0, moved: false })
    }

    /// The list after another letter.
    pub fn follow(&self, completions: Completions) -> Option<Self> {
        let same = completions.replaces.start == self.completions.replaces.start;
        Self::new(completions).filter(|_| same)
    }

    /// The word that would be replaced.
    pub fn replaces(&self) -> Range<usize> {
        self.completions.replaces.clone()
    }

    /// Whether a cursor is still where the list was made for.
    pub fn is_at(&self, cursor: usize) -> bool {
        self.completions.replaces.end == cursor
    }

    /// Takes the keys that walk the list and choose from it; `None` with `close` set, if it shall go.
    pub fn take_keys(&mut self, ui: &Ui, text: &str, close: &mut bool) -> Option<Change> {
        let count = self.completions.entries.len();
        ui.input_mut(|i| {
            let mut pressed = |key| i.count_and_consume_key(Modifiers::NONE, key) as isize;
            let by = pressed(Key::ArrowDown) - pressed(Key::ArrowUp);
            if by != 0 {
                self.selected = (self.selected as isize + by).rem_euclid(count as isize) as usize;
                self.moved = true;
            }
            if pressed(Key::Escape) > 0 {
                *close = true;
                return None;
            }
            // A word that is written out already needs no choice: Enter ends the line.
            let written = text.get(self.completions.replaces.clone()).unwrap_or_default();
            let entry = self.completions.entries.get(self.selected)?;
            if entry.label == written && !self.moved && i.key_pressed(Key::Enter) {
                *close = true;
                return None;
            }
            let mut pressed = |key| i.consume_key(Modifiers::NONE, key);
            if pressed(Key::Enter) || pressed(Key::Tab) {
                *close = true;
                return Some(self.chosen(text, entry));
            }
            None
        })
    }

    fn chosen(&self, text: &str, entry: &Completion) -> Change {
        let range: Range<usize> = self.completions.replaces.clone();
        let called_already = text.get(range.end..).is_some_and(|behind| behind.starts_with('('));
        let insert = if called_already { &entry.label } else { &entry.insert };
        replace(text, range, insert)
    }

    /// Shows it below (or above) the place where the word begins.
    pub fn show(&mut self, ui: &Ui, word: Rect, text: &str) -> Option<Change> {
        let mut chosen = None;
        let entries = &self.completions.entries;
        let rows = entries.len().min(ROWS);
        let height = rows as f32 * ROW + 66.0;
        let room = ui.ctx().content_rect();
        let below = word.bottom() + 2.0 + height < room.bottom();
        let y = if below { word.bottom() + 2.0 } else { (word.top() - 2.0 - height).max(room.top()) };
        let at: Pos2 = pos2(word.left().min(room.right() - WIDTH - 20.0).max(room.left()), y);
        let area = Area::new(Id::unique("completions")).order(Order::Foreground).fixed_pos(at);
        area.show(ui.ctx(), |ui| {
            let frame = Frame::popup(ui.style()).inner_margin(Margin::same(4));
            frame.show(ui, |ui| {
                ui.set_width(WIDTH);
                ui.spacing_mut().item_spacing.y = 0.0;
                let scroll = ScrollArea::vertical().max_height(ROWS as f32 * ROW).id_salt("completions");
                scroll.show(ui, |ui| {
                    for (i, entry) in entries.iter().enumerate() {
                        let selected = i == self.selected;
                        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
                        response
                            .widget_info(|| WidgetInfo::selected(Role::ListBoxOption, true, selected, &entry.label));
                        row(ui, rect, entry, selected);
                        if selected && self.moved {
                            response.scroll_to_me(None);
                        }
                        if response.clicked() {
                            chosen = Some(self.chosen(text, entry));
                        }
                    }
                });
                if let Some(entry) = entries.get(self.selected) {
                    ui.add_space(3.0);
                    ui.separator();
                    let font = TextStyle::Small.resolve(ui.style());
                    let mut job = LayoutJob::simple(
                        entry.doc.clone(),
                        font,
                        ui.visuals().weak_text_color(),
                        ui.available_width(),
                    );
                    job.wrap.max_rows = 3;
                    ui.add_space(2.0);
                    ui.label(job);
                    ui.add_space(2.0);
                }
            });
        });
        self.moved &= chosen.is_none();
        chosen
    }
}

fn row(ui: &Ui, rect: Rect, entry: &Completion, selected: bool) {
    let visuals = ui.visuals();
    if selected {
        ui.painter().rect_filled(rect, 3.0, visuals.selection.bg_fill);
    } else if ui.rect_contains_pointer(rect) {
        ui.painter().rect_filled(rect, 3.0, visuals.widgets.hovered.weak_bg_fill);
    }
    let strong = visuals.selection.stroke.color;
    let color = if selected { strong } else { theme::token(visuals.dark_mode, entry.class) };
    let font = TextStyle::Monospace.resolve(ui.style());
    let inner = rect.shrink2(vec2(6.0, 0.0));
    let name = ui.painter().text(inner.left_center(), Align2::LEFT_CENTER, &entry.label, font, color);
    let usage = entry.usage.lines().next().unwrap_or_default().split("    ").next().unwrap_or_default();
    let weak = if selected { strong } else { visuals.weak_text_color() };
    let mut job = LayoutJob::simple_singleline(usage.to_owned(), TextStyle::Small.resolve(ui.style()), weak);
    let left = (name.right() + 14.0).max(inner.left() + 96.0);
    job.wrap = TextWrapping::truncate_at_width((inner.right() - left).max(10.0));
    let galley = ui.painter().layout_job(job);
    let room = Rect::from_min_max(pos2(left, rect.top()), inner.max);
    ui.painter().galley(Align2::LEFT_CENTER.align_size_within_rect(galley.size(), room).min, galley, weak);
}
