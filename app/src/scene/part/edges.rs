//! The edges of a mesh, and which of them lie between two faces.

use std::collections::HashSet;

use vv::mesh::faces::Faces;
use vv::mesh::{Mesh, Vertex};
use vv::stop::{Stop, Stopped};

/// On how many sides an edge has a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sides {
    Both,
    OneOrNone,
}

/// Which directed edges faces walk.
///
/// An edge p→q leads out of p, and a face that passes p leaves it by one. So where as many corners of faces lie at p as
/// its ring has entries, faces walk all of them, and all these neighbours answer. What faces walk is looked up only at
/// the other vertices, the *rim*: few, as a rule none.
pub(super) struct Walked {
    /// For each vertex whether it is on the rim; empty if there is no rim.
    rim: Vec<bool>,
    /// The edges out of the rim that faces walk, sorted.
    out_of_rim: Vec<(Vertex, Vertex)>,
}

impl Walked {
    /// Cost: linear, and sorting what the rim takes.
    pub(super) fn new(mesh: &Mesh, faces: &Faces, stop: &Stop) -> Result<Self, Stopped> {
        stop.check()?;
        let n = mesh.vertex_count();
        let entries: usize = mesh.vertices().map(|v| mesh.ring(v).valence()).sum();
        let polygons = || faces.iter().filter(|face| face.len() > 2);
        if polygons().map(<[Vertex]>::len).sum::<usize>() == entries {
            return Ok(Self { rim: Vec::new(), out_of_rim: Vec::new() });
        }
        let mut corners = vec![0u32; n];
        for &v in polygons().flatten() {
            if let Some(count) = corners.get_mut(v.index()) {
                *count += 1;
            }
        }
        stop.check()?;
        let rim: Vec<bool> =
            mesh.vertices().zip(corners).map(|(v, count)| count as usize != mesh.ring(v).valence()).collect();
        let mut out_of_rim = Vec::new();
        for face in polygons() {
            let mut before = face[face.len() - 1];
            for &v in face {
                if rim.get(before.index()).is_some_and(|&rim| rim) {
                    out_of_rim.push((before, v));
                }
                before = v;
            }
        }
        stop.check()?;
        out_of_rim.sort_unstable();
        Ok(Self { rim, out_of_rim })
    }

    fn on_rim(&self, v: Vertex) -> bool {
        self.rim.get(v.index()).is_some_and(|&rim| rim)
    }

    fn by_face(&self, p: Vertex, q: Vertex) -> bool {
        !self.on_rim(p) || self.out_of_rim.binary_search(&(p, q)).is_ok()
    }

    /// Each pair of neighbours once, in order of the vertex that is looked at, then of its ring: that is the older one,
    /// but for pairs that only the younger names. The younger comes last.
    pub(super) fn for_each_edge(
        &self,
        mesh: &Mesh,
        stop: &Stop,
        mut edge: impl FnMut(Vertex, Vertex, Sides),
    ) -> Result<(), Stopped> {
        // The pairs that the older one names, and no face walks from the younger. Only ever asked.
        let mut named = HashSet::new();
        for p in mesh.vertices() {
            stop.check()?;
            let rim = self.on_rim(p);
            for q in mesh.ring(p).vertices() {
                if p < q {
                    let back = self.by_face(q, p);
                    if !back {
                        named.insert((p, q));
                    }
                    edge(p, q, if back && self.by_face(p, q) { Sides::Both } else { Sides::OneOrNone });
                } else if rim && !self.by_face(p, q) && !named.contains(&(q, p)) {
                    edge(q, p, Sides::OneOrNone);
                }
            }
        }
        Ok(())
    }
}
