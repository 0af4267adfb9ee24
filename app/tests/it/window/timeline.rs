//! The generations in a row.

use super::*;

#[test]
fn dragging_along_the_time_line_walks_the_generations() {
    let mut window = octahedron();
    press(&mut window, Key::Num3);
    assert_eq!(faces(&window), 512);
    let track = window.get_by_label("Time line").rect();
    let at = |generation: f32| egui::pos2(track.left() + 14.0 + 46.0 * generation, track.center().y);
    window.drag_at(at(3.0));
    window.step();
    window.hover_at(at(1.0));
    settle(&mut window);
    assert_eq!(faces(&window), 32);
    window.hover_at(at(2.0));
    settle(&mut window);
    assert_eq!(faces(&window), 128);
    window.drop_at(at(2.0));
    settle(&mut window);
    let reached = window.state().session().reached();
    assert_eq!(reached.keys().copied().collect::<Vec<_>>(), [0, 1, 2, 3], "going back forgets nothing");
    assert!(reached.values().all(|r| r.kept) && reached[&2].vertices == 66);
    press(&mut window, Key::End);
    assert_eq!(faces(&window), 512);
    press(&mut window, Key::Home);
    assert_eq!(faces(&window), 8);
    window.state_mut().apply(Command::Undo);
    window.state_mut().apply(Command::Undo);
    settle(&mut window);
    assert_eq!(faces(&window), 128, "walking the time line is one change");
}

#[test]
fn another_program_begins_another_time_line() {
    let mut window = octahedron();
    press(&mut window, Key::Num2);
    write(&mut window, PROGRAM);
    let reached = window.state().session().reached();
    assert_eq!(reached.len(), 3, "computed anew up to the generation shown");
    assert_eq!(reached[&2].vertices, 6);
}

#[test]
fn playing_keeps_to_its_speed() {
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    window.state_mut().apply(Command::SetSpeed(1e9));
    assert_eq!(window.state().session().speed, 60.0);
    window.state_mut().apply(Command::Play);
    until(&mut window, "ten generations were played", |s| s.last_reached() >= 10);
    window.state_mut().apply(Command::SetSpeed(0.1));
    window.state_mut().apply(Command::Stop);
    settle(&mut window);
    window.state_mut().apply(Command::Undo);
    settle(&mut window);
    assert!(window.state().session().document.generation < 10, "what was played is one change");
}
