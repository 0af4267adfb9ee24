//! Every shipped program runs on every shipped mesh that it claims to support, without a warning.

use std::path::PathBuf;

use vv::engine::{Engine, Machine, Settings};
use vv::io::{Format, ReadOptions, read};
use vv::mesh::close::close;
use vv::mesh::faces::faces;
use vv::mesh::statistics::{Statistics, statistics};
use vv::mesh::{Mesh, Value};
use vv::stop::Stop;

use super::{assets_folder, compile};

/// What a program is for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Class {
    Triangles,
    ClosedTriangles,
    Quads,
    Polygons,
    ClosedPolygons,
    Wires,
    /// What it makes itself in `start`.
    Own,
}

/// File, rule if only that, class. Programs that make a mesh of their own run on that, too; those that do nothing else
/// need no row.
const CLAIMS: &[(&str, Option<&str>, Class)] = &[
    ("butterfly.vv", None, Class::Triangles),
    ("catmull-clark.vv", None, Class::Polygons),
    ("catmull-clark-creases.vv", None, Class::Polygons),
    ("conway.vv", Some("kis"), Class::Polygons),
    ("conway.vv", Some("gyro"), Class::Polygons),
    ("conway.vv", Some("truncate"), Class::Polygons),
    ("conway.vv", Some("ambo"), Class::Polygons),
    ("conway.vv", Some("expand"), Class::Polygons),
    ("conway.vv", Some("bevel"), Class::Polygons),
    ("colors.vv", None, Class::Polygons),
    ("conway.vv", None, Class::ClosedPolygons),
    ("coral.vv", Some("grow"), Class::ClosedTriangles),
    ("coral.vv", Some("smooth"), Class::Polygons),
    ("curves.vv", None, Class::Wires),
    ("delaunay.vv", None, Class::Triangles),
    ("distance.vv", None, Class::Polygons),
    ("doo-sabin.vv", None, Class::Polygons),
    ("four-eight.vv", None, Class::Polygons),
    ("koch.vv", None, Class::Triangles),
    ("limit.vv", Some("loop_limit"), Class::Triangles),
    ("limit.vv", Some("catmull_clark_limit"), Class::Quads),
    ("loop-creases.vv", None, Class::Triangles),
    ("loop.vv", None, Class::Triangles),
    ("midedge.vv", None, Class::Polygons),
    ("paper-butterfly.vv", None, Class::ClosedTriangles),
    ("paper-loop.vv", None, Class::ClosedTriangles),
    ("paper-polyhedral.vv", None, Class::Triangles),
    ("paper-sqrt3.vv", None, Class::ClosedTriangles),
    ("quad-triangle.vv", None, Class::Polygons),
    ("reaction-diffusion.vv", None, Class::Polygons),
    ("remesh.vv", None, Class::Polygons),
    ("sierpinski.vv", None, Class::Triangles),
    ("sierpinski-tetrahedron.vv", None, Class::ClosedPolygons),
    ("smooth.vv", None, Class::Polygons),
    ("sqrt3.vv", None, Class::Triangles),
    ("tissue.vv", None, Class::ClosedPolygons),
];

/// What no mesh that ships has: fans that meet in a point, one face alone, faces of three sizes along a boundary.
const ODD: &[(&str, &str)] = &[
    ("two triangles at a point", "v 0 0 0\nv 1 1 0\nv 1 -1 0\nv -1 1 1\nv -1 -1 0\nf 1 3 2\nf 1 4 5\n"),
    ("a triangle", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    (
        "two quads at a point",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 0 1\nv -1 -1 0\nv 0 -1 0\nf 1 2 3 4\nf 1 5 6 7\n",
    ),
    (
        "a quad between triangles and a pentagon",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 2 1\nv 2 0.5 0\nv -1 0 0\nv -1 1 0\nv -2 0.5 0\n\
         f 1 2 3 4\nf 4 3 5\nf 3 2 6\nf 7 1 4 8 9\n",
    ),
];

/// Corners with two edges, as models have them: one in the middle of an edge of a tetrahedron, and two beside each other.
const STRAIGHT: [&str; 2] = [
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0.5 0 0\nf 1 5 2 4\nf 2 5 1 3\nf 1 4 3\nf 2 3 4\n",
    "v 0 0 0\nv 3 0 0\nv 0 3 0\nv 0 0 3\nv 1 0 0\nv 2 0 0\nf 1 5 6 2 4\nf 2 6 5 1 3\nf 1 4 3\nf 2 3 4\n",
];

fn files(folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(assets_folder().join(folder)).unwrap();
    let mut files: Vec<_> = entries.map(|e| e.unwrap().path()).filter(|p| p.is_file()).collect();
    files.sort();
    files
}

fn name(path: &std::path::Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

fn count(mesh: &Mesh) -> Statistics {
    let stop = Stop::new();
    statistics(mesh, &faces(mesh, &stop).unwrap(), &stop).unwrap()
}

fn supports(class: Class, statistics: &Statistics) -> bool {
    if statistics.face_degrees.is_empty() {
        return class == Class::Wires;
    }
    let triangles = statistics.face_degrees.iter().all(|&(n, _)| n == 3);
    match class {
        Class::Triangles => triangles,
        Class::ClosedTriangles => triangles && statistics.closed,
        Class::Polygons => true,
        Class::ClosedPolygons => statistics.closed,
        Class::Quads => statistics.face_degrees.iter().all(|&(n, _)| n == 4),
        Class::Wires | Class::Own => false,
    }
}

#[test]
fn every_program_runs_on_every_mesh_it_is_for() {
    let meshes: Vec<_> = files("meshes")
        .iter()
        .filter_map(|path| {
            let format = Format::from_extension(path.extension()?.to_str()?)?;
            let (mesh, warnings) = read(&std::fs::read(path).unwrap(), format, &ReadOptions::default()).unwrap();
            assert!(warnings.is_empty(), "{}: {warnings:?}", path.display());
            Some((name(path), mesh))
        })
        .chain(ODD.iter().map(|&(name, text)| {
            (name.to_owned(), read(text.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap().0)
        }))
        .map(|(name, mesh)| (name, count(&mesh), mesh))
        .collect();
    for path in files("programs") {
        let file = name(&path);
        let program = compile(&file, &std::fs::read_to_string(&path).unwrap());
        let native = Machine::new(program, Engine::Native);
        assert_eq!(native.refusal(), None, "{file}");
        let program = native.program();
        for &rule in &program.rules {
            let rule_name = &program.function(rule).unwrap().name;
            let row = CLAIMS.iter().find(|(f, r, _)| *f == file && r.is_none_or(|r| r == rule_name));
            let class = row.map(|row| row.2).or(program.start.map(|_| Class::Own));
            let class =
                class.unwrap_or_else(|| panic!("{file} {rule_name} has no row that says which meshes it is for"));
            let claimed: Vec<_> = meshes.iter().filter(|(_, statistics, _)| supports(class, statistics)).collect();
            assert!(class == Class::Own || !claimed.is_empty(), "{file}");
            for (mesh_name, _, mesh) in claimed {
                check(&native, rule, mesh, &format!("{file} {rule_name} on {mesh_name}"));
            }
            if program.start.is_some() {
                check(&native, rule, &Mesh::new(), &format!("{file} {rule_name} on its own mesh"));
            }
        }
    }
}

#[test]
fn schemes_for_polygons_take_corners_with_two_edges() {
    for text in STRAIGHT {
        let (mesh, _) = read(text.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
        let schemes = CLAIMS.iter().filter(|row| row.2 == Class::Polygons || row.0 == "conway.vv");
        for (file, rule, _) in schemes {
            let path = assets_folder().join("programs").join(file);
            let native = Machine::new(compile(file, &std::fs::read_to_string(&path).unwrap()), Engine::Native);
            let program = native.program();
            let rule = rule.map_or(program.default_rule(), |rule| program.rule(rule)).unwrap();
            check(&native, rule, &mesh, file);
        }
    }
}

/// The third column of the manual's table is what is tried above.
#[test]
fn the_manual_says_what_each_program_is_for() {
    let manual = include_str!("../../../README.md");
    let (_, table) = manual.split_once("## What comes with vv").unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|row| row.split('|').map(str::trim).collect()).collect();
    for path in files("programs") {
        let file = name(&path);
        let claims: Vec<Class> = CLAIMS.iter().filter(|row| row.0 == file).map(|row| row.2).collect();
        let own = compile(&file, &std::fs::read_to_string(&path).unwrap()).start.is_some();
        let row = rows.iter().find(|row| row.len() > 4 && row[1] == format!("`{file}`") && row[3] != "to include");
        let Some(row) = row else {
            assert!(claims.is_empty(), "{file} has no row of its own");
            continue;
        };
        for said in row[3].split(", ").filter(|said| *said != "made triangles") {
            let fits = match said {
                "triangles" => claims.contains(&Class::Triangles),
                "closed triangles" => claims.contains(&Class::ClosedTriangles),
                "quads" => claims.contains(&Class::Quads),
                "polygons" => claims.contains(&Class::Polygons),
                "closed polygons" => claims.contains(&Class::ClosedPolygons),
                "wires" => claims.contains(&Class::Wires),
                "its own mesh" => claims.is_empty() && own,
                _ => false,
            };
            assert!(fits, "{file} is for {said} in the manual, and tried on {claims:?}");
        }
    }
}

#[test]
fn every_program_is_laid_out_as_fmt_does() {
    for path in files("programs") {
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(vv::syntax::format(&text).as_deref(), Ok(text.as_str()), "{}", name(&path));
    }
}

/// How much some programs do that could do more.
const LITTLE: [(&str, i64); 2] = [("points", 100), ("rounds", 2)];

/// `start` and three steps on both engines, as far as the mesh stays small.
#[track_caller]
fn check(native: &Machine, rule: vv::ir::FunctionId, mesh: &Mesh, at: &str) {
    let program = native.program();
    let mut mesh = mesh.clone();
    let start = program.start.map(|start| (start, 0));
    for (function, generation) in start.into_iter().chain((1..=3).map(|n| (rule, n))) {
        if generation > 1 && (mesh.vertex_count() > 300 || mesh.set.is_empty()) {
            break; // as large as we like, or an open mesh that shrank to nothing
        }
        let little = |name: &str| LITTLE.iter().find(|row| row.0 == name).map(|row| Value::Int(row.1));
        let params = program.params().filter_map(|(id, global, _)| Some((id, little(&global.name)?))).collect();
        let settings = Settings { params, seed: 7, ..Settings::default() };
        let run = |failure: vv::engine::Failure| panic!("{at}: {:?}", failure.diagnostic);
        let interpreted =
            vv::engine::run(program, function, &mesh, generation, &settings, &mut Vec::new()).unwrap_or_else(run);
        mesh = native.run(function, &mesh, generation, &settings, &mut Vec::new()).unwrap_or_else(run);
        assert_eq!(interpreted.positions(), mesh.positions(), "{at}");
        for v in mesh.vertices() {
            assert_eq!(interpreted.ring(v).slots(), mesh.ring(v).slots(), "{at}");
        }
        let warnings = close(&mut mesh, &Stop::new()).unwrap();
        assert!(warnings.is_empty(), "{at}, step {generation}: {warnings:?}");
        assert!(generation > 1 || !mesh.set.is_empty(), "{at}");
        assert!(count(&mesh).valid, "{at}, step {generation}");
    }
}
