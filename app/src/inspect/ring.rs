//! The ring of a vertex, as it is shown.

use std::fmt;

use vv::mesh::{Mesh, Vertex};

/// Entries that are shown of a long ring.
pub const SHOWN: usize = 120;

/// The ring of a vertex, from its start, counter-clockwise seen from outside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ring {
    /// Whose it is.
    pub of: Vertex,
    /// Its first entries.
    pub entries: Vec<Entry>,
    /// How many entries it has, gaps included.
    pub len: usize,
}

/// What stands in a ring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Entry {
    /// A gap: the surface is missing there.
    Gap,
    /// A neighbour.
    Vertex {
        /// Which.
        vertex: Vertex,
        /// Whether it names the owner of the ring, too; if not it is an *incomplete* neighbour.
        answers: bool,
        /// Whether it is in the set.
        member: bool,
    },
}

impl Ring {
    /// Cost: its length times the lengths of the rings of its neighbours, of which [`SHOWN`] are looked at.
    #[must_use]
    pub fn of(mesh: &Mesh, v: Vertex) -> Self {
        let slots = mesh.ring(v).slots();
        let entry = |slot: &Option<Vertex>| match *slot {
            None => Entry::Gap,
            Some(vertex) => Entry::Vertex {
                vertex,
                answers: mesh.ring(vertex).contains(Some(v)),
                member: mesh.set.contains(vertex),
            },
        };
        Self { of: v, entries: slots.iter().take(SHOWN).map(entry).collect(), len: slots.len() }
    }

    /// The neighbours that are shown.
    pub fn vertices(&self) -> impl Iterator<Item = Vertex> + '_ {
        self.entries.iter().filter_map(|entry| entry.vertex())
    }
}

impl Entry {
    /// The neighbour, if it is one.
    #[must_use]
    pub fn vertex(self) -> Option<Vertex> {
        match self {
            Self::Gap => None,
            Self::Vertex { vertex, .. } => Some(vertex),
        }
    }

    /// Why it is no good neighbour, if so.
    #[must_use]
    pub fn fault(self, of: Vertex) -> Option<String> {
        match self {
            Self::Vertex { vertex, member: false, .. } => Some(format!("{vertex} is not in the set")),
            Self::Vertex { vertex, answers: false, .. } => Some(format!("{vertex} does not name {of}")),
            _ => None,
        }
    }
}

/// `v7: {v3, v9, _, v12}`; `!` after a neighbour that is incomplete or outside the set.
impl fmt::Display for Ring {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {{", self.of)?;
        for (i, &entry) in self.entries.iter().enumerate() {
            f.write_str(if i > 0 { ", " } else { "" })?;
            match entry {
                Entry::Gap => f.write_str("_")?,
                Entry::Vertex { vertex, .. } => write!(f, "{vertex}")?,
            }
            f.write_str(if entry.fault(self.of).is_some() { "!" } else { "" })?;
        }
        if self.entries.len() < self.len {
            write!(f, ", … {} more", self.len - self.entries.len())?;
        }
        f.write_str("}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn v(number: usize) -> Vertex {
        Vertex::from_index(number - 1).unwrap()
    }

    #[test]
    fn a_ring_reads_as_it_is_written() {
        let mut mesh = Mesh::new();
        for _ in 0..5 {
            let v = mesh.create().unwrap();
            mesh.set.add(v);
        }
        mesh.make(v(1), &[Some(v(2)), Some(v(3)), None, Some(v(4)), Some(v(5)), None]).unwrap();
        for q in [2, 3] {
            mesh.make(v(q), &[Some(v(1))]).unwrap();
        }
        mesh.set.remove(v(5));
        let ring = Ring::of(&mesh, v(1));
        assert_eq!(ring.to_string(), "v1: {v2, v3, _, v4!, v5!, _}");
        let faults: Vec<String> = ring.entries.iter().filter_map(|e| e.fault(v(1))).collect();
        assert_eq!(faults, ["v4 does not name v1", "v5 is not in the set"]);
        assert_eq!(Ring::of(&mesh, v(4)).to_string(), "v4: {}");
    }

    #[test]
    fn of_a_long_ring_the_beginning_is_shown() {
        let mut mesh = Mesh::new();
        let all: Vec<Vertex> = (0..1000).map(|_| mesh.create().unwrap()).collect();
        all.iter().for_each(|&v| _ = mesh.set.add(v));
        let items: Vec<_> = all[1..].iter().copied().map(Some).collect();
        mesh.make(all[0], &items).unwrap();
        let ring = Ring::of(&mesh, all[0]);
        assert_eq!((ring.entries.len(), ring.len), (SHOWN, 999));
        assert!(ring.to_string().ends_with(", … 879 more}"));
    }
}
