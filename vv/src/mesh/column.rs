//! An array that clones share until one of them writes.
//!
//! Memory of large arrays is kept for the next ones when the last clone goes: touching fresh memory for the first time
//! takes about as long as computing what is written to it.

use std::any::Any;
use std::ops::Deref;
use std::sync::{Arc, Mutex, PoisonError};

/// Arrays of fewer bytes are left to the allocator, which keeps them itself.
const LARGE: usize = 1 << 20;

/// Bytes that are kept at most, all threads together.
const KEPT: usize = 256 << 20;

/// A shared array; reading derefs to a slice, writing goes through [`Column::edit`].
#[derive(Debug)]
pub struct Column<T: Send + 'static>(Arc<Vec<T>>);

impl<T: Clone + Send> Column<T> {
    /// The array for writing. Copies it first if a clone shares it.
    pub fn edit(&mut self) -> &mut Vec<T> {
        Arc::make_mut(&mut self.0)
    }

    /// The array for writing, with room for `capacity` elements. A shared one is copied, with that room at once.
    pub(crate) fn edit_with_capacity(&mut self, capacity: usize) -> &mut Vec<T> {
        if Arc::get_mut(&mut self.0).is_none() {
            let mut copy = spare(capacity.max(self.0.len()));
            copy.extend_from_slice(&self.0);
            self.0 = Arc::new(copy);
        }
        let values = Arc::make_mut(&mut self.0);
        values.reserve_exact(capacity.saturating_sub(values.len()));
        values
    }
}

impl<T: Clone + Send> Column<T> {
    /// Forgets the first `n` elements: the others move to their place, unless a clone shares them.
    pub(crate) fn drop_first(&mut self, n: usize) {
        let n = n.min(self.0.len());
        match Arc::get_mut(&mut self.0) {
            Some(values) => {
                values.drain(..n);
                values.shrink_to_fit();
            }
            None => self.0 = Arc::new(self.0[n..].to_vec()),
        }
    }
}

impl<T: Send> Column<T> {
    /// Bytes of the array's capacity.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.0.capacity() * size_of::<T>()
    }

    /// Whether a clone shares it.
    pub(crate) fn is_shared(&self) -> bool {
        Arc::strong_count(&self.0) > 1
    }

    /// How many elements the array has room for.
    pub(crate) fn capacity(&self) -> usize {
        self.0.capacity()
    }

    /// Whether the two are one array.
    #[must_use]
    pub fn shares_with(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl<T: Send> Clone for Column<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T: Send> Default for Column<T> {
    fn default() -> Self {
        Self(Arc::new(Vec::new()))
    }
}

impl<T: Send> From<Vec<T>> for Column<T> {
    fn from(values: Vec<T>) -> Self {
        Self(Arc::new(values))
    }
}

impl<T: Send> Deref for Column<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T: Send + 'static> Drop for Column<T> {
    fn drop(&mut self) {
        let bytes = self.bytes();
        if (LARGE..=KEPT).contains(&bytes)
            && let Some(values) = Arc::get_mut(&mut self.0)
        {
            let mut values = std::mem::take(values);
            values.clear();
            keep(Box::new(values), bytes);
        }
    }
}

/// An array whose elements are gone.
struct Spare {
    bytes: usize,
    /// A `Vec`.
    array: Box<dyn Any + Send>,
}

/// The oldest first.
static SPARE: Mutex<Vec<Spare>> = Mutex::new(Vec::new());

fn keep(array: Box<dyn Any + Send>, bytes: usize) {
    let mut spare = SPARE.lock().unwrap_or_else(PoisonError::into_inner);
    spare.push(Spare { bytes, array });
    let mut total: usize = spare.iter().map(|s| s.bytes).sum();
    let mut first = 0;
    while total > KEPT {
        total -= spare[first].bytes;
        first += 1;
    }
    let gone: Vec<_> = spare.drain(..first).collect();
    // What it takes to give memory back is no reason to wait for it.
    drop(spare);
    drop(gone);
}

/// An empty array with room for so many elements: one that was kept, up to four times as large as asked for, else a new
/// one. Kept arrays of this type that turn out too small are given back: meshes grow.
pub(crate) fn spare<T: Send + 'static>(capacity: usize) -> Vec<T> {
    let mut found = None;
    let mut gone = Vec::new();
    if capacity * size_of::<T>() >= LARGE {
        let mut spare = SPARE.lock().unwrap_or_else(PoisonError::into_inner);
        let mut i = 0;
        while let Some(s) = spare.get(i) {
            match s.array.downcast_ref::<Vec<T>>().map(Vec::capacity) {
                Some(c) if c < capacity => gone.push(spare.remove(i)),
                Some(c) if c <= 4 * capacity && found.is_none() => found = Some(spare.remove(i)),
                _ => i += 1,
            }
        }
    }
    let kept = found.and_then(|s| s.array.downcast::<Vec<T>>().ok());
    kept.map_or_else(|| Vec::with_capacity(capacity), |array| *array)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No other test has arrays of this type.
    #[derive(Clone)]
    struct Element([u64; 4]);

    fn column(n: usize) -> Column<Element> {
        let mut values = spare(n);
        values.resize(n, Element([7; 4]));
        values.into()
    }

    fn kept() -> usize {
        let spare = SPARE.lock().unwrap();
        spare.iter().filter(|s| s.array.is::<Vec<Element>>()).count()
    }

    #[test]
    fn memory_is_kept_when_the_last_clone_goes() {
        let n = 8 * LARGE / size_of::<Element>();
        let first = column(n);
        let clone = first.clone();
        let address = first.as_ptr();
        drop(first);
        assert_eq!((kept(), clone[n - 1].0), (0, [7; 4]));
        drop(clone);
        assert_eq!(kept(), 1);
        // It is too large to be spent on a little.
        let little = spare::<Element>(n / 8);
        assert_ne!(little.as_ptr(), address);
        let second = column(n);
        assert_eq!((second.as_ptr(), second.len(), kept()), (address, n, 0));
        drop(second);
        assert_eq!(kept(), 1);
        // Where more is asked for it is given back.
        drop(spare::<Element>(2 * n));
        assert_eq!(kept(), 0);
    }
}
