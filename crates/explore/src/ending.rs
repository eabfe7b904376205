//! What the system tells a process that is to end, beside Ctrl-C: the page's server ends in good order then, and takes
//! the files that were dropped on the page with it.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Listens from here on: the flag is set when the process is to end.
#[cfg(unix)]
pub fn listen() -> io::Result<Arc<AtomicBool>> {
    use tokio::signal::unix::{SignalKind, signal};

    let told = Arc::new(AtomicBool::new(false));
    let hangup = hears_hangups().then(SignalKind::hangup);
    for kind in [SignalKind::terminate()].into_iter().chain(hangup) {
        let mut heard = signal(kind)?;
        let told = Arc::clone(&told);
        tokio::spawn(async move {
            heard.recv().await;
            told.store(true, Ordering::Relaxed);
        });
    }
    Ok(told)
}

/// The same where the terminal's window is closed, or the system is shut down.
#[cfg(windows)]
pub fn listen() -> io::Result<Arc<AtomicBool>> {
    use tokio::signal::windows::{ctrl_close, ctrl_shutdown};

    let told = Arc::new(AtomicBool::new(false));
    let (mut close, mut shutdown) = (ctrl_close()?, ctrl_shutdown()?);
    let [on_close, on_shutdown] = [Arc::clone(&told), Arc::clone(&told)];
    tokio::spawn(async move {
        close.recv().await;
        on_close.store(true, Ordering::Relaxed);
    });
    tokio::spawn(async move {
        shutdown.recv().await;
        on_shutdown.store(true, Ordering::Relaxed);
    });
    Ok(told)
}

/// True where a hangup would end the process: under nohup it is ignored, and stays so. Linux alone tells it; elsewhere a
/// hangup ends the process as if nobody listened.
#[cfg(unix)]
fn hears_hangups() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    ignored(&status).is_some_and(|signals| signals & 1 == 0)
}

/// The signals that a process ignores, the first one in the lowest bit.
#[cfg(unix)]
fn ignored(status: &str) -> Option<u64> {
    let line = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
    u64::from_str_radix(line.trim(), 16).ok()
}
