//! What is shown on a surface beside the surface: colours, stripes, cuts, the ground.

use std::sync::Arc;

use app::annotate::{ArrowSet, Arrows, Field, Quantity, Subject, Tint};
use app::camera::Up;
use app::inspect::lineage::Lineage;
use app::render::Dressing;
use app::scene::{Axis, Cut, Surface};
use vv::mesh::faces::faces;
use vv::stop::Stop;

use super::*;

/// Nothing but faces, seen from the front, on nothing.
fn plain() -> Style {
    Style { edges: false, smooth: true, transparent: true, ..Style::default() }
}

fn from_front(scene: &Scene) -> Camera {
    let camera = Camera { world_from_view: DQuat::IDENTITY, ..standard(scene, &plain()) };
    scene.fit(camera, &plain(), SIZE.aspect())
}

fn seen_from_front(mesh: &Mesh, style: &Style) -> RgbaImage {
    let scene = scene(mesh);
    headless().image(&scene, &from_front(&scene), style, SIZE).unwrap()
}

/// How often the brightness along the middle row turns from dark to light or back, by much.
fn changes(picture: &RgbaImage) -> usize {
    let y = SIZE.height / 2;
    let row = (0..SIZE.width).map(|x| picture.get_pixel(x, y)).filter(|p| p.0[3] == 255);
    let bright: Vec<bool> = row.map(|p| p.0[1] > 110).collect();
    bright.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

#[test]
fn reflection_lines_and_isophotes_are_stripes() {
    let ball = ball(24);
    assert_eq!(changes(&seen_from_front(&ball, &plain())), 0, "a ball in its light alone");
    for surface in [Surface::ReflectionLines, Surface::Isophotes] {
        let n = changes(&seen_from_front(&ball, &Style { surface, ..plain() }));
        assert!((10..60).contains(&n), "{surface:?}: {n}");
    }
}

/// The part of the picture's left, right, upper and lower half that is covered.
fn covered(picture: &RgbaImage) -> [f64; 4] {
    let (w, h) = picture.dimensions();
    let part = |inside: &dyn Fn(u32, u32) -> bool| {
        let count = picture.enumerate_pixels().filter(|(x, y, p)| inside(*x, *y) && p.0[3] > 0).count();
        count as f64 / f64::from(w * h / 2)
    };
    [part(&|x, _| x < w / 2), part(&|x, _| x >= w / 2), part(&|_, y| y < h / 2), part(&|_, y| y >= h / 2)]
}

#[test]
fn what_lies_beyond_a_cut_is_background() {
    let ball = ball(24);
    let cut = |across, flipped| {
        let cut = Cut { on: true, across, flipped, position: 0.0 };
        covered(&seen_from_front(&ball, &Style { edges: true, vertices: true, cut, ..plain() }))
    };
    let [left, right, ..] = cut(Axis::X, false);
    assert!(left > 0.3 && right < 0.02, "{left} {right}");
    let [left, right, ..] = cut(Axis::X, true);
    assert!(right > 0.3 && left < 0.02, "{left} {right}");
    let [.., upper, lower] = cut(Axis::Y, false);
    assert!(lower > 0.3 && upper < 0.02, "{upper} {lower}");
}

#[test]
fn a_cut_across_the_line_of_sight_opens_the_mesh() {
    let style = Style { cut: Cut { on: true, across: Axis::View, ..Cut::default() }, ..plain() };
    let (closed, open) = (seen_from_front(&ball(24), &plain()), seen_from_front(&ball(24), &style));
    let middle = |picture: &RgbaImage| picture.get_pixel(SIZE.width / 2, SIZE.height / 2).0;
    assert!(middle(&closed)[2] > middle(&closed)[0], "blue outside: {:?}", middle(&closed));
    assert!(middle(&open)[0] > middle(&open)[2], "warm inside: {:?}", middle(&open));
}

#[test]
fn the_place_of_a_cut_goes_from_one_end_of_the_mesh_to_the_other() {
    let seen = |position| {
        let cut = Cut { on: true, across: Axis::X, flipped: false, position };
        let [left, right, ..] = covered(&seen_from_front(&ball(24), &Style { cut, ..plain() }));
        left + right
    };
    assert!(seen(-1.0) < 0.01 && seen(-0.5) < seen(0.0) && seen(0.0) < seen(0.5) && seen(0.5) < seen(1.0));
    assert_eq!(seen(1.0), {
        let [left, right, ..] = covered(&seen_from_front(&ball(24), &plain()));
        left + right
    });
}

#[test]
fn the_grid_lies_across_the_axis_that_points_up() {
    let ball = scene(&ball(24));
    let covered_by = |up| covered(&draw(&ball, &Style { grid: true, up, ..plain() }));
    let ([.., y_above, _], [.., z_above, _]) = (covered_by(Up::Y), covered_by(Up::Z));
    assert!(z_above > y_above + 0.1, "upright in the standard view: {z_above} {y_above}");
}

fn tinted(mesh: &Mesh, quantity: &Quantity, style: &Style) -> RgbaImage {
    let scene = scene(mesh);
    let faces = faces(mesh, &Stop::new()).unwrap();
    let lineage = Lineage::default();
    let subject =
        Subject { mesh, faces: &faces, scene: &scene, generation: 0, before: None, lineage: &lineage, tint: None };
    let field = Field::new(&subject, quantity, &Stop::new()).unwrap();
    let tint = Tint::of(Arc::new(field), &scene, None);
    let dressing = Dressing { tint: Some(&tint), arrows: None };
    headless().dressed_image(&scene, dressing, &from_front(&scene), style, SIZE).unwrap()
}

#[test]
fn small_numbers_are_violet_and_large_ones_yellow() {
    let picture = tinted(&ball(24), &Quantity::Coordinate(0), &plain());
    let at = |part: f64| picture.get_pixel((f64::from(SIZE.width) * part) as u32, SIZE.height / 2).0;
    let (low, high) = (at(0.2), at(0.8));
    assert!(low[2] > low[1] && low[2] > low[0], "{low:?}");
    assert!(high[0] > 120 && high[1] > 120 && high[2] < 100, "{high:?}");
}

#[test]
fn each_face_has_the_colour_of_its_class_alone() {
    // A square, which is usual, and a triangle on either side of it.
    let mesh = mesh(
        &[[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [2.0, 0.0, 0.0], [1.5, 1.5, 0.0]],
        &[&[0, 1, 2, 3], &[1, 4, 5, 2], &[2, 5, 3]],
    );
    let picture = tinted(&mesh, &Quantity::Degree, &Style { smooth: false, ..plain() });
    let colors: std::collections::BTreeSet<_> = picture.pixels().filter(|p| p.0[3] == 255).map(|p| p.0).collect();
    let hues = colors.iter().filter(|c| c[2].abs_diff(c[0]) > 40).count();
    let greys = colors.iter().filter(|c| c[2].abs_diff(c[0]) <= 40).count();
    assert!(hues > 0 && greys > 0, "{hues} {greys}");
    let faces = compare_pictures(&picture, &seen_from_front(&mesh, &plain()), 0.1);
    assert!(faces.is_err());
}

#[test]
fn the_grid_lies_below_the_mesh_and_reaches_around_it() {
    let ball = scene(&ball(24));
    let style = Style { grid: true, ..plain() };
    let picture = draw(&ball, &style);
    let without = draw(&ball, &plain());
    let [.., upper, lower] = covered(&picture);
    let [.., upper_without, lower_without] = covered(&without);
    assert!(lower > lower_without + 0.1, "{lower} {lower_without}");
    assert!(upper - upper_without < lower - lower_without);
    let middle = |picture: &RgbaImage| *picture.get_pixel(SIZE.width / 2, SIZE.height / 2);
    assert_eq!(middle(&picture), middle(&without), "the mesh hides it");
}

#[test]
fn normals_stand_out_of_the_outline() {
    let mesh = ball(10);
    let scene = scene(&mesh);
    let faces = faces(&mesh, &Stop::new()).unwrap();
    let lineage = Lineage::default();
    let subject = Subject {
        mesh: &mesh,
        faces: &faces,
        scene: &scene,
        generation: 0,
        before: None,
        lineage: &lineage,
        tint: None,
    };
    let set = ArrowSet::new(&subject, &Arrows::VertexNormals, &Stop::new()).unwrap();
    let camera = Camera { distance: 1.5 * from_front(&scene).distance, ..from_front(&scene) };
    let drawn = |length| {
        let dressing = Dressing { tint: None, arrows: Some((&set, length)) };
        headless().dressed_image(&scene, dressing, &camera, &plain(), SIZE).unwrap()
    };
    let reach = |picture: &RgbaImage| picture.enumerate_pixels().filter(|(.., p)| p.0[3] > 0).map(|(x, ..)| x).max();
    let (none, short, long) = (reach(&drawn(0.0)), reach(&drawn(0.5)), reach(&drawn(1.0)));
    assert!(none < short && short < long, "{none:?} {short:?} {long:?}");
}

#[test]
fn hollows_are_darker_and_what_stands_out_is_as_it_was() {
    let brightness = |mesh: &Mesh, occlusion, at: [f64; 2]| {
        let scene = scene(mesh);
        let style = Style { occlusion, smooth: false, ..plain() };
        let camera = Camera { world_from_view: DQuat::from_rotation_x(-1.1), ..standard(&scene, &style) };
        let camera = scene.fit(camera, &style, SIZE.aspect());
        let picture = headless().image(&scene, &camera, &style, SIZE).unwrap();
        let [x, y] = [at[0] * f64::from(SIZE.width), at[1] * f64::from(SIZE.height)].map(|c| c as u32);
        f64::from(picture.get_pixel(x, y).0[1])
    };
    let darker = |mesh: &Mesh, at| brightness(mesh, true, at) / brightness(mesh, false, at);
    // From above into a box without lid: where its bottom meets the wall.
    let inside = darker(&box_without_lid(), [0.5, 0.36]);
    assert!(inside < 0.85, "{inside}");
    let outside = darker(&ball(24), [0.5, 0.5]);
    assert!(outside > 0.97, "{outside}");
}
