//! Rings in one arena: each a run of slots with room to grow, edited in place.

use std::num::NonZeroU32;

use rustc_hash::FxHashSet;

use super::{Column, Full, Property, Value, Vertex};

/// Room a ring gets when it is first written: six neighbours is what most triangle meshes settle at.
pub(crate) const FRESH_CAPACITY: u32 = 6;

/// Room behind the last slot that makers of large arenas leave: machine code reads that far, though it means nothing.
pub(crate) const PADDING: usize = 24;

/// Above this many items a duplicate is looked for by hashing rather than by comparing all pairs.
const PAIRWISE_LIMIT: usize = 32;

/// Why an edit of a ring was refused. The ring is then as it was.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// Note 3 and 5 of Table 2: a vertex may not be its own neighbour.
    #[error("{0} cannot be its own neighbour")]
    OwnNeighbour(Vertex),
    /// Note 3 and 5 of Table 2: a vertex may stand in a ring once.
    #[error("{0} stands in the ring already")]
    Twice(Vertex),
    /// The arena is full.
    #[error(transparent)]
    Full(#[from] Full),
}

/// The neighbours of a vertex, a cyclic list that has a start; `None` is a gap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ring<'a>(&'a [Option<Vertex>]);

impl<'a> Ring<'a> {
    /// A list that is no vertex' ring, without gaps. A vertex may stand in it more than once; the first is found.
    pub(crate) fn new(list: &'a [Option<Vertex>]) -> Self {
        Self(list)
    }

    /// The list itself, gaps included, from its start.
    #[must_use]
    pub fn slots(self) -> &'a [Option<Vertex>] {
        self.0
    }

    /// The neighbours from the start, without gaps.
    pub fn vertices(self) -> impl Iterator<Item = Vertex> + use<'a> {
        self.0.iter().copied().flatten()
    }

    /// `any in v`: the neighbour at the start, `None` for an empty ring (Table 2, note 1).
    #[must_use]
    pub fn any(self) -> Option<Vertex> {
        self.0.first().copied().flatten()
    }

    /// `is x in v`; `None` asks for a gap.
    #[must_use]
    pub fn contains(self, x: Option<Vertex>) -> bool {
        self.find(x).is_some()
    }

    /// Index of `x`, of the first gap for `None`.
    #[must_use]
    pub fn find(self, x: Option<Vertex>) -> Option<usize> {
        match x {
            // Rings with gaps end in the first one.
            None => self.0.last()?.is_none().then(|| self.0.len() - 1),
            Some(_) => self.0.iter().position(|&y| y == x),
        }
    }

    /// `nextto x in v`: what follows `x` counter-clockwise: outer `None` if `x` is not there (Table 2, note 2), inner
    /// `None` if a gap follows.
    #[must_use]
    pub fn next(self, x: Option<Vertex>) -> Option<Option<Vertex>> {
        let i = self.find(x)?;
        Some(self.0[if i + 1 == self.0.len() { 0 } else { i + 1 }])
    }

    /// `prevto x in v`: what precedes `x`, as [`Ring::next`].
    #[must_use]
    pub fn previous(self, x: Option<Vertex>) -> Option<Option<Vertex>> {
        let i = self.find(x)?;
        Some(self.0[if i == 0 { self.0.len() - 1 } else { i - 1 }])
    }

    /// `valence v`: how many neighbours, gaps not counted.
    #[must_use]
    pub fn valence(self) -> usize {
        self.0.len() - self.gaps()
    }

    /// `gaps v`: how many gaps.
    #[must_use]
    pub fn gaps(self) -> usize {
        match self.0.last() {
            Some(None) => self.0.iter().filter(|x| x.is_none()).count(),
            _ => 0,
        }
    }
}

/// Where a splice puts its vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    After,
    Before,
}

/// Where a ring lies in the arena, how long it is, and how long it may grow there.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Head {
    pub(crate) offset: u32,
    pub(crate) len: u32,
    pub(crate) capacity: u32,
}

impl Head {
    pub(crate) fn range(self) -> std::ops::Range<usize> {
        self.offset as usize..self.offset as usize + self.len as usize
    }
}

/// All rings of a universe, and the edge properties, whose columns lie parallel to the slots.
#[derive(Debug, Clone, Default)]
pub(super) struct Rings {
    heads: Column<Head>,
    slots: Column<Option<Vertex>>,
    pub(super) properties: Vec<Property>,
}

impl Rings {
    pub(super) fn len(&self) -> usize {
        self.heads.len()
    }

    pub(super) fn slot_count(&self) -> usize {
        self.slots.len()
    }

    pub(super) fn heads(&self) -> &[Head] {
        &self.heads
    }

    pub(super) fn slots(&self) -> &[Option<Vertex>] {
        &self.slots
    }

    pub(super) fn arrays(&mut self) -> (&mut Column<Head>, &mut Column<Option<Vertex>>, &mut [Property]) {
        (&mut self.heads, &mut self.slots, &mut self.properties)
    }

    pub(super) fn bytes(&self) -> usize {
        self.heads.bytes() + self.slots.bytes() + self.properties.iter().map(|p| p.values.bytes()).sum::<usize>()
    }

    /// Empty rings with room for so many slots each.
    pub(super) fn with_room(lens: &[u32]) -> Result<Self, Full> {
        let mut heads = Vec::with_capacity(lens.len());
        let mut end = 0_u32;
        for &capacity in lens {
            heads.push(Head { offset: end, len: 0, capacity });
            end = end.checked_add(capacity).ok_or(Full)?;
        }
        let mut slots = Vec::with_capacity(end as usize + PADDING);
        slots.resize(end as usize, None);
        Ok(Self { heads: heads.into(), slots: slots.into(), properties: Vec::new() })
    }

    pub(super) fn create(&mut self) -> Result<Vertex, Full> {
        let v = Vertex::from_index(self.heads.len()).ok_or(Full)?;
        self.heads.edit().push(Head::default());
        Ok(v)
    }

    fn head(&self, v: Vertex) -> Head {
        self.heads.get(v.index()).copied().unwrap_or_default()
    }

    pub(super) fn ring(&self, v: Vertex) -> Ring<'_> {
        Ring(self.slots.get(self.head(v).range()).unwrap_or(&[]))
    }

    pub(super) fn make(&mut self, v: Vertex, items: &[Option<Vertex>]) -> Result<(), EditError> {
        if let Some(twice) = first_duplicate(items) {
            return Err(EditError::Twice(twice));
        }
        if items.contains(&Some(v)) {
            return Err(EditError::OwnNeighbour(v));
        }
        let mut kept: Vec<(Vertex, Vec<Value>)> = if self.properties.is_empty() {
            Vec::new()
        } else {
            let values = |i| self.properties.iter().filter_map(|p| p.values.get(i)).collect();
            self.head(v).range().filter_map(|i| Some((self.slots[i]?, values(i)))).collect()
        };
        kept.sort_unstable_by_key(|&(x, _)| x);
        self.reserve(v, items.len(), 0)?;
        self.set_len(v, items.len());
        let range = self.head(v).range();
        self.slots.edit()[range.clone()].copy_from_slice(items);
        for (k, property) in self.properties.iter_mut().enumerate() {
            for i in range.clone() {
                let old = self.slots[i].and_then(|x| kept.binary_search_by_key(&x, |&(y, _)| y).ok());
                let value = old.and_then(|j| kept[j].1.get(k).copied());
                property.values.set(i, value.unwrap_or(property.default));
            }
        }
        self.settle_gaps(v);
        Ok(())
    }

    pub(super) fn erase(&mut self, x: Option<Vertex>, v: Vertex) {
        if let Some(i) = self.ring(v).find(x) {
            self.remove_slot(v, i);
            self.settle_gaps(v);
        }
    }

    pub(super) fn replace(&mut self, a: Option<Vertex>, x: Option<Vertex>, v: Vertex) -> Result<(), EditError> {
        let Some(i) = self.ring(v).find(a) else { return Ok(()) };
        if a == x {
            return Ok(());
        }
        self.may_enter(x, v)?;
        let at = self.head(v).range().start + i;
        self.slots.edit()[at] = x;
        if a.is_none() || x.is_none() {
            for property in &mut self.properties {
                property.values.set(at, property.default); // a gap has no edge, a new edge no history
            }
            self.settle_gaps(v);
        }
        Ok(())
    }

    pub(super) fn splice(
        &mut self,
        x: Option<Vertex>,
        a: Option<Vertex>,
        v: Vertex,
        side: Side,
    ) -> Result<(), EditError> {
        let Some(i) = self.ring(v).find(a) else { return Ok(()) };
        self.may_enter(x, v)?;
        let len = self.head(v).len as usize;
        let at = match side {
            Side::After => i + 1,
            Side::Before if i == 0 => len,
            Side::Before => i,
        };
        self.reserve(v, len + 1, len)?;
        self.set_len(v, len + 1);
        let range = self.head(v).range();
        let slots = &mut self.slots.edit()[range.clone()];
        slots.copy_within(at..len, at + 1);
        slots[at] = x;
        for property in &mut self.properties {
            shift_right(&mut property.values, range.start + at..range.end, property.default);
        }
        self.settle_gaps(v);
        Ok(())
    }

    pub(super) fn edge_value(&self, property: usize, p: Vertex, q: Vertex) -> Option<Value> {
        let values = &self.properties.get(property)?.values;
        let (older, younger) = if p < q { (p, q) } else { (q, p) };
        let slot = self.slot(older, younger).or_else(|| self.slot(younger, older))?;
        values.get(slot)
    }

    pub(super) fn set_edge_value(&mut self, property: usize, p: Vertex, q: Vertex, value: Value) -> bool {
        let slots = [self.slot(p, q), self.slot(q, p)];
        let Some(property) = self.properties.get_mut(property) else { return false };
        for slot in slots.into_iter().flatten() {
            property.values.set(slot, value);
        }
        slots.iter().any(Option::is_some)
    }

    pub(super) fn copy_from(&mut self, other: &Self, v: Vertex) -> Result<(), Full> {
        let from = other.head(v).range();
        self.reserve(v, from.len(), 0)?;
        self.set_len(v, from.len());
        let to = self.head(v).range();
        self.slots.edit()[to.clone()].copy_from_slice(&other.slots[from.clone()]);
        for (mine, theirs) in self.properties.iter_mut().zip(&other.properties) {
            for (i, j) in to.clone().zip(from.clone()) {
                if let Some(value) = theirs.values.get(j) {
                    mine.values.set(i, value);
                }
            }
        }
        Ok(())
    }

    /// The rings of the vertices that `rename` keeps, tightly laid out; entries it does not keep become gaps.
    pub(super) fn keep(&self, rename: impl Fn(Vertex) -> Option<Vertex>) -> Self {
        let is_kept = |i: usize| Vertex::from_index(i).is_some_and(|v| rename(v).is_some());
        let kept = || self.heads.iter().enumerate().filter(|&(i, _)| is_kept(i)).map(|(_, head)| head);
        let (count, room) = kept().fold((0, 0), |(count, room), head| (count + 1, room + head.len as usize));
        let mut heads = Vec::with_capacity(count);
        let mut slots = Vec::with_capacity(room);
        let mut open = Vec::new(); // those with gaps
        for head in kept() {
            let offset = slots.len();
            slots.extend(self.slots[head.range()].iter().map(|x| x.and_then(&rename)));
            if slots[offset..].contains(&None) {
                open.extend(Vertex::from_index(heads.len()));
            }
            heads.push(Head { offset: offset as u32, len: head.len, capacity: head.len });
        }
        let properties = self
            .properties
            .iter()
            .map(|p| {
                let mut values = super::Values::filled(p.default, room);
                for (i, j) in kept().flat_map(|head| head.range()).enumerate() {
                    values.set(i, p.values.get(j).unwrap_or(p.default));
                }
                Property { name: p.name.clone(), default: p.default, values }
            })
            .collect();
        let mut rings = Self { heads: heads.into(), slots: slots.into(), properties };
        open.into_iter().for_each(|v| rings.settle_gaps(v));
        rings
    }

    /// As [`Rings::keep`] for all vertices from one on, where they lie.
    pub(super) fn keep_from(&mut self, first: usize) {
        self.heads.drop_first(first);
        let offset = |head: &Head| if head.capacity > 0 { head.offset } else { u32::MAX };
        let start = self.heads.iter().fold(self.slots.len() as u32, |start, head| start.min(offset(head)));
        for head in self.heads.edit() {
            head.offset = head.offset.saturating_sub(start);
        }
        self.slots.drop_first(start as usize);
        for property in &mut self.properties {
            property.values.drop_first(start as usize);
        }
        let mut lost = 0;
        for slot in self.slots.edit() {
            let number = slot.map_or(0, |v| v.0.get());
            let new = number.saturating_sub(first as u32);
            lost |= if new == 0 { number } else { 0 };
            *slot = NonZeroU32::new(new).map(Vertex);
        }
        if lost != 0 {
            (0..self.len()).filter_map(Vertex::from_index).for_each(|v| self.settle_gaps(v));
        }
    }

    /// Lays the arena out anew if more than half of it is room that no ring uses; rings use so many slots.
    pub(super) fn tidy(&mut self, used: usize) {
        if self.slots.len() > 2 * used + 64 {
            *self = self.keep(Some);
        }
    }

    fn slot(&self, v: Vertex, x: Vertex) -> Option<usize> {
        Some(self.head(v).range().start + self.ring(v).find(Some(x))?)
    }

    fn may_enter(&self, x: Option<Vertex>, v: Vertex) -> Result<(), EditError> {
        match x {
            Some(x) if x == v => Err(EditError::OwnNeighbour(v)),
            Some(x) if self.ring(v).contains(Some(x)) => Err(EditError::Twice(x)),
            _ => Ok(()),
        }
    }

    /// Makes room for `len` slots; a ring that must move takes its first `keep` slots along.
    fn reserve(&mut self, v: Vertex, len: usize, keep: usize) -> Result<(), Full> {
        let head = self.head(v);
        if len <= head.capacity as usize {
            return Ok(());
        }
        let offset = u32::try_from(self.slots.len()).map_err(|_| Full)?;
        let capacity = u32::try_from(len).map_err(|_| Full)?.max(FRESH_CAPACITY).max(head.capacity.saturating_mul(2));
        offset.checked_add(capacity).ok_or(Full)?;
        let end = (offset + capacity) as usize;
        let old = head.offset as usize..head.offset as usize + keep;
        let slots = self.slots.edit();
        slots.resize(end, None);
        slots.copy_within(old.clone(), offset as usize);
        for property in &mut self.properties {
            property.values.resize(end, property.default);
            for i in 0..keep {
                if let Some(value) = property.values.get(old.start + i) {
                    property.values.set(offset as usize + i, value);
                }
            }
        }
        if let Some(h) = self.heads.edit().get_mut(v.index()) {
            *h = Head { offset, capacity, ..head };
        }
        Ok(())
    }

    fn set_len(&mut self, v: Vertex, len: usize) {
        if let Some(head) = self.heads.edit().get_mut(v.index()) {
            head.len = len as u32;
        }
    }

    fn remove_slot(&mut self, v: Vertex, i: usize) {
        let range = self.head(v).range();
        let slots = &mut self.slots.edit()[range.clone()];
        slots.copy_within(i + 1.., i);
        for property in &mut self.properties {
            for j in range.start + i..range.end - 1 {
                if let Some(value) = property.values.get(j + 1) {
                    property.values.set(j, value);
                }
            }
        }
        self.set_len(v, range.len() - 1);
    }

    /// Puts what stands in one slot of the arena, with its edge values, into another.
    fn move_slot(&mut self, from: usize, to: usize) {
        let slots = self.slots.edit();
        slots[to] = slots[from];
        for property in &mut self.properties {
            if let Some(value) = property.values.get(from) {
                property.values.set(to, value);
            }
        }
    }

    /// Restores the invariants of gaps: none beside another, none alone, the first at the end.
    fn settle_gaps(&mut self, v: Vertex) {
        let range = self.head(v).range();
        if !self.slots[range.clone()].contains(&None) {
            return;
        }
        // In one pass: a hub may lose all its neighbours at once.
        let first = range.start + 1;
        let mut end = first; // of what stays
        for i in first..range.end {
            if self.slots[i].is_some() || self.slots[end - 1].is_some() {
                if end < i {
                    self.move_slot(i, end);
                }
                end += 1;
            }
        }
        self.set_len(v, end - range.start);
        let slots = &self.slots[self.head(v).range()];
        match slots {
            [None] => self.set_len(v, 0),
            [None, .., None] => self.remove_slot(v, 0),
            [.., None] => {}
            _ => {
                let first = slots.iter().position(Option::is_none).map_or(0, |i| i + 1);
                let range = self.head(v).range();
                self.slots.edit()[range.clone()].rotate_left(first);
                for property in &mut self.properties {
                    let values: Vec<_> = range.clone().filter_map(|i| property.values.get(i)).collect();
                    for (k, i) in range.clone().enumerate() {
                        property.values.set(i, values[(k + first) % values.len()]);
                    }
                }
            }
        }
    }
}

fn shift_right(values: &mut super::Values, range: std::ops::Range<usize>, first: Value) {
    for i in range.clone().skip(1).rev() {
        if let Some(value) = values.get(i - 1) {
            values.set(i, value);
        }
    }
    values.set(range.start, first);
}

fn first_duplicate(items: &[Option<Vertex>]) -> Option<Vertex> {
    if items.len() <= PAIRWISE_LIMIT {
        return (1..items.len()).find(|&i| items[i].is_some() && items[..i].contains(&items[i])).and_then(|i| items[i]);
    }
    let mut seen = FxHashSet::default();
    items.iter().copied().flatten().find(|&x| !seen.insert(x))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `a b c` for vertices, `-` for a gap.
    fn parse(text: &str) -> Vec<Option<Vertex>> {
        text.split_whitespace()
            .map(|w| if w == "-" { None } else { Vertex::from_index((w.as_bytes()[0] - b'a') as usize) })
            .collect()
    }

    fn show(ring: Ring<'_>) -> String {
        let word = |x: &Option<Vertex>| x.map_or("-".to_owned(), |x| ((b'a' + x.index() as u8) as char).to_string());
        ring.slots().iter().map(word).collect::<Vec<_>>().join(" ")
    }

    /// Makes a ring at vertex `z`, edits it with `op item anchor`, and compares.
    #[track_caller]
    fn check(ring: &str, edit: &str, expected: &str) {
        let mut rings = Rings::default();
        for _ in 0..26 {
            rings.create().unwrap();
        }
        let z = parse("z")[0].unwrap();
        rings.make(z, &parse(ring)).unwrap();
        let items = parse(edit.split_once(' ').map_or("", |e| e.1));
        let result = match edit.split(' ').next().unwrap() {
            "erase" => {
                rings.erase(items[0], z);
                Ok(())
            }
            "replace" => rings.replace(items[0], items[1], z),
            "after" => rings.splice(items[0], items[1], z, Side::After),
            "before" => rings.splice(items[0], items[1], z, Side::Before),
            _ => Ok(()),
        };
        let got = match result {
            Ok(()) => show(rings.ring(z)),
            Err(e) => e.to_string(),
        };
        assert_eq!(got, expected, "{ring} | {edit}");
    }

    #[test]
    fn figures_d_to_g_of_table_2() {
        check("a b c d e f", "erase a", "b c d e f");
        check("a b c d e f", "replace b x", "a x c d e f");
        check("a b c d e f", "after x a", "a x b c d e f");
        check("a b c d e f", "before x a", "a b c d e f x"); // before the start is at the end
        check("a b c d e f", "before x c", "a b x c d e f");
        check("a b c d e f", "after x f", "a b c d e f x");
    }

    #[test]
    fn notes_4_and_5() {
        check("a b", "erase c", "a b");
        check("a b", "replace c d", "a b");
        check("a b", "after c d", "a b");
        check("a b", "replace a z", "v26 cannot be its own neighbour");
        check("a b", "after z a", "v26 cannot be its own neighbour");
        check("a b", "replace a b", "v2 stands in the ring already");
        check("a b", "before b a", "v2 stands in the ring already");
        check("a b", "replace a a", "a b");
    }

    #[test]
    fn gaps_settle_at_the_end() {
        check("a - b c", "", "b c a -");
        check("- a b c", "", "a b c -");
        check("a - - b", "", "b a -");
        check("- a -", "", "a -");
        check("-", "", "");
        check("- -", "", "");
        check("a b c", "after - a", "b c a -");
        check("a b c -", "erase -", "a b c");
        check("a b c -", "replace b -", "a - c -");
        check("a b c", "replace c -", "a b -");
        check("a b c -", "replace - d", "a b c d");
        check("a b c -", "replace a -", "b c -");
        check("a -", "erase a", "");
        check("p - q -", "erase p", "q -");
        check("p - q -", "erase -", "q p -");
        check("a b -", "after - b", "a b -");
        check("a b -", "before - a", "a b -");
        check("a b -", "after x -", "x a b -");
        check("a b -", "before x a", "x a b -");
        check("a b -", "before x -", "a b x -");
    }
}
