//! What is wrong with the mesh, by kind; a click goes there. What is selected elsewhere comes into sight.

use eframe::egui::{Button, Label, Rangef, Response, RichText, ScrollArea, TextStyle, Ui, Vec2b};

use super::clicks::point_at;
use super::theme;
use super::widgets::{grouped, menu_entry};
use crate::command::{Command, Inspect};
use crate::inspect::findings::{Findings, Group, Kind, LISTED, Row, percent};
use crate::inspect::selection::Item;
use crate::session::Session;

/// The panel's own state.
#[derive(Default)]
pub struct List {
    /// The kind that is shown alone.
    only: Option<Kind>,
    /// What was selected at the last look, to bring it into sight when something else is.
    chosen: Option<Item>,
    /// What stretch of the list was in sight.
    seen: Option<Rangef>,
}

impl List {
    /// Shows it.
    pub fn show(&mut self, ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
        let Some(frame) = session.frame() else {
            ui.weak("there is no mesh");
            return;
        };
        let Some(findings) = frame.findings.get() else {
            ui.weak("looking at the mesh …");
            return;
        };
        // Another mesh may have none of them.
        self.only = self.only.filter(|only| findings.groups.iter().any(|group| group.kind == *only));
        let lines = lines(findings, self.only);
        if findings.groups.is_empty() {
            ui.weak("nothing is wrong with the mesh");
        }
        if lines.is_empty() {
            ui.take_available_space();
            return;
        }
        if let Some(only) = self.only {
            ui.horizontal(|ui| {
                ui.weak(format!("only {}", only.title(2)));
                if ui.small_button("Show all").on_hover_text("list all kinds again").clicked() {
                    self.only = None;
                }
            });
        }
        let selected = session.selected();
        let height = ui.text_style_height(&TextStyle::Body).max(ui.spacing().interact_size.y - 4.0);
        let area = ScrollArea::vertical().id_salt("findings").auto_shrink(Vec2b::FALSE);
        let mut area = area.content_margin(theme::beside_bar());
        if let Some(top) = self.comes_into_sight(&lines, &selected, height + ui.spacing().item_spacing.y) {
            area = area.vertical_scroll_offset(top);
        }
        let shown = area.show_rows(ui, height, lines.len(), |ui, range| {
            for line in &lines[range] {
                match line {
                    Line::Title(group) => self.title(ui, group, height),
                    Line::Row(group, row) => {
                        let response = entry(ui, selected.contains(&row.item), row, height, commands);
                        response.context_menu(|ui| self.menu(ui, session, group, row, commands));
                    }
                    Line::More(count) => {
                        ui.weak(format!("      and {} more", grouped(*count)));
                    }
                    Line::NearlyPlane(count, most) => {
                        let (verb, their) = if *count == 1 { ("bends", "its") } else { ("bend", "their") };
                        let text = format!("{} {verb} by up to {} of {their} width", faces(*count), percent(*most));
                        let tip = "so little counts as plane: it begins to matter at 1 %";
                        ui.add(Label::new(RichText::new(text).weak()).truncate()).on_hover_text(tip);
                    }
                }
            }
        });
        let top = shown.state.clamped_offset().y;
        self.seen = Some(Rangef::new(top, top + shown.inner_rect.height()));
    }

    /// Where the list must be scrolled to, if something out of sight was selected elsewhere.
    fn comes_into_sight(&mut self, lines: &[Line<'_>], selected: &[Item], row: f32) -> Option<f32> {
        let chosen = match selected {
            [only] => Some(*only),
            _ => None,
        };
        if chosen == self.chosen {
            return None;
        }
        self.chosen = chosen;
        let at = lines.iter().position(|line| matches!(line, Line::Row(_, row) if Some(row.item) == chosen))?;
        let top = at as f32 * row;
        let visible = self.seen.is_some_and(|seen| seen.contains(top) && seen.contains(top + row));
        (!visible).then_some((top - self.seen.map_or(0.0, Rangef::span) / 2.0).max(0.0))
    }

    fn title(&mut self, ui: &mut Ui, group: &Group, height: f32) {
        ui.horizontal(|ui| {
            ui.set_height(height);
            let color = if group.kind.is_wrong() { ui.visuals().error_fg_color } else { ui.visuals().text_color() };
            let text = format!("{} {}", grouped(group.count), group.kind.title(group.count));
            let response = ui.label(RichText::new(text).color(color).strong());
            let response = response.on_hover_text(group.kind.explanation());
            response.context_menu(|ui| self.menu_of_kind(ui, group));
        });
    }

    /// What a right click on a finding offers.
    fn menu(&mut self, ui: &mut Ui, session: &Session, group: &Group, row: &Row, commands: &mut Vec<Command>) {
        ui.set_min_width(190.0);
        let select = Command::Inspect(Inspect::Select(row.item));
        if menu_entry(ui, true, "Fly there", "select it and bring it close") {
            commands.extend([select.clone(), Command::Inspect(Inspect::Fly)]);
        }
        if menu_entry(ui, true, "Select", "without moving the view") {
            commands.push(select.clone());
        }
        let corner = row.walk.or_else(|| match row.item {
            Item::Vertex(v) => Some([v, session.frame()?.mesh.ring(v).any()?]),
            Item::Edge(edge) => Some(edge),
            Item::Face([p, q]) => Some([q, p]),
        });
        if menu_entry(ui, corner.is_some(), "Walk", "Edmonds' walk that passes here, arrow by arrow") {
            commands.push(select);
            commands.extend(corner.map(|corner| Command::Inspect(Inspect::Walk(corner))));
            commands.push(Command::Inspect(Inspect::Fly));
        }
        ui.separator();
        if menu_entry(ui, true, "Copy line", "this finding as text") {
            ui.ctx().copy_text(row.text.clone());
        }
        self.menu_of_kind(ui, group);
    }

    fn menu_of_kind(&mut self, ui: &mut Ui, group: &Group) {
        if menu_entry(ui, true, "Copy all of this kind", "those that are listed, a line each") {
            let lines: Vec<&str> = group.rows.iter().map(|row| row.text.as_str()).collect();
            ui.ctx().copy_text(lines.join("\n"));
        }
        let only = format!("Only {}", group.kind.title(2));
        if self.only.is_none() && menu_entry(ui, true, &only, "hide all other kinds") {
            self.only = Some(group.kind);
        } else if self.only.is_some() && menu_entry(ui, true, "Show all kinds", "list all kinds again") {
            self.only = None;
        }
    }
}

enum Line<'a> {
    Title(&'a Group),
    Row(&'a Group, &'a Row),
    More(usize),
    /// Faces that count as plane, and how much the worst of them is bent.
    NearlyPlane(usize, f64),
}

fn lines(findings: &Findings, only: Option<Kind>) -> Vec<Line<'_>> {
    let mut lines = Vec::new();
    for group in findings.groups.iter().filter(|group| only.is_none_or(|only| only == group.kind)) {
        lines.push(Line::Title(group));
        lines.extend(group.rows.iter().map(|row| Line::Row(group, row)));
        if group.count > LISTED {
            lines.push(Line::More(group.count - LISTED));
        }
    }
    if let (count @ 1.., most) = findings.nearly_plane
        && only.is_none()
    {
        lines.push(Line::NearlyPlane(count, most));
    }
    lines
}

fn faces(count: usize) -> String {
    format!("{} {}", grouped(count), if count == 1 { "face" } else { "faces" })
}

fn entry(ui: &mut Ui, chosen: bool, row: &Row, height: f32, commands: &mut Vec<Command>) -> Response {
    let line = ui.horizontal(|ui| {
        ui.set_height(height);
        ui.add_space(14.0);
        let text = RichText::new(&row.text);
        let response = ui.add(Button::selectable(chosen, text).truncate());
        if response.hovered()
            && let Item::Vertex(v) = row.item
        {
            point_at(ui, v);
        }
        let response = response.on_hover_text("select it and fly there");
        if response.clicked() {
            commands.push(Command::Inspect(Inspect::Select(row.item)));
            commands.extend(row.walk.map(|start| Command::Inspect(Inspect::Walk(start))));
            commands.push(Command::Inspect(Inspect::Fly));
            // A broken walk is best seen whole.
            if row.walk.is_some() {
                commands.push(Command::Inspect(Inspect::PlayWalk));
            }
        }
        response
    });
    line.inner
}
