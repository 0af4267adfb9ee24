//! OBJ.

use super::*;

/// Three vertices to begin an OBJ with.
const THREE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// A file of [`THREE`] and `rest`.
#[track_caller]
fn check_three(rest: &str, expected: &str) {
    check_obj(&format!("{THREE}{rest}"), expected);
}

#[test]
fn obj_lines_may_end_and_go_on_in_any_way() {
    check_three("f 1 2 3\n", "1 2 3");
    check_three("f 1 2 3", "1 2 3");
    check_obj(&format!("{THREE}f 1 2 3\n").replace('\n', "\r\n"), "1 2 3");
    check_obj(&format!("{THREE}f 1 2 3\n").replace('\n', "\r"), "1 2 3");
    check_obj(&format!("\u{feff}{THREE}f 1 2 3\n"), "1 2 3");
    check_obj("v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\n", "1 2 3");
    check_obj("v 0 \\\r\n0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 \\\r\n3\r\n", "1 2 3");
    check_three("f 1 2 3 \\", "1 2 3");
    check_obj("# c\nv\t0 0 0 # a\n  v 1 0 0 # 1 2\n\nv +.1 1. 1e-3\nf  1\t2 3 # x\n", "1 2 3");
}

#[test]
fn obj_corners_have_all_forms() {
    check_three("f 1// 2/1/ 3/1/1\n", "1 2 3");
    check_three("f 1/1/ 2/9/9 3//-7\n", "1 2 3");
    check_three("f -3 -2 -1\nv 1 1 0\nf -3 -1 -2\n", "1 2 3 / 2 4 3");
    check_obj(&format!("f 1 2 3\n{THREE}"), "1 2 3");
    check_three("v 0 0 1\nf 4 3 2\nf 1 2 3\n", "1 2 3 / 2 4 3");
}

#[test]
fn obj_groups_do_not_part_a_mesh() {
    check_obj(
        "mtllib a b.mtl\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\ng x\nusemtl m\nf 1 2 3\no b\nv 0 0 1\nusemtl k\ns off\n\
         f 1 3 4\n",
        "1 2 3 / 1 3 4\n\
         Note: normals, texture coordinates, groups, materials and tags but creases and corners are not read",
    );
}

#[test]
fn obj_colours_and_weights() {
    let colors = "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 0.5 0.5 0.25 1\nf 1 2 3\n";
    check_values(colors.as_bytes(), Format::Obj, "color: (1 0 0) (1 1 1) (0.5 0.5 0.25)");
    let bytes = "v 0 0 0 255 0 0\nv 1 0 0\nv 0 1 0 51 102 0\nf 1 2 3\n";
    check_values(bytes.as_bytes(), Format::Obj, "color: (1 0 0) (1 1 1) (0.2 0.4 0)");
    check_obj("v 0 0 0 1 0 x\n", "error line 1: `x` is not a number");
    let (mesh, _) = read(b"v 2 4 6 2\nv 1 0 0\nv 0 1 0\nf 1 2 3", Format::Obj, &ReadOptions::default()).unwrap();
    assert_eq!(mesh.positions()[0].to_array(), [1.0, 2.0, 3.0]);
    check_obj("v 0 0 0 0\n", "error line 1: the weight of the vertex is 0");
    check_obj(
        "v 0 0 0 1 1\n",
        "error line 1: the vertex has 5 numbers; it takes three, four with a weight, six with a colour",
    );
}

#[test]
fn obj_statements_that_are_not_read_are_named() {
    check_three(
        "p 1\np 2\nf 1 2 3\n",
        "1 2 3\nWarning: `p` (points) on line 4 and 1 more like it ignored: points are not read",
    );
    check_three(
        "foo 1 2\nbar\nf 1 2 3\n",
        "1 2 3\nWarning: `foo` on line 4 and 1 more like it ignored: this is no statement of an OBJ file",
    );
    check_three(
        "cstype bspline\ndeg 3\nf 1 2 3\n",
        "1 2 3\nWarning: a free-form curve or surface on line 4 and 1 more like it ignored: only polygons and lines are read",
    );
}

#[test]
fn obj_errors_name_their_line() {
    check_obj("v 0 0 0\nv 1 0\n", "error line 2: the vertex has two coordinates, not three");
    check_obj("v 0 0 0\nv a 0 0\n", "error line 2: `a` is not a number");
    let said = "error line 1: `0,5` is not a number: a point stands before decimals, not a comma";
    check_obj("v 0,5 0 0\n", said);
    check_obj("v 0 0 0\nv nan 0 0\nf 1 1 2\n", "error line 2: `nan` is not finite");
    check_obj("v 0 0 0\nv 0 -inf 0\n", "error line 2: `-inf` is not finite");
    check_obj("v 0 0 0\nv 1e999 0 0\n", "error line 2: `1e999` is too large for a double");
    check_obj("v 1e300 0 0 1e-300\n", "error line 1: the coordinates divided by the weight are too large");
    check_three("v 1.5e", "error line 4: `1.5e` is not a number");
    check_three("f 1 2 3\nf 1 2", "error line 5: the file ends within a face, after `f 1 2`; it was probably cut off");
    check_three("f 1 2 4\n", "error line 4: the face has a corner at vertex `4`, but the last vertex is 3");
    check_three("f 0 1 2\n", "error line 4: the face has a corner at vertex `0`, but vertices are numbered from 1");
    check_three("f -4 -2 -1\n", "error line 4: the face has a corner at vertex `-4`, but 3 vertices stand before it");
    check_three("f /1 2 3\n", "error line 4: the face has a corner at vertex `/1`, but it names no vertex");
    check_three(
        "f 1 2 9223372036854775807\n",
        "error line 4: the face has a corner at vertex `9223372036854775807`, but the last vertex is 3",
    );
    for word in ["x", "1.0", "1/1/1/1", "99999999999999999999"] {
        let message = format!("error line 4: `{word}` is no corner of a face, as `7`, `-1` or `7/1/3` would be");
        check_three(&format!("f 1 2 {word}\n"), &message);
    }
    check_obj("f 1 2 3\n", "error line 1: the face has a corner at vertex `1`, but the file has no vertices");
    check_obj("PK\u{1}\u{2} asd\nasdasd\n", "error: this is no OBJ file: no line begins with `v` or `f`");
    assert_eq!(outcome(b"v \xff", Format::Obj, false), "error line 1: `\\xff` is not a number");
}

/// A face over a million lines is joined once, not again with each of them.
#[test]
fn a_statement_may_be_continued_on_very_many_lines() {
    let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 {}3\n", "\\\n".repeat(1_000_000));
    check_obj(&text, "1 2 3");
    check_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n2 \\ \n 3\\", "1 2 3");
}
