//! What a path through a map meets: impact counts, and outcomes as a strip.

use std::collections::BTreeSet;

use plotters::prelude::*;

use crate::map::Map;
use crate::map::figure::FigureError;
use crate::map::figure::document::{FINE, Place};
use crate::map::figure::frame::{Axes, Named, at, document, frame, frame_with, outline, text};
use crate::map::figure::palette::{Kind, Parity};
use crate::map::figure::raster::png;
use crate::scene::Values;

/// Size of the axes' numbers.
const FONT: i32 = 12;
/// Size of a path's figure.
const PATH: (u32, u32) = (960, 420);
/// Places of its plot and of the strip of outcomes below.
const IMPACTS: Place = Place { x: 84, y: 66, width: 610, height: 230 };
const STRIP: Place = Place { x: 84, y: 316, width: 610, height: 26 };

/// Draws what a path meets: impact counts above, outcomes as a strip below. The map is one
/// column wide.
///
/// # Errors
/// Any [`FigureError`].
pub fn draw(title: &str, map: &Map, caption: &str) -> Result<String, FigureError> {
    let rows = map.grid.y().map_or_else(|| Values::from(0.0), |axis| axis.values.clone());
    // The strip lies: a row of the map is a column of it.
    let strip = png(map.outcomes.len(), 1, |column, _| {
        let [r, g, b] = Kind::of(&map.outcomes[column]).colour();
        [r, g, b, 255]
    })?;
    let kinds: BTreeSet<Kind> = map.outcomes.iter().map(Kind::of).collect();
    let fallen = || map.outcomes.iter().enumerate().filter(|(_, cell)| cell.class.overturned());
    let most = fallen().map(|(_, cell)| cell.impacts).max().unwrap_or(1).max(10);
    document(PATH, &[(STRIP, strip)], |root| {
        root.draw(&Text::new(title.to_string(), at(IMPACTS.x, 14), text(18)))?;
        root.draw(&Text::new(caption.to_string(), at(IMPACTS.x, 40), text(FONT)))?;
        let x = Named { ends: rows.first()..rows.last(), name: "A_h [m/s²]".into() };
        let y = Named {
            ends: -0.05..f64::from(most).log10() + 0.1,
            name: "impacts before overturning".into(),
        };
        let set =
            Axes { size: PATH, plot: IMPACTS, room: (Some(IMPACTS.x - 16), None), font: FONT };
        let mut plot = frame_with(root, &set, (&x, &y), &decade)?;
        let dots = fallen().filter(|(_, cell)| cell.impacts > 0).map(|(row, cell)| {
            let [r, g, b] = Parity::of(cell).colour();
            let place = (rows.value(row), f64::from(cell.impacts).log10());
            Circle::new(place, 3 * FINE / 2, RGBColor(r, g, b).filled())
        });
        plot.draw_series(dots)?;
        let none = Named { ends: 0.0..1.0, name: String::new() };
        let set = Axes { size: PATH, plot: STRIP, room: (None, Some(44)), font: FONT };
        frame(root, &set, (&x, &none))?;
        let left = IMPACTS.x + IMPACTS.width + 22;
        let mut top = IMPACTS.y;
        for parity in [Parity::Odd, Parity::Even, Parity::Rested] {
            if !fallen().any(|(_, cell)| cell.impacts > 0 && Parity::of(cell) == parity) {
                continue;
            }
            let [r, g, b] = parity.colour();
            root.draw(&Circle::new(at(left + 11, top + 7), 3 * FINE, RGBColor(r, g, b).filled()))?;
            root.draw(&Text::new(parity.label(), at(left + 30, top), text(13)))?;
            top += 20;
        }
        top += 8;
        for kind in &kinds {
            let [r, g, b] = kind.colour();
            let swatch = [at(left, top), at(left + 22, top + 13)];
            root.draw(&Rectangle::new(swatch, RGBColor(r, g, b).filled()))?;
            outline(root, Place { x: left, y: top, width: 22, height: 13 }, 10)?;
            root.draw(&Text::new(kind.label(), at(left + 30, top), text(13)))?;
            top += 20;
        }
        Ok(())
    })
}

/// A whole power of ten by its exponent; nothing between.
fn decade(exponent: f64) -> String {
    if (exponent - exponent.round()).abs() > 1.0e-6 {
        return String::new();
    }
    format!("{}", 10.0_f64.powf(exponent.round()))
}
