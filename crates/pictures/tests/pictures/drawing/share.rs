use topple_pictures::drawing::share::{given, percent, shares};

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
