//! Whether numbers vary so evenly over a leaf that values between its corners say what cells there have.
//!
//! Between the four corners of a box a number is taken as bilinear. In a box that was split this is off by some e at the
//! five cells between, and in its children, whose sides are half as long, by a quarter of e where the number is smooth;
//! they are called smooth where half of e is within the tolerance. A box of the map itself was not made by splitting:
//! there the second differences of neighbouring cells say the same.

use std::collections::HashMap;

use super::boxes::{Boxes, Square};
use super::codes::NOT_RUN;
use crate::results::column_set::ColumnSet;
use crate::results::columns::Column;
use crate::stepping::outcome::Outcome;

/// The numbers that are looked at.
pub const COUNT: usize = 4;

/// Where they lie in an outcome: the rocking index, the least contact force, the strokes.
pub fn places(outcome: &mut Outcome) -> [&mut f64; COUNT] {
    let Outcome { zeta, min_contact, max_u, stroke_v, .. } = outcome;
    [zeta, min_contact, max_u, stroke_v]
}

/// The numbers of an outcome.
pub fn numbers(outcome: &Outcome) -> [f64; COUNT] {
    [outcome.zeta, outcome.min_contact, outcome.max_u, outcome.stroke_v]
}

/// Numbers between those of four corners: `x` and `y` are the shares of the way along both axes.
pub fn between(corners: &[[f64; COUNT]; 4], [x, y]: [f64; 2]) -> [f64; COUNT] {
    std::array::from_fn(|k| {
        let [low, high] = [0, 2].map(|row| corners[row][k] * (1.0 - x) + corners[row + 1][k] * x);
        low * (1.0 - y) + high * y
    })
}

/// The numbers of cells that were run, and how far they may be off.
pub struct Smooth {
    /// Of each number, in its unit.
    tolerances: [f64; COUNT],
    /// Those that were requested: others are not looked at.
    asked: [bool; COUNT],
    numbers: HashMap<usize, [f64; COUNT]>,
}

impl Smooth {
    /// A tolerance as a share of the range that each number has on a map of these columns.
    pub fn new(tolerance: f64, held: ColumnSet) -> Smooth {
        let columns = [Column::Zeta, Column::MinContact, Column::MaxU, Column::StrokeV];
        let asked = columns.map(|column| held.has(column));
        Smooth { tolerances: [tolerance; COUNT], asked, numbers: HashMap::new() }
    }

    /// Takes cells that were run.
    pub fn add(&mut self, cells: &[usize], outcomes: &[Outcome]) {
        self.numbers.extend(cells.iter().copied().zip(outcomes.iter().map(numbers)));
    }

    /// Takes the ranges of the numbers that it has so far: those of the map. A number that is the same everywhere may be
    /// off by nothing.
    pub fn take_ranges(&mut self) {
        for (k, tolerance) in self.tolerances.iter_mut().enumerate() {
            let finite = self.numbers.values().map(|numbers| numbers[k]).filter(|x| x.is_finite());
            let ends = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            });
            *tolerance *= (ends.1 - ends.0).max(0.0);
        }
    }

    fn of(&self, cell: usize) -> [f64; COUNT] {
        self.numbers.get(&cell).copied().unwrap_or([f64::NAN; COUNT])
    }

    /// True where numbers are as near to others as they are to be; what is not a number is not.
    fn near(&self, one: &[f64; COUNT], other: &[f64; COUNT], part: f64) -> bool {
        let near = |k: usize| part * (one[k] - other[k]).abs() <= self.tolerances[k];
        (0..COUNT).all(|k| !self.asked[k] || near(k))
    }

    /// The numbers at the corners of a box.
    fn corners(&self, boxes: &Boxes, square: Square) -> [[f64; COUNT]; 4] {
        let width = boxes.shape().0;
        let (columns, rows) = boxes.cells(square);
        let corner = |row: usize, column: usize| self.of(row * width + column);
        [
            corner(*rows.start(), *columns.start()),
            corner(*rows.start(), *columns.end()),
            corner(*rows.end(), *columns.start()),
            corner(*rows.end(), *columns.end()),
        ]
    }

    /// True of a cell that was run where the numbers between the corners of its leaf are as near as they are to be.
    pub fn holds(&self, boxes: &Boxes, square: Square, cell: usize) -> bool {
        let (columns, rows) = boxes.cells(square);
        let (side, width) = (boxes.side(square.level) as f64, boxes.shape().0);
        let share = |at: usize, start: usize| (at - start) as f64 / side;
        let at = [share(cell % width, *columns.start()), share(cell / width, *rows.start())];
        self.near(&between(&self.corners(boxes, square), at), &self.of(cell), 1.0)
    }

    /// True of a box of one outcome over which all numbers are smooth to their tolerances.
    pub fn is_smooth(&self, boxes: &Boxes, codes: &[u8], square: Square) -> bool {
        match square.level {
            0 => self.is_smooth_among(boxes, codes, square),
            level => {
                let parent = Square { level: level - 1, j: square.j / 2, i: square.i / 2 };
                self.is_smooth_within(boxes, codes, parent)
            }
        }
    }

    /// By the nine cells of a box that was split.
    fn is_smooth_within(&self, boxes: &Boxes, codes: &[u8], parent: Square) -> bool {
        let width = boxes.shape().0;
        let (columns, rows) = boxes.cells(parent);
        let half = boxes.side(parent.level) / 2;
        let corners = self.corners(boxes, parent);
        let first = codes[rows.start() * width + columns.start()];
        rows.step_by(half).enumerate().all(|(j, row)| {
            columns.clone().step_by(half).enumerate().all(|(i, column)| {
                let cell = row * width + column;
                let taken = between(&corners, [0.5 * i as f64, 0.5 * j as f64]);
                codes[cell] == first && self.near(&taken, &self.of(cell), 0.5)
            })
        })
    }

    /// By the second differences of cells of the map along both axes. Where a neighbour on one side has another outcome
    /// the one on the other side is asked; with none there is nothing to go by.
    fn is_smooth_among(&self, boxes: &Boxes, codes: &[u8], square: Square) -> bool {
        let (width, height) = boxes.shape();
        let side = boxes.side(0);
        let first = [square.i * side, square.j * side];
        let code = codes[first[1] * width + first[0]];
        let at = |[column, row]: [usize; 2]| {
            let known = column < width && row < height && codes[row * width + column] == code;
            (known && code != NOT_RUN).then(|| self.of(row * width + column))
        };
        let along = |axis: usize, start: [usize; 2]| {
            let shifted = |gaps: isize| {
                let mut place = start;
                place[axis] = place[axis].checked_add_signed(gaps * side as isize)?;
                at(place)
            };
            [-1, 0].map(|from| {
                let [a, b, c] = [0, 1, 2].map(|gaps| shifted(from + gaps));
                let (a, b, c) = (a?, b?, c?);
                // The middle of two gaps is off by an eighth of this along each axis; both axes, and twice as much.
                let middle = std::array::from_fn(|k| 0.5 * (a[k] + c[k]));
                Some(self.near(&middle, &b, 1.0))
            })
        };
        (0..2).all(|axis| {
            let mut other = first;
            other[1 - axis] += side;
            [first, other].into_iter().all(|start| {
                let told = along(axis, start);
                told.iter().any(Option::is_some) && !told.contains(&Some(false))
            })
        })
    }
}
