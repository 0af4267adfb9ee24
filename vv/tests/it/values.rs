//! Values of vertices, edges and the whole: how they live through edits, declarations and the forgetting of vertices.

use glam::dvec3;
use vv::io::{Format, ReadOptions, read, write};
use vv::mesh::close::close;
use vv::mesh::faces::faces;
use vv::mesh::{Mesh, Value, Vertex};
use vv::stop::Stop;

use crate::mesh::{ring_list, vertex};

/// So many vertices without neighbours, all in the set.
fn mesh(n: usize) -> Mesh {
    let mut mesh = Mesh::new();
    for _ in 0..n {
        let v = mesh.create().unwrap();
        mesh.set.add(v);
    }
    mesh
}

fn members(mesh: &Mesh) -> Vec<Vertex> {
    mesh.set.iter().collect()
}

#[test]
fn an_edge_that_was_a_gap_before_has_no_history() {
    let mut mesh = mesh(4);
    let [v, a, b, c] = [1, 2, 3, 4].map(vertex);
    mesh.make(v, &[Some(a), Some(b)]).unwrap();
    let age = mesh.declare_edge_property("age", Value::Int(9));
    mesh.set_edge_value(age, v, a, Value::Int(1));
    mesh.replace(Some(a), Some(c), v).unwrap();
    assert_eq!(mesh.edge_value(age, v, c), Some(Value::Int(1)), "it stays with its slot");
    mesh.replace(Some(c), None, v).unwrap();
    mesh.replace(None, Some(a), v).unwrap();
    assert_eq!(mesh.edge_value(age, v, a), Some(Value::Int(9)));
}

#[test]
fn what_names_a_forgotten_vertex_names_none_and_what_stays_has_its_new_number() {
    let mut mesh = mesh(4);
    let [p, gone, q, r] = [1, 2, 3, 4].map(vertex);
    mesh.make(p, &[Some(gone), Some(q), Some(r)]).unwrap();
    let mate = mesh.declare_vertex_property("mate", Value::Vertex(None));
    let guest = mesh.declare_edge_property("guest", Value::Vertex(None));
    let [first, lost] = ["first", "lost"].map(|name| mesh.declare_mesh_property(name, Value::Vertex(None)));
    mesh.set_vertex_value(mate, p, Value::Vertex(Some(gone)));
    mesh.set_vertex_value(mate, q, Value::Vertex(Some(r)));
    mesh.set_edge_value(guest, p, q, Value::Vertex(Some(q)));
    mesh.set_edge_value(guest, p, r, Value::Vertex(Some(gone)));
    mesh.set_mesh_value(first, Value::Vertex(Some(q)));
    mesh.set_mesh_value(lost, Value::Vertex(Some(gone)));
    mesh.set.remove(gone);
    assert_eq!(mesh.keep_only_set(), 1);
    let [p, q, r] = [1, 2, 3].map(vertex);
    let none = Some(Value::Vertex(None));
    let is = |v: Vertex| Some(Value::Vertex(Some(v)));
    assert_eq!([mesh.vertex_value(mate, p), mesh.vertex_value(mate, q)], [none, is(r)]);
    assert_eq!([mesh.edge_value(guest, p, q), mesh.edge_value(guest, p, r)], [is(q), none]);
    let whole: Vec<_> = mesh.mesh_properties().iter().map(|(_, value)| Some(*value)).collect();
    assert_eq!(whole, [is(q), none]);
}

#[test]
fn a_set_in_an_order_of_its_own_keeps_it_when_vertices_are_forgotten() {
    let mut mesh = mesh(4);
    [1, 2, 3].into_iter().for_each(|v| _ = mesh.set.remove(vertex(v)));
    [1, 3].into_iter().for_each(|v| _ = mesh.set.add(vertex(v)));
    mesh.keep_only_set();
    assert_eq!(members(&mesh), [3, 1, 2].map(vertex));
    assert!((1..=3).all(|v| mesh.set.contains(vertex(v))));
}

#[test]
fn a_set_that_others_share_is_merged_with_younger_vertices_behind_its_own() {
    let mut mesh = mesh(4);
    let mut younger = vv::mesh::VertexSet::default();
    [4, 3].into_iter().for_each(|v| _ = mesh.set.remove(vertex(v)));
    [3, 4].into_iter().for_each(|v| _ = younger.add(vertex(v)));
    let shared = mesh.set.clone();
    mesh.set.merge(&younger);
    assert_eq!(members(&mesh), [1, 2, 3, 4].map(vertex));
    assert_eq!(shared.len(), 2);
}

#[test]
fn a_mesh_property_is_converted_where_its_new_type_can_hold_it() {
    #[track_caller]
    fn check(before: Value, declared: Value, expected: Value) {
        let mut mesh = Mesh::new();
        mesh.declare_mesh_property("n", before);
        mesh.declare_mesh_property("n", declared);
        assert_eq!(mesh.mesh_properties(), [("n".to_owned(), expected)]);
    }
    check(Value::Int(3), Value::Double(0.5), Value::Double(3.0));
    check(Value::Double(3.0), Value::Int(7), Value::Int(3));
    check(Value::Double(3.5), Value::Int(7), Value::Int(7));
    check(Value::Double(1e19), Value::Int(7), Value::Int(7)); // beyond 64 bits
    check(Value::Vec(dvec3(1.0, 0.0, 0.0)), Value::Bool(true), Value::Bool(true));
}

#[test]
fn room_that_nobody_uses_is_given_back() {
    let mut mesh = mesh(2000);
    let all: Vec<_> = mesh.vertices().skip(1).map(Some).collect();
    mesh.make(vertex(1), &all).unwrap();
    let before = mesh.bytes();
    mesh.make(vertex(1), &[]).unwrap();
    close(&mut mesh, &Stop::default()).unwrap();
    assert!(mesh.bytes() + 4 * 1900 < before, "the long ring is gone");
    assert!(ring_list(&mesh).starts_with("1: , 2: "));
    // Members that come and go leave no holes behind but a few.
    for v in (0..30_000).map(|i| vertex(i % 1999 + 1)) {
        mesh.set.remove(v);
        mesh.set.add(v);
    }
    assert!(mesh.set.bytes() < 100_000, "{}", mesh.set.bytes());
}

#[test]
fn the_warning_of_forgotten_vertices_is_about_those_that_named_them() {
    let mut mesh = mesh(4);
    mesh.make(vertex(4), &[Some(vertex(2)), Some(vertex(1))]).unwrap();
    mesh.set.remove(vertex(2));
    let warnings = close(&mut mesh, &Stop::new()).unwrap();
    assert_eq!(warnings[0].vertices, [vertex(3)]);
}

#[test]
fn numbers_and_tags_are_written_as_others_read_them() {
    let obj = "v 0.00001 1000000000000000 0\nv 0.000001 10000000000000000 0\nv 0 1 0\nf 1 2 3\n\
        t crease 2/1/0 0 1 1e999\nt corner 1/1/0 2 2\n";
    assert!(read(obj.as_bytes(), Format::Obj, &ReadOptions::default()).is_err(), "infinite is not finite");
    let (mut mesh, _) = read(obj.replace("1e999", "3").as_bytes(), Format::Obj, &ReadOptions::default()).unwrap();
    mesh.set_edge_value(0, vertex(1), vertex(2), Value::Double(f64::INFINITY));
    let color = mesh.declare_vertex_property("color", Value::Vec(glam::DVec3::ONE));
    mesh.set_vertex_value(color, vertex(3), Value::Vec(dvec3(f64::NAN, -1.0, 2.0)));
    let written = write(&mesh, &faces(&mesh, &Stop::new()).unwrap(), Format::Obj).unwrap().0;
    assert_eq!(
        String::from_utf8(written).unwrap(),
        "# 3 vertices, 1 faces\nv 0.00001 1000000000000000 0 1 1 1\nv 1e-6 1e16 0 1 1 1\nv 0 1 0 0 0 1\nf 1 2 3\n\
         t crease 2/1/0 0 1 10\nt corner 1/1/0 2 2\n"
    );
}
