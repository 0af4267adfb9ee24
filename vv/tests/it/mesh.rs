//! Laws of the rotation system: orbits, closing, validation, counts; on random systems and on figures.

use std::collections::BTreeSet;

use proptest::prelude::*;
use proptest::sample::Index;
use vv::io::{Format, ReadOptions, read, write};
use vv::mesh::build::{BuildError, Polygons, build};
use vv::mesh::close::close;
use vv::mesh::faces::{Faces, degrees, faces};
use vv::mesh::inherit::inherit;
use vv::mesh::statistics::{Statistics, statistics};
use vv::mesh::validate::{Finding, validate};
use vv::mesh::{Mesh, Value, Vertex};
use vv::stop::{Stop, Stopped};

pub fn vertex(number: usize) -> Vertex {
    Vertex::from_index(number - 1).unwrap()
}

/// `1 2 3 / 1 3 4`
pub fn face_list(mesh: &Mesh) -> String {
    let face = |f: &[Vertex]| f.iter().map(|v| (v.index() + 1).to_string()).collect::<Vec<_>>().join(" ");
    all_faces(mesh).iter().map(face).collect::<Vec<_>>().join(" / ")
}

/// `1: 2 3 -` for each vertex, joined by `, `.
pub fn ring_list(mesh: &Mesh) -> String {
    let slot = |x: &Option<Vertex>| x.map_or("-".to_owned(), |x| (x.index() + 1).to_string());
    let ring = |v: Vertex| mesh.ring(v).slots().iter().map(slot).collect::<Vec<_>>().join(" ");
    mesh.vertices().map(|v| format!("{}: {}", v.index() + 1, ring(v))).collect::<Vec<_>>().join(", ")
}

fn all_faces(mesh: &Mesh) -> Faces {
    faces(mesh, &Stop::new()).unwrap()
}

fn count(mesh: &Mesh) -> Statistics {
    let stop = Stop::new();
    let found = statistics(mesh, &all_faces(mesh), &stop).unwrap();
    let without_faces = statistics(mesh, degrees(mesh, &stop).unwrap(), &stop).unwrap();
    assert_eq!(found, without_faces);
    found
}

fn findings(mesh: &Mesh) -> Vec<Finding> {
    validate(mesh, &Stop::new()).unwrap()
}

/// A mesh from rings as [`ring_list`] shows them, all vertices in its set.
fn mesh(rings: &str) -> Mesh {
    let mut mesh = Mesh::new();
    for _ in rings.split(", ") {
        let v = mesh.create().unwrap();
        mesh.set.add(v);
    }
    for ring in rings.split(", ") {
        let (v, items) = ring.split_once(':').unwrap();
        let item = |x: &str| if x == "-" { None } else { Some(vertex(x.parse().unwrap())) };
        let items: Vec<_> = items.split_whitespace().map(item).collect();
        mesh.make(vertex(v.parse().unwrap()), &items).unwrap();
    }
    mesh
}

// Figures.

/// The octahedron's upper half: `1` on top, around it `2 3 4 5`, open below.
const PYRAMID: &str = "1: 2 3 4 5, 2: 3 1 5 -, 3: 4 1 2 -, 4: 5 1 3 -, 5: 2 1 4 -";

#[track_caller]
fn check_close(rings: &str, expected: &str, warnings: &[&str]) {
    let mut mesh = mesh(rings);
    check_closed(&mut mesh, expected, warnings);
}

#[track_caller]
fn check_closed(mesh: &mut Mesh, expected: &str, warnings: &[&str]) {
    let got = close(mesh, &Stop::new()).unwrap();
    assert_eq!(ring_list(mesh), expected);
    let text = |d: &vv::diagnostic::Diagnostic| [&[d.message.clone()][..], &d.evidence].concat().join(" | ");
    assert_eq!(got.iter().map(text).collect::<Vec<_>>(), warnings);
}

#[test]
fn what_insert_puts_on_a_border_gets_its_gap_when_the_step_closes() {
    check_close(PYRAMID, PYRAMID, &[]);
    // The paper's insert(2, 3): 6 = {2, 3}, without a gap. Right of 2→3 the surface is missing.
    let inserted = "1: 2 3 4 5, 2: 6 1 5 -, 3: 4 1 6 -, 4: 5 1 3 -, 5: 2 1 4 -, 6: 2 3";
    let closed = "1: 2 3 4 5, 2: 6 1 5 -, 3: 4 1 6 -, 4: 5 1 3 -, 5: 2 1 4 -, 6: 3 2 -";
    assert_eq!(face_list(&mesh(inserted)), "1 2 6 3 / 1 3 4 / 1 4 5 / 1 5 2");
    assert_eq!(findings(&mesh(inserted)), [Finding::Unclosed { at: vertex(6), after: vertex(2) }]);
    check_close(inserted, closed, &[]);
    assert_eq!(face_list(&mesh(closed)), "1 2 6 3 / 1 3 4 / 1 4 5 / 1 5 2");
}

#[test]
fn on_a_wire_both_sides_become_gaps() {
    check_close("1: 2 -, 2: 1 3, 3: 2 -", "1: 2 -, 2: 1 - 3 -, 3: 2 -", &[]);
    assert_eq!(face_list(&mesh("1: 2, 2: 1 3, 3: 2")), "1 2 3 2"); // without gaps it is a face, seen from both sides
}

#[test]
fn a_walk_that_ends_at_a_vertex_which_does_not_answer_is_left() {
    check_close(
        "1: 2 -, 2: 1 3, 3: -",
        "1: 2 -, 2: 1 3, 3: ",
        &["v2 names v3 as its neighbour, but v3 does not name v2 | ring of v2: v1 v3 | ring of v3: empty"],
    );
}

#[test]
fn vertices_outside_the_set_are_forgotten() {
    let mut mesh = mesh(PYRAMID);
    mesh.set.remove(vertex(2));
    check_closed(
        &mut mesh,
        "1: 2 3 4 -, 2: 3 1 -, 3: 4 1 2 -, 4: 1 3 -",
        &[
            "1 vertex that rings of the mesh name is in no mesh at the end of the step; gaps took its places in the rings \
           of 3 vertices | now ring of v1: v2 v3 v4 null | now ring of v2: v3 v1 null | now ring of v4: v1 v3 null",
        ],
    );
}

#[test]
fn a_ring_is_quoted_once() {
    check_close(
        "1: 2 3, 2:, 3:",
        "1: 2 3, 2: , 3: ",
        &["2 neighbours do not name the vertex that names them | ring of v1: v2 v3 | ring of v2: empty | \
           ring of v3: empty"],
    );
}

/// The first `old` vertices have 1, 2, 4, 8, … as a double, 1, 2, 3, … as an int, all others 0 and 0.
#[track_caller]
fn check_inherited(rings: &str, old: usize, expected: &str) {
    inherited(mesh(rings), old, expected);
}

#[track_caller]
fn inherited(mut mesh: Mesh, old: usize, expected: &str) {
    let number = mesh.declare_vertex_property("number", Value::Double(0.0));
    let label = mesh.declare_vertex_property("label", Value::Int(0));
    let other = mesh.declare_vertex_property("other", Value::Int(0));
    for v in mesh.vertices().take(old) {
        mesh.set_vertex_value(number, v, Value::Double(f64::from(1 << v.index())));
        mesh.set_vertex_value(label, v, Value::Int(v.index() as i64 + 1));
        mesh.set_vertex_value(other, v, Value::Int(1));
    }
    inherit(&mut mesh, old, &[number, label], &Stop::new()).unwrap();
    let value = |property, v| match mesh.vertex_value(property, v).unwrap() {
        Value::Double(x) => x.to_string(),
        Value::Int(x) => x.to_string(),
        value => panic!("{value:?}"),
    };
    let all: Vec<_> = mesh.vertices().map(|v| format!("{}/{}", value(number, v), value(label, v))).collect();
    assert_eq!(all[old..].join(" "), expected);
    assert!(mesh.vertices().skip(old).all(|v| value(other, v) == "0"), "only what is asked for");
}

#[test]
fn new_vertices_inherit_means_and_the_labels_of_the_oldest() {
    check_inherited("1: 3, 2: 3, 3: 1 2", 2, "1.5/1");
    // Through other new ones: 4 from 1 and 3, 5 from 4, 6 from 5; 7 and 8 know nobody.
    check_inherited("1: 4, 2:, 3: 4, 4: 1 5 3, 5: 4 6, 6: 5, 7: 8, 8: 7", 3, "2.5/1 2.5/1 2.5/1 0/0 0/0");
    // Whom only the old one names, and who only names it; and what both are told.
    check_inherited("1: 3, 2:, 3:, 4: 2, 5: 1 2", 2, "1/1 2/2 1.5/1");
    check_inherited("1: 2, 2: 1", 2, "");
}

/// 1 and 2 go; 3 and 4 are corners of the one, 5 of the other, 6 is between them.
#[test]
fn corners_of_vertices_that_go_lie_between_them_and_the_corners_beside_them() {
    let rings = "1: 3 4, 2: 5, 3: 1 4 5, 4: 1 3, 5: 2 3, 6: 1 2";
    check_inherited(rings, 2, "1/1 1/1 2/2 1.5/1");
    let mut gone = mesh(rings);
    gone.set.remove(vertex(1));
    gone.set.remove(vertex(2));
    inherited(gone, 2, "1.3333333333333333/1 1/1 1.5/2 1.5/1");
}

#[test]
fn what_nobody_names_is_forgotten_without_a_word() {
    let mut mesh = mesh("1: 2, 2: 1, 3: 1");
    mesh.set.remove(vertex(3));
    check_closed(&mut mesh, "1: 2, 2: 1", &[]);
}

#[test]
fn positions_that_are_not_finite_are_reported() {
    let mut mesh = mesh("1: 2, 2: 1");
    mesh.set_position(vertex(2), glam::dvec3(0.5, f64::NAN, f64::INFINITY));
    check_closed(
        &mut mesh,
        "1: 2, 2: 1",
        &["the position of 1 vertex is infinite or not a number | v2 is at (0.5, NaN, inf)"],
    );
    let mut mesh = Mesh::new();
    let many: Vec<_> = (0..12).map(|_| mesh.create().unwrap()).collect();
    many.iter().for_each(|&v| mesh.set_position(v, glam::dvec3(f64::NAN, 0.0, 0.0)));
    mesh.set = many.into_iter().collect();
    let warnings = close(&mut mesh, &Stop::new()).unwrap();
    assert_eq!(warnings[0].message, "the positions of 12 vertices are infinite or not numbers");
}

#[test]
fn warnings_stay_short() {
    // A star whose hub is named by none of its points.
    let n = 100_000;
    let mut mesh = Mesh::new();
    let all: Vec<_> = (0..n).map(|_| mesh.create().unwrap()).collect();
    mesh.make(all[0], &all[1..].iter().copied().map(Some).collect::<Vec<_>>()).unwrap();
    mesh.set = all.into_iter().collect();
    let warnings = close(&mut mesh, &Stop::new()).unwrap();
    assert_eq!(warnings.len(), 1);
    assert_eq!(warnings[0].message, "99999 neighbours do not name the vertex that names them");
    assert!(warnings[0].evidence.iter().all(|fact| fact.len() < 120) && warnings[0].evidence.len() < 10);
    assert!(warnings[0].vertices.len() < 2000);
}

/// `V E F components loops χ genus`, then `closed` or `open`.
#[track_caller]
fn check_counts(mesh: &Mesh, expected: &str) {
    let s = count(mesh);
    let genus = s.genus.map_or("invalid".to_owned(), |g| g.to_string());
    let closed = if s.closed { "closed" } else { "open" };
    let chi = s.euler_characteristic;
    let counts = [s.vertices, s.edges, s.faces, s.components, s.boundary_loops].map(|n| n.to_string()).join(" ");
    assert_eq!(format!("{counts} {chi} {genus} {closed}"), expected);
}

#[test]
fn counts_of_shapes() {
    let shape = |name: &str| {
        let path = format!("{}/../assets/meshes/{name}", env!("CARGO_MANIFEST_DIR"));
        let format = Format::from_extension(name.rsplit('.').next().unwrap()).unwrap();
        read(&std::fs::read(path).unwrap(), format, &ReadOptions::default()).unwrap().0
    };
    check_counts(&shape("octahedron.obj"), "6 12 8 1 0 2 0 closed");
    check_counts(&shape("dodecahedron.obj"), "20 30 12 1 0 2 0 closed");
    check_counts(&shape("torus.obj"), "72 216 144 1 0 0 1 closed");
    check_counts(&shape("torus-quads.obj"), "72 144 72 1 0 0 1 closed");
    check_counts(&shape("genus-2.obj"), "48 150 100 1 0 -2 2 closed");
    check_counts(&shape("tetrapod.obj"), "28 78 52 1 0 2 0 closed");
    check_counts(&shape("square-open.obj"), "9 16 8 1 1 1 0 open");
    check_counts(&shape("cube-open.obj"), "8 17 10 1 1 1 0 open");
    check_counts(&shape("bad/bow-tie.obj"), "5 6 2 1 1 1 0 open");
    check_counts(&shape("bad/pillow.off"), "3 3 2 1 0 2 0 closed");
    check_counts(&shape("bad/heptagon.off"), "7 7 1 1 1 1 0 open");
    let s = count(&shape("square-open.obj"));
    assert_eq!((s.valences, s.face_degrees), (vec![(2, 2), (3, 2), (4, 4), (6, 1)], vec![(3, 8)]));
}

#[test]
fn counts_of_odd_systems() {
    check_counts(&Mesh::new(), "0 0 0 0 0 0 0 closed");
    check_counts(&mesh("1: "), "1 0 0 1 0 2 0 closed"); // a sphere with one point
    check_counts(&mesh("1: 2, 2: 1"), "2 1 1 1 0 2 0 closed"); // one face of two corners
    check_counts(&mesh("1: 2 -, 2: 1 -"), "2 1 0 1 1 1 0 open"); // a wire is a thin disk
    check_counts(&mesh("1: 2 - 3 -, 2: 3 - 1 -, 3: 1 - 2 -"), "3 3 0 1 2 0 0 open"); // a closed one an annulus
    check_counts(&mesh("1: 2, 2: "), "2 1 0 1 0 2 invalid open");
    // Wires across each other, before a square, alone and on a torus with a hole: none is a handle.
    check_counts(&mesh("1: 2 4 - 3 -, 2: 3 1 - 4 -, 3: 4 2 - 1 -, 4: 1 3 - 2 -"), "4 6 1 1 1 -1 0 open");
    check_counts(&mesh("1: 2 - 3 - 4 -, 2: 3 - 1 - 4 -, 3: 1 - 2 - 4 -, 4: 2 - 3 - 1 -"), "4 6 0 1 2 -2 0 open");
    let torus = include_str!("../../../assets/meshes/torus-quads.obj");
    let (face, corners) = torus.lines().find_map(|line| Some((line, line.strip_prefix("f ")?))).unwrap();
    let c: Vec<_> = corners.split(' ').collect();
    let torus = torus.replace(&format!("{face}\n"), &format!("l {} {}\nl {} {}\n", c[0], c[2], c[1], c[3]));
    let (torus, _) = read(torus.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
    check_counts(&torus, "72 146 71 1 1 -3 1 open");
    // K4 on a torus: one ring of the tetrahedron turned round.
    check_counts(&mesh("1: 2 3 4, 2: 3 1 4, 3: 1 2 4, 4: 2 3 1"), "4 6 2 1 0 0 1 closed");
}

#[test]
fn faces_of_the_set_only() {
    let mut mesh = mesh(PYRAMID);
    mesh.set.remove(vertex(2));
    assert_eq!(face_list(&mesh), "1 3 4 / 1 4 5");
    assert_eq!(findings(&mesh), [1, 3, 5].map(|v| Finding::Outside { from: vertex(v), to: vertex(2) }));
}

/// The corners of a face are those of a walk, whichever of them is passed more than once.
#[test]
fn a_tree_has_one_face_that_goes_round_it() {
    assert_eq!(face_list(&mesh("1: 2, 2: 1 3 4 5, 3: 2, 4: 2, 5: 2")), "1 2 5 2 4 2 3 2");
    assert_eq!(face_list(&mesh("1: 2 3 4, 2: 1, 3: 1, 4: 1")), "1 2 1 4 1 3");
    let n = 40;
    let mut path = "1: 2".to_owned();
    (2..n).for_each(|v| path += &format!(", {v}: {} {}", v - 1, v + 1));
    let there = (1..=n).chain((2..n).rev()).map(|v| v.to_string()).collect::<Vec<_>>();
    assert_eq!(face_list(&mesh(&format!("{path}, {n}: {}", n - 1))), there.join(" "));
}

#[test]
fn a_fan_of_a_hundred_thousand_triangles_takes_linear_time() {
    let n = 100_000;
    let positions = (0..=n).map(|i| glam::dvec3(f64::from(i), 0.0, 0.0)).collect();
    let mut polygons = Polygons::new(positions);
    for i in 1..=n {
        polygons.push([0, i, i % n + 1], None).unwrap();
    }
    let (mut mesh, warnings) = build(polygons, true, &Stop::new()).unwrap();
    assert_eq!(warnings, []);
    check_counts(&mesh, "100001 200000 100000 1 1 1 0 open");
    // The boundary taken in: a second hub is asked for by each of its spokes, too.
    let hub = vertex(1);
    mesh.set.remove(hub);
    let warnings = close(&mut mesh, &Stop::new()).unwrap();
    assert_eq!(warnings.len(), 1);
    check_counts(&mesh, "100000 100000 0 1 2 0 0 open");
}

#[test]
fn what_is_found_does_not_depend_on_the_number_of_threads() {
    let n = 140;
    let positions = (0..n * n).map(|i| glam::dvec3(f64::from(i % n), f64::from(i / n), 0.0)).collect();
    let mut polygons = Polygons::new(positions);
    for i in (0..n * (n - 1)).filter(|i| i % n < n - 1) {
        polygons.push([i, i + 1, i + n + 1, i + n], None).unwrap();
    }
    let mut mesh = build(polygons, true, &Stop::new()).unwrap().0;
    for i in (0..n as usize * n as usize).step_by(501) {
        let v = vertex(i + 1);
        mesh.erase(mesh.ring(v).any(), v);
        mesh.set_position(v, glam::DVec3::NAN);
    }
    let made = [1, 2, 5].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let found = all_faces(&mesh);
            let texts = [Format::Obj, Format::Off].map(|format| write(&mesh, &found, format).unwrap().0);
            let mut closed = mesh.clone();
            let warnings = close(&mut closed, &Stop::new()).unwrap();
            (texts, findings(&mesh), count(&mesh), format!("{warnings:?}"), ring_list(&closed))
        })
    });
    assert_eq!(made[0].1.len(), 2 * 40);
    assert!(made[0] == made[1] && made[0] == made[2]);
}

#[test]
fn everything_stops() {
    let stop = Stop::new();
    let mut mesh = mesh(PYRAMID);
    let found = all_faces(&mesh);
    stop.request(Stopped::ByTime);
    assert_eq!(faces(&mesh, &stop), Err(Stopped::ByTime));
    assert_eq!(validate(&mesh, &stop), Err(Stopped::ByTime));
    assert_eq!(statistics(&mesh, &found, &stop), Err(Stopped::ByTime));
    assert_eq!(close(&mut mesh, &stop).err(), Some(Stopped::ByTime));
}

// Random systems.

/// A symmetric rotation system of up to `n` vertices; with `gaps`, some corners are gaps.
fn rotation_system(n: usize, gaps: bool) -> impl Strategy<Value = Mesh> {
    let edges = prop::collection::vec((0..n, 0..n, any::<Index>(), any::<Index>()), 0..4 * n);
    let gaps = prop::collection::vec((0..n, any::<Index>()), if gaps { 0..n } else { 0..1 });
    (edges, gaps).prop_map(move |(edges, gaps)| {
        let mut rings: Vec<Vec<Option<Vertex>>> = vec![Vec::new(); n];
        for (u, v, i, j) in edges {
            if u != v && !rings[u].contains(&Some(vertex(v + 1))) {
                let (i, j) = (i.index(rings[u].len() + 1), j.index(rings[v].len() + 1));
                rings[u].insert(i, Some(vertex(v + 1)));
                rings[v].insert(j, Some(vertex(u + 1)));
            }
        }
        for (v, i) in gaps {
            let i = i.index(rings[v].len() + 1);
            rings[v].insert(i, None);
        }
        let mut mesh = Mesh::new();
        for _ in 0..n {
            let v = mesh.create().unwrap();
            mesh.set.add(v);
        }
        for (i, ring) in rings.iter().enumerate() {
            mesh.make(vertex(i + 1), ring).unwrap();
        }
        mesh
    })
}

/// A rotation system where some entries are erased at one end and some vertices are outside the set.
fn damaged_system(n: usize) -> impl Strategy<Value = Mesh> {
    let erased = prop::collection::vec((0..n, any::<Index>()), 0..4);
    let removed = prop::collection::vec(0..n, 0..3);
    (rotation_system(n, true), erased, removed).prop_map(|(mut mesh, erased, removed)| {
        for (v, i) in erased {
            let v = vertex(v + 1);
            let neighbours: Vec<_> = mesh.ring(v).vertices().collect();
            if !neighbours.is_empty() {
                mesh.erase(Some(neighbours[i.index(neighbours.len())]), v);
            }
        }
        removed.into_iter().for_each(|v| _ = mesh.set.remove(vertex(v + 1)));
        mesh
    })
}

/// The walk from u→v by a rule that gives w for v→w, until it is back; `None` where it meets a gap or an incomplete
/// neighbour.
fn orbit(
    mesh: &Mesh,
    start: (Vertex, Vertex),
    rule: impl Fn(Vertex, Vertex) -> Option<Option<Vertex>>,
) -> Option<Vec<Vertex>> {
    let complete = |u: Vertex, v: Vertex| {
        let both = mesh.ring(u).contains(Some(v)) && mesh.ring(v).contains(Some(u));
        both && mesh.set.contains(u) && mesh.set.contains(v)
    };
    let mut walk = Vec::new();
    let (mut u, mut v) = start;
    loop {
        if !complete(u, v) {
            return None;
        }
        walk.push(u);
        (u, v) = (v, rule(u, v)??);
        if (u, v) == start {
            return Some(walk);
        }
    }
}

/// The cycle from its least rotation.
fn cycle(mut walk: Vec<Vertex>) -> Vec<Vertex> {
    let n = walk.len();
    let start = (0..n).min_by_key(|&i| [&walk[i..], &walk[..i]].concat()).unwrap_or(0);
    walk.rotate_left(start);
    walk
}

/// All closed walks of a rule.
fn cycles(mesh: &Mesh, rule: impl Fn(Vertex, Vertex) -> Option<Option<Vertex>>) -> BTreeSet<Vec<Vertex>> {
    let edges = mesh.vertices().flat_map(|v| mesh.ring(v).vertices().map(move |x| (v, x)).collect::<Vec<_>>());
    edges.filter_map(|edge| orbit(mesh, edge, &rule)).map(cycle).collect()
}

fn face_cycles(faces: &Faces) -> BTreeSet<Vec<Vertex>> {
    faces.iter().map(|f| cycle(f.to_vec())).collect()
}

proptest! {
    #[test]
    fn faces_are_the_closed_orbits(mesh in damaged_system(8)) {
        let faces = all_faces(&mesh);
        prop_assert_eq!(face_cycles(&faces), cycles(&mesh, |u, v| mesh.ring(v).previous(Some(u))));
        // Each in the order of creation, from its oldest corner.
        let starts: Vec<_> = faces.iter().map(|f| f[0]).collect();
        prop_assert!(starts.is_sorted());
        prop_assert!(faces.iter().all(|f| f.iter().min() == f.first()));
    }

    #[test]
    fn the_rule_of_the_paper_reads_the_same_polygons_backwards(mesh in damaged_system(8)) {
        let backwards = cycles(&mesh, |u, v| mesh.ring(v).next(Some(u)));
        let forwards = backwards.into_iter().map(|mut walk| { walk.reverse(); cycle(walk) }).collect();
        prop_assert_eq!(face_cycles(&all_faces(&mesh)), forwards);
    }

    #[test]
    fn without_gaps_every_directed_edge_lies_on_one_face(mesh in rotation_system(8, false)) {
        let mut seen = BTreeSet::new();
        for face in all_faces(&mesh).iter() {
            for i in 0..face.len() {
                prop_assert!(seen.insert((face[i], face[(i + 1) % face.len()])));
            }
        }
        prop_assert_eq!(seen.len(), mesh.vertices().map(|v| mesh.ring(v).valence()).sum::<usize>());
    }

    #[test]
    fn euler_and_poincare(mesh in rotation_system(9, false)) {
        let s = count(&mesh);
        prop_assert!(s.valid && s.closed);
        prop_assert_eq!(s.boundary_loops, 0);
        prop_assert_eq!(s.euler_characteristic, 2 * s.components as i64 - 2 * s.genus.unwrap() as i64);
        prop_assert_eq!(s.valences.iter().map(|&(k, n)| k * n).sum::<usize>(), 2 * s.edges);
        prop_assert_eq!(s.face_degrees.iter().map(|&(k, n)| k * n).sum::<usize>(), 2 * s.edges);
    }

    /// A disk in each hole makes a closed surface: the gaps taken out, the faces gained are the boundary loops. Wires, which
    /// have a gap on either side, are handles then only.
    #[test]
    fn holes_are_filled_by_taking_out_gaps(mut mesh in rotation_system(9, true)) {
        close(&mut mesh, &Stop::new()).unwrap();
        let open = count(&mesh);
        let wired = mesh.vertices().any(|v| {
            let ring = mesh.ring(v);
            ring.vertices().any(|x| [ring.next(Some(x)), ring.previous(Some(x))] == [Some(None); 2])
        });
        for v in mesh.vertices() {
            while mesh.ring(v).gaps() > 0 {
                mesh.erase(None, v);
            }
        }
        let filled = count(&mesh);
        prop_assert!(open.valid);
        prop_assert_eq!(open.boundary_loops, filled.faces - open.faces);
        let alike = if wired { open.genus <= filled.genus } else { open.genus == filled.genus };
        prop_assert!(alike, "{:?} {:?}", open.genus, filled.genus);
        prop_assert_eq!(open.closed, open.boundary_loops == 0);
    }

    #[test]
    fn closing_keeps_faces_and_leaves_nothing_open(mut mesh in rotation_system(9, true)) {
        let before = face_cycles(&all_faces(&mesh));
        let warnings = close(&mut mesh, &Stop::new()).unwrap();
        prop_assert_eq!(warnings, []);
        prop_assert_eq!(face_cycles(&all_faces(&mesh)), before);
        prop_assert_eq!(findings(&mesh), []);
        let rings = ring_list(&mesh);
        close(&mut mesh, &Stop::new()).unwrap();
        prop_assert_eq!(ring_list(&mesh), rings);
    }

    #[test]
    fn closing_forgets_what_is_not_in_the_set(mut mesh in damaged_system(9)) {
        // The faces that stay, in the new numbers.
        let mut members: Vec<_> = mesh.set.iter().collect();
        members.sort();
        let rename = |v: &Vertex| vertex(members.iter().position(|m| m == v).unwrap() + 1);
        let before: BTreeSet<_> =
            all_faces(&mesh).iter().map(|f| cycle(f.iter().map(rename).collect())).collect();
        let foreign = mesh.set.iter().any(|v| mesh.ring(v).vertices().any(|x| !mesh.set.contains(x)));
        let warnings = close(&mut mesh, &Stop::new()).unwrap();
        prop_assert_eq!(mesh.vertex_count(), members.len());
        prop_assert_eq!(warnings.iter().any(|w| w.message.contains("in no mesh")), foreign);
        prop_assert_eq!(face_cycles(&all_faces(&mesh)), before);
        // What is left are pairs that name each other one-sidedly.
        let left = findings(&mesh);
        let one_sided = |f: &Finding| matches!(f, Finding::OneSided { .. });
        prop_assert!(left.iter().all(one_sided));
        prop_assert_eq!(warnings.iter().any(|w| w.message.contains("name")
            && !w.message.contains("in no mesh")), !left.is_empty());
    }

    #[test]
    fn validation_finds_each_one_sided_pair(mesh in damaged_system(8)) {
        let mut expected = BTreeSet::new();
        for v in mesh.set.iter() {
            for x in mesh.ring(v).vertices() {
                if !mesh.set.contains(x) {
                    expected.insert(Finding::Outside { from: v, to: x });
                } else if !mesh.ring(x).contains(Some(v)) {
                    expected.insert(Finding::OneSided { from: v, to: x });
                }
            }
        }
        let found: BTreeSet<_> =
            findings(&mesh).into_iter().filter(|f| !matches!(f, Finding::Unclosed { .. })).collect();
        prop_assert_eq!(found, expected);
    }

    /// Polygons hold all there is to a closed system, but for vertices and edges that are components by themselves.
    #[test]
    fn files_keep_rings_up_to_rotation(mut mesh in rotation_system(8, false)) {
        let alone = |v: Vertex| mesh.ring(v).vertices().all(|x| mesh.ring(x).valence() + mesh.ring(v).valence() == 2);
        mesh.set = mesh.vertices().filter(|&v| !alone(v)).collect();
        close(&mut mesh, &Stop::new()).unwrap();
        if mesh.vertex_count() == 0 {
            return Ok(());
        }
        let faces = all_faces(&mesh);
        for format in [Format::Obj, Format::Off, Format::Ply, Format::PlyText, Format::PlyBigEndian] {
            let written = write(&mesh, &faces, format).unwrap().0;
            let (again, _) = read(&written, format, &ReadOptions { strict: true, ..ReadOptions::default() }).unwrap();
            for v in mesh.vertices() {
                let ring = |mesh: &Mesh| cycle(mesh.ring(v).vertices().collect());
                prop_assert_eq!(ring(&mesh), ring(&again));
            }
            prop_assert_eq!(write(&again, &all_faces(&again), format).unwrap().0, written);
        }
    }

    /// Any polygons at all: nothing panics, what comes out is valid, and every face is kept with its corners in place.
    #[test]
    fn polygons_of_any_kind_make_a_valid_mesh_of_the_same_faces(
        soup in prop::collection::vec(prop::collection::vec(0..7u32, 3..6), 1..9),
    ) {
        let positions = (0..7).map(|i| glam::DVec3::splat(f64::from(i))).collect();
        let mut polygons = Polygons::new(positions);
        soup.iter().for_each(|face| polygons.push(face.iter().copied(), None).unwrap());
        let (mesh, warnings) = match build(polygons, false, &Stop::new()) {
            Ok(built) => built,
            Err(BuildError::Refused { diagnostic, .. }) => {
                prop_assert!(diagnostic.message.contains("not orientable"));
                return Ok(());
            }
            Err(BuildError::Stopped(_)) => unreachable!(),
        };
        prop_assert_eq!(findings(&mesh), []);
        // Faces by the places of their corners, the less of the two directions.
        let place = |v: Vertex| vertex(mesh.position(v).x as usize + 1);
        let either = |face: Vec<Vertex>| {
            let mut back = face.clone();
            back.reverse();
            cycle(face).min(cycle(back))
        };
        let mut kept: Vec<_> = all_faces(&mesh).iter().map(|f| either(f.iter().map(|&v| place(v)).collect())).collect();
        let mut seen = BTreeSet::new();
        let mut given: Vec<_> = soup.iter().filter_map(|face| {
            let mut face: Vec<_> = face.iter().map(|&v| vertex(v as usize + 1)).collect();
            face.dedup();
            while face.len() > 1 && face.first() == face.last() {
                face.pop();
            }
            (face.len() > 2 && seen.insert(cycle(face.clone()))).then(|| either(face))
        }).collect();
        kept.sort();
        given.sort();
        prop_assert_eq!(kept, given);
        // What was mended once needs no mending again.
        let written = write(&mesh, &all_faces(&mesh), Format::Off).unwrap().0;
        if mesh.vertices().all(|v| mesh.ring(v).gaps() < 3) && mesh.vertex_count() > 0 {
            let (again, _) = read(&written, Format::Off, &ReadOptions { strict: true, ..ReadOptions::default() }).unwrap();
            prop_assert_eq!(write(&again, &all_faces(&again), Format::Off).unwrap().0, written);
        }
        drop(warnings);
    }

    #[test]
    fn files_of_any_bytes_are_read_or_refused(
        obj in prop::bool::ANY,
        words in prop::collection::vec(prop::sample::select(vec![
            "v", "f", "\n", "\n", "0", "1", "2", "3", "-1", "1/1", "//", "\\", "#", "OFF", "COFF", "1e999", "nan", "0.5", "l", "\r", "\u{0}", "é",
            "99999999999", "v 1 2 3\n", "f 1 2 3\n", "OFF 3 1 0\n", "0 0 0\n", "3 0 1 2\n",
        ]), 0..40),
        bytes in prop::collection::vec(any::<u8>(), 0..8),
    ) {
        let mut text: Vec<u8> = words.join(" ").into_bytes();
        text.extend(bytes);
        let format = if obj { Format::Obj } else { Format::Off };
        if let Ok((mesh, _)) = read(&text, format, &ReadOptions::default()) {
            prop_assert_eq!(findings(&mesh), []);
        }
    }
}

/// Its ring is settled in one pass, edge values and all.
#[test]
fn a_hub_may_lose_nearly_all_its_neighbours_at_once() {
    let n = 300_000;
    let mut mesh = Mesh::new();
    let all: Vec<Vertex> = (0..n).map(|_| mesh.create().unwrap()).collect();
    let items: Vec<_> = all[1..].iter().copied().map(Some).collect();
    mesh.make(all[0], &items).unwrap();
    let weight = mesh.declare_edge_property("weight", Value::Int(0));
    let (near, far) = (all[7], all[n - 1]);
    mesh.set_edge_value(weight, all[0], far, Value::Int(5));
    [all[0], near, far].into_iter().for_each(|v| _ = mesh.set.add(v));
    assert_eq!(mesh.keep_only_set(), n - 3);
    assert_eq!(ring_list(&mesh), "1: 2 - 3 -, 2: , 3: ");
    let values: Vec<_> = mesh.edge_values(weight, vertex(1)).collect();
    assert_eq!(values, [(vertex(2), Value::Int(0)), (vertex(3), Value::Int(5))]);
}
