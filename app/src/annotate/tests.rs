//! What the numbers of small meshes are, and which colours they get.

use std::sync::Arc;

use glam::DVec3;
use vv::io::{Format, ReadOptions};
use vv::mesh::faces::{Faces, faces};
use vv::mesh::{Mesh, Value, Vertex};
use vv::stop::Stop;

use super::cell::Cell;
use super::field::{Kind, NoField};
use super::scale::{CLASS_COLORS, automatic_range, color, short};
use super::{Annotations, Field, Quantity, Reading, Subject, Tint};
use crate::inspect::lineage::{Lineage, Survivors};
use crate::library;
use crate::scene::Scene;

/// A mesh with what belongs to it.
struct Example {
    mesh: Mesh,
    faces: Faces,
    scene: Scene,
    generation: u64,
    before: Option<Mesh>,
    lineage: Lineage,
}

impl Example {
    fn of(mesh: Mesh) -> Self {
        let faces = faces(&mesh, &Stop::new()).unwrap();
        let scene = Scene::new(&mesh, &faces, None, &Stop::new()).unwrap();
        Self { mesh, faces, scene, generation: 0, before: None, lineage: Lineage::default() }
    }

    /// One of those that ship with vv.
    fn shipped(name: &str) -> Self {
        let shipped = library::MESHES.iter().find(|mesh| mesh.name == name).unwrap();
        Self::of(vv::io::read(shipped.text.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap().0)
    }

    /// Text in the OBJ format.
    fn obj(text: &str) -> Self {
        Self::of(vv::io::read(text.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap().0)
    }

    fn subject(&self) -> Subject<'_> {
        Subject {
            mesh: &self.mesh,
            faces: &self.faces,
            scene: &self.scene,
            generation: self.generation,
            before: self.before.as_ref(),
            lineage: &self.lineage,
            tint: None,
        }
    }

    fn field(&self, quantity: &str) -> Result<Field, NoField> {
        Field::new(&self.subject(), &quantity.parse().unwrap(), &Stop::new())
    }

    fn tint(&self, quantity: &str) -> Tint {
        Tint::of(Arc::new(self.field(quantity).unwrap()), &self.scene, None)
    }

    fn lacks(&self, quantity: &str) -> String {
        match self.field(quantity) {
            Err(NoField::Missing(why)) => why,
            other => panic!("{other:?}"),
        }
    }
}

/// An octahedron pushed outwards onto the unit ball, its triangles split in four so many times.
fn ball(times: u32) -> Example {
    let mut points = vec![DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z];
    let mut triangles =
        vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5usize]];
    for _ in 0..times {
        let mut made = std::collections::BTreeMap::new();
        let mut middle = |a: usize, b: usize| {
            *made.entry((a.min(b), a.max(b))).or_insert_with(|| {
                points.push((points[a] + points[b]).normalize());
                points.len() - 1
            })
        };
        let mut split = Vec::new();
        for [a, b, c] in triangles {
            let [x, y, z] = [middle(a, b), middle(b, c), middle(c, a)];
            split.extend([[a, x, z], [b, y, x], [c, z, y], [x, y, z]]);
        }
        triangles = split;
    }
    let mut text = String::new();
    points.iter().for_each(|p| text += &format!("v {} {} {}\n", p.x, p.y, p.z));
    triangles.iter().for_each(|[a, b, c]| text += &format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    Example::obj(&text)
}

/// Those that have any, with how many have it.
#[track_caller]
fn check_classes(field: &Field, expected: &[(&str, usize)]) {
    let Kind::Classes(classes) = &field.kind else { panic!("{:?}", field.kind) };
    let seen: Vec<_> = classes.iter().filter(|c| c.count > 0).map(|c| (c.name.as_str(), c.count)).collect();
    assert_eq!(seen, expected);
}

#[test]
fn a_quantity_is_said_in_a_word() {
    for text in [
        "none",
        "valence",
        "degree",
        "gauss",
        "mean",
        "birth",
        "change",
        "change:3",
        "x",
        "y",
        "z",
        "heat",
        "rgb:color",
    ] {
        let quantity: Quantity = text.parse().unwrap();
        assert_eq!(quantity.to_string(), text);
    }
    // A property may be called like something else.
    let property = Quantity::Property("valence".to_owned());
    assert_eq!(property.to_string(), "property:valence");
    assert_eq!("property:valence".parse(), Ok(property));
}

#[test]
fn valences_are_classes_around_the_regular_one() {
    check_classes(&Example::shipped("icosahedron.obj").field("valence").unwrap(), &[("5", 12)]);
    check_classes(&Example::shipped("cube.obj").field("valence").unwrap(), &[("3", 8)]);
    let ball = ball(1).field("valence").unwrap();
    check_classes(&ball, &[("4", 6), ("6", 12)]);
    let Kind::Classes(classes) = &ball.kind else { panic!() };
    assert_eq!(classes.iter().find(|c| c.name == "6").unwrap().color, CLASS_COLORS[3], "without hue");
}

#[test]
fn many_neighbours_are_in_one_class() {
    let mut fan = "v 0 0 1\n".to_owned();
    (0..12).for_each(|i| {
        let (s, c) = (f64::from(i) * std::f64::consts::TAU / 12.0).sin_cos();
        fan += &format!("v {c} {s} 0\n");
    });
    (0..12).for_each(|i| fan += &format!("f 1 {} {}\n", i + 2, (i + 1) % 12 + 2));
    check_classes(&Example::obj(&fan).field("valence").unwrap(), &[("3", 12), ("≥ 9", 1)]);
}

#[test]
fn degrees_are_told_of_faces() {
    let field =
        Example::obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3 4\nf 2 5 3\n").field("degree").unwrap();
    assert!(field.at_faces);
    assert_eq!((field.text(0).as_deref(), field.text(1).as_deref(), field.text(2)), (Some("4"), Some("3"), None));
}

#[test]
fn a_ball_has_curvature_one_everywhere() {
    let ball = ball(3);
    for quantity in ["gauss", "mean"] {
        for x in ball.field(quantity).unwrap().numbers {
            assert!((x - 1.0).abs() < 0.03, "{quantity} {x}");
        }
    }
}

#[test]
fn a_smaller_ball_is_more_curved() {
    let mut small = ball(3).mesh;
    small.vertices().for_each(|v| small.set_position(v, small.position(v) / 2.0));
    let small = Example::of(small);
    assert!((small.field("mean").unwrap().numbers[7] - 2.0).abs() < 0.06);
    assert!((small.field("gauss").unwrap().numbers[7] - 4.0).abs() < 0.2);
}

#[test]
fn a_corner_of_a_cube_lacks_a_quarter_turn() {
    // Three squares of half an area of 4/3 each: of obtuse and right triangles the mixed area is that of the squares.
    let cube = Example::shipped("cube.obj");
    let defect = std::f64::consts::FRAC_PI_2;
    let total: f64 = cube.field("gauss").unwrap().numbers.iter().map(|k| defect / k).sum();
    let side = cube.mesh.position(Vertex::from_index(0).unwrap()).x.abs() * 2.0;
    assert!((total - 6.0 * side * side).abs() < 1e-9, "the areas make up the cube: {total}");
}

#[test]
fn a_saddle_has_negative_and_a_plane_no_curvature() {
    let grid = |height: fn(f64, f64) -> f64| {
        let mut text = String::new();
        for i in 0..5 {
            for j in 0..5 {
                let (x, y) = (f64::from(i) / 4.0 - 0.5, f64::from(j) / 4.0 - 0.5);
                text += &format!("v {x} {y} {}\n", height(x, y));
            }
        }
        for i in 0..4 {
            for j in 0..4 {
                let at = |i: i32, j: i32| 5 * i + j + 1;
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                text += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
            }
        }
        Example::obj(&text)
    };
    let middle = 12;
    assert!(grid(|x, y| x * x - y * y).field("gauss").unwrap().numbers[middle] < -1.0);
    let flat = grid(|_, _| 0.0);
    for quantity in ["gauss", "mean"] {
        let numbers = flat.field(quantity).unwrap().numbers;
        assert!(numbers[middle].abs() < 1e-12);
        assert!(numbers[0].is_nan(), "at the boundary it has no meaning");
    }
}

#[test]
fn what_was_born_and_what_moved_is_followed_through_new_numbers() {
    let before = Example::shipped("tetrahedron.obj").mesh;
    let mut mesh = before.clone();
    let first = Vertex::from_index(0).unwrap();
    // v2 is gone: v3 and v4 are v2 and v3 now, and v4 is new.
    let kept: Vec<Vertex> = [0, 2, 3].into_iter().filter_map(Vertex::from_index).collect();
    for (now, &old) in kept.iter().enumerate() {
        mesh.set_position(Vertex::from_index(now).unwrap(), before.position(old));
    }
    mesh.set_position(first, DVec3::splat(0.01));
    let example = Example { generation: 1, before: Some(before), ..Example::of(mesh) };
    example.lineage.add(0, &Survivors::default());
    example.lineage.add(1, &Survivors::Listed(kept.into()));
    let change = example.field("change").unwrap();
    check_classes(&change, &[("stayed", 2), ("moved", 1), ("born", 1)]);
    assert_eq!(change.note.as_deref(), Some("1 died"));
    assert_eq!(example.field("birth").unwrap().numbers, [0.0, 0.0, 0.0, 1.0]);
}

#[test]
fn properties_are_numbers_classes_or_colours() {
    let mut mesh = Example::shipped("tetrahedron.obj").mesh;
    let vertices: Vec<_> = mesh.vertices().collect();
    let double = mesh.declare_vertex_property("heat", Value::Double(0.5));
    mesh.set_vertex_value(double, vertices[1], Value::Double(f64::INFINITY));
    mesh.declare_vertex_property("count", Value::Int(-3));
    let flag = mesh.declare_vertex_property("flag", Value::Bool(false));
    mesh.set_vertex_value(flag, vertices[2], Value::Bool(true));
    mesh.declare_vertex_property("flow", Value::Vec(DVec3::new(3.0, 4.0, 0.0)));
    mesh.declare_vertex_property("next", Value::Vertex(None));
    let example = Example::of(mesh);

    let heat = example.field("heat").unwrap();
    assert_eq!((heat.text(0).as_deref(), heat.text(1)), (Some("0.5"), None));
    assert_eq!(example.field("count").unwrap().text(0).as_deref(), Some("-3"));
    check_classes(&example.field("flag").unwrap(), &[("false", 3), ("true", 1)]);
    assert_eq!(example.field("flow").unwrap().numbers, [5.0; 4]);
    assert_eq!(example.field("flow:color").unwrap().colors[0].to_le_bytes(), [255, 255, 0, 255]);
    assert_eq!(example.lacks("heat:color"), "property `heat` is no vec, which could be a colour");
    assert_eq!(example.lacks("next"), "property `next` names vertices, which have no colours");
    assert_eq!(example.lacks("hat"), "no vertex property `hat` here, only `heat`, `count`, `flag`, `flow`, `next`");
    assert_eq!(example.tint("heat").legend.without, 1);
}

#[test]
fn a_few_outliers_do_not_take_all_the_colours() {
    let mut mesh = ball(3).mesh;
    let heat = mesh.declare_vertex_property("heat", Value::Double(0.0));
    for (i, v) in mesh.vertices().enumerate() {
        mesh.set_vertex_value(heat, v, Value::Double(if i == 5 { 1e9 } else { i as f64 }));
    }
    let n = mesh.vertex_count() as f64;
    let field = Example::of(mesh).field("heat").unwrap();
    let [low, high] = automatic_range(&field);
    assert!((0.0..0.05 * n).contains(&low) && (0.95 * n..n).contains(&high), "{low} {high}");
}

#[test]
fn signed_numbers_have_zero_in_the_middle_of_their_range() {
    let torus = Example::shipped("torus.obj").tint("gauss");
    let [low, high] = torus.legend.range;
    assert_eq!(low, -high);
    assert_eq!(color(&torus.field.kind, 0.5), [0xdd; 3]);
}

#[test]
fn where_nearly_all_numbers_are_zero_the_others_decide_the_range() {
    let range = |numbers: Vec<f64>| {
        automatic_range(&Field { numbers, kind: Kind::Diverging, ..ball(0).field("gauss").unwrap() })
    };
    let few = |x: f64| [vec![0.0; 1000], vec![x]].concat();
    assert_eq!([range(few(2.0)), range(few(-3.0)), range(few(0.0))], [[-2.0, 2.0], [-3.0, 3.0], [-1.0, 1.0]]);
}

#[test]
fn a_range_that_is_none_is_not_taken() {
    let ball = ball(1);
    let field = Arc::new(ball.field("x").unwrap());
    let range = |range| Tint::of(Arc::clone(&field), &ball.scene, range).legend.range;
    assert_eq!(range(Some([0.25, 0.5])), [0.25, 0.5]);
    assert_eq!([range(Some([3.0, 1.0])), range(Some([1.0, 1.0]))], [range(None); 2]);
}

#[test]
fn the_last_class_of_valences_is_called_by_the_one_number_in_it() {
    let last = |n: usize| {
        let corners: String = (0..n).map(|i| (i as f64).sin_cos()).map(|(s, c)| format!("v {c} {s} 0\n")).collect();
        let faces: String = (0..n).map(|i| format!("f 1 {} {}\n", i + 2, (i + 1) % n + 2)).collect();
        let field = Example::obj(&format!("v 0 0 1\n{corners}{faces}")).field("valence").unwrap();
        let Kind::Classes(classes) = field.kind else { panic!("valences are classes") };
        classes.last().unwrap().name.clone()
    };
    assert_eq!([last(9), last(10)], ["9", "≥ 9"]);
}

/// M. Meyer et al., figure 4: half of the triangle at the obtuse angle.
#[test]
fn a_flat_apex_has_half_of_its_obtuse_triangles() {
    let apex = "v 0 0 0.25\nv 1 0 0\nv -0.5 0.8660254037844386 0\nv -0.5 -0.8660254037844386 0\n";
    let field = Example::obj(&format!("{apex}f 1 2 3\nf 1 3 4\nf 1 4 2\n")).field("gauss").unwrap();
    let (square, dot) = (1.0 + 0.0625, -0.5 + 0.0625);
    let (angle, area) = (f64::acos(dot / square), f64::sqrt(square * square - dot * dot) / 2.0);
    let expected = (std::f64::consts::TAU - 3.0 * angle) / (3.0 * area / 2.0);
    assert!((field.numbers[0] - expected).abs() < 1e-9, "{} is not {expected}", field.numbers[0]);
}

#[test]
fn each_corner_gets_the_word_of_its_vertex_or_face() {
    let ball = ball(1);
    let tint = ball.tint("x");
    assert_eq!(tint.reading, Reading::Numbers);
    let [shift, factor] = tint.window();
    for (word, owner) in tint.words.iter().zip(&ball.scene.mesh.owners) {
        let t = (f32::from_bits(*word) - shift) * factor;
        let [low, high] = tint.legend.range;
        let expected = (ball.mesh.position(*owner).x - low) / (high - low);
        assert!((f64::from(t) - expected).abs() < 1e-6);
    }
    let degrees = ball.tint("degree");
    for triangle in &ball.scene.mesh.triangles {
        assert_eq!(f32::from_bits(degrees.words[triangle[0] as usize]), 3.0, "triangles are usual");
    }
}

#[test]
fn a_histogram_counts_what_lies_in_the_range() {
    let tint = ball(2).tint("y");
    let n = tint.field.numbers.len() as u32;
    let counted: u32 = tint.legend.histogram.iter().sum();
    assert!(counted <= n && counted >= n - 4, "{counted} of {n}");
    let upper = tint.with_range(Some([0.0, 2.0]));
    let positive = tint.field.numbers.iter().filter(|y| **y >= 0.0).count() as u32;
    assert_eq!(upper.legend.histogram.iter().sum::<u32>(), positive);
    assert!(Arc::ptr_eq(&tint.words, &upper.words), "the GPU has them already");
}

#[test]
fn a_cell_answers_what_was_found_and_nothing_else() {
    let (example, cell, never) = (ball(1), Cell::default(), Stop::new());
    let mut asked = Annotations { color_by: Quantity::Valence, ..Annotations::default() };
    assert!(!cell.answers(&asked) && cell.answers(&Annotations::default()));
    cell.find(&example.subject(), &asked, &never);
    assert!(cell.answers(&asked) && cell.colors(&Quantity::Valence).is_some());
    asked.range = Some([0.0, 1.0]);
    assert!(!cell.answers(&asked) && cell.colors(&Quantity::Valence).is_some(), "those of before, meanwhile");
    asked.color_by = Quantity::Change;
    cell.find(&example.subject(), &asked, &never);
    assert_eq!(cell.colors(&Quantity::Change).unwrap().unwrap_err(), "generation 0 has none before it");
    let stopped = Stop::new();
    stopped.request(vv::stop::Stopped::ByUser);
    asked.color_by = Quantity::Mean;
    cell.find(&example.subject(), &asked, &stopped);
    assert!(!cell.answers(&asked));
}

#[test]
fn numbers_are_short() {
    let shown = [0.0, 1.0, -0.25, 1234.56, 99999.0, 0.001234, 1e-7, -2.5e8].map(short);
    assert_eq!(shown, ["0", "1", "-0.25", "1235", "99999", "0.001234", "1.00e-7", "-2.50e8"]);
}

mod labels {
    use glam::{DQuat, DVec2};

    use super::*;
    use crate::annotate::labels::{Label, MOST, Outlook, Placed, place};
    use crate::camera::Camera;
    use crate::scene::{Axis, Cut, Style};

    const SIZE: DVec2 = DVec2::new(800.0, 600.0);

    fn outlook(example: &Example) -> Outlook {
        let style = Style::default();
        let camera = example.scene.standard_view(&style, SIZE.x / SIZE.y);
        let camera = Camera { world_from_view: DQuat::IDENTITY, ..camera };
        Outlook { camera: example.scene.fit(camera, &style, SIZE.x / SIZE.y), style, size: SIZE }
    }

    fn placed(example: &Example, label: &Label, outlook: &Outlook) -> Vec<Placed> {
        example.scene.build_index();
        place(&example.subject(), label, outlook, &[], &Stop::new()).unwrap()
    }

    fn texts(example: &Example, label: &Label) -> Vec<String> {
        placed(example, label, &outlook(example)).into_iter().map(|p| p.text).collect()
    }

    #[test]
    fn vertices_are_called_by_their_names_where_they_are_seen() {
        // Seen from the front, of an octahedron one vertex is hidden.
        let example = ball(0);
        // What faces the eye comes first; the others are on the outline.
        assert_eq!(texts(&example, &Label::Vertices), ["v3", "v1", "v2", "v4", "v5"]);
        let open = Outlook { style: Style { faces: false, ..Style::default() }, ..outlook(&example) };
        // v6 stands behind v3, where there is no room.
        assert_eq!(placed(&example, &Label::Vertices, &open).len(), 5);
    }

    #[test]
    fn faces_tell_how_many_corners_they_have() {
        assert_eq!(texts(&ball(0), &Label::Degrees), ["3"; 4]);
    }

    #[test]
    fn values_of_properties_are_written_as_numbers_are() {
        let mut mesh = ball(0).mesh;
        mesh.declare_vertex_property("heat", Value::Double(0.1 + 0.2));
        mesh.declare_vertex_property("flow", Value::Vec(DVec3::new(1.0, -0.5, 0.0)));
        mesh.declare_vertex_property("next", Value::Vertex(None));
        let example = Example::of(mesh);
        assert_eq!(texts(&example, &Label::Property("heat".to_owned()))[0], "0.3");
        assert_eq!(texts(&example, &Label::Property("flow".to_owned()))[0], "1 -0.5 0");
        assert_eq!(texts(&example, &Label::Property("next".to_owned()))[0], "null");
        assert!(texts(&example, &Label::Property("none".to_owned())).is_empty());
    }

    #[test]
    fn labels_of_a_dense_mesh_do_not_overlap_and_are_not_too_many() {
        let example = ball(5);
        let outlook = outlook(&example);
        let placed = placed(&example, &Label::Vertices, &outlook);
        assert!(placed.len() > 100 && placed.len() <= MOST, "{}", placed.len());
        let clip = outlook.camera.clip_from_view(SIZE.x / SIZE.y) * outlook.camera.view_from_world();
        let at = |p: &Placed| {
            let c = clip * p.at.extend(1.0);
            DVec2::new(c.x, c.y) / c.w * SIZE / 2.0
        };
        for (i, a) in placed.iter().enumerate() {
            assert!(a.at.z > 0.0, "{} faces away", a.text);
            for b in &placed[..i] {
                let apart = (at(a) - at(b)).abs();
                assert!(apart.x >= 30.0 || apart.y >= 19.0, "{} and {}", a.text, b.text);
            }
        }
        assert_eq!(placed[0].text, "v3", "old vertices come first");
    }

    #[test]
    fn labels_stay_while_the_camera_moves_a_little() {
        let example = ball(5);
        let before = outlook(&example);
        let first = placed(&example, &Label::Vertices, &before);
        let turned = before.camera.orbit(DVec2::ZERO, DVec2::new(0.01, 0.0));
        let after = Outlook { camera: turned, ..before };
        let then = place(&example.subject(), &Label::Vertices, &after, &first, &Stop::new()).unwrap();
        let stayed = then.iter().filter(|p| first.iter().any(|q| q.element == p.element)).count();
        assert!(stayed * 10 > first.len() * 9, "{stayed} of {}", first.len());
    }

    #[test]
    fn what_is_cut_away_has_no_labels_and_hides_none() {
        let example = ball(3);
        let cut = Cut { on: true, across: Axis::Z, ..Cut::default() };
        let open = Outlook { style: Style { cut, ..Style::default() }, ..outlook(&example) };
        let placed = placed(&example, &Label::Vertices, &open);
        assert!(placed.len() > 20);
        assert!(placed.iter().all(|p| p.at.z < 1e-9));
    }
}

mod arrows {
    use super::*;
    use crate::annotate::{ArrowSet, Arrows};

    fn arrows(example: &Example, arrows: &Arrows) -> ArrowSet {
        ArrowSet::new(&example.subject(), arrows, &Stop::new()).unwrap()
    }

    #[test]
    fn one_in_twenty_arrows_is_longer_than_the_unit() {
        let mut mesh = Mesh::new();
        let wind = mesh.declare_vertex_property("wind", Value::Vec(DVec3::ZERO));
        for i in 1..=101 {
            let v = mesh.create().unwrap();
            mesh.set_vertex_value(wind, v, Value::Vec(DVec3::X * f64::from(i)));
        }
        assert_eq!(arrows(&Example::of(mesh), &Arrows::Property("wind".to_owned())).unit, 96.0);
    }

    #[test]
    fn normals_of_a_ball_point_outwards() {
        let example = ball(2);
        for (what, count) in [(Arrows::VertexNormals, example.mesh.vertex_count()), (Arrows::FaceNormals, 128)] {
            let set = arrows(&example, &what);
            assert_eq!((set.arrows.len(), set.every), (count, 1));
            for [x, y, z, u, v, w] in set.arrows {
                let (p, n) = (DVec3::new(x.into(), y.into(), z.into()), DVec3::new(u.into(), v.into(), w.into()));
                assert!((n.length() - 1.0).abs() < 1e-3 && p.normalize().dot(n) > 0.99, "{what:?} {p} {n}");
            }
        }
    }

    #[test]
    fn a_property_is_measured_by_its_longest_but_for_a_few() {
        let mut mesh = ball(2).mesh;
        let flow = mesh.declare_vertex_property("flow", Value::Vec(DVec3::new(0.0, 3.0, 0.0)));
        let first = Vertex::from_index(0).unwrap();
        mesh.set_vertex_value(flow, first, Value::Vec(DVec3::new(900.0, 0.0, 0.0)));
        mesh.set_vertex_value(flow, Vertex::from_index(1).unwrap(), Value::Vec(DVec3::ZERO));
        mesh.set_vertex_value(flow, Vertex::from_index(2).unwrap(), Value::Vec(DVec3::splat(f64::NAN)));
        let example = Example::of(mesh);
        let set = arrows(&example, &Arrows::Property("flow".to_owned()));
        assert_eq!((set.unit, set.arrows.len()), (3.0, example.mesh.vertex_count() - 2));
        assert_eq!((set.arrows[0][3], set.arrows[1][4]), (300.0, 1.0));
        let lacking = ArrowSet::new(&example.subject(), &Arrows::Property("heat".to_owned()), &Stop::new());
        assert_eq!(lacking, Err(NoField::Missing("no vertex property `heat` of type vec here".to_owned())));
    }
}
