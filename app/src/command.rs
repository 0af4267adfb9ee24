//! Everything a user can ask for: what it is called, which keys mean it, when it makes sense.
//!
//! Menus, palette, buttons, keys, panels and tests make commands; [`crate::session::Session::apply`] is the one place that
//! carries them out. A new command is a variant here, a line in [`Command::describe`], a place in [`MENUS`], and its
//! effect there.

mod also;
mod choosing;
mod inspecting;
mod matching;
mod menus;
mod pair;
mod schemes;
mod view;

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui::{Key, KeyboardShortcut, Modifiers};
use vv::diagnostic::Hint;
use vv::mesh::Value;

use crate::annotate::{Annotations, Arrows, Label, Quantity};
use crate::camera::Camera;
use crate::document::MeshSource;
use crate::preferences::Preferences;
use crate::scene::{Style, Surface};
use crate::session::{Purpose, Session};

pub use inspecting::Inspect;
pub use matching::{Match, find, find_also};
pub use menus::{MENUS, Menu, outer, with_keys};
pub use pair::PairAction;
pub use view::{Toward, ViewAction, of_hands};

/// A wish.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// An empty program.
    NewProgram,
    /// Choose a file.
    Choose(Purpose),
    /// A program or a mesh, by its extension.
    Open(PathBuf),
    /// A program that ships with vv.
    OpenExample(&'static str),
    /// The same as the gallery shows it: on a mesh that suits it, unless the one that is open is to be kept.
    Exhibit {
        /// Which program.
        program: &'static str,
        /// Whether the mesh stays.
        keep_mesh: bool,
    },
    /// A mesh that ships with vv, or none.
    UseMesh(MeshSource),
    /// The program into its file.
    Save,
    /// The program into a file.
    SaveTo(PathBuf),
    /// The mesh shown into a file.
    ExportTo(PathBuf),
    /// What is seen into a PNG file.
    PictureTo(PathBuf),
    /// Takes what another program wrote into the program's file.
    TakeFromDisk,
    /// Goes on with the text in the editor.
    KeepMine,
    /// Takes what a crash has left behind, or throws it away.
    AnswerRecovery(bool),
    /// Forgets which files were open.
    ForgetRecent,
    /// Answers the question whether to save before something that would lose text.
    AnswerUnsaved(Answer),
    /// Puts a dialog away.
    CloseDialog,
    /// Ends the program.
    Quit,

    /// What was changed last is as it was before: text, mesh, rule, parameters, generation.
    Undo,
    /// What was undone last is again.
    Redo,
    /// The text is as it was before.
    UndoText,
    /// What was undone last of the text is again.
    RedoText,
    /// The program's text is now this.
    Edit(Arc<str>),
    /// The same while a number is dragged: it is run at once.
    Tune(Arc<str>),
    /// Something to do in the editor.
    Text(TextAction),
    /// Carries out what a diagnostic proposes.
    Fix(Hint),
    /// Shows a place of the program in the editor.
    Reveal(std::ops::Range<usize>),
    /// Reads the files and computes everything anew.
    Run,

    /// One generation on.
    Step,
    /// One generation back.
    Back,
    /// To generation 0.
    Rewind,
    /// To the last generation that was reached.
    End,
    /// To any generation.
    GoTo(u64),
    /// To any generation, and when it is shown, this.
    With(u64, Box<Command>),
    /// To any generation, as one of many on the way.
    Scrub(u64),
    /// Steps again and again; and ends that.
    Play,
    /// Ends what is being computed.
    Stop,

    /// The rule that is stepped.
    ChooseRule(String),
    /// The value of a parameter.
    SetParam(String, Value),
    /// A parameter at the program's own value.
    ResetParam(String),
    /// All parameters at the program's own values.
    ResetParams,
    /// Keeps the parameters as they are, under a name.
    SaveParams(String),
    /// The parameters as they were kept under a name.
    UseParams(String),
    /// Forgets what was kept under a name.
    ForgetParams(String),

    /// To look closer.
    Inspect(Inspect),

    /// How it is drawn.
    SetStyle(Style),
    /// Filled faces on and off.
    Faces,
    /// Edges on and off.
    Edges,
    /// Vertices on and off.
    Vertices,
    /// Smooth shading on and off.
    Smooth,
    /// Control mesh on and off.
    Control,
    /// What is shown on it.
    SetAnnotations(Annotations),
    /// Colours it, with the range found by itself.
    ColorBy(Quantity),
    /// What is written at vertices or in faces.
    LabelBy(Label),
    /// What is drawn as arrows.
    ArrowsOf(Arrows),
    /// How the surface shows its quality.
    ShowBy(Surface),
    /// The cut on and off.
    Cut,
    /// The grid on and off.
    Grid,
    /// Ambient occlusion on and off.
    Occlusion,
    /// The axes on and off.
    Axes,
    /// From where it is seen.
    SetCamera(Camera),
    /// Something to do with the camera.
    View(ViewAction),
    /// Steps a scheme that ships with vv once on the mesh shown.
    Subdivide(&'static str),
    /// Something to do with two documents side by side.
    Pair(PairAction),
    /// All of the mesh in sight.
    Fit,
    /// The picture to the clipboard.
    CopyImage,
    /// Light, dark, or what the system says.
    SetTheme(ThemeChoice),
    /// A panel on and off.
    Toggle(Panel),
    /// The window without its frame, as large as the screen; and back.
    FullScreen,

    /// When a changed text is run.
    SetReload(Reload),
    /// How many generations follow each other in a second, at most.
    SetSpeed(f64),

    /// All programs that ship with vv, with pictures.
    Gallery,
    /// What is as the user likes it.
    Preferences,
    /// That.
    SetPreferences(Preferences),
    /// What is seen into a file: asks for its size first.
    SavePicture,
    /// All commands, to be found by typing.
    Palette,
    /// All keys.
    CheatSheet,
    /// The manual of the language, or no more.
    Reference,
}

/// What to do with text that is not saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// Save it, then go on.
    Save,
    /// Go on and lose it.
    Discard,
}

/// Something to do in the editor, at its cursor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextAction {
    /// The keys go to the picture, or back to the text.
    Keys,
    /// Opens the field to find text.
    Find,
    /// Opens the fields to find and replace text.
    Replace,
    /// To the next place that was found.
    FindNext,
    /// To the one before.
    FindPrevious,
    /// Makes comments of the lines, or code again.
    ToggleComment,
    /// Lays the text out.
    Format,
    /// Shows what can stand at the cursor.
    Complete,
    /// To where the name at the cursor is declared.
    Declaration,
    /// To the next problem.
    NextProblem,
    /// To the one before.
    PreviousProblem,
    /// The number at the cursor up by its last digit.
    RaiseNumber,
    /// The number at the cursor down by its last digit.
    LowerNumber,
}

/// When a changed text is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum Reload {
    /// While it is typed, at each pause.
    #[default]
    Typed,
    /// When it is saved, here or by another program.
    Saved,
    /// When it is asked for.
    ByHand,
}

/// Light or dark.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum ThemeChoice {
    /// As the system.
    #[default]
    System,
    /// Light.
    Light,
    /// Dark.
    Dark,
}

/// The panels around the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Panel {
    /// Program text.
    Program,
    /// Problems and console.
    Messages,
    /// Parameters, display, statistics.
    Inspector,
    /// The generations in a row.
    Timeline,
}

/// How a command presents itself.
#[derive(Debug, Clone, Copy)]
pub struct Description {
    /// In menus and as accessible name.
    pub label: &'static str,
    /// One sentence.
    pub tooltip: &'static str,
    /// Keys that mean it, the first is shown.
    pub shortcuts: &'static [KeyboardShortcut],
}

const fn key(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

const fn ctrl(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

const fn alt(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::ALT, key)
}

const fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}

const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key)
}

impl Command {
    /// Name, tooltip and keys.
    #[must_use]
    pub fn describe(&self) -> Description {
        let (label, tooltip, shortcuts): (_, _, &'static [KeyboardShortcut]) = match self {
            Self::NewProgram => ("New program", "begin an empty program", const { &[ctrl(Key::N)] }),
            Self::Choose(purpose) => return choosing::describe(*purpose),
            Self::ForgetRecent => ("Forget recent files", "empty the list of files that were open", &[]),
            Self::Save => {
                ("Save", "save the program to its file, and the project if one is open", const { &[ctrl(Key::S)] })
            }
            Self::Quit => ("Quit", "close the window", const { &[ctrl(Key::Q)] }),
            Self::TakeFromDisk => ("Reload", "take the text on disk; the one in the editor is lost", &[]),
            Self::KeepMine => ("Keep mine", "go on with the text in the editor; saving replaces the file", &[]),
            Self::Run => {
                ("Run again", "read the files and compute everything anew", const { &[key(Key::F5), ctrl(Key::Enter)] })
            }
            Self::Undo => ("Undo", "take the last change back", const { &[ctrl(Key::Z)] }),
            Self::Redo => ("Redo", "do again what was undone", const { &[ctrl_shift(Key::Z), ctrl(Key::Y)] }),
            Self::Text(action) => return action.describe(),
            Self::View(action) => return action.describe(),
            Self::Pair(action) => return action.describe(),
            Self::Subdivide(program) => return schemes::describe(program),
            Self::Inspect(inspect) => return inspect.describe(),
            Self::SetReload(Reload::Typed) => ("Run as typed", "run a changed text at each pause in typing", &[]),
            Self::SetReload(Reload::Saved) => ("Run on save", "run a changed text when it is saved", &[]),
            Self::SetReload(Reload::ByHand) => ("Run by hand", "run a changed text only when asked to", &[]),
            Self::Step => ("Step", "apply the rule once", const { &[key(Key::S), key(Key::ArrowRight)] }),
            Self::Back => ("Back", "take the last step back", const { &[key(Key::ArrowLeft)] }),
            Self::End => ("Last generation", "go to the last generation that was reached", const { &[key(Key::End)] }),
            Self::Rewind => ("Rewind", "go back to generation 0", const { &[key(Key::Home)] }),
            Self::Play => ("Play", "step again and again, until stopped", const { &[key(Key::Space)] }),
            Self::Stop => ("Stop", "end what is being computed", const { &[key(Key::Escape)] }),
            Self::ResetParams => ("Reset parameters", "all parameters as the program says", &[]),
            Self::Faces => ("Faces", "fill the faces; off shows the wireframe", const { &[key(Key::W)] }),
            Self::Edges => ("Edges", "draw the edges", const { &[key(Key::E)] }),
            Self::Vertices => ("Vertices", "draw the vertices", const { &[key(Key::V)] }),
            Self::Smooth => ("Smooth", "shade as if the surface were smooth", const { &[key(Key::N)] }),
            Self::Control => ("Control mesh", "superimpose the mesh of generation 0", const { &[key(Key::C)] }),
            Self::Cut => ("Cut open", "cut away what lies on one side of a plane", const { &[key(Key::X)] }),
            Self::Grid => ("Grid", "draw a grid on the ground, with the axes", const { &[key(Key::G)] }),
            Self::Axes => ("Axes", "show the directions of the axes in a corner", const { &[key(Key::A)] }),
            Self::Occlusion => {
                ("Ambient occlusion", "darken hollows, where little of the sky is seen", const { &[key(Key::O)] })
            }
            Self::ShowBy(Surface::Lights) => ("Lights", "see the surface by its light alone", &[]),
            Self::ShowBy(Surface::ReflectionLines) => {
                ("Reflection lines", "see how even the surface is by the mirror images of long lamps", &[])
            }
            Self::ShowBy(Surface::Isophotes) => {
                ("Isophotes", "see how even the surface is by lines of equal light", &[])
            }
            Self::ColorBy(quantity) => return describe_color(quantity),
            Self::LabelBy(Label::Nothing) => ("No labels", "write nothing at vertices and faces", &[]),
            Self::LabelBy(Label::Vertices) => {
                ("Label vertices", "write at vertices what they are called", const { &[key(Key::I)] })
            }
            Self::LabelBy(Label::Degrees) => ("Label faces", "write in faces how many corners they have", &[]),
            Self::LabelBy(Label::Numbers) => {
                ("Label with numbers", "write the numbers that the colours stand for", &[])
            }
            Self::ArrowsOf(Arrows::Nothing) => ("No arrows", "draw no arrows", &[]),
            Self::ArrowsOf(Arrows::VertexNormals) => {
                ("Normals of vertices", "draw the normals at vertices as arrows", const { &[shift(Key::N)] })
            }
            Self::ArrowsOf(Arrows::FaceNormals) => ("Normals of faces", "draw the normals of faces as arrows", &[]),
            Self::Fit => ("Fit view", "bring all of the mesh in sight", const { &[key(Key::F)] }),
            // Ctrl+C arrives as a wish to copy, not as a key.
            Self::CopyImage => ("Copy image", "copy the picture to the clipboard", const { &[ctrl(Key::C)] }),
            Self::SetTheme(ThemeChoice::System) => ("System theme", "light or dark as the system is", &[]),
            Self::SetTheme(ThemeChoice::Light) => ("Light theme", "dark on light", &[]),
            Self::SetTheme(ThemeChoice::Dark) => ("Dark theme", "light on dark", &[]),
            Self::Toggle(Panel::Program) => ("Program panel", "show the program", const { &[ctrl(Key::Num1)] }),
            Self::Toggle(Panel::Messages) => {
                ("Messages panel", "show problems and console", const { &[ctrl(Key::Num2)] })
            }
            Self::Toggle(Panel::Inspector) => {
                ("Inspector panel", "show parameters, display and statistics", const { &[ctrl(Key::Num3)] })
            }
            Self::FullScreen => ("Full screen", "fill the screen; again to leave", const { &[key(Key::F11)] }),
            Self::Palette => {
                ("Command palette…", "find any command by typing", const { &[ctrl_shift(Key::P), ctrl(Key::K)] })
            }
            Self::CheatSheet => {
                ("Keys…", "all keys and what the mouse does", const { &[key(Key::H), key(Key::Questionmark)] })
            }
            Self::Toggle(Panel::Timeline) => {
                ("Time line", "show the generations in a row below the picture", const { &[ctrl(Key::Num4)] })
            }
            Self::Reference => {
                ("Language reference", "the manual of the language, beside the work", const { &[key(Key::F1)] })
            }
            Self::Gallery => {
                ("Gallery…", "all programs that ship with vv, with pictures", const { &[ctrl_shift(Key::G)] })
            }
            Self::Preferences => ("Preferences…", "set vv up as you like it", const { &[ctrl(Key::Comma)] }),
            Self::SavePicture => {
                ("Save picture as…", "write what is seen into a PNG file, in any size", const { &[key(Key::F12)] })
            }
            Self::SetPreferences(_)
            | Self::PictureTo(_)
            | Self::Exhibit { .. }
            | Self::Open(_)
            | Self::OpenExample(_)
            | Self::UseMesh(_)
            | Self::SaveTo(_)
            | Self::ExportTo(_)
            | Self::AnswerRecovery(_)
            | Self::AnswerUnsaved(_)
            | Self::CloseDialog
            | Self::UndoText
            | Self::RedoText
            | Self::Edit(_)
            | Self::Tune(_)
            | Self::Fix(_)
            | Self::Reveal(_)
            | Self::GoTo(_)
            | Self::With(..)
            | Self::Scrub(_)
            | Self::SetSpeed(_)
            | Self::ChooseRule(_)
            | Self::SetParam(..)
            | Self::ResetParam(_)
            | Self::SaveParams(_)
            | Self::UseParams(_)
            | Self::ForgetParams(_)
            | Self::SetStyle(_)
            | Self::SetAnnotations(_)
            | Self::LabelBy(Label::Property(_))
            | Self::ArrowsOf(Arrows::Property(_))
            | Self::SetCamera(_) => ("", "", &[]),
        };
        Description { label, tooltip, shortcuts }
    }

    /// Whether it makes sense now.
    #[must_use]
    pub fn is_enabled(&self, session: &Session) -> bool {
        match self {
            Self::Back | Self::Rewind => session.document.generation > 0,
            Self::End => session.document.generation < session.last_reached(),
            Self::Step | Self::Play => session.can_step(),
            Self::Stop => session.is_busy() || session.is_playing(),
            Self::Choose(purpose) => choosing::is_enabled(*purpose, session),
            Self::CopyImage | Self::SavePicture => session.frame().is_some(),
            Self::ForgetRecent => !session.recent().is_empty(),
            Self::View(action) => action.is_enabled(session),
            Self::Pair(action) => action.is_enabled(session),
            Self::Subdivide(_) => session.frame().is_some(),
            Self::Undo => session.can_undo(),
            Self::Redo => session.can_redo(),
            Self::Text(TextAction::NextProblem | TextAction::PreviousProblem) => session.has_problems_here(),
            Self::ResetParams => !session.document.params.is_empty(),
            Self::Inspect(inspect) => inspect.is_enabled(session),
            Self::TakeFromDisk | Self::KeepMine => session.text_on_disk().is_some(),
            _ => true,
        }
    }

    /// Whether it is a switch, and how it stands.
    #[must_use]
    pub fn is_on(&self, session: &Session) -> Option<bool> {
        let style = &session.document.style;
        Some(match self {
            Self::Faces => style.faces,
            Self::Edges => style.edges,
            Self::Vertices => style.vertices,
            Self::Smooth => style.smooth,
            Self::Control => style.control,
            Self::View(action) => return action.is_on(session),
            Self::Cut => style.cut.on,
            Self::Grid => style.grid,
            Self::Axes => style.axes,
            Self::Occlusion => style.occlusion,
            Self::ShowBy(surface) => style.surface == *surface,
            Self::ColorBy(quantity) => session.document.annotations.color_by == *quantity,
            Self::Pair(action) => return action.is_on(session),
            Self::LabelBy(label) => session.document.annotations.labels == *label,
            Self::ArrowsOf(arrows) => session.document.annotations.arrows == *arrows,
            Self::Play => session.is_playing(),
            Self::Toggle(panel) => session.panels.is_open(*panel),
            Self::SetTheme(theme) => session.theme == *theme,
            Self::SetReload(reload) => session.reload == *reload,
            Self::FullScreen => session.full_screen,
            Self::Reference => session.reference,
            Self::Inspect(inspect) => return inspect.is_on(session),
            _ => return None,
        })
    }
}

fn describe_color(quantity: &Quantity) -> Description {
    let (label, tooltip) = match quantity {
        Quantity::Plain => ("No colours", "one colour for the whole surface, or its own"),
        Quantity::Valence => ("Colour by valence", "show where vertices have more or fewer neighbours than usual"),
        Quantity::Degree => ("Colour by corners", "show which faces have more or fewer corners than most"),
        Quantity::Gauss => ("Colour by Gaussian curvature", "show where the surface is dome and where saddle"),
        Quantity::Mean => ("Colour by mean curvature", "show where the surface bulges out and where in"),
        Quantity::Birth => ("Colour by generation of birth", "show which generation made each vertex"),
        Quantity::Change => ("Colour by change", "show what was born and what moved in the last step"),
        Quantity::Coordinate(0) => ("Colour by x", "show the first coordinate"),
        Quantity::Coordinate(1) => ("Colour by y", "show the second coordinate, the height"),
        Quantity::Coordinate(_) => ("Colour by z", "show the third coordinate"),
        Quantity::Since(_) | Quantity::Property(_) | Quantity::Color(_) => ("", ""),
    };
    Description { label, tooltip, shortcuts: &[] }
}

impl TextAction {
    fn describe(self) -> Description {
        let (label, tooltip, shortcuts): (_, _, &'static [KeyboardShortcut]) = match self {
            Self::Keys => (
                "Text or picture",
                "type into the program, or give the keys to the picture, where letters are commands",
                const { &[key(Key::F6)] },
            ),
            Self::Find => ("Find…", "find text in the program", const { &[ctrl(Key::F)] }),
            Self::Replace => ("Replace…", "find and replace text in the program", const { &[ctrl(Key::H)] }),
            Self::FindNext => ("Find next", "go to the next place that was found", const { &[key(Key::F3)] }),
            Self::FindPrevious => {
                ("Find previous", "go to the place that was found before", const { &[shift(Key::F3)] })
            }
            Self::ToggleComment => {
                ("Toggle comment", "make comments of the lines, or code again", const { &[ctrl(Key::Slash)] })
            }
            Self::Format => (
                "Format program",
                "lay the program out: indentation and spaces",
                const { &[KeyboardShortcut::new(Modifiers::ALT.plus(Modifiers::SHIFT), Key::F)] },
            ),
            Self::Complete => ("Complete", "show what can stand at the cursor", const { &[ctrl(Key::Space)] }),
            Self::Declaration => {
                ("Go to declaration", "show where the name at the cursor is declared", const { &[key(Key::F4)] })
            }
            Self::NextProblem => ("Next problem", "go to the next error or warning", const { &[key(Key::F8)] }),
            Self::PreviousProblem => {
                ("Previous problem", "go to the error or warning before", const { &[shift(Key::F8)] })
            }
            Self::RaiseNumber => {
                ("Raise number", "the number at the cursor up by its last digit", const { &[alt(Key::ArrowUp)] })
            }
            Self::LowerNumber => {
                ("Lower number", "the number at the cursor down by its last digit", const { &[alt(Key::ArrowDown)] })
            }
        };
        Description { label, tooltip, shortcuts }
    }
}

/// Whether a key acts also while text is being typed.
#[must_use]
pub fn acts_while_typing(shortcut: &KeyboardShortcut) -> bool {
    let function =
        matches!(shortcut.logical_key, Key::F1 | Key::F3 | Key::F4 | Key::F5 | Key::F6 | Key::F8 | Key::F11 | Key::F12);
    // Ctrl with an arrow goes from word to word.
    let walks = matches!(shortcut.logical_key, Key::ArrowLeft | Key::ArrowRight | Key::ArrowUp | Key::ArrowDown);
    shortcut.modifiers.command && !walks || shortcut.modifiers.alt || function || shortcut.logical_key == Key::Escape
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_commands_share_a_key() {
        let mut keys = Vec::new();
        for command in with_keys() {
            let description = command.describe();
            assert!(!description.label.is_empty() && !description.tooltip.is_empty(), "{command:?}");
            for shortcut in description.shortcuts {
                assert!(!keys.contains(shortcut), "{shortcut:?} of {command:?} is taken");
                keys.push(*shortcut);
            }
        }
    }
}
