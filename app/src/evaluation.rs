//! Generations of a mesh: runs a program's `start` and rule and closes each step, with timings.
//!
//! The command line calls it on the main thread, the window on the worker's.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use sysinfo::{MemoryRefreshKind, RefreshKind, System};
use vv::diagnostic::Diagnostic;
use vv::engine::{Failure, FailureKind, Limits, Machine, Output, Settings};
use vv::ir::{FunctionId, Program};
use vv::mesh::inherit::inherit;
use vv::mesh::{Mesh, close};
use vv::stop::{Stop, Stopped};

use crate::claim::Claim;
use crate::inspect::lineage::Survivors;
use crate::trace;

/// A mesh after `start` (generation 0) or after a step, closed.
#[derive(Debug, Clone, Default)]
pub struct Generation {
    /// The mesh.
    pub mesh: Mesh,
    /// What the rule is not for, see [`Claim`]; only the first step looks for it.
    pub unfit: Option<Diagnostic>,
    /// What closing the step found.
    pub warnings: Vec<Diagnostic>,
    /// Which of its vertices were vertices of the one before.
    pub survivors: Survivors,
    /// Seconds the program took.
    pub step_s: f64,
    /// Seconds closing took.
    pub closing_s: f64,
}

/// Generation 0: the input as `start` leaves it; the input itself for a program without `start`.
///
/// # Errors
/// As [`Machine::run`].
pub fn first(
    machine: &Machine,
    input: &Mesh,
    settings: &Settings,
    output: &mut dyn Output,
) -> Result<Generation, Failure> {
    match machine.program().start {
        Some(start) => advance(machine, start, input, 0, settings, output),
        None => Ok(Generation { mesh: input.clone(), ..Generation::default() }),
    }
}

/// Generation `generation`, made of the one before by `rule`. What goes wrong with a rule for triangle meshes says so if
/// this was none. New vertices inherit what the program does not declare, see [`inherit()`].
///
/// # Errors
/// As [`Machine::run`]; `mesh` is as it was.
pub fn advance(
    machine: &Machine,
    rule: FunctionId,
    mesh: &Mesh,
    generation: u64,
    settings: &Settings,
    output: &mut dyn Output,
) -> Result<Generation, Failure> {
    let (began, before) = (Instant::now(), mesh);
    let span = trace::span("step");
    let result = machine.run(rule, before, generation, settings, output);
    let mut mesh = result.map_err(|mut failure| {
        explain(&mut failure, machine.program(), rule, before, &settings.stop);
        failure
    })?;
    drop(span);
    let step_s = began.elapsed().as_secs_f64();
    let began = Instant::now();
    let _span = trace::span("closing");
    let survivors = Survivors::of(&mesh, before.vertex_count());
    let stopped = |stopped: Stopped| Failure {
        kind: FailureKind::Stopped(stopped),
        diagnostic: Box::new(Diagnostic::new(vv::diagnostic::Severity::Error, None, stopped.to_string())),
    };
    let unknown = unknown_to(machine.program(), before);
    inherit(&mut mesh, before.vertex_count(), &unknown, &settings.stop).map_err(stopped)?;
    let warnings = close::close(&mut mesh, &settings.stop).map_err(stopped)?;
    let closing_s = began.elapsed().as_secs_f64();
    let claim = Claim::of(machine.program(), rule).filter(|_| generation == 1);
    let unfit = claim.map(|claim| claim.breach(before, &settings.stop)).transpose().map_err(stopped)?.flatten();
    Ok(Generation { mesh, unfit, warnings, survivors, step_s, closing_s })
}

/// The vertex properties of a mesh that a program does not declare, so that it cannot hand them on; but for sharpness, of
/// which new vertices have none.
fn unknown_to(program: &Program, mesh: &Mesh) -> Vec<usize> {
    let declared = |name: &str| program.vertex_properties.iter().any(|property| property.name == name);
    let properties = mesh.vertex_properties().iter().enumerate();
    properties.filter(|(_, p)| !declared(&p.name) && p.name != "sharpness").map(|(i, _)| i).collect()
}

/// Says with what went wrong that the rule is not for this mesh, if it is not.
fn explain(failure: &mut Failure, program: &Program, rule: FunctionId, mesh: &Mesh, stop: &Stop) {
    if failure.kind == FailureKind::Program
        && let Some(Ok(Some(unfit))) = Claim::of(program, rule).map(|claim| claim.breach(mesh, stop))
    {
        failure.diagnostic.message = format!("{}: {}", unfit.message, failure.diagnostic.message);
    }
}

/// The default budgets on this machine: memory is at most three quarters of what the machine, or the control group
/// the process is in, has.
#[must_use]
pub fn machine_limits() -> Limits {
    let limits = Limits::default();
    let memory = RefreshKind::nothing().with_memory(MemoryRefreshKind::nothing().with_ram());
    let Ok(system) = System::new_with_specifics(memory) else { return limits };
    let group = system.cgroup_limits().map_or(u64::MAX, |group| group.total_memory);
    match system.total_memory().min(group) {
        0 => limits,
        total => {
            Limits { max_bytes: limits.max_bytes.min(usize::try_from(total / 4 * 3).unwrap_or(usize::MAX)), ..limits }
        }
    }
}

/// By which somebody else ends a run of many pieces of work, each with a flag of its own. Clones are the same.
#[derive(Debug, Clone, Default)]
pub struct Halt(Arc<Mutex<(bool, Stop)>>);

impl Halt {
    /// Stops what is under way, and all that comes after it.
    pub fn request(&self) {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        state.0 = true;
        state.1.request(Stopped::ByUser);
    }

    /// Whether that was asked for.
    #[must_use]
    pub fn is_requested(&self) -> bool {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).0
    }

    /// The flag of the next piece of work.
    fn next(&self) -> Stop {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        state.1 = Stop::new();
        if state.0 {
            state.1.request(Stopped::ByUser);
        }
        state.1.clone()
    }
}

/// Does `work` with a flag that is set when `limit` is over; `None` gives it all the time it takes.
pub fn within<T>(limit: Option<Duration>, work: impl FnOnce(&Stop) -> T) -> T {
    within_halted(limit, &Halt::default(), work)
}

/// As [`within`]; the flag is also set when `halt` is requested.
pub fn within_halted<T>(limit: Option<Duration>, halt: &Halt, work: impl FnOnce(&Stop) -> T) -> T {
    let stop = halt.next();
    let Some(limit) = limit else { return work(&stop) };
    let (done, ended) = channel::<()>();
    std::thread::scope(|threads| {
        let flag = stop.clone();
        threads.spawn(move || {
            if ended.recv_timeout(limit) == Err(RecvTimeoutError::Timeout) {
                flag.request(Stopped::ByTime);
            }
        });
        let result = work(&stop);
        drop(done);
        result
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_stopped_when_its_time_is_over() {
        let began = Instant::now();
        let stopped = within(Some(Duration::from_millis(20)), |stop| {
            while stop.check().is_ok() {
                std::thread::sleep(Duration::from_millis(1));
            }
            stop.check()
        });
        assert_eq!(stopped, Err(Stopped::ByTime));
        assert!(began.elapsed() < Duration::from_secs(5));
    }

    #[test]
    fn work_that_ends_in_time_does_not_wait() {
        let began = Instant::now();
        assert_eq!(within(Some(Duration::from_secs(3600)), Stop::check), Ok(()));
        assert!(began.elapsed() < Duration::from_secs(5));
    }

    #[test]
    fn a_halt_stops_what_is_under_way_and_what_comes_after_it() {
        let halt = Halt::default();
        let other = halt.clone();
        let limit = Some(Duration::from_secs(3600));
        let stopped = within_halted(limit, &halt, |stop| {
            assert_eq!(stop.check(), Ok(()));
            other.request();
            stop.check()
        });
        assert_eq!(stopped, Err(Stopped::ByUser));
        assert_eq!(within_halted(None, &halt, Stop::check), Err(Stopped::ByUser));
        assert!(halt.is_requested());
    }

    #[test]
    fn the_memory_budget_fits_the_machine() {
        let limits = machine_limits();
        assert!(limits.max_bytes > 0 && limits.max_bytes <= 16 << 30);
        assert_eq!(limits.max_vertices, 50_000_000);
    }
}
