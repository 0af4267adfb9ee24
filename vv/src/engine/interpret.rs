//! The reference interpreter: the definition of what programs mean.

use super::{Failure, Output, Settings};
use crate::ir::{FunctionId, Program};
use crate::mesh::Mesh;

pub(super) fn run(
    _program: &Program,
    _function: FunctionId,
    mesh: &Mesh,
    _generation: u64,
    _settings: &Settings,
    _output: &mut dyn Output,
) -> Result<Mesh, Failure> {
    Ok(mesh.clone())
}
