//! The menu of schemes.

use super::*;
use app::session::Dialog;

fn counts(window: &Harness<'static, App>) -> (String, u64, usize) {
    let session = window.state().session();
    (session.document.program.name.clone(), session.shown_generation(), faces(window))
}

#[test]
fn a_scheme_becomes_the_program_and_steps_the_mesh_shown() {
    let mut window = octahedron();
    choose(&mut window, "Subdivide", "Butterfly");
    assert_eq!(counts(&window), ("butterfly.vv".to_owned(), 1, 32));
    assert_eq!(window.state().session().document.mesh, MeshSource::BuiltIn("octahedron.obj".to_owned()));
    // The same once more is a step.
    window.key_press_modifiers(Modifiers::SHIFT, Key::B);
    settle(&mut window);
    assert_eq!(counts(&window), ("butterfly.vv".to_owned(), 2, 128));
    // Another one goes on from there.
    let before = window.state().session().frame().unwrap().mesh.positions().to_vec();
    window.key_press_modifiers(Modifiers::SHIFT, Key::D);
    settle(&mut window);
    assert_eq!(counts(&window), ("doo-sabin.vv".to_owned(), 1, 128 + 192 + 66));
    assert_eq!(window.state().session().document.mesh.name(), "octahedron.obj, butterfly.vv × 2");
    press(&mut window, Key::Home);
    assert_eq!(window.state().session().frame().unwrap().mesh.positions(), before, "generation 0 is what was shown");
    press(&mut window, Key::S);
    window.key_press_modifiers(Modifiers::SHIFT, Key::C);
    settle(&mut window);
    let name = window.state().session().document.mesh.name();
    assert_eq!(name, "octahedron.obj, butterfly.vv × 2, doo-sabin.vv × 1");
}

#[test]
fn what_a_mesh_came_from_is_saved_with_the_project_and_computed_again() {
    let mut window = octahedron();
    for scheme in ["loop.vv", "doo-sabin.vv"] {
        window.state_mut().apply(Command::Subdivide(scheme));
        settle(&mut window);
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("row.vvp");
    window.state_mut().session_mut().chosen(app::session::Purpose::SaveProject, path.clone());
    let before = window.state().session().frame().unwrap().mesh.positions().to_vec();
    let mut again = octahedron();
    again.state_mut().apply(Command::Open(path));
    settle(&mut again);
    assert_eq!(again.state().session().document.mesh.name(), "octahedron.obj, loop.vv × 1");
    assert_eq!(again.state().session().frame().unwrap().mesh.positions(), before);
}

#[test]
fn a_scheme_for_triangles_leaves_a_mesh_of_quads_in_order() {
    let mut window = open(None, None);
    window.state_mut().apply(Command::UseMesh(MeshSource::BuiltIn("cube.obj".to_owned())));
    window.state_mut().apply(Command::Rewind);
    settle(&mut window);
    window.state_mut().apply(Command::Subdivide("loop.vv"));
    settle(&mut window);
    let session = window.state().session();
    assert!(session.frame().unwrap().statistics.valid);
}

#[test]
fn a_program_that_is_not_saved_is_asked_about_first() {
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    window.state_mut().apply(Command::Subdivide("sqrt3.vv"));
    window.run_steps(3);
    assert!(matches!(window.state().session().dialog, Some(Dialog::Unsaved { .. })));
    click(&mut window, "Don't save");
    assert_eq!(counts(&window).0, "sqrt3.vv");
}
