//! The motions of the lanes of a vector while they are integrated: their numbers go to their [places](Places), some samples
//! at once. To store the numbers of each lane at each sample took as long as the integration.

use super::motions::{
    ACCELERATION, BOTTOM, DISPLACEMENT, EIGHTHS_V, LEAST, LEAST_SO_FAR, LOWER, LOWER_SO_FAR,
    MAGNITUDE, MAGNITUDE_SO_FAR, MINUS_LOWER_SO_FAR, MOST_FIELDS, Places, QUARTERS_H, TOP, UPPER,
    UPPER_SO_FAR, VELOCITY, Z,
};
use super::shared_motion::Direction;
use crate::model::real::{Real, Vector};
use crate::stepping::lanes::each;

/// The number of rows that are stored at once, one bit of a number each.
const ROWS: usize = 32;

/// The quantities of a sample of each lane, and of the gap that ends there.
pub(crate) type Row<V> = [V; MOST_FIELDS];

/// A bound beyond any acceleration, m/s^2.
pub(crate) const BEYOND: f64 = f32::MAX as f64;

impl Direction {
    /// The quantities of samples that are kept, with the contact forces or without them.
    fn of_samples(self, forces: bool) -> &'static [usize] {
        match (self, forces) {
            (Direction::Horizontal, _) => &[DISPLACEMENT, VELOCITY, ACCELERATION, TOP, Z],
            (Direction::Vertical, false) => &[DISPLACEMENT, VELOCITY, ACCELERATION, TOP, BOTTOM],
            (Direction::Vertical, true) => {
                &[DISPLACEMENT, VELOCITY, ACCELERATION, TOP, BOTTOM, LEAST_SO_FAR]
            }
        }
    }

    /// The quantities of gaps, likewise.
    fn of_gaps(self, forces: bool) -> &'static [usize] {
        const Q: usize = QUARTERS_H;
        const E: usize = EIGHTHS_V;
        const HORIZONTAL: [usize; 9] = [
            LOWER,
            UPPER,
            UPPER_SO_FAR,
            MINUS_LOWER_SO_FAR,
            MAGNITUDE,
            MAGNITUDE_SO_FAR,
            Q,
            Q + 1,
            Q + 2,
        ];
        const VERTICAL: [usize; 10] =
            [LOWER, LOWER_SO_FAR, LEAST, E, E + 1, E + 2, E + 3, E + 4, E + 5, E + 6];
        match (self, forces) {
            (Direction::Horizontal, false) => &HORIZONTAL[..4],
            (Direction::Horizontal, true) => &HORIZONTAL,
            (Direction::Vertical, false) => &VERTICAL[..2],
            (Direction::Vertical, true) => &VERTICAL,
        }
    }

    /// The number of quantities that are kept of a motion.
    pub(crate) fn fields(self, forces: bool) -> usize {
        self.of_samples(forces).len() + self.of_gaps(forces).len()
    }

    /// The bounds of gaps with which every cell may lift in every gap, and so integrates by itself: lower and upper ones.
    fn no_bounds(self) -> [&'static [usize]; 2] {
        match self {
            Direction::Horizontal => [&[LOWER], &[UPPER, UPPER_SO_FAR, MINUS_LOWER_SO_FAR]],
            Direction::Vertical => [&[LOWER, LOWER_SO_FAR], &[]],
        }
    }
}

/// Motions that are integrated together, one in each lane.
pub(crate) struct WrittenMotions<'a, 'b, R> {
    direction: Direction,
    forces: bool,
    places: &'b mut [Places<'a, R>],
    /// The number of samples of each motion that are stored.
    stored: Vec<usize>,
    /// The quantities of a row: those of samples, and those of gaps.
    of_samples: &'static [usize],
    of_gaps: &'static [usize],
    /// The rows that are not stored yet: each quantity in a block of its own, row by row and lane by lane.
    blocks: Vec<R>,
    /// The number of these rows, and which of them each lane has, one bit each.
    rows: usize,
    has: Vec<u32>,
}

impl<'a, 'b, R: Real> WrittenMotions<'a, 'b, R> {
    /// Motions at their first samples, which end no gap.
    #[inline(always)]
    pub(crate) fn begin<V: Vector<Element = R>>(
        places: &'b mut [Places<'a, R>],
        (direction, forces): (Direction, bool),
        first: &Row<V>,
    ) -> WrittenMotions<'a, 'b, R> {
        let (of_samples, of_gaps) = (direction.of_samples(forces), direction.of_gaps(forces));
        for (lane, places) in places.iter_mut().enumerate() {
            for &field in of_samples {
                places[field][0] = first[field].lane(lane);
            }
        }
        let stored = vec![1; places.len()];
        let fields = of_samples.len() + of_gaps.len();
        let blocks = vec![R::of(0.0); fields * ROWS * V::LANES];
        let has = vec![0; places.len()];
        WrittenMotions {
            direction,
            forces,
            places,
            stored,
            of_samples,
            of_gaps,
            blocks,
            rows: 0,
            has,
        }
    }

    /// Adds a row to the motions of some lanes, one bit each.
    #[inline(always)]
    pub(crate) fn add<V: Vector<Element = R>>(&mut self, lanes: u64, row: &Row<V>) {
        let blocks = self.blocks.chunks_exact_mut(ROWS * V::LANES);
        for (block, &field) in blocks.zip(self.of_samples.iter().chain(self.of_gaps)) {
            row[field].write(&mut block[self.rows * V::LANES..]);
        }
        for (lane, has) in self.has.iter_mut().enumerate() {
            *has |= ((lanes >> lane & 1) as u32) << self.rows;
        }
        self.rows += 1;
        if self.rows == ROWS {
            self.store(V::LANES);
        }
    }

    /// Stores all rows, of vectors of so many lanes.
    #[inline(never)]
    fn store(&mut self, vector: usize) {
        let all = u32::MAX >> (ROWS - self.rows.max(1));
        for (lane, places) in self.places.iter_mut().enumerate() {
            let has = std::mem::take(&mut self.has[lane]);
            let (added, stored) = (has.count_ones() as usize, self.stored[lane]);
            let of_samples = self.of_samples.iter().map(|field| (*field, stored));
            // A gap has the number of the sample at its begin.
            let of_gaps = self.of_gaps.iter().map(|field| (*field, stored - 1));
            let blocks = self.blocks.chunks_exact(ROWS * vector);
            for (block, (field, from)) in blocks.zip(of_samples.chain(of_gaps)) {
                let to = &mut places[field][from..from + added];
                if has == all {
                    for (to, row) in to.iter_mut().zip(block.chunks_exact(vector)) {
                        *to = row[lane];
                    }
                } else {
                    for (to, row) in to.iter_mut().zip(each(has.into())) {
                        *to = block[row * vector + lane];
                    }
                }
            }
            self.stored[lane] += added;
        }
        self.rows = 0;
    }

    /// Ends the motions. Cells that share one for which `missed` is true integrate by themselves, and so do those that
    /// share a motion that exceeds the range of the number type, which has ended early. `missed` is given the number of the
    /// motion and its largest |X|.
    pub(crate) fn end(mut self, vector: usize, missed: impl Fn(usize, R) -> bool) {
        self.store(vector);
        let (direction, beyond) = (self.direction, R::of(BEYOND));
        for (lane, places) in self.places.iter_mut().enumerate() {
            let (stored, samples) = (self.stored[lane], places[DISPLACEMENT].len());
            let gaps = samples - 1;
            for &field in self.of_samples {
                let last = places[field][stored - 1];
                places[field][stored..].fill(last);
            }
            let magnitude = match direction {
                Direction::Horizontal if self.forces && stored > 1 => {
                    places[MAGNITUDE_SO_FAR][stored - 2]
                }
                _ => R::of(0.0),
            };
            if stored < samples || missed(lane, magnitude) {
                let [lower, upper] = direction.no_bounds();
                for &field in lower {
                    places[field][..gaps].fill(-beyond);
                }
                for &field in upper {
                    places[field][..gaps].fill(beyond);
                }
            }
        }
    }
}
