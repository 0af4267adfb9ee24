//! Comparing results with earlier ones.

pub mod meshes;
pub mod pictures;
