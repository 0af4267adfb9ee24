//! What goes to the terminal: diagnostics, printed lines, progress.

use std::collections::BTreeSet;
use std::io::{self, BufWriter, IsTerminal, Write};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use vv::diagnostic::{Diagnostic, Form, render};
use vv::engine::{Output, OutputClosed};
use vv::source::Sources;

use super::{DiagnosticFormat, Exit, error, fail};

/// Work that is done in this time needs no progress.
const AT_ONCE: Duration = Duration::from_millis(500);

/// Writes diagnostics to stderr, above the progress if some is shown.
#[derive(Debug, Clone)]
pub struct Reporter {
    form: Form,
    progress: ProgressBar,
    said: Arc<Mutex<BTreeSet<String>>>,
}

impl Reporter {
    /// One that writes in this format.
    pub fn new(format: DiagnosticFormat) -> Self {
        let form = match format {
            DiagnosticFormat::Human => Form::Human { color: in_color() },
            DiagnosticFormat::Short => Form::Short,
            DiagnosticFormat::Json => Form::Json,
        };
        let progress = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        Self { form, progress, said: Arc::default() }
    }

    /// Writes them. Nothing can be done when stderr is closed.
    pub fn report(&self, diagnostics: &[Diagnostic], sources: &Sources) {
        if diagnostics.is_empty() {
            return;
        }
        let text = render(diagnostics, sources, self.form);
        self.progress.suspend(|| {
            let _ = io::stderr().lock().write_all(text.as_bytes());
        });
    }

    /// As [`Reporter::report`] without a program, but of the same message only the first.
    pub fn report_once(&self, diagnostic: Diagnostic) {
        let mut said = self.said.lock().unwrap_or_else(PoisonError::into_inner);
        if said.insert(diagnostic.message.clone()) {
            self.report(&[diagnostic], &Sources::default());
        }
    }

    /// From now on, shows on a terminal that work goes on: what [`Reporter::progress`] says and how long it takes. What
    /// is done at once shows nothing.
    pub fn begin(&self) {
        if !io::stderr().is_terminal() {
            return;
        }
        let progress = self.progress.clone();
        std::thread::spawn(move || {
            std::thread::sleep(AT_ONCE);
            // A template that cannot be read would be a mistake of ours; the default style does too.
            if let Ok(style) = ProgressStyle::with_template("{spinner} {prefix}{msg} ({elapsed})") {
                progress.set_style(style);
            }
            if !progress.is_finished() {
                progress.set_draw_target(ProgressDrawTarget::stderr());
                progress.enable_steady_tick(Duration::from_millis(200));
            }
            if progress.is_finished() {
                progress.finish_and_clear();
            }
        });
    }

    /// In which part of the work: stands before all that [`Reporter::progress`] says.
    pub fn part(&self, name: String) {
        self.progress.set_prefix(name);
    }

    /// What is being done now.
    pub fn progress(&self, message: String) {
        self.progress.set_message(message);
    }

    /// Takes the progress away.
    pub fn end(&self) {
        self.progress.finish_and_clear();
    }
}

fn in_color() -> bool {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    io::stderr().is_terminal() && !set("NO_COLOR") && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
}

/// Where `print` goes: stdout, or stderr when stdout is taken.
pub struct Printer {
    to: BufWriter<Box<dyn Write>>,
    /// Someone may watch: lines appear at once.
    watched: bool,
    progress: ProgressBar,
    error: Option<io::Error>,
    closed: bool,
    /// Whether anything was printed.
    used: bool,
}

impl Printer {
    /// To stdout, or to stderr.
    pub fn new(to_stderr: bool, reporter: &Reporter) -> Self {
        let (to, watched): (Box<dyn Write>, _) = if to_stderr {
            (Box::new(io::stderr()), true)
        } else {
            (Box::new(io::stdout()), io::stdout().is_terminal())
        };
        Self {
            to: BufWriter::new(to),
            watched,
            progress: reporter.progress.clone(),
            error: None,
            closed: false,
            used: false,
        }
    }

    /// Sends on what was printed so far.
    ///
    /// # Errors
    /// [`Exit::File`], reported, if it could not be written.
    pub fn flush(&mut self, reporter: &Reporter) -> Result<(), Exit> {
        if self.error.is_none() {
            self.error = self.to.flush().err();
        }
        match self.error.take() {
            None => Ok(()),
            Some(problem) => {
                self.closed = true;
                Err(output_failed(&problem, reporter))
            }
        }
    }

    /// Whether anything was printed.
    pub fn is_used(&self) -> bool {
        self.used
    }

    /// Nobody listens any more.
    pub fn close(&mut self) {
        self.closed = true;
    }

    /// Whether something could not be written, so that nothing else needs to be made.
    pub fn is_closed(&self) -> bool {
        self.closed
    }
}

impl Output for Printer {
    fn print(&mut self, line: &str) -> Result<(), OutputClosed> {
        self.used = true;
        let Self { to, watched, progress, .. } = self;
        let mut write = || {
            to.write_all(line.as_bytes())?;
            to.write_all(b"\n")?;
            if *watched { to.flush() } else { Ok(()) }
        };
        let result = if *watched { progress.suspend(write) } else { write() };
        result.map_err(|error| {
            self.error = Some(error);
            OutputClosed
        })
    }
}

/// Writes the whole of stdout.
///
/// # Errors
/// [`Exit::File`], reported, if it could not be written.
pub fn write_stdout(bytes: &[u8], reporter: &Reporter) -> Result<(), Exit> {
    let write = || {
        let mut out = io::stdout().lock();
        out.write_all(bytes).and_then(|()| out.flush())
    };
    reporter.progress.suspend(write).map_err(|error| output_failed(&error, reporter))
}

/// A closed pipe is how readers say that they have enough: no message.
fn output_failed(problem: &io::Error, reporter: &Reporter) -> Exit {
    if problem.kind() != io::ErrorKind::BrokenPipe {
        let _ = fail::<()>(reporter, Exit::File, error(format!("<stdout>: {}", app::files::sentence(problem))));
    }
    Exit::File
}
