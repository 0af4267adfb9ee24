//! What a pass over all rings in order of memory tells, for closing, validating and counting.

use std::collections::BTreeMap;

use std::ops::Range;

use rayon::prelude::*;

use super::members::Members;
use super::{Mesh, Vertex};
use crate::stop::{Stop, Stopped};

/// What the rings and positions of the members of the set hold. Lists are in order of creation.
#[derive(Default)]
pub(super) struct Survey {
    /// Entries that name members.
    pub entries: usize,
    /// Sum over these entries: an entry u→v counts +h(u, v) if u < v, else −h(v, u), for a mixing function h. As no ring
    /// names a vertex twice, it is 0 where all pairs answer, and otherwise 0 by a chance of 2⁻⁶⁴. That takes one pass
    /// in order of memory, where looking for each entry's twin jumps about.
    pub balance: u64,
    /// Those that name others than members.
    pub torn: Vec<Vertex>,
    /// Those whose rings have gaps.
    pub with_gaps: Vec<Vertex>,
    /// Those that are nowhere.
    pub not_finite: Vec<Vertex>,
    /// How many have each valence.
    pub valences: Histogram,
}

impl Survey {
    /// Cost: linear, on all threads.
    pub(super) fn new(mesh: &Mesh, members: &Members, stop: &Stop) -> Result<Self, Stopped> {
        let parts = in_pieces(mesh, stop, |range| Self::of(mesh, members, range))?;
        Ok(parts.into_iter().fold(Self::default(), Self::and))
    }

    /// Of two ranges of vertices, the older ones first.
    fn and(mut self, mut other: Self) -> Self {
        self.entries += other.entries;
        self.balance = self.balance.wrapping_add(other.balance);
        self.torn.append(&mut other.torn);
        self.with_gaps.append(&mut other.with_gaps);
        self.not_finite.append(&mut other.not_finite);
        self.valences.add(other.valences);
        self
    }

    fn of(mesh: &Mesh, members: &Members, range: Range<usize>) -> Self {
        let mut survey = Self::default();
        let slots = mesh.slots();
        let arrays = mesh.heads()[range.clone()].iter().zip(&mesh.positions()[range.clone()]);
        for (v, (head, position)) in range.filter_map(Vertex::from_index).zip(arrays) {
            if !members.contains(v) {
                continue;
            }
            let ring = slots.get(head.range()).unwrap_or(&[]);
            let mut entries = 0;
            let mut outside = 0;
            for &x in ring.iter().flatten() {
                if members.contains(x) {
                    entries += 1;
                    let h = if v < x { mix(v, x) } else { mix(x, v).wrapping_neg() };
                    survey.balance = survey.balance.wrapping_add(h);
                } else {
                    outside += 1;
                }
            }
            survey.entries += entries;
            survey.valences.count(entries + outside);
            if outside > 0 {
                survey.torn.push(v);
            }
            if matches!(ring.last(), Some(None)) {
                survey.with_gaps.push(v);
            }
            if !position.is_finite() {
                survey.not_finite.push(v);
            }
        }
        survey
    }
}

/// Does something with all vertices of the universe, piece by piece, on all threads; the results are in order.
pub(super) fn in_pieces<T: Send>(
    mesh: &Mesh,
    stop: &Stop,
    work: impl Fn(Range<usize>) -> T + Sync,
) -> Result<Vec<T>, Stopped> {
    const PIECE: usize = 1 << 14;
    let n = mesh.vertex_count();
    let piece = |i: usize| {
        stop.check()?;
        Ok(work(i * PIECE..n.min((i + 1) * PIECE)))
    };
    stop.check()?;
    if n <= PIECE {
        return Ok(vec![piece(0)?]); // not worth to wake anybody
    }
    (0..n.div_ceil(PIECE)).into_par_iter().map(piece).collect()
}

/// The finalizer of splitmix64 over both numbers.
fn mix(u: Vertex, v: Vertex) -> u64 {
    let x = ((u.index() as u64) << 32 | v.index() as u64).wrapping_add(0x9E37_79B9_7F4A_7C15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}

/// How often each number occurs.
#[derive(Default)]
pub(super) struct Histogram {
    small: [usize; 16],
    large: BTreeMap<usize, usize>,
}

impl Histogram {
    pub(super) fn count(&mut self, x: usize) {
        match self.small.get_mut(x) {
            Some(n) => *n += 1,
            None => *self.large.entry(x).or_insert(0) += 1,
        }
    }

    pub(super) fn add(&mut self, other: Self) {
        self.small.iter_mut().zip(other.small).for_each(|(n, more)| *n += more);
        other.large.into_iter().for_each(|(x, n)| *self.large.entry(x).or_insert(0) += n);
    }

    /// How often 0 occurs.
    pub(super) fn zeros(&self) -> usize {
        self.small[0]
    }

    /// How many numbers were counted.
    pub(super) fn total(&self) -> usize {
        self.small.iter().chain(self.large.values()).sum()
    }

    /// The numbers that occur, ascending, each with how often.
    pub(super) fn into_pairs(self) -> Vec<(usize, usize)> {
        self.small.into_iter().enumerate().filter(|&(_, n)| n > 0).chain(self.large).collect()
    }
}
