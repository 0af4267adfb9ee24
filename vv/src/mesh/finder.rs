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
    #[inline(always)]
    pub(super) fn find(&self, x: Vertex, v: Vertex) -> Option<u32> {
        match self.short(v) {
            Some(ring) => ring.find(x),
            None => self.find_in_long(x, v),
        }
    }

    /// Where `x` stands in the ring of `v`, with what stands beside it.
    #[inline(always)]
    pub(super) fn beside(&self, x: Vertex, v: Vertex) -> Option<Beside> {
        match self.short(v) {
            Some(ring) => Some(ring.beside(ring.find(x)?)),
            None => self.beside_in_long(x, v),
        }
    }

    /// The ring of `v` if it is short.
    #[inline(always)]
    pub(super) fn short(&self, v: Vertex) -> Option<ShortRing<'a>> {
        let head = self.heads.get(v.index()).filter(|head| head.len as usize <= AT_ONCE)?;
        let at = head.offset as usize;
        let slots = self.slots.get(at..at + AT_ONCE)?.first_chunk()?;
        Some(ShortRing { slots, len: head.len })
    }

    #[inline(never)]
    fn beside_in_long(&self, x: Vertex, v: Vertex) -> Option<Beside> {
        let ring = self.ring(v);
        let place = self.find_in_long(x, v)?;
        let last = ring.len() as u32 - 1;
        let before = if place == 0 { last } else { place - 1 };
        let after = if place == last { 0 } else { place + 1 };
        Some(Beside { place, before, previous: ring[before as usize], next: ring[after as usize] })
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

/// A vertex in a ring with its neighbours there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beside {
    /// Its slot.
    pub(super) place: u32,
    /// The slot before it.
    pub(super) before: u32,
    /// What stands there.
    pub(super) previous: Option<Vertex>,
    /// What follows.
    pub(super) next: Option<Vertex>,
}

/// A ring whose slots are compared all at once, without a branch for each, whose outcome nobody can foretell.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShortRing<'a> {
    /// What lies behind the ring is another's.
    slots: &'a [Option<Vertex>; AT_ONCE],
    len: u32,
}

impl ShortRing<'_> {
    /// What stands in a slot.
    #[inline(always)]
    pub(super) fn slot(self, i: u32) -> Option<Vertex> {
        self.slots[i as usize % AT_ONCE]
    }

    /// The slot of a vertex.
    #[inline(always)]
    pub(super) fn find(self, x: Vertex) -> Option<u32> {
        let i = bits(self.slots, |y| y == x.0.get()).trailing_zeros();
        (i < self.len).then_some(i)
    }

    /// What stands in a slot, and beside it.
    #[inline(always)]
    pub(super) fn beside(self, place: u32) -> Beside {
        let before = if place == 0 { self.len - 1 } else { place - 1 };
        Beside { place, before, previous: self.slot(before), next: self.slot(self.after(place)) }
    }

    /// The slot after another.
    #[inline(always)]
    pub(super) fn after(self, i: u32) -> u32 {
        if i + 1 == self.len { 0 } else { i + 1 }
    }

    /// The slots whose vertex is younger than `v`, as is the one that follows: a bit for each.
    #[inline(always)]
    pub(super) fn younger_pairs(self, v: Vertex) -> u32 {
        // Gaps are less than every vertex.
        let younger = bits(self.slots, |x| x > v.0.get()) & ((1 << self.len) - 1);
        younger & (younger >> 1 | (younger << self.len) >> 1)
    }
}

/// For which slots, by their numbers (0 is a gap), something holds: a bit for each, and above them others.
#[inline(always)]
fn bits(slots: &[Option<Vertex>; AT_ONCE], holds: impl Fn(u32) -> bool) -> u32 {
    // Two bits each: with one alone compilers see a conversion, and do not compare all slots at once.
    const BITS: [u32; AT_ONCE] = [0x101, 0x202, 0x404, 0x808, 0x1010, 0x2020, 0x4040, 0x8080];
    let of = |i: usize| if holds(slots[i].map_or(0, |v| v.0.get())) { BITS[i] } else { 0 };
    of(0) | of(1) | of(2) | of(3) | of(4) | of(5) | of(6) | of(7)
}
