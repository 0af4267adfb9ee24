//! `vv render`

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;

use super::look::LookArguments;
use super::output::OutputArguments;
use super::report::Reporter;
use super::run;
use super::{EXIT_CODES, Exit, Importing, Reporting, count, error, fail};

const EXAMPLES: &str = "\
Examples:
  vv render bunny.obj -o bunny.png --size 1920x1080 --color-by gauss
  vv render bunny.obj -o bunny.pdf --view front --line hidden=dotted
  vv render a.obj b.obj -o both.png                   side by side
  vv render a.obj b.obj -o '{name}.svg'               each on its own
  vv render bunny.obj --turntable 36 -o turn.gif
  vv render bunny.obj -o bunny.png --style look.json  as the window saved it

";

/// What `vv render` takes.
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}{EXIT_CODES}"))]
pub struct Arguments {
    /// The meshes; `-` is stdin, in any format. Several stand side by side, or `{name}` in the names of outputs is that
    /// of each.
    #[arg(required_unless_present = "input", value_name = "MESH")]
    meshes: Vec<PathBuf>,
    /// A mesh, as `vv run` takes it.
    #[arg(short, long, hide = true)]
    input: Vec<PathBuf>,
    /// Go around the mesh in N pictures: `{frame}` in their names is the number of each, from 0; a .gif holds them all.
    #[arg(long, value_name = "N", value_parser = count("the number of pictures", 2..=3600u32))]
    turntable: Option<u32>,
    #[command(flatten)]
    output: OutputArguments,
    #[command(flatten)]
    look: LookArguments,
    #[command(flatten)]
    importing: Importing,
    #[command(flatten)]
    reporting: Reporting,
}

/// Draws: what `vv run` makes of meshes when it does nothing to them.
pub fn render(arguments: Arguments, began: Instant) -> Result<(), Exit> {
    let reporter = Reporter::new(arguments.reporting.diagnostic_format);
    let Arguments { meshes, input, turntable, output, look, importing, reporting } = arguments;
    if output.output.is_empty() {
        return fail(&reporter, Exit::Usage, error("nothing says where to draw").hint("add `-o FILE`"));
    }
    if let Some(mesh) = output.formats(&reporter)?.iter().find(|target| target.is_mesh()) {
        let diagnostic = error(format!("`-o {}` is a mesh and no picture", mesh.path().display()));
        return fail(&reporter, Exit::Usage, diagnostic.hint("`vv mesh convert` writes meshes"));
    }
    let meshes = [meshes, input].concat();
    let run = run::Arguments::still(meshes, turntable, output, look, importing, reporting);
    run::run(&run, began)
}
