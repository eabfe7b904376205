//! Where the plot of a map lies in a picture.

use super::super::Map;
use crate::drawing::canvas::{Canvas, Place};
use crate::drawing::frame::{Axis, Frame, LEFT};
use crate::drawing::print::Print;
use crate::drawing::{COLUMN, MARGIN, caption};
use topple::scene::Grid;

/// Room right of a plot, for the end of a number below it.
const RIGHT: f64 = 8.0;
/// From the caption to the plot.
pub const GAP: f64 = 5.0;

/// Left end of a picture's plots, and their width.
pub fn side(canvas: &Canvas) -> (f64, f64) {
    (MARGIN + LEFT, canvas.inner() - LEFT - RIGHT)
}

/// A title with what a map is a slice at.
pub fn titled(title: &str, at: &str) -> String {
    match at {
        "" => title.into(),
        at => format!("{title}: {at}"),
    }
}

/// A picture with a title, and the place of its plot, a square.
pub fn begin(map: &Map, title: &str, print: Print) -> (Canvas, Place) {
    let mut canvas = print.canvas(COLUMN);
    let y = caption::heading(&mut canvas, map.scene, title) + GAP;
    let (x, width) = side(&canvas);
    (canvas, Place { x, y, width, height: width })
}

/// The frame of a plot over a grid.
pub fn frame(place: Place, grid: &Grid) -> Frame {
    Frame::new(place, Axis::of(Some(grid.x())), Axis::of(grid.y()))
}
