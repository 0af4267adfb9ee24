//! Counts and invariants of a mesh.

use super::Mesh;
use super::faces::Faces;
use crate::stop::{Stop, Stopped};

/// What a mesh is made of. Counts are over its set.
#[derive(Debug, Clone, Default, PartialEq, Eq, serde::Serialize)]
pub struct Statistics {
    /// Vertices of the set.
    pub vertices: usize,
    /// Unordered pairs of neighbours.
    pub edges: usize,
    /// Edmonds' orbits without gaps.
    pub faces: usize,
    /// Connected components.
    pub components: usize,
    /// Closed walks along the boundary.
    pub boundary_loops: usize,
    /// V − E + F.
    pub euler_characteristic: i64,
    /// Handles, summed over the components; `None` if the mesh is not valid.
    pub genus: Option<u64>,
    /// No boundary.
    pub closed: bool,
    /// [`super::validate`] finds nothing.
    pub valid: bool,
    /// How many vertices have each valence, ascending.
    pub valences: Vec<(usize, usize)>,
    /// How many faces have each number of corners, ascending.
    pub face_degrees: Vec<(usize, usize)>,
}

/// Counts.
///
/// # Errors
/// When stopped.
pub fn statistics(_mesh: &Mesh, _faces: &Faces, _stop: &Stop) -> Result<Statistics, Stopped> {
    Ok(Statistics::default())
}
