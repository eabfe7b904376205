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
