//! Where the colours of a mesh are kept when they were found, by whatever thread.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use vv::stop::Stop;

use super::field::{Field, NoField};
use super::{Annotations, Quantity, Subject, Tint};

/// The colours found last; `Err` says why there are none.
pub type Colors = Result<Arc<Tint>, String>;

/// The colours of one mesh that were found last. Clones are the same cell.
#[derive(Debug, Clone, Default)]
pub struct Cell(Arc<Mutex<Option<Found>>>);

#[derive(Debug)]
struct Found {
    quantity: Quantity,
    range: Option<[f64; 2]>,
    colors: Colors,
}

impl Cell {
    /// Those of a quantity, perhaps in another range than asked for now.
    #[must_use]
    pub fn colors(&self, quantity: &Quantity) -> Option<Colors> {
        self.lock().as_ref().filter(|found| found.quantity == *quantity).map(|found| found.colors.clone())
    }

    /// Whether nothing is left to be found.
    #[must_use]
    pub fn answers(&self, asked: &Annotations) -> bool {
        let Annotations { color_by, range, .. } = asked;
        *color_by == Quantity::Plain
            || self.lock().as_ref().is_some_and(|found| found.quantity == *color_by && found.range == *range)
    }

    /// Finds what is asked for, on this thread; nothing when stopped. Linear in the mesh.
    pub fn find(&self, subject: &Subject<'_>, asked: &Annotations, stop: &Stop) {
        if self.answers(asked) {
            return;
        }
        let Annotations { color_by: quantity, range, .. } = asked.clone();
        let colors = match self.colors(&quantity) {
            // The numbers are known.
            Some(colors) => colors.map(|tint| tint.with_range(range)),
            None => match Field::new(subject, &quantity, stop) {
                Ok(field) => Ok(Tint::of(Arc::new(field), subject.scene, range)),
                Err(NoField::Missing(why)) => Err(why),
                Err(NoField::Stopped(_)) => return,
            },
        };
        *self.lock() = Some(Found { quantity, range, colors: colors.map(Arc::new) });
    }

    fn lock(&self) -> MutexGuard<'_, Option<Found>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
