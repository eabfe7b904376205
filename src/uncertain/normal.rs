//! The standard normal distribution.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// Steps of Halley's method. Each multiplies the number of correct digits by three; the first value has three.
const STEPS: usize = 3;

/// The share below x.
pub fn below(x: f64) -> f64 {
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
        let u = (below(x) - share) * TAU.sqrt() * (0.5 * x * x).exp();
        x -= u / (1.0 + 0.5 * x * u);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::{below, quantile};

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
            assert!((below(found) / share - 1.0).abs() < 1e-12, "{share}");
        }
        assert!(quantile(0.5).abs() < 1e-15);
        assert_eq!((quantile(0.0), quantile(1.0)), (f64::NEG_INFINITY, f64::INFINITY));
    }
}
