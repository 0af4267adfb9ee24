//! A picture without the mesh.

use eframe::egui::{Align, Frame, Layout, Margin, Rect, Ui, UiBuilder, vec2};

use crate::command::Command;
use crate::gui::widgets::{first_choice, keys, tooltip};

/// Says why, and offers what helps.
pub fn show(ui: &mut Ui, rect: Rect, why: &str, help: Option<Command>, commands: &mut Vec<Command>) {
    let size = vec2((rect.width() - 20.0).min(290.0), 76.0);
    let place = Rect::from_center_size(rect.center(), size);
    let builder = UiBuilder::new().max_rect(place).layout(Layout::top_down(Align::Center));
    ui.scope_builder(builder, |ui| {
        Frame::NONE
            .fill(ui.visuals().window_fill.gamma_multiply(0.94))
            .stroke(ui.visuals().window_stroke)
            .corner_radius(8)
            .inner_margin(Margin::symmetric(12, 10))
            .show(ui, |ui| {
                ui.label(why);
                let Some(command) = help else { return };
                let description = command.describe();
                let key = description.shortcuts.first().map(|shortcut| format!(" ({})", keys(ui, shortcut)));
                let button = first_choice(ui, &format!("{}{}", description.label, key.unwrap_or_default()));
                if ui.add(button).on_hover_ui(|ui| tooltip(ui, &command)).clicked() {
                    commands.push(command);
                }
            });
    });
}
