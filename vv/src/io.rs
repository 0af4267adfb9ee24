//! Mesh files: bytes to [`Mesh`] and back.

use crate::diagnostic::Diagnostic;
use crate::mesh::Mesh;
use crate::mesh::faces::Faces;
use crate::stop::{Stop, Stopped};

/// A file format that meshes are kept in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// Object File Format.
    Off,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 2] = [Self::Obj, Self::Off];

    /// The format of a file name's extension (without dot, any case).
    #[must_use]
    pub fn from_extension(extension: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|f| f.extension().eq_ignore_ascii_case(extension))
    }

    /// `obj`, `off`.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Off => "off",
        }
    }
}

/// How to treat input that is no rotation system.
#[derive(Debug, Clone, Default)]
pub struct ReadOptions {
    /// Refuse what would have to be repaired.
    pub strict: bool,
    /// Polled while reading.
    pub stop: Stop,
}

/// Why a mesh could not be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ReadError {
    /// The text is not of its format, or the surface is none that a rotation system can hold.
    Invalid {
        /// Line of the file, from 1, where there is one.
        line: Option<u32>,
        /// What is wrong, why and what to do; no span.
        diagnostic: Box<Diagnostic>,
    },
    /// Stopped from outside.
    Stopped(Stopped),
}

/// Reads a mesh. The warnings say everything that was changed to make it a rotation system; they have no spans.
///
/// # Errors
/// Text that is not of the format; a surface that cannot be represented.
pub fn read(_bytes: &[u8], _format: Format, _options: &ReadOptions) -> Result<(Mesh, Vec<Diagnostic>), ReadError> {
    Ok((Mesh::new(), Vec::new()))
}

/// Writes a mesh: its vertices in order of creation, its faces as polygons. Numbers are the shortest decimals that
/// read back as the same doubles.
#[must_use]
pub fn write(_mesh: &Mesh, _faces: &Faces, _format: Format) -> Vec<u8> {
    Vec::new()
}
