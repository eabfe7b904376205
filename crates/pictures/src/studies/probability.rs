//! The picture of probabilities: of overturning over two axes in colours, along one axis as a curve.

use crate::colours::palette::CURVES;
use crate::colours::ramp;
use crate::colours::{Colour, WHITE};
use crate::drawing::canvas::{Canvas, Place, Point, stroke};
use crate::drawing::error::FigureError;
use crate::drawing::frame::{Axis, BELOW, BOTH, Frame};
use crate::drawing::legend::{self, entry};
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;
use crate::drawing::raster::png;
use crate::drawing::swatch::Swatch;
use crate::drawing::{COLUMN, MARGIN, caption, scale};
use crate::map::figure::layout::{GAP, frame, side};
use topple::scene::Scene;
use topple::scene::words;
use topple_studies::uncertain::Varied;
use topple_studies::uncertain::probability::{Probabilities, Uncertainty};

/// Height of a curve's plot.
const HEIGHT: f64 = 110.0;
/// What the colours and the curve are.
const NAME: &str = "probability of overturning";

/// What is known of a scene, and what is not.
fn said(scene: &Scene, uncertainty: &Uncertainty) -> Vec<String> {
    let mut parts = words::parameters(&Varied::fixed(scene, &uncertainty.vary));
    let varied = |varied: &Varied| {
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

/// Draws probabilities; none where there are not one or two axes of several values.
pub fn draw(
    all: &Probabilities,
    uncertainty: &Uncertainty,
    print: Print,
) -> Result<Option<Picture>, FigureError> {
    let mut canvas = print.canvas(COLUMN);
    let most = canvas.inner();
    let title = format!("{}: {NAME}", print.title.unwrap_or(&all.scene.title));
    let y = caption::titled(&mut canvas, &title, &said(&all.scene, uncertainty)) + GAP;
    let (x, side) = side(&canvas);
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
    let palette = canvas.palette();
    let opaque = |colour: Colour| {
        let [r, g, b] = palette.of(colour);
        [r, g, b, 255]
    };
    let (columns, rows) = all.grid.shape();
    let image = png((columns, rows), |column, row| {
        opaque(ramp::probability(all.overturns((rows - 1 - row) * columns + column)))
    })?;
    canvas.image(place, &image, true);
    frame(place, &all.grid).draw(canvas, BOTH);
    let at = (place.x, place.bottom() + BELOW + MARGIN);
    scale::draw(canvas, at, place.width, Axis::new(0.0, 1.0, NAME), ramp::probability)
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
