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

/// So many points, each with a value of every parameter.
#[cfg(test)]
pub fn points(varied: &[Varied], samples: usize, seed: u32) -> Vec<Vec<f64>> {
    let points = shares(varied.len(), samples, seed);
    points.iter().map(|shares| values(varied, shares)).collect()
}

/// The values of parameters at the shares of a point.
pub fn values(varied: &[Varied], shares: &[f64]) -> Vec<f64> {
    varied.iter().zip(shares).map(|(varied, share)| varied.distribution.quantile(*share)).collect()
}

#[cfg(test)]
mod tests {
    use super::{points, shares};

    /// A scrambled set of 2^m points has one point in each of 2^m intervals of every coordinate, and in each of the
    /// rectangles of area 2^-m of the first two.
    #[test]
    fn every_interval_has_its_point() {
        for seed in [0, 1, 77] {
            let set = shares(12, 64, seed);
            for coordinate in 0..12 {
                let mut count = [0; 64];
                set.iter().for_each(|point| count[(64.0 * point[coordinate]) as usize] += 1);
                assert_eq!(count, [1; 64], "seed {seed}, coordinate {coordinate}");
            }
            for across in 0..=6 {
                let (columns, rows) = (1 << across, 64 >> across);
                let mut count = vec![0; 64];
                for point in &set {
                    let column = (f64::from(columns) * point[0]) as usize;
                    let row = (f64::from(rows) * point[1]) as usize;
                    count[row * columns as usize + column] += 1;
                }
                assert_eq!(count, [1; 64], "seed {seed}, {columns} x {rows}");
            }
        }
    }

    #[test]
    fn a_seed_gives_the_same_points_and_another_others() {
        let varied = ["t_h=normal(1,0.1)".parse().unwrap(), "psi=uniform(0,1)".parse().unwrap()];
        assert_eq!(points(&varied, 10, 3), points(&varied, 10, 3));
        assert_ne!(points(&varied, 10, 3), points(&varied, 10, 4));
        // More of the same seed begin with the same.
        assert_eq!(points(&varied, 10, 3), points(&varied, 20, 3)[..10]);
    }

    #[test]
    fn sets_beyond_the_first_are_others_and_no_point_is_on_an_edge() {
        let set = shares(1, (1 << 16) + 100, 0);
        assert_ne!(set[..100], set[1 << 16..]);
        assert!(set.iter().all(|point| point[0] > 0.0 && point[0] < 1.0));
    }
}
