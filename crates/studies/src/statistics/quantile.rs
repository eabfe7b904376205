//! Quantiles of values. Types are those of Hyndman & Fan (1996), Am. Stat. 50:361-365.
//!
//! | rule | of what |
//! |---|---|
//! | between two ranks in proportion, rank p (N - 1) from zero: type 7, as numpy's default | values as they are: spectra, medians |
//! | the same, rank p (N + 1) - 1: type 6 ([`Sorted::at_rank`]) | corrected ends of a bootstrap interval |
//! | the value of the rank that is nearest to p (N - 1) | plain ends of a bootstrap interval, errors |
//! | the least value at or below which a share of the weights lies: type 1 | weighted motions |
//!
//! The four differ by less than the distance of neighbouring values. A bootstrap's values may be infinite, and motions
//! are weighted, for which type 7 has no answer.

/// Values in ascending order.
#[derive(Debug, Clone, PartialEq)]
pub struct Sorted(Vec<f64>);

impl Sorted {
    /// Sorts values; those that are not numbers stand at the ends.
    pub fn of(mut values: Vec<f64>) -> Sorted {
        values.sort_by(f64::total_cmp);
        Sorted(values)
    }

    /// The values.
    pub fn values(&self) -> &[f64] {
        &self.0
    }

    /// The quantile of a share, 0 to 1, by type 7; none of no values.
    pub fn quantile(&self, share: f64) -> Option<f64> {
        self.at_rank(share * self.last()? as f64)
    }

    /// What lies at a rank from zero, between two values in proportion, and not beyond the smallest and the largest; none
    /// of no values. Between two values that are infinite it is not a number.
    pub fn at_rank(&self, rank: f64) -> Option<f64> {
        let last = self.last()?;
        let rank = rank.clamp(0.0, last as f64);
        let place = rank.floor() as usize;
        let (from, to) = (self.0[place], self.0[(place + 1).min(last)]);
        Some(from + (rank - place as f64) * (to - from))
    }

    /// The value nearest to the quantile of a share, 0 to 1, by its rank; none of no values.
    pub fn nearest(&self, share: f64) -> Option<f64> {
        self.0.get((share * self.last()? as f64).round() as usize).copied()
    }

    fn last(&self) -> Option<usize> {
        self.0.len().checked_sub(1)
    }
}

/// The ends between which 95 % of the values lie, as many beyond either; not numbers of no values.
pub fn middle_95_percent(values: Vec<f64>) -> (f64, f64) {
    let sorted = Sorted::of(values);
    let end = |share| sorted.nearest(share).unwrap_or(f64::NAN);
    (end(0.025), end(0.975))
}

/// The least values at or below which shares of the weights lie, as numpy's percentile by `inverted_cdf`; not numbers of
/// no values. A value stands before its weight.
pub fn weighted<const N: usize>(mut values: Vec<(f64, f64)>, shares: [f64; N]) -> [f64; N] {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let all: f64 = values.iter().map(|(_, weight)| weight).sum();
    shares.map(|share| {
        let mut sum = 0.0;
        let reached = values.iter().find(|(_, weight)| {
            sum += weight;
            sum >= (share - 1.0e-12) * all
        });
        reached.or(values.last()).map_or(f64::NAN, |(value, _)| *value)
    })
}
