//! Edmonds' walk around a face, step by step.
//!
//! The paper's rule: from p→q go on to q→r with **r = nextto p in q**, until p→q comes again. With rings that are
//! counter-clockwise seen from outside it walks each polygon clockwise, with the face on the right hand; the engine finds
//! the same polygons read backwards ([`vv::mesh::faces`]).

use vv::mesh::{Mesh, Vertex};

/// Walks are followed so far.
pub const LONGEST: usize = 10_000;

/// A walk.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Walk {
    /// The vertices in the order in which they are passed; two or more, the first one at the end again if it closes.
    pub path: Vec<Vertex>,
    /// How it ends.
    pub end: End,
}

/// How a walk ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// It comes back to its first edge: the orbit is a face.
    Closed,
    /// A gap follows `from` in the ring of `at`: the orbit lies along the boundary.
    Gap {
        /// Whose ring has the gap.
        at: Vertex,
        /// After which neighbour.
        from: Vertex,
    },
    /// `at` does not name `from`, from where the walk comes: an incomplete neighbour breaks the orbit.
    Broken {
        /// In whose ring the walk would go on.
        at: Vertex,
        /// What it looks for there.
        from: Vertex,
    },
    /// `at` is not in the set.
    Outside {
        /// The vertex.
        at: Vertex,
    },
    /// It was not followed to its end.
    Long,
}

impl Walk {
    /// From p to its neighbour q and on. Cost: linear in its length, times the lengths of the rings.
    #[must_use]
    pub fn from(mesh: &Mesh, p: Vertex, q: Vertex) -> Self {
        if !mesh.ring(p).contains(Some(q)) {
            return Self { path: vec![p, q], end: End::Broken { at: p, from: q } };
        }
        let mut path = vec![p, q];
        let (mut u, mut v) = (p, q);
        let end = loop {
            if !mesh.set.contains(v) {
                break End::Outside { at: v };
            }
            let w = match mesh.ring(v).next(Some(u)) {
                None => break End::Broken { at: v, from: u },
                Some(None) => break End::Gap { at: v, from: u },
                Some(Some(w)) => w,
            };
            // The step has an inverse, so the first edge to come again is the one of the start.
            if (v, w) == (p, q) {
                break End::Closed;
            }
            if path.len() > LONGEST {
                break End::Long;
            }
            path.push(w);
            (u, v) = (v, w);
        };
        Self { path, end }
    }

    /// The whole walk that passes p→q, from where it begins: at p itself if it closes, else behind a gap or a vertex that
    /// nobody comes from.
    #[must_use]
    pub fn through(mesh: &Mesh, p: Vertex, q: Vertex) -> Self {
        let walk = Self::from(mesh, p, q);
        if matches!(walk.end, End::Closed) {
            return walk;
        }
        let (mut u, mut v) = (p, q);
        for _ in 0..LONGEST {
            // t→u comes before u→v if v = nextto t in u.
            match mesh.ring(u).previous(Some(v)) {
                Some(Some(t)) if mesh.set.contains(t) && mesh.ring(t).contains(Some(u)) => (u, v) = (t, u),
                _ => break,
            }
        }
        Self::from(mesh, u, v)
    }

    /// How many arrows it has.
    #[must_use]
    pub fn arrows(&self) -> usize {
        self.path.len() - 1
    }

    /// The rule that gave arrow `i`: `v9 = nextto v3 in v12`.
    #[must_use]
    pub fn rule(&self, i: usize) -> String {
        match (i, &self.path[..]) {
            (0, [p, q, ..]) => format!("{q} is a neighbour of {p}"),
            (i, path) if i + 1 < path.len() => format!("{} = nextto {} in {}", path[i + 1], path[i - 1], path[i]),
            _ => String::new(),
        }
    }

    /// How it ends, in words.
    #[must_use]
    pub fn conclusion(&self) -> String {
        match self.end {
            End::Closed => format!("closed orbit: a face of {} corners", self.arrows()),
            End::Gap { at, from } => format!("nextto {from} in {at} is a gap: the walk ends at the boundary"),
            End::Broken { at, from } if self.path.first() == Some(&at) => {
                format!("there is no way from {at} to {from}: {at} does not name it")
            }
            End::Broken { at, from } => {
                format!("broken orbit: {at} does not name {from}, so nothing is nextto {from} in {at}")
            }
            End::Outside { at } => format!("broken orbit: {at} is not in the set"),
            End::Long => format!("the orbit goes on after {LONGEST} steps"),
        }
    }

    /// Whether something is wrong with the mesh there.
    #[must_use]
    pub fn is_broken(&self) -> bool {
        matches!(self.end, End::Broken { .. } | End::Outside { .. })
    }
}

/// The face on the left of p→q, its corners counter-clockwise; `None` if there is a hole, or the orbit is broken or too
/// long.
#[must_use]
pub fn face_left_of(mesh: &Mesh, [p, q]: [Vertex; 2]) -> Option<Vec<Vertex>> {
    // The walk from q to p has the same face on its right.
    let walk = Walk::from(mesh, q, p);
    let mut corners = match walk.end {
        End::Closed => walk.path,
        _ => return None,
    };
    corners.truncate(corners.len() - 1);
    corners.reverse();
    // … p q: p first.
    let count = corners.len();
    corners.rotate_right(2 % count.max(1));
    Some(corners)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn v(number: usize) -> Vertex {
        Vertex::from_index(number - 1).unwrap()
    }

    fn mesh(rings: &[&[usize]]) -> Mesh {
        let mut mesh = Mesh::new();
        for _ in rings {
            let v = mesh.create().unwrap();
            mesh.set.add(v);
        }
        for (i, ring) in rings.iter().enumerate() {
            let items: Vec<_> = ring.iter().map(|&n| (n > 0).then(|| v(n))).collect();
            mesh.make(v(i + 1), &items).unwrap();
        }
        mesh
    }

    #[track_caller]
    fn check(walk: &Walk, path: &str, end: &str) {
        let names: Vec<String> = walk.path.iter().map(ToString::to_string).collect();
        assert_eq!(names.join(" "), path);
        assert_eq!(walk.conclusion(), end);
    }

    /// A tetrahedron.
    fn tetrahedron() -> Mesh {
        mesh(&[&[2, 3, 4], &[1, 4, 3], &[1, 2, 4], &[1, 3, 2]])
    }

    #[test]
    fn a_walk_closes_around_a_face_by_the_papers_rule() {
        let walk = Walk::from(&tetrahedron(), v(1), v(2));
        check(&walk, "v1 v2 v4 v1", "closed orbit: a face of 3 corners");
        let rules: Vec<String> = (0..walk.arrows()).map(|i| walk.rule(i)).collect();
        assert_eq!(rules, ["v2 is a neighbour of v1", "v4 = nextto v1 in v2", "v1 = nextto v2 in v4"]);
    }

    #[test]
    fn the_face_on_the_left_is_that_of_the_engine() {
        let mesh = tetrahedron();
        let faces = vv::mesh::faces::faces(&mesh, &vv::stop::Stop::new()).unwrap();
        for face in faces.iter() {
            for i in 0..face.len() {
                let mut turned = face.to_vec();
                turned.rotate_left(i);
                assert_eq!(face_left_of(&mesh, [turned[0], turned[1]]), Some(turned));
            }
        }
    }

    #[test]
    fn a_walk_along_the_boundary_ends_at_a_gap() {
        let triangle = mesh(&[&[2, 3, 0], &[3, 1, 0], &[1, 2, 0]]);
        check(&Walk::from(&triangle, v(2), v(1)), "v2 v1 v3 v2", "closed orbit: a face of 3 corners");
        let outer = Walk::from(&triangle, v(1), v(2));
        check(&outer, "v1 v2", "nextto v1 in v2 is a gap: the walk ends at the boundary");
        assert_eq!(face_left_of(&triangle, [v(2), v(1)]), None);
    }

    #[test]
    fn a_walk_breaks_where_a_neighbour_does_not_answer() {
        let torn = mesh(&[&[2, 3, 4], &[1, 4, 3], &[1, 2, 4], &[3, 2]]); // v4 does not name v1
        let walk = Walk::through(&torn, v(1), v(4));
        check(&walk, "v1 v2 v4 v3 v1 v4", "broken orbit: v4 does not name v1, so nothing is nextto v1 in v4");
        assert!(walk.is_broken());
        check(&Walk::from(&torn, v(4), v(1)), "v4 v1", "there is no way from v4 to v1: v4 does not name it");
    }

    #[test]
    fn a_walk_breaks_at_a_vertex_outside_the_set() {
        let mut mesh = tetrahedron();
        mesh.set.remove(v(4));
        check(&Walk::from(&mesh, v(1), v(2)), "v1 v2 v4", "broken orbit: v4 is not in the set");
    }
}
