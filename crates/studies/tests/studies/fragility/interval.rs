use topple_studies::Bootstrap;
use topple_studies::fragility::interval::{Interval, bootstrap};
use topple_studies::fragility::{Curve, Fit};
use topple_studies::fragility::{Gap, Lognormal};
use topple_studies::statistics::bca::ends;

/// Of two records: the first twice, each once, the second twice.
fn of_two(first: Fit, second: Fit) -> Interval {
    let curve = Curve::from(Lognormal { theta: 1.0, beta: 0.4 });
    let refit = |times: &[u32]| match times {
        [2, 0] => first,
        [0, 2] => second,
        _ => Fit::Fitted(curve),
    };
    bootstrap(&[3, 7], &Bootstrap { replicates: 400, seed: 4 }, curve, None, refit)
}

#[test]
fn sets_without_a_curve_count_as_what_they_say() {
    let gap = |stands, fails| Fit::Separable(Gap { stands, fails });
    let found = of_two(gap(Some(4.0), None), gap(Some(0.25), Some(1.0)));
    // A quarter of the sets each: none fails, so that theta is open above; a step at 0.5.
    assert_eq!(found.theta, [Some(0.5), None]);
    assert_eq!(found.beta, [Some(0.0), Some(0.4)]);
    assert!(found.without_fit.abs_diff(200) < 60, "{found:?}");
    let found = of_two(gap(None, Some(0.1)), Fit::NotIncreasing);
    assert_eq!((found.theta, found.beta), ([None, Some(1.0)], [None; 2]));
    // All sets that have a curve have the same.
    let found = of_two(Fit::TooFewFailed, Fit::NotIncreasing);
    assert_eq!((found.theta, found.beta), ([None; 2], [None; 2]));
}

#[test]
fn the_interval_of_a_mean_is_corrected_for_its_skewness() {
    // theta is the mean of values that are skewed, so that the corrected interval reaches further up than down, and
    // as far as ranks by the formula say.
    let values: Vec<f64> = (0..60).map(|k| (0.08 * f64::from(k)).exp()).collect();
    let mean = |times: &[u32]| {
        let sum: f64 = values.iter().zip(times).map(|(v, n)| v * f64::from(*n)).sum();
        sum / f64::from(times.iter().sum::<u32>())
    };
    let fit = |times: &[u32]| Fit::Fitted(Lognormal { theta: mean(times), beta: 1.0 }.into());
    let estimate = Curve::from(Lognormal { theta: mean(&[1; 60]), beta: 1.0 });
    let settings = Bootstrap { replicates: 4000, seed: 1 };
    let groups: Vec<usize> = (0..60).collect();
    let found = bootstrap(&groups, &settings, estimate, None, fit);
    let skewness = |n| values.iter().map(|v| (v - estimate.theta).powi(n)).sum::<f64>();
    let drawn = (0..4000).map(|k| mean(&settings.multipliers(60, k))).collect();
    let a = skewness(3) / (6.0 * skewness(2).powf(1.5));
    assert!(a > 0.02, "{a}");
    for (found, wanted) in found.theta.into_iter().zip(ends(drawn, estimate.theta, a)) {
        assert!((found.unwrap() / wanted.unwrap() - 1.0).abs() < 1.0e-9);
    }
}
