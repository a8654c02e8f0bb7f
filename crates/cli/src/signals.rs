//! Signals that end the command: what it has not finished writing is removed first.

#[cfg(unix)]
pub(super) use on_unix::remove_unfinished_on_signals;

/// Elsewhere the next run removes it.
#[cfg(not(unix))]
pub(super) fn remove_unfinished_on_signals() {}

#[cfg(unix)]
mod on_unix {
    use radiosity::cache::remove_unfinished;
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;
    use std::sync::Once;
    use std::{fs, thread};

    /// What cannot be set up costs nothing else: the next run removes what is left.
    pub(crate) fn remove_unfinished_on_signals() {
        static ONCE: Once = Once::new();
        ONCE.call_once(|| {
            let heeded = [SIGINT, SIGTERM].into_iter().filter(|&s| !is_ignored(s));
            if let Ok(mut signals) = Signals::new(heeded) {
                let remove = move || signals.forever().next().map(end);
                let _ = thread::Builder::new().spawn(remove);
            }
        });
    }

    /// Ends the process by the signal, as if nobody had caught it.
    fn end(signal: i32) {
        let _nothing_more_is_written = remove_unfinished();
        let _ = emulate_default_handler(signal);
    }

    /// Whether whoever started the process wants it to outlive the signal, as shells do with what
    /// runs in the background; known on Linux.
    fn is_ignored(signal: i32) -> bool {
        let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
        let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        ignored.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
    }
}
