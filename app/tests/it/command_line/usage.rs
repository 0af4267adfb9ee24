//! Command lines that are wrong.

use super::*;

#[test]
fn a_command_line_that_cannot_be_meant_so_says_why() {
    for (arguments, said) in [
        ("run", "PROGRAM"),
        ("run move.vv --nonsense", "--nonsense"),
        ("run move.vv -i octahedron.obj -n -1", "steps are counted: 0, 1, 2"),
        ("run move.vv -i octahedron.obj -n 1.5", "steps are counted: 0, 1, 2"),
        ("run move.vv -i octahedron.obj --timeout -1", "seconds are a number"),
        ("run move.vv -i octahedron.obj --seed -1", "a seed is a whole number"),
        ("run move.vv -i octahedron.obj --reference square.off --tolerance -1", "a tolerance is a number"),
        (
            "run move.vv octahedron.obj",
            "one program, and octahedron.obj is one file more\na mesh is given with `-i octahedron.obj`",
        ),
        (
            "run octahedron.obj -i move.vv",
            "octahedron.obj is a mesh, and a program is wanted\n`vv run PROGRAM -i MESH`",
        ),
        ("check octahedron.obj", "octahedron.obj is a mesh, and a program is wanted"),
        ("run move.vv -i octahedron.obj --timeout soon", "seconds are a number"),
        ("run move.vv -i octahedron.obj --size 3", "a size is width and height such as 1280x960"),
        ("run move.vv -i octahedron.obj --tolerance 1", "--reference"),
        ("run move.vv", "move.vv has no `start` that would make a mesh, so it needs one\n`-i MESH`"),
        ("run - -i -", "program and mesh cannot both be read from stdin"),
        ("run move.vv -i octahedron.obj -o -", "`-o -` does not say what to write\n--format"),
        ("run move.vv -i octahedron.obj -o x.stp", "`-o x.stp` has no extension that vv writes\n`.obj`"),
        ("run move.vv -i octahedron.obj -o x.obj -o x.obj", "`-o x.obj` is given twice"),
        (
            "run move.vv -i octahedron.obj --turntable 1 -o a.gif",
            "the number of pictures is a whole number from 2 to 3600",
        ),
        ("mesh info octahedron.obj --max-vertices 1e9", "vertices are counted: a whole number such as 1000000"),
        ("mask move.vv --valence 2", "a valence is a whole number from 3 to 64"),
        ("mask move.vv -i octahedron.obj --vertex 0", "the number of a vertex is a whole number from 1 to 4294967295"),
        ("run move.vv -i octahedron.obj -o x.obj -o ./x.obj", "`-o x.obj` and `-o ./x.obj` are the same file"),
        ("mesh convert octahedron.obj -o x.off -o ./x.off", "`-o x.off` and `-o ./x.off` are the same file"),
        ("mask move.vv -o x.svg -o ./x.svg", "`-o x.svg` and `-o ./x.svg` are the same file"),
        ("run move.vv -i octahedron.obj -o x_{n}.obj -o ./x_1.obj", "`-o ./x_1.obj` would be written more than once"),
        ("run move.vv -i octahedron.obj -o - --format obj --summary json", "both need stdout"),
        ("run move.vv -i octahedron.obj --rule stil", "no rule `stil`\n`shift`, `still` and `step`\n--rule still"),
        ("run triangle.vv -n 2", "triangle.vv has no rule to apply, only `start`\nleave out `-n`"),
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
        ("=1", "a definition is a name and a value"),
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

#[test]
fn shells_and_man_know_the_commands() {
    let folder = Folder::with(&[]);
    for shell in ["bash", "zsh", "fish"] {
        let text = folder.check(&format!("completions {shell}"), 0, "").stdout;
        assert!(text.contains("--diagnostic-format") || text.contains("diagnostic-format"), "{shell}");
    }
    folder.check("man .", 0, "");
    assert!(folder.read("vv-mesh-diff.1").contains("tolerance"));
    assert!(folder.read("vv.1").contains("Exit codes"));
    folder.check("man nowhere", 3, "there is no directory `nowhere`");
}

#[test]
fn commands_of_meshes_without_their_first_word() {
    for (arguments, command) in
        [("info octahedron.obj", "info"), ("convert octahedron.obj -o a.off", "convert"), ("diff a.obj b.obj", "diff")]
    {
        check(arguments, 2, &format!("nor a command\nthe command is `vv mesh {command}`"));
    }
}

#[test]
fn outputs_and_inputs_as_other_commands_take_them() {
    check("mesh convert octahedron.obj new.off", 2, "new.off is one file more\nto write it: `-o new.off`");
    check("render -i octahedron.obj -o new.svg", 0, "");
}

#[test]
fn generations_that_no_output_has_a_place_for() {
    let said = "warning: `-o a.obj` holds generation 2 alone\nput `{n}` into its name to write each of them";
    check("run move.vv -i octahedron.obj --generations 0-2 -o a.obj", 0, said);
    check("run move.vv -i octahedron.obj --generations 2 -o a.obj", 0, "");
    check("run move.vv -i octahedron.obj --generations 0-2 -o a.obj -o a_{n}.obj", 0, "");
    check("run move.vv -i octahedron.obj --generations 0-2 -o a.obj -o a.svg", 0, "");
}
