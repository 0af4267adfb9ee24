//! Wires as polylines, each as long as it can be.

use super::super::push_integer;
use crate::mesh::{Mesh, Vertex};

/// Half of a wire.
type Half = (Vertex, Vertex);

/// Writes the wires of a mesh: from ends and where several meet, then those that are closed, in order of their first
/// vertices and there of its ring.
pub(super) fn write(mesh: &Mesh, members: &[Vertex], numbers: &[usize], text: &mut Vec<u8>) {
    let wires = Wires::new(mesh, members);
    let mut written = vec![false; wires.halves.len()];
    let open = (0..wires.halves.len()).filter(|&i| wires.beyond(wires.halves[i].0).is_none());
    for first in open.chain(0..wires.halves.len()) {
        if written[first] {
            continue;
        }
        text.push(b'l');
        let mut point = |v: Vertex| {
            text.push(b' ');
            push_integer(text, numbers[v.index()] + 1);
        };
        point(wires.halves[first].0);
        let mut next = Some(first);
        while let Some(half) = next.filter(|&half| !written[half]) {
            let (from, to) = wires.halves[half];
            point(to);
            written[half] = true;
            if let Some(back) = wires.find(to, from) {
                written[back] = true;
            }
            next = wires.beyond(to).and_then(|both| both.into_iter().find(|&i| !written[i]));
        }
        text.push(b'\n');
    }
}

/// How many wires a mesh has.
pub(in super::super) fn count(mesh: &Mesh) -> usize {
    Wires::new(mesh, &mesh.set.iter().collect::<Vec<_>>()).halves.len() / 2
}

struct Wires {
    /// Those from one vertex stand together, in order of its ring.
    halves: Vec<Half>,
    /// The same, sorted, each with its place.
    sorted: Vec<(Half, usize)>,
    /// For each vertex its first half, if only two wires meet there.
    through: Vec<Option<usize>>,
}

impl Wires {
    fn new(mesh: &Mesh, members: &[Vertex]) -> Self {
        let mut halves = Vec::new();
        for &v in members {
            let slots = mesh.ring(v).slots();
            for (i, &slot) in slots.iter().enumerate() {
                let before = slots[if i == 0 { slots.len() - 1 } else { i - 1 }];
                let after = slots[if i + 1 == slots.len() { 0 } else { i + 1 }];
                if let Some(q) = slot.filter(|&q| before.is_none() && after.is_none() && mesh.set.contains(q)) {
                    halves.push((v, q));
                }
            }
        }
        let sort = |halves: &[Half]| {
            let mut sorted: Vec<_> = halves.iter().copied().zip(0..).collect();
            sorted.sort_unstable();
            sorted
        };
        // A wire has a hole on either side at both ends.
        let all = sort(&halves);
        halves.retain(|&(p, q)| all.binary_search_by_key(&(q, p), |half| half.0).is_ok());
        let mut through = vec![None; mesh.vertex_count()];
        let mut start = 0;
        for both in halves.chunk_by(|g, h| g.0 == h.0) {
            if both.len() == 2 && mesh.ring(both[0].0).valence() == 2 {
                through[both[0].0.index()] = Some(start);
            }
            start += both.len();
        }
        Self { sorted: sort(&halves), halves, through }
    }

    fn find(&self, from: Vertex, to: Vertex) -> Option<usize> {
        let found = self.sorted.binary_search_by_key(&(from, to), |half| half.0).ok()?;
        Some(self.sorted[found].1)
    }

    /// The two halves from a vertex through which a polyline goes on.
    fn beyond(&self, v: Vertex) -> Option<[usize; 2]> {
        self.through[v.index()].map(|first| [first, first + 1])
    }
}
