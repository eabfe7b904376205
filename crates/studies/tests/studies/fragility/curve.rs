use topple_studies::fragility::Lognormal;

#[test]
fn a_median_that_has_lost_digits_is_no_curve() {
    for ln_theta in [700.0, -700.0] {
        let curve = Lognormal::of_logarithm(ln_theta, 1.0).expect("a normal number");
        assert!((curve.theta.ln() - ln_theta).abs() < 1.0e-12 * 700.0);
    }
    // exp(-741.9) = 4e-323 has one digit, exp(-746) none, and exp(710) is infinite.
    for ln_theta in [-709.0, -741.9, -746.0, 710.0, f64::NAN] {
        assert_eq!(Lognormal::of_logarithm(ln_theta, 1.0), None, "{ln_theta}");
    }
}
