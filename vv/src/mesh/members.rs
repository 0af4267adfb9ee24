//! Membership in a set, asked often.

use super::{Vertex, VertexSet};

/// Which vertices of the universe are in a set.
pub(super) enum Members {
    /// All from one on, so many: from the first of all what closing a step leaves, else what a rule leaves that puts new
    /// vertices in the place of the old.
    From(u32, u32),
    /// Those whose flag is set.
    Some(Vec<bool>),
}

impl Members {
    /// Of a universe of `n` vertices. Cost: nothing where the set is the end of the universe in order of creation, else a
    /// pass over the set.
    pub(super) fn new(set: &VertexSet, n: usize) -> Self {
        if let Some(first) = set.is_all_from(n) {
            return Self::From(first as u32 + 1, (n - first) as u32);
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
            Self::From(first, len) => v.0.get().wrapping_sub(*first) < *len,
            Self::Some(flags) => flags.get(v.index()).is_some_and(|&flag| flag),
        }
    }
}
