//! Tells when the content of a file has changed, however it was written.
//!
//! Editors write in place, write beside and rename, or delete and create anew; so the folders are watched, not the
//! files, and what counts is what stands in a file, not when. Folders that are themselves replaced, and file systems that
//! tell nothing, are caught by looking once a second.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::{Duration, Instant, SystemTime};

use notify::event::{AccessKind, AccessMode, EventKind};
use notify::{RecommendedWatcher, RecursiveMode, Watcher};

/// How long a file must rest before it is looked at: the pieces of one write belong together.
const REST: Duration = Duration::from_millis(15);
/// How long it is waited for at most.
const PATIENCE: Duration = Duration::from_millis(100);
/// How often files are looked at without having been told.
const LOOK: Duration = Duration::from_secs(1);

/// Looks after which a file that is missing is gone.
const GONE: u32 = 2;

/// Watches files from a thread of its own, which ends when this is dropped.
pub struct Watch {
    messages: Sender<Message>,
    changes: Receiver<PathBuf>,
    files: BTreeSet<PathBuf>,
    thread: Option<JoinHandle<()>>,
}

/// Time and length.
type Stamp = Option<(SystemTime, u64)>;

enum Message {
    Files(BTreeMap<PathBuf, Stamp>),
    Event(Told),
    Close,
}

/// What the system tells of folders.
enum Told {
    /// Files have changed, of these names.
    Of(Vec<OsString>),
    /// Something has changed, or was missed.
    Something,
}

impl Watch {
    /// Starts the thread. `wake` is called from it when a file has changed.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn start(wake: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let (messages, inbox) = mpsc::channel();
        let (sender, changes) = mpsc::channel();
        let events = messages.clone();
        let thread = std::thread::Builder::new().name("watch".to_owned()).spawn(move || {
            let mut post = Post { files: BTreeMap::new(), folders: BTreeSet::new(), watcher: None };
            post.watcher = notify::recommended_watcher(move |event: notify::Result<notify::Event>| {
                if let Some(told) = told(event) {
                    let _ = events.send(Message::Event(told));
                }
            })
            .map_err(|error| log::warn!("files are looked at once a second only: {error}"))
            .ok();
            post.stand(&inbox, &sender, &wake);
        })?;
        Ok(Self { messages, changes, files: BTreeSet::new(), thread: Some(thread) })
    }

    /// Watches these files, existing or not, and no others. What they hold now is no change.
    pub fn set_files(&mut self, files: impl IntoIterator<Item = PathBuf>) {
        let files: BTreeSet<PathBuf> = files.into_iter().collect();
        if files != self.files {
            // The stamp is taken here and now: what is written before the thread wakes up is a change.
            let stamped = files.iter().map(|path| (path.clone(), stamp(path))).collect();
            self.files = files;
            let _ = self.messages.send(Message::Files(stamped));
        }
    }

    /// A file whose content has changed, or that is gone and stays so. One that was deleted counts when it is there again.
    #[must_use]
    pub fn change(&self) -> Option<PathBuf> {
        self.changes.try_recv().ok()
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        let _ = self.messages.send(Message::Close);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// The state of the thread.
struct Post {
    files: BTreeMap<PathBuf, Seen>,
    folders: BTreeSet<PathBuf>,
    watcher: Option<RecommendedWatcher>,
}

/// What a file was like when it was looked at last.
#[derive(Default)]
struct Seen {
    /// If it is the same and nobody tells of an event, the content is not read.
    stamp: Stamp,
    /// Whether it could not be read then.
    unread: bool,
    content: Option<u64>,
    /// How many looks it has been missing for.
    missing: u32,
}

impl Post {
    fn stand(&mut self, inbox: &Receiver<Message>, changes: &Sender<PathBuf>, wake: &dyn Fn()) {
        let mut waiting: Option<Waiting> = None;
        let mut next_look = Instant::now() + LOOK;
        loop {
            let due = waiting.as_ref().map_or(next_look, Waiting::due);
            let mut changed = match inbox.recv_timeout(due.saturating_duration_since(Instant::now())) {
                Ok(Message::Close) | Err(RecvTimeoutError::Disconnected) => return,
                Ok(Message::Files(files)) => self.set_files(files),
                Ok(Message::Event(told)) => {
                    waiting.get_or_insert_with(Waiting::new).hear(told);
                    Vec::new()
                }
                Err(RecvTimeoutError::Timeout) => Vec::new(),
            };
            let now = Instant::now();
            if let Some(rested) = waiting.take_if(|w| w.due() <= now) {
                changed.extend(self.look(|path| rested.names(path), true));
                if self.files.keys().any(|path| rested.names(path)) {
                    // What was found emptied shall have time to be filled.
                    next_look = next_look.max(now + LOOK / 4);
                }
            }
            if next_look <= now && waiting.is_none() {
                changed.extend(self.look(|_| true, false));
                next_look = now + LOOK;
            }
            if !changed.is_empty() {
                changed.into_iter().for_each(|path| drop(changes.send(path)));
                wake();
            }
        }
    }

    fn look(&mut self, at: impl Fn(&Path) -> bool, told: bool) -> Vec<PathBuf> {
        self.watch_folders();
        let files = self.files.iter_mut().filter(|(path, _)| at(path));
        files.filter_map(|(path, seen)| seen.look(path, told).then(|| path.clone())).collect()
    }

    fn set_files(&mut self, files: BTreeMap<PathBuf, Stamp>) -> Vec<PathBuf> {
        self.files.retain(|path, _| files.contains_key(path));
        let mut changed = Vec::new();
        for (path, stamp) in files {
            if self.files.contains_key(&path) {
                continue;
            }
            let mut seen = Seen::default();
            seen.look(&path, true);
            if seen.stamp != stamp {
                changed.push(path.clone());
            }
            self.files.insert(path, seen);
        }
        self.watch_folders();
        changed
    }

    fn watch_folders(&mut self) {
        let Some(watcher) = &mut self.watcher else { return };
        let folder = |path: &PathBuf| match path.parent() {
            Some(parent) if parent != Path::new("") => parent.to_owned(),
            _ => PathBuf::from("."),
        };
        // A folder that was deleted is watched again when it is back.
        self.folders.retain(|folder| {
            let exists = folder.is_dir();
            if !exists {
                let _ = watcher.unwatch(folder);
            }
            exists
        });
        let wanted: BTreeSet<PathBuf> = self.files.keys().map(folder).filter(|f| f.is_dir()).collect();
        for folder in self.folders.difference(&wanted) {
            let _ = watcher.unwatch(folder);
        }
        let new: Vec<PathBuf> = wanted.difference(&self.folders).cloned().collect();
        self.folders.retain(|folder| wanted.contains(folder));
        for folder in new {
            if watcher.watch(&folder, RecursiveMode::NonRecursive).is_ok() {
                self.folders.insert(folder);
            }
        }
    }
}

impl Seen {
    /// Whether the content is another than at the last look. A file that cannot be read has not changed: it is on its
    /// way, unless it is missing for longer than anybody takes to write it. One that was just emptied is, too, until the
    /// next look that nobody asked for.
    fn look(&mut self, path: &Path, told: bool) -> bool {
        let stamp = stamp(path);
        if stamp.is_some() {
            self.missing = 0;
        } else if !told && self.content.is_some() {
            self.missing += 1;
            if self.missing == GONE {
                (self.content, self.stamp) = (None, None);
                return true;
            }
        }
        if !told && stamp == self.stamp && !self.unread {
            return false;
        }
        self.stamp = stamp;
        let emptied = told && self.content.is_some() && stamp.is_some_and(|(_, length)| length == 0);
        let content = if emptied { None } else { fingerprint(path) };
        self.unread = stamp.is_some() && content.is_none();
        content.is_some_and(|content| self.content.replace(content) != Some(content))
    }
}

/// What was heard since files were looked at.
struct Waiting {
    first: Instant,
    last: Instant,
    /// All if `None`.
    names: Option<BTreeSet<OsString>>,
}

impl Waiting {
    fn new() -> Self {
        let now = Instant::now();
        Self { first: now, last: now, names: Some(BTreeSet::new()) }
    }

    fn hear(&mut self, told: Told) {
        self.last = Instant::now();
        match (told, &mut self.names) {
            (Told::Of(more), Some(names)) => names.extend(more),
            _ => self.names = None,
        }
    }

    fn due(&self) -> Instant {
        (self.last + REST).min(self.first + PATIENCE)
    }

    fn names(&self, path: &Path) -> bool {
        self.names.as_ref().is_none_or(|names| path.file_name().is_none_or(|name| names.contains(name)))
    }
}

/// What an event tells. That a file was read is no news; to look for it would be to read it again, for ever.
fn told(event: notify::Result<notify::Event>) -> Option<Told> {
    let Ok(event) = event else { return Some(Told::Something) };
    if matches!(event.kind, EventKind::Access(access) if access != AccessKind::Close(AccessMode::Write)) {
        return None;
    }
    let names = event.paths.iter().map(|path| path.file_name().map(std::ffi::OsStr::to_owned));
    match names.collect::<Option<Vec<_>>>() {
        Some(names) if !names.is_empty() && !event.need_rescan() => Some(Told::Of(names)),
        _ => Some(Told::Something),
    }
}

fn stamp(path: &Path) -> Stamp {
    std::fs::metadata(path).and_then(|m| Ok((m.modified()?, m.len()))).ok()
}

fn fingerprint(path: &Path) -> Option<u64> {
    struct Sink(DefaultHasher);
    impl std::io::Write for Sink {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0.write(bytes);
            Ok(bytes.len())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    // A pipe would keep us waiting for somebody who opens its other end.
    if !std::fs::metadata(path).ok()?.is_file() {
        return None;
    }
    let mut file = std::fs::File::open(path).ok()?;
    let mut sink = Sink(DefaultHasher::new());
    std::io::copy(&mut file, &mut sink).ok()?.hash(&mut sink.0);
    Some(sink.0.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As a file of another user that is opened to all: neither its time nor its length changes.
    #[test]
    fn what_could_not_be_read_is_read_as_soon_as_it_can_be() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        // A folder cannot be read; a file takes its place that bears the same stamp.
        std::fs::create_dir(&path).unwrap();
        let Some((time, length)) = stamp(&path) else { panic!("it is there") };
        let mut seen = Seen::default();
        assert!(!seen.look(&path, true));
        std::fs::remove_dir(&path).unwrap();
        let file = std::fs::File::create(&path).unwrap();
        file.set_len(length).unwrap();
        file.set_modified(time).unwrap();
        assert_eq!(stamp(&path), Some((time, length)));
        assert!(seen.look(&path, false), "it has a content now");
        assert!(!seen.look(&path, false), "and no other");
    }

    /// As editors write that empty a file first.
    #[test]
    fn an_emptied_file_is_on_its_way_until_nobody_wrote_to_it_for_a_while() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let mut seen = Seen::default();
        std::fs::write(&path, "one").unwrap();
        assert!(seen.look(&path, true));
        std::fs::write(&path, "").unwrap();
        assert!(!seen.look(&path, true));
        std::fs::write(&path, "one").unwrap();
        assert!(!seen.look(&path, true), "it is as it was");
        std::fs::write(&path, "").unwrap();
        assert!(!seen.look(&path, true));
        assert!(seen.look(&path, false), "it stays empty");
        assert!(!seen.look(&path, false));
        let mut new = Seen::default();
        assert!(new.look(&path, true), "what it is from the first is no change that waits");
        assert!(!new.look(&path, false));
    }

    #[test]
    fn files_that_nobody_named_are_not_read() {
        let mut waiting = Waiting::new();
        waiting.hear(Told::Of(vec!["a".into(), "b".into()]));
        let named = |w: &Waiting| ["x/a", "x/b", "x/c"].map(|path| w.names(Path::new(path)));
        assert_eq!(named(&waiting), [true, true, false]);
        waiting.hear(Told::Something);
        waiting.hear(Told::Of(vec!["a".into()]));
        assert_eq!(named(&waiting), [true; 3], "something was missed");
    }

    #[test]
    fn pieces_of_one_write_are_waited_for_and_not_for_ever() {
        let mut waiting = Waiting::new();
        assert!(waiting.due() <= waiting.first + REST);
        waiting.last = waiting.first + REST / 2;
        assert_eq!(waiting.due(), waiting.first + REST / 2 + REST);
        waiting.last = waiting.first + 10 * PATIENCE;
        assert_eq!(waiting.due(), waiting.first + PATIENCE);
    }
}
