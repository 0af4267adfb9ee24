//! `vv mask`

mod drawn;

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Arc;

use app::claim::Claim;
use app::evaluation::{first, machine_limits, within};
use app::files;
use clap::{Args, ValueEnum};
use serde::Serialize;
use vv::diagnostic::{Diagnostic, Severity};
use vv::engine::{Engine, Failure, FailureKind, Limits, Machine, Settings};
use vv::ir::FunctionId;
use vv::masks::{Around, Class, DECIMALS, Masks, Star, TOLERANCE, fraction, judge, measure, shown};
use vv::mesh::faces::faces;
use vv::mesh::{Mesh, Vertex};
use vv::source::Sources;
use vv::stop::Stop;

use super::info::json;
use super::report::{Reporter, write_stdout};
use super::run::checks::unknown_rule;
use super::run::parameters;
use super::{EXIT_CODES, Exit, Importing, Reporting, count, error, fail, input};
use drawn::{DrawingArguments, Drawn};

const EXAMPLES: &str = "\
Examples:
  vv mask loop.vv                              inside and at the boundary, valence by valence
  vv mask catmull-clark.vv --around quads --valence 5
  vv mask butterfly.vv -i torus.obj --vertex 40
  vv mask loop.vv --valence 5 --valence 6 -o masks.pdf --page 85mm      as figures for a paper

";

/// A step for every three vertices: more would take too long.
const MOST: usize = 20_000;

/// Weights of a mesh's masks that are nearer than this are the same.
const SAME: f64 = 1e-10;

/// What `vv mask` takes.
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}{EXIT_CODES}"))]
pub struct Arguments {
    /// The program; `-` is stdin.
    ///
    /// A name that no file has is that of a program that comes with vv, such as loop.vv.
    program: PathBuf,
    /// The masks of this mesh, in place of those around one irregular vertex.
    #[arg(short, long, value_name = "MESH")]
    input: Option<PathBuf>,
    /// The mask of this vertex of the result only, counted from 1.
    #[arg(long, value_name = "NUMBER", requires = "input", value_parser = count("the number of a vertex", 1..=u32::MAX as usize))]
    vertex: Option<usize>,
    /// Around one vertex: what is around it. Default: what the rule says it is for; else quads for rules that make quads
    /// of quads and no triangles of triangles, else triangles.
    #[arg(long, value_enum, value_name = "FACES", conflicts_with = "input")]
    around: Option<Faces>,
    /// Around one vertex: its valence. May be repeated. Default: 3 to 12.
    #[arg(long, value_name = "N", conflicts_with = "input", value_parser = count("a valence", 3..=64u8))]
    valence: Vec<u8>,
    /// The rule. Default: `step`, else the program's last one.
    #[arg(long, value_name = "NAME")]
    rule: Option<String>,
    /// Give a `param` of the program another value: a number, true, false, or x,y,z. May be repeated.
    #[arg(short = 'D', long = "define", value_name = "NAME=VALUE", value_parser = parameters::definition)]
    definitions: Vec<(String, String)>,
    /// Write one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    drawing: DrawingArguments,
    #[command(flatten)]
    importing: Importing,
    #[command(flatten)]
    reporting: Reporting,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Faces {
    /// Valence 6 all around.
    Triangles,
    /// Valence 4 all around.
    Quads,
}

/// Prints the masks, and as warnings what keeps them from being masks.
pub fn mask(arguments: &Arguments) -> Result<(), Exit> {
    let reporter = Reporter::new(arguments.reporting.diagnostic_format);
    let result = measured(arguments, &reporter);
    reporter.end();
    result
}

fn measured(arguments: &Arguments, reporter: &Reporter) -> Result<(), Exit> {
    let targets = arguments.drawing.targets(reporter)?;
    reporter.begin();
    let (program, _) = input::program(&arguments.program, reporter)?;
    let name = files::shown(&arguments.program);
    let rules: Vec<_> = program.rules.iter().filter_map(|&r| program.function(r)).map(|f| f.name.as_str()).collect();
    let wanted = arguments.rule.as_deref();
    let Some(rule) = wanted.map_or_else(|| program.default_rule(), |wanted| program.rule(wanted)) else {
        let diagnostic = match wanted {
            Some(wanted) => unknown_rule(&name, wanted, &rules),
            None => error(format!("{name} has no rule, so there is no mask")),
        };
        return fail(reporter, if wanted.is_some() { Exit::Usage } else { Exit::Program }, diagnostic);
    };
    let params = parameters::values(&program, &arguments.definitions)
        .or_else(|diagnostic| fail(reporter, Exit::Usage, *diagnostic))?;
    let machine = Machine::new(Arc::clone(&program), Engine::Native);
    let rule_name = program.function(rule).map(|f| f.name.clone()).unwrap_or_default();
    let limits = Limits { max_vertices: arguments.importing.max_vertices, ..machine_limits() };
    let table = within(arguments.importing.timeout.0, |stop| {
        let settings = Settings { params, limits, stop: stop.clone(), ..Settings::default() };
        let bench = Bench { machine, rule, settings, reporter };
        match &arguments.input {
            Some(path) => bench.of_mesh(arguments, path),
            None => bench.of_stars(arguments),
        }
    })?;
    for warning in &table.warnings {
        reporter.report(&[Diagnostic::new(Severity::Warning, None, warning.as_str())], &Sources::default());
    }
    let table = Table { program: name, rule: rule_name, ..table };
    if arguments.json {
        write_stdout(json(&table).as_bytes(), reporter)?;
    } else if targets.is_empty() {
        write_stdout(table.text().as_bytes(), reporter)?;
    }
    if targets.is_empty() {
        return Ok(());
    }
    let around = if table.around == Some(TRIANGLES) { Around::Triangles } else { Around::Quads };
    arguments.drawing.write(table.drawn, around, &targets, reporter)
}

/// What is said of what is around a vertex.
const TRIANGLES: &str = "triangles";

/// All that was found.
#[derive(Default, Serialize)]
struct Table {
    program: String,
    rule: String,
    /// What is around one irregular vertex; absent for a mesh.
    around: Option<&'static str>,
    rows: Vec<Row>,
    warnings: Vec<String>,
    /// The masks as figures, if these are asked for.
    #[serde(skip)]
    drawn: Vec<Drawn>,
}

/// Masks that belong together.
#[derive(Serialize)]
struct Row {
    title: String,
    masks: Vec<Mask>,
    /// Why there are none.
    failure: Option<String>,
}

#[derive(Serialize)]
struct Mask {
    /// What is made so.
    place: String,
    /// How many vertices are.
    count: usize,
    weights: Vec<Weight>,
}

/// Old vertices of one weight.
#[derive(Serialize)]
struct Weight {
    of: Vec<String>,
    weight: f64,
    fraction: Option<String>,
}

struct Bench<'a> {
    machine: Machine,
    rule: FunctionId,
    settings: Settings,
    reporter: &'a Reporter,
}

impl Bench<'_> {
    fn measure(&self, mesh: &Mesh) -> Result<Masks, Failure> {
        measure(&self.machine, self.rule, mesh, &self.settings)
    }

    fn ended(&self, failure: Failure) -> Exit {
        self.reporter.report(&[*failure.diagnostic], &self.machine.program().sources);
        match failure.kind {
            FailureKind::Program => Exit::Program,
            FailureKind::Budget | FailureKind::Stopped(_) => Exit::Budget,
            FailureKind::OutputClosed => Exit::File,
        }
    }

    fn of_mesh(&self, arguments: &Arguments, path: &std::path::Path) -> Result<Table, Exit> {
        let (mesh, _) = input::mesh(path, &arguments.importing, self.reporter)?;
        if mesh.vertex_count() > MOST {
            let message = format!("{} vertices take too long: each three of them need a step", mesh.vertex_count());
            return fail(self.reporter, Exit::Budget, error(message).hint(format!("take a mesh of at most {MOST}")));
        }
        let mesh =
            first(&self.machine, &mesh, &self.settings, &mut Vec::new()).map_err(|failure| self.ended(failure))?;
        let mesh = mesh.mesh;
        self.reporter.progress(format!("measuring the masks of {} vertices", mesh.vertex_count()));
        let masks = self.measure(&mesh).map_err(|failure| self.ended(failure))?;
        let of = |mask: &[(Vertex, f64)]| weights(mask, |v| v.to_string(), &[]);
        let mut rows: Vec<Mask> = Vec::new();
        let mut seen = Alike::default();
        let mut drawn = Vec::new();
        for (v, mask) in masks.result.vertices().zip(&masks.weights) {
            if arguments.vertex.is_some_and(|wanted| wanted != v.index() + 1) || !masks.result.set.contains(v) {
                continue;
            }
            let mut sorted: Vec<f64> = mask.iter().map(|(_, w)| *w).collect();
            sorted.sort_by(f64::total_cmp);
            match seen.find_or_add(sorted) {
                Some(i) => rows[i].count += 1,
                None => {
                    if arguments.drawing.is_asked_for() {
                        drawn.push(arguments.drawing.of_mesh(&mesh, mask));
                    }
                    rows.push(Mask { place: v.to_string(), count: 1, weights: of(mask) });
                }
            }
        }
        if let (Some(number), true) = (arguments.vertex, rows.is_empty()) {
            let message = format!("the result has no vertex v{number}");
            return fail(self.reporter, Exit::Usage, error(message));
        }
        for (drawn, row) in drawn.iter_mut().zip(&rows) {
            DrawingArguments::name(drawn, &row.place, row.count);
        }
        let warnings = masks.faults.iter().take(3).map(ToString::to_string).collect();
        let row = Row { title: files::shown(path), masks: rows, failure: None };
        Ok(Table { rows: vec![row], warnings, drawn, ..Table::default() })
    }

    fn of_stars(&self, arguments: &Arguments) -> Result<Table, Exit> {
        let around = match arguments.around {
            Some(Faces::Triangles) => Around::Triangles,
            Some(Faces::Quads) => Around::Quads,
            None => self.natural(),
        };
        let valences: Vec<usize> = if arguments.valence.is_empty() {
            (3..=12).collect()
        } else {
            arguments.valence.iter().map(|&n| usize::from(n)).collect()
        };
        let mut table =
            Table { around: Some(if around == Around::Triangles { TRIANGLES } else { "quads" }), ..Table::default() };
        // What is wrong, and where.
        let mut faults: Vec<(String, Vec<String>)> = Vec::new();
        let inside = valences.iter().map(|&n| (n, false));
        // A regular boundary vertex has 3 sectors of triangles or 2 quads; one on either side shows the rule.
        let boundary = (1..=5).filter(|_| arguments.valence.is_empty());
        for (sectors, boundary) in inside.chain(boundary.map(|k| (k, true))) {
            let Some(star) = Star::new(sectors, around, boundary) else { continue };
            let title = match (boundary, sectors) {
                (false, n) => format!("valence {n}"),
                (true, 1) => "boundary, 1 sector".to_owned(),
                (true, n) => format!("boundary, {n} sectors"),
            };
            self.reporter.progress(format!("measuring around a vertex: {title}"));
            let row = match judge(&self.machine, self.rule, &star, &self.settings) {
                Ok(found) => {
                    for fault in found.faults.iter().map(ToString::to_string) {
                        match faults.iter_mut().find(|(other, _)| *other == fault) {
                            Some((_, places)) => places.push(title.clone()),
                            None => faults.push((fault, vec![title.clone()])),
                        }
                    }
                    if arguments.drawing.is_asked_for() {
                        let draw = |class| arguments.drawing.of_star(&star, around, class);
                        table.drawn.extend(found.classes.iter().map(draw));
                    }
                    let masks = found.classes.iter().map(|class| named(&star, class)).collect();
                    Row { title, masks, failure: None }
                }
                // Elsewhere the rule may do.
                Err(failure) if failure.kind != FailureKind::Program => return Err(self.ended(failure)),
                Err(failure) => Row { title, masks: Vec::new(), failure: Some(failure.diagnostic.message.clone()) },
            };
            table.rows.push(row);
        }
        table.warnings.extend(faults.into_iter().map(|(fault, places)| match &places[..] {
            [place] => format!("{place}: {fault}"),
            places => format!("{} and {} more: {fault}", places[0], places.len() - 1),
        }));
        Ok(table)
    }

    /// What the rule is meant for: what it says, else triangles if it makes triangles of them, quads if it makes new quads
    /// of those, but for a few at irregular vertices. What does neither is shown on triangles, as it may ask for them.
    fn natural(&self) -> Around {
        match Claim::of(self.machine.program(), self.rule).and_then(|claim| claim.corners) {
            Some(3) => return Around::Triangles,
            Some(_) => return Around::Quads,
            None => {}
        }
        let made = |valence, around| {
            let star = Star::new(valence, around, false)?;
            let result = self.machine.run(self.rule, &star.mesh, 1, &self.settings, &mut Vec::new()).ok()?;
            let count = |mesh: &Mesh| Some(faces(mesh, &Stop::new()).ok()?.iter().map(<[_]>::len).collect());
            Some([count(&star.mesh)?, count(&result)?])
        };
        let all_triangles = |[_, after]: [Vec<usize>; 2]| after.iter().all(|&n| n == 3);
        let mostly_quads = |[before, after]: [Vec<usize>; 2]| {
            before.len() != after.len() && after.iter().filter(|&&n| n == 4).count() > after.len() / 2
        };
        let for_quads = || made(4, Around::Quads).is_some_and(mostly_quads);
        if !made(6, Around::Triangles).is_some_and(all_triangles) && for_quads() {
            Around::Quads
        } else {
            Around::Triangles
        }
    }
}

/// Sorted weights of masks, each with those that come near it.
#[derive(Default)]
struct Alike {
    masks: Vec<Vec<f64>>,
    /// By a number that is near where weights are.
    cells: BTreeMap<(usize, i64), Vec<usize>>,
}

impl Alike {
    /// Which mask has the same weights, the first of them; `None` if none had, and then this one has.
    fn find_or_add(&mut self, weights: Vec<f64>) -> Option<usize> {
        let near = |other: &Vec<f64>| other.iter().zip(&weights).all(|(a, b)| (a - b).abs() < SAME);
        // Weights as near as that differ in this sum by less than a cell is wide.
        let n = weights.len();
        let sum: f64 = weights.iter().enumerate().map(|(i, w)| (i + 1) as f64 * w).sum();
        let cell = (sum / (SAME * ((n + 1) * (n + 1)) as f64)).floor() as i64;
        let cells = (cell.saturating_sub(1)..=cell.saturating_add(1)).filter_map(|cell| self.cells.get(&(n, cell)));
        let found = cells.flatten().copied().filter(|&i| near(&self.masks[i])).min();
        if found.is_none() {
            self.cells.entry((n, cell)).or_default().push(self.masks.len());
            self.masks.push(weights);
        }
        found
    }
}

fn named(star: &Star, class: &Class) -> Mask {
    let most = class.mask.iter().map(|(_, w)| *w).fold(0.0, f64::max);
    let nearest: Vec<String> =
        class.mask.iter().filter(|(_, w)| *w > most - 1e-9).map(|(v, _)| star.name(*v)).collect();
    let place = match nearest.as_slice() {
        [_] => "at p".to_owned(),
        [a, b] => format!("between {a} and {b}"),
        more => format!("amid {}", more.join(" ")),
    };
    // Neighbours all around go by their first and last.
    let rays = star.sectors + usize::from(star.boundary);
    let rings: Vec<Vec<String>> = [
        (1..=rays).map(|i| format!("q{i}")).collect(),
        (1..=star.sectors).map(|i| format!("q{i}+q{}", i % rays + 1)).collect(),
    ]
    .into();
    Mask { place, count: class.count, weights: weights(&class.mask, |v| star.name(v), &rings) }
}

/// The greatest weight first. What is all of a ring goes by its first and last.
fn weights(mask: &[(Vertex, f64)], name: impl Fn(Vertex) -> String, rings: &[Vec<String>]) -> Vec<Weight> {
    let mut sorted: Vec<&(Vertex, f64)> = mask.iter().collect();
    sorted.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut alike: Vec<(Vec<Vertex>, f64)> = Vec::new();
    for &&(v, weight) in &sorted {
        match alike.last_mut().filter(|(_, other)| (other - weight).abs() <= 10.0 * TOLERANCE) {
            Some((vertices, _)) => vertices.push(v),
            None => alike.push((vec![v], weight)),
        }
    }
    let group = |(mut vertices, weight): (Vec<Vertex>, f64)| {
        vertices.sort_unstable();
        Weight { of: vertices.into_iter().map(&name).collect(), weight, fraction: fraction(weight) }
    };
    let mut groups: Vec<Weight> = alike.into_iter().map(group).collect();
    for group in &mut groups {
        for ring in rings.iter().filter(|ring| ring.len() > 2) {
            if ring.iter().all(|member| group.of.contains(member)) {
                let at = group.of.iter().position(|of| ring.contains(of)).unwrap_or_default();
                let all = format!("{}…{}", ring[0], ring[ring.len() - 1]);
                group.of.retain(|of| !ring.contains(of));
                group.of.insert(at.min(group.of.len()), all);
            }
        }
    }
    groups
}

impl Table {
    fn text(&self) -> String {
        let mut text = format!("{}, rule {}", self.program, self.rule);
        if let Some(around) = self.around {
            let _ = write!(text, ", around a vertex p with neighbours q1, q2, … among {around}");
        }
        text.push('\n');
        for row in &self.rows {
            let _ = write!(text, "\n{}\n", row.title);
            if let Some(failure) = &row.failure {
                let _ = writeln!(text, "  none: {failure}");
            }
            let width = row.masks.iter().map(|mask| mask.place.chars().count()).max().unwrap_or_default();
            for mask in &row.masks {
                let weights: Vec<String> = mask.weights.iter().map(Weight::text).collect();
                let times = if self.around.is_none() { format!("  {:>6} × ", mask.count) } else { "  ".to_owned() };
                let _ = writeln!(text, "{times}{:width$}   {}", mask.place, weights.join("   "));
            }
        }
        text
    }
}

impl Weight {
    fn text(&self) -> String {
        format!("{}: {}", self.of.join(" "), shown(self.weight, DECIMALS))
    }
}

#[cfg(test)]
mod tests {
    use super::Alike;

    #[test]
    fn masks_with_the_same_weights_are_found_again_wherever_they_come() {
        let mut seen = Alike::default();
        let mask = |i: usize| vec![i as f64 / 777.0, 0.5, 1.0 - i as f64 / 777.0];
        let all: Vec<_> = (0..300).map(|i| seen.find_or_add(mask(i))).collect();
        assert!(all.iter().all(Option::is_none));
        for i in 0..300 {
            let by = |x: f64| mask(i).iter().map(|w| w + x).collect();
            for near in [-0.9e-10, 0.0, 0.9e-10] {
                assert_eq!(seen.find_or_add(by(near)), Some(i), "{i} {near}");
            }
        }
        assert_eq!(seen.find_or_add(vec![1.0]), None, "another number of weights");
        assert_eq!(seen.find_or_add(vec![1.0 + 3e-10]), None);
        assert_eq!(seen.find_or_add(vec![1.0 + 2.5e-10]), Some(301));
        assert_eq!(seen.find_or_add(vec![f64::NAN]), None);
    }
}
