//! The numbers of a grid's cells in tables.
//!
//! Each group of a cell's numbers depends on some of the grid's axes only: under a pulse the steps
//! on Omega, the yield displacement on A_h. A table has one entry for each value of the axes that
//! its group depends on, so that a map of a thousand columns and rows needs a few thousand entries
//! for its million cells. A clock that depends on all axes is made for each cell, of the parts that a
//! column and a row have in it.

use super::clock::Clock;
use super::coefficients::{Span, SwingH, SwingV};
use super::groups::{Drive, Groups, Horizontal, Steps, Vertical};
use super::plan::Plan;
use crate::model::real::Real;
use crate::scene::grid::Axis;
use crate::scene::{Grid, Point};

/// A cell's column and row in its grid.
pub type Place = [usize; 2];

/// One entry for each value of the axes that a group depends on.
#[derive(Debug, Clone)]
pub struct Table<T> {
    /// The entries, columns first.
    pub entries: Vec<T>,
    /// Entries from a column to the next and from a row to the next: none along an axis of no
    /// effect.
    pub strides: [usize; 2],
}

impl<T> Table<T> {
    /// The table of a group that depends on these parameters.
    fn of(grid: &Grid, parameters: &[&str], entry: impl Fn(&Point) -> T) -> Table<T> {
        let [columns, rows] = axes(grid, parameters);
        let width = grid.shape().0;
        let points = (0..rows).flat_map(|row| (0..columns).map(move |at| row * width + at));
        let entries = points.map(|cell| entry(&grid.point(cell))).collect();
        Table { entries, strides: [usize::from(columns > 1), columns * usize::from(rows > 1)] }
    }

    /// The entry of a cell.
    #[inline(always)]
    pub fn at(&self, [column, row]: Place) -> &T {
        &self.entries[column * self.strides[0] + row * self.strides[1]]
    }
}

/// Values of each axis that these parameters have: one along an axis of another parameter.
fn axes(grid: &Grid, parameters: &[&str]) -> [usize; 2] {
    let values = |axis: &Axis| match parameters.contains(&axis.key) {
        true => axis.range.count as usize,
        false => 1,
    };
    [values(&grid.x), values(&grid.y)]
}

/// What each group depends on.
const HORIZONTAL: [&str; 2] = ["t_h", "a_h"];
const VERTICAL: [&str; 1] = ["t_v"];
const DRIVE: [&str; 2] = ["a_h", "a_v"];
const CLOCK: [&str; 3] = ["t_h", "t_v", "omega"];

/// The clocks of a grid.
#[derive(Debug)]
pub enum Clocks<R> {
    /// They do not depend on every axis.
    Shared(Table<(Clock, Steps<R>)>),
    /// They do, and are made for each cell of its column's part and its row's.
    Own(Parts),
}

/// The parts of clocks.
#[derive(Debug)]
pub struct Parts {
    swing_h: Table<SwingH>,
    swing_v: Table<SwingV>,
    span: Table<Span>,
}

/// The tables of a plan's grid.
#[derive(Debug)]
pub struct CellTables<'a, R> {
    plan: &'a Plan,
    /// Columns of the grid.
    pub columns: usize,
    /// Of the horizontal isolation.
    pub horizontal: Table<Horizontal<R>>,
    /// Of the vertical isolation.
    pub vertical: Table<Vertical<R>>,
    /// Of the excitation.
    pub drive: Table<Drive<R>>,
    /// Of the clock.
    pub clocks: Clocks<R>,
    fall: f64,
}

impl<'a, R: Real> CellTables<'a, R> {
    /// The tables of a plan's grid.
    pub fn of(plan: &'a Plan, grid: &Grid) -> CellTables<'a, R> {
        let fall = plan.fall();
        let shared = plan.shared_amplitude();
        // An axis of one value counts as one that they depend on only where all do.
        let clocks = if axes(grid, &CLOCK).into_iter().product::<usize>() < grid.len() {
            Clocks::Shared(Table::of(grid, &CLOCK, |point| {
                let clock = plan.clock(point);
                (clock, plan.steps(point.omega, &clock, fall))
            }))
        } else {
            Clocks::Own(Parts {
                swing_h: Table::of(grid, &["t_h"], |point| plan.swing_h(point.t_h)),
                swing_v: Table::of(grid, &["t_v"], |point| plan.swing_v(point.t_v)),
                span: Table::of(grid, &["omega"], |point| plan.span(point.omega)),
            })
        };
        CellTables {
            plan,
            columns: grid.shape().0,
            horizontal: Table::of(grid, &HORIZONTAL, |p| plan.horizontal(p.t_h, p.a_h)),
            vertical: Table::of(grid, &VERTICAL, |p| plan.vertical(p.t_v)),
            drive: Table::of(grid, &DRIVE, |p| plan.drive(p.a_h, p.a_v, shared)),
            clocks,
            fall,
        }
    }

    /// Steps of the longest cell of a grid whose tables hold the clocks.
    pub fn longest(&self) -> u32 {
        match &self.clocks {
            Clocks::Shared(table) => {
                table.entries.iter().map(|(clock, _)| clock.steps).max().unwrap_or(0)
            }
            Clocks::Own(_) => u32::MAX,
        }
    }

    /// A cell's column and row.
    #[inline(always)]
    pub fn place(&self, index: usize) -> Place {
        // Most grids are small enough for the shorter division, which takes half the time.
        if let (Ok(index), Ok(columns)) = (u32::try_from(index), u32::try_from(self.columns)) {
            return [(index % columns) as usize, (index / columns) as usize];
        }
        [index % self.columns, index / self.columns]
    }

    /// A cell's clock.
    #[inline(always)]
    pub fn clock(&self, place: Place) -> Clock {
        match &self.clocks {
            Clocks::Shared(table) => table.at(place).0,
            Clocks::Own(parts) => self.own_clock(parts, place).0,
        }
    }

    /// The clock of a cell made of its parts, and Omega.
    #[inline(always)]
    pub(super) fn own_clock(&self, parts: &Parts, place: Place) -> (Clock, f64) {
        let span = parts.span.at(place);
        (self.plan.clock_of(parts.swing_h.at(place), parts.swing_v.at(place), span), span.omega)
    }

    /// The numbers of a clock's steps.
    #[inline(always)]
    pub(super) fn steps_of(&self, omega: f64, clock: &Clock) -> Steps<R> {
        self.plan.steps(omega, clock, self.fall)
    }

    /// The numbers of a cell's steps.
    #[inline(always)]
    pub fn steps(&self, place: Place) -> Steps<R> {
        match &self.clocks {
            Clocks::Shared(table) => table.at(place).1,
            Clocks::Own(parts) => {
                let (clock, omega) = self.own_clock(parts, place);
                self.steps_of(omega, &clock)
            }
        }
    }

    /// All groups of a cell.
    #[inline(always)]
    pub fn groups(&self, place: Place) -> Groups<R> {
        Groups {
            horizontal: *self.horizontal.at(place),
            vertical: *self.vertical.at(place),
            drive: *self.drive.at(place),
            steps: self.steps(place),
        }
    }
}
