use topple_studies::Intensity;
use topple_studies::fragility::{HazardCurve, Lognormal, hazard_text, in_50_years};

fn table(text: &str) -> HazardCurve {
    hazard_text::read(text, Intensity::Pga, None).unwrap().curve
}

fn curve(rate: impl Fn(f64) -> f64, from: f64, to: f64, count: u32) -> HazardCurve {
    let point = |k: u32| {
        let level = from * (to / from).powf(f64::from(k) / f64::from(count - 1));
        (k as usize, [level, rate(level)])
    };
    HazardCurve::of(&(0..count).map(point).collect::<Vec<_>>()).unwrap()
}

#[test]
fn a_power_law_has_its_closed_form() {
    // lambda = k_0 x^-k: the rate is k_0 theta^-k exp(k^2 beta^2/2) (Cornell 1996).
    for (k, theta, beta) in [(2.0, 1.0, 0.4), (3.5, 0.4, 0.2), (1.0, 2.0, 0.8), (2.5, 0.7, 1.5)] {
        let hazard = curve(|x| 1.0e-3 * x.powf(-k), 1.0e-6, 1.0e9, 31);
        let wanted = 1.0e-3 * f64::powf(theta, -k) * (0.5 * k * k * beta * beta).exp();
        let found = hazard.rate(Lognormal { theta, beta });
        assert!((found.rate / wanted - 1.0).abs() < 1.0e-7, "{} {wanted}", found.rate);
    }
}

#[test]
fn trapezoids_go_to_the_rate_as_points_are_put_between() {
    let fragility = Lognormal { theta: 0.8, beta: 0.3 };
    let law = |x: f64| 0.01 * x.powf(-1.7);
    let wanted = curve(law, 0.1, 4.0, 6).rate(fragility).rate;
    let trapezoids = |count: u32| {
        let points = curve(law, 0.1, 4.0, count).points();
        let p = |point: &[f64; 2]| fragility.probability(point[0]);
        let gap = |ends: &[[f64; 2]]| 0.5 * (p(&ends[0]) + p(&ends[1])) * (ends[0][1] - ends[1][1]);
        points.windows(2).map(gap).sum::<f64>()
    };
    let errors = [50, 99, 197].map(|count| trapezoids(count) / wanted - 1.0);
    // A second-order rule: a quarter of the error with half of the distance.
    assert!(errors[0].abs() > 1.0e-4 && errors[2].abs() < 1.0e-3, "{errors:?}");
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1] - 4.0).abs() < 0.1, "{errors:?}");
    }
}

#[test]
fn a_step_takes_the_rates_above_it() {
    let hazard = table("level,rate\n1,1e-2\n4,1e-4\n");
    let rate = |theta| hazard.rate(Lognormal { theta, beta: 0.0 });
    let near = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 1.0e-12;
    // In the middle of ln x the rate is the geometric mean.
    assert!(near(rate(2.0).rate, 1.0e-3 - 1.0e-4), "{:?}", rate(2.0));
    assert!(near(rate(0.5).rate, 1.0e-2 - 1.0e-4) && rate(5.0).rate == 0.0);
    assert!(near(rate(2.0).missing_above, 1.0e-4) && rate(2.0).missing_below == 0.0);
    // Over four levels lambda falls to a hundredth, so that at half of the first level it is ten times as large.
    assert!(near(rate(0.5).missing_below, 1.0e-1 - 1.0e-2), "{:?}", rate(0.5));
    assert!(near(rate(0.5).at_most(), 1.0e-1), "{:?}", rate(0.5));
    let narrow = hazard.rate(Lognormal { theta: 2.0, beta: 1.0e-9 });
    assert!((narrow.rate / rate(2.0).rate - 1.0).abs() < 1.0e-7, "{narrow:?}");
}

/// The rate over the same power law from far below is found by quadrature, and what is missing by a closed form.
#[test]
fn what_is_missing_below_a_power_law_is_the_rate_of_its_part_below() {
    for (k, theta, beta) in [(2.0, 1.0, 0.4), (3.5, 0.4, 0.2), (1.0, 2.0, 0.8), (2.5, 0.7, 1.5)] {
        let law = |x: f64| 1.0e-3 * x.powf(-k);
        let fragility = Lognormal { theta, beta };
        let whole = curve(law, 1.0e-9, 30.0, 31).rate(fragility);
        for first in [0.01, 0.1, 0.7, 3.0, 20.0] {
            let cut = curve(law, first, 30.0, 5).rate(fragility);
            let found = cut.rate + cut.missing_below;
            assert!((found / whole.rate - 1.0).abs() < 2.0e-7, "{first}: {cut:?} {whole:?}");
            assert!(first < 0.5 * theta || cut.missing_below > 0.02 * whole.rate, "{cut:?}");
        }
    }
}

#[test]
fn the_rate_of_a_whole_curve_is_within_the_bound_of_each_part_of_it() {
    let points =
        [(0.5, 0.05), (1.0, 0.02), (2.0, 6e-3), (4.0, 1.2e-3), (8.0, 1.5e-4), (16.0, 1e-5)];
    let of = |points: &[(f64, f64)]| {
        let rows: String = points.iter().map(|(x, rate)| format!("{x},{rate}\n")).collect();
        table(&format!("level,rate\n{rows}"))
    };
    for theta in [0.1, 0.7, 3.0, 12.9, 100.0] {
        for beta in [0.0, 0.02, 0.4, 0.8, 1.6] {
            let fragility = Lognormal { theta, beta };
            let whole = of(&points).rate(fragility).rate;
            for from in 0..points.len() - 1 {
                let part = of(&points[from..]).rate(fragility);
                assert!(whole <= part.at_most() * (1.0 + 1.0e-12), "{theta} {beta}: {part:?}");
            }
        }
    }
}

/// What is beyond the largest number is no bound, and below no target.
#[test]
fn a_curve_that_says_nothing_of_what_is_below_has_no_bound_there() {
    let steep = table("level,rate\n1.4,1e-1\n1.4000001,1e-9\n");
    let rate = steep.rate(Lognormal { theta: 1.4, beta: 0.4 });
    assert_eq!((rate.missing_below, rate.at_most()), (f64::INFINITY, f64::INFINITY));
    let flat = table("level,rate\n1,1e-3\n2,1e-3\n");
    assert_eq!(flat.rate(Lognormal { theta: 0.1, beta: 0.4 }).missing_below, 0.0);
}

#[test]
fn flat_and_steep_curves_have_rates() {
    let flat = table("level,rate\n1,1e-3\n2,1e-3\n");
    let fragility = Lognormal { theta: 1.4, beta: 0.4 };
    assert_eq!(flat.rate(fragility).rate, 0.0);
    let steep = table("level,rate\n1.4,1e-1\n1.4000001,1e-9\n");
    assert!((steep.rate(fragility).rate / 0.05 - 1.0).abs() < 1.0e-5);
}

#[test]
fn fifty_years() {
    assert!((in_50_years(1.0 / 475.0) - 0.099_9).abs() < 1.0e-4);
    assert_eq!(in_50_years(0.0), 0.0);
    assert!((in_50_years(1.0e-14) / 5.0e-13 - 1.0).abs() < 1.0e-12);
}
