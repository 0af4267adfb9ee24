//! The modeler without its window: document, worker, watched files, and what has become of them.
//!
//! [`Session::apply`] carries commands out, [`Session::poll`] takes in what has happened meanwhile. Neither waits for
//! anything; panels read the rest.

mod beside;
mod coloring;
mod dialog;
mod files;
mod generations;
mod inspecting;
mod keeping;
mod leading;
mod pictures;
mod problem;
mod reading;
mod subdividing;
mod text;
mod undo;
mod view;
mod weighing;

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use glam::DVec3;
use vv::diagnostic::Severity;
use vv::ir::Program;
use vv::mesh::Value;

use crate::annotate::Annotations;
use crate::camera::Camera;
use crate::command::{Command, Panel, Reload, TextAction, ThemeChoice};
use crate::document::{Document, MeshSource, ProgramText};
use crate::navigation::Navigation;
use crate::preferences::Preferences;
use crate::render::Size;
use crate::scene::{Sphere, Style};
use crate::store::{Orphan, Store};
use crate::style_file::StyleFile;
use crate::watch::Watch;
use crate::worker::{Frame, Request, Ticket, Worker};
use crate::{evaluation, library};

pub use beside::Beside;
pub use dialog::{Dialog, PathTrouble, Purpose};
use files::{Chooser, Work, is_project};
pub use inspecting::{Fault, Inspection, Walking};
pub use problem::{Place, Problem, Problems};
pub use undo::changed;
pub use weighing::MaskState;

/// How long a computation may go on for something that is no longer wanted: what is nearly done is worth seeing, so that
/// a slider shows something while it moves.
const GRACE: Duration = Duration::from_millis(250);
/// Generations in a second when playing, at first.
pub(crate) const SPEED: f64 = 2.0;
/// How long a notice is shown.
const NOTICE: Duration = Duration::from_secs(6);

/// How many there were.
static SESSIONS: AtomicU64 = AtomicU64::new(0);

/// Why what is shown is not what is wanted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Stale {
    /// The program or its input has an error.
    Failed(String),
    /// The user stopped it.
    Stopped,
}

/// A step that failed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Halted {
    /// The generation that was not reached.
    pub generation: u64,
    /// Why.
    pub message: String,
}

/// What the picture is, when it is not what is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// Made by the program that is open, perhaps when its text was another one.
    This,
    /// Made by a program that was open before.
    Former,
    /// The mesh as it was read.
    Mesh,
}

/// Which panels are open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Panels {
    /// Program text.
    pub program: bool,
    /// Problems and console.
    pub messages: bool,
    /// Parameters, display, statistics.
    pub inspector: bool,
    /// The generations in a row.
    pub timeline: bool,
}

impl Default for Panels {
    fn default() -> Self {
        Self { program: true, messages: true, inspector: true, timeline: true }
    }
}

impl Panels {
    /// Whether it is.
    #[must_use]
    pub fn is_open(&self, panel: Panel) -> bool {
        match panel {
            Panel::Program => self.program,
            Panel::Messages => self.messages,
            Panel::Inspector => self.inspector,
            Panel::Timeline => self.timeline,
        }
    }
}

/// A place of the program that the editor shall show.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reveal {
    /// Bytes of the text.
    pub range: std::ops::Range<usize>,
    /// Whether the editor gets the keys.
    pub focus: bool,
}

/// What the worker is at.
struct Running {
    ticket: Ticket,
    request: Request,
    since: Instant,
    stepping: Option<u64>,
    /// Which of the programs of the session asked for it.
    of: u64,
}

/// The modeler without its window.
pub struct Session {
    /// What is worked on. Read it; change it by commands.
    pub document: Document,
    /// Light or dark.
    pub theme: ThemeChoice,
    /// Which panels are open.
    pub panels: Panels,
    /// Whether the window fills the screen.
    pub full_screen: bool,
    /// Whether the manual is open.
    pub reference: bool,
    /// Whether the window is open that tells how things are drawn.
    pub render_options: bool,
    /// The question that is open. Its text field is edited in place.
    pub dialog: Option<Dialog>,
    /// When a changed text is run.
    pub reload: Reload,
    /// What is as the user likes it.
    pub preferences: Preferences,
    /// How many generations follow each other in a second when playing, at most.
    pub speed: f64,
    /// What hands do to the view.
    pub navigation: Navigation,
    /// A place of the program that the editor shall show; the editor takes it.
    pub reveal: Option<Reveal>,
    /// What the editor shall do; the editor takes it.
    pub text_actions: Vec<TextAction>,
    /// Size and style of the picture in the viewport, which tells them.
    pub view: Option<(Size, Style)>,
    /// The viewport shall bring all in sight; the viewport takes it.
    pub fit: bool,
    /// Whether that was asked for, else the mesh is another one.
    pub asked_to_fit: bool,
    /// Text for the clipboard; the window takes it.
    pub copied: Option<String>,
    /// The window shall ask the clipboard for its text; it takes this.
    pub asks_clipboard: bool,
    /// What is looked at closely.
    pub inspection: Inspection,

    store: Option<Store>,
    orphan: Option<Orphan>,
    keeping: keeping::Keeping,
    /// The style file that was loaded last: what it says of figures is kept in those that are saved.
    style_file: StyleFile,
    project: Option<keeping::OpenProject>,
    recent: Vec<PathBuf>,
    worker: Worker,
    /// Bytes that generations may be kept in, whatever the user likes.
    most_memory: usize,
    watch: Watch,
    wake: Arc<dyn Fn() + Send + Sync>,
    includes_revision: u64,
    mesh_revision: u64,
    included: BTreeSet<PathBuf>,
    /// Whether the user has said which mesh; else it is what the program needs.
    mesh_chosen: bool,

    history: undo::History,
    finding: coloring::Finding,
    weighing: weighing::Weighing,
    /// The text that is run, which may be older than the one in the editor.
    text_to_run: Arc<str>,
    /// When to ask for what is wanted, if it is not what was asked for last.
    due: Option<Instant>,
    running: Option<Running>,
    /// The generation that was stopped last: what it printed tells where it hung.
    stopped: Option<u64>,
    frame: Option<Arc<Frame>>,
    /// Which program of the session made it; `None` if none did: it is the mesh as it was read.
    frame_of: Option<u64>,
    stale: Option<Stale>,
    halted: Option<Halted>,
    program: Option<Arc<Program>>,
    /// Which of the programs of the session it is.
    program_of: u64,
    problems: Problems,

    playing: Option<Instant>,
    /// What is to be done when a generation is shown.
    then: Option<(u64, Command)>,
    /// How often it was played.
    plays: u64,
    text_on_disk: Option<Arc<str>>,
    /// The text that the window opened with because none was asked for.
    welcome_text: Arc<str>,
    /// Whether the program's file was deleted.
    program_gone: bool,
    chooser: Option<Chooser>,
    background: Vec<Work>,
    /// The path that was typed for what is begun now.
    typed: Option<(Purpose, String)>,
    notice: Option<(Severity, String, Instant)>,
    flight: Option<view::Flight>,
    leading: leading::Leading,
    /// When a viewpoint was asked for from the clipboard.
    awaited: Option<Instant>,
    beside: Option<Beside>,
    /// Tells sessions apart, also after two have been swapped.
    id: u64,
    /// Kept, because it hands out what was copied.
    clipboard: Arc<Mutex<Option<arboard::Clipboard>>>,
    wants_quit: bool,
}

impl Session {
    /// Opens the files given; for what is not given, something that ships with vv. `wake` is called, from other threads,
    /// when [`Session::poll`] has something to take in. Without `store` nothing is remembered.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn new(
        mesh: Option<PathBuf>,
        program: Option<PathBuf>,
        store: Option<Store>,
        wake: Arc<dyn Fn() + Send + Sync>,
    ) -> std::io::Result<Self> {
        let mut session = Self::of(welcome(mesh.is_none() && program.is_none()), wake)?;
        if let Some(store) = store {
            session.remember_with(store);
        }
        session.ask_now();
        if mesh.is_none() && program.is_none() {
            session.begin();
        }
        match program {
            Some(path) if is_project(&path) => session.open_project(&path),
            Some(path) => session.open_program(&path),
            None => {}
        }
        if let Some(path) = mesh {
            session.use_mesh(MeshSource::File(path));
        }
        Ok(session)
    }

    /// On a document, which nothing is asked of yet.
    fn of(document: Document, wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let limits = evaluation::machine_limits();
        let (waker, watcher) = (Arc::clone(&wake), Arc::clone(&wake));
        let preferences = Preferences::default();
        let most_memory = limits.max_bytes / 2;
        let worker = Worker::start(limits, (preferences.memory << 20).min(most_memory), move || waker())?;
        let watch = Watch::start(move || watcher())?;
        let [text_to_run, welcome_text] = [(); 2].map(|()| Arc::clone(&document.program.text));
        Ok(Self {
            document,
            theme: ThemeChoice::System,
            panels: Panels::default(),
            speed: SPEED,
            navigation: Navigation { glide: false, ..Navigation::default() },
            full_screen: false,
            reference: false,
            render_options: false,
            dialog: None,
            reload: Reload::Typed,
            preferences,
            reveal: None,
            text_actions: Vec::new(),
            view: None,
            fit: true,
            asked_to_fit: false,
            copied: None,
            asks_clipboard: false,
            inspection: Inspection::default(),
            store: None,
            orphan: None,
            keeping: keeping::Keeping::default(),
            style_file: StyleFile::default(),
            project: None,
            recent: Vec::new(),
            worker,
            most_memory,
            watch,
            wake,
            includes_revision: 0,
            mesh_revision: 0,
            included: BTreeSet::new(),
            mesh_chosen: false,
            history: undo::History::default(),
            finding: coloring::Finding::default(),
            weighing: weighing::Weighing::default(),
            text_to_run,
            due: None,
            running: None,
            stopped: None,
            frame: None,
            frame_of: None,
            stale: None,
            halted: None,
            program: None,
            program_of: 0,
            problems: Problems::default(),
            playing: None,
            then: None,
            plays: 0,
            text_on_disk: None,
            welcome_text,
            program_gone: false,
            chooser: None,
            background: Vec::new(),
            typed: None,
            notice: None,
            flight: None,
            leading: leading::Leading::default(),
            awaited: None,
            beside: None,
            id: SESSIONS.fetch_add(1, Ordering::Relaxed),
            clipboard: Arc::default(),
            wants_quit: false,
        })
    }

    /// Carries a command out. The only place where a document changes.
    pub fn apply(&mut self, command: Command) {
        // What was stopped was not reached: it is nothing to come back to.
        let is_undo =
            matches!(command, Command::Undo | Command::Redo | Command::UndoText | Command::RedoText | Command::Stop);
        let (kind, programs) = (undo::kind_of(&command), self.programs());
        let (text, state, document) = (Arc::clone(&self.document.program.text), self.state(), self.document.clone());
        let (before, id) = (self.before(&command), self.id);
        self.carry_out(command);
        if self.id != id {
            return; // another document has the keys now
        }
        self.link(before);
        if !is_undo {
            self.record(kind, &text, state, programs);
        }
        if programs == self.programs() {
            self.touch(&document);
        }
    }

    fn carry_out(&mut self, command: Command) {
        let generation = self.document.generation;
        match command {
            Command::NewProgram
            | Command::Choose(_)
            | Command::Open(_)
            | Command::OpenExample(_)
            | Command::Exhibit { .. }
            | Command::UseMesh(_)
            | Command::Save
            | Command::SaveTo(_)
            | Command::ExportTo(_)
            | Command::PictureTo(_)
            | Command::TakeFromDisk
            | Command::KeepMine
            | Command::AnswerRecovery(_)
            | Command::ForgetRecent
            | Command::AnswerUnsaved(_)
            | Command::Quit => self.change_files(command),
            // A text that nobody has said anything about is kept.
            Command::CloseDialog => self.dialog = None,

            Command::Undo => self.undo(),
            Command::Redo => self.redo(),
            Command::UndoText => self.undo_text(true),
            Command::RedoText => self.redo_text(true),
            Command::Edit(_)
            | Command::Tune(_)
            | Command::Text(_)
            | Command::SetReload(_)
            | Command::Fix(_)
            | Command::Reveal(_)
            | Command::Run => self.change_text(command),

            // A step that failed is tried again, not stepped over.
            Command::Step if self.stale.is_some() => self.ask_now(),
            // A key held down does not pile up generations, each four times the work of the one before.
            Command::Step if generation > self.shown_generation().saturating_add(1) => {}
            Command::Step => self.go_to(generation.saturating_add(1)),
            Command::Back => self.pause_and_go_to(generation.saturating_sub(1)),
            Command::Rewind => self.pause_and_go_to(0),
            Command::End => self.pause_and_go_to(self.last_reached()),
            Command::GoTo(generation) | Command::Scrub(generation) => self.pause_and_go_to(generation),
            Command::With(generation, then) => self.go_to_and(generation, *then),
            Command::Play if self.playing.is_some() => self.playing = None,
            Command::Play => {
                self.playing = Some(Instant::now());
                self.plays += 1;
                self.play_in_common();
            }
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

            Command::SaveParams(name) => {
                let values = self.document.params.clone();
                self.document.param_sets.insert(name, values);
            }
            Command::UseParams(name) => {
                if let Some(values) = self.document.param_sets.get(&name) {
                    self.document.params.clone_from(values);
                    self.ask_now();
                }
            }
            Command::ForgetParams(name) => {
                self.document.param_sets.remove(&name);
            }

            Command::Inspect(wish) => self.inspect(wish),
            Command::SetStyle(style) => self.document.style = style,
            Command::Faces => self.change_style(|s| {
                s.faces = !s.faces;
                s.edges |= !s.faces; // else nothing is left to see
            }),
            Command::Edges => self.change_style(|s| s.edges = !s.edges),
            Command::Vertices => self.change_style(|s| s.vertices = !s.vertices),
            Command::Smooth => self.change_style(|s| s.smooth = !s.smooth),
            Command::Control => self.change_style(|s| s.control = !s.control),
            Command::SetAnnotations(_) | Command::ColorBy(_) | Command::LabelBy(_) | Command::ArrowsOf(_) => {
                self.annotate(command);
            }
            Command::ShowBy(surface) => {
                self.change_style(|s| s.surface = surface);
                if self.shows_flat_lines() {
                    self.say(Severity::Note, "flat faces break the lines: Smooth (N) joins them");
                }
            }
            Command::Cut => self.change_style(|s| s.cut.on = !s.cut.on),
            Command::Grid => self.change_style(|s| s.grid = !s.grid),
            Command::Occlusion => self.change_style(|s| s.occlusion = !s.occlusion),
            Command::Axes => self.change_style(|s| s.axes = !s.axes),
            Command::SetCamera(camera) => self.set_camera(camera),
            Command::View(action) => self.change_view(action),
            Command::Pair(action) => self.change_pair(action),
            Command::Subdivide(program) => self.subdivide(program),
            Command::Fit => (self.fit, self.asked_to_fit) = (true, true),
            Command::CopyImage => self.copy_image(),
            Command::SetTheme(theme) => self.theme = theme,
            Command::FullScreen => self.full_screen = !self.full_screen,
            Command::Reference => self.reference = !self.reference,
            Command::Gallery => self.dialog = Some(Dialog::gallery()),
            Command::Preferences => self.dialog = Some(Dialog::Preferences),
            Command::SavePicture => self.dialog = Some(Dialog::Picture),
            Command::SetPreferences(preferences) => self.prefer(preferences),
            Command::Palette => self.dialog = Some(Dialog::Palette { query: String::new(), selected: 0 }),
            Command::CheatSheet => self.dialog = Some(Dialog::CheatSheet { query: String::new() }),
            Command::Toggle(Panel::Program) => self.panels.program = !self.panels.program,
            Command::Toggle(Panel::Messages) => self.panels.messages = !self.panels.messages,
            Command::Toggle(Panel::Inspector) => self.panels.inspector = !self.panels.inspector,
            Command::Toggle(Panel::Timeline) => self.panels.timeline = !self.panels.timeline,
            Command::SetSpeed(speed) => self.speed = speed.clamp(0.1, 60.0),
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
        self.carry_on();
        let flight = self.glide();
        let keep = self.keep();
        let motion = self.animate();
        self.ask();
        self.color();
        let mask = self.weigh();
        if self.notice.as_ref().is_some_and(|(.., since)| since.elapsed() > NOTICE) {
            self.notice = None;
        }
        let other = self.poll_other();
        let now = Instant::now();
        let other = other.map(|pause| now + pause);
        let beat = self.playing.map(|last| last + self.beat());
        let grace = self.running.as_ref().filter(|_| self.due.is_some()).map(|r| r.since + GRACE);
        let notice = self.notice.as_ref().map(|(.., since)| *since + NOTICE);
        let clock = self.running.as_ref().map(|_| now + Duration::from_millis(100));
        let next = [self.due.max(grace), beat, notice, clock, keep, flight, motion, mask, other]
            .into_iter()
            .flatten()
            .min()?;
        Some(next.saturating_duration_since(now).max(Duration::from_millis(5)))
    }

    /// Begins what commands have asked for, which [`Session::poll`] would do when it is called next.
    pub fn start(&mut self) {
        self.ask();
        self.color();
        self.weigh();
    }

    fn change_style(&mut self, change: impl FnOnce(&mut Style)) {
        let style = &mut self.document.style;
        change(style);
        // Else nothing is left to see.
        style.faces |= !style.edges && !style.vertices;
    }

    /// Tells the user of something that is no fault of what he did.
    pub fn warn(&mut self, text: impl Into<String>) {
        self.say(Severity::Warning, text);
    }

    fn say(&mut self, severity: Severity, text: impl Into<String>) {
        self.notice = Some((severity, text.into(), Instant::now()));
    }
}

/// What the window opens with.
fn welcome(refined: bool) -> Document {
    let program = ["loop.vv", "paper-loop.vv"].iter().find_map(|name| library::program(name));
    Document {
        program: program.map_or_else(|| ProgramText::new("untitled.vv", ""), |p| ProgramText::new(p.name, p.text)),
        mesh: welcome_mesh(),
        rule: None,
        params: BTreeMap::<String, Value>::new(),
        param_sets: BTreeMap::new(),
        views: BTreeMap::new(),
        generation: if refined { 2 } else { 0 },
        style: Style { control: true, ..Style::default() },
        annotations: Annotations::default(),
        camera: Camera::standard(Sphere { center: DVec3::ZERO, radius: 1.0 }, 1.0), // fitted when there is something
    }
}

/// Something for a program that needs a mesh.
fn welcome_mesh() -> MeshSource {
    let mesh = library::MESHES.iter().find(|m| m.name == "tetrapod.obj").or(library::MESHES.first());
    mesh.map_or(MeshSource::Empty, |m| MeshSource::BuiltIn(m.name.to_owned()))
}
