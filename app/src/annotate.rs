//! What is shown on a surface beside the surface: numbers as colours, arrows, labels.
//!
//! ```text
//!   Annotations   what is asked for; part of a document
//!   Subject      a mesh with all that is known of it
//!   Field        numbers, one for each vertex or face           linear in the mesh: on no window's thread
//!   Tint         a field in colours: words for the GPU, scale, legend
//! ```

pub mod cell;
pub mod curvature;
pub mod field;
mod quantity;
pub mod scale;
#[cfg(test)]
mod tests;
mod tint;

use vv::mesh::Mesh;
use vv::mesh::faces::Faces;

use crate::inspect::lineage::Lineage;
use crate::scene::Scene;

pub use field::Field;
pub use quantity::Quantity;
pub use tint::{Legend, Reading, Tint};

/// What is shown beside the surface.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Annotations {
    /// What the surface is coloured by.
    pub color_by: Quantity,
    /// The numbers at both ends of the colours; `None` is what most of the numbers lie between.
    pub range: Option<[f64; 2]>,
}

/// A mesh with all that is known of it.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// Its faces.
    pub faces: &'a Faces,
    /// Made of both.
    pub scene: &'a Scene,
    /// Its generation.
    pub generation: u64,
    /// The generation before, if it is kept.
    pub before: Option<&'a Mesh>,
    /// Which vertex of a generation is which of another.
    pub lineage: &'a Lineage,
}
