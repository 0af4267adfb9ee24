//! What was before, so that it can be again.
//!
//! Three tracks: the text; all else that is computed from (mesh, rule, parameters, generation); and the look that a style
//! file has taken the place of. In the editor only the text is undone, elsewhere whatever was changed last. They touch
//! nothing in common, so one can be undone past the other. To switch edges on and off is nobody's work and is not undone;
//! a style file changes so much at once that it is. What two linked documents did together is undone in both.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
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
    /// What is being done in two documents at once.
    common: Option<Common>,
    /// What playing was begun in two documents at once.
    played: Option<Common>,
}

/// Tells what was done in two documents at once, alike in both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Common(u64);

impl Common {
    /// Another one than all before.
    pub(super) fn new() -> Self {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        Self(COUNT.fetch_add(1, Ordering::Relaxed))
    }
}

#[derive(Debug)]
struct Track<T> {
    past: Vec<Done<T>>,
    future: Vec<Undone<T>>,
    last: Option<(Kind, Instant)>,
}

/// A change that was made.
#[derive(Debug)]
struct Done<T> {
    time: u64,
    before: T,
    common: Option<Common>,
}

/// A change that was undone.
#[derive(Debug)]
struct Undone<T> {
    time: u64,
    after: T,
    /// When it was made, and with whom.
    done: u64,
    common: Option<Common>,
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
    fn record(&mut self, change: Done<T>, kind: Kind, joins: impl FnOnce(&Kind) -> bool) {
        let now = Instant::now();
        let soon = |then: &Instant| now.duration_since(*then) < TOGETHER || matches!(kind, Kind::Play(_));
        let joins = self.future.is_empty() && self.last.as_ref().is_some_and(|(last, then)| soon(then) && joins(last));
        self.last = Some((kind, now));
        self.future.clear();
        if !joins {
            self.past.push(change);
            if self.past.len() > MOST {
                self.past.remove(0);
            }
        }
    }

    fn undo(&mut self, time: u64, now: impl FnOnce() -> T) -> Option<Done<T>> {
        let change = self.past.pop()?;
        self.future.push(Undone { time, after: now(), done: change.time, common: change.common });
        self.last = None;
        Some(change)
    }

    fn redo(&mut self, now: impl FnOnce() -> T) -> Option<Undone<T>> {
        let change = self.future.pop()?;
        self.past.push(Done { time: change.done, before: now(), common: change.common });
        self.last = None;
        Some(change)
    }

    /// When the last change was made, 0 for never; likewise when the last one was undone.
    fn done(&self) -> u64 {
        self.past.last().map_or(0, |change| change.time)
    }

    fn undone(&self) -> u64 {
        self.future.last().map_or(0, |change| change.time)
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
            let change = Done { time, before: Arc::clone(text), common: None };
            self.history.text.record(change, kind.clone(), joins);
            let mut bytes = 0;
            let fits = |change: &&Done<Arc<str>>| {
                bytes += change.before.len();
                bytes <= MOST_BYTES
            };
            let kept = self.history.text.past.iter().rev().take_while(fits).count().max(1);
            let surplus = self.history.text.past.len().saturating_sub(kept);
            self.history.text.past.drain(..surplus);
        }
        if state != self.state() {
            let kind = kind.unwrap_or(Kind::Other);
            let plays = matches!(kind, Kind::Play(_));
            let common = if plays { self.history.played } else { self.history.common };
            let change = Done { time, before: state, common };
            self.history.state.record(change, kind.clone(), |last| *last == kind && kind != Kind::Other);
        }
    }

    /// Remembers how things were seen before a style file came.
    pub(super) fn record_look(&mut self, before: Look) {
        if before != self.look() {
            let change = Done { time: self.tick(), before, common: None };
            self.history.look.record(change, Kind::Other, |_| false);
        }
    }

    /// Forgets the last change if nothing came of it: the way on that failed or was stopped is none to come back from.
    pub(super) fn forget_vain_change(&mut self) {
        let now = self.state();
        self.history.state.past.pop_if(|change| change.before == now);
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

    /// What is done until the next call is done in another document, too.
    pub(super) fn do_in_common(&mut self, common: Option<Common>) {
        self.history.common = common;
    }

    /// So is what playing does that begins now.
    pub(super) fn play_in_common(&mut self) {
        self.history.played = self.history.common;
    }

    pub(super) fn undo(&mut self) {
        let History { text, state, look, .. } = &self.history;
        let (text, state, look) = (text.done(), state.done(), look.done());
        if look > text.max(state) {
            let (now, time) = (self.look(), self.tick());
            if let Some(change) = self.history.look.undo(time, || now) {
                self.set_look(change.before);
            }
        } else if text > state {
            self.undo_text(false);
        } else if let Some(common) = self.undo_state() {
            self.undo_beside(common);
        }
    }

    pub(super) fn redo(&mut self) {
        // What was undone last comes first, whichever was done first.
        let History { text, state, look, .. } = &self.history;
        let (text, state, look) = (text.undone(), state.undone(), look.undone());
        if look > text.max(state) {
            let now = self.look();
            if let Some(change) = self.history.look.redo(|| now) {
                self.set_look(change.after);
            }
        } else if text > state {
            self.redo_text(false);
        } else if let Some(common) = self.redo_state() {
            self.redo_beside(common);
        }
    }

    /// Returns whether another document did the same.
    fn undo_state(&mut self) -> Option<Common> {
        let (now, time) = (self.state(), self.tick());
        let change = self.history.state.undo(time, || now)?;
        self.restore(change.before);
        change.common
    }

    fn redo_state(&mut self) -> Option<Common> {
        let now = self.state();
        let change = self.history.state.redo(|| now)?;
        self.restore(change.after);
        change.common
    }

    /// Undoes what was done in common, if nothing has changed since but the text.
    pub(super) fn undo_common(&mut self, common: Common) {
        if self.history.state.past.last().is_some_and(|change| change.common == Some(common)) {
            let before = self.document.clone();
            self.undo_state();
            self.touch(&before);
        }
    }

    /// The same for what was undone.
    pub(super) fn redo_common(&mut self, common: Common) {
        if self.history.state.future.last().is_some_and(|change| change.common == Some(common)) {
            let before = self.document.clone();
            self.redo_state();
            self.touch(&before);
        }
    }

    pub(super) fn undo_text(&mut self, focus: bool) {
        let (now, time) = (Arc::clone(&self.document.program.text), self.tick());
        if let Some(change) = self.history.text.undo(time, || now) {
            self.restore_text(change.before, focus);
        }
    }

    pub(super) fn redo_text(&mut self, focus: bool) {
        let now = Arc::clone(&self.document.program.text);
        if let Some(change) = self.history.text.redo(|| now) {
            self.restore_text(change.after, focus);
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
