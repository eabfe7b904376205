//! Annual rates: what of one is data, bounds where no curve is known, curves that cross, what is resampled.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use topple_studies::fragility::order::{crossings, implies};
use topple_studies::fragility::rates::empirical;
use topple_studies::fragility::runs::Pool;
use topple_studies::fragility::{
    Curve, Estimate, Estimator, RecordRuns, Run, estimate, hazard_text,
};
use topple_studies::statistics::normal;
use topple_studies::{Bootstrap, HazardCurve, Intensity, LimitState, Lognormal};

const BOOTSTRAP: Bootstrap = Bootstrap { replicates: 400, seed: 5 };

/// The hazard 1e-3/x^2 from 0.01 to 100, a line in the logarithms.
fn hazard() -> HazardCurve {
    table("0.01,10\n100,1e-7\n")
}

fn table(rows: &str) -> HazardCurve {
    hazard_text::read(rows, Intensity::Pga, None).unwrap().curve
}

/// Records in groups of so many, each failing from its capacity on.
fn records(capacities: &[f64], levels: &[f64], group: usize) -> Vec<RecordRuns> {
    let record = |(k, capacity): (usize, &f64)| {
        let run = |level: &f64| {
            let failed = level >= capacity;
            Run { level: *level, failed, demand: None, collapsed: failed }
        };
        RecordRuns { weight: 1.0, group: k / group, runs: levels.iter().map(run).collect() }
    };
    capacities.iter().enumerate().map(record).collect()
}

/// Capacities at even quantiles of a lognormal distribution.
fn capacities(theta: f64, beta: f64, count: u32) -> Vec<f64> {
    let share = |k: u32| (f64::from(k) + 0.5) / f64::from(count);
    (0..count).map(|k| theta * (beta * normal::quantile(share(k))).exp()).collect()
}

fn levels(from: f64, to: f64, count: u32) -> Vec<f64> {
    (0..count).map(|k| from * (to / from).powf(f64::from(k) / f64::from(count - 1))).collect()
}

fn stripes(records: &[RecordRuns]) -> Estimate {
    estimate(Estimator::Stripes, records, &BOOTSTRAP, Some(&hazard()))
}

fn near(found: f64, wanted: f64, by: f64) {
    assert!((found / wanted - 1.0).abs() < by, "{found}, not {wanted}");
}

/// Of a power law of slope k the part of the rate below a level y has a closed form: the integrand is a normal density about
/// ln theta - k beta^2 after an integration by parts (Cornell 1996, cut off).
#[test]
fn the_share_without_failures_is_that_of_the_curve_below_the_first_failure() {
    let records = records(&capacities(1.0, 0.6, 80), &levels(0.1, 6.0, 40), 1);
    let fit = stripes(&records);
    let (theta, beta, rate) = (fit.theta.unwrap(), fit.beta.unwrap(), fit.rate.unwrap());
    let pool = Pool::of(&records, |run| run.failed).stripes(None);
    let first = pool.iter().find(|stripe| stripe.z > 0.0).unwrap().level;
    let last = pool.last().unwrap().level;
    let k = 2.0;
    let whole = 1.0e-3 * theta.powf(-k) * (0.5 * k * k * beta * beta).exp();
    // The integral of P |d lambda| below x: that of lambda dP, less lambda P at x.
    let below = |x: f64| {
        let u = (x / theta).ln() / beta;
        whole * normal::cdf(u + k * beta) - 1.0e-3 * x.powf(-k) * normal::cdf(u)
    };
    // The ends of the hazard, a hundred times below and above, take parts of 1e-7 away.
    near(rate.rate.unwrap(), whole - 1.0e-7, 1.0e-4);
    near(rate.without_failures.unwrap(), below(first) / whole, 1.0e-3);
    near(rate.above_levels.unwrap(), (whole - below(last)) / whole, 1.0e-2);
    assert!(rate.without_failures.unwrap() > 0.02, "{rate:?}");
    // The interval has the rate inside, and the shares alone say about the same.
    assert!(rate.low.unwrap() < whole && whole < rate.high.unwrap(), "{rate:?}");
    near(empirical(&pool, &hazard()).unwrap(), whole, 0.1);
}

/// Shares that are linear in ln x have a closed form, too; those that fall are put together.
#[test]
fn an_empirical_rate_is_the_integral_of_the_marks() {
    let at = |level: f64, z: f64| topple_studies::Stripe { level, n: 10.0, z };
    let lambda = |x: f64| 1.0e-3 / (x * x);
    // P rises from 0 at 1 to 1/2 at e, and stays: by parts s times the integral of lambda, less the end's 1e-7/2.
    let e = 1.0_f64.exp();
    let wanted = 0.5 * (lambda(1.0) - lambda(e)) / 2.0 - 0.5 * 1.0e-7;
    near(empirical(&[at(1.0, 0.0), at(e, 5.0)], &hazard()).unwrap(), wanted, 1.0e-9);
    let pooled = empirical(&[at(1.0, 0.0), at(2.0, 6.0), at(3.0, 2.0), at(4.0, 9.0)], &hazard());
    let same = empirical(&[at(1.0, 0.0), at(2.0, 4.0), at(3.0, 4.0), at(4.0, 9.0)], &hazard());
    near(pooled.unwrap(), same.unwrap(), 1.0e-12);
    assert_eq!(empirical(&[at(1.0, 0.0), at(2.0, 0.0)], &hazard()), Some(0.0));
    // A flat hazard has no motions between its ends.
    assert_eq!(empirical(&[at(1.0, 0.0), at(2.0, 9.0)], &table("1,1e-3\n4,1e-3\n")), Some(0.0));
}

#[test]
fn where_no_curve_is_known_the_rate_has_bounds() {
    let known = |capacities: &[f64]| stripes(&records(capacities, &[1.0, 2.0, 4.0], 1));
    // None fails: no more than all motions above 4.
    let none = known(&[9.0; 20]).rate.unwrap();
    assert_eq!((none.rate, none.low), (None, Some(0.0)));
    near(none.with_missing().unwrap(), 1.0e-3 / 16.0, 1.0e-9);
    assert_eq!((none.is_below(1.0e-4), none.is_below(1.0e-5)), (Some(true), Some(false)));
    // Some fail at the highest level alone: all may above the level before, and a rate of zero is no word of it.
    let mut some = vec![9.0; 20];
    some[0] = 3.0;
    let one = known(&some).rate.unwrap();
    assert_eq!((one.rate, one.low), (None, Some(0.0)));
    near(one.with_missing().unwrap(), 1.0e-3 / 4.0, 1.0e-9);
    // All fail from the lowest level on: at least the motions above it.
    let all = known(&[0.5; 20]).rate.unwrap();
    near(all.low.unwrap(), 1.0e-3 - 1.0e-7, 1.0e-9);
    assert_eq!((all.rate, all.high, all.is_below(1.0)), (None, None, Some(false)));
    assert_eq!((all.missing_below, none.missing_below), (f64::INFINITY, 0.0));
    // A gap with levels on both sides is a step in its middle, within the bounds of its ends.
    let gap = known(&[1.5; 20]).rate.unwrap();
    near(gap.rate.unwrap(), 1.0e-3 / 2.0 - 1.0e-7, 1.0e-9);
    assert!(gap.low.unwrap() < gap.rate.unwrap() && gap.rate.unwrap() < gap.high.unwrap());
    // The hazard begins above: nobody counts the motions between.
    let late = table("8,1e-4\n100,1e-7\n");
    let late = estimate(
        Estimator::Stripes,
        &records(&[9.0; 20], &[1.0, 2.0, 4.0], 1),
        &BOOTSTRAP,
        Some(&late),
    );
    assert_eq!(late.rate.unwrap().high, None);
}

#[test]
fn records_of_a_group_narrow_no_interval() {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let even = (0..40).map(|_| (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64);
    let own: Vec<f64> = even.map(|share| (0.5 * normal::quantile(share)).exp()).collect();
    let levels = levels(0.2, 5.0, 15);
    let width = |fit: &Estimate| (fit.theta_high.unwrap() / fit.theta_low.unwrap()).ln();
    let one = stripes(&records(&own, &levels, 1));
    // Each record four times, as both components of a symmetric block in both directions have it.
    let four: Vec<f64> = own.iter().flat_map(|capacity| [*capacity; 4]).collect();
    let grouped = stripes(&records(&four, &levels, 4));
    near(grouped.theta.unwrap(), one.theta.unwrap(), 1.0e-9);
    // The same sets are drawn of the same groups.
    near(width(&grouped), width(&one), 1.0e-6);
    near(grouped.rate.unwrap().high.unwrap(), one.rate.unwrap().high.unwrap(), 1.0e-6);
    // As if they had nothing in common it is half as wide.
    near(width(&stripes(&records(&four, &levels, 1))), 0.5 * width(&one), 0.15);
    // Separable data: the likelihood of groups, not of records.
    let step = |times: usize, group| {
        stripes(&records(&vec![1.5; 12 * times], &[1.0, 1.4, 1.6, 2.0], group)).beta_high.unwrap()
    };
    near(step(4, 4), step(1, 1), 1.0e-9);
    assert!(step(4, 1) < 0.9 * step(1, 1));
    // One group tells nothing of others.
    let alone = stripes(&records(&own, &levels, 40));
    assert_eq!((alone.theta_low, alone.theta_high, alone.rate.unwrap().high), (None, None, None));
}

#[test]
fn curves_of_ordered_limit_states_that_cross_are_found() {
    use LimitState::{Overturning, U, Uplift, V, Zeta};
    let states = [Overturning, Uplift, Zeta(0.25), Zeta(0.5), U(0.2), V(0.2)];
    let outer = |one| states.into_iter().filter(|other| implies(one, *other)).count();
    assert_eq!(states.map(outer), [5, 0, 1, 2, 0, 0]);
    let levels = levels(0.2, 8.0, 30);
    let fit = |theta, beta| stripes(&records(&capacities(theta, beta, 60), &levels, 1));
    let (wide, narrow) = (fit(2.0, 0.9), fit(1.5, 0.2));
    let found = crossings(&states[..2], &[&wide, &narrow], Some(&hazard()));
    let [one] = found[..] else { panic!("{found:?}") };
    assert!((one.inner, one.outer, one.below) == (0, 1, true));
    // Where (ln x - ln a)/alpha = (ln x - ln b)/beta.
    let (a, b) = (wide.curve.unwrap(), narrow.curve.unwrap());
    let level = one.level.unwrap();
    near(a.probability(level), b.probability(level), 1.0e-9);
    // The share is the integral of the difference up to there, by parts with the closed form of each curve.
    let part = |of: &Curve| hazard().rate_between(*of, f64::NEG_INFINITY, level.ln());
    let rate = wide.rate.unwrap().rate.unwrap();
    near(one.share.unwrap(), (part(&a) - part(&b)) / rate, 1.0e-6);
    assert!(one.share.unwrap() > 0.1, "{one:?}");
    let held = hazard().held_below(&a, &[b]);
    near(held, rate - part(&a) + part(&b), 1.0e-6);
    // Curves in order, or of states that do not include each other, are not told.
    assert!(crossings(&states[..2], &[&narrow, &fit(1.0, 0.2)], Some(&hazard())).is_empty());
    assert!(crossings(&states[4..], &[&wide, &narrow], Some(&hazard())).is_empty());
    // Without a hazard a crossing counts by its probability.
    assert_eq!(crossings(&states[..2], &[&wide, &narrow], None).len(), 1);
    // Against a step all of the tail below it is above.
    let step = stripes(&records(&[1.5; 30], &levels, 1));
    let [one] = crossings(&states[..2], &[&wide, &step], Some(&hazard()))[..] else { panic!() };
    let below = hazard().rate_between(a, f64::NEG_INFINITY, step.theta.unwrap().ln());
    near(one.share.unwrap(), below / rate, 1.0e-9);
}

/// The fit of a cloud and the integral of its curve once more, by other means: sums over the runs, Newton's method on the plain likelihood,
/// and Simpson's rule over the hazard, which here is a line in the logarithms between each two points.
mod own {
    use super::{RecordRuns, Run};

    /// ln a, b and sigma of ln d = ln a + b ln x, over the runs that stand.
    fn line(runs: &[Run]) -> [f64; 3] {
        let stand = runs.iter().filter(|run| !run.collapsed);
        let points: Vec<[f64; 2]> =
            stand.map(|run| [run.level.ln(), run.demand.unwrap().ln()]).collect();
        let n = points.len() as f64;
        let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / n;
        let (x, d) = (mean(0), mean(1));
        let b = points.iter().map(|[s, t]| (s - x) * (t - d)).sum::<f64>()
            / points.iter().map(|[s, _]| (s - x).powi(2)).sum::<f64>();
        let squares = points.iter().map(|[s, t]| (t - d - b * (s - x)).powi(2)).sum::<f64>();
        [d - b * x, b, (squares / (n - 2.0)).sqrt()]
    }

    /// The intercept and the slope of the logistic regression of `of` on ln x.
    fn logistic(runs: &[Run], of: fn(&Run) -> bool) -> [f64; 2] {
        let (mut a, mut b) = (0.0, 0.0);
        for _ in 0..60 {
            let (mut g, mut h) = ([0.0; 2], [0.0; 3]);
            for run in runs {
                let s = run.level.ln();
                let p = 1.0 / (1.0 + (-a - b * s).exp());
                let (off, w) = (f64::from(u8::from(of(run))) - p, p * (1.0 - p));
                g = [g[0] + off, g[1] + off * s];
                h = [h[0] + w, h[1] + w * s, h[2] + w * s * s];
            }
            let det = h[0] * h[2] - h[1] * h[1];
            a += (h[2] * g[0] - h[1] * g[1]) / det;
            b += (h[0] * g[1] - h[1] * g[0]) / det;
        }
        [a, b]
    }

    /// Phi by its series about zero, and by the continued fraction in the tails.
    fn phi(u: f64) -> f64 {
        let density = (-0.5 * u * u).exp() / std::f64::consts::TAU.sqrt();
        if u.abs() > 4.0 {
            let rest = (1..200).rev().fold(u.abs(), |rest, k| u.abs() + f64::from(k) / rest);
            return if u < 0.0 { density / rest } else { 1.0 - density / rest };
        }
        let (mut term, mut sum) = (u, u);
        for k in 1..200 {
            term *= u * u / f64::from(2 * k + 1);
            sum += term;
        }
        0.5 + density * sum
    }

    /// The curve of the records, with a part for the demand where runs have one.
    pub fn curve(records: &[RecordRuns], demands: bool) -> impl Fn(f64) -> f64 {
        let runs: Vec<Run> = records.iter().flat_map(|record| record.runs.clone()).collect();
        let collapses = runs.iter().any(|run| run.collapsed);
        let of: fn(&Run) -> bool =
            if demands { |run: &Run| run.collapsed } else { |run: &Run| run.failed };
        let logit = (collapses || !demands).then(|| logistic(&runs, of));
        let line = demands.then(|| line(&runs));
        move |ln: f64| {
            let stands = |logit: [f64; 2]| 1.0 / (1.0 + (logit[0] + logit[1] * ln).exp());
            let stands = logit.map_or(1.0, stands);
            let within = line.map_or(1.0, |[ln_a, b, sigma]| phi(-(ln_a + b * ln) / sigma));
            // What fails is small where few do: not as a difference.
            let by_demand = line.map_or(0.0, |[ln_a, b, sigma]| phi((ln_a + b * ln) / sigma));
            let by_collapse = logit.map_or(0.0, |[a, b]| 1.0 / (1.0 + (-(a + b * ln)).exp()));
            if by_demand < 0.5 { by_demand + by_collapse * within } else { 1.0 - within * stands }
        }
    }

    /// The integral over the hazard.
    pub fn rate(curve: impl Fn(f64) -> f64, hazard: &[[f64; 2]]) -> f64 {
        const STEPS: u32 = 20_000;
        let segment = |ends: &[[f64; 2]]| {
            let [from, to] = [0, 1].map(|k| ends[k].map(f64::ln));
            let k = (from[1] - to[1]) / (to[0] - from[0]);
            let h = (to[0] - from[0]) / f64::from(STEPS);
            let at = |step: u32| {
                let y = from[0] + h * f64::from(step);
                curve(y) * k * (from[1] - k * (y - from[0])).exp()
            };
            let weight = |step: u32| match step {
                0 | STEPS => 1.0,
                step => 2.0 + 2.0 * f64::from(step % 2),
            };
            (0..=STEPS).map(|step| weight(step) * at(step)).sum::<f64>() * h / 3.0
        };
        hazard.windows(2).map(segment).sum()
    }
}

/// Runs of a cloud: demands of a power law with a scatter, and blocks that overturn from a capacity on, more or less.
fn cloud(seed: u64, slope: f64, scatter: f64, collapse: Option<[f64; 2]>) -> Vec<RecordRuns> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut even = move || ((random.next_u64() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64;
    let mut record = |group: usize| {
        let mut run = |level: f64| {
            let demand = 0.4 * level.powf(slope) * (scatter * normal::quantile(even())).exp();
            let capacity = collapse.map_or(f64::INFINITY, |[theta, beta]| {
                theta * (beta * normal::quantile(even())).exp()
            });
            let collapsed = level >= capacity;
            let failed = collapsed || demand > 1.0;
            Run { level, failed, demand: (!collapsed).then_some(demand), collapsed }
        };
        let runs = levels(0.3, 8.0, 6).into_iter().map(&mut run).collect();
        RecordRuns { weight: 1.0, group, runs }
    };
    (0..60).map(&mut record).collect()
}

/// The rate of a cloud is the integral of its own curve, whatever its shape: not of the lognormal curve of its median.
#[test]
fn the_rate_of_a_cloud_is_the_integral_of_its_own_curve() {
    let table = [
        [0.05, 0.4],
        [0.2, 0.1],
        [0.5, 0.05],
        [1.0, 0.02],
        [2.0, 6e-3],
        [4.0, 1.2e-3],
        [16.0, 1e-5],
    ];
    let rows: String = table.iter().map(|[x, rate]| format!("{x},{rate}\n")).collect();
    let hazard = self::table(&rows);
    let shapes = [
        (1.0, 0.3, None),
        (1.0, 0.3, Some([6.0, 0.3])),
        (0.6, 0.5, Some([2.5, 0.9])),
        (1.4, 0.2, Some([1.0, 1.6])),
        (0.3, 0.8, Some([4.0, 0.5])),
    ];
    let mut apart: Vec<f64> = Vec::new();
    for (seed, (slope, scatter, collapse)) in shapes.into_iter().enumerate() {
        let records = cloud(seed as u64, slope, scatter, collapse);
        let no_demand: Vec<RecordRuns> = records
            .iter()
            .map(|record| {
                let bare = |run: &Run| Run { demand: None, ..*run };
                RecordRuns { runs: record.runs.iter().map(bare).collect(), ..record.clone() }
            })
            .collect();
        for (records, demands) in [(&records, true), (&no_demand, false)] {
            let fit = estimate(Estimator::Cloud, records, &BOOTSTRAP, Some(&hazard));
            let rate = fit.rate.unwrap();
            let wanted = own::rate(own::curve(records, demands), &table);
            near(rate.rate.unwrap(), wanted, 1.0e-9);
            // So is its interval.
            assert!(rate.low.unwrap() < wanted && wanted < rate.high.unwrap(), "{rate:?}");
            let lognormal = Lognormal { theta: fit.theta.unwrap(), beta: fit.beta.unwrap() };
            apart.push(hazard.rate(lognormal).rate / wanted);
            // What is missing below: the same integral over the curve that goes on.
            // Between the first two points lambda is 0.02/x.
            let on = |decades: f64| {
                let x = 0.05 * 10.0_f64.powf(-decades);
                own::rate(own::curve(records, demands), &[[x, 0.02 / x], [0.05, 0.4]])
            };
            match rate.missing_below.is_finite() {
                true => near(rate.missing_below, on(12.0), 1.0e-4),
                // Without a bound each decade adds as much or more.
                false => assert!(on(8.0) > 1.9 * on(4.0), "{} {}", on(4.0), on(8.0)),
            }
        }
    }
    // A lognormal curve of the same theta and beta has other rates, by up to a factor; of one part that is normal the same.
    near(apart[0], 1.0, 1.0e-9);
    assert!(apart.iter().filter(|ratio| (*ratio - 1.0).abs() > 0.03).count() > 5, "{apart:?}");
}

/// A target is kept by the upper bound where no curve is known or its interval is open, and by nothing without one.
#[test]
fn without_a_closed_interval_a_target_is_kept_by_the_upper_bound() {
    let levels = levels(0.5, 8.0, 9);
    let target = |rate: &topple_studies::fragility::RateEstimate, of: f64| rate.is_below(of);
    // A gap: the step in its middle keeps a target between both, its upper bound does not.
    let gap = stripes(&records(&[1.9; 12], &levels, 1)).rate.unwrap();
    let (rate, high) = (gap.rate.unwrap(), gap.high.unwrap());
    assert!(gap.of_step && rate + gap.missing_above < 0.9 * high, "{gap:?}");
    let between = 0.5 * (rate + gap.missing_above + high);
    assert_eq!(target(&gap, between), Some(false), "{gap:?}");
    assert_eq!(target(&gap, (high + gap.missing_above + gap.missing_below) * 1.001), Some(true));
    // One group alone: there is a step, or a curve, but no upper bound of it.
    let alone = stripes(&records(&[1.9; 12], &levels, 12)).rate.unwrap();
    assert_eq!((alone.high, target(&alone, 1.0)), (None, Some(false)));
    let alone = stripes(&records(&capacities(2.0, 0.4, 12), &levels, 12)).rate.unwrap();
    assert!(alone.rate.unwrap() < 1.0 && !alone.of_step);
    assert_eq!((alone.high, target(&alone, 1.0)), (None, Some(false)));
    // A curve with an interval is judged by the best estimate.
    let curve = stripes(&records(&capacities(2.0, 0.4, 30), &levels, 1)).rate.unwrap();
    let most = curve.with_missing().unwrap();
    assert!(most * 1.01 < curve.high.unwrap());
    assert_eq!(
        (target(&curve, 1.01 * most), target(&curve, 0.99 * most)),
        (Some(true), Some(false))
    );
}

/// Curves of a cloud may cross, too: where they do, and what of a rate is from above the other curve.
#[test]
fn curves_of_a_cloud_that_cross_are_found() {
    let table = [[0.05, 0.4], [0.5, 0.05], [2.0, 6e-3], [16.0, 1e-5]];
    let rows: String = table.iter().map(|[x, rate]| format!("{x},{rate}\n")).collect();
    let hazard = self::table(&rows);
    let fit =
        |records: &[RecordRuns]| estimate(Estimator::Cloud, records, &BOOTSTRAP, Some(&hazard));
    // Demands that scatter widely, above a curve that is steep.
    let wide = fit(&cloud(1, 0.4, 0.9, Some([6.0, 0.3])));
    let steep = fit(&cloud(2, 1.6, 0.2, None));
    let states = [LimitState::Overturning, LimitState::Uplift];
    let found = crossings(&states, &[&wide, &steep], Some(&hazard));
    let [one] = found[..] else { panic!("{found:?}") };
    let (own, other) = (wide.curve.unwrap(), steep.curve.unwrap());
    let level = one.level.unwrap();
    near(own.probability(level), other.probability(level), 1.0e-9);
    assert!(one.below && own.probability(0.9 * level) > other.probability(0.9 * level));
    let rate = wide.rate.unwrap().rate.unwrap();
    let held = hazard.held_below(&own, &[other]);
    near(held + hazard.excess(&own, &[other]), rate, 1.0e-9);
    near(one.share.unwrap(), 1.0 - held / rate, 1.0e-9);
    let lower = |ln: f64| own.probability(ln.exp()).min(other.probability(ln.exp()));
    near(held, own::rate(lower, &table), 1.0e-6);
    assert!(held < 0.9 * rate, "{held} {rate}");
    assert!(crossings(&states, &[&steep, &wide], Some(&hazard)).iter().all(|one| !one.below));
}
