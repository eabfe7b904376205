//! The values of a parameter: a number, a range, or a list.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::range::{Range, RangeError};
use super::shown::shown;

/// The values that a parameter takes: one at least.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// A number, or a range.
    Range(Range),
    /// Two numbers or more, none twice, in any order.
    List(Vec<f64>),
}

/// Why a text is no values.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ValuesError {
    /// No range.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// An item of a list that is no number.
    #[error(
        "'{0}' in '{1}' is not a finite number; give numbers with commas between, as in 0.5,1,2"
    )]
    Item(String, String),
    /// A list that has a number twice.
    #[error("{0} stands twice in the list; give each number once")]
    Twice(String),
    /// More numbers than an axis may have.
    #[error("a list of {0} numbers; an axis has {max} at most", max = Range::LARGEST_COUNT)]
    Many(usize),
    /// A list of one number or none.
    #[error("a list has two numbers at least; give a single number by itself")]
    Short,
}

impl Values {
    /// How many there are.
    pub fn count(&self) -> usize {
        match self {
            Values::Range(range) => range.count as usize,
            Values::List(list) => list.len(),
        }
    }

    /// The i-th value, from 0; the last one beyond the end.
    pub fn value(&self, i: usize) -> f64 {
        match self {
            // Counts are below 2^32.
            Values::Range(range) => range.value(i as u32),
            // A list that nobody has checked may be empty.
            Values::List(list) => list.get(i).or(list.last()).copied().unwrap_or(f64::NAN),
        }
    }

    /// All values in order.
    pub fn iter(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.count()).map(|i| self.value(i))
    }

    /// The first value.
    pub fn first(&self) -> f64 {
        self.value(0)
    }

    /// The last value.
    pub fn last(&self) -> f64 {
        self.value(self.count().saturating_sub(1))
    }

    /// The number, where there is one alone.
    pub fn single(&self) -> Option<f64> {
        (self.count() == 1).then(|| self.first())
    }

    /// The smallest and the largest value.
    pub fn ends(&self) -> (f64, f64) {
        match self {
            Values::Range(range) => (range.start.min(range.stop), range.start.max(range.stop)),
            Values::List(list) => {
                list.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| {
                    (low.min(x), high.max(x))
                })
            }
        }
    }

    /// Where a place between the values lies on a drawn axis, counted from the first value: by the value
    /// itself, for a range of constant factors by its decimal logarithm, for a list by the place.
    pub fn coordinate(&self, place: f64) -> f64 {
        match self {
            Values::Range(range) => {
                let along = |start: f64, stop: f64| match range.count {
                    0 | 1 => start,
                    count => start + (stop - start) * place / f64::from(count - 1),
                };
                if !range.log {
                    return along(range.start, range.stop);
                }
                let sign = range.start.signum();
                sign * along(range.start.abs().log10(), range.stop.abs().log10())
            }
            Values::List(_) => place,
        }
    }

    /// The value at a coordinate; in a list linear between its numbers.
    pub fn value_at(&self, coordinate: f64) -> f64 {
        match self {
            Values::Range(range) if range.log => {
                let sign = range.start.signum();
                sign * 10.0_f64.powf(sign * coordinate)
            }
            Values::Range(_) => coordinate,
            Values::List(list) if list.is_empty() => f64::NAN,
            Values::List(list) => {
                let last = list.len() - 1;
                let place = coordinate.clamp(0.0, last as f64);
                let before = (place.floor() as usize).min(last);
                let after = (before + 1).min(last);
                list[before] + (list[after] - list[before]) * (place - before as f64)
            }
        }
    }

    /// At most a given number of the values, spread evenly; all where there are no more.
    pub fn thinned(&self, most: usize) -> Values {
        let count = self.count();
        if count <= most {
            return self.clone();
        }
        match self {
            Values::Range(range) => Values::Range(Range { count: most as u32, ..*range }),
            Values::List(list) => {
                Values::List((0..most).map(|k| list[spread(k, most, count)]).collect())
            }
        }
    }

    /// The values of a range with its gaps halved a given number of times: every 2^`times`-th is a value of this one, to the
    /// last bit. None of a list, and none where there would be more than a range may have; a single value stays.
    pub fn refined(&self, times: u32) -> Option<Values> {
        let Values::Range(range) = self else { return None };
        let gaps =
            u64::from(range.count.saturating_sub(1)).checked_mul(1_u64.checked_shl(times)?)?;
        let count = u32::try_from(gaps + 1).ok().filter(|count| *count <= Range::LARGEST_COUNT)?;
        Some(Values::Range(Range { count, ..*range }))
    }

    /// A list; one number is a single value.
    ///
    /// # Errors
    /// Those of [`check`](Values::check).
    pub fn list(numbers: Vec<f64>) -> Result<Values, ValuesError> {
        if let [number] = numbers[..]
            && number.is_finite()
        {
            return Ok(number.into());
        }
        let list = Values::List(numbers);
        list.check()?;
        Ok(list)
    }

    /// Checks what values that are read were checked for.
    ///
    /// # Errors
    /// Those of [`Range::check`]; a list of one number or none, or of more than an axis may have; a number in it that is
    /// not finite or stands twice.
    pub fn check(&self) -> Result<(), ValuesError> {
        let list = match self {
            Values::Range(range) => return Ok(range.check()?),
            Values::List(list) => list,
        };
        if list.len() < 2 {
            return Err(ValuesError::Short);
        }
        if list.len() > Range::LARGEST_COUNT as usize {
            return Err(ValuesError::Many(list.len()));
        }
        if let Some(number) = list.iter().find(|number| !number.is_finite()) {
            return Err(RangeError::Number(number.to_string()).into());
        }
        // Equal ones come to lie side by side, the earlier one first; the first that repeats another is named.
        let mut order: Vec<usize> = (0..list.len()).collect();
        order.sort_by(|a, b| list[*a].total_cmp(&list[*b]));
        let again = order.windows(2).filter(|pair| list[pair[0]] == list[pair[1]]);
        match again.map(|pair| pair[0].max(pair[1])).min() {
            Some(place) => Err(ValuesError::Twice(list[place].to_string())),
            None => Ok(()),
        }
    }
}

/// The place among `of` of the k-th of `count` that are spread evenly over them, both ends included.
pub fn spread(k: usize, count: usize, of: usize) -> usize {
    if count == of || count < 2 { k } else { (k * (of - 1) + (count - 1) / 2) / (count - 1) }
}

impl From<f64> for Values {
    fn from(value: f64) -> Values {
        Values::Range(Range::single(value))
    }
}

impl From<Range> for Values {
    fn from(range: Range) -> Values {
        Values::Range(range)
    }
}

impl FromStr for Values {
    type Err = ValuesError;

    fn from_str(text: &str) -> Result<Values, ValuesError> {
        if !text.contains(',') {
            return Ok(Values::Range(text.parse()?));
        }
        let item = |part: &str| match part.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(ValuesError::Item(shown(part), shown(text))),
        };
        Values::list(text.split(',').map(item).collect::<Result<_, _>>()?)
    }
}

impl fmt::Display for Values {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Values::Range(range) => write!(f, "{range}"),
            Values::List(list) => {
                let texts: Vec<String> = list.iter().map(f64::to_string).collect();
                write!(f, "{}", texts.join(","))
            }
        }
    }
}

impl Serialize for Values {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.single() {
            Some(number) => serializer.serialize_f64(number),
            None => serializer.collect_str(self),
        }
    }
}

impl<'de> Deserialize<'de> for Values {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Values, D::Error> {
        #[derive(Deserialize)]
        #[serde(
            untagged,
            expecting = "expected a number, \"start:stop:count\" or a list of numbers"
        )]
        enum Written {
            Number(f64),
            Text(String),
            List(Vec<f64>),
        }
        let read = match Written::deserialize(deserializer)? {
            Written::Number(value) => value.to_string().parse(),
            Written::Text(text) => text.parse(),
            Written::List(numbers) => Values::list(numbers),
        };
        read.map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::{Range, Values, ValuesError};

    #[test]
    fn numbers_ranges_and_lists_are_read_and_written_back() {
        for (text, values) in [
            ("1.75", vec![1.75]),
            ("-0.5:0.5:3", vec![-0.5, 0.0, 0.5]),
            ("0.01:100:3:log", vec![0.01, 1.0, 100.0]),
            ("3,1,2", vec![3.0, 1.0, 2.0]),
        ] {
            let read: Values = text.parse().unwrap();
            assert_eq!(read.iter().collect::<Vec<_>>(), values, "{text}");
            assert_eq!(read.to_string(), text);
            let json = serde_json::to_string(&read).unwrap();
            assert_eq!(serde_json::from_str::<Values>(&json).unwrap(), read, "{json}");
        }
        let list: Values = serde_json::from_str("[3, 1, 2]").unwrap();
        assert_eq!(list, "3,1,2".parse().unwrap());
    }

    #[test]
    fn what_is_no_list_is_refused_with_its_reason() {
        let error = |text: &str| text.parse::<Values>().unwrap_err();
        assert_eq!(error("1,2,1"), ValuesError::Twice("1".into()));
        assert_eq!(error("1,,2"), ValuesError::Item(String::new(), "1,,2".into()));
        assert_eq!(error("1,inf"), ValuesError::Item("inf".into(), "1,inf".into()));
        assert_eq!(error("1,5:3"), ValuesError::Item("5:3".into(), "1,5:3".into()));
    }

    #[test]
    fn a_list_that_was_made_is_checked_as_one_that_was_read() {
        let fault = |list: Vec<f64>| Values::List(list).check().unwrap_err();
        assert_eq!(fault(Vec::new()), ValuesError::Short);
        assert_eq!(fault(vec![1.0]), ValuesError::Short);
        assert_eq!(fault(vec![3.0, 1.0, 2.0, 1.0, 3.0]), ValuesError::Twice("1".into()));
        assert_eq!(fault(vec![0.0, 1.0, -0.0]), ValuesError::Twice("-0".into()));
        assert!(matches!(fault(vec![1.0, f64::NAN]), ValuesError::Range(_)));
        assert!(Values::List(Vec::new()).first().is_nan());
        assert_eq!(Values::List(Vec::new()).last().to_bits(), f64::NAN.to_bits());
    }

    /// Every pair compared takes minutes.
    #[test]
    fn a_list_of_a_million_numbers_takes_no_minute() {
        let most = Range::LARGEST_COUNT as usize;
        let began = Instant::now();
        let numbers: Vec<f64> = (0..most).map(|k| k as f64).collect();
        assert_eq!(Values::list(numbers.clone()).unwrap().count(), most);
        let more = [&numbers[..], &[-1.0]].concat();
        assert_eq!(Values::list(more), Err(ValuesError::Many(most + 1)));
        assert!(began.elapsed().as_secs() < 60, "{:?}", began.elapsed());
    }

    #[test]
    fn coordinates_and_values_belong_together() {
        for (text, places) in [
            ("1:3:5", [1.0, 1.5, 3.0]),
            ("0.01:100:5:log", [-2.0, -1.0, 2.0]),
            ("-0.01:-100:5:log", [2.0, 1.0, -2.0]),
            ("5,1,2,8,9", [0.0, 1.0, 4.0]),
        ] {
            let values: Values = text.parse().unwrap();
            for (place, wanted) in [0, 1, 4].into_iter().zip(places) {
                let coordinate = values.coordinate(f64::from(place));
                assert!((coordinate - wanted).abs() < 1e-12, "{text}: {coordinate} for {wanted}");
                let (back, value) = (values.value_at(coordinate), values.value(place as usize));
                assert!((back / value - 1.0).abs() < 1e-12, "{text}: {back} for {value}");
            }
        }
        let list: Values = "5,1,2".parse().unwrap();
        assert_eq!((list.value_at(0.5), list.value_at(9.0)), (3.0, 2.0));
    }

    #[test]
    fn finer_values_hold_the_coarse_ones_to_the_last_bit() {
        for text in ["0.1:15:37", "0.01:100:7:log", "-3:-0.7:12"] {
            let values: Values = text.parse().unwrap();
            let finer = values.refined(6).unwrap();
            assert_eq!(finer.count(), (values.count() - 1) * 64 + 1);
            assert!(values.iter().enumerate().all(|(i, value)| finer.value(64 * i) == value));
        }
        assert_eq!(Values::from(2.0).refined(3), Some(Values::from(2.0)));
        assert_eq!("1,2".parse::<Values>().unwrap().refined(1), None);
        assert_eq!("0:1:1000".parse::<Values>().unwrap().refined(11), None);
        assert_eq!("0:1:3".parse::<Values>().unwrap().refined(64), None);
    }

    #[test]
    fn thinned_values_keep_their_ends() {
        let all: Values = "1,2,3,4,5,6,7".parse().unwrap();
        assert_eq!(all.thinned(3).iter().collect::<Vec<_>>(), [1.0, 4.0, 7.0]);
        assert_eq!(all.thinned(7), all);
    }
}
