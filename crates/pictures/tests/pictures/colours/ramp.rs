use topple_pictures::colours::ramp::probability;

/// Luma falls from a probability to a larger one, so that a print in grey has the same order.
#[test]
fn a_larger_probability_is_darker() {
    let luma = |share: f64| {
        let [r, g, b] = probability(share).map(f64::from);
        0.299 * r + 0.587 * g + 0.114 * b
    };
    for step in 0..64 {
        let (less, more) = (f64::from(step) / 64.0, f64::from(step + 1) / 64.0);
        assert!(luma(less) > luma(more) + 0.5, "{less}: {} {}", luma(less), luma(more));
    }
}
