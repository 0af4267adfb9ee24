//! What panels read of a session.

use std::sync::{Arc, MutexGuard};

use vv::diagnostic::Severity;
use vv::ir::Program;

use super::{Halted, Origin, Problems, Session, Stale};
use crate::console::Console;
use crate::worker::{Frame, Reached};

impl Session {
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

    /// The step that was tried last, if it failed. [`Session::frame`] is then as good as before, of another generation.
    #[must_use]
    pub fn halted(&self) -> Option<&Halted> {
        self.halted.as_ref()
    }

    /// Where [`Session::frame`] comes from.
    #[must_use]
    pub fn origin(&self) -> Origin {
        match self.frame_of {
            Some(of) if of == self.programs() => Origin::This,
            Some(_) => Origin::Former,
            None => Origin::Mesh,
        }
    }

    /// What the program is called that made [`Session::frame`].
    #[must_use]
    pub fn made_by(&self) -> String {
        match (self.origin(), &self.frame) {
            (Origin::Former, Some(frame)) => crate::document::file_name(&frame.request.recipe.path),
            _ => self.document.program.name.clone(),
        }
    }

    /// What is shown, in a few words.
    #[must_use]
    pub fn shown_as(&self) -> String {
        let generation = self.shown_generation();
        match self.origin() {
            Origin::This => format!("generation {generation}"),
            Origin::Former => format!("generation {generation} of {}", self.made_by()),
            Origin::Mesh if self.stale.is_some() => "nothing computed".to_owned(),
            Origin::Mesh => format!("generation {generation}"),
        }
    }

    /// What is known of a generation that was reached.
    #[must_use]
    pub fn reached(&self, generation: u64) -> Option<Reached> {
        self.worker.reached().get(&generation).copied()
    }

    /// The last of them.
    #[must_use]
    pub fn last_reached(&self) -> u64 {
        self.worker.reached().last_key_value().map_or(0, |(generation, _)| *generation)
    }

    /// Seconds since the worker began, and the generation it is at; `None` if it rests.
    #[must_use]
    pub fn progress(&self) -> Option<(f64, Option<u64>)> {
        self.running.as_ref().map(|r| (r.since.elapsed().as_secs_f64(), r.stepping))
    }

    /// The generation of [`Session::frame`], 0 if there is none.
    #[must_use]
    pub fn shown_generation(&self) -> u64 {
        self.frame.as_ref().map_or(0, |frame| frame.request.generation)
    }

    /// Whether lines are shown that tell how smooth a surface is, on faces that are drawn flat.
    #[must_use]
    pub fn shows_flat_lines(&self) -> bool {
        let style = self.document.style;
        style.faces && !style.smooth && style.surface != crate::scene::Surface::Lights
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

    /// The generation whose output is shown: the one that is computed, failed or was stopped, else the one shown.
    #[must_use]
    pub fn console_generation(&self) -> u64 {
        match &self.running {
            Some(running) => running.request.generation,
            None => {
                let halted = self.halted.as_ref().map(|halted| halted.generation);
                self.stopped.or(halted).unwrap_or(self.document.generation)
            }
        }
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
}
