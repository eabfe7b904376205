//! The overturning map, in the manner of the paper's Fig. 11.

use std::collections::BTreeSet;

use plotters::prelude::*;

use super::super::Map;
use super::FigureError;
use super::document::{Place, compose};
use super::frame::{
    Area, Drawn, PLOT, SIZE, area, at, map_frame, outline, stroke, text, text_left_of, titled,
};
use super::palette::Kind;
use super::raster::png;
use crate::scene::Parameter;
use crate::stepping::outcome::{Class, Outcome};

/// What a hatch says.
pub fn hatch_labels(map: &Map) -> [String; 2] {
    let why = match map.scene.numbers.get(Parameter::Friction) {
        None => "contact force tensile:".to_string(),
        Some(mu) if mu.count() == 1 => format!("tensile, or friction > {mu}:"),
        Some(_) => "tensile, or friction > μ:".to_string(),
    };
    [why, "the model does not hold".to_string()]
}

/// Pixels of the hatch's image for each of the document's.
const HATCH_SCALE: usize = 2;
/// Distance of the hatch's lines, in its pixels.
const HATCH_PITCH: usize = 12;

/// Draws the map as SVG; `at` tells what it is a slice at.
///
/// # Errors
/// Any [`FigureError`].
pub fn draw(map: &Map, at: &str) -> Result<String, FigureError> {
    let mut images = vec![(PLOT, cells(map, |cell| Kind::of(cell).colour())?)];
    let hatch = hatched(map, PLOT)?;
    let has_hatch = map.has_beyond_the_model();
    images.extend(hatch.map(|image| (PLOT, image)));
    let kinds: BTreeSet<Kind> = map.outcomes.iter().map(Kind::of).collect();
    let mut drawing = String::new();
    frame(map, at, &kinds, has_hatch, &mut drawing)
        .map_err(|e| FigureError::Draw(e.to_string()))?;
    Ok(compose(SIZE, &images, &drawing))
}

/// The cells of a map in the colours of their outcomes, as an image.
///
/// # Errors
/// [`FigureError::Encode`].
pub fn cells(map: &Map, colour: impl Fn(&Outcome) -> [u8; 3]) -> Result<Vec<u8>, FigureError> {
    let (columns, rows) = map.grid.shape();
    png(columns, rows, |column, row| {
        let [r, g, b] = colour(&map.outcomes[(rows - 1 - row) * columns + column]);
        [r, g, b, 255]
    })
}

/// Lines over the cells where the model does not hold, crosses over the unresolved ones, as an
/// image for `place`; none where there are no such cells.
///
/// # Errors
/// [`FigureError::Encode`].
pub fn hatched(map: &Map, place: Place) -> Result<Option<Vec<u8>>, FigureError> {
    let unresolved = map.outcomes.iter().any(|cell| cell.class == Class::Unresolved);
    if !unresolved && !map.has_beyond_the_model() {
        return Ok(None);
    }
    let (columns, rows) = map.grid.shape();
    let (width, height) = (place.width as usize * HATCH_SCALE, place.height as usize * HATCH_SCALE);
    let image = png(width, height, |x, y| {
        let cell = (rows - 1 - y * rows / height) * columns + x * columns / width;
        let unresolved = map.outcomes[cell].class == Class::Unresolved;
        let rising = (x + y) % HATCH_PITCH < 2;
        let falling = (x + height - y) % HATCH_PITCH < 2;
        match (unresolved, map.beyond_the_model(cell)) {
            (true, _) if rising || falling => [0, 0, 0, 255],
            (false, true) if rising => [0, 0, 0, 150],
            _ => [0, 0, 0, 0],
        }
    })?;
    Ok(Some(image))
}

fn frame(
    map: &Map,
    place: &str,
    kinds: &BTreeSet<Kind>,
    hatched: bool,
    drawing: &mut String,
) -> Drawn<()> {
    let root = area(drawing, SIZE);
    map_frame(&root, map, &titled(&map.scene.title, place))?;
    legend(&root, kinds, hatched, map)?;
    root.present()?;
    Ok(())
}

fn legend(root: &Area, kinds: &BTreeSet<Kind>, hatched: bool, map: &Map) -> Drawn<()> {
    let left = PLOT.x + PLOT.width + 22;
    let mut top = PLOT.y + 4;
    let total = map.outcomes.len() as f64;
    let line = stroke(BLACK, 10);
    for &kind in kinds {
        let [r, g, b] = kind.colour();
        let swatch = [at(left, top), at(left + 24, top + 16)];
        root.draw(&Rectangle::new(swatch, RGBColor(r, g, b).filled()))?;
        if kind == Kind::Unresolved {
            root.draw(&PathElement::new(swatch.to_vec(), line))?;
            root.draw(&PathElement::new(vec![at(left, top + 16), at(left + 24, top)], line))?;
        }
        outline(root, Place { x: left, y: top, width: 24, height: 16 }, 10)?;
        let count = map.outcomes.iter().filter(|outcome| Kind::of(outcome) == kind).count();
        root.draw(&Text::new(kind.label(), at(left + 32, top + 1), text(15)))?;
        let share = share(count as f64 / total);
        root.draw(&Text::new(share, at(SIZE.0 as i32 - 10, top + 2), text_left_of(13)))?;
        top += 25;
    }
    if hatched {
        for offset in [-8, 0, 8, 16] {
            let (x0, x1) = ((left + offset).max(left), (left + offset + 16).min(left + 24));
            let (y0, y1) = (top + 16 - (x0 - left - offset), top + 16 - (x1 - left - offset));
            root.draw(&PathElement::new(vec![at(x0, y0), at(x1, y1)], line))?;
        }
        outline(root, Place { x: left, y: top, width: 24, height: 16 }, 10)?;
        for (row, label) in hatch_labels(map).into_iter().enumerate() {
            root.draw(&Text::new(label, at(left + 32, top + 1 + 18 * row as i32), text(15)))?;
        }
    }
    Ok(())
}

/// A share of the map in percent.
fn share(share: f64) -> String {
    let percent = 100.0 * share;
    if percent < 0.1 {
        return "< 0.1 %".into();
    }
    format!("{percent:.1} %")
}
