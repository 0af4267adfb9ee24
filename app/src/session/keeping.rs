//! Settings that are remembered, and the unsaved text that is kept for the case of a crash.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use vv::diagnostic::Severity;

use super::{Dialog, Session};
use crate::project::Project;
use crate::store::{Settings, Store};

/// What is typed is on its way to the disk after that.
const PAUSE: Duration = Duration::from_millis(500);

/// What was given to the store last.
#[derive(Default)]
pub(super) struct Keeping {
    settings: Option<Settings>,
    text: Option<Arc<str>>,
    since: Option<Instant>,
}

impl Session {
    pub(super) fn remember_with(&mut self, store: Store) {
        let Settings { theme, reload, panels, speed, recent, navigation } = store.settings();
        self.navigation = navigation;
        (self.theme, self.reload, self.panels, self.speed, self.recent) = (theme, reload, panels, speed, recent);
        self.orphan = store.orphan();
        self.dialog = self.orphan.as_ref().map(|orphan| Dialog::Recover { name: orphan.project.name.clone() });
        self.keeping.settings = Some(self.settings());
        self.store = Some(store);
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

    fn settings(&self) -> Settings {
        Settings {
            theme: self.theme,
            reload: self.reload,
            panels: self.panels,
            speed: self.speed,
            recent: self.recent.clone(),
            navigation: self.navigation,
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
        if let Some(trouble) = store.trouble() {
            self.say(Severity::Error, format!("what is unsaved cannot be kept: {trouble}"));
        }
        let program = &self.document.program;
        let unsaved = (program.is_modified() && !self.wants_quit).then(|| Arc::clone(&program.text));
        if unsaved == self.keeping.text {
            self.keeping.since = None;
            return None;
        }
        let now = Instant::now();
        let due = *self.keeping.since.get_or_insert(now + PAUSE);
        let is_run = self.due.is_some_and(|due| due <= now);
        if due > now && !is_run && unsaved.is_some() {
            return Some(due);
        }
        let project = unsaved.is_some().then(|| Project::of(&self.document));
        if let Some(store) = &self.store {
            store.keep(project);
        }
        self.keeping.text = unsaved;
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
