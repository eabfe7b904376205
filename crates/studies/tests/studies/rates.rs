//! Annual rates: what of one is data, bounds where no curve is known, curves that cross, what is resampled.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use topple_studies::fragility::order::{crossings, implies};
use topple_studies::fragility::rates::empirical;
use topple_studies::fragility::runs::Pool;
use topple_studies::fragility::{Estimate, Estimator, RecordRuns, Run, estimate, hazard_text};
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
    let (a, b) = (wide.curve().unwrap(), narrow.curve().unwrap());
    let level = one.level.unwrap();
    near(a.probability(level), b.probability(level), 1.0e-9);
    // The share is the integral of the difference up to there, by parts with the closed form of each curve.
    let part = |of: &Lognormal| hazard().rate_between(of, f64::NEG_INFINITY, level.ln());
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
    let below = hazard().rate_between(&a, f64::NEG_INFINITY, step.theta.unwrap().ln());
    near(one.share.unwrap(), below / rate, 1.0e-9);
}
