//! The vv modeler: owns files, windows, threads and the GPU.

pub mod annotate;
pub mod camera;
pub mod command;
pub mod compare;
pub mod console;
pub mod document;
pub mod evaluation;
pub mod figure;
pub mod files;
pub mod gallery;
pub mod gui;
pub mod inspect;
pub mod library;
pub mod navigation;
pub mod preferences;
pub mod project;
pub mod render;
pub mod scene;
pub mod session;
pub mod sheet;
pub mod store;
pub mod style_file;
pub mod trace;
mod typed_path;
pub mod viewpoint;
pub mod watch;
pub mod worker;
