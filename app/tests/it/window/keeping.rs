//! What is remembered: settings, recent files, unsaved text, projects.

use super::*;
use app::command::ThemeChoice;
use app::session::{Dialog, Purpose};
use app::store::Store;
use std::sync::Arc;

/// The window with what is remembered in a folder.
fn open_with(folder: &Path) -> Harness<'static, App> {
    let store = Store::open(folder).unwrap();
    let mut window = Harness::builder()
        .with_size(egui::vec2(1000.0, 700.0))
        .wgpu()
        .build_eframe(|cc| App::with_store(cc, None, None, Some(store)).unwrap());
    window.step();
    if matches!(window.state().session().dialog, Some(Dialog::Gallery { .. })) {
        window.state_mut().apply(Command::CloseDialog);
        window.step();
    }
    window
}

#[track_caller]
fn wait_for(what: &str, mut reached: impl FnMut() -> bool) {
    let began = Instant::now();
    while !reached() {
        assert!(began.elapsed() < Duration::from_secs(30), "waited in vain until {what}");
        std::thread::sleep(Duration::from_millis(3));
    }
}

fn recoveries(folder: &Path) -> Vec<std::path::PathBuf> {
    let files = std::fs::read_dir(folder.join("recovery")).unwrap().map(|f| f.unwrap().path());
    files.filter(|p| p.extension().is_some_and(|e| e == "json")).collect()
}

#[test]
fn theme_panels_and_files_are_remembered() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.vv");
    std::fs::write(&path, PROGRAM).unwrap();
    let mut window = open_with(folder.path());
    window.state_mut().apply(Command::SetTheme(ThemeChoice::Light));
    window.state_mut().apply(Command::Toggle(app::command::Panel::Messages));
    window.state_mut().apply(Command::Open(path.clone()));
    window.step();
    drop(window);
    let mut window = open_with(folder.path());
    let session = window.state().session();
    assert_eq!((session.theme, session.panels.messages), (ThemeChoice::Light, false));
    assert_eq!(session.recent(), [path]);
    window.get_by_label("File").click();
    window.run_steps(4);
    window.get_by_label_contains("Open recent").hover();
    window.run_steps(12);
    click(&mut window, "mine.vv");
    assert_eq!(&*window.state().session().document.program.text, PROGRAM);
}

#[test]
fn after_a_crash_unsaved_text_is_brought_back() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open_with(folder.path());
    settle(&mut window);
    write(&mut window, "// typed and never saved\n");
    wait_for("the text is kept", || {
        window.step();
        recoveries(folder.path()).len() == 1
    });
    // What a crash leaves is the file without its lock.
    let kept = &recoveries(folder.path())[0];
    std::fs::copy(kept, folder.path().join("recovery/1-1.json")).unwrap();
    drop(window);
    let mut window = open_with(folder.path());
    assert!(matches!(&window.state().session().dialog, Some(Dialog::Recover { name }) if name == "loop.vv"));
    window.run_steps(2);
    // The choice that stands out is that of Enter.
    window.get_by_label("Bring back");
    press(&mut window, Key::Enter);
    let session = window.state().session();
    assert_eq!(&*session.document.program.text, "// typed and never saved\n");
    assert!(session.document.program.is_modified());
    assert!(!folder.path().join("recovery/1-1.json").exists());
}

#[test]
fn a_window_that_is_closed_leaves_nothing_to_bring_back() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open_with(folder.path());
    settle(&mut window);
    write(&mut window, "// typed\n");
    wait_for("the text is kept", || {
        window.step();
        recoveries(folder.path()).len() == 1
    });
    window.state_mut().apply(Command::Quit);
    window.run_steps(2);
    click(&mut window, "Don't save");
    window.step();
    drop(window);
    assert!(recoveries(folder.path()).is_empty());
}

#[test]
fn a_project_holds_program_mesh_parameters_and_view() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("all.vvp");
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    window.state_mut().apply(Command::SetParam("w".to_owned(), vv::mesh::Value::Double(0.25)));
    window.state_mut().apply(Command::ChooseRule("shrink".to_owned()));
    window.state_mut().apply(Command::Step);
    window.state_mut().apply(Command::Smooth);
    settle(&mut window);
    window.state_mut().session_mut().chosen(Purpose::SaveProject, path.clone());
    let document = window.state().session().document.clone();
    let mut session = Session::new(None, None, None, Arc::new(|| {})).unwrap();
    session.apply(Command::Open(path));
    wait_for("it is computed", || {
        session.poll();
        !session.is_busy()
    });
    let opened = &session.document;
    assert_eq!((&opened.mesh, &opened.params, opened.generation), (&document.mesh, &document.params, 1));
    assert_eq!((opened.style, opened.camera), (document.style, document.camera));
    assert_eq!(session.frame().unwrap().mesh.positions()[0].length(), 0.25);
}

#[test]
fn after_a_crash_mesh_parameters_generation_and_view_are_brought_back_too() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open_with(folder.path());
    settle(&mut window);
    assert!(recoveries(folder.path()).is_empty(), "nothing was done yet");
    window.state_mut().apply(Command::OpenExample("mountain.vv"));
    window.state_mut().apply(Command::GoTo(1));
    window.state_mut().apply(Command::SetParam("height".to_owned(), vv::mesh::Value::Double(0.25)));
    window.state_mut().apply(Command::Smooth);
    settle(&mut window);
    let middle = window.get_by_label("Viewport").rect().center();
    window.drag_at(middle);
    window.step();
    window.hover_at(middle + egui::vec2(60.0, 20.0));
    window.step();
    window.drop_at(middle + egui::vec2(60.0, 20.0));
    settle(&mut window);
    let document = window.state().session().document.clone();
    let orphan = folder.path().join("recovery/1-1.json");
    wait_for("the view is kept", || {
        window.step();
        let Some(kept) = recoveries(folder.path()).into_iter().next() else { return false };
        std::fs::copy(kept, &orphan).unwrap();
        let project = app::project::Project::from_json(&std::fs::read(&orphan).unwrap(), None).unwrap();
        std::fs::remove_file(&orphan).unwrap();
        project.into_document() == document
    });
    // What the user goes back to is nothing to bring back once it is closed.
    window.state_mut().apply(Command::Quit);
    window.step();
    drop(window);
    assert!(recoveries(folder.path()).is_empty());
}

#[test]
fn what_a_project_does_not_hold_yet_is_marked_and_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("all.vvp");
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    window.state_mut().session_mut().chosen(Purpose::SaveProject, path.clone());
    let is_unsaved = |window: &Harness<'static, App>| window.state().session().is_unsaved();
    assert!(!is_unsaved(&window), "the text is in the project");
    window.state_mut().apply(Command::Step);
    assert!(!is_unsaved(&window), "to look is no work");
    window.state_mut().apply(Command::SetParam("w".to_owned(), vv::mesh::Value::Double(0.25)));
    assert!(is_unsaved(&window));
    window.state_mut().apply(Command::Undo);
    assert!(!is_unsaved(&window));
    window.state_mut().apply(Command::Smooth);
    window.state_mut().apply(Command::NewProgram);
    window.run_steps(6);
    window.get_by_label_contains("Save changes to all.vvp?");
    window.get_by_role_and_label(Role::Button, "Save").click();
    window.run_steps(2);
    assert_eq!(window.state().session().document.program.name, "untitled.vv");
    window.state_mut().apply(Command::Open(path));
    settle(&mut window);
    assert!(window.state().session().document.style.smooth && !is_unsaved(&window));
}

#[test]
fn looking_around_is_nothing_to_bring_back() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open_with(folder.path());
    settle(&mut window);
    window.state_mut().apply(Command::UseMesh(MeshSource::BuiltIn("octahedron.obj".to_owned())));
    window.state_mut().apply(Command::Step);
    window.state_mut().apply(Command::Smooth);
    window.state_mut().apply(Command::View(app::command::ViewAction::Turn(app::command::Toward::Left)));
    settle(&mut window);
    let until_kept = Instant::now() + Duration::from_millis(700);
    wait_for("something would have been kept", || {
        window.step();
        Instant::now() > until_kept
    });
    assert!(recoveries(folder.path()).is_empty());
    // Values are found by trying, and are in no file.
    window.state_mut().apply(Command::SaveParams("mine".to_owned()));
    wait_for("the values are kept", || {
        window.step();
        recoveries(folder.path()).len() == 1
    });
}

#[test]
fn a_program_whose_file_is_gone_says_so_until_it_is_saved_anew() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.vv");
    std::fs::write(&path, PROGRAM).unwrap();
    let mut window = open(None, Some(&path));
    let can_save =
        |window: &Harness<'static, App>| !window.get_by_label("Save the program").accesskit_node().is_disabled();
    assert!(window.query_by_label("file gone").is_none() && !can_save(&window));
    std::fs::rename(&path, folder.path().join("other.vv")).unwrap();
    until(&mut window, "it is told", |s| s.program_is_gone());
    window.run_steps(2);
    assert!(window.query_by_label("file gone").is_some() && can_save(&window));
    click(&mut window, "Save the program");
    window.run_steps(2);
    assert!(window.query_by_label("file gone").is_none() && path.exists());
}
