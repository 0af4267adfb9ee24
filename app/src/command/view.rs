//! What a user can ask of the camera.

use eframe::egui::{Key, KeyboardShortcut, Modifiers};

use super::{Command, Description, Inspect, alt, ctrl, ctrl_shift, key, shift};
use crate::camera::{Camera, Side, Up};
use crate::navigation::{Preset, Turning};
use crate::session::Session;

/// Something to do with the camera.
///
/// Alt with a digit is what the digit of the numeric keypad is in Blender, with Ctrl the opposite or a shift.
#[derive(Debug, Clone, PartialEq)]
pub enum ViewAction {
    /// Looks from a side.
    From(Side),
    /// Parallel lines of sight on and off.
    Orthographic,
    /// The camera goes around the pivot by a step.
    Turn(Toward),
    /// What is seen is shifted by a step.
    Shift(Toward),
    /// A step nearer.
    Nearer,
    /// A step farther.
    Farther,
    /// There, gliding if that is wanted.
    Glide(Camera),
    /// The viewpoint as text to the clipboard.
    Copy,
    /// The viewpoint from the clipboard.
    Paste,
    /// The viewpoint of a text.
    Show(String),
    /// Keeps the viewpoint under a name.
    Save(String),
    /// The viewpoint as it was kept under a name.
    Use(String),
    /// Forgets what was kept under a name.
    Forget(String),
    /// What the hands do.
    SetPreset(Preset),
    /// How dragging turns.
    SetTurning(Turning),
    /// Which axis points up.
    SetUp(Up),
    /// Gliding to new viewpoints on and off.
    Gliding,
    /// How things are drawn, in a window over the picture, or no more.
    RenderOptions,
}

/// A direction in the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Toward {
    /// Left.
    Left,
    /// Right.
    Right,
    /// Up.
    Up,
    /// Down.
    Down,
}

const fn ctrl_alt(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::ALT), key)
}

const fn look(key_: Key, side: Side) -> (KeyboardShortcut, Command) {
    (key(key_), Command::View(ViewAction::From(side)))
}

const fn look_back(key: Key, side: Side) -> (KeyboardShortcut, Command) {
    (ctrl(key), Command::View(ViewAction::From(side)))
}

const fn turn(key_: Key, toward: Toward) -> (KeyboardShortcut, Command) {
    (key(key_), Command::View(ViewAction::Turn(toward)))
}

const fn shift_view(key: Key, toward: Toward) -> (KeyboardShortcut, Command) {
    (ctrl(key), Command::View(ViewAction::Shift(toward)))
}

/// What digits mean with the hands of Blender, on the keypad and above the letters alike, before all else they mean: there
/// it is called to emulate the keypad.
const BLENDER: &[(KeyboardShortcut, Command)] = &[
    look(Key::Num1, Side::Front),
    look_back(Key::Num1, Side::Back),
    look(Key::Num3, Side::Right),
    look_back(Key::Num3, Side::Left),
    look(Key::Num7, Side::Top),
    look_back(Key::Num7, Side::Bottom),
    look(Key::Num0, Side::Isometric),
    (key(Key::Num5), Command::View(ViewAction::Orthographic)),
    turn(Key::Num4, Toward::Left),
    turn(Key::Num6, Toward::Right),
    turn(Key::Num8, Toward::Up),
    turn(Key::Num2, Toward::Down),
    shift_view(Key::Num4, Toward::Left),
    shift_view(Key::Num6, Toward::Right),
    shift_view(Key::Num8, Toward::Up),
    shift_view(Key::Num2, Toward::Down),
    (key(Key::Period), Command::Inspect(Inspect::Fly)),
    (key(Key::Period), Command::Fit),
];

/// The keys that mean something else with these hands than else, in the order in which they are tried.
#[must_use]
pub fn of_hands(preset: Preset) -> &'static [(KeyboardShortcut, Command)] {
    if preset == Preset::Blender { BLENDER } else { &[] }
}

impl ViewAction {
    pub(super) fn describe(&self) -> Description {
        let (label, tooltip, shortcuts): (_, _, &'static [KeyboardShortcut]) = match self {
            Self::From(Side::Front) => ("Front", "look from the front", const { &[alt(Key::Num1)] }),
            Self::From(Side::Back) => ("From behind", "look from behind", const { &[ctrl_alt(Key::Num1)] }),
            Self::From(Side::Right) => ("Right side", "look from the right", const { &[alt(Key::Num3)] }),
            Self::From(Side::Left) => ("Left side", "look from the left", const { &[ctrl_alt(Key::Num3)] }),
            Self::From(Side::Top) => ("Top", "look from above", const { &[alt(Key::Num7)] }),
            Self::From(Side::Bottom) => ("Bottom", "look from below", const { &[ctrl_alt(Key::Num7)] }),
            Self::From(Side::Isometric) => {
                ("Isometric", "look so that all axes are seen equally short", const { &[alt(Key::Num0)] })
            }
            Self::Orthographic => {
                ("Orthographic", "parallel lines stay parallel; off is perspective", const { &[alt(Key::Num5)] })
            }
            Self::Turn(Toward::Left) => {
                ("Go left", "go around the pivot to the left", const { &[shift(Key::ArrowLeft), alt(Key::Num4)] })
            }
            Self::Turn(Toward::Right) => {
                ("Go right", "go around the pivot to the right", const { &[shift(Key::ArrowRight), alt(Key::Num6)] })
            }
            Self::Turn(Toward::Up) => ("Go up", "go over the pivot", const { &[shift(Key::ArrowUp), alt(Key::Num8)] }),
            Self::Turn(Toward::Down) => {
                ("Go down", "go under the pivot", const { &[shift(Key::ArrowDown), alt(Key::Num2)] })
            }
            Self::Shift(Toward::Left) => {
                ("Shift left", "move what is seen to the left", const { &[ctrl(Key::ArrowLeft), ctrl_alt(Key::Num4)] })
            }
            Self::Shift(Toward::Right) => (
                "Shift right",
                "move what is seen to the right",
                const { &[ctrl(Key::ArrowRight), ctrl_alt(Key::Num6)] },
            ),
            Self::Shift(Toward::Up) => {
                ("Shift up", "move what is seen up", const { &[ctrl(Key::ArrowUp), ctrl_alt(Key::Num8)] })
            }
            Self::Shift(Toward::Down) => {
                ("Shift down", "move what is seen down", const { &[ctrl(Key::ArrowDown), ctrl_alt(Key::Num2)] })
            }
            Self::Nearer => ("Nearer", "zoom in", const { &[key(Key::Plus), key(Key::Equals)] }),
            Self::Farther => ("Farther", "zoom out", const { &[key(Key::Minus)] }),
            Self::Copy => ("Copy viewpoint", "copy the viewpoint as a line of text", const { &[ctrl_shift(Key::C)] }),
            Self::Paste => (
                "Paste viewpoint",
                "look from the viewpoint that was copied, here or elsewhere",
                const { &[ctrl_shift(Key::V)] },
            ),
            Self::SetPreset(Preset::Vv) => ("Hands of vv", "left drag turns, right drag shifts", &[]),
            Self::SetPreset(Preset::Blender) => (
                "Hands of Blender",
                "middle drag turns, with Shift it shifts, with Ctrl it zooms; digits are the keypad",
                &[],
            ),
            Self::SetPreset(Preset::Maya) => {
                ("Hands of Maya", "with Alt, left drag turns, middle drag shifts, right drag zooms", &[])
            }
            Self::SetTurning(Turning::Arcball) => ("Arcball", "what is under the pointer follows it", &[]),
            Self::SetTurning(Turning::Turntable) => ("Turntable", "turn around the up axis, which stays upright", &[]),
            Self::SetUp(Up::Y) => ("Y is up", "y points up: the front is seen from +z", &[]),
            Self::SetUp(Up::Z) => ("Z is up", "z points up: the front is seen from −y", &[]),
            Self::Gliding => ("Glide to viewpoints", "go to a new viewpoint in a fifth of a second, not at once", &[]),
            Self::RenderOptions => {
                ("Render options", "how things are drawn, in a window over the picture", const { &[key(Key::R)] })
            }
            Self::Glide(_) | Self::Show(_) | Self::Save(_) | Self::Use(_) | Self::Forget(_) => ("", "", &[]),
        };
        Description { label, tooltip, shortcuts }
    }

    pub(super) fn is_enabled(&self, session: &Session) -> bool {
        !matches!(self, Self::From(_) | Self::Copy | Self::Paste) || session.frame().is_some()
    }

    pub(super) fn is_on(&self, session: &Session) -> Option<bool> {
        let navigation = &session.navigation;
        Some(match self {
            Self::From(side) => session.aim().side(navigation.up) == Some(*side),
            Self::Orthographic => session.aim().orthographic,
            Self::SetPreset(preset) => navigation.preset == *preset,
            Self::SetTurning(turning) => navigation.turning == *turning,
            Self::SetUp(up) => navigation.up == *up,
            Self::Gliding => navigation.glide,
            Self::RenderOptions => session.render_options,
            _ => return None,
        })
    }
}
