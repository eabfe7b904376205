//! How finely a motion is stepped, and the lengths and numbers of a cell's steps.

use crate::model::precision::Precision;
use crate::stepping::guards::EVENT_BOUND;
use crate::stepping::span::STIFF_LIMIT;

/// Largest step by default, s: the chart's choice (docs/chart.md).
pub const DEFAULT_STEP: f64 = 1.0 / 128.0;
/// The fewest steps in the fastest period of a cell. The limit of stability of RK4 is 2.2 steps (omega h = 2.83).
/// More steps are needed for accuracy, most of all on a stiff vertical isolation: a block on it rocks chaotically,
/// and the error of a step grows from impact to impact.
pub const STEPS_A_PERIOD: f64 = 64.0;
/// The same for periods around [`SHORT_PERIOD`], in f32 and in f64: f32 has fewer, because its rounding errors are
/// larger.
pub const FINEST_STEPS_A_PERIOD: [f64; 2] = [160.0, 640.0];
/// See [`FINEST_STEPS_A_PERIOD`], s; for longer periods the number of steps in a period falls as the period grows.
pub const SHORT_PERIOD: f64 = 1.0 / 16.0;
/// Below this period, s, the vertical isolation acts as if it were rigid and the motion is not chaotic: the number of
/// steps in a period falls again.
pub const STIFF_PERIOD: f64 = 1.0 / 64.0;
/// The fewest steps in a period of a pulse: with so many, the contact forces between the steps, which come from the
/// stages of RK4 and have errors of third order in the step, are right to a thousandth of the weight.
pub const STEPS_A_PULSE: f64 = 64.0;

/// The longest step of u while the block stands, over the largest step: u is then an oscillation by itself, of
/// which [`STEPS_A_PERIOD`] steps lose 5e-6 in each period.
const STANDING: f64 = 2.0;

/// The longest step times the rate of the fastest motion against an end stop: the spans there are then half of the
/// switches that a step may hold.
pub const STEP_AT_STOP: f64 = 0.5 * EVENT_BOUND as f64 * STIFF_LIMIT;

/// How finely a motion is stepped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// Largest step, s.
    pub largest_step: f64,
    /// The fewest steps in the fastest period of a cell.
    steps_a_period: f64,
    /// The same for periods around [`SHORT_PERIOD`].
    finest_steps_a_period: f64,
    /// The fewest steps in a period of a pulse.
    steps_a_pulse: f64,
    /// The longest step of u in full contact, over the largest step.
    standing: f64,
    /// The fewest steps in the yield time alpha_y/(n omega_h) of a Bouc-Wen base.
    steps_a_yield: f64,
    /// All steps that follow from these numbers are divided by this one.
    divide: f64,
    /// Steps are cut at the kinks of the Bouc-Wen law.
    pub kinks: bool,
}

impl Resolution {
    /// Steps of at most `largest_step` seconds, and shorter ones where the fastest period of a cell or its pulse
    /// requires them.
    pub fn bounded(largest_step: f64) -> Resolution {
        Resolution {
            largest_step,
            steps_a_period: STEPS_A_PERIOD,
            finest_steps_a_period: FINEST_STEPS_A_PERIOD[0],
            steps_a_pulse: STEPS_A_PULSE,
            standing: STANDING,
            steps_a_yield: 1.0,
            divide: 1.0,
            kinks: true,
        }
    }

    /// Steps of `step` seconds, adjusted so that the end and the samples of the excitation fall on steps, even if
    /// they do not resolve the motion: for charts and for tests of coarse steps.
    pub fn exactly(step: f64) -> Resolution {
        Resolution {
            steps_a_period: 0.0,
            finest_steps_a_period: 0.0,
            steps_a_pulse: 1.0,
            standing: 1.0,
            steps_a_yield: 0.0,
            ..Resolution::bounded(step)
        }
    }

    /// The same with steps taken across the kinks of the Bouc-Wen law.
    pub fn across_kinks(self) -> Resolution {
        Resolution { kinks: false, ..self }
    }

    /// Steps half as long.
    pub fn halved(self) -> Resolution {
        Resolution { divide: 2.0 * self.divide, ..self }
    }

    /// The resolution for a number type: short periods take more steps in f64.
    pub fn at(self, precision: Precision) -> Resolution {
        let bounded = self.steps_a_period > 0.0;
        if bounded && precision == Precision::F64 {
            return Resolution { finest_steps_a_period: FINEST_STEPS_A_PERIOD[1], ..self };
        }
        self
    }

    /// Longest step of a cell whose fastest period is `period`, s; infinite where it has none.
    pub fn longest_step(&self, period: f64) -> f64 {
        let share = (SHORT_PERIOD / period).min(period / STIFF_PERIOD);
        let steps = (FINEST_STEPS_A_PERIOD[1] * share).min(self.finest_steps_a_period);
        self.largest_step.min(period / steps.max(self.steps_a_period)) / self.divide
    }

    /// Longest step of u in full contact where its fastest period is `period`, s.
    pub fn longest_standing(&self, period: f64) -> f64 {
        let largest_step = self.standing * self.largest_step;
        Resolution { largest_step, ..*self }.longest_step(period)
    }

    /// Longest step of a base that yields, s. z of (11) settles at the rate n |u'|/u_y, which is n omega_h/alpha_y at
    /// the velocity PGA_h/omega_h. RK4 is stable up to a rate of 2.79 steps: with one step per yield time nearly
    /// three times that velocity is possible.
    pub fn longest_in_yield(&self, yield_time: f64) -> f64 {
        yield_time / self.steps_a_yield / self.divide
    }

    /// Longest step of a pulse of this shortest period, s.
    pub fn longest_in_pulse(&self, period: f64) -> f64 {
        period / self.steps_a_pulse / self.divide
    }
}

/// The lengths and numbers of a cell's steps, in `f64`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Length of a forced step, s.
    pub step_forced: f64,
    /// Length of a free step, s.
    pub step_free: f64,
    /// Number of forced steps.
    pub steps_forced: u32,
    /// Steps between two samples of a record; 1 for a pulse.
    pub substeps: u32,
    /// The substeps that the cell would have without vertical isolation.
    pub substeps_h: u32,
    /// Number of steps in all.
    pub steps: u32,
}

impl Clock {
    /// The number of steps until a time of the run, s.
    pub fn steps_until(&self, t: f64) -> u64 {
        let forced = f64::from(self.steps_forced) * self.step_forced;
        let steps = if t < forced || self.step_free <= 0.0 {
            t / self.step_forced
        } else {
            f64::from(self.steps_forced) + (t - forced) / self.step_free
        };
        // Times are not negative.
        steps.round() as u64
    }

    /// Time at a fraction of a step, s.
    pub fn time(&self, step: u32, fraction: f64) -> f64 {
        if step < self.steps_forced {
            return (f64::from(step) + fraction) * self.step_forced;
        }
        let free = f64::from(step - self.steps_forced) + fraction;
        f64::from(self.steps_forced) * self.step_forced + free * self.step_free
    }
}
