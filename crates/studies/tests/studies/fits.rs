//! Fragilities against SciPy's figures on the same runs (crates/studies/tests/data/fits.py).

use std::collections::BTreeMap;
use std::f64::consts::PI;

use topple_studies::fragility::cloud::Cloud;
use topple_studies::fragility::ida::Capacities;
use topple_studies::fragility::runs::{Pool, Stripe};
use topple_studies::fragility::{Capacity, Fit, Lognormal, RecordRuns, Run, hazard_text, stripes};
use topple_studies::suites::intensity::Intensity;

/// Rows of a table without its header.
fn rows(table: &str) -> impl Iterator<Item = Vec<&str>> {
    table.lines().skip(1).map(|line| line.split(',').collect())
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

/// The sets of runs by their names.
fn sets() -> BTreeMap<&'static str, Vec<RecordRuns>> {
    let mut sets: BTreeMap<&str, Vec<RecordRuns>> = BTreeMap::new();
    let mut before = ("", "");
    for row in rows(include_str!("../data/fits_runs.csv")) {
        let records = sets.entry(row[0]).or_default();
        if before != (row[0], row[1]) {
            records.push(RecordRuns {
                weight: number(row[2]),
                group: records.len(),
                runs: Vec::new(),
            });
            before = (row[0], row[1]);
        }
        let run = Run {
            level: number(row[3]),
            failed: row[4] == "1",
            collapsed: row[5] == "1",
            demand: row[6].parse().ok(),
        };
        records.last_mut().unwrap().runs.push(run);
    }
    sets
}

fn assert_near(what: &str, found: f64, wanted: f64) {
    assert!((found / wanted - 1.0).abs() < 1.0e-6, "{what}: {found}, SciPy has {wanted}");
}

#[test]
fn every_estimator_agrees_with_scipy() {
    let sets = sets();
    let mut compared = 0;
    for row in rows(include_str!("../data/fits_figures.csv")) {
        let [set, estimator, theta, beta] = row[..] else { panic!("{row:?}") };
        let records = &sets[set];
        let fit = match estimator {
            "stripes" => stripes::fit(&Pool::of(records, |run| run.failed).stripes(None)),
            "ida" => Capacities::of(records).fit(),
            _ => Cloud::of(records).fit(),
        };
        let name = format!("{set}, {estimator}");
        match (fit, theta) {
            (Fit::Fitted(curve), theta) if !theta.is_empty() => {
                assert_near(&name, curve.theta, number(theta));
                assert_near(&name, curve.beta, number(beta));
            }
            (Fit::Separable(_), "") => (),
            (fit, _) => panic!("{name}: {fit:?}, SciPy has `{theta}`"),
        }
        compared += 1;
    }
    assert!(compared >= 33 && compared == 3 * sets.len(), "{compared}");
}

#[test]
fn annual_rates_agree_with_scipy() {
    let curve = hazard_text::read(include_str!("../data/fits_curve.csv"), Intensity::Pga, None)
        .unwrap()
        .curve;
    for row in rows(include_str!("../data/fits_rates.csv")) {
        let [theta, beta, rate] = [0, 1, 2].map(|column| number(row[column]));
        let found = curve.rate(Lognormal { theta, beta });
        assert_near(&format!("theta {theta}, beta {beta}"), found.rate, rate);
    }
}

/// oq-vmtk (at eb19522) minimises 1/sum ln f, we -sum ln f. Of probabilities the sum is below zero and both have their
/// minimum at one place. Of densities, as in the fit of capacities, the sum may be above zero: 1/sum is then least where
/// the sum comes to zero from below, which is no maximum of anything.
#[test]
fn the_inverse_of_the_sum_serves_probabilities_only() {
    let sets = sets();
    let curves = || {
        (1..400).flat_map(|i| {
            let curve =
                move |j| Lognormal { theta: 0.02 * f64::from(i), beta: 0.02 * f64::from(j) };
            (1..100).map(curve)
        })
    };
    let least = |target: &dyn Fn(Lognormal) -> f64| -> Lognormal {
        curves().min_by(|a, b| target(*a).total_cmp(&target(*b))).unwrap()
    };
    let stripes = Pool::of(&sets["plain"], |run| run.failed).stripes(None);
    let of_counts = |curve: Lognormal| -> f64 {
        let ln = |x: f64| x.max(f64::MIN_POSITIVE).ln();
        let one = |s: &Stripe| {
            let p = curve.probability(s.level);
            s.z * ln(p) + (s.n - s.z) * ln(1.0 - p)
        };
        stripes.iter().map(one).sum()
    };
    let ours = stripes::fit(&stripes).curve().unwrap();
    let [inverse, negative] =
        [least(&|curve| 1.0 / of_counts(curve)), least(&|curve| -of_counts(curve))];
    assert_eq!(inverse, negative);
    assert!((negative.theta - ours.theta).abs() < 0.021, "{negative:?} {ours:?}");
    assert!((negative.beta - ours.beta).abs() < 0.021, "{negative:?} {ours:?}");

    // Capacities in a unit in which they are small: 5/1000.
    let capacities: Vec<f64> = sets["narrow"]
        .iter()
        .map(|record| 1.0e-3 * Capacity::of(&record.runs).unwrap().lowest)
        .collect();
    let of_capacities = |curve: Lognormal| -> f64 {
        let theta = 1.0e-3 * curve.theta;
        let one = |x: &f64| {
            let u = (x / theta).ln() / curve.beta;
            -0.5 * u * u - (x * curve.beta * (2.0 * PI).sqrt()).ln()
        };
        capacities.iter().map(one).sum()
    };
    let ours = Capacities::of(&sets["narrow"]).fit().curve().unwrap();
    let [inverse, negative] =
        [least(&|curve| 1.0 / of_capacities(curve)), least(&|curve| -of_capacities(curve))];
    assert!((negative.theta / ours.theta).ln().abs() < 0.01, "{negative:?} {ours:?}");
    assert!((inverse.theta / ours.theta).ln().abs() > 0.1, "{inverse:?} {ours:?}");
}
