//! What was before, so that it can be again.
//!
//! Three tracks: the text; all else that is computed from (mesh, rule, parameters, generation); and the look that a style
//! file has taken the place of. In the editor only the text is undone, elsewhere whatever was changed last. They touch
//! nothing in common, so one can be undone past the other. To switch edges on and off is nobody's work and is not undone;
//! a style file changes so much at once that it is.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use std::time::{Duration, Instant};

use vv::mesh::Value;

use super::Session;
use super::pictures::Look;
use crate::command::Command;
use crate::document::MeshSource;

/// Changes of the same kind that follow each other this fast are one.
const TOGETHER: Duration = Duration::from_millis(1500);
/// Changes that are kept of each track.
const MOST: usize = 1000;
/// Bytes of text that are kept.
const MOST_BYTES: usize = 64 << 20;

/// What is computed from, beside the text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct State {
    mesh: MeshSource,
    mesh_chosen: bool,
    rule: Option<String>,
    params: BTreeMap<String, Value>,
    param_sets: BTreeMap<String, BTreeMap<String, Value>>,
    generation: u64,
}

/// The changes so far, and those that were undone.
#[derive(Debug, Default)]
pub(super) struct History {
    text: Track<Arc<str>>,
    state: Track<State>,
    look: Track<Look>,
    /// Counts what is done and undone.
    clock: u64,
    /// Counts programs: another one begins afresh.
    programs: u64,
}

#[derive(Debug)]
struct Track<T> {
    /// What was before each change, with the time at which it was done.
    past: Vec<(u64, T)>,
    /// What was after each change that was undone, with the time of that, and that at which it was done.
    future: Vec<(u64, u64, T)>,
    last: Option<(Kind, Instant)>,
}

impl<T> Default for Track<T> {
    fn default() -> Self {
        Self { past: Vec::new(), future: Vec::new(), last: None }
    }
}

/// What kind of change; those of one kind go together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Kind {
    /// A character was typed; the next one would come here.
    Insert(usize),
    /// A character was deleted here.
    Delete(usize),
    /// A number was dragged.
    Tune,
    /// A slider was moved.
    Param(String),
    /// The time line was walked.
    Time,
    /// Generations were played, for the so manieth time: however long it takes.
    Play(u64),
    /// Anything that stands alone.
    Other,
}

impl<T> Track<T> {
    fn record(&mut self, time: u64, kind: Kind, joins: impl FnOnce(&Kind) -> bool, before: T) {
        let now = Instant::now();
        let soon = |then: &Instant| now.duration_since(*then) < TOGETHER || matches!(kind, Kind::Play(_));
        let joins = self.future.is_empty() && self.last.as_ref().is_some_and(|(last, then)| soon(then) && joins(last));
        self.last = Some((kind, now));
        self.future.clear();
        if !joins {
            self.past.push((time, before));
            if self.past.len() > MOST {
                self.past.remove(0);
            }
        }
    }

    fn undo(&mut self, time: u64, now: impl FnOnce() -> T) -> Option<T> {
        let (done, before) = self.past.pop()?;
        self.future.push((time, done, now()));
        self.last = None;
        Some(before)
    }

    fn redo(&mut self, now: impl FnOnce() -> T) -> Option<T> {
        let (_, done, after) = self.future.pop()?;
        self.past.push((done, now()));
        self.last = None;
        Some(after)
    }
}

impl Session {
    pub(super) fn state(&self) -> State {
        let d = &self.document;
        State {
            mesh: d.mesh.clone(),
            mesh_chosen: self.mesh_chosen,
            rule: d.rule.clone(),
            params: d.params.clone(),
            param_sets: d.param_sets.clone(),
            generation: d.generation,
        }
    }

    /// Counts programs, see [`Session::record`].
    pub(super) fn programs(&self) -> u64 {
        self.history.programs
    }

    /// Another program: what was before it belongs to the one before.
    pub(super) fn forget_history(&mut self) {
        let programs = self.history.programs + 1;
        self.history = History { programs, ..History::default() };
    }

    /// Remembers what was before a command; nothing, if it changed nothing or brought another program.
    pub(super) fn record(&mut self, kind: Option<Kind>, text: &Arc<str>, state: State, programs: u64) {
        if self.history.programs != programs {
            return;
        }
        let time = self.tick();
        let now = Arc::clone(&self.document.program.text);
        if *text != now {
            let (kind, at) = match &kind {
                Some(Kind::Tune) => (Kind::Tune, 0),
                _ => kind_of_edit(text, &now),
            };
            let joins = |last: &Kind| match (last, &kind) {
                (Kind::Tune, Kind::Tune) => true,
                (Kind::Insert(next), Kind::Insert(_)) => *next == at,
                (Kind::Delete(last), Kind::Delete(here)) => last == here || *last == at,
                _ => false,
            };
            self.history.text.record(time, kind.clone(), joins, Arc::clone(text));
            let mut bytes = 0;
            let fits = |(_, text): &&(u64, Arc<str>)| {
                bytes += text.len();
                bytes <= MOST_BYTES
            };
            let kept = self.history.text.past.iter().rev().take_while(fits).count().max(1);
            let surplus = self.history.text.past.len().saturating_sub(kept);
            self.history.text.past.drain(..surplus);
        }
        if state != self.state() {
            let kind = kind.unwrap_or(Kind::Other);
            self.history.state.record(time, kind.clone(), |last| *last == kind && kind != Kind::Other, state);
        }
    }

    /// Remembers how things were seen before a style file came.
    pub(super) fn record_look(&mut self, before: Look) {
        if before != self.look() {
            let time = self.tick();
            self.history.look.record(time, Kind::Other, |_| false, before);
        }
    }

    /// Forgets the last change if nothing came of it: the way on that failed or was stopped is none to come back from.
    pub(super) fn forget_vain_change(&mut self) {
        let now = self.state();
        self.history.state.past.pop_if(|(_, before)| *before == now);
    }

    fn tick(&mut self) -> u64 {
        self.history.clock += 1;
        self.history.clock
    }

    /// Whether there is something to undo.
    #[must_use]
    pub fn can_undo(&self) -> bool {
        let history = &self.history;
        !history.text.past.is_empty() || !history.state.past.is_empty() || !history.look.past.is_empty()
    }

    /// Whether something was undone.
    #[must_use]
    pub fn can_redo(&self) -> bool {
        let history = &self.history;
        !history.text.future.is_empty() || !history.state.future.is_empty() || !history.look.future.is_empty()
    }

    pub(super) fn undo(&mut self) {
        let time = |track: Option<u64>| track.unwrap_or(0);
        let text = time(self.history.text.past.last().map(|e| e.0));
        let state = time(self.history.state.past.last().map(|e| e.0));
        let look = time(self.history.look.past.last().map(|e| e.0));
        if look > text.max(state) {
            let (now, time) = (self.look(), self.tick());
            if let Some(before) = self.history.look.undo(time, || now) {
                self.set_look(before);
            }
        } else if text > state {
            self.undo_text(false);
        } else {
            let (now, time) = (self.state(), self.tick());
            if let Some(before) = self.history.state.undo(time, || now) {
                self.restore(before);
            }
        }
    }

    pub(super) fn redo(&mut self) {
        // What was undone last comes first, whichever was done first.
        let time = |track: Option<u64>| track.unwrap_or(0);
        let text = time(self.history.text.future.last().map(|e| e.0));
        let state = time(self.history.state.future.last().map(|e| e.0));
        let look = time(self.history.look.future.last().map(|e| e.0));
        if look > text.max(state) {
            let now = self.look();
            if let Some(after) = self.history.look.redo(|| now) {
                self.set_look(after);
            }
        } else if text > state {
            self.redo_text(false);
        } else {
            let now = self.state();
            if let Some(after) = self.history.state.redo(|| now) {
                self.restore(after);
            }
        }
    }

    pub(super) fn undo_text(&mut self, focus: bool) {
        let (now, time) = (Arc::clone(&self.document.program.text), self.tick());
        if let Some(before) = self.history.text.undo(time, || now) {
            self.restore_text(before, focus);
        }
    }

    pub(super) fn redo_text(&mut self, focus: bool) {
        let now = Arc::clone(&self.document.program.text);
        if let Some(after) = self.history.text.redo(|| now) {
            self.restore_text(after, focus);
        }
    }

    fn restore(&mut self, state: State) {
        let other_mesh = self.document.mesh != state.mesh;
        self.playing = None;
        self.mesh_chosen = state.mesh_chosen;
        self.document.mesh = state.mesh;
        self.document.rule = state.rule;
        self.document.params = state.params;
        self.document.param_sets = state.param_sets;
        self.document.generation = state.generation;
        if other_mesh {
            self.fit = true;
            self.watch_files();
        }
        self.ask_now();
    }

    fn restore_text(&mut self, text: Arc<str>, focus: bool) {
        let end = changed(&self.document.program.text, &text).end;
        self.reveal = Some(super::Reveal { range: end..end, focus });
        self.document.program.text = text;
        self.text_was_edited();
        self.ask_now();
    }
}

/// How the changes that a command makes go together.
pub(super) fn kind_of(command: &Command) -> Option<Kind> {
    match command {
        Command::Tune(_) => Some(Kind::Tune),
        Command::SetParam(name, _) => Some(Kind::Param(name.clone())),
        Command::Scrub(_) => Some(Kind::Time),
        _ => None,
    }
}

/// The stretch of `new` that is not as in `old`.
#[must_use]
pub fn changed(old: &str, new: &str) -> Range<usize> {
    let same = |a: char, b: char| a == b;
    let start: usize = old.chars().zip(new.chars()).take_while(|&(a, b)| same(a, b)).map(|(a, _)| a.len_utf8()).sum();
    let (old, rest) = (&old[start..], &new[start..]);
    let end: usize =
        old.chars().rev().zip(rest.chars().rev()).take_while(|&(a, b)| same(a, b)).map(|(a, _)| a.len_utf8()).sum();
    start..new.len() - end
}

/// Whether a character was typed or deleted, and where it begins or ended.
fn kind_of_edit(old: &str, new: &str) -> (Kind, usize) {
    let inserted = changed(old, new);
    let removed = changed(new, old);
    let one = |text: &str| text.chars().count() == 1 && text != "\n";
    if removed.is_empty() && one(&new[inserted.clone()]) {
        (Kind::Insert(inserted.end), inserted.start)
    } else if inserted.is_empty() && one(&old[removed.clone()]) {
        (Kind::Delete(removed.start), removed.end)
    } else {
        (Kind::Other, inserted.start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_changed_is_found() {
        assert_eq!(changed("abc", "abXc"), 2..3);
        assert_eq!(changed("abXc", "abc"), 2..2);
        assert_eq!(changed("aa", "aaa"), 2..3);
        assert_eq!(changed("äb", "öb"), 0..2);
        assert_eq!(changed("same", "same"), 4..4);
    }

    #[test]
    fn typing_goes_together_and_other_edits_stand_alone() {
        assert_eq!(kind_of_edit("a", "ab"), (Kind::Insert(2), 1));
        assert_eq!(kind_of_edit("ab", "a"), (Kind::Delete(1), 2));
        assert_eq!(kind_of_edit("a", "a\n").0, Kind::Other);
        assert_eq!(kind_of_edit("a", "abc").0, Kind::Other);
    }
}
