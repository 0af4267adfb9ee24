//! What happens when a command is interrupted, or may not write any more.

/// From now on SIGINT, SIGTERM and SIGHUP leave no half-written file behind before they end the process as ever; and a
/// file that grows beyond the limit of its user is an error where it is written, not the end of the process.
#[cfg(unix)]
pub fn leave_nothing_behind() {
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::iterator::Signals;

    // Fails for no signal that may be caught; and a command that cannot clean up still works.
    let _ = signal_hook::flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    // Who started the command with a signal ignored, as shells do in the background, wants it to stay so.
    let ignored = ignored();
    let wanted = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    let Ok(mut signals) = Signals::new(wanted) else { return };
    let ender = std::thread::Builder::new().name("signals".to_owned());
    let _ = ender.spawn(move || {
        if let Some(signal) = signals.forever().next() {
            app::files::abandon();
            let _ = signal_hook::low_level::emulate_default_handler(signal);
        }
    });
}

/// The signals that are ignored, a bit for each; none where the system does not tell.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or_default()
}

/// Elsewhere there are no such signals.
#[cfg(not(unix))]
pub fn leave_nothing_behind() {}
