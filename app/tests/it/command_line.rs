//! The command line, run as a user runs it: exit code, stdout, stderr and the files that are left behind.

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

mod usage {
    use super::*;

    #[test]
    fn a_command_line_that_cannot_be_meant_so_says_why() {
        for (arguments, said) in [
            ("run", "PROGRAM"),
            ("run move.vv --nonsense", "--nonsense"),
            ("run move.vv -i octahedron.obj -n -1", "-1"),
            ("run move.vv -i octahedron.obj --timeout soon", "seconds are a number"),
            ("run move.vv -i octahedron.obj --size 3", "a size is width and height such as 1280x960"),
            ("run move.vv -i octahedron.obj --tolerance 1", "--reference"),
            ("run move.vv", "move.vv has no `start` that would make a mesh, so it needs one\n`-i MESH`"),
            ("run - -i -", "program and mesh cannot both be read from stdin"),
            ("run move.vv -i octahedron.obj -o -", "`-o -` does not say what to write\n--format"),
            ("run move.vv -i octahedron.obj -o x.stl", "`-o x.stl` has no extension that vv writes\n`.obj`"),
            ("run move.vv -i octahedron.obj -o x.obj -o x.obj", "`-o x.obj` is given twice"),
            ("run move.vv -i octahedron.obj -o - --format obj --summary json", "both need stdout"),
            ("run move.vv -i octahedron.obj --rule stil", "no rule `stil`\n`shift`, `still` and `step`\n--rule still"),
            ("run triangle.vv -n 2", "triangle.vv has no rule to apply 2 times, only `start`"),
            ("run triangle.vv --rule start", "triangle.vv has no rule `start`\nit has only `start`"),
            ("mesh convert square.off", "nothing says where to write\n-o FILE"),
            ("mesh", "info"),
        ] {
            check(arguments, 2, said);
        }
    }

    #[test]
    fn definitions_must_fit_the_parameters() {
        for (definition, said) in [
            ("far", "a definition is a name and a value"),
            ("fax=1", "no parameter `fax`\n`far`, `times` and `along`\n-D far="),
            ("far=wide", "`far` is a number\nits default is 1"),
            ("far=10.5", "`far` must lie in [0, 10]"),
            ("times=0.5", "`times` is a whole number"),
            ("along=1,2", "`along` is a vector, written x,y,z\n1,0,0"),
        ] {
            check(&format!("run move.vv -i octahedron.obj -D {definition}"), 2, said);
        }
        check("run triangle.vv -D a=1", 2, "it has no parameters\nparam double a");
    }

    #[test]
    fn help_and_version_are_there() {
        let help = check("run --help", 0, "").stdout;
        assert!(help.contains("Exit codes:") && help.contains("Examples:"));
        assert!(check("--version", 0, "").stdout.starts_with("vv "));
    }
}

mod window {
    use super::*;

    #[cfg(target_os = "linux")]
    #[test]
    fn without_a_display_it_names_the_way_that_needs_none() {
        check("", 6, "there is no display to open a window on\nWAYLAND_DISPLAY nor DISPLAY\nvv run");
        check("square.off move.vv", 6, "vv run");
    }

    #[test]
    fn what_cannot_be_opened_is_said_before() {
        check("none.vv", 3, "none.vv: there is no such file");
        check("move.vv triangle.vv", 2, "move.vv and triangle.vv are both a program: vv opens one");
        check("chek move.vv", 2, "`chek` is neither a program (.vv) nor a mesh (.obj, .off) nor a command\n`vv check`");
    }
}

mod files {
    use super::*;

    #[test]
    fn a_file_that_cannot_be_read_is_named() {
        for arguments in ["run none.vv", "check none.vv", "run move.vv -i none.obj", "mesh info none.obj"] {
            check(arguments, 3, "there is no such file or directory\nnone.");
        }
        check("run move.vv -i octahedron.obj --reference none.obj", 3, "none.obj: there is no such file");
        check("check .", 3, ".: is a directory, not a file");
        check("mesh info move.vv", 3, "move.vv: `.vv` is no mesh format that vv reads\n`.obj` or `.off`");
        check("mesh info endless", 3, "endless: has no extension");
    }

    #[test]
    fn a_program_that_is_no_text_is_refused() {
        let folder = Folder::with(&[]);
        fs::write(folder.path("latin.vv"), b"// na\xEFve\n").unwrap();
        folder.check("check latin.vv", 3, "latin.vv:1: is no text in UTF-8\n0xEF");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_device_without_end_is_refused() {
        check("check /dev/zero", 3, "/dev/zero: is no text");
        let folder = Folder::with(&[]);
        let mut command = folder.command("mesh info -");
        let status = command.stdin(fs::File::open("/dev/zero").unwrap()).stderr(Stdio::null()).status().unwrap();
        assert_eq!(status.code(), Some(3));
    }

    #[test]
    fn a_mesh_that_is_none_is_refused() {
        for (name, text, said) in [
            ("m.obj", "", "m.obj: is empty"),
            ("m.off", " \n\n", "m.off: is empty"),
            ("m.obj", "# nothing\n", "m.obj: no faces can be made"),
            ("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\n", "m.obj: no faces can be made"),
            ("m.off", "OFF\n0 0 0\n", "m.off: no faces can be made"),
            ("m.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "m.obj:3: "),
            ("m.obj", "v 0 0 0\nv 1 0", "m.obj:2: "),
            ("m.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0", "m.off"),
        ] {
            check_file(name, text, &format!("mesh info {name}"), 3, said);
            check_file(name, text, &format!("run move.vv -i {name} -o out.obj"), 3, said);
        }
    }

    #[test]
    fn one_polygon_is_a_mesh() {
        let text = "OFF\n7 1 0\n0 0 0\n1 0 0\n2 1 0\n2 2 0\n1 3 0\n0 3 0\n-1 1 0\n7 0 1 2 3 4 5 6\n";
        let folder = Folder::with(&[("m.off", text)]);
        let info = json(&folder.check("mesh info m.off --json", 0, "").stdout);
        assert_eq!((&info["faces"], &info["boundary_loops"]), (&1.into(), &1.into()));
        folder.check("run move.vv -i m.off -o out.off", 0, "");
        assert!(folder.read("out.off").contains("7 0 1 2 3 4 5 6"));
    }

    #[test]
    fn a_repaired_mesh_is_a_warning_and_an_error_when_strict() {
        let fins = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n";
        let folder = Folder::with(&[("fins.obj", fins)]);
        folder.check("run move.vv -i fins.obj -o out.obj", 0, "fins.obj\nwarning");
        let info = json(&folder.check("mesh info fins.obj --json", 0, "warning").stdout);
        assert_eq!(info["faces"], 3);
        assert!(!info["warnings"].as_array().unwrap().is_empty());
        folder.check("mesh info fins.obj --strict", 3, "fins.obj");
        folder.check("run move.vv -i fins.obj --strict -o out2.obj", 3, "fins.obj");
    }
}

mod outputs {
    use super::*;

    #[test]
    fn each_extension_gets_its_format() {
        let folder = Folder::with(&[]);
        folder.check("run move.vv -i octahedron.obj -o a.obj -o b.off", 0, "");
        assert_eq!(vertices(&folder.read("a.obj"))[..2], ["2 0 0", "0 0 0"]);
        assert!(folder.read("b.off").starts_with("OFF\n6 8 "));
    }

    #[test]
    fn stdout_holds_nothing_but_the_output() {
        let folder = Folder::with(&[]);
        let ended = folder.run("run triangle.vv -o - --format off");
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), "started\n"));
        assert!(ended.stdout.starts_with("OFF\n3 1 "), "{}", ended.stdout);
        let ended = folder.run_with_stdin("mesh convert - -o - --format obj", &ended.stdout);
        assert_eq!(vertices(&ended.stdout), ["0 0 0", "1 0 0", "0 1 0"]);
    }

    #[test]
    fn a_failed_step_writes_nothing_and_leaves_what_was_there() {
        let folder = Folder::with(&[("old.obj", "old")]);
        let ended = folder.check("run failing.vv -i octahedron.obj -o new.obj -o old.obj", 1, "failing.vv:5:");
        assert_eq!(ended.stdout, "before\n");
        assert_eq!(folder.read("old.obj"), "old");
    }

    #[test]
    fn if_one_place_cannot_be_written_to_none_is() {
        let folder = Folder::with(&[]);
        fs::create_dir(folder.path("folder.obj")).unwrap();
        folder.check("run triangle.vv -o a.obj -o none/b.obj", 3, "none/b.obj: there is no directory `none`");
        folder.check("run triangle.vv -o a.obj -o folder.obj", 3, "folder.obj: is a directory, not a file");
        folder.check("run endless.vv -i octahedron.obj -o none/b.obj", 3, "none/b.obj");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_an_error() {
        check("run triangle.vv -o a.obj -o /dev/full --format obj", 3, "/dev/full: no space is left on the device");
        for arguments in ["run triangle.vv", "run triangle.vv --summary json", "mesh info square.off"] {
            let folder = Folder::with(&[]);
            let mut command = folder.command(arguments);
            command.stdout(fs::OpenOptions::new().write(true).open("/dev/full").unwrap());
            let output = command.output().unwrap();
            assert_eq!(output.status.code(), Some(3), "{arguments}");
            assert!(String::from_utf8_lossy(&output.stderr).contains("<stdout>: no space is left"), "{arguments}");
        }
    }

    #[test]
    fn a_closed_pipe_ends_quietly() {
        let talking = "void step(mesh& S) { while (true) print(\"again and again\"); }\n";
        let folder = Folder::with(&[("talking.vv", talking)]);
        for arguments in [
            "run talking.vv -i octahedron.obj --timeout 60 -o a.obj",
            "run triangle.vv -o - --format obj -o a.obj",
            "run triangle.vv --summary json -o a.obj",
            "mesh info square.off",
        ] {
            let before = folder.names();
            let mut command = folder.command(arguments);
            let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
            drop(child.stdout.take());
            let output = child.wait_with_output().unwrap();
            let said = String::from_utf8_lossy(&output.stderr).replace("started\n", "");
            assert_eq!((output.status.code(), said.as_str()), (Some(3), ""), "{arguments}");
            assert_eq!(folder.names(), before, "{arguments}");
        }
    }

    #[test]
    fn a_mesh_without_vertices_is_not_written() {
        let text = "void step(mesh& S) { forall v in S remove v from S; }\n";
        check_file("p.vv", text, "run p.vv -i square.off -o a.obj", 1, "no vertices left");
        check_file("p.vv", text, "run p.vv -i square.off --summary json", 0, "");
    }
}

mod programs {
    use super::*;

    #[test]
    fn errors_in_the_text_end_before_anything_is_written() {
        let text = "void step(mesh& S) {\n  x = 1;\n  y = 2;\n}\n";
        let folder = Folder::with(&[("p.vv", text)]);
        folder.check("run p.vv -i square.off -o a.obj", 1, "p.vv:2:\np.vv:3:");
        folder.check("check p.vv move.vv", 1, "p.vv:2:");
    }

    #[test]
    fn programs_without_fault_are_checked_in_silence() {
        assert_eq!(check("check move.vv triangle.vv endless.vv", 0, "").stdout, "");
    }

    #[test]
    fn every_file_is_checked_whatever_is_wrong_with_others() {
        let folder = Folder::with(&[("p.vv", "void step(mesh& S) { x = 1; }\n")]);
        folder.check("check none.vv p.vv", 3, "none.vv\np.vv:1:");
    }

    #[test]
    fn a_program_with_nothing_to_run_says_what_a_rule_is() {
        for text in ["", "// nothing\n", "int f() { return 1; }\n"] {
            check_file("p.vv", text, "run p.vv -i square.off", 1, "p.vv has nothing to run\nvoid name(mesh& S)");
        }
    }

    #[test]
    fn an_include_is_found_beside_its_file_or_among_those_that_ship() {
        let folder =
            Folder::with(&[("p.vv", "#include \"insert.vv\"\n#include \"sub/q.vv\"\nvoid step(mesh& S) { q(); }\n")]);
        folder.check("check p.vv", 1, "p.vv:2:");
        fs::create_dir(folder.path("sub")).unwrap();
        fs::write(folder.path("sub/q.vv"), "#include \"../p.vv\"\nvoid q() { print(\"q\"); }\n").unwrap();
        assert_eq!(folder.check("run p.vv -i square.off", 0, "").stdout, "q\n");
    }

    #[test]
    fn diagnostics_come_in_three_forms() {
        let folder = Folder::with(&[("p.vv", "void step(mesh& S) {\n  x = 1;\n}\n")]);
        let short = folder.check("check p.vv --diagnostic-format short", 1, "p.vv:2:3: error: ").stderr;
        assert_eq!(short.lines().count(), 1, "{short}");
        let lines = folder.check("check p.vv --diagnostic-format json", 1, "p.vv").stderr;
        let object = json(lines.trim());
        assert_eq!(object["severity"], "error");
        folder.check("check p.vv", 1, "x = 1;");
        let lines = folder.check("check none.vv --diagnostic-format json", 3, "none.vv").stderr;
        assert_eq!(json(lines.trim())["severity"], "error");
        let lines = folder.check("run failing.vv -i square.off --diagnostic-format json", 1, "failing.vv").stderr;
        assert_eq!(json(lines.trim())["severity"], "error");
    }

    #[test]
    fn the_default_is_one_application_of_step() {
        for (arguments, x) in [
            ("", "2 0 0"),
            ("-n 0", "1 0 0"),
            ("-n 3", "4 0 0"),
            ("--rule shift -n 2", "3 0 0"),
            ("--rule still", "1 0 0"),
            ("-D far=0.5", "1.5 0 0"),
            ("-D far=0.5 -D far=2", "3 0 0"),
            ("-D times=-2", "-1 0 0"),
            ("-D along=0,1,2", "1 1 2"),
        ] {
            let folder = Folder::with(&[]);
            folder.check(&format!("run move.vv -i octahedron.obj -o a.obj {arguments}"), 0, "");
            assert_eq!(vertices(&folder.read("a.obj"))[0], x, "{arguments}");
        }
    }

    #[test]
    fn start_makes_its_own_mesh() {
        let folder = Folder::with(&[]);
        assert_eq!(folder.check("run triangle.vv -o a.obj", 0, "").stdout, "started\n");
        assert_eq!(vertices(&folder.read("a.obj")), ["0 0 0", "1 0 0", "0 1 0"]);
    }

    #[test]
    fn program_and_mesh_may_come_from_stdin() {
        let folder = Folder::with(&[]);
        for (arguments, stdin) in [
            ("run - -i octahedron.obj -o a.obj", MOVE),
            ("run move.vv -i - -o a.obj", OCTAHEDRON),
            ("run move.vv -i - -o a.obj", SQUARE),
        ] {
            let ended = folder.run_with_stdin(arguments, stdin);
            assert_eq!(ended.code, Some(0), "{}", ended.stderr);
            assert!(folder.read("a.obj").contains("v 2 "));
        }
        let ended = folder.run_with_stdin("check -", "void step(mesh& S) { x = 1; }\n");
        assert!(ended.code == Some(1) && ended.stderr.contains("<stdin>:1:22"), "{}", ended.stderr);
    }

    #[test]
    fn random_numbers_follow_the_seed() {
        let folder = Folder::with(&[("p.vv", "void step(mesh& S) { print(random()); }\n")]);
        let printed = |seed| folder.check(&format!("run p.vv -i square.off -n 2 --seed {seed}"), 0, "").stdout;
        assert_eq!(printed(1), printed(1));
        assert_ne!(printed(1), printed(2));
    }
}

mod budgets {
    use super::*;

    #[test]
    fn an_endless_loop_runs_out_of_time() {
        check(
            "run endless.vv -i square.off --timeout 0.2 -o a.obj",
            4,
            "endless.vv:1:\nstep 1 of 1 of `step`\n--timeout",
        );
    }

    #[test]
    fn each_step_has_the_whole_time() {
        let text = "void step(mesh& S) { for (int i = 0; i < 20000; i++) { } }\n";
        check_file("p.vv", text, "run p.vv -i square.off -n 40 --timeout 20", 0, "");
    }

    #[test]
    fn vertices_without_end_run_out_of_room() {
        let text = "void step(mesh& S) { while (true) { vertex v; add v to S; } }\n";
        check_file("p.vv", text, "run p.vv -i square.off --max-vertices 1000 -o a.obj", 4, "p.vv:1:\n1000");
        check("run move.vv -i octahedron.obj --max-vertices 5", 4, "octahedron.obj: has 6 vertices, 5 are allowed");
    }

    #[test]
    fn recursion_without_end_runs_out_of_calls() {
        let text = "int f(int i) { return f(i + 1); }\nvoid step(mesh& S) { print(f(0)); }\n";
        check_file("p.vv", text, "run p.vv -i square.off", 4, "p.vv:1:");
    }
}

mod summary {
    use super::*;

    const FIELDS: &[&str] = &[
        "vertices",
        "edges",
        "faces",
        "components",
        "boundary_loops",
        "euler_characteristic",
        "genus",
        "closed",
        "valid",
        "warnings",
        "timings",
    ];
    const TIMINGS: &[&str] =
        &["load_s", "compile_s", "steps_s", "closing_s", "faces_s", "export_s", "render_s", "total_s"];

    #[track_caller]
    fn has_fields(object: &Value, expected: &[&str]) {
        let mut expected = expected.to_owned();
        expected.sort_unstable();
        let mut got: Vec<_> = object.as_object().unwrap().keys().map(String::as_str).collect();
        got.sort_unstable();
        assert_eq!(got, expected);
    }

    #[test]
    fn it_is_the_whole_of_stdout() {
        let folder = Folder::with(&[]);
        let ended = folder.check("run move.vv -i octahedron.obj --rule still -n 2 --summary json", 0, "still\nstill");
        let summary = json(&ended.stdout);
        has_fields(&summary, FIELDS);
        has_fields(&summary["timings"], TIMINGS);
        for (name, expected) in [
            ("vertices", Value::from(6)),
            ("edges", 12.into()),
            ("faces", 8.into()),
            ("components", 1.into()),
            ("boundary_loops", 0.into()),
            ("euler_characteristic", 2.into()),
            ("genus", 0.into()),
            ("closed", true.into()),
            ("valid", true.into()),
            ("warnings", Vec::<Value>::new().into()),
        ] {
            assert_eq!(summary[name], expected, "{name}");
        }
        for list in ["steps_s", "closing_s"] {
            assert_eq!(summary["timings"][list].as_array().unwrap().len(), 2, "{list}");
        }
        assert!(summary["timings"]["total_s"].as_f64().unwrap() > 0.0);
    }

    #[test]
    fn it_repeats_what_was_warned_of() {
        let text =
            "void step(mesh& S) {\n  forall v in S {\n    vertex x;\n    splice x after any in v in v;\n  }\n}\n";
        let folder = Folder::with(&[("p.vv", text)]);
        let summary = json(
            &folder.check("run p.vv -i square.off --summary json", 0, "warning: after step 1 of 1 of `step`: ").stdout,
        );
        let warnings = summary["warnings"].as_array().unwrap();
        assert!(warnings.iter().any(|w| w.as_str().unwrap().starts_with("after step 1 of 1 of `step`: ")), "{summary}");
    }

    #[test]
    fn a_failed_run_has_none() {
        assert_eq!(check("run failing.vv -i square.off --summary json", 1, "failing.vv:5:\nbefore").stdout, "");
    }
}

mod references {
    use super::*;

    #[test]
    fn a_mesh_is_compared_with_an_earlier_one() {
        let folder = Folder::with(&[]);
        folder.check("run move.vv -i octahedron.obj -o old.off", 0, "");
        folder.check("run move.vv -i octahedron.obj --reference old.off", 0, "");
        folder.check("run move.vv -i octahedron.obj -D far=1.25 --reference old.off --tolerance 0.25", 0, "");
        let said = "the mesh is not that of old.off: v1 is 2.5e-1 off its place; 6 vertices";
        folder.check("run move.vv -i octahedron.obj -D far=1.25 --reference old.off", 5, said);
        folder.check("run triangle.vv --reference old.off", 5, "it has 3 vertices in place of 6");
    }

    #[test]
    fn the_outputs_are_written_for_a_look_at_the_difference() {
        let folder = Folder::with(&[]);
        let ended = folder.run("run move.vv -i octahedron.obj -o new.obj --reference octahedron.obj --summary json");
        assert_eq!(ended.code, Some(5));
        assert_eq!(vertices(&folder.read("new.obj"))[0], "2 0 0");
        assert_eq!(json(&ended.stdout)["vertices"], 6);
        let ended = folder.run("run move.vv -i octahedron.obj -o new.obj --reference new.obj");
        assert_eq!(ended.code, Some(0), "the reference is read before it is overwritten: {}", ended.stderr);
    }
}

mod pictures {
    use super::*;

    fn size(path: &Path) -> (u32, u32) {
        image::image_dimensions(path).unwrap()
    }

    #[test]
    fn a_picture_has_the_size_asked_for() {
        let folder = Folder::with(&[]);
        folder.check("run move.vv -i octahedron.obj -o a.png", 0, "");
        assert_eq!(size(&folder.path("a.png")), (1280, 960));
        folder.check("mesh convert square.off -o b.png --size 90x60", 0, "");
        assert_eq!(size(&folder.path("b.png")), (90, 60));
        let colors: std::collections::HashSet<_> =
            image::open(folder.path("b.png")).unwrap().into_rgba8().pixels().copied().collect();
        assert!(colors.len() > 2, "the picture is empty");
    }

    #[test]
    fn a_picture_goes_to_stdout_as_it_is() {
        let folder = Folder::with(&[]);
        let mut command = folder.command("run triangle.vv -o - --format png --size 8x8");
        let output = command.output().unwrap();
        assert_eq!((output.status.code(), &output.stdout[..4]), (Some(0), &b"\x89PNG"[..]));
        assert_eq!(output.stderr, b"started\n");
    }

    #[test]
    fn a_picture_is_compared_with_an_earlier_one() {
        let folder = Folder::with(&[]);
        folder.check("run move.vv -i octahedron.obj -n 0 -o old.png --size 120x90", 0, "");
        folder.check("run move.vv -i octahedron.obj -n 0 --reference old.png", 0, "");
        let said = "the picture is not old.png: the pixel at (";
        folder.check("run triangle.vv --reference old.png", 5, said);
        folder.check("run triangle.vv --reference old.png --tolerance 1", 0, "");
        let said = "it has 60x45 pixels in place of 120x90";
        folder.check("run triangle.vv --reference old.png --size 60x45", 5, said);
    }

    #[test]
    fn a_reference_that_is_no_picture_is_refused() {
        check_file("old.png", "no picture", "run triangle.vv --reference old.png", 3, "old.png: is no PNG picture");
        check("run triangle.vv --reference none.png", 3, "none.png: there is no such file or directory");
    }

    /// Nothing at all is drawn to where the Vulkan loader is told to look for drivers in a file that is none.
    #[cfg(target_os = "linux")]
    #[test]
    fn without_a_driver_meshes_are_made_and_pictures_say_what_they_need() {
        let folder = Folder::with(&[]);
        let run = |arguments| {
            let mut command = folder.command(arguments);
            for variable in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
                command.env(variable, "/dev/null");
            }
            command.env("WGPU_BACKEND", "vulkan").output().unwrap()
        };
        let output = run("run move.vv -i octahedron.obj -o a.obj -o a.png");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(6), "{said}");
        assert!(said.contains("mesa-vulkan-drivers") && !folder.names().contains(&"a.obj".to_owned()), "{said}");
        assert_eq!(run("run move.vv -i octahedron.obj -o a.obj --summary json").status.code(), Some(0));
    }
}

mod meshes {
    use super::*;

    #[test]
    fn info_is_a_table_or_an_object() {
        let folder = Folder::with(&[]);
        let table = folder.check("mesh info square.off", 0, "").stdout;
        for row in ["vertices              4\n", "faces                 2\n", "closed                no\n"] {
            assert!(table.contains(row), "{table}");
        }
        let info = json(&folder.check("mesh info square.off --json", 0, "").stdout);
        assert_eq!(info["edges"], 5);
        assert_eq!(info["bounds"], json("[[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]]"));
        assert_eq!(info["warnings"], json("[]"));
    }

    #[test]
    fn conversion_keeps_vertices_and_faces() {
        let folder = Folder::with(&[]);
        folder.check("mesh convert octahedron.obj -o a.off", 0, "");
        folder.check("mesh convert a.off -o b.obj", 0, "");
        assert_eq!(vertices(&folder.read("b.obj")), vertices(OCTAHEDRON));
        folder.check("mesh convert b.obj -o c.off", 0, "");
        assert_eq!(folder.read("a.off"), folder.read("c.off"));
    }
}

/// Every program that ships is without fault.
#[test]
fn shipped_programs_are_checked() {
    let programs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/programs");
    for program in fs::read_dir(programs).unwrap() {
        check(&format!("check {}", program.unwrap().path().display()), 0, "");
    }
}
