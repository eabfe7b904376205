//! What pictures are drawn on: it keeps a list of marks.

use super::picture::{Mark, Paint, Picture, Step};
pub use super::shapes::{Place, Point, Stroke, dashed, stroke};
use super::text::Style;
use super::{LEADING, MARGIN, MILLIMETRE};
use crate::colours::Colour;
use crate::colours::print_palette::Palette;

/// A picture of a width, drawn from the top downwards; its height is known when it is finished.
#[derive(Debug, Clone)]
pub struct Canvas {
    width: f64,
    scale: f64,
    palette: Palette,
    marks: Vec<Mark>,
}

/// Points nearer to each other than this are one in print.
const NEAR: f64 = 0.04;

fn path(points: impl IntoIterator<Item = Point>) -> Vec<Step> {
    let mut path = Vec::new();
    let mut points = points.into_iter().peekable();
    let mut before: Option<Point> = None;
    while let Some((x, y)) = points.next() {
        let near = before.is_some_and(|(a, b)| (a - x).abs() < NEAR && (b - y).abs() < NEAR);
        if near && points.peek().is_some() {
            continue;
        }
        path.push(if before.is_none() { Step::Move((x, y)) } else { Step::Line((x, y)) });
        before = Some((x, y));
    }
    path
}

impl Canvas {
    /// An empty picture of a width, points.
    pub fn new(width: f64) -> Canvas {
        Canvas::printed(width, 1.0, Palette::default())
    }

    /// An empty picture of a width, points of print, that is drawn so many times as large as its coordinates say, in
    /// the colours of a palette.
    pub fn printed(width: f64, scale: f64, palette: Palette) -> Canvas {
        Canvas { width: width / scale, scale, palette, marks: Vec::new() }
    }

    /// Its colours, which those who draw an image choose themselves.
    pub fn palette(&self) -> Palette {
        self.palette
    }

    /// Its width in its coordinates.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// The same without its margins.
    pub fn inner(&self) -> f64 {
        self.width - 2.0 * MARGIN
    }

    /// The picture on white paper of a height in its coordinates.
    pub fn finish(self, height: f64) -> Picture {
        let Canvas { width, scale, marks, .. } = self;
        let paper = (scale * width / MILLIMETRE, scale * height / MILLIMETRE);
        Picture { size: (width, height), paper, marks }
    }

    fn filled(&self, colour: Colour, opacity: f64) -> Paint {
        Paint::Fill(self.palette.of(colour), opacity)
    }

    fn stroked(&self, stroke: Stroke) -> Paint {
        Paint::Line(Stroke { colour: self.palette.of(stroke.colour), ..stroke })
    }

    /// A filled rectangle.
    pub fn fill(&mut self, place: Place, colour: Colour) {
        self.fill_through(place, colour, 1.0);
    }

    /// A filled rectangle of an opacity.
    pub fn fill_through(&mut self, place: Place, colour: Colour, opacity: f64) {
        self.marks.push(Mark::Rectangle(place, self.filled(colour, opacity)));
    }

    /// The outline of a rectangle.
    pub fn outline(&mut self, place: Place, stroke: Stroke) {
        self.marks.push(Mark::Rectangle(place, self.stroked(stroke)));
    }

    /// A line through points.
    pub fn line(&mut self, points: impl IntoIterator<Item = Point>, stroke: Stroke) {
        let path = path(points);
        if !path.is_empty() {
            self.marks.push(Mark::Path(path, self.stroked(stroke)));
        }
    }

    /// A filled polygon.
    pub fn polygon(&mut self, points: impl IntoIterator<Item = Point>, colour: Colour) {
        self.polygon_through(points, colour, 1.0);
    }

    /// A filled polygon of an opacity.
    pub fn polygon_through(
        &mut self,
        points: impl IntoIterator<Item = Point>,
        colour: Colour,
        opacity: f64,
    ) {
        let mut path = path(points);
        path.push(Step::Close);
        self.marks.push(Mark::Path(path, self.filled(colour, opacity)));
    }

    /// A filled circle.
    pub fn disc(&mut self, at: Point, radius: f64, colour: Colour) {
        self.marks.push(Mark::Circle(at, radius, self.filled(colour, 1.0)));
    }

    /// The outline of a circle.
    pub fn ring(&mut self, at: Point, radius: f64, stroke: Stroke) {
        self.marks.push(Mark::Circle(at, radius, self.stroked(stroke)));
    }

    /// A PNG stretched over a place; with `sharp` its pixels are cells and stay so.
    pub fn image(&mut self, place: Place, png: &[u8], sharp: bool) {
        self.marks.push(Mark::Image { place, png: png.to_vec(), sharp });
    }

    /// A line of text; of `at` the second number is that of its foot.
    pub fn text(&mut self, at: Point, style: Style, text: &str) {
        let style = Style { colour: self.palette.of(style.colour), ..style };
        self.marks.push(Mark::Text { at, style, text: text.into() });
    }

    /// What `paint` draws, cut at the edge of a place.
    pub fn clipped(&mut self, place: Place, paint: impl FnOnce(&mut Canvas)) {
        let around = std::mem::take(&mut self.marks);
        paint(self);
        let within = std::mem::replace(&mut self.marks, around);
        self.marks.push(Mark::Clip(place, within));
    }
}

/// Writes lines one below the other from the top at `at`; returns where they end.
pub fn write(canvas: &mut Canvas, at: Point, style: Style, lines: &[String]) -> f64 {
    let mut y = at.1;
    for line in lines {
        canvas.text((at.0, y + style.size), style, line);
        y += LEADING * style.size;
    }
    y
}
