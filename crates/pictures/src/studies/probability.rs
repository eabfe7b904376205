//! The picture of probabilities: of overturning over two axes in colours, along one axis as a curve.

use crate::drawing::canvas::{Canvas, Place, Point, stroke};
use crate::drawing::error::FigureError;
use crate::drawing::frame::{Axis, BELOW, BOTH, Frame};
use crate::drawing::legend::{self, entry};
use crate::drawing::raster::png;
use crate::drawing::swatch::Swatch;
use crate::drawing::{COLUMN, MARGIN, caption, scale};
use crate::map::figure::layout::{GAP, SIDE, frame};
use topple::results::colour::{Colour, WHITE};
use topple::results::palette::CURVES;
use topple::scene::Scene;
use topple::scene::words;
use topple_studies::uncertain::probability::{Probabilities, Uncertainty};

/// Colours of a probability of 0, 1/2 and 1, the lightness falling evenly between them.
const RAMP: [Colour; 3] = [[0xf4, 0xf1, 0xea], [0xd9, 0x7b, 0x4f], [0x4a, 0x00, 0x1f]];
/// Height of a curve's plot.
const HEIGHT: f64 = 110.0;
/// What the colours and the curve are.
const NAME: &str = "probability of overturning";

/// The colour of a probability.
fn colour(probability: f64) -> Colour {
    let along = 2.0 * probability.clamp(0.0, 1.0);
    let (from, to, share) = match along {
        along if along < 1.0 => (RAMP[0], RAMP[1], along),
        along => (RAMP[1], RAMP[2], along - 1.0),
    };
    let mixed = |k: usize| f64::from(from[k]) + (f64::from(to[k]) - f64::from(from[k])) * share;
    [0, 1, 2].map(|k| mixed(k).round() as u8)
}

/// What is known of a scene, and what is not.
fn said(scene: &Scene, uncertainty: &Uncertainty) -> Vec<String> {
    let mut known = scene.clone();
    for varied in &uncertainty.vary {
        known.numbers.remove(varied.parameter);
    }
    let mut parts = words::parameters(&known);
    let varied = |varied: &topple_studies::uncertain::Varied| {
        let entry = varied.parameter.entry();
        let unit = if entry.unit.is_empty() { String::new() } else { format!(" {}", entry.unit) };
        format!("{}: {}{unit}", entry.symbol, varied.distribution)
    };
    parts.extend(uncertainty.vary.iter().map(varied));
    if uncertainty.pixel {
        parts.push("axes anywhere in the pixel".into());
    }
    parts.push(format!("{} samples", uncertainty.samples));
    parts
}

/// Draws probabilities as SVG; none where there are not one or two axes of several values.
///
/// # Errors
/// [`FigureError::Encode`].
pub fn draw(all: &Probabilities, uncertainty: &Uncertainty) -> Result<Option<String>, FigureError> {
    let most = COLUMN - 2.0 * MARGIN;
    let mut canvas = Canvas::new(COLUMN);
    let title = format!("{}: {NAME}", all.scene.title);
    let y = caption::titled(&mut canvas, &title, &said(&all.scene, uncertainty)) + GAP;
    let (x, side) = SIDE;
    let grid = &all.grid;
    let place = Place { x, y, width: side, height: side };
    let bottom = match grid.line() {
        Some(_) => curve(&mut canvas, all, Place { height: HEIGHT, ..place }),
        None if grid.axes().len() == 2 && grid.len() > 1 => field(&mut canvas, all, place)?,
        None => return Ok(None),
    };
    let unresolved = all.counts.iter().any(|counts| counts[4] > 0);
    let remark = "Samples without an outcome count as standing.";
    let entries: Vec<_> = unresolved.then(|| entry(Swatch::None, remark)).into_iter().collect();
    let end = legend::draw(&mut canvas, &entries, (MARGIN, bottom + GAP), most, 1);
    Ok(Some(canvas.finish(end + MARGIN)))
}

/// Draws cells in colours, and their scale; returns where it ends.
fn field(canvas: &mut Canvas, all: &Probabilities, place: Place) -> Result<f64, FigureError> {
    let opaque = |[r, g, b]: Colour| [r, g, b, 255];
    let (columns, rows) = all.grid.shape();
    let image = png((columns, rows), |column, row| {
        opaque(colour(all.overturns((rows - 1 - row) * columns + column)))
    })?;
    canvas.image(place, &image, true);
    frame(place, &all.grid).draw(canvas, BOTH);
    let at = (place.x, place.bottom() + BELOW + MARGIN);
    scale::draw(canvas, at, place.width, Axis::new(0.0, 1.0, NAME), colour)
}

/// Draws the curve along the only axis; returns where it ends.
fn curve(canvas: &mut Canvas, all: &Probabilities, place: Place) -> f64 {
    let axis = all.grid.line();
    canvas.fill(place, WHITE);
    let frame = Frame::new(place, Axis::of(axis), Axis::new(0.0, 1.0, NAME));
    let along = |cell: usize| axis.map_or(0.0, |axis| axis.values.coordinate(cell as f64));
    let points = (0..all.counts.len()).map(|cell| frame.at((along(cell), all.overturns(cell))));
    let points: Vec<Point> = points.collect();
    canvas.clipped(place, |canvas| canvas.line(points.iter().copied(), stroke(CURVES[0], 0.8)));
    frame.draw(canvas, BOTH);
    place.bottom() + BELOW
}

#[cfg(test)]
mod tests {
    use super::colour;

    /// Luma falls from a probability to a larger one, so that a print in grey has the same order.
    #[test]
    fn a_larger_probability_is_darker() {
        let luma = |probability: f64| {
            let [r, g, b] = colour(probability).map(f64::from);
            0.299 * r + 0.587 * g + 0.114 * b
        };
        for step in 0..64 {
            let (less, more) = (f64::from(step) / 64.0, f64::from(step + 1) / 64.0);
            assert!(luma(less) > luma(more) + 0.5, "{less}: {} {}", luma(less), luma(more));
        }
    }
}
