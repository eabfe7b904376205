//! How large a share can be of which a sample found some.

/// The chance that the bound of the last of several draws is too small.
const MISS: f64 = 0.05;

/// The largest share of which a sample of `drawn` has `found` or fewer with a chance of 5 % over `draws`: Clopper and
/// Pearson's upper limit, one-sided. Where up to so many draws are made, and what one of them finds decides whether another
/// follows, the limit of the last one is too small with a chance of 5 % at most: no more than the chances of all draws
/// together (Bonferroni). None found it is close to ln(20 draws)/drawn. A sample drawn in strata varies less than the
/// binomial that this is of.
pub fn share_at_most(found: usize, drawn: usize, draws: usize) -> f64 {
    if found >= drawn {
        return 1.0;
    }
    let miss = MISS / draws.max(1) as f64;
    let (mut low, mut high) = (found as f64 / drawn as f64, 1.0);
    // A double has no more than 53 bits to halve.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if at_most(found, drawn, middle) > miss { low = middle } else { high = middle }
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
    use super::{at_most, share_at_most};

    /// Of none found it is 1 - 0.05^(1/n); others by Clopper and Pearson's tables (R: `qbeta(0.95, k + 1, n - k)`).
    #[test]
    fn bounds_are_those_of_clopper_and_pearson() {
        let one = |found, drawn| share_at_most(found, drawn, 1);
        let none = 1.0 - 0.05_f64.powf(1.0 / 3000.0);
        assert!((one(0, 3000) - none).abs() < 1e-12);
        assert!((one(0, 3000) * 3000.0 - 3.0).abs() < 0.01);
        assert!((one(1, 10) - 0.3941633).abs() < 1e-6);
        assert!((one(5, 20) - 0.4555824).abs() < 1e-6);
        assert_eq!((one(4, 4), one(0, 0)), (1.0, 1.0));
        let of_three = 1.0 - (0.05_f64 / 3.0).powf(1.0 / 3000.0);
        assert!((share_at_most(0, 3000, 3) - of_three).abs() < 1e-12);
    }

    /// Draws end with the first that finds none. The chance that the last one's bound is below a share that stays the same
    /// is a sum over what may be found; it is largest just above the bound of a count.
    #[test]
    fn the_bound_of_the_last_draw_holds_at_95_percent() {
        let (drawn, draws) = (3000, 3);
        let mut largest = 0.0_f64;
        for count in 0..12 {
            let share = share_at_most(count, drawn, draws) * (1.0 + 1.0e-9);
            let (none, too_small) = (at_most(0, drawn, share), at_most(count, drawn, share));
            let (mut wrong, mut goes_on) = (0.0, 1.0);
            for _ in 1..draws {
                wrong += goes_on * none;
                goes_on *= 1.0 - none;
            }
            wrong += goes_on * too_small;
            largest = largest.max(wrong);
        }
        assert!(largest <= 0.05 && largest > 0.045, "{largest}");
    }
}
