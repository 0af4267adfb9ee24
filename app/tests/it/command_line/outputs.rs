//! Files that are written.

use super::*;

#[test]
fn each_extension_gets_its_format() {
    let folder = Folder::with(&[]);
    folder.check("run move.vv -i octahedron.obj -o a.obj -o b.off", 0, "");
    assert_eq!(vertices(&folder.read("a.obj"))[..2], ["2 0 0", "0 0 0"]);
    assert!(folder.read("b.off").starts_with("OFF\n6 8 "));
    folder.check("run move.vv -i octahedron.obj -o a.ply -o b.PLY -o c.stl --format ply-text", 0, "");
    assert!(
        folder.read("a.ply").starts_with("ply\nformat ascii 1.0\n") && folder.read("a.ply") == folder.read("b.PLY")
    );
    assert_eq!(fs::read(folder.path("c.stl")).unwrap().len(), 84 + 8 * 50);
    folder.check(
        "mesh convert c.stl -o d.glb -o e.gltf",
        0,
        "c.stl: 24 corners of triangles were welded to 6 vertices",
    );
    assert_eq!(&fs::read(folder.path("d.glb")).unwrap()[..4], b"glTF");
    for (name, said) in [("a.ply", ""), ("c.stl", "welded"), ("d.glb", ""), ("e.gltf", "")] {
        let info = json(&folder.check(&format!("mesh info {name} --json"), 0, said).stdout);
        assert_eq!(
            (&info["vertices"], &info["faces"], &info["closed"]),
            (&6.into(), &8.into(), &true.into()),
            "{name}"
        );
    }
}

#[test]
fn what_a_run_goes_by_is_not_written_over() {
    let folder = Folder::with(&[("look.json", "{}"), ("twice.vv", "#include \"move.vv\"\nvoid twice(mesh& S) { }\n")]);
    let (program, style) = (folder.read("move.vv"), folder.read("look.json"));
    folder.check("run move.vv -i octahedron.obj -o ./move.vv --format obj", 2, "move.vv is read here");
    folder.check("run twice.vv -i octahedron.obj -o move.vv --format obj", 2, "move.vv is read here");
    folder.check("render octahedron.obj --style look.json -o look.json --format svg", 2, "look.json is read here");
    assert_eq!((folder.read("move.vv"), folder.read("look.json")), (program, style));
    // A mesh may change in its place.
    folder.check("run move.vv -i octahedron.obj -o octahedron.obj", 0, "");
    assert_eq!(vertices(&folder.read("octahedron.obj"))[..2], ["2 0 0", "0 0 0"]);
}

#[test]
fn what_a_format_has_no_place_for_is_said_once_for_all_files() {
    let program = "vertex { int age; };\nvoid step(mesh& S) { forall v in S v$age += 1; }\n";
    let folder = Folder::with(&[("grow.vv", program)]);
    let said = "warning: `age` of the vertices is not written: `.stl` files have no place for it\n\
                help: `.ply` and `.glb` files keep it";
    let ended = folder.check("run grow.vv -i octahedron.obj -n 2 -o a_{n}.stl", 0, said);
    assert_eq!(ended.stderr.matches("not written").count(), 1, "{}", ended.stderr);
    folder.check("run grow.vv -i octahedron.obj -o a.ply", 0, "");
    folder.check("mesh convert a.ply -o b.off", 0, &said.replace("stl", "off"));
    folder.check("mesh convert a.ply -o b.glb", 0, "");
    // Those of the mesh are for the next steps of the program.
    let program = "mesh { int age; };\nvoid step(mesh& S) { S$age += 1; }\n";
    let said = "note: `age` of the mesh is not written: `.obj` files have no place for it\n\
                help: who goes on from the file begins without; `.ply` files keep it";
    let folder = Folder::with(&[("grow.vv", program)]);
    folder.check("run grow.vv -i octahedron.obj -o a.obj", 0, said);
    folder.check("run grow.vv -i octahedron.obj -o a.ply", 0, "");
}

/// As the shell's `<(…)` gives it.
#[test]
#[cfg(unix)]
fn a_program_that_can_be_read_only_once_is_read_once() {
    let folder = Folder::with(&[]);
    assert!(Command::new("mkfifo").arg(folder.path("pipe.vv")).status().unwrap().success());
    let (pipe, text) = (folder.path("pipe.vv"), folder.read("move.vv"));
    let writer = std::thread::spawn(move || fs::write(pipe, text).unwrap());
    folder.check("run pipe.vv -i octahedron.obj -o a.obj --timeout 5", 0, "");
    writer.join().unwrap();
    assert_eq!(vertices(&folder.read("a.obj"))[..2], ["2 0 0", "0 0 0"]);
}

#[test]
fn help_names_every_extension() {
    for arguments in ["run --help", "mesh convert --help", "--help"] {
        let text = check(arguments, 0, "").stdout;
        for extension in vv::io::Format::EXTENSIONS {
            assert!(text.contains(&format!(".{extension}")), "{arguments}: {extension}");
        }
    }
}

#[test]
fn values_go_from_a_file_through_a_program_that_declares_them_to_a_file() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n\
        property uchar age\nproperty uchar other\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0 1 7\n1 0 0 2 8\n0 1 0 3 9\n3 0 1 2\n";
    let program = "vertex { double age; };\nvoid step(mesh& S) {\n  forall p in S {\n    p$age = p$age / 2;\n  }\n}\n";
    let folder = Folder::with(&[("in.ply", ply), ("halve.vv", program)]);
    folder.check("run halve.vv -i in.ply -n 1 -o out.ply --format ply-text", 0, "");
    let expected = ply
        .replace("uchar age", "double age")
        .replace(" 1 7", " 0.5 7")
        .replace(" 2 8", " 1 8")
        .replace(" 3 9", " 1.5 9");
    assert_eq!(folder.read("out.ply"), expected);
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
fn every_format_goes_through_a_pipe_and_back() {
    let folder = Folder::with(&[]);
    let pipe = |arguments: &str, input: &[u8]| {
        let mut command = folder.command(arguments);
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(input).unwrap();
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{arguments}");
        output.stdout
    };
    for format in vv::io::Format::ALL.map(vv::io::Format::name) {
        let moved = pipe(&format!("run move.vv -i - -n 0 -o - --format {format}"), OCTAHEDRON.as_bytes());
        let back = pipe("run move.vv -i - -n 0 -o - --format obj", &moved);
        let back = String::from_utf8(back).unwrap();
        let (mut found, mut expected) = (vertices(&back), vertices(OCTAHEDRON));
        found.sort_unstable();
        expected.sort_unstable();
        assert_eq!(found, expected, "{format}");
    }
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
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = command.stdout(writer).output().unwrap();
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

/// A pipe without reader holds the run up when all outputs are written under other names.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_nothing_behind() {
    use std::os::unix::process::ExitStatusExt as _;
    let folder = Folder::with(&[("old.obj", "old")]);
    assert!(Command::new("mkfifo").arg(folder.path("pipe")).status().unwrap().success());
    let before = folder.names();
    let mut command = folder.command("run triangle.vv -o a.obj -o old.obj -o pipe --format obj");
    let mut child = command.stdout(Stdio::null()).spawn().unwrap();
    let began = std::time::Instant::now();
    while folder.names().iter().filter(|name| name.ends_with(".tmp")).count() < 2 {
        assert!(began.elapsed().as_secs() < 60, "no file was begun");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert!(Command::new("kill").args(["-s", "TERM", &child.id().to_string()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().signal(), Some(15));
    assert_eq!((folder.names(), folder.read("old.obj").as_str()), (before, "old"));
}

/// What work that takes a while writes to a terminal, as `script` of the system plays one.
#[cfg(target_os = "linux")]
fn on_a_terminal(folder: &Folder, arguments: &str) -> String {
    let vv = format!("{} {arguments}", env!("CARGO_BIN_EXE_vv"));
    let mut command = Command::new("script");
    command.args(["--quiet", "--command", &vv, "/dev/null"]).current_dir(folder.path(""));
    let output = command.env("TERM", "xterm").stdin(Stdio::null()).output().unwrap();
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
#[cfg(target_os = "linux")]
fn a_terminal_is_told_how_far_long_work_has_come_and_a_pipe_is_not() {
    let folder = Folder::with(&[]);
    let endless = "run endless.vv -i octahedron.obj --timeout 1.5";
    let shown = on_a_terminal(&folder, endless);
    assert!(shown.contains("step 1 of 1 of `step`: 6 vertices"), "{shown}");
    let said = folder.check(endless, 4, "the time allowed for a step is over").stderr;
    assert!(!said.contains("6 vertices"), "{said}");
    let film = "run move.vv -i octahedron.obj -D far=1,2,3 --turntable 40 -o {far}.gif --size 320x240";
    let shown = on_a_terminal(&folder, film);
    assert!(shown.contains("run 3 of 3: ") && shown.contains(" of 40"), "{shown}");
}
