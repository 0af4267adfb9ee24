//! `vv run`

pub(super) mod parameters;
mod summary;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use app::evaluation::{self, Generation, machine_limits, within};
use app::files;
use app::inspect::lineage::Survivors;
use clap::{Args, ValueEnum};
use vv::diagnostic::Diagnostic;
use vv::diagnostic::Severity;
use vv::engine::{Engine, Failure, FailureKind, Limits, Machine, Settings};
use vv::ir::{FunctionId, Program};
use vv::mesh::Mesh;
use vv::mesh::faces::{Faces, faces};
use vv::mesh::statistics::statistics;
use vv::source::Sources;
use vv::stop::Stop;

use super::look::{self, LookArguments, Past};
use super::output::{DEFAULT_SIZE, OutputArguments};
use super::picture::{self, Shot};
use super::reference::{Reference, is_picture};
use super::report::{Printer, Reporter, write_stdout};
use super::{EXIT_CODES, Exit, Importing, Reporting, closest, error, fail, info, input, list, output, warnings_of};
use summary::{Summary, Timings};

const EXAMPLES: &str = "\
Examples:
  vv run loop.vv -i bunny.obj -n 2 -o fine.obj -o fine.png --size 1920x1080
  vv run terrain.vv -D roughness=0.4 --seed 7 -o terrain.off      its `start` makes the mesh
  vv run loop.vv -i - -o - --format off < in.obj > out.off
  vv run loop.vv -i bunny.obj --summary json | jq .euler_characteristic
  vv run loop.vv -i bunny.obj -o new.png --reference old.png      a picture test
  vv run loop.vv -i bunny.obj -o a.png --color-by gauss --style smooth,no-edges

";

/// What `vv run` takes.
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}{EXIT_CODES}"))]
pub struct Arguments {
    /// The program; `-` is stdin.
    program: PathBuf,
    /// What is no option and no program: the mesh, where `-i` was forgotten.
    #[arg(hide = true)]
    others: Vec<PathBuf>,
    /// The mesh to begin with (.obj, .off, .ply, .stl, .glb, .gltf); `-` is stdin, in any of these formats. A program with `start` needs none.
    #[arg(short, long, value_name = "MESH")]
    input: Option<PathBuf>,
    /// How often to apply the rule. Default: 1, or 0 if the program has only `start`.
    #[arg(short = 'n', long, value_name = "STEPS", allow_negative_numbers = true, value_parser = steps)]
    steps: Option<u64>,
    /// The rule to apply. Default: `step`, else the program's last one.
    #[arg(long, value_name = "NAME")]
    rule: Option<String>,
    /// Give a `param` of the program another value: a number, true, false, or x,y,z. May be repeated.
    #[arg(short = 'D', long = "define", value_name = "NAME=VALUE", value_parser = parameters::definition)]
    definitions: Vec<(String, String)>,
    #[command(flatten)]
    output: OutputArguments,
    #[command(flatten)]
    look: LookArguments,
    #[command(flatten)]
    importing: Importing,
    /// Seed of `random()`.
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true, value_parser = seed)]
    seed: u64,
    /// Who runs the program; both give the same results.
    #[arg(long, value_enum, value_name = "ENGINE", default_value_t)]
    engine: EngineChoice,
    /// Write counts, invariants, warnings and timings to stdout as one object; `print` then goes to stderr.
    #[arg(long, value_enum, value_name = "FORMAT")]
    summary: Option<SummaryFormat>,
    /// Compare the resulting mesh (positions and faces, vertices numbered alike) or a picture of it (.png) with this
    /// earlier one, after writing the outputs. If they differ the exit code is 5.
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
    /// How far the reference may be off: for meshes a distance, by default 1e-9; for pictures the difference of a colour
    /// channel from 0 to 1 (of single pixels at outlines four times that), by default 0.
    #[arg(long, value_name = "X", requires = "reference", allow_negative_numbers = true, value_parser = tolerance)]
    tolerance: Option<f64>,
    #[command(flatten)]
    reporting: Reporting,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SummaryFormat {
    /// One JSON object.
    Json,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum EngineChoice {
    /// The interpreter, which defines what programs mean.
    Interpret,
    /// Machine code, made anew each time.
    #[default]
    Native,
}

/// Runs the program; `began` is when the process did.
pub fn run(arguments: &Arguments, began: Instant) -> Result<(), Exit> {
    if arguments.reference.as_deref().is_some_and(is_picture) {
        picture::keep_driver_quiet();
    }
    let reporter = Reporter::new(arguments.reporting.diagnostic_format);
    let result = run_reported(arguments, began, &reporter);
    reporter.end();
    result
}

fn run_reported(arguments: &Arguments, began: Instant, reporter: &Reporter) -> Result<(), Exit> {
    check_streams(arguments, reporter)?;
    let viewpoint = arguments.output.viewpoint(reporter)?;
    let targets = arguments.output.targets(reporter)?;
    reporter.begin();
    let mut timings = Timings::default();

    let compiling = Instant::now();
    let (program, found) = input::program(&arguments.program, reporter)?;
    let mut warnings = warnings_of(&found);
    let engine = match arguments.engine {
        EngineChoice::Interpret => Engine::Interpret,
        EngineChoice::Native => Engine::Native,
    };
    let machine = Machine::new(Arc::clone(&program), engine);
    if let Some(refusal) = machine.refusal() {
        reporter.report(&[Diagnostic::new(Severity::Note, None, refusal)], &program.sources);
    }
    timings.compile_s = compiling.elapsed().as_secs_f64();

    let (rule, steps) = plan(arguments, &program).or_else(|(exit, diagnostic)| fail(reporter, exit, *diagnostic))?;
    let params = parameters::values(&program, &arguments.definitions)
        .or_else(|diagnostic| fail(reporter, Exit::Usage, *diagnostic))?;
    let reference = arguments.reference.as_deref().map(|path| Reference::read(path, &arguments.importing, reporter));
    let reference = reference.transpose()?;

    let loading = Instant::now();
    let mesh = match &arguments.input {
        Some(path) => {
            reporter.progress(format!("reading {}", path.display()));
            let (mesh, found) = input::mesh(path, &arguments.importing, reporter)?;
            warnings.extend(warnings_of(&found));
            mesh
        }
        None => Mesh::new(),
    };
    timings.load_s = loading.elapsed().as_secs_f64();

    let limits = Limits { max_vertices: arguments.importing.max_vertices, ..machine_limits() };
    let settings = Settings { params, seed: arguments.seed, limits, stop: Stop::new() };
    let to_stderr = arguments.output.to_stdout() || arguments.summary.is_some();
    let mut printer = Printer::new(to_stderr, reporter);
    let run = Run { arguments, machine: &machine, settings, reporter };
    let (mesh, past, found) = run.generations(mesh, rule.map(|rule| (rule, steps)), &mut printer, &mut timings)?;
    warnings.extend(found);
    if mesh.set.is_empty() && !targets.is_empty() {
        let diagnostic = error("the mesh has no vertices left, so there is nothing to write");
        return fail(reporter, Exit::Program, diagnostic);
    }

    let needs_faces = !targets.is_empty() || arguments.summary.is_some() || reference.is_some();
    let finding = Instant::now();
    let faces =
        if needs_faces { run.in_time("finding the faces", |stop| faces(&mesh, stop))? } else { Faces::default() };
    timings.faces_s = finding.elapsed().as_secs_f64();

    let size = arguments.output.size().or(reference.as_ref().and_then(Reference::size)).unwrap_or(DEFAULT_SIZE);
    let with_picture = reference.as_ref().is_some_and(Reference::is_picture);
    let shot = Shot { size, viewpoint, look: &arguments.look.look() };
    let result = look::Result { mesh: &mesh, faces: &faces, past: &past };
    let outputs = output::prepare(&targets, shot, with_picture, result, reporter)?;
    timings.export_s = outputs.export_s;
    timings.render_s = outputs.render_s;
    printer.flush(reporter)?;
    if arguments.summary.is_some() {
        let statistics = run.in_time("counting", |stop| statistics(&mesh, &faces, stop))?;
        timings.total_s = began.elapsed().as_secs_f64();
        let summary = Summary::new(statistics, warnings, timings);
        write_stdout(info::json(&summary).as_bytes(), reporter)?;
    }
    output::commit(outputs.prepared, reporter)?;
    match reference {
        Some(reference) => reference.compare((&mesh, &faces), outputs.picture.as_ref(), arguments.tolerance, reporter),
        None => Ok(()),
    }
}

/// Nothing can be read or written twice.
fn check_streams(arguments: &Arguments, reporter: &Reporter) -> Result<(), Exit> {
    if let Some(other) = arguments.others.first() {
        let name = files::shown(other);
        let diagnostic = error(format!("`vv run` takes one program, and {name} is one file more"));
        return fail(reporter, Exit::Usage, diagnostic.hint(format!("a mesh is given with `-i {name}`")));
    }
    let from_stdin = |path: &PathBuf| files::is_standard_stream(path);
    if from_stdin(&arguments.program) && arguments.input.as_ref().is_some_and(from_stdin) {
        return fail(reporter, Exit::Usage, error("program and mesh cannot both be read from stdin"));
    }
    if arguments.summary.is_some() && arguments.output.to_stdout() {
        return fail(reporter, Exit::Usage, error("`--summary json` and `-o -` both need stdout for themselves"));
    }
    Ok(())
}

/// Which rule to apply how often; `None` if the program has only `start`.
fn plan(arguments: &Arguments, program: &Program) -> Result<(Option<FunctionId>, u64), (Exit, Box<Diagnostic>)> {
    let name = files::shown(&arguments.program);
    let names: Vec<_> = program.rules.iter().filter_map(|&r| program.function(r)).map(|f| f.name.as_str()).collect();
    if names.is_empty() && program.start.is_none() {
        let diagnostic = error(format!("{name} has nothing to run: neither a rule nor `start`"))
            .hint("a rule is a function `void name(mesh& S) { … }` in the program's own file");
        return Err((Exit::Program, diagnostic.into()));
    }
    let rule = match &arguments.rule {
        Some(wanted) => {
            Some(program.rule(wanted).ok_or_else(|| (Exit::Usage, unknown_rule(&name, wanted, &names).into()))?)
        }
        None => program.default_rule(),
    };
    let steps = arguments.steps.unwrap_or(u64::from(rule.is_some()));
    if rule.is_none() && steps > 0 {
        let diagnostic =
            error(format!("{name} has no rule to apply {steps} times, only `start`")).hint("leave out `-n`");
        return Err((Exit::Usage, diagnostic.into()));
    }
    if program.start.is_none() && arguments.input.is_none() {
        let diagnostic = error(format!("{name} has no `start` that would make a mesh, so it needs one"))
            .hint("add `-i MESH`, an .obj, .off, .ply, .stl, .glb or .gltf file");
        return Err((Exit::Usage, diagnostic.into()));
    }
    Ok((rule, steps))
}

/// Says which rules there are.
pub(super) fn unknown_rule(program: &str, wanted: &str, names: &[&str]) -> Diagnostic {
    let diagnostic = error(format!("{program} has no rule `{wanted}`"));
    let diagnostic = match names {
        [] => diagnostic.evidence("it has only `start`"),
        [name] => diagnostic.evidence(format!("its only rule is `{name}`")),
        _ => diagnostic.evidence(format!("its rules are {}", list(names.iter().copied()))),
    };
    match closest(wanted, names.iter().copied()) {
        Some(name) => diagnostic.hint(format!("did you mean `--rule {name}`?")),
        None => diagnostic,
    }
}

fn steps(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| "steps are counted: 0, 1, 2 and so on".to_owned())
}

fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("a seed is a whole number from 0 to {}", u64::MAX))
}

fn tolerance(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|x: &f64| x.is_finite() && *x >= 0.0);
    number.ok_or_else(|| "a tolerance is a number such as 1e-9".to_owned())
}

/// One run of a program.
struct Run<'a> {
    arguments: &'a Arguments,
    machine: &'a Machine,
    settings: Settings,
    reporter: &'a Reporter,
}

impl Run<'_> {
    /// `start` and the steps of the rule. Also returns what was before, and the messages of warnings.
    fn generations(
        &self,
        input: Mesh,
        rule: Option<(FunctionId, u64)>,
        printer: &mut Printer,
        timings: &mut Timings,
    ) -> Result<(Mesh, Past, Vec<String>), Exit> {
        let mut past = Past::default();
        past.lineage.add(0, &Survivors::default());
        let mut warnings = Vec::new();
        let mut mesh = input;
        if self.machine.program().start.is_some() {
            let first = self.generation("`start`", &mut *printer, |settings, printer| {
                evaluation::first(self.machine, &mesh, settings, printer)
            })?;
            warnings.extend(self.warn("`start`", &first.warnings));
            mesh = first.mesh;
        }
        let Some((rule, steps)) = rule else { return Ok((mesh, past, warnings)) };
        let name = self.machine.program().function(rule).map_or("", |f| f.name.as_str());
        for step in 1..=steps {
            let what = format!("step {step} of {steps} of `{name}`");
            self.reporter.progress(format!("{what}: {} vertices", mesh.set.len()));
            let next = self.generation(&what, &mut *printer, |settings, printer| {
                evaluation::advance(self.machine, rule, &mesh, step, settings, printer)
            })?;
            warnings.extend(self.warn(&what, &next.warnings));
            past.lineage.add(step, &next.survivors);
            past.generation = step;
            past.before = Some(std::mem::replace(&mut mesh, next.mesh));
            timings.steps_s.push(next.step_s);
            timings.closing_s.push(next.closing_s);
        }
        Ok((mesh, past, warnings))
    }

    /// Makes one generation in the time it has.
    fn generation(
        &self,
        what: &str,
        printer: &mut Printer,
        make: impl FnOnce(&Settings, &mut Printer) -> Result<Generation, Failure>,
    ) -> Result<Generation, Exit> {
        let result = within(self.arguments.importing.timeout.0, |stop| {
            make(&Settings { stop: stop.clone(), ..self.settings.clone() }, printer)
        });
        let flushed = printer.flush(self.reporter);
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

    /// Does something in the time a step has.
    fn in_time<T>(&self, what: &str, work: impl FnOnce(&Stop) -> Result<T, vv::stop::Stopped>) -> Result<T, Exit> {
        self.reporter.progress(what.to_owned());
        within(self.arguments.importing.timeout.0, work).map_err(|stopped| {
            let diagnostic = error(stopped.to_string())
                .evidence(format!("this was while {what}"))
                .hint("allow more time with `--timeout SECONDS`");
            self.reporter.report(&[diagnostic], &Sources::default());
            Exit::Budget
        })
    }
}
