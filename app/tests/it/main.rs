//! The modeler as a specification: command lines, pictures, panels.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::allow_attributes,
    reason = "a test that panics has failed"
)]

mod command_line;
mod editors;
mod fixtures;
mod live_reload;
mod losses;
mod pictures;
mod shaders;
mod soak;
mod window;
