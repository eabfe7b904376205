//! The standard normal distribution, to machine precision far into both tails.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// 1/sqrt(2 pi).
const DENSITY_AT_ZERO: f64 = 0.398_942_280_401_432_7;
/// ln sqrt(2 pi).
const LN_SQRT_2_PI: f64 = 0.918_938_533_204_672_8;
/// From here on the continued fraction gives the tail; before, its error function does.
const FAR: f64 = 5.0;

/// Steps of Halley's method. Each multiplies the number of correct digits by three; the first value has three.
const STEPS: usize = 3;

/// Phi(x), the share below x.
pub fn cdf(x: f64) -> f64 {
    0.5 * libm::erfc(-x * FRAC_1_SQRT_2)
}

/// The x below which a share lies; infinite at 0 and 1.
pub fn quantile(share: f64) -> f64 {
    if share > 0.5 {
        return -quantile(1.0 - share);
    }
    if share <= 0.0 {
        return f64::NEG_INFINITY;
    }
    // Abramowitz & Stegun 26.2.23, off by 4.5e-4 at most.
    let t = (-2.0 * share.ln()).sqrt();
    let numerator = 2.515517 + t * (0.802853 + t * 0.010328);
    let denominator = 1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308));
    let mut x = numerator / denominator - t;
    for _ in 0..STEPS {
        // The error over the density.
        let u = (cdf(x) - share) * TAU.sqrt() * (0.5 * x * x).exp();
        x -= u / (1.0 + 0.5 * x * u);
    }
    x
}

/// ln Phi(x). It is finite down to x = -1e154, where x^2 overflows.
pub fn ln_cdf(x: f64) -> f64 {
    below_and_above(x)[0].ln
}

/// The logarithm of a share, and the density over it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// ln of the share.
    pub ln: f64,
    /// phi over the share.
    pub ratio: f64,
}

/// The shares below and above x. Both come from the smaller one, so that neither loses digits.
pub fn below_and_above(x: f64) -> [Share; 2] {
    let t = x.abs();
    let density = DENSITY_AT_ZERO * (-0.5 * t * t).exp();
    let (smaller, share) = if t < FAR {
        let share = 0.5 * libm::erfc(t * FRAC_1_SQRT_2);
        (Share { ln: share.ln(), ratio: density / share }, share)
    } else {
        let ratio = inverse_tail_ratio(t);
        (Share { ln: -0.5 * t * t - LN_SQRT_2_PI - ratio.ln(), ratio }, density / ratio)
    };
    let larger = Share { ln: (-share).ln_1p(), ratio: density / (1.0 - share) };
    if x < 0.0 { [smaller, larger] } else { [larger, smaller] }
}

/// phi(t)/Phi(-t) for a large t, by Laplace's continued fraction t + 1/(t + 2/(t + 3/(t + ...))). The number of its
/// terms falls with t; the test holds it to 1e-13.
fn inverse_tail_ratio(t: f64) -> f64 {
    let terms = 6 + (900.0 / (t * t)) as u32;
    (1..=terms).rev().fold(t, |rest, k| t + f64::from(k) / rest)
}
