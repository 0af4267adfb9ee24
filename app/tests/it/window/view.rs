//! The camera: sides, hands, keys, viewpoints as text and under names.

use super::*;
use app::camera::{Camera, Side, Up};
use app::command::ViewAction;
use app::navigation::{Preset, Turning};
use eframe::egui::PointerButton;

fn camera(window: &Harness<'static, App>) -> Camera {
    window.state().session().document.camera
}

fn view(window: &mut Harness<'static, App>, action: ViewAction) {
    window.state_mut().apply(Command::View(action));
    settle(window);
}

fn press_with(window: &mut Harness<'static, App>, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    settle(window);
}

/// Drags a button over the picture.
fn drag(window: &mut Harness<'static, App>, button: PointerButton, modifiers: Modifiers, by: egui::Vec2) {
    let middle = window.get_by_label("Viewport").rect().center();
    let press = |pos, pressed| egui::Event::PointerButton { pos, button, pressed, modifiers };
    window.hover_at(middle);
    window.event_modifiers(press(middle, true), modifiers);
    window.step();
    for i in 1..=4 {
        let pos = middle + by * (i as f32 / 4.0);
        window.event_modifiers(egui::Event::PointerMoved(pos), modifiers);
        window.step();
    }
    window.event_modifiers(press(middle + by, false), modifiers);
    settle(window);
}

const ALT: Modifiers = Modifiers::ALT;

#[test]
fn sides_are_looked_from_by_menu_and_by_keys() {
    let mut window = octahedron();
    view(&mut window, ViewAction::Nearer); // what just fits would be fitted from each side
    let before = camera(&window);
    choose(&mut window, "Camera", "Top");
    assert_eq!(camera(&window).side(Up::Y), Some(Side::Top));
    let ctrl_alt = Modifiers::COMMAND | ALT;
    for (modifiers, key, side) in [
        (ALT, Key::Num1, Side::Front),
        (ctrl_alt, Key::Num1, Side::Back),
        (ALT, Key::Num3, Side::Right),
        (ctrl_alt, Key::Num3, Side::Left),
        (ALT, Key::Num7, Side::Top),
        (ctrl_alt, Key::Num7, Side::Bottom),
        (ALT, Key::Num0, Side::Isometric),
    ] {
        press_with(&mut window, modifiers, key);
        assert_eq!(camera(&window).side(Up::Y), Some(side));
    }
    assert_eq!((camera(&window).pivot, camera(&window).distance), (before.pivot, before.distance));
    assert_eq!(window.state().session().document.generation, 0, "digits with Alt walk no generations");
    view(&mut window, ViewAction::SetUp(Up::Z));
    press_with(&mut window, ALT, Key::Num1);
    assert_eq!(camera(&window).side(Up::Z), Some(Side::Front));
}

#[test]
fn what_is_seen_whole_is_seen_whole_in_parallel_lines_and_from_all_sides() {
    use super::inspecting::{known, seen};
    let mut window = octahedron();
    known(&mut window);
    let is_whole = |window: &Harness<'static, App>| {
        let picture = window.get_by_label("Viewport").rect();
        let frame = window.state().session().frame().unwrap();
        frame.mesh.positions().iter().all(|&p| picture.contains(seen(window, p)))
    };
    assert!(is_whole(&window));
    for action in [ViewAction::Orthographic, ViewAction::Orthographic]
        .into_iter()
        .chain([Side::Top, Side::Front, Side::Left, Side::Bottom].map(ViewAction::From))
        .chain([ViewAction::Orthographic])
        .chain([Side::Top, Side::Isometric, Side::Right].map(ViewAction::From))
    {
        view(&mut window, action.clone());
        known(&mut window);
        assert!(is_whole(&window), "{action:?}");
    }
    // So it is in a window of another size …
    view(&mut window, ViewAction::Orthographic);
    window.state_mut().apply(Command::Fit);
    known(&mut window);
    window.set_size(egui::vec2(760.0, 700.0));
    window.run_steps(3);
    known(&mut window);
    assert!(is_whole(&window));
    // … but who has come nearer stays near.
    view(&mut window, ViewAction::Nearer);
    view(&mut window, ViewAction::Nearer);
    known(&mut window);
    let near = camera(&window).distance;
    view(&mut window, ViewAction::Orthographic);
    view(&mut window, ViewAction::From(Side::Top));
    window.set_size(egui::vec2(1000.0, 700.0));
    window.run_steps(3);
    known(&mut window);
    assert_eq!(camera(&window).distance, near);
}

#[test]
fn parallel_lines_are_switched_on_and_off_and_picked_through() {
    let mut window = octahedron();
    press_with(&mut window, ALT, Key::Num1);
    press_with(&mut window, ALT, Key::Num5);
    assert!(camera(&window).orthographic);
    let middle = window.get_by_label("Viewport").rect().center();
    // A double click right of the middle makes the point of the surface there the pivot.
    let at = middle + egui::vec2(30.0, 0.0);
    window.hover_at(at);
    window.step();
    for pressed in [true, false, true, false] {
        let button = PointerButton::Primary;
        // All in one frame: frames of tests are too slow for a double click.
        let event = egui::Event::PointerButton { pos: at, button, pressed, modifiers: Modifiers::NONE };
        window.input_mut().events.push(event);
    }
    settle(&mut window);
    let pivot = camera(&window).pivot;
    assert!(pivot.z > 0.5 && (pivot.element_sum() - 1.0).abs() < 1e-6, "on the face in front: {pivot}");
    press_with(&mut window, ALT, Key::Num5);
    assert!(!camera(&window).orthographic);
}

#[test]
fn keys_go_around_shift_and_zoom_and_leave_the_arrows_to_the_generations() {
    let mut window = octahedron();
    press_with(&mut window, ALT, Key::Num1);
    let front = camera(&window);
    for _ in 0..6 {
        press_with(&mut window, Modifiers::SHIFT, Key::ArrowRight);
    }
    assert_eq!(camera(&window).side(Up::Y), Some(Side::Right), "six steps are a quarter");
    for _ in 0..6 {
        press_with(&mut window, ALT, Key::Num4);
    }
    press_with(&mut window, Modifiers::COMMAND, Key::ArrowUp);
    let shifted = camera(&window);
    assert!(shifted.pivot.y < front.pivot.y && shifted.side(Up::Y) == Some(Side::Front));
    press(&mut window, Key::Plus);
    assert!(camera(&window).distance < shifted.distance);
    press(&mut window, Key::Minus);
    assert!((camera(&window).distance / shifted.distance - 1.0).abs() < 1e-9);
    assert_eq!(window.state().session().document.generation, 0);
    press(&mut window, Key::ArrowRight);
    assert_eq!(window.state().session().document.generation, 1);
}

#[test]
fn a_viewpoint_goes_by_the_clipboard_to_another_window() {
    let mut window = octahedron();
    press_with(&mut window, Modifiers::SHIFT, Key::ArrowUp);
    press_with(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::C);
    assert_eq!(window.state().session().notice().unwrap().1, "viewpoint copied");
    window.state_mut().apply(Command::View(ViewAction::Copy));
    window.step();
    let copied = window.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    let text = copied.expect("nothing was copied");
    assert!(text.starts_with("vv view: eye ") && text.contains(" perspective 28.6479"), "{text}");

    let mut other = octahedron();
    assert!(camera(&other).eye().distance(camera(&window).eye()) > 0.1);
    press_with(&mut other, Modifiers::COMMAND | Modifiers::SHIFT, Key::V);
    assert!(other.state().session().awaits_viewpoint());
    other.state_mut().apply(Command::View(ViewAction::Paste));
    other.step();
    let asks = |o: &egui::ViewportOutput| o.commands.contains(&egui::ViewportCommand::RequestPaste);
    assert!(other.output().viewport_output.values().any(asks), "the clipboard is asked");
    other.event(egui::Event::Paste(text));
    settle(&mut other);
    assert!(camera(&other).eye().distance(camera(&window).eye()) < 1e-4);
}

#[test]
fn what_is_no_viewpoint_is_told_where() {
    let mut window = octahedron();
    let before = camera(&window);
    window.state_mut().apply(Command::View(ViewAction::Paste));
    window.step();
    window.event(egui::Event::Paste("eye 1 2 x".to_owned()));
    settle(&mut window);
    let notice = window.state().session().notice().unwrap().1.to_owned();
    assert_eq!(notice, "what was copied is no viewpoint: column 9: `eye` is followed by three numbers");
    assert_eq!(camera(&window), before);
}

#[test]
fn a_viewpoint_that_was_not_asked_for_is_text_in_the_editor() {
    let mut window = octahedron();
    let before = camera(&window);
    window.get_by_label("Program text").focus();
    window.step();
    window.event(egui::Event::Paste("vv view: front".to_owned()));
    settle(&mut window);
    assert!(window.state().session().document.program.text.contains("vv view: front"));
    assert_eq!(camera(&window), before);
}

#[test]
fn hands_are_those_of_the_preset() {
    let mut window = octahedron();
    let by = egui::vec2(50.0, 20.0);
    for (preset, button, modifiers, what) in [
        (Preset::Vv, PointerButton::Primary, Modifiers::NONE, "turn"),
        (Preset::Vv, PointerButton::Secondary, Modifiers::NONE, "shift"),
        (Preset::Blender, PointerButton::Primary, Modifiers::NONE, ""),
        (Preset::Blender, PointerButton::Middle, Modifiers::NONE, "turn"),
        (Preset::Blender, PointerButton::Middle, Modifiers::SHIFT, "shift"),
        (Preset::Blender, PointerButton::Middle, Modifiers::COMMAND | Modifiers::CTRL, "zoom"),
        (Preset::Maya, PointerButton::Primary, ALT, "turn"),
        (Preset::Maya, PointerButton::Middle, ALT, "shift"),
        (Preset::Maya, PointerButton::Secondary, ALT, "zoom"),
    ] {
        view(&mut window, ViewAction::SetPreset(preset));
        press(&mut window, Key::F);
        let before = camera(&window);
        drag(&mut window, button, modifiers, by);
        let after = camera(&window);
        let turned = after.world_from_view.angle_between(before.world_from_view) > 0.01;
        let zoomed = (after.distance / before.distance - 1.0).abs() > 0.01;
        let shifted = after.pivot.distance(before.pivot) > 0.01 && !zoomed;
        assert_eq!(
            (turned, shifted, zoomed),
            (what == "turn", what == "shift", what == "zoom"),
            "{preset:?} {button:?}"
        );
    }
}

#[test]
fn a_drag_goes_on_outside_the_window() {
    let mut window = octahedron();
    let before = camera(&window);
    drag(&mut window, PointerButton::Primary, Modifiers::NONE, egui::vec2(-900.0, 0.0));
    let angle = camera(&window).world_from_view.angle_between(before.world_from_view);
    assert!(angle > 1.2, "{angle}");
}

#[test]
fn the_turntable_stays_upright() {
    let mut window = octahedron();
    drag(&mut window, PointerButton::Primary, Modifiers::NONE, egui::vec2(120.0, 100.0));
    let upright = |window: &_| (camera(window).world_from_view * glam::DVec3::X).y.abs() < 1e-9;
    assert!(!upright(&window));
    choose(&mut window, "Camera", "Navigation");
    click(&mut window, "Turntable");
    assert_eq!(window.state().session().navigation.turning, Turning::Turntable);
    assert!(upright(&window));
    drag(&mut window, PointerButton::Primary, Modifiers::NONE, egui::vec2(120.0, 100.0));
    assert!(upright(&window));
}

#[test]
fn two_fingers_turn_and_with_shift_they_shift() {
    let mut window = octahedron();
    let middle = window.get_by_label("Viewport").rect().center();
    let scroll = |window: &mut Harness<'static, App>, modifiers| {
        let before = camera(window);
        window.hover_at(middle);
        let event = egui::Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            source: egui::MouseWheelSource::Trackpad,
            delta: egui::vec2(30.0, 12.0),
            phase: egui::TouchPhase::Move,
            modifiers,
        };
        window.event_modifiers(event, modifiers);
        window.run_steps(3);
        (before, camera(window))
    };
    let (before, after) = scroll(&mut window, Modifiers::NONE);
    assert!(after.world_from_view.angle_between(before.world_from_view) > 0.05);
    assert_eq!(after.distance, before.distance);
    let (before, after) = scroll(&mut window, Modifiers::SHIFT);
    assert!(after.pivot.distance(before.pivot) > 0.01 && after.world_from_view == before.world_from_view);
}

#[test]
fn viewpoints_are_kept_under_names_and_saved_with_the_project() {
    let mut window = octahedron();
    press_with(&mut window, ALT, Key::Num1);
    let front = camera(&window);
    view(&mut window, ViewAction::Save("front page".to_owned()));
    press_with(&mut window, ALT, Key::Num7);
    choose(&mut window, "Camera", "Saved viewpoints");
    click(&mut window, "front page");
    assert_eq!(camera(&window), front);
    let document = window.state().session().document.clone();
    let bytes = app::project::Project::of(&document).to_json(None).unwrap();
    let back = app::project::Project::from_json(&bytes, None).unwrap().into_document();
    assert_eq!(back.views, document.views);
    view(&mut window, ViewAction::Forget("front page".to_owned()));
    assert!(window.state().session().document.views.is_empty());
}

#[test]
fn the_sheet_of_keys_shows_the_hands_of_the_preset() {
    let mut window = octahedron();
    view(&mut window, ViewAction::SetPreset(Preset::Blender));
    press(&mut window, Key::H);
    window.get_by_label("Find a key").type_text("middle drag");
    window.run_steps(3);
    window.get_by_label("Ctrl + middle drag");
    assert!(window.query_by_label("left drag").is_none());
}

#[test]
fn a_viewpoint_is_glided_to_where_that_is_wanted() {
    let mut window = octahedron();
    window.state_mut().apply(Command::View(ViewAction::Gliding));
    let from = camera(&window);
    window.state_mut().apply(Command::View(ViewAction::From(Side::Back)));
    window.step();
    let (aim, now) = (window.state().session().aim(), camera(&window));
    assert_eq!(aim.side(Up::Y), Some(Side::Back));
    assert!(window.state().session().glides() && now != aim);
    assert!(
        now.world_from_view.angle_between(from.world_from_view)
            < aim.world_from_view.angle_between(from.world_from_view)
    );
    until(&mut window, "it has arrived", |session| !session.glides());
    assert_eq!(camera(&window), aim);
}

#[test]
fn render_options_open_over_the_picture_and_go_by_escape() {
    let mut window = octahedron();
    window.state_mut().apply(Command::Toggle(app::command::Panel::Inspector));
    press(&mut window, Key::R);
    window.run_steps(3);
    window.get_by_label("Render options");
    click(&mut window, "Smooth");
    click(&mut window, "Orthographic");
    assert!(window.state().session().document.style.smooth && camera(&window).orthographic);
    press(&mut window, Key::Escape);
    window.run_steps(2);
    assert!(window.query_by_label("Render options").is_none());
}

/// A picture of a large mesh takes longer than a key is held.
#[test]
fn what_counts_is_what_was_held_when_a_key_was_pressed() {
    let mut window = octahedron();
    let modifiers = Modifiers::COMMAND | Modifiers::SHIFT;
    for pressed in [true, false] {
        let event = egui::Event::Key { key: Key::C, physical_key: None, pressed, repeat: false, modifiers };
        window.input_mut().events.push(event); // and at the end of the frame nothing is held any more
    }
    settle(&mut window);
    assert_eq!(window.state().session().notice().unwrap().1, "viewpoint copied");
}

#[test]
fn with_the_hands_of_blender_digits_are_the_keypad() {
    let mut window = octahedron();
    press(&mut window, Key::Num1);
    assert_eq!(window.state().session().document.generation, 1, "a digit is a generation");
    view(&mut window, ViewAction::SetPreset(Preset::Blender));
    let side = |window: &Harness<'static, App>| window.state().session().aim().side(Up::Y);
    let keys = [
        (Modifiers::NONE, Key::Num1, Side::Front),
        (Modifiers::COMMAND, Key::Num1, Side::Back),
        (Modifiers::NONE, Key::Num3, Side::Right),
        (Modifiers::COMMAND, Key::Num3, Side::Left),
        (Modifiers::NONE, Key::Num7, Side::Top),
        (Modifiers::COMMAND, Key::Num7, Side::Bottom),
    ];
    for (modifiers, key, expected) in keys {
        window.key_press_modifiers(modifiers, key);
        settle(&mut window);
        assert_eq!(side(&window), Some(expected));
    }
    assert_eq!(window.state().session().document.generation, 1);
    assert!(window.state().session().panels.program && window.state().session().panels.inspector);
    press(&mut window, Key::Num5);
    assert!(window.state().session().aim().orthographic);
    view(&mut window, ViewAction::Farther);
    let far = window.state().session().aim().distance;
    press(&mut window, Key::Period);
    assert!(window.state().session().aim().distance < far, "all of it");
    window.state_mut().apply(Command::CheatSheet);
    window.run_steps(4);
    window.get_by_label("Digits and keypad");
}

const GROWS: &str = "param double by = 1.5 in [1, 9];\nvoid grow(mesh& S) { forall v in S v$pos *= by; }\n";

#[track_caller]
fn check_whole(window: &mut Harness<'static, App>) {
    inspecting::known(window);
    let picture = window.get_by_label("Viewport").rect();
    let frame = window.state().session().frame().unwrap().clone();
    let outside = frame.mesh.positions().iter().find(|&&p| !picture.contains(inspecting::seen(window, p)));
    assert_eq!(outside, None);
}

#[test]
fn a_mesh_that_grows_out_of_the_picture_takes_the_camera_with_it_and_back() {
    let mut window = octahedron();
    window.state_mut().apply(Command::Control);
    write(&mut window, GROWS);
    window.state_mut().apply(Command::Rewind);
    window.state_mut().apply(Command::Fit);
    inspecting::known(&mut window);
    let first = camera(&window);
    for _ in 0..4 {
        window.state_mut().apply(Command::Step);
        check_whole(&mut window);
    }
    let far = camera(&window);
    assert!(far.distance > 4.0 * first.distance && far.world_from_view == first.world_from_view);
    // Back where it is as small as before it is looked at as before.
    window.state_mut().apply(Command::Rewind);
    check_whole(&mut window);
    assert_eq!(camera(&window), first);
    // Parameters make it grow, too.
    window.state_mut().apply(Command::Step);
    window.state_mut().apply(Command::SetParam("by".to_owned(), vv::mesh::Value::Double(8.0)));
    check_whole(&mut window);
    window.state_mut().apply(Command::SetParam("by".to_owned(), vv::mesh::Value::Double(1.0)));
    check_whole(&mut window);
    assert_eq!(camera(&window), first);
}

#[test]
fn who_turns_a_mesh_that_grows_is_led_back_on_the_side_he_came_to() {
    let mut window = octahedron();
    write(&mut window, GROWS);
    window.state_mut().apply(Command::Rewind);
    window.state_mut().apply(Command::Fit);
    inspecting::known(&mut window);
    view(&mut window, ViewAction::Farther); // it is whole from all sides
    for _ in 0..6 {
        window.state_mut().apply(Command::Step);
        check_whole(&mut window);
    }
    for _ in 0..3 {
        view(&mut window, ViewAction::Turn(app::command::Toward::Right));
    }
    view(&mut window, ViewAction::Orthographic);
    let far = camera(&window);
    window.state_mut().apply(Command::Rewind);
    check_whole(&mut window);
    let back = camera(&window);
    assert!(back.distance < far.distance / 4.0, "{} {}", back.distance, far.distance);
    assert_eq!((back.world_from_view, back.orthographic), (far.world_from_view, true));
}

#[test]
fn a_mesh_that_shrinks_is_seen_to_shrink() {
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    window.state_mut().apply(Command::ChooseRule("shrink".to_owned()));
    inspecting::known(&mut window);
    let before = camera(&window);
    window.state_mut().apply(Command::Step);
    inspecting::known(&mut window);
    assert_eq!(camera(&window), before);
}

#[test]
fn who_has_come_nearer_stays_there_while_the_mesh_grows() {
    let mut window = octahedron();
    write(&mut window, GROWS);
    inspecting::known(&mut window);
    for _ in 0..3 {
        view(&mut window, ViewAction::Nearer);
    }
    let near = camera(&window);
    window.state_mut().apply(Command::Step);
    inspecting::known(&mut window);
    assert_eq!(camera(&window), near);
}

#[test]
fn a_mesh_that_is_out_of_sight_is_offered() {
    let mut window = octahedron();
    inspecting::known(&mut window);
    let whole = camera(&window);
    assert!(window.query_by_label("the mesh is out of sight").is_none());
    for _ in 0..12 {
        view(&mut window, ViewAction::Shift(app::command::Toward::Right));
    }
    window.get_by_label("the mesh is out of sight");
    click(&mut window, "Fit view (F)");
    inspecting::known(&mut window);
    assert!(window.query_by_label("the mesh is out of sight").is_none());
    assert_eq!(camera(&window).distance, whole.distance);
}

#[test]
fn a_picture_between_the_mesh_and_its_control_mesh_shows_neither() {
    let mut window = octahedron();
    write(&mut window, "void aside(mesh& S) { forall v in S v$pos.x += 20; }\n");
    window.state_mut().apply(Command::Rewind);
    window.state_mut().apply(Command::Step);
    inspecting::known(&mut window);
    view(&mut window, ViewAction::From(Side::Front));
    window.state_mut().apply(Command::Fit);
    inspecting::known(&mut window);
    assert!(window.query_by_label("the mesh is out of sight").is_none());
    for _ in 0..12 {
        view(&mut window, ViewAction::Nearer);
    }
    window.get_by_label("the mesh is out of sight");
}

#[test]
fn render_options_open_beside_a_small_picture() {
    let mut window = octahedron();
    window.set_size(egui::vec2(900.0, 600.0));
    window.run_steps(3);
    press(&mut window, Key::R);
    window.run_steps(3);
    let picture = window.get_by_label("Viewport").rect();
    let options: Vec<_> = window.get_all_by_label("Orthographic").map(|node| node.rect()).collect();
    assert!(options.iter().all(|option| !option.intersects(picture)), "{options:?} over {picture}");
}
