use std::f64::consts::{LN_2, PI};

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;

use topple_studies::sharpness::blocks::sums;
use topple_studies::sharpness::figures::of_blocks;
use topple_studies::sharpness::{BOX, Sharpness};

/// The sharpness of classes over a square of a given number of cells a side.
fn square(side: usize, class: impl Fn(f64, f64) -> u8) -> Sharpness {
    let at = |k: usize| (k as f64 + 0.5) / side as f64;
    let all: Vec<u8> =
        (0..side * side).map(|cell| class(at(cell % side), at(cell / side))).collect();
    let distances: Vec<usize> =
        (0..6).map(|k| 1 << k).filter(|distance| 8 * distance <= side).collect();
    let read = |rows: std::ops::Range<usize>| Ok(all[rows.start * side..rows.end * side].to_vec());
    let blocks = sums((side, side), [BOX; 2], &distances, read).unwrap();
    of_blocks(&blocks, [BOX; 2], distances, 2)
}

fn noise() -> impl FnMut(usize) -> u8 {
    let mut noise = Pcg64Mcg::new(7);
    move |k| ((u128::from(noise.next_u64()) * k as u128) >> 64) as u8
}

/// A line at right angles to an axis parts k of the N - k pairs of each row at a distance of k cells, so that the
/// logarithms rise by ln((N - 1)/(N - k)) too much, 0.081 from 1 to 32 cells of 400: alpha is above 1 by 0.024.
#[test]
fn a_straight_boundary_has_dimension_one() {
    for (a, b) in [(1.0, 0.0), (0.0, 1.0), (1.0, 0.37), (0.6, 1.0)] {
        let found = square(400, |x, y| u8::from(a * x + b * y > 0.503 * (a + b)));
        let dimension = found.dimension.unwrap();
        assert!((dimension.value - 1.0).abs() < 0.03, "{a} {b}: {found:?}");
        assert!(dimension.low <= dimension.value && dimension.value <= dimension.high);
        // Of a straight boundary boxes have two outcomes.
        let s_bb = found.s_bb.unwrap();
        assert!(s_bb.value < LN_2 && !found.above_ln_2, "{found:?}");
    }
    // A line between boxes is in none of them.
    let between = square(400, |x, _| u8::from(x > 0.5));
    assert_eq!((between.boundary_boxes, between.s_bb), (0, None));
    assert!(between.not_told[0].contains("and 0 are there"), "{:?}", between.not_told);
}

/// Of k outcomes in equal shares the entropy is ln k; of 25 random cells its mean is less by (k - 1)/(2 · 25) in
/// the first order, and the mean over 6400 boxes scatters by less than 0.005.
#[test]
fn random_outcomes_have_the_entropy_of_their_count_and_dimension_two() {
    for k in [2, 3, 4] {
        let next = std::cell::RefCell::new(noise());
        let found = square(400, |_, _| next.borrow_mut()(k));
        let wanted = (k as f64).ln() - (k as f64 - 1.0) / 50.0;
        let s_bb = found.s_bb.unwrap();
        assert!((s_bb.value - wanted).abs() < 0.005, "{k}: {found:?}, {wanted}");
        assert_eq!(found.above_ln_2, k > 2);
        assert!((found.dimension.unwrap().value - 2.0).abs() < 0.01, "{k}: {found:?}");
    }
    // 13 cells of 25 have one colour.
    let board = square(100, |x, y| ((100.0 * x) as u8 + (100.0 * y) as u8) % 2);
    let share: f64 = 13.0 / 25.0;
    let wanted = -share * share.ln() - (1.0 - share) * (1.0 - share).ln();
    assert!((board.s_bb.unwrap().value - wanted).abs() < 1e-12 && wanted < LN_2);
}

/// The basins of Newton's method for z³ = 1, on a square from -1 to 1: every boundary point is one of all three
/// (Wada), and the box dimension of the set is about 1.44 (Nusse & Yorke measure the like; Daza et al. have
/// S_bb > ln 2).
#[test]
fn newtons_basins_are_fractal() {
    let basin = |x: f64, y: f64| {
        let (mut x, mut y) = (2.0 * x - 1.0, 2.0 * y - 1.0);
        for _ in 0..60 {
            // z - (z³ - 1)/(3 z²) = (2 z + 1/z²)/3.
            let (re, im) = (x * x - y * y, 2.0 * x * y);
            let size = re * re + im * im;
            (x, y) = ((2.0 * x + re / size) / 3.0, (2.0 * y - im / size) / 3.0);
        }
        let angle = y.atan2(x);
        if angle.abs() < PI / 3.0 {
            0
        } else if angle > 0.0 {
            1
        } else {
            2
        }
    };
    let found = square(600, basin);
    let dimension = found.dimension.unwrap();
    assert!(dimension.value > 1.35 && dimension.value < 1.55, "{found:?}");
    assert!(found.above_ln_2, "{found:?}");
}

/// Stripes whose edges are the ends of the middle-third Cantor set's gaps, a Cantor set times a line: D = 1 +
/// ln 2/ln 3. The gaps of each generation have one of two outcomes by turns.
#[test]
fn a_cantor_set_has_its_own_dimension() {
    let stripe = |x: f64| {
        let mut x = x;
        for generation in 0..20_u8 {
            x *= 3.0;
            if x > 1.0 && x < 2.0 {
                return generation % 2;
            }
            x -= if x >= 2.0 { 2.0 } else { 0.0 };
        }
        0
    };
    let wanted = 1.0 + 2.0_f64.ln() / 3.0_f64.ln();
    let found = square(729, |x, _| stripe(x));
    // The set looks the same at every power of 3, but not between, where the distances are: the points lie on no
    // straight line, which the interval tells.
    let dimension = found.dimension.unwrap();
    assert!((dimension.value - wanted).abs() < 0.1, "{found:?} {wanted}");
    assert!(dimension.low < wanted && wanted < dimension.high, "{found:?} {wanted}");
}

#[test]
fn what_is_too_coarse_is_not_told() {
    let found = square(20, |x, y| u8::from(x > y));
    assert_eq!((found.alpha, found.dimension, found.s_bb), (None, None, None));
    assert_eq!(found.not_told.len(), 2, "{:?}", found.not_told);
    let found = square(24, |x, y| ((24.0 * x) as u8 + (24.0 * y) as u8) % 2);
    assert!(
        found.not_told.iter().any(|why| why.contains("too coarse; take 32 points")),
        "{found:?}"
    );
    // One outcome everywhere.
    let found = square(100, |_, _| 1);
    assert_eq!((found.s_b.unwrap().value, found.boundary_boxes, found.s_bb), (0.0, 0, None));
}
