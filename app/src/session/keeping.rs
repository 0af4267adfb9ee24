//! Settings that are remembered, and the unsaved text that is kept for the case of a crash.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use vv::diagnostic::Severity;

use super::{Dialog, Session};
use crate::document::{Document, MeshSource};
use crate::preferences::{Preferences, Start};
use crate::project::Project;
use crate::store::{Settings, Store};

/// What is typed is on its way to the disk after that.
const PAUSE: Duration = Duration::from_millis(500);

/// What was given to the store last.
#[derive(Default)]
pub(super) struct Keeping {
    settings: Option<Settings>,
    /// What another version of vv has set.
    others: serde_json::Map<String, serde_json::Value>,
    document: Option<Document>,
    since: Option<Instant>,
    /// Whether values that are in no file have changed since it was opened or saved.
    touched: bool,
}

/// A project that is open.
pub(super) struct OpenProject {
    path: PathBuf,
    /// As it is in its file.
    saved: Document,
}

impl Session {
    pub(super) fn remember_with(&mut self, store: Store) {
        self.adopt(store.settings());
        self.orphan = store.orphan();
        self.dialog = self.orphan.as_ref().map(|orphan| Dialog::Recover { name: orphan.project.name.clone() });
        self.store = Some(store);
    }

    /// Takes settings over, which are on the disk or on their way there.
    pub(super) fn adopt(&mut self, settings: Settings) {
        self.keeping.settings = Some(settings.clone());
        let Settings { theme, reload, panels, speed, recent, navigation, preferences, others } = settings;
        self.navigation = navigation;
        (self.theme, self.reload, self.panels, self.speed, self.recent) = (theme, reload, panels, speed, recent);
        self.keeping.others = others;
        self.prefer(preferences);
    }

    /// What the window opens with where no file is given: as the user likes it, unless there is something to bring back.
    pub(super) fn begin(&mut self) {
        let Some(store) = self.store.as_ref().filter(|_| self.dialog.is_none()) else { return };
        match self.preferences.start {
            Start::Gallery => self.dialog = Some(Dialog::gallery()),
            Start::Surface => {}
            Start::LastSession => {
                if let Some(project) = store.last_session() {
                    self.open_document(project);
                }
            }
        }
    }

    /// Takes notice of what a command has changed. What a few clicks bring back is no work: a view, a style, a generation,
    /// a file that was opened.
    pub(super) fn touch(&mut self, before: &Document) {
        let now = &self.document;
        let computed = before.mesh != now.mesh && matches!(now.mesh, MeshSource::Result(_));
        let same = (&before.params, &before.param_sets, &before.views) == (&now.params, &now.param_sets, &now.views);
        self.keeping.touched |= computed || !same;
    }

    /// The window closes: there is nothing to bring back, but to begin with next time.
    pub(super) fn end(&mut self) {
        self.leave();
        if let Some(store) = &self.store {
            store.keep_last(Project::of(&self.document));
        }
    }

    /// This document closes, without anything to bring back.
    pub(super) fn leave(&mut self) {
        self.wants_quit = true;
        self.keeping.document = None;
        if let Some(store) = &self.store {
            store.keep(None);
        }
    }

    /// It is as it was opened or saved.
    pub(super) fn untouched(&mut self) {
        self.keeping.touched = false;
    }

    /// The file of the project that is open.
    #[must_use]
    pub fn project_path(&self) -> Option<&Path> {
        self.project.as_ref().map(|project| project.path.as_path())
    }

    /// Whether something would be lost if the window were closed: text that is in no file (any more), or what the project
    /// that is open does not hold. Where the eye is and which generation is shown is nobody's work.
    #[must_use]
    pub fn is_unsaved(&self) -> bool {
        match &self.project {
            Some(project) if project.saved.style != self.document.style => true,
            _ => self.is_work_unsaved(),
        }
    }

    /// The same, but for how it looks.
    fn is_work_unsaved(&self) -> bool {
        let program = &self.document.program;
        match &self.project {
            Some(project) => {
                !same_work(&project.saved, &self.document) || program.path.is_some() && program.is_modified()
            }
            None => program.is_modified() || self.program_gone,
        }
    }

    /// The project of this file holds the document now.
    pub(super) fn set_project(&mut self, path: &Path) {
        self.project = Some(OpenProject { path: path.to_owned(), saved: self.document.clone() });
        self.untouched();
    }

    /// From now on things are as the user likes them.
    pub(super) fn prefer(&mut self, preferences: Preferences) {
        self.preferences = preferences.sensible();
        self.worker.keep_within((self.preferences.memory << 20).min(self.most_memory));
    }

    /// Files that were open, the last one first.
    #[must_use]
    pub fn recent(&self) -> &[PathBuf] {
        &self.recent
    }

    pub(super) fn remember(&mut self, path: &Path) {
        let mut settings = self.settings();
        settings.remember(path);
        self.recent = settings.recent;
    }

    /// Takes over what has the keys no more.
    pub(super) fn adopt_from(&mut self, other: &Self) {
        self.adopt(other.settings());
        self.keeping.settings.clone_from(&other.keeping.settings);
    }

    pub(super) fn settings(&self) -> Settings {
        Settings {
            theme: self.theme,
            reload: self.reload,
            panels: self.panels,
            speed: self.speed,
            recent: self.recent.clone(),
            navigation: self.navigation,
            preferences: self.preferences,
            others: self.keeping.others.clone(),
        }
    }

    /// Gives the store what has changed: settings at once, text when its time has come, and before it is run. Returns
    /// when that is.
    pub(super) fn keep(&mut self) -> Option<Instant> {
        let store = self.store.as_ref()?;
        let settings = self.settings();
        if self.keeping.settings.as_ref() != Some(&settings) {
            store.keep_settings(&settings);
            self.keeping.settings = Some(settings);
        }
        let trouble = store.trouble();
        if let Some(trouble) = trouble {
            self.say(Severity::Error, format!("what is unsaved cannot be kept: {trouble}"));
        }
        let worth = !self.wants_quit && (self.keeping.touched || self.is_work_unsaved());
        let kept = self.keeping.document.as_ref();
        if worth && kept == Some(&self.document) || !worth && kept.is_none() {
            self.keeping.since = None;
            return None;
        }
        let now = Instant::now();
        let due = *self.keeping.since.get_or_insert(now + PAUSE);
        let is_run = self.due.is_some_and(|due| due <= now);
        if due > now && !is_run && worth {
            return Some(due);
        }
        let project = worth.then(|| Project::of(&self.document));
        if let Some(store) = &self.store {
            store.keep(project);
        }
        self.keeping.document = worth.then(|| self.document.clone());
        self.keeping.since = None;
        None
    }

    pub(super) fn answer_recovery(&mut self, take: bool) {
        self.dialog = None;
        let Some(orphan) = self.orphan.take() else { return };
        if take {
            self.open_document(orphan.project.clone());
        }
        orphan.forget();
    }

    /// Works on what is in a project.
    pub(super) fn open_document(&mut self, project: Project) {
        let document = project.into_document();
        let text = Arc::clone(&document.program.text);
        self.set_program(document.program.clone());
        self.mesh_chosen = true;
        self.document = document;
        self.document.program.text = text;
        self.run_text();
        self.fit = false;
        self.mesh_revision += 1;
        self.watch_files();
        self.ask_now();
    }
}

/// Whether two documents hold the same work, but for how it looks.
fn same_work(a: &Document, b: &Document) -> bool {
    (&a.program.path, &a.program.text, &a.views) == (&b.program.path, &b.program.text, &b.views)
        && (&a.mesh, &a.rule, &a.params, &a.param_sets) == (&b.mesh, &b.rule, &b.params, &b.param_sets)
}
