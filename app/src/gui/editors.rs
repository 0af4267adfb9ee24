//! The editors, one for each document: each has a cursor, a search and a place of its own.

use eframe::egui::Context;

use super::editor::Editor;
use crate::session::Session;

/// The editors of the documents that are open.
pub struct Editors {
    /// The one of the document that has the keys.
    current: Editor,
    document: u64,
    /// The other one, if it was ever shown.
    other: Option<(u64, Editor)>,
}

impl Default for Editors {
    fn default() -> Self {
        Self { current: Editor::default(), document: u64::MAX, other: None }
    }
}

impl Editors {
    /// The one of the document that has the keys.
    pub fn current(&self) -> &Editor {
        &self.current
    }

    /// The same, to be changed.
    pub fn current_mut(&mut self) -> &mut Editor {
        &mut self.current
    }

    /// The same, for the panel that shows it; after a switch with its cursor where it was.
    pub fn of(&mut self, ctx: &Context, session: &Session) -> &mut Editor {
        let document = session.id();
        if self.document != document {
            let known = self.other.take_if(|(of, _)| *of == document).map(|(_, editor)| editor);
            let before = std::mem::replace(&mut self.current, known.unwrap_or_default());
            self.other = Some((self.document, before));
            self.document = document;
            self.current.take_keys(ctx, document);
        }
        let beside = session.beside().map(|beside| beside.session().id());
        self.other.take_if(|(of, _)| Some(*of) != beside);
        &mut self.current
    }
}
