//! Laws of the rotation system: rings, orbits, closing, validation, counts.

use vv::mesh::faces::faces;
use vv::mesh::{Mesh, Vertex};
use vv::stop::Stop;

pub fn vertex(number: usize) -> Vertex {
    Vertex::from_index(number - 1).unwrap()
}

/// `1 2 3 / 1 3 4`
pub fn face_list(mesh: &Mesh) -> String {
    let face = |f: &[Vertex]| f.iter().map(|v| (v.index() + 1).to_string()).collect::<Vec<_>>().join(" ");
    faces(mesh, &Stop::new()).unwrap().iter().map(face).collect::<Vec<_>>().join(" / ")
}

/// `1: 2 3 -` for each vertex, joined by `, `.
pub fn ring_list(mesh: &Mesh) -> String {
    let slot = |x: &Option<Vertex>| x.map_or("-".to_owned(), |x| (x.index() + 1).to_string());
    let ring = |v: Vertex| mesh.ring(v).slots().iter().map(slot).collect::<Vec<_>>().join(" ");
    mesh.vertices().map(|v| format!("{}: {}", v.index() + 1, ring(v))).collect::<Vec<_>>().join(", ")
}

#[test]
fn vertices_count_from_one() {
    assert_eq!(vertex(7).to_string(), "v7");
}
