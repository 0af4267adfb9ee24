//! Files that commands read.

use std::path::Path;
use std::sync::Arc;

use app::evaluation::within;
use app::files::{self, FileError};
use vv::diagnostic::{Diagnostic, Severity};
use vv::io::ReadOptions;
use vv::ir::Program;
use vv::mesh::Mesh;
use vv::source::Sources;

use super::report::Reporter;
use super::{Exit, Importing, error, fail};

/// Reads and checks a program and reports what is wrong with it; what is wrong but no error is also returned.
///
/// # Errors
/// [`Exit::File`] if it cannot be read, [`Exit::Program`] if it has errors.
pub fn program(path: &Path, reporter: &Reporter) -> Result<(Arc<Program>, Vec<Diagnostic>), Exit> {
    let text = files::read_program(path).map_err(|error| file_failed(&error, reporter))?;
    let (compilation, _) = files::compile(path, &text);
    reporter.report(&compilation.diagnostics, &compilation.sources);
    let failed = compilation.diagnostics.iter().any(|d| d.severity == Severity::Error);
    let program = compilation.program.filter(|_| !failed).ok_or(Exit::Program)?;
    Ok((program, compilation.diagnostics))
}

/// Reads a mesh and reports what was repaired; the warnings are also returned.
///
/// # Errors
/// [`Exit::File`] if it cannot be read, [`Exit::Budget`] if it is too large or takes too long.
pub fn mesh(path: &Path, options: &Importing, reporter: &Reporter) -> Result<(Mesh, Vec<Diagnostic>), Exit> {
    let (result, stopped) = within(options.timeout.0, |stop| {
        let options = ReadOptions { strict: options.strict, stop: stop.clone() };
        (files::read_mesh(path, &options), stop.check().is_err())
    });
    let (mesh, warnings) = result.map_err(|error| {
        let exit = file_failed(&error, reporter);
        if stopped { Exit::Budget } else { exit }
    })?;
    let warnings: Vec<_> = warnings.into_iter().map(|warning| files::located(path, None, warning)).collect();
    reporter.report(&warnings, &Sources::default());
    if mesh.vertex_count() > options.max_vertices {
        let message = format!(
            "{}: has {} vertices, {} are allowed",
            files::shown(path),
            mesh.vertex_count(),
            options.max_vertices
        );
        return fail(reporter, Exit::Budget, error(message).hint("allow more with `--max-vertices N`"));
    }
    Ok((mesh, warnings))
}

/// Reports it.
pub fn file_failed(error: &FileError, reporter: &Reporter) -> Exit {
    reporter.report(&[error.located()], &Sources::default());
    Exit::File
}
