use topple_studies::statistics::quantile::{Sorted, middle_95_percent, weighted};

#[test]
fn quantiles_are_those_of_numpy() {
    // numpy.percentile([3, 1, 2, 10], [0, 16, 50, 84, 100])
    let sorted = Sorted::of(vec![3.0, 1.0, 2.0, 10.0]);
    for (share, value) in [(0.0, 1.0), (0.16, 1.48), (0.5, 2.5), (0.84, 6.64), (1.0, 10.0)] {
        let found = sorted.quantile(share).unwrap();
        assert!((found - value).abs() < 1e-12, "{share}: {found}");
    }
}

#[test]
fn the_nearest_value_is_one_of_the_values_and_a_rank_beyond_an_end_is_the_end() {
    let sorted = Sorted::of(vec![3.0, 1.0, 2.0, 10.0]);
    let nearest = [0.0, 0.16, 0.5, 0.84, 1.0].map(|share| sorted.nearest(share).unwrap());
    assert_eq!(nearest, [1.0, 1.0, 3.0, 10.0, 10.0]);
    assert_eq!([-1.0, 7.0].map(|rank| sorted.at_rank(rank).unwrap()), [1.0, 10.0]);
}

#[test]
fn of_no_values_there_is_no_quantile() {
    let none = Sorted::of(Vec::new());
    assert_eq!((none.quantile(0.5), none.nearest(0.5), none.at_rank(0.0)), (None, None, None));
    assert!(middle_95_percent(Vec::new()).0.is_nan());
    assert!(weighted(Vec::new(), [0.5, 1.0]).iter().all(|value| value.is_nan()));
}

#[test]
fn ends_leave_as_many_values_beyond_either() {
    assert_eq!(middle_95_percent((0..=1000).map(f64::from).collect()), (25.0, 975.0));
}

/// numpy.percentile(values, [50, 84, 100], method="inverted_cdf", weights=weights)
#[test]
fn weighted_quantiles_are_those_of_numpy() {
    let values = [3.0, 1.0, 2.0, 10.0, 4.0, 7.0];
    let of =
        |weights: [f64; 6]| weighted(values.into_iter().zip(weights).collect(), [0.5, 0.84, 1.0]);
    assert_eq!(of([1.0; 6]), [3.0, 10.0, 10.0]);
    assert_eq!(of([1.0, 5.0, 1.0, 1.0, 1.0, 1.0]), [1.0, 7.0, 10.0]);
}
