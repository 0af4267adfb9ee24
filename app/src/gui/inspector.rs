//! Mesh, display, counts.

use eframe::egui::{self, Align, Grid, Layout, RichText, ScrollArea, Ui, Vec2b};

use super::widgets::{grouped, heading, seconds};
use super::{display, parameters, selection, theme};
use crate::command::Command;
use crate::document::MeshSource;
use crate::session::{Purpose, Session};
use crate::worker::Frame;

/// Shows them.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let area = ScrollArea::vertical().auto_shrink(Vec2b::FALSE).content_margin(theme::beside_bar());
    area.show(ui, |ui| {
        heading(ui, "Mesh");
        ui.horizontal(|ui| {
            // The button first: the name has what is left.
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let response = ui.button("Open…").on_hover_text("open a mesh file");
                if response.clicked() {
                    commands.push(Command::Choose(Purpose::OpenMesh));
                }
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    ui.add(egui::Label::new(mesh_name(session)).truncate());
                });
            });
        });
        ui.separator();
        selection::show(ui, session, commands);
        parameters::show(ui, session, commands);
        display::show(ui, session, commands);
        ui.separator();
        match session.frame() {
            Some(frame) => statistics(ui, frame),
            None => {
                heading(ui, "Statistics");
                ui.weak("nothing computed yet");
            }
        }
    });
}

/// Where the first generation comes from.
fn mesh_name(session: &Session) -> String {
    let source = &session.document.mesh;
    let made = session.frame().is_some_and(|frame| frame.mesh.vertex_count() > 0);
    if *source == MeshSource::Empty && made { "made by the program".to_owned() } else { source.name() }
}

fn statistics(ui: &mut Ui, frame: &Frame) {
    let s = &frame.statistics;
    heading(ui, "Statistics");
    let row = |ui: &mut Ui, name: &str, value: String| {
        let label = ui.weak(name);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(value).labelled_by(label.id));
        ui.end_row();
    };
    let grid = |name: &'static str| Grid::new(name).num_columns(2).spacing([12.0, 3.0]);
    grid("counts").show(ui, |ui| {
        row(ui, "Vertices", grouped(s.vertices));
        row(ui, "Edges", grouped(s.edges));
        row(ui, "Faces", grouped(s.faces));
        row(ui, "Euler characteristic", s.euler_characteristic.to_string());
        row(ui, "Genus", s.genus.map_or("–".to_owned(), |g| g.to_string()));
        row(ui, "Components", grouped(s.components));
        row(ui, "Boundary loops", grouped(s.boundary_loops));
    });
    if !s.valid {
        ui.label(RichText::new("not a valid rotation system").color(ui.visuals().warn_fg_color));
    }
    histogram(ui, "Valences", &s.valences);
    histogram(ui, "Corners of faces", &s.face_degrees);
    heading(ui, "Time");
    let t = frame.timings;
    grid("times").show(ui, |ui| {
        row(ui, "Program", seconds(t.step));
        row(ui, "Closing the step", seconds(t.closing));
        row(ui, "Faces and counts", seconds(t.faces));
        row(ui, "Scene", seconds(t.scene));
    });
}

/// Bars, one a row; the long tail in one.
fn histogram(ui: &mut Ui, title: &str, counts: &[(usize, usize)]) {
    const ROWS: usize = 8;
    if counts.is_empty() {
        return;
    }
    heading(ui, title);
    let mut rows: Vec<(String, usize)> = counts.iter().map(|&(x, n)| (x.to_string(), n)).collect();
    if rows.len() > ROWS {
        let rest = rows.split_off(ROWS - 1);
        let total = rest.iter().map(|(_, n)| n).sum();
        if let (Some((first, _)), Some((last, _))) = (rest.first(), rest.last()) {
            rows.push((format!("{first}–{last}"), total));
        }
    }
    let most = rows.iter().map(|&(_, n)| n).max().unwrap_or(1).max(1);
    let small = egui::TextStyle::Small.resolve(ui.style());
    let (text, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
    let bar = ui.visuals().hyperlink_color.gamma_multiply(0.55);
    let widest = rows.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
    let indent = 30.0_f32.max(8.0 + 6.5 * widest as f32);
    for (name, n) in rows {
        let (rect, response) = ui.allocate_exact_size(egui::vec2(ui.available_width(), 15.0), egui::Sense::hover());
        let (left, right) = (rect.left() + indent, rect.right() - 52.0);
        let painter = ui.painter();
        painter.text(egui::pos2(left - 8.0, rect.center().y), egui::Align2::RIGHT_CENTER, &name, small.clone(), weak);
        let length = (right - left).max(0.0) * n as f32 / most as f32;
        let bar_rect = egui::Rect::from_min_size(egui::pos2(left, rect.top() + 3.0), egui::vec2(length.max(1.0), 9.0));
        painter.rect_filled(bar_rect, 2.0, bar);
        painter.text(rect.right_center(), egui::Align2::RIGHT_CENTER, grouped(n), small.clone(), text);
        response.on_hover_text(format!("{}: {n} with {name}", title.to_lowercase()));
    }
}
