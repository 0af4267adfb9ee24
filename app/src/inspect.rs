//! What the mesh says of itself: rings, walks, measures, what is wrong with it. Pure functions of a mesh; no window.
//!
//! What is shown of a vertex costs what its ring costs; what is asked of the whole mesh ([`findings`]) is computed on
//! another thread.

pub mod findings;
pub mod lineage;
pub mod mask;
pub mod measure;
pub mod ring;
pub mod selection;
pub mod walk;
