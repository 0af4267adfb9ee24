//! Failed runs leave everything as it was.

use vv::engine::{FailureKind, Output, OutputClosed, Settings, run};
use vv::mesh::{Mesh, VertexSet};

use super::{OCTAHEDRON, compile};

fn state(mesh: &Mesh) -> impl PartialEq + std::fmt::Debug {
    let rings: Vec<_> = mesh.vertices().map(|v| mesh.ring(v).slots().to_vec()).collect();
    let positions: Vec<_> = mesh.positions().iter().map(|p| p.to_array().map(f64::to_bits)).collect();
    let set: Vec<_> = VertexSet::iter(&mesh.set).collect();
    (rings, positions, set, mesh.mesh_properties().to_vec(), format!("{:?}", mesh.vertex_properties()))
}

#[test]
fn a_failed_run_leaves_the_mesh_as_it_was() {
    let text = format!(
        "vertex {{ int n; }}; mesh {{ int m = 1; }};
         {OCTAHEDRON}
         void step(mesh& S) {{
           forall p in S {{ p$pos.x += 1; p$n = 5; vertex x; add x to S; erase any in p from p; remove p from S; }}
           S$m = 2;
           int zero = 0;
           print 1 / zero;
         }}"
    );
    let program = compile(&text);
    let settings = Settings::default();
    let start = program.start.unwrap();
    let mesh = run(&program, start, &Mesh::new(), 0, &settings, &mut Vec::new()).unwrap();
    let before = state(&mesh);
    let failure = run(&program, program.default_rule().unwrap(), &mesh, 1, &settings, &mut Vec::new()).unwrap_err();
    assert_eq!(failure.kind, FailureKind::Program);
    assert!(state(&mesh) == before);
}

#[test]
fn a_closed_output_ends_the_run() {
    struct Closed(u32);
    impl Output for Closed {
        fn print(&mut self, _line: &str) -> Result<(), OutputClosed> {
            self.0 += 1;
            if self.0 > 3 { Err(OutputClosed) } else { Ok(()) }
        }
    }
    let program = compile("void step(mesh& S) { while (true) print \"y\"; }");
    let rule = program.default_rule().unwrap();
    let failure = run(&program, rule, &Mesh::new(), 1, &Settings::default(), &mut Closed(0)).unwrap_err();
    assert_eq!(failure.kind, FailureKind::OutputClosed);
    assert_eq!(failure.diagnostic.message, "the output was closed");
}

#[test]
fn what_a_failing_run_prints_is_printed_once() {
    // It is repeated silently to find where the null came from.
    super::check_body(
        "print 1; vertex n = any in a; print n$pos;",
        "1
         error 2:37 `n$pos`: null has no position
         at 2:21 `any in a`: `any in a` is null here: v1 has no neighbours
         = ring of v1: empty
         about v1",
    );
}

#[test]
fn an_error_tells_how_the_vertices_it_names_were_before_the_step() {
    super::check(
        &format!(
            "{}void step(mesh& S) {{\n  forall p in S {{\n    vertex q = any in p;\n    erase q from p;\n    \
             vertex r = nextto q in p;\n    print(r$pos);\n  }}\n}}",
            super::SQUARE
        ),
        "error 13:11 `r$pos`: null has no position
         at 12:16 `nextto q in p`: `nextto q in p` is null here: v2 is not in the ring of v1
         = ring of v1: v3 v4 ∅
         = before the step, ring of v1: v2 v3 v4 ∅
         about v1 v2",
    );
}

#[test]
fn an_error_tells_which_vertices_are_new() {
    super::check(
        &format!("{}void step(mesh& S) {{ vertex x; make {{x}} nb_of x; }}", super::SQUARE),
        "error 8:38 `x`: v5 cannot be its own neighbour
         = to be made the ring of v5: v5
         = ring of v5: empty
         = v5 was made in this step
         about v5",
    );
}
