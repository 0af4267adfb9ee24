//! `vv completions` and `vv man`

use std::path::PathBuf;

use app::files;
use clap::{Args, CommandFactory as _};
use clap_complete::Shell;

use super::report::{Reporter, write_stdout};
use super::{Cli, DiagnosticFormat, Exit, error, fail};

/// What `vv completions` takes.
#[derive(Debug, Args)]
pub struct Completions {
    /// The shell.
    shell: Shell,
}

/// Writes the completions for a shell to stdout.
pub fn completions(arguments: &Completions) -> Result<(), Exit> {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut Cli::command(), "vv", &mut text);
    write_stdout(&text, &Reporter::new(DiagnosticFormat::Human))
}

/// What `vv man` takes.
#[derive(Debug, Args)]
pub struct Man {
    /// Where they go.
    folder: PathBuf,
}

/// Writes the manual pages of all commands into a folder.
pub fn man(arguments: &Man) -> Result<(), Exit> {
    clap_mangen::generate_to(Cli::command(), &arguments.folder).or_else(|problem| {
        let message = format!("{}: {}", arguments.folder.display(), files::sentence(&problem));
        fail(&Reporter::new(DiagnosticFormat::Human), Exit::File, error(message))
    })
}
