use topple_studies::suites::spectrum::pseudo_acceleration;

/// Under a constant acceleration a the oscillator swings about -a/omega^2, first to (1 + exp(-xi pi/sqrt(1 - xi^2)))
/// times that.
#[test]
fn a_step_of_acceleration_has_its_closed_form() {
    let samples = vec![2.0; 4001];
    for period in [0.2, 1.0, 3.0] {
        for damping in [0.0_f64, 0.05, 0.5] {
            let overshoot =
                (-damping * std::f64::consts::PI / (1.0 - damping * damping).sqrt()).exp();
            let exact = 2.0 * (1.0 + overshoot);
            let got = pseudo_acceleration(&samples, 0.005, period, damping);
            assert!((got / exact - 1.0).abs() < 1.1e-6, "{period} {damping}: {got} {exact}");
        }
    }
}
