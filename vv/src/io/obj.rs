//! Wavefront OBJ, through tobj.
//!
//! Left to itself tobj numbers vertices by their first use in faces and drops unused ones, starts a mesh with vertices
//! of its own at each group, takes polylines for faces, fails at continued lines, at comments behind numbers and at
//! colours of some vertices, accepts NaN, and does not name lines. So it is handed a text of vertices and faces alone,
//! one statement to a line, that begins with a face of all vertices, which keeps them all and their order. The line it
//! read last is where a statement is wrong.

use std::borrow::Cow;
use std::io::{self, BufRead, Read, Write};

use glam::DVec3;

use super::lines::{Lines, number, show, words};
use super::{ReadError, invalid, numbering, push_number};
use crate::diagnostic::{Diagnostic, Severity};
use crate::mesh::Full;
use crate::mesh::Mesh;
use crate::mesh::build::Polygons;
use crate::mesh::faces::Faces;
use crate::stop::Stop;

/// Statements that say how things look or what they are called.
const ATTRIBUTES: [&[u8]; 19] = [
    b"vt",
    b"vn",
    b"o",
    b"g",
    b"s",
    b"mg",
    b"usemtl",
    b"mtllib",
    b"usemap",
    b"maplib",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"lod",
    b"shadow_obj",
    b"trace_obj",
    b"ctech",
    b"stech",
    b"call",
];

/// Statements of free-form curves and surfaces.
const FREE_FORM: [&[u8]; 16] = [
    b"vp", b"cstype", b"deg", b"bmat", b"step", b"curv", b"curv2", b"surf", b"parm", b"trim", b"hole", b"scrv", b"sp",
    b"end", b"con", b"merge",
];

pub(super) fn read(text: &[u8], stop: &Stop) -> Result<(Polygons, Vec<Diagnostic>), ReadError> {
    let vertex_count = Statements::new(text).filter(|(_, s)| keyword(s) == b"v").count();
    let mut feed = Feed::new(text, vertex_count, stop);
    // A closure that is never called: no `mtllib` gets through.
    let loaded = tobj::load_obj_buf(&mut feed, &tobj::LoadOptions::default(), |_| Err(tobj::LoadError::GenericFailure));
    stop.check()?;
    let models = match loaded {
        Ok((models, _)) => models,
        Err(error) => return Err(explain(text, feed.line, error)),
    };
    let Feed { lines, mut ignored, .. } = feed;
    if vertex_count == 0 && lines.is_empty() && ignored.unknown.0 > 0 {
        return Err(invalid(None, "this is no OBJ file: no line begins with `v` or `f`"));
    }
    let Some(mesh) = models.into_iter().next().map(|model| model.mesh) else {
        return Err(invalid(None, "the OBJ file holds no mesh"));
    };
    let positions: Vec<DVec3> = mesh.positions.chunks_exact(3).map(|p| DVec3::new(p[0], p[1], p[2])).collect();
    if let Some(index) = positions.iter().position(|p| !p.is_finite()) {
        return Err(not_finite(text, index));
    }
    if let Some((line, statement)) = cut_off(text) {
        let message = format!("the file ends within a face, after {}; it was probably cut off", show(&statement));
        return Err(invalid(Some(line), message));
    }
    let mut polygons = Polygons::new(positions);
    let mut corners = &mesh.indices[vertex_count.min(mesh.indices.len())..];
    for (i, &line) in lines.iter().enumerate() {
        stop.check()?;
        // No list of sizes means triangles; the first is that of the face of all vertices.
        let len =
            if mesh.face_arities.is_empty() { 3 } else { mesh.face_arities.get(i + 1).map_or(0, |&n| n as usize) };
        let (face, rest) = corners.split_at(len.min(corners.len()));
        corners = rest;
        polygons.push(face.iter().copied(), Some(line)).map_err(|_| invalid(Some(line), Full.to_string()))?;
    }
    Ok((polygons, ignored.diagnostics()))
}

/// The statements of a text with the line at which each begins; a backslash at the end of a line continues it.
#[derive(Clone)]
struct Statements<'a>(Lines<'a>);

impl<'a> Statements<'a> {
    fn new(text: &'a [u8]) -> Self {
        Self(Lines::new(text))
    }
}

impl<'a> Iterator for Statements<'a> {
    type Item = (u32, Cow<'a, [u8]>);

    fn next(&mut self) -> Option<Self::Item> {
        let (number, line) = self.0.next()?;
        let mut statement = Cow::Borrowed(line);
        while let Some(head) = statement.trim_ascii_end().strip_suffix(b"\\") {
            let mut joined = head.to_vec();
            joined.push(b' ');
            match self.0.next() {
                Some((_, line)) => joined.extend_from_slice(line),
                None => return Some((number, Cow::Owned(joined))),
            }
            statement = Cow::Owned(joined);
        }
        Some((number, statement))
    }
}

/// The last statement, if it is a face of fewer than three corners without an end of the line.
fn cut_off(text: &[u8]) -> Option<(u32, Cow<'_, [u8]>)> {
    if text.ends_with(b"\n") || text.ends_with(b"\r") {
        return None;
    }
    Statements::new(text).last().filter(|(_, s)| keyword(s) == b"f" && words(s).count() < 4)
}

fn keyword(statement: &[u8]) -> &[u8] {
    words(statement).next().unwrap_or(&[])
}

/// What tobj reads.
struct Feed<'a> {
    statements: Statements<'a>,
    stop: &'a Stop,
    /// The statement tobj is reading, and how far.
    buffer: Vec<u8>,
    read: usize,
    /// The line of that statement, 0 before the first.
    line: u32,
    /// The lines of faces.
    lines: Vec<u32>,
    ignored: Ignored,
}

impl<'a> Feed<'a> {
    fn new(text: &'a [u8], vertex_count: usize, stop: &'a Stop) -> Self {
        let mut buffer = b"f".to_vec();
        for i in 1..=vertex_count {
            let _ = write!(buffer, " {i}");
        }
        buffer.push(b'\n');
        let statements = Statements::new(text);
        Self { statements, stop, buffer, read: 0, line: 0, lines: Vec::new(), ignored: Ignored::default() }
    }

    /// Puts the next vertex or face into the buffer.
    fn refill(&mut self) -> io::Result<()> {
        self.buffer.clear();
        self.read = 0;
        while self.buffer.is_empty() {
            self.stop.check().map_err(io::Error::other)?;
            let Some((line, statement)) = self.statements.next() else { return Ok(()) };
            let keyword = keyword(&statement);
            match keyword {
                b"" => continue,
                b"v" => {
                    let numbers = words(&statement).skip(1).count();
                    self.ignored.colors |= numbers > 5;
                    let kept = if numbers > 5 { 4 } else { numbers + 1 };
                    for word in words(&statement).take(kept) {
                        self.buffer.extend_from_slice(word);
                        self.buffer.push(b' ');
                    }
                }
                b"f" => {
                    self.lines.push(line);
                    self.buffer.extend_from_slice(&statement);
                }
                _ => {
                    self.ignored.note(line, keyword);
                    continue;
                }
            }
            self.buffer.push(b'\n');
            self.line = line;
        }
        Ok(())
    }
}

impl Read for Feed<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let n = self.fill_buf()?.read(into)?;
        self.consume(n);
        Ok(n)
    }
}

impl BufRead for Feed<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.read == self.buffer.len() {
            self.refill()?;
        }
        Ok(&self.buffer[self.read..])
    }

    fn consume(&mut self, n: usize) {
        self.read = (self.read + n).min(self.buffer.len());
    }
}

/// What was passed over: how often, and the line where it first stood.
#[derive(Default)]
struct Ignored {
    colors: bool,
    attributes: bool,
    lines: (usize, u32),
    points: (usize, u32),
    free_form: (usize, u32),
    unknown: (usize, u32),
    first_unknown: String,
}

impl Ignored {
    fn note(&mut self, line: u32, keyword: &[u8]) {
        let counter = match keyword {
            b"l" => &mut self.lines,
            b"p" => &mut self.points,
            _ if ATTRIBUTES.contains(&keyword) => {
                self.attributes = true;
                return;
            }
            _ if FREE_FORM.contains(&keyword) => &mut self.free_form,
            _ => {
                if self.unknown.0 == 0 {
                    self.first_unknown = show(keyword);
                }
                &mut self.unknown
            }
        };
        if counter.0 == 0 {
            counter.1 = line;
        }
        counter.0 += 1;
    }

    fn diagnostics(&mut self) -> Vec<Diagnostic> {
        let mut diagnostics = Vec::new();
        let warnings = [
            (self.lines, "`l` (a line)".to_owned(), "polylines are not read"),
            (self.points, "`p` (points)".to_owned(), "points are not read"),
            (self.free_form, "a free-form curve or surface".to_owned(), "only polygons are read"),
            (self.unknown, std::mem::take(&mut self.first_unknown), "this is no statement of an OBJ file"),
        ];
        for ((n, line), what, why) in warnings {
            if n > 0 {
                let more = if n > 1 { format!(" and {} more like it", n - 1) } else { String::new() };
                let message = format!("{what} on line {line}{more} ignored: {why}");
                diagnostics.push(Diagnostic::new(Severity::Warning, None, message));
            }
        }
        if self.colors || self.attributes {
            let message = "colours, normals, texture coordinates, groups and materials are not read";
            diagnostics.push(Diagnostic::new(Severity::Note, None, message));
        }
        diagnostics
    }
}

/// What is wrong with the statement at `line`, or where tobj came to the end, with the first face that names a vertex
/// that is not there.
fn explain(text: &[u8], line: u32, error: tobj::LoadError) -> ReadError {
    if error == tobj::LoadError::FaceVertexOutOfBounds
        && let Some(error) = bad_corner(text)
    {
        return error;
    }
    let statement = Statements::new(text).find(|&(number, _)| number == line).map(|(_, s)| s).unwrap_or_default();
    let arguments = words(&statement).skip(1);
    let message = match keyword(&statement) {
        b"v" => match arguments.clone().find_map(|word| number(word).err()) {
            Some(why) => why,
            None => match arguments.count() {
                0 => "the vertex has no coordinates".to_owned(),
                1 => "the vertex has one coordinate, not three".to_owned(),
                2 => "the vertex has two coordinates, not three".to_owned(),
                4 => "the weight of the vertex is 0".to_owned(),
                n => format!("the vertex has {n} numbers; it takes three, four with a weight, six with a colour"),
            },
        },
        b"f" => match arguments.clone().find(|word| !is_corner(word)) {
            Some(word) => format!("{} is no corner of a face, as `7`, `-1` or `7/1/3` would be", show(word)),
            None => format!("the face cannot be read: {error}"),
        },
        _ => format!("the file cannot be read as OBJ: {error}"),
    };
    invalid(Some(line).filter(|&line| line > 0), message)
}

/// Up to three integers between slashes, where all but the first may be missing.
fn is_corner(word: &[u8]) -> bool {
    let mut parts = word.split(|&b| b == b'/');
    let integer = |part: &[u8]| std::str::from_utf8(part).is_ok_and(|part| part.parse::<i64>().is_ok());
    parts.next().is_some_and(integer) && parts.clone().count() < 3 && parts.all(|part| part.is_empty() || integer(part))
}

/// The first corner whose vertex is not there.
fn bad_corner(text: &[u8]) -> Option<ReadError> {
    let total = Statements::new(text).filter(|(_, s)| keyword(s) == b"v").count() as i64;
    let mut before = 0;
    for (line, statement) in Statements::new(text) {
        match keyword(&statement) {
            b"v" => before += 1,
            b"f" => {
                for word in words(&statement).skip(1) {
                    let index = word.split(|&b| b == b'/').next().and_then(|part| std::str::from_utf8(part).ok());
                    let index = index.and_then(|part| part.parse::<i64>().ok());
                    let why = match index {
                        None => "it names no vertex".to_owned(),
                        Some(0) => "vertices are numbered from 1".to_owned(),
                        Some(i) if i < -before => format!("{before} vertices stand before it"),
                        Some(i) if i > total => match total {
                            0 => "the file has no vertices".to_owned(),
                            _ => format!("the last vertex is {total}"),
                        },
                        Some(_) => continue,
                    };
                    let message = format!("the face has a corner at vertex {}, but {why}", show(word));
                    return Some(invalid(Some(line), message));
                }
            }
            _ => {}
        }
    }
    None
}

/// The line of the vertex at `index`, which tobj read as infinite or NaN.
fn not_finite(text: &[u8], index: usize) -> ReadError {
    let statement = Statements::new(text).filter(|(_, s)| keyword(s) == b"v").nth(index);
    let Some((line, statement)) = statement else { return invalid(None, "a coordinate is not finite") };
    let why = words(&statement).skip(1).find_map(|word| number(word).err());
    invalid(Some(line), why.unwrap_or_else(|| "the coordinates divided by the weight are too large".to_owned()))
}

pub(super) fn write(mesh: &Mesh, faces: &Faces) -> Vec<u8> {
    let (numbers, members) = numbering(mesh);
    let polygons = || faces.iter().filter(|face| face.len() > 2);
    let mut text = Vec::new();
    // Writing to a vector does not fail.
    let _ = writeln!(text, "# {} vertices, {} faces", members.len(), polygons().count());
    for v in members {
        text.push(b'v');
        for x in mesh.position(v).to_array() {
            text.push(b' ');
            push_number(&mut text, x);
        }
        text.push(b'\n');
    }
    for face in polygons() {
        text.push(b'f');
        for corner in face {
            let _ = write!(text, " {}", numbers[corner.index()] + 1);
        }
        text.push(b'\n');
    }
    text
}
