//! Lines of OBJ files: wires, edges with a hole on either side.

use std::fmt::Write;

use vv::io::{Format, ReadOptions, read, write};
use vv::mesh::faces::faces;
use vv::stop::Stop;

use super::check_obj;
use crate::mesh::ring_list;

/// Vertices in a row, and these statements.
fn obj(n: usize, statements: &str) -> String {
    let mut text = String::new();
    (0..n).for_each(|i| writeln!(text, "v {i} 0 {}", i * i).unwrap());
    statements.split(" / ").for_each(|s| writeln!(text, "{s}").unwrap());
    text
}

fn rings_and_lines(text: &str) -> [String; 2] {
    let (mesh, messages) = read(text.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
    let mut rings = ring_list(&mesh);
    messages.iter().for_each(|d| rings += &format!("; {}", d.message));
    let written = write(&mesh, &faces(&mesh, &Stop::new()).unwrap(), Format::Obj).unwrap().0;
    let lines = String::from_utf8(written).unwrap();
    let lines: Vec<_> = lines.lines().filter(|line| line.starts_with(['f', 'l'])).collect();
    [rings, lines.join(" / ")]
}

/// What is written is read the same and written the same again.
#[track_caller]
fn check(n: usize, statements: &str, rings: &str, written: &str) {
    assert_eq!(rings_and_lines(&obj(n, statements)), [rings, written]);
    assert_eq!(rings_and_lines(&obj(n, written))[1], written);
}

#[test]
fn lines_are_wires() {
    check(2, "l 1 2", "1: 2 -, 2: 1 -", "l 1 2");
    check(3, "l 3 1/4 2/5", "1: 3 - 2 -, 2: 1 -, 3: 1 -", "l 2 1 3");
    check(4, "l -1 -3 -2", "1: 3 - 2 -, 2: 1 -, 3: 1 -; 1 vertex is in no face; dropped", "l 2 1 3");
}

#[test]
fn closed_lines_come_back_to_their_first_point() {
    check(3, "l 1 2 3 1", "1: 2 - 3 -, 2: 1 - 3 -, 3: 2 - 1 -", "l 1 2 3 1");
    check(
        6,
        "l 6 5 4 6 / l 1 2 3 1",
        "1: 2 - 3 -, 2: 1 - 3 -, 3: 2 - 1 -, 4: 5 - 6 -, 5: 6 - 4 -, 6: 5 - 4 -",
        "l 1 2 3 1 / l 4 5 6 4",
    );
}

#[test]
fn lines_meet_at_a_vertex_in_their_order() {
    check(
        5,
        "l 1 2 3 / l 4 2 5",
        "1: 2 -, 2: 1 - 3 - 4 - 5 -, 3: 2 -, 4: 2 -, 5: 2 -",
        "l 1 2 / l 2 3 / l 2 4 / l 2 5",
    );
    check(
        5,
        "l 3 1 2 3 4 5 3",
        "1: 3 - 2 -, 2: 1 - 3 -, 3: 1 - 2 - 4 - 5 -, 4: 3 - 5 -, 5: 4 - 3 -",
        "l 3 1 2 3 / l 3 4 5 3",
    );
}

#[test]
fn lines_stand_behind_the_faces_at_a_border() {
    check(4, "l 3 4 / f 1 2 3", "1: 2 3 -, 2: 3 1 -, 3: 1 2 - 4 -, 4: 3 -", "f 1 2 3 / l 3 4");
}

/// As several closed fans do, which have no room for each other either.
#[test]
fn lines_from_inside_of_a_surface_get_a_vertex_of_their_own() {
    check_obj(
        &obj(5, "f 1 2 3 / f 1 3 4 / f 1 4 2 / f 2 4 3 / l 1 5 2 / l 5 1"),
        "1 2 3 / 1 3 4 / 1 4 2 / 2 4 3\n\
         Warning: lines end at 2 vertices inside of the surface; duplicated for them\n  v6 for v1\n  v7 for v2\n\
         Warning: 1 segment of lines dropped, which was no edge or one that is there\n  v5–v1",
    );
}

#[test]
fn segments_that_are_no_new_edge_are_dropped() {
    check_obj(
        &obj(5, "f 1 2 3 / l 1 2 2 4 / l 4 2 / l 3"),
        "1 2 3\n\
         Warning: 1 vertex is in no face; dropped\n  v5\n\
         Warning: 3 segments of lines dropped, which was no edge or one that is there\n  v1–v2\n  v2–v2\n  v4–v2",
    );
}

#[test]
fn points_of_lines_that_are_not_there_are_named() {
    check_obj("v 0 0 0\nl 1 2\n", "error line 2: the line has a point at vertex `2`, but the last vertex is 1");
    check_obj("v 0 0 0\nl 1 x\n", "error line 2: `x` is no point of a line, as `7`, `-1` or `7/1` would be");
}

#[test]
fn sharpness_of_wires_is_kept() {
    let text = obj(2, "l 1 2 / t crease 2/1/0 0 1 2.5");
    let (mesh, messages) = read(text.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
    assert_eq!(messages, []);
    let written = write(&mesh, &faces(&mesh, &Stop::new()).unwrap(), Format::Obj).unwrap().0;
    assert!(String::from_utf8(written).unwrap().ends_with("l 1 2\nt crease 2/1/0 0 1 2.5\n"));
}

/// A hub of ten thousand wires takes no longer than as many apart.
#[test]
fn many_lines_meet_in_one_vertex() {
    let n = 10_000;
    let lines: Vec<_> = (2..=n).map(|i| format!("l 1 {i}")).collect();
    let text = obj(n, &lines.join("\n"));
    let [_, written] = rings_and_lines(&text);
    assert_eq!(written, lines.join(" / "));
}

/// Nor from inside of a surface: a cone over a polygon with as many corners as lines.
#[test]
fn many_lines_begin_at_a_hub_inside_of_a_surface() {
    let n = 50_000;
    let mut statements = String::new();
    (2..=n).for_each(|i| write!(statements, "f 1 {i} {} / l 1 {} / ", if i == n { 2 } else { i + 1 }, n + i).unwrap());
    let text = obj(2 * n, statements.trim_end_matches(" / "));
    let (mesh, messages) = read(text.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
    assert_eq!(messages[0].message, "1 vertex is in no face; dropped");
    assert_eq!(messages[1].message, "lines end at 1 vertex inside of the surface; duplicated for them");
    assert_eq!(mesh.vertices().map(|v| mesh.ring(v).valence()).max(), Some(n - 1));
}
