//! Two motions one after the other: a main shock and its aftershock, with zeros between.

use super::lines::MOST_SAMPLES;
use super::pair::common;
use super::steps::at;
use super::{DIGITS, Pair, Record, RecordError, of_one, rounded};

impl Pair {
    /// This motion, then a given number of seconds of zeros, then another motion, whose samples stay what they are where both have
    /// one time step.
    ///
    /// # Errors
    /// Those of [`Pair::new`] of two time steps; more samples together than a record may have.
    pub fn followed_by(self, gap: f64, next: &Pair) -> Result<Pair, RecordError> {
        let record = |pair: &Pair| Record {
            dt: pair.dt,
            samples: pair.horizontal.to_vec(),
            ..Record::default()
        };
        let steps = common([&record(&self), &record(next)])?;
        let dt = steps.step(self.dt, Some(next.dt));
        let zeros = (gap / dt).round();
        let parts = steps.parts;
        let lengths = [(self.len(), parts[0]), (next.len(), parts[1])]
            .map(|(length, parts)| (length - 1) as u128 * parts as u128 + 1);
        let count = lengths[0] + lengths[1] + zeros as u128;
        if count > MOST_SAMPLES as u128 {
            let problem = format!(
                "{count} samples together, more than {MOST_SAMPLES}; give shorter records or a smaller gap"
            );
            return Err(RecordError::Whole(problem));
        }
        let joined = |first: &[f64], second: &[f64]| {
            let first = (0..lengths[0] as usize).map(|k| at(first, k, parts[0]));
            let second = (0..lengths[1] as usize).map(|k| at(second, k, parts[1]));
            first.chain(std::iter::repeat_n(0.0, zeros as usize)).chain(second).collect()
        };
        let begins = rounded((lengths[0] as f64 + zeros) * dt, DIGITS);
        let mut notes = self.notes.clone();
        for (own, pair) in [(self.dt, "first"), (next.dt, "second")] {
            if own != dt {
                notes.push(format!("the {pair} record resampled from {own} s to {dt} s"));
            }
        }
        notes.extend(of_one("second record", &next.notes));
        let mut doubts = self.doubts.clone();
        doubts.extend(of_one("second record", &next.doubts));
        notes.push(format!(
            "'{}' follows at {begins} s, after {} s of zeros",
            next.title,
            rounded(zeros * dt, DIGITS)
        ));
        let mut pair = Pair {
            title: format!("{}, then {}", self.title, next.title),
            dt,
            horizontal: joined(&self.horizontal, &next.horizontal),
            vertical: joined(&self.vertical, &next.vertical),
            notes,
            doubts,
            ..self
        };
        pair.measure();
        Ok(pair)
    }
}
