//! The steps of a gap between two samples, and the places in them where those parts end in which the forces of a
//! motion are kept.

use crate::model::real::{Real, Vector};

/// The fewest steps of a gap for which the values at its eighths are taken from the steps; with fewer steps they are
/// interpolated from its quarters.
const STEPS_FOR_EIGHTHS: u32 = 8;

/// Ends of parts of gaps in one step, at most one in each lane.
pub struct PartEnds<V: Vector> {
    /// The part's number, from the gap's start, for each lane.
    pub numbers: Vec<usize>,
    /// The lanes that have such an end.
    pub lanes: V::Mask,
    /// The lanes whose end is at the start of the step, and those whose end is halfway.
    pub at_start: V::Mask,
    pub halfway: V::Mask,
    /// The fraction of the step before the end.
    pub fraction: V,
}

/// A step of gaps.
pub struct GapStep<V: Vector> {
    /// The lanes that have at least so many steps in a gap, one bit for each lane.
    pub lanes: u64,
    /// The ends of parts in it.
    pub ends: Vec<PartEnds<V>>,
}

/// The end of a part in one lane's step.
#[derive(Clone, Copy)]
struct PartEnd {
    number: u32,
    /// The fraction of the step before the end, in units of one over the parts of a gap.
    rest: u32,
}

/// The ends of parts in a step of gaps of a given number of steps.
fn in_step(parts: u32, substeps: u32, step: u32) -> impl Iterator<Item = PartEnd> {
    let apart = parts_apart(parts, substeps);
    let numbers = (apart..parts).step_by(apart as usize);
    let here = numbers.filter(move |number| number * substeps / parts == step);
    here.map(move |number| PartEnd { number, rest: number * substeps % parts })
}

impl<V: Vector> PartEnds<V> {
    fn none(zero: V) -> PartEnds<V> {
        let none = zero.mask(0);
        let numbers = vec![0; V::LANES];
        PartEnds { numbers, lanes: none, at_start: none, halfway: none, fraction: zero }
    }

    fn put(&mut self, lane: usize, parts: u32, PartEnd { number, rest }: PartEnd) {
        let bit = self.fraction.mask(1 << lane);
        self.numbers[lane] = number as usize;
        self.lanes = self.lanes | bit;
        if rest == 0 {
            self.at_start = self.at_start | bit;
        }
        if 2 * rest == parts {
            self.halfway = self.halfway | bit;
        }
        self.fraction.put(lane, V::Element::of(f64::from(rest) / f64::from(parts)));
    }
}

/// The steps of gaps whose parts are `parts`, and whose steps in each lane are `substeps`.
pub fn gap_steps<V: Vector>(parts: u32, substeps: &[u32], zero: V) -> Vec<GapStep<V>> {
    let most = substeps.iter().copied().max().unwrap_or(0);
    let step = |step: u32| {
        let mut found = GapStep { lanes: 0, ends: Vec::new() };
        for (lane, &substeps) in substeps.iter().enumerate() {
            found.lanes |= u64::from(step < substeps) << lane;
            for (number, end) in in_step(parts, substeps, step).enumerate() {
                if number == found.ends.len() {
                    found.ends.push(PartEnds::none(zero));
                }
                found.ends[number].put(lane, parts, end);
            }
        }
        found
    };
    (0..most).map(step).collect()
}

/// The lanes, one bit each, in which only every other end of a part is taken from the steps.
pub fn by_quarters(parts: u32, substeps: &[u32]) -> u64 {
    let lanes = substeps.iter().enumerate();
    lanes
        .fold(0, |all, (lane, &substeps)| all | u64::from(parts_apart(parts, substeps) > 1) << lane)
}

/// The number of parts from one end that is taken from the steps to the next. With few steps in a gap every other
/// part is interpolated from its neighbours.
fn parts_apart(parts: u32, substeps: u32) -> u32 {
    if substeps < STEPS_FOR_EIGHTHS { parts / 4 } else { 1 }
}
