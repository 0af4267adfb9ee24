//! The manual's programs run as they stand, and print what stands under them.

use std::collections::BTreeSet;

use vv::engine::{Settings, run};
use vv::mesh::{Mesh, close};
use vv::stop::Stop;

/// The programs of the manual, each with its line and what it is said to print.
fn programs(manual: &str) -> Vec<(usize, String, String)> {
    let mut found: Vec<(usize, String, String)> = Vec::new();
    let mut fence = None;
    for (i, line) in manual.lines().enumerate() {
        match (fence, line.strip_prefix("```")) {
            (None, Some("vv")) => {
                found.push((i + 1, String::new(), String::new()));
                fence = Some("vv");
            }
            (None, Some("out")) => fence = Some("out"),
            (None, Some(_)) => fence = Some("other"),
            (Some(_), Some(_)) => fence = None,
            (Some("other"), None) => {}
            (Some(kind), None) => {
                let (_, program, output) = found.last_mut().unwrap();
                let text = if kind == "vv" { program } else { output };
                text.push_str(line);
                text.push('\n');
            }
            (None, None) => {}
        }
    }
    found
}

#[test]
fn every_program_of_the_manual_prints_what_stands_under_it() {
    let programs = programs(include_str!("../../README.md"));
    assert!(programs.len() >= 4, "the manual has lost its programs");
    for (line, text, expected) in programs {
        let mut include = |_: &str, path: &str| {
            let shipped = format!("{}/../assets/programs/{path}", env!("CARGO_MANIFEST_DIR"));
            let text = std::fs::read_to_string(shipped).map_err(|e| e.to_string())?;
            Ok(vv::Included { name: path.to_owned(), text })
        };
        let compiled = vv::compile("README.md", &text, &mut include);
        let form = vv::diagnostic::Form::Human { color: false };
        let said = vv::diagnostic::render(&compiled.diagnostics, &compiled.sources, form);
        assert_eq!(said, "", "line {line}");
        let program = compiled.program.unwrap();
        let mut printed = Vec::new();
        let mut mesh = Mesh::new();
        for (generation, rule) in program.start.into_iter().chain(program.default_rule()).enumerate() {
            mesh = run(&program, rule, &mesh, generation as u64, &Settings::default(), &mut printed)
                .unwrap_or_else(|f| panic!("line {line}: {}", f.diagnostic.message));
            assert_eq!(close::close(&mut mesh, &Stop::new()).unwrap(), [], "line {line}");
        }
        assert_eq!(printed.join("\n") + "\n", expected, "line {line}");
    }
}

#[test]
fn every_program_that_ships_has_its_row_in_the_manual() {
    let manual = include_str!("../../README.md");
    let (_, table) = manual.split_once("## What comes with vv").unwrap();
    let (table, _) = table.split_once("How long they are").unwrap();
    let folder = format!("{}/../assets/programs", env!("CARGO_MANIFEST_DIR"));
    let files = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned());
    let missing: Vec<_> = files.filter(|file| table.matches(&format!("`{file}`")).count() != 1).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// Pictures are small, and `.ci/pictures` makes them.
#[test]
fn every_program_that_can_be_stepped_has_its_picture_in_the_manual() {
    let manual = include_str!("../../README.md");
    let assets = format!("{}/../assets", env!("CARGO_MANIFEST_DIR"));
    let stems = |folder: &str| -> BTreeSet<String> {
        let files = std::fs::read_dir(format!("{assets}/{folder}")).unwrap().map(|entry| entry.unwrap().path());
        files.map(|file| file.file_stem().unwrap().to_string_lossy().into_owned()).collect()
    };
    let is_rule = |line: &str| line.starts_with("void ") && line.contains("(mesh& S) {");
    let stepped = stems("programs").into_iter().filter(|name| shipped(&format!("{name}.vv")).lines().any(is_rule));
    let pictures = stems("pictures/programs");
    assert_eq!(stepped.collect::<BTreeSet<_>>(), pictures);
    for name in &pictures {
        let file = format!("assets/pictures/programs/{name}.png");
        assert!(
            manual.lines().any(|row| row.starts_with(&format!("| `{name}.vv` |")) && row.contains(&file)),
            "{name}"
        );
        assert!(std::fs::metadata(format!("{assets}/../{file}")).unwrap().len() <= 90_000, "{name}");
    }
}

fn shipped(name: &str) -> String {
    std::fs::read_to_string(format!("{}/../assets/programs/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// Lines that are neither empty nor comment: of a program, and with those of all that it includes.
fn lines_of_code(name: &str) -> [usize; 2] {
    let text = shipped(name);
    let own = text.lines().filter(|l| !l.trim().is_empty() && !l.trim().starts_with("//")).count();
    let included = text.lines().filter_map(|l| l.strip_prefix("#include \"")?.strip_suffix('"'));
    [own, own + included.map(|file| lines_of_code(file)[1]).sum::<usize>()]
}

#[test]
fn the_lengths_in_the_manual_are_those_of_the_programs() {
    let manual = include_str!("../../README.md");
    for (row, file) in [
        ("Loop", "loop.vv"),
        ("Catmull–Clark", "catmull-clark.vv"),
        ("Doo–Sabin", "doo-sabin.vv"),
        ("√3", "sqrt3.vv"),
        ("modified butterfly", "butterfly.vv"),
        ("quad/triangle", "quad-triangle.vv"),
    ] {
        let [own, all] = lines_of_code(file);
        let expected = format!("| {row} | {own} | {all} |");
        assert!(manual.contains(&expected), "the manual should say {expected}");
    }
    let [own, all] = lines_of_code("loop-creases.vv");
    assert!(manual.contains(&format!("in {own} and {all} lines")), "{own} {all}");
}
