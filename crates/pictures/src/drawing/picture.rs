//! A picture: its size and its marks, of which an SVG, pixels and the page of a PDF are made.

use std::borrow::Cow;

use super::error::FigureError;
use super::shapes::{Place, Point, Stroke};
use super::text::Style;
use super::{MILLIMETRE, raster};
use crate::colours::Colour;

/// A picture on white paper.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width and height in the coordinates of its marks.
    pub(super) size: (f64, f64),
    /// Width and height in print, mm.
    pub(super) paper: (f64, f64),
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

impl Step {
    /// Its points, the last of which is where it ends.
    pub fn points(self) -> Vec<Point> {
        match self {
            Step::Move(to) | Step::Line(to) => vec![to],
            Step::Quad(by, to) => vec![by, to],
            Step::Cubic(by, and, to) => vec![by, and, to],
            Step::Close => vec![],
        }
    }
}

/// The control points of a quarter of a circle lie at this share of its radius.
const ROUND: f64 = 0.552_284_75;

impl Place {
    /// Its edge.
    pub(super) fn steps(self) -> Vec<Step> {
        let Place { x, y, .. } = self;
        let (right, bottom) = (self.right(), self.bottom());
        let corners = [(right, y), (right, bottom), (x, bottom)].map(Step::Line);
        [&[Step::Move((x, y))], &corners[..], &[Step::Close]].concat()
    }
}

impl Mark {
    /// What is drawn of a shape, and how, with round corners of its lines where it is a path.
    pub fn shape(&self) -> Option<(Cow<'_, [Step]>, Paint, bool)> {
        Some(match self {
            Mark::Path(steps, paint) => (steps.into(), *paint, true),
            Mark::Rectangle(place, paint) => (place.steps().into(), *paint, false),
            Mark::Circle((x, y), radius, paint) => {
                let at = |(a, b): Point| (x + radius * a, y + radius * b);
                let quarter = |[(a, b), (c, d)]: [Point; 2]| {
                    let (by, and) =
                        ((a + ROUND * c, b + ROUND * d), (c + ROUND * a, d + ROUND * b));
                    Step::Cubic(at(by), at(and), at((c, d)))
                };
                let [right, low, left, high] = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
                let ends = [[right, low], [low, left], [left, high], [high, right]];
                let quarters = ends.map(quarter);
                let circle = [&[Step::Move(at(right))], &quarters[..], &[Step::Close]].concat();
                (circle.into(), *paint, false)
            }
            _ => return None,
        })
    }
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
