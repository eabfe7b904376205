//! Where a map's outcomes are read from: memory, or a disk that holds more.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io;
use std::ops::Range;

use crate::scene::values::spread;
use crate::scene::{Grid, Parameter, Scene};
use crate::stepping::outcome::{Class, Outcome, Status};

use super::columns::Column;
use super::{Map, slides};

/// Cells that are read at once by what goes through all of them.
pub const BLOCK: usize = 1 << 16;

/// The outcomes of a grid, in its order.
pub trait Outcomes: Sync {
    /// The outcomes of some cells. Only the columns asked for are sure to be filled in.
    ///
    /// # Errors
    /// Those of the disk.
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>>;
}

impl Outcomes for [Outcome] {
    fn read(&self, cells: Range<usize>, _: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        Ok(Cow::Borrowed(&self[cells]))
    }
}

impl Outcomes for Vec<Outcome> {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        self.as_slice().read(cells, columns)
    }
}

impl Outcomes for Map<'_> {
    fn read(&self, cells: Range<usize>, columns: &[Column]) -> io::Result<Cow<'_, [Outcome]>> {
        self.outcomes[..].read(cells, columns)
    }
}

/// Goes through some columns of all of a grid's cells; `see` is handed block after block with the
/// number of its first cell.
///
/// # Errors
/// Those of reading, and of `see`.
pub fn each_block(
    grid: &Grid,
    outcomes: &dyn Outcomes,
    columns: &[Column],
    mut see: impl FnMut(usize, &[Outcome]) -> io::Result<()>,
) -> io::Result<()> {
    for first in (0..grid.len()).step_by(BLOCK) {
        let block = outcomes.read(first..(first + BLOCK).min(grid.len()), columns)?;
        see(first, &block)?;
    }
    Ok(())
}

/// Cells counted.
#[derive(Debug, Clone, PartialEq)]
pub struct Tally {
    /// All cells.
    pub cells: usize,
    /// Those of each class, in the order of [`Class::ALL`].
    by_class: [usize; 5],
    /// Those in which the contact force turned tensile, where the model does not hold.
    pub tensile: usize,
    /// Those that ask for more friction than the scene has; none where it has no coefficient.
    pub sliding: Option<usize>,
    /// Those that ended early, all that they tell proved final.
    pub proved: usize,
    /// Mean time simulated by a cell that stands, s.
    pub mean_time: f64,
}

impl Tally {
    /// Counts the cells of a grid.
    ///
    /// # Errors
    /// Those of reading.
    pub fn of(grid: &Grid, outcomes: &dyn Outcomes) -> io::Result<Tally> {
        let mut tally = Tally {
            cells: grid.len(),
            by_class: [0; 5],
            tensile: 0,
            sliding: grid.value(Parameter::Friction, 0).map(|_| 0),
            proved: 0,
            mean_time: 0.0,
        };
        let (mut stand, mut time) = (0_usize, 0.0);
        let columns = [
            Column::Outcome,
            Column::Status,
            Column::TSimulated,
            Column::MinContact,
            Column::Friction,
        ];
        each_block(grid, outcomes, &columns, |first, block| {
            for (index, cell) in (first..).zip(block) {
                tally.by_class[cell.class as usize] += 1;
                tally.tensile += usize::from(cell.min_contact < 0.0);
                tally.proved += usize::from(cell.status == Status::Proved);
                if let Some(sliding) = &mut tally.sliding {
                    *sliding += usize::from(slides(grid, index, cell));
                }
                if !cell.class.overturned() && cell.class != Class::Unresolved {
                    stand += 1;
                    time += cell.t_simulated;
                }
            }
            Ok(())
        })?;
        tally.mean_time = time / stand.max(1) as f64;
        Ok(tally)
    }

    /// Cells of each class, by name.
    pub fn classes(&self) -> BTreeMap<&'static str, usize> {
        Class::ALL.into_iter().map(|class| (class.name(), self.count(class))).collect()
    }

    /// Number of cells of a class.
    pub fn count(&self, class: Class) -> usize {
        self.by_class[class as usize]
    }
}

/// Most cells a side of what is drawn: four times the pixels that a figure has for them.
pub const DRAWN: usize = 2048;

/// A map of a slice, which begins at a cell of the sweep's grid, with at most so many cells a side, as of
/// [`DRAWN`] it is drawn: all of its cells, or of a longer side as many evenly spread ones.
///
/// # Errors
/// Those of reading.
pub fn thinned<'a>(
    scene: &'a Scene,
    (grid, first): (&Grid, usize),
    outcomes: &'a dyn Outcomes,
    most: usize,
) -> io::Result<Map<'a>> {
    let (columns, rows) = grid.shape();
    let thin = grid.thinned(most);
    if thin == *grid {
        let outcomes = outcomes.read(first..first + grid.len(), &Column::ALL)?;
        return Ok(Map { scene, grid: thin, outcomes });
    }
    let (across, up) = thin.shape();
    let mut some = Vec::with_capacity(thin.len());
    for j in 0..up {
        let first = first + spread(j, up, rows) * columns;
        let row = outcomes.read(first..first + columns, &Column::ALL)?;
        some.extend((0..across).map(|i| row[spread(i, across, columns)]));
    }
    Ok(Map { scene, grid: thin, outcomes: Cow::Owned(some) })
}
