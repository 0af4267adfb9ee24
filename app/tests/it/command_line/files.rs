//! Files that are read.

use super::*;

#[test]
fn a_file_that_cannot_be_read_is_named() {
    for arguments in ["run none.vv", "check none.vv", "run move.vv -i none.obj", "mesh info none.obj"] {
        check(arguments, 3, "there is no such file or directory\nnone.");
    }
    check("run move.vv -i octahedron.obj --reference none.obj", 3, "none.obj: there is no such file");
    check("check .", 3, ".: is a directory, not a file");
    check(
        "mesh info move.vv",
        3,
        "move.vv: `.vv` is no mesh format that vv reads\n`.obj`, `.off`, `.ply`, `.stl`, `.glb` and `.gltf`",
    );
}

#[test]
fn a_program_that_is_no_text_is_refused() {
    let folder = Folder::with(&[]);
    fs::write(folder.path("latin.vv"), b"// na\xEFve\n").unwrap();
    folder.check("check latin.vv", 3, "the text is not in UTF-8\nlatin.vv:1:\n0xEF");
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
        ("m.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "m.obj:3:"),
        ("m.obj", "v 0 0 0\nv 1 0", "m.obj:2:"),
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

#[test]
fn an_error_in_a_mesh_quotes_its_line() {
    let folder = Folder::with(&[("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")]);
    folder.check("mesh info m.off", 3, "m.off:6:7\n3 0 1 7");
    folder.check("mesh info m.off --diagnostic-format short", 3, "m.off:6:7: error: ");
    let object = json(&folder.check("mesh info m.off --diagnostic-format json", 3, "m.off").stderr);
    assert_eq!((&object["file"], &object["line"]), (&"m.off".into(), &6.into()));
    let ended = folder.run_with_stdin("mesh info -", &folder.read("m.off"));
    assert!(ended.code == Some(3) && ended.stderr.contains("<stdin>:6:7: "), "{}", ended.stderr);
}

/// Of lines that end as on old machines others than those of a quotation have the numbers: none is better than a wrong one.
#[test]
fn only_the_line_that_is_meant_is_quoted() {
    let mark = check_file("bom.obj", "\u{feff}v 0 x 0\n", "mesh info bom.obj", 3, "bom.obj:1:5\n │ v 0 x 0\n");
    assert!(!mark.stderr.contains('\u{feff}'), "{}", mark.stderr);
    let text = "# a\rv 0 0 0\nv 1 x 0\nv 0 1 0\n";
    let old = check_file("old.obj", text, "mesh info old.obj", 3, "error: old.obj:3:5: `x` is not a number");
    assert!(!old.stderr.contains("v 0 1 0"), "{}", old.stderr);
}

#[test]
fn a_mesh_without_extension_is_known_by_its_first_word() {
    check_file("square", SQUARE, "mesh info square", 0, "");
    check_file("octahedron", OCTAHEDRON, "mesh info octahedron", 0, "");
}
