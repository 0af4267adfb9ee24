//! The program's text, coloured, with its errors where they are.

mod change;
mod completion;
mod find;
mod foot;
mod header;
mod page;
mod tuning;
mod typing;

use std::ops::Range;
use std::sync::Arc;

use eframe::egui::text::{CCursor, CCursorRange, LayoutJob};
use eframe::egui::text_edit::TextEditOutput;
use eframe::egui::{
    self, Align, Color32, Context, EventFilter, FontId, Galley, Id, Key, Margin, Modifiers, Rect, RichText, ScrollArea,
    Shape, TextBuffer, TextEdit, TextFormat, TextStyle, Ui, Vec2b, pos2, vec2,
};
use vv::assist::{Assist, number_at};

use super::{messages, theme};
use crate::command::{Command, TextAction};
use crate::session::{Place, Problem, Reveal, Session};

use change::Change;
pub use find::matches;
use page::{Page, byte_of, char_of};

/// Seconds that the pointer rests on a word before it is explained.
const REST: f32 = 0.45;

/// Seconds in which it is said aloud that the keys are for somebody else now.
const ALOUD: f64 = 8.0;

/// Points between the text and what is around it.
const MARGIN: i8 = 6;

/// What a right click offers.
const MENU: &[&[Command]] = &[
    &[Command::Text(TextAction::Declaration), Command::Text(TextAction::Complete)],
    &[Command::Text(TextAction::ToggleComment), Command::Text(TextAction::Format)],
    &[Command::Text(TextAction::Find), Command::Text(TextAction::Replace)],
];

/// The panel's own state.
#[derive(Default)]
pub struct Editor {
    /// The text as egui edits it; follows the document.
    buffer: String,
    /// What the colours were made for, and the colours.
    colored: Option<(String, bool, LayoutJob)>,
    /// Which program it is.
    name: Option<(String, Option<std::path::PathBuf>)>,
    assist: Option<Assist>,
    find: find::Find,
    popup: Option<completion::Popup>,
    handle: Option<tuning::Handle>,
    /// Where the pointer lay as the text last changed. While it lies there it points at nothing, and what is said about what
    /// happens to come under it would cover what is typed.
    typed_over: Option<egui::Pos2>,
    /// What is selected, in bytes; the cursor if nothing is. egui forgets it when the keys go elsewhere.
    selected: Range<usize>,
    /// What to bring in sight, beside what the session says.
    reveal: Option<Reveal>,
    /// Tells documents apart.
    document: u64,
    /// Whether it gave the keys to the picture, and nobody has had them since.
    left: bool,
    /// Whether it had the keys in the last frame.
    had_keys: bool,
    /// When something was to be said about the keys, in seconds of the window's clock.
    told: Option<f64>,
    /// Height of what stands below the text.
    foot: f32,
}

fn id() -> Id {
    Id::unique("program text")
}

/// Whether what is typed goes into the program.
pub fn has_keys(ctx: &Context) -> bool {
    ctx.memory(|m| m.has_focus(id()))
}

impl Editor {
    /// Shows it; does what the session wants of it.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        session: &Session,
        reveal: Option<Reveal>,
        actions: Vec<TextAction>,
        commands: &mut Vec<Command>,
    ) {
        self.follow(ui.ctx(), session);
        self.reveal = reveal.or(self.reveal.take());
        header::show(ui, session, commands);
        if session.text_on_disk().is_some() {
            header::conflict(ui, session, commands);
        }
        if self.find.open {
            let selection = self.selected.clone();
            match self.find.show(ui, &self.buffer, &selection) {
                Some(find::Wish::Here) => self.go(&(selection.start..selection.start), true),
                Some(find::Wish::Next) => self.go(&selection, true),
                Some(find::Wish::Previous) => self.go(&selection, false),
                Some(find::Wish::Change(change)) => {
                    self.change(ui.ctx(), change, commands);
                    let selection = self.selected.clone();
                    self.go(&selection, true);
                }
                Some(find::Wish::Close) => self.reveal = Some(Reveal { range: selection, focus: true }),
                None => {}
            }
        }
        for action in actions {
            self.act(ui.ctx(), session, action, commands);
        }
        if has_keys(ui.ctx()) {
            let mut close = false;
            let chosen = self.popup.as_mut().and_then(|popup| popup.take_keys(ui, &self.buffer, &mut close));
            if close {
                self.popup = None;
            }
            if let Some(change) = chosen {
                self.change(ui.ctx(), change, commands);
            }
            if ui.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)) {
                self.escape(ui.ctx());
            }
            let selection = self.selected.clone();
            if let Some(change) = typing::take(ui, &self.buffer, &selection, session.preferences.tab_width) {
                self.change(ui.ctx(), change, commands);
            }
        } else {
            self.popup = None;
        }
        self.text(ui, session, commands);
    }

    /// Takes away what is over the text. It never takes the keys from it: who goes on typing would give commands.
    fn escape(&mut self, ctx: &Context) {
        if self.find.open {
            self.find.open = false;
        } else if !self.selected.is_empty() {
            let end = self.selected.end;
            self.select(ctx, end..end);
        } else {
            self.told = Some(ctx.input(|i| i.time));
        }
    }

    /// Whom the keys are for, and whether that is to be said aloud.
    fn keys(&mut self, ui: &Ui, session: &Session) -> (foot::Keys, bool) {
        let (ctx, now) = (ui.ctx(), ui.input(|i| i.time));
        let keys = match (has_keys(ctx), ctx.egui_wants_keyboard_input()) {
            (true, _) => foot::Keys::Text,
            (false, true) => foot::Keys::Field,
            (false, false) => foot::Keys::Picture,
        };
        let asked = session.dialog.is_some();
        if self.had_keys && keys != foot::Keys::Text && !asked {
            self.told = Some(now);
        }
        if keys == foot::Keys::Text && !self.had_keys {
            self.told = None;
        }
        self.had_keys = keys == foot::Keys::Text || self.had_keys && asked;
        let left = self.told.map_or(0.0, |told| told + ALOUD - now);
        if left > 0.0 {
            ui.ctx().request_repaint_after_secs(left as f32);
        }
        (keys, left > 0.0)
    }

    /// From now on the keys are for this editor, with its cursor where it was.
    pub fn take_keys(&mut self, ctx: &Context, document: u64) {
        self.document = document;
        self.popup = None;
        self.select(ctx, self.selected.clone());
    }

    /// In the text Tab means itself. F6 leaves it; then Tab goes on from here. For the beginning of a pass.
    pub fn lead_on(&mut self, ctx: &Context) {
        let focused = ctx.memory(|m| m.focused());
        self.left &= focused.is_none();
        if self.left && ctx.input(|i| i.key_pressed(Key::Tab)) {
            self.left = false;
            ctx.memory_mut(|m| m.request_focus(id()));
        }
    }

    /// Whether Escape closes something here.
    pub fn takes_escape(&self, ctx: &Context) -> bool {
        (self.popup.is_some() || self.find.open) && has_keys(ctx) || self.find.has_keys(ctx)
    }

    /// Takes over what has become of the text elsewhere.
    fn follow(&mut self, ctx: &Context, session: &Session) {
        let program = &session.document.program;
        let name = Some((program.name.clone(), program.path.clone()));
        let other = self.name != name && !program.is_modified();
        if self.buffer != *program.text {
            let Range { start, end } = self.selected;
            let kept = |at| if other { 0 } else { change::kept(&self.buffer, &program.text, at) };
            let selection = kept(start)..kept(end);
            self.buffer = program.text.to_string();
            self.select(ctx, selection);
            self.popup = None;
        }
        self.name = name;
    }

    fn select(&mut self, ctx: &Context, selection: Range<usize>) {
        let mut state = TextEdit::load_state(ctx, id()).unwrap_or_default();
        state.cursor.set_char_range(Some(char_range(&self.buffer, &selection)));
        state.store(ctx, id());
        self.selected = selection;
    }

    fn change(&mut self, ctx: &Context, change: Change, commands: &mut Vec<Command>) {
        self.buffer = change.text;
        self.popup = None;
        self.select(ctx, change.selection);
        ctx.memory_mut(|m| m.request_focus(id()));
        commands.push(Command::Edit(self.buffer.as_str().into()));
    }

    /// To the next place that was found.
    fn go(&mut self, from: &Range<usize>, forwards: bool) {
        if let Some(range) = self.find.step(&self.buffer, from, forwards) {
            self.reveal = Some(Reveal { range, focus: false });
        }
    }

    fn act(&mut self, ctx: &Context, session: &Session, action: TextAction, commands: &mut Vec<Command>) {
        let selection = self.selected.clone();
        match action {
            TextAction::Keys if has_keys(ctx) => {
                ctx.memory_mut(|m| m.surrender_focus(id()));
                self.left = true;
            }
            TextAction::Keys => self.reveal = Some(Reveal { range: selection, focus: true }),
            TextAction::Find | TextAction::Replace => {
                self.find.open(action == TextAction::Replace, &self.buffer[selection]);
            }
            TextAction::FindNext | TextAction::FindPrevious if !self.find.open => self.find.open(false, ""),
            TextAction::FindNext => self.go(&selection, true),
            TextAction::FindPrevious => self.go(&selection, false),
            TextAction::ToggleComment => {
                let change = change::toggle_comment(&self.buffer, &selection);
                self.change(ctx, change, commands);
            }
            TextAction::Format => {} // the session's
            TextAction::Complete => {
                ctx.memory_mut(|m| m.request_focus(id()));
                let completions = self.assist(session).complete(selection.end);
                self.popup = completion::Popup::new(completions);
            }
            TextAction::Declaration => {
                let declared = self.assist(session).declaration(selection.start);
                self.reveal = declared.map(|range| Reveal { range, focus: true }).or(self.reveal.take());
            }
            TextAction::NextProblem | TextAction::PreviousProblem => {
                let mut ranges: Vec<_> =
                    own_problems(session).into_iter().map(|(_, place)| place.range.clone()).collect();
                ranges.sort_by_key(|r| (r.start, r.end));
                let next = match action {
                    TextAction::NextProblem => ranges.iter().find(|r| r.start > selection.start).or(ranges.first()),
                    _ => ranges.iter().rev().find(|r| r.start < selection.start).or(ranges.last()),
                };
                self.reveal = next.map(|range| Reveal { range: range.clone(), focus: true }).or(self.reveal.take());
            }
            TextAction::RaiseNumber | TextAction::LowerNumber => {
                let units = if action == TextAction::RaiseNumber { 1 } else { -1 };
                if let Some(number) = number_at(&self.buffer, selection.start) {
                    let change = change::replace(&self.buffer, number.range.clone(), &number.moved(units));
                    self.buffer = change.text;
                    self.select(ctx, change.selection);
                    commands.push(Command::Tune(self.buffer.as_str().into()));
                }
            }
        }
    }

    fn assist(&mut self, session: &Session) -> &Assist {
        let current = self.assist.take().filter(|assist| **assist.text() == *self.buffer);
        self.assist.insert(current.unwrap_or_else(|| {
            let included = session.included_texts();
            Assist::new(self.buffer.as_str(), included.iter().map(|text| &**text))
        }))
    }

    fn text(&mut self, ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
        let reveal = self.reveal.take();
        let font = TextStyle::Monospace.resolve(ui.style());
        let digits = (self.buffer.lines().count() + 1).to_string().len().max(2);
        let digit = ui.fonts_mut(|f| f.glyph_width(&font, '0'));
        let gutter_width = digits as f32 * digit + 26.0;
        // Where the text has been edited since it was run, places are wrong.
        let own = if session.text_waits() { Vec::new() } else { own_problems(session) };
        let mut all = ui.available_rect_before_wrap();
        let whole = all;
        all.max.y -= self.foot;
        let gutter = Rect::from_min_max(all.min, pos2(all.left() + gutter_width, all.bottom()));
        let area = Rect::from_min_max(pos2(gutter.right(), all.top()), all.max);
        let before = self.buffer.len();
        let (behind, output) = self.edit(ui, area, &font, reveal.as_ref());
        if let Some(reveal) = reveal {
            self.selected = reveal.range;
        } else if let Some(range) = output.cursor_range.filter(|_| output.response.has_focus()) {
            let Range { start, end } = range.as_sorted_char_range();
            self.selected = byte_of(&self.buffer, start.0)..byte_of(&self.buffer, end.0);
        }
        let response = output.response.response.clone().accessible_name("Program text");
        response.context_menu(|ui| {
            ui.set_min_width(200.0);
            for (i, group) in MENU.iter().enumerate() {
                if i > 0 {
                    ui.separator();
                }
                for command in *group {
                    super::widgets::menu_item(ui, session, commands, command.clone(), false);
                }
            }
        });
        let changed = output.response.changed();
        if changed {
            commands.push(Command::Edit(self.buffer.as_str().into()));
        }
        let focus = output.response.has_focus();
        let cursor = output.cursor_range.filter(|_| focus).map(|range| range.primary);
        let clip = area.intersect(ui.clip_rect());
        let text = self.buffer.clone();
        let page = Page { galley: &output.galley, origin: output.galley_pos, text: &text, clip };
        // What egui takes for a word is one of prose.
        let clicked = response.interact_pointer_pos().filter(|_| response.double_clicked());
        if let Some(word) = clicked.and_then(|pos| page.word_at(pos)) {
            self.select(ui.ctx(), word);
        }
        let cursor_line = cursor.map(|cursor| page.row_of(cursor));
        let mut shapes = vec![page.found(ui, self.find.matches(&text), &self.selected)];
        if let Some(row) = cursor_line.and_then(|row| page.row_rect(row)) {
            let stripe = Rect::from_x_y_ranges(area.x_range(), row.y_range());
            shapes.insert(0, Shape::rect_filled(stripe, 0.0, ui.visuals().faint_bg_color));
        }
        ui.painter().with_clip_rect(area).set(behind, Shape::Vec(shapes));
        let cursor = cursor.map(|cursor| byte_of(&text, cursor.index.0));
        if let Some(pair) = cursor.and_then(|cursor| self.assist(session).brackets(cursor)) {
            page.brackets(ui, &pair);
        }
        for (problem, place) in &own {
            page.underline(ui, problem, place);
        }
        page.line_messages(ui, &own);
        page.gutter(ui, gutter, &own, cursor_line);
        if focus {
            let edge = egui::Stroke::new(2.0, ui.visuals().hyperlink_color);
            ui.painter().vline(gutter.left() + 1.0, gutter.y_range(), edge);
        } else {
            page.resting_cursor(ui, self.selected.end);
        }
        let typed = changed && self.buffer.len() > before;
        let pointer = ui.input(|i| i.pointer.hover_pos());
        if changed {
            self.typed_over = pointer;
        }
        self.completions(ui, session, &page, cursor, typed, commands);
        let over_text = output.response.hovered();
        if (over_text || ui.rect_contains_pointer(gutter)) && pointer != self.typed_over {
            self.tooltips(ui, session, &page, gutter, &own);
        }
        self.tune(ui, &page, over_text, commands);
        let keys = self.keys(ui, session);
        self.foot = foot::show(ui, whole, session, (&text, &self.selected), &own, keys, commands);
    }

    /// The field itself. Returns a place to draw behind the text.
    fn edit(
        &mut self,
        ui: &mut Ui,
        area: Rect,
        font: &FontId,
        reveal: Option<&Reveal>,
    ) -> (egui::layers::ShapeIdx, TextEditOutput) {
        let dark = ui.visuals().dark_mode;
        let colored = &mut self.colored;
        let mut layouter = |ui: &Ui, text: &dyn TextBuffer, _width: f32| -> Arc<Galley> {
            let text = text.as_str();
            let job = match colored {
                Some((of, was_dark, job)) if of == text && *was_dark == dark => job.clone(),
                _ => {
                    let job = color(text, dark, font);
                    *colored = Some((text.to_owned(), dark, job.clone()));
                    job
                }
            };
            ui.fonts_mut(|f| f.layout_job(job))
        };
        let buffer = &mut self.buffer;
        let keys = EventFilter { tab: true, escape: true, horizontal_arrows: true, vertical_arrows: true };
        let inside = egui::UiBuilder::new().max_rect(area);
        ui.scope_builder(inside, |ui| {
            ScrollArea::both().id_salt(("program", self.document)).auto_shrink(Vec2b::FALSE).show(ui, |ui| {
                let behind = ui.painter().add(Shape::Noop);
                let output = TextEdit::multiline(buffer)
                    .id(id())
                    .code_editor()
                    .event_filter(keys)
                    .frame(egui::Frame::NONE.inner_margin(Margin { left: 2, right: 40, top: MARGIN, bottom: 40 }))
                    .desired_width(f32::INFINITY)
                    .min_size(area.size())
                    .layouter(&mut layouter)
                    .show(ui);
                if let Some(reveal) = reveal {
                    place_cursor(ui, &output, buffer, reveal);
                }
                (behind, output)
            })
        })
        .inner
        .inner
    }

    fn completions(
        &mut self,
        ui: &Ui,
        session: &Session,
        page: &Page<'_>,
        cursor: Option<usize>,
        typed: bool,
        commands: &mut Vec<Command>,
    ) {
        let Some(cursor) = cursor else { return };
        let at = self.popup.as_ref().is_some_and(|popup| popup.is_at(cursor));
        if typed || self.popup.is_some() && !at {
            let completions = self.assist(session).complete(cursor);
            let written = completions.replaces.len();
            let after_mark = self.buffer[..completions.replaces.start].ends_with('$');
            self.popup = match &self.popup {
                Some(popup) => popup.follow(completions),
                None if typed && (written >= 2 || after_mark) => completion::Popup::new(completions),
                None => None,
            };
        }
        let Some(popup) = &mut self.popup else { return };
        let word = page.rect_of(&popup.replaces());
        if let Some(change) = popup.show(ui, word, &self.buffer) {
            self.change(ui.ctx(), change, commands);
        }
    }

    /// What is wrong under the pointer, else what the word there means.
    fn tooltips(&mut self, ui: &Ui, session: &Session, page: &Page<'_>, gutter: Rect, own: &[(&Problem, &Place)]) {
        let Some(pos) = ui.input(|i| i.pointer.hover_pos()) else { return };
        let problem = page.problem_at(pos, gutter, own);
        let byte = page.byte_at(pos).filter(|_| self.popup.is_none() && self.handle.is_none());
        let meaning = byte.and_then(|byte| self.assist(session).meaning(byte));
        let rested = ui.input(|i| i.pointer.time_since_last_movement() > REST && !i.pointer.any_down());
        if meaning.is_some() && !rested {
            ui.ctx().request_repaint_after_secs(REST);
        }
        let meaning = meaning.filter(|_| rested);
        if problem.is_none() && meaning.is_none() {
            return;
        }
        let salt = id().with("tooltip");
        egui::Tooltip::always_open(ui.ctx().clone(), ui.layer_id(), salt, egui::PopupAnchor::Pointer).gap(14.0).show(
            |ui| {
                if let Some(problem) = problem {
                    let color = theme::severity(ui.visuals(), problem.diagnostic.severity);
                    ui.label(RichText::new(&problem.diagnostic.message).color(color));
                    messages::details(ui, session, problem, &mut Vec::new());
                }
                if problem.is_some() && meaning.is_some() {
                    ui.separator();
                }
                if let Some(meaning) = &meaning {
                    let font = TextStyle::Monospace.resolve(ui.style());
                    for line in meaning.usage.lines().flat_map(|line| line.split("    ")) {
                        ui.label(color(line, ui.visuals().dark_mode, &font));
                    }
                    if !meaning.doc.is_empty() {
                        ui.label(&meaning.doc);
                    }
                }
            },
        );
    }

    /// The handle of the number under the pointer.
    fn tune(&mut self, ui: &Ui, page: &Page<'_>, over_text: bool, commands: &mut Vec<Command>) {
        let dragged = self.handle.as_ref().is_some_and(tuning::Handle::is_dragged);
        let pos = ui.input(|i| i.pointer.hover_pos()).filter(|_| over_text && !dragged && self.popup.is_none());
        let number = pos.and_then(|pos| number_at(page.text, page.byte_at(pos)?));
        if let (Some(number), Some(pos)) = (number, pos) {
            let rect = page.rect_of(&number.range);
            if rect.contains(pos) && self.handle.is_none() {
                if tuning::Handle::may_come(ui) {
                    self.handle = Some(tuning::Handle::new(number, rect, page.text, tuning::is_direct(ui)));
                } else {
                    ui.ctx().request_repaint_after_secs(0.3);
                }
            }
        }
        let mut stays = true;
        if let Some(text) = self.handle.as_mut().and_then(|handle| handle.show(ui, &mut stays)) {
            self.buffer = text;
            commands.push(Command::Tune(self.buffer.as_str().into()));
        }
        if !stays {
            self.handle = None;
        }
    }
}

fn own_problems(session: &Session) -> Vec<(&Problem, &Place)> {
    let place = |problem: &'_ Problem| problem.place.as_ref().is_some_and(|place| place.own);
    let own = session.problems().iter().filter(|p| place(p));
    own.filter_map(|problem| Some((problem, problem.place.as_ref()?))).collect()
}

fn char_range(text: &str, range: &Range<usize>) -> CCursorRange {
    CCursorRange::two(CCursor::new(char_of(text, range.start)), CCursor::new(char_of(text, range.end)))
}

/// Colours of a text.
pub fn color(text: &str, dark: bool, font: &FontId) -> LayoutJob {
    let plain = theme::token(dark, vv::syntax::TokenClass::Name);
    let mut job = LayoutJob::default();
    let mut push = |range: Range<usize>, color: Color32, italics: bool| {
        if let Some(part) = text.get(range) {
            job.append(part, 0.0, TextFormat { font_id: font.clone(), color, italics, ..Default::default() });
        }
    };
    let mut end = 0;
    for (range, class) in vv::syntax::highlight(text) {
        if range.start < end || text.get(range.clone()).is_none() {
            continue;
        }
        push(end..range.start, plain, false);
        let italics = class == vv::syntax::TokenClass::Comment;
        end = range.end;
        push(range, theme::token(dark, class), italics);
    }
    push(end..text.len(), plain, false);
    job
}

fn place_cursor(ui: &Ui, output: &TextEditOutput, text: &str, reveal: &Reveal) {
    let range = char_range(text, &reveal.range);
    let mut state = output.state.clone();
    state.cursor.set_char_range(Some(range));
    state.store(ui.ctx(), id());
    if reveal.focus {
        ui.memory_mut(|m| m.request_focus(id()));
    }
    if reveal.range == (0..0) {
        ui.scroll_to_rect(output.response.response.rect.expand(MARGIN.into()), Some(Align::Min));
        return;
    }
    let rect = output.galley.pos_from_cursor(range.secondary).translate(output.galley_pos.to_vec2());
    // No farther to the right than is needed, for the beginnings of lines tell where one is; what is out of sight comes
    // to the middle.
    let seen = ui.clip_rect().y_range().contains(rect.top()) && ui.clip_rect().y_range().contains(rect.bottom());
    let around = if seen { 20.0 } else { ui.clip_rect().height() / 2.0 - rect.height() };
    ui.scroll_to_rect(rect.expand2(vec2(60.0, around.max(20.0))), None);
}
