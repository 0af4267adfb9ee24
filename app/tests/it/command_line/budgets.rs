//! Time, vertices and calls run out.

use super::*;

#[test]
fn an_endless_loop_runs_out_of_time() {
    check("run endless.vv -i square.off --timeout 0.2 -o a.obj", 4, "endless.vv:1:\nstep 1 of 1 of `step`\n--timeout");
}

#[test]
fn each_step_has_the_whole_time() {
    let text = "void step(mesh& S) { for (int i = 0; i < 20000; i++) { } }\n";
    check_file("p.vv", text, "run p.vv -i square.off -n 40 --timeout 20 -o a.off", 0, "");
}

#[test]
fn vertices_without_end_run_out_of_room() {
    let text = "void step(mesh& S) { while (true) { vertex v; add v to S; } }\n";
    check_file(
        "p.vv",
        text,
        "run p.vv -i square.off --max-vertices 1000 -o a.obj",
        4,
        "p.vv:1:\n1000\nallow more with `--max-vertices N`",
    );
    check("run move.vv -i octahedron.obj --max-vertices 5", 4, "octahedron.obj: has 6 vertices, 5 are allowed");
}

#[test]
fn recursion_without_end_runs_out_of_calls() {
    let text = "int f(int i) { return f(i + 1); }\nvoid step(mesh& S) { print(f(0)); }\n";
    check_file("p.vv", text, "run p.vv -i square.off", 4, "p.vv:1:");
}
