//! What the command line understands. Each sub-command is one file.

mod check;
mod convert;
mod diff;
mod fmt;
mod guard;
mod info;
mod input;
mod interrupt;
mod look;
mod lsp;
mod mask;
mod open;
mod output;
mod picture;
mod reference;
mod render;
mod report;
mod run;
mod shell;
mod style;
mod view;
mod watch;

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::process::ExitCode;
use std::str::FromStr;
use std::time::{Duration, Instant};

use app::alike::closest;
use clap::{Args, Parser, Subcommand, ValueEnum};
use vv::diagnostic::{Diagnostic, Severity};
use vv::source::Sources;

use report::Reporter;

const EXIT_CODES: &str = "\
Exit codes:
  0  success
  1  the program has errors, or a step failed
  2  the command line is wrong
  3  a file could not be read or written
  4  a budget (vertices, memory, call depth) or the time is used up
  5  the result differs from the reference, a mesh from another, or a program from its layout by `vv fmt`
  6  no renderer: no display for the window, no GPU or software driver for pictures";

const EXAMPLES: &str = "\
Examples:
  vv                                          open the modeler
  vv bunny.obj loop.vv                        open it with a mesh and a program
  vv run loop.vv -i bunny.obj -n 2 -o out.obj -o out.png
  vv run loop.vv -i bunny.obj -n 2 -o side.png --view right
  vv watch loop.vv -i bunny.obj -n 2 -o out.png
  vv render bunny.obj -o bunny.pdf
  vv check *.vv
  vv fmt --check *.vv
  vv mesh info bunny.obj
  vv mesh convert bunny.obj -o bunny.off
  vv mesh diff before.obj after.obj

";

const WATCH_EXAMPLES: &str = "\
Examples:
  vv watch loop.vv -i bunny.obj -n 2 -o fine.obj -o fine.svg
  vv watch terrain.vv -D roughness=0.3:0.8:6 -o sheet.png

";

/// Writes mesh algorithms as they are drawn on paper and watches them happen: a modeler for the vertex–vertex language.
///
/// Without a sub-command vv opens its window. A mesh (.obj, .off, .ply, .stl, .glb, .gltf) and a program (.vv) may be given in either order.
#[derive(Debug, Parser)]
#[command(name = "vv", version, args_conflicts_with_subcommands = true, max_term_width = 100)]
#[command(override_usage = "vv [MESH] [PROGRAM] [--view VIEW]\n       vv <COMMAND>")]
#[command(after_help = format!("{EXAMPLES}{EXIT_CODES}"))]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    /// A mesh (.obj, .off, .ply, .stl, .glb, .gltf) and a program (.vv) to open, in either order.
    #[arg(value_name = "MESH|PROGRAM")]
    files: Vec<PathBuf>,
    /// From where to look at first: a viewpoint that was copied in the window, a file with one, or a side such as front or isometric.
    #[arg(long, value_name = "TEXT|FILE|SIDE")]
    view: Option<String>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run a program without window.
    ///
    /// First runs its `start`, if it has one, on the input mesh or on none; then applies its rule, step by step. What the
    /// program prints goes to stdout, errors and warnings go to stderr. Outputs are written when everything has
    /// succeeded, each of them whole; a failed run writes none.
    Run(Box<run::Arguments>),
    /// Run a program, and again whenever it or another file that it needs changes.
    ///
    /// As `vv run`, with its options. Says in one line what was made, or what is wrong, and waits until the program, an
    /// included one, the mesh, or a file named by `--style`, `--view` or `--reference` has another content; what is still
    /// being made then is stopped. Ends when it is interrupted, with Ctrl+C.
    #[command(after_help = format!("{WATCH_EXAMPLES}{EXIT_CODES}"))]
    Watch(Box<run::Arguments>),
    /// Draw meshes, as pictures, figures or turntables, without window.
    ///
    /// As `vv run` draws what it has made. Several meshes stand side by side in one picture, unless its name has a place
    /// for theirs.
    Render(render::Arguments),
    /// Check programs for errors without running them.
    ///
    /// Finds what `vv run` would find before it runs them. Says nothing about programs without fault.
    Check(check::Arguments),
    /// Lay programs out the one way: indentation and spaces. Lines, comments and meaning stay.
    ///
    /// Replaces each file, whole or not at all, unless it is laid out so already; `-` goes from stdin to stdout. A program
    /// that cannot be read without doubt is left as it is.
    Fmt(fmt::Arguments),
    /// Show with which weights a rule makes new vertices of old ones, found by running it.
    ///
    /// Around one vertex of each valence in regular surroundings, inside and at the boundary, or on a mesh. Warns where a
    /// rule is not affine, weights do not sum to one, a mirror image has other masks, or the order of the vertices
    /// matters.
    Mask(mask::Arguments),
    /// Help an editor: errors as they are typed, meanings, completion, names across files, layout.
    ///
    /// A language server. Editors start it and speak with it over stdin and stdout (LSP 3.17).
    Lsp(lsp::Arguments),
    /// Write what a shell needs to complete commands and options.
    ///
    /// For bash: `vv completions bash > ~/.local/share/bash-completion/completions/vv`.
    Completions(shell::Completions),
    /// Write the manual pages of all commands, `vv.1`, `vv-run.1`, …, into a folder.
    Man(shell::Man),
    /// Look at mesh files, compare and convert them.
    #[command(subcommand)]
    Mesh(MeshCommand),
}

#[derive(Debug, Subcommand)]
enum MeshCommand {
    /// Count what a mesh is made of and say what is odd about it.
    ///
    /// Reads it as `vv run` would; what has to be repaired for that goes to stderr, or into the JSON object as well.
    Info(info::Arguments),
    /// Write a mesh in another format, or as a picture.
    ///
    /// Reads it as `vv run` would. Polygons and the order of the vertices are kept.
    Convert(Box<convert::Arguments>),
    /// Compare two meshes, whatever the order of their vertices and faces.
    ///
    /// They are the same if vertices can be put on vertices so that rings (and so faces, with their sides) come to lie on
    /// rings, and none is farther off than the tolerance; properties are not compared. Says what differs, with exit code
    /// 5.
    Diff(diff::Arguments),
}

/// How errors and warnings are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DiagnosticFormat {
    /// With the lines of the program that they are about, evidence and hints.
    Human,
    /// One line each: file:line:column: error: message.
    Short,
    /// One JSON object on a line each.
    Json,
}

/// Options of everything that may report errors in files.
#[derive(Debug, Args)]
#[command(next_help_heading = "Reports")]
struct Reporting {
    /// How errors and warnings are written to stderr.
    #[arg(long, value_enum, default_value_t = DiagnosticFormat::Human, value_name = "FORMAT")]
    diagnostic_format: DiagnosticFormat,
}

/// Options of everything that reads a mesh.
#[derive(Debug, Args)]
#[command(next_help_heading = "Limits")]
struct Importing {
    /// Refuse a mesh that would have to be repaired.
    #[arg(long)]
    strict: bool,
    /// Time for each step, and for reading a mesh.
    ///
    /// With closing the step; 0 for as long as it takes.
    #[arg(long, value_name = "SECONDS", default_value = "300", allow_negative_numbers = true, value_parser = seconds)]
    timeout: Timeout,
    /// How many vertices a mesh may have.
    #[arg(long, value_name = "N", default_value_t = vv::engine::Limits::default().max_vertices, value_parser = vertices)]
    max_vertices: usize,
}

/// How a command ended when it did not end well; what is wrong was reported already.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Exit {
    /// The program has errors or did something that has no meaning.
    Program = 1,
    /// The command line cannot be meant so.
    Usage = 2,
    /// A file could not be read or written.
    File = 3,
    /// A budget or the time is used up.
    Budget = 4,
    /// The result is not the reference, a mesh not the other, a program not laid out.
    Different = 5,
    /// No display or no GPU.
    NoRenderer = 6,
}

/// Runs what the command line says.
pub fn main() -> ExitCode {
    let began = Instant::now();
    let result = match Cli::try_parse() {
        Ok(cli) => carry_out(cli, began),
        Err(answer) => open::misplaced().unwrap_or_else(|| shell::explain(&answer)),
    };
    result.map_or_else(|exit| ExitCode::from(exit as u8), |()| ExitCode::SUCCESS)
}

fn carry_out(cli: Cli, began: Instant) -> Result<(), Exit> {
    if cli.command.is_some() {
        interrupt::leave_nothing_behind();
    }
    match cli.command {
        None => open::open(&cli.files, cli.view.as_deref()),
        Some(Command::Run(arguments)) => run::run(&arguments, began),
        Some(Command::Watch(arguments)) => watch::watch(&arguments),
        Some(Command::Render(arguments)) => render::render(arguments, began),
        Some(Command::Check(arguments)) => check::check(&arguments),
        Some(Command::Fmt(arguments)) => fmt::fmt(&arguments),
        Some(Command::Mask(arguments)) => mask::mask(&arguments),
        Some(Command::Lsp(arguments)) => lsp::lsp(&arguments),
        Some(Command::Mesh(MeshCommand::Info(arguments))) => info::info(&arguments),
        Some(Command::Completions(arguments)) => shell::completions(&arguments),
        Some(Command::Man(arguments)) => shell::man(&arguments),
        Some(Command::Mesh(MeshCommand::Diff(arguments))) => diff::diff(&arguments),
        Some(Command::Mesh(MeshCommand::Convert(arguments))) => convert::convert(&arguments),
    }
}

/// A message about the run as a whole.
fn error(message: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Severity::Error, None, message)
}

/// Reports a message without place and ends with `exit`.
fn fail<T>(reporter: &Reporter, exit: Exit, diagnostic: Diagnostic) -> Result<T, Exit> {
    reporter.report(&[diagnostic], &Sources::default());
    Err(exit)
}

/// The messages of those that are warnings.
fn warnings_of(diagnostics: &[Diagnostic]) -> Vec<String> {
    diagnostics.iter().filter(|d| d.severity == Severity::Warning).map(|d| d.message.clone()).collect()
}

/// A time that may be endless.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Timeout(Option<Duration>);

fn seconds(text: &str) -> Result<Timeout, String> {
    let wanted = || "seconds are a number such as 300 or 0.5".to_owned();
    let seconds: f64 = text.parse().map_err(|_| wanted())?;
    if seconds == 0.0 {
        return Ok(Timeout(None));
    }
    Duration::try_from_secs_f64(seconds).map(|d| Timeout(Some(d))).map_err(|_| wanted())
}

fn vertices(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| "vertices are counted: a whole number such as 1000000".to_owned())
}

fn tolerance(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|x: &f64| x.is_finite() && *x >= 0.0);
    number.ok_or_else(|| "a tolerance is a number from 0 on, such as 1e-9".to_owned())
}

/// Reads how many of something there are, which is named for a sentence, such as `a valence`.
fn count<T: Copy + Display + FromStr + PartialOrd>(
    what: &'static str,
    range: RangeInclusive<T>,
) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        number.ok_or_else(|| format!("{what} is a whole number from {} to {}", range.start(), range.end()))
    }
}

/// `a`, `b` and `c`, each in back quotes.
fn list<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<_> = names.into_iter().map(|name| format!("`{name}`")).collect();
    match names.as_slice() {
        [] => String::new(),
        [name] => name.clone(),
        [names @ .., last] => format!("{} and {last}", names.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory as _;
        Cli::command().debug_assert();
    }

    /// clap breaks the line at `{n}`, which is a name that outputs may have.
    #[test]
    fn no_help_loses_a_name_to_a_line_break() {
        use clap::CommandFactory as _;
        fn walk(command: &clap::Command) {
            let texts = [command.get_about(), command.get_long_about(), command.get_after_help()];
            let of_arguments = command.get_arguments().flat_map(|a| [a.get_help(), a.get_long_help()]);
            for text in texts.into_iter().chain(of_arguments).flatten() {
                assert!(!text.to_string().contains("{n}"), "{}: {text}", command.get_name());
            }
            command.get_subcommands().for_each(walk);
        }
        walk(&Cli::command());
    }

    #[test]
    fn a_timeout_is_a_number_of_seconds() {
        assert_eq!(seconds("0.5"), Ok(Timeout(Some(Duration::from_millis(500)))));
        assert_eq!(seconds("0"), Ok(Timeout(None)));
        for wrong in ["-1", "nan", "inf", "1e300", "1s", ""] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn lists_read_as_sentences() {
        assert_eq!(list(["a"]), "`a`");
        assert_eq!(list(["a", "b", "c"]), "`a`, `b` and `c`");
    }
}
