//! How a number that is not known is distributed.

use super::distribution_error::DistributionError;
use super::normal;

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

impl Form {
    /// Its name, and what its two numbers are called.
    pub(super) const KNOWN: [(&'static str, &'static str); 3] =
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

    pub(super) fn text(self) -> (&'static str, [f64; 2]) {
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
    pub(super) fn shares(&self) -> [f64; 3] {
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
