//! What a right click in the picture offers: what can be done with the vertex, edge or face there, then with the picture.

use eframe::egui::{PointerButton, Response, RichText, Ui};
use glam::DVec3;
use vv::mesh::Vertex;

use super::clicks::{self, Sight};
use super::menu;
use super::widgets::{menu_entry, menu_item};
use crate::camera::Camera;
use crate::command::{Command, Inspect, Panel, ViewAction};
use crate::inspect::findings::Findings;
use crate::inspect::selection::Item;
use crate::scene::{Axis, Cut, Style};
use crate::session::Session;
use crate::worker::Frame;

/// What is offered for the whole picture, wherever.
const PICTURE: &[&[Command]] = &[
    &[Command::Step, Command::Back],
    &[Command::Inspect(Inspect::Fly), Command::Inspect(Inspect::Clear)],
    &[Command::Fit, Command::CopyImage, Command::SavePicture, Command::View(ViewAction::RenderOptions)],
    &[Command::Faces, Command::Smooth, Command::Edges, Command::Vertices, Command::Control],
];
/// The same where there is something else to offer first.
const SHORT: &[&[Command]] = &[&[Command::Step, Command::Back], &[Command::Fit, Command::SavePicture]];

/// Corners of a face that are named in a title.
const CORNERS: usize = 5;

/// The menu's own state: where it was opened.
#[derive(Default)]
pub struct Context {
    under: Option<Under>,
}

/// What lay under the pointer.
struct Under {
    item: Item,
    /// On the surface.
    point: DVec3,
    /// Where a walk around the face begins.
    corner: Option<[Vertex; 2]>,
}

impl Context {
    /// Opens the menu where it is asked for, and shows it.
    pub fn show(&mut self, response: &Response, sight: Sight<'_>, commands: &mut Vec<Command>) {
        let Sight { session, frame, .. } = sight;
        if let Some(at) = response.interact_pointer_pos().filter(|_| response.clicked_by(PointerButton::Secondary)) {
            self.under = sight.under(at).and_then(|picked| {
                let item = clicks::item(frame, &picked)?;
                let point = match item {
                    Item::Vertex(v) => frame.mesh.position(v),
                    _ => picked.point,
                };
                Some(Under { item, point, corner: clicks::corner(frame, &picked).or_else(|| start(frame, item)) })
            });
        }
        // The mesh may have become another one under an open menu.
        self.under = self.under.take().filter(|under| under.item.is_in(&frame.mesh));
        response.context_menu(|ui| {
            menu::scrolled(ui, 0.0, |ui| self.entries(ui, session, frame, commands));
        });
    }

    fn entries(&self, ui: &mut Ui, session: &Session, frame: &Frame, commands: &mut Vec<Command>) {
        ui.set_min_width(220.0);
        if let Some(under) = &self.under {
            under.show(ui, session, frame, commands);
            ui.separator();
        }
        for (i, group) in if self.under.is_some() { SHORT } else { PICTURE }.iter().enumerate() {
            if i > 0 {
                ui.separator();
            }
            for command in *group {
                menu_item(ui, session, commands, command.clone(), self.under.is_none());
            }
        }
    }
}

/// Where a walk begins at something that no face lies behind.
fn start(frame: &Frame, item: Item) -> Option<[Vertex; 2]> {
    match item {
        Item::Vertex(v) => Some([v, frame.mesh.ring(v).any()?]),
        Item::Edge(edge) => Some(edge),
        Item::Face([p, q]) => Some([q, p]),
    }
}

impl Under {
    fn show(&self, ui: &mut Ui, session: &Session, frame: &Frame, commands: &mut Vec<Command>) {
        let item = self.item;
        let corners = item.corners(&frame.mesh);
        ui.horizontal(|ui| {
            ui.add_space(ui.spacing().button_padding.x); // in line with the entries
            ui.label(RichText::new(title(item, &corners)).strong());
        });
        let mut wish = |wish: Inspect| commands.push(Command::Inspect(wish));
        if menu_entry(ui, true, "Select", "tell all that is known of it in the inspector") {
            wish(Inspect::Select(item));
        }
        if let Item::Vertex(v) = item {
            let shows_mask = session.inspection.mask;
            if menu_entry(
                ui,
                true,
                "Show its ring",
                "its neighbours in their order, with arrows, now and before the step",
            ) {
                wish(Inspect::Select(item));
                if shows_mask {
                    wish(Inspect::Mask);
                }
                reveal_inspector(session, commands);
            }
            let able = frame.made.is_some() && frame.before.is_some();
            if menu_entry(ui, able, "Show its mask", "of which old vertices the step made it, and with which weights") {
                commands.push(Command::Inspect(Inspect::Select(item)));
                commands.extend((!shows_mask).then_some(Command::Inspect(Inspect::Mask)));
            }
            measure(ui, session, v, commands);
        }
        let walk = if matches!(item, Item::Face(_)) { "Walk this face" } else { "Walk the face from here" };
        if menu_entry(ui, self.corner.is_some(), walk, "Edmonds' walk, arrow by arrow")
            && let Some(corner) = self.corner
        {
            commands.push(Command::Inspect(Inspect::Select(item)));
            commands.push(Command::Inspect(Inspect::Walk(corner)));
        }
        ui.separator();
        if menu_entry(ui, true, "Centre here", "bring this point to the middle, and turn around it") {
            let camera = Camera { pivot: self.point, ..session.aim() };
            commands.push(Command::View(ViewAction::Glide(camera)));
        }
        if menu_entry(ui, true, "Cut away what is before it", "cut the mesh open through this point, along an axis") {
            let cut = cut_through(self.point, &session.aim(), frame);
            commands.push(Command::SetStyle(Style { cut, ..session.document.style }));
        }
        let is_named = session.named().contains(&item);
        let (label, tip) = match is_named {
            true => ("No names here", "take the names away again"),
            false => (
                "Names here",
                "write in the picture what its vertices are called, also when something else is selected",
            ),
        };
        if menu_entry(ui, true, label, tip) {
            commands.push(Command::Inspect(Inspect::Name(item)));
        }
        let problem = frame.findings.get().is_some_and(|findings| is_listed(findings, item));
        if problem && menu_entry(ui, true, "Show in the Mesh tab", "what is wrong here, in the list of problems") {
            commands.push(Command::Inspect(Inspect::Select(item)));
            commands.extend((!session.inspection.listing).then_some(Command::Inspect(Inspect::ListProblems)));
            let panel = Command::Toggle(Panel::Messages);
            commands.extend((session.inspection.listing && !session.panels.messages).then_some(panel));
        }
        ui.separator();
        let names = corners.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
        let what = if corners.len() == 1 { "Copy name" } else { "Copy names" };
        if menu_entry(ui, true, what, "what its vertices are called") {
            ui.ctx().copy_text(names);
        }
        if menu_entry(ui, true, "Copy position", "as it is written in a program") {
            let DVec3 { x, y, z } = self.point;
            ui.ctx().copy_text(format!("vec({x}, {y}, {z})"));
        }
    }
}

/// To the vertex that is selected, if there is just one; else to the one that is clicked next.
fn measure(ui: &mut Ui, session: &Session, v: Vertex, commands: &mut Vec<Command>) {
    if let [Item::Vertex(from)] = session.selected()[..]
        && from != v
        && menu_entry(ui, true, &format!("Measure from {from} to here"), "the distance of two vertices")
    {
        commands.push(Command::Inspect(Inspect::Toggle(Item::Vertex(v))));
    }
    if menu_entry(ui, true, "Measure from here", "the distance to the vertex that is clicked next") {
        commands.push(Command::Inspect(Inspect::MeasureFrom(v)));
    }
}

fn reveal_inspector(session: &Session, commands: &mut Vec<Command>) {
    commands.extend((!session.panels.inspector).then_some(Command::Toggle(Panel::Inspector)));
}

/// `v7`, `edge v3–v9`, `face v1 v4 v8 v5`.
fn title(item: Item, corners: &[Vertex]) -> String {
    match item {
        Item::Face(_) => {
            let names: Vec<String> = corners.iter().take(CORNERS).map(ToString::to_string).collect();
            let more = if corners.len() > CORNERS { format!(" … {} corners", corners.len()) } else { String::new() };
            format!("face {}{more}", names.join(" "))
        }
        other => other.to_string(),
    }
}

fn is_listed(findings: &Findings, item: Item) -> bool {
    findings.groups.iter().flat_map(|group| &group.rows).any(|row| row.item == item)
}

/// The cut through a point across the axis that points to the eye most, which takes away what is on the eye's side.
fn cut_through(point: DVec3, camera: &Camera, frame: &Frame) -> Cut {
    let eye = camera.world_from_view * DVec3::Z;
    let away = eye.abs();
    let (across, axis) = match away.max_element() {
        most if most == away.x => (Axis::X, DVec3::X),
        most if most == away.y => (Axis::Y, DVec3::Y),
        _ => (Axis::Z, DVec3::Z),
    };
    let ball = frame.scene.bounds(&Style { control: false, ..Style::default() });
    let position = (point - ball.center).dot(axis) / ball.radius.max(f64::MIN_POSITIVE);
    Cut { on: true, across, position: position.clamp(-1.0, 1.0) as f32, flipped: eye.dot(axis) < 0.0 }
}
