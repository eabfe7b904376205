//! The annual rate of a limit state, with what of it the data say.

use super::curve::{Curve, Lognormal};
use super::fit::Gap;
use super::hazard::HazardCurve;
use super::runs::Stripe;

/// The annual rate of a limit state by an estimator, 1/year.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateEstimate {
    /// The integral of the curve over the hazard; none where the runs tell no curve.
    pub rate: Option<f64>,
    /// The lower end of its 95 % interval; none where it is open. Without a curve the rate where all stand up to the lowest
    /// level at which all fail.
    pub low: Option<f64>,
    /// The upper end. Without a curve the rate where all fail above the highest level up to which none does.
    pub high: Option<f64>,
    /// The largest contribution of motions above the last level of the hazard.
    pub missing_above: f64,
    /// The largest contribution of motions below its first level; infinite where there is no bound.
    pub missing_below: f64,
    /// The share of the rate that comes from levels below the lowest at which a run fails: of the curve's tail, not of data.
    pub without_failures: Option<f64>,
    /// The share that comes from levels above the highest.
    pub above_levels: Option<f64>,
    /// The rate of the curve held below those of the limit states that this one implies; none without a curve.
    pub ordered: Option<f64>,
    /// True where a step stands for a curve that the runs do not tell.
    pub of_step: bool,
}

impl RateEstimate {
    /// The rate, 1/year, with all that may be missing at both ends of the hazard: of a curve that of the best estimate, whose interval may
    /// reach farther; without a curve the upper bound. None where there is no bound.
    pub fn with_missing(&self) -> Option<f64> {
        self.and_missing(self.rate.or(self.high)?)
    }

    /// What is compared with a target: of a curve whose interval has an upper end the best estimate, of other runs the upper bound, both with
    /// all that may be missing. None where there is no upper bound.
    pub fn judged(&self) -> Option<f64> {
        let high = self.high?;
        let best = if self.of_step { None } else { self.rate };
        self.and_missing(best.unwrap_or(high))
    }

    /// A rate with all that may be missing; none where that has no bound.
    fn and_missing(&self, rate: f64) -> Option<f64> {
        let most = rate + self.missing_above + self.missing_below;
        most.is_finite().then_some(most)
    }

    /// True where what is [`judged`](RateEstimate::judged) is not above a target; false where it is, or there is no upper bound. None where
    /// nothing at all is known.
    pub fn is_below(&self, target: f64) -> Option<bool> {
        let nothing = self.rate.is_none() && self.low.is_none() && self.high.is_none();
        (!nothing).then(|| self.judged().is_some_and(|most| most <= target))
    }

    /// That of a curve, whose interval is not known yet.
    pub(super) fn of_curve(
        curve: &Curve,
        stripes: &[Stripe],
        hazard: &HazardCurve,
    ) -> RateEstimate {
        let all = hazard.rate(*curve);
        let share = |part: f64| (all.rate > 0.0).then(|| (part / all.rate).clamp(0.0, 1.0));
        let lowest = stripes.iter().filter(|stripe| stripe.z > 0.0).map(|stripe| stripe.level);
        let without_failures = lowest
            .reduce(f64::min)
            .and_then(|lowest| share(hazard.rate_between(*curve, f64::NEG_INFINITY, lowest.ln())));
        let above_levels = stripes
            .last()
            .and_then(|last| share(hazard.rate_between(*curve, last.level.ln(), f64::INFINITY)));
        RateEstimate {
            rate: Some(all.rate),
            low: None,
            high: None,
            missing_above: all.missing_above,
            missing_below: all.missing_below,
            without_failures,
            above_levels,
            ordered: Some(all.rate),
            of_step: false,
        }
    }

    /// That of separable data: of a step in the middle of the gap, where runs at levels on both sides tell that all fail, or
    /// stand, there; else bounds alone. `within` are the bounds of theta and of beta by the profile likelihood, none where the records
    /// tell no interval.
    pub(super) fn of_gap(
        gap: Gap,
        within: Option<([Option<f64>; 2], Option<f64>)>,
        stripes: &[Stripe],
        hazard: &HazardCurve,
    ) -> RateEstimate {
        let all = |theta: f64, beta: f64| hazard.rate(Lognormal { theta, beta });
        let rate = |theta: f64, beta: f64| all(theta, beta).rate;
        if let Some(theta_of_step) = step(gap, stripes) {
            let step = Curve::step(theta_of_step);
            // The rate falls as theta grows. Of a curve that bends, it grows with beta or falls, so that it is largest at an end.
            let high = within.and_then(|(theta, beta)| theta[0].zip(beta));
            let bounds = high.map(|(low, beta)| [all(low, 0.0), all(low, beta)]);
            let high = bounds.map(|[step, bent]| step.rate.max(bent.rate));
            let low = within.map(|(theta, _)| theta[1].map_or(0.0, |high| rate(high, 0.0)));
            let of_step = RateEstimate::of_curve(&step, stripes, hazard);
            let below =
                bounds.map_or(0.0, |[step, bent]| step.missing_below.max(bent.missing_below));
            let missing_below = of_step.missing_below.max(below);
            return RateEstimate { low, high, missing_below, of_step: true, ..of_step };
        }
        let all_stand = stripes.iter().take_while(|stripe| stripe.z == 0.0).last();
        let all_fail = stripes.iter().rev().take_while(|stripe| stripe.z == stripe.n).last();
        let from = |stripe: Option<&Stripe>| stripe.map(|stripe| rate(stripe.level, 0.0));
        // Below the hazard's first level nobody counts the motions.
        let counted = |stripe: &&Stripe| hazard.begins_below(stripe.level);
        RateEstimate {
            rate: None,
            low: Some(from(all_fail).unwrap_or(0.0)),
            high: from(all_stand.filter(counted)),
            missing_above: all(f64::MAX, 0.0).missing_above,
            // Where some stand up to a level, weaker motions do, too.
            missing_below: if all_stand.is_some() { 0.0 } else { f64::INFINITY },
            without_failures: None,
            above_levels: None,
            ordered: None,
            of_step: false,
        }
    }
}

/// Where a step stands for separable data: in the middle of a gap, or at a level at which runs stand and fail, if levels below
/// it show that none fails and levels above it that all do.
pub(super) fn step(gap: Gap, stripes: &[Stripe]) -> Option<f64> {
    let (first, last) = (stripes.first()?.level, stripes.last()?.level);
    let middle = gap.middle()?;
    let inside =
        gap.stands < gap.fails || middle > first * (1.0 + 1e-12) && middle < last * (1.0 - 1e-12);
    inside.then_some(middle)
}

/// The annual rate of failure by the shares of the runs alone: no curve is fitted. Shares that fall with the level are put
/// together until they rise, which is the rising function of largest likelihood (Ayer et al. 1955, Ann. Math. Stat. 26(4),
/// 641-647); between levels the share is linear in ln x. Below the first level none fails, above the last one the share stays.
pub fn empirical(stripes: &[Stripe], hazard: &HazardCurve) -> Option<f64> {
    let mut pooled: Vec<[f64; 3]> = Vec::with_capacity(stripes.len());
    for stripe in stripes {
        let (mut z, mut n, mut levels) = (stripe.z, stripe.n, 1.0);
        while let Some([before_z, before_n, before]) = pooled.last().copied()
            && before_z * n >= z * before_n
        {
            pooled.pop();
            (z, n, levels) = (z + before_z, n + before_n, levels + before);
        }
        pooled.push([z, n, levels]);
    }
    let shares = pooled.iter().flat_map(|[z, n, levels]| vec![z / n; *levels as usize]);
    let points: Vec<[f64; 2]> =
        stripes.iter().map(|stripe| stripe.level.ln()).zip(shares).map(|(y, p)| [y, p]).collect();
    (!points.is_empty()).then(|| hazard.rate_of_shares(&points))
}
