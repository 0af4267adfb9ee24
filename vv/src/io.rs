//! Mesh files: bytes to [`Mesh`] and back.

mod lines;
mod obj;
mod off;

use std::io::Write;

use crate::diagnostic::{Diagnostic, Severity};
use crate::mesh::build::{self, BuildError};
use crate::mesh::faces::Faces;
use crate::mesh::{Mesh, Vertex};
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

impl From<Stopped> for ReadError {
    fn from(stopped: Stopped) -> Self {
        Self::Stopped(stopped)
    }
}

impl From<BuildError> for ReadError {
    fn from(error: BuildError) -> Self {
        match error {
            BuildError::Refused { line, diagnostic } => Self::Invalid { line, diagnostic },
            BuildError::Stopped(stopped) => Self::Stopped(stopped),
        }
    }
}

/// Text that is not of its format.
fn invalid(line: Option<u32>, message: impl Into<String>) -> ReadError {
    ReadError::Invalid { line, diagnostic: Box::new(Diagnostic::new(Severity::Error, None, message)) }
}

/// Reads a mesh: its vertices in the order of the file, all in its set; rings as [`build::build`] makes them. The
/// diagnostics say everything that was changed to make it a rotation system (warnings) or not read (notes); they have
/// no spans.
///
/// Numbers are doubles, correctly rounded. Cost: linear in the size of the text, whatever counts the text announces.
///
/// # Errors
/// Text that is not of the format; a surface that cannot be represented.
pub fn read(bytes: &[u8], format: Format, options: &ReadOptions) -> Result<(Mesh, Vec<Diagnostic>), ReadError> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(invalid(None, "the file is empty"));
    }
    let (polygons, mut diagnostics) = match format {
        Format::Obj => obj::read(bytes, &options.stop)?,
        Format::Off => off::read(bytes, &options.stop)?,
    };
    let no_faces = polygons.is_empty();
    let (mesh, repairs) = build::build(polygons, options.strict, &options.stop)?;
    diagnostics.extend(repairs);
    if no_faces {
        diagnostics.push(Diagnostic::new(Severity::Warning, None, "the file has no faces, so the mesh is empty"));
    }
    Ok((mesh, diagnostics))
}

/// Writes a mesh: the vertices of its set in order of creation, its faces as polygons. Numbers are the shortest
/// decimals that read back as the same doubles. What was written and read is written the same, byte for byte (but for
/// three or more fans of faces in one vertex, whose order polygons do not tell).
///
/// Polygons do not tell of edges without faces, nor of properties; a face of two corners, the edge that is a component
/// by itself, is left out.
#[must_use]
pub fn write(mesh: &Mesh, faces: &Faces, format: Format) -> Vec<u8> {
    match format {
        Format::Obj => obj::write(mesh, faces),
        Format::Off => off::write(mesh, faces),
    }
}

/// Numbers of the vertices of the set in order of creation, from 0, by the index of the vertex; and the vertices.
fn numbering(mesh: &Mesh) -> (Vec<usize>, Vec<Vertex>) {
    let mut members: Vec<Vertex> = mesh.set.iter().collect();
    members.sort_unstable();
    let mut numbers = vec![0; mesh.vertex_count()];
    for (i, v) in members.iter().enumerate() {
        if let Some(number) = numbers.get_mut(v.index()) {
            *number = i;
        }
    }
    (numbers, members)
}

/// The shortest decimal that reads back as `x`, with an exponent where there would be many zeros.
fn push_number(text: &mut Vec<u8>, x: f64) {
    let magnitude = x.abs();
    // Writing to a vector does not fail.
    let _ = if x == 0.0 || (1e-5..1e16).contains(&magnitude) || !x.is_finite() {
        write!(text, "{x}")
    } else {
        write!(text, "{x:e}")
    };
}
