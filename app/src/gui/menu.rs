//! The menu bar.

use std::path::Path;
use std::sync::LazyLock;

use eframe::egui::{MenuBar, Ui};

use super::widgets::menu_item;
use crate::command::{Command, Panel, ThemeChoice};
use crate::document::{MeshSource, NOWHERE};
use crate::files;
use crate::library::{self, Shipped};
use crate::session::{Purpose, Session};

/// Shows it.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let list = |ui: &mut Ui, commands: &mut Vec<Command>, entries: &[Option<Command>]| {
        let ticks = entries.iter().flatten().any(|command| command.is_on(session).is_some());
        for entry in entries {
            match entry {
                Some(command) => menu_item(ui, session, commands, command.clone(), ticks),
                None => drop(ui.separator()),
            }
        }
    };
    MenuBar::new().ui(ui, |ui| {
        ui.menu_button("File", |ui| {
            ui.set_min_width(220.0);
            let entries = [
                Some(Command::NewProgram),
                Some(Command::Choose(Purpose::OpenProgram)),
                Some(Command::Choose(Purpose::OpenMesh)),
                None,
                Some(Command::Save),
                Some(Command::Choose(Purpose::SaveProgram)),
                Some(Command::Choose(Purpose::ExportMesh)),
                None,
                Some(Command::Quit),
            ];
            list(ui, commands, &entries);
        });
        ui.menu_button("Examples", |ui| {
            ui.set_min_width(180.0);
            for example in EXAMPLES.iter() {
                let open = session.document.program.path.is_none() && session.document.program.name == example.name;
                if ui.selectable_label(open, example.name).on_hover_text(headline(example.text)).clicked() {
                    commands.push(Command::OpenExample(example.name));
                    ui.close();
                }
            }
        });
        ui.menu_button("Meshes", |ui| {
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
        });
        ui.menu_button("Run", |ui| {
            ui.set_min_width(200.0);
            let entries = [
                Some(Command::Step),
                Some(Command::Back),
                Some(Command::Rewind),
                None,
                Some(Command::Play),
                Some(Command::Stop),
                None,
                Some(Command::Run),
            ];
            list(ui, commands, &entries);
        });
        ui.menu_button("View", |ui| {
            ui.set_min_width(200.0);
            let entries = [
                Some(Command::Fit),
                Some(Command::CopyImage),
                None,
                Some(Command::Faces),
                Some(Command::Smooth),
                Some(Command::Edges),
                Some(Command::Vertices),
                Some(Command::Control),
                None,
                Some(Command::Toggle(Panel::Program)),
                Some(Command::Toggle(Panel::Messages)),
                Some(Command::Toggle(Panel::Inspector)),
                None,
                Some(Command::SetTheme(ThemeChoice::System)),
                Some(Command::SetTheme(ThemeChoice::Light)),
                Some(Command::SetTheme(ThemeChoice::Dark)),
            ];
            list(ui, commands, &entries);
        });
    });
}

/// The programs that do something by themselves, which those made to be included do not.
static EXAMPLES: LazyLock<Vec<&Shipped>> = LazyLock::new(|| {
    let does_something = |shipped: &&Shipped| {
        let (compilation, _) = files::compile(&Path::new(NOWHERE).join(shipped.name), shipped.text);
        compilation.program.is_some_and(|program| !program.rules.is_empty() || program.start.is_some())
    };
    library::PROGRAMS.iter().filter(does_something).collect()
});

/// The first comment of a program.
fn headline(text: &str) -> String {
    let lines = text.lines().map(str::trim).take_while(|line| line.starts_with("//"));
    lines.map(|line| line.trim_start_matches('/').trim()).collect::<Vec<_>>().join(" ")
}
