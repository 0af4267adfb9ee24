//! Pictures of meshes without window.

use vv::mesh::Mesh;
use vv::mesh::faces::Faces;

use super::output::Size;
use super::report::Reporter;
use super::{Exit, error, fail};

/// A picture in PNG format.
///
/// # Errors
/// [`Exit::NoRenderer`], reported.
pub fn png(_mesh: &Mesh, _faces: &Faces, _size: Size, reporter: &Reporter) -> Result<Vec<u8>, Exit> {
    fail(reporter, Exit::NoRenderer, error("pictures cannot be made yet"))
}
