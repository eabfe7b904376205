//! Full-contact motions in one array: quantity by quantity, in each quantity motion by motion, in each
//! motion sample by sample. A device has the same array (`shaders/shared_contact.wgsl`): there
//! neighbouring cells read neighbouring numbers.

use fearless_simd::Level;

use crate::cells::listing::Entries;
use crate::model::excitation::Ground;
use crate::model::isolation::Variant;
use crate::model::motion::Motion;
use crate::model::real::Real;
use crate::stepping::spans::Direction;
use crate::stepping::state::State;

/// u or v at each sample, m.
pub const DISPLACEMENT: usize = 0;
/// Its rate, m/s.
pub const VELOCITY: usize = 1;
/// X or Y of (14), m/s^2.
pub const ACCELERATION: usize = 2;
/// Lower bound of the acceleration between each sample and the next.
pub const LOWER: usize = 3;
/// Largest |u|, or largest v, up to each sample, m.
pub const TOP: usize = 4;

/// Of u: z.
pub const Z: usize = 5;
/// Of u: upper bound of the acceleration between each sample and the next.
pub const UPPER: usize = 6;
/// Of u: largest upper bound up to and with each gap.
pub const UPPER_SO_FAR: usize = 7;
/// Of u: largest negative of the lower bound, up to and with each gap.
pub const MINUS_LOWER_SO_FAR: usize = 8;
/// Of u: largest magnitude of the acceleration up to and with each gap. This quantity and those after it are kept only
/// where contact forces are requested.
pub const MAGNITUDE_SO_FAR: usize = 9;
/// Of u: largest magnitude of the acceleration between each sample and the next, crests between steps included.
pub const MAGNITUDE: usize = 10;

/// Of v: least v up to each sample, m.
pub const BOTTOM: usize = 5;
/// Of v: least lower bound up to and with each gap.
pub const LOWER_SO_FAR: usize = 6;
/// Of v: least acceleration up to each sample. This quantity and those after it are kept only where contact forces are
/// requested.
pub const LEAST_SO_FAR: usize = 7;
/// Of v: least acceleration between each sample and the next, crests between steps included.
pub const LEAST: usize = 8;

/// The most quantities of a motion.
pub const MOST_FIELDS: usize = 11;

impl Direction {
    /// The quantities of samples that are kept, with the contact forces or without them.
    pub(crate) fn of_samples(self, forces: bool) -> &'static [usize] {
        match (self, forces) {
            (Direction::Horizontal, _) => &[DISPLACEMENT, VELOCITY, ACCELERATION, TOP, Z],
            (Direction::Vertical, false) => &[DISPLACEMENT, VELOCITY, ACCELERATION, TOP, BOTTOM],
            (Direction::Vertical, true) => {
                &[DISPLACEMENT, VELOCITY, ACCELERATION, TOP, BOTTOM, LEAST_SO_FAR]
            }
        }
    }

    /// The quantities of gaps, likewise.
    pub(crate) fn of_gaps(self, forces: bool) -> &'static [usize] {
        const HORIZONTAL: [usize; 6] =
            [LOWER, UPPER, UPPER_SO_FAR, MINUS_LOWER_SO_FAR, MAGNITUDE, MAGNITUDE_SO_FAR];
        const VERTICAL: [usize; 3] = [LOWER, LOWER_SO_FAR, LEAST];
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
    pub(crate) fn no_bounds(self) -> [&'static [usize]; 2] {
        match self {
            Direction::Horizontal => [&[LOWER], &[UPPER, UPPER_SO_FAR, MINUS_LOWER_SO_FAR]],
            Direction::Vertical => [&[LOWER, LOWER_SO_FAR], &[]],
        }
    }
}

/// The slots of a motion's numbers, one slice for each quantity.
pub(crate) type Slots<'a, R> = Vec<&'a mut [R]>;

/// The motions of one direction.
#[derive(Debug)]
pub struct Motions<R> {
    /// All numbers.
    pub values: Vec<R>,
    /// The number of the first sample of each motion, and the end of the last motion.
    pub first: Vec<u32>,
    /// The combinations of values that have a motion.
    pub entries: Entries,
}

impl<R: Real> Motions<R> {
    /// Zeros for motions of these lengths.
    pub fn new(
        fields: usize,
        lengths: impl Iterator<Item = usize>,
        entries: Entries,
    ) -> Motions<R> {
        let mut first = vec![0];
        let mut samples = 0;
        for length in lengths {
            samples += length;
            // The memory limit keeps the samples below 2^32.
            first.push(samples as u32);
        }
        Motions { values: vec![R::of(0.0); fields * samples], first, entries }
    }

    /// Samples of all motions.
    pub fn samples(&self) -> usize {
        self.first.last().map_or(0, |samples| *samples as usize)
    }

    /// Samples of the longest motion.
    pub fn longest(&self) -> usize {
        self.first.windows(2).map(|ends| (ends[1] - ends[0]) as usize).max().unwrap_or(0)
    }

    /// The slots of each motion.
    pub(crate) fn slots(&mut self) -> Vec<Slots<'_, R>> {
        let lengths = self.first.windows(2).map(|ends| (ends[1] - ends[0]) as usize);
        let lengths: Vec<usize> = lengths.collect();
        let mut slots: Vec<Slots<R>> =
            lengths.iter().map(|_| Vec::with_capacity(MOST_FIELDS)).collect();
        // Without a motion there are no numbers.
        let samples = self.samples().max(1);
        for mut rest in self.values.chunks_mut(samples) {
            for (slots, length) in slots.iter_mut().zip(&lengths) {
                let (of_this, others) = rest.split_at_mut(*length);
                slots.push(of_this);
                rest = others;
            }
        }
        slots
    }

    /// A motion, by its number.
    #[inline(always)]
    pub fn at(&self, number: usize) -> MotionSlice<'_, R> {
        let (first, end) = (self.first[number] as usize, self.first[number + 1] as usize);
        MotionSlice { values: &self.values[first..], samples: self.samples(), length: end - first }
    }
}

/// One motion.
#[derive(Clone, Copy)]
pub struct MotionSlice<'a, R> {
    /// The numbers from its first sample on.
    values: &'a [R],
    /// Samples of all motions.
    samples: usize,
    /// Samples of this one.
    pub length: usize,
}

impl<'a, R> MotionSlice<'a, R> {
    /// The gap that corresponds to a gap of the motion of the other direction: the last one where this motion is
    /// shorter.
    #[inline(always)]
    pub fn gap(&self, other: usize) -> usize {
        // The last sample ends no gap.
        other.min(self.length.saturating_sub(2))
    }

    /// A quantity at the samples of the motion.
    #[inline(always)]
    pub fn field(&self, field: usize) -> &'a [R] {
        let start = field * self.samples;
        &self.values[start..start + self.length]
    }
}

/// The two motions of a cell.
#[derive(Clone, Copy)]
pub struct MotionPair<'a, R> {
    /// The motion of u.
    pub across: MotionSlice<'a, R>,
    /// The motion of v.
    pub up: MotionSlice<'a, R>,
    /// The base does not move vertically before the block lifts.
    pub still: bool,
    /// The variant of the model that the cells of this pair have.
    pub variant: Variant,
    /// The record.
    pub record: &'a [Ground<R>],
    /// The vector instructions of this machine.
    pub level: Level,
}

impl<R: Real> MotionPair<'_, R> {
    /// The motion at a sample, and the largest displacements up to it.
    #[inline(always)]
    pub(crate) fn move_to(&self, scale: R, sample: usize, state: &mut State<R>) {
        let (h, v, zero) = (self.across, self.up, R::of(0.0));
        // A motion of v at rest may be shorter: it stays as it is at its last sample.
        let at = sample.min(v.length - 1);
        let z = h.field(Z)[sample];
        state.motion = Motion {
            u: scale * h.field(DISPLACEMENT)[sample],
            du: scale * h.field(VELOCITY)[sample],
            v: v.field(DISPLACEMENT)[at],
            dv: v.field(VELOCITY)[at],
            z: if scale < zero { -z } else { z },
            phi: zero,
            dphi: zero,
        };
        state.extremes.max_u = scale.abs() * h.field(TOP)[sample];
        state.extremes.least_v = v.field(BOTTOM)[at];
        state.extremes.most_v = v.field(TOP)[at];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The quantities of a motion have the numbers from zero on.
    #[test]
    fn no_quantity_is_left_out() {
        for direction in [Direction::Horizontal, Direction::Vertical] {
            for forces in [false, true] {
                let fields = [direction.of_samples(forces), direction.of_gaps(forces)];
                let mut fields = fields.concat();
                fields.sort_unstable();
                let count = direction.fields(forces);
                assert_eq!(fields, (0..count).collect::<Vec<usize>>(), "{direction:?} {forces}");
                assert!(count <= MOST_FIELDS);
            }
        }
    }
}
