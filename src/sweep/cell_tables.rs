//! The numbers of a grid's cells in tables, each by the parameters that it depends on. A clock that depends
//! on all axes is made for each cell, of its parts.

use super::body::{BODY, Body};
use super::cells::Reader;
use super::clock::Clock;
use super::clock_parts::{SPAN, STRENGTH, SWING_H, SWING_V, Span, SwingH, SwingV};
use super::groups::{Drive, Groups, Horizontal, Steps, Vertical};
use super::plan::Plan;
use super::table::{Table, Window};
use crate::model::block::Model;
use crate::model::real::Real;
use crate::scene::grid::Place;
use crate::scene::{Case, Grid, Parameter};

/// The clocks of a grid.
#[derive(Debug)]
pub enum Clocks<R> {
    /// They do not depend on every axis.
    Shared(Table<(Clock, Steps<R>)>),
    /// They do, and are made for each cell of its parts.
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
    /// Of what an outcome is read by.
    pub readers: Table<Reader>,
}

/// What a clock depends on.
pub(super) fn clock_parameters(grid: &Grid) -> Vec<Parameter> {
    [&BODY[..], &swing_parameters(grid), &SWING_V, &SPAN].concat()
}

/// What the horizontal part of a clock depends on, beside the body.
fn swing_parameters(grid: &Grid) -> Vec<Parameter> {
    let mut swing = SWING_H.to_vec();
    if grid.gives_strength() {
        swing.extend(STRENGTH);
    }
    swing
}

impl<'a, R: Real> CellTables<'a, R> {
    /// The tables of a plan's grid, for the cells in a window.
    pub fn of(plan: &'a Plan, grid: &'a Grid, window: &Window) -> CellTables<'a, R> {
        let shared = plan.shared_amplitude(grid);
        let all = clock_parameters(grid);
        let body = |case: &Case| Body::of(&plan.locked(case));
        // An axis of one value counts as one that they depend on only where all do.
        let clocks = if window.entries(grid, &all) < window.cells() || window.cells() == 1 {
            Clocks::Shared(Table::of(grid, window, &all, |case| {
                let clock = plan.clock(case);
                (clock, Steps::of(plan.span(case).omega, &clock, body(case).fall()))
            }))
        } else {
            let of_h = [&BODY[..], &swing_parameters(grid)].concat();
            let of_v = [&BODY[..], &SWING_V].concat();
            let swing_h = |case: &Case| plan.swing_h(&plan.locked(case), &body(case));
            let swing_v = |case: &Case| plan.swing_v(&plan.locked(case), &body(case));
            Clocks::Own(Box::new(Parts {
                swing_h: Table::of(grid, window, &of_h, swing_h),
                swing_v: Table::of(grid, window, &of_v, swing_v),
                span: Table::of(grid, window, &SPAN, |case| plan.span(case)),
                fall: Table::of(grid, window, &BODY, |case| body(case).fall()),
            }))
        };
        let of_h = [&BODY[..], &Horizontal::<R>::LAW].concat();
        let of_v = [&BODY[..], &Vertical::<R>::LAW].concat();
        let of_reader = [&BODY[..], &Reader::LAW].concat();
        let (horizontal, vertical) = (
            |case: &Case| Horizontal::of(&plan.locked(case), &body(case)),
            |case: &Case| Vertical::of(&plan.locked(case), &body(case)),
        );
        CellTables {
            plan,
            grid,
            bodies: Table::of(grid, window, &BODY, |case| body(case).model()),
            horizontal: Table::of(grid, window, &of_h, horizontal),
            vertical: Table::of(grid, window, &of_v, vertical),
            drive: Table::of(grid, window, &Drive::<R>::LAW, |case| Drive::of(case, shared)),
            clocks,
            readers: Table::of(grid, window, &of_reader, Reader::of),
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

    /// The clock of a cell made of its parts, and what its steps take besides.
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

/// A clock of a cell of its own.
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
