//! A request to a backend: cells of the grid of a plan, and how they are run.

use crate::cells::cell_list::CellList;
use crate::cells::plan::Plan;
use crate::model::precision::Precision;
use crate::scene::Grid;

/// Cells that a backend is to run.
#[derive(Clone, Copy)]
pub struct CellRun<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// The grid that numbers the cells.
    pub grid: &'a Grid,
    /// The cells; the outcomes have the same order.
    pub cells: CellList<'a>,
    /// Number type.
    pub precision: Precision,
    /// Each cell runs twice, see [`Method::resolve`](crate::sweep::settings::Method::resolve).
    pub resolve: bool,
}

impl<'a> CellRun<'a> {
    /// Some cells of a grid, once each.
    pub fn of(
        plan: &'a Plan,
        grid: &'a Grid,
        cells: impl Into<CellList<'a>>,
        precision: Precision,
    ) -> CellRun<'a> {
        CellRun { plan, grid, cells: cells.into(), precision, resolve: false }
    }

    /// All cells of a grid, once each.
    pub fn all(plan: &'a Plan, grid: &'a Grid, precision: Precision) -> CellRun<'a> {
        CellRun::of(plan, grid, 0..grid.len(), precision)
    }

    /// The same request, with each cell run twice where that is requested.
    pub fn resolving(self, resolve: bool) -> CellRun<'a> {
        CellRun { resolve, ..self }
    }
}
