//! A second document beside the first.
//!
//! The session is the document that has the keys and the panels; the other one is a session of its own, with its own
//! worker and history, inside of it. To switch is to swap the two. What belongs to the window (settings, dialogs, the
//! question whether to quit) goes along to the one that has the keys.

use std::time::Duration;

use vv::diagnostic::Severity;

use super::undo::Common;
use super::{Dialog, Origin, Session};
use crate::command::{Command, PairAction};

/// The document beside the one that has the keys.
pub struct Beside {
    other: Box<Session>,
    /// Whether it stands at the right.
    pub right: bool,
    /// Whether both are looked at from the same viewpoint.
    pub views_linked: bool,
    /// Whether both walk the generations together.
    pub steps_linked: bool,
}

impl Beside {
    /// The other document.
    #[must_use]
    pub fn session(&self) -> &Session {
        &self.other
    }

    /// The other document, for the viewport that shows it.
    pub fn session_mut(&mut self) -> &mut Session {
        &mut self.other
    }
}

/// What links looked like before a command.
pub(super) struct Before {
    mesh: crate::document::MeshSource,
    fit: bool,
    /// What the other document does as well.
    echo: Option<(Common, Command)>,
}

impl Session {
    /// Tells documents apart, also after two have changed sides.
    #[must_use]
    pub fn id(&self) -> u64 {
        self.id
    }

    /// The document beside this one.
    #[must_use]
    pub fn beside(&self) -> Option<&Beside> {
        self.beside.as_ref()
    }

    /// The same, for the viewport that shows it.
    pub fn beside_mut(&mut self) -> Option<&mut Beside> {
        self.beside.as_mut()
    }

    /// Carries out what concerns two documents.
    pub(super) fn change_pair(&mut self, action: PairAction) {
        match action {
            PairAction::Compare if self.beside.is_none() => self.compare(),
            PairAction::Compare => {}
            PairAction::Switch => self.switch(),
            PairAction::Close if self.beside.is_some() => {
                self.unless_unsaved(Command::Pair(PairAction::Close), Self::close_this);
            }
            PairAction::Close => {}
            PairAction::LinkViews => {
                if let Some(beside) = &mut self.beside {
                    beside.views_linked = !beside.views_linked;
                }
                self.link_views();
            }
            PairAction::LinkSteps => {
                if let Some(beside) = &mut self.beside {
                    beside.steps_linked = !beside.steps_linked;
                }
            }
            PairAction::Other(command) => self.tell_other(*command),
        }
    }

    /// Opens a copy at the right, which gets the keys.
    fn compare(&mut self) {
        let mut other = match Self::of(self.document.clone(), std::sync::Arc::clone(&self.wake)) {
            Ok(other) => other,
            Err(error) => return self.say(Severity::Error, format!("no second document: {error}")),
        };
        other.adopt(self.settings());
        other.store = self.store.as_ref().and_then(|store| store.sibling().ok());
        other.text_to_run = std::sync::Arc::clone(&self.text_to_run);
        other.mesh_chosen = true;
        other.fit = true; // the picture is narrower now
        other.watch_files();
        other.ask_now();
        // What is computed already is seen at once.
        other.frame.clone_from(&self.frame);
        other.program.clone_from(&self.program);
        other.frame_of = match self.origin() {
            Origin::This => Some(other.programs()),
            Origin::Former => Some(u64::MAX), // of none that it will have
            Origin::Mesh => None,
        };
        other.flight.clone_from(&self.flight);
        self.beside = Some(Beside { other: Box::new(other), right: true, views_linked: true, steps_linked: true });
        self.switch();
    }

    /// Keys and panels to the other document.
    pub(super) fn switch(&mut self) {
        let Some(mut beside) = self.beside.take() else { return };
        std::mem::swap(self, &mut beside.other);
        beside.right = !beside.right;
        let other = &mut beside.other;
        self.adopt_from(other);
        self.full_screen = other.full_screen;
        self.reference = other.reference;
        self.render_options = other.render_options;
        self.wants_quit = std::mem::take(&mut other.wants_quit);
        self.text_actions = std::mem::take(&mut other.text_actions);
        self.copied = other.copied.take();
        self.awaited = other.awaited.take();
        std::mem::swap(&mut self.clipboard, &mut other.clipboard);
        if self.dialog.is_none() {
            self.dialog = other.dialog.take();
        }
        self.beside = Some(beside);
    }

    fn close_this(&mut self) {
        self.switch();
        if let Some(mut beside) = self.beside.take() {
            beside.other.leave();
            // What it computes is to end first.
            std::thread::spawn(move || drop(beside));
        }
    }

    /// Ends, unless the other document would lose something.
    pub(super) fn quit(&mut self) {
        if self.beside.as_ref().is_some_and(|beside| beside.other.would_lose()) {
            self.switch();
            self.dialog = Some(Dialog::Unsaved { then: Box::new(Command::Quit) });
        } else {
            if let Some(beside) = &mut self.beside {
                beside.other.leave();
            }
            self.end();
        }
    }

    /// To be called before a command is carried out.
    pub(super) fn before(&mut self, command: &Command) -> Before {
        let echo = self.beside.as_ref().filter(|beside| beside.steps_linked && walks(command));
        let possible = echo.filter(|beside| {
            let same_play = *command != Command::Play || beside.other.is_playing() == self.is_playing();
            same_play && command.is_enabled(&beside.other)
        });
        let echo = possible.map(|_| (Common::new(), command.clone()));
        if self.beside.is_some() {
            self.do_in_common(echo.as_ref().map(|(common, _)| *common));
        }
        Before { mesh: self.document.mesh.clone(), fit: self.fit, echo }
    }

    /// What the other document does as well, after a command.
    pub(super) fn link(&mut self, before: Before) {
        let Some(beside) = &mut self.beside else { return };
        if let Some((common, command)) = before.echo {
            beside.other.do_in_common(Some(common));
            beside.other.apply(command);
            beside.other.do_in_common(None);
        }
        if beside.views_linked && self.document.mesh == before.mesh && !self.asked_to_fit {
            self.fit = before.fit; // another program on the same mesh is looked at as the one before
        }
        self.link_views();
    }

    fn link_views(&mut self) {
        if let Some(beside) = self.beside.as_mut().filter(|beside| beside.views_linked) {
            beside.other.document.camera = self.document.camera;
            beside.other.flight.clone_from(&self.flight);
        }
    }

    /// Something for the other document, whose viewpoint then is that of both.
    fn tell_other(&mut self, command: Command) {
        let Some(beside) = &mut self.beside else { return };
        beside.other.apply(command);
        if beside.views_linked {
            self.document.camera = beside.other.document.camera;
            self.flight.clone_from(&beside.other.flight);
        }
    }

    /// Undoes what the other document has done in common with this one, as long as both are linked.
    pub(super) fn undo_beside(&mut self, common: Common) {
        if let Some(beside) = self.beside.as_mut().filter(|beside| beside.steps_linked) {
            beside.other.undo_common(common);
        }
    }

    /// Does it again.
    pub(super) fn redo_beside(&mut self, common: Common) {
        if let Some(beside) = self.beside.as_mut().filter(|beside| beside.steps_linked) {
            beside.other.redo_common(common);
        }
    }

    /// Takes in what has happened to the other document; when to call again.
    pub(super) fn poll_other(&mut self) -> Option<Duration> {
        let beside = self.beside.as_mut()?;
        let next = beside.other.poll();
        if beside.other.dialog.is_some() {
            self.switch(); // it has a question
        }
        next
    }
}

/// Whether a command walks the generations.
fn walks(command: &Command) -> bool {
    matches!(
        command,
        Command::Step
            | Command::Back
            | Command::Rewind
            | Command::End
            | Command::GoTo(_)
            | Command::Scrub(_)
            | Command::Play
            | Command::Stop
    )
}
