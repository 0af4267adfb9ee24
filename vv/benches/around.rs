//! What surrounds a step, single thread, in faces per second: closing it, faces, counts, validation, snapshots, files.
//!
//! `cargo bench -p vv --bench around`, with a name to choose: `close`, `faces`, …
#![allow(clippy::unwrap_used, clippy::allow_attributes, reason = "a benchmark that panics has failed")]

use std::hint::black_box;
use std::path::Path;
use std::sync::{Arc, OnceLock};

use divan::Bencher;
use divan::counter::ItemsCount;
use vv::engine::{Engine, Machine, Settings};
use vv::io::{Format, ReadOptions, read, write};
use vv::mesh::Mesh;
use vv::mesh::build::{Polygons, build};
use vv::mesh::close::close;
use vv::mesh::faces::{Faces, faces};
use vv::mesh::statistics::statistics;
use vv::mesh::validate::validate;
use vv::stop::Stop;

fn main() {
    divan::main();
}

/// A closed mesh of triangles, refined; an open one of quadrilaterals, numbered row by row.
const MESHES: [&str; 2] = ["triangles", "grid"];

#[divan::bench(args = MESHES)]
fn close_(bencher: Bencher, name: &str) {
    let sample = sample(name);
    bencher
        .counter(ItemsCount::new(sample.faces.len()))
        .with_inputs(|| sample.unclosed.clone())
        .bench_local_refs(|mesh| close(mesh, &Stop::new()).unwrap());
}

#[divan::bench(args = MESHES)]
fn faces_(bencher: Bencher, name: &str) {
    measure(bencher, name, |sample| faces(&sample.mesh, &Stop::new()).unwrap());
}

#[divan::bench(args = MESHES)]
fn statistics_(bencher: Bencher, name: &str) {
    measure(bencher, name, |sample| statistics(&sample.mesh, &sample.faces, &Stop::new()).unwrap());
}

#[divan::bench(args = MESHES)]
fn validate_(bencher: Bencher, name: &str) {
    measure(bencher, name, |sample| validate(&sample.mesh, &Stop::new()).unwrap());
}

#[divan::bench(args = MESHES)]
fn snapshot(bencher: Bencher, name: &str) {
    measure(bencher, name, |sample| sample.mesh.clone());
}

#[divan::bench(args = MESHES)]
fn write_obj(bencher: Bencher, name: &str) {
    measure(bencher, name, |sample| write(&sample.mesh, &sample.faces, Format::Obj));
}

#[divan::bench(args = MESHES)]
fn write_off(bencher: Bencher, name: &str) {
    measure(bencher, name, |sample| write(&sample.mesh, &sample.faces, Format::Off));
}

#[divan::bench(args = MESHES)]
fn read_obj(bencher: Bencher, name: &str) {
    reading(bencher, name, Format::Obj);
}

#[divan::bench(args = MESHES)]
fn read_off(bencher: Bencher, name: &str) {
    reading(bencher, name, Format::Off);
}

fn measure<T>(bencher: Bencher, name: &str, work: impl Fn(&Sample) -> T) {
    let sample = sample(name);
    bencher.counter(ItemsCount::new(sample.faces.len())).bench_local(|| work(black_box(sample)));
}

fn reading(bencher: Bencher, name: &str, format: Format) {
    let sample = sample(name);
    let text = write(&sample.mesh, &sample.faces, format).unwrap().0;
    bencher
        .counter(ItemsCount::new(sample.faces.len()))
        .bench_local(|| read(black_box(&text), format, &ReadOptions::default()).unwrap());
}

struct Sample {
    /// As a step leaves it.
    unclosed: Mesh,
    mesh: Mesh,
    faces: Faces,
}

fn sample(name: &str) -> &'static Sample {
    static SAMPLES: [OnceLock<Sample>; 2] = [OnceLock::new(), OnceLock::new()];
    SAMPLES[usize::from(name == "grid")].get_or_init(|| {
        let unclosed = if name == "grid" { grid(1100) } else { refined(8) };
        let mut mesh = unclosed.clone();
        close(&mut mesh, &Stop::new()).unwrap();
        let faces = faces(&mesh, &Stop::new()).unwrap();
        Sample { unclosed, mesh, faces }
    })
}

/// The icosahedron after so many steps of the paper's Loop subdivision.
fn refined(steps: u64) -> Mesh {
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets");
    let text = std::fs::read_to_string(assets.join("programs/paper-loop.vv")).unwrap();
    let program = vv::compile("program.vv", &text, &mut |_, _| Err(String::new())).program.unwrap();
    let rule = program.default_rule().unwrap();
    let machine = Machine::new(Arc::clone(&program), Engine::Native);
    let icosahedron = std::fs::read(assets.join("meshes/icosahedron.obj")).unwrap();
    let mut mesh = read(&icosahedron, Format::Obj, &ReadOptions::default()).unwrap().0;
    for generation in 1..=steps {
        close(&mut mesh, &Stop::new()).unwrap();
        mesh = machine.run(rule, &mesh, generation, &Settings::default(), &mut Vec::new()).unwrap();
    }
    mesh
}

/// `n` × `n` quadrilaterals.
fn grid(n: u32) -> Mesh {
    let place = |i: u32| glam::dvec3(f64::from(i % (n + 1)), f64::from(i / (n + 1)), f64::from(i % 7) / 7.0);
    let mut polygons = Polygons::new((0..(n + 1) * (n + 1)).map(place).collect());
    for row in 0..n {
        for column in 0..n {
            let a = row * (n + 1) + column;
            polygons.push([a, a + 1, a + n + 2, a + n + 1], None).unwrap();
        }
    }
    build(polygons, true, &Stop::new()).unwrap().0
}
