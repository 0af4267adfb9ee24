//! Vertex sets: the members in the order in which they were added.

use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::Vertex;

/// A set of vertices, iterated in the order in which they were added. A clone shares its members until one is edited.
///
/// A set whose members were added in order of creation, as almost all are, is one ascending array and nothing else:
/// adding is a push, asking a binary search. Other sets keep the place of each member beside the array.
#[derive(Debug, Clone, Default)]
pub struct VertexSet(Arc<Members>);

#[derive(Debug, Clone, Default)]
struct Members {
    /// In order of addition; `None` where a member was removed (only with `places`).
    order: Vec<Option<Vertex>>,
    /// Index into `order`; `None` while `order` is ascending and without holes.
    places: Option<FxHashMap<Vertex, u32>>,
}

impl VertexSet {
    /// The first `n` vertices of a universe, in order.
    pub(super) fn first(n: usize) -> Self {
        let order = (0..n).map(Vertex::from_index).collect();
        Self(Arc::new(Members { order, places: None }))
    }

    /// How many members.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.places.as_ref().map_or(self.0.order.len(), FxHashMap::len)
    }

    /// Whether it has no member.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.0.order.capacity() * 4 + self.0.places.as_ref().map_or(0, |p| p.capacity() * 9)
    }

    /// The same for two sets that share their members, and different for two that hold memory of their own.
    pub(crate) fn identity(&self) -> usize {
        Arc::as_ptr(&self.0) as usize
    }

    /// `is v in S`: O(1) or a binary search.
    #[must_use]
    pub fn contains(&self, v: Vertex) -> bool {
        self.0.contains(v)
    }

    /// Where these are the vertices of a universe of `n` from one on, added in order of creation: the index of that; `None`
    /// says nothing. O(1).
    pub(super) fn is_all_from(&self, n: usize) -> Option<usize> {
        match self.span() {
            Some((first, last)) => (last.index() + 1 == n).then_some(first.index()),
            None => self.is_empty().then_some(n),
        }
    }

    /// The members in order of addition as they lie in memory, `None` where one was removed.
    pub(crate) fn order(&self) -> &[Option<Vertex>] {
        &self.0.order
    }

    /// The first and the last member of a set that is all vertices between them, in order; `None` for another set or an
    /// empty one.
    pub(crate) fn span(&self) -> Option<(Vertex, Vertex)> {
        let (Some(&Some(first)), Some(&Some(last))) = (self.0.order.first(), self.0.order.last()) else { return None };
        let all = self.0.places.is_none() && last.index() - first.index() + 1 == self.0.order.len();
        all.then_some((first, last))
    }

    /// The members that `rename` keeps by their new names, which are in the order of the old.
    pub(super) fn renamed(&self, rename: impl Fn(Vertex) -> Option<Vertex>) -> Self {
        let order: Vec<_> = self.iter().filter_map(rename).map(Some).collect();
        let mut members = Members { order, places: None };
        if self.0.places.is_some() {
            members.index();
        }
        Self(Arc::new(members))
    }

    /// The members of a set that is one ascending array and not shared: a larger vertex may be pushed.
    pub(crate) fn ascending(&mut self) -> Option<&mut Vec<Option<Vertex>>> {
        let members = Arc::get_mut(&mut self.0)?;
        members.places.is_none().then_some(&mut members.order)
    }

    /// The members in order of addition.
    pub fn iter(&self) -> impl Iterator<Item = Vertex> {
        self.0.order.iter().copied().flatten()
    }

    /// `add v to S` (Table 1): whether it was new; a member keeps its place.
    pub fn add(&mut self, v: Vertex) -> bool {
        if self.contains(v) {
            return false;
        }
        let members = Arc::make_mut(&mut self.0);
        if members.places.is_none() && members.order.last().is_some_and(|&last| last > Some(v)) {
            members.index();
        }
        if let Some(places) = &mut members.places {
            places.insert(v, members.order.len() as u32);
        }
        members.order.push(Some(v));
        true
    }

    /// `remove v from S` (Table 1): whether it was a member. Amortised O(1).
    pub fn remove(&mut self, v: Vertex) -> bool {
        if !self.contains(v) {
            return false;
        }
        let members = Arc::make_mut(&mut self.0);
        if members.order.last() == Some(&Some(v)) {
            members.order.pop();
            if let Some(places) = &mut members.places {
                places.remove(&v);
            }
            return true;
        }
        members.index();
        if let Some(places) = &mut members.places
            && let Some(i) = places.remove(&v)
        {
            members.order[i as usize] = None;
            if members.order.len() > 2 * places.len() + 16 {
                members.order.retain(Option::is_some);
                members.places = None;
                if !members.order.is_sorted() {
                    members.index();
                }
            }
        }
        true
    }

    /// `merge S with T` (Table 1): adds the members of `other` that are missing, in its order.
    pub fn merge(&mut self, other: &Self) {
        if self.is_empty() {
            self.clone_from(other);
            return;
        }
        let behind = self.0.order.last() < other.0.order.first();
        if behind && self.0.places.is_none() && other.0.places.is_none() {
            match Arc::get_mut(&mut self.0) {
                Some(members) => members.order.extend_from_slice(&other.0.order),
                None => {
                    let order = [self.order(), other.order()].concat();
                    self.0 = Arc::new(Members { order, places: None });
                }
            }
            return;
        }
        for v in other.iter() {
            self.add(v);
        }
    }
}

impl Members {
    fn contains(&self, v: Vertex) -> bool {
        match &self.places {
            Some(places) => places.contains_key(&v),
            None if self.order.last() < Some(&Some(v)) => false,
            None => self.order.binary_search(&Some(v)).is_ok(),
        }
    }

    fn index(&mut self) {
        if self.places.is_none() {
            let places = self.order.iter().enumerate().filter_map(|(i, v)| v.map(|v| (v, i as u32)));
            self.places = Some(places.collect());
        }
    }
}

impl FromIterator<Vertex> for VertexSet {
    fn from_iter<I: IntoIterator<Item = Vertex>>(vertices: I) -> Self {
        let mut set = Self::default();
        for v in vertices {
            set.add(v);
        }
        set
    }
}

/// The same members in the same order.
impl PartialEq for VertexSet {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs `+3 -1 …` on an empty set and shows what is left.
    #[track_caller]
    fn check(edits: &str, expected: &str) {
        let mut set = VertexSet::default();
        for edit in edits.split(' ') {
            let v = Vertex::from_index(edit[1..].parse().unwrap()).unwrap();
            if edit.starts_with('+') {
                set.add(v)
            } else {
                set.remove(v)
            };
        }
        let got = set.iter().map(|v| v.index().to_string()).collect::<Vec<_>>().join(" ");
        assert_eq!(got, expected);
        assert_eq!(set.len(), set.iter().count());
        assert!((0..9).all(|i| {
            let v = Vertex::from_index(i).unwrap();
            set.contains(v) == set.iter().any(|w| w == v)
        }));
    }

    #[test]
    fn members_keep_the_order_of_addition() {
        check("+1 +2 +3", "1 2 3");
        check("+3 +1 +2", "3 1 2");
        check("+3 +1 +3 +2", "3 1 2");
        check("+1 +2 +3 -2 +2", "1 3 2");
        check("+1 +2 +3 -3 +2", "1 2");
        check("+1 -1 -1", "");
    }
}
