//! The engine as a specification: text in, text out.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::allow_attributes,
    reason = "a test that panics has failed"
)]

mod engines;
mod examples;
mod files;
mod gallery;
mod includes;
mod manual;
mod masks;
mod mesh;
mod oracles;
mod rings;
mod run;
mod schemes;
mod shapes;
mod values;

mod architecture;
mod check;
