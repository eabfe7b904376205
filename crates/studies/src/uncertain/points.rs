//! Points that fill a box evenly: Sobol's sequence, scrambled by Owen's method.
//!
//! The crate `sobol_burley` was chosen of those that were found because it alone scrambles: without it there is no
//! seed, the first point is a corner of the box, and no two sets can be compared. It has no dependency, and the
//! direction numbers of Joe & Kuo for 256 dimensions. It gives 2^16 points of 23 bits, made for pictures; more points
//! are further sets of their own seeds, and 23 bits place a value more finely than 2^16 points lie apart.

use sobol_burley::sample;

use super::varied::{LEAST_SHARE, Varied};

/// Bits of the number of a point in a set.
const BITS: u32 = 16;
/// What separates the seeds of the sets beyond the first.
const NEXT_SEED: u32 = 0x9e37_79b9;

/// A given number of points of a given number of coordinates, 0 to 1 with both ends excluded. Powers of two fill a box best. There are
/// 256 coordinates at most, far more than a scene has numbers.
pub fn shares(coordinates: usize, samples: usize, seed: u32) -> Vec<Vec<f64>> {
    let point = |index: usize| {
        let within = index as u32 & ((1 << BITS) - 1);
        let set = (index >> BITS) as u32;
        let seed = seed.wrapping_add(set.wrapping_mul(NEXT_SEED));
        let share =
            |coordinate: usize| f64::from(sample(within, coordinate as u32, seed)) + LEAST_SHARE;
        (0..coordinates).map(share).collect()
    };
    (0..samples).map(point).collect()
}

/// The values of parameters at the shares of a point.
pub fn values(varied: &[Varied], shares: &[f64]) -> Vec<f64> {
    varied.iter().zip(shares).map(|(varied, share)| varied.distribution.quantile(*share)).collect()
}
