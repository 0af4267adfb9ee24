//! Files that the modeler keeps for itself: settings, and what is unsaved, for the case that it ends without being asked.
//!
//! Written by a thread of its own, newest first, so that nobody waits for a disk. Each window that is open has a recovery
//! file with a lock; a recovery file without living lock was left behind by one that crashed.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

use serde::{Deserialize, Serialize};

use crate::command::{Reload, ThemeChoice};
use crate::files;
use crate::navigation::Navigation;
use crate::preferences::Preferences;
use crate::project::Project;
use crate::session::Panels;

/// Files that are remembered.
const RECENT: usize = 12;

/// What is remembered from one time to the next.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Light or dark.
    pub theme: ThemeChoice,
    /// When a changed text is run.
    pub reload: Reload,
    /// Which panels are open.
    pub panels: Panels,
    /// Generations a second when playing.
    pub speed: f64,
    /// Files that were opened or saved, the last one first.
    pub recent: Vec<PathBuf>,
    /// What hands do to the view.
    pub navigation: Navigation,
    /// What the dialog of this name sets.
    #[serde(flatten)]
    pub preferences: Preferences,
    /// What another version of vv has set and this one does not know: it is kept.
    #[serde(flatten)]
    pub others: serde_json::Map<String, serde_json::Value>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            theme: ThemeChoice::System,
            reload: Reload::Typed,
            panels: Panels::default(),
            speed: crate::session::SPEED,
            recent: Vec::new(),
            navigation: Navigation::default(),
            preferences: Preferences::default(),
            others: serde_json::Map::new(),
        }
    }
}

impl Settings {
    /// Remembers a file.
    pub fn remember(&mut self, path: &Path) {
        // Where it is, wherever the program is started from next time.
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.recent.retain(|other| *other != path);
        self.recent.insert(0, path);
        self.recent.truncate(RECENT);
    }
}

/// What a file says, setting by setting, over the defaults: one from another version may say things that have no meaning
/// here, which is no reason to forget the others.
fn understood(said: serde_json::Map<String, serde_json::Value>) -> Settings {
    let mut settings = Settings::default();
    for (name, value) in said {
        let Ok(serde_json::Value::Object(mut all)) = serde_json::to_value(&settings) else { continue };
        all.insert(name, value);
        settings = serde_json::from_value(serde_json::Value::Object(all)).unwrap_or(settings);
    }
    settings
}

/// Something to be on the disk.
enum Job {
    Settings(Settings),
    /// What was open at the end.
    Last(Box<Project>),
    /// `None` takes it away.
    Recovery(Option<Box<Project>>),
}

/// The folder, and the thread that writes to it.
pub struct Store {
    folder: PathBuf,
    jobs: Option<Sender<Job>>,
    thread: Option<JoinHandle<()>>,
    trouble: Arc<Mutex<Option<String>>>,
    /// Held as long as the window lives.
    _lock: File,
    lock_path: PathBuf,
}

/// What a window that crashed has left behind.
#[derive(Debug)]
pub struct Orphan {
    /// What was in it.
    pub project: Project,
    path: PathBuf,
}

impl Orphan {
    /// It is not needed any more.
    pub fn forget(self) {
        let _ = fs::remove_file(self.path.with_extension("lock"));
        let _ = fs::remove_file(self.path);
    }
}

impl Store {
    /// The folder of this user's settings.
    #[must_use]
    pub fn user_folder() -> Option<PathBuf> {
        let set = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
        let base = if cfg!(windows) {
            set("APPDATA")
        } else if cfg!(target_os = "macos") {
            set("HOME").map(|home| home.join("Library/Application Support"))
        } else {
            set("XDG_CONFIG_HOME").or_else(|| set("HOME").map(|home| home.join(".config")))
        };
        base.map(|base| base.join("vv"))
    }

    /// In a folder, which is made if there is none.
    ///
    /// # Errors
    /// What the file system says.
    pub fn open(folder: &Path) -> std::io::Result<Self> {
        let recovery_folder = folder.join("recovery");
        fs::create_dir_all(&recovery_folder)?;
        let stamp = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default();
        let lock_path = recovery_folder.join(format!("{}-{}.lock", std::process::id(), stamp.as_nanos()));
        let lock = locked(&lock_path)?;
        remove_idle_locks(&recovery_folder);
        let (jobs, received) = mpsc::channel();
        let trouble = Arc::new(Mutex::new(None));
        let writer = Writer {
            settings: folder.join("settings.json"),
            last: folder.join("last-session.json"),
            recovery: lock_path.with_extension("json"),
            trouble: Arc::clone(&trouble),
        };
        let thread = std::thread::Builder::new().name("store".to_owned()).spawn(move || writer.work(&received))?;
        let folder = folder.to_owned();
        Ok(Self { folder, jobs: Some(jobs), thread: Some(thread), trouble, _lock: lock, lock_path })
    }

    /// Another one in the same folder, for another document.
    ///
    /// # Errors
    /// As [`Store::open`].
    pub fn sibling(&self) -> std::io::Result<Self> {
        Self::open(&self.folder)
    }

    /// What was remembered. What cannot be understood is forgotten, and that alone.
    #[must_use]
    pub fn settings(&self) -> Settings {
        let bytes = fs::read(self.folder.join("settings.json")).unwrap_or_default();
        let mut settings = understood(serde_json::from_slice(&bytes).unwrap_or_default());
        if !(0.1..=60.0).contains(&settings.speed) {
            settings.speed = crate::session::SPEED;
        }
        settings
    }

    /// Remembers.
    pub fn keep_settings(&self, settings: &Settings) {
        self.send(Job::Settings(settings.clone()));
    }

    /// Keeps what would be lost; `None` if nothing would.
    pub fn keep(&self, unsaved: Option<Project>) {
        self.send(Job::Recovery(unsaved.map(Box::new)));
    }

    /// Remembers what was open at the end.
    pub fn keep_last(&self, project: Project) {
        self.send(Job::Last(Box::new(project)));
    }

    /// What was open at the end of the last session.
    #[must_use]
    pub fn last_session(&self) -> Option<Project> {
        let bytes = fs::read(self.folder.join("last-session.json")).ok()?;
        Project::from_json(&bytes, None).ok()
    }

    /// What could not be written, once.
    #[must_use]
    pub fn trouble(&self) -> Option<String> {
        self.trouble.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// What a window that crashed has left behind, the newest.
    #[must_use]
    pub fn orphan(&self) -> Option<Orphan> {
        let files = fs::read_dir(self.folder.join("recovery")).ok()?;
        let mut found: Vec<(std::time::SystemTime, Orphan)> = Vec::new();
        for path in files.filter_map(|f| Some(f.ok()?.path())).filter(|p| p.extension().is_some_and(|e| e == "json")) {
            let lock = path.with_extension("lock");
            // Who holds the lock is alive.
            if lock == self.lock_path || File::open(&lock).is_ok_and(|file| file.try_lock().is_err()) {
                continue;
            }
            let project = fs::read(&path).ok().and_then(|bytes| Project::from_json(&bytes, None).ok());
            let time = fs::metadata(&path).and_then(|m| m.modified());
            if let (Some(project), Ok(time)) = (project, time) {
                found.push((time, Orphan { project, path }));
            }
        }
        found.into_iter().max_by_key(|(time, _)| *time).map(|(_, orphan)| orphan)
    }

    fn send(&self, job: Job) {
        if let Some(jobs) = &self.jobs {
            let _ = jobs.send(job);
        }
    }
}

impl Drop for Store {
    fn drop(&mut self) {
        self.jobs = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
        let _ = fs::remove_file(&self.lock_path);
    }
}

/// A file that is there and locked: one that is not locked yet another window may take for left behind.
fn locked(path: &Path) -> std::io::Result<File> {
    loop {
        let file = File::create(path)?;
        file.lock()?;
        if path.exists() {
            return Ok(file);
        }
    }
}

/// Takes away the locks of windows that crashed without unsaved work.
fn remove_idle_locks(folder: &Path) {
    let files = fs::read_dir(folder).into_iter().flatten().filter_map(|file| Some(file.ok()?.path()));
    for path in files.filter(|path| path.extension().is_some_and(|extension| extension == "lock")) {
        let Ok(file) = File::open(&path) else { continue };
        // Held while it is taken away, so that a window that has just made it notices.
        if file.try_lock().is_ok() && !path.with_extension("json").exists() {
            let _ = fs::remove_file(&path);
        }
    }
}

struct Writer {
    settings: PathBuf,
    last: PathBuf,
    recovery: PathBuf,
    trouble: Arc<Mutex<Option<String>>>,
}

impl Writer {
    fn work(&self, jobs: &Receiver<Job>) {
        while let Ok(job) = jobs.recv() {
            let (mut settings, mut recovery, mut last) = (None, None, None);
            for job in std::iter::once(job).chain(jobs.try_iter()) {
                match job {
                    Job::Settings(s) => settings = Some(s),
                    Job::Recovery(r) => recovery = Some(r),
                    Job::Last(l) => last = Some(l),
                }
            }
            match recovery {
                Some(Some(project)) => self.write(&self.recovery, project.to_json(None)),
                Some(None) => drop(fs::remove_file(&self.recovery)),
                None => {}
            }
            if let Some(project) = last {
                self.write(&self.last, project.to_json(None));
            }
            if let Some(settings) = settings {
                self.write(&self.settings, serde_json::to_vec_pretty(&settings).map_err(|e| e.to_string()));
            }
        }
    }

    fn write(&self, path: &Path, bytes: Result<Vec<u8>, String>) {
        let failed = |error: files::FileError| format!("{}: {}", path.display(), error.diagnostic.message);
        if let Err(error) = bytes.and_then(|bytes| files::write(path, &bytes).map_err(failed)) {
            *self.trouble.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    use crate::camera::Camera;
    use crate::document::{Document, MeshSource, ProgramText};
    use crate::scene::{Sphere, Style};

    fn project(text: &str) -> Project {
        Project::of(&Document {
            program: ProgramText::new("mine.vv", text),
            mesh: MeshSource::Empty,
            rule: None,
            params: Default::default(),
            param_sets: Default::default(),
            views: Default::default(),
            generation: 0,
            style: Style::default(),
            annotations: crate::annotate::Annotations::default(),
            camera: Camera::standard(Sphere { center: glam::DVec3::ZERO, radius: 1.0 }, 1.0),
        })
    }

    #[test]
    fn settings_are_remembered() {
        let folder = tempfile::tempdir().unwrap();
        let mut settings = Settings { theme: ThemeChoice::Light, speed: 5.0, ..Settings::default() };
        for name in ["a", "b", "a"] {
            settings.remember(&folder.path().join(name));
        }
        assert_eq!(settings.recent, [folder.path().join("a"), folder.path().join("b")]);
        let store = Store::open(folder.path()).unwrap();
        assert_eq!(store.settings(), Settings::default());
        store.keep_settings(&settings);
        drop(store);
        assert_eq!(Store::open(folder.path()).unwrap().settings(), settings);
    }

    #[test]
    fn settings_of_another_version_are_kept_and_what_has_no_meaning_is_forgotten_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("settings.json");
        fs::write(&path, r#"{"theme": "Pink", "tab_width": 4, "hologram": {"depth": 3}, "scale": "large"}"#).unwrap();
        let store = Store::open(folder.path()).unwrap();
        let mut settings = store.settings();
        assert_eq!(settings.preferences, Preferences { tab_width: 4, ..Preferences::default() });
        assert_eq!(settings.theme, ThemeChoice::System);
        settings.theme = ThemeChoice::Dark;
        store.keep_settings(&settings);
        drop(store);
        let written: serde_json::Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
        assert_eq!((&written["hologram"]["depth"], &written["theme"]), (&3.into(), &"Dark".into()));
    }

    #[test]
    fn settings_that_cannot_be_read_are_forgotten() {
        let folder = tempfile::tempdir().unwrap();
        for text in ["{", "[]", "{\"speed\": 1e300}", "{\"theme\": \"Pink\"}"] {
            fs::write(folder.path().join("settings.json"), text).unwrap();
            assert_eq!(Store::open(folder.path()).unwrap().settings(), Settings::default(), "{text}");
        }
    }

    #[test]
    fn what_was_unsaved_is_found_after_a_crash_and_not_while_its_window_lives() {
        let folder = tempfile::tempdir().unwrap();
        let crashed = Store::open(folder.path()).unwrap();
        crashed.keep(Some(project("// old")));
        crashed.keep(Some(project("// new")));
        let next = Store::open(folder.path()).unwrap();
        assert!(next.orphan().is_none(), "it lives");
        let lock = crashed.lock_path.clone();
        drop(crashed); // waits for the thread; a crash leaves the file with its lock free
        assert!(!lock.exists());
        let orphan = next.orphan().unwrap();
        assert_eq!(orphan.project, project("// new"));
        orphan.forget();
        assert!(next.orphan().is_none());
    }

    #[test]
    fn what_is_saved_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        store.keep(Some(project("// new")));
        store.keep(None);
        drop(store);
        assert!(Store::open(folder.path()).unwrap().orphan().is_none());
        assert_eq!(fs::read_dir(folder.path().join("recovery")).unwrap().count(), 0);
    }

    #[test]
    fn the_lock_of_a_window_that_crashed_without_unsaved_work_is_taken_away() {
        let folder = tempfile::tempdir().unwrap();
        let alive = Store::open(folder.path()).unwrap();
        let crashed = |name: &str| fs::write(folder.path().join("recovery").join(name), "").unwrap();
        ["1-1.lock", "2-2.lock", "2-2.json"].into_iter().for_each(crashed);
        let next = Store::open(folder.path()).unwrap();
        let files = fs::read_dir(folder.path().join("recovery")).unwrap().map(|file| file.unwrap().path());
        let mut expected = vec![alive.lock_path.clone(), next.lock_path.clone()];
        expected.extend(["2-2.lock", "2-2.json"].map(|name| folder.path().join("recovery").join(name)));
        assert_eq!(files.collect::<BTreeSet<_>>(), expected.into_iter().collect());
    }

    #[test]
    fn a_disk_that_takes_nothing_is_told_of() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        fs::remove_dir_all(folder.path().join("recovery")).unwrap();
        store.keep(Some(project("")));
        let began = std::time::Instant::now();
        let trouble = loop {
            if let Some(trouble) = store.trouble() {
                break trouble;
            }
            assert!(began.elapsed() < std::time::Duration::from_secs(30));
            std::thread::sleep(std::time::Duration::from_millis(2));
        };
        assert!(trouble.contains("there is no directory"), "{trouble}");
    }

    #[test]
    fn of_many_files_the_latest_are_remembered() {
        let mut settings = Settings::default();
        let path = |i: usize| std::path::absolute(format!("{i}.vv")).unwrap();
        (0..20).for_each(|i| settings.remember(&path(i)));
        assert_eq!((settings.recent.len(), &settings.recent[0]), (RECENT, &path(19)));
    }

    #[test]
    fn of_several_windows_that_crashed_the_newest_is_told_of() {
        let folder = tempfile::tempdir().unwrap();
        for text in ["// one", "// other"] {
            Store::open(folder.path()).unwrap().keep(Some(project(text)));
        }
        let store = Store::open(folder.path()).unwrap();
        for (old, expected) in [("// one", "// other"), ("// other", "// one")] {
            for file in fs::read_dir(folder.path().join("recovery")).unwrap() {
                let path = file.unwrap().path();
                let age = if fs::read_to_string(&path).unwrap().contains(old) { 1000 } else { 2000 };
                let time = std::time::UNIX_EPOCH + std::time::Duration::from_secs(age);
                File::options().write(true).open(&path).unwrap().set_modified(time).unwrap();
            }
            assert_eq!(store.orphan().unwrap().project, project(expected));
        }
    }
}
