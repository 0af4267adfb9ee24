//! What checks without an error never makes an engine panic: programs with a few tokens changed either are refused, or
//! run to a mesh or a located error.

use std::ops::Range;
use std::sync::mpsc;
use std::time::Duration;

use vv::builtins::Random;
use vv::diagnostic::Severity;
use vv::engine::{Limits, Settings, run};
use vv::ir::Program;
use vv::mesh::{Mesh, close};
use vv::stop::{Stop, Stopped};
use vv::syntax::TokenClass;

use super::{INSERT, compiled};

/// Something of everything.
const PROGRAM: &str = "
const int n = 3;
param double w = 1.0 / 16 in [0, 1];
param bool on = w > 0.1 || n == 3;
vertex { double age = 0; int kind; vertex mate; vec up = vec(0, 0, 1); bool seen; };
edge { double sharpness = 0.5; };
mesh { int generation; vec centre; };

void start(mesh& S) {
  vertex a, b, c, d;
  make {b, c, d} nb_of a; make {a, d, c} nb_of b; make {a, b, d} nb_of c; make {a, c, b} nb_of d;
  a$pos = vec(1, 1, 1); b$pos = vec(1, -1, -1); c$pos = vec(-1, 1, -1); d$pos = vec(-1, -1, 1);
  add a to S; add b to S; add c to S; add d to S;
}

int count(mesh M, int& total, double scale) {
  int k = 0;
  forall v in M { k++; total += int(scale); if (k > 100) break; else continue; }
  return k;
}

mesh boundary(const mesh& M) {
  mesh B;
  forall v in M if (is null in v && gaps v == 1) add v to B;
  return B;
}

vertex other(vertex v, const vec& p) {
  if (v == null || !v) return null;
  return distance(v$pos, p) < 2 * w ? any in v : prevto any in v in v;
}

void refine(mesh& S) {
  mesh NV, OLD = S;
  synchronize S;
  forall p in S {
    p$age += 1; p$mate = other(p, `p$pos); p$seen = !p$seen; p$up.x -= w * p$kind--;
    forall q in `p {
      if (p < q) continue;
      vertex x = insert(p, q);
      x$pos = (`p$pos + `q$pos) / 2.0 + w * `(nextto q in `p)$pos - cross(p$up, q$up) * random();
      (p|x)$sharpness = max((p|x)$sharpness - 0.25, 0);
      add x to NV;
    }
  }
  forall x in NV {
    vertex p = any in x, q = nextto p in x;
    make {nextto x in q, q, prevto x in q, nextto x in p, p, prevto x in p} nb_of x;
  }
  merge S with NV;
  int total = 0;
  S$generation = count(boundary(S), total, 1.5) + count(OLD, total, w);
  S$centre = vec(total, valence any in any in p0(S), n % 2);
  print \"generation \", S$generation, \" \", S$centre.x, is p0(S) in NV, on;
}

vertex p0(const mesh& M) { forall v in M return v; return null; }

ring around(const mesh& M, vertex v) {
  ring r;
  forall f in faces M if (is v in f) { r = f; break; }
  return r;
}

void lower(ring& r, vec by) { forall p, q in r p$pos -= by * w + q$pos * 0.01; erase any in r from r; }

double weight(ring f, vertex p, vertex q);

void quads(mesh& S) {
  mesh F, E;
  forall f in faces S {
    vertex c;
    ring r = f;
    forall p, q in f { c$pos += p$pos * weight(f, p, q); splice c after q in p; add q to r; }
    make f nb_of c;
    lower(r, c$up);
    replace any in r with c in r; splice c before nextto c in r in r;
    print r, valence r, is c in r, prevto c in r;
    add c to F;
  }
  forall a, b in p0(F) { erase b from a; add a to E; }
  ring last = w > 1 ? around(S, p0(S)) : around(E, p0(F));
  if (valence last > 0) forall x in last from any in last print x;
  merge S with F;
}

double weight(ring f, vertex p, vertex q) {
  double k = 0;
  forall x in f from p, q k += x$age / valence f;
  return k + 1.0 / valence f;
}

void cut(mesh& S) {
  vertex a = p0(S), b = any in a;
  splice null after b in a; replace b with null in a; splice b before nextto null in a in a; erase null from a;
  for (int i = 0, j = 9; i < j; ++i, j--) { do { i += 2; } while (i < n); a$kind = i * j / 2; }
  while (a && a$kind > 0) { a$kind -= 5; remove a from S; S = boundary(S); add b to S; }
}
";

/// A token with the white space before it.
type Token<'a> = (&'a str, TokenClass);

fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut at = 0;
    let token =
        |(range, class): (Range<usize>, TokenClass)| (&text[std::mem::replace(&mut at, range.end)..range.end], class);
    vv::syntax::highlight(text).into_iter().map(token).collect()
}

/// The text with one or two tokens changed: mostly into others of their class, which often gives a program again.
fn mutated(tokens: &[Token<'_>], random: &mut Random) -> String {
    let mut pick = |n: usize| (random.bits() % n as u64) as usize;
    let mut all = tokens.to_vec();
    for _ in 0..=pick(2) {
        let (i, other) = (pick(all.len()), pick(tokens.len()));
        match pick(12) {
            0 => {
                all.remove(i);
            }
            1 => all.insert(i, tokens[other]),
            2 => all[i] = tokens[other],
            _ => {
                let alike: Vec<_> = tokens.iter().filter(|t| t.1 == all[i].1).collect();
                all[i] = *alike[other % alike.len()];
            }
        }
    }
    all.iter().map(|t| t.0).collect()
}

/// Runs a rule for at most a tenth of a second.
fn run_briefly(program: &Program, rule: vv::ir::FunctionId, mesh: &Mesh, generation: u64) -> Option<Mesh> {
    let stop = Stop::new();
    let settings = Settings {
        limits: Limits { max_vertices: 1000, max_bytes: 1 << 20, max_call_depth: 100 },
        stop: stop.clone(),
        ..Settings::default()
    };
    let (done, waiting) = mpsc::channel::<()>();
    let watch = std::thread::spawn(move || {
        if waiting.recv_timeout(Duration::from_millis(100)) == Err(mpsc::RecvTimeoutError::Timeout) {
            stop.request(Stopped::ByTime);
        }
    });
    let result = run(program, rule, mesh, generation, &settings, &mut Vec::new());
    drop(done);
    watch.join().expect("the watch");
    match result {
        Ok(mut mesh) => {
            let said = close::close(&mut mesh, &Stop::new()).expect("nobody stops it");
            assert!(said.iter().all(|d| d.severity != Severity::Error), "{said:?}");
            Some(mesh)
        }
        Err(failure) => {
            assert!(failure.diagnostic.span.is_some(), "{failure:?}");
            None
        }
    }
}

fn run_all(program: &Program, tetrahedron: &Mesh) {
    let start = program.start.and_then(|start| run_briefly(program, start, &Mesh::new(), 0));
    for &rule in &program.rules {
        for mesh in start.iter().chain([tetrahedron]) {
            run_briefly(program, rule, mesh, 1).and_then(|mesh| run_briefly(program, rule, &mesh, 2));
        }
    }
}

#[test]
fn changed_programs_are_refused_or_run() {
    let text = format!("{INSERT}{PROGRAM}");
    let c = compiled(&text);
    assert!(c.diagnostics.is_empty(), "{:?}", c.diagnostics);
    let program = c.program.expect("a program");
    let start = program.start.expect("a start");
    let tetrahedron = run_briefly(&program, start, &Mesh::new(), 0).expect("a mesh");
    assert_eq!(tetrahedron.vertex_count(), 4);
    for &rule in &program.rules {
        run_briefly(&program, rule, &tetrahedron, 1).expect("the rules run while nothing is changed");
    }
    let cases = std::env::var("VV_MUTATIONS").ok().and_then(|n| n.parse().ok()).unwrap_or(300);
    let tokens = tokens(&text);
    let mut ran = 0;
    for seed in 0..cases {
        let text = mutated(&tokens, &mut Random::new(seed, 0));
        let result = std::panic::catch_unwind(|| {
            let c = compiled(&text);
            assert_eq!(c.program.is_none(), c.diagnostics.iter().any(|d| d.severity == Severity::Error));
            c.program.map(|program| run_all(&program, &tetrahedron)).is_some()
        });
        ran += u64::from(result.unwrap_or_else(|_| panic!("case {seed}:\n{text}")));
    }
    assert!(ran > cases / 20, "only {ran} of {cases} changed programs ran");
}
