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
    /// Slots that rings use, gaps included.
    pub slots: usize,
    /// Entries that name members.
    pub entries: usize,
    /// Sum over these entries: an entry v→x counts f(v) f(x) (f(x) − f(v)), for a function f that scatters, and its twin
    /// x→v as much with the other sign. As no ring names a vertex twice, it is 0 where all pairs answer, and otherwise 0
    /// by a chance of about 2⁻⁶⁰. Powers of f(x) are summed round a ring, so that it takes one pass in order of memory,
    /// where looking for each entry's twin jumps about.
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
        if let Members::From(1, _) = members {
            // Everything that exists is a member. What does not exist has no ring that answers: where one names it, the
            // entries do not balance.
            let survey = Self::sum(in_pieces(mesh, stop, |range| Self::of(mesh, range, |_| true))?);
            if survey.balance == 0 {
                return Ok(survey);
            }
        }
        Ok(Self::sum(in_pieces(mesh, stop, |range| Self::of(mesh, range, |v| members.contains(v)))?))
    }

    fn sum(parts: Vec<Self>) -> Self {
        parts.into_iter().fold(Self::default(), Self::and)
    }

    /// Of two ranges of vertices, the older ones first.
    fn and(mut self, mut other: Self) -> Self {
        self.slots += other.slots;
        self.entries += other.entries;
        self.balance = self.balance.wrapping_add(other.balance);
        self.torn.append(&mut other.torn);
        self.with_gaps.append(&mut other.with_gaps);
        self.not_finite.append(&mut other.not_finite);
        self.valences.add(other.valences);
        self
    }

    fn of(mesh: &Mesh, range: Range<usize>, is_member: impl Fn(Vertex) -> bool) -> Self {
        let mut survey = Self::default();
        let (mut balance, mut used, mut others, mut gaps) = (0_u64, 0, 0, 0);
        let slots = mesh.slots();
        let vertices = range.clone().filter_map(Vertex::from_index);
        for ((v, head), position) in vertices.zip(&mesh.heads()[range.clone()]).zip(&mesh.positions()[range]) {
            if !is_member(v) {
                continue;
            }
            let ring = &slots[head.range()];
            let (mut sum, mut squares, mut outside) = (0_u64, 0_u64, 0);
            for &slot in ring {
                let is_other = slot.is_some_and(|x| !is_member(x));
                outside += usize::from(is_other);
                // Others than members count 0, without a branch.
                let x = if is_other { 0 } else { scattered(slot) };
                sum = sum.wrapping_add(x);
                squares = squares.wrapping_add(x.wrapping_mul(x));
            }
            let mut entries = ring.len();
            if let Some(None) = ring.last() {
                survey.with_gaps.push(v);
                entries = ring.iter().flatten().count();
                gaps += ring.len() - entries;
                let (x, times) = (scattered(None), (ring.len() - entries) as u64);
                sum = sum.wrapping_sub(x.wrapping_mul(times));
                squares = squares.wrapping_sub(x.wrapping_mul(x).wrapping_mul(times));
            }
            let f = scattered(Some(v));
            let differences = squares.wrapping_sub(f.wrapping_mul(sum));
            balance = balance.wrapping_add(f.wrapping_mul(differences));
            used += ring.len();
            survey.valences.count(entries);
            if outside > 0 {
                survey.torn.push(v);
                others += outside;
            }
            if !position.is_finite() {
                survey.not_finite.push(v);
            }
        }
        Self { slots: used, entries: used - gaps - others, balance, ..survey }
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

/// A number for each vertex and for none, in which nothing is left of their order, sums and factors: the two halves of a
/// multiple, some of their bits turned, times each other.
fn scattered(v: Option<Vertex>) -> u64 {
    let multiple = u64::from(v.map_or(0, |v| v.0.get())) * 0x9E37_79B9;
    let turned = multiple ^ 0xBF58_476D_1CE4_E5B9;
    (turned >> 32) * (turned & 0xFFFF_FFFF)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// All ways in which five vertices may name each other.
    #[track_caller]
    fn check(vertices: [usize; 5]) {
        let f = vertices.map(|i| scattered(Vertex::from_index(i)));
        let h = |v: usize, x: usize| f[v].wrapping_mul(f[x]).wrapping_mul(f[x].wrapping_sub(f[v]));
        let mut sums = vec![(0_u64, true)];
        for (i, j) in (0..5).flat_map(|i| (0..i).map(move |j| (i, j))) {
            // Both name each other or neither does, or one does.
            let ways = [(0, true), (h(i, j), false), (h(j, i), false)];
            sums = sums.into_iter().flat_map(|(s, b)| ways.map(|(t, a)| (s.wrapping_add(t), a && b))).collect();
        }
        assert_eq!(sums.len(), 3_usize.pow(10));
        assert!(sums.iter().all(|&(sum, all_answer)| (sum == 0) == all_answer), "{vertices:?}");
    }

    #[test]
    fn rings_balance_only_where_all_pairs_answer() {
        for first in 0..8 {
            check([1, 2, 3, 4, 5].map(|i| first + i));
            check([0, 1, 3, 7, 15].map(|i| (first + 1) * i));
        }
        check([0, 6, 7, 1, 13]); // the seventh and the first make the eighth
        check([1000, 2000, 3000, 4000, 5000]);
        check([0, 1 << 16, 1 << 24, 1 << 31, u32::MAX as usize - 1]);
        for bits in 0..29 {
            check([1, 2, 3, 4, 5].map(|i| (i << bits) - 1)); // what they have in common stands in all three factors
        }
    }

    #[test]
    fn rings_that_name_one_side_everywhere_alike_do_not_balance() {
        for (columns, rows) in [(3, 3), (4, 4), (7, 5), (64, 32), (100, 100)] {
            let at = |i: usize, j: usize| i % rows * columns + j % columns;
            let f = |i, j| scattered(Vertex::from_index(at(i, j)));
            let mut balance = 0_u64;
            for (i, j) in (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))) {
                // Right, up, and back along the diagonal: the numbers in and out of each have one sum.
                for x in [f(i, j + 1), f(i + 1, j), f(i + rows - 1, j + columns - 1)] {
                    let v = f(i, j);
                    balance = balance.wrapping_add(v.wrapping_mul(x).wrapping_mul(x.wrapping_sub(v)));
                }
            }
            assert_ne!(balance, 0, "{columns} × {rows}");
        }
    }
}
