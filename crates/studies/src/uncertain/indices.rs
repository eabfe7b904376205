//! How much of a result's variance each parameter explains: Sobol indices by Saltelli's design.
//!
//! First-order indices are those of Saltelli et al. (2010), Computer Physics Communications 181:259-270, Table 2 (b);
//! total ones those of Jansen (1999), Computer Physics Communications 117:35-43.

use rand_pcg::Pcg64Mcg;

use super::points::{shares, values};
use super::varied::Varied;
use crate::statistics::bootstrap::draw;
use crate::statistics::quantile::middle_95_percent;

/// How often the design's rows are resampled for an interval of 95 %.
const RESAMPLES: usize = 1000;
/// Rows from which on an interval of resampled rows says how far an index is known. Of n rows it is too narrow by
/// t_(n-1)/1.96 sqrt(n/(n - 1)), t the 97.5 % point of Student's distribution: by a third or more for seven rows and fewer.
pub const FEWEST_ROWS: usize = 8;

/// Points of N(k + 2) evaluations for k parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// N points.
    pub a: Vec<Vec<f64>>,
    /// N others.
    pub b: Vec<Vec<f64>>,
    /// For each parameter the points of `a` with its value out of `b`.
    pub ab: Vec<Vec<Vec<f64>>>,
}

/// What a parameter explains of the variance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Index {
    /// The share that it explains alone.
    pub first: Explained,
    /// The share that it explains alone and together with others.
    pub total: Explained,
}

/// A share of the variance, with its interval, or why there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Explained {
    /// A number.
    Share {
        /// The share.
        value: f64,
        /// Low end of its interval of 95 %.
        low: f64,
        /// High end.
        high: f64,
    },
    /// So few samples do not tell it: there are fewer than [`FEWEST_ROWS`], the interval is as wide as all that an index may be, 0 to 1, or
    /// more than 2.5 % of the resampled sets have a single output, so that an end of the interval is theirs.
    TooFew,
    /// The outputs are all the same.
    Constant,
}

impl Explained {
    fn of(value: f64, rows: usize, resampled: Vec<f64>) -> Explained {
        if !value.is_finite() {
            return Explained::Constant;
        }
        let tell = rows >= FEWEST_ROWS && 40 * (RESAMPLES - resampled.len()) <= RESAMPLES;
        let (low, high) = middle_95_percent(resampled);
        match tell && high - low < 1.0 {
            true => Explained::Share { value, low, high },
            false => Explained::TooFew,
        }
    }

    /// The share with the ends of its interval, where it is known.
    pub fn numbers(self) -> [Option<f64>; 3] {
        match self {
            Explained::Share { value, low, high } => [value, low, high].map(Some),
            Explained::TooFew | Explained::Constant => [None; 3],
        }
    }
}

impl Design {
    /// The design of a given number of rows: the scrambled points of twice as many coordinates as there are parameters.
    pub fn of(varied: &[Varied], samples: usize, seed: u32) -> Design {
        let k = varied.len();
        let rows = shares(2 * k, samples, seed);
        let half = |from: usize| -> Vec<Vec<f64>> {
            rows.iter().map(|row| values(varied, &row[from..from + k])).collect()
        };
        let (a, b) = (half(0), half(k));
        let exchanged = |parameter: usize| {
            let rows = a.iter().zip(&b).map(|(a, b)| {
                let mut row = a.clone();
                row[parameter] = b[parameter];
                row
            });
            rows.collect()
        };
        let ab = (0..k).map(exchanged).collect();
        Design { a, b, ab }
    }

    /// All points in the order `a`, `b`, `ab` of each parameter: what is to be evaluated.
    pub fn rows(&self) -> impl Iterator<Item = &Vec<f64>> {
        self.a.iter().chain(&self.b).chain(self.ab.iter().flatten())
    }
}

/// The first-order and total indices of each parameter from the outputs at the points of a design, a number each; `seed` is
/// that of the resampling.
pub fn indices(y_a: &[f64], y_b: &[f64], y_ab: &[Vec<f64>], seed: u32) -> Vec<Index> {
    let n = y_a.len();
    let all: Vec<usize> = (0..n).collect();
    let whole: Vec<[f64; 2]> = estimates(y_a, y_b, y_ab, &all);
    // The generator sets the last bit: the seed stands above it, so that each has a sequence of its own.
    let mut noise = Pcg64Mcg::new((1 << 64) ^ (u128::from(seed) << 1));
    let mut resampled: Vec<[Vec<f64>; 2]> = vec![Default::default(); y_ab.len()];
    for _ in 0..RESAMPLES {
        let rows: Vec<usize> = draw(&mut noise, n).collect();
        for (kept, [first, total]) in resampled.iter_mut().zip(estimates(y_a, y_b, y_ab, &rows)) {
            // A resample may have a single output.
            if first.is_finite() {
                kept[0].push(first);
                kept[1].push(total);
            }
        }
    }
    let one = |([first, total], [firsts, totals]): ([f64; 2], [Vec<f64>; 2])| Index {
        first: Explained::of(first, n, firsts),
        total: Explained::of(total, n, totals),
    };
    whole.into_iter().zip(resampled).map(one).collect()
}

/// First-order and total index of each parameter over some rows.
fn estimates(y_a: &[f64], y_b: &[f64], y_ab: &[Vec<f64>], rows: &[usize]) -> Vec<[f64; 2]> {
    let n = rows.len() as f64;
    let sum = |of: &dyn Fn(usize) -> f64| rows.iter().map(|row| of(*row)).sum::<f64>();
    let mean = sum(&|row| y_a[row] + y_b[row]) / (2.0 * n);
    let variance = sum(&|row| (y_a[row] - mean).powi(2) + (y_b[row] - mean).powi(2)) / (2.0 * n);
    let one = |y_ab: &Vec<f64>| {
        // Of outputs about their mean, which the sum does not depend on but its scatter does.
        let first = sum(&|row| (y_b[row] - mean) * (y_ab[row] - y_a[row])) / n;
        let total = sum(&|row| (y_a[row] - y_ab[row]).powi(2)) / (2.0 * n);
        match variance > 0.0 {
            true => [first / variance, total / variance],
            false => [f64::NAN; 2],
        }
    };
    y_ab.iter().map(one).collect()
}
