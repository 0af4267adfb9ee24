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

use super::twins::{NONE, Twins};
use super::{Mesh, Vertex, VertexSet};
use crate::stop::{Stop, Stopped};

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
    let links = Twins::new(mesh, set, stop)?;
    let mut faces = Faces::default();
    let mut visited = vec![false; links.targets.len()];
    let mut first = vec![NONE; mesh.vertex_count()]; // the slot at which the first face leaves the vertex
    let mut path = Vec::new();
    for v in mesh.vertices() {
        stop.check()?;
        let range = links.slots(v);
        let mut s = match first[v.index()] {
            NONE => range.start,
            s => s,
        };
        for _ in range {
            if !visited[s as usize] && walk(&links, s, v, &mut visited, &mut path, stop)? {
                for &(corner, slot) in &path {
                    faces.corners.push(corner);
                    if first[corner.index()] == NONE {
                        first[corner.index()] = slot;
                    }
                }
                faces.ends.push(faces.corners.len() as u32);
            }
            s = links.next(s, v);
        }
    }
    Ok(faces)
}

/// Walks on from slot `s` of `v`, marks what it meets, and says whether it came back: `path` is then the orbit, each
/// corner with the slot by which it is left. The step is injective, so a walk that meets an earlier one ran into the
/// middle of a walk that ends.
fn walk(
    links: &Twins,
    start: u32,
    v: Vertex,
    visited: &mut [bool],
    path: &mut Vec<(Vertex, u32)>,
    stop: &Stop,
) -> Result<bool, Stopped> {
    path.clear();
    let (mut s, mut v) = (start, v);
    loop {
        let Some(next) = links.targets[s as usize] else { return Ok(false) };
        visited[s as usize] = true;
        path.push((v, s));
        if path.len().is_multiple_of(4096) {
            stop.check()?;
        }
        let twin = links.twins[s as usize];
        if twin == NONE {
            return Ok(false);
        }
        (s, v) = (links.previous(twin, next), next);
        if s == start {
            return Ok(true);
        }
        if visited[s as usize] {
            return Ok(false);
        }
    }
}
