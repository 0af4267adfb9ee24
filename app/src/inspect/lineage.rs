//! Which vertex of a generation was which of another, and the meshes of those generations that are kept.
//!
//! Closing a step forgets vertices and numbers the others anew ([`vv::mesh::close`]), in order of creation: so those that
//! were there before a step come first, in their old order.

use std::collections::BTreeMap;
use std::sync::{Arc, PoisonError, RwLock};

use vv::mesh::{Mesh, Vertex};

/// Which vertices of a generation were vertices of the one before.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Survivors {
    /// The first so many, under the same numbers.
    First(usize),
    /// The first of them, each with the number it had.
    Listed(Arc<[Vertex]>),
}

impl Default for Survivors {
    fn default() -> Self {
        Self::First(0)
    }
}

impl Survivors {
    /// Of a mesh whose step has ended but is not closed yet; before the step it had `before` vertices. Cost: linear in
    /// these, if any vertex is forgotten.
    #[must_use]
    pub fn of(mesh: &Mesh, before: usize) -> Self {
        if mesh.set.len() == mesh.vertex_count() {
            return Self::First(before);
        }
        let kept: Vec<Vertex> = mesh.vertices().take(before).filter(|&v| mesh.set.contains(v)).collect();
        if kept.len() == before { Self::First(before) } else { Self::Listed(kept.into()) }
    }

    /// What a vertex was called before; `None` if it was born since.
    fn before(&self, v: Vertex) -> Option<Vertex> {
        match self {
            Self::First(count) => (v.index() < *count).then_some(v),
            Self::Listed(kept) => kept.get(v.index()).copied(),
        }
    }

    /// What a vertex of before is called now; `None` if it is gone.
    fn after(&self, v: Vertex) -> Option<Vertex> {
        match self {
            Self::First(count) => (v.index() < *count).then_some(v),
            Self::Listed(kept) => kept.binary_search(&v).ok().and_then(Vertex::from_index),
        }
    }
}

/// The survivors of all generations of a recipe that were ever reached: they only become more, as every generation comes
/// out the same each time it is computed. Beside them the meshes to compare with. Clones share both.
#[derive(Debug, Clone, Default)]
pub struct Lineage(Arc<RwLock<Vec<Survivors>>>, Arc<RwLock<BTreeMap<u64, Mesh>>>);

impl Lineage {
    /// Tells of a generation; those before it were told of already, or it is left out.
    pub fn add(&self, generation: u64, survivors: &Survivors) {
        let mut all = self.0.write().unwrap_or_else(PoisonError::into_inner);
        if all.len() as u64 == generation {
            all.push(survivors.clone());
        }
    }

    /// Keeps the mesh of a generation.
    pub fn keep(&self, generation: u64, mesh: Mesh) {
        self.1.write().unwrap_or_else(PoisonError::into_inner).insert(generation, mesh);
    }

    /// Keeps it no longer.
    pub fn forget(&self, generation: u64) {
        self.1.write().unwrap_or_else(PoisonError::into_inner).remove(&generation);
    }

    /// The mesh of a generation, if it is kept.
    #[must_use]
    pub fn mesh(&self, generation: u64) -> Option<Mesh> {
        self.1.read().unwrap_or_else(PoisonError::into_inner).get(&generation).cloned()
    }

    /// The generation in which a vertex of `generation` was born. Cost: its age.
    #[must_use]
    pub fn birth(&self, v: Vertex, generation: u64) -> u64 {
        let all = self.0.read().unwrap_or_else(PoisonError::into_inner);
        let (mut v, mut born) = (v, generation);
        while born > 0
            && let Some(before) = all.get(born as usize).and_then(|survivors| survivors.before(v))
        {
            (v, born) = (before, born - 1);
        }
        born
    }

    /// What a vertex of generation `from` is called in generation `to`; `None` if it does not live there. Cost: the
    /// generations between.
    #[must_use]
    pub fn carry(&self, v: Vertex, from: u64, to: u64) -> Option<Vertex> {
        let all = self.0.read().unwrap_or_else(PoisonError::into_inner);
        if to < from {
            return (to + 1..=from).rev().try_fold(v, |v, g| all.get(g as usize)?.before(v));
        }
        (from + 1..=to).try_fold(v, |v, g| all.get(g as usize)?.after(v))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn v(number: usize) -> Vertex {
        Vertex::from_index(number - 1).unwrap()
    }

    /// Generation 1 keeps 3 vertices and makes more; generation 2 forgets v2 and v4.
    fn lineage() -> Lineage {
        let lineage = Lineage::default();
        let kept: Vec<Vertex> = [1, 3, 5].map(v).to_vec();
        for (g, survivors) in
            [Survivors::First(0), Survivors::First(3), Survivors::Listed(kept.into())].iter().enumerate()
        {
            lineage.add(g as u64, survivors);
        }
        lineage
    }

    #[test]
    fn a_vertex_is_followed_through_the_numbers_it_has() {
        let lineage = lineage();
        let check = |from: (u64, usize), to: u64, expected: Option<usize>| {
            assert_eq!(lineage.carry(v(from.1), from.0, to), expected.map(v), "{from:?} to {to}");
        };
        check((0, 3), 1, Some(3));
        check((0, 3), 2, Some(2));
        check((0, 2), 2, None);
        check((1, 5), 2, Some(3));
        check((2, 2), 0, Some(3));
        check((2, 3), 1, Some(5));
        check((2, 3), 0, None);
        check((2, 4), 2, Some(4));
        check((0, 1), 3, None);
    }

    #[test]
    fn a_vertex_knows_when_it_was_born() {
        let lineage = lineage();
        let born = |number, generation| lineage.birth(v(number), generation);
        assert_eq!([born(1, 2), born(2, 2), born(3, 2), born(4, 2), born(4, 1)], [0, 0, 1, 2, 1]);
    }

    #[test]
    fn a_generation_that_is_computed_again_changes_nothing() {
        let lineage = lineage();
        lineage.add(1, &Survivors::First(3));
        assert_eq!([lineage.carry(v(3), 0, 1), lineage.carry(v(1), 0, 3)], [Some(v(3)), None]);
    }
}
