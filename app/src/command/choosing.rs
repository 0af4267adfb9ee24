//! What files can be chosen for.

use eframe::egui::{Key, KeyboardShortcut};

use super::{Description, ctrl, ctrl_shift};
use crate::session::{MaskState, Purpose, Session};

pub(super) fn describe(purpose: Purpose) -> Description {
    let (label, tooltip, shortcuts): (_, _, &'static [KeyboardShortcut]) = match purpose {
        Purpose::OpenProgram => ("Open program…", "open a .vv file", const { &[ctrl(Key::O)] }),
        Purpose::OpenMesh => ("Open mesh…", "open a mesh file", const { &[ctrl_shift(Key::O)] }),
        Purpose::SaveProgram => {
            ("Save program as…", "save the program under another name", const { &[ctrl_shift(Key::S)] })
        }
        Purpose::ExportMesh => {
            ("Save mesh as…", "write the mesh shown into a file; its extension says how", const { &[ctrl(Key::E)] })
        }
        Purpose::OpenProject => ("Open project…", "open program, mesh, parameters and view together", &[]),
        Purpose::SaveProject => ("Save project as…", "save program, mesh, parameters and view together", &[]),
        Purpose::OpenStyle => ("Load style…", "show things as a style file says", &[]),
        Purpose::SaveStyle => {
            ("Save style…", "save how things are shown, for other meshes and for `vv run --style`", &[])
        }
        Purpose::SaveMask => {
            ("Save mask as figure…", "draw the mask of the selected vertex for a paper, as `vv mask` does", &[])
        }
        // Asked after its options.
        Purpose::SavePicture => ("", "", &[]),
    };
    Description { label, tooltip, shortcuts }
}

pub(super) fn is_enabled(purpose: Purpose, session: &Session) -> bool {
    match purpose {
        Purpose::ExportMesh => session.frame().is_some(),
        Purpose::SaveMask => matches!(session.mask(), MaskState::Found(mask) if mask.is_affine),
        _ => true,
    }
}
