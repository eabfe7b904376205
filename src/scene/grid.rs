//! The grid of parameters that a scene sweeps.

use super::range::Range;
use super::{Excitation, Scene};

/// A swept parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// Name of the column and array: `omega`.
    pub key: &'static str,
    /// Symbol on figures.
    pub symbol: &'static str,
    /// Unit on figures.
    pub unit: &'static str,
    /// The values.
    pub range: Range,
}

/// A rectangle of cells; cells are numbered row by row, x fastest, y upwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    fixed: Point,
    sweeps: Sweeps,
}

/// What the axes of a grid are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sweeps {
    /// Omega and A_h.
    Pulse,
    /// T_h and T_v.
    Periods,
}

/// The parameters of one cell, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// T_h, s; of no meaning where the direction is locked.
    pub t_h: f64,
    /// T_v, s; of no meaning where the direction is locked.
    pub t_v: f64,
    /// Omega, rad/s; of no meaning for a record.
    pub omega: f64,
    /// A_h, m/s^2; a record's PGA_h, for (21) asks for it.
    pub a_h: f64,
    /// A_v, m/s^2; a record's PGA_v.
    pub a_v: f64,
}

impl Grid {
    /// The grid of a scene: (Omega, A_h) for a pulse, (T_h, T_v) for a record.
    pub fn of(scene: &Scene) -> Grid {
        // A locked direction has no period: one value stands for it, which nothing reads.
        let one = Range::single(1.0);
        let t_h = scene.isolation.horizontal.map_or(one, |base| base.t_h);
        let t_v = scene.isolation.vertical.map_or(one, |base| base.t_v);
        let fixed = Point { t_h: t_h.start, t_v: t_v.start, omega: 1.0, a_h: 0.0, a_v: 0.0 };
        match &scene.excitation {
            Excitation::Pulse(pulse) => Grid {
                x: Axis { key: "omega", symbol: "Ω", unit: "rad/s", range: pulse.omega },
                y: Axis { key: "a_h", symbol: "A_h", unit: "m/s²", range: pulse.a_h },
                fixed: Point { a_v: pulse.a_v, ..fixed },
                sweeps: Sweeps::Pulse,
            },
            Excitation::Record(pair) => Grid {
                x: Axis { key: "t_h", symbol: "T_h", unit: "s", range: t_h },
                y: Axis { key: "t_v", symbol: "T_v", unit: "s", range: t_v },
                fixed: Point { a_h: pair.pga_h, a_v: pair.pga_v, ..fixed },
                sweeps: Sweeps::Periods,
            },
        }
    }

    /// Columns and rows.
    pub fn shape(&self) -> (usize, usize) {
        (self.x.range.count as usize, self.y.range.count as usize)
    }

    /// The point that takes the most steps: every period at its shortest, the pulse at its fastest.
    pub fn extreme(&self) -> Point {
        let (x, y) = (&self.x.range, &self.y.range);
        match self.sweeps {
            Sweeps::Pulse => Point { omega: x.start.max(x.stop), ..self.point(0) },
            Sweeps::Periods => Point { t_h: x.least(), t_v: y.least(), ..self.fixed },
        }
    }

    /// Number of cells. At most 2^40, which fits on every machine with 64-bit addresses; smaller
    /// ones saturate.
    pub fn len(&self) -> usize {
        let (columns, rows) = self.shape();
        columns.saturating_mul(rows)
    }

    /// False: an axis has one value at least.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Values of both axes at a cell.
    pub fn coordinates(&self, cell: usize) -> (f64, f64) {
        let columns = self.x.range.count as usize;
        // Both quotients are below an axis's count, a u32.
        let (column, row) = ((cell % columns) as u32, (cell / columns) as u32);
        (self.x.range.value(column), self.y.range.value(row))
    }

    /// Parameters of a cell.
    pub fn point(&self, cell: usize) -> Point {
        let (x, y) = self.coordinates(cell);
        match self.sweeps {
            Sweeps::Pulse => Point { omega: x, a_h: y, ..self.fixed },
            Sweeps::Periods => Point { t_h: x, t_v: y, ..self.fixed },
        }
    }
}
