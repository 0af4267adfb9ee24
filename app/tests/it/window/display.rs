//! How the mesh is drawn and what is shown on it.

use std::sync::Arc;

use app::annotate::{Arrows, Label, Quantity};
use app::scene::{Axis, Surface};
use app::session::Purpose;
use app::style_file::StyleFile;

use super::*;

fn unfold(window: &mut Harness<'static, App>, group: &str) {
    window.get_by_label(group).click();
    window.run_steps(20); // it opens slowly
}

/// Until the colours asked for are known.
#[track_caller]
fn colored(window: &mut Harness<'static, App>) {
    until(window, "the colours are known", |s| s.colors().is_some());
    window.step();
}

#[test]
fn a_quantity_is_chosen_from_a_list_and_explained_beside_the_mesh() {
    let mut window = octahedron();

    choose(&mut window, "Colour by", "valence");
    colored(&mut window);
    assert_eq!(window.state().session().document.annotations.color_by, Quantity::Valence);
    window.get_by_label("4");
    let tint = window.state().session().colors().unwrap().unwrap();
    assert_eq!(tint.field.numbers.len(), 6);
    choose(&mut window, "Colour by", "nothing");
    assert!(window.state().session().colors().is_none());
    assert!(window.query_by_label("4").is_none());
}

#[test]
fn a_surface_with_colours_of_its_own_is_not_said_to_have_none() {
    let mut window = octahedron();
    let shown = |window: &Harness<'static, App>| window.get_by_label("Colour by").value();
    assert_eq!(shown(&window).as_deref(), Some("nothing"));
    write(&mut window, "vertex { vec color; };\nvoid f(mesh& S) { forall v in S v$color = vec(1, 0, 0); }\n");
    click(&mut window, "Step");
    settle(&mut window);
    assert_eq!(shown(&window).as_deref(), Some("its own colours"));
}

#[test]
fn showing_the_change_moves_nothing_in_the_window() {
    let mut window = octahedron();
    let before = window.get_by_label("Viewport").rect();
    window.state_mut().apply(Command::ColorBy(Quantity::Change));
    colored(&mut window);
    window.run_steps(4);
    assert_eq!(window.get_by_label("Viewport").rect(), before);
}

#[test]
fn properties_of_the_program_are_offered_and_their_range_can_be_set() {
    let mut window = octahedron();
    write(&mut window, "vertex { double heat = 0.0; };\nvoid f(mesh& S) { forall v in S v$heat = v$pos.x; }\n");
    click(&mut window, "Step");

    choose(&mut window, "Colour by", "heat");
    colored(&mut window);
    let low = window.get_by_label("From").rect().center();
    window.drag_at(low);
    window.step();
    window.hover_at(low + egui::vec2(30.0, 0.0));
    window.step();
    window.drop_at(low + egui::vec2(30.0, 0.0));
    settle(&mut window);
    let [low, high] = window.state().session().document.annotations.range.unwrap();
    assert!(low > -1.0 && (high - 1.0).abs() < 1e-9, "{low} {high}");
    click(&mut window, "Auto");
    assert_eq!(window.state().session().document.annotations.range, None);
}

#[test]
fn in_a_small_picture_the_colours_are_explained_in_a_strip() {
    let mut window = octahedron();
    window.state_mut().apply(Command::ColorBy(Quantity::Coordinate(0)));
    colored(&mut window);
    // How far above the lower edge it begins, as a part of the picture.
    let part = |window: &mut Harness<'static, App>| {
        window.run_steps(3);
        let picture = window.get_by_label("Viewport").rect();
        let titles: Vec<_> = window.query_all_by_label("coordinate x").map(|node| node.rect()).collect();
        let title = titles.into_iter().find(|title| picture.contains_rect(*title)).expect("it is said in the picture");
        (picture.bottom() - title.top()) / picture.height()
    };
    window.set_size(egui::vec2(1600.0, 1000.0));
    assert!((0.2..0.35).contains(&part(&mut window)));
    window.set_size(egui::vec2(700.0, 460.0));
    assert!(part(&mut window) < 0.33);
    window.state_mut().apply(Command::ColorBy(Quantity::Valence));
    colored(&mut window);
    window.run_steps(3);
    assert!(window.query_all_by_label("4").next().is_some(), "the kinds have their names");
}

#[test]
fn what_a_generation_lacks_is_said_in_place_of_colours() {
    let mut window = octahedron();
    window.state_mut().apply(Command::ColorBy(Quantity::Change));
    colored(&mut window);
    window.get_by_label("generation 0 has none before it");
    click(&mut window, "Step");
    colored(&mut window);
    window.get_by_label("born");
}

#[test]
fn colours_come_with_each_generation() {
    let mut window = octahedron();
    window.state_mut().apply(Command::ColorBy(Quantity::Birth));
    colored(&mut window);
    click(&mut window, "Step");
    // No picture without them between.
    let tint = window.state().session().colors().unwrap().unwrap();
    assert_eq!(tint.field.numbers.iter().filter(|g| **g == 1.0).count(), 12);
}

#[test]
fn the_mesh_is_cut_open_by_key_and_by_dragging_its_place() {
    let mut window = octahedron();
    press(&mut window, Key::X);
    assert!(window.state().session().document.style.cut.on);
    unfold(&mut window, "Cut");
    click(&mut window, "Cut across y");
    assert_eq!(window.state().session().document.style.cut.across, Axis::Y);
    let field = window.get_by_label("Place of the cut").rect();
    window.drag_at(field.center());
    window.step();
    window.hover_at(field.center() + egui::vec2(90.0, 0.0));
    window.step();
    window.drop_at(field.center() + egui::vec2(90.0, 0.0));
    settle(&mut window);
    assert!(window.state().session().document.style.cut.position > 0.2);
    press(&mut window, Key::X);
    assert!(!window.state().session().document.style.cut.on);
}

#[test]
fn surface_grid_and_axes_are_switched() {
    let mut window = octahedron();
    unfold(&mut window, "Surface");
    click(&mut window, "Isophotes");
    assert_eq!(window.state().session().document.style.surface, Surface::Isophotes);
    click(&mut window, "Lights");
    assert_eq!(window.state().session().document.style.surface, Surface::Lights);
    for key in [Key::G, Key::A, Key::O] {
        press(&mut window, key);
    }
    assert!(is_on(&window, "Grid") && is_on(&window, "Axes"));
    let style = window.state().session().document.style;
    assert!(style.grid && style.axes && style.occlusion);
}

#[test]
fn vertices_are_labelled_by_key_and_what_else_is_written_by_choice() {
    let mut window = octahedron();
    press(&mut window, Key::I);
    assert_eq!(window.state().session().document.annotations.labels, Label::Vertices);
    unfold(&mut window, "Labels and arrows");
    choose(&mut window, "Label by", "corners of faces");
    assert_eq!(window.state().session().document.annotations.labels, Label::Degrees);
    press(&mut window, Key::I);
    press(&mut window, Key::I);
    assert_eq!(window.state().session().document.annotations.labels, Label::Nothing);
}

#[test]
fn arrows_are_chosen_and_made_longer() {
    let mut window = octahedron();
    unfold(&mut window, "Labels and arrows");
    choose(&mut window, "Arrows of", "normals of faces");
    until(&mut window, "the arrows are known", |s| s.arrows().is_some());
    assert_eq!(window.state().session().arrows().unwrap().arrows.len(), 8);
    window.run_steps(2);
    window.get_by_label("Length of arrows");
    window.key_press_modifiers(Modifiers::SHIFT, Key::N);
    settle(&mut window);
    assert_eq!(window.state().session().document.annotations.arrows, Arrows::VertexNormals);
}

#[test]
fn a_style_is_saved_and_loaded_into_another_session() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine");
    let session = || Session::new(None, None, None, Arc::new(|| {})).unwrap();
    let mut first = session();
    first.apply(Command::Smooth);
    first.apply(Command::ColorBy(Quantity::Valence));
    first.chosen(Purpose::SaveStyle, path.clone());
    assert!(first.notice().is_some_and(|(_, text)| text.starts_with("saved mine.json")));

    let mut second = session();
    assert_ne!(second.document.style, first.document.style);
    second.chosen(Purpose::OpenStyle, path.with_extension("json"));
    assert_eq!(second.document.style, first.document.style);
    assert_eq!(second.document.annotations, first.document.annotations);

    // What only figures have is not lost on the way through the window.
    std::fs::write(&path, r#"{"page": "85mm", "lines": {"inner": "0.3"}}"#).unwrap();
    second.chosen(Purpose::OpenStyle, path.clone());
    second.chosen(Purpose::SaveStyle, path.clone());
    let (kept, _) = StyleFile::read(&path.with_extension("json")).unwrap();
    assert_eq!((kept.page.as_deref(), kept.lines["inner"].as_str()), (Some("85mm"), "0.3"));

    let before = second.document.style;
    std::fs::write(&path, "{\n \"style\": {\"egdes\": true}}").unwrap();
    second.chosen(Purpose::OpenStyle, path);
    assert!(second.notice().is_some_and(|(_, text)| text.ends_with("mine: line 2: nothing is called `egdes` here")));
    assert_eq!(second.document.style, before);
}

#[test]
fn lines_of_reflection_on_flat_faces_say_that_smooth_is_wanted() {
    let mut window = octahedron();
    window.set_size(egui::vec2(1000.0, 1000.0));
    window.state_mut().apply(Command::ShowBy(Surface::ReflectionLines));
    settle(&mut window);
    let said = |window: &Harness<'static, App>| window.state().session().notice().map(|(_, text)| text.to_owned());
    assert!(said(&window).unwrap().contains("Smooth"));
    unfold(&mut window, "Surface");
    click(&mut window, "smooth them");
    assert!(window.state().session().document.style.smooth);
    assert!(window.query_by_label("smooth them").is_none());
    window.state_mut().apply(Command::ShowBy(Surface::Lights));
    window.state_mut().apply(Command::Smooth);
    settle(&mut window);
    assert!(window.query_by_label("smooth them").is_none(), "light is no line");
}

#[test]
fn the_colours_are_explained_beside_the_mesh_and_not_over_it() {
    let mut window = open(None, None);
    window.set_size(egui::vec2(1280.0, 720.0));
    window.run_steps(4);
    window.state_mut().apply(Command::Fit);
    window.state_mut().apply(Command::ColorBy(Quantity::Gauss));
    colored(&mut window);
    window.run_steps(4);
    let picture = window.get_by_label("Viewport").rect();
    let mut titles = window.get_all_by_label("Gaussian curvature").map(|node| node.rect());
    let title = titles.find(|rect| picture.contains(rect.center())).unwrap();
    assert!(title.top() > picture.bottom() - 0.15 * picture.height(), "{title} in {picture}");
}

#[test]
fn options_of_drawing_open_over_the_picture_and_not_over_the_same_in_the_inspector() {
    let mut window = octahedron();
    let inspector = window.get_by_label("Fit view").rect();
    window.state_mut().apply(Command::View(app::command::ViewAction::RenderOptions));
    window.run_steps(4);
    let all: Vec<_> = window.get_all_by_label("Fit view").map(|node| node.rect()).collect();
    assert_eq!(all.len(), 2);
    let picture = window.get_by_label("Viewport").rect();
    let opened = all.iter().find(|rect| **rect != inspector).unwrap();
    assert!(picture.contains_rect(*opened), "{opened} in {picture}");
}

#[test]
fn what_the_colours_mean_does_not_lie_over_the_counts() {
    let mut window = octahedron();
    window.state_mut().apply(Command::ColorBy(Quantity::Coordinate(0)));
    window.state_mut().apply(Command::Toggle(app::command::Panel::Inspector));
    for (width, height) in
        [(660.0, 500.0), (720.0, 500.0), (800.0, 500.0), (840.0, 500.0), (900.0, 600.0), (1280.0, 720.0)]
    {
        window.set_size(egui::vec2(width, height));
        colored(&mut window);
        window.run_steps(3);
        let counts = window.get_by_label_contains("8 faces").rect();
        let title = window.get_by_label("coordinate x").rect();
        let ends: Vec<_> = ["-1", "\u{2212}1"].iter().flat_map(|end| window.query_all_by_label(end)).collect();
        let least = ends.iter().map(|node| node.rect().bottom()).fold(title.bottom(), f32::max);
        let apart = counts.right() < title.left() || least < counts.top();
        assert!(apart, "in {width} × {height}: from {title} to {least} over {counts}");
    }
}
