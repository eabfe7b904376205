//! The scale of a picture's colours.

use super::canvas::{Canvas, Place, Point};
use super::error::FigureError;
use super::frame::{Axis, BELOW, Frame, Written};
use super::raster::png;
use crate::colours::Colour;

/// Height of a scale.
const HEIGHT: f64 = 6.0;
/// Columns of its image.
const COLUMNS: usize = 256;

/// Draws a scale with its numbers and its name below; `colour` is that of a share of its width. Returns where it ends.
pub fn draw(
    canvas: &mut Canvas,
    (x, y): Point,
    width: f64,
    axis: Axis,
    colour: impl Fn(f64) -> Colour,
) -> Result<f64, FigureError> {
    let place = Place { x, y, width, height: HEIGHT };
    let palette = canvas.palette();
    let image = png((COLUMNS, 1), |column, _| {
        let [red, green, blue] = palette.of(colour((column as f64 + 0.5) / COLUMNS as f64));
        [red, green, blue, 255]
    })?;
    canvas.image(place, &image, true);
    let written = Written { y: false, x: true, beyond: 4.0 };
    Frame::new(place, axis, Axis::new(0.0, 1.0, "")).draw(canvas, written);
    Ok(place.bottom() + BELOW)
}
