//! The modeler without its window: document, worker, watched files, and what has become of them.
//!
//! [`Session::apply`] carries commands out, [`Session::poll`] takes in what has happened meanwhile. Neither waits for
//! anything; panels read the rest.

mod problem;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver};
use std::sync::{Arc, MutexGuard};
use std::time::{Duration, Instant};

use glam::DVec3;
use vv::diagnostic::Severity;
use vv::engine::{FailureKind, Limits};
use vv::ir::Program;
use vv::mesh::Value;

use crate::camera::Camera;
use crate::command::{Answer, Command, Panel, ThemeChoice};
use crate::console::Console;
use crate::document::{Document, MeshSource, NOWHERE, ProgramText};
use crate::scene::{Sphere, Style};
use crate::watch::Watch;
use crate::worker::{Event, Failed, Frame, Recipe, Report, Request, Ticket, Worker};
use crate::{files, library};

pub use problem::{Place, Problem, Problems};

/// How long a text rests before it is compiled.
const TYPING_PAUSE: Duration = Duration::from_millis(300);
/// How long a computation may go on for something that is no longer wanted: what is nearly done is worth seeing, so that
/// a slider shows something while it moves.
const GRACE: Duration = Duration::from_millis(250);
/// Time between two generations when playing.
const BEAT: Duration = Duration::from_millis(600);
/// Playing pauses before a generation that would probably have more vertices.
const PLAY_VERTICES: usize = 1_000_000;
/// A file dialog that is gone sooner than this was never there.
const NO_DIALOG: Duration = Duration::from_millis(500);
/// How long a notice is shown.
const NOTICE: Duration = Duration::from_secs(6);
/// Bytes that kept generations may use.
const MEMORY: usize = 2 << 30;

/// What a file is chosen for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// To open a program.
    OpenProgram,
    /// To open a mesh.
    OpenMesh,
    /// To save the program.
    SaveProgram,
    /// To save the mesh.
    ExportMesh,
}

/// A question to the user.
#[derive(Debug, Clone, PartialEq)]
pub enum Dialog {
    /// Save the program before `then`, which would lose its text?
    Unsaved {
        /// What comes after.
        then: Box<Command>,
    },
    /// Where no file dialog opens: the path, please.
    TypePath {
        /// What for.
        purpose: Purpose,
        /// As typed so far.
        path: String,
    },
}

/// Why what is shown is not what is wanted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Stale {
    /// The program or its input has an error.
    Failed(String),
    /// The user stopped it.
    Stopped,
}

/// Which panels are open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Panels {
    /// Program text.
    pub program: bool,
    /// Problems and console.
    pub messages: bool,
    /// Parameters, display, statistics.
    pub inspector: bool,
}

impl Panels {
    /// Whether it is.
    #[must_use]
    pub fn is_open(&self, panel: Panel) -> bool {
        match panel {
            Panel::Program => self.program,
            Panel::Messages => self.messages,
            Panel::Inspector => self.inspector,
        }
    }
}

/// What the worker is at.
struct Running {
    ticket: Ticket,
    request: Request,
    since: Instant,
    stepping: Option<u64>,
}

/// A file dialog that is open.
struct Chooser {
    purpose: Purpose,
    since: Instant,
    result: Receiver<Option<PathBuf>>,
}

/// The modeler without its window.
pub struct Session {
    /// What is worked on. Read it; change it by commands.
    pub document: Document,
    /// Light or dark.
    pub theme: ThemeChoice,
    /// Which panels are open.
    pub panels: Panels,
    /// The question that is open. Its text field is edited in place.
    pub dialog: Option<Dialog>,
    /// A place of the program that the editor shall show; the editor takes it.
    pub reveal: Option<std::ops::Range<usize>>,
    /// The viewport shall bring all in sight; the viewport takes it.
    pub fit: bool,

    worker: Worker,
    watch: Watch,
    wake: Arc<dyn Fn() + Send + Sync>,
    includes_revision: u64,
    mesh_revision: u64,
    included: BTreeSet<PathBuf>,

    /// When to ask for what is wanted, if it is not what was asked for last.
    due: Option<Instant>,
    running: Option<Running>,
    frame: Option<Arc<Frame>>,
    stale: Option<Stale>,
    program: Option<Arc<Program>>,
    problems: Problems,

    playing: Option<Instant>,
    text_on_disk: Option<Arc<str>>,
    chooser: Option<Chooser>,
    background: Vec<Receiver<Result<String, String>>>,
    notice: Option<(Severity, String, Instant)>,
    wants_quit: bool,
}

impl Session {
    /// Opens the files given; for what is not given, something that ships with vv. `wake` is called, from other threads,
    /// when [`Session::poll`] has something to take in.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn new(
        mesh: Option<PathBuf>,
        program: Option<PathBuf>,
        wake: Arc<dyn Fn() + Send + Sync>,
    ) -> std::io::Result<Self> {
        let (waker, watcher) = (Arc::clone(&wake), Arc::clone(&wake));
        let worker = Worker::start(Limits::default(), MEMORY, move || waker())?;
        let watch = Watch::start(move || watcher())?;
        let mut session = Self {
            document: welcome(mesh.is_none() && program.is_none()),
            theme: ThemeChoice::System,
            panels: Panels { program: true, messages: true, inspector: true },
            dialog: None,
            reveal: None,
            fit: true,
            worker,
            watch,
            wake,
            includes_revision: 0,
            mesh_revision: 0,
            included: BTreeSet::new(),
            due: None,
            running: None,
            frame: None,
            stale: None,
            program: None,
            problems: Problems::default(),
            playing: None,
            text_on_disk: None,
            chooser: None,
            background: Vec::new(),
            notice: None,
            wants_quit: false,
        };
        session.ask_now();
        if let Some(path) = program {
            session.open_program(&path);
        }
        if let Some(path) = mesh {
            session.use_mesh(MeshSource::File(path));
        }
        Ok(session)
    }

    /// Carries a command out. The only place where a document changes.
    pub fn apply(&mut self, command: Command) {
        let generation = self.document.generation;
        match command {
            Command::NewProgram => self.unless_unsaved(command, |s| {
                s.set_program(ProgramText::new("untitled.vv", ""));
            }),
            Command::Choose(purpose) => self.choose(purpose),
            Command::Open(ref path) if is_program(path) => {
                let path = path.clone();
                self.unless_unsaved(command, |s| s.open_program(&path));
            }
            Command::Open(path) => self.use_mesh(MeshSource::File(path)),
            Command::OpenExample(name) => self.unless_unsaved(command, |s| {
                if let Some(example) = library::program(name) {
                    s.set_program(ProgramText::new(example.name, example.text));
                }
            }),
            Command::UseMesh(source) => self.use_mesh(source),
            Command::Save => match self.document.program.path.clone() {
                Some(path) => self.save_to(&path),
                None => self.choose(Purpose::SaveProgram),
            },
            Command::SaveTo(path) => self.save_to(&path),
            Command::ExportTo(path) => self.export_to(path),
            Command::TakeFromDisk => {
                if let Some(text) = self.text_on_disk.take() {
                    self.document.program.saved = Arc::clone(&text);
                    self.document.program.text = text;
                    self.ask_now();
                }
            }
            Command::KeepMine => {
                if let Some(text) = self.text_on_disk.take() {
                    self.document.program.saved = text;
                }
            }
            Command::AnswerUnsaved(answer) => self.answer_unsaved(answer),
            Command::CloseDialog => self.dialog = None,
            Command::Quit => self.unless_unsaved(command, |s| s.wants_quit = true),

            Command::Edit(text) => {
                if self.document.program.text != text {
                    self.document.program.text = text;
                    self.ask_after(TYPING_PAUSE);
                }
            }
            Command::Fix(hint) => self.fix(&hint),
            Command::Reveal(range) => {
                self.panels.program = true;
                self.reveal = Some(range);
            }
            Command::Run => {
                self.includes_revision += 1;
                self.mesh_revision += 1;
                self.ask_now();
            }

            // A step that failed is tried again, not stepped over.
            Command::Step if self.stale.is_some() => self.ask_now(),
            Command::Step => self.go_to(generation.saturating_add(1)),
            Command::Back => self.pause_and_go_to(generation.saturating_sub(1)),
            Command::Rewind => self.pause_and_go_to(0),
            Command::GoTo(generation) => self.pause_and_go_to(generation),
            Command::Play if self.playing.is_some() => self.playing = None,
            Command::Play => self.playing = Some(Instant::now()),
            Command::Stop => self.stop(),

            Command::ChooseRule(name) => {
                self.document.rule = Some(name);
                self.ask_now();
            }
            Command::SetParam(name, value) => {
                self.document.params.insert(name, value);
                self.ask_now();
            }
            Command::ResetParam(name) => {
                self.document.params.remove(&name);
                self.ask_now();
            }
            Command::ResetParams => {
                self.document.params.clear();
                self.ask_now();
            }

            Command::SetStyle(style) => self.document.style = style,
            Command::Faces => self.change_style(|s| {
                s.faces = !s.faces;
                s.edges |= !s.faces; // else nothing is left to see
            }),
            Command::Edges => self.change_style(|s| s.edges = !s.edges),
            Command::Vertices => self.change_style(|s| s.vertices = !s.vertices),
            Command::Smooth => self.change_style(|s| s.smooth = !s.smooth),
            Command::Control => self.change_style(|s| s.control = !s.control),
            Command::SetCamera(camera) => self.document.camera = camera,
            Command::Fit => self.fit = true,
            Command::SetTheme(theme) => self.theme = theme,
            Command::Toggle(Panel::Program) => self.panels.program = !self.panels.program,
            Command::Toggle(Panel::Messages) => self.panels.messages = !self.panels.messages,
            Command::Toggle(Panel::Inspector) => self.panels.inspector = !self.panels.inspector,
        }
    }

    /// Takes in what has happened since the last call. Returns when to call again at the latest, if nothing wakes.
    pub fn poll(&mut self) -> Option<Duration> {
        while let Some(report) = self.worker.report() {
            self.take_report(report);
        }
        while let Some(path) = self.watch.change() {
            self.take_change(&path);
        }
        self.take_choice();
        self.take_background();
        self.play();
        self.ask();
        if self.notice.as_ref().is_some_and(|(.., since)| since.elapsed() > NOTICE) {
            self.notice = None;
        }
        let now = Instant::now();
        let beat = self.playing.map(|last| last + BEAT);
        let grace = self.running.as_ref().filter(|_| self.due.is_some()).map(|r| r.since + GRACE);
        let notice = self.notice.as_ref().map(|(.., since)| *since + NOTICE);
        let clock = self.running.as_ref().map(|_| now + Duration::from_millis(100));
        let next = [self.due.max(grace), beat, notice, clock].into_iter().flatten().min()?;
        Some(next.saturating_duration_since(now).max(Duration::from_millis(5)))
    }

    /// The last good result.
    #[must_use]
    pub fn frame(&self) -> Option<&Arc<Frame>> {
        self.frame.as_ref()
    }

    /// Whether, and why, [`Session::frame`] is not what is wanted.
    #[must_use]
    pub fn stale(&self) -> Option<&Stale> {
        self.stale.as_ref()
    }

    /// Seconds since the worker began, and the generation it is at; `None` if it rests.
    #[must_use]
    pub fn progress(&self) -> Option<(f64, Option<u64>)> {
        self.running.as_ref().map(|r| (r.since.elapsed().as_secs_f64(), r.stepping))
    }

    /// Whether something is computed or about to be.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        self.running.is_some() || self.due.is_some()
    }

    /// Whether generations follow each other.
    #[must_use]
    pub fn is_playing(&self) -> bool {
        self.playing.is_some()
    }

    /// The last program that compiled: its rules and parameters.
    #[must_use]
    pub fn program(&self) -> Option<&Arc<Program>> {
        self.program.as_ref()
    }

    /// Whether there is a rule.
    #[must_use]
    pub fn can_step(&self) -> bool {
        self.program.as_ref().is_some_and(|p| !p.rules.is_empty())
    }

    /// Name of the rule that is stepped.
    #[must_use]
    pub fn rule(&self) -> Option<&str> {
        let program = self.program.as_ref()?;
        let chosen = self.document.rule.as_deref().and_then(|name| program.rule(name));
        program.function(chosen.or_else(|| program.default_rule())?).map(|f| f.name.as_str())
    }

    /// What is wrong, in the order of the text.
    #[must_use]
    pub fn problems(&self) -> &Problems {
        &self.problems
    }

    /// What the generations have printed.
    pub fn console(&self) -> MutexGuard<'_, Console> {
        self.worker.console()
    }

    /// The generation whose output is shown: the one that is computed or failed, else the one shown.
    #[must_use]
    pub fn console_generation(&self) -> u64 {
        match &self.running {
            Some(running) => running.request.generation,
            None => self.document.generation,
        }
    }

    /// What another program has written into the program's file while the text here has changes of its own.
    #[must_use]
    pub fn text_on_disk(&self) -> Option<&Arc<str>> {
        self.text_on_disk.as_ref()
    }

    /// A short message.
    #[must_use]
    pub fn notice(&self) -> Option<(Severity, &str)> {
        self.notice.as_ref().map(|(severity, text, _)| (*severity, text.as_str()))
    }

    /// Whether the window shall close.
    #[must_use]
    pub fn wants_quit(&self) -> bool {
        self.wants_quit
    }

    fn change_style(&mut self, change: impl FnOnce(&mut Style)) {
        change(&mut self.document.style);
    }

    fn say(&mut self, severity: Severity, text: impl Into<String>) {
        self.notice = Some((severity, text.into(), Instant::now()));
    }
}

/// Files.
impl Session {
    fn unless_unsaved(&mut self, command: Command, action: impl FnOnce(&mut Self)) {
        if self.document.program.is_modified() {
            self.dialog = Some(Dialog::Unsaved { then: Box::new(command) });
        } else {
            action(self);
        }
    }

    fn answer_unsaved(&mut self, answer: Answer) {
        let Some(Dialog::Unsaved { then }) = &self.dialog else { return };
        let then = (**then).clone();
        if answer == Answer::Discard {
            self.dialog = None;
            // The saved text comes back, so that what follows finds nothing to lose.
            self.document.program.text = Arc::clone(&self.document.program.saved);
            self.ask_now();
            self.apply(then);
            return;
        }
        match self.document.program.path.clone() {
            Some(path) => {
                self.dialog = None;
                self.save_to(&path);
                if !self.document.program.is_modified() {
                    self.apply(then);
                }
            }
            // The question stays until the text has a file.
            None => self.choose(Purpose::SaveProgram),
        }
    }

    fn open_program(&mut self, path: &Path) {
        match files::read_program(path) {
            Ok(text) => self.set_program(ProgramText::of_file(path, text)),
            Err(error) => self.say(Severity::Error, format!("{}: {}", path.display(), error.diagnostic.message)),
        }
    }

    fn set_program(&mut self, program: ProgramText) {
        self.document.program = program;
        self.document.rule = None;
        self.document.params.clear();
        self.included.clear();
        self.text_on_disk = None;
        self.reveal = Some(0..0);
        self.fit = true;
        self.watch_files();
        self.ask_now();
    }

    fn use_mesh(&mut self, source: MeshSource) {
        if matches!(source, MeshSource::File(_)) {
            self.document.generation = 0; // who knows how large it is
        }
        self.playing = None;
        self.document.mesh = source;
        self.mesh_revision += 1;
        self.fit = true;
        self.watch_files();
        self.ask_now();
    }

    fn save_to(&mut self, path: &Path) {
        let text = Arc::clone(&self.document.program.text);
        match files::write(path, text.as_bytes()) {
            Ok(()) => {
                let program = &mut self.document.program;
                let moved = program.path.as_deref() != Some(path);
                program.path = Some(path.to_owned());
                program.name = crate::document::file_name(path);
                program.saved = text;
                self.text_on_disk = None;
                if moved {
                    self.watch_files();
                    self.ask_now(); // includes are looked for elsewhere now
                }
                let name = self.document.program.name.clone();
                self.say(Severity::Note, format!("saved {name}"));
            }
            Err(error) => self.say(Severity::Error, format!("{}: {}", path.display(), error.diagnostic.message)),
        }
    }

    fn export_to(&mut self, path: PathBuf) {
        let Some(frame) = self.frame.clone() else { return };
        let format = path.extension().and_then(|e| vv::io::Format::from_extension(&e.to_string_lossy()));
        let Some(format) = format else {
            self.say(Severity::Error, "the name of a mesh ends in .obj or .off");
            return;
        };
        self.in_background(move || {
            let bytes = vv::io::write(&frame.mesh, &frame.faces, format);
            match files::write(&path, &bytes) {
                Ok(()) => Ok(format!("saved {}", path.display())),
                Err(error) => Err(format!("{}: {}", path.display(), error.diagnostic.message)),
            }
        });
    }

    fn in_background(&mut self, work: impl FnOnce() -> Result<String, String> + Send + 'static) {
        let (sender, receiver) = mpsc::channel();
        let wake = Arc::clone(&self.wake);
        std::thread::spawn(move || {
            let _ = sender.send(work());
            wake();
        });
        self.background.push(receiver);
    }

    fn take_background(&mut self) {
        let mut said = Vec::new();
        self.background.retain(|receiver| match receiver.try_recv() {
            Ok(result) => {
                said.push(result);
                false
            }
            Err(mpsc::TryRecvError::Empty) => true,
            Err(mpsc::TryRecvError::Disconnected) => false,
        });
        for result in said {
            match result {
                Ok(text) => self.say(Severity::Note, text),
                Err(text) => self.say(Severity::Error, text),
            }
        }
    }

    fn choose(&mut self, purpose: Purpose) {
        if self.chooser.is_some() {
            return;
        }
        let program = &self.document.program;
        let mut dialog = rfd::AsyncFileDialog::new();
        let folder = match (&self.document.mesh, purpose) {
            (MeshSource::File(path), Purpose::OpenMesh | Purpose::ExportMesh) => path.parent(),
            _ => program.path.as_deref().and_then(Path::parent),
        };
        if let Some(folder) = folder.filter(|f| f.is_absolute()) {
            dialog = dialog.set_directory(folder);
        }
        dialog = match purpose {
            Purpose::OpenProgram | Purpose::SaveProgram => dialog.add_filter("vv programs", &["vv"]),
            Purpose::OpenMesh | Purpose::ExportMesh => dialog.add_filter("meshes", &["obj", "off"]),
        };
        dialog = match purpose {
            Purpose::SaveProgram => dialog.set_file_name(&program.name),
            Purpose::ExportMesh => dialog.set_file_name("mesh.obj"),
            Purpose::OpenProgram | Purpose::OpenMesh => dialog,
        };
        let (sender, result) = mpsc::channel();
        let wake = Arc::clone(&self.wake);
        std::thread::spawn(move || {
            let chosen = pollster::block_on(async {
                match purpose {
                    Purpose::OpenProgram | Purpose::OpenMesh => dialog.pick_file().await,
                    Purpose::SaveProgram | Purpose::ExportMesh => dialog.save_file().await,
                }
            });
            let _ = sender.send(chosen.map(|file| file.path().to_owned()));
            wake();
        });
        self.chooser = Some(Chooser { purpose, since: Instant::now(), result });
    }

    fn take_choice(&mut self) {
        let Some(chooser) = &self.chooser else { return };
        let choice = match chooser.result.try_recv() {
            Ok(choice) => choice,
            Err(mpsc::TryRecvError::Empty) => return,
            Err(mpsc::TryRecvError::Disconnected) => None,
        };
        let (purpose, at_once) = (chooser.purpose, chooser.since.elapsed() < NO_DIALOG);
        self.chooser = None;
        match choice {
            Some(path) => self.chosen(purpose, path),
            None if at_once => {
                let path = match purpose {
                    Purpose::SaveProgram => self.document.program.name.clone(),
                    Purpose::ExportMesh => "mesh.obj".to_owned(),
                    Purpose::OpenProgram | Purpose::OpenMesh => String::new(),
                };
                self.dialog = Some(Dialog::TypePath { purpose, path });
            }
            None => {}
        }
    }

    /// Does with a path what it was chosen for.
    pub fn chosen(&mut self, purpose: Purpose, path: PathBuf) {
        let then = match self.dialog.take() {
            Some(Dialog::Unsaved { then }) => Some(*then),
            _ => None,
        };
        match purpose {
            Purpose::OpenProgram => self.unless_unsaved(Command::Open(path.clone()), |s| s.open_program(&path)),
            Purpose::OpenMesh => self.use_mesh(MeshSource::File(path)),
            Purpose::SaveProgram => {
                self.save_to(&with_extension(path, "vv"));
                if let Some(then) = then.filter(|_| !self.document.program.is_modified()) {
                    self.apply(then);
                }
            }
            Purpose::ExportMesh => self.export_to(with_extension(path, "obj")),
        }
    }

    fn watch_files(&mut self) {
        let mut files = self.included.clone();
        files.extend(self.document.program.path.clone());
        if let MeshSource::File(path) = &self.document.mesh {
            files.insert(path.clone());
        }
        self.watch.set_files(files.into_iter().filter(|path| !path.starts_with(NOWHERE)));
    }

    fn take_change(&mut self, path: &Path) {
        if matches!(&self.document.mesh, MeshSource::File(mesh) if mesh == path) {
            self.mesh_revision += 1;
            self.ask_now();
        }
        if self.document.program.path.as_deref() != Some(path) {
            if self.included.contains(path) {
                self.includes_revision += 1;
                self.ask_now();
            }
            return;
        }
        let Ok(text) = files::read_program(path) else { return };
        let text: Arc<str> = text.into();
        let program = &mut self.document.program;
        if text == program.text {
            program.saved = text;
            self.text_on_disk = None;
        } else if text == program.saved {
            // What we know already, for instance because we have just written it.
            self.text_on_disk = None;
        } else if program.is_modified() {
            self.text_on_disk = Some(text);
        } else {
            program.saved = Arc::clone(&text);
            program.text = text;
            self.ask_now();
        }
    }
}

/// Generations.
impl Session {
    fn go_to(&mut self, generation: u64) {
        self.document.generation = generation;
        self.ask_now();
    }

    fn pause_and_go_to(&mut self, generation: u64) {
        self.playing = None;
        self.go_to(generation);
    }

    fn stop(&mut self) {
        self.playing = None;
        let Some(running) = self.running.take() else { return };
        self.due = None;
        let shown = self.frame.as_ref().map(|f| &f.request);
        match shown {
            // A step was stopped: what is shown is a good result, of the generation before.
            Some(request) if *request.recipe == *running.request.recipe => {
                self.document.generation = request.generation;
                self.stale = None;
            }
            _ => self.stale = Some(Stale::Stopped),
        }
        self.say(Severity::Note, "stopped");
    }

    fn play(&mut self) {
        let Some(last) = self.playing else { return };
        if self.is_busy() || last.elapsed() < BEAT {
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
        self.go_to(generation.saturating_add(1));
    }

    /// By how much a generation is larger than the one before, from generation 0 to the one shown.
    fn growth(&self) -> f64 {
        let Some(frame) = &self.frame else { return 1.0 };
        let first = frame.control_vertices.max(1) as f64;
        (frame.statistics.vertices as f64 / first).powf(1.0 / frame.request.generation.max(1) as f64)
    }

    fn ask_now(&mut self) {
        self.ask_after(Duration::ZERO);
    }

    fn ask_after(&mut self, pause: Duration) {
        self.due = Some(Instant::now() + pause);
    }

    /// What is wanted.
    fn request(&self) -> Request {
        let document = &self.document;
        let recipe = Recipe {
            path: document.program.path_or_name(),
            text: Arc::clone(&document.program.text),
            includes_revision: self.includes_revision,
            mesh: document.mesh.clone(),
            mesh_revision: self.mesh_revision,
            rule: document.rule.clone(),
            params: document.params.clone(),
        };
        Request { recipe: Arc::new(recipe), generation: document.generation }
    }

    /// Hands the wish to the worker once it is due and what runs may be dropped for it.
    fn ask(&mut self) {
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
        self.running = Some(Running { ticket, request, since: Instant::now(), stepping: None });
    }

    fn take_report(&mut self, report: Report) {
        let Some(running) = &mut self.running else { return };
        if !running.ticket.issued(&report) {
            return;
        }
        let request = running.request.clone();
        match report.event {
            Event::Compiled { compilation, files } => {
                self.problems.compiled(&compilation);
                if let Some(program) = &compilation.program {
                    self.program = Some(Arc::clone(program));
                    self.included.clear();
                }
                // Files of the last program that compiled stay watched: the error may be that one of them is gone.
                self.included.extend(files);
                self.watch_files();
            }
            Event::MeshRead { diagnostics } => self.problems.mesh_read(&request.recipe.mesh.name(), diagnostics),
            Event::Stepping(generation) => running.stepping = Some(generation),
            Event::Preview(frame) => self.frame = Some(frame),
            Event::Finished(frame) => {
                self.problems.ran(&frame.warnings, &Arc::default());
                self.frame = Some(frame);
                self.stale = None;
                self.running = None;
            }
            Event::Failed(failed) => {
                self.running = None;
                self.failed(failed);
            }
        }
    }

    fn failed(&mut self, failed: Failed) {
        self.playing = None;
        if let FailureKind::Stopped(_) = failed.kind {
            self.stale = Some(Stale::Stopped);
            return;
        }
        self.problems.ran(failed.diagnostic.as_deref().map_or(&[], std::slice::from_ref), &failed.sources);
        let message = match self.problems.first_error() {
            Some(problem) => match problem.place.as_ref().filter(|place| place.own) {
                Some(place) => format!("line {}: {}", place.start.line, problem.diagnostic.message),
                None => problem.diagnostic.message.clone(),
            },
            None => "the program failed".to_owned(),
        };
        self.stale = Some(Stale::Failed(message));
    }

    fn fix(&mut self, hint: &vv::diagnostic::Hint) {
        let Some((span, replacement)) = &hint.edit else { return };
        let text = &self.document.program.text;
        let (start, end) = (span.start as usize, span.end as usize);
        // The text may have changed since the diagnostic was made.
        if span.file != vv::source::FileId::MAIN || text.get(start..end).is_none() {
            return;
        }
        let text = format!("{}{replacement}{}", &text[..start], &text[end..]);
        self.document.program.text = text.into();
        self.ask_now();
    }
}

/// What the window opens with.
fn welcome(refined: bool) -> Document {
    let program = ["loop.vv", "paper-loop.vv"].iter().find_map(|name| library::program(name));
    let mesh = library::MESHES.iter().find(|m| m.name == "tetrapod.obj").or(library::MESHES.first());
    Document {
        program: program.map_or_else(|| ProgramText::new("untitled.vv", ""), |p| ProgramText::new(p.name, p.text)),
        mesh: mesh.map_or(MeshSource::Empty, |m| MeshSource::BuiltIn(m.name.to_owned())),
        rule: None,
        params: std::collections::BTreeMap::<String, Value>::new(),
        generation: if refined { 2 } else { 0 },
        style: Style { control: true, ..Style::default() },
        camera: Camera::standard(Sphere { center: DVec3::ZERO, radius: 1.0 }, 1.0), // fitted when there is something
    }
}

/// Whether a path is that of a program.
fn is_program(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("vv"))
}

fn with_extension(path: PathBuf, extension: &str) -> PathBuf {
    if path.extension().is_some() { path } else { path.with_extension(extension) }
}
