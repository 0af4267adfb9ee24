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
    let reached = [0, 1, 2, 3, 4].map(|generation| window.state().session().reached(generation));
    let vertices = reached.map(|r| r.filter(|r| r.kept).map(|r| r.vertices));
    assert_eq!(vertices, [Some(6), Some(18), Some(66), Some(258), None], "going back forgets nothing");
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
    let reached = [2, 3].map(|generation| window.state().session().reached(generation));
    assert_eq!(reached.map(|r| r.map(|r| r.vertices)), [Some(6), None], "computed anew up to the generation shown");
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

#[test]
fn a_right_click_on_a_generation_offers_what_to_do_with_it() {
    let mut window = octahedron();
    press(&mut window, Key::Num3);
    let track = window.get_by_label("Time line").rect();
    let right_click = |window: &mut Harness<'static, App>, generation: f32| {
        let at = egui::pos2(track.left() + 14.0 + 46.0 * generation, track.center().y);
        window.hover_at(at);
        for pressed in [true, false] {
            let (button, modifiers) = (egui::PointerButton::Secondary, Modifiers::NONE);
            window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
            window.step();
        }
        window.run_steps(3);
    };
    right_click(&mut window, 1.0);
    assert_eq!(faces(&window), 512, "nothing is done before something is chosen");
    click(&mut window, "Colour what its step changed");
    assert_eq!(faces(&window), 32);
    assert_eq!(window.state().session().document.annotations.color_by.to_string(), "change");
    right_click(&mut window, 2.0);
    window.get_by_label("Go to generation 2");
    click(&mut window, "Save picture of it…");
    assert_eq!(faces(&window), 128);
    assert_eq!(window.state().session().dialog, Some(app::session::Dialog::Picture));
}

#[test]
fn any_generation_is_compared_with_any_other() {
    let mut window = octahedron();
    press(&mut window, Key::Num3);
    let track = window.get_by_label("Time line").rect();
    let at = egui::pos2(track.left() + 14.0 + 46.0, track.center().y);
    window.hover_at(at);
    for pressed in [true, false] {
        let (button, modifiers) = (egui::PointerButton::Secondary, Modifiers::NONE);
        window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
        window.step();
    }
    window.run_steps(3);
    click(&mut window, "Compare with generation 1");
    let counts = |window: &mut Harness<'static, App>| -> Vec<(String, usize)> {
        until(window, "the colours are found", |s| s.colors().is_some());
        match window.state().session().colors() {
            Some(Ok(tint)) => match &tint.field.kind {
                app::annotate::field::Kind::Classes(all) => all.iter().map(|c| (c.name.clone(), c.count)).collect(),
                other => panic!("{other:?}"),
            },
            other => vec![(other.unwrap().unwrap_err(), 0)],
        }
    };
    let classes = |born| [("stayed".to_owned(), 0), ("moved".to_owned(), 18), ("born".to_owned(), born)];
    // Generation 1 has 18 vertices, 3 has 258, 2 has 66.
    assert_eq!(counts(&mut window), classes(240));
    press(&mut window, Key::Num2);
    assert_eq!(counts(&mut window), classes(48));
    press(&mut window, Key::Num1);
    assert_eq!(counts(&mut window), [("this is the generation that others are compared with".to_owned(), 0)]);
    press(&mut window, Key::Num0);
    assert_eq!(counts(&mut window), [("generation 1 comes after this one".to_owned(), 0)]);
    press(&mut window, Key::Num3);
    click(&mut window, "Last step");
    assert_eq!(counts(&mut window)[2], ("born".to_owned(), 192));
    window.state_mut().apply(Command::ColorBy(app::annotate::Quantity::Since(0)));
    settle(&mut window);
    assert_eq!(counts(&mut window)[2], ("born".to_owned(), 252));
}

#[test]
fn what_waits_for_a_generation_is_forgotten_when_another_one_is_wanted() {
    let mut window = octahedron();
    let save = || Box::new(Command::SavePicture);
    window.state_mut().apply(Command::With(3, save()));
    window.state_mut().apply(Command::GoTo(1));
    settle(&mut window);
    window.state_mut().apply(Command::GoTo(3));
    settle(&mut window);
    assert_eq!(window.state().session().dialog, None);
    // A generation that is not reached.
    write(&mut window, "void f(mesh& S) { print(1 / 0); }");
    window.state_mut().apply(Command::GoTo(0));
    settle(&mut window);
    window.state_mut().apply(Command::With(1, save()));
    settle(&mut window);
    assert_eq!(window.state().session().dialog, None);
    window.state_mut().apply(Command::With(0, save()));
    settle(&mut window);
    assert_eq!(window.state().session().dialog, Some(app::session::Dialog::Picture));
}
