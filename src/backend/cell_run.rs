//! A request to a backend: cells of the grid of a plan, and how they are run.

use std::borrow::Cow;

use crate::cells::plan::Plan;
use crate::model::precision::Precision;
use crate::results::block::Block;
use crate::scene::Grid;

/// Cells that a backend is to run.
pub struct CellRun<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// The grid that numbers the cells.
    pub grid: &'a Grid,
    /// The numbers of the cells, in any order; the outcomes have the same order.
    pub cells: Cow<'a, [usize]>,
    /// Number type.
    pub precision: Precision,
    /// Each cell runs twice, see [`Method::resolve`](crate::sweep::settings::Method::resolve).
    pub resolve: bool,
    /// The receiver of cells that are done while others still run.
    pub snapshots: Option<Snapshots<'a>>,
}

/// Receives the outcomes of a run that continues: in the order of its cells, and with the values that they have at
/// the end. Cells that have not run are pending.
#[derive(Clone, Copy)]
pub struct Snapshots<'a> {
    /// True when a snapshot is due.
    pub due: &'a (dyn Fn() -> bool + Sync),
    /// Receives a snapshot.
    pub take: &'a (dyn Fn(Block) + Sync),
}

impl<'a> CellRun<'a> {
    /// Some cells of a grid, once each.
    pub fn of(
        plan: &'a Plan,
        grid: &'a Grid,
        cells: impl Into<Cow<'a, [usize]>>,
        precision: Precision,
    ) -> CellRun<'a> {
        CellRun { plan, grid, cells: cells.into(), precision, resolve: false, snapshots: None }
    }

    /// All cells of a grid, once each.
    pub fn all(plan: &'a Plan, grid: &'a Grid, precision: Precision) -> CellRun<'a> {
        CellRun::of(plan, grid, (0..grid.len()).collect::<Vec<usize>>(), precision)
    }

    /// The same request, with each cell run twice where that is requested.
    pub fn resolving(self, resolve: bool) -> CellRun<'a> {
        CellRun { resolve, ..self }
    }
}
