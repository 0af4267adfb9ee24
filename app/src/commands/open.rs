//! `vv [MESH] [PROGRAM]`

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use app::{files, library};
use clap::CommandFactory as _;
use vv::diagnostic::Diagnostic;
use vv::io::Format;

use super::report::Reporter;
use super::{Cli, DiagnosticFormat, Exit, closest, error, fail, guard, input, view};

/// Opens the modeler, and says why it ended if it was not asked to.
pub fn open(paths: &[PathBuf], viewpoint: Option<&str>) -> Result<(), Exit> {
    let reporter = Reporter::new(DiagnosticFormat::Human);
    let viewpoint = viewpoint.map(|given| view::read(given, &reporter)).transpose()?;
    let Opened { mesh, program } = sort(paths).or_else(|diagnostic| fail(&reporter, Exit::Usage, *diagnostic))?;
    // What no file has is perhaps the name of a program that comes with vv.
    let program_file = program.as_ref().filter(|path| library::meant(path).is_none());
    for path in [mesh.as_ref(), program_file].into_iter().flatten() {
        files::check_readable(path).map_err(|error| input::file_failed(&error, &reporter))?;
    }
    if let Some(problem) = no_window(|name| std::env::var_os(name), loader_finds) {
        return fail(&reporter, Exit::NoRenderer, problem);
    }
    let guard = guard::Guard::new();
    let result = app::gui::run(mesh, program, viewpoint);
    drop(guard);
    result.or_else(|problem| {
        if problem.was_open {
            guard::display_lost(&reporter);
            return Err(Exit::NoRenderer);
        }
        let display = std::env::var("WAYLAND_DISPLAY").or_else(|_| std::env::var("DISPLAY")).unwrap_or_default();
        fail(&reporter, Exit::NoRenderer, explained(&problem.to_string(), &display))
    })
}

/// What the window system or the driver says, in words that help.
fn explained(cause: &str, display: &str) -> Diagnostic {
    // The first line says what; what follows is a trace of who called whom.
    let line = cause.lines().next().unwrap_or_default();
    let diagnostic = if cause.contains("X server") || cause.contains("wayland compositor") {
        error(format!("the window cannot open: the display `{display}` does not answer"))
            .hint("WAYLAND_DISPLAY or DISPLAY must name a display that runs and lets you in")
    } else if cause.contains("surface") || cause.contains("adapter") {
        error("the window cannot open: there is no graphics driver to draw with")
            .evidence(line)
            .hint("on Debian and Ubuntu: apt install libvulkan1 mesa-vulkan-drivers, which draws without a GPU as well")
    } else {
        error(format!("the window cannot open: {line}")).hint(PACKAGES)
    };
    diagnostic.hint(WITHOUT_WINDOW)
}

/// What works without graphics.
const WITHOUT_WINDOW: &str = "`vv run PROGRAM -i MESH -o out.obj` works without window";
const PACKAGES: &str = "on Debian and Ubuntu a window needs the packages libxkbcommon-x11-0, libxcursor1, libxi6, \
                        libx11-xcb1, libvulkan1 and a driver such as mesa-vulkan-drivers";

/// What to open.
#[derive(Debug, Default, PartialEq, Eq)]
struct Opened {
    mesh: Option<PathBuf>,
    program: Option<PathBuf>,
}

/// Tells mesh and program apart by extension.
fn sort(paths: &[PathBuf]) -> Result<Opened, Box<Diagnostic>> {
    let mut opened = Opened::default();
    for path in paths {
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let (place, kind) = if extension.eq_ignore_ascii_case("vv") {
            (&mut opened.program, "program")
        } else if extension.eq_ignore_ascii_case(app::project::EXTENSION) {
            (&mut opened.program, "program or project")
        } else if Format::from_extension(&extension).is_some() {
            (&mut opened.mesh, "mesh")
        } else {
            return Err(Box::new(unknown(path)));
        };
        if let Some(other) = place.replace(path.clone()) {
            let message = format!("{} and {} are both a {kind}: vv opens one", other.display(), path.display());
            return Err(Box::new(error(message)));
        }
    }
    Ok(opened)
}

fn unknown(path: &Path) -> Diagnostic {
    let shown = path.display().to_string();
    let diagnostic =
        error(format!("`{shown}` is neither a program (.vv) nor a project (.vvp) nor a mesh nor a command"));
    let command = Cli::command();
    let names: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
    if is_of_meshes(&shown) {
        return diagnostic.hint(format!("the command is `vv mesh {shown}`"));
    }
    match closest(&shown, names.iter().copied().chain(["help"])) {
        Some(command) => diagnostic.hint(format!("did you mean `vv {command}`?")),
        None => diagnostic.hint(format!("the commands are `{}`; `vv --help` explains them", names.join("`, `"))),
    }
}

/// Whether this is a command of `vv mesh`.
fn is_of_meshes(word: &str) -> bool {
    let command = Cli::command();
    command.find_subcommand("mesh").is_some_and(|mesh| mesh.find_subcommand(word).is_some())
}

/// Refuses a command line that begins with a command of `vv mesh`; `None` if it does not.
pub fn misplaced() -> Option<Result<(), Exit>> {
    let first = std::env::args_os().nth(1)?;
    let is_meant = first.to_str().is_some_and(is_of_meshes);
    is_meant.then(|| fail(&Reporter::new(DiagnosticFormat::Human), Exit::Usage, unknown(Path::new(&first))))
}

/// Why there can be no window, if that is known in advance. What it asks for is what winit opens at run time: without
/// a display it says little, without the keyboard library it panics.
fn no_window<S: AsRef<OsStr>>(
    variable: impl Fn(&str) -> Option<S>,
    has_library: impl Fn(&str) -> bool,
) -> Option<Diagnostic> {
    if !cfg!(all(unix, not(target_os = "macos"))) {
        return None;
    }
    let set = |name: &str| variable(name).is_some_and(|value| !value.as_ref().is_empty());
    let wayland = set("WAYLAND_DISPLAY") || set("WAYLAND_SOCKET");
    if !wayland && !set("DISPLAY") {
        return Some(
            error("there is no display to open a window on")
                .evidence("neither WAYLAND_DISPLAY nor DISPLAY is set")
                .hint(WITHOUT_WINDOW)
                .hint("over ssh, `ssh -X` gives a display; `xvfb-run vv` opens the window where nobody sees it"),
        );
    }
    let needed: &[(&str, &str)] = if wayland {
        &[("libxkbcommon.so.0", "libxkbcommon0"), ("libwayland-client.so.0", "libwayland-client0")]
    } else {
        &[
            ("libxkbcommon.so.0", "libxkbcommon0"),
            ("libxkbcommon-x11.so.0", "libxkbcommon-x11-0"),
            ("libX11.so.6", "libx11-6"),
            ("libX11-xcb.so.1", "libx11-xcb1"),
            ("libXcursor.so.1", "libxcursor1"),
            ("libXi.so.6", "libxi6"),
        ]
    };
    let missing: Vec<_> = needed.iter().filter(|(library, _)| !has_library(library)).collect();
    if missing.is_empty() {
        return None;
    }
    let names = |which: fn(&(&'static str, &'static str)) -> &'static str, between: &str| {
        missing.iter().map(|&pair| which(pair)).collect::<Vec<_>>().join(between)
    };
    Some(
        error(format!("the window needs libraries that are not installed: {}", names(|p| p.0, ", ")))
            .hint(format!("on Debian and Ubuntu: apt install {}", names(|p| p.1, " ")))
            .hint(WITHOUT_WINDOW),
    )
}

/// Whether the dynamic loader would find a library. Where that cannot be told (no loader cache) it may.
fn loader_finds(library: &str) -> bool {
    let Ok(cache) = fs::read("/etc/ld.so.cache") else { return true };
    if cache.windows(library.len()).any(|part| part == library.as_bytes()) {
        return true;
    }
    let paths = std::env::var_os("LD_LIBRARY_PATH").unwrap_or_default();
    let usual = ["/lib", "/usr/lib", "/lib64", "/usr/lib64", "/usr/local/lib"].map(PathBuf::from);
    std::env::split_paths(&paths).chain(usual).any(|folder| folder.join(library).exists())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn sorted(paths: &[&str], expected: Result<(Option<&str>, Option<&str>), &str>) {
        let paths: Vec<_> = paths.iter().map(PathBuf::from).collect();
        let got = sort(&paths).map_err(|d| d.message);
        let expected = expected
            .map(|(mesh, program)| Opened { mesh: mesh.map(PathBuf::from), program: program.map(PathBuf::from) });
        assert_eq!(got, expected.map_err(str::to_owned));
    }

    #[test]
    fn mesh_and_program_come_in_either_order() {
        sorted(&[], Ok((None, None)));
        sorted(&["a.obj"], Ok((Some("a.obj"), None)));
        sorted(&["a.OFF", "b.vv"], Ok((Some("a.OFF"), Some("b.vv"))));
        sorted(&["b.vv", "a.off"], Ok((Some("a.off"), Some("b.vv"))));
        sorted(&["a.vvp"], Ok((None, Some("a.vvp"))));
        sorted(&["a.vv", "b.vv"], Err("a.vv and b.vv are both a program: vv opens one"));
        sorted(&["a.stp"], Err("`a.stp` is neither a program (.vv) nor a project (.vvp) nor a mesh nor a command"));
    }

    #[cfg(target_os = "linux")]
    #[track_caller]
    fn windowless(variables: &[(&str, &str)], missing: &[&str], expected: Option<&str>) {
        let variable = |name: &str| variables.iter().find(|(n, _)| *n == name).map(|(_, value)| value);
        let got = no_window(variable, |library| !missing.contains(&library)).map(|d| d.message);
        assert_eq!(got.as_deref(), expected);
    }

    #[test]
    fn causes_are_explained() {
        for (cause, expected) in [
            ("os error at x.rs:788: Failed to open connection to X server", "the display `:7` does not answer"),
            ("os error at x.rs:89: Could not find wayland compositor", "the display `:7` does not answer"),
            ("Failed to create surface for any enabled backend: {}", "there is no graphics driver to draw with"),
            ("it broke\n\nCaused by:\n  something", "it broke"),
        ] {
            assert_eq!(explained(cause, ":7").message, format!("the window cannot open: {expected}"));
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn what_keeps_the_window_from_opening_is_known_before() {
        windowless(&[], &[], Some("there is no display to open a window on"));
        windowless(&[("DISPLAY", "")], &[], Some("there is no display to open a window on"));
        windowless(&[("DISPLAY", ":0")], &[], None);
        windowless(&[("WAYLAND_DISPLAY", "wayland-0")], &["libxkbcommon-x11.so.0"], None);
        let message = "the window needs libraries that are not installed: libxkbcommon-x11.so.0";
        windowless(&[("DISPLAY", ":0")], &["libxkbcommon-x11.so.0"], Some(message));
    }
}
