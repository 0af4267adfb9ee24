//! What a step prints, on its way to the console.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use vv::engine::{Output, OutputClosed};

use super::{Shared, lock};
use crate::console;

/// How often printed lines are handed over: often enough to watch, seldom enough that the window gets the lock.
const FLUSH: Duration = Duration::from_millis(50);

/// Gathers what a step prints and hands it over now and then.
pub(super) struct Printer<'a> {
    shared: &'a Shared,
    wake: &'a dyn Fn(),
    generation: u64,
    lines: VecDeque<String>,
    bytes: usize,
    dropped: u64,
    /// Whether anything was printed.
    pub used: bool,
    flushed: Option<Instant>,
}

impl<'a> Printer<'a> {
    pub fn new(shared: &'a Shared, wake: &'a dyn Fn(), generation: u64) -> Self {
        Self { shared, wake, generation, lines: VecDeque::new(), bytes: 0, dropped: 0, used: false, flushed: None }
    }

    /// Hands over what is left.
    pub fn flush(&mut self) {
        self.flushed = Some(Instant::now());
        if self.lines.is_empty() {
            return;
        }
        lock(&self.shared.console).append(self.generation, self.lines.drain(..), self.dropped);
        (self.bytes, self.dropped) = (0, 0);
        (self.wake)();
    }
}

impl Output for Printer<'_> {
    fn print(&mut self, line: &str) -> Result<(), OutputClosed> {
        let line = console::shortened(line);
        self.used = true;
        self.bytes += line.len();
        self.lines.push_back(line);
        while self.lines.len() > console::MAX_LINES || self.bytes > console::MAX_BYTES {
            self.bytes -= self.lines.pop_front().map_or(0, |l| l.len());
            self.dropped += 1;
        }
        // The first line at once: perhaps nothing comes after it.
        if self.flushed.is_none_or(|last| last.elapsed() >= FLUSH) {
            self.flush();
        }
        Ok(())
    }
}
