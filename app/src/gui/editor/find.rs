//! The field to find and replace text.

use std::ops::Range;

use eframe::egui::{Button, Context, Id, Key, Margin, Modifiers, Response, RichText, TextEdit, Ui};

use super::change::{Change, replace};

/// What is looked for.
#[derive(Default)]
pub struct Find {
    /// Whether the field is there.
    pub open: bool,
    replacing: bool,
    query: String,
    replacement: String,
    exact: bool,
    /// The field shall have the keys.
    focus: bool,
    matches: Vec<Range<usize>>,
    /// What `matches` was found with.
    found: (String, String, bool),
}

/// What the field asks for.
pub enum Wish {
    /// To the first place from the beginning of what is selected on: it grows with what is typed.
    Here,
    /// To the place after the cursor.
    Next,
    /// To the place before it.
    Previous,
    /// The text is to be this.
    Change(Change),
    /// The text gets the keys back.
    Close,
}

impl Find {
    /// Opens the field, with what is selected.
    pub fn open(&mut self, replacing: bool, selected: &str) {
        self.open = true;
        self.replacing = replacing;
        self.focus = true;
        if !selected.is_empty() && !selected.contains('\n') {
            self.query = selected.to_owned();
        }
    }

    /// Whether what is typed is looked for, or put in its place.
    pub fn has_keys(&self, ctx: &Context) -> bool {
        self.open && ctx.memory(|m| m.has_focus(query_id()) || m.has_focus(replacement_id()))
    }

    /// Where it is, in order.
    pub fn matches(&mut self, text: &str) -> &[Range<usize>] {
        if !self.open {
            return &[];
        }
        let (of, query, exact) = &self.found;
        if *of != text || *query != self.query || *exact != self.exact {
            self.matches = matches(text, &self.query, self.exact);
            self.found = (text.to_owned(), self.query.clone(), self.exact);
        }
        &self.matches
    }

    /// The place after or before what is selected, round the end.
    pub fn step(&mut self, text: &str, selection: &Range<usize>, forwards: bool) -> Option<Range<usize>> {
        let selection = selection.clone();
        let all = self.matches(text);
        let found = if forwards {
            all.iter().find(|m| m.start >= selection.end && **m != selection).or(all.first())
        } else {
            all.iter().rev().find(|m| m.end <= selection.start && **m != selection).or(all.last())
        };
        found.cloned()
    }

    /// Shows the field.
    pub fn show(&mut self, ui: &mut Ui, text: &str, selection: &Range<usize>) -> Option<Wish> {
        let mut wish = None;
        let id = query_id();
        let frame = eframe::egui::Frame::NONE.fill(ui.visuals().panel_fill).inner_margin(Margin::symmetric(12, 5));
        let response = frame.show(ui, |ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let wide = (ui.available_width() - 210.0).clamp(60.0, 260.0);
            ui.horizontal(|ui| {
                let keys = ui.memory(|m| m.has_focus(id)).then(|| entered(ui)).flatten();
                let field = TextEdit::singleline(&mut self.query)
                    .id(id)
                    .hint_text(crate::gui::widgets::hint("find"))
                    .desired_width(wide)
                    .show(ui);
                if std::mem::take(&mut self.focus) {
                    let mut state = field.state.clone();
                    let all = eframe::egui::text::CCursorRange::select_all(&field.galley);
                    state.cursor.set_char_range(Some(all));
                    state.store(ui.ctx(), id);
                    ui.memory_mut(|m| m.request_focus(id));
                }
                let changed = field.response.changed();
                closes(ui, &field.response, &mut wish);
                field.response.response.accessible_name("Find in program");
                if let Some(backwards) = keys {
                    wish = Some(if backwards { Wish::Previous } else { Wish::Next });
                }
                if changed {
                    wish = Some(Wish::Here);
                }
                if ui.add(Button::new("‹").small()).on_hover_text("previous (Shift+Enter)").clicked() {
                    wish = Some(Wish::Previous);
                }
                if ui.add(Button::new("›").small()).on_hover_text("next (Enter)").clicked() {
                    wish = Some(Wish::Next);
                }
                let exact = ui.selectable_label(self.exact, "Aa").on_hover_text("large and small letters differ");
                if exact.clicked() {
                    self.exact = !self.exact;
                }
                let count = self.count(text, selection);
                let nothing = count == "none" && !self.query.is_empty();
                let color = if nothing { ui.visuals().error_fg_color } else { ui.visuals().weak_text_color() };
                if !self.query.is_empty() {
                    ui.label(RichText::new(count).small().color(color));
                }
                ui.with_layout(eframe::egui::Layout::right_to_left(eframe::egui::Align::Center), |ui| {
                    let close = ui.add(Button::new("×").frame(false)).on_hover_text("close (Escape)");
                    if close.accessible_name("Close find").clicked() {
                        wish = Some(Wish::Close);
                    }
                });
            });
            if self.replacing {
                ui.horizontal(|ui| self.replacing(ui, wide, text, selection, &mut wish));
            }
        });
        let stroke = ui.visuals().widgets.noninteractive.bg_stroke;
        ui.painter().hline(response.response.rect.x_range(), response.response.rect.bottom(), stroke);
        ui.add_space(-ui.spacing().item_spacing.y);
        if matches!(wish, Some(Wish::Close)) {
            self.open = false;
        }
        wish
    }

    fn replacing(&mut self, ui: &mut Ui, wide: f32, text: &str, selection: &Range<usize>, wish: &mut Option<Wish>) {
        let id = replacement_id();
        let entered = ui.memory(|m| m.has_focus(id)).then(|| entered(ui)).flatten().is_some();
        let field = TextEdit::singleline(&mut self.replacement)
            .id(id)
            .hint_text(crate::gui::widgets::hint("replace by"))
            .desired_width(wide);
        let field = ui.add(field);
        closes(ui, &field, wish);
        field.accessible_name("Replace by");
        let some = !self.matches(text).is_empty();
        if ui.add_enabled(some, Button::new("Replace")).clicked() || entered && some {
            *wish = if self.matches(text).contains(selection) {
                Some(Wish::Change(replace(text, selection.clone(), &self.replacement)))
            } else {
                Some(Wish::Next)
            };
        }
        if ui.add_enabled(some, Button::new("All")).on_hover_text("replace all of them").clicked() {
            *wish = Some(Wish::Change(self.all_replaced(text)));
        }
    }

    fn all_replaced(&mut self, text: &str) -> Change {
        let mut result = String::with_capacity(text.len());
        let mut end = 0;
        let replacement = self.replacement.clone();
        for found in self.matches(text) {
            result.push_str(&text[end..found.start]);
            result.push_str(&replacement);
            end = found.end;
        }
        let cursor = result.len();
        result.push_str(&text[end..]);
        Change { text: result, selection: cursor..cursor }
    }

    fn count(&mut self, text: &str, selection: &Range<usize>) -> String {
        let all = self.matches(text);
        match all.iter().position(|m| m == selection) {
            _ if all.is_empty() => "none".to_owned(),
            Some(i) => format!("{} of {}", i + 1, all.len()),
            None => all.len().to_string(),
        }
    }
}

fn query_id() -> Id {
    Id::unique("find in program")
}

fn replacement_id() -> Id {
    Id::unique("replace in program")
}

/// Enter was pressed; `true` with Shift.
fn entered(ui: &Ui) -> Option<bool> {
    ui.input_mut(|i| {
        if i.consume_key(Modifiers::SHIFT, Key::Enter) {
            return Some(true);
        }
        i.consume_key(Modifiers::NONE, Key::Enter).then_some(false)
    })
}

/// Escape in a field closes.
fn closes(ui: &Ui, field: &Response, wish: &mut Option<Wish>) {
    if field.lost_focus() && ui.input(|i| i.key_pressed(Key::Escape)) {
        *wish = Some(Wish::Close);
    }
}

/// Where `query` stands in a text, in order, none over another; large and small letters are the same but for `exact`.
pub fn matches(text: &str, query: &str, exact: bool) -> Vec<Range<usize>> {
    if query.is_empty() {
        return Vec::new();
    }
    if exact {
        return text.match_indices(query).map(|(i, m)| i..i + m.len()).collect();
    }
    let wanted: Vec<char> = query.chars().flat_map(char::to_lowercase).collect();
    let mut found = Vec::new();
    let mut end = 0;
    for (start, _) in text.char_indices() {
        if start < end {
            continue;
        }
        let mut letters =
            text[start..].char_indices().flat_map(|(i, c)| c.to_lowercase().map(move |l| (i + c.len_utf8(), l)));
        let mut last = 0;
        let fits = wanted.iter().all(|w| {
            letters.next().is_some_and(|(i, l)| {
                last = i;
                l == *w
            })
        });
        if fits {
            end = start + last;
            found.push(start..end);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_found_large_and_small() {
        assert_eq!(matches("Ab ab aB", "ab", false), [0..2, 3..5, 6..8]);
        assert_eq!(matches("Ab ab Ab ab", "ab", true), [3..5, 9..11]);
        assert_eq!(matches("aaaa", "aa", false), [0..2, 2..4]);
        assert_eq!(matches("äÖö", "ö", false), [2..4, 4..6]);
        assert_eq!(matches("abc", "", false), []);
    }

    #[test]
    fn all_are_replaced_at_once() {
        let mut find = Find { open: true, query: "p".to_owned(), replacement: "vertex".to_owned(), ..Find::default() };
        assert_eq!(find.all_replaced("p, p;").text, "vertex, vertex;");
        assert_eq!(find.step("p, p;", &(0..1), true), Some(3..4));
        assert_eq!(find.step("p, p;", &(3..4), true), Some(0..1), "round the end");
        assert_eq!(find.step("p, p;", &(0..1), false), Some(3..4));
    }
}
