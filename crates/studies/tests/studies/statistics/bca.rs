use topple_studies::statistics::bca::{acceleration, ends};
use topple_studies::statistics::normal;

/// Standard deviations of a normal distribution on either side of its mean that hold 95 %.
const DEVIATIONS: f64 = 1.959_963_984_540_054;

/// The values 1 to `count`.
fn values(count: u32) -> Vec<f64> {
    (1..=count).map(f64::from).collect()
}

#[test]
fn ends_are_between_ranks_and_open_at_an_infinite_value() {
    let near = |found: [Option<f64>; 2], wanted: [f64; 2]| {
        found.iter().zip(wanted).all(|(found, wanted)| (found.unwrap() - wanted).abs() < 1e-6)
    };
    assert_eq!(ends(values(38), 19.5, 0.0), [None, None]);
    assert!(near(ends(values(39), 20.0, 0.0), [1.0, 39.0]));
    assert!(near(ends(values(99), 50.0, 0.0), [2.5, 97.5]));
    let mut open = values(99);
    open[98] = f64::INFINITY;
    assert!(near(ends(open.clone(), 50.0, 0.0), [2.5, 97.5]));
    open[97] = f64::INFINITY;
    assert_eq!(ends(open, 50.0, 0.0)[1], Some(f64::INFINITY));
}

#[test]
fn ends_move_with_the_estimate() {
    // Phi(0.25) of the values are below: half a deviation is added to either point.
    let count = 9999;
    let estimate = normal::cdf(0.25) * 1.0e4;
    let wanted = [-1.0, 1.0].map(|side| normal::cdf(0.5 + side * DEVIATIONS) * 1.0e4);
    for (found, wanted) in ends(values(count), estimate, 0.0).into_iter().zip(wanted) {
        assert!((found.unwrap() - wanted).abs() < 3.0, "{found:?} {wanted}");
    }
    assert_eq!(ends(values(100), 1.0e3, 0.0), [Some(100.0); 2]);
    // A positive skewness moves both points up.
    let skewed = ends(values(count), 5000.0, 0.1);
    for (found, side) in skewed.into_iter().zip([-DEVIATIONS, DEVIATIONS]) {
        let wanted = normal::cdf(side / (1.0 - 0.1 * side)) * 1.0e4;
        assert!((found.unwrap() - wanted).abs() < 3.0, "{found:?} {wanted}");
    }
}

#[test]
fn acceleration_is_a_sixth_of_the_skewness() {
    // Means of x without one: the values 1, 1, 4 have the deviations -1, -1, 2, those of the rest half, turned around.
    assert!((acceleration(&[2.5, 2.5, 1.0]) - 6.0 / (6.0 * 6.0_f64.powf(1.5))).abs() < 1.0e-12);
    assert_eq!(acceleration(&[1.0; 4]), 0.0);
    assert_eq!(acceleration(&[1.0, f64::INFINITY]), 0.0);
    assert_eq!(acceleration(&[]), 0.0);
}
