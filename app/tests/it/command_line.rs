//! The command line, run as a user runs it: exit code, stdout, stderr and the files that are left behind.

mod budgets;
mod documented;
mod figures;
mod files;
mod headless;
mod language_server;
mod layout;
mod losses;
mod masks;
mod meshes;
mod outputs;
mod pictures;
mod programs;
mod references;
mod several;
mod summary;
mod usage;
mod watching;
mod window;

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;
use tempfile::TempDir;

const OCTAHEDRON: &str = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
                          f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
const SQUARE: &str = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
const MOVE: &str = "param double far = 1 in [0, 10];\nparam int times = 1;\nparam vec along = vec(1, 0, 0);\n\
                    void shift(mesh& S) { forall v in S v$pos += far * times * along; }\n\
                    void still(mesh& S) { print(\"still\"); }\n\
                    void step(mesh& S) { forall v in S v$pos += far * times * along; }\n";
const TRIANGLE: &str = "void start(mesh& S) {\n  vertex a; vertex b; vertex c;\n  a$pos = vec(0, 0, 0);\n  \
                        b$pos = vec(1, 0, 0);\n  c$pos = vec(0, 1, 0);\n  make {b, c, null} nb_of a;\n  \
                        make {c, a, null} nb_of b;\n  make {a, b, null} nb_of c;\n  \
                        add a to S; add b to S; add c to S;\n  print(\"started\");\n}\n";
const ENDLESS: &str = "void step(mesh& S) { while (true) { } }\n";
const FAILING: &str =
    "void step(mesh& S) {\n  print(\"before\");\n  forall v in S {\n    vertex x = null;\n    x$pos = v$pos;\n  }\n}\n";

/// How vv ended.
struct Ended {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

/// A folder to run vv in.
struct Folder(TempDir);

impl Folder {
    /// With the fixtures above and these files.
    fn with(files: &[(&str, &str)]) -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        let fixtures = [
            ("octahedron.obj", OCTAHEDRON),
            ("square.off", SQUARE),
            ("move.vv", MOVE),
            ("triangle.vv", TRIANGLE),
            ("endless.vv", ENDLESS),
            ("failing.vv", FAILING),
        ];
        for (name, text) in fixtures.iter().chain(files) {
            fs::write(folder.path(name), text).unwrap();
        }
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    fn names(&self) -> Vec<String> {
        let files = fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<_> = files.map(|f| f.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_vv"));
        command.args(arguments.split_whitespace()).current_dir(self.0.path());
        for display in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            command.env_remove(display);
        }
        // As on a machine without session, where Mesa's driver would complain.
        command.env_remove("XDG_RUNTIME_DIR");
        command
    }

    fn run(&self, arguments: &str) -> Ended {
        self.run_with_stdin(arguments, "")
    }

    fn run_with_stdin(&self, arguments: &str, stdin: &str) -> Ended {
        let mut command = self.command(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        // A command that does not read its stdin may have ended already.
        let _ = child.stdin.take().unwrap().write_all(stdin.as_bytes());
        let output = child.wait_with_output().unwrap();
        let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
        Ended { code: output.status.code(), stdout: text(&output.stdout), stderr: text(&output.stderr) }
    }

    /// Runs `vv arguments` and expects this exit code, each line of `said` in stderr (silence if there is none), and
    /// no other file than before, unless the command succeeds.
    #[track_caller]
    fn check(&self, arguments: &str, code: i32, said: &str) -> Ended {
        let before = self.names();
        let ended = self.run(arguments);
        assert_eq!(ended.code, Some(code), "vv {arguments}: {}", ended.stderr);
        for line in said.lines() {
            assert!(ended.stderr.contains(line), "vv {arguments} does not say `{line}` but:\n{}", ended.stderr);
        }
        assert!(!said.is_empty() || ended.stderr.is_empty(), "vv {arguments} is not silent:\n{}", ended.stderr);
        assert!(!ended.stderr.contains("panicked"), "{}", ended.stderr);
        assert!(code == 0 || self.names() == before, "vv {arguments} left {:?}", self.names());
        ended
    }
}

/// Runs vv in a folder with the fixtures only.
#[track_caller]
fn check(arguments: &str, code: i32, said: &str) -> Ended {
    Folder::with(&[]).check(arguments, code, said)
}

/// Runs vv in a folder with the fixtures and `name` with `text`.
#[track_caller]
fn check_file(name: &str, text: &str, arguments: &str, code: i32, said: &str) -> Ended {
    Folder::with(&[(name, text)]).check(arguments, code, said)
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error} in {text}"))
}

fn vertices(obj: &str) -> Vec<&str> {
    obj.lines().filter_map(|line| line.strip_prefix("v ")).collect()
}

/// Every program that ships is without fault.
#[test]
fn shipped_programs_are_checked() {
    let programs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/programs");
    for program in fs::read_dir(programs).unwrap() {
        check(&format!("check {}", program.unwrap().path().display()), 0, "");
    }
}
