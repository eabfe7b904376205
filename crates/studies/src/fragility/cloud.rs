//! The fit to a cloud: a regression of the demand on those that stand, and the share of those that collapse.

use super::binary::{self, Binary, Line};
use super::curve::{Curve, Part, Shape};
use super::fit::{Fit, Gap};
use super::link::logit;
use super::runs::{Pool, RecordRuns, Weighed, weighed};

/// A cloud of runs, prepared for resampling.
#[derive(Debug)]
pub struct Cloud {
    /// Demands of each record; none where the limit state is no limit of a demand.
    demands: Option<Vec<Sums>>,
    /// The mean of ln x of the demands, which the sums are about.
    centre: f64,
    /// Runs by whether the block collapses; by whether the limit state fails where there are no demands.
    collapses: Pool,
    near: Option<Line>,
}

/// Sums over the runs of a record that stand and have a demand: of 1, s = ln x - centre, d = ln demand, and products.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    runs: f64,
    n: f64,
    s: f64,
    d: f64,
    ss: f64,
    sd: f64,
    dd: f64,
}

impl Cloud {
    /// Of records. Where no run has a demand, the probability of failing is fitted as that of collapse is.
    pub fn of(records: &[RecordRuns]) -> Cloud {
        Cloud::of_weighed(&weighed(records))
    }

    pub(super) fn of_weighed(records: &[Weighed]) -> Cloud {
        let some = records.iter().flat_map(|record| &record.runs).any(|run| run.demand.is_some());
        let collapses =
            Pool::of_weighed(records, |run| if some { run.collapsed } else { run.failed });
        let near = match binary::fit(&collapses.stripes(None), logit, None) {
            Binary::Line(line) => Some(line),
            _ => None,
        };
        let all: Sums = records.iter().map(|record| Sums::of(record, 0.0)).sum();
        let centre = if all.n > 0.0 { all.s / all.n } else { 0.0 };
        let demands = some.then(|| records.iter().map(|record| Sums::of(record, centre)).collect());
        Cloud { demands, centre, collapses, near }
    }

    /// The curve P = P(demand exceeds its limit | stands, x) (1 - P(C | x)) + P(C | x) (Jalayer et al. 2017, Earthquake
    /// Engng Struct. Dyn. 46(15)). It is not lognormal, unless nothing collapses: theta is the level where P = 1/2, and beta half the
    /// distance in ln x between P = Phi(-1) and P = Phi(1), about 16 % and 84 %.
    ///
    /// P(demand exceeds) is Phi((ln a + b ln x)/sigma), with a, b by weighted least squares over the runs that stand with
    /// a demand above zero, and sigma^2 the sum of squares over n - 2. Runs with a demand of zero have no logarithm and are
    /// left out. P(C) = 1/(1 + exp(-alpha_0 - alpha_1 ln x)) has the largest likelihood; where a level separates those
    /// that stand from those that collapse it is a step in the geometric middle. Neither part may fall with x, or else
    /// the curve need not pass a probability once.
    pub fn fit(&self) -> Fit {
        self.fit_resampled(None)
    }

    /// The same for resampled records.
    pub(super) fn fit_resampled(&self, times: Option<&[u32]>) -> Fit {
        let stripes = self.collapses.stripes(times);
        let logistic = |at, scale| Some(Part { shape: Shape::Logistic, at, scale });
        let collapse = match binary::fit(&stripes, logit, self.near) {
            Binary::NoRuns => return Fit::NoRuns,
            Binary::NotIncreasing => return Fit::NotIncreasing,
            Binary::Line(line) => logistic(line.at, line.scale),
            Binary::Separable(gap) if self.demands.is_none() => return Fit::Separable(gap),
            Binary::Separable(gap) => match (gap.stands, gap.fails) {
                (_, None) => None,
                (None, _) => return Fit::Separable(gap),
                (Some(stands), Some(fails)) => logistic(0.5 * (stands.ln() + fails.ln()), 0.0),
            },
        };
        let growth = match &self.demands {
            None => None,
            Some(records) => {
                let times = |place: usize| times.map_or(1, |times| times[place]);
                let drawn = records.iter().enumerate().map(|(k, sums)| sums.times(times(k)));
                match drawn.sum::<Sums>().growth(self.centre) {
                    Ok(growth) => Some(growth),
                    Err(why) => return why,
                }
            }
        };
        let (first, second) = match (growth, collapse) {
            (Some(growth), collapse) => (growth, collapse),
            (None, Some(collapse)) => (collapse, None),
            (None, None) => return Fit::NoRuns,
        };
        let Some(curve) = Curve::of(first, second) else { return Fit::NotIncreasing };
        if curve.beta <= 1.0e-12 * (1.0 + curve.theta.ln().abs()) {
            return Fit::Separable(Gap { stands: Some(curve.theta), fails: Some(curve.theta) });
        }
        Fit::Fitted(curve)
    }
}

impl Sums {
    fn of(record: &Weighed, centre: f64) -> Sums {
        let demand = |demand: &f64| *demand > 0.0 && demand.is_finite();
        let stand = record.runs.iter().filter(|run| !run.collapsed);
        let with = stand.filter_map(|run| Some((run.level, run.demand.filter(demand)?)));
        let one = |(level, demand): (f64, f64)| {
            let (s, d, w) = (level.ln() - centre, demand.ln(), record.weight);
            Sums {
                runs: 1.0,
                n: w,
                s: w * s,
                d: w * d,
                ss: w * s * s,
                sd: w * s * d,
                dd: w * d * d,
            }
        };
        with.map(one).sum()
    }

    fn times(self, times: u32) -> Sums {
        let k = f64::from(times);
        let Sums { runs, n, s, d, ss, sd, dd } = self;
        Sums { runs: k * runs, n: k * n, s: k * s, d: k * d, ss: k * ss, sd: k * sd, dd: k * dd }
    }

    fn growth(self, centre: f64) -> Result<Part, Fit> {
        let Sums { n, s, d, .. } = self;
        let (ss, sd, dd) = (self.ss - s * s / n, self.sd - s * d / n, self.dd - d * d / n);
        // What rounding leaves of sums of squares that are zero.
        const ZERO: f64 = 1.0e-14;
        if !(self.runs >= 3.0 && n > 2.0 && ss > ZERO * self.ss) {
            return Err(Fit::TooFewDemands);
        }
        let slope = sd / ss;
        let squares = dd - slope * sd;
        let sigma = if squares > ZERO * self.dd { (squares / (n - 2.0)).sqrt() } else { 0.0 };
        let at = centre + (s - d / slope) / n;
        if !(slope > 0.0 && at.is_finite() && (sigma / slope).is_finite()) {
            return Err(Fit::NotIncreasing);
        }
        Ok(Part { shape: Shape::Normal, at, scale: sigma / slope })
    }
}

impl std::iter::Sum for Sums {
    fn sum<I: Iterator<Item = Sums>>(all: I) -> Sums {
        all.fold(Sums::default(), |a, b| Sums {
            runs: a.runs + b.runs,
            n: a.n + b.n,
            s: a.s + b.s,
            d: a.d + b.d,
            ss: a.ss + b.ss,
            sd: a.sd + b.sd,
            dd: a.dd + b.dd,
        })
    }
}
