//! Parallel loops give the same on any number of threads.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use glam::{DVec3, dvec3};
use rayon::ThreadPoolBuilder;
use vv::builtins::Random;
use vv::engine::{Engine, Failure, FailureKind, Machine, Settings};
use vv::io::{Format, ReadOptions, read};
use vv::ir::FunctionId;
use vv::mesh::Mesh;
use vv::mesh::build::{Polygons, build};
use vv::stop::{Stop, Stopped};

use super::programs::PARALLEL;
use super::{assets, compile_text, state, wheel};
use crate::run::OCTAHEDRON;

const THREADS: [usize; 3] = [1, 2, 7];

/// A program under an engine.
struct Runner(Machine, FunctionId);

impl Runner {
    fn new(text: &str, engine: Engine) -> Self {
        let program = compile_text(text);
        let machine = Machine::new(Arc::clone(&program), engine);
        assert_eq!(machine.engine(), engine);
        Self(machine, program.default_rule().unwrap())
    }

    /// A step on so many threads.
    fn step(&self, mesh: &Mesh, threads: usize, settings: &Settings) -> Result<Mesh, Failure> {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| self.0.run(self.1, mesh, 1, settings, &mut Vec::new()))
    }
}

fn start(text: &str) -> Mesh {
    let program = compile_text(text);
    let machine = Machine::new(Arc::clone(&program), Engine::Interpret);
    machine.run(program.start.unwrap(), &Mesh::new(), 0, &Settings::default(), &mut Vec::new()).unwrap()
}

fn stop_after(time: Duration, stop: &Stop) {
    let stop = stop.clone();
    thread::spawn(move || {
        thread::sleep(time);
        stop.request(Stopped::ByTime);
    });
}

/// All threads end as the interpreter does.
#[track_caller]
fn check(text: &str, meshes: &[Mesh]) -> Result<(), Failure> {
    let [interpreter, native] = [Engine::Interpret, Engine::Native].map(|engine| Runner::new(text, engine));
    // Rounds that never end shall fail a test, not keep it.
    let settings = Settings::default();
    stop_after(Duration::from_secs(60), &settings.stop);
    for mesh in meshes {
        let interpreted = interpreter.step(mesh, 1, &settings);
        for threads in THREADS {
            let compiled = native.step(mesh, threads, &settings);
            match (&interpreted, &compiled) {
                (Ok(a), Ok(b)) => assert_eq!(state(a), state(b), "{threads} threads"),
                (Err(a), Err(b)) => assert_eq!((a.kind, &a.diagnostic), (b.kind, &b.diagnostic), "{threads} threads"),
                _ => panic!("{threads} threads: {interpreted:?}, {compiled:?}"),
            }
        }
        interpreted?;
    }
    Ok(())
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let small = assets("meshes", "obj").into_iter().filter_map(|path| {
        let mesh = read(&std::fs::read(&path).unwrap(), Format::Obj, &ReadOptions::default()).unwrap().0;
        (mesh.vertex_count() < 200).then_some(mesh)
    });
    let mut meshes: Vec<Mesh> = small.collect();
    // A vertex whose ring is long.
    meshes.push(start(&format!("{}{PARALLEL}", wheel(40))));
    check(PARALLEL, &meshes).unwrap();
    // Other code finds its way in rings where there are no values of edges.
    check(&PARALLEL.replace("edge { double s = 2; };", "").replace(" + (p|q)$s", ""), &meshes).unwrap();
}

/// A cone, its base open: rings of four, three and many.
fn cone(rim: u32, rows: u32) -> Mesh {
    let point = |i: u32, row: u32| {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(rim)).sin_cos();
        f64::from(row + 1) * dvec3(cos, sin, -1.0)
    };
    let mut polygons = Polygons::new((0..rows).flat_map(|row| (0..rim).map(move |i| point(i, row))).collect());
    let top = polygons.positions.len() as u32;
    polygons.positions.push(DVec3::ZERO);
    for i in 0..rim {
        let next = (i + 1) % rim;
        polygons.push([top, i, next], None).unwrap();
        for row in (0..rows - 1).map(|row| row * rim) {
            polygons.push([row + i, row + rim + i, row + rim + next, row + next], None).unwrap();
        }
    }
    build(polygons, true, &Stop::new()).unwrap().0
}

/// So many that other threads are woken, whatever the build.
#[test]
fn large_meshes_give_the_same_bits() {
    check(PARALLEL, &[cone(80, 80)]).unwrap();
}

/// A program around a loop over the vertices of an octahedron, whose numbers are 0 to 5.
fn with_numbers(round: &str) -> String {
    format!(
        "vertex {{ int n; double x; }};\n{OCTAHEDRON}
static int deep(int n) {{ return n > 0 ? deep(n - 1) + 1 : 0; }}
static void endless(vertex p) {{ while (p$n >= 0) p$x += 1; }}
void step(mesh& S) {{
  int i = 0;
  forall p in S p$n = i++;
  parallel forall p in S {{ {round} }}
}}
"
    )
}

#[track_caller]
fn check_fails(round: &str, message: &str) {
    let text = with_numbers(round);
    let failure = check(&text, &[start(&text)]).unwrap_err();
    assert_eq!(failure.diagnostic.message, message);
}

#[test]
fn an_error_in_a_round_is_that_of_the_first_in_turn() {
    check_fails("p$x = 1 / (p$n - 3);", "this divides by zero");
    check_fails("if (p$n == 2) p$x = 1 % (p$n - 2); p$x = 1 / (p$n - 4);", "this divides by zero");
    check_fails("p$x = deep(p$n < 4 ? 3 : 100000);", "more than 10000 calls are open at once");
    check_fails("vertex q = p$n == 5 ? null : p; p$x = q$pos.x;", "null has no position");
}

#[test]
fn calls_may_be_as_deep_as_elsewhere() {
    let text = with_numbers("p$x = deep(9900 + p$n);");
    check(&text, &[start(&text)]).unwrap();
}

#[test]
fn rounds_that_never_end_are_given_up_when_one_before_them_fails() {
    check_fails("if (p$n == 0) p$n /= 0; while (true) p$x += 1;", "this divides by zero");
    check_fails("if (p$n == 0) p$n /= 0; endless(p);", "this divides by zero");
}

#[test]
fn a_stop_ends_all_rounds() {
    for round in ["while (true) p$x += 1;", "endless(p);", "if (p$n > 3) endless(p);"] {
        let text = with_numbers(round);
        let (native, start) = (Runner::new(&text, Engine::Native), start(&text));
        for threads in THREADS {
            let settings = Settings::default();
            stop_after(Duration::from_millis(50), &settings.stop);
            let failure = native.step(&start, threads, &settings).unwrap_err();
            assert_eq!(failure.kind, FailureKind::Stopped(Stopped::ByTime));
            let span = failure.diagnostic.span.unwrap();
            assert_eq!(&text[span.start as usize..span.end as usize], "S");
        }
    }
}

/// A random program with parallel loops as its step begins, and as it ends, if it comes so far.
pub fn with_loops(text: &str, seed: u64) -> String {
    let mut writer = Writer { random: Random::new(seed, 1), values: false };
    let functions = "static double reach(vertex p, int n) { return n > 0 ? reach(any in p, n - 1) : valence p; }
static vec about(vertex p) { vec m; forall q in `p m += `q$pos; return m; }
";
    let step = text.find("void step").unwrap_or(0);
    let (before, step) = text.split_at(step);
    let loops: Vec<String> = (0..2).map(|_| writer.parallel_loop()).collect();
    let mut begin = step.lines().take(5).collect::<Vec<_>>().join("\n");
    let _ = writeln!(begin, "\n  synchronize S;\n  {}", loops[0]);
    let rest = step.lines().skip(5).collect::<Vec<_>>().join("\n");
    let end = rest.trim_end().trim_end_matches('}');
    format!("{before}{functions}{begin}{end}  {}\n}}\n", loops[1])
}

/// Writes parallel loops.
struct Writer {
    random: Random,
    /// Whether rounds store numbers and mates; positions if not.
    values: bool,
}

impl Writer {
    fn below(&mut self, n: u64) -> u64 {
        self.random.bits() % n
    }

    fn pick<'a>(&mut self, from: &[&'a str]) -> &'a str {
        from[self.below(from.len() as u64) as usize]
    }

    fn parallel_loop(&mut self) -> String {
        self.values = self.below(2) == 0;
        let body: Vec<_> = (0..=self.below(5)).map(|_| self.statement(2)).collect();
        let (number, vertex) = (self.number(1), self.vertex(1));
        format!("parallel forall w in S {{ double y = {number}; vertex v = {vertex}; int m = i; {} }}", body.join(" "))
    }

    fn statement(&mut self, depth: u64) -> String {
        let (number, vertex) = (self.number(2), self.vertex(2));
        if depth > 0 && self.below(3) == 0 {
            let body = self.statement(depth - 1);
            let condition = self.pick(&["v < b", "is v in c", "y > x", "w == a", "is v in T", "m % 2 == 0"]);
            return match self.below(4) {
                0 => format!("if ({condition}) {{ {body} continue; }} else y = {number};"),
                1 => format!("forall q in {vertex} {{ v = q; {body} y += {number}; if ({condition}) break; }}"),
                2 => format!("forall q, r in `w {{ v = r; {body} if ({condition}) continue; m++; }}"),
                _ => format!("for (int k = 0; k < 3; k++) {{ m += k; {body} }}"),
            };
        }
        match (self.below(6), self.values) {
            (0, _) => format!("y -= {number};"),
            (1, _) => format!("v = {vertex};"),
            (2, true) => format!("w$mate = {vertex};"),
            (_, true) => format!("w$n += m + (y > {number});"),
            (2, false) => "w$pos += about(w) * 0.125;".to_owned(),
            (_, false) => format!("w$pos.{} = {number};", self.pick(&["x", "y", "z"])),
        }
    }

    fn vertex(&mut self, depth: u64) -> String {
        if depth == 0 || self.below(2) == 0 {
            return self.pick(&["w", "w", "a", "b", "c"]).to_owned();
        }
        let v = self.vertex(depth - 1);
        match self.below(4) {
            0 => format!("(any in {v})"),
            1 => format!("(nextto {v} in w)"),
            2 => format!("(prevto any in w in `({v}))"),
            _ if self.values => format!("(any in {v})"),
            _ => format!("{v}$mate"),
        }
    }

    fn number(&mut self, depth: u64) -> String {
        let v = self.vertex(1);
        if depth == 0 {
            return self.pick(&["x", "1.5", "i", "w$pos.x", "w$n", "`w$pos.z"]).to_owned();
        }
        let (a, b) = (self.number(depth - 1), self.number(depth - 1));
        match self.below(7) {
            0 => format!("({a} + {b})"),
            1 => format!("({a} * {b})"),
            2 => format!("cos({a} / {b})"),
            3 => format!("reach({v}, 2)"),
            4 => format!("(gaps {v} + valence {v})"),
            5 if self.values => format!("length({v}$pos)"),
            5 => format!("{v}$n"),
            _ => format!("`({v})$pos.y"),
        }
    }
}
