//! Faces as Edmonds' orbits.
//!
//! The rule, for rings counter-clockwise: **from u→v go on to v→w, w = prevto u in v**. It walks each polygon
//! counter-clockwise and keeps it on the left:
//!
//! ```text
//!       v ←────── u          ring of v, counter-clockwise: … w u …
//!        ╲  face             coming from u, the neighbour before u is the sharpest left turn
//!         ╲
//!          ↘ w
//! ```
//!
//! The paper's rule, from (u, v) go on to (v, nextto u in v), gives the same polygons read backwards. *Proof.* Call the
//! paper's step φ(u, v) = (v, next_v u), ours ψ(u, v) = (v, prev_v u), and let r(u, v) = (v, u). Undoing our step,
//! ψ⁻¹(v, w) = (next_v w, v), so r ψ⁻¹ r (w, v) = r ψ⁻¹(v, w) = r(next_v w, v) = (v, next_v w) = φ(w, v). Hence
//! φ = r ψ⁻¹ r: the orbits of φ are those of ψ with every edge reversed, in reversed order. ∎

use rustc_hash::FxHashMap;

use super::finder::{Beside, Finder};
use super::members::Members;
use super::survey::Histogram;
use super::{Mesh, Vertex, VertexSet};
use crate::stop::{Stop, Stopped};

/// Orbits up to this long are walked from each of their corners; only longer ones leave marks.
const SHORT: usize = 8;

/// Slots that have a bit of their own in a [`Walker::left`].
const BITS: u32 = 8;

/// The slot is told by [`Walker::far`].
const FAR: u16 = 0xff;

/// The polygons of a mesh, flat: all corners one after the other.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Faces {
    corners: Vec<Vertex>,
    /// End of each face in `corners`.
    ends: Vec<u32>,
}

impl Faces {
    /// How many faces.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether no orbit is a face.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The corners of face `index`, counter-clockwise seen from outside; empty past the end.
    #[must_use]
    pub fn get(&self, index: usize) -> &[Vertex] {
        let Some(&end) = self.ends.get(index) else { return &[] };
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        &self.corners[start as usize..end as usize]
    }

    /// The faces in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[Vertex]> {
        (0..self.len()).map(|i| self.get(i))
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.corners.capacity() * size_of::<Vertex>() + self.ends.capacity() * size_of::<u32>()
    }

    /// The corners of all faces, and where each face ends among them.
    pub(crate) fn into_parts(self) -> (Vec<Vertex>, Vec<u32>) {
        (self.corners, self.ends)
    }

    /// All corners of all faces.
    #[must_use]
    pub fn corners(&self) -> &[Vertex] {
        &self.corners
    }
}

/// How many corners faces have, without the faces.
#[derive(Default)]
pub struct Degrees(pub(super) Histogram);

impl Degrees {
    /// How many faces have each number of corners, ascending.
    #[must_use]
    pub fn into_pairs(self) -> Vec<(usize, usize)> {
        self.0.into_pairs()
    }
}

impl From<&Faces> for Degrees {
    fn from(faces: &Faces) -> Self {
        let mut degrees = Histogram::default();
        faces.iter().for_each(|face| degrees.count(face.len()));
        Self(degrees)
    }
}

/// What is kept of faces.
trait Keep {
    /// Makes room for those of a mesh with so many slots: room that is not needed is never touched.
    fn for_slots(slots: usize) -> Self;

    fn face(&mut self, corners: impl ExactSizeIterator<Item = Vertex>);
}

impl Keep for Faces {
    fn for_slots(slots: usize) -> Self {
        Self { corners: Vec::with_capacity(slots), ends: Vec::with_capacity(slots / 3) }
    }

    #[inline(always)]
    fn face(&mut self, corners: impl ExactSizeIterator<Item = Vertex>) {
        self.corners.extend(corners);
        self.ends.push(self.corners.len() as u32);
    }
}

impl Keep for Degrees {
    fn for_slots(_: usize) -> Self {
        Self::default()
    }

    #[inline(always)]
    fn face(&mut self, corners: impl ExactSizeIterator<Item = Vertex>) {
        self.0.count(corners.len());
    }
}

/// The faces of the set of `mesh`, see [`faces_of`].
///
/// # Errors
/// When stopped.
pub fn faces(mesh: &Mesh, stop: &Stop) -> Result<Faces, Stopped> {
    faces_of(mesh, &mesh.set, stop)
}

/// How many corners the faces of the set of `mesh` have: as [`faces`] finds them, in no memory of their own.
///
/// # Errors
/// When stopped.
pub fn degrees(mesh: &Mesh, stop: &Stop) -> Result<Degrees, Stopped> {
    find(mesh, &mesh.set, stop)
}

/// The faces of a set of vertices: the orbits that meet no gap and no incomplete neighbour, which is one that does not
/// name the vertex that names it, or stands outside the set. An edge that is a component by itself, `{q}` at p and
/// `{p}` at q, has one orbit of two corners; it counts, so that V − E + F = 2 holds there too. A vertex without
/// neighbours has none.
///
/// The order is that of the vertices' creation: each face begins at its oldest corner, and the faces that begin at one
/// vertex follow its ring, from the corner of the first face that met the vertex before, else from the start of the
/// ring. Reading a file starts rings the same way ([`super::build`]), so faces that were written and read come out the
/// same.
///
/// Cost: linear, also with vertices of high valence (there O(log valence) per slot).
///
/// # Errors
/// When stopped.
pub fn faces_of(mesh: &Mesh, set: &VertexSet, stop: &Stop) -> Result<Faces, Stopped> {
    find(mesh, set, stop)
}

fn find<K: Keep>(mesh: &Mesh, set: &VertexSet, stop: &Stop) -> Result<K, Stopped> {
    let mut walker = Walker::new(mesh, Members::new(set, mesh.vertex_count()));
    for v in mesh.vertices() {
        stop.check()?;
        if walker.members.contains(v) {
            walker.add_faces_from(v, stop)?;
        }
    }
    Ok(walker.faces)
}

/// Finds the faces of one vertex after the other: those of which it is the oldest corner.
///
/// The face on the left of v→x begins at v only if x and the neighbour that follows x are younger than v, for the face
/// comes back from there: one comparison of all slots tells. In a triangle each of the two stands beside v in the other's
/// ring, in a quad the same vertex does in both.
struct Walker<'a, K> {
    finder: Finder<'a>,
    members: Members,
    faces: K,
    /// For each vertex the slots at which faces leave it that were found from older corners, a bit for each of the first
    /// [`BITS`]; above them the slot of the first of these faces, from 1, or [`FAR`].
    left: Vec<u16>,
    /// The slots of first faces behind [`BITS`].
    far: FxHashMap<Vertex, u32>,
    /// The orbit in hand: each corner with the slot by which it is left.
    path: Vec<(Vertex, u32)>,
    /// Slots of the arena that long walks have passed; empty while there was none.
    visited: Vec<bool>,
}

impl<'a, K: Keep> Walker<'a, K> {
    fn new(mesh: &'a Mesh, members: Members) -> Self {
        let heads = mesh.vertices().zip(mesh.heads()).filter(|&(v, _)| members.contains(v));
        let slots = heads.map(|(_, head)| head.len as usize).sum();
        Self {
            finder: Finder::new(mesh),
            members,
            faces: K::for_slots(slots),
            left: vec![0; mesh.vertex_count()],
            far: FxHashMap::default(),
            path: Vec::new(),
            visited: Vec::new(),
        }
    }

    fn add_faces_from(&mut self, v: Vertex, stop: &Stop) -> Result<(), Stopped> {
        let Some(ring) = self.finder.short(v) else { return self.add_faces_from_long(v, stop) };
        let left = self.left[v.index()];
        let pairs = ring.younger_pairs(v) & !u32::from(left);
        if pairs == 0 {
            return Ok(());
        }
        let from_first = u32::MAX << (left >> BITS).saturating_sub(1);
        for mut pairs in [pairs & from_first, pairs & !from_first] {
            while pairs != 0 {
                let i = pairs.trailing_zeros();
                pairs &= pairs - 1;
                if let (Some(x), Some(w)) = (ring.slot(i), ring.slot(ring.after(i))) {
                    self.add_face((v, i), x, w, stop)?;
                }
            }
        }
        Ok(())
    }

    #[inline(never)]
    fn add_faces_from_long(&mut self, v: Vertex, stop: &Stop) -> Result<(), Stopped> {
        let ring = self.finder.ring(v);
        let start = match self.left[v.index()] >> BITS {
            FAR => self.far.get(&v).map_or(0, |&slot| slot as usize),
            slot => usize::from(slot.saturating_sub(1)),
        };
        for i in (start..ring.len()).chain(0..start) {
            let next = if i + 1 == ring.len() { 0 } else { i + 1 };
            if let (Some(x), Some(w)) = (ring[i], ring[next])
                && x > v
                && w > v
            {
                self.add_face((v, i as u32), x, w, stop)?;
            }
        }
        Ok(())
    }

    /// Adds the orbit that leaves `v` by a slot for `x` and would come back from `w`, both younger, if it is a face and `v`
    /// its oldest corner.
    #[inline]
    fn add_face(&mut self, (v, leaves_v): (Vertex, u32), x: Vertex, w: Vertex, stop: &Stop) -> Result<(), Stopped> {
        if !self.members.contains(x) || !self.members.contains(w) {
            return Ok(());
        }
        let (Some(ring_x), Some(ring_w)) = (self.finder.short(x), self.finder.short(w)) else {
            return self.add_face_beside_long((v, leaves_v), x, w, stop);
        };
        let (Some(at_x), Some(at_w)) = (ring_x.find(v), ring_w.find(v)) else { return Ok(()) };
        let (at_x, at_w) = (ring_x.beside(at_x), ring_w.beside(at_w));
        // Gaps are less than every vertex. An older corner has this face already, if it is one.
        if (at_x.previous < Some(v)) | (at_w.next < Some(v)) {
            return Ok(());
        }
        if at_x.previous == Some(w) && at_w.next == Some(x) && x != w {
            self.add([v, x, w], [leaves_v, at_x.before, at_w.place]);
            return Ok(());
        }
        if let Some(y) = at_x.previous
            && at_w.next == Some(y)
            && y != v
            && y != w
            && self.members.contains(y)
            && let Some(ring_y) = self.finder.short(y)
            && let Some(at_y) = ring_y.find(x)
            && let at_y = ring_y.beside(at_y)
            && at_y.previous == Some(w)
        {
            self.add([v, x, y, w], [leaves_v, at_x.before, at_y.before, at_w.place]);
            return Ok(());
        }
        self.add_long_face((v, leaves_v), (x, at_x), (w, at_w), stop)
    }

    /// As [`Walker::add_face`], where one of the two has a long ring.
    #[inline(never)]
    fn add_face_beside_long(&mut self, v: (Vertex, u32), x: Vertex, w: Vertex, stop: &Stop) -> Result<(), Stopped> {
        match (self.finder.beside(v.0, x), self.finder.beside(v.0, w)) {
            (Some(at_x), Some(at_w)) => self.add_long_face(v, (x, at_x), (w, at_w), stop),
            _ => Ok(()),
        }
    }

    /// As [`Walker::add_face`], for an orbit of any corners.
    #[inline(never)]
    fn add_long_face(
        &mut self,
        (v, leaves_v): (Vertex, u32),
        (x, at_x): (Vertex, Beside),
        (w, at_w): (Vertex, Beside),
        stop: &Stop,
    ) -> Result<(), Stopped> {
        self.path.clear();
        self.path.extend([(v, leaves_v), (x, at_x.before)]);
        let is_face = match self.walk_short((w, at_w), at_x.previous) {
            Walk::Face => true,
            Walk::NoFace => false,
            Walk::Long => self.walk_long(v, leaves_v, stop)?,
        };
        if is_face {
            self.faces.face(self.path.iter().map(|&(corner, _)| corner));
            for i in 0..self.path.len() {
                let (corner, slot) = self.path[i];
                self.leave(corner, slot);
            }
        }
        Ok(())
    }

    /// Walks on to `to` from the end of the path, which began at its oldest corner, until the corner `last`, from which
    /// the walk goes back to the beginning.
    fn walk_short(&mut self, last: (Vertex, Beside), mut to: Option<Vertex>) -> Walk {
        let (w, at_w) = last;
        let oldest = self.path[0].0;
        loop {
            let Some(&(u, _)) = self.path.last() else { return Walk::NoFace };
            let Some(c) = to else { return Walk::NoFace };
            if c == w && at_w.next == Some(u) {
                self.path.push((w, at_w.place));
                return Walk::Face;
            }
            // An older corner has this face already, if it is one.
            if c < oldest || !self.members.contains(c) {
                return Walk::NoFace;
            }
            if c == oldest || self.path.len() >= SHORT {
                return Walk::Long;
            }
            let Some(side) = self.finder.beside(u, c) else { return Walk::NoFace };
            self.path.push((c, side.before));
            to = side.previous;
        }
    }

    /// Walks from slot `start` of `v`, marks what it meets, and says whether it came back. The step is injective, so a
    /// walk that meets an earlier one ran into the middle of a walk that ends, or has been here before.
    fn walk_long(&mut self, v: Vertex, start: u32, stop: &Stop) -> Result<bool, Stopped> {
        if self.visited.is_empty() {
            self.visited = vec![false; self.finder.slot_count()];
        }
        self.path.clear();
        let (mut u, mut slot) = (v, start);
        loop {
            let mark = &mut self.visited[self.finder.arena_slot(u, slot)];
            if std::mem::replace(mark, true) {
                return Ok(false);
            }
            self.path.push((u, slot));
            if self.path.len().is_multiple_of(4096) {
                stop.check()?;
            }
            let Some(c) = self.finder.ring(u)[slot as usize] else { return Ok(false) };
            // An older corner has this face already, if it is one.
            if c < v || !self.members.contains(c) {
                return Ok(false);
            }
            let Some(side) = self.finder.beside(u, c) else { return Ok(false) };
            (u, slot) = (c, side.before);
            if (u, slot) == (v, start) {
                return Ok(true);
            }
        }
    }

    /// Adds a face, whose corners are left by these slots.
    #[inline(always)]
    fn add<const N: usize>(&mut self, corners: [Vertex; N], slots: [u32; N]) {
        self.faces.face(corners.into_iter());
        for i in 0..N {
            self.leave(corners[i], slots[i]);
        }
    }

    /// Notes that a face leaves a corner by a slot.
    #[inline(always)]
    fn leave(&mut self, corner: Vertex, slot: u32) {
        let left = &mut self.left[corner.index()];
        let is_first = *left >> BITS == 0;
        if slot >= BITS {
            if is_first {
                *left |= FAR << BITS;
                self.far.insert(corner, slot);
            }
            return;
        }
        let first = if is_first { (slot as u16 + 1) << BITS } else { 0 };
        *left |= first | 1 << slot;
    }
}

/// What has become of a walk.
enum Walk {
    /// It came back: the path is a face.
    Face,
    /// It met a gap, an incomplete neighbour or an older corner.
    NoFace,
    /// It is long, or passes its oldest corner more than once.
    Long,
}
