//! Looking closer: what is selected, the walk that is watched.

use std::time::{Duration, Instant};

use glam::DVec3;
use vv::diagnostic::{Diagnostic, Severity};
use vv::mesh::triangulate::newell;
use vv::mesh::{Mesh, Vertex};

use super::{Dialog, Session};
use crate::camera::Camera;
use crate::command::Inspect;
use crate::inspect::lineage::Lineage;
use crate::inspect::measure::{FaceMeasure, normal_at};
use crate::inspect::ring::Ring;
use crate::inspect::selection::{Item, Selection};
use crate::inspect::walk::Walk;
use crate::scene::Sphere;
use crate::worker::{Failed, Frame};

/// Between two arrows of a walk that is played; less if there are so many that it would take longer than [`WALK`].
const ARROW: Duration = Duration::from_millis(650);
const WALK: Duration = Duration::from_secs(12);
/// Walks with more vertices are seen alone.
const AROUND: usize = 12;
/// Neighbours of a vertex that decide how close a flight comes.
const NEIGHBOURS: usize = 64;
/// A surface that turns farther away from the eye than this is brought around.
const STEEP: f64 = 1.1;

/// What is looked at closely.
#[derive(Debug)]
pub struct Inspection {
    /// What is selected. [`Session::selected`] tells what of it the shown mesh has.
    pub selection: Selection,
    /// The vertex that the pointer rests on, in the picture or in a panel.
    pub pointed: Option<Vertex>,
    /// The walk that is watched.
    pub walk: Option<Walking>,
    /// Whether the problems of the mesh are listed and marked.
    pub listing: bool,
    /// Whether the ring of the generation before is drawn, too.
    pub old_ring: bool,
    /// Where the program failed.
    pub fault: Option<Fault>,
    /// Whether the mask of the selected vertex is wanted.
    pub mask: bool,
    /// The vertex of the generation before that the pointer rests on, in a mask.
    pub pointed_old: Option<Vertex>,
    /// Whether the next vertex that is clicked is measured to.
    pub measuring: bool,
    /// What has its names in the picture, selected or not.
    pub named: Selection,
}

impl Default for Inspection {
    fn default() -> Self {
        let selection = Selection::default();
        Self {
            selection,
            pointed: None,
            walk: None,
            listing: false,
            old_ring: true,
            fault: None,
            mask: false,
            pointed_old: None,
            measuring: false,
            named: Selection::default(),
        }
    }
}

/// Edmonds' walk, watched step by step.
#[derive(Debug, Clone)]
pub struct Walking {
    /// All of it.
    pub walk: Walk,
    /// How many arrows are shown, from 1 on.
    pub at: usize,
    /// When the last one was added, if they are played.
    pub playing: Option<Instant>,
    start: [Vertex; 2],
    generation: u64,
}

impl Walking {
    /// Between two arrows, when they are played.
    fn pause(&self) -> Duration {
        ARROW.min(WALK / u32::try_from(self.walk.arrows()).unwrap_or(u32::MAX).max(1))
    }
}

/// The mesh before a step that failed, and the vertices that the error names.
#[derive(Debug, Clone)]
pub struct Fault {
    /// Before the step.
    pub mesh: Mesh,
    /// The generation it is.
    pub generation: u64,
    /// What went wrong.
    pub message: String,
    /// The vertices that the error names; some may have been born in the step.
    pub vertices: Vec<Vertex>,
}

impl Session {
    /// What of the selection the shown mesh has, by the names it has there.
    #[must_use]
    pub fn selected(&self) -> Vec<Item> {
        self.selection().0
    }

    /// What of the selection the shown mesh has, and what it has not, with the generation that had it.
    #[must_use]
    pub fn selection(&self) -> (Vec<Item>, Vec<(u64, Item)>) {
        match &self.frame {
            Some(frame) => self.inspection.selection.shown(&frame.mesh, frame.request.generation, &frame.lineage),
            None => (Vec::new(), Vec::new()),
        }
    }

    /// What of that which has its names in the picture the shown mesh has, by the names it has there.
    #[must_use]
    pub fn named(&self) -> Vec<Item> {
        let Some(frame) = &self.frame else { return Vec::new() };
        self.inspection.named.shown(&frame.mesh, frame.request.generation, &frame.lineage).0
    }

    /// What a vertex of some generation is called in the mesh shown, if it lives there.
    #[must_use]
    pub fn shown_vertex(&self, v: Vertex, generation: u64) -> Option<Vertex> {
        let frame = self.frame.as_ref()?;
        frame.lineage.carry(v, generation, frame.request.generation).filter(|&v| frame.mesh.set.contains(v))
    }

    /// The ring that a vertex of the shown mesh had before the step, with the generation that was.
    #[must_use]
    pub fn old_ring(&self, v: Vertex) -> Option<(Ring, u64)> {
        let frame = self.frame.as_ref()?;
        let generation = frame.request.generation;
        let (mesh, before) = frame.before.as_ref().zip(generation.checked_sub(1))?;
        Some((Ring::of(mesh, frame.lineage.carry(v, generation, before)?), before))
    }

    /// Where a walk would begin: at the selected face or edge, or at the start of the ring of the selected vertex.
    #[must_use]
    pub fn corner(&self) -> Option<[Vertex; 2]> {
        let frame = self.frame.as_ref()?;
        match *self.selected().last()? {
            Item::Vertex(v) => Some([v, frame.mesh.ring(v).any()?]),
            Item::Edge(edge) => Some(edge),
            // The walk has the face on its right hand.
            Item::Face([p, q]) => Some([q, p]),
        }
    }

    pub(super) fn inspect(&mut self, wish: Inspect) {
        let generation = self.shown_generation();
        let lineage = || self.frame.as_ref().map(|f| f.lineage.clone()).unwrap_or_default();
        // It ends with whatever is done next, but for looking.
        self.inspection.measuring &= matches!(wish, Inspect::Point(_) | Inspect::PointOld(_) | Inspect::Fly);
        match wish {
            Inspect::Select(item) => {
                self.inspection.selection.set(item, generation);
                self.inspection.walk = None;
            }
            Inspect::Toggle(item) => {
                self.inspection.selection.toggle(item, generation, &lineage());
                self.inspection.walk = None;
            }
            Inspect::MeasureFrom(v) => {
                self.inspection.selection.set(Item::Vertex(v), generation);
                self.inspection.walk = None;
                self.inspection.measuring = true;
            }
            Inspect::Name(item) => self.inspection.named.toggle(item, generation, &lineage()),
            Inspect::SelectNumbers(numbers) => self.select_numbers(&numbers),
            Inspect::Clear => {
                self.inspection.selection.clear();
                self.inspection.walk = None;
            }
            Inspect::AskForVertex => self.dialog = Some(Dialog::SelectVertex { text: String::new() }),
            Inspect::Fly => self.fly(),
            Inspect::Point(vertex) => self.inspection.pointed = vertex,
            Inspect::PointOld(vertex) => self.inspection.pointed_old = vertex,
            Inspect::Mask => {
                self.inspection.mask = !self.inspection.mask;
                self.panels.inspector |= self.inspection.mask;
            }
            Inspect::Walk(start) => self.walk(start, 1),
            Inspect::WalkOn => match &mut self.inspection.walk {
                Some(walking) => {
                    walking.at = (walking.at + 1).min(walking.walk.arrows());
                    walking.playing = None;
                }
                None => self.begin_walk(),
            },
            Inspect::WalkBack => {
                if let Some(walking) = &mut self.inspection.walk {
                    walking.at = walking.at.saturating_sub(1).max(1);
                    walking.playing = None;
                }
            }
            Inspect::PlayWalk => self.play_walk(),
            Inspect::EndWalk => self.inspection.walk = None,
            Inspect::OldRing => self.inspection.old_ring = !self.inspection.old_ring,
            Inspect::ListProblems => {
                self.inspection.listing = !self.inspection.listing;
                self.panels.messages |= self.inspection.listing;
            }
        }
    }

    fn select_numbers(&mut self, numbers: &[u64]) {
        let Some(frame) = self.frame.clone() else { return };
        let vertex = |&number: &u64| {
            let index = usize::try_from(number).ok()?.checked_sub(1)?;
            Vertex::from_index(index).filter(|&v| frame.mesh.set.contains(v))
        };
        if let Some(missing) = numbers.iter().find(|number| vertex(number).is_none()) {
            let most = frame.mesh.vertex_count();
            self.say(Severity::Error, format!("there is no v{missing}: the mesh has v1 to v{most}"));
            return;
        }
        self.inspection.selection.clear();
        self.inspection.walk = None;
        for v in numbers.iter().filter_map(vertex) {
            let item = Item::Vertex(v);
            if !self.selected().contains(&item) {
                self.inspection.selection.toggle(item, frame.request.generation, &Lineage::default());
            }
        }
        self.fly();
    }

    fn begin_walk(&mut self) {
        if let Some(corner) = self.corner() {
            self.walk(corner, 1);
        }
    }

    fn walk(&mut self, start: [Vertex; 2], at: usize) {
        let Some(frame) = &self.frame else { return };
        let [p, q] = start;
        if !frame.mesh.set.contains(p) {
            return;
        }
        let walk = Walk::from(&frame.mesh, p, q);
        let at = at.clamp(1, walk.arrows());
        let generation = frame.request.generation;
        self.inspection.walk = Some(Walking { walk, at, playing: None, start, generation });
    }

    fn play_walk(&mut self) {
        if self.inspection.walk.is_none() {
            self.begin_walk();
        }
        let Some(walking) = &mut self.inspection.walk else { return };
        if walking.playing.take().is_none() {
            if walking.at == walking.walk.arrows() {
                walking.at = 1;
            }
            walking.playing = Some(Instant::now());
        }
    }

    /// What is watched is looked for in the mesh that is shown now.
    pub(super) fn follow(&mut self) {
        self.inspection.pointed = None;
        let (Some(walking), Some(frame)) = (&self.inspection.walk, &self.frame) else { return };
        let (playing, at) = (walking.playing, walking.at);
        let carry = |v| frame.lineage.carry(v, walking.generation, frame.request.generation);
        let start = match (carry(walking.start[0]), carry(walking.start[1])) {
            (Some(p), Some(q)) if frame.mesh.ring(p).contains(Some(q)) => [p, q],
            _ => {
                self.inspection.walk = None;
                return;
            }
        };
        self.walk(start, at);
        if let Some(walking) = &mut self.inspection.walk {
            walking.playing = playing;
        }
    }

    /// Remembers where a program failed, to show it.
    pub(super) fn remember_fault(&mut self, failed: &Failed) {
        self.inspection.fault = fault(failed.diagnostic.as_deref(), failed);
    }

    fn fly(&mut self) {
        let Some(frame) = &self.frame else { return };
        let aspect = self.view.map_or(1.0, |(size, _)| size.aspect());
        let orbit = self.inspection.walk.as_ref().and_then(|walking| orbit(&walking.walk, frame));
        let Some((ball, normal)) = orbit.or_else(|| ball(&self.selected(), frame)) else { return };
        let from = self.aim();
        let turned = normal.map_or(from, |normal| facing(from, normal));
        let to = turned.fit(ball, aspect);
        if to.is_finite() {
            self.glide_to(to);
        }
    }

    /// Moves what moves by itself; when to call again.
    pub(super) fn animate(&mut self) -> Option<Instant> {
        let now = Instant::now();
        if let Some(walking) = &mut self.inspection.walk
            && let Some(since) = walking.playing
        {
            let pause = walking.pause();
            let passed = now.duration_since(since).as_secs_f64() / pause.as_secs_f64();
            if passed >= 1.0 {
                // Pictures may take longer than a pause.
                walking.at = walking.at.saturating_add(passed as usize).min(walking.walk.arrows());
                walking.playing = (walking.at < walking.walk.arrows()).then_some(now);
            }
            return walking.playing.map(|since| since + pause);
        }
        None
    }
}

fn fault(diagnostic: Option<&Diagnostic>, failed: &Failed) -> Option<Fault> {
    let (diagnostic, mesh) = (diagnostic?, failed.before.as_ref()?);
    Some(Fault {
        mesh: Mesh::clone(mesh),
        generation: failed.generation.saturating_sub(1),
        message: diagnostic.message.clone(),
        vertices: diagnostic.vertices.clone(),
    })
}

/// A ball around things and what is next to them, and where the surface faces there.
fn ball(items: &[Item], frame: &Frame) -> Option<(Sphere, Option<DVec3>)> {
    let mesh = &frame.mesh;
    let corners: Vec<Vertex> = items.iter().flat_map(|item| item.corners(mesh)).collect();
    let mut points: Vec<DVec3> = corners.iter().map(|&v| mesh.position(v)).collect();
    if let [only] = corners[..] {
        points.extend(mesh.ring(only).vertices().take(NEIGHBOURS).map(|v| mesh.position(v)));
    }
    points.retain(|p| p.is_finite());
    let (first, rest) = points.split_first()?;
    let (low, high) = rest.iter().fold((*first, *first), |(low, high), &p| (low.min(p), high.max(p)));
    let center = if corners.len() == 1 { *first } else { (low + high) / 2.0 };
    let reach = points.iter().map(|p| p.distance(center)).fold(0.0, f64::max);
    let whole = frame.scene.bounds(&crate::scene::Style::default()).radius;
    // Some of what is around, but not more than all.
    let radius = (2.2 * reach).max(1e-4 * whole).min(whole.max(f64::MIN_POSITIVE));
    let radius = if reach > 0.0 { radius } else { 0.1 * whole };
    let normal = match items {
        [Item::Face(_)] => Some(FaceMeasure::of(&points).normal),
        _ => corners.iter().find_map(|&v| normal_at(mesh, v)),
    };
    Some((Sphere { center, radius }, normal.filter(|n| *n != DVec3::ZERO)))
}

/// A ball around a walk, all of it, and where the face faces that it goes round.
fn orbit(walk: &Walk, frame: &Frame) -> Option<(Sphere, Option<DVec3>)> {
    let points = walk.path.iter().map(|&v| frame.mesh.position(v)).filter(|p| p.is_finite());
    let points: Vec<DVec3> = points.collect();
    let (first, rest) = points.split_first()?;
    let (low, high) = rest.iter().fold((*first, *first), |(low, high), &p| (low.min(p), high.max(p)));
    let center = (low + high) / 2.0;
    let reach = points.iter().map(|p| p.distance(center)).fold(0.0, f64::max);
    // The face lies on the right hand. A short way that does not close goes around nothing.
    let normal = Some(-newell(&points).normalize_or_zero()).filter(|n| *n != DVec3::ZERO && points.len() > 3);
    // A face is seen with what is around it, a long way fills the picture.
    let room = if points.len() > AROUND { 1.1 } else { 2.2 };
    (reach > 0.0).then_some((Sphere { center, radius: room * reach }, normal))
}

/// `camera`, turned as little as needed to see a surface that faces `normal`.
fn facing(camera: Camera, normal: DVec3) -> Camera {
    let eye = camera.world_from_view * DVec3::Z;
    let angle = eye.angle_between(normal);
    if angle <= STEEP || !angle.is_finite() {
        return camera;
    }
    let part = (angle - 0.6 * STEEP) / angle;
    let turn = glam::DQuat::IDENTITY.slerp(glam::DQuat::from_rotation_arc(eye, normal), part);
    Camera { world_from_view: (turn * camera.world_from_view).normalize(), ..camera }
}
