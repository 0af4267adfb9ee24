//! From tree to checked program: names, types, conversions, effects. Never fails, never panics.

use std::sync::Arc;

use crate::diagnostic::Diagnostic;
use crate::ir::Program;
use crate::source::{FileId, Sources};
use crate::syntax::tree::Ast;

/// Checks the files of a program, included ones first, its own file ([`FileId::MAIN`]) last. The program may be run
/// only if no diagnostic is an error.
#[must_use]
pub fn check(sources: Arc<Sources>, _files: &[(FileId, Ast)]) -> (Program, Vec<Diagnostic>) {
    let program = Program {
        sources,
        functions: Vec::new(),
        rules: Vec::new(),
        start: None,
        globals: Vec::new(),
        vertex_properties: Vec::new(),
        edge_properties: Vec::new(),
        mesh_properties: Vec::new(),
    };
    (program, Vec::new())
}
