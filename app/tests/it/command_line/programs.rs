//! Programs run and checked.

use std::fs;

use super::*;

#[test]
fn a_rule_that_is_not_for_the_faces_it_meets_is_warned_of_once_and_named_where_it_fails() {
    let house = "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n4 0 1 2 3\n3 1 4 2\n";
    let folder = Folder::with(&[("house.off", house)]);
    let assets = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets");
    let says = |kind: &str, rest: &str| format!("the program is for {kind}, and {rest}");
    let one = says("triangle meshes", "1 of the 2 faces is none");
    for program in ["loop", "loop-creases", "butterfly", "delaunay", "koch", "sierpinski", "paper-polyhedral"] {
        let warned = folder.check(
            &format!("run {assets}/programs/{program}.vv -i house.off -n 2"),
            0,
            &format!("warning: {one}\nthis was in step 1 of 2 of `\n`triangulate(S)` of edits.vv makes triangles"),
        );
        assert_eq!(warned.stderr.matches("is for").count(), 1, "{}", warned.stderr);
        folder.check(&format!("run {assets}/programs/{program}.vv -i square.off -o a.ply"), 0, "");
    }
    for (program, mesh, rest) in [
        ("sqrt3", "torus-quads", says("triangle meshes", "72 of the 72 faces are none: v73 is not in the ring of v7")),
        ("paper-sqrt3", "torus-quads", says("closed triangle meshes", "72 of the 72 faces are none: v")),
        ("paper-loop", "cube-open", says("closed triangle meshes", "the mesh is open: null has no position")),
    ] {
        folder.check(&format!("run {assets}/programs/{program}.vv -i {assets}/meshes/{mesh}.obj"), 1, &rest);
    }
    let summary = folder.check(&format!("run {assets}/programs/loop.vv -i house.off --summary json"), 0, &one).stdout;
    assert_eq!(json(&summary)["warnings"][0], one);
    // What a rule says of itself comes before what its program says.
    let limit = format!("run {assets}/programs/limit.vv -i house.off --rule");
    folder.check(
        &format!("{limit} loop_limit"),
        0,
        "`loop_limit` is for triangle meshes, and 1 of the 2 faces is none",
    );
    let quads = "`catmull_clark_limit` is for quad meshes, and 1 of the 2 faces is none\ncatmull-clark.vv makes quads";
    folder.check(&format!("{limit} catmull_clark_limit"), 0, quads);
    // It is none of a program's business that says nothing.
    fs::write(folder.path("still.vv"), "// Of meshes.\nvoid step(mesh& S) { }\n").unwrap();
    folder.check("run still.vv -i house.off", 0, "note: nothing is printed and nothing written\n`-o FILE`");
    folder.check("run still.vv -i house.off -o out.off", 0, "");
}

#[test]
fn a_program_comes_from_stdin_while_the_result_goes_to_stdout() {
    let folder = Folder::with(&[]);
    let ended = folder.run_with_stdin("run - -i octahedron.obj -o - --format obj", MOVE);
    assert_eq!((ended.code, vertices(&ended.stdout)[..1].to_vec()), (Some(0), vec!["2 0 0"]), "{}", ended.stderr);
}

#[test]
fn a_file_that_is_included_by_nearly_the_name_of_one_that_comes_with_vv() {
    for near in ["Loop.vv", "loop", "lib/LOOP.vv"] {
        let said = format!("there is no file `{near}`, but `loop.vv` comes with vv");
        check_file("p.vv", &format!("#include \"{near}\"\n"), "check p.vv", 1, &said);
    }
    let said = "there is no file `none.vv`, and vv ships with no program of this name";
    check_file("p.vv", "#include \"none.vv\"\n", "check p.vv", 1, said);
}

#[test]
fn what_a_file_says_of_vertices_is_inherited_where_the_program_knows_nothing_of_it() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n\
               property double sharpness\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
               0 0 0 255 0 0 255 1\n2 0 0 0 255 0 255 1\n0 2 0 0 0 255 255 1\n3 0 1 2\n";
    let folder = Folder::with(&[("c.ply", ply)]);
    let assets = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/programs");
    let made = |program: &str| {
        let said = folder.check(&format!("run {program} -i c.ply -o - --format ply-text"), 0, "").stdout;
        said.split_once("end_header\n").unwrap().1.to_owned()
    };
    let loop_ = made(&format!("{assets}/loop.vv"));
    let rest: Vec<_> = loop_.lines().take(6).map(|line| line.splitn(4, ' ').last().unwrap()).collect();
    let expected =
        ["255 0 0 255 1", "0 255 0 255 1", "0 0 255 255 1", "128 128 0 255 0", "128 0 128 255 0", "0 128 128 255 0"];
    assert_eq!(rest, expected, "there is no sharpness where there was none");
    assert!(made(&format!("{assets}/doo-sabin.vv")).contains("85 85 85 255 0\n"), "the mean of all corners");
    // What it knows of is its own business.
    let own = "#include \"loop.vv\"\nvertex { vec color = vec(1, 1, 1); };\nstep { loop(S); }\n";
    fs::write(folder.path("own.vv"), own).unwrap();
    assert_eq!(made("own.vv").matches("255 255 255 255 0\n").count(), 3);
}

#[test]
fn what_a_file_says_and_the_program_cannot_hold_is_warned_of() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               property double heat\nproperty double age\nelement face 1\n\
               property list uchar int vertex_indices\nelement mesh 1\nproperty double time\nend_header\n\
               0 0 0 1.5 2\n2 0 0 2 3\n0 2 0 3 4\n3 0 1 2\n0.5\n";
    let folder = Folder::with(&[("c.ply", ply)]);
    let own = "vertex { int heat; int age; };\nmesh { bool time; };\nstep { forall p in S p$heat += p$age; }\n";
    fs::write(folder.path("own.vv"), own).unwrap();
    let said = "warning: `heat` of vertices is `double` in the mesh file and `int` in the program, which cannot hold it\n\
                own.vv:1:14\n`double heat;` keeps what the mesh says\n`time` of the mesh is `double`";
    let run = folder.check("run own.vv -i c.ply --summary json", 0, said);
    assert_eq!(json(&run.stdout)["warnings"].as_array().unwrap().len(), 2, "2, 3 and 4 are whole: {}", run.stderr);
}

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
fn a_program_that_is_no_file_is_the_one_that_comes_with_vv() {
    let folder = Folder::with(&[]);
    let said = "note: there is no file sqrt3.vv, so this is the program of that name that comes with vv";
    folder.check("run sqrt3.vv -i octahedron.obj -n 2 -o a.obj", 0, said);
    assert_eq!(vertices(&folder.read("a.obj")).len(), 6 + 8 + 24);
    assert!(folder.check("mask sqrt3.vv --valence 4", 0, said).stdout.contains("at p"));
    for near in ["./sqrt3.vv", "Sqrt3.VV", "sqrt3"] {
        folder.check(&format!("check {near}"), 3, &format!("{near}: there is no such file\n`sqrt3.vv` comes with vv"));
    }
    folder.check("run sqrt4.vv -i octahedron.obj", 3, "sqrt4.vv: there is no such file");
    // One's own comes first, and what comes with vv includes what comes with vv.
    fs::write(folder.path("ptt.vv"), "broken").unwrap();
    folder.check("check sqrt3.vv", 0, said);
    fs::write(folder.path("sqrt3.vv"), "step { print \"own\"; }\n").unwrap();
    assert_eq!(folder.check("run sqrt3.vv -i octahedron.obj", 0, "").stdout, "own\n");
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

#[test]
fn both_engines_say_and_write_the_same() {
    let folder = Folder::with(&[("p.vv", "#include \"loop.vv\"\nvoid step(mesh& S) { loop(S); print(random()); }\n")]);
    let made = |engine: &str| {
        let ended = folder.check(&format!("run p.vv -i octahedron.obj -n 2 -o {engine}.obj --engine {engine}"), 0, "");
        (ended.stdout, fs::read_to_string(folder.path(&format!("{engine}.obj"))).unwrap())
    };
    assert_eq!(made("interpret"), made("native"));
    let failed = |engine: &str| {
        let ended = folder.check(&format!("run failing.vv -i square.off --engine {engine}"), 1, "null");
        (ended.stdout, ended.stderr)
    };
    assert_eq!(failed("interpret"), failed("native"));
}
