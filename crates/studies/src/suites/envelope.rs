//! The envelope of a suite: which cells keep the block standing under how many of its motions, within which strokes.

use std::io::{self, Write};

use super::columns::{self, TableColumn, number};
use super::swept::SuiteSweep;
use super::swept_motion::{SweptMotion, Values};
use crate::statistics::quantile;
use topple::results::csv::Number;
use topple::stepping::outcome::Class;

/// What a base must do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Share of the motions under which the block must stand.
    pub standing: f64,
    /// Largest max |u|, m; none where there is room for any.
    pub u: Option<f64>,
    /// Largest stroke of v, m.
    pub v: Option<f64>,
}

/// Shares of the motions whose strokes are told.
pub const SHARES: [f64; 3] = [0.5, 0.84, 1.0];

/// A cell under all motions. Shares are of their weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellEnvelope {
    /// Share under which the block stands: it rocks, or stays in full contact.
    pub standing: f64,
    /// Share under which it overturns. Where cells are unresolved both sum to less than one.
    pub overturned: f64,
    /// Share under which it rocks and stands.
    pub rocked: f64,
    /// Percentiles of max |u| over the motions under which it stands, m; not numbers where there are none.
    pub max_u: [f64; 3],
    /// Those of the stroke of v, m.
    pub stroke_v: [f64; 3],
    /// Those of the rocking index.
    pub zeta: [f64; 3],
    /// All limits are kept.
    pub feasible: bool,
}

/// The cells of a grid under a suite.
#[derive(Debug)]
pub struct Envelope {
    /// The sweeps that it was made of.
    pub sweep: SuiteSweep,
    /// The limits.
    pub limits: Limits,
    /// A cell each, in the grid's order.
    pub cells: Vec<CellEnvelope>,
}

impl Envelope {
    /// Reduces the sweeps of a suite, cell by cell.
    pub fn of(sweep: SuiteSweep, limits: Limits) -> Envelope {
        let cells = (0..sweep.grid.len()).map(|cell| reduced(&sweep, cell, limits)).collect();
        Envelope { sweep, limits, cells }
    }

    /// The feasible cells: those that have a feasible neighbour before those alone, least max |u| first, of equal ones the
    /// least stroke of v.
    pub fn best(&self) -> Vec<usize> {
        let mut best: Vec<usize> =
            (0..self.cells.len()).filter(|cell| self.cells[*cell].feasible).collect();
        best.sort_by_cached_key(|cell| {
            let CellEnvelope { max_u, stroke_v, .. } = self.cells[*cell];
            // Strokes are not negative: their bits sort as they do.
            (self.is_alone(*cell), max_u[2].to_bits(), stroke_v[2].to_bits())
        });
        best
    }

    /// True of a feasible cell that has neighbours, none of them feasible: a small change of the base is too much.
    pub fn is_alone(&self, cell: usize) -> bool {
        let grid = &self.sweep.grid;
        let place = grid.place(cell);
        let mut neighbours = Vec::new();
        for (axis, along) in grid.axes().iter().enumerate() {
            for at in [place[axis].checked_sub(1), Some(place[axis] + 1)].into_iter().flatten() {
                let mut beside = place;
                beside[axis] = at;
                neighbours.extend((at < along.count()).then(|| grid.cell(&beside)));
            }
        }
        !neighbours.is_empty() && !neighbours.iter().any(|cell| self.cells[*cell].feasible)
    }

    /// The cell under which the block stands most often, of equal ones that with the least max |u|: what comes
    /// nearest where nothing is feasible.
    pub fn nearest(&self) -> Option<usize> {
        (0..self.cells.len()).min_by(|a, b| {
            let (a, b) = (&self.cells[*a], &self.cells[*b]);
            b.standing.total_cmp(&a.standing).then(a.max_u[2].total_cmp(&b.max_u[2]))
        })
    }

    /// The motion with the largest of some values in a cell, among those under which the block stands.
    pub fn governing(&self, cell: usize, values: Values) -> Option<&str> {
        let standing = self.sweep.standing(cell);
        let largest = standing.max_by(|a, b| values(a)[cell].total_cmp(&values(b)[cell]));
        largest.map(|motion| motion.id.as_str())
    }

    /// The motions by the share of the grid's cells that they overturn, the worst first.
    pub fn worst(&self) -> Vec<(&str, f64)> {
        let share = |outcomes: &[Class]| {
            let overturned = outcomes.iter().filter(|class| class.overturned()).count();
            overturned as f64 / outcomes.len().max(1) as f64
        };
        let mut worst: Vec<(&str, f64)> = self
            .sweep
            .motions
            .iter()
            .map(|motion| (motion.id.as_str(), share(&motion.outcomes)))
            .collect();
        worst.sort_by(|a, b| b.1.total_cmp(&a.1));
        worst
    }
}

/// A cell under all motions.
fn reduced(sweep: &SuiteSweep, cell: usize, limits: Limits) -> CellEnvelope {
    let all: f64 = sweep.motions.iter().map(|motion| motion.weight).sum();
    let share = |holds: fn(Class) -> bool| {
        let those = sweep.motions.iter().filter(|motion| holds(motion.outcomes[cell]));
        // A sum of nothing is a negative zero.
        those.fold(0.0, |sum, motion| sum + motion.weight) / all
    };
    let of = |values: Values| {
        let weighted = |motion: &SweptMotion| (f64::from(values(motion)[cell]), motion.weight);
        quantile::weighted(sweep.standing(cell).map(weighted).collect(), SHARES)
    };
    let standing = share(Class::stands);
    let max_u = of(|motion| &motion.max_u);
    let stroke_v = of(|motion| &motion.stroke_v);
    let within = |limit: Option<f64>, value: f64| limit.is_none_or(|limit| value <= limit);
    // A sum of weights may be off by its last digits.
    let enough = standing >= limits.standing - 1.0e-9 && standing > 0.0;
    CellEnvelope {
        standing,
        overturned: share(Class::overturned),
        rocked: share(|class| class == Class::Rocking),
        max_u,
        stroke_v,
        zeta: of(|motion| &motion.zeta),
        feasible: enough && within(limits.u, max_u[2]) && within(limits.v, stroke_v[2]),
    }
}

/// The columns of envelope.csv after the axes.
pub const COLUMNS: [TableColumn; 11] = [
    number("records", "1", "motions"),
    number("standing", "1", "share of the motions under which the block stands"),
    number("overturned", "1", "share of the motions under which it overturns"),
    number("rocked", "1", "share of the motions under which it rocks and stands"),
    number("max_u_50", "m", "median of max |u| over the motions under which it stands"),
    number("max_u_84", "m", "84th percentile of max |u| over the motions under which it stands"),
    number("max_u_100", "m", "largest max |u| over the motions under which it stands"),
    number("stroke_v_50", "m", "median of the stroke of v over the motions under which it stands"),
    number(
        "stroke_v_84",
        "m",
        "84th percentile of the stroke of v over the motions under which it stands",
    ),
    number("stroke_v_100", "m", "largest stroke of v over the motions under which it stands"),
    number("feasible", "1", "1 where all limits are kept"),
];

/// Those of zeta.csv.
pub const ZETA_COLUMNS: [TableColumn; 3] = [
    number("zeta_50", "1", "median of the rocking index over the motions under which it stands"),
    number(
        "zeta_84",
        "1",
        "84th percentile of the rocking index over the motions under which it stands",
    ),
    number("zeta_100", "1", "largest rocking index over the motions under which it stands"),
];

/// Writes envelope.csv: the axes, and what there is of each cell.
///
/// # Errors
/// Those of the writer.
pub fn write(envelope: &Envelope, writer: impl Write) -> io::Result<()> {
    let grid = &envelope.sweep.grid;
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(columns::keys(grid).chain(columns::names(&COLUMNS)))?;
    let records = envelope.sweep.motions.len();
    let known = |value: f64| (!value.is_nan()).then_some(Number(value));
    for (index, cell) in envelope.cells.iter().enumerate() {
        let axes = columns::values(grid, index);
        let shares = [cell.standing, cell.overturned, cell.rocked].map(Number);
        let (u, v) = (cell.max_u.map(known), cell.stroke_v.map(known));
        table.serialize((axes, records, shares, u, v, u8::from(cell.feasible)))?;
    }
    table.flush()
}

/// Writes zeta.csv: the axes, and percentiles of the rocking index over the motions under which the block stands.
///
/// # Errors
/// Those of the writer.
pub fn write_zeta(envelope: &Envelope, writer: impl Write) -> io::Result<()> {
    let grid = &envelope.sweep.grid;
    let mut table = csv::Writer::from_writer(writer);
    table.write_record(columns::keys(grid).chain(columns::names(&ZETA_COLUMNS)))?;
    for (index, cell) in envelope.cells.iter().enumerate() {
        let axes = columns::values(grid, index);
        table
            .serialize((axes, cell.zeta.map(|value| (!value.is_nan()).then_some(Number(value)))))?;
    }
    table.flush()
}
