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

mod bench;
mod history;
mod idle;
mod printer;
mod results;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread::JoinHandle;

use vv::Compilation;
use vv::diagnostic::Diagnostic;
use vv::engine::{FailureKind, Limits, Machine};
use vv::ir::{FunctionId, GlobalId};
use vv::mesh::faces::Faces;
use vv::mesh::statistics::Statistics;
use vv::mesh::{Mesh, Value};
use vv::source::Sources;
use vv::stop::{Stop, Stopped};

use crate::annotate::cell::Cell;
use crate::annotate::{Annotations, Subject};
use crate::console::Console;
use crate::document::MeshSource;
use crate::inspect::findings::Findings;
use crate::inspect::lineage::Lineage;
use crate::scene::Scene;

use bench::Bench;
pub use bench::fits;

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
    /// Program, mesh and parameters.
    pub recipe: Arc<Recipe>,
    /// How many steps after `start`, which makes generation 0.
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
        /// What it says and the program cannot hold.
        lost: Vec<Diagnostic>,
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
    /// The mesh of the generation before, if it was at hand.
    pub before: Option<Mesh>,
    /// Which vertex of a generation is which of another.
    pub lineage: Lineage,
    /// The step that made it; `None` for generation 0.
    pub made: Option<Arc<Made>>,
    /// What is wrong with the mesh; known some time after the frame.
    pub findings: OnceLock<Findings>,
    /// The colours found for it.
    pub colors: Cell,
    /// Where the time went.
    pub timings: Timings,
}

/// A step, to be run again.
#[derive(Debug)]
pub struct Made {
    /// The program, ready to run.
    pub machine: Arc<Machine>,
    /// The rule.
    pub rule: FunctionId,
    /// Values of parameters.
    pub params: Vec<(GlobalId, Value)>,
}

impl Frame {
    /// All that is known of its mesh.
    #[must_use]
    pub fn subject(&self) -> Subject<'_> {
        Subject {
            mesh: &self.mesh,
            faces: &self.faces,
            scene: &self.scene,
            generation: self.request.generation,
            before: self.before.as_ref(),
            lineage: &self.lineage,
            tint: self.colors.latest(),
        }
    }
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
    /// Preparing the picture, at the same time as counting.
    pub scene: f64,
}

/// What is known of a generation that was reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// Members of its mesh.
    pub vertices: usize,
    /// Seconds the program took.
    pub step: f64,
    /// Whether it is kept; else going there computes it again.
    pub kept: bool,
}

/// Why a request ended without a mesh.
#[derive(Debug, Clone)]
pub struct Failed {
    /// Whether the program failed, a budget ran out or somebody stopped it.
    pub kind: FailureKind,
    /// What to tell the user. `None` where the compiler or the reader of meshes has said it before.
    pub diagnostic: Option<Box<Diagnostic>>,
    /// The texts that the diagnostic's spans refer to.
    pub sources: Arc<Sources>,
    /// The generation that failed.
    pub generation: u64,
    /// The mesh before the step that failed, if a step did.
    pub before: Option<Box<Mesh>>,
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
    reached: Mutex<BTreeMap<u64, Reached>>,
    /// Bytes that kept generations may use.
    memory: AtomicUsize,
    /// Whether what was computed is to be forgotten.
    forgotten: AtomicBool,
    /// What is to be shown on the frames to come.
    annotations: Mutex<Annotations>,
}

#[derive(Default)]
struct Slot {
    request: Option<(u64, Request, Stop)>,
    /// Stops what is being worked on.
    current: Option<Stop>,
    closed: bool,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // A panic in the worker leaves plain data behind, never half an invariant.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Worker {
    /// Starts the thread. `wake` is called, from other threads, when a request has come to its end, something was printed,
    /// or more can be done with a picture. What happens on the way is for those who look now and then.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn start(limits: Limits, memory: usize, wake: impl Fn() + Send + Sync + 'static) -> std::io::Result<Self> {
        let shared = Arc::new(Shared {
            slot: Mutex::default(),
            filled: Condvar::new(),
            console: Mutex::default(),
            reached: Mutex::default(),
            memory: AtomicUsize::new(memory),
            forgotten: AtomicBool::new(false),
            annotations: Mutex::default(),
        });
        let (sender, reports) = mpsc::channel();
        let bench = Bench::new(Arc::clone(&shared), sender, Arc::new(wake), limits);
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

    /// Bytes that generations may be kept in from the next one on.
    pub fn keep_within(&self, bytes: usize) {
        self.shared.memory.store(bytes, Ordering::Relaxed);
    }

    /// The oldest report that was not taken yet, also of requests whose ticket is gone.
    #[must_use]
    pub fn report(&self) -> Option<Report> {
        self.reports.try_recv().ok()
    }

    /// The generations that the last recipe has reached.
    pub fn reached(&self) -> MutexGuard<'_, BTreeMap<u64, Reached>> {
        lock(&self.shared.reached)
    }

    /// Forgets the generations of the last recipe and what they have printed: they are of no program any more.
    pub fn forget(&self) {
        self.shared.forgotten.store(true, Ordering::Relaxed);
        lock(&self.shared.reached).clear();
        lock(&self.shared.console).clear();
    }

    /// From now on frames come with the colours that are asked for.
    pub fn annotate(&self, annotations: &Annotations) {
        lock(&self.shared.annotations).clone_from(annotations);
    }

    /// What the generations have printed.
    pub fn console(&self) -> MutexGuard<'_, Console> {
        lock(&self.shared.console)
    }
}

/// Drops something large on another thread: to give back the memory of a million faces takes longer than a window has
/// between two pictures.
pub fn release<T: Send + 'static>(large: T) {
    rayon::spawn(move || drop(large));
}

impl Drop for Worker {
    fn drop(&mut self) {
        let mut slot = lock(&self.shared.slot);
        slot.closed = true;
        if let Some(stop) = &slot.current {
            stop.request(Stopped::ByUser);
        }
        drop(slot);
        self.shared.filled.notify_one();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    const ENDLESS: &str = "void f(mesh& S) { print(\"began\"); while (true) { } }";

    fn worker(memory: usize) -> Worker {
        Worker::start(Limits::default(), memory, || {}).unwrap()
    }

    fn request(text: &str, generation: u64) -> Request {
        let recipe = Recipe {
            path: "test.vv".into(),
            text: text.into(),
            includes_revision: 0,
            mesh: MeshSource::BuiltIn("octahedron.obj".to_owned()),
            mesh_revision: 0,
            rule: None,
            params: BTreeMap::new(),
        };
        Request { recipe: Arc::new(recipe), generation }
    }

    /// The next report of a ticket that satisfies `wanted`. The time allowed is for slow machines only.
    #[track_caller]
    fn wait_for(worker: &Worker, ticket: &Ticket, wanted: impl Fn(&Event) -> bool) -> Event {
        let began = Instant::now();
        loop {
            match worker.report() {
                Some(report) if ticket.issued(&report) && wanted(&report.event) => return report.event,
                Some(_) => {}
                None => std::thread::sleep(Duration::from_millis(2)),
            }
            assert!(began.elapsed() < Duration::from_secs(30), "waited in vain");
        }
    }

    #[track_caller]
    fn finish(worker: &mut Worker, request: Request) -> Result<Arc<Frame>, Failed> {
        let ticket = worker.submit(request);
        let is_last = |e: &Event| matches!(e, Event::Finished(_) | Event::Failed(_));
        match wait_for(worker, &ticket, is_last) {
            Event::Finished(frame) => Ok(frame),
            Event::Failed(failed) => Err(failed),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_request_gives_the_generation_asked_for() {
        let mut worker = worker(1 << 30);
        let frame = finish(&mut worker, request("void f(mesh& S) { forall v in S v$pos *= 2.0; }", 3)).unwrap();
        assert_eq!(frame.request.generation, 3);
        assert_eq!(frame.mesh.positions()[0].length(), 8.0);
        assert_eq!((frame.statistics.faces, frame.control_vertices), (8, 6));
    }

    #[test]
    fn the_window_is_woken_for_the_picture_and_when_it_can_be_pointed_at() {
        let (waker, awake) = mpsc::channel();
        let mut worker = Worker::start(Limits::default(), 1 << 30, move || _ = waker.send(())).unwrap();
        let frame = finish(&mut worker, request("void f(mesh& S) { }", 3)).unwrap();
        (0..3).for_each(|_| awake.recv_timeout(Duration::from_secs(30)).unwrap());
        assert!(frame.scene.is_indexed() && frame.findings.get().is_some());
        assert_eq!(awake.recv_timeout(Duration::from_millis(50)), Err(mpsc::RecvTimeoutError::Timeout));
    }

    #[test]
    fn dropping_a_ticket_stops_its_work_and_the_next_request_is_served() {
        let mut worker = worker(1 << 30);
        let endless = worker.submit(request(ENDLESS, 1));
        wait_for(&worker, &endless, |e| matches!(e, Event::Stepping(1)));
        let began = Instant::now();
        drop(endless);
        finish(&mut worker, request("void f(mesh& S) { }", 1)).unwrap();
        assert!(began.elapsed() < Duration::from_secs(10));
    }

    #[test]
    fn the_newest_request_wins() {
        let mut worker = worker(1 << 30);
        let endless = worker.submit(request(ENDLESS, 1));
        wait_for(&worker, &endless, |e| matches!(e, Event::Stepping(1)));
        // Neither has begun when the other comes.
        let forgotten = worker.submit(request(ENDLESS, 1));
        let newest = worker.submit(request("void f(mesh& S) { }", 2));
        drop(endless);
        wait_for(&worker, &newest, |e| matches!(e, Event::Finished(_)));
        while let Some(report) = worker.report() {
            assert!(!forgotten.issued(&report), "{report:?}");
        }
    }

    #[test]
    fn dropping_the_worker_ends_what_it_does() {
        let mut worker = worker(1 << 30);
        let endless = worker.submit(request(ENDLESS, 1));
        wait_for(&worker, &endless, |e| matches!(e, Event::Stepping(1)));
        drop(worker); // returns
        drop(endless);
    }

    #[test]
    fn generations_that_are_kept_are_not_computed_again() {
        let mut worker = worker(1 << 30);
        let text = "void f(mesh& S) { print(\"once\"); }";
        let first = finish(&mut worker, request(text, 1)).unwrap();
        finish(&mut worker, request(text, 2)).unwrap();
        let again = finish(&mut worker, request(text, 1)).unwrap();
        assert!(Arc::ptr_eq(&first, &again));
        assert_eq!(worker.console().len(9), 2);
    }

    #[test]
    fn another_recipe_begins_with_nothing_printed() {
        let mut worker = worker(1 << 30);
        finish(&mut worker, request("void f(mesh& S) { print(\"said\"); }", 2)).unwrap();
        assert_eq!((worker.console().len(9), worker.reached().len()), (2, 3));
        finish(&mut worker, request("void f(mesh& S) { }", 1)).unwrap();
        assert_eq!((worker.console().len(9), worker.reached().len()), (0, 2));
    }

    #[test]
    fn generations_that_no_memory_was_left_for_come_out_the_same() {
        let text = "void f(mesh& S) { forall v in S v$pos *= 1.5 + random(); }";
        let (mut roomy, mut tight) = (worker(1 << 30), worker(0));
        for generation in [4, 2, 3, 0, 4] {
            let a = finish(&mut roomy, request(text, generation)).unwrap();
            let b = finish(&mut tight, request(text, generation)).unwrap();
            assert_eq!(a.mesh.positions(), b.mesh.positions(), "generation {generation}");
        }
    }

    #[test]
    fn generations_that_are_not_kept_any_more_are_known() {
        let mut worker = worker(0);
        finish(&mut worker, request("void f(mesh& S) { }", 3)).unwrap();
        let kept = |worker: &Worker| worker.reached().values().map(|r| r.kept).collect::<Vec<_>>();
        assert_eq!(kept(&worker), [true, false, false, true]);
        finish(&mut worker, request("void f(mesh& S) { }", 1)).unwrap();
        assert_eq!(kept(&worker), [true, true, false, false]);
    }

    #[test]
    fn a_failed_step_leaves_the_generations_before_it() {
        let mut worker = worker(1 << 30);
        let text = "mesh { int n = 3; };\nvoid f(mesh& S) { S$n -= 1; print(1 / S$n); }";
        let failed = finish(&mut worker, request(text, 9)).unwrap_err();
        assert_eq!((failed.kind, failed.generation), (FailureKind::Program, 3));
        assert!(failed.diagnostic.is_some());
        finish(&mut worker, request(text, 2)).unwrap();
        assert_eq!(worker.console().lines(2, 0..9), ["0", "1"]);
    }

    #[test]
    fn endless_printing_fills_no_memory() {
        let mut worker = worker(1 << 30);
        let text = "void f(mesh& S) { while (true) print(\"again and again\"); }";
        let ticket = worker.submit(request(text, 1));
        wait_for(&worker, &ticket, |e| matches!(e, Event::Stepping(1)));
        let began = Instant::now();
        while worker.console().dropped() == 0 {
            assert!(began.elapsed() < Duration::from_secs(30));
            std::thread::sleep(Duration::from_millis(5));
        }
        assert!(worker.console().len(1) <= crate::console::MAX_LINES);
    }

    #[test]
    fn parameters_that_do_not_fit_are_left_at_their_defaults() {
        let text = "param double w = 0.5 in [0, 1];\nvoid f(mesh& S) { forall v in S v$pos *= w; }";
        let size = |value| {
            let mut request = request(text, 1);
            Arc::make_mut(&mut request.recipe).params.insert("w".to_owned(), value);
            finish(&mut worker(1 << 30), request).unwrap().mesh.positions()[0].length()
        };
        assert_eq!(size(Value::Double(0.25)), 0.25);
        assert_eq!(size(Value::Double(7.0)), 0.5);
        assert_eq!(size(Value::Double(-1.0)), 0.5);
        assert_eq!(size(Value::Bool(true)), 0.5);
    }
}
