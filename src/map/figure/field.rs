//! Maps of a value in greys with contour levels, in the manner of the paper's Figs. 4 and 6.

use plotters::prelude::*;

use super::super::Map;
use super::super::boundaries::{Boundary, levels};
use super::document::{FINE, Place, compose};
use super::fields::Field;
use super::frame::{Drawn, PLOT, Plot, SIZE, area, map_frame, stroke, titled};
use super::greys::{FALLEN, Greys, keys};
use super::labels::Labels;
use super::overturning::hatched;
use super::raster::png;
use super::{FigureError, tick};
use crate::stepping::outcome::{Class, Outcome};

/// Draws a field as SVG; `at` tells what the map is a slice at.
///
/// # Errors
/// Any [`FigureError`].
pub fn draw(map: &Map, field: &Field, at: &str) -> Result<String, FigureError> {
    let greys = Greys::over([map], field);
    let mut images = vec![(PLOT, cells(map, field, &greys)?), (BAR, greys.bar()?)];
    let hatch = hatched(map, PLOT)?;
    let has_hatch = map.has_beyond_the_model();
    images.extend(hatch.map(|image| (PLOT, image)));
    let mut drawing = String::new();
    frame((map, at), field, &greys, has_hatch, &mut drawing)
        .map_err(|e| FigureError::Draw(e.to_string()))?;
    Ok(compose(SIZE, &images, &drawing))
}

/// The cells of a map in the greys of their values, as an image.
///
/// # Errors
/// [`FigureError::Encode`].
pub fn cells(map: &Map, field: &Field, greys: &Greys) -> Result<Vec<u8>, FigureError> {
    let (columns, rows) = map.grid.shape();
    png(columns, rows, |column, row| {
        let cell = &map.outcomes[(rows - 1 - row) * columns + column];
        let grey = match cell.class {
            Class::Unresolved => 255,
            _ if field.counts(cell) => greys.shade((field.value)(cell)),
            _ => FALLEN,
        };
        [grey, grey, grey, 255]
    })
}

/// Place of the scale of greys.
const BAR: Place = Place { x: 730, y: 110, width: 22, height: 300 };

fn frame(
    (map, at): (&Map, &str),
    field: &Field,
    greys: &Greys,
    hatched: bool,
    drawing: &mut String,
) -> Drawn<()> {
    let root = area(drawing, SIZE);
    let title = titled(&format!("{}: {}", map.scene.title, field.title), at);
    let mut plot = map_frame(&root, map, &title)?;
    let named = lines(&mut plot, map, field, greys, 26)?;
    let mut labels = Labels::new(map, field);
    for (text, line) in &named {
        labels.draw(&mut plot, line, text)?;
    }
    greys.draw(&root, BAR, field.label, 16)?;
    keys(&root, &[map], field, hatched, (BAR.x, BAR.y + BAR.height + 34), 14)?;
    root.present()?;
    Ok(())
}

/// Points of a line below which it goes around a speck: where the motion is chaotic cells differ
/// from their neighbours, and thick lines around each would hide them.
const SPECK: usize = 16;

/// A level's value and the longest of its lines.
pub type Level = (String, Vec<(f64, f64)>);

/// Draws the levels of a value, and thick lines around overturning, dashed around full contact;
/// returns the levels, to be labelled. `thick` is in tenths of the document's units.
pub fn lines(
    plot: &mut Plot,
    map: &Map,
    field: &Field,
    greys: &Greys,
    thick: i32,
) -> Drawn<Vec<Level>> {
    let value = |cell: &Outcome| {
        (field.counts(cell) && !cell.class.overturned()).then(|| (field.value)(cell))
    };
    let thin = stroke(RGBColor(40, 40, 40), 6);
    let values = greys.levels();
    let mut named = Vec::new();
    for (level, lines) in values.iter().zip(levels(map, value, &values)) {
        for line in lines.iter().filter(|line| line.len() >= SPECK) {
            plot.draw_series(LineSeries::new(line.iter().copied(), thin))?;
        }
        if let Some(longest) = lines.into_iter().max_by_key(|line| line.len()) {
            named.push((tick(*level, greys.width()), longest));
        }
    }
    let around = stroke(BLACK, thick);
    for line in Boundary::Overturning.lines(map) {
        let style = if line.len() < SPECK { thin } else { around };
        plot.draw_series(LineSeries::new(line, style))?;
    }
    for line in Boundary::FullContact.lines(map) {
        let (dash, gap) = (9 * FINE * thick / 26, 6 * FINE * thick / 26);
        plot.draw_series(DashedLineSeries::new(line, dash as u32, gap as u32, around))?;
    }
    Ok(named)
}
