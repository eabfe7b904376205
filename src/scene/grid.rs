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
    t_h: f64,
    t_v: f64,
    pulse: super::Pulse,
}

/// The parameters of one cell, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// T_h, s; of no meaning where the direction is locked.
    pub t_h: f64,
    /// T_v, s; of no meaning where the direction is locked.
    pub t_v: f64,
    /// Omega, rad/s.
    pub omega: f64,
    /// A_h, m/s^2.
    pub a_h: f64,
    /// A_v, m/s^2.
    pub a_v: f64,
}

impl Grid {
    /// The grid of a scene: (Omega, A_h) for a pulse.
    pub fn of(scene: &Scene) -> Grid {
        let Excitation::Pulse(pulse) = scene.excitation;
        let x = Axis { key: "omega", symbol: "Ω", unit: "rad/s", range: pulse.omega };
        let y = Axis { key: "a_h", symbol: "A_h", unit: "m/s²", range: pulse.a_h };
        let t_h = scene.isolation.horizontal.map_or(1.0, |base| base.t_h.start);
        let t_v = scene.isolation.vertical.map_or(1.0, |base| base.t_v.start);
        Grid { x, y, t_h, t_v, pulse }
    }

    /// Columns and rows.
    pub fn shape(&self) -> (usize, usize) {
        (self.x.range.count as usize, self.y.range.count as usize)
    }

    /// The point that takes the most steps: every period at its shortest, the pulse at its fastest.
    pub fn extreme(&self) -> Point {
        Point { omega: self.x.range.start.max(self.x.range.stop), ..self.point(0) }
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
        Point { t_h: self.t_h, t_v: self.t_v, omega: x, a_h: y, a_v: self.pulse.a_v }
    }
}
