//! Commands found by typing, and the sheet of all keys.

use super::*;
use app::session::Dialog;

fn type_into(window: &mut Harness<'static, App>, field: &str, text: &str) {
    window.get_by_label(field).type_text(text);
    window.run_steps(3);
}

fn open_palette(window: &mut Harness<'static, App>) {
    window.key_press_modifiers(Modifiers::COMMAND, Key::K);
    window.run_steps(3);
    assert!(matches!(window.state().session().dialog, Some(Dialog::Palette { .. })));
}

#[test]
fn a_few_letters_and_enter_carry_a_command_out() {
    let mut window = octahedron();
    open_palette(&mut window);
    type_into(&mut window, "Find a command", "smo");
    press(&mut window, Key::Enter);
    let session = window.state().session();
    assert!(session.document.style.smooth);
    assert!(session.dialog.is_none());
}

#[test]
fn the_palette_finds_examples_and_meshes_and_is_walked_by_arrows() {
    let mut window = octahedron();
    open_palette(&mut window);
    type_into(&mut window, "Find a command", "cube.obj");
    press(&mut window, Key::Enter);
    assert_eq!(window.state().session().document.mesh, MeshSource::BuiltIn("cube.obj".to_owned()));
    open_palette(&mut window);
    window.key_press(Key::ArrowUp);
    window.run_steps(2);
    window.key_press(Key::ArrowDown);
    window.key_press(Key::ArrowDown);
    window.run_steps(2);
    let Some(Dialog::Palette { selected, .. }) = &window.state().session().dialog else { panic!("closed") };
    assert_eq!(*selected, 1, "up from the first goes to the last, and on from there to the first");
    press(&mut window, Key::Escape);
    assert!(window.state().session().dialog.is_none());
}

#[test]
fn the_palette_knows_other_words_for_commands() {
    let mut window = octahedron();
    for (typed, expected) in [
        ("zebra", "Reflection lines"),
        ("wireframe", "Faces"),
        ("shading", "Render options"),
        ("export", "Save mesh as…"),
        ("export pdf", "Save picture as…"),
        ("undo", "Undo"),
        ("screenshot", "Save picture as…"),
        ("subdivide", "Step"),
        ("subdivide quads", "Catmull–Clark"),
        ("reflect", "Reflection lines"),
        ("normals", "Normals of faces"),
        ("settings", "Preferences…"),
        ("shortcuts", "Keys…"),
        ("planarity", "Mesh problems"),
        ("compare", "Side by side"),
        ("help keys", "Keys…"),
    ] {
        open_palette(&mut window);
        type_into(&mut window, "Find a command", typed);
        let is_chosen = |node: &egui_kittest::kittest::AccessKitNode<'_>| {
            node.toggled() == Some(egui::accesskit::Toggled::True) || node.is_selected() == Some(true)
        };
        let found = window.query_all_by(move |node| node.role() == Role::Button && is_chosen(node));
        let found: Vec<String> = found.filter_map(|node| node.accesskit_node().label()).collect();
        assert!(found.contains(&expected.to_owned()), "{typed}: {found:?}");
        press(&mut window, Key::Escape);
    }
}

#[test]
fn what_makes_no_sense_now_is_not_carried_out() {
    let mut window = octahedron();
    open_palette(&mut window);
    type_into(&mut window, "Find a command", "rewind");
    press(&mut window, Key::Enter);
    assert!(window.state().session().dialog.is_some(), "generation 0 cannot be rewound");
}

#[test]
fn the_sheet_of_keys_is_searched() {
    let mut window = octahedron();
    press(&mut window, Key::H);
    window.get_by_label("Save mesh as");
    window.get_by_label("zoom to the pointer");
    type_into(&mut window, "Find a key", "wheel");
    assert!(window.query_by_label("Save mesh as").is_none());
    window.get_by_label("zoom to the pointer");
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    type_into(&mut window, "Find a key", "wireframe");
    assert_eq!(window.query_all_by_label("Faces").count(), 3, "a switch, a count, and the line of the sheet");
    press(&mut window, Key::Escape);
    assert!(window.state().session().dialog.is_none());
}

#[test]
fn the_manual_stands_beside_the_work() {
    let mut window = octahedron();
    press(&mut window, Key::F1);
    let sections = |window: &Harness<'static, App>, name: &str| window.query_all_by_label(name).count();
    assert_eq!(sections(&window, "Old values"), 2, "a link and a heading");
    window.get_by_label("Find in the reference").focus();
    window.step();
    type_into(&mut window, "Find in the reference", "synchronize");
    assert_eq!(sections(&window, "Holes"), 0, "sections that do not speak of it are left out");
    press_outside(&mut window, Key::Num1);
    assert_eq!(faces(&window), 32, "the window goes on meanwhile");
    press(&mut window, Key::F1);
    assert_eq!(sections(&window, "Old values"), 0);
}

#[test]
fn a_tooltip_goes_when_a_dialog_opens_over_it() {
    let mut window = octahedron();
    window.hover_at(window.get_by_label("Step").rect().center());
    window.run_steps(60);
    window.get_by_label("apply the rule once");
    window.key_press_modifiers(Modifiers::COMMAND, Key::Comma);
    window.run_steps(60);
    assert!(window.query_by_label("apply the rule once").is_none());
    press(&mut window, Key::Escape);
    // Nor does one open in a dialog that comes under the pointer.
    let middle = window.get_by_label("Viewport").rect().left_center();
    window.hover_at(middle);
    window.run_steps(4);
    window.state_mut().apply(Command::Gallery);
    window.run_steps(60);
    let tips = |window: &Harness<'static, App>| window.query_all_by_label_contains(".vv, on ").count();
    let before = tips(&window);
    window.hover_at(middle + egui::vec2(2.0, 0.0));
    window.run_steps(60);
    assert_eq!(tips(&window), before + 1);
    press(&mut window, Key::Escape);
    let away = window.get_by_label("Viewport").rect().center();
    window.hover_at(away);
    window.run_steps(4);
    window.hover_at(window.get_by_label("Step").rect().center());
    window.run_steps(60);
    window.get_by_label("apply the rule once");
}
