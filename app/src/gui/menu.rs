//! The menu bar.

use eframe::egui::{MenuBar, Ui};

use super::views;
use super::widgets::menu_item;
use crate::command::{Command, MENUS, Menu, outer};
use crate::document::MeshSource;
use crate::gallery::{EXHIBITS, Exhibit, Group};
use crate::library;
use crate::session::Session;

/// Shows it.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    MenuBar::new().ui(ui, |ui| {
        for menu in MENUS.iter().filter(|menu| outer(menu.title).is_none()) {
            ui.menu_button(menu.title, |ui| {
                ui.set_min_width(210.0);
                entries(ui, session, commands, menu);
                if menu.title == "File" && !session.recent().is_empty() {
                    ui.separator();
                    ui.menu_button("Open recent", |ui| recent(ui, session, commands));
                }
                if MENUS.iter().any(|inner| outer(inner.title) == Some(menu.title)) {
                    ui.separator();
                }
                for inner in MENUS.iter().filter(|inner| outer(inner.title) == Some(menu.title)) {
                    ui.menu_button(inner.title, |ui| entries(ui, session, commands, inner));
                }
                if menu.title == "Camera" {
                    ui.menu_button("Saved viewpoints", |ui| views::show(ui, session, commands));
                }
            });
            if menu.title == "File" {
                ui.menu_button("Examples", |ui| examples(ui, session, commands));
                ui.menu_button("Meshes", |ui| meshes(ui, session, commands));
            }
        }
    });
}

fn entries(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>, menu: &Menu) {
    let ticks = menu.groups.iter().copied().flatten().any(|command| command.is_on(session).is_some());
    for (i, group) in menu.groups.iter().enumerate() {
        if i > 0 {
            ui.separator();
        }
        for command in *group {
            menu_item(ui, session, commands, command.clone(), ticks);
        }
    }
}

fn recent(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    ui.set_min_width(240.0);
    for path in session.recent() {
        let response = ui.button(crate::document::file_name(path));
        if response.on_hover_text(path.display().to_string()).clicked() {
            commands.push(Command::Open(path.clone()));
            ui.close();
        }
    }
    ui.separator();
    menu_item(ui, session, commands, Command::ForgetRecent, false);
}

fn examples(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    menu_item(ui, session, commands, Command::Gallery, false);
    ui.separator();
    // Side by side, so that all have room in a small window.
    let columns: [&[Group]; 3] =
        [&[Group::Subdivision], &[Group::Beyond, Group::Fractals], &[Group::Growth, Group::Paper]];
    ui.horizontal_top(|ui| {
        for groups in columns {
            ui.vertical(|ui| {
                ui.set_width(186.0);
                for group in groups {
                    ui.weak(group.title());
                    for exhibit in EXHIBITS.iter().filter(|e| e.group == *group) {
                        example(ui, session, commands, exhibit);
                    }
                    ui.add_space(6.0);
                }
            });
        }
    });
}

fn example(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>, exhibit: &Exhibit) {
    let open = session.document.program.path.is_none() && session.document.program.name == exhibit.program;
    if ui.selectable_label(open, exhibit.program).on_hover_text(exhibit.headline()).clicked() {
        commands.push(Command::OpenExample(exhibit.program));
        ui.close();
    }
}

fn meshes(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    ui.set_min_width(180.0);
    for mesh in library::MESHES {
        let source = MeshSource::BuiltIn(mesh.name.to_owned());
        if ui.selectable_label(session.document.mesh == source, mesh.name).clicked() {
            commands.push(Command::UseMesh(source));
            ui.close();
        }
    }
    ui.separator();
    let none = session.document.mesh == MeshSource::Empty;
    let response = ui.selectable_label(none, "No mesh").on_hover_text("for programs that build their own");
    if response.clicked() {
        commands.push(Command::UseMesh(MeshSource::Empty));
        ui.close();
    }
}
