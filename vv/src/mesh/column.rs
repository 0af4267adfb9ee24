//! An array that clones share until one of them writes.

use std::ops::Deref;
use std::sync::Arc;

/// A shared array; reading derefs to a slice, writing goes through [`Column::edit`].
#[derive(Debug)]
pub struct Column<T>(Arc<Vec<T>>);

impl<T: Clone> Column<T> {
    /// The array for writing. Copies it first if a clone shares it.
    pub fn edit(&mut self) -> &mut Vec<T> {
        Arc::make_mut(&mut self.0)
    }

    /// The array for writing, with room for `capacity` elements. A shared one is copied, with that room at once.
    pub(crate) fn edit_with_capacity(&mut self, capacity: usize) -> &mut Vec<T> {
        if Arc::get_mut(&mut self.0).is_none() {
            let mut copy = Vec::with_capacity(capacity.max(self.0.len()));
            copy.extend_from_slice(&self.0);
            self.0 = Arc::new(copy);
        }
        let values = Arc::make_mut(&mut self.0);
        values.reserve_exact(capacity.saturating_sub(values.len()));
        values
    }
}

impl<T> Column<T> {
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

impl<T> Clone for Column<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T> Default for Column<T> {
    fn default() -> Self {
        Self(Arc::new(Vec::new()))
    }
}

impl<T> From<Vec<T>> for Column<T> {
    fn from(values: Vec<T>) -> Self {
        Self(Arc::new(values))
    }
}

impl<T> Deref for Column<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.0
    }
}
