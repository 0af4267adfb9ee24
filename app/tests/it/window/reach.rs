//! The window for those who do not see it, or have no mouse: everything has a name and is reached by Tab.

use super::*;
use app::command::{MENUS, Panel};
use app::session::Dialog;
use std::collections::BTreeSet;

/// What can be operated in the window as it is, with what each is called.
fn operable(window: &Harness<'static, App>) -> Vec<(Role, String)> {
    let roles = [
        Role::Button,
        Role::CheckBox,
        Role::RadioButton,
        Role::Slider,
        Role::SpinButton,
        Role::ComboBox,
        Role::TextInput,
        Role::MultilineTextInput,
        Role::Link,
    ];
    let nodes = window.query_all_by(move |node| roles.contains(&node.role()) && !node.is_hidden());
    nodes
        .map(|node| {
            let node = node.accesskit_node();
            (node.role(), node.label().or_else(|| node.placeholder().map(str::to_owned)).unwrap_or_default())
        })
        .collect()
}

#[track_caller]
fn all_have_names(window: &Harness<'static, App>, place: &str) {
    assert!(operable(window).len() > 3, "{place}: {:?}", operable(window));
    let nameless: Vec<_> = operable(window).into_iter().filter(|(_, name)| name.trim().is_empty()).collect();
    assert!(nameless.is_empty(), "{place}: {nameless:?}");
}

#[test]
fn everything_that_can_be_operated_has_a_name() {
    let mut window = octahedron();
    write(&mut window, PROGRAM);
    all_have_names(&window, "window");
    let dialogs = [Command::Gallery, Command::Preferences, Command::SavePicture, Command::Palette, Command::CheatSheet];
    for command in dialogs {
        window.state_mut().apply(command.clone());
        window.run_steps(4);
        all_have_names(&window, command.describe().label);
        window.state_mut().apply(Command::CloseDialog);
        window.run_steps(2);
    }
    window.state_mut().apply(Command::NewProgram);
    window.run_steps(3);
    assert!(matches!(window.state().session().dialog, Some(Dialog::Unsaved { .. })));
    all_have_names(&window, "unsaved");
    window.state_mut().apply(Command::CloseDialog);
    window.state_mut().apply(Command::Reference);
    window.run_steps(4);
    all_have_names(&window, "reference");
}

#[test]
fn preferences_are_seen_whole_in_a_low_window() {
    let mut window = octahedron();
    window.set_size(egui::vec2(1280.0, 600.0));
    window.state_mut().apply(Command::Preferences);
    window.run_steps(4);
    let bottom = |window: &Harness<'static, App>, name: &str| window.get_by_label(name).rect();
    let done = bottom(&window, "Done");
    for name in ["Speed of playing", "Tab makes", "At start", "Up"] {
        let row = window.query_all_by_label(name).next().unwrap().rect();
        assert!(row.bottom() <= done.top() && row.top() > 0.0, "{name} {row} {done}");
    }
}

#[test]
fn tab_goes_through_all_that_can_be_operated() {
    let mut window = octahedron();
    window.state_mut().apply(Command::Toggle(Panel::Program)); // in which Tab means itself
    window.run_steps(2);
    let focused = |window: &Harness<'static, App>| {
        let node = window.query_all_by(|node| node.is_focused()).next()?;
        node.accesskit_node().label()
    };
    let mut reached = BTreeSet::new();
    for _ in 0..120 {
        window.key_press(Key::Tab);
        window.step();
        reached.extend(focused(&window));
    }
    for name in
        ["Step", "Play", "File", "Generation", "Rule", "Faces", "Smooth", "Fit view", "Time line", "Speed", "Problems"]
    {
        assert!(reached.contains(name), "{name} is not among {reached:?}");
    }
}

/// What has the keys.
fn focused(window: &Harness<'static, App>) -> String {
    let node = window.query_all_by(|node| node.is_focused()).next();
    node.and_then(|node| node.accesskit_node().label()).unwrap_or_default()
}

#[test]
fn tab_goes_in_the_order_in_which_one_reads() {
    let mut window = octahedron();
    press(&mut window, Key::Num1);
    let mut reached = Vec::new();
    for _ in 0..120 {
        // Out of the text, in which Tab means itself.
        if focused(&window) == "Program text" {
            window.key_press(Key::F6);
            window.run_steps(2);
        }
        window.key_press(Key::Tab);
        window.step();
        window.step();
        reached.push(focused(&window));
    }
    let first = reached.iter().position(|name| name == "File").unwrap();
    let order = [
        "File",
        "Examples",
        "Help",
        "Rewind",
        "Back",
        "Step",
        "Play",
        "Generation",
        "Rule",
        "Program panel",
        "Messages panel",
        "Inspector panel",
        "Save the program",
        "Program text",
        "Problems",
        "Mesh",
        "Console",
        "Open…",
        "Select vertex…",
        "Fit view",
        "Faces",
        "Smooth",
        "Play the generations",
        "Time line",
        "Speed",
    ];
    let mut rest = reached[first..].iter();
    for name in order {
        assert!(rest.any(|reached| reached == name), "{name} does not come in its turn in {reached:?}");
    }
}

#[test]
fn what_has_the_keys_is_seen() {
    for theme in [app::command::ThemeChoice::Dark, app::command::ThemeChoice::Light] {
        let mut window = octahedron();
        window.state_mut().apply(Command::SetTheme(theme));
        settle(&mut window);
        let before = window.render().unwrap();
        for (name, role) in [("Faces", Role::CheckBox), ("Step", Role::Button), ("Console", Role::Button)] {
            window.get_by_role_and_label(role, name).focus();
            window.run_steps(3);
            let rect = window.get_by_role_and_label(role, name).rect().expand(3.0);
            let with = window.render().unwrap();
            let around = with.enumerate_pixels().filter(|(x, y, pixel)| {
                rect.contains(egui::pos2(*x as f32, *y as f32)) && *pixel != before.get_pixel(*x, *y)
            });
            let length = 2.0 * (rect.width() + rect.height());
            assert!(around.count() as f32 > 0.7 * length, "{theme:?} {name}");
        }
    }
}

#[test]
fn the_time_line_is_walked_by_arrows_when_it_has_the_keys() {
    let mut window = octahedron();
    press(&mut window, Key::Num2);
    window.get_by_label("Time line").focus();
    window.step();
    press(&mut window, Key::ArrowLeft);
    assert_eq!(window.state().session().document.generation, 1);
}

#[test]
fn every_command_of_the_menus_is_described() {
    for command in MENUS.iter().flat_map(|m| m.groups).copied().flatten() {
        let description = command.describe();
        assert!(!description.label.is_empty() && !description.tooltip.is_empty(), "{command:?}");
    }
}

#[test]
fn what_comes_beside_the_name_of_the_program_makes_its_panel_no_wider() {
    let mut window = octahedron();
    let left = |window: &Harness<'static, App>| window.get_by_label("Viewport").rect().left();
    let before = left(&window);
    assert!((before - 0.36 * window.ctx.content_rect().width()).abs() < 2.0, "as it is meant: {before}");
    window.state_mut().apply(Command::SetReload(app::command::Reload::ByHand));
    window.state_mut().apply(Command::Edit("// changed".into()));
    window.run_steps(4);
    let run = window.get_by_label("Run the changed text").rect();
    let save = window.get_by_label("Save the program").rect();
    assert!(run.right() <= save.left() && save.right() < before, "{run} {save}");
    assert_eq!(left(&window), before);
}
