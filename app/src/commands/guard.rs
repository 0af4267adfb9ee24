//! The last words when the window ends without being asked to.
//!
//! When an X server goes away, Xlib calls C's `exit(1)` from the middle of the window's loop: nothing of ours is unwound,
//! but what the thread owns is dropped, and so it can say what has happened and give the exit code its meaning. Whoever
//! asks the server something at that moment, as winit does in each frame, panics before.

use std::cell::Cell;
use std::panic;

use vv::source::Sources;

use super::report::Reporter;
use super::{DiagnosticFormat, Exit, error};

const KEPT: &str = "what was not saved is kept; vv offers it when it is started next";

thread_local!(static WINDOW: Window = const { Window { open: Cell::new(false) } });

/// Lives as long as the thread.
struct Window {
    open: Cell<bool>,
}

impl Drop for Window {
    fn drop(&mut self) {
        if self.open.get() {
            display_lost(&Reporter::new(DiagnosticFormat::Human));
            std::process::exit(Exit::NoRenderer as i32);
        }
    }
}

/// Says that the display is gone.
pub fn display_lost(reporter: &Reporter) {
    say(reporter, "the display is gone, and the window with it");
}

fn say(reporter: &Reporter, message: &str) {
    reporter.report(&[error(message).hint(KEPT)], &Sources::default());
}

/// While it lives the window is open.
#[must_use = "the window is open as long as this lives"]
pub struct Guard(());

impl Guard {
    /// From now on the window is open.
    pub fn new() -> Self {
        WINDOW.with(|window| window.open.set(true));
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |what| {
            let file = what.location().map_or("", |place| place.file());
            if is_loss(file, what.payload_as_str().unwrap_or_default()) {
                WINDOW.with(|window| window.open.set(false));
                display_lost(&Reporter::new(DiagnosticFormat::Human));
                std::process::exit(Exit::NoRenderer as i32);
            }
            usual(what);
        }));
        Self(())
    }
}

/// Whether this is how winit fails where it asks an X server that is gone.
fn is_loss(file: &str, message: &str) -> bool {
    file.contains("winit") && message.contains("Connection(IoError")
}

impl Drop for Guard {
    fn drop(&mut self) {
        let _ = WINDOW.try_with(|window| window.open.set(false));
        if std::thread::panicking() {
            say(&Reporter::new(DiagnosticFormat::Human), "vv itself failed, which is a mistake in vv");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lost_display_is_no_mistake_of_ours() {
        let message = "called `Result::unwrap()` on an `Err` value: Connection(IoError(Custom { kind: Other }))";
        assert!(is_loss("/registry/winit-0.30.13/src/platform_impl/linux/x11/window.rs", message));
        assert!(!is_loss("app/src/gui.rs", message));
        assert!(!is_loss("/registry/winit-0.30.13/src/lib.rs", "index out of bounds"));
    }
}
