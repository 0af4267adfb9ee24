//! Files that commands read.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use app::document::NOWHERE;
use app::evaluation::within;
use app::files::{self, FileError};
use app::library;
use vv::diagnostic::{Diagnostic, Severity};
use vv::io::{Format, Place, ReadOptions};
use vv::ir::Program;
use vv::mesh::Mesh;
use vv::source::{Sources, Span};

use super::report::Reporter;
use super::{Exit, Importing, error, fail};

/// Largest file that is read again to quote a line of it.
const MOST_QUOTED: u64 = 64 << 20;

/// Reads and checks a program and reports what is wrong with it; what is wrong but no error is also returned. A name that
/// no file has is that of a program that comes with vv, if one has it, as in `#include`.
///
/// # Errors
/// [`Exit::Usage`] if it is a mesh, [`Exit::File`] if it cannot be read, [`Exit::Program`] if it has errors.
pub fn program(path: &Path, reporter: &Reporter) -> Result<(Arc<Program>, Vec<Diagnostic>), Exit> {
    not_a_mesh(path, reporter)?;
    if let Some(shipped) = library::meant(path) {
        let said = format!("there is no file {}, so this is the program of that name that comes with vv", shipped.name);
        reporter.report(&[Diagnostic::new(Severity::Note, None, said)], &Sources::default());
        return compiled(&Path::new(NOWHERE).join(shipped.name), shipped.text, reporter);
    }
    let text =
        files::read_program(path).map_err(|error| match library::nearly(path).filter(|_| library::is_free(path)) {
            Some(name) => {
                reporter.report(&[error.located().hint(format!("`{name}` comes with vv"))], &Sources::default());
                Exit::File
            }
            None => file_failed(&error, reporter),
        })?;
    compiled(path, &text, reporter)
}

/// As [`program`], of a text.
///
/// # Errors
/// [`Exit::Program`] if it has errors.
pub fn compiled(path: &Path, text: &str, reporter: &Reporter) -> Result<(Arc<Program>, Vec<Diagnostic>), Exit> {
    let (compilation, _) = files::compile(path, text);
    reporter.report(&compilation.diagnostics, &compilation.sources);
    let failed = compilation.diagnostics.iter().any(|d| d.severity == Severity::Error);
    let program = compilation.program.filter(|_| !failed).ok_or(Exit::Program)?;
    Ok((program, compilation.diagnostics))
}

/// Refuses a mesh where a program is wanted.
///
/// # Errors
/// [`Exit::Usage`] if it is a mesh.
pub fn not_a_mesh(path: &Path, reporter: &Reporter) -> Result<(), Exit> {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    if Format::from_extension(&extension).is_some() {
        let diagnostic = error(format!("{} is a mesh, and a program is wanted", files::shown(path)));
        return fail(reporter, Exit::Usage, diagnostic.hint("`vv run PROGRAM -i MESH` applies a program to a mesh"));
    }
    Ok(())
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

/// Reports it, with the line it is about where there is one.
pub fn file_failed(error: &FileError, reporter: &Reporter) -> Exit {
    match quoted(error) {
        Some((diagnostic, sources)) => reporter.report(&[diagnostic], &sources),
        None => reporter.report(&[error.located()], &Sources::default()),
    }
    Exit::File
}

/// The diagnostic at its line of the file; `None` without line, or if the file cannot be read again.
fn quoted(error: &FileError) -> Option<(Diagnostic, Sources)> {
    let Place::Text { line, column } = error.place? else { return None };
    let line = line.checked_sub(1)? as usize;
    // Only a file gives the same again; a pipe would keep us waiting.
    fs::metadata(&error.path).ok().filter(|m| m.is_file() && m.len() <= MOST_QUOTED)?;
    let bytes = fs::read(&error.path).ok()?;
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&bytes);
    let text = String::from_utf8_lossy(bytes).into_owned();
    // Lines that end by CR alone are none in a quotation.
    if text.replace("\r\n", "").contains('\r') {
        return None;
    }
    let quote = text.split_inclusive('\n').nth(line)?;
    let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
    let end = start + quote.trim_end().len();
    // From the column on the word that stands there.
    let word = column.and_then(|column| quote.char_indices().nth(column as usize - 1)).map(|(before, _)| {
        let len = quote[before..].find(char::is_whitespace).unwrap_or(quote.len() - before);
        (start + before, start + before + len)
    });
    let (start, end) = word.unwrap_or((start, end));
    let mut sources = Sources::default();
    let file = sources.add(files::shown(&error.path), text);
    let mut diagnostic = Diagnostic::clone(&error.diagnostic);
    diagnostic.span = Some(Span::new(file, start as u32, end as u32));
    Some((diagnostic, sources))
}
