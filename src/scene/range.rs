//! Ranges of a swept parameter, `start:stop:count`, and `start:stop:count:log`.

use std::fmt;
use std::str::FromStr;

use super::shown::shown;

/// Evenly spaced values from `start` to `stop`, both included, or evenly in their logarithm; one value
/// where the two are equal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// First value.
    pub start: f64,
    /// Last value.
    pub stop: f64,
    /// How many values, at least one.
    pub count: u32,
    /// Spaced by a constant factor.
    pub log: bool,
}

/// Why a text is no range.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RangeError {
    /// Not `start:stop:count` nor a number.
    #[error(
        "'{0}' is neither a number nor start:stop:count, as in 0.2:15:400 or 0.01:10:50:log, nor a list \
         as in 1,2,4"
    )]
    Form(String),
    /// Logarithmic steps that reach or cross zero.
    #[error("logarithmic steps from {0} to {1} would cross zero; give two ends of one sign")]
    Log(String, String),
    /// A bound that is no finite number.
    #[error("'{0}' is not a finite number")]
    Number(String),
    /// A count that is no whole number from 1 to the largest.
    #[error("'{0}' is not a whole number of points from 1 to {max}; a range is START:END:POINTS", max = Range::LARGEST_COUNT)]
    Count(String),
    /// Two ends with a single point.
    #[error("one point cannot include both {0} and {1}; give 2 points or more, or a single number")]
    OnePoint(String, String),
    /// Ends so large, or so far apart, that what lies between them is no number.
    #[error("between {0} and {1} there are values beyond what a number holds; give nearer ends")]
    Wide(String, String),
    /// Several points at one place.
    #[error("{0} points from {1} to {1} are all the same; a range is START:END:POINTS")]
    NoExtent(u32, String),
}

impl Range {
    /// Most points that an axis may have.
    pub const LARGEST_COUNT: u32 = 1 << 20;

    /// The range that holds one value.
    pub fn single(value: f64) -> Range {
        Range { start: value, stop: value, count: 1, log: false }
    }

    /// So many values from `start` to `stop`, evenly apart.
    pub fn even(start: f64, stop: f64, count: u32) -> Range {
        Range { start, stop, count, log: false }
    }

    /// Checks what text that is read was checked for: ends, and as many values as they may have.
    ///
    /// # Errors
    /// An end that is no finite number, a count of none or too many, ends that do not suit it.
    pub fn check(&self) -> Result<(), RangeError> {
        let Range { start, stop, count, log } = *self;
        if let Some(end) = [start, stop].into_iter().find(|end| !end.is_finite()) {
            return Err(RangeError::Number(end.to_string()));
        }
        if !(1..=Range::LARGEST_COUNT).contains(&count) {
            return Err(RangeError::Count(count.to_string()));
        }
        if start == stop && count > 1 {
            return Err(RangeError::NoExtent(count, start.to_string()));
        }
        if start != stop && count == 1 {
            return Err(RangeError::OnePoint(start.to_string(), stop.to_string()));
        }
        if log && (start == 0.0 || stop == 0.0 || start.signum() != stop.signum()) {
            return Err(RangeError::Log(start.to_string(), stop.to_string()));
        }
        // What a value between the ends is made of.
        let between = match log {
            true => [stop / start, start / stop],
            false => [start, stop].map(|end| end * f64::from(count)),
        };
        if !between.into_iter().all(f64::is_finite) {
            return Err(RangeError::Wide(start.to_string(), stop.to_string()));
        }
        Ok(())
    }

    /// The i-th value, from 0; the last one beyond the end.
    pub fn value(&self, i: u32) -> f64 {
        // A range that nobody has checked may have a count of none.
        if self.count <= 1 || i == 0 {
            return self.start;
        }
        if i >= self.count - 1 {
            return self.stop;
        }
        let share = f64::from(i) / f64::from(self.count - 1);
        if self.log {
            let value = self.start * (self.stop / self.start).powf(share);
            let whole = value.round();
            // 3.9999999999999996 is 4.
            return if (value - whole).abs() < 1.0e-12 * value.abs() { whole } else { value };
        }
        // Of both ends, so that 0.1:2:96 has 0.34 and not 0.33999999999999997.
        let last = f64::from(self.count - 1);
        (self.start * f64::from(self.count - 1 - i) + self.stop * f64::from(i)) / last
    }
}

impl FromStr for Range {
    type Err = RangeError;

    fn from_str(text: &str) -> Result<Range, RangeError> {
        let number = |part: &str| match part.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => Err(RangeError::Number(shown(part))),
            Err(_) => Err(RangeError::Form(shown(text))),
        };
        // A range has four parts at most: a fifth says that it is none.
        let parts: Vec<&str> = text.splitn(5, ':').collect();
        match parts[..] {
            [value] => Ok(Range::single(number(value)?)),
            [start, stop, count] | [start, stop, count, "log"] => {
                let log = parts.len() == 4;
                let (start, stop) = (number(start)?, number(stop)?);
                let count = match count.trim().parse::<u32>() {
                    Ok(n) => n,
                    Err(_) => return Err(RangeError::Count(shown(count))),
                };
                let range = Range { start, stop, count, log };
                range.check()?;
                Ok(range)
            }
            _ => Err(RangeError::Form(shown(text))),
        }
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.count == 1 {
            return write!(f, "{}", self.start);
        }
        let log = if self.log { ":log" } else { "" };
        write!(f, "{}:{}:{}{log}", self.start, self.stop, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::{Range, RangeError};

    #[test]
    fn both_ends_are_included_exactly() {
        let range: Range = "0.2:15:400".parse().unwrap();
        let values: Vec<f64> = (0..400).map(|i| range.value(i)).collect();
        assert_eq!((values.len(), values[0], values[399]), (400, 0.2, 15.0));
        assert!(values.windows(2).all(|pair| pair[1] > pair[0]));
        assert_eq!("1.75".parse(), Ok(Range::single(1.75)));
    }

    #[test]
    fn what_is_no_range_is_refused_with_its_reason() {
        let error = |text: &str| text.parse::<Range>().unwrap_err();
        let whole: Range = "1:27:4:log".parse().unwrap();
        assert!((0..4).map(|i| whole.value(i)).eq([1.0, 3.0, 9.0, 27.0]));
        assert_eq!(error("1:2:0"), RangeError::Count("0".into()));
        assert_eq!(error("1:2:-3"), RangeError::Count("-3".into()));
        assert_eq!(error("1:2:1e9"), RangeError::Count("1e9".into()));
        assert_eq!(error("1:2:1"), RangeError::OnePoint("1".into(), "2".into()));
        assert_eq!(error("2:2:5"), RangeError::NoExtent(5, "2".into()));
        assert_eq!(error("nan"), RangeError::Number("nan".into()));
        assert_eq!(error("1:inf:5"), RangeError::Number("inf".into()));
        assert_eq!(error(""), RangeError::Form(String::new()));
        assert_eq!(error("1:2"), RangeError::Form("1:2".into()));
        assert_eq!(error("1:2:3:4"), RangeError::Form("1:2:3:4".into()));
        assert_eq!(error("0:2:3:log"), RangeError::Log("0".into(), "2".into()));
        assert_eq!(error("-1:2:3:log"), RangeError::Log("-1".into(), "2".into()));
        assert!(error(&"1:".repeat(900)).to_string().len() < 300);
        // Their product is zero, and they have one sign all the same.
        assert!("1e-200:1e-199:3:log".parse::<Range>().is_ok());
    }

    #[test]
    fn a_range_that_was_made_is_checked_as_one_that_was_read() {
        let fault = |start, stop, count| Range::even(start, stop, count).check().unwrap_err();
        assert_eq!(fault(1.0, 2.0, 0), RangeError::Count("0".into()));
        assert_eq!(fault(1.0, 2.0, u32::MAX), RangeError::Count("4294967295".into()));
        assert_eq!(fault(1.0, 2.0, 1), RangeError::OnePoint("1".into(), "2".into()));
        assert_eq!(fault(1.0, 1.0, 3), RangeError::NoExtent(3, "1".into()));
        assert_eq!(fault(f64::NAN, 1.0, 3), RangeError::Number("NaN".into()));
        assert_eq!(fault(1.0, f64::INFINITY, 3), RangeError::Number("inf".into()));
        assert!(Range { log: true, ..Range::even(-1.0, 1.0, 3) }.check().is_err());
        let wide = |start: &str, stop: &str| RangeError::Wide(start.into(), stop.into());
        let read = |text: &str| text.parse::<Range>().map_err(|error| error.to_string());
        assert_eq!(
            read("-1e306:1e306:1000"),
            Err(wide(&(-1.0e306).to_string(), &1.0e306.to_string()).to_string())
        );
        assert!(read("1e-300:1e300:3:log").is_err() && read("1e-100:1e100:3:log").is_ok());
        // Asked for a value before it is checked, it has one.
        assert_eq!(Range::even(1.0, 2.0, 0).value(7), 1.0);
    }
}
