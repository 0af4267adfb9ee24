//! What happens when a step ends.

use super::Mesh;
use crate::diagnostic::Diagnostic;
use crate::stop::{Stop, Stopped};

/// Closes a step: forgets vertices that are not in the set, lets the holes run through walks that have a gap at both
/// ends. Returns warnings (forgotten vertices, incomplete neighbours, positions that are not finite).
///
/// # Errors
/// When stopped; drop the mesh then.
pub fn close(_mesh: &mut Mesh, _stop: &Stop) -> Result<Vec<Diagnostic>, Stopped> {
    Ok(Vec::new())
}
