//! The vertex–vertex language and its engine.
//!
//! ```text
//!   text ── syntax::parse ──▶ tree ── check::check ──▶ ir::Program ─┐
//!                                                                   ├─ engine::run ──▶ Mesh ── mesh::close ──▶ Mesh
//!   bytes ── io::read ──────────────────────────────▶ mesh::Mesh ──┘                              │
//!                                                          mesh::faces, mesh::statistics, io::write ◀┘
//! ```
//!
//! A pure library: no window, no clock, no thread of its own, no file system. Texts come in as strings, meshes as
//! bytes; whoever calls decides where from, how long and on which thread.

pub mod builtins;
pub mod check;
pub mod diagnostic;
pub mod engine;
pub mod io;
pub mod ir;
pub mod mesh;
pub mod source;
pub mod stop;
pub mod syntax;

use std::sync::Arc;

use diagnostic::Diagnostic;
use ir::Program;
use source::Sources;

/// What became of a text.
#[derive(Debug, Clone)]
pub struct Compilation {
    /// The text and those it includes; places in diagnostics refer to them.
    pub sources: Arc<Sources>,
    /// The program, if there was no error.
    pub program: Option<Arc<Program>>,
    /// Errors, warnings and notes, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
}

/// An included text.
#[derive(Debug, Clone)]
pub struct Included {
    /// What identifies the file: a text of this name is read once. Diagnostics call it so.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// Parses and checks a program. `include` finds the text that `#include "path"` in the file `from` (a name it gave, or
/// `name`) means, or says why not. A file included twice, or by itself, is read once.
pub fn compile(
    name: &str,
    text: &str,
    _include: &mut dyn FnMut(&str, &str) -> Result<Included, String>,
) -> Compilation {
    let mut sources = Sources::default();
    let file = sources.add(name, text);
    let (ast, mut diagnostics) = syntax::parse(file, text);
    let sources = Arc::new(sources);
    let (program, more) = check::check(Arc::clone(&sources), &[(file, ast)]);
    diagnostics.extend(more);
    Compilation { sources, program: Some(Arc::new(program)), diagnostics }
}
