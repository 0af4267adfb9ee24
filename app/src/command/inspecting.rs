//! Commands that look closer: at what is selected, at rings and walks, at what is wrong with the mesh.

use eframe::egui::{Key, KeyboardShortcut};
use vv::mesh::Vertex;

use super::{Description, alt, ctrl, key, shift};
use crate::inspect::selection::Item;
use crate::session::Session;

/// To look closer.
#[derive(Debug, Clone, PartialEq)]
pub enum Inspect {
    /// This alone is selected.
    Select(Item),
    /// This is selected, too; or no more.
    Toggle(Item),
    /// These vertices are selected, by number; those that do not exist are told of.
    SelectNumbers(Vec<u64>),
    /// Nothing is selected.
    Clear,
    /// Asks for numbers of vertices.
    AskForVertex,
    /// What is selected comes close.
    Fly,
    /// The pointer rests on this vertex, in the picture or in a panel.
    Point(Option<Vertex>),

    /// The same of a vertex of the generation before, in a mask.
    PointOld(Option<Vertex>),
    /// The mask of the selected vertex: of which vertices the step made it.
    Mask,

    /// Begins Edmonds' walk with the arrow from the first vertex to the second.
    Walk([Vertex; 2]),
    /// One arrow further; begins a walk at what is selected, if there is none.
    WalkOn,
    /// One arrow back.
    WalkBack,
    /// The arrows one after the other; and pauses that.
    PlayWalk,
    /// No walk any more.
    EndWalk,

    /// The distance from this vertex is measured to the one that is clicked next.
    MeasureFrom(Vertex),
    /// The corners of this have their names in the picture; or no more.
    Name(Item),

    /// The ring of the generation before in the picture, or no more.
    OldRing,
    /// The list of what is wrong with the mesh, and its marks in the picture.
    ListProblems,
}

impl Inspect {
    pub(super) fn describe(&self) -> Description {
        let (label, tooltip, shortcuts): (_, _, &'static [KeyboardShortcut]) = match self {
            // Escape does it, too, when nothing is computed that it could stop.
            Self::Clear => ("Clear selection", "select nothing, end the walk", const { &[shift(Key::Escape)] }),
            Self::AskForVertex => {
                ("Select vertex…", "select vertices by their numbers, as v12", const { &[ctrl(Key::G)] })
            }
            Self::Fly => ("Fly to selection", "bring what is selected close", const { &[shift(Key::F)] }),
            Self::WalkOn => {
                ("Walk on", "one arrow further around the face, as Edmonds walks it", const { &[key(Key::Period)] })
            }
            Self::WalkBack => ("Walk back", "one arrow back", const { &[key(Key::Comma)] }),
            Self::PlayWalk => ("Play the walk", "walk around the face, arrow by arrow", const { &[ctrl(Key::Period)] }),
            Self::EndWalk => ("End the walk", "draw no arrows any more", &[]),
            Self::OldRing => (
                "Old ring in the picture",
                "draw the ring that the selected vertex had before the step, dashed, where it was",
                &[],
            ),
            Self::ListProblems => {
                ("Mesh problems", "list what is wrong with the mesh and mark it", const { &[alt(Key::P)] })
            }
            Self::Mask => (
                "Mask",
                "of which old vertices the step made the selected one, and with which weights",
                const { &[key(Key::M)] },
            ),
            Self::Select(_)
            | Self::Toggle(_)
            | Self::SelectNumbers(_)
            | Self::Point(_)
            | Self::PointOld(_)
            | Self::MeasureFrom(_)
            | Self::Name(_)
            | Self::Walk(_) => ("", "", &[]),
        };
        Description { label, tooltip, shortcuts }
    }

    pub(super) fn is_enabled(&self, session: &Session) -> bool {
        let inspection = &session.inspection;
        let walk = inspection.walk.as_ref();
        match self {
            Self::Clear => !inspection.selection.is_empty() || walk.is_some(),
            Self::AskForVertex | Self::ListProblems | Self::Mask => session.frame().is_some(),
            Self::Fly => !session.selected().is_empty() || walk.is_some(),
            Self::WalkOn => match walk {
                Some(walking) => walking.at < walking.walk.arrows(),
                None => session.corner().is_some(),
            },
            Self::PlayWalk => walk.is_some() || session.corner().is_some(),
            Self::WalkBack => walk.is_some_and(|walking| walking.at > 1),
            Self::EndWalk => walk.is_some(),
            _ => true,
        }
    }

    pub(super) fn is_on(&self, session: &Session) -> Option<bool> {
        match self {
            Self::ListProblems => Some(session.inspection.listing),
            Self::OldRing => Some(session.inspection.old_ring),
            Self::Mask => Some(session.inspection.mask),
            Self::PlayWalk => Some(session.inspection.walk.as_ref().is_some_and(|w| w.playing.is_some())),
            _ => None,
        }
    }
}
