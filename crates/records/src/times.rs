//! Columns of times: the step between them, however few digits they have.

use super::clock::Clock;
use super::{DIGITS, RecordError, Step, rounded};

/// Largest part of a step by which a time may miss its place.
const JITTER: f64 = 0.02;

/// Times as they are written.
#[derive(Default)]
pub struct Times {
    times: Vec<f64>,
    /// The line of each.
    lines: Vec<u32>,
    /// Most decimals, and most digits, that one of them has.
    decimals: usize,
    digits: usize,
}

impl Times {
    /// One more, as it is written in a line.
    pub fn add(&mut self, line: usize, written: &str, time: f64) {
        let mantissa = written.split(['e', 'E', 'd', 'D']).next().unwrap_or_default();
        let digits = mantissa.bytes().filter(u8::is_ascii_digit).count();
        let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        // An exponent moves the point.
        let exact = mantissa.len() < written.len();
        self.decimals = self.decimals.max(if exact { 20 } else { decimals });
        self.digits = self.digits.max(digits);
        self.times.push(time);
        self.lines.push(u32::try_from(line).unwrap_or(u32::MAX));
    }

    /// Those that follow.
    pub fn append(&mut self, mut more: Times) {
        self.times.append(&mut more.times);
        self.lines.append(&mut more.lines);
        self.decimals = self.decimals.max(more.decimals);
        self.digits = self.digits.max(more.digits);
    }

    /// The first of them.
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

    /// Says of one of the times what is wrong.
    fn refused(&self, index: usize, problem: String) -> RecordError {
        RecordError::line(self.lines.get(index).map_or(0, |line| *line as usize), problem)
    }

    /// The first time that does not follow the one before it by the step that most have: one that goes back, or one
    /// before which samples are missing.
    fn gap(&self, clock: &Clock) -> Option<RecordError> {
        let mut apart: Vec<f64> = self.times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let middle = apart.len().saturating_sub(1) / 2;
        if apart.is_empty() {
            return None;
        }
        let (_, usual, _) = apart.select_nth_unstable_by(middle, f64::total_cmp);
        let usual = *usual;
        if !(usual > 0.0) {
            return None;
        }
        self.times.windows(2).zip(1..).find_map(|(pair, index)| {
            let (before, time) = (pair[0], pair[1]);
            let apart = time - before;
            // The usual step has two roundings of its own.
            let within = 2.02 * (self.rounding(before) + self.rounding(time)) + JITTER * usual;
            let word = clock.word;
            if apart <= 0.0 && usual > within {
                let problem = format!(
                    "the time {time} {word} does not come after {before} {word} before it; put the rows in order, and each \
                     time once"
                );
                return Some(self.refused(index, problem));
            }
            let steps = (apart / usual).round();
            let missing = steps >= 2.0
                && apart - usual > within
                && (apart - steps * usual).abs() <= steps * within;
            missing.then(|| {
                let (what, them) = match steps - 1.0 {
                    1.0 => ("a sample is missing".to_string(), "it"),
                    more => (format!("{more} samples are missing"), "them"),
                };
                let problem = format!(
                    "{what} between the times {before} {word} and {time} {word}; fill {them} in, or cut the record there"
                );
                self.refused(index, problem)
            })
        })
    }
}

/// The step of evenly spaced times of a unit: the one that is given in s, where the times agree with it to their digits.
pub fn step(times: &Times, given: Option<f64>, clock: &Clock) -> Result<Step, RecordError> {
    let all = &times.times;
    let (Some(first), Some(last)) = (all.first(), all.last()) else {
        return Err(RecordError::whole("no samples"));
    };
    let gaps = (all.len().max(2) - 1) as f64;
    let read = rounded((last - first) / gaps, DIGITS);
    let refused = |problem: RecordError| Err(times.gap(clock).unwrap_or(problem));
    if !(read > 0.0) {
        return refused(RecordError::whole(
            "the times in the first column do not grow; if its commas are decimal ones, write points",
        ));
    }
    let within = (times.rounding(*first) + times.rounding(*last)) / gaps;
    let within = within.max(Step::exact(read).within);
    let given = given.map(|given| rounded(given / clock.seconds, DIGITS));
    let agreed = given.filter(|given| (given - read).abs() <= within);
    let (apart, known) = agreed.map_or((read, false), |given| (given, true));
    for (index, time) in all.iter().enumerate() {
        let place = first + apart * index as f64;
        let off = (time - place).abs();
        if off <= JITTER * apart {
            continue;
        }
        // Two roundings: its own, and that of the first.
        let rounding =
            1.01 * (times.rounding(*time) + times.rounding(*first)) + within * index as f64;
        if off <= rounding && known {
            continue;
        }
        let word = clock.word;
        let problem = if off <= rounding {
            format!(
                "the times have too few digits to tell their step, which is near {} {word}; give `dt`",
                rounded(read, 4)
            )
        } else {
            format!(
                "the time {time} is not where even steps of {apart} {word} put it ({place}); resample the record evenly"
            )
        };
        return refused(times.refused(index, problem));
    }
    let seconds = |time: f64| rounded(time * clock.seconds, DIGITS);
    Ok(Step { seconds: seconds(apart), within: within * clock.seconds })
}
