//! What a pass over all rings in order of memory tells, for closing, validating and counting.

use std::collections::BTreeMap;

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
    /// Cost: linear.
    pub(super) fn new(mesh: &Mesh, members: &Members, stop: &Stop) -> Result<Self, Stopped> {
        let mut survey = Self::default();
        let slots = mesh.slots();
        for (v, (head, position)) in mesh.vertices().zip(mesh.heads().iter().zip(mesh.positions())) {
            stop.check()?;
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
        Ok(survey)
    }
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
