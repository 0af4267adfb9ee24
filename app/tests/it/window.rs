//! The window, driven as a user drives it: by names, keys and the pointer.

mod compare;
mod display;
mod editor;
mod gallery;
mod inspecting;
mod keeping;
mod masks;
mod menus;
mod palette;
mod paths;
mod pictures;
mod reach;
mod reference;
mod states;
mod subdividing;
mod timeline;
mod view;

use std::path::Path;
use std::time::{Duration, Instant};

use app::command::Command;
use app::document::MeshSource;
use app::gui::App;
use app::session::{Session, Stale};
use eframe::egui;
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

/// The window on files, the first picture shown.
fn open(mesh: Option<&Path>, program: Option<&Path>) -> Harness<'static, App> {
    let (mesh, program) = (mesh.map(Path::to_owned), program.map(Path::to_owned));
    let mut window = Harness::builder()
        .with_size(egui::vec2(1000.0, 700.0))
        .wgpu()
        .build_eframe(|cc| App::new(cc, mesh, program).unwrap());
    settle(&mut window);
    window
}

/// Lets the window run until a state is reached. The time allowed is for slow machines only.
#[track_caller]
fn until(window: &mut Harness<'static, App>, what: &str, reached: impl Fn(&Session) -> bool) {
    let began = Instant::now();
    loop {
        window.step();
        if reached(window.state().session()) {
            return;
        }
        assert!(began.elapsed() < Duration::from_secs(60), "waited in vain until {what}");
        std::thread::sleep(Duration::from_millis(3));
    }
}

/// Until nothing is computed any more and what came of it is on the screen.
#[track_caller]
fn settle(window: &mut Harness<'static, App>) {
    window.step();
    until(window, "all is computed", |s| !s.is_busy());
    window.step();
}

fn click(window: &mut Harness<'static, App>, name: &str) {
    window.get_by_label(name).click();
    settle(window);
}

/// Opens a menu or a list and chooses an entry.
fn choose(window: &mut Harness<'static, App>, menu: &str, entry: &str) {
    window.get_by_label(menu).click();
    window.run_steps(4);
    click(window, entry);
}

fn press(window: &mut Harness<'static, App>, key: Key) {
    window.key_press(key);
    settle(window);
}

/// Replaces the text in the editor by typing.
fn write(window: &mut Harness<'static, App>, text: &str) {
    window.get_by_label("Program text").focus();
    window.step();
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.step();
    window.get_by_label("Program text").type_text(text);
    settle(window);
    assert_eq!(&*window.state().session().document.program.text, text);
}

fn faces(window: &Harness<'static, App>) -> usize {
    window.state().session().frame().unwrap().statistics.faces
}

fn switch<'w>(window: &'w Harness<'static, App>, name: &'w str) -> egui_kittest::Node<'w> {
    window.get_by_role_and_label(Role::CheckBox, name)
}

fn is_on(window: &Harness<'static, App>, name: &str) -> bool {
    switch(window, name).accesskit_node().toggled() == Some(egui::accesskit::Toggled::True)
}

fn octahedron() -> Harness<'static, App> {
    let mut window = open(None, None);
    window.state_mut().apply(Command::UseMesh(MeshSource::BuiltIn("octahedron.obj".to_owned())));
    window.state_mut().apply(Command::Rewind);
    settle(&mut window);
    assert_eq!(faces(&window), 8);
    window
}

const PROGRAM: &str = "param double w = 0.5 in [0, 1];\nvoid shrink(mesh& S) { forall v in S v$pos *= w; }\n\
                       void grow(mesh& S) { print(\"grown\"); forall v in S v$pos *= 2.0; }\n";

#[test]
fn opens_with_a_refined_surface_and_its_control_mesh() {
    let mut window = open(None, None);
    let session = window.state().session();
    assert!(session.document.generation >= 2 && session.document.style.control);
    let frame = session.frame().unwrap();
    assert!(frame.statistics.valid && frame.statistics.faces > 500);
    assert_eq!(session.problems().iter().count(), 0);
    // The viewport holds a shaded picture: many colours, not one.
    let viewport = window.get_by_label("Viewport").rect();
    let image = window.render().unwrap();
    let colors: std::collections::BTreeSet<[u8; 4]> = image
        .enumerate_pixels()
        .filter(|(x, y, _)| viewport.contains(egui::pos2(*x as f32, *y as f32)))
        .map(|(_, _, pixel)| pixel.0)
        .collect();
    assert!(colors.len() > 200, "{} colours", colors.len());
}

#[test]
fn step_back_and_rewind_walk_the_generations_by_button_and_by_key() {
    let mut window = octahedron();
    click(&mut window, "Step");
    assert_eq!(faces(&window), 32);
    press(&mut window, Key::S);
    assert_eq!(faces(&window), 128);
    press(&mut window, Key::ArrowRight);
    assert_eq!(faces(&window), 512);
    click(&mut window, "Back");
    assert_eq!(faces(&window), 128);
    press(&mut window, Key::ArrowLeft);
    assert_eq!(faces(&window), 32);
    press(&mut window, Key::Num3);
    assert_eq!(faces(&window), 512);
    click(&mut window, "Rewind");
    assert_eq!(faces(&window), 8);
    assert!(window.get_by_label("Back").accesskit_node().is_disabled());
}

#[test]
fn statistics_stand_beside_the_picture() {
    let mut window = octahedron();
    click(&mut window, "Step");
    for (name, value) in
        [("Vertices", "18"), ("Edges", "48"), ("Faces", "32"), ("Euler characteristic", "2"), ("Genus", "0")]
    {
        window.get_by(|node| node.label().as_deref() == Some(name) && node.value().as_deref() == Some(value));
    }
}

#[test]
fn playing_goes_on_until_stopped() {
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    click(&mut window, "Program text"); // letters go to the text …
    window.key_press(Key::F6); // … until F6 gives the keys to the picture
    window.step();
    window.key_press(Key::Space);
    until(&mut window, "three generations were played", |s| s.frame().unwrap().request.generation >= 3);
    assert!(window.state().session().is_playing());
    press(&mut window, Key::Escape);
    assert!(!window.state().session().is_playing());
}

#[test]
fn an_error_marks_the_last_good_result_as_stale_and_repairing_clears_it() {
    let mut window = octahedron();
    window.state_mut().apply(Command::OpenExample("paper-loop.vv"));
    settle(&mut window);
    press(&mut window, Key::Num1);
    let text = window.state().session().document.program.text.to_string();
    write(&mut window, &text.replace("merge S with NV", "merge S wiht NV"));
    assert_eq!(faces(&window), 32, "the last good mesh stays");
    assert!(matches!(window.state().session().stale(), Some(Stale::Failed(message)) if message.starts_with("line ")));
    window.get_by_label("stale: last good result");
    let line = text.lines().position(|l| l.contains("merge S")).unwrap() as u32 + 1;
    let problem = window.state().session().problems().first_error().unwrap().place.clone().unwrap();
    assert_eq!((problem.own, problem.start.line), (true, line));
    write(&mut window, &text);
    assert_eq!(window.state().session().stale(), None);
    assert!(window.query_by_label("stale: last good result").is_none());
}

#[test]
fn an_error_while_running_is_located_and_stepping_again_tries_again() {
    let mut window = octahedron();
    write(&mut window, "void f(mesh& S) {\n  vertex v = null;\n  v$pos = v$pos;\n}\n");
    assert_eq!(window.state().session().stale(), None, "generation 0 needs no step");
    click(&mut window, "Step");
    let problem = window.state().session().problems().first_error().unwrap().clone();
    assert_eq!(problem.place.unwrap().start.line, 3);
    click(&mut window, "Step");
    assert_eq!(window.state().session().halted().unwrap().generation, 1);
    write(&mut window, "void f(mesh& S) { forall v in S v$pos *= 2.0; }\n");
    click(&mut window, "Step");
    assert_eq!((window.state().session().stale(), window.state().session().halted()), (None, None));
    assert_eq!(window.state().session().problems().iter().count(), 0);
}

#[test]
fn the_rule_is_chosen_from_those_of_the_program() {
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    assert_eq!(window.state().session().rule(), Some("grow"));
    choose(&mut window, "Rule", "shrink");
    assert_eq!(window.state().session().rule(), Some("shrink"));
    click(&mut window, "Step");
    assert_eq!(size(&window), 0.5);
}

/// Distance of the first vertex from the origin.
fn size(window: &Harness<'static, App>) -> f64 {
    window.state().session().frame().unwrap().mesh.positions()[0].length()
}

#[test]
fn a_parameter_is_a_slider_and_moving_it_computes_the_generation_anew() {
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    window.state_mut().apply(Command::ChooseRule("shrink".to_owned()));
    press_outside(&mut window, Key::Num2);
    assert_eq!(size(&window), 0.25);
    let slider = |w: &Harness<'static, App>, value| {
        w.get_by_role_and_label(Role::Slider, "w").set_value_accesskit(value);
    };
    slider(&window, 1.0);
    settle(&mut window);
    assert_eq!(size(&window), 1.0);
    click(&mut window, "Reset all");
    assert_eq!(size(&window), 0.25);
}

/// A key while no text has the focus.
fn press_outside(window: &mut Harness<'static, App>, key: Key) {
    window.key_press(Key::Escape); // of other fields
    window.step();
    if window.query_by_label("Program text").is_some_and(|text| text.is_focused()) {
        window.key_press(Key::F6);
        window.run_steps(2);
    }
    press(window, key);
}

#[test]
fn an_endless_loop_is_stopped_and_nothing_is_lost() {
    let mut window = octahedron();
    press(&mut window, Key::Num1);
    window.get_by_label("Program text").focus();
    window.step();
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.get_by_label("Program text").type_text("void f(mesh& S) { while (true) print(\"again\"); }");
    until(&mut window, "the loop runs", |s| {
        s.progress().is_some_and(|(_, step)| step == Some(1)) && s.console().len(1) > 0
    });
    window.get_by_label("Stop").click();
    window.step();
    window.step();
    assert!(!window.state().session().is_busy());
    assert_eq!(window.state().session().stale(), Some(&Stale::Stopped));
    assert_eq!(faces(&window), 32, "the last good mesh stays");
    // The worker is free for the next.
    write(&mut window, PROGRAM);
    assert_eq!(window.state().session().stale(), None);
}

#[test]
fn the_console_shows_what_generations_print_and_going_back_takes_it_back() {
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    press_outside(&mut window, Key::Num2);
    click(&mut window, "Console");
    assert_eq!(window.get_all_by_label("grown").count(), 2);
    click(&mut window, "Back");
    assert_eq!(window.get_all_by_label("grown").count(), 1);
}

#[test]
fn letters_typed_into_the_program_are_no_commands() {
    let mut window = octahedron();
    window.get_by_label("Program text").focus();
    window.step();
    for key in [Key::S, Key::W, Key::C, Key::Num3] {
        press(&mut window, key);
    }
    let document = &window.state().session().document;
    assert_eq!(document.generation, 0);
    assert!(document.style.faces && document.style.control);
}

#[test]
fn switches_change_the_picture_and_keys_are_the_same_switches() {
    let mut window = octahedron();
    let before = window.render().unwrap();
    switch(&window, "Vertices").click();
    settle(&mut window);
    assert!(is_on(&window, "Vertices"));
    let with_vertices = window.render().unwrap();
    assert!(differ(&window, &before, &with_vertices) > 50);
    press(&mut window, Key::V);
    assert!(!is_on(&window, "Vertices"));
    press(&mut window, Key::W);
    assert!(!is_on(&window, "Faces") && is_on(&window, "Edges"));
}

/// How many pixels of the viewport differ.
fn differ(window: &Harness<'static, App>, a: &image::RgbaImage, b: &image::RgbaImage) -> usize {
    let viewport = window.get_by_label("Viewport").rect();
    let inside = |x, y| viewport.contains(egui::pos2(x as f32, y as f32));
    a.enumerate_pixels().filter(|(x, y, pixel)| inside(*x, *y) && *pixel != b.get_pixel(*x, *y)).count()
}

#[test]
fn dragging_turns_the_view_the_wheel_zooms_and_fit_brings_it_back() {
    let mut window = octahedron();
    let start = window.state().session().document.camera;
    let middle = window.get_by_label("Viewport").rect().center();
    window.drag_at(middle);
    window.step();
    window.hover_at(middle + egui::vec2(60.0, 20.0));
    window.step();
    window.drop_at(middle + egui::vec2(60.0, 20.0));
    settle(&mut window);
    let turned = window.state().session().document.camera;
    assert_ne!(turned.world_from_view, start.world_from_view);
    assert_eq!((turned.pivot, turned.distance), (start.pivot, start.distance));
    let wheel = egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        source: egui::MouseWheelSource::Wheel,
        delta: egui::vec2(0.0, 120.0),
        phase: egui::TouchPhase::Move,
        modifiers: Modifiers::NONE,
    };
    window.hover_at(middle);
    window.event(wheel);
    for _ in 0..20 {
        window.step(); // the motion is smoothed over several frames
    }
    let near = window.state().session().document.camera;
    assert!(near.distance < 0.9 * turned.distance);
    press(&mut window, Key::F);
    let session = window.state().session();
    let fitted = session.document.camera;
    assert_eq!(fitted.world_from_view, turned.world_from_view);
    // As close as pictures without window stand.
    let viewport = window.get_by_label("Viewport").rect();
    let aspect = f64::from(viewport.width().round() / viewport.height().round());
    let expected = session.frame().unwrap().scene.fit(turned, &session.document.style, aspect);
    assert!((fitted.distance - expected.distance).abs() < 1e-4, "{fitted:?} {expected:?}");
}

#[test]
fn examples_and_meshes_are_chosen_from_menus() {
    let mut window = octahedron();
    choose(&mut window, "Meshes", "cube-open.obj");
    assert_eq!(window.state().session().frame().unwrap().statistics.boundary_loops, 1);
    choose(&mut window, "Examples", "paper-sqrt3.vv");
    assert_eq!(window.state().session().document.program.name, "paper-sqrt3.vv");
    assert_eq!(window.state().session().problems().iter().count(), 0);
}

#[test]
fn a_program_that_builds_its_own_mesh_is_given_none_and_one_that_needs_one_gets_it_back() {
    let mut window = open(None, None);
    press(&mut window, Key::Home);
    choose(&mut window, "Examples", "mountain.vv");
    assert_eq!(window.state().session().document.mesh, MeshSource::Empty);
    assert!(faces(&window) > 0);
    window.get_by_label("made by the program");
    choose(&mut window, "Examples", "loop.vv");
    assert!(matches!(window.state().session().document.mesh, MeshSource::BuiltIn(_)));
    assert!(faces(&window) > 0);
    window.get_by_label("Examples").click();
    window.run_steps(4);
    assert!(window.query_by_label("insert.vv").is_none(), "no example: it only serves others");
}

#[test]
fn unsaved_text_is_asked_about_before_it_is_lost() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.vv");
    std::fs::write(&path, PROGRAM).unwrap();
    let mut window = open(None, Some(&path));
    let changed = format!("{PROGRAM}// more\n");
    write(&mut window, &changed);
    window.get_by_label("unsaved");
    window.state_mut().apply(Command::Quit);
    window.step();
    window.step();
    window.get_by_label("Cancel").click();
    window.step();
    window.step();
    assert!(!window.state().session().wants_quit());
    assert_eq!(&*window.state().session().document.program.text, changed);
    window.state_mut().apply(Command::OpenExample("loop.vv"));
    window.step();
    window.step();
    click(&mut window, "Save");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), changed);
    assert_eq!(window.state().session().document.program.name, "loop.vv", "then goes on");
}

#[test]
fn a_mesh_that_cannot_be_read_is_explained_and_the_old_picture_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.obj");
    std::fs::write(&path, "v 0 0 0\nf 1 2 3\n").unwrap();
    let mut window = octahedron();
    window.state_mut().apply(Command::Open(path));
    settle(&mut window);
    assert_eq!(faces(&window), 8);
    assert!(matches!(window.state().session().stale(), Some(Stale::Failed(message)) if message.contains("broken.obj")));
    window.state_mut().apply(Command::UseMesh(MeshSource::BuiltIn("cube.obj".to_owned())));
    settle(&mut window);
    assert_eq!(window.state().session().stale(), None);
}

#[test]
fn a_mesh_is_shown_even_while_its_program_has_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let (mesh, program) = (folder.path().join("tetrahedron.obj"), folder.path().join("broken.vv"));
    std::fs::write(&mesh, "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n").unwrap();
    std::fs::write(&program, "void f(mesh& S) { synchronize }").unwrap();
    let window = open(Some(&mesh), Some(&program));
    assert_eq!(faces(&window), 4);
    assert!(window.state().session().stale().is_some());
}

#[test]
fn without_a_mesh_the_viewport_says_what_to_do() {
    let mut window = octahedron();
    window.state_mut().apply(Command::UseMesh(MeshSource::Empty));
    settle(&mut window);
    assert_eq!(faces(&window), 0);
    assert_eq!(window.state().session().stale(), None);
}

#[test]
fn a_mesh_that_was_chosen_is_kept_also_for_a_program_that_builds_its_own() {
    let mut window = octahedron();
    window.state_mut().apply(Command::OpenExample("mountain.vv"));
    settle(&mut window);
    let session = window.state().session();
    assert_eq!(session.document.mesh, MeshSource::BuiltIn("octahedron.obj".to_owned()));
    assert_eq!(session.frame().unwrap().statistics.vertices, 6 + 7);
}

#[test]
fn a_program_that_comes_to_build_its_own_mesh_while_it_is_typed_is_given_none() {
    let mut window = open(None, None);
    press(&mut window, Key::Home);
    write(&mut window, "void start(mesh& S) { vertex v; add v to S; }");
    let session = window.state().session();
    assert_eq!(session.document.mesh, MeshSource::Empty);
    assert_eq!(session.frame().unwrap().statistics.vertices, 1);
    write(&mut window, "void f(mesh& S) { }");
    assert_ne!(window.state().session().document.mesh, MeshSource::Empty);
    assert!(faces(&window) > 10);
}

#[test]
fn what_was_printed_before_a_stop_stays_on_the_console() {
    let mut window = octahedron();
    write(&mut window, "void f(mesh& S) { print(\"here it hangs\"); while (true) { } }");
    window.state_mut().apply(Command::Step);
    until(&mut window, "it prints", |s| s.console().len(s.console_generation()) == 1);
    window.state_mut().apply(Command::Stop);
    settle(&mut window);
    let session = window.state().session();
    assert_eq!(session.document.generation, 0);
    assert_eq!(session.console().lines(session.console_generation(), 0..9), ["here it hangs"]);
}

#[test]
fn after_a_dialog_the_editor_has_the_keys_again() {
    let mut window = octahedron();
    window.get_by_label("Program text").focus();
    window.step();
    window.get_by_label("Program text").type_text(" ");
    settle(&mut window);
    window.state_mut().apply(Command::NewProgram);
    window.run_steps(3);
    assert!(window.state().session().dialog.is_some());
    assert!(!window.get_by_label("Program text").is_focused());
    window.get_by_label("Cancel").click();
    window.run_steps(4);
    assert!(window.state().session().dialog.is_none());
    assert!(window.get_by_label("Program text").is_focused());
}

#[test]
fn a_narrow_window_leaves_the_viewport_its_room() {
    let mut window = open(None, None);
    window.set_size(egui::vec2(640.0, 480.0));
    window.run_steps(4);
    let viewport = window.get_by_label("Viewport").rect();
    assert!(viewport.width() >= 160.0, "{viewport}");
    // The inspector is not pushed out either.
    assert!(window.get_by_label("Fit view").rect().left() > viewport.right());
}

#[test]
fn in_a_narrow_window_no_tab_of_the_messages_is_cut_or_covered() {
    let mut window = octahedron();
    for size in [egui::vec2(1280.0, 720.0), egui::vec2(760.0, 460.0), egui::vec2(640.0, 480.0)] {
        window.set_size(size);
        write(&mut window, "void f(mesh& S) { print(1); x = 1; }\n");
        window.run_steps(3);
        let tab = |name: &str| window.get_by_role_and_label(Role::Button, name).rect();
        let mut places = ["Problems", "Mesh", "Console"].map(tab).to_vec();
        places.extend(window.query_by_label("Copy").map(|copy| copy.rect()));
        places.push(window.get_by_label("Viewport").rect());
        assert!(places.is_sorted_by(|a, b| a.right() <= b.left()), "{size}: {places:?}");
        assert!(places.len() == 5 || size.x < 700.0, "there is room to copy: {size}");
    }
}

#[test]
fn a_text_whose_file_is_gone_is_asked_about_before_it_is_lost() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.vv");
    std::fs::write(&path, PROGRAM).unwrap();
    let mut window = open(None, Some(&path));
    std::fs::remove_file(&path).unwrap();
    window.state_mut().apply(Command::NewProgram);
    window.run_steps(3);
    assert!(window.state().session().dialog.is_some());
    click(&mut window, "Don't save");
    assert!(window.state().session().dialog.is_none());
    assert_eq!(&*window.state().session().document.program.text, "");
}

#[test]
fn parameters_stand_under_the_file_that_they_are_of() {
    let mut window = octahedron();
    write(&mut window, "#include \"mountain.vv\"\nparam double size = 1 in [0.5, 2];\nvoid f(mesh& S) { }\n");
    let top = |name: &str| window.get_by_label(name).rect().top();
    let own = format!("of {}", window.state().session().document.program.name);
    let slider = |name: &str| window.get_by_role_and_label(Role::Slider, name).rect().top();
    let order = [top("of mountain.vv"), slider("height"), top(&own), slider("size")];
    assert!(order.is_sorted(), "{order:?}");
}

#[test]
fn a_parameter_is_reset_alone_and_values_are_kept_under_a_name() {
    let mut window = octahedron();
    write(&mut window, "param double w = 0.5 in [0, 1]; // how much\nparam bool b = true;\nvoid f(mesh& S) { }\n");
    let set = |window: &mut Harness<'static, App>, w, b| {
        window.state_mut().apply(Command::SetParam("w".to_owned(), vv::mesh::Value::Double(w)));
        window.state_mut().apply(Command::SetParam("b".to_owned(), vv::mesh::Value::Bool(b)));
        settle(window);
    };
    set(&mut window, 0.25, false);
    window.get_by_label("Sets").click();
    window.run_steps(4);
    window.get_by_label("Name of the set").focus();
    window.step();
    window.get_by_label("Name of the set").type_text("narrow");
    window.run_steps(2);
    click(&mut window, "Keep");
    press_outside(&mut window, Key::Escape);
    click(&mut window, "Reset w");
    let params = |window: &Harness<'static, App>| window.state().session().document.params.clone();
    assert_eq!(params(&window).keys().collect::<Vec<_>>(), ["b"]);
    set(&mut window, 0.75, true);
    window.get_by_label("Sets").click();
    window.run_steps(4);
    click(&mut window, "narrow");
    let expected = [("b", vv::mesh::Value::Bool(false)), ("w", vv::mesh::Value::Double(0.25))];
    assert_eq!(params(&window), expected.map(|(name, value)| (name.to_owned(), value)).into());
}
