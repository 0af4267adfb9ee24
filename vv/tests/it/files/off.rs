//! OFF.

use super::*;

/// OFF of one triangle with this header, these ends of the vertex lines and of the face line.
fn triangle(header: &str, vertex: &str, face: &str) -> String {
    format!("{header}\n0 0 0{vertex}\n1 0 0{vertex}\n0 1 0{vertex}\n3 0 1 2{face}")
}

#[test]
fn off_headers_and_counts_have_many_forms() {
    for header in ["OFF\n3 1 3", "OFF 3 1 3", "OFF\n3 1", "3 1 3", "# a\n\nOFF # b\n\n3 1 3 # c\n# d\n"] {
        check_off(&triangle(header, "", ""), "1 2 3");
        check_off(&triangle(header, " # e\n", " # f\n\n"), "1 2 3");
    }
    check_off("OFF 3 1 3 0 0 0 1 0 0 0 1 0 3 0 1 2", "1 2 3");
    check_off("OFF\n3 1 3\n0 0 0 1 0 0\n0 1 0 3 0\n1 2", "1 2 3");
    check_off(&triangle("OFF\n3 1 3", "", "").replace('\n', "\r\n"), "1 2 3");
}

#[test]
fn off_normals_and_texture_coordinates_are_passed_over() {
    let note = "1 2 3\nNote: normals, texture coordinates and colours of faces are not read";
    check_off(&triangle("NOFF\n3 1 3", " 0 0 1", "\n"), note);
    check_off(&triangle("STCNOFF\n3 1 3", " 0 0 1 1 1 1 1 0 0", "\n"), note);
    check_off(&triangle("OFF\n3 1 3", "", " 255 0 0\n"), note);
}

#[test]
fn off_colours_are_kept() {
    let check = |text: String, expected: &str| {
        check_off(&text, "1 2 3");
        check_values(text.as_bytes(), Format::Off, expected);
    };
    let red = "color: (1 0 0) (1 0 0) (1 0 0)";
    check(triangle("COFF\n3 1 3", " 255 0 0 255", "\n"), red);
    check(triangle("COFF\n3 1 3", " 255 0 0", "\n"), red);
    check(triangle("COFF\n3 1 3", " 1 0 0 1", "\n"), red);
    check(triangle("COFF\n3 1 3", " 1 0 0", "\n"), red);
    check(triangle("COFF\n3 1 3", " 0 0 0 255", "\n"), "color: (0 0 0) (0 0 0) (0 0 0)");
    check(
        "COFF 3 1 3 0 0 0 1 .5 0 1 1 0 0 1 .5 0 1 0 1 0 0 0 0 1 3 0 1 2".to_owned(),
        "color: (1 0.5 0) (1 0.5 0) (0 0 0)",
    );
    let (text, note) = (triangle("STCNOFF\n3 1 3", " 0 0 1 255 51 0 0.5 0.5", "\n"), "1 2 3\nNote: normals, texture");
    assert!(outcome(text.as_bytes(), Format::Off, false).starts_with(note));
    check_values(text.as_bytes(), Format::Off, "color: (1 0.2 0) (1 0.2 0) (1 0.2 0)");
}

#[test]
fn off_may_be_flat() {
    let note = "1 2 3\nNote: the vertices have two coordinates; the third is 0";
    check_off("OFF\n3 1 3\n0 0\n1 0\n0 1\n3 0 1 2\n", note);
    check_off("OFF\n3 1 3\n# a\n\n0 0 # b\n1 0\n0 1\n3 0 1 2\n", note);
    check_off("OFF\n3 1 3\n0 0\n1\n0 1\n3 0 1 2\n", "error line 4: vertex 2 has one coordinate, not three");
    check_off(
        "OFF\n3 1 3\n0 0\n1 0 0\n0 1\n3 0 1 2\n",
        "error line 4: vertex 2 has more coordinates than the two of the first",
    );
    check_off("OFF\n3 1 3\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "error line 4: vertex 2 has two coordinates, not three");
}

#[test]
fn off_that_is_not_read_is_named() {
    for word in ["4OFF", "nOFF", "4nOFF"] {
        let message =
            format!("error line 1: `{word}` has coordinates of other dimension than three; only plain OFF is read");
        check_off(&format!("{word}\n3 1 3\n"), &message);
    }
    check_off("OFF BINARY\n\0\u{3}", "error line 1: binary OFF is not read; save the file as text");
    check_off("<html>", "error line 1: this is no OFF file: it begins with `<html>`, not with OFF");
    assert_eq!(
        outcome(&[0xff, 0xfe, 0, 10, 32], Format::Off, false),
        "error line 1: this is no OFF file: it begins with `\\xff\\xfe\\x00`, not with OFF"
    );
}

#[test]
fn off_errors_name_their_line() {
    check_off("OFF\n", "error line 1: the file ends before the number of vertices");
    check_off("OFF\n3\n", "error line 2: the file ends before the number of faces");
    check_off("OFF\nx 1 0\n", "error line 2: expected the number of vertices, found `x`");
    check_off("OFF\n3 -1 0\n", "error line 2: expected the number of faces, found `-1`");
    check_off(
        "OFF\n99999999999999999999 1 0\n",
        "error line 2: expected the number of vertices, found `99999999999999999999`",
    );
    check_off("OFF\n3 1 3\n0 0 0\n1 0 0\n", "error line 4: the file ends after 2 of 3 vertices");
    check_off("OFF\n3 1 3\n0 0 0\n1 0", "error line 4: the file ends after 1 of 3 vertices");
    check_off("OFF\n2 1 3\n0 0 0\n1 nan 0\n3 0 1 0", "error line 4: vertex 2: `nan` is not finite");
    check_off(&triangle("OFF\n3 2 3", "", "\n"), "error line 6: the file ends after 1 of 2 faces");
    check_off(&triangle("OFF\n3 2 3", "", "\n3 0 1\n"), "error line 7: face 2 announces 3 corners, but there are 2");
    check_off(
        &triangle("OFF\n3 2 3", "", "\n3 0 1 3\n"),
        "error line 7: face 2 has a corner at vertex 3, but they go from 0 to 2",
    );
    check_off(
        &triangle("OFF\n3 2 3", "", "\n3 0 1 -1\n"),
        "error line 7: expected a vertex of the face, numbered from 0, found `-1`",
    );
    check_off(
        &triangle("OFF\n3 1 3", "", "\nfoo\n"),
        "1 2 3\nWarning: line 7 and what follows is ignored: all announced faces were read",
    );
}

#[test]
fn off_counts_that_lie_cost_nothing() {
    check_off(&triangle("OFF\n1000000000 1 0", "", ""), "error line 6: the file ends after 4 of 1000000000 vertices");
    check_off(
        &triangle("OFF\n3 18446744073709551615 0", "", ""),
        "error line 6: the file ends after 1 of 18446744073709551615 faces",
    );
    check_off(
        &triangle("OFF\n3 2 0", "", "\n4000000000 0 1 2"),
        "error line 7: face 2 announces 4000000000 corners, but there are 3",
    );
}
