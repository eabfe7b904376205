//! The numbers of a grid's cells in tables: each table has one entry for each combination of the
//! parameters that it depends on. A clock that depends on all axes is computed for each cell from its
//! parts.

use super::body::{Body, body_parameters};
use super::clock::Clock;
use super::clock_parts::{SPAN, SWING_V, Span, SwingH, SwingV, clock_parameters, swing_parameters};
use super::groups::{Drive, Groups, Horizontal, Steps, Vertical};
use super::plan::Plan;
use super::reader::Reader;
use super::table::{Table, Window};
use crate::model::block::Model;
use crate::model::real::Real;
use crate::scene::grid::Place;
use crate::scene::isolation::VERTICAL;
use crate::scene::{Case, Grid, Parameter};

/// The clocks of a grid.
#[derive(Debug)]
pub enum Clocks<R> {
    /// They do not depend on every axis.
    Shared(Table<(Clock, Steps<R>)>),
    /// They do, and are computed for each cell from its parts.
    Own(Box<Parts>),
}

/// The parts of clocks.
#[derive(Debug)]
pub struct Parts {
    swing_h: Table<SwingH>,
    swing_v: Table<SwingV>,
    span: Table<Span>,
    /// See [`Body::fall`].
    fall: Table<f64>,
}

/// The tables of a plan's grid.
#[derive(Debug)]
pub struct CellTables<'a, R> {
    plan: &'a Plan,
    grid: &'a Grid,
    /// Of the bodies: the block on its base.
    pub bodies: Table<Model<R>>,
    /// Of the horizontal isolation.
    pub horizontal: Table<Horizontal<R>>,
    /// Of the vertical isolation.
    pub vertical: Table<Vertical<R>>,
    /// Of the excitation and the start.
    pub drive: Table<Drive<R>>,
    /// Of the clock.
    pub clocks: Clocks<R>,
    /// Of the numbers that turn a last state into an outcome.
    pub readers: Table<Reader>,
}

/// A table of numbers that depend on the body and a law; the directions that the plan locks are locked.
fn by_body<T>(
    (plan, grid, window): (&Plan, &Grid, &Window),
    law: &[Parameter],
    entry: impl Fn(&Case, &Body) -> T,
) -> Table<T> {
    Table::of(grid, window, &[&body_parameters()[..], law].concat(), |case| {
        let case = plan.locked(case);
        entry(&case, &Body::of(&case))
    })
}

impl<'a, R: Real> CellTables<'a, R> {
    /// The tables of a plan's grid, for the cells in a window.
    pub fn of(plan: &'a Plan, grid: &'a Grid, window: &Window) -> CellTables<'a, R> {
        let shared = plan.shared_amplitude(grid);
        let all = clock_parameters(grid);
        let of = (plan, grid, window);
        // A single cell has a shared clock.
        let clocks = if window.entries(grid, &all) < window.cells() || window.cells() == 1 {
            Clocks::Shared(by_body(of, &all, |case, body| {
                let clock = plan.clock(case);
                (clock, Steps::of(plan.span(case).omega, &clock, body.fall()))
            }))
        } else {
            let swing = swing_parameters(grid);
            Clocks::Own(Box::new(Parts {
                swing_h: by_body(of, &swing, |case, body| plan.swing_h(case, body)),
                swing_v: by_body(of, &SWING_V, |case, body| plan.swing_v(case, body)),
                span: Table::of(grid, window, &SPAN, |case| plan.span(case)),
                fall: by_body(of, &[], |_, body| body.fall()),
            }))
        };
        CellTables {
            plan,
            grid,
            bodies: by_body(of, &[], |_, body| body.model()),
            horizontal: by_body(of, &Horizontal::<R>::law(), Horizontal::of),
            vertical: by_body(of, &VERTICAL, Vertical::of),
            drive: Table::of(grid, window, &Drive::<R>::LAW, |case| Drive::of(case, shared)),
            clocks,
            readers: by_body(of, &Reader::LAW, |case, _| Reader::of(case)),
        }
    }

    /// The grid.
    pub fn grid(&self) -> &'a Grid {
        self.grid
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

    /// A cell's place along each axis.
    #[inline(always)]
    pub fn place(&self, index: usize) -> Place {
        self.grid.place(index)
    }

    /// A cell's clock.
    #[inline(always)]
    pub fn clock(&self, place: &Place) -> Clock {
        match &self.clocks {
            Clocks::Shared(table) => table.at(place).0,
            Clocks::Own(parts) => self.own_clock(parts, place).clock,
        }
    }

    /// The clock of a cell from its parts, and the other numbers of its steps.
    #[inline(always)]
    pub(super) fn own_clock(&self, parts: &Parts, place: &Place) -> OwnClock {
        let span = parts.span.at(place);
        let clock = self.plan.clock_of(parts.swing_h.at(place), parts.swing_v.at(place), span);
        OwnClock { clock, omega: span.omega, fall: *parts.fall.at(place) }
    }

    /// The numbers of a cell's steps.
    #[inline(always)]
    pub fn steps(&self, place: &Place) -> Steps<R> {
        match &self.clocks {
            Clocks::Shared(table) => table.at(place).1,
            Clocks::Own(parts) => self.own_clock(parts, place).steps(),
        }
    }

    /// All groups of a cell.
    #[inline(always)]
    pub fn groups(&self, place: &Place) -> Groups<R> {
        Groups {
            horizontal: *self.horizontal.at(place),
            vertical: *self.vertical.at(place),
            drive: *self.drive.at(place),
            steps: self.steps(place),
            // A window has fewer than 2^32 bodies.
            body: self.bodies.index(place) as u32,
        }
    }
}

/// The clock of one cell, with the other numbers of its steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OwnClock {
    pub(super) clock: Clock,
    omega: Option<f64>,
    fall: f64,
}

impl OwnClock {
    /// The numbers of its steps.
    #[inline(always)]
    pub(super) fn steps<R: Real>(&self) -> Steps<R> {
        Steps::of(self.omega, &self.clock, self.fall)
    }
}
