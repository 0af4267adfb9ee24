mod noted;

use std::f64::consts::TAU;
use std::fmt::Write as _;

use glam::{DVec3, DVec4};

use super::*;
use crate::viewpoint::{Viewpoint, parse};
use vv::io::{Format as MeshFormat, ReadOptions, read};
use vv::mesh::faces::faces;

struct Case {
    mesh: Mesh,
    faces: Faces,
    scene: Scene,
}

impl Case {
    fn new(obj: &str) -> Self {
        let (mesh, _) = read(obj.as_bytes(), MeshFormat::Obj, &ReadOptions::default()).unwrap();
        let faces = faces(&mesh, &Stop::new()).unwrap();
        let scene = Scene::new(&mesh, &faces, None, &Stop::new()).unwrap();
        Self { mesh, faces, scene }
    }

    fn camera(&self, orthographic: bool) -> Camera {
        let camera = Camera { orthographic, ..Camera::standard(self.scene.bounds(&Style::default()), 1.0) };
        self.scene.fit(camera, &Style::default(), 1.0)
    }

    fn draw_from(&self, camera: &Camera, style: &Style, settings: &Settings) -> Option<Drawing> {
        draw(self.subject(&Notes::default()), camera, 1.0, style, settings, &Stop::new()).unwrap()
    }

    fn subject<'a>(&'a self, notes: &'a Notes) -> Subject<'a> {
        Subject { scene: &self.scene, mesh: &self.mesh, faces: &self.faces, tint: None, notes }
    }

    fn draw(&self, settings: &Settings) -> Drawing {
        self.draw_from(&self.camera(false), &Style { faces: false, ..Style::default() }, settings).unwrap()
    }

    /// How many straight lines of each class there are, and where.
    #[track_caller]
    fn check(&self, expected: &str) {
        let mut text = String::new();
        for layer in self.draw(&with_hidden()).layers {
            if let Layer::Lines { name, paths, .. } = layer {
                let count: usize = paths.iter().map(|p| p.points.len() - usize::from(!p.closed)).sum();
                let _ = write!(text, "{count} {name}, ");
            }
        }
        assert_eq!(text.trim_end_matches(", "), expected);
    }
}

fn with_hidden() -> Settings {
    let mut settings = Settings::default();
    settings.lines[Class::Hidden as usize] = Some(Settings::line(Class::Hidden));
    settings
}

const CUBE: &str = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
                    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";

/// An L, one thick, its faces with six corners seen from the front and the back.
const L: &str = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\n\
                 v 0 2 1\nf 6 5 4 3 2 1\nf 7 8 9 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\n\
                 f 6 1 7 12\n";

#[test]
fn a_cube_shows_nine_edges_and_hides_three() {
    Case::new(CUBE).check("3 hidden, 3 inner, 6 outline");
}

#[test]
fn a_concave_face_hides_only_what_is_behind_it() {
    // From the right and above: back, left and lower side are not seen, nor what lies between them.
    Case::new(L).check("3 hidden, 7 inner, 8 outline");
    // A wire behind it, half of it behind the notch.
    let case = Case::new(&format!("{L}v 1.5 1.5 -1\nv 0.5 0.5 -1\nl 13 14\n"));
    let camera = case.camera(true).from_side(crate::camera::Side::Front, crate::camera::Up::Y);
    assert_half_hidden(&case, &camera);
}

#[test]
fn an_open_mesh_has_a_boundary_and_shows_its_inside() {
    // Inside, an upper piece of the edge at the back is seen.
    Case::new(&CUBE.replace("f 3 4 8 7\n", "")).check("3 hidden, 2 inner, 4 outline, 4 boundary");
}

#[test]
fn a_cut_is_lined() {
    let case = Case::new(CUBE);
    let cut = crate::scene::Cut { on: true, ..Default::default() };
    let style = Style { cut, ..Style::default() };
    let drawing = case.draw_from(&case.camera(false), &style, &Settings::default()).unwrap();
    let boundary = drawing.layers.iter().find_map(|layer| match layer {
        Layer::Lines { name: "boundary", paths, .. } => Some(paths),
        _ => None,
    });
    // A square, its four sides seen from where the other half was.
    assert!(matches!(&boundary.unwrap()[..], [path] if path.closed && path.points.len() == 4), "{boundary:?}");
}

#[test]
fn creases_are_lines_of_their_own() {
    let mut case = Case::new(&format!("{CUBE}t crease 2/1/0 6 7 2\n"));
    case.check("3 hidden, 2 inner, 6 outline, 1 crease");
    // Whole numbers are as sharp, as PLY files may have them.
    case.mesh.declare_edge_property("sharpness", vv::mesh::Value::Int(0));
    case.check("3 hidden, 2 inner, 6 outline, 1 crease");
}

#[test]
fn a_line_ends_where_it_pierces_a_face() {
    // A wire from before a square to behind it.
    let case = Case::new("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 1\nv 0 0 -1\nf 1 2 3 4\nl 5 6\n");
    assert_half_hidden(&case, &case.camera(true));
}

/// The second half of the wire, the one line that no face has, is hidden.
#[track_caller]
fn assert_half_hidden(case: &Case, camera: &Camera) {
    let space = Space::new(camera, 1.0, &Style::default().cut, case.scene.bounds(&Style::default()));
    let surface = Surface::new(&case.scene, &case.mesh, &space, false);
    let hider = Hider::new(&surface.triangles);
    let is_wire = |edge: &&Edge| !surface.triangles.iter().any(|t| t.whole.contains(&edge.whole[0]));
    let hidden = hider.hidden(surface.edges.iter().find(is_wire).unwrap());
    assert!(matches!(hidden[..], [(low, high)] if (low - 0.5).abs() < 1e-6 && high > 0.6), "{hidden:?}");
}

fn torus(text: &mut String, center: DVec3, upright: bool, first: &mut usize) {
    const AROUND: usize = 18;
    const ACROSS: usize = 9;
    for i in 0..AROUND {
        for j in 0..ACROSS {
            let (u, v) = (TAU * i as f64 / AROUND as f64, TAU * j as f64 / ACROSS as f64);
            let (r, z) = (1.0 + 0.4 * v.cos(), 0.4 * v.sin());
            let p = DVec3::new(r * u.cos(), r * u.sin(), z);
            let p = center + if upright { DVec3::new(p.x, -p.z, p.y) } else { p };
            let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
        }
    }
    for i in 0..AROUND {
        for j in 0..ACROSS {
            let at = |i: usize, j: usize| *first + (i % AROUND) * ACROSS + j % ACROSS;
            let _ = writeln!(text, "f {} {} {} {}", at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    *first += AROUND * ACROSS;
}

fn tori(apart: f64) -> String {
    let (mut text, mut first) = (String::new(), 1);
    torus(&mut text, DVec3::ZERO, false, &mut first);
    torus(&mut text, DVec3::new(apart, 0.1, 0.05), true, &mut first);
    text
}

/// Quadrilaterals far from flat.
fn saddles() -> String {
    const SIDE: usize = 7;
    let mut text = String::new();
    for i in 0..SIDE * SIDE {
        let (x, y) = (i % SIDE, i / SIDE);
        let z = if (x + y) % 2 == 0 { 0.6 } else { -0.55 } + 0.02 * ((7 * i) % 11) as f64;
        let _ = writeln!(text, "v {} {z} {}", x as f64 + 0.03 * (i % 5) as f64, -(y as f64));
    }
    for y in 1..SIDE {
        for x in 1..SIDE {
            let at = |x: usize, y: usize| y * SIDE + x + 1;
            let _ = writeln!(text, "f {} {} {} {}", at(x - 1, y - 1), at(x, y - 1), at(x, y), at(x - 1, y));
        }
    }
    text
}

/// Tetrahedra that touch in their corners.
fn sierpinski(depth: u32) -> String {
    let corner = [(1.0, 1.0, 1.0), (-1.0, 1.0, -1.0), (1.0, -1.0, -1.0), (-1.0, -1.0, 1.0)].map(DVec3::from);
    let mut parts = vec![(DVec3::ZERO, 1.0)];
    for _ in 0..depth {
        parts = parts.iter().flat_map(|&(c, s)| corner.map(|k| (c + k * (s / 2.0), s / 2.0))).collect();
    }
    let mut text = String::new();
    for (i, (center, size)) in parts.iter().enumerate() {
        for p in corner.map(|k| *center + k * *size) {
            let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
        }
        for face in [[1, 2, 3], [1, 4, 2], [1, 3, 4], [2, 4, 3]] {
            let _ = writeln!(text, "f {} {} {}", 4 * i + face[0], 4 * i + face[1], 4 * i + face[2]);
        }
    }
    text
}

/// Pixels a side.
const PIXELS: usize = 600;

/// The triangle seen at each pixel, found by depth with the matrices of the window's pictures.
struct Buffer {
    corners: Vec<[DVec3; 3]>,
    seen: Vec<(f64, usize)>,
}

const NOTHING: usize = usize::MAX;

impl Buffer {
    fn new(triangles: &[[DVec4; 3]]) -> Self {
        let corners: Vec<_> = triangles.iter().map(|t| t.map(|c| c.truncate() / c.w)).collect();
        let mut seen = vec![(f64::NEG_INFINITY, NOTHING); PIXELS * PIXELS];
        let pixel = |x: f64| (((x + 1.0) / 2.0 * PIXELS as f64).max(0.0) as usize).min(PIXELS - 1);
        for (number, t) in corners.iter().enumerate() {
            let (low, high) = (t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2]));
            for j in pixel(low.y)..=pixel(high.y) {
                for i in pixel(low.x)..=pixel(high.x) {
                    let center = DVec2::new(i as f64 + 0.5, j as f64 + 0.5) * 2.0 / PIXELS as f64 - 1.0;
                    let Some((inside, depth)) = depth(t, center) else { continue };
                    let best = &mut seen[j * PIXELS + i];
                    if inside && depth > best.0 {
                        *best = (depth, number);
                    }
                }
            }
        }
        Self { corners, seen }
    }

    /// Whether a point is hidden; `None` where that changes from pixel to pixel. `own` says which triangles have the edge.
    fn hides(&self, at: DVec3, own: impl Fn(usize) -> bool) -> Option<bool> {
        let pixel = |x: f64| ((x + 1.0) / 2.0 * PIXELS as f64) as usize;
        let (i, j) = (pixel(at.x), pixel(at.y));
        let verdict = |i: usize, j: usize| {
            let (_, number) = self.seen[j * PIXELS + i];
            number != NOTHING
                && !own(number)
                && depth(&self.corners[number], at.truncate()).is_some_and(|(_, depth)| depth > at.z + 1e-9)
        };
        let first = verdict(i, j);
        let around = (i - 1..=i + 1).flat_map(|i| (j - 1..=j + 1).map(move |j| (i, j)));
        around.into_iter().all(|(i, j)| verdict(i, j) == first).then_some(first)
    }
}

/// Whether a triangle covers a place, and its depth there.
fn depth(t: &[DVec3; 3], p: DVec2) -> Option<(bool, f64)> {
    let side = |a: DVec3, b: DVec3| (b - a).truncate().perp_dot(p - a.truncate());
    let weights = [side(t[1], t[2]), side(t[2], t[0]), side(t[0], t[1])];
    let area: f64 = weights.iter().sum();
    let inside = weights.iter().all(|w| w * area >= 0.0);
    (area.abs() > 1e-12).then(|| (inside, (0..3).map(|i| weights[i] / area * t[i].z).sum()))
}

/// Compares what is seen along all edges with a depth buffer: less than 0.1 % of their length may differ.
#[track_caller]
fn check_hidden(obj: &str, orthographic: bool) {
    let case = Case::new(obj);
    let camera = case.camera(orthographic);
    let bounds = case.scene.bounds(&Style::default());
    let space = Space::new(&camera, 1.0, &Style::default().cut, bounds);
    let surface = Surface::new(&case.scene, &case.mesh, &space, false);
    let hider = Hider::new(&surface.triangles);

    let clip_from_world = camera.clip_from_view_within(1.0, bounds) * camera.view_from_world();
    let place = |v: u32| case.scene.mesh.vertex(v).map(|v| case.mesh.position(v)).unwrap();
    let clip = |v: u32| clip_from_world * place(v).extend(1.0);
    let buffer = Buffer::new(&surface.triangles.iter().map(|t| t.whole.map(clip)).collect::<Vec<_>>());

    let (mut compared, mut skipped, mut wrong) = (0.0, 0.0, 0.0);
    for edge in &surface.edges {
        let hidden = hider.hidden(edge);
        let own = |number: usize| edge.whole.iter().all(|v| surface.triangles[number].whole.contains(v));
        let [a, b] = edge.whole.map(clip);
        let length = edge.ends[0].truncate().distance(edge.ends[1].truncate());
        let samples = (length * PIXELS as f64 / 2.0).ceil();
        for i in 0..samples as usize {
            let t = (i as f64 + 0.5) / samples;
            // Places between the ends in the picture are not in proportion to those in the world.
            let s = t * a.w / (t * a.w + (1.0 - t) * b.w);
            let p = a.lerp(b, s);
            let p = p.truncate() / p.w;
            let here = edge.ends[0].lerp(edge.ends[1], t);
            assert!(p.truncate().distance(here.truncate()) < 1e-9, "the picture is another one");
            let is_hidden = hidden.iter().any(|&(low, high)| (low..high).contains(&t));
            let share = length / samples;
            match buffer.hides(p, own) {
                None => skipped += share,
                Some(expected) => {
                    compared += share;
                    wrong += if expected == is_hidden { 0.0 } else { share };
                }
            }
        }
    }
    assert!(skipped < 0.4 * compared, "{skipped} of {compared} were too near to other edges");
    assert!(wrong <= 1e-3 * compared, "{wrong} of {compared} differ");
}

#[test]
fn hidden_lines_are_those_that_a_depth_buffer_hides() {
    for orthographic in [false, true] {
        check_hidden(CUBE, orthographic);
        check_hidden(L, orthographic);
        check_hidden(&tori(1.0), orthographic);
        check_hidden(&tori(0.55), orthographic); // they pierce each other
        check_hidden(&saddles(), orthographic);
        check_hidden(&sierpinski(3), orthographic);
    }
}

/// Looks through the picture at many places: what was painted last there is what is nearest.
#[track_caller]
fn check_order(obj: &str, orthographic: bool) {
    let case = Case::new(obj);
    let part = &case.scene.mesh;
    let camera = case.camera(orthographic);
    let space = Space::new(&camera, 1.0, &Style::default().cut, case.scene.bounds(&Style::default()));
    let surface = Surface::new(&case.scene, &case.mesh, &space, false);
    let face_of: Vec<u32> = surface.triangles.iter().map(|t| part.triangle_faces[t.number as usize]).collect();
    let hidden = covered::covered(&surface.triangles, &face_of, case.faces.len(), &Stop::new()).unwrap();
    let seen = surface.triangles.iter().zip(&face_of).filter(|(_, face)| !hidden[**face as usize]);
    let (triangles, faces_seen): (Vec<_>, Vec<u32>) = seen.map(|(triangle, face)| (*triangle, *face)).unzip();
    let broken = vec![false; case.faces.len()];
    let order = order::order(&triangles, &faces_seen, &broken, &Stop::new()).unwrap();
    assert!(order.is_exact);
    let polygon = |face: u32| -> Vec<DVec2> {
        let corners = case.faces.get(face as usize).iter().map(|v| surface.corner_of[v.index()]);
        corners.map(|c| space.project(surface.points[c as usize]).truncate()).collect()
    };
    let areas: Vec<(Vec<DVec2>, u32)> = order
        .painted
        .iter()
        .map(|painted| match painted {
            order::Painted::Whole(face) => (polygon(*face), *face),
            order::Painted::Piece(corners, number) => (corners.clone(), faces_seen[*number as usize]),
        })
        .collect();
    let covers = |corners: &[DVec2], p: DVec2| {
        let crosses =
            |(a, b): (DVec2, DVec2)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y);
        (0..corners.len()).filter(|&i| crosses((corners[i], corners[(i + 1) % corners.len()]))).count() % 2 == 1
    };
    let (mut covered, mut wrong) = (0, 0);
    for i in 0..70 * 70 {
        // Not where the symmetry of a mesh puts its edges.
        let p = DVec2::new(f64::from(i % 70) + 0.37, f64::from(i / 70) + 0.61) / 35.0 - 1.0;
        let depths = surface.triangles.iter().zip(&face_of).filter_map(|(t, &face)| {
            let (inside, depth) = depth(&t.corners, p)?;
            inside.then_some((depth, face))
        });
        let nearest = depths.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, face)| face);
        let painted = areas.iter().rev().find(|(corners, _)| covers(corners, p)).map(|(_, face)| *face);
        covered += usize::from(nearest.is_some());
        wrong += usize::from(nearest != painted);
    }
    assert!(covered > 500);
    assert_eq!(wrong, 0, "of {covered} places");
}

#[test]
fn faces_are_painted_from_back_to_front_and_cut_where_they_pierce_each_other() {
    for orthographic in [false, true] {
        check_order(CUBE, orthographic);
        check_order(L, orthographic);
        check_order(&tori(1.0), orthographic);
        check_order(&tori(0.55), orthographic);
        check_order(&saddles(), orthographic);
        check_order(&sierpinski(3), orthographic);
    }
    // Three bars that hide each other in a circle.
    check_order(
        "v -1 -0.2 0.3\nv 1 -0.2 -0.3\nv 1 0.2 -0.3\nv -1 0.2 0.3\nv 0.3 -1 0.3\nv 0.7 -1 0.3\nv -0.2 1 -0.3\n\
         v -0.6 1 -0.3\nv 0.5 1 0.35\nv 0.9 0.9 0.35\nv -0.4 -1 -0.4\nv -0.8 -0.9 -0.4\nf 1 2 3 4\nf 5 6 7 8\n\
         f 9 10 11 12\n",
        true,
    );
}

#[test]
fn faces_that_pierce_each_other_meet_in_a_line() {
    // A square through another, half of the line behind a third.
    let squares = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv -.5 0 -1\nv .5 0 -1\nv .5 0 1\nv -.5 0 1\n\
                   v 0 -.3 2\nv 3 -.3 2\nv 3 .3 2\nv 0 .3 2\nf 1 2 3 4\nf 5 6 7 8\nf 9 10 11 12\n";
    let case = Case::new(squares);
    let Ok(Viewpoint::From { side, up, .. }) = parse("front") else { panic!() };
    let camera = case.camera(true).from_side(side, up);
    let camera = case.scene.fit(Camera { orthographic: true, ..camera }, &Style::default(), 1.0);
    let drawing = case.draw_from(&camera, &Style::default(), &Settings::default()).unwrap();
    let lines = drawing.layers.iter().find_map(|layer| match layer {
        Layer::Lines { name: "intersection", paths, .. } => Some(paths),
        _ => None,
    });
    let [path] = &lines.unwrap()[..] else { panic!("{lines:?}") };
    // Four wide, so that a half is an eighth.
    let length = path.points[1].minus(path.points[0]).length() / f64::from(drawing.size.x);
    assert!(path.points.len() == 2 && (length - 0.125).abs() < 2e-3, "{length} {path:?}");
    // Tori that are only interlocked have none, those that pierce each other have closed ones.
    let lines = |apart: f64| {
        let drawing = Case::new(&tori(apart)).draw(&with_hidden());
        drawing.layers.iter().any(|layer| matches!(layer, Layer::Lines { name: "intersection", .. }))
    };
    assert!(!lines(1.0) && lines(0.55));
}

#[test]
fn faces_that_others_cover_are_not_painted() {
    let painted = |obj: &str| {
        let case = Case::new(obj);
        let drawing = case.draw_from(&case.camera(true), &Style::default(), &Settings::default()).unwrap();
        match drawing.layers.first() {
            Some(Layer::Faces(areas)) => areas.len(),
            _ => 0,
        }
    };
    assert_eq!(painted(CUBE), 3);
    // Behind a square in four pieces, and behind one with a hole.
    let quarters = "v -1 -1 0\nv 0 -1 0\nv 1 -1 0\nv -1 0 0\nv 0 0 0\nv 1 0 0\nv -1 1 0\nv 0 1 0\nv 1 1 0\n\
                    v -.4 -.4 -.1\nv .2 -.4 -.1\nv .2 .4 -.1\nf 10 11 12\nf 1 2 5 4\nf 2 3 6 5\nf 4 5 8 7\n";
    assert_eq!(painted(&format!("{quarters}f 5 6 9 8\n")), 4);
    assert_eq!(painted(quarters), 4, "and where the fourth is missing it is seen");
}

#[test]
fn lines_fade_with_their_depth() {
    let case = Case::new(CUBE);
    let settings = Settings { fade: 0.75, ..Settings::default() };
    let drawing = case.draw(&settings);
    let mut lines = Vec::new();
    for layer in &drawing.layers {
        if let Layer::Lines { name: "outline", depth, line, .. } = layer {
            lines.push((*depth, line.color[0]));
        }
    }
    // From far to near, so that what is near covers what is far.
    assert!(lines.len() > 3 && lines.is_sorted_by(|a, b| a.0 > b.0 && a.1 > b.1), "{lines:?}");
    assert!(lines.iter().all(|&(depth, gray)| gray == (0.75 * 255.0 * depth as f64 / 7.0).round() as u8), "{lines:?}");
    let length = |drawing: &Drawing| -> f64 {
        let of = |path: &Path| {
            let around = path.closed.then_some([path.points[path.points.len() - 1], path.points[0]]);
            let steps = path.points.windows(2).map(|w| [w[0], w[1]]).chain(around);
            steps.map(|[a, b]| a.minus(b).length()).sum::<f64>()
        };
        let paths =
            drawing.layers.iter().map(|layer| if let Layer::Lines { paths, .. } = layer { &paths[..] } else { &[] });
        paths.flatten().map(of).sum()
    };
    let plain = length(&case.draw(&Settings::default()));
    assert!((length(&drawing) - plain).abs() < 1e-3 * plain, "the lines are the same");
}

#[test]
fn faces_have_the_colours_of_their_vertices() {
    let red = CUBE.lines().map(|l| if l.starts_with('v') { format!("{l} 1 0 0\n") } else { format!("{l}\n") });
    let case = Case::new(&red.collect::<String>());
    let drawing = case.draw_from(&case.camera(false), &Style::default(), &Settings::default()).unwrap();
    let Some(Layer::Faces(areas)) = drawing.layers.first() else { panic!("{drawing:?}") };
    assert_eq!(areas.len(), 3, "those that are seen");
    assert!(areas.iter().all(|(_, [r, g, b])| *r > 2 * g.max(b)), "{areas:?}");
}

#[test]
fn the_light_is_that_of_the_windows_pictures() {
    let shader = include_str!("../../../shaders/faces.wgsl");
    let own = include_str!("light.rs").replace("_f32", "").replace("Vec3::new", "vec3");
    for name in [
        "UP",
        "SKY",
        "GROUND",
        "KEY_DIRECTION",
        "KEY",
        "FILL_DIRECTION",
        "FILL",
        "GLOSS",
        "GLOSS_POWER",
        "RIM",
        "RIM_POWER",
        "BACK",
    ] {
        let value = |text: &str| {
            let is = |line: &&str| [":", " ="].iter().any(|end| line.starts_with(&format!("const {name}{end}")));
            let line = text.lines().find(is);
            line.and_then(|l| l.split(" = ").nth(1)).map(|l| l.split(';').next().unwrap_or_default().to_owned())
        };
        assert_eq!(value(&own), value(shader), "{name}");
    }
}

/// The drawing of a cube in a format.
fn written(format: Format) -> Vec<u8> {
    let case = Case::new(CUBE);
    let style = Style { vertices: true, ..Style::default() };
    write(&case.draw_from(&case.camera(false), &style, &with_hidden()).unwrap(), format)
}

#[test]
fn svg_is_xml_with_a_group_for_each_class() {
    let text = String::from_utf8(written(Format::Svg)).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let groups = document.root_element().children().filter(roxmltree::Node::is_element);
    let ids: Vec<_> =
        groups.map(|g| (g.attribute("id").unwrap(), g.children().filter(|c| c.is_element()).count())).collect();
    assert_eq!(ids.iter().map(|g| g.0).collect::<Vec<_>>(), ["faces", "hidden", "inner", "outline", "vertices"]);
    assert_eq!((ids[0].1, ids[4].1), (3, 7));
}

#[test]
fn eps_has_a_tight_box_and_short_lines() {
    let text = String::from_utf8(written(Format::Eps)).unwrap();
    assert!(text.starts_with("%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 341 "), "{text}");
    assert!(text.contains("\n%%HiResBoundingBox: 0 0 340.15 ") && text.ends_with("showpage\n%%EOF\n"), "{text}");
    assert!(text.lines().all(|line| line.len() < 256 && line.is_ascii()));
    let count = |word: &str| text.split_whitespace().filter(|w| *w == word).count();
    assert_eq!((count("f"), count("d")), (3, 7));
    assert_eq!(count("begin"), count("end"));
}

#[test]
fn pdf_says_where_its_objects_are() {
    use std::io::Read as _;

    let bytes = written(Format::Pdf);
    let find = |what: &[u8]| bytes.windows(what.len()).rposition(|w| w == what).unwrap();
    let text = |from: usize| String::from_utf8_lossy(&bytes[from..]).into_owned();
    let table: usize = text(find(b"startxref")).lines().nth(1).unwrap().parse().unwrap();
    let entries = text(table);
    assert!(entries.starts_with("xref\n0 5\n"), "{entries}");
    for (number, entry) in (1..5).zip(entries.lines().skip(3)) {
        let offset: usize = entry[..10].parse().unwrap();
        assert!(text(offset).starts_with(&format!("{number} 0 obj\n")));
    }
    let from = find(b"\nstream\n") + 8;
    let mut content = String::new();
    flate2::read::ZlibDecoder::new(&bytes[from..]).read_to_string(&mut content).unwrap();
    let count = |word: &str| content.split_whitespace().filter(|w| *w == word).count();
    assert_eq!(count("b"), 3, "{content}");
    assert!(bytes.starts_with(b"%PDF-1.4\n") && bytes.ends_with(b"%%EOF\n"));
}

#[test]
fn numbers_are_as_short_as_can_be() {
    let numbers = [0, 5, -5, 50, 100, -123, 1200].map(hundredths);
    assert_eq!(numbers, ["0", ".05", "-.05", ".5", "1", "-1.23", "12"]);
    assert_eq!(thousandths([0, 128, 255]), "0 .502 1");
}

#[test]
fn a_figure_is_the_same_each_time() {
    let case = Case::new(&tori(0.55));
    assert_eq!(case.draw(&with_hidden()), case.draw(&with_hidden()));
}

#[test]
fn a_figure_is_as_wide_as_its_page_and_no_higher() {
    let case = Case::new(L);
    let size = |width, height| {
        let page = Page { width, height };
        let At { x, y } = case.draw(&Settings { page, ..Settings::default() }).size;
        [x, y].map(|x| (f64::from(x) / 7200.0 * 25.4 * 10.0).round() / 10.0)
    };
    let [width, height] = size(85.0, None);
    assert_eq!(width, 85.0);
    assert!(height > 40.0);
    assert_eq!(size(85.0, Some(30.0)), [(85.0 * 30.0 / height * 10.0_f64).round() / 10.0, 30.0]);
}

#[test]
fn what_lies_outside_the_picture_is_cut_off() {
    let case = Case::new(CUBE);
    let Ok(Viewpoint::At(camera)) = parse("eye 0 0 5 target 0.9 0 1 orthographic 1") else { panic!() };
    assert!(case.draw_from(&camera, &Style::default(), &Settings::default()).is_some());
    let Ok(Viewpoint::At(away)) = parse("eye 0 0 5 target 0 0 9 perspective 30") else { panic!() };
    assert_eq!(case.draw_from(&away, &Style::default(), &Settings::default()), None);
    // From inside, most of it is behind the eye.
    let Ok(Viewpoint::At(inside)) = parse("eye 0 0 0 target 0.3 0 -0.5 perspective 100") else { panic!() };
    let drawing = case.draw_from(&inside, &Style::default(), &Settings::default()).unwrap();
    let in_page = |p: &At| (0..=drawing.size.x).contains(&p.x) && (0..=drawing.size.y).contains(&p.y);
    let mut paths =
        drawing.layers.iter().flat_map(|l| if let Layer::Lines { paths, .. } = l { &paths[..] } else { &[] });
    assert!(paths.all(|path| path.points.iter().all(in_page)));
}
