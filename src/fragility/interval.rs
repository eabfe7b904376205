//! Intervals by resampling records.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

use super::fit::Fit;

/// How records are resampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bootstrap {
    /// How many sets are drawn. Fewer than [`FEWEST`] give no interval.
    pub replicates: u32,
    /// What the draws start from: equal seeds give equal intervals.
    pub seed: u64,
}

/// Sets below which the 2.5 % and 97.5 % points are beyond the smallest and the largest value.
pub const FEWEST: u32 = 39;
/// Sets that a thread takes at once: fewer cost more to hand over than to fit.
const AT_ONCE: usize = 32;

/// What resampling gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// 2.5 % and 97.5 % points of theta; none where it is open at that end.
    pub theta: [Option<f64>; 2],
    /// Those of beta.
    pub beta: [Option<f64>; 2],
    /// Sets without a curve.
    pub without_fit: usize,
}

/// Draws sets of as many records with replacement, fits each, and takes the percentile intervals of theta and beta.
///
/// Records are drawn, not runs: the runs of a record belong together. `refit` gets how often each record is drawn.
///
/// A set without a curve says something where it is separable: a gap with two ends counts with its middle and with a beta
/// of zero, which are the limits of the likelihood; a set in which none fails counts as theta without bound, one
/// in which all fail as theta of zero, both without a beta. Left out, they would make the interval too narrow on that
/// side. An interval that reaches such a theta is open there. The other sets without a curve do not count.
pub fn bootstrap(
    records: usize,
    settings: &Bootstrap,
    refit: impl Fn(&[u32]) -> Fit + Sync,
) -> Interval {
    let draw = |replicate: u32| refit(&multipliers(records, settings.seed, replicate));
    let fits: Vec<Fit> =
        (0..settings.replicates).into_par_iter().with_min_len(AT_ONCE).map(draw).collect();
    let (mut thetas, mut betas) = (Vec::new(), Vec::new());
    for fit in &fits {
        let (theta, beta) = match fit {
            Fit::Fitted(curve) => (Some(curve.theta), Some(curve.beta)),
            Fit::Separable(gap) => match (gap.stands, gap.fails) {
                (Some(_), Some(_)) => (gap.middle(), Some(0.0)),
                (Some(_), None) => (Some(f64::INFINITY), None),
                (None, _) => (Some(0.0), None),
            },
            _ => (None, None),
        };
        thetas.extend(theta);
        betas.extend(beta);
    }
    let curves = fits.iter().filter(|fit| fit.curve().is_some()).count();
    let theta =
        percentiles(thetas).map(|theta| theta.filter(|theta| *theta > 0.0 && theta.is_finite()));
    Interval { theta, beta: percentiles(betas), without_fit: fits.len() - curves }
}

/// How often each record is drawn in a set. Each set has a generator of its own, so that the order of the sets, and the
/// number of threads, change nothing.
fn multipliers(records: usize, seed: u64, replicate: u32) -> Vec<u32> {
    // Odd, so that sets of one seed start apart; the generator mixes the number into its state.
    const APART: u64 = 0x9e37_79b9_7f4a_7c15;
    let start = seed.wrapping_add(u64::from(replicate).wrapping_mul(APART));
    let mut random = Pcg64Mcg::seed_from_u64(start);
    let mut times = vec![0; records];
    for _ in 0..records {
        times[below(&mut random, records as u64) as usize] += 1;
    }
    times
}

/// A whole number below a bound, each equally likely: the high half of a product, and another draw where the low half
/// falls into the part that the bound does not divide (Lemire 2019, ACM Trans. Model. Comput. Simul. 29(1)).
fn below(random: &mut impl Rng, bound: u64) -> u64 {
    let uneven = bound.wrapping_neg() % bound;
    loop {
        let product = u128::from(random.next_u64()) * u128::from(bound);
        if product as u64 >= uneven {
            return (product >> 64) as u64;
        }
    }
}

/// The 2.5 % and 97.5 % points: the values of ranks p (N + 1), between two ranks in proportion (Davison & Hinkley 1997,
/// Bootstrap Methods and their Application, section 5.3).
fn percentiles(mut values: Vec<f64>) -> [Option<f64>; 2] {
    if values.len() < FEWEST as usize {
        return [None; 2];
    }
    values.sort_by(f64::total_cmp);
    [0.025, 0.975].map(|share| {
        let rank = share * (values.len() + 1) as f64 - 1.0;
        let place = (rank.floor() as usize).min(values.len() - 1);
        let (from, to) = (values[place], values[(place + 1).min(values.len() - 1)]);
        let part = rank - place as f64;
        // An infinite neighbour that has no part leaves the value finite.
        Some(if part < 1.0e-9 { from } else { from + part * (to - from) })
            .filter(|value| !value.is_nan())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_draw_is_even_and_every_set_has_as_many_records() {
        let mut counts = [0_u32; 7];
        for replicate in 0..10_000 {
            let times = multipliers(7, 3, replicate);
            assert_eq!(times.iter().sum::<u32>(), 7);
            counts.iter_mut().zip(&times).for_each(|(count, times)| *count += times);
        }
        // 70,000 draws in seven: the standard deviation of a count is 93.
        for count in counts {
            assert!(count.abs_diff(10_000) < 400, "{counts:?}");
        }
    }

    #[test]
    fn percentiles_are_between_ranks_and_open_at_an_infinite_value() {
        let values = |count: u32| (1..=count).map(f64::from).collect::<Vec<_>>();
        assert_eq!(percentiles(values(38)), [None, None]);
        assert_eq!(percentiles(values(39)), [Some(1.0), Some(39.0)]);
        let [low, high] = percentiles(values(99)).map(Option::unwrap);
        assert!((low - 2.5).abs() < 1e-12 && (high - 97.5).abs() < 1e-12, "{low} {high}");
        let mut open = values(99);
        open[98] = f64::INFINITY;
        assert_eq!(percentiles(open.clone())[0], Some(low));
        assert!((percentiles(open.clone())[1].unwrap() - 97.5).abs() < 1e-12);
        open[97] = f64::INFINITY;
        assert_eq!(percentiles(open)[1], Some(f64::INFINITY));
    }
}
