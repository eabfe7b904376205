//! The motions of the lanes of a vector while they are integrated: their numbers go to their [slots](Slots), some samples
//! at once. To store the numbers of each lane at each sample took as long as the integration.

use super::motions::{DISPLACEMENT, MOST_FIELDS, Slots};
use crate::model::real::{Real, Vector};
use crate::stepping::lanes::each;
use crate::stepping::spans::Direction;

/// The number of rows that are stored at once, one bit of a number each.
const ROWS: usize = 32;

/// The quantities of a sample of each lane, and of the gap that ends there.
pub(crate) type Row<V> = [V; MOST_FIELDS];

/// A bound beyond any acceleration, m/s^2.
pub(crate) const BEYOND: f64 = f32::MAX as f64;

/// Motions that are integrated together, one in each lane.
pub(crate) struct WrittenMotions<'a, 'b, R> {
    direction: Direction,
    forces: bool,
    slots: &'b mut [Slots<'a, R>],
    /// The number of samples of each motion that are stored.
    stored: Vec<usize>,
    /// The rows that are not stored yet: each quantity in a block of its own, row by row and lane by lane.
    blocks: Vec<R>,
    /// The number of these rows, and which of them each lane has, one bit each.
    rows: usize,
    has: Vec<u32>,
    /// The number of lanes of a vector.
    lanes: usize,
}

impl<'a, 'b, R: Real> WrittenMotions<'a, 'b, R> {
    /// Motions at their first samples, which end no gap.
    #[inline(always)]
    pub(crate) fn begin<V: Vector<Element = R>>(
        slots: &'b mut [Slots<'a, R>],
        (direction, forces): (Direction, bool),
        first: &Row<V>,
    ) -> WrittenMotions<'a, 'b, R> {
        let (of_samples, of_gaps) = (direction.of_samples(forces), direction.of_gaps(forces));
        for (lane, slots) in slots.iter_mut().enumerate() {
            for &field in of_samples {
                slots[field][0] = first[field].lane(lane);
            }
        }
        let stored = vec![1; slots.len()];
        let fields = of_samples.len() + of_gaps.len();
        let blocks = vec![R::of(0.0); fields * ROWS * V::LANES];
        let has = vec![0; slots.len()];
        WrittenMotions { direction, forces, slots, stored, blocks, rows: 0, has, lanes: V::LANES }
    }

    /// The quantities of a row: those of samples, and those of gaps.
    #[inline(always)]
    fn quantities(&self) -> [&'static [usize]; 2] {
        [self.direction.of_samples(self.forces), self.direction.of_gaps(self.forces)]
    }

    /// Adds a row to the motions of some lanes, one bit each. No motion is given more rows than it has gaps.
    #[inline(always)]
    pub(crate) fn add<V: Vector<Element = R>>(&mut self, lanes: u64, row: &Row<V>) {
        let [of_samples, of_gaps] = self.quantities();
        let blocks = self.blocks.chunks_exact_mut(ROWS * V::LANES);
        for (block, &field) in blocks.zip(of_samples.iter().chain(of_gaps)) {
            row[field].write(&mut block[self.rows * V::LANES..]);
        }
        for (lane, has) in self.has.iter_mut().enumerate() {
            *has |= ((lanes >> lane & 1) as u32) << self.rows;
        }
        self.rows += 1;
        if self.rows == ROWS {
            self.store();
        }
    }

    /// Stores all rows.
    #[inline(never)]
    fn store(&mut self) {
        let (lanes, [of_samples, of_gaps]) = (self.lanes, self.quantities());
        // Where there is no row, no lane has one.
        let all = u32::MAX >> (ROWS - self.rows.max(1));
        for (lane, slots) in self.slots.iter_mut().enumerate() {
            let has = std::mem::take(&mut self.has[lane]);
            let (added, stored) = (has.count_ones() as usize, self.stored[lane]);
            let of_samples = of_samples.iter().map(|field| (*field, stored));
            // A gap has the number of the sample at its begin.
            let of_gaps = of_gaps.iter().map(|field| (*field, stored - 1));
            let blocks = self.blocks.chunks_exact(ROWS * lanes);
            for (block, (field, from)) in blocks.zip(of_samples.chain(of_gaps)) {
                let to = &mut slots[field][from..from + added];
                if has == all {
                    for (to, row) in to.iter_mut().zip(block.chunks_exact(lanes)) {
                        *to = row[lane];
                    }
                } else {
                    for (to, row) in to.iter_mut().zip(each(has.into())) {
                        *to = block[row * lanes + lane];
                    }
                }
            }
            self.stored[lane] += added;
        }
        self.rows = 0;
    }

    /// Ends the motions. Cells that share a motion that exceeds the range of the number type, which has ended early,
    /// integrate by themselves.
    pub(crate) fn end(mut self) {
        self.store();
        let (direction, beyond) = (self.direction, R::of(BEYOND));
        let [of_samples, _] = self.quantities();
        for (lane, slots) in self.slots.iter_mut().enumerate() {
            let (stored, samples) = (self.stored[lane], slots[DISPLACEMENT].len());
            let gaps = samples - 1;
            for &field in of_samples {
                let last = slots[field][stored - 1];
                slots[field][stored..].fill(last);
            }
            if stored < samples {
                let [lower, upper] = direction.no_bounds();
                for &field in lower {
                    slots[field][..gaps].fill(-beyond);
                }
                for &field in upper {
                    slots[field][..gaps].fill(beyond);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::motions::{
        LOWER, MAGNITUDE, MINUS_LOWER_SO_FAR, UPPER, UPPER_SO_FAR, VELOCITY,
    };
    use super::*;

    /// A number for each quantity of each row.
    fn number(field: usize, row: usize) -> f32 {
        (1000 * field + row) as f32
    }

    /// A motion of u with so many samples after so many rows.
    fn written(samples: usize, rows: usize) -> Vec<Vec<f32>> {
        let direction = Direction::Horizontal;
        let mut motion = vec![vec![0.0_f32; samples]; direction.fields(true)];
        let mut slots = vec![motion.iter_mut().map(|field| &mut field[..]).collect()];
        let row = |row| -> Row<f32> { std::array::from_fn(|field| number(field, row)) };
        let mut written = WrittenMotions::begin(&mut slots, (direction, true), &row(0));
        for number in 1..=rows {
            written.add(1, &row(number));
        }
        written.end();
        motion
    }

    /// Sample k has the numbers of row k, and gap k those of row k + 1.
    #[test]
    fn each_number_goes_to_its_slot() {
        for rows in [0, 1, ROWS - 1, ROWS, ROWS + 1, 3 * ROWS] {
            let motion = written(rows + 1, rows);
            for (field, numbers) in motion.iter().enumerate() {
                let samples = Direction::Horizontal.of_samples(true).contains(&field);
                let (first, count) = if samples { (0, rows + 1) } else { (1, rows) };
                let expected: Vec<f32> = (0..count).map(|k| number(field, first + k)).collect();
                assert_eq!(numbers[..count], expected, "field {field}, {rows} rows");
            }
        }
    }

    /// A motion that ends early bounds nothing: its cells integrate by themselves.
    #[test]
    fn a_motion_that_is_not_shared_has_no_bounds() {
        let beyond = BEYOND as f32;
        for (samples, rows) in [(50, 40), (7, 0)] {
            let (motion, gaps) = (written(samples, rows), samples - 1);
            assert!(motion[LOWER][..gaps].iter().all(|lower| *lower == -beyond));
            for field in [UPPER, UPPER_SO_FAR, MINUS_LOWER_SO_FAR] {
                assert!(motion[field][..gaps].iter().all(|bound| *bound == beyond), "{field}");
            }
            assert_eq!(motion[VELOCITY][samples - 1], number(VELOCITY, rows));
            if rows > 0 {
                assert_eq!(motion[MAGNITUDE][rows - 1], number(MAGNITUDE, rows));
            }
        }
    }
}
