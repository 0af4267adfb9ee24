//! The pictures: one, or two side by side with a line of title each.

use std::sync::Arc;

use eframe::egui::{
    self, Align, Button, CentralPanel, Frame, Layout, Panel, RichText, Sense, Stroke, StrokeKind, Ui, WidgetInfo,
};
use eframe::egui_wgpu::RenderState;

use super::theme;
use super::viewport::Viewport;
use crate::command::{Command, PairAction};
use crate::render::RenderError;
use crate::session::{Origin, Session};

/// The panel's own state: what is seen at the left, or alone, and at the right.
pub struct Pictures {
    left: Viewport,
    right: Viewport,
}

impl Pictures {
    /// On the window's device. `wake` is called, from another thread, when there is more to show.
    ///
    /// # Errors
    /// If the driver refuses a pipeline.
    pub fn new(state: &RenderState, wake: &Arc<dyn Fn() + Send + Sync>) -> Result<Self, RenderError> {
        let viewport = || Viewport::new(state.clone(), Arc::clone(wake));
        Ok(Self { left: viewport()?, right: viewport()? })
    }

    /// Shows them.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session, commands: &mut Vec<Command>) {
        let Some(other_is_right) = session.beside().map(|beside| beside.right) else {
            CentralPanel::default().frame(Frame::NONE).show(ui, |ui| self.left.show(ui, session, "Viewport", commands));
            return;
        };
        let width = ui.available_width();
        Panel::left("left picture")
            .frame(Frame::NONE)
            .default_size(width / 2.0)
            .size_range((width * 0.2)..=(width * 0.8))
            .show(ui, |ui| {
                side(ui, &mut self.left, "Left viewport", session, other_is_right, commands);
            });
        CentralPanel::default().frame(Frame::NONE).show(ui, |ui| {
            side(ui, &mut self.right, "Right viewport", session, !other_is_right, commands);
        });
    }
}

/// One of two. What is done to the one without keys is for it; pressing into it gives it the keys.
fn side(
    ui: &mut Ui,
    viewport: &mut Viewport,
    name: &str,
    session: &mut Session,
    has_keys: bool,
    commands: &mut Vec<Command>,
) {
    let rect = ui.max_rect();
    let pressed = ui
        .input(|i| i.pointer.any_pressed() && i.pointer.interact_pos().is_some_and(|pos| rect.contains(pos)))
        && ui.rect_contains_pointer(rect);
    if has_keys {
        Panel::top(format!("title of {name}")).frame(theme::bar(ui)).show(ui, |ui| title(ui, session, true, commands));
        CentralPanel::default().frame(Frame::NONE).show(ui, |ui| viewport.show(ui, session, name, commands));
        let frame = Stroke::new(2.0, ui.visuals().hyperlink_color.gamma_multiply(0.7));
        ui.painter().rect_stroke(rect, 0.0, frame, StrokeKind::Inside);
        return;
    }
    let Some(beside) = session.beside_mut() else { return };
    Panel::top(format!("title of {name}"))
        .frame(theme::bar(ui))
        .show(ui, |ui| title(ui, beside.session(), false, commands));
    let mut its = Vec::new();
    CentralPanel::default().frame(Frame::NONE).show(ui, |ui| viewport.show(ui, beside.session_mut(), name, &mut its));
    commands.extend(its.into_iter().map(|command| Command::Pair(PairAction::Other(Box::new(command)))));
    if pressed {
        commands.push(Command::Pair(PairAction::Switch));
    }
}

/// What is shown, and how to close it.
fn title(ui: &mut Ui, session: &Session, has_keys: bool, commands: &mut Vec<Command>) {
    let document = &session.document;
    let mark = if document.program.is_modified() || session.program_is_gone() { "● " } else { "" };
    let made_by = match session.origin() {
        Origin::Former => format!(" (shows {})", session.made_by()),
        _ => String::new(),
    };
    let names = [format!("{mark}{}{made_by}", document.program.name), document.mesh.name()];
    let generation = session.shown_generation();
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let close = Command::Pair(PairAction::Close);
            let response = ui.add(Button::new("×").small().frame(false));
            let name = format!("Close {}", document.program.name);
            if response.on_hover_text("close this side; the other one stays").accessible_name(name).clicked() {
                commands.extend((!has_keys).then_some(Command::Pair(PairAction::Switch)));
                commands.push(close);
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let hover = format!("{} · {} · generation {generation}", names[0], names[1]);
                let font = egui::TextStyle::Body.resolve(ui.style());
                let wide = |text: &str| {
                    ui.painter().layout_no_wrap(text.to_owned(), font.clone(), egui::Color32::WHITE).size().x
                };
                let text = fitted(&names, generation, ui.available_width(), wide);
                let text = if has_keys { RichText::new(text).strong() } else { RichText::new(text).weak() };
                let label = ui.add(egui::Label::new(text).truncate().selectable(false).sense(Sense::click()));
                let label = label.on_hover_text(hover);
                label.widget_info(|| WidgetInfo::labeled(egui::Role::Label, true, label_name(session, has_keys)));
            });
        });
    });
}

fn label_name(session: &Session, has_keys: bool) -> String {
    let document = &session.document;
    let keys = if has_keys { ", has the keys" } else { "" };
    format!("{} on {}, {}{keys}", document.program.name, document.mesh.name(), session.shown_as())
}

/// Names and generation in a line that is not wider than `room`: what does not fit is left out in the middle of the longer
/// name, never in the number.
fn fitted(names: &[String; 2], generation: u64, room: f32, wide: impl Fn(&str) -> f32) -> String {
    /// Characters that a name keeps.
    const LEAST: usize = 5;
    let number = generation.to_string();
    let mut shown = names.clone();
    for before in ["generation ", "gen. ", ""] {
        let line = |shown: &[String; 2]| format!("{} · {} · {before}{number}", shown[0], shown[1]);
        shown = names.clone();
        let mut kept = names.each_ref().map(|name| name.chars().count());
        loop {
            let text = line(&shown);
            if wide(&text) <= room {
                return text;
            }
            let longer = usize::from(wide(&shown[1]) > wide(&shown[0]));
            let Some(which) = [longer, 1 - longer].into_iter().find(|&i| kept[i] > LEAST) else { break };
            kept[which] -= 1;
            shown[which] = shortened(&names[which], kept[which]);
        }
    }
    let short = format!("{} · {number}", shown[0]);
    if wide(&short) <= room { short } else { number }
}

/// A name with so many characters, one of which stands for those left out in its middle.
fn shortened(name: &str, count: usize) -> String {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() <= count {
        return name.to_owned();
    }
    let behind = count.saturating_sub(1) / 2;
    let before = count.saturating_sub(1) - behind;
    letters[..before].iter().chain(&['…']).chain(&letters[letters.len() - behind..]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_title_loses_the_middle_of_its_names_and_never_its_number() {
        let names = ["catmull-clark.vv".to_owned(), "tetrahedron.obj".to_owned()];
        let check = |room: f32, expected: &str| {
            assert_eq!(fitted(&names, 123, room, |text| text.chars().count() as f32), expected, "{room}");
        };
        check(60.0, "catmull-clark.vv · tetrahedron.obj · generation 123");
        check(45.0, "catmul…rk.vv · tetrah…on.obj · generation 123");
        check(30.0, "ca…vv · te…bj · generation 123");
        check(24.0, "ca…vv · te…bj · gen. 123");
        check(19.0, "ca…vv · te…bj · 123");
        check(12.0, "ca…vv · 123");
        check(3.0, "123");
    }
}
