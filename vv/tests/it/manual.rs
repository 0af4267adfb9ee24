//! The manual's programs run as they stand, and print what stands under them.

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
        let mut include = |_: &str, path: &str| match path {
            "insert.vv" => Ok(vv::Included {
                name: path.to_owned(),
                text: include_str!("../../../assets/programs/insert.vv").to_owned(),
            }),
            _ => Err("no such file".to_owned()),
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
