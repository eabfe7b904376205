//! The progress bar.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

/// A run that is over sooner shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// A bar with cells a second and time left, on a terminal only.
pub struct Progress {
    bar: ProgressBar,
    began: Instant,
    shown: AtomicBool,
}

impl Progress {
    /// A bar for `cells` cells; `quiet` shows none.
    pub fn new(cells: usize, quiet: bool) -> Progress {
        let bar = ProgressBar::with_draw_target(Some(cells as u64), ProgressDrawTarget::hidden());
        // The template is a constant; a mistake in it would show as the library's default bar.
        if let Ok(style) = ProgressStyle::with_template(
            "{bar:32} {percent:>3} %  {human_pos} of {human_len} cells  {rate}  {eta} left",
        ) {
            bar.set_style(style.with_key("rate", rate));
        }
        Progress { bar, began: Instant::now(), shown: AtomicBool::new(quiet) }
    }

    /// Tells of cells that are done.
    pub fn advance(&self, cells: usize) {
        self.bar.inc(cells as u64);
        if self.began.elapsed() > PATIENCE && !self.shown.swap(true, Ordering::Relaxed) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

fn rate(state: &ProgressState, line: &mut dyn std::fmt::Write) {
    // A line that cannot be written is a bar that is not shown; the run does not depend on it.
    let _ = write!(line, "{:.0} cells/s", state.per_sec());
}
