//! Typing a path, where the system offers no file dialog; and files that are dropped.

use std::sync::Arc;

use super::*;
use app::session::{Dialog, Purpose};

fn ask(window: &mut Harness<'static, App>, purpose: Purpose, path: &str) {
    window.state_mut().session_mut().dialog = Some(Dialog::path(purpose, path, None));
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
fn tab_stays_and_says_so_where_there_is_nothing_to_complete_and_goes_on_when_pressed_again() {
    let (_folder, path) = folder();
    let mut window = octahedron();
    let tab = |window: &mut Harness<'static, App>| {
        window.key_press(Key::Tab);
        window.run_steps(3);
    };
    for (name, why) in [
        ("models/x", "Nothing here begins so"),
        ("models/pawn.obj", "That is all of the name"),
        ("models/torus", "Several names begin so"),
    ] {
        ask(&mut window, Purpose::OpenMesh, &format!("{path}{name}"));
        type_on(&mut window, name.rsplit('/').next().unwrap());
        tab(&mut window);
        says(&window, why);
        type_on(&mut window, "y");
        assert_eq!(typed(&window), format!("{path}{name}y"), "the field has the keys");
        assert!(window.query_by_label_contains(why).is_none());
        window.key_press(Key::Backspace);
        tab(&mut window);
        tab(&mut window);
        type_on(&mut window, "z");
        assert_eq!(typed(&window), format!("{path}{name}"), "they went on");
        window.state_mut().apply(Command::CloseDialog);
        window.run_steps(3);
    }
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
fn what_a_mesh_file_has_no_place_for_is_among_the_problems() {
    let (_folder, path) = folder();
    let mut window = octahedron();
    write(&mut window, "vertex { int age; };\nvoid step(mesh& S) { forall v in S v$age += 1; }\n");
    press_outside(&mut window, Key::Num1);
    let save = |window: &mut Harness<'static, App>, name: &str, said: &str| {
        window.state_mut().session_mut().chosen(Purpose::ExportMesh, format!("{path}{name}").into());
        until(window, said, |s| s.notice().is_some_and(|(_, text)| text.ends_with(said)));
        let (severity, _) = window.state().session().notice().unwrap();
        assert_eq!(severity == vv::diagnostic::Severity::Warning, said != name);
        window.run_steps(2);
    };
    save(&mut window, "a.stl", "a.stl, but not all of it");
    window.get_by_label_contains("`age` of the vertices is not written: `.stl` files have no place for it");
    // Until it was saved whole.
    save(&mut window, "a.ply", "a.ply");
    assert!(window.query_by_label_contains("is not written").is_none());
}

#[test]
fn a_text_without_a_file_is_saved_before_the_window_closes() {
    let (_folder, path) = folder();
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    let path = format!("{path}mine.vv");
    let then = Some(Box::new(Command::Quit));
    window.state_mut().session_mut().dialog = Some(Dialog::path(Purpose::SaveProgram, path.clone(), then));
    window.run_steps(4);
    press(&mut window, Key::Enter);
    assert_eq!(std::fs::read_to_string(path).unwrap(), PROGRAM);
    assert!(window.state().session().wants_quit());
}

/// What the dialog says of the path.
#[track_caller]
fn says(window: &Harness<'static, App>, part: &str) {
    assert!(window.query_by_label_contains(part).is_some(), "{:?}", window.state().session().dialog);
}

#[test]
fn a_path_that_cannot_be_written_stays_with_the_reason_beside_it() {
    let (_folder, path) = folder();
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    let tries = [
        (Purpose::SaveProgram, "no/mine.vv", "there is no directory"),
        (Purpose::ExportMesh, "no/mine.obj", "there is no directory"),
        (Purpose::ExportMesh, "mine.xyz", "the name of a mesh ends in"),
        (Purpose::SavePicture, "no/mine.png", "there is no directory"),
        (Purpose::SavePicture, "mine.bmp", "the name of a picture ends in"),
        (Purpose::SaveStyle, "no/mine.json", "there is no directory"),
        (Purpose::SaveProject, "no/mine.vvp", "there is no directory"),
        (Purpose::OpenStyle, "notes.txt", "the text ends before"),
    ];
    for (purpose, name, why) in tries {
        let asked = format!("{path}{name}");
        ask(&mut window, purpose, &asked);
        press(&mut window, Key::Enter);
        assert_eq!(typed(&window), asked);
        says(&window, why);
        // The field has the keys, and what is typed on makes a path of its own.
        type_on(&mut window, "x");
        assert_ne!(typed(&window), asked);
        assert!(window.query_by_label_contains(why).is_none(), "{why} is of another path");
        window.state_mut().apply(Command::CloseDialog);
        window.run_steps(2);
    }
}

#[test]
fn a_path_whose_file_cannot_be_finished_is_asked_for_again() {
    let mut window = octahedron();
    if !Path::new("/dev/full").exists() {
        return; // a device of Linux
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("full.obj");
    #[cfg(unix)]
    std::os::unix::fs::symlink("/dev/full", &path).unwrap();
    ask(&mut window, Purpose::ExportMesh, &path.display().to_string());
    press(&mut window, Key::Enter);
    press(&mut window, Key::Enter);
    until(&mut window, "it has failed", |s| s.dialog.is_some());
    window.run_steps(3);
    assert_eq!(typed(&window), path.display().to_string());
    says(&window, "no space is left on the device");
}

#[test]
fn a_file_that_is_there_is_replaced_only_when_asked_for_twice_or_by_its_button() {
    let (_folder, path) = folder();
    let file = format!("{path}mine.vv");
    let content = || std::fs::read_to_string(&file).unwrap();
    std::fs::write(&file, "// old").unwrap();
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    ask(&mut window, Purpose::SaveProgram, &file);
    says(&window, "mine.vv exists already.");
    press(&mut window, Key::Enter);
    assert_eq!(content(), "// old");
    says(&window, "Press Enter again to replace it.");
    press(&mut window, Key::Enter);
    assert_eq!((content().as_str(), &window.state().session().dialog), (PROGRAM, &None));
    let other = format!("{path}other.vv");
    std::fs::write(&other, "// old").unwrap();
    ask(&mut window, Purpose::SaveProgram, &other);
    click(&mut window, "Replace");
    assert_eq!(std::fs::read_to_string(other).unwrap(), PROGRAM);
}

/// A file as the system hands it over.
#[derive(Debug)]
struct Dropped(std::path::PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

#[test]
fn files_that_are_dropped_are_opened_together_and_what_is_none_of_vv_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let [program, mesh, other] = ["mine.vv", "a b.off", "c.txt"].map(|name| folder.path().join(name));
    std::fs::write(&program, PROGRAM).unwrap();
    std::fs::write(&mesh, "OFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2\n").unwrap();
    std::fs::write(&other, "").unwrap();
    let mut window = octahedron();
    let mut drop = |files: &[&Path]| {
        let dropped = files.iter().map(|path| Arc::new(Dropped(path.to_path_buf())) as egui::DroppedFileHandle);
        window.input_mut().dropped_files = dropped.collect();
        settle(&mut window);
        let session = window.state().session();
        let said = session.notice().map(|(_, text)| text.to_owned());
        (session.document.program.name.clone(), faces(&window), said)
    };
    assert_eq!(drop(&[&program, &mesh]), ("mine.vv".to_owned(), 1, None));
    let (name, faces, said) = drop(&[&other]);
    assert_eq!((name.as_str(), faces), ("mine.vv", 1));
    assert!(said.is_some_and(|said| said.contains("c.txt: neither a program")));
}
