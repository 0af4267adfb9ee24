//! Opening, saving, and files that change on disk.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, Instant};

use vv::diagnostic::{Diagnostic, Severity};
use vv::io::Format;

use super::{Dialog, PathTrouble, Purpose, Session};
use crate::command::{Answer, Command};
use crate::document::{MeshSource, NOWHERE, ProgramText};
use crate::project::{self, Project};
use crate::{files, library, style_file, typed_path};

/// What a style is called, when nobody says.
const STYLE_NAME: &str = "style.json";

/// A file dialog that is gone sooner than this was never there.
const NO_DIALOG: Duration = Duration::from_millis(1000);

/// Something that is done on another thread.
pub(super) struct Work {
    /// What it has to say at its end.
    result: Receiver<Result<Done, String>>,
    /// The path that was typed for it, to be asked for again if it fails.
    typed: Option<(Purpose, String)>,
}

/// Work that has come to a good end.
pub(super) struct Done {
    /// What to say of it.
    said: String,
    /// What was lost on the way.
    losses: Vec<Diagnostic>,
}

impl From<String> for Done {
    fn from(said: String) -> Self {
        Self { said, losses: Vec::new() }
    }
}

/// A file dialog that is open.
pub(super) struct Chooser {
    purpose: Purpose,
    since: Instant,
    result: Receiver<Option<PathBuf>>,
}

impl Session {
    /// Carries out what concerns files, and what takes the place of the work that is open.
    pub(super) fn change_files(&mut self, command: Command) {
        match command {
            Command::NewProgram => self.unless_unsaved(command, |s| {
                s.set_program(ProgramText::new("untitled.vv", ""));
                s.document.generation = 0; // what has no rule has no steps
            }),
            Command::Choose(purpose) => self.choose(purpose),
            Command::Open(ref path) if is_program(path) => {
                let path = path.clone();
                self.unless_unsaved(command, |s| s.open_program(&path));
            }
            Command::Open(ref path) if is_project(path) => {
                let path = path.clone();
                self.unless_unsaved(command, |s| s.open_project(&path));
            }
            Command::Open(path) if is_mesh(&path) => self.use_mesh(MeshSource::File(path)),
            Command::Open(path) => {
                let style = path.extension().is_some_and(|e| e.eq_ignore_ascii_case(style_file::EXTENSION));
                let done = if style { self.open_style(&path) } else { Err(unknown()) };
                self.tell(&path, done);
            }
            Command::OpenExample(name) => self.unless_unsaved(command, |s| {
                if let Some(example) = library::program(name) {
                    s.set_program(ProgramText::new(example.name, example.text));
                }
            }),
            Command::Exhibit { program, keep_mesh } => {
                self.unless_unsaved(command, |s| s.show_exhibit(program, keep_mesh));
            }
            Command::UseMesh(source) => self.use_mesh(source),
            Command::Save => self.save(),
            Command::SaveTo(path) => {
                let done = self.save_to(&path);
                self.tell(&path, done);
            }
            Command::ExportTo(path) => {
                let done = self.export_to(&path);
                self.tell(&path, done);
            }
            Command::PictureTo(path) => {
                let done = self.picture_to(&path);
                self.tell(&path, done);
            }
            Command::TakeFromDisk => {
                if let Some(text) = self.text_on_disk.take() {
                    self.document.program.saved = Arc::clone(&text);
                    self.document.program.text = text;
                    self.text_was_saved();
                    self.ask_now();
                }
            }
            Command::KeepMine => {
                if let Some(text) = self.text_on_disk.take() {
                    self.document.program.saved = text;
                }
            }
            Command::AnswerRecovery(take) => self.answer_recovery(take),
            Command::ForgetRecent => self.recent.clear(),
            Command::AnswerUnsaved(answer) => self.answer_unsaved(answer),
            Command::Quit => self.unless_unsaved(command, Self::quit),
            _ => {}
        }
    }

    pub(super) fn unless_unsaved(&mut self, command: Command, action: impl FnOnce(&mut Self)) {
        if self.would_lose() {
            self.dialog = Some(Dialog::Unsaved { then: Box::new(command) });
        } else {
            action(self);
        }
    }

    /// Whether there is text that is in no file.
    pub(super) fn would_lose(&self) -> bool {
        self.is_unsaved() || self.is_orphan()
    }

    /// Whether the program's file is gone, so that the text stands in the editor alone.
    fn is_orphan(&self) -> bool {
        self.document.program.path.as_ref().is_some_and(|path| !path.exists())
    }

    /// Whether the program's file was found deleted or renamed, and is not back.
    #[must_use]
    pub fn program_is_gone(&self) -> bool {
        self.program_gone
    }

    pub(super) fn answer_unsaved(&mut self, answer: Answer) {
        let Some(Dialog::Unsaved { then }) = &self.dialog else { return };
        let then = (**then).clone();
        if answer == Answer::Discard {
            self.dialog = None;
            // The saved text comes back, so that what follows finds nothing to lose.
            self.project = None;
            self.document.program.text = Arc::clone(&self.document.program.saved);
            self.text_was_edited();
            if self.is_orphan() {
                self.document.program.path = None;
            }
            self.ask_now();
            self.carry_out(then);
            return;
        }
        if self.document.program.path.is_none() && self.project.is_none() {
            // The question stays until the text has a file.
            self.choose(Purpose::SaveProgram);
            return;
        }
        self.dialog = None;
        self.save();
        if !self.is_unsaved() && !self.is_orphan() {
            self.carry_out(then);
        }
    }

    /// Saves the program, and the project that is open. A text without file has one in its project.
    pub(super) fn save(&mut self) {
        if self.text_on_disk.is_some() {
            let question = "the program has changed on disk: first say “Reload” or “Keep mine”";
            self.say(Severity::Warning, question.to_owned());
            return;
        }
        let program = &self.document.program;
        let project = self.project_path().map(Path::to_owned);
        match (program.path.clone(), project) {
            (None, None) => self.choose(Purpose::SaveProgram),
            (None, Some(project)) => {
                let done = self.save_project(&project);
                self.tell(&project, done);
            }
            (Some(path), None) => {
                let done = self.save_to(&path);
                self.tell(&path, done);
            }
            (Some(path), Some(project)) => {
                if program.is_modified() || self.is_orphan() {
                    let done = self.save_to(&path);
                    self.tell(&path, done);
                }
                if !self.document.program.is_modified() {
                    let done = self.save_project(&project);
                    self.tell(&project, done);
                }
            }
        }
    }

    /// Says what has gone wrong with a file.
    pub(super) fn tell(&mut self, path: &Path, done: Result<(), String>) {
        if let Err(why) = done {
            self.say(Severity::Error, format!("{}: {why}", path.display()));
        }
    }

    pub(super) fn open_program(&mut self, path: &Path) {
        match files::read_program(path) {
            Ok(text) => {
                self.set_program(ProgramText::of_file(path, text));
                self.remember(path);
            }
            Err(error) => match library::meant(path) {
                Some(shipped) => self.set_program(ProgramText::new(shipped.name, shipped.text)),
                None => self.say(Severity::Error, format!("{}: {}", path.display(), error.diagnostic.message)),
            },
        }
    }

    pub(super) fn set_program(&mut self, program: ProgramText) {
        if self.document.mesh == MeshSource::Empty {
            self.mesh_chosen = false; // that was for the program before
        }
        self.document.program = program;
        self.project = None;
        self.program_gone = false;
        self.forget_history();
        self.untouched();
        self.run_text();
        self.document.rule = None;
        self.document.params.clear();
        self.document.param_sets.clear();
        self.included.clear();
        self.text_on_disk = None;
        self.reveal = Some(super::Reveal { range: 0..0, focus: false });
        self.fit = true;
        self.watch_files();
        self.ask_now();
    }

    /// A program that builds its mesh itself gets none, another one gets one, unless the user has chosen.
    pub(super) fn suit_mesh(&mut self) {
        let Some(program) = self.program.as_ref().filter(|_| !self.mesh_chosen) else { return };
        if program.start.is_some() == (self.document.mesh == MeshSource::Empty) {
            return;
        }
        self.document.mesh = if program.start.is_some() { MeshSource::Empty } else { super::welcome_mesh() };
        self.running = None; // what is computed for the other mesh shall not be seen
        self.fit |= self.frame.is_some(); // before the first picture a viewpoint may have been given
        self.ask_now();
    }

    pub(super) fn use_mesh(&mut self, source: MeshSource) {
        self.mesh_chosen = true;
        if matches!(source, MeshSource::File(_)) {
            self.document.generation = 0; // who knows how large it is
        }
        self.playing = None;
        if let MeshSource::File(path) = &source {
            self.remember(path);
        }
        self.document.mesh = source;
        self.mesh_revision += 1;
        self.fit = true;
        self.watch_files();
        self.ask_now();
    }

    pub(super) fn save_to(&mut self, path: &Path) -> Result<(), String> {
        let text = Arc::clone(&self.document.program.text);
        files::write(path, text.as_bytes()).map_err(|error| error.diagnostic.message.clone())?;
        let program = &mut self.document.program;
        let moved = program.path.as_deref() != Some(path);
        program.path = Some(path.to_owned());
        program.name = crate::document::file_name(path);
        program.saved = text;
        self.text_on_disk = None;
        self.program_gone = false;
        self.text_was_saved();
        self.remember(path);
        self.ask_now();
        if moved {
            self.watch_files(); // includes are looked for elsewhere now
        }
        self.say(Severity::Note, format!("saved {}", typed_path::shown(path)));
        Ok(())
    }

    pub(super) fn open_project(&mut self, path: &Path) {
        let folder = std::path::absolute(path).ok().and_then(|path| path.parent().map(Path::to_owned));
        let read = std::fs::read(path).map_err(|error| files::sentence(&error));
        match read.and_then(|bytes| Project::from_json(&bytes, folder.as_deref())) {
            Ok(project) => {
                self.open_document(project);
                self.set_project(path);
                self.remember(path);
            }
            Err(error) => self.say(Severity::Error, format!("{}: {error}", path.display())),
        }
    }

    fn save_project(&mut self, path: &Path) -> Result<(), String> {
        let folder = std::path::absolute(path).ok().and_then(|path| path.parent().map(Path::to_owned));
        let bytes = Project::of(&self.document).to_json(folder.as_deref());
        files::write(path, &bytes?).map_err(|error| error.diagnostic.message.clone())?;
        self.set_project(path);
        self.remember(path);
        self.say(Severity::Note, format!("saved {}", typed_path::shown(path)));
        Ok(())
    }

    pub(super) fn export_to(&mut self, path: &Path) -> Result<(), String> {
        let frame = self.frame.clone().ok_or("there is no mesh yet")?;
        let format = path.extension().and_then(|e| Format::from_extension(&e.to_string_lossy()));
        let format = format.ok_or_else(|| format!("the name of a mesh ends in {}", files::mesh_extensions("or")))?;
        files::check_writable(path).map_err(|error| error.diagnostic.message.clone())?;
        let path = path.to_owned();
        self.in_background(move || {
            let written = vv::io::write(&frame.mesh, &frame.faces, format);
            let (bytes, losses) = written.map_err(|problem| problem.to_string())?;
            match files::write(&path, &bytes) {
                Ok(()) if losses.is_empty() => Ok(format!("saved {}", typed_path::shown(&path)).into()),
                Ok(()) => Ok(Done { said: format!("saved {}, but not all of it", typed_path::shown(&path)), losses }),
                Err(error) => Err(format!("{}: {}", path.display(), error.diagnostic.message)),
            }
        });
        Ok(())
    }

    pub(super) fn in_background<D: Into<Done>>(&mut self, work: impl FnOnce() -> Result<D, String> + Send + 'static) {
        let (sender, receiver) = mpsc::channel();
        let wake = Arc::clone(&self.wake);
        std::thread::spawn(move || {
            let _ = sender.send(work().map(Into::into));
            wake();
        });
        self.background.push(Work { result: receiver, typed: self.typed.clone() });
    }

    pub(super) fn take_background(&mut self) {
        let mut said = Vec::new();
        self.background.retain(|work| match work.result.try_recv() {
            Ok(result) => {
                said.push((result, work.typed.clone()));
                false
            }
            Err(mpsc::TryRecvError::Empty) => true,
            Err(mpsc::TryRecvError::Disconnected) => false,
        });
        for (result, typed) in said {
            match (result, typed) {
                (Ok(Done { said, losses }), _) => {
                    self.say(if losses.is_empty() { Severity::Note } else { Severity::Warning }, said);
                    self.problems.written(&losses);
                }
                (Err(why), Some((purpose, path))) if self.dialog.is_none() => {
                    self.notice = None; // that it is being written
                    let trouble = Some((path.clone(), PathTrouble::Failed(why)));
                    self.dialog = Some(Dialog::TypePath { purpose, path, then: None, trouble });
                }
                (Err(why), _) => self.say(Severity::Error, why),
            }
        }
    }

    pub(super) fn choose(&mut self, purpose: Purpose) {
        if self.chooser.is_some() {
            return;
        }
        if !offers_file_dialog() {
            return self.ask_for_path(purpose);
        }
        let mut dialog = rfd::AsyncFileDialog::new().add_filter(purpose.files(), purpose.extensions());
        if let Some(folder) = self.folder_for(purpose) {
            dialog = dialog.set_directory(folder);
        }
        if purpose.saves() {
            dialog = dialog.set_file_name(self.name_for(purpose));
        }
        let (sender, result) = mpsc::channel();
        let wake = Arc::clone(&self.wake);
        std::thread::spawn(move || {
            let chosen = pollster::block_on(async {
                if purpose.saves() { dialog.save_file().await } else { dialog.pick_file().await }
            });
            let _ = sender.send(chosen.map(|file| file.path().to_owned()));
            wake();
        });
        self.chooser = Some(Chooser { purpose, since: Instant::now(), result });
    }

    /// Where a file of this kind was found last.
    fn folder_for(&self, purpose: Purpose) -> Option<&Path> {
        let folder = match (&self.document.mesh, purpose) {
            (MeshSource::File(path), Purpose::OpenMesh | Purpose::ExportMesh) => path.parent(),
            _ => self.document.program.path.as_deref().and_then(Path::parent),
        };
        folder.filter(|folder| folder.is_absolute())
    }

    /// What a file that is saved may be called.
    fn name_for(&self, purpose: Purpose) -> String {
        let program = &self.document.program.name;
        let program = program.strip_suffix(".vv").unwrap_or(program);
        let made_by = self.made_by();
        let shown = format!("{}-{}", made_by.strip_suffix(".vv").unwrap_or(&made_by), self.shown_generation());
        match purpose {
            Purpose::SaveProgram => self.document.program.name.clone(),
            // The mesh and the picture of one generation stay when those of the next come.
            Purpose::ExportMesh => format!("{shown}.obj"),
            Purpose::SavePicture => format!("{shown}.png"),
            Purpose::SaveMask => format!("{program}-mask.svg"),
            Purpose::SaveProject => format!("{program}.{}", project::EXTENSION),
            Purpose::SaveStyle => STYLE_NAME.to_owned(),
            Purpose::OpenProgram | Purpose::OpenMesh | Purpose::OpenProject | Purpose::OpenStyle => String::new(),
        }
    }

    pub(super) fn take_choice(&mut self) {
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
            None if at_once => self.ask_for_path(purpose),
            None => {}
        }
    }

    /// Asks for a path in a dialog of our own.
    fn ask_for_path(&mut self, purpose: Purpose) {
        let folder = self.folder_for(purpose).map(Path::to_owned).or_else(|| std::env::current_dir().ok());
        let folder = folder.map_or_else(String::new, |folder| typed_path::shown(&folder));
        let path = format!("{}/{}", folder.trim_end_matches('/'), self.name_for(purpose));
        let then = match self.dialog.take() {
            Some(Dialog::Unsaved { then }) => Some(then),
            _ => None,
        };
        self.dialog = Some(Dialog::path(purpose, path, then));
    }

    /// Does with a path what it was chosen for.
    pub fn chosen(&mut self, purpose: Purpose, path: PathBuf) {
        let then = match self.dialog.take() {
            Some(Dialog::Unsaved { then } | Dialog::TypePath { then: Some(then), .. }) => Some(*then),
            _ => None,
        };
        let path = purpose.with_extension(path);
        let done = self.use_path(purpose, &path, then);
        self.tell(&path, done);
    }

    /// Does with the path that is typed what it is asked for. If that fails the dialog stays, and says why; and if it would
    /// replace something, unless that is `wanted`.
    pub fn path_typed(&mut self, wanted: bool) {
        let Some(asked @ Dialog::TypePath { .. }) = self.dialog.take() else { return };
        let Dialog::TypePath { purpose, path: text, then, .. } = asked.clone() else { return };
        let path = purpose.with_extension(typed_path::expand(&text));
        let done = if purpose.saves() && !wanted && path.exists() {
            Err(PathTrouble::Exists)
        } else {
            self.typed = Some((purpose, text.clone()));
            let done = self.use_path(purpose, &path, then.map(|then| *then));
            self.typed = None;
            done.map_err(PathTrouble::Failed)
        };
        if let (Err(why), Dialog::TypePath { purpose, path, then, .. }) = (done, asked) {
            self.dialog = Some(Dialog::TypePath { purpose, path, then, trouble: Some((text, why)) });
        }
    }

    fn use_path(&mut self, purpose: Purpose, path: &Path, then: Option<Command>) -> Result<(), String> {
        if !purpose.saves() {
            files::check_readable(path).map_err(|error| error.diagnostic.message.clone())?;
        }
        match purpose {
            // What a file is its name says, whatever was asked for.
            Purpose::OpenProgram | Purpose::OpenMesh if is_program(path) || is_project(path) || is_mesh(path) => {
                self.apply(Command::Open(path.to_owned()));
            }
            Purpose::OpenProgram => self.unless_unsaved(Command::Open(path.to_owned()), |s| s.open_program(path)),
            Purpose::OpenMesh => self.apply(Command::UseMesh(MeshSource::File(path.to_owned()))),
            Purpose::SaveProgram => {
                self.save_to(path)?;
                if let Some(then) = then.filter(|_| !self.document.program.is_modified()) {
                    self.carry_out(then);
                }
            }
            Purpose::ExportMesh => self.export_to(path)?,
            Purpose::OpenProject => self.unless_unsaved(Command::Open(path.to_owned()), |s| s.open_project(path)),
            Purpose::SaveProject => self.save_project(path)?,
            Purpose::SavePicture => self.picture_to(path)?,
            Purpose::SaveMask => self.mask_to(path)?,
            Purpose::OpenStyle => self.open_style(path)?,
            Purpose::SaveStyle => self.save_style(path)?,
        }
        Ok(())
    }

    pub(super) fn watch_files(&mut self) {
        let mut files = self.included.clone();
        files.extend(self.document.program.path.clone());
        if let MeshSource::File(path) = &self.document.mesh {
            files.insert(path.clone());
        }
        self.watch.set_files(files.into_iter().filter(|path| !path.starts_with(NOWHERE)));
    }

    pub(super) fn take_change(&mut self, path: &Path) {
        let gone = !path.exists();
        if self.document.program.path.as_deref() == Some(path) {
            self.program_gone = gone;
        }
        let name = crate::document::file_name(path);
        let warning = format!("{name} is gone from the disk; what was read of it is still here");
        if gone {
            self.say(Severity::Warning, warning);
            return;
        }
        self.notice.take_if(|(_, text, _)| *text == warning);
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
            let before = Arc::clone(&program.text);
            program.saved = Arc::clone(&text);
            program.text = text;
            self.record(None, &before, self.state(), self.programs());
            self.text_was_saved();
            self.ask_now();
        }
    }
}

/// Whether the system may have a file dialog. Where it surely has none nobody should wait for it.
fn offers_file_dialog() -> bool {
    if !cfg!(all(unix, not(target_os = "macos"))) {
        return true;
    }
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    let bus = set("DBUS_SESSION_BUS_ADDRESS").is_some()
        || set("XDG_RUNTIME_DIR").is_some_and(|folder| Path::new(&folder).join("bus").exists());
    bus || set("PATH").is_some_and(|paths| std::env::split_paths(&paths).any(|folder| folder.join("zenity").exists()))
}

/// Whether a path is that of a program.
pub(super) fn is_program(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("vv"))
}

/// Why a file of another kind is not opened, whatever it was dropped for.
fn unknown() -> String {
    let meshes = files::mesh_extensions("or");
    format!(
        "neither a program (.vv), a project (.{}), a style (.{}) nor a mesh ({meshes})",
        project::EXTENSION,
        style_file::EXTENSION
    )
}

/// Whether a path is that of a mesh.
fn is_mesh(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default();
    Format::EXTENSIONS.iter().any(|known| extension.eq_ignore_ascii_case(known))
}

/// Whether a path is that of a project.
pub(super) fn is_project(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case(project::EXTENSION))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_a_typed_path_what_was_asked_for_goes_on() {
        let folder = tempfile::tempdir().unwrap();
        let check = |then: Command, done: fn(&Session) -> bool| {
            let path = folder.path().join("mine");
            let mut session = Session::new(None, None, None, Arc::new(|| {})).unwrap();
            session.apply(Command::NewProgram);
            session.apply(Command::Edit("// mine\n".into()));
            session.apply(then);
            assert!(matches!(session.dialog, Some(Dialog::Unsaved { .. })) && !done(&session));
            session.ask_for_path(Purpose::SaveProgram);
            session.chosen(Purpose::SaveProgram, path.clone());
            assert_eq!(std::fs::read_to_string(path.with_extension("vv")).unwrap(), "// mine\n");
            assert!(done(&session) && session.dialog.is_none());
        };
        check(Command::Quit, Session::wants_quit);
        check(Command::OpenExample("butterfly.vv"), |s| s.document.program.name == "butterfly.vv");
        check(Command::Exhibit { program: "sqrt3.vv", keep_mesh: true }, |s| s.document.program.name == "sqrt3.vv");
    }
}
