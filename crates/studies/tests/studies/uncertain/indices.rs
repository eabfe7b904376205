use std::f64::consts::PI;

use topple_studies::uncertain::indices::FEWEST_ROWS;
use topple_studies::uncertain::{Design, Explained, Index, Varied, indices};

/// Parameters that may have any value, in place of x_1, x_2, ...
const KEYS: [&str; 6] = ["phase", "tilt", "a_h", "a_v", "psi", "eccentricity"];

fn of(distributions: &[&str], n: usize, model: impl Fn(&[f64]) -> f64) -> Vec<Index> {
    let parameter = |(key, distribution): (&&str, &&str)| -> Varied {
        format!("{key}={distribution}").parse().unwrap()
    };
    let varied: Vec<Varied> = KEYS.iter().zip(distributions).map(parameter).collect();
    let design = Design::of(&varied, n, 5);
    assert_eq!(design.rows().count(), n * (varied.len() + 2));
    let y = |rows: &[Vec<f64>]| rows.iter().map(|row| model(row)).collect::<Vec<f64>>();
    let y_ab: Vec<Vec<f64>> = design.ab.iter().map(|rows| y(rows)).collect();
    indices(&y(&design.a), &y(&design.b), &y_ab, 0)
}

/// An index may be off by three standard errors, which the interval of 95 % tells, and the interval itself may be
/// as wide as N rows allow: a summand's standard deviation over the variance is below 2 in these models.
fn compare(found: &[Index], first: &[f64], total: &[f64], n: usize) {
    let widest = 2.0 * 1.96 * 2.0 / (n as f64).sqrt();
    let close = |found: Explained, wanted: f64| {
        let (value, low, high) = share(found);
        let said = format!("{found:?} for {wanted}");
        assert!(low <= value && value <= high && high - low < widest, "{said}");
        let error = (high - low) / (2.0 * 1.96);
        assert!((value - wanted).abs() <= 3.0 * error, "{said}");
    };
    for (i, index) in found.iter().enumerate() {
        close(index.first, first[i]);
        close(index.total, total[i]);
    }
}

fn share(found: Explained) -> (f64, f64, f64) {
    let [Some(value), Some(low), Some(high)] = found.numbers() else { panic!("{found:?}") };
    (value, low, high)
}

/// Ishigami & Homma (1990): sin x_1 + a sin² x_2 + b x_3⁴ sin x_1.
#[test]
fn ishigami() {
    let (a, b) = (7.0, 0.1);
    let uniform = "uniform(-3.141592653589793,3.141592653589793)";
    let n = 4096;
    let found = of(&[uniform; 3], n, |x| {
        x[0].sin() + a * x[1].sin().powi(2) + b * x[2].powi(4) * x[0].sin()
    });
    let v_1 = 0.5 * (1.0 + b * PI.powi(4) / 5.0).powi(2);
    let v_2 = a * a / 8.0;
    let v_13 = b * b * PI.powi(8) * (1.0 / 18.0 - 1.0 / 50.0);
    let v = v_1 + v_2 + v_13;
    compare(&found, &[v_1 / v, v_2 / v, 0.0], &[(v_1 + v_13) / v, v_2 / v, v_13 / v], n);
    // x_3 explains nothing by itself, but a quarter together with x_1.
    let ((_, low, high), (_, at_least, _)) = (share(found[2].first), share(found[2].total));
    assert!(low < 0.0 && high > 0.0 && at_least > 0.2);
}

/// Sobol's g-function: the product of (|4 x_i - 2| + a_i)/(1 + a_i).
#[test]
fn g_function() {
    let a = [0.0, 1.0, 4.5, 9.0, 99.0, 99.0];
    let n = 4096;
    let found = of(&["uniform(0,1)"; 6], n, |x| {
        x.iter().zip(a).map(|(x, a)| ((4.0 * x - 2.0).abs() + a) / (1.0 + a)).product()
    });
    let own = a.map(|a| 1.0 / (3.0 * (1.0_f64 + a).powi(2)));
    let all = own.iter().map(|own| 1.0 + own).product::<f64>();
    let v = all - 1.0;
    compare(&found, &own.map(|own| own / v), &own.map(|own| own * all / (1.0 + own) / v), n);
}

/// Of a sum each parameter explains its own variance, and both indices are the same.
#[test]
fn an_additive_model_and_a_parameter_without_effect() {
    let n = 1024;
    let found = of(&["normal(0,1)", "normal(5,2)", "uniform(0,1)"], n, |x| x[0] + x[1]);
    compare(&found, &[0.2, 0.8, 0.0], &[0.2, 0.8, 0.0], n);
    let (_, low, high) = share(found[2].first);
    assert!(low <= 0.0 && high >= 0.0, "{found:?}");
    assert_eq!(share(found[2].total), (0.0, 0.0, 0.0));
}

/// The generator drops the last bit of what it begins with.
#[test]
fn neighbouring_seeds_resample_other_rows() {
    let y: Vec<f64> = (0..40).map(|k| f64::from(k * k % 17)).collect();
    let y_ab = vec![y.iter().rev().copied().collect::<Vec<f64>>()];
    let ends = |seed| {
        let index = indices(&y, &y_ab[0], &y_ab, seed)[0];
        [share(index.first), share(index.total)].map(|(_, low, high)| [low, high])
    };
    for seed in [0, 2, u32::MAX - 1] {
        assert_ne!(ends(seed), ends(seed + 1), "seeds {seed} and {}", seed + 1);
    }
}

#[test]
fn an_output_that_never_changes_has_no_indices() {
    let found = of(&["uniform(0,1)"], 16, |_| 3.0);
    assert_eq!((found[0].first, found[0].total), (Explained::Constant, Explained::Constant));
}

/// An index of which the samples say nothing is no number, however narrow the interval is that so few rows give.
#[test]
fn too_few_samples_tell_no_index() {
    let both = ["uniform(0,1)"; 2];
    for n in 2..FEWEST_ROWS {
        for index in of(&both, n, |x| x[0] + 0.3 * x[1]) {
            assert_eq!((index.first, index.total), (Explained::TooFew, Explained::TooFew));
        }
    }
    let known = of(&both, 64, |x| x[0] + 0.3 * x[1]);
    assert!(share(known[0].first).0 > 0.7 && share(known[0].total).0 > 0.7, "{known:?}");
    // A rare event is all that the variance is of: where few rows have it, a narrow interval says nothing.
    let rare = of(&both, 16, |x| if x[0] * x[1] > 0.8 { 1.0 } else { 0.0 });
    assert!(rare.iter().all(|one| one.first == Explained::TooFew && one.total == one.first));
    // An interval as wide as all that an index may be.
    let wide = of(&both, 10, |x| (x[0] - 0.5) * (x[1] - 0.5));
    assert!(wide.iter().any(|one| one.first == Explained::TooFew), "{wide:?}");
}
