//! The programs of `assets/programs` give what CGAL, OpenSubdiv and OpenMesh give: the same faces up to the names of the
//! vertices, positions within 1e-9. What the libraries gave stands in `fixtures/oracles`, made by `oracles/make`.

mod matching;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use vv::engine::{Engine, Machine, Settings};
use vv::io::{Format, ReadOptions, read};
use vv::ir::Program;
use vv::mesh::close::close;
use vv::mesh::faces::faces;
use vv::mesh::{Mesh, Value, Vertex};
use vv::stop::Stop;

use crate::engines::{self, compile_file};
use matching::{Lists, same};

const TOLERANCE: f64 = 1e-9;

/// Results of one function of a library, by the folder they are in, and the program that makes the same.
struct Oracle {
    folder: &'static str,
    program: &'static str,
    /// What else the input has: a file beside it with this extension.
    with: Option<&'static str>,
    /// Meshes that we do otherwise on purpose, and why. That they differ is tested, too.
    except: Option<(&'static [&'static str], &'static str)>,
}

const fn oracle(folder: &'static str, program: &'static str) -> Oracle {
    Oracle { folder, program, with: None, except: None }
}

const ORACLES: &[Oracle] = &[
    oracle("cgal/loop", "loop.vv"),
    oracle("opensubdiv/loop", "loop.vv"),
    oracle("openmesh/loop", "loop.vv"),
    Oracle { with: Some("creases"), ..oracle("opensubdiv/loop-creases", "loop-creases.vv") },
    oracle("openmesh/butterfly", "butterfly.vv"),
    oracle("cgal/sqrt3", "sqrt3.vv"),
    oracle("openmesh/sqrt3", "sqrt3.vv"),
];

#[test]
fn loop_() {
    check("loop.vv");
}

#[test]
fn loop_creases() {
    check("loop-creases.vv");
}

#[test]
fn butterfly() {
    check("butterfly.vv");
}

#[test]
fn sqrt3() {
    check("sqrt3.vv");
}

/// A result that nobody compares would prove nothing.
#[test]
fn every_result_is_compared() {
    let listed: BTreeSet<_> = ORACLES.iter().map(|oracle| oracle.folder.to_owned()).collect();
    let mut found = BTreeSet::new();
    for library in entries(&fixtures()).into_iter().filter(|path| path.is_dir() && !path.ends_with("inputs")) {
        for folder in entries(&library) {
            found.insert(folder.strip_prefix(fixtures()).unwrap().to_string_lossy().into_owned());
        }
    }
    assert_eq!(listed, found);
}

/// Compares all that there is about a program.
#[track_caller]
fn check(program: &str) {
    let mut wrong = Vec::new();
    let compiled = compile_file(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/programs").join(program));
    let native = Machine::new(Arc::clone(&compiled), Engine::Native);
    let oracles: Vec<_> = ORACLES.iter().filter(|oracle| oracle.program == program).collect();
    assert_ne!(oracles.len(), 0, "{program}");
    for oracle in oracles {
        let files = entries(&fixtures().join(oracle.folder));
        let names: BTreeSet<_> =
            files.iter().filter_map(|path| path.file_stem()?.to_str()?.strip_suffix("-1")).collect();
        assert_ne!(names.len(), 0, "{}", oracle.folder);
        for name in names {
            let differences = compare(oracle, name, &compiled, &native);
            match oracle.except {
                Some((except, why)) if except.contains(&name) => {
                    if differences.is_empty() {
                        wrong.push(format!("{} of {name}: nothing is different, though {why}", oracle.folder));
                    }
                }
                _ => wrong.extend(differences),
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The differences, step by step, for the steps that there are results of.
fn compare(oracle: &Oracle, name: &str, program: &Program, native: &Machine) -> Vec<String> {
    let rule = program.default_rule().unwrap();
    let mut mesh = input(name, oracle.with);
    let mut differences = Vec::new();
    for step in 1.. {
        let path = fixtures().join(oracle.folder).join(format!("{name}-{step}.off"));
        let Ok(text) = fs::read_to_string(&path) else { break };
        mesh = engines::compare(program, native, rule, &mesh, step, &Settings::default()).unwrap().0.unwrap();
        assert_eq!(close(&mut mesh, &Stop::new()).unwrap(), [], "{}, step {step} of {name}", oracle.program);
        if let Err(difference) = same(&lists(&mesh), &parse(&text), TOLERANCE) {
            differences.push(format!("{}, step {step} of {name}: {difference}", oracle.folder));
        }
    }
    differences
}

/// The mesh that the libraries got.
fn input(name: &str, with: Option<&str>) -> Mesh {
    let path = fixtures().join("inputs").join(name);
    let bytes = fs::read(path.with_extension("off")).unwrap();
    let (mut mesh, warnings) = read(&bytes, Format::Off, &ReadOptions::default()).unwrap();
    assert_eq!(warnings, [], "{name}");
    let Some(extension) = with else { return mesh };
    let vertices: Vec<Vertex> = mesh.vertices().collect();
    let edges = mesh.declare_edge_property("sharpness", Value::Double(0.0));
    let corners = mesh.declare_vertex_property("sharpness", Value::Double(0.0));
    for line in fs::read_to_string(path.with_extension(extension)).unwrap().lines() {
        let words: Vec<_> = line.split(' ').collect();
        let vertex = |i: usize| vertices[words[i].parse::<usize>().unwrap()];
        let value = Value::Double(words.last().unwrap().parse().unwrap());
        match words[0] {
            "edge" => assert!(mesh.set_edge_value(edges, vertex(1), vertex(2), value)),
            "corner" => mesh.set_vertex_value(corners, vertex(1), value),
            other => panic!("{other}"),
        }
    }
    mesh
}

/// As the file formats have it, the vertices in order of creation.
fn lists(mesh: &Mesh) -> Lists {
    let faces = faces(mesh, &Stop::new()).unwrap();
    let members: BTreeSet<Vertex> = mesh.set.iter().collect();
    let number: BTreeMap<_, _> = members.iter().zip(0..).collect();
    Lists {
        points: members.iter().map(|&v| mesh.position(v)).collect(),
        faces: faces.iter().map(|face| face.iter().map(|v| number[v]).collect()).collect(),
    }
}

/// OFF as `make` writes it.
fn parse(text: &str) -> Lists {
    let mut lines = text.lines().skip(1).map(|line| line.split(' ').collect::<Vec<_>>());
    let counts = lines.next().unwrap();
    let mut numbers = |count: &str| lines.by_ref().take(count.parse().unwrap()).collect::<Vec<_>>();
    let (points, faces) = (numbers(counts[0]), numbers(counts[1]));
    let double = |word: &&str| word.parse::<f64>().unwrap();
    Lists {
        points: points.iter().map(|p| DVec3::new(double(&p[0]), double(&p[1]), double(&p[2]))).collect(),
        faces: faces.iter().map(|f| f[1..].iter().map(|word| word.parse().unwrap()).collect()).collect(),
    }
}

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/oracles")
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
}
