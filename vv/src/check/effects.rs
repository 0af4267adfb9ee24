//! What calls what: functions that are declared and called, but not defined, old values that no `synchronize` can have
//! made, and those that nothing reads.

use crate::diagnostic::{Diagnostic, Severity};
use crate::ir::FunctionId;
use crate::source::{FileId, Span};

use super::Checker;

/// What a function does, itself.
#[derive(Debug, Clone, Default)]
pub(super) struct Effects {
    pub(super) calls: Vec<FunctionId>,
    /// The first place that makes old values.
    pub(super) synchronizes: Option<Span>,
    /// The first place that reads an old value.
    pub(super) reads_old: Option<Span>,
}

impl Checker<'_> {
    /// Looks at what a step can reach: a library may leave something to those who include it. What is missing is said only of
    /// a `sound` text: it may stand in what could not be read.
    pub(super) fn look_at_calls(&mut self, sound: bool) {
        let n = self.effects.len();
        let mut callers = vec![Vec::new(); n];
        let mut callees = vec![Vec::new(); n];
        for (i, effects) in self.effects.iter().enumerate() {
            for call in &effects.calls {
                let callee = call.0 as usize;
                if callee < n {
                    callers[callee].push(i);
                    callees[i].push(callee);
                }
            }
        }
        let roots = self.rules.iter().chain(&self.start).map(|f| f.0 as usize).filter(|&i| i < n);
        let run = reachable(roots, &callees);
        let mut undefined = std::mem::take(&mut self.undefined);
        undefined.retain(|(id, _)| run.get(id.0 as usize).copied().unwrap_or(false));
        self.diagnostics.extend(undefined.into_iter().map(|(_, error)| error));
        self.warn_of_missing_synchronize(&run, &callers, &callees);
        if sound && !self.diagnostics.iter().any(|d| d.severity == Severity::Error) {
            self.warn_of_unread_old_values(&run, &callers, &callees);
        }
    }

    /// An old value may be there if the function, one that it calls, or one that leads to it (or calls on the way)
    /// synchronizes.
    fn warn_of_missing_synchronize(&mut self, run: &[bool], callers: &[Vec<usize>], callees: &[Vec<usize>]) {
        let n = self.effects.len();
        let itself = (0..n).filter(|&i| self.effects[i].synchronizes.is_some());
        let synchronizing = reachable(itself, callers);
        let covered = reachable((0..n).filter(|&i| synchronizing[i]), callees);
        let faulty: Vec<Span> =
            (0..n).filter(|&i| run[i] && !covered[i]).filter_map(|i| self.effects[i].reads_old).collect();
        for span in faulty {
            self.report(
                Diagnostic::warning(span, "there is no old value here: nothing has called `synchronize`")
                    .hint("begin the step with `synchronize S;`"),
            );
        }
    }

    /// Old values may be read by whatever else a step runs that comes to make them; those of an included file are made for
    /// whoever includes it.
    fn warn_of_unread_old_values(&mut self, run: &[bool], callers: &[Vec<usize>], callees: &[Vec<usize>]) {
        let n = self.effects.len();
        let itself = (0..n).filter(|&i| self.effects[i].reads_old.is_some());
        let reading = reachable(itself, callers);
        let covered = reachable((0..n).filter(|&i| reading[i]), callees);
        let vain = (0..n).filter(|&i| run[i] && !covered[i]).filter_map(|i| self.effects[i].synchronizes);
        let vain: Vec<Span> = vain.filter(|span| span.file == FileId::MAIN).collect();
        for span in vain {
            self.report(
                Diagnostic::warning(span, "nothing reads the old values that this makes")
                    .hint("a back-quote reads them: `` `p$pos ``, `` forall q in `p ``; else leave this out"),
            );
        }
    }
}

fn reachable(from: impl Iterator<Item = usize>, next: &[Vec<usize>]) -> Vec<bool> {
    let mut reached = vec![false; next.len()];
    let mut open: Vec<usize> = from.collect();
    while let Some(i) = open.pop() {
        if !std::mem::replace(&mut reached[i], true) {
            open.extend(&next[i]);
        }
    }
    reached
}
