//! Cells counted: by outcome, and where the model is not valid.

use std::collections::BTreeMap;
use std::io;

use super::column_set::ColumnSet;
use super::columns::Column;
use super::outcomes::{Outcomes, each_block};
use crate::scene::{Grid, Parameter};
use crate::stepping::outcome::{Class, Outcome, Status};

/// True where a cell of a grid has a friction coefficient and asks for more.
pub fn slides(grid: &Grid, cell: usize, outcome: &Outcome) -> bool {
    outcome.slides(grid.value(Parameter::Friction, cell))
}

/// Columns that are read to count cells.
pub const COLUMNS: [Column; 5] =
    [Column::Outcome, Column::Status, Column::TSimulated, Column::MinContact, Column::Friction];

/// Cells counted.
#[derive(Debug, Clone, PartialEq)]
pub struct Tally {
    /// All cells.
    pub cells: usize,
    /// Those of each class, in the order of [`Class::ALL`].
    by_class: [usize; 5],
    /// Those in which the contact force turned tensile, where the model is not valid; none if nobody requested contact
    /// forces.
    pub tensile: Option<usize>,
    /// Those that ask for more friction than the scene has; none if it has no coefficient, or nobody requested contact
    /// forces.
    pub sliding: Option<usize>,
    /// Those that stand and move farther than the radius of their pendulum, where no dish is; none without a pendulum, or where
    /// nobody asked for max |u|.
    pub beyond_radius: Option<usize>,
    /// Those that ended early, their results proved final.
    pub proved: usize,
    /// Mean time simulated by a cell that stands, s.
    pub mean_time: f64,
}

impl Tally {
    /// Counts the cells of a grid, of which these columns were requested.
    ///
    /// # Errors
    /// Those of reading.
    pub fn of(grid: &Grid, outcomes: &dyn Outcomes, asked: ColumnSet) -> io::Result<Tally> {
        let forces = asked.asked().forces;
        let friction = grid.value(Parameter::Friction, 0).filter(|_| forces);
        let radius = grid.value(Parameter::Radius, 0).filter(|_| asked.has(Column::MaxU));
        let more = radius.map(|_| Column::MaxU);
        let columns: Vec<Column> = COLUMNS.into_iter().chain(more).collect();
        let mut tally = Tally {
            cells: grid.len(),
            by_class: [0; 5],
            tensile: forces.then_some(0),
            sliding: friction.map(|_| 0),
            beyond_radius: radius.map(|_| 0),
            proved: 0,
            mean_time: 0.0,
        };
        let (mut stand, mut time) = (0_usize, 0.0);
        each_block(grid.len(), outcomes, &columns, |first, block| {
            for (index, cell) in (first..).zip(block) {
                tally.by_class[cell.class as usize] += 1;
                if let Some(tensile) = &mut tally.tensile {
                    *tensile += usize::from(cell.loses_contact());
                }
                tally.proved += usize::from(cell.status == Status::Proved);
                if let Some(sliding) = &mut tally.sliding {
                    *sliding += usize::from(slides(grid, index, cell));
                }
                let radius = grid.value(Parameter::Radius, index).unwrap_or(f64::INFINITY);
                if let Some(beyond) = &mut tally.beyond_radius {
                    *beyond += usize::from(cell.class.stands() && cell.max_u > radius);
                }
                if cell.class.stands() {
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
