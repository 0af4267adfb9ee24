//! Where each command stands: the menus, which the palette, the cheat sheet and the keys go by as well.

use super::{Command, Panel, ThemeChoice};
use crate::session::Purpose;

/// A menu.
#[derive(Debug)]
pub struct Menu {
    /// In the menu bar.
    pub title: &'static str,
    /// Its entries; lines stand between the groups.
    pub groups: &'static [&'static [Command]],
}

/// All menus, in the order of the bar. A command that stands in none has no key.
pub const MENUS: &[Menu] = &[
    Menu {
        title: "File",
        groups: &[
            &[Command::NewProgram, Command::Choose(Purpose::OpenProgram), Command::Choose(Purpose::OpenMesh)],
            &[Command::Save, Command::Choose(Purpose::SaveProgram), Command::Choose(Purpose::ExportMesh)],
            &[Command::Quit],
        ],
    },
    Menu {
        title: "Run",
        groups: &[
            &[Command::Step, Command::Back, Command::Rewind],
            &[Command::Play, Command::Stop],
            &[Command::Run, Command::ResetParams],
        ],
    },
    Menu {
        title: "View",
        groups: &[
            &[Command::Fit, Command::CopyImage],
            &[Command::Faces, Command::Smooth, Command::Edges, Command::Vertices, Command::Control],
            &[
                Command::Toggle(Panel::Program),
                Command::Toggle(Panel::Messages),
                Command::Toggle(Panel::Inspector),
                Command::FullScreen,
            ],
            &[
                Command::SetTheme(ThemeChoice::System),
                Command::SetTheme(ThemeChoice::Light),
                Command::SetTheme(ThemeChoice::Dark),
            ],
        ],
    },
    Menu { title: "Help", groups: &[&[Command::Palette, Command::CheatSheet]] },
];

/// The commands that keys mean.
pub fn with_keys() -> impl Iterator<Item = &'static Command> {
    MENUS.iter().flat_map(|menu| menu.groups).copied().flatten().filter(|c| !c.describe().shortcuts.is_empty())
}
