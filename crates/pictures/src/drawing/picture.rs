//! A picture: its size and its marks, of which an SVG, pixels and the page of a PDF are made.

use super::canvas::{Place, Point, Stroke};
use super::error::FigureError;
use super::text::Style;
use super::{MILLIMETRE, raster};
use topple::results::colour::Colour;

/// A picture on white paper.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width and height in the coordinates of its marks.
    pub(super) size: (f64, f64),
    /// Width and height in print, mm.
    pub(super) paper: (f64, f64),
    /// Letters of its SVG are outlines, which need no font.
    pub(super) outlines: bool,
    /// What is drawn, the lowest first.
    pub(super) marks: Vec<Mark>,
}

/// Something that is drawn.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Mark {
    Rectangle(Place, Paint),
    Path(Vec<Step>, Paint),
    Circle(Point, f64, Paint),
    /// A PNG stretched over a place; with `sharp` its pixels stay rectangles.
    Image {
        place: Place,
        png: Vec<u8>,
        sharp: bool,
    },
    /// A line of text as [`super::text`] reads it; of `at` the second number is that of its foot.
    Text {
        at: Point,
        style: Style,
        text: String,
    },
    /// Marks that are cut at the edge of a place.
    Clip(Place, Vec<Mark>),
}

/// How a shape is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Paint {
    /// Filled with a colour of an opacity.
    Fill(Colour, f64),
    /// As a line along its edge.
    Line(Stroke),
}

/// A step of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Step {
    Move(Point),
    Line(Point),
    /// A curve of the second degree: its control point, and where it ends.
    Quad(Point, Point),
    /// One of the third degree.
    Cubic(Point, Point, Point),
    Close,
}

impl Picture {
    /// A PNG as a picture: in the size that it says of itself, or with a point a pixel.
    ///
    /// # Errors
    /// [`FigureError::Encode`]: no PNG.
    pub fn of_png(png: Vec<u8>) -> Result<Picture, FigureError> {
        let (width, height) = raster::size(&png)?;
        let (x, y) = (0.0, 0.0);
        Ok(Picture {
            size: (width, height),
            paper: (width / MILLIMETRE, height / MILLIMETRE),
            outlines: false,
            marks: vec![Mark::Image { place: Place { x, y, width, height }, png, sharp: true }],
        })
    }

    /// Width and height in print, points.
    pub fn points(&self) -> (f64, f64) {
        (self.paper.0 * MILLIMETRE, self.paper.1 * MILLIMETRE)
    }

    /// A unit of its coordinates in print, mm.
    pub(super) fn unit(&self) -> f64 {
        self.paper.0 / self.size.0
    }

    /// Calls with each text and its style.
    pub(super) fn for_texts(&self, with: &mut impl FnMut(&str, Style)) {
        for_texts(&self.marks, with);
    }
}

fn for_texts(marks: &[Mark], with: &mut impl FnMut(&str, Style)) {
    for mark in marks {
        match mark {
            Mark::Text { style, text, .. } => with(text, *style),
            Mark::Clip(_, inner) => for_texts(inner, with),
            _ => {}
        }
    }
}
