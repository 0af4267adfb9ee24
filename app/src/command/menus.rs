//! Where each command stands: the menus, which the palette, the cheat sheet and the keys go by as well.

use super::{Command, Inspect, PairAction, Panel, Reload, TextAction, ThemeChoice, Toward, ViewAction};
use crate::annotate::{Arrows, Label, Quantity};
use crate::camera::{Side, Up};
use crate::navigation::{Preset, Turning};
use crate::scene::Surface;
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
            &[
                Command::NewProgram,
                Command::Choose(Purpose::OpenProgram),
                Command::Choose(Purpose::OpenMesh),
                Command::Choose(Purpose::OpenProject),
            ],
            &[
                Command::Save,
                Command::Choose(Purpose::SaveProgram),
                Command::Choose(Purpose::SaveProject),
                Command::Choose(Purpose::ExportMesh),
                Command::SavePicture,
            ],
            &[Command::Gallery, Command::Preferences],
            &[Command::Quit],
        ],
    },
    Menu {
        title: "Edit",
        groups: &[
            &[Command::Undo, Command::Redo],
            &[Command::Text(TextAction::Keys)],
            &[
                Command::Text(TextAction::Find),
                Command::Text(TextAction::Replace),
                Command::Text(TextAction::FindNext),
                Command::Text(TextAction::FindPrevious),
            ],
            &[
                Command::Text(TextAction::Complete),
                Command::Text(TextAction::Declaration),
                Command::Text(TextAction::ToggleComment),
                Command::Text(TextAction::Format),
                Command::Text(TextAction::RaiseNumber),
                Command::Text(TextAction::LowerNumber),
            ],
            &[Command::Text(TextAction::NextProblem), Command::Text(TextAction::PreviousProblem)],
        ],
    },
    Menu {
        title: "Run",
        groups: &[
            &[Command::Step, Command::Back, Command::Rewind, Command::End],
            &[Command::Play, Command::Stop],
            &[Command::Run, Command::ResetParams],
            &[Command::SetReload(Reload::Typed), Command::SetReload(Reload::Saved), Command::SetReload(Reload::ByHand)],
        ],
    },
    Menu {
        title: "View",
        groups: &[
            &[Command::Fit, Command::CopyImage, Command::View(ViewAction::RenderOptions)],
            &[Command::Faces, Command::Smooth, Command::Edges, Command::Vertices, Command::Control],
            &[Command::Choose(Purpose::OpenStyle), Command::Choose(Purpose::SaveStyle)],
            &[
                Command::Toggle(Panel::Program),
                Command::Toggle(Panel::Messages),
                Command::Toggle(Panel::Inspector),
                Command::Toggle(Panel::Timeline),
                Command::FullScreen,
            ],
            &[
                Command::SetTheme(ThemeChoice::System),
                Command::SetTheme(ThemeChoice::Light),
                Command::SetTheme(ThemeChoice::Dark),
            ],
        ],
    },
    Menu {
        title: "Subdivide",
        groups: &[
            &[Command::Subdivide("loop.vv"), Command::Subdivide("butterfly.vv"), Command::Subdivide("sqrt3.vv")],
            &[
                Command::Subdivide("catmull-clark.vv"),
                Command::Subdivide("doo-sabin.vv"),
                Command::Subdivide("quad-triangle.vv"),
                Command::Subdivide("midedge.vv"),
                Command::Subdivide("four-eight.vv"),
            ],
        ],
    },
    Menu {
        title: "Compare",
        groups: &[
            &[Command::Pair(PairAction::Compare), Command::Pair(PairAction::Switch), Command::Pair(PairAction::Close)],
            &[Command::Pair(PairAction::LinkViews), Command::Pair(PairAction::LinkSteps)],
        ],
    },
    Menu {
        title: "Camera",
        groups: &[
            &[
                Command::View(ViewAction::From(Side::Front)),
                Command::View(ViewAction::From(Side::Back)),
                Command::View(ViewAction::From(Side::Left)),
                Command::View(ViewAction::From(Side::Right)),
                Command::View(ViewAction::From(Side::Top)),
                Command::View(ViewAction::From(Side::Bottom)),
                Command::View(ViewAction::From(Side::Isometric)),
            ],
            &[Command::View(ViewAction::Orthographic)],
            &[Command::View(ViewAction::Copy), Command::View(ViewAction::Paste)],
        ],
    },
    Menu {
        title: "Move",
        groups: &[
            &[
                Command::View(ViewAction::Turn(Toward::Left)),
                Command::View(ViewAction::Turn(Toward::Right)),
                Command::View(ViewAction::Turn(Toward::Up)),
                Command::View(ViewAction::Turn(Toward::Down)),
            ],
            &[
                Command::View(ViewAction::Shift(Toward::Left)),
                Command::View(ViewAction::Shift(Toward::Right)),
                Command::View(ViewAction::Shift(Toward::Up)),
                Command::View(ViewAction::Shift(Toward::Down)),
            ],
            &[Command::View(ViewAction::Nearer), Command::View(ViewAction::Farther)],
        ],
    },
    Menu {
        title: "Navigation",
        groups: &[
            &[
                Command::View(ViewAction::SetPreset(Preset::Vv)),
                Command::View(ViewAction::SetPreset(Preset::Blender)),
                Command::View(ViewAction::SetPreset(Preset::Maya)),
            ],
            &[
                Command::View(ViewAction::SetTurning(Turning::Arcball)),
                Command::View(ViewAction::SetTurning(Turning::Turntable)),
            ],
            &[Command::View(ViewAction::SetUp(Up::Y)), Command::View(ViewAction::SetUp(Up::Z))],
            &[Command::View(ViewAction::Gliding)],
        ],
    },
    Menu {
        title: "Inspect",
        groups: &[
            &[
                Command::Inspect(Inspect::AskForVertex),
                Command::Inspect(Inspect::Fly),
                Command::Inspect(Inspect::Clear),
            ],
            &[
                Command::Inspect(Inspect::WalkOn),
                Command::Inspect(Inspect::WalkBack),
                Command::Inspect(Inspect::PlayWalk),
                Command::Inspect(Inspect::EndWalk),
            ],
            &[
                Command::Inspect(Inspect::OldRing),
                Command::Inspect(Inspect::Mask),
                Command::Choose(Purpose::SaveMask),
                Command::Inspect(Inspect::ListProblems),
            ],
        ],
    },
    Menu {
        title: "Show",
        groups: &[
            &[
                Command::ColorBy(Quantity::Plain),
                Command::ColorBy(Quantity::Valence),
                Command::ColorBy(Quantity::Degree),
                Command::ColorBy(Quantity::Gauss),
                Command::ColorBy(Quantity::Mean),
                Command::ColorBy(Quantity::Birth),
                Command::ColorBy(Quantity::Change),
                Command::ColorBy(Quantity::Coordinate(0)),
                Command::ColorBy(Quantity::Coordinate(1)),
                Command::ColorBy(Quantity::Coordinate(2)),
            ],
            &[
                Command::LabelBy(Label::Nothing),
                Command::LabelBy(Label::Vertices),
                Command::LabelBy(Label::Degrees),
                Command::LabelBy(Label::Numbers),
            ],
            &[
                Command::ArrowsOf(Arrows::Nothing),
                Command::ArrowsOf(Arrows::VertexNormals),
                Command::ArrowsOf(Arrows::FaceNormals),
            ],
            &[
                Command::ShowBy(Surface::Lights),
                Command::ShowBy(Surface::ReflectionLines),
                Command::ShowBy(Surface::Isophotes),
            ],
            &[Command::Cut, Command::Occlusion, Command::Grid, Command::Axes],
        ],
    },
    Menu { title: "Help", groups: &[&[Command::Palette, Command::CheatSheet, Command::Reference]] },
];

/// The menu that another one is part of; `None` for those that stand in the bar.
#[must_use]
pub fn outer(title: &str) -> Option<&'static str> {
    match title {
        "Move" | "Navigation" => Some("Camera"),
        "Compare" => Some("View"),
        _ => None,
    }
}

/// The commands that keys mean.
pub fn with_keys() -> impl Iterator<Item = &'static Command> {
    MENUS.iter().flat_map(|menu| menu.groups).copied().flatten().filter(|c| !c.describe().shortcuts.is_empty())
}
