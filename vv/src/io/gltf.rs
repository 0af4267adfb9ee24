//! glTF 2.0: a scene of triangles, in JSON with binary data, embedded or behind it in a GLB container.
//!
//! Everything in the scene becomes one mesh, placed by its nodes. Corners that differ in what is not kept – normals,
//! texture coordinates – are welded. What begins with an underscore is the format's way to keep other values: `_age`
//! is the property `age`.
//!
//! Colours are light there, not what a screen takes, see `to_linear`.

mod accessor;
mod document;
mod read;
mod write;

pub(super) use read::read;
pub(super) use write::{holds, write_glb, write_text};

const MAGIC: &[u8] = b"glTF";
const VERSION: u32 = 2;
const JSON: &[u8] = b"JSON";
const BIN: &[u8] = b"BIN\0";
/// Attributes of vertices.
const POSITION: &str = "POSITION";
const COLOR: &str = "COLOR_0";

/// Whether bytes are in a GLB container.
pub(super) fn is_glb(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// The sRGB transfer function (IEC 61966-2-1), from the encoded value to light.
fn to_linear(c: f64) -> f64 {
    if c <= 0.04045 { c / 12.92 } else { libm::pow((c + 0.055) / 1.055, 2.4) }
}

/// Its inverse: `1.055 c^(1 / 2.4) − 0.055`, exact at 1.
fn to_srgb(c: f64) -> f64 {
    if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * (libm::pow(c, 1.0 / 2.4) - 1.0) + 1.0 }
}
