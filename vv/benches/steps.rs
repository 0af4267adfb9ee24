//! One step of refinement, single thread, in output faces per second: both engines, meshes of ten thousand to a million
//! output faces.
//!
//! `cargo bench -p vv --bench steps`, with a name to choose: `loop`, `sqrt3`, …
#![allow(clippy::unwrap_used, clippy::allow_attributes, reason = "a benchmark that panics has failed")]

use std::path::Path;
use std::sync::{Arc, Mutex};

use divan::Bencher;
use divan::counter::ItemsCount;
use vv::engine::{Engine, Machine, Settings};
use vv::io::{Format, ReadOptions, read};
use vv::ir::Program;
use vv::mesh::Mesh;
use vv::mesh::close::close;
use vv::mesh::faces::faces;
use vv::stop::Stop;

fn main() {
    divan::main();
}

/// `engine` and how often the mesh was refined before.
const ARGUMENTS: [(Engine, u64); 5] =
    [(Engine::Interpret, 4), (Engine::Interpret, 5), (Engine::Native, 4), (Engine::Native, 6), (Engine::Native, 7)];

#[divan::bench(args = ARGUMENTS.map(show))]
fn loop_(bencher: Bencher, case: &str) {
    measure(bencher, case, &asset("paper-loop"), "icosahedron", 0);
}

#[divan::bench(args = ARGUMENTS.map(show))]
fn loop_with_boundary_rules(bencher: Bencher, case: &str) {
    measure(bencher, case, &asset("loop"), "icosahedron", 0);
}

#[divan::bench(args = ARGUMENTS.map(show))]
fn butterfly(bencher: Bencher, case: &str) {
    measure(bencher, case, &asset("paper-butterfly"), "icosahedron", 0);
}

#[divan::bench(args = ARGUMENTS.map(show))]
fn polyhedral(bencher: Bencher, case: &str) {
    measure(bencher, case, &asset("paper-polyhedral"), "icosahedron", 0);
}

#[divan::bench(args = ARGUMENTS.map(show))]
fn sqrt3(bencher: Bencher, case: &str) {
    measure(bencher, case, &asset("paper-sqrt3"), "icosahedron", 2);
}

#[divan::bench(args = ARGUMENTS.map(show))]
fn catmull_clark(bencher: Bencher, case: &str) {
    measure(bencher, case, &asset("catmull-clark"), "cube", 1);
}

#[divan::bench(args = ARGUMENTS.map(show))]
fn doo_sabin(bencher: Bencher, case: &str) {
    measure(bencher, case, &asset("doo-sabin"), "cube", 1);
}

fn show((engine, steps): (Engine, u64)) -> String {
    format!("{engine:?} {steps}").to_lowercase()
}

/// Times one step from a mesh that was refined before, allocation of the result included, its release not.
fn measure(bencher: Bencher, case: &str, text: &str, mesh: &str, more: u64) {
    let (engine, steps) = case.split_once(' ').unwrap();
    let engine = if engine == "native" { Engine::Native } else { Engine::Interpret };
    let program = compile(text);
    let rule = program.default_rule().unwrap();
    let native = Machine::new(Arc::clone(&program), Engine::Native);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../assets/meshes/{mesh}.obj"));
    let mut mesh = read(&std::fs::read(path).unwrap(), Format::Obj, &ReadOptions::default()).unwrap().0;
    for generation in 1..=steps.parse::<u64>().unwrap() + more {
        mesh = native.run(rule, &mesh, generation, &Settings::default(), &mut Vec::new()).unwrap();
        close(&mut mesh, &Stop::new()).unwrap();
    }
    let machine = Machine::new(program, engine);
    let step = || machine.run(rule, &mesh, 1, &Settings::default(), &mut Vec::new()).unwrap();
    let count = faces(&step(), &Stop::new()).unwrap().len();
    // Releasing the last result is no part of the step.
    let last = Mutex::new(Mesh::new());
    bencher.counter(ItemsCount::new(count)).with_inputs(|| *last.lock().unwrap() = Mesh::new()).bench_local_values(
        |()| {
            *last.lock().unwrap() = step();
        },
    );
}

fn asset(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../assets/programs/{name}.vv"));
    std::fs::read_to_string(path).unwrap()
}

fn compile(text: &str) -> Arc<Program> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/programs");
    let mut include = |_: &str, name: &str| {
        let text = std::fs::read_to_string(folder.join(name)).map_err(|e| e.to_string())?;
        Ok(vv::Included { name: name.to_owned(), text })
    };
    vv::compile("program.vv", text, &mut include).program.unwrap()
}
