//! The steps of a gap between two samples, and where in them the parts end in which a motion's forces are kept.

use crate::model::real::{Real, Vector};

/// Steps of a gap from which on eighths of it are taken from them; with fewer, its quarters tell them.
const STEPS_FOR_EIGHTHS: u32 = 8;

/// Ends of parts of gaps in one step, at most one of each lane.
pub struct PartEnds<V: Vector> {
    /// The part's number, from the gap's start, for each lane.
    pub numbers: Vec<usize>,
    /// Lanes that have one.
    pub lanes: V::Mask,
    /// At the start of the step, or halfway.
    pub at_start: V::Mask,
    pub halfway: V::Mask,
    /// How much of the step is before it.
    pub fraction: V,
}

/// A step of gaps.
pub struct GapStep<V: Vector> {
    /// Lanes that have so many steps to a gap, a bit each.
    pub lanes: u64,
    /// The ends of parts in it.
    pub ends: Vec<PartEnds<V>>,
}

/// The end of a part in one lane's step.
#[derive(Clone, Copy)]
struct PartEnd {
    number: u32,
    /// How much of the step is before it, in as many parts as a gap has.
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

/// Lanes, a bit each, of whose parts only every other end is taken from the steps.
pub fn by_quarters(parts: u32, substeps: &[u32]) -> u64 {
    let lanes = substeps.iter().enumerate();
    lanes
        .fold(0, |all, (lane, &substeps)| all | u64::from(parts_apart(parts, substeps) > 1) << lane)
}

/// From one part whose end is taken from the steps to the next. With few steps to a gap every other part is told by those
/// beside it.
fn parts_apart(parts: u32, substeps: u32) -> u32 {
    if substeps < STEPS_FOR_EIGHTHS { parts / 4 } else { 1 }
}
