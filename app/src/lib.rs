//! The vv modeler: owns files, windows, threads and the GPU.

pub mod camera;
pub mod compare;
pub mod evaluation;
pub mod files;
pub mod library;
pub mod render;
pub mod scene;
