//! The ring of the selected vertex: its neighbours on a circle, in their order, and as text; and as it was before.

use eframe::egui::{
    Align2, Color32, FontId, Grid, Pos2, Rect, Response, RichText, Role, ScrollArea, Sense, Shape, Stroke, TextStyle,
    Ui, Vec2, WidgetInfo, vec2,
};
use vv::mesh::Vertex;

use super::clicks::point_at;
use super::overlay::{Inks, around};
use super::widgets::{bold, heading, icon};
use crate::command::{Command, Inspect};
use crate::inspect::ring::{Entry, Ring};
use crate::inspect::selection::Item;
use crate::session::Session;
use crate::worker::Frame;

/// Entries up to which a ring is drawn with names, and up to which it is drawn at all.
const NAMED: usize = 14;
const DRAWN: usize = 60;
/// Rows of the table of neighbours.
const ROWS: usize = 24;

/// Shows it, its neighbours, and the ring of the generation before.
pub fn show(ui: &mut Ui, session: &Session, frame: &Frame, v: Vertex, commands: &mut Vec<Command>) {
    let generation = frame.request.generation;
    let ring = Ring::of(&frame.mesh, v);
    let old = session.old_ring(v);
    let panel = Panel { session, frame };
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        bold(ui, "Ring");
        sample(ui, Inks::new(ui).ring, false);
    });
    let beside = old.is_some() && ui.available_width() > 430.0;
    if beside && let Some((old, before)) = &old {
        ui.columns(2, |columns| {
            panel.ring(&mut columns[0], &ring, generation, "", commands);
            panel.old(&mut columns[1], old, *before, commands);
        });
    } else {
        panel.ring(ui, &ring, generation, "", commands);
        if let Some((old, before)) = &old {
            ui.add_space(4.0);
            panel.old(ui, old, *before, commands);
        }
    }
    if old.is_none() && generation > 0 {
        let born = frame.lineage.birth(v, generation) == generation;
        ui.weak(if born { "no old ring: it was born in this step" } else { "the old ring is not kept" });
    }
    if let Some(findings) = frame.findings.get() {
        let mut callers = findings.unanswered(v).peekable();
        if callers.peek().is_some() {
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing.x = 4.0;
                ui.label(RichText::new(format!("name {v} without being named:")).color(ui.visuals().warn_fg_color));
                for u in callers.take(ROWS) {
                    vertex_link(ui, session, commands, u, &u.to_string(), None);
                }
            });
        }
    }
    panel.neighbours(ui, &ring, commands);
}

struct Panel<'a> {
    session: &'a Session,
    frame: &'a Frame,
}

impl Panel<'_> {
    /// The circle and the text. `prefix` tells the names of the parts of the old ring from those of the new one.
    fn ring(&self, ui: &mut Ui, ring: &Ring, generation: u64, prefix: &str, commands: &mut Vec<Command>) {
        if (1..=DRAWN).contains(&ring.len) {
            self.circle(ui, ring, generation, prefix, commands);
        }
        self.text(ui, ring, generation, prefix, commands);
    }

    /// The ring before the step, and whether it is seen in the picture.
    fn old(&self, ui: &mut Ui, old: &Ring, before: u64, commands: &mut Vec<Command>) {
        ui.horizontal(|ui| {
            bold(ui, &format!("Old ring, generation {before}"));
            sample(ui, Inks::new(ui).old, true);
        });
        super::widgets::switch(ui, self.session, commands, Command::Inspect(Inspect::OldRing));
        self.ring(ui, old, before, "old ", commands);
    }

    /// What a vertex of a generation is called now.
    fn here(&self, v: Vertex, generation: u64) -> Option<Vertex> {
        let shown = self.frame.request.generation;
        let here = self.frame.lineage.carry(v, generation, shown);
        here.filter(|&v| self.frame.mesh.set.contains(v))
    }

    fn circle(&self, ui: &mut Ui, ring: &Ring, generation: u64, prefix: &str, commands: &mut Vec<Command>) {
        let named = ring.entries.len() <= NAMED;
        let width = ui.available_width();
        let height = if prefix.is_empty() { 190.0_f32 } else { 150.0 }.min(width);
        let (rect, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
        let inks = Inks::new(ui);
        let (weak, text_color) = (ui.visuals().weak_text_color(), ui.visuals().text_color());
        let count = ring.entries.len();
        let font = FontId::proportional(if named { 12.0 } else { 10.0 });
        // Half of what an entry takes up.
        let measured = |text: String| ui.painter().layout_no_wrap(text, font.clone(), text_color).size().x;
        let widest = ring.vertices().map(|v| measured(v.to_string())).fold(12.0, f32::max);
        let room = if named { vec2(widest / 2.0 + 5.0, 10.0) } else { vec2(5.0, 5.0) };
        let radius = (height / 2.0 - 14.0).min(width / 2.0 - room.x).max(20.0);
        let place = |i: usize| around(rect.center(), radius, i, count);
        for (i, &entry) in ring.entries.iter().enumerate() {
            let at = place(i);
            let fault = entry.fault(ring.of).is_some();
            match entry {
                Entry::Gap => {
                    ui.painter().text(at, Align2::CENTER_CENTER, "_", font.clone(), weak);
                }
                Entry::Vertex { .. } => {
                    let ink = if fault { inks.wrong } else { weak.gamma_multiply(0.6) };
                    spoke(ui, rect.center(), at, room.y + 4.0, Stroke::new(1.0, ink), fault);
                }
            }
            // To the next one; before and after a gap, there is no face.
            let next = ring.entries[(i + 1) % count];
            let gap = entry == Entry::Gap || next == Entry::Gap;
            if count > 1 {
                let ink = match gap {
                    true => weak,
                    false if prefix.is_empty() => inks.ring,
                    false => inks.old,
                };
                arc(ui, rect.center(), radius, i, count, room, ink, gap);
            }
        }
        let small = FontId::proportional(12.0);
        let galley = ui.painter().layout_no_wrap(ring.of.to_string(), small, inks.selected);
        let middle = Rect::from_center_size(rect.center(), galley.size() + vec2(10.0, 4.0));
        ui.painter().rect(
            middle,
            8,
            ui.visuals().panel_fill,
            Stroke::new(1.2, inks.selected),
            eframe::egui::StrokeKind::Inside,
        );
        ui.painter().galley(middle.center() - galley.size() / 2.0, galley, inks.selected);
        for (i, &entry) in ring.entries.iter().enumerate() {
            let Some(q) = entry.vertex() else { continue };
            let here = self.here(q, generation);
            let area = Rect::from_center_size(place(i), 2.0 * room);
            let id = ui.scope_id().with(("ring", prefix, i));
            let response = ui.interact(area, id, if here.is_some() { Sense::click() } else { Sense::hover() });
            response
                .widget_info(|| WidgetInfo::labeled(Role::Button, here.is_some(), format!("{prefix}ring entry {q}")));
            let lit =
                response.hovered() || response.has_focus() || here.is_some() && here == self.session.inspection.pointed;
            let fault = entry.fault(ring.of);
            let ink = match (&fault, here) {
                (Some(_), _) => inks.wrong,
                (None, Some(_)) => text_color,
                (None, None) => weak,
            };
            if lit {
                ui.painter().rect_filled(area, 8, inks.pointed.gamma_multiply(0.55));
            }
            if named {
                ui.painter().text(area.center(), Align2::CENTER_CENTER, q.to_string(), font.clone(), ink);
            } else {
                ui.painter().circle_filled(area.center(), 3.0, ink);
            }
            let mut note = format!("{q}, number {} of the ring", i + 1);
            note.extend(fault.map(|fault| format!(": {fault}")));
            if here.is_none() {
                note += "; it is not in the mesh any more";
            }
            self.answer(ui, &response, here, commands);
            response.on_hover_text(note);
        }
    }

    /// What pointing and clicking at an entry do.
    fn answer(&self, ui: &Ui, response: &Response, here: Option<Vertex>, commands: &mut Vec<Command>) {
        let Some(v) = here else { return };
        if response.hovered() {
            point_at(ui, v);
        }
        if response.clicked() {
            commands.push(Command::Inspect(Inspect::Select(Item::Vertex(v))));
        }
    }

    /// `v7: {v3, v9, _, v12}`
    fn text(&self, ui: &mut Ui, ring: &Ring, generation: u64, prefix: &str, commands: &mut Vec<Command>) {
        let left_out = ring.len - ring.entries.len();
        ui.horizontal_wrapped(|ui| {
            // Lines break between entries, never before a comma.
            ui.spacing_mut().item_spacing = vec2(7.0, 2.0);
            ui.monospace(if ring.len == 0 { format!("{}: {{}}", ring.of) } else { format!("{}:", ring.of) });
            for (i, &entry) in ring.entries.iter().enumerate() {
                let last = i + 1 == ring.entries.len();
                let after = if !last || left_out > 0 { "," } else { "}" };
                let before = if i == 0 { "{" } else { "" };
                let Some(q) = entry.vertex() else {
                    ui.monospace(format!("{before}_{after}")).on_hover_text("a gap: the surface is missing here");
                    continue;
                };
                let fault = entry.fault(ring.of);
                let text = format!("{before}{q}{}{after}", if fault.is_some() { "!" } else { "" });
                match self.here(q, generation) {
                    Some(here) => {
                        let name = format!("{prefix}{q}");
                        let link = vertex_link(ui, self.session, commands, here, &text, Some(&name));
                        if let Some(fault) = fault {
                            link.on_hover_text(fault);
                        }
                    }
                    None => {
                        ui.label(RichText::new(text).monospace().weak());
                    }
                }
            }
            if left_out > 0 {
                ui.weak(format!("… {left_out} more}}"));
            }
        });
    }

    /// Each neighbour with what stands at the edge, and the way around the face there.
    fn neighbours(&self, ui: &mut Ui, ring: &Ring, commands: &mut Vec<Command>) {
        let mesh = &self.frame.mesh;
        if ring.vertices().next().is_none() {
            ui.weak("no neighbours");
            return;
        }
        heading(ui, "Neighbours");
        let properties = mesh.edge_properties();
        let table = Grid::new(("neighbours", ring.of)).num_columns(4 + properties.len());
        // As narrow as it gets; wider than the panel it is scrolled, and pushes nothing aside.
        let table = table.spacing([10.0, 2.0]).min_col_width(16.0);
        let area = ScrollArea::horizontal().id_salt("neighbours");
        area.show(ui, |ui| table.show(ui, |ui| self.rows(ui, ring, commands)));
        let count = ring.len;
        if count > ROWS {
            ui.weak(format!("… {} more", count - ROWS));
        }
    }

    /// The head of the table of neighbours, and a row for each.
    fn rows(&self, ui: &mut Ui, ring: &Ring, commands: &mut Vec<Command>) {
        let mesh = &self.frame.mesh;
        let properties = mesh.edge_properties();
        for text in ["", "", "length"].into_iter().chain(properties.iter().map(|p| p.name.as_str())) {
            ui.label(RichText::new(text).small().weak());
        }
        ui.label(RichText::new("face").small().weak());
        ui.end_row();
        for (i, q) in ring.vertices().enumerate().take(ROWS) {
            ui.weak((i + 1).to_string());
            vertex_link(ui, self.session, commands, q, &q.to_string(), Some(&format!("neighbour {q}")));
            ui.label(self.session.preferences.unit.length(mesh.position(ring.of).distance(mesh.position(q))));
            for k in 0..properties.len() {
                let value = mesh.edge_value(k, ring.of, q);
                ui.label(value.map_or_else(String::new, super::selection::value));
            }
            let walk = icon(ui, super::widgets::Icon::Walk, &format!("Walk the face at {q}"));
            if walk.on_hover_text(format!("Edmonds' walk: {} → {q} → nextto {} in {q} …", ring.of, ring.of)).clicked()
            {
                commands.push(Command::Inspect(Inspect::Walk([ring.of, q])));
            }
            ui.end_row();
        }
    }
}

/// How its lines look in the picture.
fn sample(ui: &mut Ui, ink: Color32, dashed: bool) {
    let (rect, _) = ui.allocate_exact_size(vec2(24.0, 12.0), Sense::hover());
    let ends = [rect.left_center(), rect.right_center()];
    if dashed {
        ui.painter().extend(Shape::dashed_line(&ends, Stroke::new(1.4, ink), 4.0, 3.0));
    } else {
        ui.painter().line_segment(ends, Stroke::new(2.0, ink));
    }
}

/// A line from the owner to an entry; with a head, for an entry that does not answer.
fn spoke(ui: &Ui, from: Pos2, to: Pos2, room: f32, stroke: Stroke, one_way: bool) {
    let direction = (to - from).normalized();
    let end = to - direction * room;
    ui.painter().line_segment([from, end], stroke);
    if one_way {
        head(ui, end, direction, stroke.color);
    }
}

fn head(ui: &Ui, tip: Pos2, direction: Vec2, color: Color32) {
    let (back, side) = (tip - direction * 7.0, direction.rot90() * 3.5);
    ui.painter().add(Shape::convex_polygon(vec![tip, back + side, back - side], color, Stroke::NONE));
}

/// The part of the circle between an entry and the next, with an arrow head; dotted beside a gap.
#[expect(clippy::too_many_arguments, reason = "a drawing, used once")]
fn arc(ui: &Ui, center: Pos2, radius: f32, i: usize, count: usize, room: Vec2, ink: Color32, dotted: bool) {
    use std::f32::consts::TAU;
    let step = TAU / count as f32;
    // Names are wider than high: at the top the circle leaves them sideways.
    let margin = |angle: f32| (room.y + 2.0 + (room.x - room.y).max(0.0) * angle.sin().abs()) / radius;
    let (begin, end) = (-TAU / 4.0 - step * i as f32, -TAU / 4.0 - step * (i + 1) as f32);
    let (begin, end) = (begin - margin(begin), end + margin(end));
    if begin - end < 0.05 {
        return;
    }
    let at = |t: f32| {
        let angle = begin + (end - begin) * t;
        center + radius * vec2(angle.cos(), angle.sin())
    };
    let points: Vec<Pos2> = (0..=12).map(|k| at(k as f32 / 12.0)).collect();
    if dotted {
        ui.painter().extend(Shape::dotted_line(&points, ink, 5.0, 0.8));
        return;
    }
    ui.painter().line(points[..12].to_vec(), Stroke::new(1.6, ink));
    head(ui, points[12], (points[12] - points[10]).normalized(), ink);
}

/// A vertex by name, which selects it when clicked and makes it glow when pointed at. `name` is for those who cannot see.
pub fn vertex_link(
    ui: &mut Ui,
    session: &Session,
    commands: &mut Vec<Command>,
    v: Vertex,
    text: &str,
    name: Option<&str>,
) -> Response {
    let lit = session.inspection.pointed == Some(v);
    let mut shown = RichText::new(text).monospace();
    if lit {
        let light = Inks::new(ui).pointed.gamma_multiply(0.55);
        shown = shown.background_color(light).color(ui.visuals().strong_text_color());
    }
    let response = ui.link(shown);
    let response = match name {
        Some(name) => response.accessible_name(name),
        None => response,
    };
    if response.hovered() {
        point_at(ui, v);
    }
    if response.clicked() {
        commands.push(Command::Inspect(Inspect::Select(Item::Vertex(v))));
    }
    response
}

/// Text in which the names of vertices of a generation can be clicked, if the mesh shown has them.
pub fn text_with_vertices(
    ui: &mut Ui,
    session: &Session,
    commands: &mut Vec<Command>,
    text: &str,
    generation: Option<u64>,
) {
    let Some(generation) = generation else {
        ui.add(eframe::egui::Label::new(RichText::new(text).weak()).wrap());
        return;
    };
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(0.0, 1.0);
        let font = TextStyle::Body.resolve(ui.style());
        for (part, vertex) in parts(text) {
            match vertex.and_then(|v| session.shown_vertex(v, generation)) {
                Some(here) => {
                    vertex_link(ui, session, commands, here, part, None);
                }
                None => {
                    ui.label(RichText::new(part).font(font.clone()).weak());
                }
            }
        }
    });
}

/// The text in pieces: names of vertices, and what stands between.
pub fn parts(text: &str) -> Vec<(&str, Option<Vertex>)> {
    let mut parts = Vec::new();
    let (mut begin, mut at) = (0, 0);
    while at < text.len() {
        let word = text[at..].find(|c: char| !c.is_alphanumeric() && c != '_').map_or(text.len(), |n| at + n);
        let vertex = text[at..word].strip_prefix('v').filter(|digits| digits.bytes().all(|b| b.is_ascii_digit()));
        let vertex = vertex.and_then(|digits| digits.parse::<usize>().ok()?.checked_sub(1));
        if let Some(vertex) = vertex.and_then(Vertex::from_index) {
            parts.push((&text[begin..at], None));
            parts.push((&text[at..word], Some(vertex)));
            begin = word;
        }
        let rest = text[word..].find(|c: char| c.is_alphanumeric() || c == '_').map_or(text.len(), |n| word + n);
        at = rest;
    }
    parts.push((&text[begin..], None));
    parts.retain(|(part, _)| !part.is_empty());
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_vertices_are_found_in_text() {
        let check = |text: &str, expected: &[&str]| {
            let found: Vec<&str> = parts(text).into_iter().map(|(part, _)| part).collect();
            assert_eq!(found, expected);
            let names = parts(text).into_iter().filter(|(_, v)| v.is_some()).count();
            assert_eq!(
                names,
                expected
                    .iter()
                    .filter(|p| p.starts_with('v') && p.len() > 1 && p.as_bytes()[1].is_ascii_digit())
                    .count()
            );
        };
        check("ring of v2: v12 ∅ v7", &["ring of ", "v2", ": ", "v12", " ∅ ", "v7"]);
        check("v$pos of wv3 v0", &["v$pos of wv3 v0"]);
        check("", &[]);
        check("v1", &["v1"]);
    }
}
