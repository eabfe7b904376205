//! Values written on the lines of a map.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::super::Map;
use super::super::boundaries::Line;
use super::document::FINE;
use super::fields::Field;
use super::frame::{Drawn, Plot, text};
use crate::scene::Values;

/// Values written on their lines: none on top of another, none near a cell without a value.
pub struct Labels<'a> {
    map: &'a Map<'a>,
    field: &'a Field,
    /// Places taken, as shares of the axes.
    placed: Vec<(f64, f64)>,
}

impl<'a> Labels<'a> {
    /// None placed yet.
    pub fn new(map: &'a Map<'a>, field: &'a Field) -> Labels<'a> {
        Labels { map, field, placed: Vec::new() }
    }

    /// Points that a line has at least to be labelled.
    const SHORTEST: usize = 12;
    /// Distance of two labels, as a share of the axes.
    const APART: (f64, f64) = (0.09, 0.04);
    /// Half of the room of a label, as a share of the axes.
    const ROOM: (f64, f64) = (0.035, 0.015);

    /// Writes a value in the middle of its line, or as near as there is room; a short line has
    /// none.
    pub fn draw(&mut self, plot: &mut Plot, line: &Line, value: &str) -> Drawn<()> {
        if line.len() < Self::SHORTEST {
            return Ok(());
        }
        let middle = line.len() / 2;
        let outwards = (0..middle).flat_map(|k| [line[middle - k], line[middle + k]]);
        let Some(place) = outwards.into_iter().find(|place| self.free(self.share(*place))) else {
            return Ok(());
        };
        self.placed.push(self.share(place));
        let style = text(12).pos(Pos::new(HPos::Center, VPos::Center));
        let half = (4 * value.len() as i32 + 2) * FINE;
        plot.draw_series([EmptyElement::at(place)
            + Rectangle::new([(-half, -7 * FINE), (half, 7 * FINE)], WHITE.mix(0.8).filled())
            + Text::new(value.to_string(), (0, 0), style)])?;
        Ok(())
    }

    fn share(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let of = |values: &Values, at: f64| {
            let (start, stop) =
                (values.coordinate(0.0), values.coordinate((values.count() - 1) as f64));
            (at - start) / (stop - start)
        };
        let grid = &self.map.grid;
        (of(&grid.x().values, x), grid.y().map_or(0.0, |axis| of(&axis.values, y)))
    }

    fn free(&self, (x, y): (f64, f64)) -> bool {
        let apart =
            |(a, b): &(f64, f64)| (x - a).abs() > Self::APART.0 || (y - b).abs() > Self::APART.1;
        if !self.placed.iter().all(apart) {
            return false;
        }
        let (columns, rows) = self.map.grid.shape();
        let cell = |share: f64, count: usize| (share * (count - 1) as f64).round();
        for dx in [-1.0, -0.5, 0.0, 0.5, 1.0] {
            for dy in [-1.0, 0.0, 1.0] {
                let i = cell(x + dx * Self::ROOM.0, columns);
                let j = cell(y + dy * Self::ROOM.1, rows);
                if !(i >= 0.0 && j >= 0.0 && i < columns as f64 && j < rows as f64) {
                    return false;
                }
                let outcome = &self.map.outcomes[j as usize * columns + i as usize];
                if outcome.class.overturned() || !self.field.counts(outcome) {
                    return false;
                }
            }
        }
        true
    }
}
