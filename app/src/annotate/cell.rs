//! Where the colours of a mesh are kept when they were found, by whatever thread.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use vv::stop::Stop;

use super::field::{Field, NoField};
use super::{Annotations, ArrowSet, Arrows, Quantity, Subject, Tint};

/// The colours found last; `Err` says why there are none.
pub type Colors = Result<Arc<Tint>, String>;

/// The colours and arrows of one mesh that were found last. Clones are the same cell.
#[derive(Debug, Clone, Default)]
pub struct Cell {
    colors: Arc<Mutex<Option<Found>>>,
    arrows: Arc<Mutex<Option<FoundArrows>>>,
}

type FoundArrows = (Arrows, Arc<ArrowSet>);

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

    /// Those found last, of whatever.
    #[must_use]
    pub fn latest(&self) -> Option<Arc<Tint>> {
        self.lock().as_ref()?.colors.as_ref().ok().map(Arc::clone)
    }

    /// Whether nothing is left to be found.
    #[must_use]
    pub fn answers(&self, asked: &Annotations) -> bool {
        self.has_colors(asked) && self.has_arrows(asked)
    }

    /// Those arrows.
    #[must_use]
    pub fn arrows(&self, arrows: &Arrows) -> Option<Arc<ArrowSet>> {
        let found = self.arrows.lock().unwrap_or_else(PoisonError::into_inner);
        found.as_ref().filter(|(found, _)| found == arrows).map(|(_, set)| Arc::clone(set))
    }

    fn has_arrows(&self, asked: &Annotations) -> bool {
        asked.arrows == Arrows::Nothing || self.arrows(&asked.arrows).is_some()
    }

    fn has_colors(&self, asked: &Annotations) -> bool {
        let Annotations { color_by, range, .. } = asked;
        *color_by == Quantity::Plain
            || self.lock().as_ref().is_some_and(|found| found.quantity == *color_by && found.range == *range)
    }

    /// Finds what is asked for, on this thread; nothing when stopped. Linear in the mesh.
    pub fn find(&self, subject: &Subject<'_>, asked: &Annotations, stop: &Stop) {
        if !self.has_arrows(asked) {
            let set = match ArrowSet::new(subject, &asked.arrows, stop) {
                Ok(set) => set,
                Err(NoField::Missing(_)) => ArrowSet::default(),
                Err(NoField::Stopped(_)) => return,
            };
            *self.arrows.lock().unwrap_or_else(PoisonError::into_inner) = Some((asked.arrows.clone(), Arc::new(set)));
        }
        if self.has_colors(asked) {
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
        self.colors.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
