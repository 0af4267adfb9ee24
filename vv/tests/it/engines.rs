//! The engines give the same: every program of the specification runs on both, and so do the assets and programs nobody
//! wrote.

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
    let mut text = Writer::new(seed, seed % 8 < 3).program();
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

/// Uses every kind of expression and statement, with values that tell right from wrong.
const EVERYTHING: &str = r#"
vertex { double age = 1.5; vec dir = vec(1, 2, 3); int n = 4; bool flag = true; vertex mate; };
mesh { int generation = 3; vec centre; };
param int count = 5;
const double half = count / 2.0 - 2.0;

double longer(double x, double y) {
  double sum = 0;
  for (int i = 0; i < 12; i++) {
    if (i == 7) continue;
    if (i % 5 == 4) sum -= x / (i + 1.0); else sum += x * y + i;
    sum += sum > 100 ? -50 : floor(sum) / 8;
    sum = min(sum, 1e6) - max(-sum, -1e6) * 0.125 + abs(i - 6) + fabs(x) + clamp(y, 0, 1) + hypot(x, y);
  }
  return sum;
}
int factorial(int n) { return n <= 1 ? 1 : n * factorial(n - 1); }
double slow(double x, int n) { if (n == 0) return x; return slow(x * 0.5 - 1, n - 1) + x; }
vertex first(mesh& S) { forall v in S { if (valence v > 4) return v; } return null; }
mesh far(mesh S, double x) { mesh T; forall v in S { if (v$pos.x > x) add v to T; } return T; }
void swap(vertex& a, vertex& b) { vertex c = a; a = b; b = c; }
vertex insert(vertex p, vertex q) {
  vertex x; make {p, q} nb_of x; replace p with x in q; replace q with x in p; return x;
}

void step(mesh& S) {
  synchronize S;
  mesh T, U;
  print "begin ", count, " ", half, " ", longer(half, 0.75), " ", factorial(10), " ", slow(3, 20);
  forall p in S {
    p$n += valence p * 2 - gaps p; p$age *= 0.5 + p$pos.x; p$dir = cross(p$dir, p$pos) + -p$dir; p$mate = any in p;
    p$flag = is p in S && !(is p in T) || is null in p;
    p$pos.y += length(p$dir) + dot(p$dir, `p$pos) + distance(p$pos, `p$pos) + sin(p$age) + pow(p$age, 1.5) + sqrt(2);
    print p, p$n, " ", p$age, p$dir, p$mate, p$flag, p$pos, `p$pos, normalize(p$pos);
    forall q in `p {
      vertex a = nextto q in `p, b = prevto q in `p;
      print q, a, b, " ", p < q, a <= b, q != a, p == q, is q in p, gaps q;
      if (p < q) continue;
      if (is q in p && valence p > 2) {
        vertex x = insert(p, q);
        x$pos = 0.5 * `p$pos + `q$pos / 2;
        add x to T;
        print x, any in x, nextto p in x, prevto q in `p, nextto x in p, x$n, x$age, x$dir, x$flag, x$mate;
      }
    }
  }
  forall x in T {
    vertex p = any in x, q = nextto p in x;
    if (nextto x in q && prevto x in p) make {nextto x in q, q, prevto x in q, nextto x in p, p, prevto x in p} nb_of x;
  }
  vertex v = first(S), w = null;
  print v; vertex top = v; swap(v, w);
  print v, w, S$generation, S$centre;
  S$generation += 2; S$centre = vec(1, 2, 3); S$centre.z = 7;
  if (w) {
    vertex y;
    vertex z, u, k = any in w; splice y after k in w; splice z before y in w; splice u before k in w;
    make {k, w} nb_of z; splice y after k in z; splice u before w in z; erase k from z; forall q in z { print q; }
    erase k from w;
    splice null before y in w; erase null from w;
    forall q in w { erase q from w; print q, valence w, gaps w; }
    forall q in w { print q; }
    make {y, k, null} nb_of w;
    print valence w, gaps w, nextto null in w, prevto null in w;
  }
  U = far(T, -100); merge S with U; merge S with far(T, 0.25);
  remove top from U; forall x in T { remove x from U; if (x$n > 3) break; }
  print U, S, S$generation, S$centre;
  int i = 7; double d = 2.75; bool b = d > 2;
  i += 3; i -= 1; i *= 2; i /= 4; i %= 3; i++; --i; d++; d -= 0.5; i = d * 3; int j = b; double e = b;
  int minus = -7; double m = minus;
  print i, d, b, j, e, m, minus / 2, minus % 4, min(i, j), max(i, j), (bool)1, vec(1, 2, 3) == vec(1, 5, 3), b == (d > 1);
  do { i--; if (i < -3) break; if (i == 0) continue; print i; } while (i > -10);
}
"#;

/// Edge values, which go through splits, and rings that are edited beside them.
const EDGES: &str = r#"
edge { double s = 0.25; vec way; vertex via; };
void step(mesh& S) {
  synchronize S;
  forall p in S { forall q in p { (p|q)$s += p < q ? 1.5 : 0.125; (p|q)$way.y = (p|q)$s; (p|q)$via = p; } }
  forall p in S { forall q in `p {
    print p, q, `(p|q)$s, (q|p)$s, (p|q)$way, (p|q)$via;
    if (p < q) continue;
    vertex x; make {p, q} nb_of x; replace p with x in q; replace q with x in p;
    splice null after q in x; add x to S;
    print (p|x)$s, (x|q)$s; erase x from p; vertex f = any in p; if (f != null) splice x after f in p;
  } }
}
"#;

/// Rings as values, faces, pairs, and loops that begin somewhere.
const RINGS: &str = r#"
ring turned(ring r) { ring s; forall x in r from nextto any in r in r add x to s; return s; }
void grow(ring& r, vertex x) { add x to r; add any in r to r; }
void show(ring r) { print r, " ", valence r, any in r; }
void step(mesh& S) {
  synchronize S;
  mesh C;
  ring kept;
  int n = 0;
  forall f in faces S {
    ring r;
    vertex c;
    n++;
    show(f); print f, n, any in f;
    forall p, q in f {
      c$pos += p$pos * n + q$pos / 3;
      print p, q, nextto q in f, prevto p in f, is c in f;
      forall x in f from p, q { print x; if (x == q) break; }
      forall x, y in p from q { print x, y; }
      add q to r;
      if (p < q) splice c after q in p;
    }
    r = turned(r);
    print r, f, n % 2 == 0 ? r : f;
    if (n % 3 == 0) kept = r;
    make r nb_of c; add c to C;
    grow(r, c); print r, valence r;
    erase any in r from r; replace any in r with c in r; splice c before any in r in r; splice c after c in r;
    print r, is c in r, nextto c in r, prevto c in r;
    forall x in r { add c to r; if (valence r > 30) { print r; break; } }
  }
  forall p, q in kept from nextto any in kept in kept, prevto any in kept in kept print p, q;
  ring long;
  forall v in S { forall p, q in v { print v, p, q; add q to long; } forall p, q in `v print p, q; }
  print long, valence long, nextto any in long in long;
  vertex hub, far; ring eight;
  forall x in long { if (!(is x in eight) && valence eight < 8) add x to eight; }
  make eight nb_of hub; print hub; forall p, q in hub from any in eight print p, q;
  erase any in eight from eight; make eight nb_of hub; print valence hub; forall q in hub { erase q from hub; print q; }
  merge S with C;
  forall f in faces C show(f);
}
"#;

/// A mistake in these ends in no error, which would be found by the interpreter.
const APPENDED: &str = "
void step(mesh& S) {
  ring r;
  forall v in S { if (valence r < 5) add v to r; }
  print r;
  vertex v; make r nb_of v; add v to S;
  forall q in v print q;
}
";

/// What compiled code knows of new vertices and spares itself to ask: the first end in an error, the others do not.
/// `a`, `b` and `c` are a face of an octahedron.
const NEW: [&[&str]; 2] = [
    &[
        "vertex x; replace a with x in b; replace c with x in b;",
        "vertex x; splice x after a in b; splice x after c in b;",
        "vertex x; if (a < c) replace a with x in b; replace c with x in b;",
        "vertex x; if (a > c) print a; else replace a with x in b; replace c with x in b;",
        "vertex x; forall q in a splice x after any in b in b;",
        "vertex x; for (int i = 0; i < 2; i++) { if (i > 0) replace c with x in b; replace a with x in b; }",
        "vertex x; while (!(is x in b && valence x)) { make {a} nb_of x; replace any in b with x in b; \
         if (is a in x) replace nextto x in b with x in b; }",
        "vertex x, y; if (a < c) y = x; replace a with y in b; replace c with x in b;",
        "vertex x, y = a < c ? x : null; replace a with y in b; replace c with x in b;",
        "vertex x; a$mate = x; replace a with a$mate in b; replace c with x in b;",
        "vertex x; replace a with x in b; vertex y = prevto c in b; replace c with y in b;",
        "vertex x; put(x, b, 2); replace c with x in b;",
        "vertex x; put(x, b, 0); replace c with x in b;",
        "vertex x; ring r; add x to r; add c to r; make r nb_of b; replace c with x in b;",
        "vertex x, p = a < c ? b : c; replace a with x in p; replace c with x in b;",
        "vertex x, y; replace a with y in b; replace c with x in b; replace y with x in b;",
        "vertex x; make {x, a} nb_of b; replace a with x in b;",
        "vertex x; make {a, a} nb_of x;",
        "vertex x, y = a; make {a, y} nb_of x;",
        "vertex x, y = prevto b in a; make {y, prevto b in a} nb_of x;",
        "vertex x; make {a, x} nb_of x;",
        "vertex x; make {a, b, c, any in a, nextto any in a in a} nb_of x;",
        "vertex x; make {a, b, c, x, any in b} nb_of x;",
        "vertex x; make {a, b, c, a} nb_of x;",
        "replace a with b in b;",
        "synchronize S; vertex x; vec v = `a$pos + `x$pos;",
        "synchronize S; vertex x; vec v = `a$pos + `(nextto x in `a)$pos;",
        "vec v = `a$pos + `b$pos;",
        "replace a with any in b in b;",
        "forall q in b replace q with b in b;",
        "vertex x; make {b} nb_of x; replace b with x in x;",
        "vertex x, y = a > c ? b : x; make {c, b} nb_of y; replace b with x in y;",
        "vertex x; make {a, b, c} nb_of x; splice x after a in b; splice x after c in b;",
        "vertex x = nextto (nextto c in b) in a; erase a from x;",
        "vertex x = nextto c in a; erase b from x; splice c after b in a;",
    ],
    &[
        "vertex x; make {a, b} nb_of x; replace a with x in b; replace b with x in a; print any in x, nextto b in x;",
        "vertex x; make {a, b} nb_of x; make {c} nb_of x; make {b, c, a} nb_of x; erase c from x; print any in x;",
        "vertex x; erase a from x; make {a, b} nb_of x; erase a from x; make {c, a, b} nb_of x; print nextto c in x;",
        "vertex x; make {} nb_of x; make {a} nb_of x; print nextto a in x, prevto b in x;",
        "vertex x, y = a < c ? x : a; make {a} nb_of y; make {b, c} nb_of x; print any in x, nextto b in x;",
        "vertex x, y; make {x, a} nb_of y; make {y, a} nb_of x; replace a with b in x; replace a with x in b; print x, y;",
        "for (int i = 0; i < 3; i++) { vertex x; make {b, a} nb_of x; splice x after a in b; erase b from x; }",
        "vertex x; replace a with x in b; erase x from b; splice x before c in b; print any in b, nextto c in b;",
        "vertex x; put(x, b, 2); print is x in b;",
        "vertex x; make {a, nextto x in b} nb_of x; print valence x, gaps x;",
        "synchronize S; forall q in `a { vertex x; erase any in a from a; replace q with x in a; }",
        "synchronize S; forall q in `a { vertex x, y; splice y before any in a in a; replace q with x in a; }",
        "synchronize S; make {c, b} nb_of a; forall q in `a { vertex x; replace q with x in a; }",
        "synchronize S; make {} nb_of a; forall q in `a { vertex x; replace q with x in a; splice x after q in b; }",
        "synchronize S; vertex p = a < c ? b : c; forall q in `a { vertex x; replace q with x in p; replace p with x in a; }",
        "mesh T; add a to T; remove a from T; vertex x; add x to T; add b to T; print T, is x in T, is a in T, is c in T;",
        "a$mate = b; vec v = a$pos + a$mate$pos * 2 - (nextto a in b)$pos; b$pos = v.x * v + a$pos; print v, b$pos;",
        "vertex x; make {a, b, c, nextto x in a} nb_of x; print valence x, gaps x;",
        "vertex x, y; make {a, b, c, y, nextto x in a, any in x} nb_of x; print valence x, gaps x;",
        "vertex x; make {a, b, c} nb_of x; splice x after a in b; splice x after b in c; splice x after c in a;",
        "vertex x = nextto c in a, y = prevto c in a; splice y after c in x; erase c from y; erase c from a; print any in a;",
        "vertex x = prevto b in a; erase b from x; erase b from a; erase a from b;",
        "vertex x = nextto c in a; erase a from x; erase b from a; erase c from a;",
        "vertex x = nextto c in a; erase a from x; vertex y; splice y before any in a in a; splice y after c in x; erase c from a;",
        "vertex x = nextto c in a, y = a < c ? a : c; erase a from x; erase b from y; erase c from a;",
        "vertex x = nextto c in a; erase a from x; make {c, b} nb_of a; vertex y; splice y after c in a; print nextto c in a;",
        "vertex x = nextto c in a; if (a < c) { erase a from x; erase b from a; } else erase x from a; print prevto c in a;",
        "vertex x = nextto c in a; print is a in x; vertex y; replace c with y in a; splice y after c in a; erase c from a;",
        "vertex x, y; make {a} nb_of x; make {b, c, a} nb_of y; vertex n = a; \
         for (int i = 0; i < 20; i++) { vertex z; splice z after n in x; print nextto z in x, prevto n in x; n = z; } \
         forall q in x { erase q from x; print valence x; forall r in x print r; } forall q in y print q;",
        "vertex x, y; make {a} nb_of x; make {b, c, a} nb_of y; vertex n = a; \
         for (int i = 0; i < 20; i++) { vertex z; splice z before n in x; n = i % 2 ? z : n; } forall q in x print q; \
         while (valence x) { vertex q = any in x; q = nextto q in x; q = nextto q in x; erase q from x; print q; } \
         forall q in y print q;",
    ],
];

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
                && NEW.concat().iter().all(|body| compare_generated(&with_new(body), mutation).is_ok())
                && (0..40).all(|seed| compare_generated(&generate(seed), mutation).is_ok())
        })
        .collect();
    assert!(missed.is_empty(), "{missed:?}");
}
