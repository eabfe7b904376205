//! A distribution as a text, read and written.

use std::fmt;
use std::str::FromStr;

use topple::scene::shown::shown;

use super::distribution::{Distribution, Form};
use super::distribution_error::DistributionError;

impl FromStr for Distribution {
    type Err = DistributionError;

    fn from_str(text: &str) -> Result<Distribution, DistributionError> {
        let text = text.trim();
        let unknown = || DistributionError::Form(shown(text));
        let inside = text.strip_suffix(')').and_then(|text| text.split_once('('));
        let (name, inside) = inside.ok_or_else(unknown)?;
        let name = name.trim();
        let known = Form::KNOWN.into_iter().find(|(known, _)| *known == name);
        let (name, meaning) = known.ok_or_else(unknown)?;
        let number = |part: &str| match part.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(DistributionError::Number(shown(part), shown(text))),
        };
        let numbers: Vec<f64> = inside.split(',').map(number).collect::<Result<_, _>>()?;
        let (first, second, cut) = match numbers[..] {
            [first, second] => (first, second, None),
            [first, second, low, high] => (first, second, Some((low, high))),
            _ => {
                return Err(DistributionError::Count(shown(text), numbers.len(), name, meaning));
            }
        };
        let positive = |what, value: f64| match value > 0.0 {
            true => Ok(value),
            false => Err(DistributionError::NotPositive(what, value.to_string(), shown(text))),
        };
        let ordered = |(low, high): (f64, f64)| match low < high {
            true => Ok((low, high)),
            false => Err(DistributionError::Order(low.to_string(), high.to_string(), shown(text))),
        };
        let form = match name {
            "normal" => Form::Normal { mean: first, deviation: positive("the deviation", second)? },
            "uniform" => {
                let (low, high) = ordered((first, second))?;
                Form::Uniform { low, high }
            }
            _ => Form::Lognormal {
                median: positive("the median", first)?,
                beta: positive("the deviation of the logarithm", second)?,
            },
        };
        let cut = cut.map(ordered).transpose()?;
        let distribution = Distribution { form, cut };
        let [.., between] = distribution.shares();
        match cut {
            Some((low, high)) if !(between > f64::MIN_POSITIVE) => {
                Err(DistributionError::Empty(low.to_string(), high.to_string(), shown(text)))
            }
            _ => Ok(distribution),
        }
    }
}

impl fmt::Display for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, [first, second]) = self.form.text();
        match self.cut {
            Some((low, high)) => write!(f, "{name}({first},{second},{low},{high})"),
            None => write!(f, "{name}({first},{second})"),
        }
    }
}
