//! How a number that is not known is distributed.

use std::fmt;
use std::str::FromStr;

use super::normal;
use topple::scene::shown::shown;

/// Points lie inside of (0, 1) at a multiple of this: no share that is smaller is ever drawn at either end.
pub const LEAST_SHARE: f64 = 1.0 / 16_777_216.0;

/// A distribution, cut off at two ends or not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distribution {
    /// Its form.
    pub form: Form,
    /// The ends at which it is cut off.
    pub cut: Option<(f64, f64)>,
}

/// The form of a distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Form {
    /// Normal.
    Normal {
        /// Its mean.
        mean: f64,
        /// Its standard deviation.
        deviation: f64,
    },
    /// Every value between two ends is as likely as any other.
    Uniform {
        /// The least value.
        low: f64,
        /// The largest.
        high: f64,
    },
    /// The natural logarithm is normal.
    Lognormal {
        /// The median.
        median: f64,
        /// The standard deviation of the natural logarithm.
        beta: f64,
    },
}

/// Why a text is no distribution.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DistributionError {
    /// No form that is known.
    #[error(
        "'{0}' is no distribution; give normal(MEAN,DEVIATION), uniform(LOW,HIGH) or lognormal(MEDIAN,BETA)"
    )]
    Form(String),
    /// The wrong count of numbers.
    #[error(
        "'{0}' has {1} numbers; {2} has two, {3}, and two more, LOW,HIGH, where it is to be cut off"
    )]
    Count(String, usize, &'static str, &'static str),
    /// An item that is no number.
    #[error(
        "'{0}' in '{1}' is not a finite number; decimals have a point, commas separate numbers"
    )]
    Number(String, String),
    /// A spread or a median that is not above zero.
    #[error("{0} {1} in '{2}' must be a positive number")]
    NotPositive(&'static str, String, String),
    /// Ends in the wrong order.
    #[error("'{2}': the low end {0} must lie below the high end {1}")]
    Order(String, String, String),
    /// A cut that leaves nothing.
    #[error("'{2}': nothing of it lies between {0} and {1}; move the ends")]
    Empty(String, String, String),
}

impl Form {
    /// Its name, and what its two numbers are called.
    const KNOWN: [(&'static str, &'static str); 3] =
        [("normal", "MEAN,DEVIATION"), ("uniform", "LOW,HIGH"), ("lognormal", "MEDIAN,BETA")];

    /// The place of a value on a scale on which the distribution is symmetric about 0: standard normal or, for a
    /// uniform one, from -1/2 to 1/2.
    fn standard(self, value: f64) -> f64 {
        match self {
            Form::Normal { mean, deviation } => (value - mean) / deviation,
            Form::Uniform { low, high } => ((value - low) / (high - low)).clamp(0.0, 1.0) - 0.5,
            Form::Lognormal { median, beta } if value > 0.0 => (value / median).ln() / beta,
            Form::Lognormal { .. } => f64::NEG_INFINITY,
        }
    }

    /// The share below a place of that scale; that above a place is the one below its negative.
    fn share(self, standard: f64) -> f64 {
        match self {
            Form::Uniform { .. } => standard + 0.5,
            _ => normal::cdf(standard),
        }
    }

    /// The value at a place of the scale.
    fn value(self, standard: f64) -> f64 {
        match self {
            Form::Normal { mean, deviation } => mean + deviation * standard,
            Form::Uniform { low, high } => low + (high - low) * (standard + 0.5),
            Form::Lognormal { median, beta } => median * (beta * standard).exp(),
        }
    }

    /// The place of the scale below which a share lies.
    fn place(self, share: f64) -> f64 {
        match self {
            Form::Uniform { .. } => share - 0.5,
            _ => normal::quantile(share),
        }
    }

    fn text(self) -> (&'static str, [f64; 2]) {
        match self {
            Form::Normal { mean, deviation } => ("normal", [mean, deviation]),
            Form::Uniform { low, high } => ("uniform", [low, high]),
            Form::Lognormal { median, beta } => ("lognormal", [median, beta]),
        }
    }
}

impl Distribution {
    /// One that is not cut off.
    pub fn of(form: Form) -> Distribution {
        Distribution { form, cut: None }
    }

    /// Checks what one that is read was checked for.
    ///
    /// # Errors
    /// Numbers that are not finite, a spread or a median that is not above zero, ends in the wrong order.
    pub fn check(&self) -> Result<(), DistributionError> {
        // A number that is written has all its digits.
        self.to_string().parse::<Distribution>().map(|_| ())
    }

    /// The name of its form.
    pub fn name(&self) -> &'static str {
        self.form.text().0
    }

    /// The numbers of its form.
    pub fn numbers(&self) -> [f64; 2] {
        self.form.text().1
    }

    /// The shares of the form below the low end, above the high end, and between them.
    fn shares(&self) -> [f64; 3] {
        let Some((low, high)) = self.cut else { return [0.0, 0.0, 1.0] };
        let (low, high) = (self.form.standard(low), self.form.standard(high));
        let share = |place| self.form.share(place);
        let (below, above) = (share(low), share(-high));
        // Of the tail in which both ends lie, so that no digits are lost.
        let between = match (low > 0.0, high < 0.0) {
            (true, _) => share(-low) - above,
            (_, true) => share(high) - below,
            _ => 1.0 - below - above,
        };
        [below, above, between]
    }

    /// The value below which a share lies, 0 to 1.
    pub fn quantile(&self, share: f64) -> f64 {
        let [below, above, between] = self.shares();
        let (from_below, from_above) = (below + share * between, above + (1.0 - share) * between);
        let place = match from_below <= from_above {
            true => self.form.place(from_below),
            false => -self.form.place(from_above),
        };
        let value = self.form.value(place);
        match self.cut {
            Some((low, high)) => value.clamp(low, high),
            None => value,
        }
    }

    /// The shares of its values below one value and above another.
    pub fn outside(&self, low: f64, high: f64) -> (f64, f64) {
        let [below, above, between] = self.shares();
        let place = |value: f64| self.form.standard(value);
        let share = |of: f64, cut: f64| ((of - cut) / between).clamp(0.0, 1.0);
        (share(self.form.share(place(low)), below), share(self.form.share(-place(high)), above))
    }
}

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

#[cfg(test)]
mod tests {
    use super::{Distribution, DistributionError};

    fn read(text: &str) -> Distribution {
        text.parse().unwrap()
    }

    /// scipy 1.17.1: norm(1, 0.5), lognorm(0.4, scale=2), uniform(1, 2), truncnorm(-1, 3, 1, 0.5), and the
    /// far tail truncnorm(6, 7, 0, 1).
    #[test]
    fn quantiles_are_those_of_scipy() {
        for (text, wanted) in [
            ("normal(1,0.5)", [-0.5451161530839066, 0.7377997436459796, 1.0, 1.979981992270027]),
            ("lognormal(2,0.4)", [0.5810341523133201, 1.62155728651761, 2.0, 4.380368154417211]),
            ("uniform(1,3)", [1.002, 1.6, 2.0, 2.95]),
            (
                "normal(1,0.5,0.5,2.5)",
                [0.501732734161232, 0.887068140483091, 1.0992239498017236, 2.003735486021077],
            ),
            (
                "normal(0,1,6,7)",
                [6.000162245969133, 6.0575631913034345, 6.111358215508885, 6.565596387454304],
            ),
        ] {
            let distribution = read(text);
            assert_eq!(distribution.to_string(), text);
            for (share, wanted) in [0.001, 0.3, 0.5, 0.975].into_iter().zip(wanted) {
                let found: f64 = distribution.quantile(share);
                assert!(
                    (found / wanted - 1.0).abs() < 1e-12,
                    "{text} at {share}: {found}, {wanted}"
                );
            }
        }
    }

    #[test]
    fn what_is_cut_off_is_never_drawn_and_shares_are_of_what_is_left() {
        for text in ["normal(0.1,0.2,0,0.3)", "lognormal(1,2,0.5,4)", "uniform(-1,1,-0.5,2)"] {
            let (distribution, cut) = (read(text), read(text).cut.unwrap());
            let (low, high) = (distribution.quantile(0.0), distribution.quantile(1.0));
            assert!(low >= cut.0 && high <= cut.1 && high > low, "{text}: {low}, {high}");
            assert_eq!(distribution.outside(cut.0, cut.1), (0.0, 0.0), "{text}");
            for share in [0.1, 0.5, 0.8] {
                let value = distribution.quantile(share);
                let (below, above) = distribution.outside(value, value);
                assert!((below - share).abs() < 1e-12 && (above + share - 1.0).abs() < 1e-12);
            }
        }
        let (below, above) = read("normal(0.2,0.1)").outside(0.0, f64::INFINITY);
        assert!((below - 0.022_750_131_948_179_2).abs() < 1e-15 && above == 0.0, "{below}");
    }

    #[test]
    fn what_is_no_distribution_is_refused_with_its_reason() {
        let error = |text: &str| text.parse::<Distribution>().unwrap_err();
        assert_eq!(error("0.1"), DistributionError::Form("0.1".into()));
        assert_eq!(error("gauss(1,2)"), DistributionError::Form("gauss(1,2)".into()));
        assert!(matches!(error("normal(1)"), DistributionError::Count(_, 1, "normal", _)));
        assert!(matches!(error("normal(1,2,3)"), DistributionError::Count(_, 3, ..)));
        assert!(matches!(error("normal(1,x)"), DistributionError::Number(..)));
        assert!(matches!(error("normal(1,inf)"), DistributionError::Number(..)));
        assert!(matches!(
            error("normal(1,0)"),
            DistributionError::NotPositive("the deviation", ..)
        ));
        assert!(matches!(
            error("lognormal(0,1)"),
            DistributionError::NotPositive("the median", ..)
        ));
        assert!(matches!(error("uniform(2,1)"), DistributionError::Order(..)));
        assert!(matches!(error("normal(0,1,5,5)"), DistributionError::Order(..)));
        assert!(matches!(error("uniform(0,1,2,3)"), DistributionError::Empty(..)));
        let line = error("normal(0,1,3)").to_string();
        assert_eq!(
            line,
            "'normal(0,1,3)' has 3 numbers; normal has two, MEAN,DEVIATION, and two more, LOW,HIGH, where it \
             is to be cut off"
        );
    }
}
