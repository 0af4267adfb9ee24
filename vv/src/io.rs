//! Mesh files: bytes to [`Mesh`] and back.
//!
//! | format | positions | colours | other values | polygons |
//! |---|---|---|---|---|
//! | OBJ | exact | `v x y z r g b` | `sharpness` of edges and vertices, as OpenSubdiv's `t crease`, `t corner` | any, wires as `l` |
//! | OFF | exact | bytes (COFF) | | any |
//! | PLY | exact | bytes | all of vertices, edges and the whole | any |
//! | STL | 32 bits | | | triangles |
//! | glTF | 32 bits | 32 bits | of vertices, 32 bits | triangles |
//!
//! What a file says of vertices, edges and the whole beside positions and faces is kept with the mesh as properties
//! ([`crate::mesh::Mesh::vertex_properties`]); a program that declares a property of the name finds the values, and what
//! it leaves there is written. [`COLOR`] is a vector of red, green and blue from 0 to 1, as on a screen (sRGB).

mod color;
mod gltf;
mod lines;
mod losses;
mod obj;
mod off;
mod ply;
mod stl;
mod weld;

use std::collections::BTreeSet;
use std::fmt;
use std::io::Write;

use rayon::prelude::*;

use crate::diagnostic::{Diagnostic, Severity};
use crate::mesh::build::{self, BuildError};
use crate::mesh::faces::Faces;
use crate::mesh::triangulate::{Triangulator, newell};
use crate::mesh::{Mesh, Property, Vertex};
use crate::stop::{Stop, Stopped};

pub use color::COLOR;
pub use obj::SHARPNESS;

/// How a mesh is kept in a file. Formats that differ only in what is written are read alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// Object File Format.
    Off,
    /// Stanford's polygon format, binary, little-endian.
    Ply,
    /// The same as text.
    PlyText,
    /// The same big-endian.
    PlyBigEndian,
    /// Stereolithography, binary.
    Stl,
    /// The same as text.
    StlText,
    /// glTF in one binary file.
    Glb,
    /// glTF as text, its data embedded.
    Gltf,
}

impl Format {
    /// All formats; of those that share an extension the one that it names first.
    pub const ALL: [Self; 9] = [
        Self::Obj,
        Self::Off,
        Self::Ply,
        Self::PlyText,
        Self::PlyBigEndian,
        Self::Stl,
        Self::StlText,
        Self::Glb,
        Self::Gltf,
    ];

    /// The extensions of mesh files, each once.
    pub const EXTENSIONS: [&'static str; 6] = ["obj", "off", "ply", "stl", "glb", "gltf"];

    /// The format of a file name's extension (without dot, any case).
    #[must_use]
    pub fn from_extension(extension: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|f| f.extension().eq_ignore_ascii_case(extension))
    }

    /// The format of a name as [`Format::name`] gives it.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|f| f.name() == name)
    }

    /// What file names end in: `obj`, `off`, `ply`, ….
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Off => "off",
            Self::Ply | Self::PlyText | Self::PlyBigEndian => "ply",
            Self::Stl | Self::StlText => "stl",
            Self::Glb => "glb",
            Self::Gltf => "gltf",
        }
    }

    /// The extension, with what distinguishes it from others of the same: `ply`, `ply-text`, ….
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::PlyText => "ply-text",
            Self::PlyBigEndian => "ply-big-endian",
            Self::StlText => "stl-text",
            _ => self.extension(),
        }
    }

    /// Whether it is read as text. Files of the others may be text as well.
    #[must_use]
    pub fn is_text(self) -> bool {
        matches!(self, Self::Obj | Self::Off | Self::Gltf)
    }

    /// The format that a file's bytes say they are in, if they do: all formats but OBJ begin in a way of their own.
    #[must_use]
    pub fn of_bytes(bytes: &[u8]) -> Option<Self> {
        if ply::is_ply(bytes) {
            return Some(Self::Ply);
        }
        if gltf::is_glb(bytes) {
            return Some(Self::Glb);
        }
        if stl::is_binary(bytes) {
            return Some(Self::Stl);
        }
        let mut lines = lines::Lines::new(bytes, lines::COMMENT).map(|(_, line)| line);
        let word = lines.find_map(|line| lines::words(line).next())?;
        match word {
            _ if word.to_ascii_uppercase().ends_with(b"OFF") => Some(Self::Off),
            _ if word.eq_ignore_ascii_case(b"solid") || word.eq_ignore_ascii_case(b"facet") => Some(Self::Stl),
            [b'{', ..] => Some(Self::Gltf),
            _ => None,
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

/// A place in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// In a text, from 1; without column the whole line. Columns count characters.
    Text {
        /// From 1; CR, LF and CR LF end lines.
        line: u32,
        /// Column at which the word begins that is meant.
        column: Option<u32>,
    },
    /// In binary data: bytes before it.
    Byte(u64),
}

impl Place {
    fn line(line: u32) -> Self {
        Self::Text { line, column: None }
    }

    fn byte(offset: usize) -> Self {
        Self::Byte(offset as u64)
    }
}

/// `3`, `3:7`, `byte 84`.
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text { line, column: None } => write!(f, "{line}"),
            Self::Text { line, column: Some(column) } => write!(f, "{line}:{column}"),
            Self::Byte(offset) => write!(f, "byte {offset}"),
        }
    }
}

/// Why a mesh could not be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ReadError {
    /// The file is not of its format, or the surface is none that a rotation system can hold.
    #[error("{}", diagnostic.message)]
    Invalid {
        /// Where in the file, where that is known.
        place: Option<Place>,
        /// What is wrong, why and what to do; no span.
        diagnostic: Box<Diagnostic>,
    },
    /// Stopped from outside.
    #[error("{0}")]
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
            BuildError::Refused { line, diagnostic } => Self::Invalid { place: line.map(Place::line), diagnostic },
            BuildError::Stopped(stopped) => Self::Stopped(stopped),
        }
    }
}

/// More than a format can hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the mesh is too large: a .{0} file holds at most 4 GiB")]
pub struct TooLarge(&'static str);

/// Bytes that are not of their format.
fn invalid(place: impl Into<Option<Place>>, message: impl Into<String>) -> ReadError {
    let diagnostic = Box::new(Diagnostic::new(Severity::Error, None, message));
    ReadError::Invalid { place: place.into(), diagnostic }
}

/// What was passed over or done without changing the surface.
fn note(message: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Severity::Note, None, message)
}

/// What was lost.
fn warning(message: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Severity::Warning, None, message)
}

/// Reads a mesh: its vertices in the order of the file, all in its set; rings as [`build::build`] makes them. The
/// diagnostics say everything that was changed to make it a rotation system (warnings), and what was not read or was
/// joined (notes); they have no spans.
///
/// Numbers in texts are doubles, correctly rounded. STL and glTF do not say which triangles share a vertex: there
/// corners at exactly the same position are one. Cost: linear in the size of the file, whatever counts it announces;
/// with joining O(n log n).
///
/// # Errors
/// Bytes that are not of the format; a surface that cannot be represented.
pub fn read(bytes: &[u8], format: Format, options: &ReadOptions) -> Result<(Mesh, Vec<Diagnostic>), ReadError> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(invalid(None, "the file is empty"));
    }
    let (polygons, mut diagnostics) = match format {
        Format::Obj => obj::read(bytes, &options.stop)?,
        Format::Off => off::read(bytes, &options.stop)?,
        Format::Ply | Format::PlyText | Format::PlyBigEndian => ply::read(bytes, &options.stop)?,
        Format::Stl | Format::StlText => stl::read(bytes, &options.stop)?,
        Format::Glb | Format::Gltf => gltf::read(bytes, &options.stop)?,
    };
    let no_faces = polygons.is_empty();
    let (mesh, repairs) = build::build(polygons, options.strict, &options.stop)?;
    diagnostics.extend(repairs);
    if no_faces && mesh.set.is_empty() {
        diagnostics.push(warning("the file has no faces, so the mesh is empty"));
    }
    Ok((mesh, diagnostics))
}

/// Writes a mesh: the vertices of its set in order of creation, its faces as polygons, and of its properties what the
/// format can hold (see the module); properties that hold vertices are never written, nor is in PLY the second of two
/// that would have columns of one name, as the vector `v` and the number `v_x`. Numbers in texts are the shortest
/// decimals that read back as the same doubles. What was written and read is written the same, byte for byte, but for
/// three or more fans of faces in one vertex, whose order polygons do not tell, for polygons that were cut into
/// triangles, and for STL, which does not keep the order of vertices.
///
/// Wires, edges with a hole on either side, are written to OBJ alone. A face of two corners, the edge that is a component
/// by itself, is left out.
///
/// The diagnostics are warnings of the properties and wires that are left out, one for each kind; they have no spans. A
/// property that has nothing but its default is none of them.
///
/// # Errors
/// If the format cannot hold so much.
pub fn write(mesh: &Mesh, faces: &Faces, format: Format) -> Result<(Vec<u8>, Vec<Diagnostic>), TooLarge> {
    let bytes = match format {
        Format::Obj => obj::write(mesh, faces),
        Format::Off => off::write(mesh, faces),
        Format::Ply => ply::write(mesh, faces, ply::Encoding::LittleEndian),
        Format::PlyText => ply::write(mesh, faces, ply::Encoding::Text),
        Format::PlyBigEndian => ply::write(mesh, faces, ply::Encoding::BigEndian),
        Format::Stl => stl::write(mesh, faces).ok_or(TooLarge("stl"))?,
        Format::StlText => stl::write_text(mesh, faces),
        Format::Glb => gltf::write_glb(mesh, faces).ok_or(TooLarge("glb"))?,
        Format::Gltf => gltf::write_text(mesh, faces),
    };
    Ok((bytes, losses::losses(mesh, format)))
}

/// Faces that are polygons: with three corners and more.
fn polygons(faces: &Faces) -> impl Iterator<Item = &[Vertex]> {
    faces.iter().filter(|face| is_polygon(face))
}

fn is_polygon(face: &[Vertex]) -> bool {
    face.len() > 2
}

/// The faces cut into triangles.
fn for_each_triangle(mesh: &Mesh, faces: &Faces, mut each: impl FnMut([Vertex; 3])) {
    let mut triangulator = Triangulator::default();
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for face in polygons(faces) {
        points.clear();
        points.extend(face.iter().map(|&v| mesh.position(v)));
        triangulator.triangles(&points, newell(&points), &mut triangles);
        triangles.iter().for_each(|t| each(t.map(|i| face[i as usize])));
    }
}

/// Leaves of properties with one name the first, with a warning: a file may have `v` and `v_x`, `v_y`, `v_z`, which are
/// `v` as well.
fn first_of_each(properties: &mut Vec<Property>, of: &str) -> Vec<Diagnostic> {
    let mut known = BTreeSet::new();
    let mut warnings = Vec::new();
    properties.retain(|property| {
        let is_first = known.insert(property.name.clone());
        if !is_first {
            warnings.push(warning(format!("{of} has two properties `{}`; only the first is read", property.name)));
        }
        is_first
    });
    warnings
}

/// Whether a name can stand after `$` in a program; others are not kept.
fn is_name(name: &[u8]) -> bool {
    name.first().is_some_and(|b| b.is_ascii_alphabetic() || *b == b'_')
        && name.iter().all(|b| b.is_ascii_alphanumeric() || *b == b'_')
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

/// Appends the lines of `count` things to a text, made piece by piece on all threads: `push` appends that of a thing.
fn push_lines(text: &mut Vec<u8>, count: usize, push: impl Fn(&mut Vec<u8>, usize) + Sync) {
    const PIECE: usize = 1 << 14;
    let lines = |piece: usize| {
        let mut lines = Vec::new();
        (piece * PIECE..count.min((piece + 1) * PIECE)).for_each(|i| push(&mut lines, i));
        lines
    };
    let pieces: Vec<Vec<u8>> = (0..count.div_ceil(PIECE)).into_par_iter().map(lines).collect();
    text.reserve_exact(pieces.iter().map(Vec::len).sum());
    pieces.into_iter().for_each(|piece| text.extend(piece));
}

/// Appends the decimal digits of a number.
fn push_integer(text: &mut Vec<u8>, mut n: usize) {
    let mut digits = [b'0'; 20];
    let mut start = digits.len();
    loop {
        start -= 1;
        digits[start] = b'0' + (n % 10) as u8;
        n /= 10;
        if n == 0 {
            return text.extend_from_slice(&digits[start..]);
        }
    }
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
