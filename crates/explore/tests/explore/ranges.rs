use topple::scene::parameters::PARAMETERS;

/// What a slider gives is accepted without `force`, but for ends that a number may not have itself.
#[test]
fn ranges_lie_among_legal_and_plausible_numbers() {
    for entry in PARAMETERS {
        let range = entry.slider;
        assert!(range.low < range.high, "{}", entry.key);
        assert!(!range.log || range.low > 0.0, "{}", entry.key);
        let inside = |share: f64| range.low + share * (range.high - range.low);
        for value in [inside(0.01), inside(0.6), inside(0.99)] {
            let value = if matches!(entry.key, "bouc_wen_n") { value.round() } else { value };
            assert!(entry.legal.holds(value), "{} {value}", entry.key);
            let (_, most) = entry.plausible;
            assert!(value.abs() <= most, "{} {value}", entry.key);
        }
    }
}
