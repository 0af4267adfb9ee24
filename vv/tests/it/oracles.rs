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
use vv::mesh::close::close;
use vv::mesh::faces::faces;
use vv::mesh::{Mesh, Value, Vertex};
use vv::stop::Stop;

use crate::engines;
use matching::{Lists, same};

const TOLERANCE: f64 = 1e-9;

/// Results of one function of a library, by the folder they are in, and the program that makes the same.
struct Oracle {
    folder: &'static str,
    program: &'static str,
    /// What else the input has: a file beside it with this extension.
    with: Option<&'static str>,
    /// What we do otherwise on purpose.
    but: Option<Otherwise>,
}

/// A difference that is meant: with `theirs` in place of `ours` the program makes what the library makes, and only then.
struct Otherwise {
    why: &'static str,
    ours: &'static str,
    theirs: &'static str,
}

const fn oracle(folder: &'static str, program: &'static str) -> Oracle {
    Oracle { folder, program, with: None, but: None }
}

const ORACLES: &[Oracle] = &[
    oracle("cgal/loop", "loop.vv"),
    oracle("opensubdiv/loop", "loop.vv"),
    oracle("openmesh/loop", "loop.vv"),
    Oracle { with: Some("creases"), ..oracle("opensubdiv/loop-creases", "loop-creases.vv") },
    Oracle { with: Some("corners"), ..oracle("opensubdiv/loop-corners", "loop-creases.vv") },
    oracle("openmesh/butterfly", "butterfly.vv"),
    oracle("cgal/sqrt3", "sqrt3.vv"),
    Oracle {
        but: Some(Otherwise {
            why: "CGAL counts the steps of a call, and so never gets to the second one when each is a call by itself",
            ours: "S$generation % 2 == 1",
            theirs: "false",
        }),
        ..oracle("cgal/sqrt3-restarted", "sqrt3.vv")
    },
    oracle("openmesh/sqrt3", "sqrt3.vv"),
    oracle("cgal/catmull-clark", "catmull-clark.vv"),
    oracle("opensubdiv/catmull-clark", "catmull-clark.vv"),
    Oracle {
        but: Some(Otherwise {
            why: "OpenMesh moves a boundary vertex by 1/6 2/3 1/6, to where it would end, and that at each step",
            ours: "3.0/4.0 * p$pos + 1.0/8.0 * (",
            theirs: "2.0/3.0 * p$pos + 1.0/6.0 * (",
        }),
        ..oracle("openmesh/catmull-clark", "catmull-clark.vv")
    },
    Oracle { with: Some("creases"), ..oracle("opensubdiv/catmull-clark-creases", "catmull-clark-creases.vv") },
    Oracle { with: Some("corners"), ..oracle("opensubdiv/catmull-clark-corners", "catmull-clark-creases.vv") },
    oracle("cgal/doo-sabin", "doo-sabin.vv"),
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

#[test]
fn catmull_clark() {
    check("catmull-clark.vv");
}

#[test]
fn catmull_clark_creases() {
    check("catmull-clark-creases.vv");
}

#[test]
fn doo_sabin() {
    check("doo-sabin.vv");
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
    let path = assets().join(program);
    let text = fs::read_to_string(&path).unwrap();
    let oracles: Vec<_> = ORACLES.iter().filter(|oracle| oracle.program == program).collect();
    assert_ne!(oracles.len(), 0, "{program}");
    for oracle in oracles {
        let wrong = match &oracle.but {
            None => compare(oracle, &text),
            Some(Otherwise { why, ours, theirs }) => {
                assert_ne!(compare(oracle, &text), "", "{}: nothing differs, though {why}", oracle.folder);
                assert!(text.contains(ours), "{program} has no `{ours}`");
                compare(oracle, &text.replace(ours, theirs))
            }
        };
        assert_eq!(wrong, "", "{}:\n{wrong}", oracle.folder);
    }
}

/// The differences, one a line: of each mesh, step by step, for the steps that there are results of.
fn compare(oracle: &Oracle, text: &str) -> String {
    let mut include = |_: &str, name: &str| {
        let text = fs::read_to_string(assets().join(name)).map_err(|error| error.to_string())?;
        Ok(vv::Included { name: name.to_owned(), text })
    };
    let program = vv::compile(oracle.program, text, &mut include).program.unwrap();
    let native = Machine::new(Arc::clone(&program), Engine::Native);
    let rule = program.default_rule().unwrap();
    let results = entries(&fixtures().join(oracle.folder));
    let names: BTreeSet<_> = results.iter().filter_map(|path| path.file_stem()?.to_str()?.strip_suffix("-1")).collect();
    assert_ne!(names.len(), 0, "{}", oracle.folder);
    let mut wrong = String::new();
    for name in names {
        let mut mesh = input(name, oracle.with);
        for step in 1.. {
            let path = fixtures().join(oracle.folder).join(format!("{name}-{step}.off"));
            let Ok(theirs) = fs::read_to_string(&path) else { break };
            mesh = engines::compare(&program, &native, rule, &mesh, step, &Settings::default()).unwrap().0.unwrap();
            assert_eq!(close(&mut mesh, &Stop::new()).unwrap(), [], "{}, step {step} of {name}", oracle.program);
            if let Err(difference) = same(&lists(&mesh), &parse(&theirs), TOLERANCE) {
                wrong += &format!("step {step} of {name}: {difference}\n");
            }
        }
    }
    wrong
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

fn assets() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/programs")
}

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/oracles")
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
}
