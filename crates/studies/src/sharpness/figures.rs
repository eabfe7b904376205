//! The figures of a map from its blocks: basin entropy, the uncertainty exponent and the dimension, with intervals.

use std::f64::consts::LN_2;

use rand_pcg::Pcg64Mcg;

use super::blocks::Sums;
use super::{Estimate, FARTHEST, Sharpness};
use crate::statistics::bootstrap::draw;
use crate::statistics::quantile::middle_95_percent;

/// Fewest boxes with two outcomes, fewest pairs of neighbours that differ, and fewest distances, to say anything.
const FEWEST: (usize, u64, usize) = (20, 100, 3);
/// Standard errors of a slope on either side of it that hold 95 %, of 3, 4, 5 and 6 points (Student's distribution).
const STUDENT: [f64; 4] = [12.71, 4.303, 3.182, 2.776];
/// Resamples, of which 95 % lie within an interval.
const RESAMPLES: usize = 500;

/// What blocks say together, of boundaries over so many axes.
pub fn of_blocks(
    blocks: &[Sums],
    box_cells: [usize; 2],
    distances: Vec<usize>,
    axes: usize,
) -> Sharpness {
    let mut whole = Sums::default();
    blocks.iter().for_each(|block| whole.add(block));
    let uncertain = whole.uncertain();
    let near = whole.pairs.first().map_or(0, |[_, differ]| *differ);
    let (boxes, boundary_boxes) = (whole.boxes as usize, whole.boundary as usize);
    let (fewest_boxes, fewest_pairs, fewest_distances) = FEWEST;
    let mut not_told = Vec::new();
    if boundary_boxes < fewest_boxes {
        not_told.push(format!(
            "S_bb, for {fewest_boxes} boxes with two outcomes are needed and {boundary_boxes} are there; take more points"
        ));
    }
    let coarse = distances.len() < fewest_distances;
    if near < fewest_pairs {
        not_told.push(format!(
            "alpha, for {fewest_pairs} pairs of neighbours with different outcomes are needed and {near} are there; take \
             more points"
        ));
    } else if coarse {
        let least = FARTHEST.0 << (fewest_distances - 1);
        not_told.push(format!(
            "alpha, for the grid is too coarse; take {least} points an axis or more"
        ));
    }
    let tells_box = boundary_boxes >= fewest_boxes;
    let tells_alpha = near >= fewest_pairs && !coarse;
    let mut resampled: [Vec<f64>; 3] = Default::default();
    let mut noise = Pcg64Mcg::new(1);
    for _ in 0..RESAMPLES {
        let mut sums = Sums::default();
        draw(&mut noise, blocks.len()).for_each(|block| sums.add(&blocks[block]));
        let slope = slope(&distances, &sums.uncertain()).map_or(f64::NAN, |(slope, _)| slope);
        for (kept, value) in resampled.iter_mut().zip([sums.s_b(), sums.s_bb(), slope]) {
            // A resample may have no boundary.
            kept.extend(Some(value).filter(|value| value.is_finite()));
        }
    }
    let [of_b, of_bb, of_alpha] = resampled.map(middle_95_percent);
    let estimate = |value, (low, high)| Estimate { value, low, high };
    let line = slope(&distances, &uncertain).filter(|_| tells_alpha);
    let alpha = line.map(|(value, error)| {
        // Blocks scatter, and the points need not lie on a straight line.
        let beside = STUDENT[(distances.len() - FEWEST.2).min(STUDENT.len() - 1)] * error;
        estimate(value, (of_alpha.0.min(value - beside), of_alpha.1.max(value + beside)))
    });
    let s_bb = tells_box.then(|| estimate(whole.s_bb(), of_bb));
    let whole_axes = axes as f64;
    Sharpness {
        box_cells,
        boxes,
        boundary_boxes,
        s_b: (boxes > 0).then(|| estimate(whole.s_b(), of_b)),
        s_bb,
        above_ln_2: s_bb.is_some_and(|s_bb| s_bb.low > LN_2),
        distances,
        uncertain,
        alpha,
        alpha_error: line.map(|(_, error)| error),
        dimension: alpha.map(|alpha| {
            estimate(whole_axes - alpha.value, (whole_axes - alpha.high, whole_axes - alpha.low))
        }),
        not_told,
    }
}

/// The slope of the straight line through the logarithms of shares over those of distances, by least squares, and its
/// standard error; none of fewer than three, or where a share is zero.
fn slope(distances: &[usize], uncertain: &[f64]) -> Option<(f64, f64)> {
    let n = distances.len() as f64;
    let x: Vec<f64> = distances.iter().map(|distance| (*distance as f64).ln()).collect();
    let y: Vec<f64> = uncertain.iter().map(|share| share.ln()).collect();
    if distances.len() < FEWEST.2 || y.iter().any(|y| !y.is_finite()) {
        return None;
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / n;
    let (mean_x, mean_y) = (mean(&x), mean(&y));
    let sum = |of: &dyn Fn(f64, f64) -> f64| x.iter().zip(&y).map(|(x, y)| of(*x, *y)).sum::<f64>();
    let width = sum(&|x, _| (x - mean_x).powi(2));
    let slope = sum(&|x, y| (x - mean_x) * (y - mean_y)) / width;
    let rest = sum(&|x, y| (y - mean_y - slope * (x - mean_x)).powi(2));
    Some((slope, (rest / (n - 2.0) / width).sqrt()))
}
