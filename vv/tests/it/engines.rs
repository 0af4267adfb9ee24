//! The engines give the same: every program of the specification runs on both, and so do the assets and programs nobody
//! wrote.

mod parallel;
mod programs;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use vv::engine::{Engine, Failure, FailureKind, Limits, Machine, Mutation, Output, OutputClosed, Settings};
use vv::io::{Format, ReadOptions, read};
use vv::ir::{FunctionId, GlobalId, Param, Program};
use vv::mesh::close::close;
use vv::mesh::{Mesh, Value};
use vv::stop::{Stop, Stopped};

use programs::{APPENDED, EDGES, EVERYTHING, NEW, PARALLEL, RINGS};

use crate::run::generated::Writer;
use crate::run::{OCTAHEDRON, SQUARE};

/// As [`vv::engine::run`], on both engines, which must agree.
#[track_caller]
pub fn run(
    program: &Program,
    function: FunctionId,
    mesh: &Mesh,
    generation: u64,
    settings: &Settings,
    output: &mut dyn Output,
) -> Result<Mesh, Failure> {
    let native = Machine::new(Arc::new(program.clone()), Engine::Native);
    assert_eq!(native.refusal(), None);
    match compare(program, &native, function, mesh, generation, settings) {
        Ok((result, lines)) => {
            for line in lines {
                let _ = output.print(&line);
            }
            result
        }
        Err(difference) => panic!("{difference}"),
    }
}

type Ended = (Result<Mesh, Failure>, Vec<String>);

/// What the interpreter gives, or how the other engine differs from it.
pub fn compare(
    program: &Program,
    native: &Machine,
    function: FunctionId,
    mesh: &Mesh,
    generation: u64,
    settings: &Settings,
) -> Result<Ended, String> {
    let mut lines = [Vec::new(), Vec::new()];
    let [interpreted, compiled] = &mut lines;
    let first = vv::engine::run(program, function, mesh, generation, settings, interpreted);
    let second = native.run(function, mesh, generation, settings, compiled);
    match (&first, &second) {
        (Ok(a), Ok(b)) => {
            let (a, b) = (state(a), state(b));
            if a != b {
                return Err(difference(&a, &b));
            }
        }
        // Where a stop is noticed, and what was printed before, depends on the moment.
        (Err(a), Err(b)) if matches!(a.kind, FailureKind::Stopped(_)) && a.kind == b.kind => {
            let [interpreted, _] = lines;
            return Ok((first, interpreted));
        }
        (Err(a), Err(b)) => {
            if (a.kind, &a.diagnostic) != (b.kind, &b.diagnostic) {
                return Err(format!("interpreted {a:?}\ncompiled {b:?}"));
            }
            // Compiled code may come some lines further before memory is counted.
            if a.kind == FailureKind::Budget {
                let shorter = lines[0].len().min(lines[1].len());
                lines.iter_mut().for_each(|lines| lines.truncate(shorter));
            }
        }
        (Ok(_), Err(b)) => return Err(format!("only compiled code fails: {b:?}")),
        (Err(a), Ok(_)) => return Err(format!("only the interpreter fails: {a:?}")),
    }
    let [interpreted, compiled] = lines;
    if interpreted != compiled { Err(difference(&interpreted, &compiled)) } else { Ok((first, interpreted)) }
}

fn difference(a: &[String], b: &[String]) -> String {
    let at = a.iter().zip(b).position(|(a, b)| a != b).unwrap_or(a.len().min(b.len()));
    format!("interpreted {:?}\n   compiled {:?}", a.get(at), b.get(at))
}

/// All that can be known of a mesh, one line each.
fn state(mesh: &Mesh) -> Vec<String> {
    let mut lines = Vec::new();
    for v in mesh.vertices() {
        lines.push(format!("ring of {v}: {:?}", mesh.ring(v).slots()));
        lines.push(format!("position of {v}: {}", bits(Value::Vec(mesh.position(v)))));
        for (i, property) in mesh.vertex_properties().iter().enumerate() {
            lines.push(format!("{} of {v}: {:?}", property.name, mesh.vertex_value(i, v).map(bits)));
        }
        for x in mesh.ring(v).vertices() {
            for (i, property) in mesh.edge_properties().iter().enumerate() {
                lines.push(format!("{} of {v}, {x}: {:?}", property.name, mesh.edge_value(i, v, x).map(bits)));
            }
        }
    }
    lines.push(format!("set {:?}", mesh.set.iter().collect::<Vec<_>>()));
    for (name, value) in mesh.mesh_properties() {
        lines.push(format!("{name}: {}", bits(*value)));
    }
    lines
}

/// A value to the bit; which NaN it is no program can tell, and the machine may choose.
fn bits(value: Value) -> String {
    let double = |x: f64| if x.is_nan() { "nan".to_owned() } else { format!("{x} {:x}", x.to_bits()) };
    match value {
        Value::Double(x) => double(x),
        Value::Vec(v) => format!("{:?}", v.to_array().map(double)),
        other => format!("{other:?}"),
    }
}

fn assets(folder: &str, extension: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets").join(folder);
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == extension));
    paths.sort();
    paths
}

pub fn compile_file(path: &Path) -> Arc<Program> {
    let text = std::fs::read_to_string(path).unwrap();
    let folder = path.parent().unwrap().to_owned();
    let mut include = |_: &str, name: &str| {
        let text = std::fs::read_to_string(folder.join(name)).map_err(|e| e.to_string())?;
        Ok(vv::Included { name: name.to_owned(), text })
    };
    vv::compile("program.vv", &text, &mut include).program.unwrap()
}

/// Every rule of the assets on every mesh of the assets, two steps, as long as the mesh is small.
#[test]
fn the_assets_run_the_same() {
    let meshes: Vec<_> = assets("meshes", "obj")
        .into_iter()
        .map(|path| {
            (path.clone(), read(&std::fs::read(&path).unwrap(), Format::Obj, &ReadOptions::default()).unwrap().0)
        })
        .collect();
    for path in assets("programs", "vv") {
        let program = compile_file(&path);
        let native = Machine::new(Arc::clone(&program), Engine::Native);
        assert_eq!(native.refusal(), None, "{}", path.display());
        let rules = program.rules.iter().map(|&r| Some(r)).chain(program.rules.is_empty().then_some(None));
        for (rule, (name, mesh)) in rules.flat_map(|rule| meshes.iter().map(move |mesh| (rule, mesh))) {
            let mut mesh = mesh.clone();
            let steps = rule.into_iter().flat_map(|r| [(r, 1), (r, 2)]);
            for (function, generation) in program.start.map(|start| (start, 0)).into_iter().chain(steps) {
                if mesh.vertex_count() > 1000 {
                    break;
                }
                let settings = Settings { seed: 7, params: least(&program), ..Settings::default() };
                match compare(&program, &native, function, &mesh, generation, &settings) {
                    Ok((Ok(new), _)) => {
                        mesh = new;
                        close(&mut mesh, &Stop::new()).unwrap();
                    }
                    Ok((Err(_), _)) => break,
                    Err(difference) => panic!("{} on {}: {difference}", path.display(), name.display()),
                }
            }
        }
    }
}

/// Each `param int` at the low end of its range.
fn least(program: &Program) -> Vec<(GlobalId, Value)> {
    let low = |param: &Param| param.range.map(|(low, _)| low).filter(|low| matches!(low, Value::Int(_)));
    program.params().filter_map(|(id, _, param)| Some((id, low(param)?))).collect()
}

/// `VV_GENERATED` sets how many.
#[test]
fn generated_programs_run_the_same() {
    let programs = std::env::var("VV_GENERATED").ok().and_then(|n| n.parse().ok()).unwrap_or(300);
    let first = std::env::var("VV_FIRST").ok().and_then(|n| n.parse().ok()).unwrap_or(100_000);
    for seed in first..first + programs {
        let text = generate(seed);
        if let Err(difference) = compare_generated(&text, Mutation::None) {
            panic!("{difference}\nseed {seed}\n{text}");
        }
    }
}

/// A random program. Some have no edge values, without which rings are edited another way, some begin with a square, or
/// with a wheel of many spokes.
fn generate(seed: u64) -> String {
    let mut text = parallel::with_loops(&Writer::new(seed, seed % 8 < 3).program(), seed);
    if !seed.is_multiple_of(4) {
        text = text.replace("edge { double s; };", "");
        for name in ["a", "b", "c", "d"] {
            text = text.replace(&format!("(a|{name})$s +="), "x +=");
        }
    }
    match seed % 3 {
        0 => text,
        1 => text.replace(OCTAHEDRON, SQUARE),
        _ => text.replace(OCTAHEDRON, &wheel(5 + seed % 14)),
    }
}

/// A hub, spokes around it, and a rim.
fn wheel(spokes: u64) -> String {
    let names: Vec<_> = (0..spokes).map(|i| format!("r{i}")).collect();
    let mut body = format!("vertex hub, {}; make {{{}}} nb_of hub; add hub to S;", names.join(", "), names.join(", "));
    for i in 0..names.len() {
        let (next, previous) = (&names[(i + 1) % names.len()], &names[(i + names.len() - 1) % names.len()]);
        let r = &names[i];
        body.push_str(&format!(
            "make {{{previous}, null, {next}, hub}} nb_of {r}; add {r} to S; {r}$pos = vec({i}, 1, 2);"
        ));
    }
    format!("void start(mesh& S) {{ {body} }}\n")
}

fn compare_generated(text: &str, mutation: Mutation) -> Result<(), String> {
    let compilation = vv::compile("test.vv", text, &mut |_, _| Err(String::new()));
    let program = compilation.program.ok_or("does not compile")?;
    let native = Machine::with_mutation(Arc::clone(&program), Engine::Native, mutation);
    let limits = Limits { max_vertices: 500, max_bytes: 1 << 20, max_call_depth: 30 };
    let mut mesh = Mesh::new();
    for (function, generation) in [(program.start, 0), (program.default_rule(), 1)] {
        let Some(function) = function else { continue };
        // Some never end, under either engine.
        let stop = Stop::new();
        let settings = Settings { limits, stop: stop.clone(), ..Settings::default() };
        thread::spawn(move || {
            thread::sleep(Duration::from_millis(500));
            stop.request(Stopped::ByTime);
        });
        match compare(&program, &native, function, &mesh, generation, &settings) {
            // One may have come to its end, whatever that is, before the time was over, and the other not.
            Err(_) if settings.stop.check().is_err() => break,
            Err(difference) => return Err(difference),
            Ok((Ok(new), _)) => mesh = new,
            // Where memory ends is the one thing engines may see differently.
            Ok((Err(failure), _)) => {
                assert_ne!(failure.kind, FailureKind::OutputClosed);
                break;
            }
        }
    }
    Ok(())
}

/// What is printed before an error stays, and is not printed again.
#[test]
fn lines_before_an_error_are_printed_once() {
    let text = "void step(mesh& S) { for (int i = 0; i < 3; i++) print i; vertex v = null; print v$pos; }";
    let program = vv::compile("test.vv", text, &mut |_, _| Err(String::new())).program.unwrap();
    let native = Machine::new(Arc::clone(&program), Engine::Native);
    let mut lines = Vec::new();
    let rule = program.default_rule().unwrap();
    native.run(rule, &Mesh::new(), 1, &Settings::default(), &mut lines).unwrap_err();
    assert_eq!(lines, ["0", "1", "2"]);
}

/// A closed output ends the step where it was noticed.
#[test]
fn a_closed_output_ends_the_step() {
    struct Closed(usize);
    impl Output for Closed {
        fn print(&mut self, _: &str) -> Result<(), OutputClosed> {
            self.0 += 1;
            if self.0 > 2 { Err(OutputClosed) } else { Ok(()) }
        }
    }
    let text = "void say(int n) { print n; }\nvoid step(mesh& S) { while (true) say(1); }";
    let program = vv::compile("test.vv", text, &mut |_, _| Err(String::new())).program.unwrap();
    let rule = program.default_rule().unwrap();
    let run = |engine| {
        let machine = Machine::new(Arc::clone(&program), engine);
        let mut closed = Closed(0);
        let failure = machine.run(rule, &Mesh::new(), 1, &Settings::default(), &mut closed).unwrap_err();
        assert_eq!((failure.kind, closed.0), (FailureKind::OutputClosed, 3));
        failure.diagnostic
    };
    assert_eq!(run(Engine::Native), run(Engine::Interpret));
}

/// What takes long in the runtime asks there whether to stop, and is named where it does.
#[test]
fn a_stop_is_reported_where_it_was_noticed() {
    struct StopsAtOnce(Stop);
    impl Output for StopsAtOnce {
        fn print(&mut self, _: &str) -> Result<(), OutputClosed> {
            self.0.request(Stopped::ByTime);
            Ok(())
        }
    }
    let parallel = "parallel forall v in S v$pos.x = 1;";
    for statement in
        ["forall f in faces S print f;", "synchronize S;", "synchronize N;", "print S;", "print r;", parallel]
    {
        let text = format!(
            "{OCTAHEDRON}void step(mesh& S) {{ mesh N; ring r; forall v in S {{ add v to N; add v to r; break; }} print 0; {statement} }}"
        );
        let program = compile_text(&text);
        let start = Machine::new(Arc::clone(&program), Engine::Native);
        let start = start.run(program.start.unwrap(), &Mesh::new(), 0, &Settings::default(), &mut Vec::new()).unwrap();
        let run = |engine| {
            let machine = Machine::new(Arc::clone(&program), engine);
            assert_eq!(machine.engine(), engine);
            let settings = Settings::default();
            let mut output = StopsAtOnce(settings.stop.clone());
            machine.run(program.default_rule().unwrap(), &start, 1, &settings, &mut output).map_err(|failure| {
                assert_eq!(failure.kind, FailureKind::Stopped(Stopped::ByTime), "{statement}");
                failure.diagnostic
            })
        };
        let [native, interpreted] = [run(Engine::Native), run(Engine::Interpret)];
        assert_eq!(native.err(), interpreted.err(), "{statement}");
    }
}

/// A program around one of them.
fn with_new(body: &str) -> String {
    format!(
        "vertex {{ vertex mate; }};\n{OCTAHEDRON}
void put(vertex x, vertex v, int n) {{
  if (n > 0) {{ put(x, v, n - 1); return; }}
  splice x after any in v in v;
}}
void step(mesh& S) {{
  vertex a, b, c;
  forall v in S {{ a = v; break; }}
  b = any in a; c = nextto a in b;
  {body}
  forall v in S {{ print v; forall q in v print q; }}
}}
"
    )
}

#[test]
fn what_is_known_of_new_vertices_is_true() {
    for (body, fails) in NEW.iter().zip([true, false]).flat_map(|(l, fails)| l.iter().map(move |b| (b, fails))) {
        let text = with_new(body);
        let program = compile_text(&text);
        let native = Machine::new(Arc::clone(&program), Engine::Native);
        assert_eq!(native.refusal(), None);
        let settings = Settings::default();
        let start = compare(&program, &native, program.start.unwrap(), &Mesh::new(), 0, &settings).unwrap();
        let step = compare(&program, &native, program.default_rule().unwrap(), &start.0.unwrap(), 1, &settings);
        let (ended, _) = step.unwrap_or_else(|difference| panic!("{body}\n{difference}"));
        assert_eq!(ended.is_err(), fails, "{body}\n{ended:?}");
    }
}

/// Where old values are made: first thing in a run, where the mesh as it came will do, and elsewhere. `old` and `first` have
/// sets of their own, so that they are compiled by themselves.
const OLD: &[&str] = &[
    "old(S); move(S); show(S);",
    "mesh T = S; { int n = 2; old(T); } move(S); show(T);",
    "move(S); old(S); move(S); show(S);",
    "old(S); move(S); old(S); show(S);",
    "if (count < 3) move(S); old(S); move(S); show(S);",
    "for (int i = 0; i < 2; i++) { old(S); move(S); } show(S);",
    "move(S); first(S); show(S);",
    "moved(S); old(S); show(S);",
    "around(S); move(S); show(S);",
    "move(S); around(S); move(S); show(S);",
    "mesh T = twisted(S); old(S); show(S);",
    "synchronize S; move(S); show(S);",
    "move(S); synchronize S; move(S); show(S);",
];

/// A program around one of them.
fn with_old(body: &str) -> String {
    format!(
        "param int count = 2;\n{OCTAHEDRON}
static void move(mesh& S) {{
  forall v in S {{ v$pos.x += 1; make {{prevto any in v in v, any in v}} nb_of v; }}
}}
static void old(mesh& S) {{ mesh T = S; synchronize T; }}
static void show(mesh& S) {{ forall v in S {{ print v, `v$pos, v$pos; forall q in `v print q; forall q in v print q; }} }}
static void moved(mesh& S) {{ mesh T = S; move(T); }}
static void around(mesh& S) {{ mesh T; old(S); merge S with T; }}
static mesh twisted(mesh S) {{ move(S); return S; }}
void first(mesh& S) {{ synchronize S; mesh T = S; move(T); }}
void step(mesh& S) {{ {body} }}
"
    )
}

#[test]
fn what_is_made_old_is_what_stood_there() {
    OLD.iter().for_each(|body| check_to_the_end(&with_old(body)));
}

#[track_caller]
fn compile_text(text: &str) -> Arc<Program> {
    let compilation = vv::compile("test.vv", text, &mut |_: &str, _: &str| Err(String::new()));
    compilation.program.unwrap_or_else(|| panic!("{text}\n{:#?}", compilation.diagnostics))
}

/// A hexagon around a vertex, open, and its program's text.
fn everything() -> String {
    format!("{}{}", wheel(6), EVERYTHING.replace("(bool)1, ", ""))
}

#[test]
fn everything_runs_the_same() {
    check_to_the_end(&everything());
    check_to_the_end(&format!("{OCTAHEDRON}{EDGES}"));
    check_to_the_end(&format!("{OCTAHEDRON}{RINGS}"));
    check_to_the_end(&format!("{OCTAHEDRON}{APPENDED}"));
    check_to_the_end(&format!("{}{PARALLEL}", wheel(40)));
    check_to_the_end(&format!("{OCTAHEDRON}{PARALLEL}"));
}

/// Both engines give the same for `start` and a step, and that is no error: a program that fails early compares little.
#[track_caller]
fn check_to_the_end(text: &str) {
    let program = compile_text(text);
    let native = Machine::new(Arc::clone(&program), Engine::Native);
    assert_eq!(native.refusal(), None);
    let settings = Settings::default();
    let mesh = compare(&program, &native, program.start.unwrap(), &Mesh::new(), 0, &settings).unwrap().0.unwrap();
    let (mesh, lines) = compare(&program, &native, program.default_rule().unwrap(), &mesh, 1, &settings).unwrap();
    mesh.unwrap_or_else(|failure| panic!("{}\n{failure:#?}", lines.join("\n")));
}

/// Each thing that is compiled wrongly on purpose is found.
#[test]
fn planted_mistakes_are_found() {
    let everything = everything();
    let missed: Vec<_> = Mutation::ALL
        .iter()
        .filter(|&&mutation| {
            compare_generated(&everything, mutation).is_ok()
                && compare_generated(&format!("{OCTAHEDRON}{EDGES}"), mutation).is_ok()
                && compare_generated(&format!("{OCTAHEDRON}{RINGS}"), mutation).is_ok()
                && compare_generated(&format!("{OCTAHEDRON}{APPENDED}"), mutation).is_ok()
                && compare_generated(&format!("{OCTAHEDRON}{PARALLEL}"), mutation).is_ok()
                && NEW.concat().iter().all(|body| compare_generated(&with_new(body), mutation).is_ok())
                && OLD.iter().all(|body| compare_generated(&with_old(body), mutation).is_ok())
                && (0..40).all(|seed| compare_generated(&generate(seed), mutation).is_ok())
        })
        .collect();
    assert!(missed.is_empty(), "{missed:?}");
}
