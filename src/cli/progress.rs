//! The progress bar.

use std::borrow::Cow;
use std::io;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use topple::map::columns::Column;
use topple::map::outcomes::Outcomes;
use topple::stepping::outcome::Outcome;

/// A run that is over sooner shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// What is left is told in cells and their rate, or in a word.
const CELLS: &str = "{bar:32} {percent:>3} %  {human_pos} of {human_len} cells  {rate}  {eta} left";

/// A bar with cells a second and time left, on a terminal only.
pub struct Progress {
    bar: ProgressBar,
    began: Instant,
    shown: AtomicBool,
}

impl Progress {
    /// A bar for `cells` cells; `quiet` shows none.
    pub fn new(cells: usize, quiet: bool) -> Progress {
        Progress::styled(CELLS, cells, quiet)
    }

    /// A count of cells that are found whole on disk, of as many as there are.
    pub fn checking(quiet: bool) -> Progress {
        Progress::styled("{human_pos} cells checked", 0, quiet)
    }

    fn styled(template: &str, total: usize, quiet: bool) -> Progress {
        let bar = ProgressBar::with_draw_target(Some(total as u64), ProgressDrawTarget::hidden());
        // Templates are constants; a mistake in one would show as the library's default bar.
        if let Ok(style) = ProgressStyle::with_template(template) {
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

/// Outcomes whose reading shows how far the work on them is.
pub struct Watched<'a> {
    outcomes: &'a dyn Outcomes,
    progress: Progress,
}

impl<'a> Watched<'a> {
    /// Outcomes of so many cells, of which so many columns will be read; `doing` says what for.
    pub fn new(
        outcomes: &'a dyn Outcomes,
        doing: &str,
        cells: usize,
        columns: usize,
        quiet: bool,
    ) -> Watched<'a> {
        let template = format!("{{bar:32}} {{percent:>3}} %  {doing}  {{eta}} left");
        let progress = Progress::styled(&template, cells.saturating_mul(columns), quiet);
        Watched { outcomes, progress }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.progress.finish();
    }
}

impl Outcomes for Watched<'_> {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        self.progress.advance(cells.len() * columns.len());
        self.outcomes.read(cells, columns)
    }
}

fn rate(state: &ProgressState, line: &mut dyn std::fmt::Write) {
    // A line that cannot be written is a bar that is not shown; the run does not depend on it.
    let _ = write!(line, "{:.0} cells/s", state.per_sec());
}
