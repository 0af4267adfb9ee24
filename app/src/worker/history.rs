//! The generations of a recipe that are kept, and their pictures.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, OnceLock};
use std::time::Instant;

use vv::mesh::Mesh;
use vv::mesh::faces::{Faces, faces};
use vv::mesh::statistics::statistics;
use vv::stop::{Stop, Stopped};

use super::{Frame, Made, Recipe, Request, Timings};
use crate::annotate::cell::Cell;
use crate::evaluation::Generation;
use crate::inspect::lineage::Lineage;
use crate::scene::Scene;
use crate::trace;

/// The generations of one recipe.
pub(super) struct History {
    pub recipe: Arc<Recipe>,
    pub generations: BTreeMap<u64, Kept>,
    pub lineage: Lineage,
    /// Those of them that have a picture.
    drawn: BTreeSet<u64>,
    /// What all of them take.
    bytes: usize,
    control: Option<Faces>,
}

pub(super) struct Kept {
    pub generation: Generation,
    pub frame: Option<Arc<Frame>>,
}

impl Kept {
    /// The picture takes about as much again as the mesh, and holds the one before.
    fn bytes(&self) -> usize {
        let picture =
            |frame: &Arc<Frame>| 2 * self.generation.mesh.bytes() + frame.before.as_ref().map_or(0, Mesh::bytes);
        self.generation.mesh.bytes() + self.frame.as_ref().map_or(0, picture)
    }
}

impl History {
    pub fn new(recipe: Arc<Recipe>) -> Self {
        let (generations, drawn) = (BTreeMap::new(), BTreeSet::new());
        Self { recipe, generations, lineage: Lineage::default(), drawn, bytes: 0, control: None }
    }

    /// Keeps a generation.
    pub fn insert(&mut self, number: u64, generation: Generation) {
        self.lineage.add(number, &generation.survivors);
        self.lineage.keep(number, generation.mesh.clone());
        let kept = Kept { generation, frame: None };
        self.bytes += kept.bytes();
        self.drawn.remove(&number);
        self.bytes -= self.generations.insert(number, kept).map_or(0, |before| before.bytes());
    }

    /// The picture of a generation that is kept.
    pub fn frame(&mut self, request: &Request, made: Option<Made>, stop: &Stop) -> Result<Arc<Frame>, Stopped> {
        let control_mesh = self.generations.get(&0).map(|kept| kept.generation.mesh.clone());
        if let (None, Some(mesh)) = (&self.control, &control_mesh) {
            self.control = Some(faces(mesh, stop)?);
        }
        let control = match (&control_mesh, &self.control) {
            (Some(mesh), Some(faces)) if request.generation > 0 => Some((mesh, faces)),
            _ => None,
        };
        let before = request.generation.checked_sub(1).and_then(|g| self.generations.get(&g));
        let before = before.map(|kept| kept.generation.mesh.clone());
        let Some(kept) = self.generations.get_mut(&request.generation) else {
            return Err(Stopped::ByUser); // not reached: the caller has just made it
        };
        if let Some(frame) = &kept.frame {
            return Ok(Arc::clone(frame));
        }
        let lineage = self.lineage.clone();
        let frame = Arc::new(Frame {
            before,
            lineage,
            made: made.map(Arc::new),
            ..frame(request, &kept.generation, control, stop)?
        });
        self.bytes -= kept.bytes();
        kept.frame = Some(Arc::clone(&frame));
        self.bytes += kept.bytes();
        self.drawn.insert(request.generation);
        Ok(frame)
    }

    /// Forgets pictures first, then meshes, those farthest from `current` first, until `memory` bytes suffice.
    /// Generation 0, `current` and the one that is compared with stay. Returns the generations that are not kept any
    /// more. Cost: constant, but for those that lose something.
    pub fn evict(&mut self, memory: usize, current: u64, compared: Option<u64>) -> Vec<u64> {
        let stays = |g: u64| g == 0 || g == current || Some(g) == compared;
        while self.bytes > memory
            && let Some(g) = farthest(self.drawn.iter(), current, stays)
        {
            self.drawn.remove(&g);
            if let Some(kept) = self.generations.get_mut(&g) {
                self.bytes -= kept.bytes();
                kept.frame = None;
                self.bytes += kept.bytes();
            }
        }
        let mut gone = Vec::new();
        while self.bytes > memory
            && let Some(g) = farthest(self.generations.keys(), current, stays)
        {
            self.bytes -= self.generations.remove(&g).map_or(0, |kept| kept.bytes());
            self.lineage.forget(g);
            gone.push(g);
        }
        gone
    }
}

/// Which of these numbers, in order, is the farthest from `current`, but for those that stay, which are few.
fn farthest<'a>(
    mut numbers: impl DoubleEndedIterator<Item = &'a u64>,
    current: u64,
    stays: impl Fn(u64) -> bool,
) -> Option<u64> {
    let first = *numbers.find(|&&g| !stays(g))?;
    let last = numbers.rfind(|&&g| !stays(g)).map_or(first, |&g| g);
    Some(if first.abs_diff(current) >= last.abs_diff(current) { first } else { last })
}

/// Faces, counts and scene of a generation.
pub(super) fn frame(
    request: &Request,
    generation: &Generation,
    control: Option<(&Mesh, &Faces)>,
    stop: &Stop,
) -> Result<Frame, Stopped> {
    let began = Instant::now();
    let span = trace::span("faces");
    let faces = faces(&generation.mesh, stop)?;
    drop(span);
    let faces_s = began.elapsed().as_secs_f64();
    let began = Instant::now();
    let (statistics, scene) = rayon::join(
        || {
            let _span = trace::span("counting");
            let statistics = statistics(&generation.mesh, &faces, stop);
            (statistics, began.elapsed().as_secs_f64())
        },
        || {
            let _span = trace::span("scene");
            Scene::new(&generation.mesh, &faces, control, stop)
        },
    );
    let (statistics, counting_s) = (statistics.0?, statistics.1);
    let scene = Arc::new(scene?);
    Ok(Frame {
        request: request.clone(),
        mesh: generation.mesh.clone(),
        faces,
        statistics,
        control_vertices: control.map_or(generation.mesh.set.len(), |(mesh, _)| mesh.set.len()),
        warnings: generation.unfit.iter().chain(&generation.warnings).cloned().collect(),
        scene,
        before: None,
        made: None,
        lineage: Lineage::default(),
        findings: OnceLock::new(),
        colors: Cell::default(),
        timings: Timings {
            step: generation.step_s,
            closing: generation.closing_s,
            faces: faces_s + counting_s,
            scene: began.elapsed().as_secs_f64(),
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::MeshSource;

    /// Six generations of one size, each with its picture.
    fn history() -> History {
        let recipe = Arc::new(Recipe {
            path: "test.vv".into(),
            text: "".into(),
            includes_revision: 0,
            mesh: MeshSource::Empty,
            mesh_revision: 0,
            rule: None,
            params: BTreeMap::new(),
        });
        let mut history = History::new(Arc::clone(&recipe));
        for generation in 0..6 {
            let mut mesh = Mesh::new();
            for _ in 0..100 {
                let v = mesh.create().unwrap();
                mesh.set.add(v);
            }
            let made = Generation { mesh, ..Generation::default() };
            let request = Request { recipe: Arc::clone(&recipe), generation };
            history.insert(generation, made);
            history.frame(&request, None, &Stop::new()).unwrap();
        }
        history
    }

    /// What is left with room for so many meshes, of which a picture takes two and has that of the generation before:
    /// `(3)` has lost its picture.
    #[track_caller]
    fn check(meshes: usize, current: u64, compared: Option<u64>, expected: &str) {
        let mut history = history();
        let size = history.generations[&0].generation.mesh.bytes();
        let gone = history.evict(meshes * size, current, compared);
        assert!(gone.iter().all(|g| (0..6).contains(g) && !history.generations.contains_key(g)), "{gone:?}");
        assert_eq!(gone.len() + history.generations.len(), 6);
        assert_eq!(history.bytes, history.generations.values().map(Kept::bytes).sum::<usize>());
        let show = |(g, kept): (&u64, &Kept)| if kept.frame.is_some() { g.to_string() } else { format!("({g})") };
        assert_eq!(history.generations.iter().map(show).collect::<Vec<_>>().join(" "), expected);
    }

    #[test]
    fn pictures_go_before_meshes_and_the_farthest_first_but_never_the_first_and_the_current() {
        check(23, 2, None, "0 1 2 3 4 5");
        check(17, 2, None, "0 1 2 3 (4) (5)");
        check(8, 2, None, "0 2 (3)");
        check(0, 2, None, "0 2");
        check(14, 5, None, "0 (1) (2) (3) 4 5");
        check(0, 2, Some(4), "0 2 4");
    }
}
