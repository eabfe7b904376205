//! The size of the next submission to a device, from the time that earlier ones took.

use std::time::Duration;

/// What a submission may take: well below the two seconds after which a desktop driver ends it, and
/// long against the time that it takes to submit one.
const LONGEST: Duration = Duration::from_millis(100);
/// Turns of a cell in the first submission to a device that nothing is known of.
const FIRST_WORK: u32 = 16;
/// The same in the longest one: a small share of a long cell's, so that the host hears in time of
/// room for new cells.
const MOST_WORK: f64 = 512.0;
/// Turns of a cell in a dispatch, after which the list of running cells is made anew. More leave threads
/// without a cell; fewer move states for nothing. Drivers bound the iterations of a shader's loops,
/// the software one silently at 65,535 for all loops together.
pub const DISPATCH_TURNS: u32 = 128;
/// Cells of the first tile on a device that nothing is known of.
const FIRST_TILE: f64 = 32_768.0;
/// Cells of a tile at least.
const LEAST_TILE: f64 = 8_192.0;
/// What a dispatch of two whole tiles may take.
const DISPATCH_TIME: Duration = Duration::from_millis(50);

/// How much a device is given at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Turns of a cell in a submission.
    work: f64,
    /// Cells of a tile.
    tile: f64,
}

impl Default for Pace {
    fn default() -> Pace {
        Pace { work: f64::from(FIRST_WORK), tile: FIRST_TILE }
    }
}

impl Pace {
    /// Dispatches of the next submission, and turns of a cell in each.
    pub fn dispatches(&self) -> (u32, u32) {
        // Between one and the most.
        let work = self.work as u32;
        let dispatches = work.div_ceil(DISPATCH_TURNS);
        (dispatches, work / dispatches)
    }

    /// Cells of the next tile.
    pub fn tile(&self) -> usize {
        self.tile as usize
    }

    /// Learns what so many turns of at most a given number of cells took, by the host's clock and by the
    /// device's. The longer one counts: a device's clock that stands still must not let work grow
    /// past what a driver allows.
    pub fn learn(&mut self, work: u32, cells: usize, host: Duration, device: Option<Duration>) {
        let took = host.max(device.unwrap_or_default()).as_secs_f64().max(1.0e-6);
        let work = f64::from(work);
        let ratio = LONGEST.as_secs_f64() / took;
        self.work = (work * ratio.clamp(0.25, 4.0)).clamp(1.0, MOST_WORK);
        // A device with few cells does not show how many it could have.
        if cells as f64 >= 0.5 * self.tile {
            let rate = work * cells as f64 / took;
            let most = rate * DISPATCH_TIME.as_secs_f64() / (2.0 * f64::from(DISPATCH_TURNS));
            let ratio = (most / self.tile).clamp(0.25, 4.0);
            self.tile = (self.tile * ratio).max(LEAST_TILE);
        }
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
                pace.learn(256, 1 << 18, host * MILLI, device.map(|device| device * MILLI));
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
        let after = |steps_a_second: f64| {
            let mut pace = Pace::default();
            for _ in 0..20 {
                let (dispatches, work) = pace.dispatches();
                let cells = 2 * pace.tile();
                let took = f64::from(dispatches * work) * cells as f64 / steps_a_second;
                pace.learn(dispatches * work, cells, Duration::from_secs_f64(took), None);
            }
            (pace.dispatches(), pace.tile())
        };
        // Tiles grow until a dispatch of two of them takes its time; as many dispatches fill a submission.
        let (dispatches, tile) = after(1.0e11);
        let fill = (LONGEST.as_secs_f64() / DISPATCH_TIME.as_secs_f64()) as u32;
        assert_eq!(dispatches, (fill, DISPATCH_TURNS));
        assert!(tile > 1 << 18);
        // A million steps a second: one dispatch would take two seconds.
        let ((dispatches, work), tile) = after(1.0e6);
        assert_eq!((dispatches, tile), (1, 8192));
        assert!((1..8).contains(&work));
    }
}
