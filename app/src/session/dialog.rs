//! The questions to the user.

use std::path::PathBuf;

use vv::io::Format;

use crate::command::Command;
use crate::{project, style_file};

/// What a file is chosen for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// To open a program.
    OpenProgram,
    /// To open a mesh.
    OpenMesh,
    /// To save the program.
    SaveProgram,
    /// To save the mesh.
    ExportMesh,
    /// To open a project.
    OpenProject,
    /// To save a project.
    SaveProject,
    /// To save what is seen.
    SavePicture,
    /// To save the mask of the selected vertex.
    SaveMask,
    /// To see things as a file says.
    OpenStyle,
    /// To save how things are seen.
    SaveStyle,
}

impl Purpose {
    /// Whether the file is written.
    #[must_use]
    pub fn saves(self) -> bool {
        !matches!(self, Self::OpenProgram | Self::OpenMesh | Self::OpenProject | Self::OpenStyle)
    }

    /// How the names of such files end.
    #[must_use]
    pub fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::OpenProgram | Self::SaveProgram => &["vv"],
            Self::OpenMesh | Self::ExportMesh => &Format::EXTENSIONS,
            Self::OpenProject | Self::SaveProject => &[project::EXTENSION],
            Self::SavePicture => &["png", "svg", "eps", "pdf"],
            Self::SaveMask => &["svg", "eps", "pdf"],
            Self::OpenStyle | Self::SaveStyle => &[style_file::EXTENSION],
        }
    }

    /// The path of a file that is saved, whose name may have been typed without an ending.
    #[must_use]
    pub fn with_extension(self, path: PathBuf) -> PathBuf {
        match self.extensions().first() {
            Some(extension) if self.saves() && path.extension().is_none() => path.with_extension(extension),
            _ => path,
        }
    }

    /// What such files are called.
    #[must_use]
    pub fn files(self) -> &'static str {
        match self {
            Self::OpenProgram | Self::SaveProgram => "vv programs",
            Self::OpenMesh | Self::ExportMesh => "meshes",
            Self::OpenProject | Self::SaveProject => "vv projects",
            Self::SavePicture => "pictures and figures",
            Self::SaveMask => "figures",
            Self::OpenStyle | Self::SaveStyle => "styles",
        }
    }
}

/// Why a path that was chosen is asked for again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PathTrouble {
    /// What is there would be replaced.
    Exists,
    /// It did not work.
    Failed(String),
}

/// A question to the user.
#[derive(Debug, Clone, PartialEq)]
pub enum Dialog {
    /// Save the program before `then`, which would lose its text?
    Unsaved {
        /// What comes after.
        then: Box<Command>,
    },
    /// Where no file dialog opens: the path, please.
    TypePath {
        /// What for.
        purpose: Purpose,
        /// As typed so far.
        path: String,
        /// What comes after.
        then: Option<Box<Command>>,
        /// What is to be said of a path that was chosen, as long as it is the one that is typed.
        trouble: Option<(String, PathTrouble)>,
    },
    /// A window crashed; bring back what was unsaved in it?
    Recover {
        /// What the program is called.
        name: String,
    },
    /// Which command?
    Palette {
        /// As typed so far.
        query: String,
        /// Which of those that fit.
        selected: usize,
    },
    /// Which vertices?
    SelectVertex {
        /// As typed so far.
        text: String,
    },
    /// Which program?
    Gallery {
        /// As typed so far.
        query: String,
        /// Which of [`crate::gallery::EXHIBITS`].
        selected: usize,
        /// Whether the mesh that is open stays.
        keep_mesh: bool,
    },
    /// How shall vv be?
    Preferences,
    /// How shall the picture be?
    Picture,
    /// All keys.
    CheatSheet {
        /// As typed so far.
        query: String,
    },
}

impl Dialog {
    /// Asks for a path.
    #[must_use]
    pub fn path(purpose: Purpose, path: impl Into<String>, then: Option<Box<Command>>) -> Self {
        Self::TypePath { purpose, path: path.into(), then, trouble: None }
    }

    /// The gallery, as it opens.
    #[must_use]
    pub fn gallery() -> Self {
        Self::Gallery { query: String::new(), selected: 0, keep_mesh: true }
    }
}
