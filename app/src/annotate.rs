//! What is shown on a surface beside the surface: numbers as colours, arrows, labels.
//!
//! ```text
//!   Annotations   what is asked for; part of a document
//!   Subject      a mesh with all that is known of it
//!   Field        numbers, one for each vertex or face           linear in the mesh: on no window's thread
//!   Tint         a field in colours: words for the GPU, scale, legend
//! ```

pub mod arrows;
pub mod cell;
pub mod curvature;
pub mod field;
pub mod labels;
mod quantity;
pub mod scale;
#[cfg(test)]
mod tests;
mod tint;

use std::sync::Arc;

use vv::mesh::Mesh;
use vv::mesh::faces::Faces;

use crate::inspect::lineage::Lineage;
use crate::scene::Scene;

pub use arrows::{ArrowSet, Arrows};
pub use field::Field;
pub use labels::Label;
pub use quantity::Quantity;
pub use tint::{Legend, Reading, Tint};

/// What is shown beside the surface.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Annotations {
    /// What the surface is coloured by.
    pub color_by: Quantity,
    /// The numbers at both ends of the colours; `None` is what most of the numbers lie between.
    pub range: Option<[f64; 2]>,
    /// What is written at vertices or in faces.
    pub labels: Label,
    /// What is drawn as arrows.
    pub arrows: Arrows,
    /// How long arrows are, as a multiple of the mean length of the edges.
    pub arrow_length: f32,
}

impl Default for Annotations {
    fn default() -> Self {
        Self {
            color_by: Quantity::Plain,
            range: None,
            labels: Label::Nothing,
            arrows: Arrows::Nothing,
            arrow_length: 1.0,
        }
    }
}

/// A mesh with all that is known of it.
#[derive(Debug, Clone)]
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
    /// Its colours, if they are known.
    pub tint: Option<Arc<Tint>>,
}
