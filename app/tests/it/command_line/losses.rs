//! Outputs that cannot be kept: a pipe that nobody reads, a disk that is full, a folder that is missing. Whatever is
//! written, the exit code is 3, and there is no half of a file.

use vv::io::Format;

use super::*;

/// What goes to stdout beside meshes, and what it needs from stdin.
const TO_STDOUT: [(&str, &str); 19] = [
    ("run triangle.vv", ""),
    ("run triangle.vv --summary json", ""),
    ("run triangle.vv --generations 0 --summary json", ""),
    ("run triangle.vv -o - --format png --size 8x8", ""),
    ("run triangle.vv -o - --format svg", ""),
    ("run triangle.vv -o - --format eps", ""),
    ("run triangle.vv -o - --format pdf", ""),
    ("mesh convert square.off -o - --format obj", ""),
    ("mesh info square.off", ""),
    ("mesh info square.off --json", ""),
    ("mesh diff square.off octahedron.obj", ""),
    ("mask move.vv", ""),
    ("mask move.vv --json", ""),
    ("fmt -", "void  step(mesh& S) { }\n"),
    ("render square.off -o - --format png --size 8x8", ""),
    ("render square.off -o - --format svg", ""),
    ("completions bash", ""),
    ("run --help", ""),
    ("--version", ""),
];

/// All that is written into files; `PLACE/` is where.
const TO_FILES: [&str; 28] = [
    "run triangle.vv -o PLACE/new.obj",
    "run triangle.vv -o PLACE/new.off",
    "run triangle.vv -o PLACE/new.ply",
    "run triangle.vv -o PLACE/new.ply --format ply-text",
    "run triangle.vv -o PLACE/new.stl",
    "run triangle.vv -o PLACE/new.glb",
    "run triangle.vv -o PLACE/new.gltf",
    "run triangle.vv -o PLACE/new.png --size 8x8",
    "run triangle.vv -o PLACE/new.svg",
    "run triangle.vv -o PLACE/new.eps",
    "run triangle.vv -o PLACE/new.pdf",
    "run triangle.vv -o PLACE/old.obj",
    "run move.vv -i octahedron.obj --turntable 2 -o PLACE/new.gif --size 8x8",
    "run move.vv -i octahedron.obj --turntable 2 -o PLACE/new_{frame}.png --size 8x8",
    "run move.vv -i octahedron.obj --generations 0,1 -o PLACE/new.png --size 240x90",
    "run move.vv -i octahedron.obj --generations 0,1 -o PLACE/new.gif --size 8x8",
    "run move.vv -i octahedron.obj --generations 0,1 -o PLACE/new.svg",
    "run move.vv -i octahedron.obj -n 1 -o PLACE/new_{n}.obj",
    "run move.vv -i octahedron.obj -D far=1,2 -o PLACE/new.png --size 240x90",
    "run move.vv -i octahedron.obj -D far=1,2 -o PLACE/new_{far}.obj",
    "mesh convert octahedron.obj -o PLACE/new.off",
    "mesh convert octahedron.obj -o PLACE/new.pdf",
    "render octahedron.obj square.off -o PLACE/new.png --size 240x90",
    "render octahedron.obj --turntable 2 -o PLACE/new.gif --size 8x8",
    "render octahedron.obj -o PLACE/new.svg",
    "mask thirds.vv --valence 4 -o PLACE/new.svg",
    "mask thirds.vv --valence 4 -o PLACE/new.pdf",
    "man PLACE",
];

const THIRDS: (&str, &str) = (
    "thirds.vv",
    "void step(mesh& S) { synchronize S; forall v in S {\n  vec sum = vec(0, 0, 0); forall q in v sum += `q$pos;\n  \
     v$pos = `v$pos * 2 / 3 + sum / (3.0 * valence v); } }\n",
);

/// All that goes to stdout.
fn to_stdout() -> Vec<(String, &'static str)> {
    let meshes = Format::ALL.map(|format| (format!("run triangle.vv -o - --format {}", format.name()), ""));
    meshes.into_iter().chain(TO_STDOUT.map(|(arguments, stdin)| (arguments.to_owned(), stdin))).collect()
}

/// How a command ends whose stdout is this.
fn ends(folder: &Folder, arguments: &str, stdin: &str, stdout: Stdio) -> (Option<i32>, String) {
    let mut command = folder.command(arguments);
    command.stdin(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.stdout(stdout).spawn().unwrap();
    let _ = child.stdin.take().unwrap().write_all(stdin.as_bytes());
    let output = child.wait_with_output().unwrap();
    // What a program prints goes to stderr where stdout is taken.
    (output.status.code(), String::from_utf8_lossy(&output.stderr).replace("started\n", ""))
}

#[test]
fn a_closed_pipe_ends_every_output_quietly() {
    let folder = Folder::with(&[]);
    let before = folder.names();
    for (arguments, stdin) in to_stdout() {
        // A file beside it is not written either.
        let beside = if arguments.contains("-o -") { " -o beside.svg" } else { "" };
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let (code, said) = ends(&folder, &format!("{arguments}{beside}"), stdin, writer.into());
        assert_eq!((code, without_warnings(&said).as_str()), (Some(3), ""), "{arguments}");
        assert_eq!(folder.names(), before, "{arguments}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_behind_stdout_is_told_by_every_output() {
    let folder = Folder::with(&[]);
    let before = folder.names();
    for (arguments, stdin) in to_stdout() {
        let beside = if arguments.contains("-o -") { " -o beside.svg" } else { "" };
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let (code, said) = ends(&folder, &format!("{arguments}{beside}"), stdin, full.into());
        let said = without_warnings(&said);
        let expected = "error: <stdout>: no space is left on the device\n";
        assert_eq!((code, said.trim_start()), (Some(3), expected), "{arguments}");
        assert_eq!(folder.names(), before, "{arguments}");
    }
}

/// `vv mask` warns of a rule that has no masks, before it writes what it has.
fn without_warnings(said: &str) -> String {
    let lines = said.lines().filter(|line| !line.is_empty() && !line.starts_with("warning: "));
    lines.map(|line| format!("{line}\n")).collect()
}

#[test]
fn a_missing_folder_is_told_by_every_output() {
    let folder = Folder::with(&[THIRDS]);
    for arguments in TO_FILES {
        folder.check(&arguments.replace("PLACE", "none"), 3, "there is no directory `none`");
    }
}

/// No file may have a single byte, as on a disk without room.
#[cfg(unix)]
#[test]
fn a_file_that_cannot_grow_leaves_nothing_and_takes_nothing_away() {
    let folder = Folder::with(&[THIRDS, ("loose.vv", "void  step(mesh& S) { }\n")]);
    let place = tempfile::tempdir_in(folder.0.path()).unwrap();
    fs::write(place.path().join("old.obj"), "old").unwrap();
    let name = place.path().file_name().unwrap().to_str().unwrap();
    let before = folder.names();
    for arguments in TO_FILES.into_iter().chain(["fmt loose.vv"]) {
        let arguments = arguments.replace("PLACE", name);
        let vv = folder.command(&arguments);
        let mut command = Command::new("sh");
        command.args(["-c", "ulimit -f 0; exec \"$0\" \"$@\""]).arg(vv.get_program()).args(vv.get_args());
        let output = command.current_dir(folder.0.path()).env_remove("XDG_RUNTIME_DIR").output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{arguments}: {said}");
        assert!(said.contains("file too large"), "{arguments}: {said}");
        let left: Vec<_> = fs::read_dir(&place).unwrap().map(|file| file.unwrap().file_name()).collect();
        assert_eq!((left, folder.names()), (vec!["old.obj".into()], before.clone()), "{arguments}");
        assert_eq!(fs::read_to_string(place.path().join("old.obj")).unwrap(), "old");
        assert_eq!(folder.read("loose.vv"), "void  step(mesh& S) { }\n");
    }
}
