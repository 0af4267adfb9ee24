//! What the modeler works on: a program, the mesh it is applied to, how often, and how it is looked at.
//!
//! A document is plain data, cheap to clone. It is changed by [`crate::command::Command`]s only.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use vv::mesh::Value;

use crate::annotate::Annotations;
use crate::camera::Camera;
use crate::scene::Style;
use crate::worker::Request;

/// The folder of texts that have no file.
pub const NOWHERE: &str = "<vv>";

/// Everything that a user would miss if it were gone.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// The program's text and where it is kept.
    pub program: ProgramText,
    /// Where generation 0 comes from.
    pub mesh: MeshSource,
    /// The rule that is stepped; `None`, or one that the program lacks, is the program's default.
    pub rule: Option<String>,
    /// Values of parameters that are not at their defaults, by name. Those of other programs are harmless.
    pub params: BTreeMap<String, Value>,
    /// Sets of such values that were given a name.
    pub param_sets: BTreeMap<String, BTreeMap<String, Value>>,
    /// Viewpoints that were given a name.
    pub views: BTreeMap<String, Camera>,
    /// Which generation is wanted.
    pub generation: u64,
    /// How it is drawn.
    pub style: Style,
    /// What is shown on it.
    pub annotations: Annotations,
    /// From where it is seen.
    pub camera: Camera,
}

/// A program's text and where it is kept.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProgramText {
    /// What it is called: a file name, or the name of a program that ships with vv.
    pub name: String,
    /// Its file; `None` until it is saved.
    pub path: Option<PathBuf>,
    /// The text as it stands in the editor.
    pub text: Arc<str>,
    /// The text as it was opened or saved last.
    pub saved: Arc<str>,
}

impl ProgramText {
    /// A text that has no file yet; unchanged it needs no saving.
    #[must_use]
    pub fn new(name: impl Into<String>, text: impl Into<Arc<str>>) -> Self {
        let text = text.into();
        Self { name: name.into(), path: None, saved: Arc::clone(&text), text }
    }

    /// The content of a file.
    #[must_use]
    pub fn of_file(path: &Path, text: impl Into<Arc<str>>) -> Self {
        Self { path: Some(path.to_owned()), ..Self::new(file_name(path), text) }
    }

    /// Whether closing would lose something.
    #[must_use]
    pub fn is_modified(&self) -> bool {
        self.text != self.saved
    }

    /// The path that diagnostics name and includes are relative to. A text without file stands among the programs that
    /// ship with vv, where it can include those.
    #[must_use]
    pub fn path_or_name(&self) -> PathBuf {
        self.path.clone().unwrap_or_else(|| Path::new(NOWHERE).join(&self.name))
    }
}

/// Where generation 0 comes from.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum MeshSource {
    /// From the program's `start` alone.
    Empty,
    /// From a file.
    File(PathBuf),
    /// One of the meshes that ship with vv, by name.
    BuiltIn(String),
    /// What another program has made: a generation of it.
    Result(#[serde(with = "crate::project::result")] Arc<Request>),
}

impl MeshSource {
    /// What it is called.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Empty => "no mesh".to_owned(),
            Self::File(path) => file_name(path),
            Self::BuiltIn(name) => name.clone(),
            Self::Result(request) => {
                let (program, n) = (file_name(&request.recipe.path), request.generation);
                match request.recipe.mesh {
                    Self::Empty => format!("{program} × {n}"),
                    ref mesh => format!("{}, {program} × {n}", mesh.name()),
                }
            }
        }
    }

    /// How many programs have worked on it before.
    #[must_use]
    pub fn depth(&self) -> usize {
        match self {
            Self::Result(request) => 1 + request.recipe.mesh.depth(),
            _ => 0,
        }
    }
}

/// The last part of a path, for people.
#[must_use]
pub fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
