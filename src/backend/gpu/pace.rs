//! The size of the next submission to a device, from the times of earlier ones.

use std::time::Duration;

/// The longest time of a submission: well below the two seconds after which a desktop driver ends it, and much longer
/// than the time to submit one.
const LONGEST: Duration = Duration::from_millis(100);
/// The turns of a cell in the first submission to a device about which nothing is known, and the cells for which that is so.
const FIRST_WORK: u32 = 16;
const FIRST_CELLS: usize = 1 << 18;
/// The turns of a cell in the longest submission: a small share of those of a long cell, so that the host knows in
/// time that there is room for new cells.
const MOST_WORK: f64 = 512.0;
/// The turns of a cell in a dispatch, after which the list of running cells is made again. With more turns threads
/// are without a cell for longer; with fewer, states are moved more often than necessary. Drivers limit the
/// iterations of the loops of a shader, the software driver silently at 65,535 for all loops together.
pub const DISPATCH_TURNS: u32 = 128;

/// The amount of work that a device is given at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// The turns of a cell in a submission.
    work: f64,
    /// The cells that had this work.
    cells: usize,
}

impl Default for Pace {
    fn default() -> Pace {
        Pace { work: f64::from(FIRST_WORK), cells: FIRST_CELLS }
    }
}

impl Pace {
    /// The dispatches of the next submission of at most so many running cells, and the turns of a cell in each. More cells
    /// than the work was learned with may take as much longer.
    pub fn dispatches(&self, cells: usize) -> (u32, u32) {
        let share = (self.cells as f64 / cells.max(1) as f64).min(1.0);
        // The value lies between one and the largest work.
        let work = ((self.work * share) as u32).max(1);
        let dispatches = work.div_ceil(DISPATCH_TURNS);
        (dispatches, work / dispatches)
    }

    /// Records the time that a number of turns of at most so many cells took, by the clock of the host and by that of the
    /// device. The longer time counts: if the clock of a device stands still, the work must not grow
    /// beyond the limit of a driver.
    pub fn learn(&mut self, work: u32, cells: usize, host: Duration, device: Option<Duration>) {
        let took = host.max(device.unwrap_or_default()).as_secs_f64().max(1.0e-6);
        let ratio = LONGEST.as_secs_f64() / took;
        self.work = (f64::from(work) * ratio.clamp(0.25, 4.0)).clamp(1.0, MOST_WORK);
        self.cells = cells;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MILLI: Duration = Duration::from_millis(1);
    const CELLS: usize = 1000;

    #[test]
    fn a_clock_that_stands_still_does_not_let_work_grow() {
        for (host, device) in [(150, Some(0)), (150, None), (0, Some(150)), (150, Some(150))] {
            let mut pace = Pace::default();
            for _ in 0..20 {
                pace.learn(256, 1 << 18, host * MILLI, device.map(|device| device * MILLI));
            }
            let (dispatches, work) = pace.dispatches(1 << 18);
            assert!(
                dispatches * work < 256,
                "{host} ms, {device:?} ms: {dispatches} dispatches of {work}"
            );
        }
    }

    #[test]
    fn a_fast_device_is_given_much_and_a_slow_one_little() {
        let after = |turns_a_second: f64| {
            let mut pace = Pace::default();
            for _ in 0..20 {
                let (dispatches, work) = pace.dispatches(CELLS);
                let took = f64::from(dispatches * work) / turns_a_second;
                pace.learn(dispatches * work, CELLS, Duration::from_secs_f64(took), None);
            }
            pace
        };
        let of = |turns_a_second: f64| after(turns_a_second).dispatches(CELLS);
        assert_eq!(of(1.0e5), (MOST_WORK as u32 / DISPATCH_TURNS, DISPATCH_TURNS));
        // With a tenth of a second for a turn a submission has one.
        assert_eq!(of(10.0), (1, 1));
        assert_eq!(of(100.0), (1, 10));
        // A tile joins a few long cells: the same number of turns of all cells together.
        assert_eq!(after(1.0e5).dispatches(64 * CELLS), (1, MOST_WORK as u32 / 64));
    }
}
