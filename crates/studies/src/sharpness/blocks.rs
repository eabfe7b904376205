//! What is summed up over the blocks of a map: the entropy of boxes, and pairs of cells that differ.

use std::io;
use std::ops::Range;

use topple::results::columns::Column;
use topple::results::outcomes::{BLOCK, Outcomes};
use topple::stepping::outcome::Class;

/// Blocks along an axis, which are resampled: neighbours in a block are not independent.
const BLOCKS: usize = 8;
/// Place of a cell of which nothing can be said.
const UNRESOLVED: u8 = Class::Unresolved as u8;

/// What is summed up of a block.
#[derive(Debug, Clone, Default)]
pub struct Sums {
    pub(super) entropy: f64,
    pub(super) boxes: f64,
    pub(super) boundary: f64,
    /// Of each distance the pairs, and those that differ.
    pub(super) pairs: Vec<[u64; 2]>,
}

impl Sums {
    pub(super) fn add(&mut self, other: &Sums) {
        self.entropy += other.entropy;
        self.boxes += other.boxes;
        self.boundary += other.boundary;
        self.pairs.resize(other.pairs.len().max(self.pairs.len()), [0; 2]);
        for (sum, own) in self.pairs.iter_mut().zip(&other.pairs) {
            *sum = [sum[0] + own[0], sum[1] + own[1]];
        }
    }

    pub(super) fn s_b(&self) -> f64 {
        self.entropy / self.boxes
    }

    /// Boxes of one outcome have no entropy.
    pub(super) fn s_bb(&self) -> f64 {
        self.entropy / self.boundary
    }

    pub(super) fn uncertain(&self) -> Vec<f64> {
        self.pairs.iter().map(|[all, differ]| *differ as f64 / *all as f64).collect()
    }
}

/// The places of the classes of some cells.
pub(super) fn classes(outcomes: &dyn Outcomes, cells: Range<usize>) -> io::Result<Vec<u8>> {
    let mut classes = Vec::with_capacity(cells.len());
    for first in cells.clone().step_by(BLOCK) {
        let block = outcomes.read(first..(first + BLOCK).min(cells.end), &[Column::Outcome])?;
        classes.extend(block.iter().map(|cell| cell.class as u8));
    }
    Ok(classes)
}

/// The sums of the blocks of a slice; `read` gives the classes of some of its rows.
pub fn sums(
    (columns, rows): (usize, usize),
    [wide, high]: [usize; 2],
    distances: &[usize],
    read: impl Fn(Range<usize>) -> io::Result<Vec<u8>>,
) -> io::Result<Vec<Sums>> {
    let none = Sums { pairs: vec![[0; 2]; distances.len()], ..Sums::default() };
    let mut blocks = vec![none; BLOCKS * BLOCKS];
    let block = |i: usize, j: usize| BLOCKS * (j * BLOCKS / rows) + i * BLOCKS / columns;
    let farthest = distances.last().copied().unwrap_or(0);
    // Rows of boxes, and those that are as far from them as is looked.
    let height = (BLOCK / columns).max(2 * farthest).max(1).div_ceil(high) * high;
    for first in (0..rows).step_by(height) {
        let last = (first + height).min(rows);
        let read = read(first..(last + farthest).min(rows))?;
        let class = |i: usize, j: usize| read[(j - first) * columns + i];
        for j in (first..last).step_by(high).filter(|j| j + high <= rows) {
            for i in (0..columns).step_by(wide).filter(|i| i + wide <= columns) {
                let cells = (j..j + high).flat_map(|j| (i..i + wide).map(move |i| (i, j)));
                if let Some(entropy) = entropy(cells.map(|(i, j)| class(i, j))) {
                    let sums = &mut blocks[block(i, j)];
                    sums.entropy += entropy;
                    sums.boxes += 1.0;
                    sums.boundary += f64::from(u8::from(entropy > 0.0));
                }
            }
        }
        for j in first..last {
            for i in 0..columns {
                let own = class(i, j);
                let pairs = &mut blocks[block(i, j)].pairs;
                for (distance, pairs) in distances.iter().zip(pairs) {
                    let along = (i + distance < columns).then(|| class(i + distance, j));
                    let across = (j + distance < rows).then(|| class(i, j + distance));
                    for other in along.into_iter().chain(across) {
                        let known = own != UNRESOLVED && other != UNRESOLVED;
                        pairs[0] += u64::from(known);
                        pairs[1] += u64::from(known && own != other);
                    }
                }
            }
        }
    }
    Ok(blocks)
}

/// The entropy of a box; none where less than two of its cells have an outcome.
fn entropy(cells: impl Iterator<Item = u8>) -> Option<f64> {
    let mut counts = [0_u32; Class::ALL.len()];
    cells.for_each(|class| counts[usize::from(class)] += 1);
    counts[usize::from(UNRESOLVED)] = 0;
    let all = f64::from(counts.iter().sum::<u32>());
    let part = |count: &u32| {
        let share = f64::from(*count) / all;
        if *count == 0 { 0.0 } else { -share * share.ln() }
    };
    // One outcome alone has a share of 1, whose logarithm is exactly zero.
    (all >= 2.0).then(|| counts.iter().map(part).sum::<f64>())
}
