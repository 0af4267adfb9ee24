//! Several inputs, generations and values of parameters in one command.

use super::*;

/// The first coordinate of the first vertex: 1 for the octahedron, moved by `along` in each step.
#[track_caller]
fn first_x(folder: &Folder, name: &str) -> f64 {
    let text = folder.read(name);
    vertices(&text)[0].split(' ').next().unwrap().parse().unwrap()
}

fn lines(text: &str) -> Vec<Value> {
    text.lines().map(json).collect()
}

#[test]
fn each_generation_has_a_file_of_its_own_beside_the_last_one() {
    let folder = Folder::with(&[]);
    folder.check("run move.vv -i octahedron.obj -n 2 -o g_{n}.obj -o p_{n:3}.off -o last.obj", 0, "");
    let made: Vec<_> = folder.names().into_iter().filter(|n| n.starts_with(['g', 'p']) || n == "last.obj").collect();
    assert_eq!(made, ["g_0.obj", "g_1.obj", "g_2.obj", "last.obj", "p_000.off", "p_001.off", "p_002.off"]);
    for (name, x) in [("g_0.obj", 1.0), ("g_1.obj", 2.0), ("g_2.obj", 3.0), ("last.obj", 3.0)] {
        assert_eq!(first_x(&folder, name), x, "{name}");
    }
}

#[test]
fn only_the_generations_asked_for_are_written() {
    let folder = Folder::with(&[]);
    folder.check("run move.vv -i octahedron.obj --generations 0,2-3 -o g_{n}.obj", 0, "");
    let made: Vec<_> = folder.names().into_iter().filter(|name| name.starts_with('g')).collect();
    assert_eq!(made, ["g_0.obj", "g_2.obj", "g_3.obj"]);
    let said = "there is no generation 3 after 2 steps\n-n 3";
    folder.check("run move.vv -i octahedron.obj -n 2 --generations 3 -o {n}.obj", 2, said);
    folder.check("run move.vv -i octahedron.obj --generations 3-1 -o {n}.obj", 2, "generations are counted");
}

#[test]
fn a_step_that_fails_leaves_no_generation_behind() {
    check("run failing.vv -i octahedron.obj -n 2 -o g_{n}.obj", 1, "failing.vv:5:");
}

#[test]
fn each_input_is_run_on_its_own() {
    let folder = Folder::with(&[]);
    let ended = folder.run("run move.vv -i octahedron.obj -i none.obj -i square.off -o new_{name}.obj");
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    assert!(ended.stderr.contains("none.obj: there is no such file"), "{}", ended.stderr);
    assert_eq!(vertices(&folder.read("new_octahedron.obj")).len(), 6);
    assert_eq!(vertices(&folder.read("new_square.obj")).len(), 4);
}

#[test]
fn a_sweep_runs_with_each_value() {
    let folder = Folder::with(&[]);
    folder.check("run move.vv -i octahedron.obj -D far=0:1:3 -D times=1,4 -o {far}x{times:2}.obj", 0, "");
    for (name, x) in [("0x01.obj", 1.0), ("0.5x01.obj", 1.5), ("1x04.obj", 5.0), ("0.5x04.obj", 3.0)] {
        assert_eq!(first_x(&folder, name), x, "{name}");
    }
    assert_eq!(folder.names().iter().filter(|name| name.contains('x') && name.starts_with(['0', '1'])).count(), 6);
}

#[test]
fn sweeps_that_cannot_be_meant_are_refused_before_anything_is_run() {
    let refused = |arguments: &str, said: &str| {
        check(&format!("run move.vv -i octahedron.obj {arguments}"), 2, said);
    };
    refused("-D far=0:1:1 -o {far}.obj", "a sweep is `from:to:count`");
    refused("-D times=0:1:3 -o {times}.obj", "`-D times=0.5`: the parameter `times` is a whole number");
    refused("-D far=0:1:1000 -D times=1,2 -o {far}{times}.obj", "these are more than 1000 runs");
    refused("-D far=0:1:3 -o a.obj", "`-o a.obj` would be written more than once\nput `{far}` into its name");
    refused("-i octahedron.obj -o {name}.obj", "would be written more than once");
    refused("-o {fra}.obj", "nothing is called `fra`\nthere are `n` and `name`");
    refused("-D far=1 -o {fa}.obj", "did you mean `{far}`?");
    refused("-o {n.obj", "a `{` has no partner");
    refused("-D far=0:1:3 --reference octahedron.obj", "`--reference` compares one result");
    refused("-n 99999999 -o {n}.obj", "these would be more than 100000 files");
}

#[test]
fn the_summary_has_a_line_for_each_run_and_generation() {
    let folder = Folder::with(&[]);
    let arguments = "run move.vv -i octahedron.obj -i square.off -D far=1,2 -n 1 -o {name}{far}_{n}.obj --summary json";
    let told = lines(&folder.check(arguments, 0, "").stdout);
    let tell = |line: &Value| {
        format!("{} {} {} {}", line["input"], line["parameters"]["far"], line["generation"], line["vertices"])
    };
    let first: Vec<String> = told.iter().map(tell).collect();
    assert_eq!(first.len(), 8);
    assert_eq!(first[..3], ["\"octahedron.obj\" 1.0 0 6", "\"octahedron.obj\" 1.0 1 6", "\"octahedron.obj\" 2.0 0 6"]);
    assert_eq!(first[7], "\"square.off\" 2.0 1 4");
}

#[test]
fn braces_in_names_are_doubled() {
    let folder = Folder::with(&[]);
    folder.check("run triangle.vv -o a{{n}}.obj", 0, "");
    assert!(folder.names().contains(&"a{n}.obj".to_owned()));
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_ends_all_runs() {
    let folder = Folder::with(&[]);
    let before = folder.names();
    let mut command = folder.command("run move.vv -i octahedron.obj -D far=0:1:9 --summary json -o {far}.obj");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stderr).as_ref()), (Some(3), ""));
    assert_eq!(folder.names(), before);
}
