//! The baseline of a record: the velocity with which its ground ends, and the line that is subtracted from it.
//!
//! The velocity v is the integral of the acceleration, which is linear between samples. Of the lines c t through the start
//! the one that is nearest to v has c = sum(t v) / sum(t^2), over the samples; the acceleration without it is a - c.

use super::{GRAVITY, Record, rounded, written};

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
    pub fn end_and_peak(&self) -> (f64, f64) {
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
