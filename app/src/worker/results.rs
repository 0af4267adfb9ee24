//! Meshes that come from programs that were run before this one.

use vv::diagnostic::{Diagnostic, Severity};
use vv::engine::{Engine, Limits, Machine, Output, OutputClosed, Settings};
use vv::io::ReadOptions;
use vv::mesh::Mesh;
use vv::stop::Stop;

use super::Request;
use super::bench::{params, shipped_mesh};
use crate::document::MeshSource;
use crate::{evaluation, files};

/// Nobody reads what a program prints that was run before.
struct Silence;

impl Output for Silence {
    fn print(&mut self, _line: &str) -> Result<(), OutputClosed> {
        Ok(())
    }
}

/// What was read, and what is to be said about it.
pub(super) type Read = Result<(Mesh, Vec<Diagnostic>), Box<Diagnostic>>;

/// Reads or computes the mesh of a source.
pub(super) fn read(source: &MeshSource, limits: Limits, stop: &Stop) -> Read {
    let options = ReadOptions { stop: stop.clone(), ..ReadOptions::default() };
    match source {
        MeshSource::Empty => Ok((Mesh::new(), Vec::new())),
        MeshSource::File(path) => files::read_mesh(path, &options).map_err(|error| error.diagnostic),
        MeshSource::BuiltIn(name) => shipped_mesh(name, &options),
        MeshSource::Result(request) => compute(request, limits, stop),
    }
}

fn compute(request: &Request, limits: Limits, stop: &Stop) -> Read {
    let recipe = &request.recipe;
    let (mesh, diagnostics) = read(&recipe.mesh, limits, stop)?;
    let (compilation, _) = files::compile(&recipe.path, &recipe.text);
    let error = |message: &str| Box::new(Diagnostic::new(Severity::Error, None, message));
    let name = crate::document::file_name(&recipe.path);
    let Some(program) = compilation.program else {
        return Err(error(&format!("{name}, which made the mesh, has errors")));
    };
    let machine = Machine::new(program.clone(), Engine::Native);
    let settings =
        Settings { params: params(&program, &recipe.params), limits, stop: stop.clone(), ..Settings::default() };
    let failed = |mut failure: vv::engine::Failure| {
        // Its places are those of another text.
        failure.diagnostic.span = None;
        failure.diagnostic.labels.clear();
        failure.diagnostic.calls.clear();
        failure.diagnostic.hints.clear();
        failure.diagnostic.message = format!("{name}, which made the mesh: {}", failure.diagnostic.message);
        failure.diagnostic
    };
    let mut now = evaluation::first(&machine, &mesh, &settings, &mut Silence).map_err(failed)?;
    let chosen = recipe.rule.as_deref().and_then(|name| program.rule(name)).or_else(|| program.default_rule());
    for generation in 1..=request.generation {
        let rule = chosen.ok_or_else(|| error(&format!("{name}, which made the mesh, has no rule")))?;
        now = evaluation::advance(&machine, rule, &now.mesh, generation, &settings, &mut Silence).map_err(failed)?;
    }
    Ok((now.mesh, diagnostics))
}
