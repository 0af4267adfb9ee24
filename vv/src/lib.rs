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
//! bytes; whoever calls decides where from, how long and on which thread. Who steps a program more than once keeps an
//! [`engine::Machine`].
//!
//! ```
//! use vv::engine::{Engine, Machine, Settings};
//! use vv::mesh::{Mesh, close::close};
//!
//! let text = "void step(mesh& S) { vertex x; x$pos = vec(1, 2, 3); add x to S; }";
//! let compilation = vv::compile("grow.vv", text, &mut |_, _| Err("nothing to include".to_owned()));
//! let machine = Machine::new(compilation.program.ok_or("the program has an error")?, Engine::Native);
//! let rule = machine.program().default_rule().ok_or("the program has no rule")?;
//!
//! let (mut mesh, settings) = (Mesh::new(), Settings::default());
//! for generation in 1..=3 {
//!     mesh = machine.run(rule, &mesh, generation, &settings, &mut Vec::new())?;
//!     close(&mut mesh, &settings.stop)?;
//! }
//! assert_eq!(mesh.vertices().map(|v| v.to_string()).collect::<Vec<_>>(), ["v1", "v2", "v3"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Where things are
//!
//! | to | begin at |
//! |---|---|
//! | read a program and hear what is wrong with it | [`compile`], [`diagnostic::Diagnostic`] |
//! | run it | [`engine::Machine`], [`engine::Settings`]; then [`mesh::close`] |
//! | know what programs mean | [`ir`], the manual beside it |
//! | hold a mesh, walk and edit its rings | [`mesh::Mesh`], [`mesh::Ring`], [`mesh::Vertex`] |
//! | find its faces, count, check it | [`mesh::faces`], [`mesh::statistics`], [`mesh::validate`] |
//! | make one of polygons, compare two | [`mesh::build`], [`mesh::isomorphism`] |
//! | read and write files | [`io::read`], [`io::write`], [`io::Format`] |
//! | find the weights of a rule | [`masks::measure`], [`masks::Star`], [`masks::measure_vertex`] |
//! | help an editor | [`assist`], [`syntax`], [`builtins`] |
//! | end what takes too long | [`stop::Stop`], [`engine::Limits`] |
//!
//! # Examples
//!
//! In `vv/examples`, to be run by `cargo run -p vv --example NAME`:
//!
//! - `subdivide` runs a program on a mesh file and writes OBJ;
//! - `orbits` walks the faces of a rotation system, and shows that the order of neighbours decides what surface it is;
//! - `rings` edits rings by hand, with what [`mesh::validate`] says on the way;
//! - `masks` finds the weights of a rule.
//!
//! ## `subdivide`
//! ```no_run
#![doc = include_str!("../examples/subdivide.rs")]
//! ```
//!
//! ## `orbits`
//! ```no_run
#![doc = include_str!("../examples/orbits.rs")]
//! ```
//!
//! ## `rings`
//! ```no_run
#![doc = include_str!("../examples/rings.rs")]
//! ```
//!
//! ## `masks`
//! ```no_run
#![doc = include_str!("../examples/masks.rs")]
//! ```

pub mod assist;
pub mod builtins;
pub mod check;
pub mod diagnostic;
pub mod engine;
pub mod io;
pub mod ir;
pub mod masks;
pub mod mesh;
pub mod source;
pub mod stop;
pub mod syntax;

/// Vectors as they stand in this library's interface.
pub use glam;

use std::collections::HashSet;
use std::sync::Arc;

use diagnostic::{Diagnostic, Severity};
use ir::Program;
use source::{FileId, Sources};
use syntax::tree::{Ast, Item};

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

/// Files may include each other this deep.
const MAX_INCLUDE_DEPTH: u32 = 64;

/// Parses and checks a program. `include` finds the text that `#include "path"` in the file `from` (a name it gave, or
/// `name`) means, as `include(from, path)`, or says why not. A file included twice, or by itself, is read once.
pub fn compile(name: &str, text: &str, include: &mut dyn FnMut(&str, &str) -> Result<Included, String>) -> Compilation {
    let mut loader =
        Loader { sources: Sources::default(), names: HashSet::new(), files: Vec::new(), diagnostics: Vec::new() };
    loader.load(name, text, include, 0);
    let Loader { sources, files, mut diagnostics, .. } = loader;
    let sources = Arc::new(sources);
    let sound = !diagnostics.iter().any(|d| d.severity == Severity::Error);
    let (program, more) = check::check(Arc::clone(&sources), &files, sound);
    diagnostics.extend(more);
    // What has no place speaks of all that has one, and comes last.
    diagnostics.sort_by_key(|d| (d.span.is_none(), d.span.map(|s| (s.file, s.start, s.end))));
    let failed = diagnostics.iter().any(|d| d.severity == Severity::Error);
    Compilation { sources, program: (!failed).then(|| Arc::new(program)), diagnostics }
}

/// Reads files, each after those that it includes.
struct Loader {
    sources: Sources,
    names: HashSet<String>,
    files: Vec<(FileId, Ast)>,
    diagnostics: Vec<Diagnostic>,
}

impl Loader {
    fn load(
        &mut self,
        name: &str,
        text: &str,
        include: &mut dyn FnMut(&str, &str) -> Result<Included, String>,
        depth: u32,
    ) {
        self.names.insert(name.to_owned());
        let file = self.sources.add(name, text);
        let (ast, diagnostics) = syntax::parse(file, text);
        self.diagnostics.extend(diagnostics);
        for item in &ast.items {
            let Item::Include { path, span } = item else { continue };
            match include(name, path) {
                Ok(included) if self.names.contains(&included.name) => {}
                Ok(_) if depth >= MAX_INCLUDE_DEPTH => {
                    let message = format!("files include each other deeper than {MAX_INCLUDE_DEPTH} levels");
                    self.diagnostics.push(Diagnostic::error(*span, message));
                }
                Ok(included) => self.load(&included.name, &included.text, include, depth + 1),
                Err(message) => self.diagnostics.push(Diagnostic::error(*span, message)),
            }
        }
        self.files.push((file, ast));
    }
}
