//! How large a share can be of which a sample found some.

/// The chance that a bound is too small.
const MISS: f64 = 0.05;

/// The largest share of which a sample of `drawn` has `found` or fewer with a chance of 5 %: Clopper and Pearson's
/// upper limit, one-sided. None found it is close to 3/drawn. A sample drawn in strata varies less than the binomial
/// that this is of.
pub fn share_at_most(found: usize, drawn: usize) -> f64 {
    if found >= drawn {
        return 1.0;
    }
    let (mut low, mut high) = (found as f64 / drawn as f64, 1.0);
    // A double has no more than 53 bits to halve.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if at_most(found, drawn, middle) > MISS { low = middle } else { high = middle }
    }
    high
}

/// The chance that a binomial variable of `drawn` and `share` is `found` at most.
fn at_most(found: usize, drawn: usize, share: f64) -> f64 {
    let odds = (share / (1.0 - share)).ln();
    // ln of the chance of none, and from one count to the next.
    let mut term = drawn as f64 * (-share).ln_1p();
    let mut sum = term.exp();
    for k in 1..=found {
        term += ((drawn - k + 1) as f64 / k as f64).ln() + odds;
        sum += term.exp();
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::share_at_most;

    /// Of none found it is 1 - 0.05^(1/n); others by Clopper and Pearson's tables (R: `qbeta(0.95, k + 1, n - k)`).
    #[test]
    fn bounds_are_those_of_clopper_and_pearson() {
        let none = 1.0 - 0.05_f64.powf(1.0 / 3000.0);
        assert!((share_at_most(0, 3000) - none).abs() < 1e-12);
        assert!((share_at_most(0, 3000) * 3000.0 - 3.0).abs() < 0.01);
        assert!((share_at_most(1, 10) - 0.3941633).abs() < 1e-6);
        assert!((share_at_most(5, 20) - 0.4555824).abs() < 1e-6);
        assert_eq!((share_at_most(4, 4), share_at_most(0, 0)), (1.0, 1.0));
    }
}
