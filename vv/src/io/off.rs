//! The Object File Format, as Geomview describes it.

use std::io::Write;

use glam::DVec3;

use super::lines::{Lines, number, show, words};
use super::{ReadError, invalid, numbering, push_number};
use crate::diagnostic::{Diagnostic, Severity};
use crate::mesh::Mesh;
use crate::mesh::build::Polygons;
use crate::mesh::faces::Faces;
use crate::stop::Stop;

/// Reads the header (`OFF`, also with the prefixes `ST`, `C`, `N` for what is not read; it may be missing), the counts,
/// the vertices and the faces. Comments and blank lines may stand anywhere.
///
/// One vertex or face stands on a line, and what follows on it (normals, colours) is passed over; a file with too few
/// lines for that is read as a stream of words.
pub(super) fn read(text: &[u8], stop: &Stop) -> Result<(Polygons, Vec<Diagnostic>), ReadError> {
    let mut words = Words::new(text);
    let extras = header(&mut words)?;
    let vertex_count = count(&mut words, "vertices")?;
    let face_count = count(&mut words, "faces")?;
    if let Some(edges) = words.next_on_line() {
        integer(edges, words.line, "the number of edges")?;
    }
    let stream = words.lines_left() < vertex_count.saturating_add(u64::from(face_count > 0));
    let mut ignored = !stream && words.finish_line() > 0;

    let mut positions = Vec::new();
    while (positions.len() as u64) < vertex_count {
        stop.check()?;
        let n = positions.len() as u64;
        let mut p = [0.0; 3];
        for (k, x) in p.iter_mut().enumerate() {
            let word = if stream || k == 0 { words.next() } else { words.next_on_line() };
            let Some(word) = word else { return Err(ends(&words, stream, k, n, vertex_count)) };
            *x = number(word).map_err(|why| invalid(Some(words.line), format!("vertex {}: {why}", n + 1)))?;
        }
        if stream {
            for _ in 0..extras {
                words.next();
            }
        } else {
            ignored |= words.finish_line() > 0;
        }
        positions.push(DVec3::from_array(p));
    }

    let mut polygons = Polygons::new(positions);
    let mut corners = Vec::new();
    while (polygons.len() as u64) < face_count {
        stop.check()?;
        let n = polygons.len() as u64 + 1;
        let Some(word) = words.next() else {
            let message = format!("the file ends after {} of {face_count} faces", n - 1);
            return Err(invalid(Some(words.line), message));
        };
        let line = words.line;
        let len = integer(word, line, "the number of corners of a face")?;
        corners.clear();
        while (corners.len() as u64) < len {
            let word = if stream { words.next() } else { words.next_on_line() };
            let Some(word) = word else {
                let message = format!("face {n} announces {len} corners, but there are {}", corners.len());
                return Err(invalid(Some(line), message));
            };
            let corner = integer(word, words.line, "a vertex of the face, numbered from 0")?;
            match u32::try_from(corner) {
                Ok(corner) if u64::from(corner) < vertex_count => corners.push(corner),
                _ => {
                    let last = vertex_count.checked_sub(1);
                    let range = last.map_or("there is none".to_owned(), |last| format!("they go from 0 to {last}"));
                    return Err(invalid(
                        Some(words.line),
                        format!("face {n} has a corner at vertex {corner}, but {range}"),
                    ));
                }
            }
            if corners.len().is_multiple_of(4096) {
                stop.check()?;
            }
        }
        polygons
            .push(corners.iter().copied(), Some(line))
            .map_err(|_| invalid(Some(line), crate::mesh::Full.to_string()))?;
        if !stream {
            ignored |= words.finish_line() > 0;
        }
    }

    let mut diagnostics = Vec::new();
    if ignored || extras > 0 {
        let message = "colours, normals and texture coordinates are not read";
        diagnostics.push(Diagnostic::new(Severity::Note, None, message));
    }
    if words.next().is_some() {
        let message = format!("line {} and what follows is ignored: all announced faces were read", words.line);
        diagnostics.push(Diagnostic::new(Severity::Warning, None, message));
    }
    Ok((polygons, diagnostics))
}

/// Reads the key word and returns how many numbers follow the coordinates of a vertex.
fn header(words: &mut Words<'_>) -> Result<usize, ReadError> {
    let mut peek = words.clone();
    let Some(word) = peek.next() else { return Err(invalid(None, "the file holds nothing but comments")) };
    if word.first().is_some_and(u8::is_ascii_digit) && !word.ends_with(b"OFF") {
        return Ok(0);
    }
    let not_off = || {
        let message = format!("this is no OFF file: it begins with {}, not with OFF", show(word));
        invalid(Some(peek.line), message)
    };
    let Some(mut prefix) = word.strip_suffix(b"OFF") else { return Err(not_off()) };
    let mut extras = 0;
    for (name, numbers) in [(&b"ST"[..], 2), (b"C", 4), (b"N", 3)] {
        if let Some(rest) = prefix.strip_prefix(name) {
            prefix = rest;
            extras += numbers;
        }
    }
    match prefix {
        b"" => {}
        b"4" | b"n" | b"4n" => {
            let message =
                format!("{} has coordinates of other dimension than three; only plain OFF is read", show(word));
            return Err(invalid(Some(peek.line), message));
        }
        _ => return Err(not_off()),
    }
    *words = peek;
    let mut peek = words.clone();
    if peek.next_on_line().is_some_and(|word| word.eq_ignore_ascii_case(b"BINARY")) {
        return Err(invalid(Some(peek.line), "binary OFF is not read; save the file as text"));
    }
    Ok(extras)
}

fn count(words: &mut Words<'_>, what: &str) -> Result<u64, ReadError> {
    let Some(word) = words.next() else {
        return Err(invalid(Some(words.line), format!("the file ends before the number of {what}")));
    };
    integer(word, words.line, &format!("the number of {what}"))
}

/// The file or a line ends within vertex `n`, of which `k` coordinates were read.
fn ends(words: &Words<'_>, stream: bool, k: usize, n: u64, vertex_count: u64) -> ReadError {
    let line = Some(words.line);
    match k {
        _ if stream || k == 0 => invalid(line, format!("the file ends after {n} of {vertex_count} vertices")),
        2 => {
            invalid(line, format!("vertex {} has two coordinates; flat OFF is not read, write 0 for the third", n + 1))
        }
        _ => invalid(line, format!("vertex {} has one coordinate, not three", n + 1)),
    }
}

fn integer(word: &[u8], line: u32, expected: &str) -> Result<u64, ReadError> {
    let integer = std::str::from_utf8(word).ok().and_then(|text| text.parse().ok());
    integer.ok_or_else(|| invalid(Some(line), format!("expected {expected}, found {}", show(word))))
}

/// The words of a text, and the line of the last.
#[derive(Clone)]
struct Words<'a> {
    lines: Lines<'a>,
    rest: &'a [u8],
    line: u32,
}

impl<'a> Words<'a> {
    fn new(text: &'a [u8]) -> Self {
        Self { lines: Lines::new(text), rest: &[], line: 1 }
    }

    /// The next word on this line.
    fn next_on_line(&mut self) -> Option<&'a [u8]> {
        let rest: &'a [u8] = self.rest;
        let word = words(rest).next()?;
        let end = word.as_ptr() as usize - rest.as_ptr() as usize + word.len();
        self.rest = &rest[end..];
        Some(word)
    }

    /// The next word, on this line or a later one.
    fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(word) = self.next_on_line() {
                return Some(word);
            }
            (self.line, self.rest) = self.lines.next()?;
        }
    }

    /// Passes over the rest of the line: how many words that was.
    fn finish_line(&mut self) -> usize {
        words(std::mem::take(&mut self.rest)).count()
    }

    /// How many lines with words follow this one.
    fn lines_left(&self) -> u64 {
        self.lines.clone().filter(|(_, line)| words(line).next().is_some()).count() as u64
    }
}

pub(super) fn write(mesh: &Mesh, faces: &Faces) -> Vec<u8> {
    let (numbers, members) = numbering(mesh);
    let polygons = || faces.iter().filter(|face| face.len() > 2);
    let mut text = Vec::new();
    // Writing to a vector does not fail.
    let _ = writeln!(text, "OFF\n{} {} 0", members.len(), polygons().count());
    for v in members {
        for (k, x) in mesh.position(v).to_array().into_iter().enumerate() {
            if k > 0 {
                text.push(b' ');
            }
            push_number(&mut text, x);
        }
        text.push(b'\n');
    }
    for face in polygons() {
        let _ = write!(text, "{}", face.len());
        for corner in face {
            let _ = write!(text, " {}", numbers[corner.index()]);
        }
        text.push(b'\n');
    }
    text
}
