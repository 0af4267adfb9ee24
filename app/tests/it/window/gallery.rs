//! The gallery, saving pictures, and preferences.

use super::*;
use app::annotate::Label;
use app::command::Inspect;
use app::gallery::EXHIBITS;
use app::inspect::selection::Item;
use app::preferences::{Background, PictureOptions, Preferences, Start};
use app::session::{Dialog, Purpose};
use app::store::Store;
use vv::mesh::Vertex;

fn open_gallery(window: &mut Harness<'static, App>) {
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::G);
    window.run_steps(6);
    assert!(matches!(window.state().session().dialog, Some(Dialog::Gallery { .. })));
}

#[test]
fn a_click_shows_a_program_on_a_mesh_that_suits_it() {
    let mut window = octahedron();
    open_gallery(&mut window);
    window.get_by_label("Catmull–Clark").click();
    window.run_steps(6);
    settle(&mut window);
    let session = window.state().session();
    assert!(session.dialog.is_none());
    assert_eq!(session.document.program.name, "catmull-clark.vv");
    assert_eq!(session.document.mesh, MeshSource::BuiltIn("elephant.obj".to_owned()));
    assert_eq!((session.shown_generation(), session.problems().iter().count()), (2, 0));
}

#[test]
fn programs_are_found_by_typing_and_opened_by_enter() {
    let mut window = octahedron();
    open_gallery(&mut window);
    window.get_by_label("Find a program").type_text("snowflake");
    window.run_steps(6);
    assert!(window.query_by_label("Catmull–Clark").is_none());
    press(&mut window, Key::Enter);
    let session = window.state().session();
    assert_eq!(session.document.program.name, "koch.vv");
    assert_eq!(session.document.mesh, MeshSource::Empty);
}

#[test]
fn arrows_walk_the_tiles() {
    let mut window = octahedron();
    open_gallery(&mut window);
    press(&mut window, Key::ArrowRight);
    press(&mut window, Key::ArrowRight);
    press(&mut window, Key::Enter);
    assert_eq!(window.state().session().document.program.name, EXHIBITS[2].program);
}

#[test]
fn a_mesh_from_a_file_is_kept_unless_another_is_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.obj");
    std::fs::write(&path, app::library::MESHES[0].text).unwrap();
    let mut window = open(Some(&path), None);
    for (keep, mesh) in [(true, MeshSource::File(path)), (false, MeshSource::BuiltIn("genus-2.obj".to_owned()))] {
        open_gallery(&mut window);
        if !keep {
            click(&mut window, "keep mine.obj");
        }
        window.get_by_label("√3").click();
        window.run_steps(6);
        settle(&mut window);
        assert_eq!(window.state().session().document.mesh, mesh);
    }
}

#[test]
fn unsaved_text_is_asked_about_before_a_program_is_shown() {
    let mut window = octahedron();
    write(&mut window, "// mine\n");
    window.key_press(Key::Escape);
    window.step();
    open_gallery(&mut window);
    window.get_by_label("√3").click();
    window.run_steps(6);
    click(&mut window, "Don't save");
    assert_eq!(window.state().session().document.program.name, "sqrt3.vv");
}

#[test]
fn every_exhibit_can_be_shown() {
    let mut window = octahedron();
    for exhibit in EXHIBITS {
        // Far generations take their time; what stands in the way does so at the first.
        let program = exhibit.program;
        window.state_mut().apply(Command::Exhibit { program, keep_mesh: true });
        window.state_mut().apply(Command::GoTo(exhibit.generation.min(1)));
        settle(&mut window);
        let session = window.state().session();
        assert_eq!(session.problems().iter().count(), 0, "{program}");
        assert!(session.frame().unwrap().statistics.faces > 0 || program == "curves.vv", "{program}");
    }
}

fn window_with(folder: &Path) -> Harness<'static, App> {
    let store = Store::open(folder).unwrap();
    let mut window = Harness::builder()
        .with_size(egui::vec2(1000.0, 700.0))
        .wgpu()
        .build_eframe(|cc| App::with_store(cc, None, None, Some(store)).unwrap());
    settle(&mut window);
    window
}

#[test]
fn what_opens_first_is_the_gallery_a_surface_or_what_was_open_last() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = window_with(folder.path());
    assert!(matches!(window.state().session().dialog, Some(Dialog::Gallery { .. })));
    window.state_mut().apply(Command::CloseDialog);
    let preferences = Preferences { start: Start::LastSession, ..Preferences::default() };
    window.state_mut().apply(Command::SetPreferences(preferences));
    window.state_mut().apply(Command::OpenExample("koch.vv"));
    window.state_mut().apply(Command::GoTo(1));
    settle(&mut window);
    window.state_mut().apply(Command::Quit);
    window.step();
    drop(window);
    let mut window = window_with(folder.path());
    let session = window.state().session();
    assert!(session.dialog.is_none());
    assert_eq!((session.document.program.name.as_str(), session.shown_generation()), ("koch.vv", 1));
    let preferences = Preferences { start: Start::Surface, ..Preferences::default() };
    window.state_mut().apply(Command::SetPreferences(preferences));
    window.step();
    drop(window);
    let window = window_with(folder.path());
    assert!(window.state().session().dialog.is_none());
    assert_eq!(window.state().session().document.program.name, "loop.vv");
}

#[test]
fn preferences_are_set_in_a_dialog_and_remembered() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = window_with(folder.path());
    window.state_mut().apply(Command::CloseDialog);
    window.step();
    window.key_press_modifiers(Modifiers::COMMAND, Key::Comma);
    window.run_steps(6);
    choose(&mut window, "At start", "a surface");
    choose(&mut window, "Theme", "dark");
    click(&mut window, "Done");
    assert!(window.state().session().dialog.is_none());
    drop(window);
    let mut window = window_with(folder.path());
    let session = window.state().session();
    assert_eq!((session.preferences.start, session.theme), (Start::Surface, app::command::ThemeChoice::Dark));
    window.key_press_modifiers(Modifiers::COMMAND, Key::Comma);
    window.run_steps(6);
    click(&mut window, "Reset to defaults");
    let session = window.state().session();
    assert_eq!((session.preferences, session.theme), (Preferences::default(), app::command::ThemeChoice::System));
}

#[test]
fn everything_grows_and_shrinks_by_preference_and_by_key() {
    let mut window = octahedron();
    window.state_mut().apply(Command::SetPreferences(Preferences { scale: 1.5, ..Preferences::default() }));
    window.run_steps(6);
    assert_eq!(window.ctx.zoom_factor(), 1.5);
    window.key_press_modifiers(Modifiers::COMMAND, Key::Num0);
    window.run_steps(6);
    assert_eq!(window.ctx.zoom_factor(), 1.0);
    assert_eq!(window.state().session().preferences.scale, 1.0);
}

#[test]
fn tab_makes_as_many_spaces_as_one_likes() {
    let mut window = octahedron();
    window.state_mut().apply(Command::SetPreferences(Preferences { tab_width: 4, ..Preferences::default() }));
    write(&mut window, "ab");
    press(&mut window, Key::Tab);
    assert_eq!(&*window.state().session().document.program.text, "ab  ");
    press(&mut window, Key::Tab);
    assert_eq!(&*window.state().session().document.program.text, "ab      ");
}

#[test]
fn a_picture_is_saved_in_the_size_and_on_the_background_one_asks_for() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = octahedron();
    window.key_press(Key::F12);
    window.run_steps(6);
    assert_eq!(window.state().session().dialog, Some(Dialog::Picture));
    click(&mut window, "square");
    click(&mut window, "transparent");
    let options = window.state().session().preferences.picture;
    let expected = PictureOptions { as_seen: false, width: 2048, height: 2048, background: Background::Transparent };
    assert_eq!(options, expected);
    for (background, corner) in [(Background::Transparent, [0, 0, 0, 0]), (Background::White, [255; 4])] {
        let picture = PictureOptions { width: 90, height: 60, background, ..expected };
        window.state_mut().apply(Command::SetPreferences(Preferences { picture, ..Preferences::default() }));
        let path = folder.path().join(format!("{background:?}"));
        window.state_mut().session_mut().chosen(Purpose::SavePicture, path.clone());
        until(&mut window, "it is saved", |s| s.notice().is_some_and(|(_, text)| text.starts_with("saved ")));
        let image = image::open(path.with_extension("png")).unwrap().into_rgba8();
        assert_eq!(image.dimensions(), (90, 60));
        assert_eq!(image.get_pixel(0, 0).0, corner);
        assert_eq!(image.get_pixel(45, 30).0[3], 255);
        window.state_mut().apply(Command::CloseDialog);
    }
}

#[test]
fn a_saved_picture_has_the_labels_and_the_ring_that_are_seen() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = octahedron();
    let save = |window: &mut Harness<'static, App>, name: &str| {
        let path = folder.path().join(name);
        window.state_mut().session_mut().chosen(Purpose::SavePicture, path.clone());
        until(window, "it is saved", |_| path.exists());
        path
    };
    let written = |path: std::path::PathBuf| {
        let text = std::fs::read_to_string(path).unwrap();
        text.split("aria-label=\"").skip(1).map(|t| t.split('"').next().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let plain = save(&mut window, "plain.png");
    assert!(written(save(&mut window, "plain.svg")).is_empty());
    window.state_mut().apply(Command::LabelBy(Label::Vertices));
    window.state_mut().apply(Command::Axes);
    settle(&mut window);
    let labels = written(save(&mut window, "labels.svg"));
    assert!(labels.contains(&"v1".to_owned()) && labels.ends_with(&["x", "y", "z"].map(str::to_owned)), "{labels:?}");
    let [plain, labelled] = [plain, save(&mut window, "labels.png")].map(|p| image::open(p).unwrap().into_rgba8());
    let changed = plain.pixels().zip(labelled.pixels()).filter(|(a, b)| a != b).count();
    assert!(changed > 200, "{changed} pixels");
    let seen = Vertex::from_index(labels[0][1..].parse::<usize>().unwrap() - 1).unwrap();
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(seen))));
    window.run_steps(4);
    let ring = written(save(&mut window, "ring.svg"));
    assert!(ring.iter().any(|text| text.contains(" – v")), "{ring:?}");
}
