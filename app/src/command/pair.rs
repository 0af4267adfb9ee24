//! What a user can ask of two documents side by side.

use eframe::egui::{Key, KeyboardShortcut};

use super::{Command, Description, ctrl};
use crate::session::Session;

/// Something to do with two documents.
#[derive(Debug, Clone, PartialEq)]
pub enum PairAction {
    /// Opens a copy of the document beside it.
    Compare,
    /// The other document gets the keys and the panels.
    Switch,
    /// Closes the document that has the keys; the other one stays.
    Close,
    /// Both are looked at from the same viewpoint, or each from its own.
    LinkViews,
    /// Both walk the generations together, or each for itself.
    LinkSteps,
    /// Something to do for the other document.
    Other(Box<Command>),
}

impl PairAction {
    pub(super) fn describe(&self) -> Description {
        let (label, tooltip, shortcuts): (_, _, &'static [KeyboardShortcut]) = match self {
            Self::Compare => (
                "Side by side",
                "open a copy of the document beside it, to compare programs or meshes",
                const { &[ctrl(Key::Backslash)] },
            ),
            Self::Switch => ("Other side", "keys and panels belong to the other document", const { &[ctrl(Key::F6)] }),
            Self::Close => ("Close this side", "the other document stays", const { &[ctrl(Key::W)] }),
            Self::LinkViews => {
                ("Link views", "look at both documents from the same viewpoint", const { &[ctrl(Key::L)] })
            }
            Self::LinkSteps => ("Link steps", "step, go back and play in both documents at once", &[]),
            Self::Other(_) => ("", "", &[]),
        };
        Description { label, tooltip, shortcuts }
    }

    pub(super) fn is_enabled(&self, session: &Session) -> bool {
        session.beside().is_some() != (*self == Self::Compare)
    }

    pub(super) fn is_on(&self, session: &Session) -> Option<bool> {
        match self {
            Self::LinkViews => Some(session.beside().is_some_and(|beside| beside.views_linked)),
            Self::LinkSteps => Some(session.beside().is_some_and(|beside| beside.steps_linked)),
            _ => None,
        }
    }
}
