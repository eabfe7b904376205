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

/// phi(x)/Phi(x), the inverse Mills ratio: the slope of ln Phi(x).
pub fn inverse_mills(x: f64) -> f64 {
    below_and_above(x)[0].ratio
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

#[cfg(test)]
mod tests {
    use super::*;

    /// x, ln Phi(x) and phi(x)/Phi(x), from series and the continued fraction in 120 digits.
    const EXACT: [(f64, f64, f64); 20] = [
        (-100000.0, -5000000012.431864, 100000.00001),
        (-1234.5, -762003.1623604982, 1234.5008100434893),
        (-60.0, -1805.0135606805673, 60.016657420241124),
        (-38.4, -741.8476730152483, 38.426006464567344),
        (-20.0, -203.91715537109727, 20.04975306852785),
        (-10.1, -54.24604754269364, 10.197157545956838),
        (-7.0, -27.384307498811076, 7.137545613226504),
        (-5.0001, -15.065517049221958, 5.186600697536508),
        (-4.9999, -15.064479748428528, 5.186407236823434),
        (-3.0, -6.607726221510349, 3.2830986549304364),
        (-1.0, -1.8410216450092636, 1.525135276160981),
        (-0.25, -0.9130617648111351, 0.9635539794164039),
        (0.0, -std::f64::consts::LN_2, 0.7978845608028654),
        (0.25, -0.5129840754094305, 0.6458393710168173),
        (0.7, -0.27702394227713123, 0.41192475041929066),
        (2.0, -0.02301290932896349, 0.055247862678989956),
        (4.5, -3.397678896834466e-06, 1.5983795414617587e-05),
        (5.5, -1.8989562646189464e-08, 1.0769760247056311e-07),
        (9.0, -1.1285884059538405e-19, 1.0279773571668915e-18),
        (20.0, -2.7536241186062337e-89, 5.520948362159764e-88),
    ];

    #[test]
    fn tails_are_exact_to_twelve_digits() {
        for (x, ln, ratio) in EXACT {
            let error = ((ln_cdf(x) - ln) / ln).abs().max((inverse_mills(x) / ratio - 1.0).abs());
            assert!(error < 2.0e-13, "{x}: {} {}, {error:e}", ln_cdf(x), inverse_mills(x));
            if ln > -700.0 {
                let error = (cdf(x).ln() - ln).abs();
                assert!(error < 1.0e-12, "{x}: {error:e}");
            }
        }
    }

    #[test]
    fn a_quantile_has_its_share_below() {
        for x in [-6.0, -1.959963984540054, -0.3, 0.0, 0.7, 3.0] {
            assert!((quantile(cdf(x)) - x).abs() < 1.0e-11, "{x}: {}", quantile(cdf(x)));
        }
    }

    #[test]
    fn nothing_overflows_before_the_square() {
        assert!(ln_cdf(-1.0e154).is_finite() && inverse_mills(-1.0e154) == 1.0e154);
        assert!(ln_cdf(1.0e300) == 0.0 && inverse_mills(1.0e300) == 0.0);
        assert!(ln_cdf(f64::NAN).is_nan() && cdf(f64::NAN).is_nan());
        assert!(cdf(f64::INFINITY) == 1.0 && cdf(f64::NEG_INFINITY) == 0.0);
    }

    /// scipy.stats.norm.ppf of scipy 1.17.1.
    #[test]
    fn quantiles_are_those_of_scipy() {
        for (share, x) in [
            (1e-300, -37.0470962993612),
            (1e-100, -21.273453560965322),
            (1e-20, -9.262340089798409),
            (1e-10, -6.361340902404056),
            (5.960464477539063e-08, -5.294704084854597),
            (0.001, -3.090232306167813),
            (0.025, -1.9599639845400545),
            (0.2, -0.8416212335729142),
            (0.4999, -0.0002506628300880075),
            (0.75, 0.6744897501960817),
            (0.9, 1.2815515655446004),
            (0.975, 1.959963984540054),
            (0.999999, 4.753424308817087),
        ] {
            let found = quantile(share);
            assert!((found - x).abs() <= 1e-12 * x.abs().max(1.0), "{share}: {found} for {x}");
            assert!((cdf(found) / share - 1.0).abs() < 1e-12, "{share}");
        }
        assert!(quantile(0.5).abs() < 1e-15);
        assert_eq!((quantile(0.0), quantile(1.0)), (f64::NEG_INFINITY, f64::INFINITY));
    }
}
