//! What hands do to the view: one table that the viewport, the cheat sheet and the preferences read.

use eframe::egui::{Modifiers, PointerButton};
use serde::{Deserialize, Serialize};

use crate::camera::Up;

/// How the view is moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Navigation {
    /// Which buttons do what.
    pub preset: Preset,
    /// How dragging turns.
    pub turning: Turning,
    /// Which axis points up.
    pub up: Up,
    /// Whether the view glides to a new place instead of jumping there.
    pub glide: bool,
}

impl Default for Navigation {
    fn default() -> Self {
        Self { preset: Preset::Vv, turning: Turning::Arcball, up: Up::Y, glide: true }
    }
}

/// Habits from other programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Preset {
    /// Left turns, right shifts.
    #[default]
    Vv,
    /// The middle button turns; with Shift it shifts, with Ctrl it zooms.
    Blender,
    /// With Alt, left turns, middle shifts and right zooms.
    Maya,
}

/// How dragging turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Turning {
    /// What is under the pointer follows it in any direction.
    #[default]
    Arcball,
    /// Around the up axis, which stays upright.
    Turntable,
}

/// What a drag does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hand {
    /// Turns.
    Turn,
    /// Shifts.
    Pan,
    /// Comes nearer as the pointer goes up or to the right.
    Zoom,
}

/// A button that is held, and what dragging then does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grip {
    /// The button.
    pub button: PointerButton,
    /// The keys held with it, exactly.
    pub modifiers: Modifiers,
    /// What dragging does.
    pub hand: Hand,
}

const fn grip(button: PointerButton, modifiers: Modifiers, hand: Hand) -> Grip {
    Grip { button, modifiers, hand }
}

impl Preset {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Vv, Self::Blender, Self::Maya];

    /// What drags do.
    #[must_use]
    pub fn grips(self) -> &'static [Grip] {
        use PointerButton::{Middle, Primary, Secondary};
        match self {
            Self::Vv => {
                const {
                    &[
                        grip(Primary, Modifiers::NONE, Hand::Turn),
                        grip(Secondary, Modifiers::NONE, Hand::Pan),
                        grip(Middle, Modifiers::NONE, Hand::Pan),
                        grip(Primary, Modifiers::SHIFT, Hand::Pan),
                    ]
                }
            }
            Self::Blender => {
                const {
                    &[
                        grip(Middle, Modifiers::NONE, Hand::Turn),
                        grip(Middle, Modifiers::SHIFT, Hand::Pan),
                        grip(Middle, Modifiers::CTRL, Hand::Zoom),
                        grip(Primary, Modifiers::ALT, Hand::Turn), // as Blender, where a mouse has no third button
                    ]
                }
            }
            Self::Maya => {
                const {
                    &[
                        grip(Primary, Modifiers::ALT, Hand::Turn),
                        grip(Middle, Modifiers::ALT, Hand::Pan),
                        grip(Secondary, Modifiers::ALT, Hand::Zoom),
                    ]
                }
            }
        }
    }

    /// What a drag with these buttons and keys does.
    #[must_use]
    pub fn hand(self, button: PointerButton, modifiers: Modifiers) -> Option<Hand> {
        let held = |m: Modifiers| (m.shift, m.alt, m.ctrl || m.command);
        let same = |grip: &&Grip| grip.button == button && held(grip.modifiers) == held(modifiers);
        self.grips().iter().find(same).map(|grip| grip.hand)
    }

    /// What the hands do, in words: how, and what comes of it.
    #[must_use]
    pub fn explained(self) -> Vec<(String, &'static str)> {
        let mut rows: Vec<(String, &'static str)> = Vec::new();
        for hand in [Hand::Turn, Hand::Pan, Hand::Zoom] {
            let grips: Vec<String> =
                self.grips().iter().filter(|grip| grip.hand == hand).map(|grip| grip.in_words()).collect();
            if !grips.is_empty() {
                rows.push((grips.join(", "), hand.in_words()));
            }
        }
        rows.extend(EVERYWHERE.iter().map(|&(how, what)| (how.to_owned(), what)));
        rows
    }
}

/// What the hands do in every preset.
const EVERYWHERE: &[(&str, &str)] = &[
    ("wheel, pinch", "zoom to the pointer"),
    ("two fingers", "turn; with Shift shift, with Ctrl zoom"),
    ("double click", "turn around this point"),
    ("right click", "open a menu"),
];

impl Hand {
    fn in_words(self) -> &'static str {
        match self {
            Self::Turn => "turn",
            Self::Pan => "shift",
            Self::Zoom => "zoom",
        }
    }
}

impl Grip {
    fn in_words(self) -> String {
        let button = match self.button {
            PointerButton::Primary => "left drag",
            PointerButton::Secondary => "right drag",
            _ => "middle drag",
        };
        let m = self.modifiers;
        let keys = [(m.ctrl, "Ctrl + "), (m.shift, "Shift + "), (m.alt, "Alt + ")];
        let keys: String = keys.into_iter().filter(|(held, _)| *held).map(|(_, name)| name).collect();
        format!("{keys}{button}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use PointerButton::{Middle, Primary, Secondary};

    #[track_caller]
    fn check(preset: Preset, button: PointerButton, modifiers: Modifiers, hand: Option<Hand>) {
        assert_eq!(preset.hand(button, modifiers), hand);
    }

    #[test]
    fn each_preset_has_the_habits_of_its_program() {
        check(Preset::Vv, Primary, Modifiers::NONE, Some(Hand::Turn));
        check(Preset::Vv, Primary, Modifiers::SHIFT, Some(Hand::Pan));
        check(Preset::Vv, Middle, Modifiers::NONE, Some(Hand::Pan));
        check(Preset::Vv, Primary, Modifiers::ALT, None);
        check(Preset::Blender, Middle, Modifiers::NONE, Some(Hand::Turn));
        check(Preset::Blender, Middle, Modifiers::SHIFT, Some(Hand::Pan));
        check(Preset::Blender, Middle, Modifiers::COMMAND | Modifiers::CTRL, Some(Hand::Zoom));
        check(Preset::Blender, Primary, Modifiers::NONE, None);
        check(Preset::Maya, Primary, Modifiers::ALT, Some(Hand::Turn));
        check(Preset::Maya, Middle, Modifiers::ALT, Some(Hand::Pan));
        check(Preset::Maya, Secondary, Modifiers::ALT, Some(Hand::Zoom));
        check(Preset::Maya, Primary, Modifiers::NONE, None);
    }

    #[test]
    fn no_grip_means_two_things() {
        for preset in Preset::ALL {
            for (i, a) in preset.grips().iter().enumerate() {
                assert_eq!(preset.hand(a.button, a.modifiers), Some(a.hand), "{preset:?} {i}");
            }
        }
    }

    #[test]
    fn hands_are_explained_in_words() {
        let rows = Preset::Blender.explained();
        assert_eq!(rows[0], ("middle drag, Alt + left drag".to_owned(), "turn"));
        assert_eq!(rows[1], ("Shift + middle drag".to_owned(), "shift"));
        assert_eq!(rows[2], ("Ctrl + middle drag".to_owned(), "zoom"));
        assert!(Preset::Vv.explained().iter().any(|(how, _)| how == "right drag, middle drag, Shift + left drag"));
    }
}
