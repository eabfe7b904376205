//! The fit to an incremental dynamic analysis: each record's lowest failing level is its capacity.

use super::curve::Lognormal;
use super::fit::{Fit, Gap};
use super::link::probit;
use super::newton::{self, Point};
use super::runs::{RecordRuns, Weighed, weighed};

/// Records by their capacities.
#[derive(Debug)]
pub struct Capacities {
    records: Vec<Record>,
}

/// The capacity of a record, or the level up to which it has none.
#[derive(Debug, Clone, Copy)]
struct Record {
    weight: f64,
    /// The lowest failing level; the highest level where the record never fails.
    level: f64,
    /// Its logarithm.
    ln: f64,
    fails: bool,
    /// The highest level below the capacity, if there is one.
    stands: Option<f64>,
}

impl Capacities {
    /// Those of records.
    pub fn of(records: &[RecordRuns]) -> Capacities {
        Capacities::of_weighed(&weighed(records))
    }

    pub(super) fn of_weighed(records: &[Weighed]) -> Capacities {
        let record = |record: &Weighed| {
            let levels = || record.runs.iter().map(|run| run.level);
            let failing = record.runs.iter().filter(|run| run.failed).map(|run| run.level);
            let capacity = failing.reduce(f64::min);
            let below = levels().filter(|level| capacity.is_none_or(|fails| *level < fails));
            let stands = below.reduce(f64::max);
            let (level, fails) = (capacity.or(stands)?, capacity.is_some());
            Some(Record { weight: record.weight, level, ln: level.ln(), fails, stands })
        };
        Capacities { records: records.iter().filter_map(record).collect() }
    }

    /// The lognormal distribution of the capacities. Where every record fails, ln theta is the mean of ln x_i and beta
    /// their standard deviation, over n - 1. Where some never fail up to their highest level x_max, theta and beta
    /// maximise the product of phi((ln x_i - ln theta)/beta)/(x_i beta) over those that fail and of
    /// 1 - Phi(ln(x_max/theta)/beta) over the others. That is a maximum, not corrected for n - 1.
    ///
    /// A record that stands again above its lowest failing level counts as failing there: theta is then too low. The true
    /// capacity is between the lowest failing level and the level below it: theta is too high by up to the distance of
    /// levels, about half of it on average. A record that fails at its lowest level counts as if its capacity were that
    /// level.
    pub fn fit(&self) -> Fit {
        self.fit_near(None, None)
    }

    /// The same for resampled records, from a curve that is near.
    pub(super) fn fit_near(&self, times: Option<&[u32]>, near: Option<Lognormal>) -> Fit {
        let drawn: Vec<Record> = (self.records.iter().enumerate())
            .map(|(place, record)| {
                let times = times.map_or(1, |times| times[place]);
                Record { weight: record.weight * f64::from(times), ..*record }
            })
            .filter(|record| record.weight > 0.0)
            .collect();
        let count = times.map_or(drawn.len(), |times| times.iter().sum::<u32>() as usize) as f64;
        fit(&drawn, count, near)
    }
}

fn fit(records: &[Record], count: f64, near: Option<Lognormal>) -> Fit {
    let failing = || records.iter().filter(|record| record.fails);
    if records.is_empty() {
        return Fit::NoRuns;
    }
    let highest = records.iter().filter_map(|record| record.stands).reduce(f64::max);
    let lowest = failing().map(|record| record.level).reduce(f64::min);
    let (Some(lowest), Some(last)) =
        (lowest, failing().map(|record| record.level).reduce(f64::max))
    else {
        return Fit::Separable(Gap { stands: highest, fails: None });
    };
    if failing().nth(1).is_none() {
        return Fit::TooFewFailed;
    }
    // With one capacity for all the density grows without bound; a record that stands above it would hold it down.
    if lowest == last && records.iter().all(|record| record.fails || record.level <= lowest) {
        return Fit::Separable(Gap { stands: highest, fails: Some(lowest) });
    }
    let sum: f64 = records.iter().map(|record| record.weight).sum();
    let mean = |of: &dyn Fn(&Record) -> f64| {
        records.iter().map(|record| record.weight / sum * of(record)).sum::<f64>()
    };
    let centre = mean(&|record| record.ln);
    let variance = mean(&|record| (record.ln - centre).powi(2));
    if records.iter().all(|record| record.fails) {
        return Fit::of_logarithm(centre, (variance * count / (count - 1.0)).sqrt());
    }
    let spread = variance.sqrt();
    let standard: Vec<Record> = records
        .iter()
        .map(|record| Record {
            weight: record.weight / sum,
            ln: (record.ln - centre) / spread,
            ..*record
        })
        .collect();
    let likelihood = |[gamma, delta]: [f64; 2]| likelihood(&standard, gamma, delta);
    let from = |curve: Lognormal| {
        newton::maximum([spread / curve.beta, (curve.theta.ln() - centre) / curve.beta], likelihood)
    };
    match near.and_then(from).or_else(|| newton::maximum([1.0, 0.0], likelihood)) {
        Some([gamma, delta]) if gamma > 0.0 => {
            Fit::of_logarithm(centre + spread * delta / gamma, spread / gamma)
        }
        _ => Fit::NotIncreasing,
    }
}

/// The logarithm of the likelihood a record in gamma = 1/beta and delta = ln(theta)/beta, in which it is concave (Olsen
/// 1978, Econometrica 46, 1211-1215).
fn likelihood(records: &[Record], gamma: f64, delta: f64) -> Option<Point> {
    if !(gamma > 0.0) {
        return None;
    }
    let (mut value, mut gradient, mut curvature) = (0.0, [0.0; 2], [0.0; 3]);
    for Record { weight, ln, fails, .. } in records {
        let u = gamma * ln - delta;
        // By u, of which the derivatives are ln by gamma and -1 by delta.
        let (slope, bend) = if *fails {
            value += weight * (gamma.ln() - 0.5 * u * u);
            gradient[0] += weight / gamma;
            curvature[0] += weight / (gamma * gamma);
            (-u, 1.0)
        } else {
            let [_, stands] = probit(u);
            value += weight * stands.value;
            (stands.slope, stands.curvature)
        };
        gradient = [gradient[0] + weight * slope * ln, gradient[1] - weight * slope];
        let bend = weight * bend;
        curvature = [curvature[0] + bend * ln * ln, curvature[1] - bend * ln, curvature[2] + bend];
    }
    let finite = value.is_finite() && curvature.iter().chain(&gradient).all(|x| x.is_finite());
    finite.then_some(Point { value, gradient, curvature })
}
