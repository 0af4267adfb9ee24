//! What a right click offers, and menus by the keys.

use app::command::Inspect;
use app::inspect::selection::Item;
use glam::DVec3;

use super::inspecting::{known, on, seen, v};
use super::*;

const PLANE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
const TWICE: &str = "void f(mesh& S) {\n  forall v in S { print(\"moved \", v, \" by \", 2); v$pos *= 0.5; }\n\
                     print(\"done\");\n}\n";
/// In the middle of the face v1 v2 v5, nearest to v1.
const FACE: DVec3 = DVec3::new(0.3, 0.15, 0.0);

fn right_click(window: &mut Harness<'static, App>, at: egui::Pos2) {
    window.hover_at(at);
    window.step();
    for pressed in [true, false] {
        let (button, modifiers) = (egui::PointerButton::Secondary, Modifiers::NONE);
        window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
        window.step();
    }
    window.run_steps(3);
}

fn right_click_on(window: &mut Harness<'static, App>, p: DVec3) {
    let at = seen(window, p);
    right_click(window, at);
}

/// Chooses an entry; what it puts on the clipboard.
fn copied(window: &mut Harness<'static, App>, entry: &str) -> Option<String> {
    window.get_by_label(entry).click();
    for _ in 0..4 {
        window.step();
        let text = window.output().platform_output.commands.iter().find_map(|command| match command {
            egui::OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        });
        if text.is_some() {
            return text;
        }
    }
    None
}

fn selected(window: &Harness<'static, App>) -> Vec<Item> {
    window.state().session().selected()
}

fn position(window: &Harness<'static, App>, number: usize) -> DVec3 {
    window.state().session().frame().unwrap().mesh.position(v(number))
}

#[test]
fn a_right_click_on_a_vertex_offers_what_can_be_done_with_it() {
    let (mut window, _folder) = on(PLANE, TWICE);
    let at = position(&window, 3);
    right_click_on(&mut window, at);
    assert_eq!(selected(&window), [], "nothing is done before something is chosen");
    window.get_by_label("v3");
    assert!(window.get_by_label("Show its mask").accesskit_node().is_disabled(), "no step made it");
    click(&mut window, "Show its ring");
    assert_eq!(selected(&window), [Item::Vertex(v(3))]);
    right_click_on(&mut window, at);
    click(&mut window, "Centre here");
    known(&mut window);
    assert_eq!(window.state().session().document.camera.pivot, at);
    right_click_on(&mut window, at);
    assert_eq!(copied(&mut window, "Copy name").as_deref(), Some("v3"));
    right_click_on(&mut window, at);
    assert_eq!(copied(&mut window, "Copy position").as_deref(), Some("vec(1, 1, 0)"));
    press(&mut window, Key::S);
    known(&mut window);
    let at = position(&window, 3);
    right_click_on(&mut window, at);
    click(&mut window, "Show its mask");
    assert!(window.state().session().inspection.mask);
}

#[test]
fn it_is_measured_from_a_vertex_to_the_next_that_is_clicked() {
    let (mut window, _folder) = on(PLANE, TWICE);
    let [from, to] = [1, 2].map(|number| position(&window, number));
    right_click_on(&mut window, from);
    click(&mut window, "Measure from here");
    assert!(window.state().session().inspection.measuring);
    // Near it is enough.
    let at = seen(&window, to) + egui::vec2(-20.0, -9.0);
    window.hover_at(at);
    window.step();
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    known(&mut window);
    assert_eq!(selected(&window), [Item::Vertex(v(1)), Item::Vertex(v(2))]);
    assert!(!window.state().session().inspection.measuring);
    window.get_by(|node| node.label().as_deref() == Some("Distance") && node.value().as_deref() == Some("1"));
    press(&mut window, Key::Escape);
    right_click_on(&mut window, from);
    click(&mut window, "Measure from here");
    press(&mut window, Key::Escape);
    assert!(!window.state().session().inspection.measuring, "Esc ends it");
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(v(4)))));
    right_click_on(&mut window, from);
    click(&mut window, "Measure from v4 to here");
    assert_eq!(selected(&window), [Item::Vertex(v(4)), Item::Vertex(v(1))]);
}

#[test]
fn a_right_click_knows_edges_and_faces_and_where_there_is_nothing() {
    let (mut window, _folder) = on(PLANE, TWICE);
    right_click_on(&mut window, FACE);
    window.get_by_label("face v1 v2 v5");
    click(&mut window, "Walk this face");
    let walk = window.state().session().inspection.walk.clone().unwrap().walk;
    assert_eq!(walk.path, [v(1), v(5), v(2), v(1)]);
    right_click_on(&mut window, DVec3::new(0.5, 0.0, 0.0));
    window.get_by_label("edge v1–v2");
    assert_eq!(copied(&mut window, "Copy names").as_deref(), Some("v1 v2"));
    press(&mut window, Key::Escape);
    let corner = window.get_by_label("Viewport").rect().center_top() + egui::vec2(0.0, 12.0);
    right_click(&mut window, corner);
    assert!(window.query_by_label("Centre here").is_none());
    window.get_by_label("Copy image");
}

#[test]
fn names_stay_in_the_picture_while_generations_go_by() {
    let (mut window, _folder) = on(PLANE, TWICE);
    right_click_on(&mut window, FACE);
    click(&mut window, "Names here");
    press(&mut window, Key::S);
    known(&mut window);
    assert_eq!(window.state().session().named(), [Item::Face([v(1), v(2)])]);
    right_click_on(&mut window, 0.5 * FACE);
    click(&mut window, "No names here");
    assert_eq!(window.state().session().named(), []);
}

#[test]
fn what_is_before_a_place_is_cut_away() {
    let mut window = octahedron();
    known(&mut window);
    window.state_mut().apply(Command::View(app::command::ViewAction::From(app::camera::Side::Front)));
    known(&mut window);
    right_click_on(&mut window, DVec3::new(0.2, 0.3, 0.5));
    click(&mut window, "Cut away what is before it");
    let cut = window.state().session().document.style.cut;
    assert!(
        cut.on && cut.across == app::scene::Axis::Z && !cut.flipped && (cut.position - 0.5).abs() < 1e-3,
        "{cut:?}"
    );
}

#[test]
fn a_finding_is_reached_from_the_picture_copied_and_seen_with_its_kind_alone() {
    let obj =
        format!("{PLANE}v 3 0 0\nv 4 0 0\nv 4 1 0.5\nv 3 1 0\nf 6 7 8 9\nv 0 3 0\nv 1 3 0\nv 2 3 0\nf 10 11 12\n");
    let (mut window, _folder) = on(&obj, TWICE);
    right_click_on(&mut window, DVec3::new(3.4, 0.4, 0.1));
    click(&mut window, "Show in the Mesh tab");
    assert!(window.state().session().inspection.listing);
    assert_eq!(selected(&window), [Item::Face([v(6), v(7)])]);
    let line = "7.36 %  face v6 v7 v8 v9";
    let at = window.get_by_label(line).rect().center();
    right_click(&mut window, at);
    assert_eq!(copied(&mut window, "Copy line").as_deref(), Some(line));
    window.get_by_label("1 degenerate face");
    right_click(&mut window, at);
    click(&mut window, "Only faces that are not plane");
    assert!(window.query_by_label("1 degenerate face").is_none());
    click(&mut window, "Show all");
    window.get_by_label("1 degenerate face");
    let before = window.state().session().document.camera;
    right_click(&mut window, at);
    click(&mut window, "Fly there");
    known(&mut window);
    assert_ne!(window.state().session().document.camera, before);
}

#[test]
fn printed_lines_are_copied_filtered_and_lead_to_their_vertices() {
    let (mut window, _folder) = on(PLANE, TWICE);
    press(&mut window, Key::S);
    known(&mut window);
    click(&mut window, "Console");
    let line = |window: &Harness<'static, App>, text: &str| window.query_by_label(text).map(|n| n.rect().center());
    let at = line(&window, "done").unwrap();
    right_click(&mut window, at);
    assert_eq!(copied(&mut window, "Copy line").as_deref(), Some("done"));
    let at = line(&window, "moved v4 by 2").unwrap();
    right_click(&mut window, at);
    click(&mut window, "Fly to v4");
    assert_eq!(selected(&window), [Item::Vertex(v(4))]);
    known(&mut window);
    right_click(&mut window, at);
    click(&mut window, "Only lines like this");
    assert!(line(&window, "done").is_none() && line(&window, "moved v4 by 2").is_some());
    window.get_by_label("Filter lines").focus();
    window.step();
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.step();
    window.get_by_label("Filter lines").type_text("V5 b");
    window.run_steps(3);
    assert!(line(&window, "moved v4 by 2").is_none() && line(&window, "moved v5 by 2").is_some());
}

#[test]
fn the_value_of_a_property_is_copied_and_colours_the_mesh() {
    let program = "vertex { double heat = 0.5; };\nvoid f(mesh& S) { forall v in S v$heat = v$pos.x; }\n";
    let (mut window, _folder) = on(PLANE, program);
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(v(1)))));
    press(&mut window, Key::S);
    known(&mut window);
    let of = |name: &str| {
        let name = name.to_owned();
        move |window: &Harness<'static, App>| {
            window.get_by(|node| node.label().as_deref() == Some(&name) && node.value().is_some()).rect().center()
        }
    };
    let at = of("pos")(&window);
    right_click(&mut window, at);
    assert_eq!(copied(&mut window, "Copy name and value").as_deref(), Some("pos (0, 0, 0)"));
    let at = of("heat")(&window);
    right_click(&mut window, at);
    click(&mut window, "Colour by it");
    assert_eq!(window.state().session().document.annotations.color_by.to_string(), "heat");
}

fn has_keys(window: &Harness<'static, App>) -> Option<String> {
    let node = window.query_all_by(|node| node.is_focused()).next()?;
    node.accesskit_node().label()
}

#[test]
fn menus_are_opened_and_walked_by_the_keys() {
    let mut window = octahedron();
    window.get_by_label("Program text").focus();
    window.step();
    window.key_press_modifiers(Modifiers::ALT, Key::R);
    window.run_steps(4);
    assert_eq!(has_keys(&window).as_deref(), Some("Step"));
    window.key_press(Key::ArrowUp);
    window.run_steps(2);
    assert_eq!(has_keys(&window).as_deref(), Some("Run by hand"), "up from the first is the last");
    window.key_press(Key::ArrowDown);
    window.run_steps(2);
    press(&mut window, Key::Enter);
    assert_eq!(faces(&window), 32, "it was carried out");
    window.run_steps(3);
    assert!(window.query_by_label("Run by hand").is_none(), "and the menu is gone");
    assert_eq!(has_keys(&window).as_deref(), Some("Program text"), "the keys are where they were");

    window.key_press(Key::F10);
    window.run_steps(4);
    window.get_by_label("New program");
    window.key_press(Key::ArrowRight);
    window.run_steps(4);
    assert!(window.query_by_label("New program").is_none(), "to the next menu");
    window.key_press(Key::ArrowLeft);
    window.run_steps(4);
    press(&mut window, Key::Escape);
    window.run_steps(3);
    assert!(window.query_by_label("New program").is_none());
    assert_eq!(faces(&window), 32, "arrows meant the menu alone");
}

#[test]
fn each_menu_of_the_bar_has_a_letter_of_its_own() {
    let mut window = octahedron();
    press(&mut window, Key::Escape);
    let letters = [
        (Key::F, "New program"),
        (Key::X, "Gallery…"),
        (Key::M, "No mesh"),
        (Key::E, "Undo"),
        (Key::R, "Run again"),
        (Key::V, "Dark theme"),
        (Key::S, "Butterfly"),
        (Key::C, "From behind"),
        (Key::I, "Walk on"),
        (Key::O, "Isophotes"),
        (Key::H, "Language reference"),
    ];
    for (letter, entry) in letters {
        window.key_press_modifiers(Modifiers::ALT, letter);
        window.run_steps(4);
        assert!(window.query_by_label(entry).is_some(), "{letter:?} shows {entry}");
    }
}

#[test]
fn a_menu_that_has_no_room_is_scrolled_by_keys_and_wheel_and_never_covers_the_bar() {
    for (size, menu, first, last) in [
        ((900.0, 600.0), "Show", "No colours", "Isophotes"),
        ((900.0, 600.0), "Meshes", "tetrahedron.obj", "No mesh"),
        ((640.0, 420.0), "View", "Render options", "Compare"),
    ] {
        let mut window = octahedron();
        window.set_size(egui::vec2(size.0, size.1));
        window.run_steps(3);
        let bar = window.get_by_label(menu).rect();
        let in_sight = |window: &Harness<'static, App>, name: &str| {
            let entry = window.get_by_label(name).rect();
            entry.top() >= bar.bottom() && entry.bottom() <= size.1
        };
        let open = |window: &mut Harness<'static, App>| {
            window.get_by_label(menu).click();
            window.run_steps(5);
        };
        open(&mut window);
        assert!(in_sight(&window, first) && !in_sight(&window, last), "{menu} at {size:?}");
        if menu == "Show" {
            let high = |name: &str| window.get_by_label(name).rect().height();
            assert_eq!(high("Colour by generation of birth"), high(first), "no entry is broken");
        }
        window.key_press(Key::End);
        window.run_steps(40);
        assert!(has_keys(&window).is_some() && in_sight(&window, last), "{menu} by the keys");
        window.key_press(Key::Home);
        window.run_steps(40);
        assert!(in_sight(&window, first), "{menu} back by the keys");
        press(&mut window, Key::Escape);
        open(&mut window);
        window.hover_at(window.get_by_label(first).rect().center());
        window.step();
        window.event(egui::Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            delta: egui::vec2(0.0, -900.0),
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Wheel,
            modifiers: Modifiers::NONE,
        });
        window.run_steps(40);
        assert!(in_sight(&window, last), "{menu} by the wheel");
    }
}
