//! PLY.

use super::values::values;
use super::*;

/// A text of one triangle with these lines in the header before the faces, and this at the end of each vertex line.
fn triangle(header: &str, rest: [&str; 3]) -> String {
    let [a, b, c] = rest;
    format!(
        "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 3\nproperty float x\nproperty float y\n\
         property float z\n{header}element face 1\nproperty list uchar int vertex_indices\nend_header\n\
         0 0 0{a}\n1 0 0{b}\n0 1 0{c}\n3 0 1 2\n"
    )
}

#[track_caller]
fn check(text: &str, expected: &str) {
    assert_eq!(outcome(text.as_bytes(), Format::Ply, false), expected);
}

#[track_caller]
fn check_properties(header: &str, rest: [&str; 3], expected: &str) {
    check_values(triangle(header, rest).as_bytes(), Format::Ply, expected);
}

#[test]
fn text_is_read_as_words_in_any_lines() {
    check(&triangle("", [""; 3]), "1 2 3");
    check(&triangle("", [""; 3]).replace('\n', "\r\n"), "1 2 3");
    check(&triangle("", [""; 3]).replace('\n', "\r"), "1 2 3");
    check(&triangle("", ["\n", "\n\n", " "]), "1 2 3");
    check(&triangle("", [""; 3]).replace("vertex_indices", "vertex_index"), "1 2 3");
    check(&triangle("", [""; 3]).replace("0 0 0\n", "0 0\n0\n"), "1 2 3");
}

#[test]
fn properties_of_vertices_are_kept_by_name_and_type() {
    check_properties("property int age\n", [" 3", " -4", " 5"], "age: 3 -4 5");
    check_properties("property double t\n", [" 0.1", " 1e300", " 5"], "t: 0.1 1e300. 5.");
    check_properties(
        "property float v_x\nproperty uchar k\nproperty float v_z\nproperty float v_y\n",
        [" 1 7 3 2", " 0 8 0 0", " 4 9 6 5"],
        "v: (1 2 3) (0 0 0) (4 5 6)\nk: 7 8 9",
    );
    check_properties("property float v_x\nproperty float v_y\n", [" 1 2"; 3], "v_x: 1. 1. 1.\nv_y: 2. 2. 2.");
    check_properties("property list uchar int l\nproperty int k\n", [" 2 8 8 1", " 0 2", " 1 8 3"], "k: 1 2 3");
}

#[test]
fn colours_are_bytes_words_or_fractions() {
    let colors = |ty: &str| format!("property {ty} red\nproperty {ty} green\nproperty {ty} blue\n");
    check_properties(
        &colors("uchar"),
        [" 255 0 51", " 0 0 0", " 1 1 1"],
        &format!("color: (1 0 0.2) (0 0 0) ({0} {0} {0})", 1.0 / 255.0),
    );
    check_properties(&colors("ushort"), [" 65535 0 13107", " 0 0 0", " 0 0 0"], "color: (1 0 0.2) (0 0 0) (0 0 0)");
    check_properties(&colors("float"), [" 1 0 .25", " 0 0 0", " 0 0 0"], "color: (1 0 0.25) (0 0 0) (0 0 0)");
    check_properties(
        &colors("uchar").replace(' ', " diffuse_").replace("diffuse_uchar ", "uchar "),
        [" 255 0 51", " 0 0 0", " 0 0 0"],
        "color: (1 0 0.2) (0 0 0) (0 0 0)",
    );
}

#[test]
fn what_is_not_read_is_named() {
    let text = triangle("property float nx\nproperty float ny\nproperty float nz\nproperty int a-b\n", [" 0 0 1 7"; 3]);
    check(&text, "1 2 3\nNote: `a-b`, `nx`, `ny`, `nz` are not read");
    let text =
        triangle("", [""; 3]).replace("end_header\n", "element material 1\nproperty int k\nend_header\n") + "7\n";
    check(&text, "1 2 3\nNote: `material` are not read");
    check(
        &(triangle("", [""; 3]) + "8"),
        "1 2 3\nWarning: line 15 and what follows is ignored: all announced elements were read",
    );
}

/// As programs have one `v` only, and would find either.
#[test]
fn of_two_properties_with_one_name_the_first_is_read() {
    let vector = "property float v_x\nproperty float v_y\nproperty float v_z\n";
    check_properties(&format!("property int v\n{vector}"), [" 7 1 2 3"; 3], "v: 7 7 7");
    check_properties(&format!("{vector}property int v\n"), [" 1 2 3 7"; 3], "v: (1 2 3) (1 2 3) (1 2 3)");
    let colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let text = triangle(&format!("property double color\n{colors}"), [" 9 255 0 0"; 3]);
    check_values(text.as_bytes(), Format::Ply, "color: (1 0 0) (1 0 0) (1 0 0)");
    let text = triangle("", [""; 3]).replace(
        "end_header\n",
        &format!(
            "element edge 1\nproperty int vertex1\nproperty int vertex2\nproperty int v\n{vector}element mesh 1\n\
             property int v\n{vector}end_header\n"
        ),
    ) + "0 1 7 1 2 3\n8 1 2 3\n";
    check_values(text.as_bytes(), Format::Ply, "v: 1-2 7\nv: 8");
    check(
        &text,
        "1 2 3\nWarning: `edge` has two properties `v`; only the first is read\n\
         Warning: `mesh` has two properties `v`; only the first is read",
    );
}

#[test]
fn edges_and_the_whole_have_properties_too() {
    let text = triangle("", [""; 3]).replace(
        "end_header\n",
        "element edge 2\nproperty int vertex1\nproperty int vertex2\nproperty float sharpness\n\
         element mesh 1\nproperty int step\nproperty double v_x\nproperty double v_y\nproperty double v_z\nend_header\n",
    ) + "1 0 2.5\n2 1 1\n7 1 2 3\n";
    check_values(text.as_bytes(), Format::Ply, "sharpness: 1-2 2.5 2-3 1.\nstep: 7\nv: (1 2 3)");
}

#[test]
fn strips_are_triangles_in_turn() {
    let text = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
        element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
        0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 -1 2 3 4 -1\n";
    check(text, "1 2 3 / 2 4 3 / 3 4 5");
}

#[test]
fn faces_may_stand_before_vertices() {
    let text = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n\
        property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n";
    check(text, "1 2 3");
    check(
        &text.replace("3 0 1 2", "3 0 1 3"),
        "error line 10: face 1 has a corner at vertex 3, but they go from 0 to 2",
    );
}

#[test]
fn errors_name_their_place() {
    let whole = triangle("", [""; 3]);
    let broken = |from: &str, to: &str| whole.replacen(from, to, 1);
    check(&broken("ply\n", "plyx\n"), "error line 1: this is no PLY file: it begins with `plyx`, not with ply");
    check("ply\nformat ascii 1.0\n", "error: the file ends within its header: `end_header` is missing");
    check(&broken("ascii", "binary"), "error line 2: `binary` is no format of PLY");
    check(&broken("format ascii 1.0\n", ""), "error: the header does not say in which format the file is");
    check(&broken("property float x", "property real x"), "error line 5: `real` is no type of PLY");
    check(&broken("property float x", "property list uchar x"), "error line 5: `x` is no type of PLY");
    check(&broken("property float x", "property float"), "error line 5: the property has no name");
    check(&broken("float y", "float x"), "error line 6: the property `x` is named twice");
    check(&broken("float z", "float w"), "error line 4: the vertices have no `z`");
    check(&broken("vertex 3", "vertex -3"), "error line 4: expected how many there are of `vertex`, found `-3`");
    check(&broken("element vertex 3\n", ""), "error line 4: a property stands before the first element");
    check(&broken("comment", "remark"), "error line 3: `remark` is no statement of a PLY header");
    check(&broken("element face 1", "element vertex 1"), "error line 8: the element `vertex` is named twice");
    check(&broken("vertex_indices", "corners"), "error line 8: `face` has no list `vertex_indices`");
    check(&broken("1 0 0", "1 o 0"), "error line 12: `o` is not a number");
    check(&broken("1 0 0", "1 inf 0"), "error line 12: vertex 2: a coordinate is not finite");
    check(&broken("3 0 1 2\n", "3 0 1"), "error line 14: the file ends after 0 of 1 rows of `face`");
    check(
        &broken("vertex 3", "vertex 99999999999999"),
        "error line 14: the file ends after 4 of 99999999999999 rows of `vertex`",
    );
    check(&broken("3 0 1 2", "3 0 -1 2"), "error line 14: face 1 has a corner at vertex -1, but they go from 0 to 2");
    check(
        &broken("3 0 1 2", "-3 0 1 2"),
        "error line 14: row 1 of `face`: the length of a list is negative or no integer",
    );
    check(&broken("3 0 1 2", "9999999999 0 1 2"), "error line 14: the file ends after 0 of 1 rows of `face`");
    check("ply\nformat ascii 1.0\nelement face 0\nend_header\n", "error: the file has no element `vertex`");
    let many: String = (0..1100).map(|i| format!("property int p{i}\n")).collect();
    check(&triangle(&many, [""; 3]), "error line 1005: `vertex` has more than 1000 properties");
}

#[test]
fn rows_without_properties_take_no_time() {
    let text = triangle("", [""; 3]).replace("end_header", "element nothing 18446744073709551615\nend_header");
    check(&text, "1 2 3\nNote: `nothing` are not read");
}

#[test]
fn all_encodings_keep_all_values() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n\
        property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar small\nproperty int middle\n\
        property double large\nproperty double v_x\nproperty double v_y\nproperty double v_z\nelement face 1\n\
        property list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\nproperty int vertex2\n\
        property double sharpness\nelement mesh 1\nproperty int step\nend_header\n\
        0.1 0 0 255 0 7 1 -70000 0.5 1 2 3\n1 0 1e300 1 2 3 2 5 NaN 0 0 0\n0 1 0 0 0 0 255 5 inf -1 0 0.25\n3 0 1 2\n0 2 2.5\n-7\n";
    let (mesh, diagnostics) = read(text.as_bytes(), Format::Ply, &ReadOptions::default()).unwrap();
    assert_eq!(diagnostics, []);
    assert_eq!(String::from_utf8(written(&mesh, Format::PlyText)).unwrap(), text);
    for format in [Format::Ply, Format::PlyBigEndian] {
        let bytes = written(&mesh, format);
        let (again, diagnostics) = read(&bytes, format, &ReadOptions::default()).unwrap();
        assert_eq!(diagnostics, []);
        assert_eq!(values(&again), values(&mesh));
        assert_eq!(again.positions(), mesh.positions());
        assert_eq!(written(&again, Format::PlyText), text.as_bytes());
    }
}

#[test]
fn a_face_of_many_corners_is_written_and_read() {
    let n = 300;
    let mut text = format!("OFF {n} 1 0\n");
    (0..n).for_each(|i| text += &format!("{i} {} 0\n", i * i));
    text += &format!("{n}");
    (0..n).for_each(|i| text += &format!(" {i}"));
    let (mesh, _) = read(text.as_bytes(), Format::Off, &ReadOptions::default()).unwrap();
    for format in [Format::Ply, Format::PlyText, Format::PlyBigEndian] {
        let (again, _) = read(&written(&mesh, format), format, &ReadOptions::default()).unwrap();
        assert_eq!(face_list(&again), face_list(&mesh));
    }
}

#[test]
fn whole_numbers_that_no_double_is_are_said_to_be_rounded() {
    let header = "property double a\nproperty double b\nproperty int c\n";
    let kept = " 9007199254740992 -1152921504606847000 9007199254740993";
    check(&triangle(header, [kept, " 1e300 0.1 0", " nan -inf 0"]), "1 2 3");
    let said = "1 2 3\nWarning: whole numbers of `a`, `b` of `vertex` are rounded: a double keeps those up to 2^53";
    check(&triangle(header, [kept, " 9007199254740993 1 0", " 0 -9223372036854775807 0"]), said);
}
