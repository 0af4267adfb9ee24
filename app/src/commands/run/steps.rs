//! The generations of one run.

use app::annotate::Quantity;
use app::evaluation::{self, Generation, within_halted};
use app::inspect::lineage::Survivors;
use vv::diagnostic::Diagnostic;
use vv::engine::{Failure, FailureKind, Settings};
use vv::mesh::Mesh;
use vv::source::Sources;
use vv::stop::Stop;

use super::super::report::Printer;
use super::super::{Exit, error, warnings_of};
use super::Run;
use super::cases::Case;
use super::look::Past;
use super::summary::Timings;

/// Where a run is.
pub struct State {
    /// The mesh.
    pub mesh: Mesh,
    /// What was before.
    pub past: Past,
    /// What was warned of.
    pub warnings: Vec<String>,
    /// Where the time went.
    pub timings: Timings,
}

impl Run<'_> {
    /// `start` and the steps of the rule, from `state` on; `see` is shown generation 0 and what each step makes. Returns
    /// the last one.
    ///
    /// # Errors
    /// Of the program or of `see`; reported.
    pub fn generations(
        &self,
        case: &Case,
        mut state: State,
        printer: &mut Printer,
        see: &mut dyn FnMut(&mut State) -> Result<(), Exit>,
    ) -> Result<State, Exit> {
        let settings = Settings { params: case.params.clone(), ..self.settings.clone() };
        let with = self.plan.label(case).map_or(String::new(), |label| format!(" with {label}"));
        state.past.lineage.add(0, &Survivors::default());
        if self.machine.program().start.is_some() {
            let what = format!("`start`{with}");
            let first = self.generation(&what, &settings, &mut *printer, |settings, printer| {
                evaluation::first(self.machine, &state.mesh, settings, printer)
            })?;
            state.warnings.extend(self.warn(&what, &first.warnings));
            state.mesh = first.mesh;
        }
        see(&mut state)?;
        let Some((rule, steps)) = self.rule else { return Ok(state) };
        let name = self.machine.program().function(rule).map_or("", |f| f.name.as_str());
        for step in 1..=steps {
            let what = format!("step {step} of {steps} of `{name}`{with}");
            self.reporter.progress(format!("{what}: {} vertices", state.mesh.set.len()));
            let next = self.generation(&what, &settings, &mut *printer, |settings, printer| {
                evaluation::advance(self.machine, rule, &state.mesh, step, settings, printer)
            })?;
            if let Some(unfit) = next.unfit {
                let unfit = [unfit.evidence(format!("this was in {what}"))];
                self.reporter.report(&unfit, &Sources::default());
                state.warnings.extend(warnings_of(&unfit));
            }
            state.warnings.extend(self.warn(&what, &next.warnings));
            state.past.lineage.add(step, &next.survivors);
            state.past.generation = step;
            let before = std::mem::replace(&mut state.mesh, next.mesh);
            if self.shot.look.annotations.color_by == Quantity::Since(step - 1) {
                state.past.lineage.keep(step - 1, before.clone());
            }
            state.past.first.get_or_insert_with(|| before.clone());
            state.past.before = Some(before);
            state.timings.steps_s.push(next.step_s);
            state.timings.closing_s.push(next.closing_s);
            see(&mut state)?;
        }
        Ok(state)
    }

    /// Makes one generation in the time it has.
    fn generation(
        &self,
        what: &str,
        settings: &Settings,
        printer: &mut Printer,
        make: impl FnOnce(&Settings, &mut Printer) -> Result<Generation, Failure>,
    ) -> Result<Generation, Exit> {
        let result = within_halted(self.arguments.importing.timeout.0, &self.way.halt, |stop| {
            make(&Settings { stop: stop.clone(), ..settings.clone() }, printer)
        });
        let flushed = printer.flush(self.reporter);
        self.go_on()?;
        match result {
            Err(failure) if failure.kind == FailureKind::OutputClosed => Err(flushed.err().unwrap_or(Exit::File)),
            Err(failure) => {
                let exit = match failure.kind {
                    FailureKind::Program => Exit::Program,
                    FailureKind::Budget | FailureKind::Stopped(_) => Exit::Budget,
                    FailureKind::OutputClosed => Exit::File,
                };
                let mut diagnostic = failure.diagnostic.evidence(format!("this was in {what}"));
                if let FailureKind::Stopped(_) = failure.kind {
                    diagnostic = diagnostic.hint("allow more time with `--timeout SECONDS`");
                } else if exit == Exit::Budget && diagnostic.message.ends_with(" vertices") {
                    diagnostic = diagnostic.hint("allow more with `--max-vertices N`");
                }
                self.reporter.report(&[diagnostic], &self.machine.program().sources);
                Err(exit)
            }
            Ok(generation) => flushed.map(|()| generation),
        }
    }

    /// Reports what a step left odd and returns the messages.
    fn warn(&self, what: &str, warnings: &[Diagnostic]) -> Vec<String> {
        let warnings: Vec<_> = warnings
            .iter()
            .cloned()
            .map(|mut warning| {
                warning.message = format!("after {what}: {}", warning.message);
                warning
            })
            .collect();
        self.reporter.report(&warnings, &self.machine.program().sources);
        warnings_of(&warnings)
    }

    /// Whether what is being made is still wanted.
    ///
    /// # Errors
    /// If it is not. Whoever does not want it knows: nothing is reported.
    pub fn go_on(&self) -> Result<(), Exit> {
        if self.way.halt.is_requested() { Err(Exit::Budget) } else { Ok(()) }
    }

    /// Does something in the time a step has.
    ///
    /// # Errors
    /// [`Exit::Budget`], reported.
    pub fn in_time<T>(&self, what: &str, work: impl FnOnce(&Stop) -> Result<T, vv::stop::Stopped>) -> Result<T, Exit> {
        self.reporter.progress(what.to_owned());
        let result = within_halted(self.arguments.importing.timeout.0, &self.way.halt, work);
        self.go_on()?;
        result.map_err(|stopped| {
            let diagnostic = error(stopped.to_string())
                .evidence(format!("this was while {what}"))
                .hint("allow more time with `--timeout SECONDS`");
            self.reporter.report(&[diagnostic], &Sources::default());
            Exit::Budget
        })
    }
}
