//! What is selected: vertices, edges and faces, by vertices.

use std::fmt;

use vv::mesh::{Mesh, Vertex};

use super::lineage::Lineage;
use super::walk::face_left_of;

/// Things that can be selected at once.
pub const MOST: usize = 64;

/// Something of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Item {
    /// A vertex.
    Vertex(Vertex),
    /// An edge, the older end first.
    Edge([Vertex; 2]),
    /// The face on the left of an edge, which begins at its oldest corner.
    Face([Vertex; 2]),
}

impl Item {
    /// The vertices that it is known by.
    #[must_use]
    pub fn vertices(self) -> ([Vertex; 2], usize) {
        match self {
            Self::Vertex(v) => ([v, v], 1),
            Self::Edge(ends) | Self::Face(ends) => (ends, 2),
        }
    }

    /// All its corners, as far as the mesh has it.
    #[must_use]
    pub fn corners(self, mesh: &Mesh) -> Vec<Vertex> {
        match self {
            Self::Vertex(v) => vec![v],
            Self::Edge(ends) => ends.to_vec(),
            Self::Face(edge) => face_left_of(mesh, edge).unwrap_or_default(),
        }
    }

    /// Whether the mesh has it.
    #[must_use]
    pub fn is_in(self, mesh: &Mesh) -> bool {
        let has = |v: Vertex| mesh.set.contains(v);
        match self {
            Self::Vertex(v) => has(v),
            Self::Edge([p, q]) => {
                has(p) && has(q) && (mesh.ring(p).contains(Some(q)) || mesh.ring(q).contains(Some(p)))
            }
            Self::Face(edge) => edge.into_iter().all(has) && face_left_of(mesh, edge).is_some(),
        }
    }

    fn renamed(self, name: impl Fn(Vertex) -> Option<Vertex>) -> Option<Self> {
        Some(match self {
            Self::Vertex(v) => Self::Vertex(name(v)?),
            Self::Edge([p, q]) => Self::Edge([name(p)?, name(q)?]),
            Self::Face([p, q]) => Self::Face([name(p)?, name(q)?]),
        })
    }
}

/// `v7`, `edge v3–v9`, `face v1 v4 …`.
impl fmt::Display for Item {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vertex(v) => write!(f, "{v}"),
            Self::Edge([p, q]) => write!(f, "edge {p}–{q}"),
            Self::Face([p, q]) => write!(f, "face {p} {q} …"),
        }
    }
}

/// What is selected, in the order in which it was. Items are of the generation in which they were chosen; where else they
/// live, they are found by their vertices.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Selection {
    items: Vec<(u64, Item)>,
}

impl Selection {
    /// Nothing.
    pub fn clear(&mut self) {
        self.items.clear();
    }

    /// Whether it is nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// This alone.
    pub fn set(&mut self, item: Item, generation: u64) {
        self.items = vec![(generation, item)];
    }

    /// This too, or no more if it is; the oldest goes where there are too many.
    pub fn toggle(&mut self, item: Item, generation: u64, lineage: &Lineage) {
        let before = self.items.len();
        self.items.retain(|&(g, old)| carried(old, g, generation, lineage) != Some(item));
        if self.items.len() == before {
            self.items.push((generation, item));
        }
        if self.items.len() > MOST {
            self.items.remove(0);
        }
    }

    /// What of it a generation has, by the names it has there, and what it has not, by the names it had.
    #[must_use]
    pub fn shown(&self, mesh: &Mesh, generation: u64, lineage: &Lineage) -> (Vec<Item>, Vec<(u64, Item)>) {
        let (mut here, mut gone) = (Vec::new(), Vec::new());
        for &(g, item) in &self.items {
            match carried(item, g, generation, lineage).filter(|item| item.is_in(mesh)) {
                Some(item) => here.push(item),
                None => gone.push((g, item)),
            }
        }
        (here, gone)
    }
}

fn carried(item: Item, from: u64, to: u64, lineage: &Lineage) -> Option<Item> {
    if from == to {
        return Some(item);
    }
    item.renamed(|v| lineage.carry(v, from, to))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_too_many_things_the_oldest_goes() {
        let mut mesh = Mesh::new();
        let (mut selection, lineage) = (Selection::default(), Lineage::default());
        for _ in 0..MOST + 2 {
            let v = mesh.create().unwrap();
            mesh.set.add(v);
            selection.toggle(Item::Vertex(v), 0, &lineage);
        }
        let (shown, gone) = selection.shown(&mesh, 0, &lineage);
        assert_eq!((shown.len(), gone.len()), (MOST, 0));
        assert_eq!(Some(shown[0]), Vertex::from_index(2).map(Item::Vertex));
    }
}
