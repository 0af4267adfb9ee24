//! Membership in a set, asked often.

use super::{Vertex, VertexSet};

/// Which vertices of the universe are in a set.
pub(super) enum Members {
    /// All of these, which is what closing a step leaves.
    All(usize),
    /// Those whose flag is set.
    Some(Vec<bool>),
}

impl Members {
    /// Of a universe of `n` vertices. Cost: nothing where the set is the universe in order of creation, else a pass over the set.
    pub(super) fn new(set: &VertexSet, n: usize) -> Self {
        if set.is_all_of(n) {
            return Self::All(n);
        }
        let mut flags = vec![false; n];
        for v in set.iter() {
            if let Some(flag) = flags.get_mut(v.index()) {
                *flag = true;
            }
        }
        Self::Some(flags)
    }

    /// Whether `v` is a vertex of the universe and in the set.
    pub(super) fn contains(&self, v: Vertex) -> bool {
        match self {
            Self::All(n) => v.index() < *n,
            Self::Some(flags) => flags.get(v.index()).is_some_and(|&flag| flag),
        }
    }
}
