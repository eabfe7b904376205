use topple_report::fragility::judged;

/// The estimate, the ends of its interval, and what the hazard curve may leave out are each judged.
#[test]
fn a_rate_keeps_the_target_surely_or_not() {
    let told = |rate: &str, high: &str, below: &str| {
        let missing = ("missing_above", "1.5e-4");
        let row = [("rate", rate), ("rate_high", high), ("below_target", below), missing];
        let row = row.into_iter().map(|(a, b)| (a.into(), b.into())).collect();
        judged(&row, 4.0e-4).unwrap_or_default()
    };
    assert!(told("1e-4", "2e-4", "1").ends_with("so does the upper end of its interval."));
    assert!(told("1e-4", "2e-2", "1").ends_with("it may not be kept."));
    assert!(told("1e-4", "", "0").ends_with("is not known: the rate has no upper bound."));
    // A step, or bounds alone.
    assert!(told("1e-4", "3e-4", "0").starts_with("By the upper end of its interval"));
    assert!(told("", "3e-4", "0").starts_with("By the upper end of its interval"));
    assert_eq!(told("5e-4", "6e-4", "0"), "This exceeds the accepted rate, 0.0004 a year.");
    assert!(told("3e-4", "3.5e-4", "0").starts_with("With what the hazard curve may leave out"));
    assert_eq!(told("", "", ""), "");
}
