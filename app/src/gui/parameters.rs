//! The parameters of the program: sliders, boxes and fields, and sets of values under a name.

use eframe::egui::{self, Align, Align2, Button, DragValue, Id, Key, Layout, RichText, Slider, TextEdit, Ui};
use vv::ir::{Global, Param, Program};
use vv::mesh::Value;
use vv::source::FileId;

use super::widgets::{bold, tooltip};
use crate::command::Command;
use crate::session::Session;
use crate::worker::fits;

/// Shows them, if there are any.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let Some(program) = session.program() else { return };
    if program.params().next().is_none() {
        return;
    }
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        // The narrowest panel has room for all three.
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.spacing_mut().button_padding.x = 5.0;
        bold(ui, "Parameters");
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let reset = Command::ResetParams;
            let button = ui.add_enabled(reset.is_enabled(session), Button::new("Reset")).accessible_name("Reset all");
            if button.on_hover_ui(|ui| tooltip(ui, &reset)).clicked() {
                commands.push(reset);
            }
            let menu = ui.menu_button("Sets", |ui| sets(ui, session, commands)).response;
            menu.on_hover_text("keep the values under a name, and bring them back");
        });
    });
    let mut file = FileId::MAIN;
    for (_, global, param) in program.params() {
        if global.span.file != file {
            file = global.span.file;
            if let Some(source) = program.sources.file(file) {
                let name = source.name.rsplit(['/', '\\']).next().unwrap_or_default();
                ui.label(RichText::new(format!("of {name}")).small().weak());
            }
        }
        // What the program leaves out is not shown either.
        let given = session.document.params.get(&global.name).copied().filter(|&v| fits(global, param, v));
        let row = Row { global, param, value: given.unwrap_or(param.default), note: note(program, global) };
        let changed = ui.push_id(&global.name, |ui| row.show(ui, given.is_some(), commands)).inner;
        if let Some(value) = changed {
            // At its default a parameter follows the program again.
            commands.push(if value == param.default {
                Command::ResetParam(global.name.clone())
            } else {
                Command::SetParam(global.name.clone(), value)
            });
        }
    }
    ui.separator();
}

/// Values that were given names.
fn sets(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    ui.set_width(220.0);
    for (name, values) in &session.document.param_sets {
        ui.horizontal(|ui| {
            let on = *values == session.document.params;
            if ui.selectable_label(on, name).on_hover_text("bring these values back").clicked() {
                commands.push(Command::UseParams(name.clone()));
                ui.close();
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let forget = ui.small_button("×").on_hover_text("forget these values");
                if forget.accessible_name(format!("Forget {name}")).clicked() {
                    commands.push(Command::ForgetParams(name.clone()));
                }
            });
        });
    }
    if !session.document.param_sets.is_empty() {
        ui.separator();
    }
    ui.horizontal(|ui| {
        let id = Id::unique("name of a set");
        let mut name: String = ui.data(|d| d.get_temp(id)).unwrap_or_default();
        let field = ui.add(
            TextEdit::singleline(&mut name)
                .hint_text(super::widgets::hint("name"))
                .desired_width(100.0)
                .align(Align2::LEFT_CENTER),
        );
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        field.accessible_name("Name of the set");
        let named = !name.trim().is_empty();
        let keep = ui.add_enabled(named, Button::new("Keep")).on_hover_text("keep the values as they are now");
        if keep.clicked() || entered && named {
            commands.push(Command::SaveParams(name.trim().to_owned()));
            name.clear();
        }
        ui.data_mut(|d| d.insert_temp(id, name));
    });
}

/// A parameter.
struct Row<'a> {
    global: &'a Global,
    param: &'a Param,
    value: Value,
    /// What the program's text says of it.
    note: Option<String>,
}

impl Row<'_> {
    /// A field for it; its value if the user has changed it.
    fn show(&self, ui: &mut Ui, given: bool, commands: &mut Vec<Command>) -> Option<Value> {
        match (self.value, self.param.range) {
            (Value::Bool(mut on), _) => {
                let mut changed = None;
                ui.horizontal(|ui| {
                    let field = self.explained(super::widgets::check_box(ui, &mut on, &self.global.name));
                    changed = field.changed().then_some(Value::Bool(on));
                    self.reset(ui, given, commands);
                });
                changed
            }
            (Value::Int(mut x), range) => {
                let label = self.label(ui, given, commands);
                let response = match range {
                    Some((Value::Int(low), Value::Int(high))) => slider(ui, Slider::new(&mut x, low..=high)),
                    _ => ui.add(DragValue::new(&mut x).speed(0.1)),
                };
                response.labelled_by(label.id).changed().then_some(Value::Int(x))
            }
            (Value::Double(mut x), range) => {
                let label = self.label(ui, given, commands);
                let response = match range {
                    Some((Value::Double(low), Value::Double(high))) => {
                        slider(ui, Slider::new(&mut x, low..=high).smart_aim(true).max_decimals(6))
                    }
                    _ => ui.add(DragValue::new(&mut x).speed(0.01).max_decimals(6)),
                };
                response.labelled_by(label.id).changed().then_some(Value::Double(x))
            }
            (Value::Vec(mut v), _) => {
                let label = self.label(ui, given, commands);
                let mut changed = false;
                ui.horizontal(|ui| {
                    for x in [&mut v.x, &mut v.y, &mut v.z] {
                        let field = ui.add(DragValue::new(x).speed(0.01).max_decimals(4));
                        changed |= field.labelled_by(label.id).changed();
                    }
                });
                changed.then_some(Value::Vec(v))
            }
            (Value::Vertex(_), _) => None, // no literal, no field
        }
    }

    /// Its name, and how to get the program's own value back.
    fn label(&self, ui: &mut Ui, given: bool, commands: &mut Vec<Command>) -> egui::Response {
        ui.horizontal(|ui| {
            let label = self.explained(ui.label(&self.global.name));
            self.reset(ui, given, commands);
            label
        })
        .inner
    }

    fn explained(&self, response: egui::Response) -> egui::Response {
        match &self.note {
            Some(note) => response.on_hover_text(note),
            None => response,
        }
    }

    fn reset(&self, ui: &mut Ui, given: bool, commands: &mut Vec<Command>) {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            // Its room is kept, so that nothing moves while a slider does.
            let reset = ui.add_visible(given, Button::new(RichText::new("reset").small()).small().frame(false));
            let name = format!("Reset {}", self.global.name);
            if reset.on_hover_text("as the program says").accessible_name(name).clicked() {
                commands.push(Command::ResetParam(self.global.name.clone()));
            }
        });
    }
}

fn slider(ui: &mut Ui, slider: Slider<'_>) -> egui::Response {
    ui.spacing_mut().slider_width = (ui.available_width() - 66.0).max(40.0);
    ui.add(slider)
}

/// The comment behind a declaration, or the lines of comment above it.
fn note(program: &Program, global: &Global) -> Option<String> {
    let text = &program.sources.file(global.span.file)?.text;
    let (start, end) = (global.span.start as usize, global.span.end as usize);
    let behind = text.get(end..)?.lines().next().unwrap_or_default();
    if let Some((_, comment)) = behind.split_once("//") {
        return Some(comment.trim().to_owned());
    }
    let line = text.get(..start)?.rfind('\n').map_or(0, |i| i + 1);
    let above = text[..line].lines().rev().map(str::trim).take_while(|line| line.starts_with("//"));
    let mut lines: Vec<&str> = above.map(|line| line.trim_start_matches('/').trim()).collect();
    lines.reverse();
    (!lines.is_empty()).then(|| lines.join(" "))
}
