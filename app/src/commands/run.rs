//! `vv run`

mod cases;
pub(super) mod checks;
mod names;
pub(super) mod parameters;
mod plan;
mod sheets;
mod steps;
mod summary;

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use app::brought;
use app::evaluation::{Halt, machine_limits};
use app::files::{self, Prepared};
use clap::{Args, ValueEnum};
use image::RgbaImage;
use vv::diagnostic::{Diagnostic, Severity};
use vv::engine::{Engine, Limits, Machine, Settings};
use vv::ir::FunctionId;
use vv::mesh::Mesh;
use vv::mesh::faces::{Degrees, Faces, degrees, faces};
use vv::mesh::statistics::statistics;
use vv::source::Sources;
use vv::stop::Stop;

use super::look::{self, LookArguments, Past};
use super::output::{DEFAULT_SIZE, OutputArguments};
use super::picture::{self, Exhibit, Shot};
use super::reference::{Reference, is_picture};
use super::report::{Printer, Reporter, write_stdout};
use super::{
    DiagnosticFormat, EXIT_CODES, Exit, Importing, Reporting, count, error, fail, info, input, output, tolerance,
    warnings_of,
};
use cases::Case;
use plan::{Given, Plan, Sheet};
use sheets::Exhibits;
use steps::State;
use summary::{Line, Summary, Timings};

const EXAMPLES: &str = "\
Examples:
  vv run loop.vv -i bunny.obj -n 2 -o fine.obj -o fine.png --size 1920x1080
  vv run terrain.vv -D roughness=0.4 --seed 7 -o terrain.off      its `start` makes the mesh
  vv run loop.vv -i - -o - --format off < in.obj > out.off
  vv run loop.vv -i bunny.obj --summary json | jq .euler_characteristic
  vv run loop.vv -i bunny.obj -o new.png --reference old.png      a picture test
  vv run loop.vv -i bunny.obj -o a.png --color-by gauss --style smooth,no-edges
  vv run loop.vv -i a.obj -i b.obj -n 3 -o '{name}_{n:2}.obj'     every generation of both
  vv run terrain.vv -D roughness=0.3:0.8:5 -o 'terrain_{roughness}.obj' -o all.png
  vv run loop.vv -i bunny.obj --generations 0-3 -o steps.png --size 1600x450   side by side
  vv run loop.vv -i cube.obj --generations 0-3 -o fig.pdf --style no-faces     the same in lines, for a paper
  vv run loop.vv -i bunny.obj -n 2 --turntable 36 -o 'turn_{frame:3}.png' -o turn.gif

";

/// What `vv run` takes.
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}{EXIT_CODES}"))]
pub struct Arguments {
    /// The program; `-` is stdin.
    ///
    /// A name that no file has is that of a program that comes with vv, such as loop.vv.
    pub program: PathBuf,
    /// What is no option and no program: the mesh, where `-i` was forgotten.
    #[arg(hide = true)]
    others: Vec<PathBuf>,
    /// The mesh to begin with; `-` is stdin.
    ///
    /// In one of the formats .obj, .off, .ply, .stl, .glb and .gltf, also from stdin. A program with `start` needs
    /// none. May be repeated: each is run on its own, and `{name}` in the names of outputs is its name.
    #[arg(short, long, value_name = "MESH")]
    input: Vec<PathBuf>,
    /// How often to apply the rule.
    ///
    /// Default: 1, or 0 if the program has only `start`.
    #[arg(short = 'n', long, value_name = "STEPS", allow_negative_numbers = true, value_parser = steps)]
    steps: Option<u64>,
    /// The rule to apply.
    ///
    /// Default: `step`, else the program's last one.
    #[arg(long, value_name = "NAME")]
    rule: Option<String>,
    /// Which generations to write, such as 0,2,4 or 0-3.
    ///
    /// `{n:2}` in the names of outputs stands for them (in two digits); pictures and figures without it show them side
    /// by side. Default: all, and the last one.
    #[arg(long, help_heading = "Output", value_name = "LIST", value_parser = plan::generations)]
    generations: Option<plan::Generations>,
    /// Go around the mesh in N pictures.
    ///
    /// `{frame}` in their names is the number of each, from 0; a .gif holds them all.
    #[arg(long, help_heading = "Output", value_name = "N", value_parser = count("the number of pictures", 2..=3600u32))]
    turntable: Option<u32>,
    /// Give a `param` of the program another value.
    ///
    /// A number, true, false, or x,y,z. May be repeated. Several values, `w=0,0.1,0.5` or from:to:count `w=0:1:5`, make
    /// as many runs, and `{w}` in the names of outputs is the value; pictures and figures without `{w}` show them side
    /// by side.
    #[arg(short = 'D', long = "define", value_name = "NAME=VALUE", value_parser = parameters::definition)]
    definitions: Vec<(String, String)>,
    /// Seed of `random()`.
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true, value_parser = seed)]
    seed: u64,
    /// Who runs the program; both give the same results.
    #[arg(long, value_enum, value_name = "ENGINE", default_value_t)]
    engine: EngineChoice,
    #[command(flatten)]
    output: OutputArguments,
    #[command(flatten)]
    look: LookArguments,
    #[command(flatten)]
    importing: Importing,
    /// Write counts, invariants, warnings and timings to stdout.
    ///
    /// As one object; `print` then goes to stderr.
    #[arg(long, help_heading = "Reports", value_enum, value_name = "FORMAT")]
    summary: Option<SummaryFormat>,
    /// Compare the result with this earlier one.
    ///
    /// The mesh (positions and faces, vertices numbered alike) or a picture of it (.png), after writing the outputs. If
    /// they differ the exit code is 5.
    #[arg(long, help_heading = "Reports", value_name = "FILE")]
    reference: Option<PathBuf>,
    /// How far the reference may be off.
    ///
    /// For meshes a distance, by default 1e-9; for pictures the difference of a colour channel from 0 to 1 (of single
    /// pixels at outlines four times that), by default 0.
    #[arg(long, help_heading = "Reports", value_name = "X", requires = "reference", allow_negative_numbers = true, value_parser = tolerance)]
    tolerance: Option<f64>,
    #[command(flatten)]
    reporting: Reporting,
    /// Whether nothing is done, and there is no program.
    #[arg(skip)]
    still: bool,
}

/// What is run where there is no program.
const STILL: &str = "void still(mesh& S) { }\n";

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
    make(arguments, began, &Way::default()).map(drop)
}

/// How a run is made that is one of many.
#[derive(Debug, Default)]
pub struct Way {
    /// Ends it.
    pub halt: Halt,
    /// Whether it is made again when a file that it reads changes: it may write none of them, and counts what came out.
    pub watched: bool,
    /// Becomes true when stdout takes no more.
    pub closed: AtomicBool,
}

impl Arguments {
    /// To do nothing to meshes, and write what comes of that.
    pub fn still(
        input: Vec<PathBuf>,
        turntable: Option<u32>,
        output: OutputArguments,
        look: LookArguments,
        importing: Importing,
        reporting: Reporting,
    ) -> Self {
        Self {
            program: PathBuf::from("still.vv"),
            others: Vec::new(),
            input,
            steps: Some(0),
            rule: None,
            generations: None,
            turntable,
            definitions: Vec::new(),
            output,
            look,
            importing,
            seed: 0,
            engine: EngineChoice::Interpret,
            summary: None,
            reference: None,
            tolerance: None,
            reporting,
            still: true,
        }
    }

    /// The files that are read, there or not.
    pub fn read(&self) -> Vec<PathBuf> {
        let looked_at = match files::is_standard_stream(&self.program) {
            true => Vec::new(),
            false => files::compile(&self.program, &files::read_program(&self.program).unwrap_or_default()).1,
        };
        let view = self.output.view_file();
        let others = self.input.iter().chain(&self.reference).chain(view.as_ref()).chain(self.look.files());
        [&self.program].into_iter().chain(others).cloned().chain(looked_at).collect()
    }

    /// How errors are written.
    pub fn diagnostic_format(&self) -> DiagnosticFormat {
        self.reporting.diagnostic_format
    }

    /// Whether stdout takes the outputs.
    pub fn to_stdout(&self) -> bool {
        self.output.to_stdout()
    }

    /// Whether stdout takes the summary.
    pub fn has_summary(&self) -> bool {
        self.summary.is_some()
    }
}

/// What a run has made.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tally {
    /// Runs that ended well.
    pub runs: usize,
    /// Files.
    pub files: usize,
    /// Vertices, edges and faces of the last result, if they were to be counted.
    pub counts: Option<[usize; 3]>,
}

/// Runs the program and says what was made.
pub fn make(arguments: &Arguments, began: Instant, way: &Way) -> Result<Tally, Exit> {
    if arguments.reference.as_deref().is_some_and(is_picture) {
        picture::keep_driver_quiet();
    }
    let reporter = Reporter::new(arguments.reporting.diagnostic_format);
    let result = run_reported(arguments, began, way, &reporter);
    reporter.end();
    result
}

fn run_reported(arguments: &Arguments, began: Instant, way: &Way, reporter: &Reporter) -> Result<Tally, Exit> {
    checks::streams(arguments, reporter)?;
    let viewpoint = arguments.output.viewpoint(reporter)?;
    let look = arguments.look.look(reporter)?;
    let outputs = arguments.output.formats(reporter)?;
    reporter.begin();
    vv::engine::keep_freed_memory();

    let compiling = Instant::now();
    let (program, found) = match arguments.still {
        true => input::compiled(&arguments.program, STILL, reporter)?,
        false => input::program(&arguments.program, reporter)?,
    };
    let engine = match arguments.engine {
        EngineChoice::Interpret => Engine::Interpret,
        EngineChoice::Native => Engine::Native,
    };
    let machine = Machine::new(Arc::clone(&program), engine);
    if let Some(refusal) = machine.refusal() {
        reporter.report(&[Diagnostic::new(Severity::Note, None, refusal)], &program.sources);
    }
    let timings = Timings { compile_s: compiling.elapsed().as_secs_f64(), ..Timings::default() };

    let usage = |diagnostic: Box<Diagnostic>| {
        reporter.report(&[*diagnostic], &Sources::default());
        Exit::Usage
    };
    let (rule, steps) =
        checks::what_to_apply(arguments, &program).or_else(|(exit, diagnostic)| fail(reporter, exit, *diagnostic))?;
    let cases = cases::cases(&program, arguments.input.len(), &arguments.definitions).map_err(usage)?;
    let given = Given {
        program: &arguments.program,
        inputs: &arguments.input,
        generations: arguments.generations.as_ref(),
        frames: arguments.turntable,
    };
    let plan = Plan::new(given, outputs, cases, steps).map_err(usage)?;
    if arguments.reference.is_some() && plan.has_many() {
        return fail(reporter, Exit::Usage, error("`--reference` compares one result, and here are several"));
    }
    checks::not_read(&plan, arguments, &program, way.watched).map_err(usage)?;
    if arguments.summary.is_none() {
        reporter.report(Vec::from_iter(plan.unshown()).as_slice(), &Sources::default());
    }
    output::check_places(&plan.all_targets(), reporter)?;
    if plan.all_targets().iter().any(|target| target.figure().is_some()) {
        look.warn_of_figures(reporter);
    }
    let reference = arguments.reference.as_deref().map(|path| Reference::read(path, &arguments.importing, reporter));
    let reference = reference.transpose()?;

    let limits = Limits { max_vertices: arguments.importing.max_vertices, ..machine_limits() };
    let size = arguments.output.size().or(reference.as_ref().and_then(Reference::size)).unwrap_or(DEFAULT_SIZE);
    let run = Run {
        arguments,
        machine: &machine,
        rule: rule.map(|rule| (rule, steps)),
        settings: Settings { params: Vec::new(), seed: arguments.seed, limits, stop: Stop::new() },
        plan: &plan,
        shot: Shot { size, viewpoint, look: &look },
        reference,
        warnings: warnings_of(&found),
        began,
        way,
        reporter,
    };
    let still = |sheet: &&Sheet| sheet.target.is_picture() && !sheet.target.is_film();
    let mut sheets = plan.sheets().iter().filter(still);
    sheets.try_for_each(|sheet| run.layout(sheet).map(drop))?;
    run.all(&timings)
}

/// All runs of a command.
struct Run<'a> {
    arguments: &'a Arguments,
    machine: &'a Machine,
    /// What to apply how often.
    rule: Option<(FunctionId, u64)>,
    /// But for the parameters.
    settings: Settings,
    plan: &'a Plan,
    shot: Shot<'a>,
    reference: Option<Reference>,
    /// What was warned of in the program.
    warnings: Vec<String>,
    began: Instant,
    way: &'a Way,
    reporter: &'a Reporter,
}

/// An input that was read, with what was warned of, and how long that took.
struct Loaded {
    mesh: Mesh,
    warnings: Vec<String>,
    load_s: f64,
}

/// What a run has made so far.
#[derive(Default)]
struct Made {
    prepared: Vec<Prepared>,
    /// One for each generation that is asked for.
    summaries: String,
    faces: Faces,
    picture: Option<RgbaImage>,
    exhibits: Exhibits,
}

impl Run<'_> {
    /// Each on its own: a failure in one ends with its exit code when all others are done. Where nobody listens any more,
    /// or nothing can be drawn, the others would fare no better.
    fn all(&self, timings: &Timings) -> Result<Tally, Exit> {
        let (mut result, mut tally) = (Ok(()), Tally::default());
        let mut exhibits = Exhibits::new();
        let mut loaded: Option<(usize, Result<Loaded, Exit>)> = None;
        let to_stderr = self.arguments.output.to_stdout() || self.arguments.summary.is_some();
        let mut printer = Printer::new(to_stderr, self.reporter);
        for case in self.plan.cases() {
            if let count @ 2.. = self.plan.cases().len() {
                self.reporter.part(format!("run {} of {count}: ", case.index + 1));
            }
            if loaded.as_ref().is_none_or(|(input, _)| *input != case.input) {
                loaded = Some((case.input, self.load(case.input)));
            }
            let ended = match &loaded {
                Some((_, Ok(loaded))) => {
                    self.one(case, loaded, timings.clone(), &mut printer, &mut exhibits, &mut tally)
                }
                Some((_, Err(exit))) => Err(*exit),
                None => Ok(()),
            };
            self.way.closed.store(printer.is_closed(), Ordering::Relaxed);
            if ended == Err(Exit::NoRenderer) || printer.is_closed() {
                return ended.map(|()| tally);
            }
            self.go_on()?;
            result = result.and(ended);
        }
        if self.plan.cases().len() > 1 {
            self.reporter.part(String::new());
            picture::in_one_range(exhibits.values_mut(), self.shot.look);
            result = result.and(self.sheets(&exhibits).and_then(|sheets| self.commit(sheets, &mut tally)));
        }
        if result.is_ok() && !self.is_asked_for_anything() && !printer.is_used() {
            let note = Diagnostic::new(Severity::Note, None, "nothing is printed and nothing written");
            let note = note.hint("`-o FILE` writes the mesh or a picture of it, `--summary json` what it has");
            self.reporter.report(&[note], &Sources::default());
        }
        result.map(|()| tally)
    }

    fn is_asked_for_anything(&self) -> bool {
        let Arguments { output, summary, reference, .. } = self.arguments;
        !output.output.is_empty() || summary.is_some() || reference.is_some() || self.way.watched
    }

    fn commit(&self, prepared: Vec<Prepared>, tally: &mut Tally) -> Result<(), Exit> {
        self.go_on()?;
        let files = prepared.len();
        output::commit(prepared, self.reporter)?;
        tally.files += files;
        Ok(())
    }

    fn load(&self, input: usize) -> Result<Loaded, Exit> {
        let loading = Instant::now();
        let (mesh, found) = match self.arguments.input.get(input) {
            Some(path) => {
                self.reporter.progress(format!("reading {}", path.display()));
                input::mesh(path, &self.arguments.importing, self.reporter)?
            }
            None => (Mesh::new(), Vec::new()),
        };
        let lost = brought::lost(self.machine.program(), &mesh);
        self.reporter.report(&lost, &self.machine.program().sources);
        let warnings = [self.warnings.clone(), warnings_of(&found), warnings_of(&lost)].concat();
        Ok(Loaded { mesh, warnings, load_s: loading.elapsed().as_secs_f64() })
    }

    /// Runs one and writes what is made of it, all or nothing.
    fn one(
        &self,
        case: &Case,
        loaded: &Loaded,
        timings: Timings,
        printer: &mut Printer,
        exhibits: &mut Exhibits,
        tally: &mut Tally,
    ) -> Result<(), Exit> {
        let mut made = Made::default();
        let state = State {
            mesh: loaded.mesh.clone(),
            past: Past::default(),
            warnings: loaded.warnings.clone(),
            timings: Timings { load_s: loaded.load_s, ..timings },
        };
        let state = self.generations(case, state, printer, &mut |state| self.show(case, state, &mut made))?;
        if self.plan.cases().len() == 1 {
            picture::in_one_range(made.exhibits.values_mut(), self.shot.look);
            made.prepared.extend(self.sheets(&made.exhibits)?);
        }
        let counts = if self.way.watched { Some(self.count(&state.mesh)?) } else { None };
        if !made.summaries.is_empty() {
            write_stdout(made.summaries.as_bytes(), self.reporter).inspect_err(|_| printer.close())?;
        }
        self.commit(made.prepared, tally)?;
        (tally.runs, tally.counts) = (tally.runs + 1, counts);
        exhibits.append(&mut made.exhibits);
        match &self.reference {
            Some(reference) => {
                let result = (&state.mesh, &made.faces);
                reference.compare(result, made.picture.as_ref(), self.arguments.tolerance, self.reporter)
            }
            None => Ok(()),
        }
    }

    fn count(&self, mesh: &Mesh) -> Result<[usize; 3], Exit> {
        let faces = self.in_time("counting the faces", |stop| degrees(mesh, stop))?;
        let found = self.in_time("counting", |stop| statistics(mesh, faces, stop))?;
        Ok([found.vertices, found.edges, found.faces])
    }

    /// Makes of a generation what is asked for.
    fn show(&self, case: &Case, state: &mut State, made: &mut Made) -> Result<(), Exit> {
        let State { mesh, past, warnings, timings } = state;
        let targets = self.plan.targets(case, past.generation);
        let summarised = self.arguments.summary.is_some() && self.plan.is_shown(past.generation);
        let reference = self.reference.as_ref().filter(|_| self.plan.is_last(past.generation));
        let on_sheet = self.plan.is_on_sheet(case, past.generation);
        let turns = self.plan.turns(case, past.generation);
        if targets.is_empty() && turns.is_empty() && !on_sheet && !summarised && reference.is_none() {
            return Ok(());
        }
        if mesh.set.is_empty() && (on_sheet || !turns.is_empty() || !targets.is_empty()) {
            let diagnostic = error("the mesh has no vertices left, so there is nothing to write");
            return fail(self.reporter, Exit::Program, diagnostic);
        }
        let finding = Instant::now();
        // What only counts keeps none of them.
        let counted = if targets.is_empty() && turns.is_empty() && !on_sheet && reference.is_none() {
            Some(self.in_time("counting the faces", |stop| degrees(mesh, stop))?)
        } else {
            made.faces = self.in_time("finding the faces", |stop| faces(mesh, stop))?;
            None
        };
        timings.faces_s = finding.elapsed().as_secs_f64();

        let with_picture = reference.is_some_and(Reference::is_picture);
        let result = look::Result { mesh, faces: &made.faces, past };
        let outputs = output::prepare(&targets, self.shot, with_picture, result, self.reporter)?;
        timings.export_s = outputs.export_s;
        timings.render_s = outputs.render_s;
        made.prepared.extend(outputs.prepared);
        if on_sheet || !turns.is_empty() {
            let exhibit = Exhibit::new(result, self.shot.look, self.reporter)?;
            let drawing = Instant::now();
            for turn in &turns {
                made.prepared.extend(self.frames(&exhibit, turn)?);
            }
            timings.render_s += drawing.elapsed().as_secs_f64();
            if on_sheet {
                made.exhibits.insert(
                    (case.index, past.generation),
                    exhibit.kept(self.shot.look, self.plan.has_figures_on_sheets()),
                );
            }
        }
        made.picture = outputs.picture;
        if summarised {
            let degrees = counted.unwrap_or_else(|| Degrees::from(&made.faces));
            let statistics = self.in_time("counting", |stop| statistics(mesh, degrees, stop))?;
            timings.total_s = self.began.elapsed().as_secs_f64();
            let summary = Summary::new(statistics, warnings.clone(), timings.clone());
            made.summaries += &match self.plan.has_many() {
                false => info::json(&summary),
                true => self.line(case, past.generation, summary).text(),
            };
        }
        Ok(())
    }

    fn line(&self, case: &Case, generation: u64, summary: Summary) -> Line {
        let globals = |id| self.machine.program().params().find(|&(other, ..)| other == id);
        let named = |&(id, value)| Some((globals(id)?.1.name.clone(), summary::value(value)));
        Line {
            input: self.arguments.input.get(case.input).map(|path| path.display().to_string()),
            parameters: case.params.iter().filter_map(named).collect(),
            generation,
            summary,
        }
    }
}

fn steps(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| "steps are counted: 0, 1, 2 and so on".to_owned())
}

fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("a seed is a whole number from 0 to {}", u64::MAX))
}
