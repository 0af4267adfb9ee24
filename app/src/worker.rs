//! Evaluation off the window's thread.
//!
//! ```text
//!   window ── Request ──▶ slot (newest wins) ──▶ worker: compile ─ read mesh ─ generations ─ faces, scene
//!      ▲                                                   │
//!      └───────────── Report (channel, then wake) ◀────────┘
//! ```
//!
//! A [`Ticket`] stands for a request that somebody still wants: dropping it stops the work. Generations are kept, so that
//! going back or one further computes nothing twice.

use std::collections::{BTreeMap, VecDeque};
use std::panic::AssertUnwindSafe;
use std::path::PathBuf;
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use vv::Compilation;
use vv::diagnostic::{Diagnostic, Severity};
use vv::engine::{Failure, FailureKind, Limits, Output, OutputClosed, Settings};
use vv::io::{Format, ReadError, ReadOptions};
use vv::ir::Program;
use vv::mesh::faces::{Faces, faces};
use vv::mesh::statistics::{Statistics, statistics};
use vv::mesh::{Mesh, Value};
use vv::source::Sources;
use vv::stop::{Stop, Stopped};

use crate::console::{self, Console};
use crate::document::MeshSource;
use crate::evaluation::{self, Generation};
use crate::scene::Scene;
use crate::{files, library};

/// What decides every generation: two equal recipes give the same meshes.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// The program's file, or what it is called; includes are looked for beside it.
    pub path: PathBuf,
    /// The program.
    pub text: Arc<str>,
    /// Counts changes of included files.
    pub includes_revision: u64,
    /// Where generation 0 comes from.
    pub mesh: MeshSource,
    /// Counts changes of the mesh file.
    pub mesh_revision: u64,
    /// The rule; the program's default where it has none of that name.
    pub rule: Option<String>,
    /// Values of parameters; those that the program does not have, or has with another type or range, are left out.
    pub params: BTreeMap<String, Value>,
}

/// A generation of a recipe.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Of what.
    pub recipe: Arc<Recipe>,
    /// Which.
    pub generation: u64,
}

/// A request that somebody waits for. Dropping it cancels the work.
#[derive(Debug)]
pub struct Ticket {
    id: u64,
    stop: Stop,
}

impl Ticket {
    /// Whether a report answers this request.
    #[must_use]
    pub fn issued(&self, report: &Report) -> bool {
        self.id == report.ticket
    }
}

impl Drop for Ticket {
    fn drop(&mut self) {
        self.stop.request(Stopped::ByUser);
    }
}

/// News of a request.
#[derive(Debug)]
pub struct Report {
    ticket: u64,
    /// What happened.
    pub event: Event,
}

/// What can happen to a request, in this order.
#[derive(Debug)]
pub enum Event {
    /// The text was compiled; `files` are those it was made of.
    Compiled {
        /// With all that the compiler has to say.
        compilation: Compilation,
        /// The program's own file and the included ones.
        files: Vec<PathBuf>,
    },
    /// The mesh was read.
    MeshRead {
        /// What was repaired; an error if it could not be read.
        diagnostics: Vec<Diagnostic>,
    },
    /// A generation is being computed.
    Stepping(u64),
    /// The last report: it worked.
    Finished(Arc<Frame>),
    /// The last report: it did not. What was shown before is still the last good result.
    Failed(Failed),
    /// The program cannot run yet, but here is the mesh it is meant for.
    Preview(Arc<Frame>),
}

/// A generation ready to be shown.
#[derive(Debug, Clone)]
pub struct Frame {
    /// What it was asked for with.
    pub request: Request,
    /// The mesh.
    pub mesh: Mesh,
    /// Its faces.
    pub faces: Faces,
    /// Its counts.
    pub statistics: Statistics,
    /// Vertices of the control mesh, generation 0.
    pub control_vertices: usize,
    /// What closing the step found.
    pub warnings: Vec<Diagnostic>,
    /// What to draw.
    pub scene: Arc<Scene>,
    /// Where the time went.
    pub timings: Timings,
}

/// Seconds that a generation took.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Timings {
    /// The program.
    pub step: f64,
    /// Closing the step.
    pub closing: f64,
    /// Finding faces and counting.
    pub faces: f64,
    /// Preparing the picture.
    pub scene: f64,
}

/// Why a request ended without a mesh.
#[derive(Debug, Clone)]
pub struct Failed {
    /// How.
    pub kind: FailureKind,
    /// What to tell the user. `None` where the compiler or the reader of meshes has said it before.
    pub diagnostic: Option<Box<Diagnostic>>,
    /// The texts that the diagnostic's spans refer to.
    pub sources: Arc<Sources>,
    /// The generation that failed.
    pub generation: u64,
}

/// The thread that computes. Dropping it stops the work and waits for the thread to end.
pub struct Worker {
    shared: Arc<Shared>,
    reports: Receiver<Report>,
    next_id: u64,
    thread: Option<JoinHandle<()>>,
}

struct Shared {
    slot: Mutex<Slot>,
    filled: Condvar,
    console: Mutex<Console>,
}

#[derive(Default)]
struct Slot {
    request: Option<(u64, Request, Stop)>,
    closed: bool,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // A panic in the worker leaves plain data behind, never half an invariant.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Worker {
    /// Starts the thread. `wake` is called, from that thread, when there is something new to see.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn start(limits: Limits, memory: usize, wake: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let shared = Arc::new(Shared { slot: Mutex::default(), filled: Condvar::new(), console: Mutex::default() });
        let (sender, reports) = mpsc::channel();
        let bench = Bench {
            shared: Arc::clone(&shared),
            reports: sender,
            wake: Box::new(wake),
            limits,
            memory,
            compiled: None,
            input: None,
            history: None,
            shown_mesh: None,
        };
        let thread = std::thread::Builder::new()
            .name("evaluation".to_owned())
            .stack_size(8 << 20)
            .spawn(move || bench.work())?;
        Ok(Self { shared, reports, next_id: 0, thread: Some(thread) })
    }

    /// Asks for a generation. A request that has not begun yet is forgotten; one that is being worked on goes on until
    /// its ticket is dropped.
    pub fn submit(&mut self, request: Request) -> Ticket {
        self.next_id += 1;
        let ticket = Ticket { id: self.next_id, stop: Stop::new() };
        lock(&self.shared.slot).request = Some((ticket.id, request, ticket.stop.clone()));
        self.shared.filled.notify_one();
        ticket
    }

    /// The oldest report that was not taken yet, also of requests whose ticket is gone.
    #[must_use]
    pub fn report(&self) -> Option<Report> {
        self.reports.try_recv().ok()
    }

    /// What the generations have printed.
    pub fn console(&self) -> MutexGuard<'_, Console> {
        lock(&self.shared.console)
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        lock(&self.shared.slot).closed = true;
        self.shared.filled.notify_one();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// The state of the worker's thread.
struct Bench {
    shared: Arc<Shared>,
    reports: Sender<Report>,
    wake: Box<dyn Fn() + Send>,
    limits: Limits,
    /// Bytes that kept generations may use.
    memory: usize,
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
    files: Vec<PathBuf>,
}

struct Input {
    source: MeshSource,
    revision: u64,
    mesh: Option<Mesh>,
    diagnostics: Vec<Diagnostic>,
}

/// The generations of one recipe.
struct History {
    recipe: Arc<Recipe>,
    generations: BTreeMap<u64, Kept>,
    control: Option<Faces>,
}

struct Kept {
    generation: Generation,
    frame: Option<Arc<Frame>>,
}

impl Kept {
    /// The picture takes about as much again as the mesh.
    fn bytes(&self) -> usize {
        self.generation.mesh.bytes() * if self.frame.is_some() { 3 } else { 1 }
    }
}

impl Bench {
    fn work(mut self) {
        loop {
            let (ticket, request, stop) = {
                let mut slot = lock(&self.shared.slot);
                loop {
                    if slot.closed {
                        return;
                    }
                    match slot.request.take() {
                        Some(request) => break request,
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
                    })
                }
            };
            self.report(ticket, event);
        }
    }

    fn report(&self, ticket: u64, event: Event) {
        // Nobody listens any more: the window closes.
        let _ = self.reports.send(Report { ticket, event });
        (self.wake)();
    }

    fn serve(&mut self, ticket: u64, request: &Request, stop: &Stop) -> Result<Arc<Frame>, Failed> {
        let recipe = &request.recipe;
        self.compile(recipe);
        self.read(recipe, stop)?;
        let (Some(compiled), Some(input)) = (&self.compiled, &self.input) else {
            return Err(Failed::said_before(FailureKind::Program, request.generation));
        };
        let (compilation, files) = (compiled.compilation.clone(), compiled.files.clone());
        let program = compilation.program.clone();
        self.report(ticket, Event::Compiled { compilation, files });
        self.report(ticket, Event::MeshRead { diagnostics: input.diagnostics.clone() });
        let Some(mesh) = input.mesh.clone() else {
            return Err(Failed::said_before(FailureKind::Program, 0));
        };
        let mesh_key = Some((recipe.mesh.clone(), recipe.mesh_revision));
        let Some(program) = program else {
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
        let frame = self.generation(ticket, request, &program, mesh, stop)?;
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
        let (compilation, files) = files::compile(&recipe.path, &recipe.text);
        let (path, text) = (recipe.path.clone(), Arc::clone(&recipe.text));
        self.compiled = Some(Compiled { path, text, revision, compilation, files });
    }

    fn read(&mut self, recipe: &Recipe, stop: &Stop) -> Result<(), Failed> {
        let revision = recipe.mesh_revision;
        if self.input.as_ref().is_some_and(|i| i.source == recipe.mesh && i.revision == revision) {
            return Ok(());
        }
        let options = ReadOptions { stop: stop.clone(), ..ReadOptions::default() };
        let result = match &recipe.mesh {
            MeshSource::Empty => Ok((Mesh::new(), Vec::new())),
            MeshSource::File(path) => files::read_mesh(path, &options).map_err(|e| e.diagnostic),
            MeshSource::BuiltIn(name) => shipped_mesh(name, &options),
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

    fn generation(
        &mut self,
        ticket: u64,
        request: &Request,
        program: &Arc<Program>,
        input: Mesh,
        stop: &Stop,
    ) -> Result<Arc<Frame>, Failed> {
        let recipe = &request.recipe;
        let mut history = match self.history.take() {
            Some(history) if history.recipe == *recipe => history,
            _ => {
                lock(&self.shared.console).clear();
                History { recipe: Arc::clone(recipe), generations: BTreeMap::new(), control: None }
            }
        };
        let result = self.advance_to(ticket, request, program, input, stop, &mut history);
        // A step that failed leaves the generations before it as they were.
        self.history = Some(history);
        result
    }

    fn advance_to(
        &self,
        ticket: u64,
        request: &Request,
        program: &Arc<Program>,
        input: Mesh,
        stop: &Stop,
        history: &mut History,
    ) -> Result<Arc<Frame>, Failed> {
        let recipe = &request.recipe;
        let settings = Settings {
            params: params(program, &recipe.params),
            limits: self.limits,
            stop: stop.clone(),
            ..Settings::default()
        };
        let nearest = history.generations.range(..=request.generation).next_back().map(|(&g, _)| g);
        for generation in nearest.map_or(0, |g| g + 1)..=request.generation {
            let failed = |failure: Failure| Failed {
                kind: failure.kind,
                diagnostic: Some(failure.diagnostic),
                sources: Arc::clone(&program.sources),
                generation,
            };
            self.report(ticket, Event::Stepping(generation));
            let mut printer = Printer::new(self, generation);
            lock(&self.shared.console).begin(generation);
            let result = match generation.checked_sub(1).and_then(|g| history.generations.get(&g)) {
                None => evaluation::first(program, &input, &settings, &mut printer),
                Some(before) => {
                    let rule = recipe.rule.as_deref().and_then(|name| program.rule(name));
                    let Some(rule) = rule.or_else(|| program.default_rule()) else {
                        let message = "the program has no rule to step";
                        let hint = "write `void step(mesh& S) { … }`";
                        return Err(Failed {
                            diagnostic: Some(Box::new(Diagnostic::new(Severity::Error, None, message).hint(hint))),
                            ..Failed::said_before(FailureKind::Program, generation)
                        });
                    };
                    evaluation::advance(program, rule, &before.generation.mesh, generation, &settings, &mut printer)
                }
            };
            printer.flush();
            let kept = Kept { generation: result.map_err(failed)?, frame: None };
            history.generations.insert(generation, kept);
            history.evict(self.memory, generation);
        }
        let stopped = |s| Failed::said_before(FailureKind::Stopped(s), request.generation);
        let frame = history.frame(request, stop).map_err(stopped)?;
        history.evict(self.memory, request.generation);
        Ok(frame)
    }
}

impl History {
    fn frame(&mut self, request: &Request, stop: &Stop) -> Result<Arc<Frame>, Stopped> {
        let control_mesh = self.generations.get(&0).map(|kept| kept.generation.mesh.clone());
        if let (None, Some(mesh)) = (&self.control, &control_mesh) {
            self.control = Some(faces(mesh, stop)?);
        }
        let control = match (&control_mesh, &self.control) {
            (Some(mesh), Some(faces)) if request.generation > 0 => Some((mesh, faces)),
            _ => None,
        };
        let Some(kept) = self.generations.get_mut(&request.generation) else {
            return Err(Stopped::ByUser); // not reached: the caller has just made it
        };
        if let Some(frame) = &kept.frame {
            return Ok(Arc::clone(frame));
        }
        let frame = Arc::new(frame(request, &kept.generation, control, stop)?);
        kept.frame = Some(Arc::clone(&frame));
        Ok(frame)
    }

    /// Forgets pictures first, then meshes, those farthest from `current` first, until `memory` bytes suffice.
    /// Generation 0 and `current` stay.
    fn evict(&mut self, memory: usize, current: u64) {
        let mut total: usize = self.generations.values().map(Kept::bytes).sum();
        let mut order: Vec<u64> = self.generations.keys().copied().filter(|&g| g != 0 && g != current).collect();
        order.sort_by_key(|g| std::cmp::Reverse(g.abs_diff(current)));
        for g in &order {
            if total <= memory {
                return;
            }
            if let Some(kept) = self.generations.get_mut(g) {
                total -= kept.bytes();
                kept.frame = None;
                total += kept.bytes();
            }
        }
        for g in &order {
            if total <= memory {
                return;
            }
            total -= self.generations.remove(g).map_or(0, |kept| kept.bytes());
        }
    }
}

impl Failed {
    /// Nothing to add to what was reported.
    fn said_before(kind: FailureKind, generation: u64) -> Self {
        Self { kind, diagnostic: None, sources: Arc::default(), generation }
    }
}

fn frame(
    request: &Request,
    generation: &Generation,
    control: Option<(&Mesh, &Faces)>,
    stop: &Stop,
) -> Result<Frame, Stopped> {
    let began = Instant::now();
    let faces = faces(&generation.mesh, stop)?;
    let statistics = statistics(&generation.mesh, &faces, stop)?;
    let faces_s = began.elapsed().as_secs_f64();
    let began = Instant::now();
    let scene = Arc::new(Scene::new(&generation.mesh, &faces, control));
    stop.check()?;
    Ok(Frame {
        request: request.clone(),
        mesh: generation.mesh.clone(),
        faces,
        statistics,
        control_vertices: control.map_or(generation.mesh.set.len(), |(mesh, _)| mesh.set.len()),
        warnings: generation.warnings.clone(),
        scene,
        timings: Timings {
            step: generation.step_s,
            closing: generation.closing_s,
            faces: faces_s,
            scene: began.elapsed().as_secs_f64(),
        },
    })
}

fn shipped_mesh(name: &str, options: &ReadOptions) -> Result<(Mesh, Vec<Diagnostic>), Box<Diagnostic>> {
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

/// The values that fit the program's parameters.
fn params(program: &Program, values: &BTreeMap<String, Value>) -> Vec<(vv::ir::GlobalId, Value)> {
    let fits = |ty, range: Option<(Value, Value)>, value: Value| {
        value.ty() == ty
            && match (range, value) {
                (Some((Value::Int(low), Value::Int(high))), Value::Int(x)) => low <= x && x <= high,
                (Some((Value::Double(low), Value::Double(high))), Value::Double(x)) => low <= x && x <= high,
                _ => true,
            }
    };
    program
        .params()
        .filter_map(|(id, global, param)| {
            let &value = values.get(&global.name)?;
            fits(global.ty, param.range, value).then_some((id, value))
        })
        .collect()
}

/// How often printed lines are handed over: often enough to watch, seldom enough that the window gets the lock.
const FLUSH: Duration = Duration::from_millis(50);

/// Gathers what a step prints and hands it over now and then.
struct Printer<'a> {
    bench: &'a Bench,
    generation: u64,
    lines: VecDeque<String>,
    bytes: usize,
    dropped: u64,
    flushed: Instant,
}

impl<'a> Printer<'a> {
    fn new(bench: &'a Bench, generation: u64) -> Self {
        Self { bench, generation, lines: VecDeque::new(), bytes: 0, dropped: 0, flushed: Instant::now() }
    }

    fn flush(&mut self) {
        self.flushed = Instant::now();
        if self.lines.is_empty() {
            return;
        }
        lock(&self.bench.shared.console).append(self.generation, self.lines.drain(..), self.dropped);
        (self.bytes, self.dropped) = (0, 0);
        (self.bench.wake)();
    }
}

impl Output for Printer<'_> {
    fn print(&mut self, line: &str) -> Result<(), OutputClosed> {
        let line = console::shortened(line);
        self.bytes += line.len();
        self.lines.push_back(line);
        while self.lines.len() > console::MAX_LINES || self.bytes > console::MAX_BYTES {
            self.bytes -= self.lines.pop_front().map_or(0, |l| l.len());
            self.dropped += 1;
        }
        if self.flushed.elapsed() >= FLUSH {
            self.flush();
        }
        Ok(())
    }
}
