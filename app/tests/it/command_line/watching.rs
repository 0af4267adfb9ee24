//! `vv watch`: files change, and what is made of them is made anew.

use std::io::{BufRead as _, BufReader, Read};
use std::process::Child;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use super::*;

const STEP: &str = "#include \"more.vv\"\nvoid step(mesh& S) { forall v in S v$pos *= more(); }\n";

/// `vv watch`, and what it says line by line.
struct Watching {
    child: Child,
    out: Receiver<String>,
    err: Receiver<String>,
}

fn lines(from: impl Read + Send + 'static) -> Receiver<String> {
    let (tell, told) = channel();
    std::thread::spawn(move || BufReader::new(from).lines().map_while(Result::ok).try_for_each(|line| tell.send(line)));
    told
}

impl Watching {
    fn begin(folder: &Folder, arguments: &str) -> Self {
        let mut command = folder.command(&format!("watch {arguments} --diagnostic-format short"));
        let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let (out, err) = (lines(child.stdout.take().unwrap()), lines(child.stderr.take().unwrap()));
        Self { child, out, err }
    }

    /// The next line of stdout begins so.
    #[track_caller]
    fn makes(&self, expected: &str) -> String {
        let line = self.out.recv_timeout(Duration::from_secs(60)).expect("a line of stdout");
        assert!(line.starts_with(expected), "{line}");
        line
    }

    /// And that of stderr.
    #[track_caller]
    fn fails(&self, expected: &str) {
        let line = self.err.recv_timeout(Duration::from_secs(60)).expect("a line of stderr");
        assert!(line.starts_with(expected), "{line}");
    }

    #[cfg(unix)]
    fn signal(&self, name: &str) {
        let id = self.child.id().to_string();
        assert!(Command::new("kill").args(["-s", name, &id]).status().unwrap().success());
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn folder() -> Folder {
    Folder::with(&[("grow.vv", STEP), ("more.vv", "double more() { return 2.0; }\n")])
}

fn first(folder: &Folder, name: &str) -> String {
    vertices(&folder.read(name))[0].to_owned()
}

fn rename_over(folder: &Folder, name: &str, text: &str) {
    fs::write(folder.path("beside"), text).unwrap();
    fs::rename(folder.path("beside"), folder.path(name)).unwrap();
}

const MADE: &str = "grow.vv: 6 vertices, 12 edges, 8 faces; 1 file in ";

#[test]
fn outputs_are_made_anew_when_any_file_that_is_read_changes() {
    let folder = folder();
    fs::write(folder.path("from.txt"), "front").unwrap();
    fs::write(folder.path("look.json"), "{}").unwrap();
    let watching =
        Watching::begin(&folder, "grow.vv -i octahedron.obj -o a.obj --view from.txt --style look.json,no-edges");
    watching.makes(MADE);
    assert_eq!(first(&folder, "a.obj"), "2 0 0");
    rename_over(&folder, "more.vv", "double more() { return 3.0; }\n");
    watching.makes(MADE);
    assert_eq!(first(&folder, "a.obj"), "3 0 0");
    fs::write(folder.path("grow.vv"), STEP.replace("*=", "/=")).unwrap();
    watching.makes(MADE);
    assert!(first(&folder, "a.obj").starts_with("0.333"));
    rename_over(&folder, "octahedron.obj", &OCTAHEDRON.replace("v 1 0 0", "v 9 0 0"));
    watching.makes(MADE);
    assert_eq!(first(&folder, "a.obj"), "3 0 0");
    for (name, text) in [("from.txt", "back"), ("look.json", "{\"page\": \"85mm\"}")] {
        fs::remove_file(folder.path("a.obj")).unwrap();
        fs::write(folder.path(name), text).unwrap();
        watching.makes(MADE);
        assert!(folder.path("a.obj").is_file(), "{name}");
    }
}

#[test]
fn an_error_is_told_with_its_place_and_the_next_change_is_waited_for() {
    let folder = folder();
    let watching = Watching::begin(&folder, "grow.vv -i octahedron.obj -o a.obj");
    watching.makes(MADE);
    let good = folder.read("a.obj");
    fs::write(folder.path("more.vv"), "double more() { return 2.0 }\n").unwrap();
    watching.fails("more.vv:1:24: error: ");
    assert_eq!(folder.read("a.obj"), good);
    fs::write(folder.path("grow.vv"), FAILING).unwrap();
    watching.makes("before");
    watching.fails("grow.vv:5:");
    fs::write(folder.path("more.vv"), "double more() { return 5.0; }\n").unwrap();
    fs::remove_file(folder.path("octahedron.obj")).unwrap();
    fs::write(folder.path("grow.vv"), STEP).unwrap();
    watching.fails("error: octahedron.obj: there is no such file");
    fs::write(folder.path("octahedron.obj"), OCTAHEDRON).unwrap();
    watching.makes(MADE);
    assert_eq!(first(&folder, "a.obj"), "5 0 0");
}

#[test]
fn a_program_without_end_is_stopped_by_the_next_change() {
    let folder = Folder::with(&[("grow.vv", &ENDLESS.replace("while", "print(\"endless\"); while"))]);
    let watching = Watching::begin(&folder, "grow.vv -i octahedron.obj -o a.obj --timeout 0");
    // Compiled, though not yet told: the line waits for the end of the step.
    std::thread::sleep(Duration::from_millis(300));
    fs::write(folder.path("grow.vv"), STEP.replace("more()", "7.0").replace("#include \"more.vv\"", "")).unwrap();
    let line = watching.makes("");
    if line == "endless" {
        watching.makes(MADE);
    }
    assert_eq!(first(&folder, "a.obj"), "7 0 0");
    assert!(watching.err.try_recv().is_err(), "who changes a program knows that it is stopped");
}

#[test]
fn several_runs_are_counted_and_a_summary_has_stdout_for_itself() {
    let folder = Folder::with(&[]);
    let watching = Watching::begin(&folder, "move.vv -i octahedron.obj -D far=1,2 -o {far}.obj");
    watching.makes("move.vv: 2 runs; 2 files in ");
    let watching = Watching::begin(&folder, "move.vv -i octahedron.obj --summary json");
    watching.fails("move.vv: 6 vertices");
    assert_eq!(watching.makes("{"), "{");
}

#[test]
fn what_can_never_be_made_anew_is_refused() {
    check("watch - -i octahedron.obj", 2, "`vv watch` reads files, and what comes from stdin does not change");
    check("watch move.vv -i -", 2, "`vv run` reads stdin");
    check("watch move.vv -i octahedron.obj -o - --format obj", 2, "what went to stdout cannot be made anew");
    check(
        "watch move.vv -i octahedron.obj -o ./octahedron.obj",
        2,
        "octahedron.obj is read here, so it is not written",
    );
    check("watch move.vv -i octahedron.obj -o a.xyz", 2, "`-o a.xyz` has no extension");
    check("watch move.vv -i octahedron.obj -D for=1", 2, "for");
}

#[cfg(unix)]
#[test]
fn it_ends_when_interrupted_and_when_nobody_listens() {
    use std::os::unix::process::ExitStatusExt as _;
    let folder = folder();
    for (name, number) in [("INT", 2), ("TERM", 15)] {
        let mut watching = Watching::begin(&folder, "grow.vv -i octahedron.obj -o a.obj");
        watching.makes(MADE);
        watching.signal(name);
        assert_eq!(watching.child.wait().unwrap().signal(), Some(number));
    }
    let mut command = folder.command("watch grow.vv -i octahedron.obj -o a.obj");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut out = BufReader::new(child.stdout.take().unwrap());
    out.read_line(&mut String::new()).unwrap();
    drop(out);
    fs::write(folder.path("more.vv"), "double more() { return 3.0; }\n").unwrap();
    let ended = child.wait_with_output().unwrap();
    assert_eq!((ended.status.code(), ended.stderr.as_slice()), (Some(3), &b""[..]));
    assert!(!folder.names().iter().any(|name| name.ends_with(".tmp")));
}
