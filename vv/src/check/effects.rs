//! What calls what: functions that are declared and called, but not defined, and old values that no `synchronize` can have
//! made.

use crate::diagnostic::Diagnostic;
use crate::ir::FunctionId;
use crate::source::Span;

use super::Checker;

/// What a function does, itself.
#[derive(Debug, Clone, Default)]
pub(super) struct Effects {
    pub(super) calls: Vec<FunctionId>,
    pub(super) synchronizes: bool,
    /// The first place that reads an old value.
    pub(super) reads_old: Option<Span>,
}

impl Checker<'_> {
    /// Looks at what a step can reach: a library may leave something to those who include it.
    pub(super) fn look_at_calls(&mut self) {
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
    }

    /// An old value may be there if the function, one that it calls, or one that leads to it (or calls on the way)
    /// synchronizes.
    fn warn_of_missing_synchronize(&mut self, run: &[bool], callers: &[Vec<usize>], callees: &[Vec<usize>]) {
        let n = self.effects.len();
        let itself = (0..n).filter(|&i| self.effects[i].synchronizes);
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
