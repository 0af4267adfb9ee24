//! The viewport without a surface: why there is none, and where to get one.

use eframe::egui::{Align, FontId, Layout, Rect, RichText, Ui, UiBuilder, vec2};

use crate::command::Command;
use crate::gui::widgets::tooltip;
use crate::session::{Purpose, Session, Stale};

/// Shows it.
pub fn show(ui: &mut Ui, rect: Rect, session: &Session, commands: &mut Vec<Command>) {
    ui.painter().rect_filled(rect, 0.0, ui.visuals().extreme_bg_color);
    let why = match session.stale() {
        Some(Stale::Failed(message)) => message.clone(),
        _ if session.is_busy() => return,
        Some(Stale::Stopped) => "stopped".to_owned(),
        None => "drop a mesh or a program here, or".to_owned(),
    };
    let size = vec2((rect.width() - 24.0).min(420.0), rect.height().min(150.0));
    let inner = Rect::from_center_size(rect.center(), size);
    let builder = UiBuilder::new().max_rect(inner).layout(Layout::top_down(Align::Center));
    ui.scope_builder(builder, |ui| {
        ui.label(RichText::new("nothing to show yet").font(FontId::proportional(18.0)));
        ui.weak(why);
        ui.add_space(8.0);
        for command in [Command::Choose(Purpose::OpenMesh), Command::Choose(Purpose::OpenProgram), Command::Gallery] {
            if ui.button(command.describe().label).on_hover_ui(|ui| tooltip(ui, &command)).clicked() {
                commands.push(command);
            }
        }
    });
}
