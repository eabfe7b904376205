//! Rows of several numbers: as many in each, times among them, or values that run on from row to row.

use crate::times::Times;

/// Part of the change from row to row below which values that follow each other in a row change, where they run on.
const RUN_ON: f64 = 0.8;

/// Most that the change from row to row and that within a row are apart, where values run on.
const BETWEEN: f64 = 2.0;

/// The rows: as many numbers in each, but for the last one, which may have fewer.
pub(super) struct Table {
    pub width: usize,
    pub values: Vec<f64>,
    /// The first two columns, which may be times.
    pub times: [Times; 2],
    /// The line of the first row, and of one that has fewer numbers.
    pub first: usize,
    pub short: Option<usize>,
}

impl Table {
    pub fn column(&self, column: usize) -> impl Iterator<Item = f64> {
        self.values.iter().skip(column).step_by(self.width).copied()
    }

    /// True where each number of a column is above the one before it.
    pub fn grows(&self, column: usize) -> bool {
        self.column(column).is_sorted_by(|before, next| before < next)
    }

    /// True where a column counts the rows.
    pub fn counts(&self, column: usize) -> bool {
        self.column(column).is_sorted_by(|before, next| next - before == 1.0)
    }

    /// True of values that run on from row to row: a motion changes less from one sample to the next than over a row, and
    /// no more from a row's last to the next one's first.
    pub fn runs_on(&self) -> bool {
        let apart = |apart: usize, counts: &dyn Fn(usize) -> bool| {
            let pairs = self.values.iter().zip(self.values.iter().skip(apart)).enumerate();
            let changes = pairs.filter(|(at, _)| counts(*at)).map(|(_, (a, b))| (b - a).abs());
            let (sum, count) =
                changes.fold((0.0, 0), |(sum, count), change| (sum + change, count + 1));
            sum / f64::from(count.max(1))
        };
        let ends = |at: usize| at % self.width + 1 == self.width;
        let (within, between) = (apart(1, &|at| !ends(at)), apart(1, &ends));
        within < RUN_ON * apart(self.width, &|_| true)
            && between < BETWEEN * within
            && within < BETWEEN * between
    }
}
