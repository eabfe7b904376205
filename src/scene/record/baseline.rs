//! The baseline of a record: the velocity with which its ground ends, and the line that is subtracted from it.
//!
//! The velocity v is the integral of the acceleration, which is linear between samples. Of the lines c t through the start
//! the one that is nearest to v has c = sum(t v) / sum(t^2), over the samples; the acceleration without it is a - c.

use super::{Record, rounded};
use crate::scene::GRAVITY;
use crate::written::written;

written! {
    /// What is subtracted from a record's velocity.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
    pub enum Baseline {
        /// Leave the record as it is.
        None = "none",
        /// Subtract from the velocity the line through the start that is nearest to it.
        Line = "line",
    }
}

/// Largest share of its peak velocity with which the ground of a good record ends: one that is cut off in its coda has up to a
/// fifth. The offset that an end velocity V stands for is a constant acceleration V/D over the duration D. It moves a base of the
/// period T and the post-yield stiffness psi by V T^2/(4 pi^2 psi D); the motion moves it by V_peak T/(2 pi) or so. With V a
/// quarter of V_peak, T = 4 s, psi = 0.1 and D = 20 s the first is 8 % of the second.
const SHARE: f64 = 0.25;
/// Smallest velocity that is said, m/s: by the same numbers an offset of it moves the base by 1 cm.
const LEAST: f64 = 0.05;

/// The velocities at the samples, m/s, from rest.
fn velocities(samples: &[f64], dt: f64) -> impl Iterator<Item = f64> {
    let gaps = samples.windows(2).scan(0.0, move |velocity, gap| {
        *velocity += 0.5 * dt * (gap[0] + gap[1]);
        Some(*velocity)
    });
    std::iter::once(0.0).chain(gaps)
}

impl Record {
    /// The velocity at the end, and the largest one, m/s.
    fn end_and_peak(&self) -> (f64, f64) {
        velocities(&self.samples, self.dt).fold((0.0, 0.0), |(_, peak): (f64, f64), velocity| {
            (velocity, peak.max(velocity.abs()))
        })
    }

    /// The record on its baseline, with what is to be said of it: what was subtracted, and that its ground ends with a velocity.
    pub fn on_baseline(mut self, baseline: Option<Baseline>) -> Record {
        let is_corrected = baseline == Some(Baseline::Line);
        if is_corrected {
            self.subtract_line();
        }
        let (end, peak) = self.end_and_peak();
        if end.abs() > SHARE * peak && end.abs() > LEAST {
            let remedy = match is_corrected {
                true => "even without a line of it; correct the record by another program",
                false => {
                    "its baseline is not corrected; `baseline` line subtracts a line of its velocity"
                }
            };
            let (end, share) = (rounded(end, 3), (100.0 * end.abs() / peak).round());
            self.doubts.push(format!(
                "the ground ends with the velocity {end} m/s, {share} % of its largest: {remedy}"
            ));
        }
        self
    }

    fn subtract_line(&mut self) {
        let (before, _) = self.end_and_peak();
        let times = (0..self.samples.len()).map(|k| k as f64 * self.dt);
        let (of_velocity, of_time) = times.zip(velocities(&self.samples, self.dt)).fold(
            (0.0, 0.0),
            |(of_velocity, of_time), (time, velocity)| {
                (of_velocity + time * velocity, of_time + time * time)
            },
        );
        // A record has two samples at least, and so a time above 0.
        let offset = of_velocity / of_time;
        self.samples.iter_mut().for_each(|sample| *sample -= offset);
        let (after, _) = self.end_and_peak();
        let [offset, in_g, before, after] =
            [offset, offset / GRAVITY, before, after].map(|number| rounded(number, 3));
        self.notes.push(format!(
            "baseline: an offset of {offset} m/s2 ({in_g} g) subtracted, the slope of the line nearest to the velocity; the \
             velocity at the end was {before} m/s and is {after} m/s"
        ));
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn record(sample: impl Fn(f64) -> f64) -> Record {
        let samples = (0..=2000).map(|k| sample(0.01 * f64::from(k))).collect();
        Record { dt: 0.01, samples, ..Record::default() }
    }

    /// A motion whose velocity ends at 0: sin^2 (TAU t/20) sin(TAU t) over 20 s has no integral.
    fn clean(t: f64) -> f64 {
        3.0 * (TAU * t / 40.0).sin().powi(2) * (TAU * t).sin()
    }

    #[test]
    fn a_ground_that_ends_with_a_velocity_is_said_and_a_clean_one_is_not() {
        let clean_one = record(clean).on_baseline(None);
        assert!(clean_one.doubts.is_empty() && clean_one.notes.is_empty());
        // 0.3 m/s2 over 20 s are 6 m/s.
        let off = record(|t| clean(t) + 0.3).on_baseline(None);
        assert!(off.doubts[0].starts_with("the ground ends with the velocity 6 m/s, "), "{off:?}");
        // The peak velocity is about 1 m/s; an offset of a share of it over 20 s ends with that share.
        let peak = record(clean).end_and_peak().1;
        for (share, doubts) in [(0.2, 0), (0.5, 1)] {
            let off = record(|t| clean(t) + share * peak / 20.0).on_baseline(None);
            assert_eq!(off.doubts.len(), doubts, "{share}");
        }
    }

    /// The velocity of a constant is a line: nothing of it is left, and of a motion with one only the constant goes.
    #[test]
    fn a_line_takes_an_offset_away_and_says_by_how_much() {
        let alone = record(|_| 0.3).on_baseline(Some(Baseline::Line));
        assert!(alone.samples.iter().all(|sample| sample.abs() < 1e-14));
        let (off, plain) = (record(|t| clean(t) + 0.3), record(clean));
        let [off, plain] = [off, plain].map(|record| record.on_baseline(Some(Baseline::Line)));
        for (one, other) in off.samples.iter().zip(&plain.samples) {
            assert!((one - other).abs() < 1e-12);
        }
        assert!(off.doubts.is_empty());
        assert!(off.notes[0].contains("the velocity at the end was 6 m/s and is"), "{off:?}");
        // A step half way is no line: it is said after it, too.
        let step = |t: f64| clean(t) + if t < 18.0 { 0.0 } else { 3.0 };
        let step = record(step).on_baseline(Some(Baseline::Line));
        assert!(step.doubts[0].contains("even without a line of it"), "{step:?}");
        // None is what nothing is.
        let (none, nothing) = (record(clean).on_baseline(Some(Baseline::None)), record(clean));
        assert_eq!(none.samples, nothing.samples);
    }
}
