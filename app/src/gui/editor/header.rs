//! What stands above the program: its name, what can be done with it, and what has happened to its file.

use eframe::egui::{self, Margin, RichText, Ui};

use super::super::widgets;
use crate::command::Command;
use crate::session::Session;

/// Its name, whether it is saved and run, and how to.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let frame = egui::Frame::NONE.fill(ui.visuals().panel_fill).inner_margin(Margin::symmetric(12, 5));
    frame.show(ui, |ui| {
        let program = &session.document.program;
        let name = |ui: &mut Ui| {
            let name = ui.add(egui::Label::new(RichText::new(&program.name).strong()).truncate());
            name.on_hover_text(match &program.path {
                Some(path) => path.display().to_string(),
                None => "ships with vv; save it to make it yours".to_owned(),
            });
        };
        widgets::sides(ui, "program", ui.spacing().interact_size.y, name, |ui| {
            let gone = session.program_is_gone();
            if gone {
                let text = RichText::new("file gone").small().color(ui.visuals().warn_fg_color);
                ui.label(text).on_hover_text("it was deleted or renamed; saving writes it anew");
            } else if program.is_modified() {
                ui.label(RichText::new("unsaved").small().color(ui.visuals().warn_fg_color));
            }
            if session.text_waits() {
                let response = ui.add(egui::Button::new("Run").small()).accessible_name("Run the changed text");
                if response.on_hover_text("the text has changed since it was run (F5)").clicked() {
                    commands.push(Command::Run);
                }
            }
            let needs = program.is_modified() || program.path.is_none() || gone;
            let response = ui.add_enabled(needs, egui::Button::new("Save"));
            let response = response.accessible_name("Save the program");
            if response.on_hover_ui(|ui| widgets::tooltip(ui, &Command::Save)).clicked() {
                commands.push(Command::Save);
            }
        });
    });
    ui.painter().hline(
        ui.max_rect().x_range(),
        ui.cursor().top() - ui.spacing().item_spacing.y,
        ui.visuals().widgets.noninteractive.bg_stroke,
    );
    ui.add_space(-ui.spacing().item_spacing.y);
}

/// Asks which text counts, where the file has changed beside unsaved work.
pub fn conflict(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let color = ui.visuals().warn_fg_color;
    let frame = egui::Frame::NONE.fill(color.gamma_multiply(0.16)).inner_margin(Margin::symmetric(12, 5));
    frame.show(ui, |ui| {
        ui.horizontal(|ui| {
            let text = RichText::new("The file has changed on disk.").color(color);
            let text = |ui: &mut Ui| _ = ui.add(egui::Label::new(text).truncate());
            widgets::sides(ui, "conflict", ui.spacing().interact_size.y, text, |ui| {
                widgets::button(ui, session, commands, Command::TakeFromDisk);
                widgets::button(ui, session, commands, Command::KeepMine);
            });
        });
    });
    ui.add_space(-ui.spacing().item_spacing.y);
}
