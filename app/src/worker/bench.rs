//! The worker's thread: requests to frames.

use std::collections::BTreeMap;
use std::panic::AssertUnwindSafe;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::sync::mpsc::Sender;
use std::sync::{Arc, PoisonError};

use vv::Compilation;
use vv::diagnostic::{Diagnostic, Severity};
use vv::engine::{Engine, Failure, FailureKind, Limits, Machine, Settings};
use vv::io::{Format, ReadError, ReadOptions};
use vv::ir::{Global, Param, Program};
use vv::mesh::{Mesh, Value};
use vv::stop::{Stop, Stopped};

use super::history::{History, frame};
use super::idle::is_idle;
use super::printer::Printer;
use super::results;
use super::{Event, Failed, Frame, Made, Reached, Recipe, Report, Request, Shared, lock};
use crate::annotate::Quantity;
use crate::document::MeshSource;
use crate::evaluation::{self, Generation};
use crate::inspect::findings::Findings;
use crate::{brought, files, library, trace};

/// Of a step that does nothing that one could see.
const IDLE: &str = "the step changed nothing";

/// The state of the worker's thread.
pub(super) struct Bench {
    shared: Arc<Shared>,
    reports: Sender<Report>,
    wake: Arc<dyn Fn() + Send + Sync>,
    limits: Limits,
    compiled: Option<Compiled>,
    input: Option<Input>,
    history: Option<History>,
    /// Source and revision of the mesh that the last frame came from.
    shown_mesh: Option<(MeshSource, u64)>,
}

struct Compiled {
    path: PathBuf,
    text: Arc<str>,
    revision: u64,
    compilation: Compilation,
    /// The program ready to run, if it has no error.
    machine: Option<Arc<Machine>>,
    files: Vec<PathBuf>,
}

struct Input {
    source: MeshSource,
    revision: u64,
    mesh: Option<Mesh>,
    diagnostics: Vec<Diagnostic>,
}

impl Bench {
    pub(super) fn new(
        shared: Arc<Shared>,
        reports: Sender<Report>,
        wake: Arc<dyn Fn() + Send + Sync>,
        limits: Limits,
    ) -> Self {
        let (compiled, input, history, shown_mesh) = (None, None, None, None);
        Self { shared, reports, wake, limits, compiled, input, history, shown_mesh }
    }

    /// Serves one request after the other until the worker is dropped.
    pub(super) fn work(mut self) {
        loop {
            let (ticket, request, stop) = {
                let mut slot = lock(&self.shared.slot);
                loop {
                    if slot.closed {
                        return;
                    }
                    match slot.request.take() {
                        Some(request) => {
                            slot.current = Some(request.2.clone());
                            break request;
                        }
                        None => slot = self.shared.filled.wait(slot).unwrap_or_else(PoisonError::into_inner),
                    }
                }
            };
            let generation = request.generation;
            let outcome = std::panic::catch_unwind(AssertUnwindSafe(|| self.serve(ticket, &request, &stop)));
            let event = match outcome {
                Ok(Ok(frame)) => Event::Finished(frame),
                Ok(Err(failed)) => Event::Failed(failed),
                Err(_) => {
                    // Whatever was being changed is suspect now.
                    (self.compiled, self.input, self.history) = (None, None, None);
                    let message = "vv itself failed here, which is a mistake in vv; the window goes on";
                    Event::Failed(Failed {
                        kind: FailureKind::Program,
                        diagnostic: Some(Box::new(Diagnostic::new(Severity::Error, None, message))),
                        sources: Arc::default(),
                        generation,
                        before: None,
                    })
                }
            };
            self.report(ticket, event);
        }
    }

    fn report(&self, ticket: u64, event: Event) {
        let frame = match &event {
            Event::Finished(frame) | Event::Preview(frame) => Some(Arc::clone(frame)),
            _ => None,
        };
        // What is on its way is seen when the window looks; to draw it would delay what comes at its end.
        let is_last = !matches!(event, Event::Compiled { .. } | Event::MeshRead { .. } | Event::Stepping(_));
        // Nobody listens any more: the window closes.
        let _ = self.reports.send(Report { ticket, event });
        if is_last {
            (self.wake)();
        }
        // The picture comes first; what is needed to point at it comes after it, and no request waits for that.
        if let Some(frame) = frame.filter(|frame| !frame.scene.is_indexed() || frame.findings.get().is_none()) {
            let wake = Arc::clone(&self.wake);
            rayon::spawn(move || {
                frame.scene.build_index();
                wake();
                let _span = trace::span("findings");
                // Nobody stops this: it takes less than what comes before it.
                let found = Findings::of(&frame.mesh, &frame.faces, frame.statistics.valid, &Stop::new());
                frame.findings.get_or_init(|| found.unwrap_or_default());
                drop(frame);
                wake();
            });
        }
    }

    fn serve(&mut self, ticket: u64, request: &Request, stop: &Stop) -> Result<Arc<Frame>, Failed> {
        let recipe = &request.recipe;
        self.compile(recipe);
        let said_before = || Failed::said_before(FailureKind::Program, request.generation);
        let compiled = self.compiled.as_ref().ok_or_else(said_before)?;
        let (compilation, files) = (compiled.compilation.clone(), compiled.files.clone());
        let machine = compiled.machine.clone();
        // Before the mesh, which may be large: what the program is need not wait for it.
        self.report(ticket, Event::Compiled { compilation, files });
        self.read(recipe, stop)?;
        let input = self.input.as_ref().ok_or_else(said_before)?;
        let is_file = matches!(recipe.mesh, MeshSource::File(_) | MeshSource::BuiltIn(_));
        let both = machine.as_ref().zip(input.mesh.as_ref()).filter(|_| is_file);
        let lost = both.map(|(machine, mesh)| brought::lost(machine.program(), mesh)).unwrap_or_default();
        self.report(ticket, Event::MeshRead { diagnostics: input.diagnostics.clone(), lost });
        let Some(mesh) = input.mesh.clone() else {
            return Err(Failed::said_before(FailureKind::Program, 0));
        };
        let mesh_key = Some((recipe.mesh.clone(), recipe.mesh_revision));
        let Some(machine) = machine else {
            if self.shown_mesh != mesh_key {
                let request = Request { recipe: Arc::clone(recipe), generation: 0 };
                let first = Generation { mesh, ..Generation::default() };
                let stopped = |_| Failed::said_before(FailureKind::Stopped(Stopped::ByUser), 0);
                let frame = frame(&request, &first, None, stop).map_err(stopped)?;
                self.report(ticket, Event::Preview(Arc::new(frame)));
                self.shown_mesh = mesh_key;
            }
            return Err(Failed::said_before(FailureKind::Program, request.generation));
        };
        let frame = self.generation(ticket, request, &machine, mesh, stop)?;
        self.shown_mesh = mesh_key;
        Ok(frame)
    }

    fn compile(&mut self, recipe: &Recipe) {
        let revision = recipe.includes_revision;
        if let Some(c) = &self.compiled
            && c.path == recipe.path
            && c.text == recipe.text
            && c.revision == revision
        {
            return;
        }
        let span = trace::span("checking");
        let (mut compilation, files) = files::compile(&recipe.path, &recipe.text);
        drop(span);
        let _span = trace::span("compiling");
        let machine = compilation.program.clone().map(|p| Arc::new(Machine::new(p, Engine::Native)));
        if let Some(refusal) = machine.as_ref().and_then(|m| m.refusal()) {
            compilation.diagnostics.push(Diagnostic::new(Severity::Note, None, refusal));
        }
        let (path, text) = (recipe.path.clone(), Arc::clone(&recipe.text));
        self.compiled = Some(Compiled { path, text, revision, compilation, machine, files });
    }

    fn read(&mut self, recipe: &Recipe, stop: &Stop) -> Result<(), Failed> {
        let revision = recipe.mesh_revision;
        if self.input.as_ref().is_some_and(|i| i.source == recipe.mesh && i.revision == revision) {
            return Ok(());
        }
        let _span = trace::span("reading the mesh");
        let result = match self.known(&recipe.mesh) {
            Some(mesh) => Ok((mesh, Vec::new())),
            None => results::read(&recipe.mesh, self.limits, stop),
        };
        if let Err(stopped) = stop.check() {
            return Err(Failed::said_before(FailureKind::Stopped(stopped), 0));
        }
        let source = recipe.mesh.clone();
        self.input = Some(match result {
            Ok((mesh, diagnostics)) => Input { source, revision, mesh: Some(mesh), diagnostics },
            Err(error) => Input { source, revision, mesh: None, diagnostics: vec![*error] },
        });
        Ok(())
    }

    /// The mesh of a source that was computed just now.
    fn known(&self, source: &MeshSource) -> Option<Mesh> {
        let (MeshSource::Result(request), Some(history)) = (source, &self.history) else { return None };
        let kept = history.generations.get(&request.generation).filter(|_| history.recipe == request.recipe)?;
        Some(kept.generation.mesh.clone())
    }

    fn generation(
        &mut self,
        ticket: u64,
        request: &Request,
        machine: &Arc<Machine>,
        input: Mesh,
        stop: &Stop,
    ) -> Result<Arc<Frame>, Failed> {
        let recipe = &request.recipe;
        if self.shared.forgotten.swap(false, Ordering::Relaxed) {
            self.history = None;
        }
        let mut history = match self.history.take() {
            Some(history) if history.recipe == *recipe => history,
            _ => {
                lock(&self.shared.console).clear();
                lock(&self.shared.reached).clear();
                History::new(Arc::clone(recipe))
            }
        };
        let result = self.advance_to(ticket, request, machine, input, stop, &mut history);
        // A step that failed leaves the generations before it as they were.
        self.history = Some(history);
        result
    }

    fn advance_to(
        &self,
        ticket: u64,
        request: &Request,
        machine: &Arc<Machine>,
        input: Mesh,
        stop: &Stop,
        history: &mut History,
    ) -> Result<Arc<Frame>, Failed> {
        let recipe = &request.recipe;
        let program = machine.program();
        let settings = Settings {
            params: params(program, &recipe.params),
            limits: self.limits,
            stop: stop.clone(),
            ..Settings::default()
        };
        let named = recipe.rule.as_deref().and_then(|name| program.rule(name));
        let rule = named.or_else(|| program.default_rule());
        let nearest = history.generations.range(..=request.generation).next_back().map(|(&g, _)| g);
        for generation in nearest.map_or(0, |g| g + 1)..=request.generation {
            let failed = |failure: Failure| Failed {
                kind: failure.kind,
                diagnostic: Some(failure.diagnostic),
                sources: Arc::clone(&program.sources),
                generation,
                before: match generation.checked_sub(1) {
                    None => Some(Box::new(input.clone())),
                    Some(g) => history.generations.get(&g).map(|kept| Box::new(kept.generation.mesh.clone())),
                },
            };
            self.report(ticket, Event::Stepping(generation));
            let mut printer = Printer::new(&self.shared, &*self.wake, generation);
            lock(&self.shared.console).begin(generation);
            let result = match generation.checked_sub(1).and_then(|g| history.generations.get(&g)) {
                None => evaluation::first(machine, &input, &settings, &mut printer),
                Some(before) => {
                    let Some(rule) = rule else {
                        let message = "the program has no rule to step";
                        let hint = "write `void step(mesh& S) { … }`";
                        return Err(Failed {
                            diagnostic: Some(Box::new(Diagnostic::new(Severity::Error, None, message).hint(hint))),
                            ..Failed::said_before(FailureKind::Program, generation)
                        });
                    };
                    let before = &before.generation;
                    let made = evaluation::advance(machine, rule, &before.mesh, generation, &settings, &mut printer);
                    // What the first step was not for, none after it is.
                    made.map(|made| Generation { unfit: made.unfit.or_else(|| before.unfit.clone()), ..made })
                }
            };
            printer.flush();
            let printed = printer.used;
            let mut made = result.map_err(failed)?;
            let before = generation.checked_sub(1).and_then(|g| history.generations.get(&g));
            if before.is_some_and(|before| !printed && is_idle(&before.generation.mesh, &made.mesh)) {
                made.warnings.push(Diagnostic::new(Severity::Note, None, IDLE));
            }
            let reached = Reached { vertices: made.mesh.set.len(), step: made.step_s, kept: true };
            history.insert(generation, made);
            lock(&self.shared.reached).insert(generation, reached);
            self.evict(history, generation);
        }
        let stopped = |s| Failed::said_before(FailureKind::Stopped(s), request.generation);
        let rule = rule.filter(|_| request.generation > 0);
        let made = rule.map(|rule| Made { machine: Arc::clone(machine), rule, params: settings.params.clone() });
        let frame = history.frame(request, made, stop).map_err(stopped)?;
        let annotations = lock(&self.shared.annotations).clone();
        frame.colors.find(&frame.subject(), &annotations, stop);
        self.evict(history, request.generation);
        Ok(frame)
    }

    fn evict(&self, history: &mut History, current: u64) {
        let compared = match lock(&self.shared.annotations).color_by {
            Quantity::Since(generation) => Some(generation),
            _ => None,
        };
        let gone = history.evict(self.shared.memory.load(Ordering::Relaxed), current, compared);
        let mut reached = lock(&self.shared.reached);
        for generation in gone {
            if let Some(reached) = reached.get_mut(&generation) {
                reached.kept = false;
            }
        }
    }
}

impl Failed {
    /// Nothing to add to what was reported.
    fn said_before(kind: FailureKind, generation: u64) -> Self {
        Self { kind, diagnostic: None, sources: Arc::default(), generation, before: None }
    }
}

pub(super) fn shipped_mesh(name: &str, options: &ReadOptions) -> Result<(Mesh, Vec<Diagnostic>), Box<Diagnostic>> {
    let error = |message: String| Box::new(Diagnostic::new(Severity::Error, None, message));
    let shipped = library::MESHES.iter().find(|m| m.name == name);
    let format = name.rsplit_once('.').and_then(|(_, extension)| Format::from_extension(extension));
    let (Some(shipped), Some(format)) = (shipped, format) else {
        return Err(error(format!("no mesh called `{name}` ships with vv")));
    };
    vv::io::read(shipped.text.as_bytes(), format, options).map_err(|e| match e {
        ReadError::Invalid { diagnostic, .. } => diagnostic,
        ReadError::Stopped(stopped) => error(stopped.to_string()),
    })
}

/// Whether a parameter can have this value.
#[must_use]
pub fn fits(global: &Global, param: &Param, value: Value) -> bool {
    value.ty() == global.ty
        && match (param.range, value) {
            (Some((Value::Int(low), Value::Int(high))), Value::Int(x)) => low <= x && x <= high,
            (Some((Value::Double(low), Value::Double(high))), Value::Double(x)) => low <= x && x <= high,
            _ => true,
        }
}

/// The values that fit the program's parameters.
pub(super) fn params(program: &Program, values: &BTreeMap<String, Value>) -> Vec<(vv::ir::GlobalId, Value)> {
    program
        .params()
        .filter_map(|(id, global, param)| {
            let &value = values.get(&global.name)?;
            fits(global, param, value).then_some((id, value))
        })
        .collect()
}
