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

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(dt: f64, horizontal: Vec<f64>, vertical: Vec<f64>) -> Pair {
        let of = |samples| Record { dt, samples, ..Record::default() };
        Pair::new(of(horizontal), Some(of(vertical))).unwrap()
    }

    #[test]
    fn the_second_record_keeps_its_samples_after_the_gap() {
        let main = pair(0.01, vec![0.1, -0.7, 0.3], vec![0.2, 0.1, 0.0]);
        let after = pair(0.01, vec![0.5, 0.9], vec![-0.4, 0.6]);
        let both = main.clone().followed_by(0.05, &after).unwrap();
        assert_eq!(*both.horizontal, [0.1, -0.7, 0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.9]);
        assert_eq!(*both.vertical, [0.2, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.4, 0.6]);
        assert_eq!((both.pga_h, both.pga_v, both.dt), (0.9, 0.6, 0.01));
        // The first sample of the second record lies at 8 steps.
        assert!(both.notes.last().unwrap().contains("follows at 0.08 s, after 0.05 s of zeros"));
        // Of half the step: the first record is linear between its samples, the second keeps its own.
        let fine = pair(0.005, vec![0.5, 0.9, 0.2], vec![0.0, 0.0, 0.1]);
        let both = main.followed_by(0.01, &fine).unwrap();
        let wanted = [0.1, -0.3, -0.7, -0.2, 0.3, 0.0, 0.0, 0.5, 0.9, 0.2];
        assert_eq!(both.dt, 0.005);
        assert!(both.horizontal.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-15));
    }

    #[test]
    fn too_many_samples_are_refused() {
        let short = pair(0.000_01, vec![0.1, 0.2], vec![0.0, 0.1]);
        let error = short.clone().followed_by(3600.0, &short).unwrap_err().to_string();
        assert!(error.contains("360000004 samples together"), "{error}");
    }
}
