//! Wavefront OBJ, through tobj.
//!
//! Left to itself tobj numbers vertices by their first use in faces and drops unused ones, starts a mesh with vertices
//! of its own at each group, takes polylines for faces, fails at continued lines, at comments behind numbers and at
//! colours of some vertices, accepts NaN, and does not name lines. So it is handed a text of vertices and faces alone,
//! one statement to a line, that begins with a face of all vertices, which keeps them all and their order. Polylines are
//! among the faces, and are known by their place. The line it read last is where a statement is wrong. Colours and tags
//! are read on the way.

mod polylines;
mod tags;

use std::borrow::Cow;
use std::io::{self, BufRead, Read, Write};

use glam::DVec3;

use super::color::{self, Colors};
use super::lines::{COMMENT, Lines, column, number, show, words};
use super::losses::Of;
use super::{
    Place, ReadError, invalid, is_polygon, note, numbering, polygons, push_integer, push_lines, push_number, warning,
};
use crate::diagnostic::Diagnostic;
use crate::mesh::build::Polygons;
use crate::mesh::faces::Faces;
use crate::mesh::{Full, Mesh, Type};
use crate::stop::Stop;
use tags::Tags;

pub(super) use polylines::count as wires;
pub use tags::SHARPNESS;

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
    let vertex_count = Statements::new(text).filter(|s| s.keyword() == b"v").count();
    let mut feed = Feed::new(text, vertex_count, stop);
    // A closure that is never called: no `mtllib` gets through.
    let loaded = tobj::load_obj_buf(&mut feed, &tobj::LoadOptions::default(), |_| Err(tobj::LoadError::GenericFailure));
    stop.check()?;
    if let Some(error) = feed.wrong {
        return Err(error);
    }
    let models = match loaded {
        Ok((models, _)) => models,
        Err(error) => return Err(explain(text, feed.line, error)),
    };
    let Feed { faces, mut ignored, colors, greatest, tags, .. } = feed;
    if vertex_count == 0 && faces.is_empty() && ignored.unknown.0 > 0 {
        return Err(invalid(None, "this is no OBJ file: no line begins with `v` or `f`"));
    }
    let Some(mesh) = models.into_iter().next().map(|model| model.mesh) else {
        return Err(invalid(None, "the OBJ file holds no mesh"));
    };
    let positions: Vec<DVec3> = mesh.positions.chunks_exact(3).map(|p| DVec3::new(p[0], p[1], p[2])).collect();
    if let Some(index) = positions.iter().position(|p| !p.is_finite()) {
        return Err(not_finite(text, index));
    }
    if let Some(statement) = cut_off(text) {
        let message = format!("the file ends within a face, after {}; it was probably cut off", show(&statement.text));
        return Err(invalid(Place::line(statement.line), message));
    }
    let mut polygons = Polygons::new(positions);
    let mut corners = &mesh.indices[vertex_count.min(mesh.indices.len())..];
    for (i, &Face { line, open }) in faces.iter().enumerate() {
        stop.check()?;
        // No list of sizes means triangles; the first is that of the face of all vertices.
        let len =
            if mesh.face_arities.is_empty() { 3 } else { mesh.face_arities.get(i + 1).map_or(0, |&n| n as usize) };
        let (face, rest) = corners.split_at(len.min(corners.len()));
        corners = rest;
        let added = if open { polygons.push_wire(face) } else { polygons.push(face.iter().copied(), Some(line)) };
        added.map_err(|_| invalid(Place::line(line), Full.to_string()))?;
    }
    polygons.values.vertices.extend(colors.property(greatest));
    tags.give(&mut polygons.values, vertex_count);
    Ok((polygons, ignored.diagnostics()))
}

/// A statement and the line at which it begins.
struct Statement<'a> {
    line: u32,
    text: Cow<'a, [u8]>,
}

impl Statement<'_> {
    fn keyword(&self) -> &[u8] {
        words(&self.text).next().unwrap_or(&[])
    }

    /// What follows the key word.
    fn arguments(&self) -> impl Iterator<Item = &[u8]> + Clone {
        words(&self.text).skip(1)
    }

    /// Where one of its words stands; a statement that was continued is no line any more.
    fn place(&self, word: &[u8]) -> Place {
        let column = if let Cow::Borrowed(text) = self.text { column(text, word) } else { None };
        Place::Text { line: self.line, column }
    }
}

/// The statements of a text; a backslash at the end of a line continues it.
#[derive(Clone)]
struct Statements<'a>(Lines<'a>);

impl<'a> Statements<'a> {
    fn new(text: &'a [u8]) -> Self {
        Self(Lines::new(text, COMMENT))
    }
}

impl<'a> Iterator for Statements<'a> {
    type Item = Statement<'a>;

    fn next(&mut self) -> Option<Self::Item> {
        let (line, text) = self.0.next()?;
        let mut text = Cow::Borrowed(text);
        while let Some(head) = text.trim_ascii_end().strip_suffix(b"\\").map(<[u8]>::len) {
            let joined = text.to_mut();
            joined.truncate(head);
            joined.push(b' ');
            let Some((_, more)) = self.0.next() else { break };
            joined.extend_from_slice(more);
        }
        Some(Statement { line, text })
    }
}

/// The last statement, if it is a face of fewer than three corners without an end of the line.
fn cut_off(text: &[u8]) -> Option<Statement<'_>> {
    if text.ends_with(b"\n") || text.ends_with(b"\r") {
        return None;
    }
    Statements::new(text).last().filter(|s| s.keyword() == b"f" && s.arguments().count() < 3)
}

/// A statement with corners.
struct Face {
    line: u32,
    /// Whether it is a polyline.
    open: bool,
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
    faces: Vec<Face>,
    ignored: Ignored,
    colors: Colors,
    /// The greatest opacity of colours.
    greatest: f64,
    tags: Tags,
    /// What is wrong with a colour or tag; nothing is read after it.
    wrong: Option<ReadError>,
}

impl<'a> Feed<'a> {
    fn new(text: &'a [u8], vertex_count: usize, stop: &'a Stop) -> Self {
        let mut buffer = b"f".to_vec();
        for i in 1..=vertex_count {
            let _ = write!(buffer, " {i}");
        }
        buffer.push(b'\n');
        let statements = Statements::new(text);
        Self {
            statements,
            stop,
            buffer,
            read: 0,
            line: 0,
            faces: Vec::new(),
            ignored: Ignored::default(),
            colors: Colors::default(),
            greatest: 0.0,
            tags: Tags::new(vertex_count),
            wrong: None,
        }
    }

    /// Puts the next vertex or face into the buffer.
    fn refill(&mut self) -> io::Result<()> {
        self.buffer.clear();
        self.read = 0;
        while self.buffer.is_empty() {
            self.stop.check().map_err(io::Error::other)?;
            let Some(statement) = self.statements.next().filter(|_| self.wrong.is_none()) else {
                return Ok(());
            };
            let keyword = statement.keyword();
            match keyword {
                b"" => continue,
                b"v" => {
                    let numbers = statement.arguments().count();
                    self.add_color(&statement);
                    let kept = if numbers > 5 { 4 } else { numbers + 1 };
                    for word in words(&statement.text).take(kept) {
                        self.buffer.extend_from_slice(word);
                        self.buffer.push(b' ');
                    }
                }
                b"f" | b"l" => {
                    self.faces.push(Face { line: statement.line, open: keyword == b"l" });
                    self.buffer.push(b'f');
                    for word in statement.arguments() {
                        self.buffer.push(b' ');
                        self.buffer.extend_from_slice(word);
                    }
                }
                b"t" => {
                    match self.tags.add(statement.arguments(), |word| statement.place(word)) {
                        Ok(known) => self.ignored.attributes |= !known,
                        Err(error) => self.wrong = Some(error),
                    }
                    continue;
                }
                _ => {
                    self.ignored.note(statement.line, keyword);
                    continue;
                }
            }
            self.buffer.push(b'\n');
            self.line = statement.line;
        }
        Ok(())
    }

    /// The colour behind the coordinates, if there is one, with opacity or without.
    fn add_color(&mut self, statement: &Statement<'_>) {
        if statement.arguments().count() < 6 {
            return self.colors.push(None); // at most a weight
        }
        let mut channels = [0.0; 4];
        for (channel, word) in channels.iter_mut().zip(statement.arguments().skip(3)) {
            match number(word) {
                Ok(x) => *channel = x,
                Err(why) => self.wrong = Some(invalid(statement.place(word), why)),
            }
        }
        let [r, g, b, opacity] = channels;
        self.greatest = self.greatest.max(opacity);
        self.colors.push(Some(DVec3::new(r, g, b)));
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
    attributes: bool,
    points: (usize, u32),
    free_form: (usize, u32),
    unknown: (usize, u32),
    first_unknown: String,
}

impl Ignored {
    fn note(&mut self, line: u32, keyword: &[u8]) {
        let counter = match keyword {
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
            (self.points, "`p` (points)".to_owned(), "points are not read"),
            (self.free_form, "a free-form curve or surface".to_owned(), "only polygons and lines are read"),
            (self.unknown, std::mem::take(&mut self.first_unknown), "this is no statement of an OBJ file"),
        ];
        for ((n, line), what, why) in warnings {
            if n > 0 {
                let more = if n > 1 { format!(" and {} more like it", n - 1) } else { String::new() };
                let message = format!("{what} on line {line}{more} ignored: {why}");
                diagnostics.push(warning(message));
            }
        }
        if self.attributes {
            diagnostics.push(note(
                "normals, texture coordinates, groups, materials and tags but creases and corners are not read",
            ));
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
    let Some(statement) = Statements::new(text).find(|s| s.line == line) else {
        return invalid(None, format!("the file cannot be read as OBJ: {error}"));
    };
    let arguments = statement.arguments();
    let mut about = Place::line(line);
    let message = match statement.keyword() {
        b"v" => match arguments.clone().find_map(|word| Some((word, number(word).err()?))) {
            Some((word, why)) => {
                about = statement.place(word);
                why
            }
            None => match arguments.count() {
                0 => "the vertex has no coordinates".to_owned(),
                1 => "the vertex has one coordinate, not three".to_owned(),
                2 => "the vertex has two coordinates, not three".to_owned(),
                4 => "the weight of the vertex is 0".to_owned(),
                n => format!("the vertex has {n} numbers; it takes three, four with a weight, six with a colour"),
            },
        },
        b"f" => match arguments.clone().find(|word| !is_corner(word)) {
            Some(word) => {
                about = statement.place(word);
                format!("{} is no corner of a face, as `7`, `-1` or `7/1/3` would be", show(word))
            }
            None => format!("the face cannot be read: {error}"),
        },
        b"l" => match arguments.clone().find(|word| !is_corner(word)) {
            Some(word) => {
                about = statement.place(word);
                format!("{} is no point of a line, as `7`, `-1` or `7/1` would be", show(word))
            }
            None => format!("the line cannot be read: {error}"),
        },
        _ => format!("the file cannot be read as OBJ: {error}"),
    };
    invalid(Some(about).filter(|_| line > 0), message)
}

/// Up to three integers between slashes, where all but the first may be missing.
fn is_corner(word: &[u8]) -> bool {
    let mut parts = word.split(|&b| b == b'/');
    let integer = |part: &[u8]| std::str::from_utf8(part).is_ok_and(|part| part.parse::<i64>().is_ok());
    parts.next().is_some_and(integer) && parts.clone().count() < 3 && parts.all(|part| part.is_empty() || integer(part))
}

/// The first corner whose vertex is not there.
fn bad_corner(text: &[u8]) -> Option<ReadError> {
    let total = Statements::new(text).filter(|s| s.keyword() == b"v").count() as i64;
    let mut before = 0;
    for statement in Statements::new(text) {
        match statement.keyword() {
            b"v" => before += 1,
            keyword @ (b"f" | b"l") => {
                for word in statement.arguments() {
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
                    let what = if keyword == b"f" { "face has a corner" } else { "line has a point" };
                    let message = format!("the {what} at vertex {}, but {why}", show(word));
                    return Some(invalid(statement.place(word), message));
                }
            }
            _ => {}
        }
    }
    None
}

/// The line of the vertex at `index`, which tobj read as infinite or NaN.
fn not_finite(text: &[u8], index: usize) -> ReadError {
    let statement = Statements::new(text).filter(|s| s.keyword() == b"v").nth(index);
    let Some(statement) = statement else { return invalid(None, "a coordinate is not finite") };
    match statement.arguments().find_map(|word| Some((word, number(word).err()?))) {
        Some((word, why)) => invalid(statement.place(word), why),
        None => invalid(Place::line(statement.line), "the coordinates divided by the weight are too large"),
    }
}

/// Whether a property of this name and type is written.
pub(super) fn holds(of: Of, name: &str, ty: Type) -> bool {
    match of {
        Of::Vertices => color::is_color(name, ty) || tags::is_sharpness(name, ty),
        Of::Edges => tags::is_sharpness(name, ty),
        Of::Whole => false,
    }
}

/// As text, with polylines, colours and sharpness if there are any.
pub(super) fn write(mesh: &Mesh, faces: &Faces) -> Vec<u8> {
    let (numbers, members) = numbering(mesh);
    let colors = color::column(mesh);
    let mut text = Vec::new();
    // Writing to a vector does not fail.
    let _ = writeln!(text, "# {} vertices, {} faces", members.len(), polygons(faces).count());
    push_lines(&mut text, members.len(), |text, i| {
        let v = members[i];
        text.push(b'v');
        let color = colors.map(|column| color::of(mesh, column, v).to_array());
        for x in mesh.position(v).to_array().into_iter().chain(color.into_iter().flatten()) {
            text.push(b' ');
            push_number(text, x);
        }
        text.push(b'\n');
    });
    push_lines(&mut text, faces.len(), |text, i| {
        let face = faces.get(i);
        if is_polygon(face) {
            text.push(b'f');
            for corner in face {
                text.push(b' ');
                push_integer(text, numbers[corner.index()] + 1);
            }
            text.push(b'\n');
        }
    });
    polylines::write(mesh, &members, &numbers, &mut text);
    tags::write(mesh, &members, &numbers, &mut text);
    text
}
