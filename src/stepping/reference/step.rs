//! One adaptive step, cut at the first switch or kink inside it.

use super::cubic::Cubic;
use super::guards::{Guard, first_guard};
use super::system::{Drive, State};
use super::trial::Trial;
use super::{EVENT_TIME, Settings};
use crate::scene::Case;

/// A step whose error is within the tolerance.
#[derive(Debug, Clone)]
pub struct AcceptedStep {
    /// The time at its end, s.
    pub t: f64,
    /// The length of the step, s.
    pub h: f64,
    /// The state at its end.
    pub y: State,
    /// The time derivative at its end.
    pub rate: State,
    /// The guard that cut the step, if one did.
    pub guard: Option<Guard>,
}

/// The lengths of the steps of one cell.
pub struct Stepper {
    /// The length of the next trial, s.
    next: f64,
    /// The longest steps: with a drive, and without one.
    longest: [f64; 2],
}

impl Stepper {
    /// The stepper before the first step.
    pub fn new(settings: &Settings, case: &Case) -> Stepper {
        // The limit is a sixteenth of the shortest period, so that an uplift at its crest is not missed.
        let base = &case.isolation;
        let pulse = case.shaking.pulse().map(|pulse| pulse.shortest_period());
        let periods = [base.horizontal.map(|law| law.t_h), base.vertical.map(|law| law.t_v)];
        let bound = |longest: f64, period: f64| longest.min(period / 16.0);
        let [driven, free] = [settings.longest, settings.longest_free]
            .map(|longest| periods.into_iter().flatten().fold(longest, bound));
        let longest = [pulse.into_iter().fold(driven, bound), free];
        Stepper { next: 0.1 * longest[0], longest }
    }

    /// Takes a step towards the time `stop`, up to the first guard that happens.
    pub fn step(&mut self, trial: &Trial, stop: f64) -> AcceptedStep {
        let longest = self.longest[usize::from(trial.drive == Drive::Free)];
        loop {
            let left = stop - trial.t;
            let mut h = self.next.min(longest).min(left);
            // The last step ends exactly at `stop`, so that no remainder is lost in t.
            let last = h >= left * (1.0 - 1.0e-9);
            if last {
                h = left;
            }
            let (mut y1, mut error) = trial.step(h);
            let mut d1 = trial.rate_of(h, &y1);
            let mut guard = None;
            let mut cut = h;
            // A step that is too long for the motion is no evidence of what happens before the cut: the rest of the
            // step is searched again.
            loop {
                let cubic = Cubic::new((trial.y, trial.rate), (&y1, &d1), cut);
                match first_guard(trial, &cubic) {
                    Some((which, place)) if guard.is_none() || place < cut - 2.0 * EVENT_TIME => {
                        guard = Some(which);
                        cut = place;
                        (y1, error) = trial.step(cut);
                        d1 = trial.rate_of(cut, &y1);
                    }
                    _ => break,
                }
            }
            if !error.is_finite() && cut > 1.0e-14 {
                // The trial left the range of its law, as |z|^n soon does for a large n.
                self.next = 0.2 * cut;
                continue;
            }
            let grown = cut * (0.9 * error.max(1.0e-10).powf(-1.0 / 8.0)).clamp(0.2, 5.0);
            if error > 1.0 && cut > 1.0e-14 {
                self.next = grown;
                continue;
            }
            // A step that is cut at a guard is little evidence of how long the next one may be.
            self.next = if guard.is_some() { self.next.max(grown) } else { grown };
            let end = if last && guard.is_none() { stop } else { trial.t + cut };
            return AcceptedStep { t: end, h: cut, y: y1, rate: d1, guard };
        }
    }
}
