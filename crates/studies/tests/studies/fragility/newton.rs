use topple_studies::fragility::newton::{Point, maximum};

#[test]
fn halved_steps_reach_a_maximum_that_full_steps_fly_past() {
    // -ln cosh: from beyond 1.09 full steps go further and further away.
    let function = |[x, y]: [f64; 2]| {
        let one = |x: f64| (x.abs() + (0.5 + 0.5 * (-2.0 * x.abs()).exp()).ln(), x.tanh());
        let ((fx, tx), (fy, ty)) = (one(x - 0.3), one(y + 0.2));
        let curvature = [1.0 - tx * tx, 0.0, 1.0 - ty * ty];
        Some(Point { value: -fx - fy, gradient: [-tx, -ty], curvature })
    };
    for start in [[2.0, 0.0], [-5.0, 9.0], [15.0, -15.0]] {
        let [x, y] = maximum(start, function).unwrap();
        assert!((x - 0.3).abs() < 1.0e-12 && (y + 0.2).abs() < 1.0e-12, "{x} {y}");
    }
}

#[test]
fn no_maximum_no_answer() {
    let rising = |[x, _]: [f64; 2]| {
        Some(Point { value: x, gradient: [1.0, 0.0], curvature: [0.0, 0.0, 1.0] })
    };
    assert_eq!(maximum([0.0, 0.0], rising), None);
    assert_eq!(maximum([0.0, 0.0], |_| None), None);
}
