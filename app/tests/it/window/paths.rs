//! Typing a path, where the system offers no file dialog.

use super::*;
use app::session::{Dialog, Purpose};

fn ask(window: &mut Harness<'static, App>, purpose: Purpose, path: &str) {
    window.state_mut().session_mut().dialog = Some(Dialog::TypePath { purpose, path: path.to_owned(), then: None });
    window.run_steps(4);
}

fn typed<'w>(window: &'w Harness<'static, App>) -> &'w str {
    match &window.state().session().dialog {
        Some(Dialog::TypePath { path, .. }) => path,
        other => panic!("no path is asked for: {other:?}"),
    }
}

fn type_on(window: &mut Harness<'static, App>, text: &str) {
    // Where the keys go, as for one who types.
    window.event(egui::Event::Text(text.to_owned()));
    window.run_steps(2);
}

/// A folder with meshes in another one, and something else.
fn folder() -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("models")).unwrap();
    for mesh in ["torus.obj", "torus-quads.obj", "pawn.obj"] {
        std::fs::copy(
            format!("{}/../assets/meshes/{mesh}", env!("CARGO_MANIFEST_DIR")),
            folder.path().join("models").join(mesh),
        )
        .unwrap();
    }
    std::fs::write(folder.path().join("notes.txt"), "").unwrap();
    let path = format!("{}/", folder.path().display());
    (folder, path)
}

#[test]
fn a_mesh_is_opened_as_a_mesh_whatever_was_asked_for() {
    let (_folder, path) = folder();
    let mut window = octahedron();
    let text = window.state().session().document.program.text.clone();
    window.state_mut().session_mut().chosen(Purpose::OpenProgram, format!("{path}models/pawn.obj").into());
    let document = &window.state().session().document;
    assert_eq!(document.mesh, MeshSource::File(format!("{path}models/pawn.obj").into()));
    assert_eq!(document.program.text, text);
}

#[test]
fn what_is_in_the_folder_is_offered_and_tab_completes_it() {
    let (_folder, path) = folder();
    let mut window = octahedron();
    ask(&mut window, Purpose::OpenMesh, &path);
    assert!(window.query_by_label("notes.txt").is_none(), "that is no mesh");
    click(&mut window, "models/");
    assert_eq!(typed(&window), format!("{path}models/"));
    type_on(&mut window, "to");
    assert_eq!(typed(&window), format!("{path}models/to"));
    assert!(window.query_by_label("pawn.obj").is_none());
    window.key_press(Key::Tab);
    window.run_steps(2);
    assert_eq!(typed(&window), format!("{path}models/torus"));
    press(&mut window, Key::Enter);
    assert_eq!(typed(&window), format!("{path}models/torus"), "that is not all of a name");
    type_on(&mut window, ".");
    window.key_press(Key::Tab);
    window.run_steps(2);
    press(&mut window, Key::Enter);
    assert_eq!(window.state().session().document.mesh, MeshSource::File(format!("{path}models/torus.obj").into()));
}

#[test]
fn a_name_that_is_offered_is_typed_over() {
    let (_folder, path) = folder();
    let mut window = octahedron();
    ask(&mut window, Purpose::ExportMesh, &format!("{path}loop-2.obj"));
    type_on(&mut window, "mine");
    assert_eq!(typed(&window), format!("{path}mine"), "the name alone, and its ending is found");
    press(&mut window, Key::Enter);
    until(&mut window, "it is saved", |s| s.notice().is_some_and(|(_, text)| text.starts_with("saved ")));
    let saved = std::fs::read_to_string(format!("{path}mine.obj")).unwrap();
    assert_eq!(saved.lines().filter(|line| line.starts_with("v ")).count(), 6);
}

#[test]
fn a_text_without_a_file_is_saved_before_the_window_closes() {
    let (_folder, path) = folder();
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    let path = format!("{path}mine.vv");
    let then = Some(Box::new(Command::Quit));
    window.state_mut().session_mut().dialog =
        Some(Dialog::TypePath { purpose: Purpose::SaveProgram, path: path.clone(), then });
    window.run_steps(4);
    press(&mut window, Key::Enter);
    assert_eq!(std::fs::read_to_string(path).unwrap(), PROGRAM);
    assert!(window.state().session().wants_quit());
}
