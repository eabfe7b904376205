//! Columns of times: the step between them, however few digits they have.

use super::{DIGITS, RecordError, Step, rounded};

/// Largest part of a step by which a time may miss its place.
const JITTER: f64 = 0.02;

/// Times as they are written.
#[derive(Default)]
pub(super) struct Times {
    times: Vec<f64>,
    /// Most decimals, and most digits, that one of them has.
    decimals: usize,
    digits: usize,
}

impl Times {
    /// One more, as it is written.
    pub fn add(&mut self, written: &str, time: f64) {
        let mantissa = written.split(['e', 'E', 'd', 'D']).next().unwrap_or_default();
        let digits = mantissa.bytes().filter(u8::is_ascii_digit).count();
        let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        // An exponent moves the point.
        let exact = mantissa.len() < written.len();
        self.decimals = self.decimals.max(if exact { 20 } else { decimals });
        self.digits = self.digits.max(digits);
        self.times.push(time);
    }

    pub fn append(&mut self, mut more: Times) {
        self.times.append(&mut more.times);
        self.decimals = self.decimals.max(more.decimals);
        self.digits = self.digits.max(more.digits);
    }

    pub fn first(&self) -> Option<f64> {
        self.times.first().copied()
    }

    /// By how much a time may be off as it is written.
    fn rounding(&self, time: f64) -> f64 {
        let last = |place: f64| 0.5 * 10.0_f64.powf(place);
        let decimals = last(-(self.decimals.min(20) as f64));
        // Programs that write so many digits write fewer decimals of larger numbers.
        let magnitude = if time == 0.0 { 0.0 } else { time.abs().log10().floor() + 1.0 };
        decimals.max(last(magnitude - self.digits.min(20) as f64))
    }
}

/// The step of evenly spaced times: the one that is given, where the times agree with it to their digits.
pub(super) fn step(times: &Times, given: Option<f64>) -> Result<Step, RecordError> {
    let all = &times.times;
    let (Some(first), Some(last)) = (all.first(), all.last()) else {
        return Err(RecordError::whole("no samples"));
    };
    let gaps = (all.len().max(2) - 1) as f64;
    let read = rounded((last - first) / gaps, DIGITS);
    if !(read > 0.0) {
        return Err(RecordError::whole(
            "the times in the first column do not grow; if its commas are decimal ones, write points",
        ));
    }
    let within = (times.rounding(*first) + times.rounding(*last)) / gaps;
    let within = within.max(Step::exact(read).within);
    let step = given.filter(|given| (given - read).abs() <= within);
    let (seconds, known) = step.map_or((read, false), |given| (given, true));
    for (index, time) in all.iter().enumerate() {
        let place = first + seconds * index as f64;
        let off = (time - place).abs();
        if off <= JITTER * seconds {
            continue;
        }
        // Two roundings: its own, and that of the first.
        let rounding =
            1.01 * (times.rounding(*time) + times.rounding(*first)) + within * index as f64;
        if off <= rounding && known {
            continue;
        }
        if off <= rounding {
            let problem = format!(
                "sample {}: the times have too few digits to tell their step, which is near {} s; give `dt`",
                index + 1,
                rounded(read, 4)
            );
            return Err(RecordError::whole(problem));
        }
        let problem = format!(
            "sample {}: the time {time} is not where even steps of {seconds} s put it ({place}); \
             resample the record evenly",
            index + 1
        );
        return Err(RecordError::whole(problem));
    }
    Ok(Step { seconds, within })
}

#[cfg(test)]
mod tests {
    use super::{Times, step};

    fn times(count: usize, dt: f64, written: impl Fn(f64) -> String) -> Times {
        let mut times = Times::default();
        for k in 0..count {
            let text = written(k as f64 * dt);
            times.add(&text, text.parse().unwrap());
        }
        times
    }

    #[test]
    fn a_given_step_is_taken_where_the_times_have_few_digits() {
        let few = |time: f64| format!("{time:.2}");
        let error = step(&times(2000, 0.005, few), None).unwrap_err().to_string();
        assert!(error.contains("too few digits") && error.contains("give `dt`"), "{error}");
        assert_eq!(step(&times(2000, 0.005, few), Some(0.005)).unwrap().seconds, 0.005);
        assert!(step(&times(2000, 0.005, few), Some(0.006)).is_err());
        // 1/256 s to four decimals.
        let four = |time: f64| format!("{time:.4}");
        let read = step(&times(500, 0.00390625, four), None).unwrap();
        assert!((read.seconds - 0.00390625).abs() <= read.within);
        assert_eq!(
            step(&times(500, 0.00390625, four), Some(0.00390625)).unwrap().seconds,
            0.00390625
        );
        assert_eq!(step(&times(500, 0.01, four), Some(0.02)).unwrap().seconds, 0.01);
    }

    #[test]
    fn uneven_times_are_refused_whatever_is_given() {
        let mut uneven = times(20, 0.01, |time| format!("{time:.3}"));
        uneven.times[7] += 0.004;
        for given in [None, Some(0.01)] {
            let error = step(&uneven, given).unwrap_err().to_string();
            assert!(error.starts_with("sample 8: the time"), "{error}");
        }
    }
}
