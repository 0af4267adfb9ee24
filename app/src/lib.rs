//! The vv modeler: owns files, windows, threads and the GPU.

pub mod camera;
pub mod evaluation;
pub mod files;
pub mod render;
pub mod scene;
