//! What programs do when they run.
//!
//! A test is a program and what it prints, followed, if it fails, by the error: place, text under it and message, then
//! labels (`at`), evidence (`=`), hints (`?`) and open calls (`in`).

mod algebra;
mod boundary;
mod budgets;
mod errors;
mod faces;
mod functions;
pub mod generated;
mod loops;
mod numbers;
mod old;
mod paper;
mod properties;
mod sets;

use vv::diagnostic::Diagnostic;
use vv::engine::Settings;
use vv::ir::Program;
use vv::mesh::Mesh;
use vv::source::{Sources, Span};

use crate::engines::run;

/// A unit octahedron; `x` is its vertex on the positive x axis, `X` that on the negative one.
pub const OCTAHEDRON: &str = "void start(mesh& S) {
  vertex x, y, z, X, Y, Z;
  x$pos = vec(1, 0, 0); y$pos = vec(0, 1, 0); z$pos = vec(0, 0, 1);
  X$pos = vec(-1, 0, 0); Y$pos = vec(0, -1, 0); Z$pos = vec(0, 0, -1);
  make {y, z, Y, Z} nb_of x; make {z, x, Z, X} nb_of y; make {x, y, X, Y} nb_of z;
  make {y, Z, Y, z} nb_of X; make {z, X, Z, x} nb_of Y; make {x, Y, X, y} nb_of Z;
  add x to S; add y to S; add z to S; add X to S; add Y to S; add Z to S;
}
";

/// The square of two triangles abc and acd.
pub const SQUARE: &str = "void start(mesh& S) {
  vertex a, b, c, d;
  b$pos = vec(1, 0, 0); c$pos = vec(1, 1, 0); d$pos = vec(0, 1, 0);
  make {b, c, d, null} nb_of a; make {c, a, null} nb_of b;
  make {d, a, b, null} nb_of c; make {a, c, null} nb_of d;
  add a to S; add b to S; add c to S; add d to S;
}
";

#[track_caller]
fn compile(text: &str) -> Program {
    let include = &mut |_: &str, path: &str| Err(format!("there is no {path}"));
    let compilation = vv::compile("test.vv", text, include);
    match compilation.program {
        Some(program) => Program::clone(&program),
        None => panic!("does not compile:\n{}", show_all(&compilation.diagnostics, &compilation.sources)),
    }
}

/// What a program prints in `start` and `steps` steps of its default rule, and the mesh or the error.
#[track_caller]
fn run_with(text: &str, steps: u64, settings: &Settings) -> (Vec<String>, Mesh) {
    let program = compile(text);
    let mut output = Vec::new();
    let mut mesh = Mesh::new();
    let steps = program.default_rule().into_iter().flat_map(|rule| (1..=steps).map(move |n| (rule, n)));
    for (function, generation) in program.start.map(|start| (start, 0)).into_iter().chain(steps) {
        match run(&program, function, &mesh, generation, settings, &mut output) {
            Ok(new) => mesh = new,
            Err(failure) => {
                output.extend(show(&failure.diagnostic, &program.sources));
                break;
            }
        }
    }
    (output, mesh)
}

/// Runs `start` and one step of the default rule, if there are such, and compares what is printed.
#[track_caller]
fn check(text: &str, expected: &str) {
    check_with(text, &Settings::default(), expected);
}

#[track_caller]
fn check_with(text: &str, settings: &Settings, expected: &str) {
    let (output, _) = run_with(text, 1, settings);
    let lines = |text: &str| text.trim().lines().map(|l| l.trim().to_owned()).collect::<Vec<_>>().join("\n");
    let (got, expected) = (lines(&output.join("\n")), lines(expected));
    assert!(got == expected, "printed\n{got}\n\nexpected\n{expected}\n");
}

/// Checks statements that run once, with the vertices v1 to v6 in the variables a to f and no neighbours.
#[track_caller]
fn check_body(body: &str, expected: &str) {
    check(&format!("void step(mesh& S) {{ vertex a, b, c, d, e, f;\n{body}\n}}"), expected);
}

/// Makes the ring of `f`, edits it and compares it, from its start, a gap as `-`.
#[track_caller]
fn check_ring(items: &str, edit: &str, expected: &str) {
    let text = format!("void step(mesh& S) {{ vertex a, b, c, d, e, f; make {{{items}}} nb_of f; {edit}; }}");
    let (output, mesh) = run_with(&text, 1, &Settings::default());
    assert_eq!(output.join("\n"), "");
    let f = mesh.vertices().nth(5).unwrap();
    let slots = mesh.ring(f).slots().iter().map(|x| x.map_or("-".to_owned(), |x| x.to_string()));
    assert_eq!(slots.collect::<Vec<_>>().join(" "), expected, "{items} | {edit}");
}

fn show_all(diagnostics: &[Diagnostic], sources: &Sources) -> String {
    diagnostics.iter().flat_map(|d| show(d, sources)).collect::<Vec<_>>().join("\n")
}

fn show(d: &Diagnostic, sources: &Sources) -> Vec<String> {
    let at = |span: Span| {
        let (_, start, _) = sources.locate(span).unwrap();
        let text = sources.text(span).split_whitespace().collect::<Vec<_>>().join(" ");
        format!("{}:{} `{text}`", start.line, start.column)
    };
    let mut lines = vec![format!("error {}: {}", d.span.map_or(String::new(), at), d.message)];
    lines.extend(d.labels.iter().map(|(span, text)| format!("at {}: {text}", at(*span))));
    lines.extend(d.evidence.iter().map(|text| format!("= {text}")));
    lines.extend(d.hints.iter().map(|hint| format!("? {}", hint.message)));
    if !d.vertices.is_empty() {
        lines.push(format!("about {}", d.vertices.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")));
    }
    lines.extend(d.calls.iter().map(|(name, span)| format!("in {name} at {}", at(*span))));
    lines
}
