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
