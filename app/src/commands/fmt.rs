//! `vv fmt`

use std::path::{Path, PathBuf};

use app::files;
use clap::Args;
use vv::source::Sources;

use super::report::Reporter;
use super::{EXIT_CODES, Exit, Reporting, error, input, output};

/// What `vv fmt` takes.
#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES)]
pub struct Arguments {
    /// Programs; `-` is stdin.
    #[arg(required = true, value_name = "PROGRAM")]
    programs: Vec<PathBuf>,
    /// Change nothing; exit code 5 if a program would be changed.
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    reporting: Reporting,
}

/// Lays all of them out, whatever is wrong with some.
pub fn fmt(arguments: &Arguments) -> Result<(), Exit> {
    let reporter = Reporter::new(arguments.reporting.diagnostic_format);
    let mut worst = None;
    for path in &arguments.programs {
        if let Err(exit) = one(path, arguments.check, &reporter) {
            // What could not be done outweighs what was found.
            worst = worst.filter(|&worst| exit == Exit::Different || worst == Exit::File).or(Some(exit));
        }
    }
    worst.map_or(Ok(()), Err)
}

fn one(path: &Path, check: bool, reporter: &Reporter) -> Result<(), Exit> {
    input::not_a_mesh(path, reporter)?;
    let failed = |error: files::FileError| input::file_failed(&error, reporter);
    // What came out of a pipe does not go back into it.
    if !check && !files::is_standard_stream(path) && path.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir()) {
        let message = "is no file that could be replaced";
        return Err(failed(files::FileError::at(path, None, message, None)));
    }
    let text = files::read_program(path).map_err(failed)?;
    let formatted = vv::syntax::format(&text).map_err(|diagnostics| {
        let mut sources = Sources::default();
        sources.add(files::shown(path), text.as_str());
        reporter.report(&diagnostics, &sources);
        Exit::Program
    })?;
    let changed = formatted != text;
    if check && changed {
        let name = files::shown(path);
        let diagnostic = error(format!("{name} is not laid out")).hint(format!("`vv fmt {name}` lays it out"));
        reporter.report(&[diagnostic], &Sources::default());
        return Err(Exit::Different);
    }
    if check || !changed && !files::is_standard_stream(path) {
        return Ok(());
    }
    output::commit(vec![files::prepare(path, formatted.as_bytes()).map_err(failed)?], reporter)
}
