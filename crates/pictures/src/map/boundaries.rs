//! Lines of a map: around overturning, around full contact, and levels of a value.

use std::io::Write;

use contour::ContourBuilder;

use super::Map;
use topple::results::csv::Number;
use topple::scene::Grid;
use topple::stepping::outcome::{Class, Outcome};

/// A line in the axes' coordinates, see [`Values::coordinate`](topple::scene::Values::coordinate).
pub type Line = Vec<(f64, f64)>;

/// A boundary between outcomes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Boundary {
    /// Around the cells that overturn.
    Overturning,
    /// Around the cells that stay in full contact.
    FullContact,
}

impl Boundary {
    /// Name in boundaries.csv.
    pub fn name(self) -> &'static str {
        match self {
            Boundary::Overturning => "overturning",
            Boundary::FullContact => "full_contact",
        }
    }

    fn holds(self, outcome: &Outcome) -> bool {
        match self {
            Boundary::Overturning => outcome.class.overturned(),
            Boundary::FullContact => outcome.class == Class::FullContact,
        }
    }

    /// Its lines, halfway between cells on either side.
    pub fn lines(self, map: &Map) -> Vec<Line> {
        let inside = |outcome: &Outcome| Some(if self.holds(outcome) { 1.0 } else { 0.0 });
        levels(map, inside, &[0.5]).pop().unwrap_or_default()
    }
}

/// For each level the lines on which a value has it.
pub fn levels(
    map: &Map,
    value: impl Fn(&Outcome) -> Option<f64>,
    levels: &[f64],
) -> Vec<Vec<Line>> {
    let known: Vec<Option<f64>> = map.outcomes.iter().map(value).collect();
    contours(&map.grid, &known, levels)
}

/// For each level the lines on which the values of a grid's cells have it, linear between cells. They end beside
/// cells that have no value. A grid of a single row or column has none.
pub fn contours(grid: &Grid, known: &[Option<f64>], levels: &[f64]) -> Vec<Vec<Line>> {
    let (columns, rows) = grid.shape();
    let (Some(y), x) = (grid.y(), grid.x()) else {
        return vec![Vec::new(); levels.len()];
    };
    if columns < 2 || rows < 2 {
        return vec![Vec::new(); levels.len()];
    }
    let values: Vec<f64> = known.iter().map(|value| value.unwrap_or(f64::MAX)).collect();
    let Ok(found) = ContourBuilder::new(columns, rows, true).lines(&values, levels) else {
        return vec![Vec::new(); levels.len()];
    };
    // The library puts a cell's value half a cell beyond its number, and closes rings around the
    // grid's edge; those stretches, and those beside unknown cells, are no part of a level.
    let apart = |x: f64, y: f64| {
        let ends = |place: f64, count: usize| {
            // A line beside an unknown cell lies on the known one's centre: look beyond it.
            let cell = place - 0.5;
            let low = (cell - 1.0e-6).max(0.0).floor() as usize;
            (low, ((cell + 1.0e-6).max(0.0).ceil() as usize).min(count - 1))
        };
        let ((i0, i1), (j0, j1)) = (ends(x, columns), ends(y, rows));
        let outside = x < 0.5 || y < 0.5 || x > columns as f64 - 0.5 || y > rows as f64 - 0.5;
        outside
            || [j0, j1].iter().any(|j| [i0, i1].iter().any(|i| known[j * columns + i].is_none()))
    };
    found
        .iter()
        .map(|level| {
            let mut lines = Vec::new();
            for ring in &level.geometry().0 {
                let mut line = Line::new();
                for place in &ring.0 {
                    if apart(place.x, place.y) {
                        if line.len() > 1 {
                            lines.push(std::mem::take(&mut line));
                        }
                        line.clear();
                    } else {
                        line.push((
                            x.values.coordinate(place.x - 0.5),
                            y.values.coordinate(place.y - 0.5),
                        ));
                    }
                }
                if line.len() > 1 {
                    lines.push(line);
                }
            }
            lines
        })
        .collect()
}

/// Writes boundaries.csv: one row per point, `boundary,line` and the two axes.
pub fn write(map: &Map, writer: impl Write) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(writer);
    let Some(y_axis) = map.grid.y() else { return Ok(()) };
    let x_axis = map.grid.x();
    table.write_record(["boundary", "line", x_axis.key(), y_axis.key()])?;
    for boundary in [Boundary::Overturning, Boundary::FullContact] {
        for (index, line) in boundary.lines(map).iter().enumerate() {
            for (x, y) in line {
                let (x, y) = (x_axis.values.value_at(*x), y_axis.values.value_at(*y));
                table.serialize((boundary.name(), index, Number(x), Number(y)))?;
            }
        }
    }
    table.flush()?;
    Ok(())
}
