//! The mask of the selected vertex: as a list, in the picture, and why there is none.

use app::command::Inspect;
use app::inspect::selection::Item;
use app::session::{MaskState, Purpose};
use vv::mesh::Vertex;

use super::inspecting::{known, on, seen, v};
use super::*;

const TETRAHEDRON: &str = "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
/// Half of it stays, the rest comes from the neighbours.
const HALVES: &str = "void step(mesh& S) {\n  synchronize S;\n  forall v in S {\n    vec sum = vec(0, 0, 0);\n    \
                      forall q in v sum += `q$pos;\n    v$pos = `v$pos / 2 + sum / (2.0 * valence v);\n  }\n}\n";

/// Its first step, with this vertex selected.
fn stepped(program: &str, selected: usize) -> (Harness<'static, App>, tempfile::TempDir) {
    let (mut window, folder) = on(TETRAHEDRON, program);
    press(&mut window, Key::Num1);
    known(&mut window);
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(v(selected)))));
    window.run_steps(2);
    (window, folder)
}

#[track_caller]
fn measured(window: &mut Harness<'static, App>) {
    until(window, "the mask is measured", |s| !matches!(s.mask(), MaskState::Measuring(_)));
    window.run_steps(2);
}

fn pointed(window: &Harness<'static, App>) -> Option<Vertex> {
    window.state().session().inspection.pointed_old
}

#[test]
fn the_mask_of_a_vertex_is_listed_with_fractions() {
    let (mut window, _folder) = stepped(HALVES, 3);
    assert!(window.query_by_label("1/2").is_none(), "nobody asked for it");
    press(&mut window, Key::M);
    measured(&mut window);
    window.get_by_label("v3 as a sum of vertices of generation\u{a0}0");
    window.get_by_label("1/2");
    window.get_by_label("1/6");
    for old in ["mask v1", "mask v2", "mask v3", "mask v4"] {
        window.get_by_label(old);
    }
    click(&mut window, "mask v4");
    assert_eq!(window.state().session().selected(), [Item::Vertex(v(4))]);
    measured(&mut window);
    window.get_by_label("v4 as a sum of vertices of generation\u{a0}0");
    click(&mut window, "Mask");
    assert!(window.query_by_label("1/2").is_none());
}

#[test]
fn list_and_picture_answer_each_other() {
    let (mut window, _folder) = stepped(HALVES, 3);
    press(&mut window, Key::F);
    known(&mut window);
    click(&mut window, "Mask");
    measured(&mut window);
    let before = window.render().unwrap();
    window.get_by_label("mask v4").hover();
    window.run_steps(3);
    assert_eq!(pointed(&window), Some(v(4)));
    let lit = window.render().unwrap();
    assert!(differ(&window, &before, &lit) > 50, "the picture answers");
    // Where v1 was before the step.
    let at = seen(&window, glam::DVec3::ONE);
    window.hover_at(at);
    window.run_steps(3);
    assert_eq!(pointed(&window), Some(v(1)));
    let corner = window.get_by_label("Viewport").rect().center_top() + egui::vec2(0.0, 12.0);
    window.hover_at(corner);
    window.run_steps(3);
    assert_eq!(pointed(&window), None);
}

#[test]
fn a_mask_is_saved_as_the_figure_that_the_command_line_draws() {
    let (mut window, folder) = stepped(HALVES, 3);
    let path = folder.path().join("mask.svg");
    window.state_mut().session_mut().chosen(Purpose::SaveMask, path.clone());
    assert!(!path.exists(), "no mask is shown");
    press(&mut window, Key::M);
    measured(&mut window);
    window.get_by_label("Save as figure…");
    window.state_mut().session_mut().chosen(Purpose::SaveMask, path.with_extension(""));
    let saved = std::fs::read_to_string(&path).unwrap();
    let words = |text: &str| saved.matches(&format!("\"{text}\"")).count();
    assert_eq!((words("1/2"), words("1/6")), (1, 3), "{saved}");
}

#[test]
fn where_there_is_no_mask_it_is_said_why() {
    let (mut window, _folder) = on(TETRAHEDRON, HALVES);
    window.state_mut().apply(Command::Inspect(Inspect::Mask));
    window.run_steps(2);
    window.get_by_label(
        "select one vertex: its mask tells of which old vertices the step made it, and with which weights",
    );
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(v(1)))));
    window.run_steps(2);
    window.get_by_label("no step made generation\u{a0}0: its vertices have no mask; step once");
}

#[test]
fn what_keeps_weights_from_being_a_mask_is_said() {
    let round = "void step(mesh& S) { forall v in S v$pos = normalize(v$pos); }\n";
    let (mut window, _folder) = stepped(round, 2);
    click(&mut window, "Mask");
    measured(&mut window);
    window.get_by_label("v2 is no sum of vertices of generation\u{a0}0");
    window.get_by_label_contains("v2 is not affine in the old positions");
    write(&mut window, "void step(mesh& S) { forall v in S v$pos *= 2; }\n");
    measured(&mut window);
    window.get_by_label("the weights of v2 sum to 2, not to 1");
    let greedy = "void step(mesh& S) { forall v in S { vertex q = any in v; v$pos = (v$pos + q$pos) / 2; } }\n";
    write(&mut window, greedy);
    measured(&mut window);
    window.get_by_label("around a vertex of valence 3 among triangles: the masks depend on the order of the vertices");
}

#[test]
fn measuring_a_step_that_takes_long_is_stopped() {
    // The step itself is done at once; from the third run on it never ends.
    let text = "void step(mesh& S) { forall v in S { if (v$pos.x > 1.5 || v$pos.x < -1.5) while (true) { } } }\n";
    let (mut window, _folder) = stepped(text, 2);
    click(&mut window, "Mask");
    until(
        &mut window,
        "it takes long",
        |s| matches!(s.mask(), MaskState::Measuring(since) if since > Duration::from_millis(400)),
    );
    window.run_steps(2);
    click(&mut window, "Stop measuring");
    assert!(matches!(window.state().session().mask(), MaskState::Off));
    // And the window goes on.
    click(&mut window, "Step");
    assert_eq!(window.state().session().shown_generation(), 2);
}
