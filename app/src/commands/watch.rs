//! `vv watch`

use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::path::Path;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;
use std::time::Instant;

use app::files;
use app::watch::Watch;

use super::report::{Reporter, write_stdout};
use super::run::{self, Arguments, Tally, Way};
use super::{Exit, error, fail};

/// Of the thread that runs the program: what the system gives the first thread of a process.
const STACK: usize = 8 << 20;

/// Why to look up.
#[derive(Debug, PartialEq, Eq)]
enum News {
    /// Files may have changed.
    Changed,
    /// What was being made is made, or cannot be.
    Ended,
}

/// Runs the program, and again whenever something that it is made of has changed. Comes back when nobody listens any
/// more, or where no change could help.
pub fn watch(arguments: &Arguments) -> Result<(), Exit> {
    let reporter = Reporter::new(arguments.diagnostic_format());
    check(arguments, &reporter)?;
    let (news, inbox) = mpsc::channel();
    let tell = news.clone();
    let mut watch = Watch::start(move || drop(tell.send(News::Changed))).or_else(|problem| no_thread(&problem))?;
    let mut is_first = true;
    loop {
        // Watched before they are read, so that no change is missed.
        let read = arguments.read();
        // What is missing now has no content to come back to: it counts as changed once it is there.
        watch.set_files(read.iter().filter(|path| path.exists()).cloned());
        watch.set_files(read);
        let way = Way { watched: true, ..Way::default() };
        let began = Instant::now();
        let made = making(arguments, &way, began, &watch, (&news, &inbox))?;
        if way.halt.is_requested() {
            continue;
        }
        match made {
            Err(exit) if exit == Exit::NoRenderer || way.closed.load(Ordering::Relaxed) => return Err(exit),
            Err(Exit::Usage) if is_first => return Err(Exit::Usage),
            Err(_) => {}
            Ok(tally) => say(arguments, &line(&arguments.program, tally, began), &reporter)?,
        }
        is_first = false;
        while !has_changed(&watch) {
            if inbox.recv().is_err() {
                return Ok(()); // not reached: the news has a sender here
            }
        }
    }
}

/// What cannot be watched, or made more than once.
fn check(arguments: &Arguments, reporter: &Reporter) -> Result<(), Exit> {
    if arguments.read().iter().any(|path| files::is_standard_stream(path)) {
        let diagnostic = error("`vv watch` reads files, and what comes from stdin does not change");
        return fail(reporter, Exit::Usage, diagnostic.hint("`vv run` reads stdin"));
    }
    if arguments.to_stdout() {
        let diagnostic = error("`vv watch` makes files anew, and what went to stdout cannot be made anew");
        return fail(reporter, Exit::Usage, diagnostic.hint("`vv run` writes to stdout"));
    }
    Ok(())
}

fn no_thread<T>(problem: &io::Error) -> Result<T, Exit> {
    let diagnostic = error(format!("files cannot be watched: {}", files::sentence(problem)));
    fail(&Reporter::new(super::DiagnosticFormat::Human), Exit::File, diagnostic)
}

/// Runs the program once, until it ends or something changes.
fn making(
    arguments: &Arguments,
    way: &Way,
    began: Instant,
    watch: &Watch,
    (news, inbox): (&Sender<News>, &Receiver<News>),
) -> Result<Result<Tally, Exit>, Exit> {
    /// Tells also of a thread that panics.
    struct Teller<'a>(&'a Sender<News>);
    impl Drop for Teller<'_> {
        fn drop(&mut self) {
            let _ = self.0.send(News::Ended);
        }
    }
    thread::scope(|threads| {
        let work = move || {
            let _teller = Teller(news);
            run::make(arguments, began, way)
        };
        let maker = thread::Builder::new().name("run".to_owned()).stack_size(STACK);
        let maker = maker.spawn_scoped(threads, work).or_else(|problem| no_thread(&problem))?;
        while inbox.recv() == Ok(News::Changed) {
            if has_changed(watch) {
                way.halt.request();
            }
        }
        maker.join().map_err(|panic| std::panic::resume_unwind(panic))
    })
}

fn has_changed(watch: &Watch) -> bool {
    std::iter::from_fn(|| watch.change()).count() > 0
}

/// One line on what was made.
fn line(program: &Path, tally: Tally, began: Instant) -> String {
    let some = |count: usize, one: &str, many: &str| format!("{count} {}", if count == 1 { one } else { many });
    let mut line = format!("{}: ", files::shown(program));
    let what = match tally.counts {
        Some([vertices, edges, faces]) if tally.runs == 1 => {
            let (vertices, edges) = (some(vertices, "vertex", "vertices"), some(edges, "edge", "edges"));
            format!("{vertices}, {edges}, {}", some(faces, "face", "faces"))
        }
        _ => some(tally.runs, "run", "runs"),
    };
    let files = some(tally.files, "file", "files");
    // Nothing can fail: it is written into memory.
    let _ = writeln!(line, "{what}; {files} in {:.2} s", began.elapsed().as_secs_f64());
    line
}

/// To stdout, or to stderr where stdout is taken.
fn say(arguments: &Arguments, line: &str, reporter: &Reporter) -> Result<(), Exit> {
    if arguments.has_summary() {
        let _ = io::stderr().lock().write_all(line.as_bytes());
        return Ok(());
    }
    write_stdout(line.as_bytes(), reporter)
}
