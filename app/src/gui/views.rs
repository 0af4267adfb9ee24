//! Viewpoints that were given names.

use eframe::egui::{Align, Align2, Button, Id, Key, Layout, TextEdit, Ui};

use crate::command::{Command, ViewAction};
use crate::session::Session;

/// Shows them as a menu.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    ui.set_width(220.0);
    for (name, camera) in &session.document.views {
        ui.horizontal(|ui| {
            let on = *camera == session.aim();
            if ui.selectable_label(on, name).on_hover_text("look from there").clicked() {
                commands.push(Command::View(ViewAction::Use(name.clone())));
                ui.close();
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let forget = ui.small_button("×").on_hover_text("forget this viewpoint");
                if forget.accessible_name(format!("Forget {name}")).clicked() {
                    commands.push(Command::View(ViewAction::Forget(name.clone())));
                }
            });
        });
    }
    if !session.document.views.is_empty() {
        ui.separator();
    }
    ui.horizontal(|ui| {
        let id = Id::unique("name of a viewpoint");
        let mut name: String = ui.data(|d| d.get_temp(id)).unwrap_or_default();
        let field = ui.add(
            TextEdit::singleline(&mut name)
                .hint_text(super::widgets::hint("name"))
                .desired_width(100.0)
                .align(Align2::LEFT_CENTER),
        );
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        field.accessible_name("Name of the viewpoint");
        let named = !name.trim().is_empty();
        let keep = ui.add_enabled(named, Button::new("Keep")).on_hover_text("keep the viewpoint as it is now");
        if keep.clicked() || entered && named {
            commands.push(Command::View(ViewAction::Save(name.trim().to_owned())));
            name.clear();
        }
        ui.data_mut(|d| d.insert_temp(id, name));
    });
}
