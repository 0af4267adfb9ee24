//! From tree to checked program: names, types, conversions, effects. Never fails, never panics.
//!
//! ```text
//!   declare    signatures of all functions; constants, parameters and properties in order
//!   body       scopes and variables of the function being checked
//!   statement  expression  place     the tree, node by node, into ir
//!   operator   what operators take and conversions give
//!   constant   values of file scope
//!   effects    what calls what, and who may read old values
//!   leaving    what leaves a loop or the function
//!   parallel   rounds that would depend on one another
//!   suggest    names that may have been meant
//! ```
//!
//! What is faulty has been reported and is `None` from there on: `None` fits everywhere, so that one mistake gives one
//! message.

mod body;
mod constant;
mod declare;
mod effects;
mod expression;
mod leaving;
mod operator;
mod parallel;
mod place;
mod statement;
mod suggest;

use std::cell::Cell;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use crate::diagnostic::{Diagnostic, Severity};
use crate::ir::{Function, FunctionId, Global, GlobalId, Program, PropertyDeclaration};
use crate::mesh::Value;
use crate::source::{FileId, Sources, Span};
use crate::syntax::tree::{Ast, Element};

use body::Body;
use declare::Signature;

/// Diagnostics that are shown.
const MOST_DIAGNOSTICS: usize = 100;

/// Checks the files of a program, included ones first, its own file ([`FileId::MAIN`]) last. The program may be run
/// only if no diagnostic is an error. A `const T&` is passed as a `T` that cannot be changed. Texts are `sound` if they were
/// read without error.
#[must_use]
pub fn check(sources: Arc<Sources>, files: &[(FileId, Ast)], sound: bool) -> (Program, Vec<Diagnostic>) {
    let mut checker = Checker::new(&sources);
    checker.declare_functions(files);
    checker.declare_globals(files);
    let functions = checker.define_functions();
    checker.look_at_parallel_loops(&functions);
    checker.look_at_calls(sound);
    checker.warn_of_copied_mesh();
    let program = Program {
        rules: checker.rules.clone(),
        start: checker.start,
        functions,
        globals: checker.globals,
        vertex_properties: checker.vertex_properties.declarations,
        edge_properties: checker.edge_properties.declarations,
        mesh_properties: checker.mesh_properties.declarations,
        sources: Arc::clone(&sources),
    };
    (program, most_important(checker.diagnostics))
}

/// The diagnostics that are shown: of very many the errors before the warnings, in the order in which they were found.
fn most_important(diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
    if diagnostics.len() <= MOST_DIAGNOSTICS {
        return diagnostics;
    }
    let (mut shown, others): (Vec<_>, Vec<_>) = diagnostics.into_iter().partition(|d| d.severity == Severity::Error);
    shown.truncate(MOST_DIAGNOSTICS);
    let room = MOST_DIAGNOSTICS - shown.len();
    shown.extend(others.into_iter().take(room));
    shown.push(Diagnostic::new(Severity::Note, None, "there are more errors or warnings than are shown here"));
    shown
}

struct Checker<'a> {
    sources: &'a Sources,
    diagnostics: Vec<Diagnostic>,
    signatures: Vec<Signature<'a>>,
    function_names: FxHashMap<&'a str, FunctionId>,
    /// Functions that are only declared, with what is to be said if a step calls them.
    undefined: Vec<(FunctionId, Diagnostic)>,
    rules: Vec<FunctionId>,
    start: Option<FunctionId>,
    globals: Vec<Global>,
    /// Values of the globals while no parameter is given from outside.
    defaults: Vec<GlobalValue>,
    global_names: FxHashMap<&'a str, GlobalName>,
    vertex_properties: Properties<'a>,
    edge_properties: Properties<'a>,
    mesh_properties: Properties<'a>,
    effects: Vec<effects::Effects>,
    body: Body<'a>,
    searches_left: Cell<u32>,
}

/// A name at file scope; faulty ones have no handle yet, or never get one.
struct GlobalName {
    span: Span,
    id: Option<GlobalId>,
    /// Its declaration has been read.
    declared: bool,
}

/// What is known of a global's value.
#[derive(Clone, Copy)]
struct GlobalValue {
    /// `None` if it has none: reported.
    value: Option<Value>,
    /// A parameter, or computed from one.
    varies: bool,
}

#[derive(Default)]
struct Properties<'a> {
    declarations: Vec<PropertyDeclaration>,
    /// `None` for faulty ones.
    names: FxHashMap<&'a str, (Span, Option<u32>)>,
}

impl<'a> Checker<'a> {
    fn new(sources: &'a Sources) -> Self {
        Self {
            sources,
            diagnostics: Vec::new(),
            signatures: Vec::new(),
            function_names: FxHashMap::default(),
            undefined: Vec::new(),
            rules: Vec::new(),
            start: None,
            globals: Vec::new(),
            defaults: Vec::new(),
            global_names: FxHashMap::default(),
            vertex_properties: Properties::default(),
            edge_properties: Properties::default(),
            mesh_properties: Properties::default(),
            effects: Vec::new(),
            body: Body::default(),
            searches_left: Cell::new(suggest::MAX_SEARCHES),
        }
    }

    fn define_functions(&mut self) -> Vec<Function> {
        (0..self.signatures.len()).map(|i| self.define_function(FunctionId(i as u32))).collect()
    }

    fn properties(&self, of: Element) -> &Properties<'a> {
        match of {
            Element::Vertex => &self.vertex_properties,
            Element::Edge => &self.edge_properties,
            Element::Mesh => &self.mesh_properties,
        }
    }

    fn properties_mut(&mut self, of: Element) -> &mut Properties<'a> {
        match of {
            Element::Vertex => &mut self.vertex_properties,
            Element::Edge => &mut self.edge_properties,
            Element::Mesh => &mut self.mesh_properties,
        }
    }

    fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Reports an error; `None` stands for what is faulty.
    fn fail<T>(&mut self, diagnostic: Diagnostic) -> Option<T> {
        self.diagnostics.push(diagnostic);
        None
    }

    /// The text under a span.
    fn text(&self, span: Span) -> &'a str {
        self.sources.text(span)
    }
}

/// Runs what recurses, on more stack if there is little. The parser bounds how deep trees are.
fn with_stack<T>(f: impl FnOnce() -> T) -> T {
    stacker::maybe_grow(128 << 10, 1 << 20, f)
}
