//! STL as text.

use super::*;

const TRIANGLE: &str = "solid a b\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  \
    endloop\n endfacet\nendsolid a b\n";

#[track_caller]
fn check(text: &str, expected: &str) {
    assert_eq!(outcome(text.as_bytes(), Format::Stl, false), expected);
}

#[test]
fn a_single_triangle_is_a_mesh() {
    let expected = "1 2 3\nNote: 3 corners of triangles were welded to 3 vertices, one for each position";
    check(TRIANGLE, expected);
    check(&TRIANGLE.to_uppercase(), expected);
    check(&TRIANGLE.replace('\n', "\r\n"), expected);
    check(&TRIANGLE.replace("normal 0 0 1", "normal nan nan nan"), expected);
    check(&TRIANGLE.replace(" normal 0 0 1", ""), expected);
    check(&TRIANGLE.replace("solid a b", "solid"), expected);
    check(&TRIANGLE.replace("endsolid a b\n", ""), expected);
}

#[test]
fn corners_at_the_same_position_are_one_vertex() {
    let second = TRIANGLE
        .replace("0 0 0", "1 1 0")
        .replace("vertex 1 0 0", "vertex -0 1 0")
        .replace("   vertex 0 1 0\n  endl", "   vertex 1 0 0\n  endl");
    check(
        &format!("{TRIANGLE}{second}"),
        "1 2 3 / 2 4 3\nNote: 6 corners of triangles were welded to 4 vertices, one for each position",
    );
}

#[test]
fn errors_name_their_line() {
    let broken = |from: &str, to: &str| TRIANGLE.replacen(from, to, 1);
    check(&broken("vertex 1 0 0", "vertex 1 x 0"), "error line 5: `x` is not a number");
    check(&broken("vertex 1 0 0", "vertex 1 inf 0"), "error line 5: `inf` is not finite");
    check(&broken("outer loop", "outer hoop"), "error line 3: `hoop` is no key word of STL here");
    check(&TRIANGLE[..60], "error line 5: the file ends within a facet; it was probably cut off");
    check(&TRIANGLE[..56], "error line 4: the file ends within a vertex");
    check(&broken(" facet", " vertex 0 0 0\n facet"), "error line 2: `vertex` is no key word of STL here");
    check("solid x\nendsolid x\n", "\nWarning: the file has no faces, so the mesh is empty");
    check("hello", "error: this is no STL file: it neither begins with `solid` nor has 84 bytes of header");
}

#[test]
fn what_is_written_is_what_others_read() {
    let (mesh, _) =
        read(b"v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n", Format::Obj, &ReadOptions::default()).unwrap();
    let text = String::from_utf8(written(&mesh, Format::StlText)).unwrap();
    assert_eq!(text.matches("  facet normal 0 0 1\n    outer loop\n      vertex").count(), 2, "{text}");
    let bytes = written(&mesh, Format::Stl);
    assert_eq!(bytes.len(), 84 + 2 * 50);
    assert_eq!(bytes[80..84], [2, 0, 0, 0]);
    assert_eq!(bytes[84..96], [[0u8; 4], [0; 4], 1f32.to_le_bytes()].concat());
}
