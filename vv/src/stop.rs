//! A flag by which another thread stops a run.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

/// Shared by the one who runs, who polls it, and the one who may stop the run. Clones are the same flag.
#[derive(Debug, Clone, Default)]
pub struct Stop(Arc<AtomicU8>);

/// Why a run was stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Stopped {
    /// The user asked for it, or a newer request made it pointless.
    #[error("stopped")]
    ByUser,
    /// The time allowed for it is over.
    #[error("the time allowed for a step is over")]
    ByTime,
}

impl Stop {
    /// A flag that is not set.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks the run to stop; the first reason given stays.
    pub fn request(&self, reason: Stopped) {
        let code = match reason {
            Stopped::ByUser => 1,
            Stopped::ByTime => 2,
        };
        let _ = self.0.compare_exchange(0, code, Ordering::Relaxed, Ordering::Relaxed);
    }

    /// The flag itself, zero while nothing was requested, for compiled code to poll.
    pub(crate) fn flag(&self) -> &AtomicU8 {
        &self.0
    }

    /// Polled where work could go on for long. Costs one relaxed load.
    ///
    /// # Errors
    /// When a stop was requested.
    pub fn check(&self) -> Result<(), Stopped> {
        match self.0.load(Ordering::Relaxed) {
            0 => Ok(()),
            1 => Err(Stopped::ByUser),
            _ => Err(Stopped::ByTime),
        }
    }
}
