//! `vv check`

use std::path::PathBuf;

use clap::Args;

use super::report::Reporter;
use super::{EXIT_CODES, Exit, Reporting, input};

/// What `vv check` takes.
#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES)]
pub struct Arguments {
    /// Programs; `-` is stdin.
    #[arg(required = true, value_name = "PROGRAM")]
    programs: Vec<PathBuf>,
    #[command(flatten)]
    reporting: Reporting,
}

/// Checks all of them, whatever is wrong with some. A file that cannot be read outweighs a program with errors.
pub fn check(arguments: &Arguments) -> Result<(), Exit> {
    let reporter = Reporter::new(arguments.reporting.diagnostic_format);
    let mut worst = None;
    for path in &arguments.programs {
        if let Err(exit) = input::program(path, &reporter) {
            worst = worst.filter(|&worst| worst == Exit::File).or(Some(exit));
        }
    }
    worst.map_or(Ok(()), Err)
}
