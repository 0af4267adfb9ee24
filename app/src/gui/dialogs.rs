//! Questions that must be answered before anything else.

use eframe::egui::{Context, Frame, Id, Key, Margin, Modal, Ui};

use super::gallery::Gallery;
use super::{cheat_sheet, palette, preferences, saving, selection, type_path, widgets};
use crate::command::{Answer, Command};
use crate::session::{Dialog, Session};

/// Shows the one that is open.
pub fn show(ctx: &Context, session: &mut Session, gallery: &mut Gallery, commands: &mut Vec<Command>) {
    match &session.dialog {
        Some(Dialog::Palette { .. }) => return palette::show(ctx, session, commands),
        Some(Dialog::CheatSheet { .. }) => return cheat_sheet::show(ctx, session, commands),
        Some(Dialog::SelectVertex { .. }) => return selection::ask(ctx, session, commands),
        Some(Dialog::Preferences) => return preferences::show(ctx, session, commands),
        Some(Dialog::Picture) => return saving::show(ctx, session, commands),
        Some(Dialog::Gallery { .. }) => return gallery.show(ctx, session, commands),
        _ => {}
    }
    let project = session.project_path().map(crate::document::file_name);
    let name = project.clone().unwrap_or_else(|| session.document.program.name.clone());
    let Some(dialog) = &mut session.dialog else { return };
    let mut typed = None;
    let enter = ctx.input(|i| i.key_pressed(Key::Enter)) && ctx.memory(|m| m.focused().is_none());
    let frame = Frame::window(&ctx.global_style()).inner_margin(Margin::same(18));
    let response = Modal::new(Id::unique("dialog")).frame(frame).show(ctx, |ui| {
        ui.set_width(380.0_f32.min(ui.ctx().content_rect().width() - 60.0));
        match dialog {
            Dialog::Unsaved { .. } => unsaved(ui, &name, project.is_some(), enter, commands),
            Dialog::TypePath { purpose, path, trouble, .. } => {
                typed = type_path::show(ui, *purpose, path, trouble.as_ref(), commands);
            }
            Dialog::Recover { name } => recover(ui, name, enter, commands),
            _ => {} // shown above
        }
    });
    if response.should_close() {
        commands.push(Command::CloseDialog);
    }
    if let Some(wanted) = typed {
        session.path_typed(wanted);
    }
}

fn unsaved(ui: &mut Ui, name: &str, is_project: bool, enter: bool, commands: &mut Vec<Command>) {
    ui.heading(format!("Save changes to {name}?"));
    ui.add_space(4.0);
    ui.label(if is_project {
        "What has changed since the project was saved would be lost."
    } else {
        "The text in the editor is not saved and would be lost."
    });
    ui.add_space(12.0);
    ui.horizontal(|ui| {
        if ui.add(widgets::first_choice(ui, "Save")).clicked() || enter {
            commands.push(Command::AnswerUnsaved(Answer::Save));
        }
        if ui.button("Don't save").clicked() {
            commands.push(Command::AnswerUnsaved(Answer::Discard));
        }
        if ui.button("Cancel").clicked() {
            commands.push(Command::CloseDialog);
        }
    });
}

fn recover(ui: &mut Ui, name: &str, enter: bool, commands: &mut Vec<Command>) {
    ui.heading("Bring back unsaved work?");
    ui.add_space(4.0);
    ui.label(format!("vv ended unexpectedly while {name} had changes that were not saved. They were kept."));
    ui.add_space(12.0);
    ui.horizontal(|ui| {
        if ui.add(widgets::first_choice(ui, "Bring back")).clicked() || enter {
            commands.push(Command::AnswerRecovery(true));
        }
        if ui.button("Throw away").clicked() {
            commands.push(Command::AnswerRecovery(false));
        }
        if ui.button("Later").clicked() {
            commands.push(Command::CloseDialog);
        }
    });
}
