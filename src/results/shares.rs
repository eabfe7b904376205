//! Shares of a whole, as legends tell them.

/// Shares of a whole in tenths of a percent that sum to 100.0 %: those with the largest remainders are
/// rounded up. What is there but below a tenth is said to be.
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
        (floor, _) => format!("{}.{} %", floor / 10, floor % 10),
    };
    floors.iter().zip(counts).map(written).collect()
}

#[cfg(test)]
mod tests {
    use super::shares;

    #[test]
    fn shares_sum_to_a_hundred_percent() {
        assert_eq!(shares(&[1, 1, 1]), ["33.4 %", "33.3 %", "33.3 %"]);
        assert_eq!(shares(&[999_999, 1]), ["100.0 %", "< 0.1 %"]);
        // Each rounded by itself these make 100.1 %.
        let counts = [3966, 517, 4105, 256, 876, 175, 44, 16, 6, 39];
        let sum: f64 = shares(&counts)
            .iter()
            .filter_map(|share| share.trim_end_matches(" %").parse::<f64>().ok())
            .sum();
        assert!((sum - 100.0).abs() < 1.0e-9, "{sum}");
    }
}
