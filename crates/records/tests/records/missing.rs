//! Codes of missing samples.

use topple_records::missing::told;

#[test]
fn codes_of_missing_samples_are_told_and_samples_are_not() {
    let wave = |k: usize| (1.0e3 * (0.05 * k as f64).sin() * 100.0).round() / 100.0 + 0.001;
    let of = |code: f64| {
        let mut values: Vec<f64> = (0..400).map(wave).collect();
        assert_eq!(told(&values), None);
        (values[100], values[300]) = (code, code);
        told(&values)
    };
    for code in [-999.0, -9999.0, 99999.0, 999.99] {
        let said = of(code).unwrap_or_default();
        let wanted = format!("2 samples are exactly {code}, number 101 first: ");
        assert!(said.starts_with(&wanted), "{said}");
    }
    // wave(100) is -958.9 and wave(300) 650.3: 99 is far from both.
    assert!(of(-99.0).is_some());
    assert_eq!(of(-999.5), None);
    // Counts of a digitizer pass by such a value.
    let mut counts: Vec<f64> = (0..400).map(|k| f64::from(k - 200) * 11.0 - 9.0).collect();
    assert!(counts.contains(&-999.0));
    assert_eq!(told(&counts), None);
    counts[399] = -999.0;
    assert!(told(&counts).is_some());
}
