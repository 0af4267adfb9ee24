//! Meshes compared vertex by vertex.

use std::fmt;

use vv::mesh::faces::Faces;
use vv::mesh::{Mesh, Vertex};

/// How a mesh differs from its reference.
#[derive(Debug, Clone, PartialEq)]
pub enum MeshDifference {
    /// Another number of vertices.
    VertexCount {
        /// In the mesh.
        found: usize,
        /// In the reference.
        expected: usize,
    },
    /// Vertices lie elsewhere.
    Positions {
        /// The vertex that is furthest off.
        vertex: Vertex,
        /// Its distance from where it should be; NaN if a coordinate is.
        distance: f64,
        /// How many vertices are further off than the tolerance.
        count: usize,
    },
    /// Another number of faces.
    FaceCount {
        /// In the mesh.
        found: usize,
        /// In the reference.
        expected: usize,
    },
    /// As many faces, but others.
    Face {
        /// One that the reference lacks.
        found: Vec<Vertex>,
        /// One that only the reference has.
        expected: Vec<Vertex>,
    },
}

impl fmt::Display for MeshDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::VertexCount { found, expected } => write!(f, "it has {found} vertices in place of {expected}"),
            Self::Positions { vertex, distance, count } => {
                let others = if *count == 1 { "vertex is" } else { "vertices are" };
                write!(f, "{vertex} is {distance:e} off its place; {count} {others} further off than the tolerance")
            }
            Self::FaceCount { found, expected } => write!(f, "it has {found} faces in place of {expected}"),
            Self::Face { found, expected } => {
                let list = |face: &[Vertex]| face.iter().map(Vertex::to_string).collect::<Vec<_>>().join(" ");
                write!(f, "its face {} is none of the reference, which has {}", list(found), list(expected))
            }
        }
    }
}

/// Compares a mesh with a reference whose vertices are numbered alike. Positions may differ by `tolerance` (a distance);
/// faces must be the same polygons, in any order and from any corner on. Cost: O(faces · log faces).
///
/// # Errors
/// The first kind of difference in the order of [`MeshDifference`].
pub fn compare_meshes(
    (mesh, faces): (&Mesh, &Faces),
    (reference, reference_faces): (&Mesh, &Faces),
    tolerance: f64,
) -> Result<(), MeshDifference> {
    let (found, expected) = (mesh.positions(), reference.positions());
    if found.len() != expected.len() {
        return Err(MeshDifference::VertexCount { found: found.len(), expected: expected.len() });
    }
    let mut worst: Option<(usize, f64)> = None;
    let mut count = 0;
    for (i, (a, b)) in found.iter().zip(expected).enumerate() {
        let distance = a.distance(*b);
        if distance <= tolerance || a == b {
            continue;
        }
        count += 1;
        if worst.is_none_or(|(_, d)| distance > d || (distance.is_nan() && !d.is_nan())) {
            worst = Some((i, distance));
        }
    }
    if let Some((i, distance)) = worst
        && let Some(vertex) = Vertex::from_index(i)
    {
        return Err(MeshDifference::Positions { vertex, distance, count });
    }
    if faces.len() != reference_faces.len() {
        return Err(MeshDifference::FaceCount { found: faces.len(), expected: reference_faces.len() });
    }
    let (found, expected) = (canonical(faces), canonical(reference_faces));
    if found == expected {
        return Ok(());
    }
    let lacking = |from: &[Vec<Vertex>], of: &[Vec<Vertex>]| {
        from.iter().find(|face| of.binary_search(face).is_err()).or(from.first()).cloned().unwrap_or_default()
    };
    Err(MeshDifference::Face { found: lacking(&found, &expected), expected: lacking(&expected, &found) })
}

/// The faces in ascending order, each turned so that its least corner sequence comes first.
fn canonical(faces: &Faces) -> Vec<Vec<Vertex>> {
    let turned = |face: &[Vertex]| {
        let least = face.iter().min().copied();
        let starts = (0..face.len()).filter(|&i| Some(face[i]) == least);
        starts.map(|i| [&face[i..], &face[..i]].concat()).min().unwrap_or_default()
    };
    let mut faces: Vec<_> = faces.iter().map(turned).collect();
    faces.sort_unstable();
    faces
}

#[cfg(test)]
mod tests {
    use super::*;
    use vv::io::{Format, ReadOptions, read};
    use vv::mesh::faces::faces;
    use vv::stop::Stop;

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

    fn mesh(obj: &str) -> (Mesh, Faces) {
        let mesh = read(obj.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap().0;
        let faces = faces(&mesh, &Stop::new()).unwrap();
        (mesh, faces)
    }

    /// Compares the square with `from` replaced by `to` with the square itself.
    #[track_caller]
    fn check(from: &str, to: &str, expected: &str) {
        let (a, b) = (mesh(&SQUARE.replace(from, to)), mesh(SQUARE));
        let got = compare_meshes((&a.0, &a.1), (&b.0, &b.1), 1e-9);
        assert_eq!(got.map_or_else(|d| d.to_string(), |()| "same".to_owned()), expected);
    }

    #[test]
    fn meshes_are_the_same_whatever_the_order_of_faces_and_corners() {
        check("f", "f", "same");
        check("f 1 2 3\nf 1 3 4\n", "f 3 4 1\nf 2 3 1\n", "same");
    }

    #[test]
    fn positions_may_differ_by_the_tolerance() {
        check("1 1 0", "1 1 1e-10", "same");
        check("1 1 0", "1 1 1e-8", "v3 is 1e-8 off its place; 1 vertex is further off than the tolerance");
        check(" 1 0\n", " 3 0\n", "v3 is 2e0 off its place; 2 vertices are further off than the tolerance");
    }

    #[test]
    fn another_connectivity_is_a_difference() {
        check(
            "f 1 2 3\nf 1 3 4\n",
            "f 1 2 4\nf 2 3 4\n",
            "its face v1 v2 v4 is none of the reference, which has v1 v2 v3",
        );
        check("f 1 2 3\nf 1 3 4\n", "f 1 2 3 4\n", "it has 1 faces in place of 2");
        check("f 1 2 3\n", "v 2 2 2\nf 1 2 3\nf 2 5 3\n", "it has 5 vertices in place of 4");
    }
}
