//! The command line of vv.

mod commands;

fn main() -> std::process::ExitCode {
    if let Some(path) = std::env::var_os("VV_TRACE")
        && let Err(error) = app::trace::write_to(path.as_ref())
    {
        eprintln!("no trace is written to {}: {error}", path.display());
    }
    commands::main()
}
