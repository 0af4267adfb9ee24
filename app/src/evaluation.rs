//! Generations of a mesh: runs a program's `start` and rule and closes each step, with timings.
//!
//! The command line calls it on the main thread, the window on the worker's.

use std::time::Instant;

use vv::diagnostic::Diagnostic;
use vv::engine::{self, Failure, FailureKind, Output, Settings};
use vv::ir::{FunctionId, Program};
use vv::mesh::{Mesh, close};

/// A mesh after `start` (generation 0) or after a step, closed.
#[derive(Debug, Clone, Default)]
pub struct Generation {
    /// The mesh.
    pub mesh: Mesh,
    /// What closing the step found.
    pub warnings: Vec<Diagnostic>,
    /// Seconds the program took.
    pub step_s: f64,
    /// Seconds closing took.
    pub closing_s: f64,
}

/// Generation 0: the input as `start` leaves it; the input itself for a program without `start`.
///
/// # Errors
/// As [`engine::run`].
pub fn first(
    program: &Program,
    input: &Mesh,
    settings: &Settings,
    output: &mut dyn Output,
) -> Result<Generation, Failure> {
    match program.start {
        Some(start) => advance(program, start, input, 0, settings, output),
        None => Ok(Generation { mesh: input.clone(), ..Generation::default() }),
    }
}

/// Generation `generation`, made of the one before by `rule`.
///
/// # Errors
/// As [`engine::run`]; `mesh` is as it was.
pub fn advance(
    program: &Program,
    rule: FunctionId,
    mesh: &Mesh,
    generation: u64,
    settings: &Settings,
    output: &mut dyn Output,
) -> Result<Generation, Failure> {
    let began = Instant::now();
    let mut mesh = engine::run(program, rule, mesh, generation, settings, output)?;
    let step_s = began.elapsed().as_secs_f64();
    let began = Instant::now();
    let warnings = close::close(&mut mesh, &settings.stop).map_err(|stopped| Failure {
        kind: FailureKind::Stopped(stopped),
        diagnostic: Box::new(Diagnostic::new(vv::diagnostic::Severity::Error, None, stopped.to_string())),
    })?;
    Ok(Generation { mesh, warnings, step_s, closing_s: began.elapsed().as_secs_f64() })
}
