//! A picture that the mesh has left.

use eframe::egui::{Align, Frame, Layout, Margin, Rect, Ui, UiBuilder, vec2};

use crate::command::Command;
use crate::gui::widgets::{first_choice, keys, tooltip};

/// Says so, and offers to go where it is.
pub fn show(ui: &mut Ui, rect: Rect, commands: &mut Vec<Command>) {
    let size = vec2((rect.width() - 20.0).min(240.0), 76.0);
    let place = Rect::from_center_size(rect.center(), size);
    let builder = UiBuilder::new().max_rect(place).layout(Layout::top_down(Align::Center));
    ui.scope_builder(builder, |ui| {
        Frame::NONE
            .fill(ui.visuals().window_fill.gamma_multiply(0.94))
            .stroke(ui.visuals().window_stroke)
            .corner_radius(8)
            .inner_margin(Margin::symmetric(12, 10))
            .show(ui, |ui| {
                ui.label("the mesh is out of sight");
                let fit = Command::Fit.describe();
                let shortcut = fit.shortcuts.first().map(|shortcut| keys(ui, shortcut)).unwrap_or_default();
                let button = first_choice(ui, &format!("{} ({shortcut})", fit.label));
                if ui.add(button).on_hover_ui(|ui| tooltip(ui, &Command::Fit)).clicked() {
                    commands.push(Command::Fit);
                }
            });
    });
}
