//! What is shown is true: whose the keys are, which program made the picture, at which generation it stands, what failed.

use super::*;
use app::session::{Dialog, Origin, Purpose};
use vv::diagnostic::Severity;

fn type_text(window: &mut Harness<'static, App>, text: &str) {
    // Where the keys go, as for one who types.
    for letter in text.chars() {
        let key = Key::from_name(&letter.to_uppercase().to_string()).unwrap_or(Key::Space);
        window.event(egui::Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: Modifiers::NONE,
        });
        window.event(egui::Event::Text(letter.to_string()));
        window.step();
    }
    window.run_steps(2);
}

fn text<'w>(window: &'w Harness<'static, App>) -> &'w str {
    &window.state().session().document.program.text
}

fn has_keys(window: &Harness<'static, App>) -> bool {
    window.get_by_label("Program text").is_focused()
}

#[test]
fn escape_never_takes_the_keys_from_the_text() {
    let mut window = octahedron();
    write(&mut window, "// ");
    for _ in 0..3 {
        press(&mut window, Key::Escape);
    }
    let (style, generation) = (window.state().session().document.style, 0);
    type_text(&mut window, "for");
    assert_eq!(text(&window), "// for");
    let document = &window.state().session().document;
    assert_eq!((document.style, document.generation), (style, generation), "letters were no commands");
    assert!(!window.state().session().render_options);
}

#[test]
fn escape_takes_away_what_is_over_the_text_one_after_the_other() {
    let mut window = octahedron();
    write(&mut window, "// one two\n");
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    window.get_by_label("Program text").focus();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.run_steps(2);
    press(&mut window, Key::Escape);
    assert!(window.query_by_label("Find in program").is_none(), "the search first");
    press(&mut window, Key::Escape);
    type_text(&mut window, "x");
    assert_eq!(text(&window), "// one two\nx", "then what was selected");
}

#[test]
fn one_key_gives_the_keys_to_the_picture_and_back_and_it_is_said_whose_they_are() {
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    window.get_by_label("F6: keys to the picture");
    window.key_press(Key::F6);
    window.run_steps(3);
    assert!(!has_keys(&window));
    window.get_by_label("letters are commands · F6: type here");
    press(&mut window, Key::S);
    assert_eq!((window.state().session().document.generation, text(&window)), (1, PROGRAM));
    window.key_press(Key::F6);
    window.run_steps(3);
    assert!(has_keys(&window));
    type_text(&mut window, "s");
    assert_eq!(text(&window), format!("{PROGRAM}s"), "where the cursor was");
    window.get_by_label("line 4, column 2");
}

#[test]
fn the_problem_of_the_line_with_the_cursor_is_said_whole_below_the_text_and_mended_there() {
    let mut window = octahedron();
    write(&mut window, "void f(mesh& S) { }\nvoid g(mesh& S) { forall vertex p in S { } }");
    let problem = window.state().session().problems().first_error().unwrap().diagnostic.clone();
    window.get_by_label("line 2, column 45");
    let foot = window.get_by_label("line 2, column 45").rect().top();
    let below = |node: &egui_kittest::Node<'_>| node.rect().top() > foot - 90.0 && node.rect().bottom() <= foot + 1.0;
    let all: Vec<_> = window.get_all_by_label(&problem.message).filter(|n| below(n)).map(|n| n.rect()).collect();
    assert_eq!(all.len(), 1, "{} at {all:?}", problem.message);
    let fix = window.get_all_by_label("Fix").find(|n| below(n)).unwrap();
    fix.click();
    settle(&mut window);
    assert!(text(&window).contains("forall p in S"), "{}", text(&window));
}

#[test]
fn a_mesh_that_the_rule_is_not_for_is_a_problem_of_all_generations_that_came_of_it() {
    let mut window = octahedron();
    write(&mut window, "// Of quad meshes.\n\nvoid still(mesh& S) { }\n");
    let said = "the program is for quad meshes, and 8 of the 8 faces are none";
    assert!(window.query_by_label_contains(said).is_none(), "nothing was stepped");
    for _ in 0..2 {
        click(&mut window, "Step");
        let session = window.state().session();
        let warnings = session.problems().iter().filter(|p| p.diagnostic.severity == Severity::Warning);
        let warnings: Vec<_> = warnings.map(|p| p.diagnostic.message.as_str()).collect();
        assert_eq!(warnings, [said], "generation {}", session.shown_generation());
    }
    window.get_by_label_contains(said);
}

#[test]
fn a_step_that_fails_leaves_generation_and_time_line_where_the_picture_is() {
    let mut window = octahedron();
    write(&mut window, "void f(mesh& S) { forall v in S { if (v$pos.x > 1.5) print(1 / 0); v$pos *= 2.0; } }\n");
    click(&mut window, "Step");
    assert_eq!((window.state().session().document.generation, size(&window)), (1, 2.0));
    click(&mut window, "Step");
    let session = window.state().session();
    assert_eq!((session.document.generation, session.shown_generation(), size(&window)), (1, 1, 2.0));
    assert_eq!(session.stale(), None, "what is shown is as good as before");
    assert_eq!(session.halted().unwrap().generation, 2);
    window.get_by_label("generation 2 failed");
    let line = window.get_by_label("Time line");
    assert_eq!(line.accesskit_node().numeric_value(), Some(1.0));
    // Nothing came of it, so nothing of it is to be undone.
    window.state_mut().apply(Command::Undo);
    settle(&mut window);
    assert_eq!(window.state().session().document.generation, 0);
    assert_eq!(window.state().session().halted(), None);
    assert!(window.query_by_label("generation 2 failed").is_none());
}

#[test]
fn while_a_changed_text_fails_it_is_said_which_generation_is_seen_and_which_is_wanted() {
    let mut window = octahedron();
    write(&mut window, "void f(mesh& S) { forall v in S v$pos *= 2.0; }\n");
    press_outside(&mut window, Key::Num2);
    write(&mut window, "void f(mesh& S) { print(1 / 0); }\n");
    let session = window.state().session();
    assert_eq!((session.document.generation, session.shown_generation()), (2, 2), "mended, it goes on from there");
    assert_eq!((session.origin(), session.halted().unwrap().generation), (Origin::This, 1));
    window.get_by_label("stale: last good result; generation 1 failed");
    window.state_mut().apply(Command::GoTo(3));
    settle(&mut window);
    window.get_by_label("shown: 2");
    write(&mut window, "void f(mesh& S) { forall v in S v$pos *= 2.0; }\n");
    assert_eq!((window.state().session().shown_generation(), size(&window)), (3, 8.0));
    assert!(window.query_by_label("shown: 2").is_none());
}

#[test]
fn a_program_that_does_not_compile_has_no_rules_or_generations_of_the_one_before() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.vv");
    std::fs::write(&path, "void f(mesh& S) {").unwrap();
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    press_outside(&mut window, Key::Num2);
    window.state_mut().apply(Command::SaveTo(folder.path().join("good.vv")));
    settle(&mut window);
    window.state_mut().apply(Command::Open(path));
    settle(&mut window);
    let session = window.state().session();
    assert_eq!((session.program().is_none(), session.rule()), (true, None));
    assert_eq!(session.reached(0), None);
    assert_eq!((session.origin(), session.console().len(9)), (Origin::Former, 0));
    assert!(window.query_by_label("w").is_none(), "no parameters");
    assert!(window.get_by_label("Step").accesskit_node().is_disabled());
    window.get_by_label("stale: generation 2 of good.vv");
    // What was computed for the one before is not mistaken for this one's.
    let mended = "void grow(mesh& S) { print(\"again\"); forall v in S v$pos *= 2.0; }\n";
    write(&mut window, mended);
    assert_eq!((window.state().session().origin(), window.state().session().rule()), (Origin::This, Some("grow")));
    assert_eq!(window.state().session().console().len(9), 2);
}

#[test]
fn while_a_text_is_typed_rules_and_parameters_of_the_last_good_one_stay() {
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    write(&mut window, &PROGRAM.replace("grow(mesh& S)", "grow(mesh& S"));
    assert!(window.state().session().stale().is_some());
    assert_eq!(window.state().session().rule(), Some("grow"));
    window.get_by_role_and_label(Role::Slider, "w");
}

#[test]
fn messages_and_signs_leave_the_legend_and_the_surface_free() {
    for size in [egui::vec2(1280.0, 720.0), egui::vec2(900.0, 600.0)] {
        let mut window = octahedron();
        window.set_size(size);
        window.state_mut().apply(Command::ColorBy(app::annotate::Quantity::Valence));
        settle(&mut window);
        window.run_steps(3);
        let legend = window.get_by_label("valence").rect();
        let before = window.render().unwrap();
        window
            .state_mut()
            .session_mut()
            .warn("something long that is said of a file and goes over more than one line ".repeat(2));
        window.run_steps(2);
        let after = window.render().unwrap();
        let in_legend = |x: u32, y: u32| {
            let p = egui::pos2(x as f32, y as f32);
            p.x >= legend.left() - 8.0 && p.y >= legend.top() - 4.0 && p.x < size.x - 300.0
        };
        let changed = before.enumerate_pixels().filter(|(x, y, p)| in_legend(*x, *y) && *p != after.get_pixel(*x, *y));
        assert_eq!(changed.count(), 0, "{size}");
    }
}

#[test]
fn the_name_of_a_mesh_leaves_its_button_free() {
    let mut window = octahedron();
    window.set_size(egui::vec2(900.0, 600.0));
    window.state_mut().apply(Command::UseMesh(MeshSource::Empty));
    window.state_mut().apply(Command::OpenExample("coral.vv"));
    settle(&mut window);
    window.run_steps(3);
    let (name, button) = (window.get_by_label("made by the program").rect(), window.get_by_label("Open…").rect());
    assert!(name.right() <= button.left(), "{name} {button}");
}

#[test]
fn a_style_that_is_loaded_is_one_step_to_undo_and_figures_go_by_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::write(
        path("look.json"),
        r##"{ "style": { "smooth": true, "edges": true }, "annotations": { "color_by": "valence" },
              "page": "50mm", "lines": { "outline": "2,#ff0000" } }"##,
    )
    .unwrap();
    let mut window = octahedron();
    let before = window.state().session().document.clone();
    window.state_mut().apply(Command::Smooth); // nobody's work
    window.state_mut().apply(Command::Smooth);
    window.state_mut().session_mut().chosen(Purpose::OpenStyle, path("look.json"));
    settle(&mut window);
    let styled = window.state().session().document.clone();
    assert!(styled.style.smooth && styled.annotations != before.annotations);
    let figure = |window: &mut Harness<'static, App>, name: &str| {
        window.state_mut().apply(Command::PictureTo(path(name)));
        until(window, "it is saved", |s| s.notice().is_some_and(|(_, text)| text.starts_with("saved ")));
        std::fs::read_to_string(path(name)).unwrap()
    };
    let written = figure(&mut window, "styled.svg");
    assert!(written.contains("width=\"50mm\"") && written.contains("#f00"), "{written}");
    window.state_mut().apply(Command::Undo);
    settle(&mut window);
    let document = &window.state().session().document;
    assert_eq!((document.style, &document.annotations), (before.style, &before.annotations));
    let written = figure(&mut window, "plain.svg");
    assert!(!written.contains("width=\"50mm\"") && !written.contains("#f00"));
    window.state_mut().apply(Command::Redo);
    settle(&mut window);
    assert_eq!(window.state().session().document, styled);
    std::fs::write(path("wrong.json"), "{\n  \"page\": \"wide\"\n}").unwrap();
    window.state_mut().session_mut().chosen(Purpose::OpenStyle, path("wrong.json"));
    let (_, said) = window.state().session().notice().unwrap();
    assert!(said.contains("wrong.json: line 2: a page is a width"), "{said}");
    assert_eq!(window.state().session().document, styled);
}

#[test]
fn a_value_that_the_program_does_not_take_is_not_shown_as_if_it_did() {
    let mut window = octahedron();
    let program =
        |range: &str| format!("param double w = 0.25 in {range};\nvoid f(mesh& S) {{ forall v in S v$pos *= w; }}\n");
    write(&mut window, &program("[0, 1]"));
    window.state_mut().apply(Command::SetParam("w".to_owned(), vv::mesh::Value::Double(0.75)));
    click(&mut window, "Step");
    assert_eq!(size(&window), 0.75);
    write(&mut window, &program("[0, 0.5]"));
    assert_eq!(size(&window), 0.25);
    let slider = window.get_by_role_and_label(Role::Slider, "w");
    assert_eq!(slider.accesskit_node().numeric_value(), Some(0.25));
}

#[test]
fn a_file_of_an_unknown_kind_leaves_all_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("notes.xyz");
    std::fs::write(&path, "notes").unwrap();
    let mut window = octahedron();
    let before = window.state().session().document.clone();
    window.state_mut().apply(Command::Open(path));
    settle(&mut window);
    let session = window.state().session();
    assert_eq!((&session.document, session.stale()), (&before, None));
    let (_, said) = session.notice().unwrap();
    assert!(said.contains("notes.xyz: neither a program (.vv)"), "{said}");
}

#[test]
fn what_a_former_program_made_is_saved_and_titled_by_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("broken.vv"), "void f(mesh& S) {").unwrap();
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    window.state_mut().apply(Command::SaveTo(path("good.vv")));
    window.state_mut().apply(Command::Step);
    settle(&mut window);
    window.state_mut().apply(Command::Open(path("broken.vv")));
    settle(&mut window);
    assert_eq!((window.state().session().made_by().as_str(), size(&window)), ("good.vv", 2.0));
    window.state_mut().apply(Command::Pair(app::command::PairAction::Compare));
    settle(&mut window);
    window.run_steps(3);
    window.get_by_label("broken.vv on octahedron.obj, generation 1 of good.vv");
    window.get_by_label("broken.vv on octahedron.obj, nothing computed, has the keys");
}

#[test]
fn what_was_wrong_is_not_said_any_more_while_something_else_is_computed() {
    let mut window = octahedron();
    press(&mut window, Key::Num1);
    write(&mut window, "void f(mesh& S) { nothing }");
    let Some(Stale::Failed(message)) = window.state().session().stale().cloned() else { panic!("it compiles") };
    assert!(window.query_all_by_label(&message).next().is_some());
    window.state_mut().apply(Command::Edit("void f(mesh& S) { while (true) { } }".into()));
    window.state_mut().apply(Command::Run);
    until(&mut window, "it runs", |s| s.progress().is_some_and(|(_, stepping)| stepping == Some(1)));
    let began = Instant::now();
    while window.query_all_by_label("what is wanted now is being computed").next().is_none() {
        assert!(began.elapsed() < Duration::from_secs(60), "nothing is said of it");
        window.step();
    }
    assert!(window.query_all_by_label(&message).next().is_none(), "that was another text");
    window.get_by_label("stale: last good result");
    window.state_mut().apply(Command::Stop);
}

#[test]
fn what_is_typed_in_the_frame_in_which_a_dialog_closes_is_for_those_who_get_the_keys() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    type_text(&mut window, "ab");
    let key = |key, modifiers| egui::Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
    let letter = |name, text: &str| [key(name, Modifiers::NONE), egui::Event::Text(text.to_owned())];
    let mut save_and = |name: &str, typed: &[egui::Event]| {
        let path = folder.path().join(name).display().to_string();
        window.state_mut().session_mut().dialog = Some(Dialog::path(Purpose::SaveProgram, path.clone(), None));
        window.run_steps(4);
        window.input_mut().events.push(key(Key::Enter, Modifiers::NONE));
        window.input_mut().events.extend(typed.iter().cloned());
        settle(&mut window);
        window.run_steps(4);
        (std::fs::read_to_string(path).unwrap(), text(&window).to_owned())
    };
    let program = |more: &str| format!("{PROGRAM}{more}");
    assert_eq!(save_and("one.vv", &letter(Key::X, "x")), (program("ab"), program("abx")));
    let undone = [&[key(Key::Z, Modifiers::COMMAND)][..], &letter(Key::C, "c")].concat();
    assert_eq!(save_and("two.vv", &undone), (program("abx"), program("c")), "what was typed before was undone");
}

#[test]
fn a_step_that_changes_nothing_says_so() {
    let mut window = octahedron();
    write(&mut window, "vertex { int n; };\nvoid rest(mesh& S) { }\n");
    let said = |window: &Harness<'static, App>| window.state().session().notice().map(|(_, text)| text.to_owned());
    assert_eq!(said(&window), None);
    click(&mut window, "Step");
    assert_eq!(said(&window).as_deref(), Some("the step changed nothing"));
    window.get_by_label_contains("the step changed nothing");
    // It is not said any longer than it is so.
    click(&mut window, "Back");
    assert_eq!(said(&window), None);
    write(&mut window, "void rest(mesh& S) { print(\"looked\"); }\n");
    click(&mut window, "Step");
    assert!(window.query_by_label_contains("the step changed nothing").is_none(), "it was not there for the mesh");
}

#[test]
fn positions_that_cannot_be_drawn_are_told_in_place_of_the_mesh() {
    let mut window = octahedron();
    write(&mut window, "void boom(mesh& S) { forall v in S v$pos *= 1e100; }\n");
    let said = "no position is a number that can be drawn";
    click(&mut window, "Step");
    assert!(window.query_by_label(said).is_none());
    click(&mut window, "Step");
    window.get_by_label(said);
}

#[test]
fn what_the_mesh_file_says_and_the_program_cannot_hold_is_warned_of_at_its_declaration() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               property double heat\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
               0 0 0 1.5\n2 0 0 2\n0 2 0 3\n3 0 1 2\n";
    let folder = tempfile::tempdir().unwrap();
    let mesh = folder.path().join("c.ply");
    std::fs::write(&mesh, ply).unwrap();
    let mut window = open(Some(&mesh), None);
    let warned = |window: &Harness<'static, App>| -> Vec<String> {
        window.state().session().problems().iter().map(app::session::Problem::to_text).collect()
    };
    write(&mut window, "vertex { int heat; };\nvoid f(mesh& S) { }\n");
    let [warning] = &warned(&window)[..] else { panic!("{:?}", warned(&window)) };
    let message = "1:14: warning: `heat` of vertices is `double` in the mesh file and `int` in the program";
    assert!(warning.contains(message) && warning.contains("hint: `double heat;` keeps"), "{warning}");
    write(&mut window, "vertex { double heat; };\nvoid f(mesh& S) { }\n");
    assert_eq!(warned(&window), [""; 0]);
}

#[test]
fn a_mesh_alone_comes_with_a_program_that_is_for_it_and_a_program_that_was_asked_for_stays() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| {
        let shipped = app::library::MESHES.iter().find(|mesh| mesh.name == name).unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, shipped.text).unwrap();
        path
    };
    let program = |window: &Harness<'static, App>| window.state().session().document.program.name.clone();
    let [cube, tetrapod] = ["cube.obj", "tetrapod.obj"].map(file);
    let mut window = open(Some(&tetrapod), None);
    assert_eq!(program(&window), "loop.vv");
    window.state_mut().apply(Command::Open(cube.clone()));
    settle(&mut window);
    assert_eq!(program(&window), "catmull-clark.vv", "not all faces are triangles");
    press(&mut window, Key::S);
    assert_eq!(faces(&window), 24);
    window.state_mut().apply(Command::OpenExample("loop.vv"));
    settle(&mut window);
    window.state_mut().apply(Command::Open(cube));
    settle(&mut window);
    assert_eq!(program(&window), "loop.vv", "that was asked for");
}

#[test]
fn a_name_that_no_file_has_is_that_of_a_program_that_comes_with_vv() {
    let window = open(None, Some(Path::new("tissue.vv")));
    let session = window.state().session();
    assert_eq!((&*session.document.program.name, &session.document.program.path), ("tissue.vv", &None));
    assert_eq!((session.notice(), &session.document.mesh), (None, &MeshSource::Empty), "it builds its own");
    let window = open(None, Some(Path::new("nowhere/tissue.vv")));
    let notice = window.state().session().notice().map(|(severity, _)| severity);
    assert_eq!(notice, Some(Severity::Error), "that is the name of a file");
}
