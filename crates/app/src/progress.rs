//! The progress bar.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use topple::work::observer::{Observer, Phase};

use super::call::Call;
use super::interrupt;

/// A phase that is over sooner shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// The remaining work is given in cells and their rate, or in a word.
const CELLS: &str = "{bar:32} {percent:>3} %  {human_pos} of {human_len} cells  {rate}  {eta} left";

/// A bar with cells a second and time left, on a terminal only.
pub struct Bar {
    bar: ProgressBar,
    began: Instant,
    shown: AtomicBool,
}

impl Bar {
    /// A bar for `cells` cells; `quiet` shows none.
    pub fn new(cells: usize, quiet: bool) -> Bar {
        Bar::styled(CELLS, cells, quiet)
    }

    /// A count of cells that are found whole on disk, of as many as there are.
    pub fn checking(quiet: bool) -> Bar {
        Bar::styled("{human_pos} cells checked", 0, quiet)
    }

    /// A bar of a share of the whole; `doing` says of what.
    pub fn share(doing: &str, total: usize, quiet: bool) -> Bar {
        let template = format!("{{bar:32}} {{percent:>3}} %  {doing}  {{eta}} left");
        Bar::styled(&template, total, quiet)
    }

    fn styled(template: &str, total: usize, quiet: bool) -> Bar {
        let quiet = quiet || !Call::current().has_bars();
        let bar = ProgressBar::with_draw_target(Some(total as u64), ProgressDrawTarget::hidden());
        // Templates are constants; a mistake in one would show as the library's default bar.
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.with_key("rate", rate));
        }
        Bar { bar, began: Instant::now(), shown: AtomicBool::new(quiet) }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Observer for Bar {
    fn advance(&self, cells: usize) {
        self.bar.inc(cells as u64);
        if self.began.elapsed() > PATIENCE && !self.shown.swap(true, Ordering::Relaxed) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
    }

    fn cancelled(&self) -> bool {
        interrupt::asked()
    }
}

/// The phases of a run, a bar each.
pub struct Screen {
    quiet: bool,
    bar: Mutex<Bar>,
}

impl Screen {
    /// Shows nothing where it is to be quiet.
    pub fn new(quiet: bool) -> Screen {
        let quiet = quiet || !Call::current().has_bars();
        Screen { quiet, bar: Mutex::new(Bar::new(0, true)) }
    }

    fn with<T>(&self, act: impl FnOnce(&mut Bar) -> T) -> T {
        // A thread that panicked has left a whole bar behind.
        act(&mut self.bar.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        self.with(|bar| bar.finish());
    }
}

impl Observer for Screen {
    fn advance(&self, cells: usize) {
        self.with(|bar| bar.advance(cells));
    }

    fn cancelled(&self) -> bool {
        interrupt::asked()
    }

    fn begins(&self, phase: Phase, total: usize) {
        let new = match phase {
            Phase::Repairing => {
                Bar::share("running cells beside boundaries again", total, self.quiet)
            }
            Phase::Refining => Bar::share("refining", total, self.quiet),
            Phase::Counting => Bar::share("counting", total, self.quiet),
            Phase::Choosing => Bar::share("choosing the reference's sample", total, self.quiet),
            Phase::Verifying => Bar::share("verifying by the reference", total, self.quiet),
            Phase::Fitting => Bar::share("fitting fragilities", total, self.quiet),
            Phase::Writing => Bar::share("writing", total, self.quiet),
            _ => Bar::new(total, self.quiet),
        };
        self.with(|bar| {
            bar.finish();
            *bar = new;
        });
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        self.clear();
    }
}

fn rate(state: &ProgressState, line: &mut dyn std::fmt::Write) {
    // A line that cannot be written is a bar that is not shown; the run does not depend on it.
    let _ = write!(line, "{:.0} cells/s", state.per_sec());
}
