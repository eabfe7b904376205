//! Places, and how lines are drawn.

use crate::colours::Colour;

/// A place in a picture, points from its upper left corner.
pub type Point = (f64, f64);

/// A rectangle of the picture, points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Left edge.
    pub x: f64,
    /// Upper edge.
    pub y: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

impl Place {
    /// Its right edge.
    pub fn right(&self) -> f64 {
        self.x + self.width
    }

    /// Its lower edge.
    pub fn bottom(&self) -> f64 {
        self.y + self.height
    }
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub colour: Colour,
    /// Its width, points.
    pub width: f64,
    /// Lengths of dashes and of the gaps between; none of a whole line.
    pub dash: Option<(f64, f64)>,
}

/// A whole line.
pub const fn stroke(colour: Colour, width: f64) -> Stroke {
    Stroke { colour, width, dash: None }
}

/// A dashed line.
pub const fn dashed(colour: Colour, width: f64, dash: (f64, f64)) -> Stroke {
    Stroke { colour, width, dash: Some(dash) }
}

/// The points of a spring from one to another, which bends so often to either side by so much.
pub fn spring(from: Point, to: Point, bends: u32, by: f64) -> impl Iterator<Item = Point> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let length = dx.hypot(dy).max(f64::MIN_POSITIVE);
    (0..=bends).map(move |k| {
        let share = f64::from(k) / f64::from(bends);
        let side = match k {
            k if k == 0 || k == bends => 0.0,
            k if k % 2 == 0 => by,
            _ => -by,
        };
        (from.0 + dx * share - side * dy / length, from.1 + dy * share + side * dx / length)
    })
}
