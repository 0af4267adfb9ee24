//! The command line of vv.

mod commands;

fn main() -> std::process::ExitCode {
    commands::main()
}
