//! The numbers of the cells of a list in tables: each table has one entry for each combination of the parameters that
//! it depends on. A clock that depends on all axes is computed for each cell from its parts.

use super::body::{Body, body_parameters};
use super::cell_list::CellList;
use super::clock::Clock;
use super::clock_parts::{
    ClockRule, SPAN, SWING_V, Span, SwingH, SwingV, clock_parameters, swing_parameters,
};
use super::contact::dependence::shared_amplitude;
use super::listing::{CellAt, Listing};
use super::plan::Plan;
use super::reader::Reader;
use super::table::Table;
use crate::model::block::Model;
use crate::model::excitation::{Cell, Drive, Horizontal, Steps, Vertical};
use crate::model::real::Real;
use crate::scene::{Case, Grid, Parameter};

/// The clocks of a grid.
#[derive(Debug)]
pub enum Clocks<R> {
    /// The clocks do not depend on every axis.
    Shared(Table<(Clock, Steps<R>)>),
    /// The clocks depend on every axis, and each is computed for its cell from its parts.
    Own(Box<ClockParts>),
}

/// The parts of clocks.
#[derive(Debug)]
pub struct ClockParts {
    swing_h: Table<SwingH>,
    swing_v: Table<SwingV>,
    span: Table<Span>,
    /// See [`Body::fall`].
    fall: Table<f64>,
}

/// The tables of a list of cells.
#[derive(Debug)]
pub struct CellTables<'a, R> {
    rule: ClockRule<'a>,
    grid: &'a Grid,
    cells: CellList<'a>,
    /// Numbers of the bodies: the block on its base.
    pub bodies: Table<Model<R>>,
    /// Numbers of the horizontal isolation.
    pub horizontal: Table<Horizontal<R>>,
    /// Numbers of the vertical isolation.
    pub vertical: Table<Vertical<R>>,
    /// Numbers of the excitation and of the start.
    pub drive: Table<Drive<R>>,
    /// The clocks.
    pub clocks: Clocks<R>,
    /// The numbers that turn a last state into an outcome.
    pub readers: Table<Reader>,
}

/// A table of numbers that depend on the body and on a law. The directions that the plan locks are locked here, too.
fn by_body<T: Send>(
    (plan, list): (&Plan, &Listing),
    law: &[Parameter],
    entry: impl Fn(&Case, &Body) -> T + Sync,
) -> Table<T> {
    Table::of(list, &[&body_parameters()[..], law].concat(), |case| {
        let case = plan.locked(case);
        entry(&case, &Body::of(&case))
    })
}

impl<'a, R: Real> CellTables<'a, R> {
    /// The tables of some cells of a plan's grid.
    pub fn of(plan: &'a Plan, grid: &'a Grid, cells: CellList<'a>) -> CellTables<'a, R> {
        let (rule, shared) = (plan.clock_rule(), shared_amplitude(plan, grid));
        let all = clock_parameters(grid);
        let list = Listing::of(grid, cells);
        let of = (plan, &list);
        // A single cell has a shared clock.
        let clocks = if list.share(&all) || cells.len() == 1 {
            Clocks::Shared(by_body(of, &all, |case, body| {
                let clock = plan.clock(case);
                (clock, Steps::of(rule.span(case).omega, &clock, body.fall()))
            }))
        } else {
            let swing = swing_parameters(grid);
            Clocks::Own(Box::new(ClockParts {
                swing_h: by_body(of, &swing, |case, body| rule.swing_h(case, body)),
                swing_v: by_body(of, &SWING_V, |case, body| rule.swing_v(case, body)),
                span: Table::of(&list, &SPAN, |case| rule.span(case)),
                fall: by_body(of, &[], |_, body| body.fall()),
            }))
        };
        CellTables {
            rule,
            grid,
            cells,
            bodies: by_body(of, &[], |_, body| body.model()),
            horizontal: by_body(of, &Horizontal::<R>::law(), Horizontal::of),
            vertical: by_body(of, &Vertical::<R>::law(), Vertical::of),
            drive: Table::of(&list, &Drive::<R>::LAW, |case| Drive::of(case, shared)),
            clocks,
            readers: by_body(of, &Reader::LAW, |case, _| Reader::of(case, plan.asked)),
        }
    }

    /// The grid.
    pub fn grid(&self) -> &'a Grid {
        self.grid
    }

    /// The cells of the list.
    pub fn cells(&self) -> CellList<'a> {
        self.cells
    }

    /// Steps of the longest cell of a list whose tables hold the clocks.
    pub fn longest(&self) -> u32 {
        match &self.clocks {
            Clocks::Shared(table) => {
                table.entries.iter().map(|(clock, _)| clock.steps).max().unwrap_or(0)
            }
            Clocks::Own(_) => u32::MAX,
        }
    }

    /// A cell, by its number in the list.
    #[inline(always)]
    pub fn cell(&self, number: usize) -> CellAt {
        CellAt { number, place: self.grid.place(self.cells.at(number)) }
    }

    /// A cell's clock.
    #[inline(always)]
    pub fn clock(&self, cell: &CellAt) -> Clock {
        match &self.clocks {
            Clocks::Shared(table) => table.at(cell).0,
            Clocks::Own(parts) => self.own_clock(parts, cell).clock,
        }
    }

    /// The clock of a cell from its parts, and the other numbers of its steps.
    #[inline(always)]
    pub(crate) fn own_clock(&self, parts: &ClockParts, cell: &CellAt) -> OwnClock {
        let span = parts.span.at(cell);
        let clock = self.rule.clock_of(parts.swing_h.at(cell), parts.swing_v.at(cell), span);
        OwnClock { clock, omega: span.omega, fall: *parts.fall.at(cell) }
    }

    /// The numbers of a cell's steps.
    #[inline(always)]
    pub fn steps(&self, cell: &CellAt) -> Steps<R> {
        match &self.clocks {
            Clocks::Shared(table) => table.at(cell).1,
            Clocks::Own(parts) => self.own_clock(parts, cell).steps(),
        }
    }

    /// All numbers of a cell.
    #[inline(always)]
    pub fn numbers(&self, cell: &CellAt) -> Cell<R> {
        Cell {
            horizontal: *self.horizontal.at(cell),
            vertical: *self.vertical.at(cell),
            drive: *self.drive.at(cell),
            steps: self.steps(cell),
            // A list has fewer than 2^32 bodies.
            body: self.bodies.index.of(cell) as u32,
            padding: 0,
        }
    }
}

/// The clock of one cell, with the other numbers of its steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OwnClock {
    pub(crate) clock: Clock,
    omega: Option<f64>,
    fall: f64,
}

impl OwnClock {
    /// The numbers of its steps.
    #[inline(always)]
    pub(crate) fn steps<R: Real>(&self) -> Steps<R> {
        Steps::of(self.omega, &self.clock, self.fall)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::clock::DEFAULT_STEP;
    use crate::model::pulse::Shape;
    use crate::scene::{Directions, Range, SceneBuilder};

    /// The number of entries of each table of a list.
    fn entries(scene: &SceneBuilder, list: impl Fn(&Grid) -> Vec<usize>) -> Vec<usize> {
        let scene = scene.clone().check().unwrap();
        let (plan, grid) = (Plan::new(&scene, DEFAULT_STEP).unwrap(), Grid::of(&scene));
        let cells = list(&grid);
        let tables = CellTables::<f32>::of(&plan, &grid, (&cells).into());
        let clocks = match &tables.clocks {
            Clocks::Shared(table) => vec![table.entries.len()],
            Clocks::Own(parts) => {
                let swings = [parts.swing_h.entries.len(), parts.swing_v.entries.len()];
                [&swings[..], &[parts.span.entries.len(), parts.fall.entries.len()]].concat()
            }
        };
        let others = [
            tables.bodies.entries.len(),
            tables.horizontal.entries.len(),
            tables.vertical.entries.len(),
            tables.drive.entries.len(),
            tables.readers.entries.len(),
        ];
        [&clocks[..], &others].concat()
    }

    /// Two axes of a million values each, on both of which one table depends: no machine can hold all pairs.
    fn coupled() -> Vec<SceneBuilder> {
        let many = |start, stop| Range::even(start, stop, 1 << 20);
        let free = || {
            let ground = SceneBuilder { isolation: Some(Directions::None), ..Default::default() };
            ground.with(Parameter::Omega, 5.0).with(Parameter::AH, 4.0)
        };
        let base = || {
            SceneBuilder::object(1)
                .with(Parameter::TV, 0.75)
                .with(Parameter::Omega, 5.0)
                .with(Parameter::AH, 4.0)
        };
        let object = SceneBuilder { object: Some(1), ..free() };
        let velocity = SceneBuilder { shape: Some(Shape::MavroeidisPapageorgiou), ..object };
        vec![
            free()
                .with(Parameter::HalfWidth, many(0.1, 0.4))
                .with(Parameter::Height, many(0.5, 2.0)),
            base().with(Parameter::TH, many(1.0, 3.0)).with(Parameter::Psi, many(0.1, 0.9)),
            velocity.with(Parameter::Gamma, many(1.5, 3.0)).with(Parameter::Phase, many(0.0, 3.0)),
        ]
    }

    #[test]
    fn tables_of_a_list_have_no_more_entries_than_it_has_cells() {
        for scene in coupled() {
            // Cells from all parts of the grid, and some cells that differ along one axis alone.
            let list = |grid: &Grid| {
                let all_over = (0..500).map(|k| k * (grid.len() / 500 + 1));
                all_over.chain((0..100).map(|row| row * (1 << 20))).collect()
            };
            let entries = entries(&scene, list);
            assert!(entries.iter().all(|entries| *entries <= 600), "{entries:?}");
            assert!(entries.contains(&599), "cell 0 is there twice: {entries:?}");
        }
    }
}
