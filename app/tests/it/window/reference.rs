//! The manual beside the work.

use super::*;

fn look_for(window: &mut Harness<'static, App>, words: &str) {
    let field = window.get_by_label("Find in the reference");
    field.focus();
    window.step();
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.step();
    window.get_by_label("Find in the reference").type_text(words);
    window.run_steps(30); // it is scrolled smoothly
}

#[test]
fn what_is_looked_for_is_counted_and_brought_in_sight_one_after_the_other() {
    let mut window = octahedron();
    window.state_mut().apply(Command::Reference);
    window.run_steps(6);
    look_for(&mut window, "Botsch");
    let field = window.get_by_label("Find in the reference").rect();
    let found = window.get_by_label_contains("Botsch, Kobbelt").rect();
    assert!(found.top() > field.bottom() && found.bottom() < 700.0 && found.left() > field.left(), "{found}");
    look_for(&mut window, "nextto");
    window.get_by_label_contains("1 of ");
    window.key_press(Key::Enter);
    window.run_steps(6);
    window.get_by_label_contains("2 of ");
    window.key_press_modifiers(Modifiers::SHIFT, Key::Enter);
    window.run_steps(6);
    window.get_by_label_contains("1 of ");
    look_for(&mut window, "no such word at all");
    window.get_by_label("none");
}

#[test]
fn what_is_found_in_a_block_of_code_is_brought_in_sight_too() {
    let mut window = octahedron();
    window.state_mut().apply(Command::Reference);
    window.run_steps(6);
    look_for(&mut window, "edge_width");
    let field = window.get_by_label("Find in the reference").rect();
    let found = window.get_by_label_contains("edge_width").rect();
    assert!(found.bottom() > field.bottom() && found.top() < 700.0, "{found}");
}

#[test]
fn escape_leaves_the_field_and_then_closes() {
    let mut window = octahedron();
    window.state_mut().apply(Command::Inspect(app::command::Inspect::Select(app::inspect::selection::Item::Vertex(
        inspecting::v(1),
    ))));
    window.state_mut().apply(Command::Reference);
    window.run_steps(6);
    look_for(&mut window, "nextto");
    press(&mut window, Key::Escape);
    assert!(window.state().session().reference);
    press(&mut window, Key::Num1);
    assert_eq!(window.state().session().document.generation, 1, "keys are the window's again");
    look_for(&mut window, "nextto");
    press(&mut window, Key::Escape);
    press(&mut window, Key::Escape);
    assert!(!window.state().session().reference);
    assert_eq!(window.state().session().selected().len(), 1, "that is the next one's");
    press(&mut window, Key::Escape);
    assert!(window.state().session().selected().is_empty());
}
