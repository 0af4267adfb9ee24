//! What a format cannot hold is said, and what is not said is kept.

use vv::diagnostic::Severity;
use vv::mesh::{Property, Value};

use super::values::values;
use super::*;

/// A square with a value of every kind, some of them under names that mean something in files.
fn full() -> Mesh {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
    let (mut mesh, _) = read(text.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
    let [v, q] = [0, 1].map(|i| mesh.vertices().nth(i).unwrap());
    let vector = Value::Vec(glam::DVec3::new(0.0, 1.0, 0.0));
    let mut on_vertices = |name: &str, value: Value| {
        let i = mesh.declare_vertex_property(name, Value::zero(value.ty()));
        mesh.set_vertex_value(i, v, value);
    };
    on_vertices("age", Value::Int(3));
    on_vertices("color", vector);
    on_vertices("sharpness", Value::Double(2.0));
    on_vertices("red", Value::Bool(true));
    on_vertices("next", Value::Vertex(Some(q)));
    on_vertices("w", vector);
    on_vertices("w_y", Value::Double(5.0));
    on_vertices("idle", Value::Double(0.0));
    let mut on_edges = |name: &str, value: Value| {
        let i = mesh.declare_edge_property(name, Value::zero(value.ty()));
        mesh.set_edge_value(i, v, q, value);
    };
    on_edges("sharpness", Value::Double(1.5));
    on_edges("kind", Value::Int(2));
    on_edges("from", Value::Vertex(Some(v)));
    on_edges("idle", Value::Int(0));
    mesh.declare_mesh_property("step", Value::Int(7));
    mesh.declare_mesh_property("idle", Value::Bool(false));
    mesh
}

#[track_caller]
fn check(mesh: &Mesh, format: Format, expected: &str) {
    let (_, losses) = write(mesh, &faces(mesh, &Stop::new()).unwrap(), format).unwrap();
    let show = |d: vv::diagnostic::Diagnostic| {
        let of_mesh = d.message.contains(" of the mesh ") && d.message.contains("not written");
        assert_eq!(d.severity, if of_mesh { Severity::Note } else { Severity::Warning });
        d.hints.iter().fold(d.message, |text, hint| format!("{text} ({})", hint.message))
    };
    assert_eq!(losses.into_iter().map(show).collect::<Vec<_>>().join("\n"), expected, "{format:?}");
}

/// Of vertices as values nothing is written anywhere.
const NOWHERE: [&str; 2] = [
    "`next` of the vertices is not written: no format holds vertices as values",
    "`from` of the edges is not written: no format holds vertices as values",
];

#[test]
fn properties_that_a_format_has_no_place_for_are_named_once_for_each_kind() {
    let mesh = full();
    let [next, from] = NOWHERE;
    check(
        &mesh,
        Format::Obj,
        &format!(
            "`age`, `red`, `w` and `w_y` of the vertices are not written: `.obj` files have no place for them \
             (`.ply` and `.glb` files keep them)\n{next}\n\
             `kind` of the edges is not written: `.obj` files have no place for it (`.ply` files keep it)\n{from}\n\
             `step` of the mesh is not written: `.obj` files have no place for it (who goes on from the file begins \
             without; `.ply` files keep it)"
        ),
    );
    check(
        &mesh,
        Format::Off,
        &format!(
            "`age`, `sharpness`, `red`, `w` and `w_y` of the vertices are not written: `.off` files have no place for \
             them (`.ply` and `.glb` files keep them)\n{next}\n\
             `sharpness` and `kind` of the edges are not written: `.off` files have no place for them \
             (`.ply` files keep them)\n{from}\n\
             `step` of the mesh is not written: `.off` files have no place for it (who goes on from the file begins \
             without; `.ply` files keep it)"
        ),
    );
    check(
        &mesh,
        Format::Stl,
        &format!(
            "`age`, `color`, `sharpness`, `red`, `w` and `w_y` of the vertices are not written: `.stl` files have no \
             place for them (`.ply` and `.glb` files keep them)\n{next}\n\
             `sharpness` and `kind` of the edges are not written: `.stl` files have no place for them \
             (`.ply` files keep them)\n{from}\n\
             `step` of the mesh is not written: `.stl` files have no place for it (who goes on from the file begins \
             without; `.ply` files keep it)"
        ),
    );
    check(
        &mesh,
        Format::Glb,
        &format!(
            "{next}\n\
             `sharpness` and `kind` of the edges are not written: `.glb` files have no place for them \
             (`.ply` files keep them)\n{from}\n\
             `step` of the mesh is not written: `.glb` files have no place for it (who goes on from the file begins \
             without; `.ply` files keep it)"
        ),
    );
    check(
        &mesh,
        Format::PlyText,
        &format!(
            "`red` and `w_y` of the vertices are not written: their names stand for something else in `.ply` files \
             (another name would be kept)\n{next}\n{from}"
        ),
    );
}

#[test]
fn what_is_not_named_reads_back() {
    let mesh = full();
    for format in Format::ALL {
        let bytes = written(&mesh, format);
        let (_, losses) = write(&mesh, &faces(&mesh, &Stop::new()).unwrap(), format).unwrap();
        let said: String = losses.into_iter().map(|loss| loss.message + "\n").collect();
        let (back, _) = read(&bytes, format, &ReadOptions::default()).unwrap();
        let names = |properties: &[Property]| properties.iter().map(|p| p.name.clone()).collect::<Vec<_>>();
        let whole = |mesh: &Mesh| mesh.mesh_properties().iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
        for (of, had, has) in [
            ("the vertices", names(mesh.vertex_properties()), names(back.vertex_properties())),
            ("the edges", names(mesh.edge_properties()), names(back.edge_properties())),
            ("the mesh", whole(&mesh), whole(&back)),
        ] {
            for name in had.iter().filter(|name| *name != "idle") {
                let is_named = said.lines().any(|l| l.contains(&format!("`{name}`")) && l.contains(of));
                assert_eq!(is_named, !has.contains(name), "{format:?}: `{name}` of {of}\n{said}{}", values(&back));
            }
        }
    }
}

#[test]
fn wires_are_written_to_obj_alone() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 2 0\nv 0 3 0\nf 1 2 3\nl 3 4 5\n";
    let (mesh, _) = read(text.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
    check(&mesh, Format::Obj, "");
    let lost =
        "2 edges without faces are not written: `.off` files have faces alone (`.obj` files have room for lines)";
    check(&mesh, Format::Off, lost);
    check(&mesh, Format::Ply, &lost.replace("off", "ply"));
}

#[test]
fn numbers_that_read_back_as_a_vector_are_named() {
    let mut mesh = full();
    for name in ["p_z", "p_x", "q_x", "q_y"] {
        mesh.declare_edge_property(name, Value::Double(1.0));
    }
    let [next, from] = NOWHERE;
    let before = format!(
        "`red` and `w_y` of the vertices are not written: their names stand for something else in `.ply` files \
         (another name would be kept)\n{next}\n{from}"
    );
    check(&mesh, Format::Ply, &before);
    mesh.declare_edge_property("p_y", Value::Double(1.0));
    check(
        &mesh,
        Format::Ply,
        &format!(
            "{before}\n`p_x`, `p_y` and `p_z` of the edges are the vector `p` to who reads `.ply` files \
             (other names would stay apart)"
        ),
    );
}

#[test]
fn of_many_names_some_are_said() {
    let (mut mesh, _) = read(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", Format::Obj, &ReadOptions::default()).unwrap();
    for i in 0..10 {
        mesh.declare_mesh_property(&format!("n{i}"), Value::Int(1));
    }
    check(
        &mesh,
        Format::Stl,
        "`n0`, `n1`, `n2`, `n3`, `n4`, `n5`, `n6`, `n7` and 2 more of the mesh are not written: `.stl` files have no \
         place for them (who goes on from the file begins without; `.ply` files keep them)",
    );
}

#[test]
fn whole_numbers_that_a_format_rounds_are_named() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
    let mesh = |on_vertices: &[(&str, i64)], on_edges: i64, whole: i64| {
        let (mut mesh, _) = read(text.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
        let [v, q] = [0, 1].map(|i| mesh.vertices().nth(i).unwrap());
        for &(name, value) in on_vertices {
            let i = mesh.declare_vertex_property(name, Value::Int(0));
            mesh.set_vertex_value(i, q, Value::Int(value));
        }
        let i = mesh.declare_edge_property("kind", Value::Int(0));
        mesh.set_edge_value(i, v, q, Value::Int(on_edges));
        mesh.declare_mesh_property("step", Value::Int(whole));
        mesh
    };
    const PLY: i64 = 1 << 53;
    const GLTF: i64 = 1 << 24;
    let all_kept = mesh(&[("a", PLY), ("b", -PLY), ("c", i64::MIN), ("d", 3 << 60)], PLY + 2, PLY);
    let ply = |of: &str| format!("{of} rounded: `.ply` files keep whole numbers up to 2^53");
    let none = mesh(&[("a", PLY + 1), ("b", i64::MAX)], -PLY - 1, PLY + 1);
    for format in [Format::Ply, Format::PlyText, Format::PlyBigEndian] {
        check(&all_kept, format, "");
        let all = ["`a` and `b` of the vertices are", "`kind` of the edges is", "`step` of the mesh is"];
        check(&none, format, &all.map(ply).join("\n"));
    }
    for format in [Format::Glb, Format::Gltf] {
        let files = format!("`.{}` files", format.extension());
        check(&mesh(&[("a", GLTF), ("b", -GLTF), ("c", GLTF + 2)], 0, 0), format, "");
        let rounded = format!(
            "`a` of the vertices is rounded: {files} keep whole numbers up to 2^24 (`.ply` files keep them up to 2^53)"
        );
        check(&mesh(&[("a", GLTF + 1), ("b", GLTF)], 0, 0), format, &rounded);
        check(&mesh(&[("a", i64::MAX)], 0, 0), format, &rounded);
    }
    check(&mesh(&[("sharpness", 5)], 0, 0), Format::Obj, "");
}
