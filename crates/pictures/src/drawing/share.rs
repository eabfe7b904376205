//! Shares of a whole in words and legends, in tenths of a percent. What is there is not called 0.0 %, and what is not all not 100.0 %.
//!
//! Twin: `percent` in crates/explore/src/page/numbers.js.

use topple::scene::record::rounded;

/// A share as a percentage.
pub fn percent(share: f64) -> String {
    let text = format!("{:.1} %", 100.0 * share);
    match &*text {
        "0.0 %" if share > 0.0 => "less than 0.1 %".into(),
        "100.0 %" if share < 1.0 => "more than 99.9 %".into(),
        _ => text,
    }
}

/// A share that somebody gave, or a percentile, as a percentage with all its digits.
pub fn given(share: f64) -> String {
    // Twelve digits: 100 times 0.29 is not 29.
    format!("{} %", rounded(100.0 * share, 12))
}

/// Shares of a whole that sum to 100.0 %: those with the largest remainders are rounded up.
pub fn shares(counts: &[usize]) -> Vec<String> {
    let total = counts.iter().sum::<usize>().max(1) as u128;
    let tenths = |count: usize| 1000 * count as u128;
    let mut floors: Vec<u128> = counts.iter().map(|count| tenths(*count) / total).collect();
    let mut order: Vec<usize> = (0..counts.len()).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(tenths(counts[k]) % total));
    let missing = 1000_u128.saturating_sub(floors.iter().sum()) as usize;
    for &k in order.iter().filter(|&&k| counts[k] > 0).take(missing) {
        floors[k] += 1;
    }
    let written = |(floor, count): (&u128, &usize)| match (floor, count) {
        (0, 1..) => "< 0.1 %".to_string(),
        (1000, count) if (*count as u128) < total => "> 99.9 %".to_string(),
        (floor, _) => format!("{}.{} %", floor / 10, floor % 10),
    };
    floors.iter().zip(counts).map(written).collect()
}

#[cfg(test)]
mod tests {
    use super::{given, percent, shares};

    #[test]
    fn shares_sum_to_a_hundred_percent() {
        assert_eq!(shares(&[1, 1, 1]), ["33.4 %", "33.3 %", "33.3 %"]);
        assert_eq!(shares(&[999_999, 1]), ["> 99.9 %", "< 0.1 %"]);
        assert_eq!(shares(&[7, 0]), ["100.0 %", "0.0 %"]);
        // Each rounded by itself these make 100.1 %.
        let counts = [3966, 517, 4105, 256, 876, 175, 44, 16, 6, 39];
        let sum: f64 = shares(&counts)
            .iter()
            .filter_map(|share| share.trim_end_matches(" %").parse::<f64>().ok())
            .sum();
        assert!((sum - 100.0).abs() < 1.0e-9, "{sum}");
    }

    #[test]
    fn what_is_neither_none_nor_all_is_not_said_to_be() {
        for (share, text) in [
            (0.0, "0.0 %"),
            (1.0, "100.0 %"),
            (0.5, "50.0 %"),
            (1.0 / 1444.0, "0.1 %"),
            (1.0 / 10_000.0, "less than 0.1 %"),
            (9_999.0 / 10_000.0, "more than 99.9 %"),
            (0.9994, "99.9 %"),
            (0.9996, "more than 99.9 %"),
            (0.0004, "less than 0.1 %"),
        ] {
            assert_eq!(percent(share), text, "{share}");
        }
        assert_eq!([0.29, 0.84, 0.9999, 1.0].map(given), ["29 %", "84 %", "99.99 %", "100 %"]);
        // A legend rounds as a sentence does.
        assert_eq!(shares(&[1443, 1]), ["99.9 %", "0.1 %"]);
    }
}
