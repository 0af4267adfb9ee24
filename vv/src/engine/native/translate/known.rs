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
    pub(super) start: Value,
    /// Bytes of the ring, i64.
    pub(super) bytes: Value,
    /// Bytes from the start to the slot, i64; 0 if it is not there.
    pub(super) at: Value,
    /// Whether it is there; `None` if that is certain.
    pub(super) found: Option<Value>,
    /// The kind of memory.
    pub(super) flags: MemFlagsData,
}

/// What a fact is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Key {
    NotNull(Value),
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
    /// An address.
    At(Value),
}

#[derive(Default)]
pub(super) struct Known {
    facts: FxHashMap<Key, Fact>,
    /// Keys in the order in which they were learned.
    log: Vec<Key>,
    scopes: Vec<usize>,
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
    }

    /// A fact that is known already stays, for it holds longer.
    pub(super) fn learn(&mut self, key: Key, fact: Fact) {
        if let Entry::Vacant(entry) = self.facts.entry(key) {
            entry.insert(fact);
            self.log.push(key);
        }
    }

    pub(super) fn get(&self, key: Key) -> Option<Fact> {
        self.facts.get(&key).copied()
    }

    pub(super) fn holds(&self, key: Key) -> bool {
        self.facts.contains_key(&key)
    }

    /// Rings, as they are or as they were, may have changed or moved.
    pub(super) fn forget_rings(&mut self, of_old: bool) {
        self.facts.retain(|key, _| !matches!(key, Key::Bounds { old, .. } | Key::Find { old, .. } if *old == of_old));
    }
}
