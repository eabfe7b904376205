//! Cells drawn at random among those that were left alone, one from each stratum.
//!
//! The leaves in the order of the tree, with as many places as each has cells that were not run, make one long row. It
//! is cut into strata of equal length, and one place is drawn from each: neighbours in the row are neighbours on the
//! map, so that the probes are spread evenly over it.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;

use super::boxes::{Boxes, Square};
use super::codes::NOT_RUN;

/// A cell that is run as a probe, and its leaf.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Probe {
    /// The cell.
    pub cell: usize,
    /// The leaf that contains the cell.
    pub leaf: Square,
}

/// Leaves, with the number of their cells that were not run.
pub struct LeftAlone {
    leaves: Vec<(Square, usize)>,
    /// The number of cells that were not run, of all leaves together.
    pub count: usize,
}

/// The columns and rows of the cells that belong to a leaf: without its upper and right borders, except at the far borders of the
/// map, where these belong to it, too.
pub fn own_cells(boxes: &Boxes, leaf: Square) -> (std::ops::Range<usize>, std::ops::Range<usize>) {
    let (columns, rows) = boxes.shape();
    let (across, up) = boxes.cells(leaf);
    let end = |range: &std::ops::RangeInclusive<usize>, count: usize| {
        *range.end() + usize::from(*range.end() + 1 == count)
    };
    (*across.start()..end(&across, columns), *up.start()..end(&up, rows))
}

/// The number of cells that belong to a leaf and were not run.
fn not_run(boxes: &Boxes, codes: &[u8], leaf: Square) -> usize {
    let width = boxes.shape().0;
    let (columns, rows) = own_cells(boxes, leaf);
    let row = |row: usize| &codes[row * width + columns.start..row * width + columns.end];
    let alone = |row: &[u8]| row.iter().filter(|code| **code == NOT_RUN).count();
    rows.map(|number| alone(row(number))).sum()
}

impl LeftAlone {
    /// The leaves of one outcome that have cells which were not run, by the codes of all cells.
    pub fn of(boxes: &Boxes, codes: &[u8], is_mixed: impl Fn(Square) -> bool) -> LeftAlone {
        let (mut leaves, mut count) = (Vec::new(), 0);
        boxes.each_leaf(|leaf| {
            if leaf.level == boxes.levels() || is_mixed(leaf) {
                return;
            }
            let alone = not_run(boxes, codes, leaf);
            if alone > 0 {
                leaves.push((leaf, alone));
                count += alone;
            }
        });
        LeftAlone { leaves, count }
    }

    /// Draws `count` cells, one from each stratum; all cells where there are no more than that.
    pub fn draw(
        &self,
        boxes: &Boxes,
        codes: &[u8],
        wanted: usize,
        random: &mut Pcg64Mcg,
    ) -> Vec<Probe> {
        let wanted = wanted.min(self.count);
        let width = boxes.shape().0;
        let mut probes = Vec::with_capacity(wanted);
        let (mut leaf, mut before) = (0, 0);
        for stratum in 0..wanted {
            let ends =
                [stratum, stratum + 1].map(|k| k as u128 * self.count as u128 / wanted as u128);
            let length = ends[1] - ends[0];
            let place = (ends[0] + ((u128::from(random.next_u64()) * length) >> 64)) as usize;
            while before + self.leaves[leaf].1 <= place {
                before += self.leaves[leaf].1;
                leaf += 1;
            }
            let square = self.leaves[leaf].0;
            let (columns, rows) = own_cells(boxes, square);
            let cells =
                rows.flat_map(|row| columns.clone().map(move |column| row * width + column));
            let mut alone = cells.filter(|cell| codes[*cell] == NOT_RUN);
            if let Some(cell) = alone.nth(place - before) {
                probes.push(Probe { cell, leaf: square });
            }
        }
        probes
    }
}
