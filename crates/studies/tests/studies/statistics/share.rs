use topple_studies::statistics::{Bootstrap, DrawnGroups};

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
