//! The boxes of a refined map: which ones are split, and which cells of the finest grid they have.

use std::ops::RangeInclusive;

use super::error::RefineError;
use crate::scene::Grid;

/// Most cells of a finest grid, as a power of two: those of 16,384 x 16,384.
pub const MOST_CELLS: u32 = 28;

/// A box between neighbouring cells of a level, by its place among the level's boxes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Square {
    /// The level: 0 is between cells of the map that is refined.
    pub level: u32,
    /// Place along the second axis.
    pub j: usize,
    /// Place along the first axis.
    pub i: usize,
}

/// Which boxes are split.
#[derive(Debug, Clone)]
pub struct Boxes {
    levels: u32,
    /// Boxes of level 0 along both axes.
    base: [usize; 2],
    /// A bit a box, of each level but the finest.
    split: Vec<Vec<u64>>,
}

impl Boxes {
    /// The boxes of a grid, none split, to be split down to so many levels.
    ///
    /// # Errors
    /// [`RefineError`].
    pub fn of(grid: &Grid, levels: u32) -> Result<Boxes, RefineError> {
        let several = grid.axes().iter().filter(|axis| axis.count() > 1).count();
        if several != 2 || grid.axes().len() != 2 {
            return Err(RefineError::Axes(several));
        }
        if levels == 0 {
            return Err(RefineError::None);
        }
        for axis in grid.axes() {
            if axis.values.refined(0).is_none() {
                return Err(RefineError::List(axis.key()));
            }
        }
        let base = [grid.axes()[0].count() - 1, grid.axes()[1].count() - 1];
        // An axis has fewer than 2^21 values: with more levels it would have too many anyway.
        let sides = base.map(|count| (count << levels.min(MOST_CELLS)) + 1);
        if levels > MOST_CELLS || sides[0].saturating_mul(sides[1]) > 1 << MOST_CELLS {
            return Err(RefineError::Large);
        }
        let bits = |level: u32| (base[0] << level) * (base[1] << level);
        let split = (0..levels).map(|level| vec![0; bits(level).div_ceil(64)]).collect();
        Ok(Boxes { levels, base, split })
    }

    /// The number of levels.
    pub fn levels(&self) -> u32 {
        self.levels
    }

    /// Columns and rows of the finest grid.
    pub fn shape(&self) -> (usize, usize) {
        ((self.base[0] << self.levels) + 1, (self.base[1] << self.levels) + 1)
    }

    /// Gaps of the finest grid along a side of a box of a level.
    pub fn side(&self, level: u32) -> usize {
        1 << (self.levels - level)
    }

    fn bit(&self, square: Square) -> (usize, u64) {
        let place = square.j * (self.base[0] << square.level) + square.i;
        (place / 64, 1 << (place % 64))
    }

    /// True where a box is split.
    pub fn is_split(&self, square: Square) -> bool {
        let (word, bit) = self.bit(square);
        // Boxes of the finest level are never split.
        self.split.get(square.level as usize).is_some_and(|level| level[word] & bit != 0)
    }

    /// Splits a box that is not of the finest level.
    pub fn split(&mut self, square: Square) {
        let (word, bit) = self.bit(square);
        if let Some(level) = self.split.get_mut(square.level as usize) {
            level[word] |= bit;
        }
    }

    /// The boxes of level 0, row by row.
    pub fn roots(&self) -> impl Iterator<Item = Square> + use<> {
        let [across, up] = self.base;
        (0..up).flat_map(move |j| (0..across).map(move |i| Square { level: 0, j, i }))
    }

    /// The four boxes that a box is split into.
    pub fn children(&self, square: Square) -> [Square; 4] {
        let Square { level, j, i } = square;
        [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(dj, di)| Square {
            level: level + 1,
            j: 2 * j + dj,
            i: 2 * i + di,
        })
    }

    /// The columns and rows of the finest grid's cells in a box, its borders included.
    pub fn cells(&self, square: Square) -> (RangeInclusive<usize>, RangeInclusive<usize>) {
        let side = self.side(square.level);
        let along = |place: usize| place * side..=(place + 1) * side;
        (along(square.i), along(square.j))
    }

    /// The leaf that has the gap above and right of a cell of the finest grid.
    pub fn leaf(&self, column: usize, row: usize) -> Square {
        let mut square = Square { level: 0, j: 0, i: 0 };
        for level in 0..=self.levels {
            let side = self.side(level);
            square = Square { level, j: row / side, i: column / side };
            if !self.is_split(square) {
                break;
            }
        }
        square
    }

    /// The leaves around a cell of the finest grid, each once.
    pub fn around(&self, column: usize, row: usize) -> Vec<Square> {
        let (columns, rows) = self.shape();
        let sides = |at: usize, count: usize| {
            let before = at.checked_sub(1);
            [before, Some(at).filter(|at| at + 1 < count)].into_iter().flatten()
        };
        let gaps = sides(row, rows).flat_map(|j| sides(column, columns).map(move |i| (i, j)));
        let mut leaves: Vec<Square> = gaps.map(|(i, j)| self.leaf(i, j)).collect();
        leaves.sort_unstable();
        leaves.dedup();
        leaves
    }

    /// True where a leaf beside this one, or at a corner of it, is smaller: a boundary is near.
    pub fn is_beside_smaller(&self, square: Square) -> bool {
        let (columns, rows) = self.shape();
        let side = self.side(square.level);
        let (left, low) = (square.i * side, square.j * side);
        let (right, high) = (left + side, low + side);
        // Gaps around the box, those of its corners included; beyond the grid there is none.
        let along = |from: usize, to: usize| from.saturating_sub(1)..to + 1;
        let above = [low.checked_sub(1), Some(high)];
        let beside = [left.checked_sub(1), Some(right)];
        let smaller = |column: usize, row: usize| {
            column + 1 < columns && row + 1 < rows && self.leaf(column, row).level > square.level
        };
        let across = above
            .into_iter()
            .flatten()
            .any(|row| along(left, right).any(|column| smaller(column, row)));
        across
            || beside
                .into_iter()
                .flatten()
                .any(|column| along(low, high).any(|row| smaller(column, row)))
    }

    /// Calls with each leaf, those of a box of level 0 one after the other.
    pub fn each_leaf(&self, mut see: impl FnMut(Square)) {
        let mut open = Vec::new();
        for root in self.roots() {
            open.push(root);
            while let Some(square) = open.pop() {
                if self.is_split(square) {
                    open.extend(self.children(square).into_iter().rev());
                } else {
                    see(square);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Parameter, Range, SceneBuilder};

    fn boxes(levels: u32) -> Result<Boxes, RefineError> {
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, 1.75)
            .with(Parameter::TV, 0.75)
            .with(Parameter::Omega, Range::even(1.0, 8.0, 4))
            .with(Parameter::AH, Range::even(1.0, 8.0, 3))
            .check()
            .unwrap();
        Boxes::of(&Grid::of(&scene), levels)
    }

    #[test]
    fn leaves_cover_every_gap_once() {
        let mut boxes = boxes(3).unwrap();
        assert_eq!(boxes.shape(), (25, 17));
        boxes.split(Square { level: 0, j: 1, i: 2 });
        boxes.split(Square { level: 1, j: 2, i: 5 });
        boxes.split(Square { level: 2, j: 5, i: 10 });
        let mut seen = vec![0; 24 * 16];
        let mut count = 0;
        boxes.each_leaf(|leaf| {
            let (columns, rows) = boxes.cells(leaf);
            count += 1;
            for row in *rows.start()..*rows.end() {
                for column in *columns.start()..*columns.end() {
                    seen[row * 24 + column] += 1;
                    assert_eq!(boxes.leaf(column, row), leaf);
                }
            }
        });
        assert!(seen.iter().all(|times| *times == 1));
        assert_eq!(count, 6 + 3 * 3);
        // Inside a box, and where four of different levels meet.
        assert_eq!(boxes.around(2, 3), [Square { level: 0, j: 0, i: 0 }]);
        assert_eq!(boxes.around(0, 0), [Square { level: 0, j: 0, i: 0 }]);
        let levels: Vec<u32> = boxes.around(20, 8).iter().map(|leaf| leaf.level).collect();
        assert_eq!(levels, [0, 1, 2]);
        // Beside the split box below, left and at the corner, and not farther; of its own children that beside the
        // smaller ones.
        let beside = |level, j, i| boxes.is_beside_smaller(Square { level, j, i });
        assert_eq!(
            [(0, 2), (1, 1), (0, 1), (0, 0), (1, 0)].map(|(j, i)| beside(0, j, i)),
            [true, true, true, false, false]
        );
        assert_eq!([(2, 4), (3, 4), (3, 5)].map(|(j, i)| beside(1, j, i)), [true, true, true]);
        assert_eq!([(4, 10), (5, 11)].map(|(j, i)| beside(2, j, i)), [true, true]);
        assert!(!beside(3, 10, 20));
    }

    #[test]
    fn a_grid_that_is_too_fine_is_refused() {
        assert_eq!(boxes(0).unwrap_err(), RefineError::None);
        assert_eq!(boxes(13).unwrap_err(), RefineError::Large);
        assert_eq!(boxes(u32::MAX).unwrap_err(), RefineError::Large);
    }
}
