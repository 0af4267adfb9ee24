//! Where each slot's opposite stands: for `u` naming `v`, the place at which `v` names `u`.

use rustc_hash::FxHashMap;

use super::{Mesh, Vertex, VertexSet};
use crate::stop::{Stop, Stopped};

/// Rings up to this long are searched by going through them; longer ones have an index.
const SHORT: usize = 64;

/// Marks a slot without a twin: a gap, or a neighbour that does not answer.
pub(super) const NONE: u32 = u32::MAX;

/// Finds vertices in rings in O(log valence), where [`super::Ring::find`] takes O(valence): a fan of *n* triangles
/// asks its hub *n* times.
pub(super) struct Finder<'a> {
    mesh: &'a Mesh,
    /// For each long ring its vertices in order of creation, each with its slot. Only ever asked, never iterated.
    long: FxHashMap<Vertex, Vec<(Vertex, usize)>>,
}

impl<'a> Finder<'a> {
    pub(super) fn new(mesh: &'a Mesh) -> Self {
        let mut long = FxHashMap::default();
        for v in mesh.vertices() {
            let slots = mesh.ring(v).slots();
            if slots.len() > SHORT {
                let mut index: Vec<_> = slots.iter().enumerate().filter_map(|(i, x)| x.map(|x| (x, i))).collect();
                index.sort_unstable();
                long.insert(v, index);
            }
        }
        Self { mesh, long }
    }

    /// The slot of `x` in the ring of `v`.
    pub(super) fn find(&self, x: Vertex, v: Vertex) -> Option<usize> {
        let slots = self.mesh.ring(v).slots();
        if slots.len() <= SHORT {
            return slots.iter().position(|&y| y == Some(x));
        }
        let index = self.long.get(&v)?;
        let i = index.binary_search_by_key(&x, |&(y, _)| y).ok()?;
        Some(index[i].1)
    }
}

/// The rings of the set laid out flat, with the twin of each slot.
pub(super) struct Twins {
    /// First slot of each vertex of the universe, and the end: vertices outside the set have none.
    starts: Vec<u32>,
    /// What stands in each slot; neighbours outside the set are kept as they are.
    pub(super) targets: Vec<Option<Vertex>>,
    /// The slot at the other end that names this one's owner, or [`NONE`].
    pub(super) twins: Vec<u32>,
}

impl Twins {
    /// O(slots), but O(log valence) more in rings longer than some sixty.
    pub(super) fn new(mesh: &Mesh, set: &VertexSet, stop: &Stop) -> Result<Self, Stopped> {
        let n = mesh.vertex_count();
        let mut member = vec![false; n];
        for v in set.iter().filter(|v| v.index() < n) {
            member[v.index()] = true;
        }
        let mut starts = Vec::with_capacity(n + 1);
        let mut targets = Vec::new();
        for v in mesh.vertices() {
            starts.push(targets.len() as u32);
            if member[v.index()] {
                targets.extend_from_slice(mesh.ring(v).slots());
            }
        }
        starts.push(targets.len() as u32);
        let finder = Finder::new(mesh);
        let mut twins = vec![NONE; targets.len()];
        for v in mesh.vertices() {
            stop.check()?;
            for s in starts[v.index()]..starts[v.index() + 1] {
                // Each pair is found from its older end.
                if let Some(x) = targets[s as usize]
                    && v < x
                    && x.index() < n
                    && member[x.index()]
                    && let Some(i) = finder.find(v, x)
                {
                    let twin = starts[x.index()] + i as u32;
                    twins[s as usize] = twin;
                    twins[twin as usize] = s;
                }
            }
        }
        Ok(Self { starts, targets, twins })
    }

    /// The slots of `v`.
    pub(super) fn slots(&self, v: Vertex) -> std::ops::Range<u32> {
        self.starts[v.index()]..self.starts[v.index() + 1]
    }

    /// The slot before `s` in the ring of its owner `v`.
    pub(super) fn previous(&self, s: u32, v: Vertex) -> u32 {
        let range = self.slots(v);
        if s == range.start { range.end - 1 } else { s - 1 }
    }

    /// The slot after `s` in the ring of its owner `v`.
    pub(super) fn next(&self, s: u32, v: Vertex) -> u32 {
        let range = self.slots(v);
        if s + 1 == range.end { range.start } else { s + 1 }
    }
}
