//! Two documents side by side.

use super::*;
use app::camera::{Camera, Side, Up};
use app::command::{PairAction, ViewAction};
use app::session::Dialog;

fn pair(window: &mut Harness<'static, App>, action: PairAction) {
    window.state_mut().apply(Command::Pair(action));
    settle_both(window);
}

#[track_caller]
fn settle_both(window: &mut Harness<'static, App>) {
    window.step();
    until(window, "both are computed", |s| !s.is_busy() && s.beside().is_none_or(|b| !b.session().is_busy()));
    window.step();
}

fn this(window: &Harness<'static, App>) -> (String, u64) {
    let session = window.state().session();
    (session.document.program.name.clone(), session.shown_generation())
}

fn other(window: &Harness<'static, App>) -> (String, u64) {
    let session = window.state().session().beside().unwrap().session();
    (session.document.program.name.clone(), session.shown_generation())
}

fn cameras(window: &Harness<'static, App>) -> [Camera; 2] {
    let session = window.state().session();
    [session.document.camera, session.beside().unwrap().session().document.camera]
}

/// An octahedron at the left with loop.vv, at the right with butterfly.vv, which has the keys.
fn loop_and_butterfly() -> Harness<'static, App> {
    let mut window = octahedron();
    window.key_press_modifiers(Modifiers::COMMAND, Key::Backslash);
    settle_both(&mut window);
    window.state_mut().apply(Command::OpenExample("butterfly.vv"));
    settle_both(&mut window);
    window
}

fn named(name: &str, generation: u64) -> (String, u64) {
    (name.to_owned(), generation)
}

#[test]
fn a_copy_opens_at_the_right_and_takes_another_program() {
    let window = loop_and_butterfly();
    assert_eq!((this(&window), other(&window)), (named("butterfly.vv", 0), named("loop.vv", 0)));
    let (left, right) = (window.get_by_label("Left viewport").rect(), window.get_by_label("Right viewport").rect());
    assert!(left.right() <= right.left() && left.width() > 100.0 && right.width() > 100.0);
    window.get_by_label("loop.vv on octahedron.obj, generation 0");
    window.get_by_label("butterfly.vv on octahedron.obj, generation 0, has the keys");
    // The panels are those of the document that has the keys.
    assert!(window.get_by_label("Program text").value().unwrap().contains("butterfly"));
}

#[test]
fn linked_documents_step_together_and_alone_otherwise() {
    let mut window = loop_and_butterfly();
    press(&mut window, Key::S);
    press(&mut window, Key::S);
    settle_both(&mut window);
    assert_eq!((this(&window).1, other(&window).1), (2, 2));
    let session = window.state().session();
    let positions = |s: &Session| s.frame().unwrap().mesh.positions().to_vec();
    assert_ne!(positions(session), positions(session.beside().unwrap().session()), "different schemes");
    pair(&mut window, PairAction::LinkSteps);
    press(&mut window, Key::ArrowLeft);
    settle_both(&mut window);
    assert_eq!((this(&window).1, other(&window).1), (1, 2));
}

#[test]
fn linked_views_turn_together_and_each_alone_otherwise() {
    let mut window = loop_and_butterfly();
    let [a, b] = cameras(&window);
    assert_eq!(a, b);
    let right = window.get_by_label("Right viewport").rect().center();
    window.drag_at(right);
    window.step();
    window.hover_at(right + egui::vec2(50.0, 10.0));
    window.step();
    window.drop_at(right + egui::vec2(50.0, 10.0));
    settle_both(&mut window);
    let [turned, with_it] = cameras(&window);
    assert!(turned != a && turned == with_it);
    window.key_press_modifiers(Modifiers::COMMAND, Key::L);
    settle_both(&mut window);
    window.state_mut().apply(Command::View(ViewAction::From(Side::Top)));
    let [alone, still] = cameras(&window);
    assert!(alone.side(Up::Y) == Some(Side::Top) && still == turned);
    pair(&mut window, PairAction::LinkViews);
    let [a, b] = cameras(&window);
    assert!(a == b && a == alone, "linked again, both look as the one with the keys");
}

#[test]
fn the_wheel_zooms_where_the_pointer_is_and_pressing_gives_the_keys() {
    let mut window = loop_and_butterfly();
    pair(&mut window, PairAction::LinkViews);
    let left = window.get_by_label("Left viewport").rect().center();
    let [this_before, other_before] = cameras(&window);
    window.hover_at(left);
    window.step();
    window.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        source: egui::MouseWheelSource::Wheel,
        delta: egui::vec2(0.0, 3.0),
        phase: egui::TouchPhase::Move,
        modifiers: Modifiers::NONE,
    });
    window.run_steps(10);
    let [a, b] = cameras(&window);
    assert!(a == this_before && b.distance < other_before.distance);
    assert_eq!(this(&window).0, "butterfly.vv");
    window.drag_at(left);
    window.step();
    window.drop_at(left);
    settle_both(&mut window);
    assert_eq!((this(&window).0, other(&window).0), ("loop.vv".to_owned(), "butterfly.vv".to_owned()));
    assert!(window.get_by_label("Program text").value().unwrap().contains("Loop"));
    window.key_press_modifiers(Modifiers::COMMAND, Key::F6);
    settle(&mut window);
    assert_eq!(this(&window).0, "butterfly.vv");
}

#[test]
fn undo_belongs_to_each_document() {
    let mut window = loop_and_butterfly();
    pair(&mut window, PairAction::LinkSteps);
    press(&mut window, Key::S);
    pair(&mut window, PairAction::Switch);
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle_both(&mut window);
    // What was done last at the left was to rewind from generation 2.
    assert_eq!((this(&window).1, other(&window).1), (2, 1));
    pair(&mut window, PairAction::Switch);
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle_both(&mut window);
    assert_eq!(this(&window), named("butterfly.vv", 0));
}

#[test]
fn what_linked_documents_did_together_is_undone_and_done_again_in_both() {
    let (step, undo, redo) =
        ((Modifiers::NONE, Key::S), (Modifiers::COMMAND, Key::Z), (Modifiers::COMMAND | Modifiers::SHIFT, Key::Z));
    #[track_caller]
    fn check(window: &mut Harness<'static, App>, (held, key): (Modifiers, Key), expected: (u64, u64)) {
        window.key_press_modifiers(held, key);
        settle_both(window);
        assert_eq!((this(window).1, other(window).1), expected);
    }
    let mut window = loop_and_butterfly();
    let window = &mut window;
    check(window, step, (1, 1));
    check(window, step, (2, 2));
    check(window, undo, (1, 1));
    check(window, redo, (2, 2));
    check(window, (Modifiers::COMMAND, Key::F6), (2, 2));
    check(window, undo, (1, 1));
    check(window, redo, (2, 2));
    // What only one did since, is undone there first, and it may be undone in one while both are not linked.
    pair(window, PairAction::LinkSteps);
    check(window, step, (3, 2));
    check(window, undo, (2, 2));
    check(window, undo, (1, 2));
    check(window, redo, (2, 2));
    check(window, step, (3, 2));
    pair(window, PairAction::LinkSteps);
    check(window, undo, (2, 2));
    check(window, undo, (1, 1));
}

#[test]
fn either_side_is_closed() {
    let mut window = loop_and_butterfly();
    window.key_press_modifiers(Modifiers::COMMAND, Key::W);
    settle_both(&mut window);
    assert!(window.state().session().beside().is_none());
    assert_eq!(this(&window).0, "loop.vv");
    window.get_by_label("Viewport");

    let mut window = loop_and_butterfly();
    window.get_by_label("Close loop.vv").click();
    settle_both(&mut window);
    assert!(window.state().session().beside().is_none());
    assert_eq!(this(&window).0, "butterfly.vv");
}

#[test]
fn what_is_unsaved_at_either_side_is_asked_about() {
    let mut window = loop_and_butterfly();
    window.state_mut().apply(Command::Edit("// mine".into()));
    settle_both(&mut window);
    window.key_press_modifiers(Modifiers::COMMAND, Key::W);
    window.run_steps(3);
    assert!(matches!(window.state().session().dialog, Some(Dialog::Unsaved { .. })));
    click(&mut window, "Cancel");
    assert!(window.state().session().beside().is_some());
    // To quit asks, too, though the unsaved text is not in the document that has the keys.
    pair(&mut window, PairAction::Switch);
    assert_eq!(this(&window).0, "loop.vv");
    window.key_press_modifiers(Modifiers::COMMAND, Key::Q);
    window.run_steps(3);
    assert_eq!(this(&window).0, "butterfly.vv");
    assert!(!window.state().session().wants_quit());
    click(&mut window, "Don't save");
    assert!(window.state().session().wants_quit());
}

#[test]
fn settings_are_those_of_the_window() {
    let mut window = loop_and_butterfly();
    window.state_mut().apply(Command::View(ViewAction::SetUp(Up::Z)));
    window.state_mut().apply(Command::SetSpeed(7.0));
    pair(&mut window, PairAction::Switch);
    let session = window.state().session();
    assert_eq!((session.navigation.up, session.speed), (Up::Z, 7.0));
}

#[test]
fn a_running_side_is_closed_at_once() {
    let mut window = loop_and_butterfly();
    window.state_mut().apply(Command::Edit("void f(mesh& S) { while (true) { } }".into()));
    window.state_mut().apply(Command::Run);
    window.state_mut().apply(Command::GoTo(1));
    until(&mut window, "it runs", |s| s.progress().is_some_and(|(_, stepping)| stepping == Some(1)));
    let began = Instant::now();
    window.state_mut().apply(Command::Pair(PairAction::Close));
    window.run_steps(3);
    window.get_by_label("Don't save").click();
    settle_both(&mut window);
    assert_eq!(this(&window).0, "loop.vv");
    assert!(began.elapsed() < Duration::from_secs(20));
}

#[test]
fn what_is_unsaved_at_both_sides_is_kept_for_the_case_of_a_crash_and_not_once_it_is_closed() {
    let folder = tempfile::tempdir().unwrap();
    let store = app::store::Store::open(folder.path()).unwrap();
    let mut window = Harness::builder()
        .with_size(egui::vec2(1000.0, 700.0))
        .wgpu()
        .build_eframe(|cc| App::with_store(cc, None, None, Some(store)).unwrap());
    window.state_mut().apply(Command::CloseDialog);
    window.state_mut().apply(Command::Edit("// left".into()));
    pair(&mut window, PairAction::Compare);
    window.state_mut().apply(Command::Edit("// right".into()));
    let kept = || {
        let files = std::fs::read_dir(folder.path().join("recovery")).unwrap().map(|f| f.unwrap().path());
        let texts = files.filter(|p| p.extension().is_some_and(|e| e == "json"));
        let mut texts: Vec<_> = texts.filter_map(|p| std::fs::read_to_string(p).ok()).collect();
        texts.sort();
        texts
    };
    let holds = |text: &str| kept().iter().any(|kept| kept.contains(text));
    until(&mut window, "both are kept", |_| holds("// left") && holds("// right"));
    window.state_mut().apply(Command::Pair(PairAction::Close));
    window.state_mut().apply(Command::AnswerUnsaved(app::command::Answer::Discard));
    until(&mut window, "the right one is forgotten", |_| holds("// left") && !holds("// right") && kept().len() == 1);
}

#[test]
fn each_document_has_a_cursor_and_an_undo_of_its_own() {
    let mut window = loop_and_butterfly();
    let text = |window: &Harness<'static, App>| window.state().session().document.program.text.to_string();
    let originals = [text(&window), {
        pair(&mut window, PairAction::Switch);
        text(&window)
    }];
    pair(&mut window, PairAction::Switch);
    let field = |window: &Harness<'static, App>| window.get_by_label("Program text").value().unwrap();
    // At the end of the one, at the beginning of the other.
    window.get_by_label("Program text").focus();
    window.step();
    let ctrl = Modifiers::COMMAND | Modifiers::CTRL;
    window.key_press_modifiers(ctrl, Key::End);
    window.step();
    window.get_by_label("Program text").type_text("1");
    settle_both(&mut window);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F6);
    settle(&mut window);
    window.key_press_modifiers(ctrl, Key::Home);
    window.step();
    window.get_by_label("Program text").type_text("2");
    settle_both(&mut window);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F6);
    settle(&mut window);
    window.get_by_label("Program text").type_text("3");
    settle_both(&mut window);
    assert_eq!(field(&window), format!("{}13", originals[0]));
    window.key_press_modifiers(Modifiers::COMMAND, Key::F6);
    settle(&mut window);
    window.get_by_label("Program text").type_text("4");
    settle_both(&mut window);
    assert_eq!(field(&window), format!("24{}", originals[1]));
    // Each takes back what was typed there.
    for _ in 0..4 {
        window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        settle_both(&mut window);
        if text(&window) == originals[1] {
            break;
        }
    }
    assert_eq!(field(&window), originals[1]);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F6);
    settle(&mut window);
    assert_eq!(field(&window), format!("{}13", originals[0]));
}
