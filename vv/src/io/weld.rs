//! Corners to vertices, for formats that repeat the position of a vertex in each of its faces.

use glam::DVec3;

use super::note;
use crate::diagnostic::Diagnostic;
use crate::stop::{Stop, Stopped};

/// Vertices for points: one for each position, exactly, in the order in which they first come.
pub(super) struct Welded {
    /// The vertex of each point.
    pub of: Vec<u32>,
    /// The first point of each vertex.
    pub first: Vec<u32>,
}

/// Joins points at exactly the same position (−0 is 0). O(n log n); sorting rather than hashing, as no file can make
/// that slow.
pub(super) fn weld(points: &[DVec3], stop: &Stop) -> Result<Welded, Stopped> {
    let key = |i: u32| points[i as usize].to_array().map(|x| (x + 0.0).to_bits());
    let mut sorted: Vec<([u64; 3], u32)> = (0..points.len() as u32).map(|i| (key(i), i)).collect();
    stop.check()?;
    sorted.sort_unstable();
    stop.check()?;
    // The first point at each position …
    let mut of = vec![0; points.len()];
    for same in sorted.chunk_by(|a, b| a.0 == b.0) {
        same.iter().for_each(|&(_, i)| of[i as usize] = same[0].1);
    }
    // … becomes the next vertex.
    let mut first = Vec::new();
    for i in 0..of.len() {
        of[i] = if of[i] as usize == i {
            first.push(i as u32);
            first.len() as u32 - 1
        } else {
            of[of[i] as usize]
        };
    }
    Ok(Welded { of, first })
}

impl Welded {
    /// Says how many there were and are.
    pub(super) fn diagnostic(&self, what: &str) -> Diagnostic {
        let (from, to) = (self.of.len(), self.first.len());
        note(format!("{from} {what} were welded to {to} vertices, one for each position"))
    }
}
