//! The step of a column of times, by its unit, by words above it, and by the step that is given.

use super::told::{OFF, Told};
use crate::clock::Clock;
use crate::shown::shown;
use crate::times::{self, Times};
use crate::{DIGITS, RecordError, Step, rounded};

/// Longest time between samples that a column of times in s may have; above it the times are in another unit.
const LONGEST: f64 = 0.25;

/// What a column of times tells.
pub(super) struct Timed {
    pub step: Step,
    /// The time of the first sample, s, where the unit is known.
    pub start: Option<f64>,
    /// What has to be said of it.
    pub note: Option<String>,
}

impl Told {
    /// What a column of times tells. Its step is the one that is given, or stated in words or in a row, where the times
    /// agree with it to their digits.
    ///
    /// # Errors
    /// Uneven times, times of a unit that is not known, and a step that the times contradict.
    pub fn step_of(
        &self,
        times: &Times,
        given: Option<f64>,
        row: Option<f64>,
    ) -> Result<Timed, RecordError> {
        let second = Clock::default();
        let begins =
            |clock: &Clock| times.first().map(|first| rounded(first * clock.seconds, DIGITS));
        let (at, clock) = match &self.clock {
            None => (0, None),
            Some((at, Ok(clock))) => (*at, Some(clock)),
            Some((at, Err(word))) => {
                let word = shown(word);
                let Some(given) = given else {
                    let problem = format!(
                        "times in '{word}' are not read; write them in s, or give `dt` in their place"
                    );
                    return Err(RecordError::line(*at, problem));
                };
                // Whatever they are in, they are evenly apart.
                times::step(times, None, &second)?;
                let note =
                    format!("times in '{word}' are not read: the step is {given} s, as given");
                return Ok(Timed { step: Step::exact(given), start: None, note: Some(note) });
            }
        };
        let stated = self.step.map(|(_, step)| step);
        let found = times::step(times, given.or(stated).or(row), clock.unwrap_or(&second))?;
        if let (Some((at, stated)), None) = (self.step, given)
            && (stated - found.seconds).abs() > found.within
        {
            let problem = format!(
                "a step of {stated} s, and the times have {} s; correct one, or give `dt`",
                found.seconds
            );
            return Err(RecordError::line(at, problem));
        }
        if let Some(clock) = clock.filter(|clock| clock.seconds != 1.0) {
            let note = format!("the times are in {} by line {at}", clock.word);
            return Ok(Timed { step: found, start: begins(clock), note: Some(note) });
        }
        match given {
            Some(given) if clock.is_none() && found.seconds > LONGEST => {
                let note = Some(other_unit(found, given)?);
                Ok(Timed { step: Step::exact(given), start: None, note })
            }
            _ => Ok(Timed { step: found, start: begins(&second), note: None }),
        }
    }
}

/// What a first column in no stated unit is by the step that is given: times in ms or µs, or a count.
fn other_unit(found: Step, given: f64) -> Result<String, RecordError> {
    let apart = found.seconds;
    let is = |factor: f64| (apart - factor * given).abs() <= OFF * apart + found.within;
    let what = if is(1.0e3) {
        "is in ms by the step that is given"
    } else if is(1.0e6) {
        "is in µs by the step that is given"
    } else if apart == 1.0 {
        "counts samples: the step is the one that is given"
    } else {
        return Err(RecordError::whole(format!(
            "steps of {apart} in the first column are `dt` in neither s, ms nor µs; give the right `dt`, or name their unit \
             in a heading such as time (ms), acc (g)"
        )));
    };
    Ok(format!("the first column {what}, {given} s"))
}
