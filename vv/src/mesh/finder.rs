//! Finds vertices in rings.

use rustc_hash::FxHashMap;

use super::{Head, Mesh, Vertex};

/// Rings up to this long are searched by going through them; longer ones have an index.
const SHORT: u32 = 64;

/// This many slots are compared at once.
const AT_ONCE: usize = 8;

/// Finds vertices in rings in O(log valence), where [`super::Ring::find`] takes O(valence): a fan of *n* triangles
/// asks its hub *n* times.
pub(super) struct Finder<'a> {
    heads: &'a [Head],
    slots: &'a [Option<Vertex>],
    /// For each long ring its vertices in order of creation, each with its slot. Only ever asked, never iterated.
    long: FxHashMap<Vertex, Vec<(Vertex, u32)>>,
}

impl<'a> Finder<'a> {
    /// Cost: a pass over the heads, and sorting the long rings.
    pub(super) fn new(mesh: &'a Mesh) -> Self {
        let mut long = FxHashMap::default();
        if mesh.heads().iter().any(|head| head.len > SHORT) {
            for v in mesh.vertices().filter(|v| mesh.heads()[v.index()].len > SHORT) {
                let slots = mesh.ring(v).slots();
                let mut index: Vec<_> = (0..).zip(slots).filter_map(|(i, x)| x.map(|x| (x, i))).collect();
                index.sort_unstable();
                long.insert(v, index);
            }
        }
        Self { heads: mesh.heads(), slots: mesh.slots(), long }
    }

    /// The ring of `v`; empty for a vertex of another universe.
    pub(super) fn ring(&self, v: Vertex) -> &'a [Option<Vertex>] {
        let Some(head) = self.heads.get(v.index()) else { return &[] };
        self.slots.get(head.range()).unwrap_or(&[])
    }

    /// How many slots the arena has.
    pub(super) fn slot_count(&self) -> usize {
        self.slots.len()
    }

    /// Where slot `i` of the ring of `v` lies in the arena.
    pub(super) fn arena_slot(&self, v: Vertex, i: u32) -> usize {
        self.heads[v.index()].offset as usize + i as usize
    }

    /// The slot of `x` in the ring of `v`.
    #[inline]
    pub(super) fn find(&self, x: Vertex, v: Vertex) -> Option<u32> {
        let head = self.heads.get(v.index())?;
        // Without a branch for each slot, whose outcome nobody can foretell. What lies behind a short ring is another's.
        if head.len as usize <= AT_ONCE
            && let Some(slots) = self.slots.get(head.offset as usize..)
            && let Some(slots) = slots.first_chunk::<AT_ONCE>()
        {
            let mut hits = 0u32;
            for (i, &slot) in slots.iter().enumerate() {
                hits |= u32::from(slot == Some(x)) << i;
            }
            let i = hits.trailing_zeros();
            return (i < head.len).then_some(i);
        }
        self.find_in_long(x, v)
    }

    #[inline(never)]
    fn find_in_long(&self, x: Vertex, v: Vertex) -> Option<u32> {
        let ring = self.ring(v);
        if ring.len() <= SHORT as usize {
            return ring.iter().position(|&slot| slot == Some(x)).map(|i| i as u32);
        }
        let index = self.long.get(&v)?;
        let i = index.binary_search_by_key(&x, |&(y, _)| y).ok()?;
        Some(index[i].1)
    }
}
