//! Subdivides a mesh file by a program and writes what came of it as OBJ.
//!
//!   cargo run --example subdivide assets/programs/loop.vv assets/meshes/cube-open.obj 3 > fine.obj

use std::error::Error;
use std::io::{self, Write};
use std::path::Path;
use std::{env, fs};

use vv::Included;
use vv::diagnostic::Severity;
use vv::engine::{Engine, Machine, Settings};
use vv::io::{Format, ReadOptions};
use vv::mesh::close::close;
use vv::mesh::faces::faces;
use vv::stop::Stop;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    if let [program, mesh, steps] = &arguments[..] {
        subdivide(program, mesh, steps.parse()?, &mut io::stdout().lock())?;
    }
    Ok(())
}

/// Writes `mesh` after so many steps of `program`.
pub fn subdivide(program: &str, mesh: &str, steps: u64, out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    // The library opens no files: whoever calls it says what an `#include` means.
    let mut include = |from: &str, path: &str| {
        let path = Path::new(from).with_file_name(path).display().to_string();
        let text = fs::read_to_string(&path).map_err(|error| format!("{path}: {error}"))?;
        Ok(Included { name: path, text })
    };
    let compilation = vv::compile(program, &fs::read_to_string(program)?, &mut include);
    for error in compilation.diagnostics.iter().filter(|d| d.severity == Severity::Error) {
        eprintln!("{program}: {}", error.message);
    }
    let machine = Machine::new(compilation.program.ok_or("the program cannot run")?, Engine::Native);
    let rule = machine.program().default_rule().ok_or("the program has no rule")?;

    let extension = Path::new(mesh).extension().unwrap_or_default().to_string_lossy();
    let format = Format::from_extension(&extension).ok_or("no mesh file, by its extension")?;
    let (mut mesh, _) = vv::io::read(&fs::read(mesh)?, format, &ReadOptions::default())?;
    let settings = Settings::default();
    for generation in 1..=steps {
        mesh = machine.run(rule, &mesh, generation, &settings, &mut Vec::new())?;
        // Forgets what has no place in the surface any more, and names what the step has left open.
        for finding in close(&mut mesh, &settings.stop)? {
            eprintln!("generation {generation}: {}", finding.message);
        }
    }
    let faces = faces(&mesh, &Stop::new())?;
    Ok(out.write_all(&vv::io::write(&mesh, &faces, Format::Obj)?.0)?)
}
