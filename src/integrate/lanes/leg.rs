//! Legs: runs of equal steps under a ground of one form, one a lane.

use crate::model::Setting;
use crate::model::excitation::Ground;
use crate::model::real::Real;
use crate::model::vector::Vector;

use super::super::certificate::TRIES;

/// Most steps of a leg: numbers of steps that the number type holds without loss.
pub const MOST_STEPS: u32 = 1 << 20;

/// A leg of each lane.
pub struct Leg<V> {
    /// Length of a step, s.
    pub step: V,
    /// Steps done.
    pub done: V,
    /// Steps in all.
    pub steps: V,
    /// Periods of the pulse, or gaps between samples of the record, in one step; zero without
    /// excitation.
    phase_step: V,
    /// Amplitudes of the pulse, or the sample before; zero without excitation.
    base: Ground<V>,
    /// From the sample before to the one after.
    rise: Ground<V>,
    /// Lanes under excitation, a bit each.
    forced: u64,
}

impl<V: Vector> Leg<V> {
    /// No leg in any lane.
    #[inline(always)]
    pub fn new(zero: V) -> Leg<V> {
        let ground = Ground { h: zero, v: zero };
        Leg {
            step: zero,
            done: zero,
            steps: zero.like(1.0),
            phase_step: zero,
            base: ground,
            rise: ground,
            forced: 0,
        }
    }

    /// The ground at a fraction of each lane's step: twin of
    /// [`ground_at`](crate::model::excitation::ground_at).
    #[inline(always)]
    pub fn ground(&self, recorded: bool, fraction: V) -> Ground<V> {
        let zero = fraction.like(0.0);
        if self.forced == 0 {
            return Ground { h: zero, v: zero };
        }
        let phase = (self.done + fraction) * self.phase_step;
        if recorded {
            return Ground {
                h: self.base.h + phase * self.rise.h,
                v: self.base.v + phase * self.rise.v,
            };
        }
        let wave = V::pulse_sine(phase);
        Ground { h: self.base.h * wave, v: self.base.v * wave }
    }

    /// Puts a lane on the leg that its cell is in after `step` steps, fewer than it has in all; the
    /// leg's first step.
    #[inline(always)]
    pub fn begin(&mut self, lane: usize, set: &Setting<V::Element>, step: u32) -> u32 {
        let cell = set.cell;
        let zero = V::Element::of(0.0);
        let bit = 1 << lane;
        if step >= cell.steps_forced {
            let mut steps = (cell.steps - step).min(MOST_STEPS);
            if set.variant.certificate {
                // Up to the next try.
                steps = steps.min(TRIES + 1 - (step & TRIES));
            }
            if self.forced & bit != 0 || self.step.lane(lane) != cell.step_free {
                self.forced &= !bit;
                self.step.put(lane, cell.step_free);
                for number in [&mut self.phase_step, &mut self.base.h, &mut self.base.v] {
                    number.put(lane, zero);
                }
                self.rise.h.put(lane, zero);
                self.rise.v.put(lane, zero);
            }
            self.done.put(lane, zero);
            self.steps.put(lane, V::Element::of(f64::from(steps)));
            return step;
        }
        self.forced |= bit;
        self.step.put(lane, cell.step_forced);
        self.phase_step.put(lane, cell.phase_step);
        let (first, steps) = if set.variant.recorded {
            let sample = step / cell.substeps;
            let before = set.record[sample as usize];
            let after = set.record[sample as usize + 1];
            self.base.h.put(lane, before.h);
            self.base.v.put(lane, before.v);
            self.rise.h.put(lane, after.h - before.h);
            self.rise.v.put(lane, after.v - before.v);
            (sample * cell.substeps, cell.substeps)
        } else {
            self.base.h.put(lane, cell.amplitude_h);
            self.base.v.put(lane, cell.amplitude_v);
            (0, cell.steps_forced)
        };
        self.done.put(lane, V::Element::of(f64::from(step - first)));
        self.steps.put(lane, V::Element::of(f64::from(steps)));
        first
    }
}
