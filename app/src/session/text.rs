//! The program's text: how it is changed, and when it is run.

use std::sync::Arc;
use std::time::Duration;

use vv::diagnostic::{Hint, Severity};

use super::{Reveal, Session};
use crate::command::{Command, Reload, TextAction};

/// How long a text rests before it is compiled.
const TYPING_PAUSE: Duration = Duration::from_millis(300);

impl Session {
    /// Whether the text in the editor is not the one that was run, and waits for somebody to say so.
    #[must_use]
    pub fn text_waits(&self) -> bool {
        self.text_to_run != self.document.program.text
    }

    /// The texts that the last program that compiled includes.
    #[must_use]
    pub fn included_texts(&self) -> Vec<Arc<str>> {
        let Some(program) = &self.program else { return Vec::new() };
        program.sources.files().iter().skip(1).map(|file| Arc::clone(&file.text)).collect()
    }

    /// Whether some problem has a place in the text in the editor.
    #[must_use]
    pub fn has_problems_here(&self) -> bool {
        self.problems.iter().any(|p| p.place.as_ref().is_some_and(|place| place.own))
    }

    /// What another program has written into the program's file while the text here has changes of its own.
    #[must_use]
    pub fn text_on_disk(&self) -> Option<&Arc<str>> {
        self.text_on_disk.as_ref()
    }

    /// Carries out what concerns the text.
    pub(super) fn change_text(&mut self, command: Command) {
        match command {
            Command::Edit(text) if self.document.program.text != text => {
                self.document.program.text = text;
                self.text_was_edited();
                self.ask_after(TYPING_PAUSE);
            }
            Command::Tune(text) if self.document.program.text != text => {
                self.document.program.text = text;
                self.run_text();
                self.ask_now();
            }
            Command::Text(TextAction::Format) => self.format(),
            Command::Text(action) => {
                self.panels.program = true;
                self.text_actions.push(action);
            }
            Command::SetReload(reload) => {
                self.reload = reload;
                self.text_was_edited();
                self.ask_now();
            }
            Command::Fix(hint) => self.fix(&hint),
            Command::Reveal(range) => {
                self.panels.program = true;
                self.reveal = Some(Reveal { range, focus: true });
            }
            Command::Run => {
                self.run_text();
                self.includes_revision += 1;
                self.mesh_revision += 1;
                self.ask_now();
            }
            _ => {}
        }
    }

    /// From now on this text is run.
    pub(super) fn run_text(&mut self) {
        self.text_to_run = Arc::clone(&self.document.program.text);
    }

    pub(super) fn text_was_edited(&mut self) {
        if self.reload == Reload::Typed {
            self.run_text();
        }
    }

    pub(super) fn text_was_saved(&mut self) {
        if self.reload != Reload::ByHand {
            self.run_text();
        }
    }

    fn format(&mut self) {
        match vv::syntax::format(&self.document.program.text) {
            Ok(text) if *text == *self.document.program.text => self.say(Severity::Note, "laid out already"),
            Ok(text) => {
                self.document.program.text = text.into();
                self.text_was_edited();
                self.ask_now();
            }
            Err(_) => {
                let text = "only a program that can be read without doubt is laid out: see its errors";
                self.say(Severity::Error, text);
            }
        }
    }

    fn fix(&mut self, hint: &Hint) {
        let Some((span, replacement)) = &hint.edit else { return };
        let text = &self.document.program.text;
        let (start, end) = (span.start as usize, span.end as usize);
        // The text may have changed since the diagnostic was made.
        if span.file != vv::source::FileId::MAIN || text.get(start..end).is_none() {
            return;
        }
        let text = format!("{}{replacement}{}", &text[..start], &text[end..]);
        self.document.program.text = text.into();
        self.text_was_edited();
        self.ask_now();
    }
}
