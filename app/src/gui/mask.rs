//! The mask of the selected vertex: as a list beside the picture, and on the old mesh in it.

use std::time::Duration;

use eframe::egui::{self, Context, Id, Label, RichText, TextStyle, Ui, Vec2, vec2};
use vv::mesh::{Mesh, Vertex};

use super::overlay::{Inks, Overlay};
use super::widgets::{heading, seconds};
use crate::command::{Command, Inspect};
use crate::inspect::mask::{Group, Mask};
use crate::inspect::selection::Item;
use crate::session::{MaskState, Purpose, Session};
use crate::worker::Frame;

/// Old vertices that are listed and drawn.
const SHOWN: usize = 120;
/// Of which so many have their weights beside them in the picture.
const LABELLED: usize = 40;
/// Points around the pointer within which an old vertex is meant.
const NEAR: f32 = 9.0;

/// The list, if it is wanted.
pub fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let state = session.mask();
    if matches!(state, MaskState::Off) {
        return;
    }
    heading(ui, "Mask of the vertex");
    let generation = session.shown_generation();
    match state {
        MaskState::Off => {}
        MaskState::NoVertex => {
            plain(
                ui,
                "select one vertex: its mask tells of which old vertices the step made it, and with which weights",
            );
        }
        MaskState::NoStep => plain(ui, "no step made generation 0: its vertices have no mask; step once"),
        MaskState::NotKept => {
            let before = generation.saturating_sub(1);
            plain(ui, &format!("generation {before} is not kept: go there and step again"));
        }
        MaskState::Measuring(since) => {
            ui.horizontal_wrapped(|ui| {
                // What is done at once needs no clock.
                let long = since > Duration::from_millis(300);
                let time = if long { format!(", {}", seconds(since.as_secs_f64())) } else { String::new() };
                ui.weak(format!("running the step again and again{time} …"));
                if long && ui.button("Stop").accessible_name("Stop measuring").clicked() {
                    commands.push(Command::Inspect(Inspect::Mask));
                }
            });
        }
        MaskState::Failed(why) => {
            ui.add(Label::new(RichText::new(format!("no mask: {why}")).color(ui.visuals().warn_fg_color)).wrap());
        }
        MaskState::Found(mask) => List { session, generation }.show(ui, &mask, commands),
    }
}

fn plain(ui: &mut Ui, text: &str) {
    // A number does not stand alone in a line.
    let shown = text.replace("generation ", "generation\u{a0}");
    ui.add(Label::new(RichText::new(shown).weak()).wrap());
}

struct List<'a> {
    session: &'a Session,
    /// The one that is shown.
    generation: u64,
}

impl List<'_> {
    fn show(&self, ui: &mut Ui, mask: &Mask, commands: &mut Vec<Command>) {
        let before = self.generation.saturating_sub(1);
        if mask.is_affine {
            plain(ui, &format!("{} as a sum of vertices of generation {before}", mask.of));
        } else {
            plain(ui, &format!("{} is no sum of vertices of generation {before}", mask.of));
        }
        let font = TextStyle::Monospace.resolve(ui.style());
        let widest = mask
            .groups
            .iter()
            .take(SHOWN)
            .map(|group| ui.painter().layout_no_wrap(group.text(), font.clone(), egui::Color32::WHITE).size().x);
        let widest = widest.fold(24.0, f32::max);
        let mut left = SHOWN;
        for group in &mask.groups {
            if left == 0 {
                break;
            }
            ui.horizontal_top(|ui| {
                let height = ui.text_style_height(&TextStyle::Monospace);
                ui.spacing_mut().item_spacing = vec2(8.0, 2.0);
                ui.spacing_mut().interact_size.y = height;
                if mask.is_affine {
                    let text = RichText::new(group.text()).monospace().strong();
                    let size = vec2(widest, height);
                    let layout = egui::Layout::right_to_left(egui::Align::Center);
                    let response = ui.allocate_ui_with_layout(size, layout, |ui| ui.label(text)).inner;
                    response.on_hover_text(format!("{:.15}", group.weight));
                } else {
                    ui.weak("depends on");
                }
                ui.horizontal_wrapped(|ui| {
                    ui.spacing_mut().item_spacing = vec2(7.0, 2.0);
                    for &v in group.vertices.iter().take(left) {
                        self.vertex(ui, v, before, commands);
                    }
                });
            });
            left = left.saturating_sub(group.vertices.len());
        }
        let count: usize = mask.groups.iter().map(|group| group.vertices.len()).sum();
        if count > SHOWN {
            ui.weak(format!("… {} more", count - SHOWN));
        }
        if mask.is_affine {
            let command = Command::Choose(Purpose::SaveMask);
            if ui.button("Save as figure…").on_hover_text(command.describe().tooltip).clicked() {
                commands.push(command);
            }
        }
        for fault in &mask.faults {
            ui.add(Label::new(RichText::new(fault).color(ui.visuals().warn_fg_color)).wrap());
        }
    }

    /// An old vertex, which can be selected if it still lives.
    fn vertex(&self, ui: &mut Ui, v: Vertex, generation: u64, commands: &mut Vec<Command>) {
        let here = self.session.shown_vertex(v, generation);
        let mut text = RichText::new(v.to_string()).monospace();
        if self.session.inspection.pointed_old == Some(v) {
            let light = Inks::new(ui).pointed.gamma_multiply(0.55);
            text = text.background_color(light).color(ui.visuals().strong_text_color());
        }
        let name = format!("mask {v}");
        let response = match here {
            Some(_) => ui.link(text).accessible_name(name),
            None => ui.add(Label::new(text).sense(egui::Sense::hover())).accessible_name(name),
        };
        if response.hovered() {
            point_at(ui, v);
        }
        if let Some(here) = here.filter(|_| response.clicked()) {
            commands.push(Command::Inspect(Inspect::Select(Item::Vertex(here))));
        }
        let place = if here.is_none() { "; it is not in the mesh any more" } else { "" };
        response.on_hover_text(format!("{v} of generation {generation}{place}"));
    }
}

/// Draws it on the old mesh; returns whether there is one to draw.
pub fn mark(ui: &Ui, overlay: &Overlay<'_>, session: &Session, frame: &Frame) -> bool {
    let (MaskState::Found(mask), Some(old)) = (session.mask(), &frame.before) else { return false };
    let inks = overlay.inks;
    let all: Vec<(Vertex, &Group)> = mask.weights().take(SHOWN).collect();
    old_edges(overlay, old, &all);
    let center = overlay.see(frame.mesh.position(mask.of)).map(|spot| spot.at);
    let pointer = ui.ctx().pointer_hover_pos().filter(|_| ui.rect_contains_pointer(overlay.rect()));
    let mut nearest: Option<(f32, Vertex)> = None;
    for (i, &(v, group)) in all.iter().enumerate() {
        let at = old.position(v);
        let Some(spot) = overlay.see(at) else { continue };
        if let Some(distance) = pointer.map(|pointer| spot.at.distance(pointer)).filter(|d| *d <= NEAR)
            && nearest.is_none_or(|(other, _)| distance < other)
        {
            nearest = Some((distance, v));
        }
        if session.inspection.pointed_old == Some(v) {
            overlay.glow(at, inks.pointed);
        }
        if !mask.is_affine {
            overlay.circle(at, 5.0, 2.0, inks.measure);
            continue;
        }
        // The area of the dot is the weight; what draws away is a circle.
        let radius = 2.5 + 7.0 * (group.weight.abs().min(1.0) as f32).sqrt();
        if group.weight < 0.0 {
            overlay.circle(at, radius, 2.0, inks.walk);
        } else {
            overlay.disc(at, radius, inks.measure);
        }
        if i < LABELLED {
            let out = center.map_or(Vec2::ZERO, |center| spot.at - center);
            // Where the vertex itself stands its name is above it.
            let out = if out.length() < 4.0 { vec2(0.0, 1.0) } else { out.normalized() };
            let color = if group.weight < 0.0 { inks.walk } else { inks.measure };
            overlay.label(at, out * vec2(radius + 20.0, radius + 11.0), &group.text(), color);
        }
    }
    if let Some((_, v)) = nearest {
        point_at(ui, v);
    }
    true
}

/// The edges of the old mesh between what the vertex was made of. Who has very many neighbours is left out: to look for
/// one among them in each frame takes long.
fn old_edges(overlay: &Overlay<'_>, old: &Mesh, all: &[(Vertex, &Group)]) {
    const MOST: usize = 256;
    let names = |v: Vertex, u: Vertex| old.ring(v).slots().len() <= MOST && old.ring(v).contains(Some(u));
    for &(v, _) in all {
        for &(u, _) in all {
            if names(v, u) && (v < u || !names(u, v)) {
                overlay.line(old.position(v), old.position(u), 1.6, overlay.inks.measure);
            }
        }
    }
}

/// Says that the pointer rests on an old vertex, wherever that is shown.
fn point_at(ui: &Ui, v: Vertex) {
    ui.ctx().data_mut(|data| data.insert_temp(pointed_id(), Some(v)));
}

/// On which old vertex the pointer rested in this pass, if that has changed.
pub fn take_pointed(ctx: &Context, session: &Session, commands: &mut Vec<Command>) {
    let pointed = ctx.data_mut(|data| data.remove_temp::<Option<Vertex>>(pointed_id())).flatten();
    if pointed != session.inspection.pointed_old {
        commands.push(Command::Inspect(Inspect::PointOld(pointed)));
    }
}

fn pointed_id() -> Id {
    Id::unique("old vertex that is pointed at")
}
