//! What is wanted, what is computed for it, and what came of it.

use std::sync::Arc;
use std::time::{Duration, Instant};

use vv::diagnostic::Severity;
use vv::engine::FailureKind;

use super::{GRACE, Halted, Running, Session, Stale};
use crate::command::Command;
use crate::document::{MeshSource, ProgramText};
use crate::library;
use crate::worker::{Event, Failed, Frame, Recipe, Report, Request, release};

/// Playing pauses before a generation that would probably have more vertices.
const PLAY_VERTICES: usize = 1_000_000;

impl Session {
    pub(super) fn go_to(&mut self, generation: u64) {
        self.document.generation = generation;
        self.ask_now();
    }

    pub(super) fn pause_and_go_to(&mut self, generation: u64) {
        self.playing = None;
        self.go_to(generation);
    }

    /// Goes there; what is to be done with it waits until it is shown.
    pub(super) fn go_to_and(&mut self, generation: u64, then: Command) {
        self.pause_and_go_to(generation);
        self.then = Some((generation, then));
    }

    /// Does what has waited for the generation that is shown now; forgets it when another one is wanted.
    pub(super) fn carry_on(&mut self) {
        let Some((generation, _)) = &self.then else { return };
        let wanted = *generation == self.document.generation;
        if wanted && self.is_busy() {
            return;
        }
        let reached = wanted && self.stale.is_none() && *generation == self.shown_generation();
        if let Some((_, then)) = self.then.take().filter(|_| reached) {
            self.apply(then);
        }
    }

    pub(super) fn stop(&mut self) {
        self.playing = None;
        let Some(running) = self.running.take() else { return };
        self.due = None;
        self.stopped = Some(running.request.generation);
        let shown = self.frame.as_ref().map(|f| &f.request);
        match shown {
            // A step was stopped: what is shown is a good result, of the generation before.
            Some(request) if *request.recipe == *running.request.recipe => {
                self.document.generation = request.generation;
                self.stale = None;
                self.forget_vain_change();
            }
            _ => self.stale = Some(Stale::Stopped),
        }
        self.say(Severity::Note, "stopped");
    }

    /// Time between two generations when playing.
    pub(super) fn beat(&self) -> Duration {
        Duration::from_secs_f64(1.0 / self.speed)
    }

    pub(super) fn play(&mut self) {
        let Some(last) = self.playing else { return };
        if self.is_busy() || last.elapsed() < self.beat() {
            return;
        }
        if self.stale.is_some() || !self.can_step() {
            self.playing = None;
            return;
        }
        let generation = self.document.generation;
        let shown = self.frame.as_ref().map_or(0, |f| f.statistics.vertices);
        if self.growth() * shown as f64 > PLAY_VERTICES as f64 {
            self.playing = None;
            self.say(
                Severity::Note,
                "paused: the next generation would have more than a million vertices; Step goes on",
            );
            return;
        }
        self.playing = Some(Instant::now());
        let before = self.state();
        self.go_to(generation.saturating_add(1));
        let text = Arc::clone(&self.document.program.text);
        self.record(Some(super::undo::Kind::Play(self.plays)), &text, before, self.programs());
    }

    /// By how much a generation is larger than the one before, from generation 0 to the one shown.
    fn growth(&self) -> f64 {
        let Some(frame) = &self.frame else { return 1.0 };
        let first = frame.control_vertices.max(1) as f64;
        (frame.statistics.vertices as f64 / first).powf(1.0 / frame.request.generation.max(1) as f64)
    }

    pub(super) fn ask_now(&mut self) {
        self.ask_after(Duration::ZERO);
    }

    pub(super) fn ask_after(&mut self, pause: Duration) {
        self.due = Some(Instant::now() + pause);
    }

    /// What is wanted.
    fn request(&self) -> Request {
        let document = &self.document;
        let recipe = Recipe {
            path: document.program.path_or_name(),
            text: Arc::clone(&self.text_to_run),
            includes_revision: self.includes_revision,
            mesh: document.mesh.clone(),
            mesh_revision: self.mesh_revision,
            rule: document.rule.clone(),
            params: document.params.clone(),
        };
        Request { recipe: Arc::new(recipe), generation: document.generation }
    }

    /// Hands the wish to the worker once it is due and what runs may be dropped for it.
    pub(super) fn ask(&mut self) {
        if self.due.is_none_or(|due| Instant::now() < due) {
            return;
        }
        let request = self.request();
        if let Some(running) = &self.running {
            let same = *running.request.recipe == *request.recipe;
            if same && running.request.generation == request.generation {
                self.due = None;
                return;
            }
            // A generation on the way to the one that is wanted now is no work lost.
            if same && running.request.generation < request.generation {
                return;
            }
            if running.since.elapsed() < GRACE {
                return;
            }
        }
        self.due = None;
        self.running = None; // drops the ticket: the old work stops
        let ticket = self.worker.submit(request.clone());
        (self.stopped, self.halted) = (None, None);
        let (since, of) = (Instant::now(), self.programs());
        self.running = Some(Running { ticket, request, since, stepping: None, of });
    }

    pub(super) fn take_report(&mut self, report: Report) {
        let Some(running) = &mut self.running else { return };
        if !running.ticket.issued(&report) {
            return;
        }
        let (request, of) = (running.request.clone(), running.of);
        match report.event {
            Event::Compiled { compilation, files } => {
                self.problems.compiled(&compilation);
                self.inspection.fault = None;
                if let Some(program) = &compilation.program {
                    self.program = Some(Arc::clone(program));
                    self.program_of = of;
                    self.included.clear();
                } else if self.program_of != of {
                    // Rules, parameters and generations of the program before are not those of this one.
                    (self.program, self.program_of) = (None, of);
                    self.worker.forget();
                }
                // Files of the last program that compiled stay watched: the error may be that one of them is gone.
                self.included.extend(files);
                self.watch_files();
                self.suit_mesh();
            }
            Event::MeshRead { diagnostics, lost } => {
                let sources = self.program.as_ref().map(|program| Arc::clone(&program.sources)).unwrap_or_default();
                self.problems.mesh_read(&request.recipe.mesh.name(), &diagnostics, &lost, &sources);
            }
            Event::Stepping(generation) => running.stepping = Some(generation),
            Event::Preview(frame) => self.show(frame, None),
            Event::Finished(frame) => {
                self.problems.ran(&frame.warnings, &Arc::default(), frame.request.generation);
                self.inspection.fault = None;
                self.say_if_idle(&frame);
                self.show(Arc::clone(&frame), Some(of));
                self.stale = None;
                self.running = None;
                self.suit_program(&frame);
            }
            Event::Failed(failed) => {
                self.running = None;
                self.failed(failed, &request);
            }
        }
    }

    /// A mesh file that the program nobody has asked for is not for gets another one.
    fn suit_program(&mut self, first: &Frame) {
        const ANY_POLYGONS: &str = "catmull-clark.vv";
        let unasked = Arc::ptr_eq(&self.document.program.text, &self.welcome_text);
        let is_of_file = matches!(first.request.recipe.mesh, MeshSource::File(_)) && first.request.generation == 0;
        let of_triangles = first.statistics.face_degrees.iter().all(|&(degree, _)| degree == 3);
        if !unasked || !is_of_file || of_triangles {
            return;
        }
        if let Some(program) = library::program(ANY_POLYGONS) {
            let was = std::mem::replace(&mut self.fit, false);
            self.set_program(ProgramText::new(program.name, program.text));
            self.fit = was; // the mesh is the same
            self.say(Severity::Note, format!("{ANY_POLYGONS}, since not all faces are triangles"));
        }
    }

    /// Who asks for a step that changes nothing shall not doubt the button.
    fn say_if_idle(&mut self, next: &Frame) {
        let note_of = |frame: &Frame| {
            let note = frame.warnings.iter().find(|warning| warning.severity == Severity::Note);
            note.map(|note| note.message.clone())
        };
        let before = self.frame.as_deref().and_then(note_of);
        // What was said of the generation before is not said of this one.
        self.notice.take_if(|(_, text, _)| before.as_ref() == Some(text));
        let steps = next.request.generation > self.shown_generation();
        if let Some(note) = note_of(next).filter(|_| steps) {
            self.say(Severity::Note, note);
        }
    }

    fn show(&mut self, frame: Arc<Frame>, of: Option<u64>) {
        self.remember_sight(&frame);
        release(self.frame.replace(frame));
        self.frame_of = of;
        self.follow();
    }

    fn failed(&mut self, failed: Failed, request: &Request) {
        self.playing = None;
        if let FailureKind::Stopped(_) = failed.kind {
            self.stale = Some(Stale::Stopped);
            return;
        }
        self.remember_fault(&failed);
        let before = failed.generation.saturating_sub(1);
        self.problems.ran(failed.diagnostic.as_deref().map_or(&[], std::slice::from_ref), &failed.sources, before);
        let message = match self.problems.first_error() {
            Some(problem) => match problem.place.as_ref().filter(|place| place.own) {
                Some(place) => format!("line {}: {}", place.start.line, problem.diagnostic.message),
                None => problem.diagnostic.message.clone(),
            },
            None => "the program failed".to_owned(),
        };
        if failed.diagnostic.is_some() {
            self.halted = Some(Halted { generation: failed.generation, message: message.clone() });
        }
        let shown = self.frame.as_ref().filter(|_| self.frame_of.is_some()).map(|frame| &frame.request);
        match shown {
            // A step has failed: what is shown is a good result, of a generation before.
            Some(shown) if *shown.recipe == *request.recipe => {
                if self.document.generation == request.generation && self.due.is_none() {
                    self.document.generation = shown.generation;
                    self.forget_vain_change();
                }
                self.stale = None;
            }
            _ => self.stale = Some(Stale::Failed(message)),
        }
    }
}
