//! The motion of the ground under each lane, one forcing segment at a time: steps of equal length under a ground
//! motion of one form (the pulse, a gap between two samples of a record, or rest). Twin of `shaders/forcing.wgsl`.

use crate::model::CellEquations;
use crate::model::excitation::{Cell, Ground};
use crate::model::isolation::Variant;
use crate::model::number::Number;
use crate::model::pulse::wave;
use crate::model::real::{Real, Vector};

/// The most steps of a segment: the number type holds this number of steps without loss, with room for a fraction.
pub const MOST_STEPS: u32 = 1 << 20;

/// The forcing segment of each lane.
pub struct Forcing<V> {
    /// The length of a step, s.
    pub step: V,
    /// The number of steps done.
    pub done: V,
    /// The number of steps in all.
    pub steps: V,
    /// The phase at which the segment begins: periods of the pulse, zero for a record.
    phase_start: V,
    /// The periods of the pulse, or the gaps between samples of the record, in one step; zero without excitation.
    phase_step: V,
    /// The amplitudes of the pulse, or the sample of the record at the start of the gap; zero without excitation.
    base: Ground<V>,
    /// The difference between the samples at the end and at the start of the gap.
    rise: Ground<V>,
    /// The lanes under excitation, one bit each.
    pub forced: u64,
    /// The sample of the record at the end of the gap, and the one at the end of the next gap. The latter is read
    /// while the gap before runs, so that lanes change to it without a wait for single numbers to be put into a
    /// vector. A thread of the shader reads a gap when the gap begins.
    after: Ground<V>,
    next: Ground<V>,
    /// The lanes that have a next gap, one bit each.
    pub fetched: u64,
}

impl<V: Vector> Forcing<V> {
    /// No segment in any lane.
    #[inline(always)]
    pub fn new(zero: V) -> Forcing<V> {
        let ground = Ground { h: zero, v: zero };
        Forcing {
            step: zero,
            done: zero,
            steps: zero.like(1.0),
            phase_start: zero,
            phase_step: zero,
            base: ground,
            rise: ground,
            forced: 0,
            after: ground,
            next: ground,
            fetched: 0,
        }
    }

    /// The acceleration of the ground at a fraction of the step of each lane: the pulse (22), or the record, linear
    /// between its samples.
    #[inline(always)]
    pub fn ground(&self, variant: Variant, cell: &Cell<V>, fraction: V) -> Ground<V> {
        let zero = fraction.like(0.0);
        if self.forced == 0 {
            return Ground { h: zero, v: zero };
        }
        let phase = self.phase_start + (self.done + fraction) * self.phase_step;
        if variant.recorded {
            return Ground {
                h: self.base.h + phase * self.rise.h,
                v: self.base.v + phase * self.rise.v,
            };
        }
        let wave = wave((variant.pulse, variant.cycles), cell, phase);
        Ground { h: self.base.h * wave, v: self.base.v * wave }
    }

    /// Puts lanes, each of which has a next gap, on this gap.
    #[inline(always)]
    pub fn follow(&mut self, lanes: V::Mask, cell: &Cell<V>) {
        let (base, rise) = gap(cell, self.after, self.next);
        self.base.h = V::select(lanes, base.h, self.base.h);
        self.base.v = V::select(lanes, base.v, self.base.v);
        self.rise.h = V::select(lanes, rise.h, self.rise.h);
        self.rise.v = V::select(lanes, rise.v, self.rise.v);
        self.after.h = V::select(lanes, self.next.h, self.after.h);
        self.after.v = V::select(lanes, self.next.v, self.after.v);
        self.done = V::select(lanes, self.done.like(0.0), self.done);
    }

    /// Reads the next gap of a lane, from `sample` on, if its record has one there.
    #[inline(always)]
    pub fn fetch(
        &mut self,
        lane: usize,
        cell: &Cell<V::Element>,
        record: &[Ground<V::Element>],
        sample: u32,
    ) {
        if sample * cell.steps.substeps >= cell.steps.steps_forced.min(cell.steps.steps) {
            self.fetched &= !(1 << lane);
            return;
        }
        put(&mut self.next, lane, record[sample as usize + 1]);
        self.fetched |= 1 << lane;
    }

    /// Puts a lane on the segment in which its cell is after `step` steps, fewer than it has in all. The result is
    /// the first step of the segment. `follows`: the segment before belongs to the same cell.
    #[inline(always)]
    pub fn begin(
        &mut self,
        lane: usize,
        set: &CellEquations<V::Element>,
        step: u32,
        follows: bool,
    ) -> u32 {
        let cell = set.cell;
        let zero = V::Element::of(0.0);
        let bit = 1 << lane;
        self.fetched &= !bit;
        if step >= cell.steps.steps_forced {
            self.forced &= !bit;
            self.step.put(lane, cell.steps.step_free);
            self.done.put(lane, zero);
            let steps = (cell.steps.steps - step).min(MOST_STEPS);
            self.steps.put(lane, V::Element::of(f64::from(steps)));
            self.phase_start.put(lane, zero);
            self.phase_step.put(lane, zero);
            self.base.h.put(lane, zero);
            self.base.v.put(lane, zero);
            self.rise.h.put(lane, zero);
            self.rise.v.put(lane, zero);
            return step;
        }
        let first;
        let steps;
        if set.variant.recorded {
            let sample = step / cell.steps.substeps;
            let (before, after) = (set.record[sample as usize], set.record[sample as usize + 1]);
            let (base, rise) = gap(cell, before, after);
            put(&mut self.base, lane, base);
            put(&mut self.rise, lane, rise);
            put(&mut self.after, lane, after);
            first = sample * cell.steps.substeps;
            steps = cell.steps.substeps;
            self.fetch(lane, cell, set.record, sample + 1);
            // A gap that follows another gap of the same cell has the same steps.
            if follows {
                self.done.put(lane, V::Element::of(f64::from(step - first)));
                return first;
            }
        } else {
            self.base.h.put(lane, cell.drive.amplitude_h);
            self.base.v.put(lane, cell.drive.amplitude_v);
            first = step - step % MOST_STEPS;
            steps = (cell.steps.steps_forced - first).min(MOST_STEPS);
            self.phase_start.put(lane, V::Element::of(f64::from(first)) * cell.steps.phase_step);
        }
        self.forced |= bit;
        self.step.put(lane, cell.steps.step_forced);
        self.phase_step.put(lane, cell.steps.phase_step);
        self.done.put(lane, V::Element::of(f64::from(step - first)));
        self.steps.put(lane, V::Element::of(f64::from(steps)));
        first
    }
}

#[inline(always)]
fn put<V: Vector>(ground: &mut Ground<V>, lane: usize, value: Ground<V::Element>) {
    ground.h.put(lane, value.h);
    ground.v.put(lane, value.v);
}

/// The acceleration of the ground at the first sample of a gap of the record under a cell, and its rise to the second
/// sample.
#[inline(always)]
fn gap<N: Number>(cell: &Cell<N>, before: Ground<N>, after: Ground<N>) -> (Ground<N>, Ground<N>) {
    let (h, v) = (cell.drive.amplitude_h, cell.drive.amplitude_v);
    let base = Ground { h: h * before.h, v: v * before.v };
    (base, Ground { h: h * (after.h - before.h), v: v * (after.v - before.v) })
}

/// The acceleration of the ground at a fraction of a step of a cell.
pub fn ground_at<R: Real>(set: &CellEquations<R>, step: u32, fraction: R) -> Ground<R> {
    let mut forcing = Forcing::new(R::of(0.0));
    if step < set.cell.steps.steps_forced {
        forcing.begin(0, set, step, false);
    }
    forcing.ground(set.variant, set.cell, fraction)
}
