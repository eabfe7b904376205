//! Values of cells in greys, with their scale.

use crate::drawing::canvas::{Canvas, Point};
use crate::drawing::error::FigureError;
use crate::drawing::frame::{Axis, Frame};
use crate::drawing::raster::png;
use crate::drawing::scale;
use topple::scene::Grid;

/// Greys of the largest and of the least value.
const MOST: f64 = 70.0;
const LEAST: f64 = 235.0;

/// Greys between two values.
#[derive(Debug, Clone, Copy)]
pub struct Shades {
    from: f64,
    to: f64,
}

impl Shades {
    /// Those of the values that are known.
    pub fn over(values: &[Option<f64>]) -> Shades {
        let known = values.iter().flatten();
        let (from, to) = known
            .fold((f64::MAX, f64::MIN), |(low, high), value| (low.min(*value), high.max(*value)));
        match to > from {
            true => Shades { from, to },
            // One value has no scale to lie on.
            false if to >= 0.0 => Shades { from: 0.0, to: if to > 0.0 { 2.0 * to } else { 1.0 } },
            false => Shades { from: 0.0, to: 1.0 },
        }
    }

    fn grey(&self, value: f64) -> u8 {
        let share = ((value - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
        (LEAST + (MOST - LEAST) * share) as u8
    }

    /// Draws the scale; where it ends below.
    pub fn draw(
        &self,
        canvas: &mut Canvas,
        at: Point,
        width: f64,
        label: &str,
    ) -> Result<f64, FigureError> {
        let axis = Axis::new(self.from, self.to, label);
        let grey = |share| [self.grey(self.from + (self.to - self.from) * share); 3];
        scale::draw(canvas, at, width, axis, grey)
    }
}

/// Draws the cells of a grid of two axes; those of no value are white.
pub fn paint(
    canvas: &mut Canvas,
    grid: &Grid,
    values: &[Option<f64>],
    shades: &Shades,
    frame: &Frame,
) -> Result<(), FigureError> {
    let (columns, rows) = grid.shape();
    let image = png((columns, rows), |column, row| {
        let grey = values[(rows - 1 - row) * columns + column].map_or(255, |v| shades.grey(v));
        [grey, grey, grey, 255]
    })?;
    canvas.image(frame.place, &image, true);
    Ok(())
}
