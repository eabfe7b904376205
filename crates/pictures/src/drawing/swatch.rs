//! What stands beside a word in a legend: a colour, a hatch, a line, a mark.

use super::canvas::{Canvas, Place, Point, Stroke, stroke};
use crate::colours::palette::dots;
use crate::colours::print_palette::Texture;
use crate::colours::{BLACK, Colour, WHITE};

/// Size of a swatch, points.
pub const SIZE: (f64, f64) = (13.0, 7.0);
/// Distance of the lines of a hatch, points, measured along the axes.
pub const PITCH: f64 = 4.5;
/// Width of these lines.
pub const WIDTH: f64 = 0.45;
/// Distance of the lines over greys that classes share.
pub const TEXTURE: f64 = 2.4;
/// Distance of the dots over the cells that overturn about the right corner, and their radius.
pub const DOTS: f64 = 3.0;
/// See [`DOTS`].
pub const DOT: f64 = 0.42;
/// Radius of the ring around a region that is too small to be seen.
pub const RING: f64 = 2.6;

/// A mark at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A filled circle.
    Disc,
    /// An open circle.
    Circle,
    /// Two crossing lines.
    Cross,
    /// A filled triangle that points upwards.
    Triangle,
}

impl Mark {
    /// Draws it at a point.
    pub fn draw(self, canvas: &mut Canvas, (x, y): Point, radius: f64, colour: Colour) {
        match self {
            Mark::Disc => canvas.disc((x, y), radius, colour),
            Mark::Circle => {
                canvas.disc((x, y), radius, WHITE);
                canvas.ring((x, y), radius, stroke(colour, 0.5));
            }
            Mark::Cross => {
                let line = stroke(colour, 0.9);
                canvas.line([(x - radius, y - radius), (x + radius, y + radius)], line);
                canvas.line([(x - radius, y + radius), (x + radius, y - radius)], line);
            }
            Mark::Triangle => {
                let (side, low) = (0.866 * radius, 0.5 * radius);
                canvas.polygon([(x, y - radius), (x + side, y + low), (x - side, y + low)], colour);
            }
        }
    }
}

/// What stands beside a word in a legend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Swatch {
    /// Nothing: a remark.
    None,
    /// A colour.
    Fill(Colour),
    /// The dots of cells that overturn about the right corner.
    Dotted(Colour),
    /// The hatch of cells for which the model is not valid.
    Hatched,
    /// The crossed lines of cells of which nothing can be said.
    Crossed,
    /// A line.
    Line(Stroke),
    /// A line with marks on it.
    Curve(Stroke, Mark),
    /// A mark alone.
    Mark(Mark, Colour),
    /// The ring around a region too small to be seen.
    Ring,
}

/// The ring around a region that is too small to be seen: black on a white edge.
pub fn ring(canvas: &mut Canvas, at: Point) {
    canvas.ring(at, RING, stroke(WHITE, 1.2));
    canvas.ring(at, RING, stroke(BLACK, 0.5));
}

/// Lines across a place that rise, or fall, to the right.
fn lines(canvas: &mut Canvas, place: Place, rising: bool, colour: Colour) {
    let Place { x, y, width, height } = place;
    canvas.clipped(place, |canvas| {
        let mut shift = -height;
        while shift < width {
            let (left, right) = (x + shift, x + shift + height);
            let (from, to) = if rising { (y + height, y) } else { (y, y + height) };
            canvas.line([(left, from), (right, to)], stroke(colour, WIDTH));
            shift += PITCH;
        }
    });
}

/// The lines that a palette has over a colour.
fn texture(canvas: &mut Canvas, place: Place, colour: Colour) {
    let line = stroke(dots(canvas.palette().of(colour)), WIDTH);
    let Place { x, y, width, height } = place;
    let along = |length: f64| {
        (0..).map(|k| TEXTURE * (0.5 + f64::from(k))).take_while(move |at| *at < length)
    };
    match canvas.palette().texture(colour) {
        Texture::Plain => {}
        Texture::Across => {
            along(height).for_each(|at| canvas.line([(x, y + at), (x + width, y + at)], line));
        }
        Texture::Upright => {
            along(width).for_each(|at| canvas.line([(x + at, y), (x + at, y + height)], line));
        }
    }
}

impl Swatch {
    /// Draws it with its upper left corner at a place.
    pub fn draw(self, canvas: &mut Canvas, (x, y): Point) {
        let (width, height) = SIZE;
        let place = Place { x, y, width, height };
        let middle = (x + 0.5 * width, y + 0.5 * height);
        let across = [(x, middle.1), (x + width, middle.1)];
        let edge = stroke(BLACK, 0.4);
        match self {
            Swatch::None => {}
            Swatch::Fill(colour) => {
                canvas.fill(place, colour);
                texture(canvas, place, colour);
                canvas.outline(place, edge);
            }
            Swatch::Dotted(colour) => {
                canvas.fill(place, colour);
                for x in [2.2, 6.5, 10.8] {
                    canvas.disc((place.x + x, middle.1), DOT, dots(canvas.palette().of(colour)));
                }
                canvas.outline(place, edge);
            }
            Swatch::Hatched => {
                lines(canvas, place, true, BLACK);
                canvas.outline(place, edge);
            }
            Swatch::Crossed => {
                lines(canvas, place, true, BLACK);
                lines(canvas, place, false, BLACK);
                canvas.outline(place, edge);
            }
            Swatch::Line(stroke) => canvas.line(across, stroke),
            Swatch::Curve(stroke, mark) => {
                canvas.line(across, stroke);
                mark.draw(canvas, middle, 1.6, stroke.colour);
            }
            Swatch::Mark(mark, colour) => mark.draw(canvas, middle, 2.0, colour),
            Swatch::Ring => ring(canvas, middle),
        }
    }
}
