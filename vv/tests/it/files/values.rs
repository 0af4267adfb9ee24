//! Named values: from files to properties, and back.

use std::fmt::Write;

use super::*;
use vv::mesh::{Property, Value};

fn show(value: Value) -> String {
    match value {
        Value::Vec(v) => format!("({} {} {})", v.x, v.y, v.z),
        Value::Bool(x) => x.to_string(),
        Value::Int(x) => x.to_string(),
        Value::Double(x) => {
            format!("{x:?}").trim_end_matches(".0").to_owned() + if x.fract() == 0.0 { "." } else { "" }
        }
        Value::Vertex(v) => format!("{v:?}"),
    }
}

/// `age: 1 2 3`, then edges as `sharpness: 1-2 2.5`, then the whole.
pub fn values(mesh: &Mesh) -> String {
    let mut text = String::new();
    let begin = |text: &mut String, name: &str| {
        let _ = write!(text, "{}{name}:", if text.is_empty() { "" } else { "\n" });
    };
    for (i, Property { name, .. }) in mesh.vertex_properties().iter().enumerate() {
        begin(&mut text, name);
        mesh.vertices().for_each(|v| text += &format!(" {}", show(mesh.vertex_value(i, v).unwrap())));
    }
    for (i, Property { name, .. }) in mesh.edge_properties().iter().enumerate() {
        begin(&mut text, name);
        for p in mesh.vertices() {
            for q in mesh.ring(p).vertices().filter(|&q| p < q) {
                let value = mesh.edge_value(i, p, q).unwrap();
                assert_eq!(mesh.edge_value(i, q, p), Some(value));
                if value != Value::zero(value.ty()) {
                    let _ = write!(text, " {}-{} {}", p.index() + 1, q.index() + 1, show(value));
                }
            }
        }
    }
    for (name, value) in mesh.mesh_properties() {
        begin(&mut text, name);
        text += &format!(" {}", show(*value));
    }
    text
}

#[track_caller]
pub fn check_values(bytes: &[u8], format: Format, expected: &str) {
    let (mesh, _) = read(bytes, format, &ReadOptions::default()).unwrap();
    assert_eq!(values(&mesh), expected);
}

/// Two triangles, 1 2 3 and 1 3 4, with these lines behind.
fn square(rest: &str) -> String {
    format!("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n{rest}")
}

#[test]
fn creases_and_corners_are_sharpness() {
    let check = |tags: &str, expected: &str| check_values(square(tags).as_bytes(), Format::Obj, expected);
    check("t crease 2/1/0 0 2 2.5\n", "sharpness: 1-3 2.5");
    check("t crease 2/1/0 2 0 2.5\nt crease 2/1/0 0 1 1\n", "sharpness: 1-2 1. 1-3 2.5");
    check("t crease 4/1/0 0 1 2 3 .5\n", "sharpness: 1-2 0.5 3-4 0.5");
    check("t crease 4/2/0 0 1 2 3 .5 7\n", "sharpness: 1-2 0.5 3-4 7.");
    check("t crease 2/1/0 0 2 1\nt crease 2/1/0 2 0 3\n", "sharpness: 1-3 3."); // the last counts
    check("t crease 2/1/0 0 2 -1\n", "sharpness:");
    check("t corner 1/1/0 3 4\n", "sharpness: 0. 0. 0. 4.");
    check("t corner 2/2/0 3 0 4 1\n", "sharpness: 1. 0. 0. 4.");
    check("t corner 1/1/0 3 4\nt crease 2/1/0 0 3 1\n", "sharpness: 0. 0. 0. 4.\nsharpness: 1-4 1.");
    check("", "");
    // Tags may stand before the faces.
    check_values(format!("t corner 1/1/0 3 4\n{}", square("")).as_bytes(), Format::Obj, "sharpness: 0. 0. 0. 4.");
}

#[test]
fn creases_that_are_none_are_named() {
    let check = |tags: &str, expected: &str| check_obj(&square(tags), expected);
    check(
        "t crease 2/1/0 1 3 2\n",
        "1 2 3 / 1 3 4\nWarning: 1 edge with a value of `sharpness` is the side of no face; dropped\n  v2–v4",
    );
    check("t crease 2/1/0 0 4 1\n", "error line 7: the crease names vertex `4`, but in a tag they go from 0 to 3");
    check("t crease 2/1/0 0 -1 1\n", "error line 7: the crease names vertex `-1`, but in a tag they go from 0 to 3");
    check("t crease 2/1/0 0 1 x\n", "error line 7: `x` is not a number");
    check("t crease 2/1/0 0 1\n", "error line 7: the crease has no sharpness");
    check("t crease 2/1/0 0\n", "error line 7: the crease ends after 1 vertices");
    check("t crease 2/1 0 1 2\n", "error line 7: expected counts as `2/1/0`, found `2/1`");
    check("t crease 3/1/0 0 1 2 1\n", "error line 7: the crease has 3 vertices and 1 numbers");
    check("t crease 99999999999/1/0 0 1 2 1\n", "error line 7: the crease has 99999999999 vertices and 1 numbers");
    check("t corner\n", "error line 7: the corner has no counts as `1/1/0`");
    check(
        "t interpolateboundary 1/0/0 1\n",
        "1 2 3 / 1 3 4\n\
         Note: normals, texture coordinates, groups, materials and tags but creases and corners are not read",
    );
}

#[test]
fn creases_and_colours_are_written() {
    let colored = "# 4 vertices, 2 faces\n\
        v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 0.5 0.25 0\nf 1 2 3\nf 1 3 4\n\
        t crease 2/1/0 0 1 1\nt crease 2/1/0 0 2 2.5\nt corner 1/1/0 3 4\n";
    let (mesh, _) = read(colored.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
    assert_eq!(String::from_utf8(written(&mesh, Format::Obj)).unwrap(), colored);
    let off =
        "COFF\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n1 1 0 0 0 255 255\n0 1 0 128 64 0 255\n3 0 1 2\n3 0 2 3\n";
    assert_eq!(String::from_utf8(written(&mesh, Format::Off)).unwrap(), off);
}

#[test]
fn values_go_with_their_vertices_and_edges() {
    // v2 is in no face; v1 is doubled, as is the crease.
    let text = "v 0 0 0 1 0 0\nv 9 9 9 0 0 1\nv 1 0 0 0 1 0\nv 0 1 0 0 1 0\nv 0 0 1 0 1 0\nv 0 -1 0 0 1 0\n\
        f 1 3 4\nf 3 1 5\nf 1 3 6\nt crease 2/1/0 0 2 3\n";
    check_values(
        text.as_bytes(),
        Format::Obj,
        "color: (1 0 0) (0 1 0) (0 1 0) (0 1 0) (0 1 0) (1 0 0) (0 1 0)\nsharpness: 1-2 3. 6-7 3.",
    );
}

#[test]
fn a_declaration_finds_the_values_of_its_name_if_its_type_can_hold_them() {
    let ply = |ty: &str, a: &str, b: &str, c: &str| {
        let text = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n\
             property {ty} p\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
             0 0 0 {a}\n1 0 0 {b}\n0 1 0 {c}\n3 0 1 2\n"
        );
        read(text.as_bytes(), Format::Ply, &ReadOptions::default()).unwrap().0
    };
    #[track_caller]
    fn check(mut mesh: Mesh, default: Value, expected: &str) {
        mesh.declare_vertex_property("p", default);
        assert_eq!(values(&mesh), expected);
        let v = mesh.create().unwrap();
        assert_eq!(mesh.vertex_value(0, v), Some(default));
    }
    check(ply("int", "1", "0", "7"), Value::Int(9), "p: 1 0 7");
    check(ply("int", "1", "0", "7"), Value::Double(9.5), "p: 1. 0. 7.");
    check(ply("uchar", "1", "0", "1"), Value::Bool(true), "p: true false true");
    check(ply("uchar", "1", "0", "2"), Value::Bool(true), "p: true true true");
    check(ply("float", "1", "0", "-3"), Value::Int(9), "p: 1 0 -3");
    check(ply("float", "1", "0", "0.5"), Value::Int(9), "p: 9 9 9");
    check(ply("float", "1", "nan", "0"), Value::Int(9), "p: 9 9 9");
    check(ply("float", "1", "0", "0"), Value::Bool(false), "p: true false false");
    check(ply("float", "1", "0", "0"), Value::Vec(glam::DVec3::X), "p: (1 0 0) (1 0 0) (1 0 0)");
}

/// What would be two columns of one name is written once, and what means something at vertices alone is kept elsewhere.
#[test]
fn names_that_would_clash_in_a_file_do_not_spoil_it() {
    let (mut mesh, _) = read(square("").as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
    let half = Value::Vec(glam::DVec3::splat(0.5));
    mesh.declare_vertex_property("v", half);
    mesh.declare_vertex_property("v_y", Value::Double(2.5));
    mesh.declare_vertex_property("red", Value::Int(7));
    mesh.declare_vertex_property("color", half);
    mesh.declare_edge_property("vertex1", Value::Int(7));
    mesh.declare_edge_property("color", half);
    mesh.declare_edge_property("x", Value::Double(1.5));
    mesh.declare_mesh_property("blue", Value::Int(3));
    let (back, _) = read(&written(&mesh, Format::Ply), Format::Ply, &ReadOptions::default()).unwrap();
    let names = |properties: &[Property]| properties.iter().map(|p| p.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(back.vertex_properties()), ["color", "v"]);
    assert_eq!(names(back.edge_properties()), ["color", "x"]);
    assert_eq!(back.edge_value(0, back.vertices().next().unwrap(), back.vertices().nth(1).unwrap()), Some(half));
    assert_eq!(back.mesh_properties(), [("blue".to_owned(), Value::Int(3))]);
}

#[test]
fn errors_name_the_column_of_the_word_they_are_about() {
    let check = |text: &str, format: Format, expected: &str| {
        let Err(ReadError::Invalid { place, .. }) = read(text.as_bytes(), format, &ReadOptions::default()) else {
            panic!("{text}")
        };
        assert_eq!(place.unwrap().to_string(), expected);
    };
    check("v 0 0 0\nv 1 xx 0\n", Format::Obj, "2:5");
    check("v 0 0 0\nf 1  7 1\n", Format::Obj, "2:6");
    check("v 0 0 0\nf ü 1 1 q 1\n", Format::Obj, "2:3");
    check("v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\nt crease 2/1/0 1 8 1\n", Format::Obj, "5:18");
    check("v 0 \\\n 0 x\n", Format::Obj, "1");
    check("OFF\n3 1 0\n0 0 0\n 1 ä 0", Format::Off, "4:4");
    check("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 5", Format::Off, "6:7");
    check("solid a\n facet normal 0 0 1\n  outer lop\n", Format::Stl, "3:9");
}
