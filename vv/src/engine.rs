//! Running programs: what every engine takes and gives.
//!
//! [`run`] does one step (or `start`) on a copy of a mesh and gives back the new mesh, not yet closed
//! ([`crate::mesh::close`]). If it fails the copy is dropped, so a failed step leaves the mesh as it was.
//!
//! [`run`] is the interpreter, which defines what programs mean. A [`Machine`] keeps a program ready from step to step,
//! as machine code where it may, with the same results.

mod interpret;
mod native;
mod text;

use std::sync::Arc;

use crate::diagnostic::Diagnostic;
use crate::ir::{FunctionId, GlobalId, Program};
use crate::mesh::{Mesh, Value};
use crate::stop::{Stop, Stopped};

#[doc(hidden)]
pub use native::Mutation;
pub use native::keep_freed_memory;

/// Who runs a program. All give the same results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Engine {
    /// The interpreter, which defines what programs mean.
    Interpret,
    /// Machine code: some milliseconds to begin, then ten to twenty times as fast.
    #[default]
    Native,
}

/// A program ready to run, with what was compiled for it. Make one for a program and keep it from step to step.
#[derive(Debug)]
pub struct Machine {
    program: Arc<Program>,
    native: Option<Result<native::Native, native::Refused>>,
}

impl Machine {
    /// Prepares a program; for [`Engine::Native`] this compiles it, a few milliseconds for a page of text.
    #[must_use]
    pub fn new(program: Arc<Program>, engine: Engine) -> Self {
        Self::with_mutation(program, engine, Mutation::None)
    }

    /// For the test of the tests: compiles something wrongly.
    #[doc(hidden)]
    #[must_use]
    pub fn with_mutation(program: Arc<Program>, engine: Engine, mutation: Mutation) -> Self {
        let native = (engine == Engine::Native).then(|| native::compile(&program, mutation));
        Self { program, native }
    }

    /// The program.
    #[must_use]
    pub fn program(&self) -> &Arc<Program> {
        &self.program
    }

    /// Who runs it: the interpreter where machine code was refused, too.
    #[must_use]
    pub fn engine(&self) -> Engine {
        if matches!(self.native, Some(Ok(_))) { Engine::Native } else { Engine::Interpret }
    }

    /// Why the interpreter runs it though machine code was asked for.
    #[must_use]
    pub fn refusal(&self) -> Option<String> {
        match &self.native {
            Some(Err(refused)) => Some(format!("the program runs in the interpreter: {refused}")),
            _ => None,
        }
    }

    /// As [`run`].
    ///
    /// # Errors
    /// As [`run`].
    pub fn run(
        &self,
        function: FunctionId,
        mesh: &Mesh,
        generation: u64,
        settings: &Settings,
        output: &mut dyn Output,
    ) -> Result<Mesh, Failure> {
        match &self.native {
            Some(Ok(native)) => native.run(&self.program, function, mesh, generation, settings, output),
            _ => run(&self.program, function, mesh, generation, settings, output),
        }
    }
}

/// What a run may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Vertices in the universe, those that `start` or import made included.
    pub max_vertices: usize,
    /// Bytes of rings, columns, old values and sets, and of all that was printed (somebody may keep it). Counted now and
    /// then, so a step may go over it by a sixteenth.
    pub max_bytes: usize,
    /// Calls open at once.
    pub max_call_depth: u32,
}

impl Default for Limits {
    /// 50 million vertices, 16 GiB, 10,000 calls.
    fn default() -> Self {
        Self { max_vertices: 50_000_000, max_bytes: 16 << 30, max_call_depth: 10_000 }
    }
}

/// Everything a run depends on beside program, rule and mesh.
#[derive(Debug, Clone, Default)]
pub struct Settings {
    /// Values for `param`s in place of their defaults. Those of another type are converted as an assignment would;
    /// callers check ranges ([`crate::ir::Param::range`]).
    pub params: Vec<(GlobalId, Value)>,
    /// Seeds `random()`, whose stream is a function of this and the generation.
    pub seed: u64,
    /// Budgets.
    pub limits: Limits,
    /// Polled at every loop round and call.
    pub stop: Stop,
}

/// Where `print` goes.
pub trait Output {
    /// Takes one line, without its end.
    ///
    /// # Errors
    /// When nobody reads any more (a closed pipe); the run then ends.
    fn print(&mut self, line: &str) -> Result<(), OutputClosed>;
}

/// Collects the lines.
impl Output for Vec<String> {
    fn print(&mut self, line: &str) -> Result<(), OutputClosed> {
        self.push(line.to_owned());
        Ok(())
    }
}

/// Nobody reads what is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the output was closed")]
pub struct OutputClosed;

/// A run that did not end in a mesh.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{}", diagnostic.message)]
pub struct Failure {
    /// What kind of end it was.
    pub kind: FailureKind,
    /// What to tell the user, located.
    pub diagnostic: Box<Diagnostic>,
}

/// Kinds of failure, which exit codes tell apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FailureKind {
    /// The program did something that has no meaning.
    Program,
    /// Vertices, memory or call depth ran out.
    Budget,
    /// Stopped from outside.
    Stopped(Stopped),
    /// The output was closed.
    OutputClosed,
}

/// Interprets `function` (a rule or `start`) on a copy of `mesh` as generation `generation`: 0 for `start`, n for the n-th
/// step. The program's properties are declared on the mesh first. The result is not closed.
///
/// # Errors
/// See [`FailureKind`]; `mesh` is as it was in any case.
pub fn run(
    program: &Program,
    function: FunctionId,
    mesh: &Mesh,
    generation: u64,
    settings: &Settings,
    output: &mut dyn Output,
) -> Result<Mesh, Failure> {
    interpret::run(program, function, mesh, generation, settings, output)
}
