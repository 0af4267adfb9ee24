//! What a click in the picture means, in one table; dragging is no click.

use eframe::egui::{Modifiers, PointerButton, Pos2, Response, Ui};
use vv::mesh::Vertex;

use super::overlay::Overlay;
use crate::command::{Command, Inspect};
use crate::inspect::selection::Item;
use crate::inspect::walk::face_left_of;
use crate::scene::{Picked, Pointer};
use crate::session::Session;
use crate::worker::Frame;

/// Points around the pointer within which edges and vertices are meant, too.
pub const NEAR: f32 = 6.0;

/// What a click may mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Click {
    /// Select what is there alone.
    Select,
    /// Select it, too.
    Add,
    /// Walk around the face, from its corner that is nearest.
    Corner,
}

/// Keys that are held and what the click means then. The first row that fits holds.
const CLICKS: &[(Modifiers, Click)] =
    &[(Modifiers::COMMAND, Click::Corner), (Modifiers::SHIFT, Click::Add), (Modifiers::NONE, Click::Select)];

/// The same for the cheat sheet.
pub const HANDS: &[(&str, &str)] = &[
    ("click", "select the vertex, edge or face"),
    ("Shift + click", "select more: two vertices are a distance, three an angle"),
    ("Ctrl + click", "walk around the face from this corner"),
    ("Esc", "select nothing"),
    ("right click", "what can be done with the vertex, edge or face; also in the program, in lists, on the time line"),
];

/// What is seen in a viewport, as hands meet it.
#[derive(Clone, Copy)]
pub struct Sight<'a> {
    /// Where things are seen.
    pub overlay: &'a Overlay<'a>,
    /// Whose picture it is.
    pub session: &'a Session,
    /// The mesh in it.
    pub frame: &'a Frame,
    /// What of the distance to the eye is as wide as what a pointer means.
    pub spread: f64,
}

impl Sight<'_> {
    /// What lies under a place of the window; faces hide what is behind them, if they are seen.
    pub fn under(&self, at: Pos2) -> Option<Picked> {
        let opaque = self.session.document.style.faces;
        let pointer = Pointer { ray: self.overlay.ray(at), spread: self.spread, opaque, cut: self.overlay.cut() };
        self.frame.scene.pick(&pointer)
    }
}

/// Takes clicks and the place where the pointer rests.
pub fn take(ui: &Ui, response: &Response, sight: Sight<'_>, commands: &mut Vec<Command>) {
    let Sight { overlay, session, frame, .. } = sight;
    if let Some(at) = response.hover_pos()
        && !response.dragged()
        && let Some(picked) = sight.under(at)
        && let Some(vertex) = picked.vertex.filter(|near| near.distance <= 1.0)
        && stands_out(overlay, frame, vertex.what)
    {
        point_at(ui, vertex.what);
    }
    let Some(at) = response.interact_pointer_pos().filter(|_| response.clicked_by(PointerButton::Primary)) else {
        return;
    };
    let held = ui.input(|i| i.modifiers);
    let Some(&(_, click)) = CLICKS.iter().find(|(modifiers, _)| held.contains(*modifiers)) else { return };
    let picked = sight.under(at);
    let wish = match (click, picked.as_ref()) {
        // The nearest vertex will do.
        (Click::Select, Some(picked)) if session.inspection.measuring => {
            picked.vertex.map(|near| Inspect::Toggle(Item::Vertex(near.what)))
        }
        (Click::Corner, Some(picked)) => corner(frame, picked).map(Inspect::Walk),
        (Click::Select, Some(picked)) => item(frame, picked).map(Inspect::Select),
        (Click::Add, Some(picked)) => item(frame, picked).map(Inspect::Toggle),
        // Where nothing can be found yet, nothing is lost either.
        (Click::Select, None) if frame.scene.is_indexed() => Some(Inspect::Clear),
        (_, None) => None,
    };
    commands.extend(wish.map(Command::Inspect));
}

/// Whether its neighbours are far enough away that the pointer is not always beside some vertex.
fn stands_out(overlay: &Overlay<'_>, frame: &Frame, vertex: Vertex) -> bool {
    let seen = |v| overlay.see(frame.mesh.position(v)).map(|spot| spot.at);
    match frame.mesh.ring(vertex).any() {
        Some(neighbour) => seen(vertex).zip(seen(neighbour)).is_none_or(|(a, b)| a.distance(b) > 2.5 * NEAR),
        None => true,
    }
}

/// The vertex that is near, else the edge, else the face.
pub fn item(frame: &Frame, picked: &Picked) -> Option<Item> {
    let near = |distance: f64| distance <= 1.0;
    if let Some(vertex) = picked.vertex.filter(|v| near(v.distance)) {
        return Some(Item::Vertex(vertex.what));
    }
    if let Some(edge) = picked.edge.filter(|e| near(e.distance)) {
        return Some(Item::Edge(edge.what));
    }
    match frame.faces.get(picked.face?) {
        &[p, q, ..] => Some(Item::Face([p, q])),
        _ => None,
    }
}

/// The first edge of the walk with the face under the pointer on its right, away from the corner that is nearest.
pub fn corner(frame: &Frame, picked: &Picked) -> Option<[Vertex; 2]> {
    let &[p, q, ..] = frame.faces.get(picked.face?) else { return None };
    let corners = face_left_of(&frame.mesh, [p, q])?;
    let distance = |i: &usize| frame.mesh.position(corners[*i]).distance_squared(picked.point);
    let nearest = (0..corners.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let before = if nearest == 0 { corners.len() - 1 } else { nearest - 1 };
    Some([corners[nearest], corners[before]])
}

/// Says that the pointer rests on a vertex, wherever that is shown.
pub fn point_at(ui: &Ui, vertex: Vertex) {
    ui.ctx().data_mut(|data| data.insert_temp(pointed_id(), Some(vertex)));
}

/// What the pointer rested on in this pass, if that has changed.
pub fn take_pointed(ctx: &eframe::egui::Context, session: &Session, commands: &mut Vec<Command>) {
    let pointed = ctx.data_mut(|data| data.remove_temp::<Option<Vertex>>(pointed_id())).flatten();
    if pointed != session.inspection.pointed {
        commands.push(Command::Inspect(Inspect::Point(pointed)));
    }
}

fn pointed_id() -> eframe::egui::Id {
    eframe::egui::Id::unique("vertex that is pointed at")
}
