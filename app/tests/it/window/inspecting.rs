//! Looking closer: what is selected, its ring, walks, measures, what is wrong with the mesh.

use app::camera::picture_point;
use app::command::Inspect;
use app::inspect::findings::Kind;
use app::inspect::selection::Item;
use glam::{DVec2, DVec3};
use vv::mesh::Vertex;

use super::*;

pub fn v(number: usize) -> Vertex {
    Vertex::from_index(number - 1).unwrap()
}

/// A mesh of a file, with a program that steps it.
pub fn on(obj: &str, program: &str) -> (Harness<'static, App>, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let (mesh, text) = (folder.path().join("mesh.obj"), folder.path().join("program.vv"));
    std::fs::write(&mesh, obj).unwrap();
    std::fs::write(&text, program).unwrap();
    let mut window = open(Some(&mesh), Some(&text));
    known(&mut window);
    (window, folder)
}

/// Until the picture can be pointed at and the mesh was looked at.
#[track_caller]
pub fn known(window: &mut Harness<'static, App>) {
    settle(window);
    until(window, "it can be pointed at", |s| {
        s.frame().is_some_and(|f| f.scene.is_indexed() && f.findings.get().is_some()) && !s.glides()
    });
    window.step();
}

/// Where a point of the world is seen in the window.
pub fn seen(window: &Harness<'static, App>, p: DVec3) -> egui::Pos2 {
    let rect = window.get_by_label("Viewport").rect();
    let camera = window.state().session().document.camera;
    let aspect = f64::from(rect.width() / rect.height());
    let clip = camera.clip_from_view(aspect) * camera.view_from_world() * p.extend(1.0);
    let half = rect.size() / 2.0;
    let at = rect.center() + egui::vec2((clip.x / clip.w) as f32 * half.x, -(clip.y / clip.w) as f32 * half.y);
    // It is what the camera says.
    let of = |v: egui::Vec2| DVec2::new(f64::from(v.x), f64::from(v.y));
    let ray = camera.ray(picture_point(of(at - rect.min), of(rect.size())));
    let along = (p - ray.origin).dot(ray.direction);
    assert!(p.distance(ray.origin + along * ray.direction) < 1e-3 * camera.distance);
    at
}

fn click_at(window: &mut Harness<'static, App>, p: DVec3, modifiers: Modifiers) {
    let at = seen(window, p);
    click_in_window(window, at, modifiers);
}

fn click_in_window(window: &mut Harness<'static, App>, at: egui::Pos2, modifiers: Modifiers) {
    window.hover_at(at);
    window.step();
    for pressed in [true, false] {
        let button = egui::PointerButton::Primary;
        window.event_modifiers(egui::Event::PointerButton { pos: at, button, pressed, modifiers }, modifiers);
        window.step();
    }
    window.event(egui::Event::PointerGone);
    known(window);
}

fn selected(window: &Harness<'static, App>) -> Vec<Item> {
    window.state().session().selected()
}

fn position(window: &Harness<'static, App>, number: usize) -> DVec3 {
    window.state().session().frame().unwrap().mesh.position(v(number))
}

/// The row of a table.
#[track_caller]
fn says(window: &Harness<'static, App>, name: &str, value: &str) {
    window.get_by(|node| node.label().as_deref() == Some(name) && node.value().as_deref() == Some(value));
}

const PLANE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
const LOOP: &str = "void f(mesh& S) {\n  forall v in S v$pos *= 2.0;\n  vertex x; add x to S; }\n";

#[test]
fn a_click_selects_what_is_under_it_and_one_on_nothing_clears() {
    let (mut window, _folder) = on(PLANE, LOOP);
    let middle = position(&window, 5);
    click_at(&mut window, middle, Modifiers::NONE);
    assert_eq!(selected(&window), [Item::Vertex(v(5))]);
    click_at(&mut window, DVec3::new(0.5, 0.0, 0.0), Modifiers::NONE);
    assert_eq!(selected(&window), [Item::Edge([v(1), v(2)])]);
    click_at(&mut window, DVec3::new(0.5, 0.2, 0.0), Modifiers::NONE);
    assert_eq!(selected(&window), [Item::Face([v(1), v(2)])]);
    says(&window, "Face", "3 corners");
    says(&window, "Area", "0.25");
    let corner = window.get_by_label("Viewport").rect().center_top() + egui::vec2(0.0, 12.0);
    click_in_window(&mut window, corner, Modifiers::NONE);
    assert_eq!(selected(&window), []);
}

#[test]
fn more_is_selected_with_shift_and_measured() {
    let (mut window, _folder) = on(PLANE, LOOP);
    for number in [1, 2] {
        let at = position(&window, number);
        click_at(&mut window, at, Modifiers::SHIFT);
    }
    says(&window, "Distance", "1");
    says(&window, "Along x", "1");
    says(&window, "Along y", "0");
    let at = position(&window, 3);
    click_at(&mut window, at, Modifiers::SHIFT);
    says(&window, "Angle at v2", "90°");
    says(&window, "Angle at v1", "45°");
    click_at(&mut window, at, Modifiers::SHIFT);
    assert_eq!(selected(&window), [Item::Vertex(v(1)), Item::Vertex(v(2))], "again, and it is not selected");
    press(&mut window, Key::Escape);
    assert_eq!(selected(&window), []);
}

#[test]
fn an_edge_tells_its_length_and_the_angle_of_its_faces() {
    let mut window = open(None, None);
    window.state_mut().apply(Command::UseMesh(MeshSource::BuiltIn("cube.obj".to_owned())));
    window.state_mut().apply(Command::Rewind);
    known(&mut window);
    let frame = window.state().session().frame().unwrap().clone();
    let [p, q] = [frame.faces.get(0)[0], frame.faces.get(0)[1]];
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Edge([p.min(q), p.max(q)]))));
    window.step();
    says(&window, "Dihedral angle", "90°");
    says(&window, "Face to the left", "4 corners");
}

#[test]
fn the_ring_of_a_vertex_is_told_and_the_mesh_is_walked_by_its_entries() {
    let (mut window, _folder) = on(PLANE, LOOP);
    let first = position(&window, 1);
    click_at(&mut window, first, Modifiers::NONE);
    says(&window, "Valence", "3, 1 gap");
    says(&window, "Born in", "generation 0");
    // {v2, v5, v4, _}
    for entry in ["v2", "v5", "v4"] {
        window.get_by_label(&format!("ring entry {entry}"));
    }
    window.get_by_label("ring entry v5").hover();
    window.run_steps(3);
    assert_eq!(window.state().session().inspection.pointed, Some(v(5)), "the mesh answers");
    click(&mut window, "ring entry v5");
    assert_eq!(selected(&window), [Item::Vertex(v(5))]);
    says(&window, "Valence", "4");
    click(&mut window, "v3");
    assert_eq!(selected(&window), [Item::Vertex(v(3))]);
}

#[test]
fn pointing_at_a_vertex_of_the_picture_is_seen_in_the_panel() {
    let (mut window, _folder) = on(PLANE, LOOP);
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(v(1)))));
    let at = seen(&window, position(&window, 5));
    window.hover_at(at);
    window.run_steps(3);
    assert_eq!(window.state().session().inspection.pointed, Some(v(5)));
    let elsewhere = seen(&window, DVec3::new(0.5, 0.2, 0.0));
    window.hover_at(elsewhere);
    window.run_steps(3);
    assert_eq!(window.state().session().inspection.pointed, None);
}

#[test]
fn what_is_selected_stays_itself_while_generations_go_by() {
    // Forgets v1, so that all others have new numbers.
    let text = "void f(mesh& S) {\n  vertex first = null;\n  forall v in S { first = v; break; }\n\
                forall q in first erase first from q;\n  make {} nb_of first;\n  remove first from S;\n\
                vertex x; add x to S; }\n";
    let (mut window, _folder) = on(PLANE, text);
    let middle = position(&window, 5);
    click_at(&mut window, middle, Modifiers::NONE);
    press(&mut window, Key::S);
    known(&mut window);
    assert_eq!(selected(&window), [Item::Vertex(v(4))], "the same one under its new number");
    assert_eq!(position(&window, 4), middle);
    says(&window, "Born in", "generation 0");
    window.get_by_label("Old ring, generation 0");
    window.get_by_label("old ring entry v4");
    press(&mut window, Key::Num5);
    known(&mut window);
    assert_eq!(selected(&window), []);
    window.get_by_label("v5 of generation 0 is not in this one");
    press(&mut window, Key::Num0);
    assert_eq!(selected(&window), [Item::Vertex(v(5))]);
}

#[test]
fn a_vertex_is_selected_by_its_number_and_flown_to() {
    let (mut window, _folder) = on(PLANE, LOOP);
    let start = window.state().session().document.camera;
    let ask = |window: &mut Harness<'static, App>, text: &str| {
        window.key_press_modifiers(Modifiers::COMMAND, Key::G);
        window.run_steps(3);
        window.get_by_label("Numbers of vertices").type_text(text);
        window.run_steps(2);
        click(window, "Select");
        known(window);
    };
    ask(&mut window, "v3");
    assert_eq!(selected(&window), [Item::Vertex(v(3))]);
    let camera = window.state().session().document.camera;
    assert_eq!(camera.pivot, position(&window, 3));
    assert_ne!(camera.distance, start.distance);
    ask(&mut window, "1, 77");
    let notice = window.state().session().notice().map(|(_, text)| text.to_owned());
    assert_eq!(notice.as_deref(), Some("there is no v77: the mesh has v1 to v5"));
    ask(&mut window, "1 5");
    says(&window, "Distance", "0.70711");
}

#[test]
fn a_walk_around_a_face_goes_step_by_step_and_closes() {
    let (mut window, _folder) = on(PLANE, LOOP);
    // Near the corner v1 of the face v1 v2 v5.
    click_at(&mut window, DVec3::new(0.3, 0.1, 0.0), Modifiers::COMMAND);
    let shown = |w: &Harness<'static, App>| {
        let walking = w.state().session().inspection.walk.clone().unwrap();
        (walking.at, walking.walk.rule(walking.at - 1))
    };
    assert_eq!(shown(&window), (1, "v5 is a neighbour of v1".to_owned()));
    press(&mut window, Key::Period);
    assert_eq!(shown(&window), (2, "v2 = nextto v1 in v5".to_owned()));
    click(&mut window, "Walk on");
    assert_eq!(shown(&window), (3, "v1 = nextto v5 in v2".to_owned()));
    window.get_by_label("closed orbit: a face of 3 corners");
    press(&mut window, Key::Comma);
    assert_eq!(shown(&window).0, 2);
    click(&mut window, "Play the walk");
    until(&mut window, "it has gone round", |s| s.inspection.walk.as_ref().is_some_and(|w| w.at == 3));
    click(&mut window, "End the walk");
    assert!(window.state().session().inspection.walk.is_none());
}

#[test]
fn a_walk_along_the_boundary_ends_at_the_gap() {
    let (mut window, _folder) = on(PLANE, LOOP);
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(v(1)))));
    window.step();
    click(&mut window, "Walk the face at v2");
    window.get_by_label("nextto v1 in v2 is a gap: the walk ends at the boundary");
}

/// Takes the first vertex out of the ring of a neighbour, and adds one that nobody names.
const TEARS: &str = "void f(mesh& S) {\n  forall v in S {\n    forall q in v { erase v from q; break; }\n    break;\n  }\n  vertex x; add x to S;\n}\n";

#[test]
fn what_is_wrong_with_the_mesh_is_listed_and_leads_there() {
    let obj = format!("{PLANE}v 3 0 0\nv 4 0 0\nv 4 1 0.5\nv 3 1 0\nf 6 7 8 9\n");
    let (mut window, _folder) = on(&obj, TEARS);
    press(&mut window, Key::S);
    known(&mut window);
    window.get_by_role_and_label(Role::Button, "Mesh").click();
    settle(&mut window);
    assert!(window.state().session().inspection.listing);
    let kinds: Vec<(Kind, usize)> = {
        let frame = window.state().session().frame().unwrap();
        frame.findings.get().unwrap().groups.iter().map(|g| (g.kind, g.count)).collect()
    };
    let expected = [(Kind::Incomplete, 1), (Kind::Broken, 1), (Kind::Isolated, 1), (Kind::NotPlane, 1)];
    assert_eq!(kinds, expected);
    let before = window.state().session().document.camera;
    click(&mut window, "v1 → v2: v2 does not name v1");
    known(&mut window);
    assert_eq!(selected(&window), [Item::Vertex(v(1))]);
    assert_ne!(window.state().session().document.camera, before, "flown there");
    assert_eq!(window.state().session().document.camera.pivot, position(&window, 1));
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(v(2)))));
    window.step();
    window.get_by_label("name v2 without being named:");
    let broken = window.state().session().frame().unwrap().findings.get().unwrap().groups[1].rows[0].text.clone();
    click(&mut window, &broken);
    let walk = window.state().session().inspection.walk.clone().unwrap();
    assert!(walk.walk.is_broken(), "{:?}", walk.walk);
    click(&mut window, "Problems");
    assert!(!window.state().session().inspection.listing);
}

#[test]
fn a_run_time_error_shows_the_vertices_that_it_names() {
    let text = "void f(mesh& S) {\n  forall v in S {\n    if (valence v == 4) {\n      vertex q = nextto v in v;\n\
                print(q$pos);\n    }\n  }\n}\n";
    let (mut window, _folder) = on(PLANE, text);
    press(&mut window, Key::S);
    known(&mut window);
    let session = window.state().session();
    let fault = session.inspection.fault.as_ref().unwrap();
    assert_eq!((&fault.vertices[..], fault.generation), (&[v(5)][..], 0));
    assert_eq!(fault.mesh.ring(v(5)).valence(), 4);
    // Its name is a link to it.
    window.get_all_by_label("v5").next().unwrap().click();
    window.run_steps(3);
    assert_eq!(selected(&window), [Item::Vertex(v(5))]);
    press(&mut window, Key::Num0);
    assert!(window.state().session().inspection.fault.is_none());
}

#[test]
fn the_old_ring_is_drawn_where_it_was_and_can_be_left_out() {
    let text = "void f(mesh& S) {\n  forall v in S v$pos *= 0.5;\n  vertex x; add x to S; }\n";
    let (mut window, _folder) = on(PLANE, text);
    let middle = position(&window, 5);
    click_at(&mut window, middle, Modifiers::NONE);
    assert!(window.state().session().old_ring(v(5)).is_none(), "nothing was before");
    press(&mut window, Key::S);
    known(&mut window);
    let (ring, generation) = window.state().session().old_ring(v(5)).unwrap();
    assert_eq!((ring.to_string(), generation), ("v5: {v1, v2, v3, v4}".to_owned(), 0));
    let with = window.render().unwrap();
    click(&mut window, "Old ring in the picture");
    assert!(!window.state().session().inspection.old_ring);
    window.event(egui::Event::PointerGone);
    known(&mut window);
    let without = window.render().unwrap();
    assert!(differ(&window, &with, &without) > 300);
}

#[test]
fn a_long_broken_orbit_is_seen_whole() {
    const CORNERS: usize = 120;
    let mut obj = String::new();
    for z in [0, 1] {
        for i in 0..CORNERS {
            let angle = std::f64::consts::TAU * i as f64 / CORNERS as f64;
            obj += &format!("v {} {} {z}\n", 5.0 * angle.cos(), 5.0 * angle.sin());
        }
    }
    obj += "f";
    (1..=CORNERS).rev().for_each(|i| obj += &format!(" {i}"));
    obj += "\n";
    for i in 0..CORNERS {
        let [a, b] = [i + 1, (i + 1) % CORNERS + 1];
        obj += &format!("f {a} {b} {} {}\n", b + CORNERS, a + CORNERS);
    }
    obj += "f";
    (CORNERS + 1..=2 * CORNERS).for_each(|i| obj += &format!(" {i}"));
    obj += "\n";
    let (mut window, _folder) = on(&obj, TEARS);
    press(&mut window, Key::S);
    known(&mut window);
    window.get_by_role_and_label(Role::Button, "Mesh").click();
    settle(&mut window);
    let text = {
        let frame = window.state().session().frame().unwrap();
        let broken = frame.findings.get().unwrap().groups.iter().find(|g| g.kind == Kind::Broken).unwrap();
        broken.rows[0].text.clone()
    };
    click(&mut window, &text);
    until(&mut window, "the camera is there", |s| !s.glides());
    let session = window.state().session();
    let path = session.inspection.walk.as_ref().unwrap().walk.path.clone();
    assert!(path.len() >= CORNERS, "{}", path.len());
    let viewport = window.get_by_label("Viewport").rect();
    let mesh = &session.frame().unwrap().mesh;
    let places: Vec<egui::Pos2> = path.iter().map(|&v| seen(&window, mesh.position(v))).collect();
    assert!(places.iter().all(|p| viewport.contains(*p)), "{viewport}: {places:?}");
    let width = egui::Rect::from_points(&places).width();
    assert!(width > 0.5 * viewport.width().min(viewport.height()), "{width} of {viewport}");
}

#[test]
fn numbers_of_a_vector_that_have_no_room_beside_each_other_stand_below_each_other() {
    let obj = PLANE.replace("v 0 0 0", "v 1.23456e-17 -2.34567e-18 3.45678e-17");
    let (mut window, _folder) = on(&obj, LOOP);
    let row = |window: &Harness<'static, App>, number: usize| {
        let vertex = window.get_by(|node| node.label().as_deref() == Some("Vertex") && node.value().is_some());
        assert_eq!(vertex.value(), Some(format!("v{number}")));
        let pos = window.get_by(|node| node.label().as_deref() == Some("pos") && node.value().is_some());
        (pos.value().unwrap(), pos.rect().height() / vertex.rect().height())
    };
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(v(2)))));
    known(&mut window);
    assert_eq!(row(&window, 2), ("(1, 0, 0)".to_owned(), 1.0));
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(v(1)))));
    known(&mut window);
    let (value, lines) = row(&window, 1);
    assert_eq!(value, "(1.23456e-17,\n-2.34567e-18,\n3.45678e-17)");
    assert!(lines > 2.5, "{lines}");
    let below = |window: &Harness<'static, App>| {
        let pos = window.get_by(|node| node.label().as_deref() == Some("pos") && node.value().is_some()).rect();
        window.get_by_label("Ring").rect().top() - pos.bottom()
    };
    let room = below(&window);
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(v(2)))));
    known(&mut window);
    assert!(below(&window) <= room + 4.0, "the row is as high as what is in it");
}

#[test]
fn what_is_told_of_a_vertex_has_the_width_of_a_narrow_inspector_and_no_more() {
    let (mut window, _folder) = on(PLANE, "edge { vec along = vec(1, 1, 1); };\nvoid f(mesh& S) { }\n");
    for width in [1280.0, 900.0] {
        window.set_size(egui::vec2(width, 600.0));
        window.run_steps(4);
    }
    let margin = |window: &Harness<'static, App>| {
        let picture = window.get_by_label("Viewport").rect();
        let heading = window.get_all_by_label("Selection").map(|node| node.rect()).find(|r| r.left() > picture.left());
        heading.unwrap().left() - picture.right()
    };
    let before = margin(&window);
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(v(2)))));
    press(&mut window, Key::S);
    known(&mut window);
    window.run_steps(4);
    window.get_by_label("Neighbours");
    assert_eq!(margin(&window), before);
}

#[test]
fn the_name_of_a_long_value_stands_beside_its_first_line() {
    let obj = "v 0.12345678 -0.2345678 0.3456789\nv 1.2345678 0.12345 0.9876\nv 0.54321 1.98765 0.4321\nf 1 2 3\n";
    let (mut window, _folder) = on(obj, PROGRAM);
    window.set_size(egui::vec2(760.0, 600.0));
    window.state_mut().apply(Command::Inspect(Inspect::Select(Item::Vertex(v(1)))));
    window.run_steps(6);
    let name = window.get_by_label("pos").rect();
    let value = window.get_by_label_contains("0.12").rect();
    assert!(value.height() > 2.0 * name.height(), "in three lines: {value} {name}");
    assert!((name.top() - value.top()).abs() < 3.0, "{name} {value}");
    let other = window.get_by_label("Born in").rect();
    assert!(other.height() < name.height() + 1.0, "a name is not broken: {other}");
}
