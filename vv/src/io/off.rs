//! The Object File Format, as Geomview describes it.

use std::io::Write;

use glam::DVec3;

use super::color::{self, Colors};
use super::lines::{COMMENT, Words, integer, number, show};
use super::{
    Place, ReadError, invalid, is_polygon, note, numbering, polygons, push_integer, push_lines, push_number, warning,
};
use crate::diagnostic::Diagnostic;
use crate::mesh::Mesh;
use crate::mesh::build::Polygons;
use crate::mesh::faces::Faces;
use crate::stop::Stop;

/// What follows the coordinates of a vertex, in this order.
#[derive(Clone, Copy, Default)]
struct Extras {
    normal: bool,
    color: bool,
    texture: bool,
}

impl Extras {
    /// How many numbers that are; colours may lack their opacity.
    fn len(self) -> usize {
        3 * usize::from(self.normal) + 4 * usize::from(self.color) + 2 * usize::from(self.texture)
    }

    /// The colour among the words behind the coordinates, and its opacity.
    fn color(self, words: &[&[u8]]) -> Option<(DVec3, f64)> {
        let from = 3 * usize::from(self.normal);
        let to = words.len().checked_sub(2 * usize::from(self.texture))?;
        let numbers: Vec<f64> = words.get(from..to)?.iter().map_while(|word| number(word).ok()).collect();
        match numbers[..] {
            [r, g, b] if self.color => Some((DVec3::new(r, g, b), 0.0)),
            [r, g, b, opacity] if self.color => Some((DVec3::new(r, g, b), opacity)),
            _ => None,
        }
    }
}

/// Reads the header (`OFF`, also with the prefixes `C` for colours and `ST`, `N` for what is not read; it may be
/// missing), the counts, the vertices and the faces. Comments and blank lines may stand anywhere.
///
/// One vertex or face stands on a line, and what else follows on it is passed over; a file with too few lines for that
/// is read as a stream of words. Where the first vertex has two coordinates alone, all have, and lie in the plane z = 0.
pub(super) fn read(text: &[u8], stop: &Stop) -> Result<(Polygons, Vec<Diagnostic>), ReadError> {
    let mut words = Words::new(text, COMMENT);
    let extras = header(&mut words)?;
    let vertex_count = count(&mut words, "vertices")?;
    let face_count = count(&mut words, "faces")?;
    if let Some(edges) = words.next_on_line() {
        expect(&words, edges, "the number of edges")?;
    }
    let stream = words.lines_left() < vertex_count.saturating_add(u64::from(face_count > 0));
    let mut ignored = !stream && words.finish_line() > 0;

    let flat = !stream && vertex_count > 0 && words.words_on_next_line() == 2;
    // A line of a vertex or a face has that many bytes at least, whatever the header announces.
    let announced = |count: u64| count.min(text.len() as u64 / 6) as usize;
    let mut positions = Vec::with_capacity(announced(vertex_count));
    let (mut colors, mut greatest) = (Colors::default(), 0.0);
    let mut rest = Vec::new();
    while (positions.len() as u64) < vertex_count {
        stop.check()?;
        let n = positions.len() as u64;
        let mut p = [0.0; 3];
        for (k, x) in p.iter_mut().enumerate().take(if flat { 2 } else { 3 }) {
            let word = if stream || k == 0 { words.next() } else { words.next_on_line() };
            let Some(word) = word else { return Err(ends(&words, stream, k, n, vertex_count)) };
            *x = number(word).map_err(|why| invalid(words.place(), format!("vertex {}: {why}", n + 1)))?;
        }
        rest.clear();
        if stream {
            rest.extend((0..extras.len()).map_while(|_| words.next()));
        } else {
            rest.extend(std::iter::from_fn(|| words.next_on_line()));
        }
        if flat && !rest.is_empty() {
            let message = format!("vertex {} has more coordinates than the two of the first", n + 1);
            return Err(invalid(words.line(), message));
        }
        let color = extras.color(&rest);
        ignored |= rest.len() > if color.is_some() { 4 } else { 0 };
        colors.push(color.map(|(color, _)| color));
        greatest = color.map_or(0.0, |(_, opacity)| opacity).max(greatest);
        positions.push(DVec3::from_array(p));
    }

    let mut polygons = Polygons::new(positions);
    polygons.reserve(announced(face_count), 4 * announced(face_count));
    let mut corners = Vec::new();
    while (polygons.len() as u64) < face_count {
        stop.check()?;
        let n = polygons.len() as u64 + 1;
        let Some(word) = words.next() else {
            let message = format!("the file ends after {} of {face_count} faces", n - 1);
            return Err(invalid(words.line(), message));
        };
        let line = words.line;
        let len = expect(&words, word, "the number of corners of a face")?;
        corners.clear();
        while (corners.len() as u64) < len {
            let word = if stream { words.next() } else { words.next_on_line() };
            let Some(word) = word else {
                let message = format!("face {n} announces {len} corners, but there are {}", corners.len());
                return Err(invalid(Place::line(line), message));
            };
            let corner = expect(&words, word, "a vertex of the face, numbered from 0")?;
            match u32::try_from(corner) {
                Ok(corner) if u64::from(corner) < vertex_count => corners.push(corner),
                _ => {
                    let last = vertex_count.checked_sub(1);
                    let range = last.map_or("there is none".to_owned(), |last| format!("they go from 0 to {last}"));
                    let message = format!("face {n} has a corner at vertex {corner}, but {range}");
                    return Err(invalid(words.place(), message));
                }
            }
            if corners.len().is_multiple_of(4096) {
                stop.check()?;
            }
        }
        polygons
            .push(corners.iter().copied(), Some(line))
            .map_err(|_| invalid(Place::line(line), crate::mesh::Full.to_string()))?;
        if !stream {
            ignored |= words.finish_line() > 0;
        }
    }

    polygons.values.vertices.extend(colors.property(greatest));

    let mut diagnostics = Vec::new();
    if flat {
        diagnostics.push(note("the vertices have two coordinates; the third is 0"));
    }
    if ignored {
        diagnostics.push(note("normals, texture coordinates and colours of faces are not read"));
    }
    if words.next().is_some() {
        let message = format!("line {} and what follows is ignored: all announced faces were read", words.line);
        diagnostics.push(warning(message));
    }
    Ok((polygons, diagnostics))
}

/// Reads the key word.
fn header(words: &mut Words<'_>) -> Result<Extras, ReadError> {
    let mut peek = words.clone();
    let Some(word) = peek.next() else { return Err(invalid(None, "the file holds nothing but comments")) };
    if word.first().is_some_and(u8::is_ascii_digit) && !word.ends_with(b"OFF") {
        return Ok(Extras::default());
    }
    let not_off = || {
        let message = format!("this is no OFF file: it begins with {}, not with OFF", show(word));
        invalid(peek.line(), message)
    };
    let Some(mut prefix) = word.strip_suffix(b"OFF") else { return Err(not_off()) };
    let mut has = |name: &[u8]| {
        let rest = prefix.strip_prefix(name);
        prefix = rest.unwrap_or(prefix);
        rest.is_some()
    };
    let (texture, color, normal) = (has(b"ST"), has(b"C"), has(b"N"));
    match prefix {
        b"" => {}
        b"4" | b"n" | b"4n" => {
            let message =
                format!("{} has coordinates of other dimension than three; only plain OFF is read", show(word));
            return Err(invalid(peek.line(), message));
        }
        _ => return Err(not_off()),
    }
    *words = peek;
    let mut peek = words.clone();
    if peek.next_on_line().is_some_and(|word| word.eq_ignore_ascii_case(b"BINARY")) {
        return Err(invalid(peek.line(), "binary OFF is not read; save the file as text"));
    }
    Ok(Extras { normal, color, texture })
}

fn count(words: &mut Words<'_>, what: &str) -> Result<u64, ReadError> {
    let Some(word) = words.next() else {
        return Err(invalid(words.line(), format!("the file ends before the number of {what}")));
    };
    expect(words, word, &format!("the number of {what}"))
}

/// The file or a line ends within vertex `n`, of which `k` coordinates were read.
fn ends(words: &Words<'_>, stream: bool, k: usize, n: u64, vertex_count: u64) -> ReadError {
    let line = words.line();
    match k {
        _ if stream || k == 0 => invalid(line, format!("the file ends after {n} of {vertex_count} vertices")),
        2 => invalid(line, format!("vertex {} has two coordinates, not three", n + 1)),
        _ => invalid(line, format!("vertex {} has one coordinate, not three", n + 1)),
    }
}

/// The word, which was read last, as a number.
fn expect(words: &Words<'_>, word: &[u8], expected: &str) -> Result<u64, ReadError> {
    integer(word).ok_or_else(|| invalid(words.place(), format!("expected {expected}, found {}", show(word))))
}

/// As text, with the colours of vertices in bytes if there are any.
pub(super) fn write(mesh: &Mesh, faces: &Faces) -> Vec<u8> {
    let (numbers, members) = numbering(mesh);
    let colors = color::column(mesh);
    let mut text = Vec::new();
    // Writing to a vector does not fail.
    let header = if colors.is_some() { "COFF" } else { "OFF" };
    let _ = writeln!(text, "{header}\n{} {} 0", members.len(), polygons(faces).count());
    push_lines(&mut text, members.len(), |text, i| {
        let v = members[i];
        for (k, x) in mesh.position(v).to_array().into_iter().enumerate() {
            if k > 0 {
                text.push(b' ');
            }
            push_number(text, x);
        }
        if let Some(column) = colors {
            let [r, g, b] = color::bytes(mesh, column, v);
            let _ = write!(text, " {r} {g} {b} 255");
        }
        text.push(b'\n');
    });
    push_lines(&mut text, faces.len(), |text, i| {
        let face = faces.get(i);
        if is_polygon(face) {
            push_integer(text, face.len());
            for corner in face {
                text.push(b' ');
                push_integer(text, numbers[corner.index()]);
            }
            text.push(b'\n');
        }
    });
    text
}
