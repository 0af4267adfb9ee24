//! `vv completions` and `vv man`

use std::io::IsTerminal as _;
use std::path::PathBuf;

use app::files;
use clap::{Args, CommandFactory as _};
use clap_complete::Shell;

use super::report::{Reporter, write_stdout};
use super::{Cli, DiagnosticFormat, Exit, input, output};

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

/// Writes the manual pages of all commands into a folder, all or none.
pub fn man(arguments: &Man) -> Result<(), Exit> {
    let reporter = Reporter::new(DiagnosticFormat::Human);
    let mut command = Cli::command().disable_help_subcommand(true);
    command.build();
    let mut prepared = Vec::new();
    pages(&command, &mut |page| {
        let mut text = Vec::new();
        // Nothing can fail: it is written into memory.
        let _ = page.render(&mut text);
        let path = arguments.folder.join(page.get_filename());
        prepared.push(files::prepare(&path, &text).map_err(|error| input::file_failed(&error, &reporter))?);
        Ok(())
    })?;
    output::commit(prepared, &reporter)
}

/// The pages of a command and of those below it.
fn pages(command: &clap::Command, take: &mut dyn FnMut(clap_mangen::Man) -> Result<(), Exit>) -> Result<(), Exit> {
    command.get_subcommands().filter(|below| !below.is_hide_set()).try_for_each(|below| pages(below, take))?;
    take(clap_mangen::Man::new(command.clone()))
}

/// Says what is wrong with the command line, or what was asked: help, or the version.
pub fn explain(answer: &clap::Error) -> Result<(), Exit> {
    if answer.use_stderr() || std::io::stdout().is_terminal() {
        answer.exit();
    }
    write_stdout(answer.render().to_string().as_bytes(), &Reporter::new(DiagnosticFormat::Human))
}
