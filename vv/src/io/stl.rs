//! Stereolithography: triangles, each with the positions of its corners, as text and binary (little-endian).
//!
//! ```text
//!   80 bytes of header                       solid name
//!   number of triangles, 32 bits               facet normal 0 0 1
//!   50 bytes each:                               outer loop
//!     normal, 3 × 32 bits                          vertex 0 0 0     three of these
//!     corners, 3 × 3 × 32 bits                   endloop
//!     16 bits of anything                      endfacet …
//! ```

use std::io::Write;

use glam::DVec3;

use super::lines::{Words, number, show};
use super::weld::weld;
use super::{Place, ReadError, for_each_triangle, invalid, push_number, warning};
use crate::diagnostic::Diagnostic;
use crate::mesh::build::Polygons;
use crate::mesh::faces::Faces;
use crate::mesh::{Full, Mesh};
use crate::stop::Stop;

const HEADER: usize = 80;
/// Header and number.
const BEFORE: usize = HEADER + 4;
const TRIANGLE: usize = 50;

/// Whether it is binary by its length, which is all that tells: headers may begin as texts do.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    announced(bytes).is_some_and(|n| bytes.len() as u64 == BEFORE as u64 + n * TRIANGLE as u64)
}

/// How many triangles a binary file says it has.
fn announced(bytes: &[u8]) -> Option<u64> {
    bytes.get(HEADER..)?.first_chunk().map(|&n| u64::from(u32::from_le_bytes(n)))
}

pub(super) fn read(bytes: &[u8], stop: &Stop) -> Result<(Polygons, Vec<Diagnostic>), ReadError> {
    let begins = bytes.trim_ascii_start().get(..5).unwrap_or_default();
    let begins_as_text = begins.eq_ignore_ascii_case(b"solid") || begins.eq_ignore_ascii_case(b"facet");
    let is_text = begins_as_text && !bytes[..bytes.len().min(2 * BEFORE)].contains(&0);
    let (corners, mut diagnostics) =
        if is_text && !is_binary(bytes) { read_text(bytes, stop)? } else { read_binary(bytes, stop)? };
    let Corners { points, ends, lines } = corners;
    if u32::try_from(points.len()).is_err() {
        return Err(invalid(None, Full.to_string()));
    }
    let welded = weld(&points, stop)?;
    if !points.is_empty() {
        diagnostics.insert(0, welded.diagnostic("corners of triangles"));
    }
    let mut polygons = Polygons::new(welded.first.iter().map(|&i| points[i as usize]).collect());
    drop(points);
    let mut start = 0;
    for (f, &end) in ends.iter().enumerate() {
        let line = lines.get(f).copied();
        let full = |_| invalid(line.map(Place::line), Full.to_string());
        polygons.push(welded.of[start..end].iter().copied(), line).map_err(full)?;
        start = end;
    }
    Ok((polygons, diagnostics))
}

#[derive(Default)]
struct Corners {
    points: Vec<DVec3>,
    /// End of each face in `points`.
    ends: Vec<usize>,
    /// Line of each face, in texts.
    lines: Vec<u32>,
}

fn read_binary(bytes: &[u8], stop: &Stop) -> Result<(Corners, Vec<Diagnostic>), ReadError> {
    let Some(count) = announced(bytes) else {
        let message = format!("this is no STL file: it neither begins with `solid` nor has {BEFORE} bytes of header");
        return Err(invalid(None, message));
    };
    let data = &bytes[BEFORE..];
    let room = (data.len() / TRIANGLE) as u64;
    if room < count {
        let message = format!("the file announces {count} triangles and ends after {room}");
        return Err(invalid(Place::byte(bytes.len()), message));
    }
    let mut corners = Corners::default();
    for (i, triangle) in data.chunks_exact(TRIANGLE).take(count as usize).enumerate() {
        stop.check()?;
        for k in 0..3 {
            let at = 12 + 12 * k; // behind the normal
            let [x, y, z] =
                [0, 4, 8].map(|d| triangle[at + d..].first_chunk().map_or(f32::NAN, |&b| f32::from_le_bytes(b)));
            let p = DVec3::new(x.into(), y.into(), z.into());
            if !p.is_finite() {
                let message = format!("triangle {}: a coordinate is not finite", i + 1);
                return Err(invalid(Place::byte(BEFORE + i * TRIANGLE + at), message));
            }
            corners.points.push(p);
        }
        corners.ends.push(corners.points.len());
    }
    let rest = data.len() - count as usize * TRIANGLE;
    let left = (rest > 0).then(|| warning(format!("{rest} bytes after the last triangle are ignored")));
    Ok((corners, left.into_iter().collect()))
}

/// Key words of any case, any number of solids, and faces of any number of corners.
fn read_text(bytes: &[u8], stop: &Stop) -> Result<(Corners, Vec<Diagnostic>), ReadError> {
    let mut words = Words::new(bytes, None);
    let mut corners = Corners::default();
    let mut line = 1;
    let mut in_facet = false;
    while let Some(word) = words.next() {
        stop.check()?;
        match word.to_ascii_lowercase().as_slice() {
            b"solid" | b"endsolid" => {
                words.finish_line(); // its name
            }
            b"facet" => {
                line = words.line;
                in_facet = true;
                let mut peek = words.clone();
                if peek.next().is_some_and(|word| word.eq_ignore_ascii_case(b"normal")) {
                    words = peek;
                    // What programs write where they know none may be no number.
                    for _ in 0..3 {
                        words.next();
                    }
                }
            }
            b"outer" | b"loop" | b"endloop" => {}
            b"vertex" if in_facet => {
                let mut p = [0.0; 3];
                for x in &mut p {
                    let Some(word) = words.next() else {
                        return Err(invalid(words.line(), "the file ends within a vertex"));
                    };
                    *x = number(word).map_err(|why| invalid(words.place(), why))?;
                }
                corners.points.push(DVec3::from_array(p));
            }
            b"endfacet" => {
                in_facet = false;
                corners.ends.push(corners.points.len());
                corners.lines.push(line);
            }
            _ => return Err(invalid(words.place(), format!("{} is no key word of STL here", show(word)))),
        }
    }
    if in_facet {
        return Err(invalid(words.line(), "the file ends within a facet; it was probably cut off"));
    }
    Ok((corners, Vec::new()))
}

/// Binary; `None` if there are too many triangles. Positions beyond 32 bits become the greatest.
pub(super) fn write(mesh: &Mesh, faces: &Faces) -> Option<Vec<u8>> {
    let mut out = vec![b' '; HEADER];
    let title = b"binary STL";
    out[..title.len()].copy_from_slice(title);
    out.extend([0; 4]);
    let mut count = 0u64;
    for_each_triangle(mesh, faces, |t| {
        let points = t.map(|v| mesh.position(v));
        for v in [normal(points), points[0], points[1], points[2]] {
            v.to_array().into_iter().for_each(|x| out.extend(single(x).to_le_bytes()));
        }
        out.extend([0; 2]);
        count += 1;
    });
    out[HEADER..BEFORE].copy_from_slice(&u32::try_from(count).ok()?.to_le_bytes());
    Some(out)
}

/// As text.
pub(super) fn write_text(mesh: &Mesh, faces: &Faces) -> Vec<u8> {
    // Writing to a vector does not fail.
    let mut out = b"solid mesh\n".to_vec();
    let vector = |out: &mut Vec<u8>, head: &str, v: DVec3| {
        let _ = write!(out, "{head}");
        for x in v.to_array() {
            out.push(b' ');
            push_number(out, x);
        }
        out.push(b'\n');
    };
    for_each_triangle(mesh, faces, |t| {
        let points = t.map(|v| mesh.position(v));
        vector(&mut out, "  facet normal", normal(points));
        let _ = writeln!(out, "    outer loop");
        points.into_iter().for_each(|p| vector(&mut out, "      vertex", p));
        let _ = writeln!(out, "    endloop\n  endfacet");
    });
    let _ = writeln!(out, "endsolid mesh");
    out
}

/// Of unit length, zero where there is none.
fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

/// In 32 bits; what is too large is the greatest, what is no number 0.
pub(super) fn single(x: f64) -> f32 {
    if x.is_nan() { 0.0 } else { (x as f32).clamp(f32::MIN, f32::MAX) }
}
