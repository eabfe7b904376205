use topple_studies::suites::shown::is_beyond;

#[test]
fn a_limit_is_compared_with_the_digits_of_the_table() {
    // 0.19098502 is shown of a number 5e-9 larger, 0.1 of one 1.5e-9 larger, 0.3 of one 1.2e-8 larger.
    for shown in ["0.19098502", "0.1", "0.3", "1.7e-5", "16777217", "0.7"] {
        let (value, limit) = (shown.parse::<f32>().unwrap(), value_of(shown));
        assert!(!is_beyond(value, limit), "{shown}");
        assert!(is_beyond(value, limit * (1.0 - 1.0e-9)), "{shown}");
        assert!(!is_beyond(value, limit * (1.0 + 1.0e-9)), "{shown}");
    }
    assert!(is_beyond(f32::INFINITY, 1.0) && !is_beyond(f32::NAN, 1.0));
    assert!(is_beyond(0.2, 0.1) && !is_beyond(0.1, 0.2) && !is_beyond(0.0, 0.0));
}

/// The number that somebody gives who copies what is shown.
fn value_of(shown: &str) -> f64 {
    shown.parse::<f32>().unwrap().to_string().parse().unwrap()
}
