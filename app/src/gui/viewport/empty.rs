//! The viewport without a surface: why there is none, and where to get one.

use std::f32::consts::TAU;

use eframe::egui::{Align, Button, Color32, FontId, Layout, Mesh, Pos2, Rect, RichText, Stroke, Ui, UiBuilder, vec2};

use crate::command::Command;
use crate::gui::widgets::{first_choice, tooltip};
use crate::render::palette::palette;
use crate::session::{Purpose, Session, Stale};

/// Points across of the drawing.
const DRAWING: f32 = 84.0;
/// Size of a button.
const BUTTON: [f32; 2] = [160.0, 28.0];

/// Shows it.
pub fn show(ui: &mut Ui, rect: Rect, session: &Session, commands: &mut Vec<Command>) {
    background(ui, rect);
    let why = match session.stale() {
        Some(Stale::Failed(message)) if super::is_slow(session).is_none() => message.clone(),
        _ if session.is_busy() => return,
        Some(Stale::Stopped) => "stopped".to_owned(),
        _ => "choose a program with its mesh, or drop a file here".to_owned(),
    };
    let drawn = rect.height() > 330.0;
    let height = if drawn { 190.0 + DRAWING } else { 170.0 };
    let size = vec2((rect.width() - 24.0).min(420.0), rect.height().min(height));
    let inner = Rect::from_center_size(rect.center(), size);
    let builder = UiBuilder::new().max_rect(inner).layout(Layout::top_down(Align::Center));
    ui.scope_builder(builder, |ui| {
        if drawn {
            let (space, _) = ui.allocate_exact_size(vec2(DRAWING, DRAWING + 8.0), eframe::egui::Sense::hover());
            ring(ui, space.center_top() + vec2(0.0, DRAWING / 2.0));
        }
        ui.label(RichText::new("Nothing to show yet").font(FontId::proportional(18.0)));
        ui.weak(why);
        ui.add_space(10.0);
        for command in [Command::Gallery, Command::Choose(Purpose::OpenMesh), Command::Choose(Purpose::OpenProgram)] {
            let label = command.describe().label;
            let button = if command == Command::Gallery { first_choice(ui, label) } else { Button::new(label) };
            if ui.add_sized(BUTTON, button).on_hover_ui(|ui| tooltip(ui, &command)).clicked() {
                commands.push(command);
            }
        }
    });
}

/// As behind a surface.
fn background(ui: &Ui, rect: Rect) {
    let palette = palette(super::theme_of(ui));
    let [top, bottom] =
        [palette.background_top, palette.background_bottom].map(|[r, g, b, _]| Color32::from_rgb(r, g, b));
    let mut mesh = Mesh::default();
    for (corner, color) in
        [(rect.left_top(), top), (rect.right_top(), top), (rect.right_bottom(), bottom), (rect.left_bottom(), bottom)]
    {
        mesh.colored_vertex(corner, color);
    }
    mesh.add_triangle(0, 1, 2);
    mesh.add_triangle(0, 2, 3);
    ui.painter().add(mesh);
}

/// A vertex with its ring, which is all that a mesh consists of.
fn ring(ui: &Ui, center: Pos2) {
    let (ink, accent) = (ui.visuals().weak_text_color(), ui.visuals().hyperlink_color);
    let at = |turn: f32| center + DRAWING * 0.46 * vec2((turn * TAU).cos(), (turn * TAU).sin());
    for i in 0..6 {
        let turn = i as f32 / 6.0;
        ui.painter().line_segment([center, at(turn)], Stroke::new(1.0, ink));
        ui.painter().line_segment([at(turn), at(turn + 1.0 / 6.0)], Stroke::new(1.5, accent));
    }
    for i in 0..6 {
        ui.painter().circle_filled(at(i as f32 / 6.0), 3.0, accent);
    }
    ui.painter().circle_filled(center, 4.0, ink);
}
