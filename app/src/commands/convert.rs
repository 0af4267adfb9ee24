//! `vv mesh convert`

use std::path::PathBuf;

use app::evaluation::within;
use app::files;
use clap::Args;
use vv::mesh::faces::faces;

use super::look::{self, LookArguments, Past};
use super::output::{DEFAULT_SIZE, OutputArguments};
use super::picture::Shot;
use super::report::Reporter;
use super::{EXIT_CODES, Exit, Importing, Reporting, error, fail, input, output};

/// What `vv mesh convert` takes.
#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES)]
pub struct Arguments {
    /// The mesh; `-` is stdin, in any format.
    mesh: PathBuf,
    /// What is no option and no mesh to read: the output, where `-o` was forgotten.
    #[arg(hide = true)]
    others: Vec<PathBuf>,
    #[command(flatten)]
    output: OutputArguments,
    #[command(flatten)]
    look: LookArguments,
    #[command(flatten)]
    importing: Importing,
    #[command(flatten)]
    reporting: Reporting,
}

/// Writes all outputs or none.
pub fn convert(arguments: &Arguments) -> Result<(), Exit> {
    let reporter = Reporter::new(arguments.reporting.diagnostic_format);
    if let Some(other) = arguments.others.first() {
        let name = files::shown(other);
        let diagnostic = error(format!("`vv mesh convert` reads one mesh, and {name} is one file more"));
        return fail(&reporter, Exit::Usage, diagnostic.hint(format!("to write it: `-o {name}`")));
    }
    if arguments.output.output.is_empty() {
        return fail(&reporter, Exit::Usage, error("nothing says where to write").hint("add `-o FILE`"));
    }
    let viewpoint = arguments.output.viewpoint(&reporter)?;
    let look = arguments.look.look(&reporter)?;
    let targets = arguments.output.targets(&reporter)?;
    if targets.iter().any(|target| target.figure().is_some()) {
        look.warn_of_figures(&reporter);
    }
    let (mesh, _) = input::mesh(&arguments.mesh, &arguments.importing, &reporter)?;
    let faces = match within(arguments.importing.timeout.0, |stop| faces(&mesh, stop)) {
        Ok(faces) => faces,
        Err(stopped) => return fail(&reporter, Exit::Budget, error(stopped.to_string())),
    };
    let size = arguments.output.size().unwrap_or(DEFAULT_SIZE);
    let shot = Shot { size, viewpoint, look: &look };
    let result = look::Result { mesh: &mesh, faces: &faces, past: &Past::default() };
    let outputs = output::prepare(&targets, shot, false, result, &reporter)?;
    output::commit(outputs.prepared, &reporter)
}
