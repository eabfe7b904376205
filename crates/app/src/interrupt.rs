//! Ctrl-C: the first ends the run in good order, the second at once.

use std::sync::atomic::{AtomicBool, Ordering};

/// Set by the first Ctrl-C.
static ASKED: AtomicBool = AtomicBool::new(false);

/// Exit status of a run that Ctrl-C ended, as shells have it: 128 and the signal's number.
pub const STATUS: u8 = 130;

/// Listens to Ctrl-C from here on.
pub fn listen() {
    // Where the system gives no such signal, a run just ends with it.
    let _ = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(STATUS));
        }
    });
}

/// True when the run is to end.
pub fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// The flag that is true when the run is to end.
pub fn flag() -> &'static AtomicBool {
    &ASKED
}
