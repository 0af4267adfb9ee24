//! What is known of values where code stands: facts that hold from where they were learned to the end of the scope.

use std::collections::hash_map::Entry;

use cranelift_codegen::ir::{MemFlagsData, Value};
use rustc_hash::FxHashMap;

/// Where a ring lies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    /// Address of the first slot.
    pub(super) start: Value,
    /// Number of slots, i32.
    pub(super) len: Value,
    /// The kind of memory.
    pub(super) flags: MemFlagsData,
}

/// Where something stands in a ring.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    /// Address of the first slot, [`NOTHING`](crate::engine::native::context::NOTHING) if it is not there.
    pub(super) start: Value,
    /// Bytes of the ring, i64.
    pub(super) bytes: Value,
    /// Bytes from the start to the slot, i64.
    pub(super) at: Value,
    /// Addresses of the slot and of the ring's end, where they are at hand.
    pub(super) here: Option<(Value, Value)>,
    /// It is there.
    pub(super) certain: bool,
    /// The kind of memory.
    pub(super) flags: MemFlagsData,
}

/// What a fact is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Key {
    NotNull(Value),
    /// The same number in 64 bits.
    Wide(Value),
    /// Two vertices, the smaller value first.
    Differ(Value, Value),
    /// A vertex has an old value.
    Held(Value),
    Bounds {
        v: Value,
        old: bool,
    },
    Find {
        x: Value,
        v: Value,
        old: bool,
    },
    /// Where in the arena the ring of a vertex lies, wherever that is.
    Lies(Value),
    /// How many gaps a ring has.
    Gaps {
        v: Value,
        old: bool,
    },
    /// `x` stands in the ring of `v`.
    Stands {
        x: Value,
        v: Value,
    },
    /// What stands beside something in a ring, if it is not null.
    Beside(Value),
    /// A vertex or null when this was learned.
    Met(Value),
    /// Where a face, which begins at `start`, has this side.
    Side {
        p: Value,
        q: Value,
        start: Value,
    },
}

#[derive(Debug, Clone, Copy)]
pub(super) enum Fact {
    Holds,
    Bounds(Bounds),
    Found(Found),
    Lies {
        offset: Value,
        len: Value,
    },
    /// At a place beside `x`, which stands there if this is not null; both in the ring of `v`, bytes from its start.
    Beside {
        x: Value,
        v: Value,
        at: Value,
        place: Value,
    },
    /// An address.
    At(Value),
    Is(Value),
}

/// A vertex that was created here.
struct Fresh {
    v: Value,
    /// Length of the log when it was created.
    since: usize,
    /// The rings it may have been put into: it is in no other.
    rings: Vec<Value>,
    /// Its own ring was not made; what else edits rings changes no empty one.
    bare: bool,
}

#[derive(Default)]
pub(super) struct Known {
    /// Each with its place in the log.
    facts: FxHashMap<Key, (Fact, usize)>,
    /// Keys in the order in which they were learned.
    log: Vec<Key>,
    scopes: Vec<usize>,
    fresh: Vec<Fresh>,
}

impl Known {
    pub(super) fn enter(&mut self) {
        self.scopes.push(self.log.len());
    }

    pub(super) fn leave(&mut self) {
        let mark = self.scopes.pop().unwrap_or(0);
        for key in self.log.drain(mark..) {
            self.facts.remove(&key);
        }
        self.fresh.retain(|f| f.since < mark);
    }

    /// A fact that is known already stays, for it holds longer.
    pub(super) fn learn(&mut self, key: Key, fact: Fact) {
        if let Entry::Vacant(entry) = self.facts.entry(key) {
            entry.insert((fact, self.log.len()));
            self.log.push(key);
        }
    }

    pub(super) fn get(&self, key: Key) -> Option<Fact> {
        self.facts.get(&key).map(|&(fact, _)| fact)
    }

    pub(super) fn holds(&self, key: Key) -> bool {
        self.facts.contains_key(&key)
    }

    /// Rings, as they are or as they were, may have changed or moved.
    pub(super) fn forget_rings(&mut self, of_old: bool) {
        self.forget_rings_but(of_old, |_| false);
    }

    /// The ring of `v` may have changed, and the arena may have moved.
    pub(super) fn forget_ring(&mut self, v: Value) {
        let others: Vec<Value> = self.facts.iter().filter_map(|(key, (fact, _))| ring_of(key, fact)).collect();
        let others: Vec<Value> = others.into_iter().filter(|&w| self.differ(v, w)).collect();
        self.forget_rings_but(false, |w| others.contains(&w));
    }

    /// The arena may have moved.
    pub(super) fn forget_addresses(&mut self) {
        self.forget_rings_but(false, |_| true);
    }

    /// Rings may have changed, but for those of some vertices. The arena may have moved.
    fn forget_rings_but(&mut self, of_old: bool, stays: impl Fn(Value) -> bool) {
        self.facts.retain(|key, (fact, _)| match key {
            Key::Bounds { old, .. } | Key::Find { old, .. } | Key::Gaps { old, .. } => *old != of_old,
            key => of_old || ring_of(key, fact).is_none_or(&stays),
        });
    }

    /// Where `x` stands in the ring of `v` as it is, bytes from its start, if it is sure to.
    pub(super) fn place(&self, x: Value, v: Value) -> Option<Value> {
        match (self.get(Key::Stands { x, v }), self.get(Key::Find { x, v, old: false })) {
            (Some(Fact::Is(at)), _) => Some(at),
            (_, Some(Fact::Found(found))) if found.certain => Some(found.at),
            _ => None,
        }
    }

    /// A vertex is not null.
    pub(super) fn is_not_null(&mut self, x: Value) {
        self.learn(Key::NotNull(x), Fact::Holds);
        if let Some(Fact::Beside { x: other, v, at, place }) = self.get(Key::Beside(x)) {
            self.learn(Key::Stands { x: other, v }, Fact::Is(at));
            self.learn(Key::Stands { x, v }, Fact::Is(place));
        }
    }

    /// A vertex was created just now.
    pub(super) fn created(&mut self, v: Value) {
        self.fresh.push(Fresh { v, since: self.log.len(), rings: Vec::new(), bare: true });
        self.learn(Key::NotNull(v), Fact::Holds);
    }

    pub(super) fn learn_that_differ(&mut self, a: Value, b: Value) {
        self.learn(Key::Differ(a.min(b), a.max(b)), Fact::Holds);
    }

    /// Whether two vertices are sure to be different ones.
    pub(super) fn differ(&self, a: Value, b: Value) -> bool {
        self.holds(Key::Differ(a.min(b), a.max(b))) || self.is_younger(a, b) || self.is_younger(b, a)
    }

    /// Whether `a` was created when `b` was a vertex, or null, already.
    fn is_younger(&self, a: Value, b: Value) -> bool {
        let Some(a) = self.fresh(a) else { return false };
        let was = |key| self.facts.get(&key).is_some_and(|&(_, place)| place < a.since);
        was(Key::NotNull(b)) || was(Key::Met(b))
    }

    fn fresh(&self, v: Value) -> Option<&Fresh> {
        self.fresh.iter().find(|f| f.v == v)
    }

    /// Whether `x` is sure not to stand in the ring of `v` as it is.
    pub(super) fn is_absent(&self, x: Value, v: Value) -> bool {
        self.fresh(x).is_some_and(|x| x.rings.iter().all(|&w| self.differ(v, w)))
    }

    /// Whether `v` is sure to have had no ring yet.
    pub(super) fn is_bare(&self, v: Value) -> bool {
        self.fresh(v).is_some_and(|v| v.bare)
    }

    /// Something, `None` for a gap, is put into the ring of `v`.
    pub(super) fn put(&mut self, x: Option<Value>, v: Value) {
        let Some(x) = x else { return };
        for i in 0..self.fresh.len() {
            if !self.differ(x, self.fresh[i].v) {
                self.fresh[i].rings.push(v);
            }
        }
    }

    /// Anything may be put into the ring of `v`.
    pub(super) fn put_any(&mut self, v: Value) {
        for fresh in &mut self.fresh {
            fresh.rings.push(v);
        }
    }

    /// The ring of `v` is made of these: none was there twice but gaps.
    pub(super) fn made_of(&mut self, items: &[Value], v: Value) {
        for (i, &x) in items.iter().enumerate() {
            self.learn_that_differ(x, v);
            for &y in &items[..i] {
                if self.holds(Key::NotNull(x)) || self.holds(Key::NotNull(y)) {
                    self.learn_that_differ(x, y);
                }
            }
        }
    }

    /// The ring of `v` is made.
    pub(super) fn made(&mut self, v: Value) {
        for i in 0..self.fresh.len() {
            self.fresh[i].bare &= self.differ(v, self.fresh[i].v);
        }
    }

    /// New vertices may have been put anywhere.
    pub(super) fn forget_new(&mut self) {
        self.fresh.clear();
    }
}

/// The vertex whose ring, as it is and wherever it lies, a fact is about.
fn ring_of(key: &Key, fact: &Fact) -> Option<Value> {
    match (key, fact) {
        (&(Key::Lies(v) | Key::Stands { v, .. }), _) | (Key::Beside(_), &Fact::Beside { v, .. }) => Some(v),
        _ => None,
    }
}
