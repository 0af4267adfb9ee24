//! What is wrong with the mesh, by kind; a click goes there.

use eframe::egui::{Button, RichText, ScrollArea, TextStyle, Ui, Vec2b};

use super::clicks::point_at;
use super::theme;
use super::widgets::grouped;
use crate::command::{Command, Inspect};
use crate::inspect::findings::{Findings, Group, LISTED, Row};
use crate::inspect::selection::Item;
use crate::session::Session;

/// Shows it.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let Some(frame) = session.frame() else {
        ui.weak("there is no mesh");
        return;
    };
    let Some(findings) = frame.findings.get() else {
        ui.weak("looking at the mesh …");
        return;
    };
    let lines = lines(findings);
    if lines.is_empty() {
        ui.weak("nothing is wrong with the mesh");
        ui.take_available_space();
        return;
    }
    let selected = session.selected();
    let height = ui.text_style_height(&TextStyle::Body).max(ui.spacing().interact_size.y - 4.0);
    let area = ScrollArea::vertical().id_salt("findings").auto_shrink(Vec2b::FALSE).content_margin(theme::beside_bar());
    area.show_rows(ui, height, lines.len(), |ui, range| {
        for line in &lines[range] {
            match line {
                Line::Title(group) => title(ui, group, height),
                Line::Row(row) => entry(ui, selected.contains(&row.item), row, height, commands),
                Line::More(count) => {
                    ui.weak(format!("      and {} more", grouped(*count)));
                }
            }
        }
    });
}

enum Line<'a> {
    Title(&'a Group),
    Row(&'a Row),
    More(usize),
}

fn lines(findings: &Findings) -> Vec<Line<'_>> {
    let mut lines = Vec::new();
    for group in &findings.groups {
        lines.push(Line::Title(group));
        lines.extend(group.rows.iter().map(Line::Row));
        if group.count > LISTED {
            lines.push(Line::More(group.count - LISTED));
        }
    }
    lines
}

fn title(ui: &mut Ui, group: &Group, height: f32) {
    ui.horizontal(|ui| {
        ui.set_height(height);
        let color = if group.kind.is_wrong() { ui.visuals().error_fg_color } else { ui.visuals().text_color() };
        let text = format!("{} {}", grouped(group.count), group.kind.title(group.count));
        ui.label(RichText::new(text).color(color).strong()).on_hover_text(group.kind.explanation());
    });
}

fn entry(ui: &mut Ui, chosen: bool, row: &Row, height: f32, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.set_height(height);
        ui.add_space(14.0);
        let text = RichText::new(&row.text);
        let response = ui.add(Button::selectable(chosen, text).truncate());
        if response.hovered()
            && let Item::Vertex(v) = row.item
        {
            point_at(ui, v);
        }
        if response.on_hover_text("select it and fly there").clicked() {
            commands.push(Command::Inspect(Inspect::Select(row.item)));
            commands.extend(row.walk.map(|start| Command::Inspect(Inspect::Walk(start))));
            commands.push(Command::Inspect(Inspect::Fly));
            // A broken walk is best seen whole.
            if row.walk.is_some() {
                commands.push(Command::Inspect(Inspect::PlayWalk));
            }
        }
    });
}
