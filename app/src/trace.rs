//! Where time goes: spans of work, written down only when asked for.
//!
//! With `VV_TRACE=FILE` in the environment, `vv` writes the spans of all threads to the file as Chrome's trace events,
//! which <https://ui.perfetto.dev> and `chrome://tracing` show as a time line: how long each took (`dur`), and how long the
//! processor was at it (`tdur`), which is less where the thread waited or others had its turn. Else a span costs one relaxed
//! load.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

static ON: AtomicBool = AtomicBool::new(false);
static SINK: Mutex<Option<Sink>> = Mutex::new(None);

enum Sink {
    Memory(Vec<Span>),
    File { file: BufWriter<File>, began: Instant },
}

/// A piece of work that is over.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Span {
    /// What was done.
    pub name: &'static str,
    /// How long it took.
    pub time: Duration,
}

/// A piece of work going on; dropping it ends it.
#[must_use = "it ends where it is dropped"]
pub struct Running {
    name: &'static str,
    began: Option<(Instant, Duration)>,
}

/// Begins a piece of work.
#[inline]
pub fn span(name: &'static str) -> Running {
    Running { name, began: ON.load(Ordering::Relaxed).then(|| (Instant::now(), at_work())) }
}

impl Drop for Running {
    fn drop(&mut self) {
        if let Some((began, worked)) = self.began {
            note(self.name, began, began.elapsed(), at_work().saturating_sub(worked));
        }
    }
}

/// Writes spans to a file from now on.
///
/// # Errors
/// If it cannot be created.
pub fn write_to(path: &Path) -> std::io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    file.write_all(b"[\n")?;
    begin(Sink::File { file, began: Instant::now() });
    Ok(())
}

/// Keeps spans in memory from now on, until they are [taken](take).
pub fn collect() {
    begin(Sink::Memory(Vec::new()));
}

/// The spans that have ended since the last call, if they are kept in memory.
pub fn take() -> Vec<Span> {
    match &mut *sink() {
        Some(Sink::Memory(spans)) => std::mem::take(spans),
        _ => Vec::new(),
    }
}

fn begin(sink_: Sink) {
    *sink() = Some(sink_);
    ON.store(true, Ordering::Relaxed);
}

fn sink() -> MutexGuard<'static, Option<Sink>> {
    SINK.lock().unwrap_or_else(PoisonError::into_inner)
}

/// How long the processor has been at this thread, where the system tells.
fn at_work() -> Duration {
    #[cfg(unix)]
    {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
        Duration::new(time.tv_sec.unsigned_abs(), u32::try_from(time.tv_nsec).unwrap_or(0))
    }
    #[cfg(not(unix))]
    Duration::ZERO
}

fn note(name: &'static str, since: Instant, time: Duration, work: Duration) {
    match &mut *sink() {
        Some(Sink::Memory(spans)) => spans.push(Span { name, time }),
        Some(Sink::File { file, began }) => {
            let (start, time) = (since.saturating_duration_since(*began).as_micros(), time.as_micros());
            let work = work.as_micros();
            let thread = thread();
            // Chrome wants no end of the list, so that a program may stop at any time.
            let line = format!(
                r#"{{"name":"{name}","ph":"X","ts":{start},"dur":{time},"tdur":{work},"pid":1,"tid":{thread}}},"#
            );
            // A full disk ends the trace, not the work.
            let written = writeln!(file, "{line}").and_then(|()| if time > 1000 { file.flush() } else { Ok(()) });
            if written.is_err() {
                ON.store(false, Ordering::Relaxed);
            }
        }
        None => {}
    }
}

/// A number for this thread: 1 for the one that asks first.
fn thread() -> u32 {
    static NEXT: AtomicU32 = AtomicU32::new(1);
    thread_local!(static OWN: u32 = NEXT.fetch_add(1, Ordering::Relaxed));
    OWN.with(|&own| own)
}
