//! The program's text, coloured, with its errors where they are.

use std::ops::Range;
use std::sync::Arc;

use eframe::egui::text::{CCursor, CCursorRange, LayoutJob};
use eframe::egui::text_edit::TextEditState;
use eframe::egui::{
    self, Align, Align2, Color32, Event, FontId, Galley, Id, Key, Layout, Margin, Painter, Pos2, Rect, RichText,
    ScrollArea, Shape, Stroke, TextBuffer, TextEdit, TextFormat, TextStyle, Ui, Vec2b, pos2, vec2,
};
use vv::diagnostic::Severity;

use super::{messages, theme};
use crate::command::Command;
use crate::session::{Place, Problem, Session};

const INDENT: &str = "  ";

/// The panel's own state.
#[derive(Default)]
pub struct Editor {
    /// The text as egui edits it; follows the document.
    buffer: String,
    /// What the colours were made for, and the colours.
    colored: Option<(String, bool, LayoutJob)>,
    /// Which program it is: another one starts with a fresh undo history.
    name: Option<(String, Option<std::path::PathBuf>)>,
}

impl Editor {
    /// Shows it; brings `reveal`, a stretch of the text, in sight.
    pub fn show(&mut self, ui: &mut Ui, session: &Session, reveal: Option<Range<usize>>, commands: &mut Vec<Command>) {
        let id = Id::unique("program text");
        let program = &session.document.program;
        if self.buffer != *program.text {
            self.buffer = program.text.to_string();
        }
        let name = Some((program.name.clone(), program.path.clone()));
        if self.name != name {
            // Saving under a name is no other program.
            if self.name.is_none() || !program.saved.is_empty() && !program.is_modified() && reveal.is_some() {
                TextEditState::default().store(ui.ctx(), id);
            }
            self.name = name;
        }
        header(ui, session, commands);
        if session.text_on_disk().is_some() {
            conflict(ui, session, commands);
        }
        self.text(ui, id, session, reveal, commands);
    }

    fn text(
        &mut self,
        ui: &mut Ui,
        id: Id,
        session: &Session,
        reveal: Option<Range<usize>>,
        commands: &mut Vec<Command>,
    ) {
        let font = TextStyle::Monospace.resolve(ui.style());
        let digits = (self.buffer.lines().count() + 1).to_string().len().max(2);
        let digit = ui.fonts_mut(|f| f.glyph_width(&font, '0'));
        let gutter_width = digits as f32 * digit + 26.0;
        let all = ui.available_rect_before_wrap();
        let gutter = Rect::from_min_max(all.min, pos2(all.left() + gutter_width, all.bottom()));
        let area = Rect::from_min_max(pos2(gutter.right(), all.top()), all.max);
        indent_by_hand(ui, id, &self.buffer);
        let dark = ui.visuals().dark_mode;
        let colored = &mut self.colored;
        let mut layouter = |ui: &Ui, text: &dyn TextBuffer, _width: f32| -> Arc<Galley> {
            let text = text.as_str();
            let job = match colored {
                Some((of, was_dark, job)) if of == text && *was_dark == dark => job.clone(),
                _ => {
                    let job = color(text, dark, &font);
                    *colored = Some((text.to_owned(), dark, job.clone()));
                    job
                }
            };
            ui.fonts_mut(|f| f.layout_job(job))
        };
        let buffer = &mut self.buffer;
        let output = ui
            .scope_builder(egui::UiBuilder::new().max_rect(area), |ui| {
                ScrollArea::both().id_salt("program").auto_shrink(Vec2b::FALSE).show(ui, |ui| {
                    let current_line = ui.painter().add(Shape::Noop);
                    let output = TextEdit::multiline(buffer)
                        .id(id)
                        .code_editor()
                        .frame(egui::Frame::NONE)
                        .margin(Margin { left: 6, right: 40, top: 6, bottom: 40 })
                        .desired_width(f32::INFINITY)
                        .min_size(area.size())
                        .layouter(&mut layouter)
                        .show(ui);
                    if let Some(range) = reveal {
                        place_cursor(ui, id, &output, buffer, range);
                    }
                    (current_line, output)
                })
            })
            .inner
            .inner;
        let (current_line, output) = output;
        output.response.response.clone().accessible_name("Program text");
        if output.response.changed() {
            commands.push(Command::Edit(self.buffer.as_str().into()));
        }
        let page = Page {
            galley: &output.galley,
            origin: output.galley_pos,
            text: &self.buffer,
            clip: area.intersect(ui.clip_rect()),
        };
        let cursor_line =
            output.cursor_range.filter(|_| output.response.has_focus()).map(|range| page.row_of(range.primary));
        if let Some(row) = cursor_line.and_then(|row| page.row_rect(row)) {
            let stripe = Rect::from_x_y_ranges(area.x_range(), row.y_range());
            ui.painter()
                .with_clip_rect(area)
                .set(current_line, Shape::rect_filled(stripe, 0.0, ui.visuals().faint_bg_color));
        }
        let own: Vec<(&Problem, &Place)> = session
            .problems()
            .iter()
            .filter_map(|problem| Some((problem, problem.place.as_ref().filter(|place| place.own)?)))
            .collect();
        for (problem, place) in &own {
            page.underline(ui, problem, place);
        }
        page.line_messages(ui, &own);
        page.gutter(ui, gutter, &own, cursor_line);
        let hovered = ui.input(|i| i.pointer.hover_pos()).and_then(|pos| page.problem_at(pos, gutter, &own));
        if let Some(problem) = hovered
            && output.response.hovered() | ui.rect_contains_pointer(gutter)
        {
            egui::Tooltip::always_open(ui.ctx().clone(), ui.layer_id(), id.with("problem"), egui::PopupAnchor::Pointer)
                .gap(14.0)
                .show(|ui| {
                    let color = theme::severity(ui.visuals(), problem.diagnostic.severity);
                    ui.label(RichText::new(&problem.diagnostic.message).color(color));
                    messages::details(ui, problem, &mut Vec::new());
                });
        }
    }
}

fn header(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let frame = egui::Frame::NONE.fill(ui.visuals().panel_fill).inner_margin(Margin::symmetric(12, 5));
    frame.show(ui, |ui| {
        ui.horizontal(|ui| {
            let program = &session.document.program;
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let response =
                    ui.add_enabled(program.is_modified() || program.path.is_none(), egui::Button::new("Save"));
                let response = response.accessible_name("Save the program");
                if response.on_hover_ui(|ui| super::widgets::tooltip(ui, &Command::Save)).clicked() {
                    commands.push(Command::Save);
                }
                if program.is_modified() {
                    ui.label(RichText::new("unsaved").small().color(ui.visuals().warn_fg_color));
                }
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    let name = ui.add(egui::Label::new(RichText::new(&program.name).strong()).truncate());
                    name.on_hover_text(match &program.path {
                        Some(path) => path.display().to_string(),
                        None => "ships with vv; save it to make it yours".to_owned(),
                    });
                });
            });
        });
    });
    ui.painter().hline(
        ui.max_rect().x_range(),
        ui.cursor().top() - ui.spacing().item_spacing.y,
        ui.visuals().widgets.noninteractive.bg_stroke,
    );
    ui.add_space(-ui.spacing().item_spacing.y);
}

fn conflict(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let color = ui.visuals().warn_fg_color;
    let frame = egui::Frame::NONE.fill(color.gamma_multiply(0.16)).inner_margin(Margin::symmetric(12, 5));
    frame.show(ui, |ui| {
        ui.horizontal(|ui| {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                super::widgets::button(ui, session, commands, Command::KeepMine);
                super::widgets::button(ui, session, commands, Command::TakeFromDisk);
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    ui.add(egui::Label::new(RichText::new("The file has changed on disk.").color(color)).truncate());
                });
            });
        });
    });
    ui.add_space(-ui.spacing().item_spacing.y);
}

/// Colours of a text.
fn color(text: &str, dark: bool, font: &FontId) -> LayoutJob {
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

/// Tab inserts spaces, Enter keeps the indentation and deepens it after `{`, `}` on an empty line takes it back: what
/// egui would insert is replaced before it sees the keys.
fn indent_by_hand(ui: &Ui, id: Id, text: &str) {
    if !ui.memory(|m| m.has_focus(id)) {
        return;
    }
    let Some(range) = TextEdit::load_state(ui.ctx(), id).and_then(|s| s.cursor.char_range()) else { return };
    let cursor = byte_of(text, range.as_sorted_char_range().start.0);
    let line = text.get(..cursor).unwrap_or_default().rsplit('\n').next().unwrap_or_default();
    let indentation: String = line.chars().take_while(|c| *c == ' ' || *c == '\t').collect();
    ui.input_mut(|input| {
        for event in &mut input.events {
            match event {
                Event::Key { key: Key::Tab, pressed: true, modifiers, .. } if modifiers.is_none() => {
                    *event = Event::Text(INDENT.to_owned());
                }
                Event::Key { key: Key::Enter, pressed: true, modifiers, .. } if modifiers.is_none() => {
                    let deeper = if line.trim_end().ends_with('{') { INDENT } else { "" };
                    let inserted = format!("\n{indentation}{deeper}");
                    if inserted.len() > 1 {
                        *event = Event::Text(inserted);
                    }
                }
                _ => {}
            }
        }
    });
}

fn place_cursor(ui: &Ui, id: Id, output: &egui::text_edit::TextEditOutput, text: &str, range: Range<usize>) {
    let (start, end) = (CCursor::new(char_of(text, range.start)), CCursor::new(char_of(text, range.end)));
    let mut state = output.state.clone();
    state.cursor.set_char_range(Some(CCursorRange::two(start, end)));
    state.store(ui.ctx(), id);
    let rect = output.galley.pos_from_cursor(start).translate(output.galley_pos.to_vec2());
    if range != (0..0) {
        ui.memory_mut(|m| m.request_focus(id));
    }
    ui.scroll_to_rect(rect.expand2(vec2(60.0, 20.0)), Some(Align::Center));
}

/// The text as it stands on the screen.
struct Page<'a> {
    galley: &'a Galley,
    origin: Pos2,
    text: &'a str,
    clip: Rect,
}

impl Page<'_> {
    /// Rows are lines: nothing wraps.
    fn row_rect(&self, row: usize) -> Option<Rect> {
        self.galley.rows.get(row).map(|r| r.rect().translate(self.origin.to_vec2()))
    }

    fn row_of(&self, cursor: CCursor) -> usize {
        self.galley.layout_from_cursor(cursor).row
    }

    /// What a place covers on its first line; at least a character wide.
    fn rect_of(&self, place: &Place) -> Rect {
        let start = floor_char_boundary(self.text, place.range.start);
        let end = floor_char_boundary(self.text, place.range.end).max(start);
        let line_end = self.text[start..].find('\n').map_or(self.text.len(), |i| start + i);
        let at = |byte| self.galley.pos_from_cursor(CCursor::new(char_of(self.text, byte)));
        let (from, to) = (at(start), at(end.min(line_end)));
        let right = to.right().max(from.left() + 7.0);
        Rect::from_min_max(from.min, pos2(right, from.max.y)).translate(self.origin.to_vec2())
    }

    fn underline(&self, ui: &Ui, problem: &Problem, place: &Place) {
        let rect = self.rect_of(place);
        let color = theme::severity(ui.visuals(), problem.diagnostic.severity);
        wave(&ui.painter().with_clip_rect(self.clip), rect, color);
    }

    /// The worst message of each line, after its end.
    fn line_messages(&self, ui: &Ui, problems: &[(&Problem, &Place)]) {
        let painter = ui.painter().with_clip_rect(self.clip);
        let font = TextStyle::Small.resolve(ui.style());
        for row in rows_with_problems(problems) {
            let Some((problem, _)) = worst(problems, row) else { continue };
            let Some(rect) = self.row_rect(row as usize - 1) else { continue };
            if problem.diagnostic.severity < Severity::Warning {
                continue;
            }
            let color = theme::severity(ui.visuals(), problem.diagnostic.severity).gamma_multiply(0.85);
            let at = pos2(rect.right() + 22.0, rect.center().y);
            painter.text(at, Align2::LEFT_CENTER, &problem.diagnostic.message, font.clone(), color);
        }
    }

    fn gutter(&self, ui: &Ui, gutter: Rect, problems: &[(&Problem, &Place)], cursor_line: Option<usize>) {
        let painter = ui.painter().with_clip_rect(gutter.intersect(ui.clip_rect()));
        let font = FontId::monospace(TextStyle::Monospace.resolve(ui.style()).size - 1.5);
        for row in 0..self.galley.rows.len() {
            let Some(rect) = self.row_rect(row) else { break };
            if rect.bottom() < gutter.top() {
                continue;
            }
            if rect.top() > gutter.bottom() {
                break;
            }
            let problem = worst(problems, row as u32 + 1);
            let color = match problem {
                Some((problem, _)) => theme::severity(ui.visuals(), problem.diagnostic.severity),
                None if cursor_line == Some(row) => ui.visuals().text_color(),
                None => ui.visuals().weak_text_color().gamma_multiply(0.75),
            };
            if problem.is_some() {
                painter.circle_filled(pos2(gutter.left() + 9.0, rect.center().y), 3.5, color);
            }
            let at = pos2(gutter.right() - 8.0, rect.center().y);
            painter.text(at, Align2::RIGHT_CENTER, (row + 1).to_string(), font.clone(), color);
        }
    }

    fn problem_at<'p>(&self, pos: Pos2, gutter: Rect, problems: &[(&'p Problem, &Place)]) -> Option<&'p Problem> {
        if gutter.contains(pos) {
            let row = (0..self.galley.rows.len())
                .find(|&row| self.row_rect(row).is_some_and(|r| r.y_range().contains(pos.y)))?;
            return worst(problems, row as u32 + 1).map(|(problem, _)| problem);
        }
        let near = |place: &Place| self.clip.contains(pos) && self.rect_of(place).expand(1.0).contains(pos);
        problems.iter().find(|(_, place)| near(place)).map(|(problem, _)| *problem)
    }
}

fn rows_with_problems(problems: &[(&Problem, &Place)]) -> std::collections::BTreeSet<u32> {
    problems.iter().map(|(_, place)| place.start.line).collect()
}

fn worst<'p, 'q>(problems: &[(&'p Problem, &'q Place)], line: u32) -> Option<(&'p Problem, &'q Place)> {
    let here = problems.iter().filter(|(_, place)| place.start.line == line);
    // The first of the worst.
    here.rev().max_by_key(|(problem, _)| problem.diagnostic.severity).copied()
}

fn wave(painter: &Painter, rect: Rect, color: Color32) {
    const STEP: f32 = 2.0;
    let y = rect.bottom() - 1.0;
    let count = (rect.width() / STEP).ceil() as usize;
    let points =
        (0..=count).map(|i| pos2(rect.left() + i as f32 * STEP, y + if i % 2 == 0 { 1.0 } else { -1.0 })).collect();
    painter.add(Shape::line(points, Stroke::new(1.2, color)));
}

fn floor_char_boundary(text: &str, byte: usize) -> usize {
    let byte = byte.min(text.len());
    (0..=byte).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

fn char_of(text: &str, byte: usize) -> usize {
    text[..floor_char_boundary(text, byte)].chars().count()
}

fn byte_of(text: &str, index: usize) -> usize {
    text.char_indices().nth(index).map_or(text.len(), |(byte, _)| byte)
}
