//! The size of the next submission to a device, from the times of earlier ones.

use std::time::Duration;

/// The longest time of a submission: well below the two seconds after which a desktop driver ends it, and much longer
/// than the time to submit one.
const LONGEST: Duration = Duration::from_millis(100);
/// The turns of a cell in the first submission to a device about which nothing is known.
const FIRST_WORK: u32 = 16;
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
}

impl Default for Pace {
    fn default() -> Pace {
        Pace { work: f64::from(FIRST_WORK) }
    }
}

impl Pace {
    /// The dispatches of the next submission, and the turns of a cell in each.
    pub fn dispatches(&self) -> (u32, u32) {
        // The value lies between one and the largest work.
        let work = self.work as u32;
        let dispatches = work.div_ceil(DISPATCH_TURNS);
        (dispatches, work / dispatches)
    }

    /// Records the time that a number of turns took, by the clock of the host and by that of the device. The longer time counts: if the clock of a device stands still, the work must not grow
    /// beyond the limit of a driver.
    pub fn learn(&mut self, work: u32, host: Duration, device: Option<Duration>) {
        let took = host.max(device.unwrap_or_default()).as_secs_f64().max(1.0e-6);
        let ratio = LONGEST.as_secs_f64() / took;
        self.work = (f64::from(work) * ratio.clamp(0.25, 4.0)).clamp(1.0, MOST_WORK);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MILLI: Duration = Duration::from_millis(1);

    #[test]
    fn a_clock_that_stands_still_does_not_let_work_grow() {
        for (host, device) in [(150, Some(0)), (150, None), (0, Some(150)), (150, Some(150))] {
            let mut pace = Pace::default();
            for _ in 0..20 {
                pace.learn(256, host * MILLI, device.map(|device| device * MILLI));
            }
            let (dispatches, work) = pace.dispatches();
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
                let (dispatches, work) = pace.dispatches();
                let took = f64::from(dispatches * work) / turns_a_second;
                pace.learn(dispatches * work, Duration::from_secs_f64(took), None);
            }
            pace.dispatches()
        };
        assert_eq!(after(1.0e5), (MOST_WORK as u32 / DISPATCH_TURNS, DISPATCH_TURNS));
        // With a tenth of a second for a turn a submission has one.
        assert_eq!(after(10.0), (1, 1));
        assert_eq!(after(100.0), (1, 10));
    }
}
