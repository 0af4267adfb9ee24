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

use super::finder::Finder;
use super::members::Members;
use super::{Mesh, Vertex, VertexSet};
use crate::stop::{Stop, Stopped};

/// Orbits up to this long are walked from each of their corners; only longer ones leave marks.
const SHORT: usize = 8;

/// No slot.
const NONE: u32 = u32::MAX;

/// The polygons of a mesh, flat: all corners one after the other.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Faces {
    corners: Vec<Vertex>,
    /// End of each face in `corners`.
    ends: Vec<u32>,
}

impl Faces {
    /// How many.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is none.
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

/// The faces of the set of `mesh`, see [`faces_of`].
///
/// # Errors
/// When stopped.
pub fn faces(mesh: &Mesh, stop: &Stop) -> Result<Faces, Stopped> {
    faces_of(mesh, &mesh.set, stop)
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
/// comes back from there. Their places for v are looked up once, and a triangle is seen by comparing what stands beside
/// them: each pair of neighbours is looked up once, as knowing all twins would take, but nothing is stored.
struct Walker<'a> {
    finder: Finder<'a>,
    members: Members,
    faces: Faces,
    /// For each vertex the slot at which its first face leaves it, or [`NONE`].
    first: Vec<u32>,
    /// For each slot of the vertex in hand that holds a younger one its place there.
    places: Vec<u32>,
    /// The orbit in hand: each corner with the slot by which it is left.
    path: Vec<(Vertex, u32)>,
    /// Slots of the arena that long walks have passed; empty while there was none.
    visited: Vec<bool>,
}

impl<'a> Walker<'a> {
    fn new(mesh: &'a Mesh, members: Members) -> Self {
        let slots = mesh.vertices().filter(|&v| members.contains(v)).map(|v| mesh.ring(v).slots().len()).sum();
        Self {
            finder: Finder::new(mesh),
            members,
            // Room that is not needed is never touched.
            faces: Faces { corners: Vec::with_capacity(slots), ends: Vec::with_capacity(slots / 3) },
            first: vec![NONE; mesh.vertex_count()],
            places: Vec::new(),
            path: Vec::new(),
            visited: Vec::new(),
        }
    }

    fn add_faces_from(&mut self, v: Vertex, stop: &Stop) -> Result<(), Stopped> {
        let ring = self.finder.ring(v);
        // One after the other, so that the processor can wait for many at once.
        self.places.clear();
        self.places.extend(ring.iter().map(|&slot| match slot {
            Some(x) if x > v && self.members.contains(x) => self.finder.find(v, x).unwrap_or(NONE),
            _ => NONE,
        }));
        let start = match self.first[v.index()] {
            NONE => 0,
            slot => slot as usize,
        };
        for i in (start..ring.len()).chain(0..start) {
            let next = if i + 1 == ring.len() { 0 } else { i + 1 };
            let (Some(x), Some(w)) = (ring[i], ring[next]) else { continue };
            let (at_x, at_w) = (self.places[i], self.places[next]);
            if at_x == NONE || at_w == NONE {
                continue;
            }
            let (leaves_x, to) = before(self.finder.ring(x), at_x);
            let from = after(self.finder.ring(w), at_w);
            // Gaps are less than every vertex. An older corner has this face already, if it is one.
            if (to < Some(v)) | (from < Some(v)) {
                continue;
            }
            if to == Some(w) && from == Some(x) && x != w {
                self.add(&[(v, i as u32), (x, leaves_x), (w, at_w)]);
                continue;
            }
            self.path.clear();
            self.path.extend([(v, i as u32), (x, leaves_x)]);
            match self.walk_short((w, at_w), to) {
                Walk::Face => {
                    let path = std::mem::take(&mut self.path);
                    self.add(&path);
                    self.path = path;
                }
                Walk::NoFace => {}
                Walk::Long => {
                    if self.walk_long(v, i as u32, stop)? {
                        let path = std::mem::take(&mut self.path);
                        self.add(&path);
                        self.path = path;
                    }
                }
            }
        }
        Ok(())
    }

    /// Walks on to `to` from the end of the path, which began at its oldest corner, until the corner `last`, from which
    /// the walk goes back to the beginning by that slot.
    fn walk_short(&mut self, last: (Vertex, u32), mut to: Option<Vertex>) -> Walk {
        let (w, at_w) = last;
        let oldest = self.path[0].0;
        loop {
            let Some(&(u, _)) = self.path.last() else { return Walk::NoFace };
            let Some(c) = to else { return Walk::NoFace };
            if c == w && after(self.finder.ring(w), at_w) == Some(u) {
                self.path.push(last);
                return Walk::Face;
            }
            // An older corner has this face already, if it is one.
            if c < oldest || !self.members.contains(c) {
                return Walk::NoFace;
            }
            if c == oldest || self.path.len() >= SHORT {
                return Walk::Long;
            }
            let Some(place) = self.finder.find(u, c) else { return Walk::NoFace };
            let (leaves, next) = before(self.finder.ring(c), place);
            self.path.push((c, leaves));
            to = next;
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
            let Some(place) = self.finder.find(u, c) else { return Ok(false) };
            (u, slot) = (c, before(self.finder.ring(c), place).0);
            if (u, slot) == (v, start) {
                return Ok(true);
            }
        }
    }

    fn add(&mut self, path: &[(Vertex, u32)]) {
        self.faces.corners.extend(path.iter().map(|&(corner, _)| corner));
        self.faces.ends.push(self.faces.corners.len() as u32);
        for &(corner, slot) in path {
            let first = &mut self.first[corner.index()];
            *first = if *first == NONE { slot } else { *first };
        }
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

/// The slot before `i` in a ring, and what stands there.
fn before(ring: &[Option<Vertex>], i: u32) -> (u32, Option<Vertex>) {
    let before = if i == 0 { ring.len() as u32 - 1 } else { i - 1 };
    (before, ring[before as usize])
}

/// What stands after slot `i` in a ring.
fn after(ring: &[Option<Vertex>], i: u32) -> Option<Vertex> {
    let after = i as usize + 1;
    ring[if after == ring.len() { 0 } else { after }]
}
