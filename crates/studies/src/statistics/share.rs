//! Intervals of shares of records, some of which belong together.

use super::Bootstrap;
use super::bca::{acceleration, ends};

/// The share of either tail of an interval of 95 %.
const TAIL: f64 = 0.025;

/// Sets of groups of records, drawn with replacement, that intervals of any shares of these records are made of.
#[derive(Debug, Clone)]
pub struct DrawnGroups {
    /// The group of each record, by numbers without gaps.
    of: Vec<usize>,
    count: usize,
    /// How often each group is in a set.
    sets: Vec<Vec<u32>>,
    /// The upper ends of the shares of independent groups of which none fails, and one.
    few: [f64; 2],
}

/// Upper ends of 95 % of the share of `count` independent trials of which none fails, and one (Clopper & Pearson 1934).
fn few(count: usize) -> [f64; 2] {
    let n = count as f64;
    let none = 1.0 - TAIL.powf(1.0 / n);
    // At most one failure has the probability (1 - p)^n + n p (1 - p)^(n - 1), which falls with p.
    let most = |p: f64| (1.0 - p).powf(n - 1.0) * (1.0 - p + n * p);
    let (mut low, mut high) = (none, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if most(middle) > TAIL { low = middle } else { high = middle }
    }
    [none, high]
}

impl DrawnGroups {
    /// Draws sets; `of` has the group of each record, `count` says how many groups there are.
    pub fn of(of: &[usize], count: usize, bootstrap: &Bootstrap) -> DrawnGroups {
        let sets = (0..bootstrap.replicates).map(|set| bootstrap.multipliers(count, set)).collect();
        DrawnGroups { of: of.to_vec(), count, sets, few: few(count) }
    }

    /// The interval of 95 % of a share, which is the mean of the records' `parts` by their weights. Groups are drawn, not
    /// records, and the ends are corrected for bias and acceleration ([`ends`]). Where all parts are 0, or all 1, each set has
    /// the same share: then the interval is that of as many independent trials as there are groups (Clopper & Pearson 1934,
    /// Biometrika 26(4), 404-413). Where few fail, sets tell too little: no end is closer than that of such trials of which as
    /// many fail, up to one, linear between none and one. None of one group with both kinds.
    pub fn interval(&self, parts: &[f64], weights: &[f64]) -> [Option<f64>; 2] {
        let mut sums = vec![[0.0; 2]; self.count];
        for ((group, part), weight) in self.of.iter().zip(parts).zip(weights) {
            let [z, n] = &mut sums[*group];
            (*z, *n) = (*z + weight * part, *n + weight);
        }
        let share = |times: &dyn Fn(usize) -> f64| {
            let add = |[z, n]: [f64; 2], (group, [of_z, of_n]): (usize, &[f64; 2])| {
                [z + times(group) * of_z, n + times(group) * of_n]
            };
            let [z, n] = sums.iter().enumerate().fold([0.0; 2], add);
            (n > 0.0).then_some(z / n)
        };
        let Some(estimate) = share(&|_| 1.0) else { return [None; 2] };
        let [none, one] = self.few;
        if estimate <= 0.0 {
            return [Some(0.0), Some(none)];
        }
        // A sum of weights may be off by its last digits.
        if estimate >= 1.0 - 1.0e-12 {
            return [Some(1.0 - none), Some(1.0)];
        }
        if self.count < 2 {
            return [None; 2];
        }
        let drawn = self.sets.iter().filter_map(|times| share(&|group| f64::from(times[group])));
        let without = (0..self.count)
            .filter_map(|left| share(&|group| f64::from(u8::from(group != left))))
            .collect::<Vec<_>>();
        let [low, high] = ends(drawn.collect(), estimate, acceleration(&without));
        let least = |share: f64| none + (one - none) * (share * self.count as f64).min(1.0);
        [
            low.map(|low| low.min(1.0 - least(1.0 - estimate))),
            high.map(|high| high.max(least(estimate))),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SETS: Bootstrap = Bootstrap { replicates: 4000, seed: 1 };

    fn near(found: [Option<f64>; 2], low: f64, high: f64, within: f64) {
        let found = found.map(Option::unwrap);
        assert!((found[0] - low).abs() < within && (found[1] - high).abs() < within, "{found:?}");
    }

    /// Of 100 independent records 30 fail: the normal approximation has 0.3 -+ 1.96 sqrt(0.21/100) = 0.210 and 0.390. Steps
    /// of a hundredth, and the noise of 4000 sets, are within 0.015.
    #[test]
    fn independent_records_have_the_interval_of_a_binomial_share() {
        let groups: Vec<usize> = (0..100).collect();
        let parts: Vec<f64> = groups.iter().map(|k| if *k < 30 { 1.0 } else { 0.0 }).collect();
        let drawn = DrawnGroups::of(&groups, 100, &SETS);
        near(drawn.interval(&parts, &[1.0; 100]), 0.210, 0.390, 0.015);
    }

    /// Ten records each of ten groups that behave alike are ten records.
    #[test]
    fn records_of_a_group_that_behave_alike_count_once() {
        let groups: Vec<usize> = (0..100).map(|k| k / 10).collect();
        let parts: Vec<f64> = groups.iter().map(|g| if *g < 3 { 1.0 } else { 0.0 }).collect();
        let many = DrawnGroups::of(&groups, 10, &SETS).interval(&parts, &[1.0; 100]);
        let one = DrawnGroups::of(&(0..10).collect::<Vec<_>>(), 10, &SETS);
        let once: Vec<f64> = (0..10).map(|k| if k < 3 { 1.0 } else { 0.0 }).collect();
        assert_eq!(many, one.interval(&once, &[1.0; 10]));
    }

    /// (1 - p)^n = 0.025: of 20 that all stand p = 0.1684 at the most.
    #[test]
    fn where_none_fails_the_share_may_still_be_some() {
        let groups: Vec<usize> = (0..20).collect();
        let drawn = DrawnGroups::of(&groups, 20, &SETS);
        near(drawn.interval(&[0.0; 20], &[1.0; 20]), 0.0, 0.168_43, 1.0e-5);
        near(drawn.interval(&[1.0; 20], &[0.5; 20]), 0.831_57, 1.0, 1.0e-5);
        assert_eq!(drawn.interval(&[0.0; 20], &[0.0; 20]), [None; 2]);
        let one = DrawnGroups::of(&[0, 0], 1, &SETS);
        assert_eq!(one.interval(&[1.0, 0.0], &[1.0; 2]), [None; 2]);
    }

    /// At most one failure of n has the probability (1 - p)^n + n p (1 - p)^(n - 1): of 20 it is 0.025 at p = 0.2487
    /// (0.7513^20 + 20 * 0.2487 * 0.7513^19 = 0.0033 + 0.0217). Ten records of each of 20 groups are no more than these: with one
    /// failure of 200 the end lies a tenth of the way from that of no failure, 0.1684.
    #[test]
    fn a_share_of_few_failures_has_a_wider_interval_than_none() {
        let groups: Vec<usize> = (0..20).collect();
        let one: Vec<f64> = groups.iter().map(|k| if *k == 0 { 1.0 } else { 0.0 }).collect();
        let [_, high] = DrawnGroups::of(&groups, 20, &SETS).interval(&one, &[1.0; 20]);
        assert!((0.248..0.26).contains(&high.unwrap()), "{high:?}");
        let groups: Vec<usize> = (0..200).map(|k| k / 10).collect();
        let drawn = DrawnGroups::of(&groups, 20, &SETS);
        let failed: Vec<f64> = (0..200).map(|k| if k == 0 { 1.0 } else { 0.0 }).collect();
        let [low, high] = drawn.interval(&failed, &[1.0; 200]).map(Option::unwrap);
        assert!(low < 0.005 && (high - (0.168_43 + 0.1 * 0.080_27)).abs() < 1.0e-4, "{high}");
        let stood: Vec<f64> = failed.iter().map(|part| 1.0 - part).collect();
        let [other, _] = drawn.interval(&stood, &[1.0; 200]).map(Option::unwrap);
        assert!((other - (1.0 - high)).abs() < 1.0e-12, "{other}");
    }
}
