//! The SVG document that pictures are drawn into.

use std::fmt::Write as _;

use super::raster::data_url;
use super::text::{self, Anchor, Style};
use super::{LEADING, MARGIN, MILLIMETRE, render};
use topple::results::colour::Colour;
use topple::results::print_palette::Palette;

/// A place in a document, points from its upper left corner.
pub type Point = (f64, f64);

/// A rectangle of the document, points.
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

/// A document of a width, drawn from the top downwards; its height is known when it is finished.
#[derive(Debug, Clone)]
pub struct Canvas {
    width: f64,
    scale: f64,
    palette: Palette,
    outlines: bool,
    body: String,
    clips: usize,
}

/// A colour as SVG writes it.
fn hex([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A length with the digits that a print shows: hundredths of a point.
fn short(length: f64) -> String {
    let text = format!("{length:.2}");
    let plain = text.trim_end_matches('0').trim_end_matches('.');
    if plain == "-0" { "0".into() } else { plain.into() }
}

/// The attribute of an opacity; none of what is opaque.
fn through(opacity: f64) -> String {
    match opacity {
        1.0 => String::new(),
        opacity => format!(" fill-opacity=\"{}\"", short(opacity)),
    }
}

/// Points nearer to each other than this are one in print.
const NEAR: f64 = 0.04;

fn path(points: impl IntoIterator<Item = Point>) -> String {
    let mut path = String::new();
    let mut points = points.into_iter().peekable();
    let mut before: Option<Point> = None;
    while let Some((x, y)) = points.next() {
        let near = before.is_some_and(|(a, b)| (a - x).abs() < NEAR && (b - y).abs() < NEAR);
        if near && points.peek().is_some() {
            continue;
        }
        let letter = if before.is_none() { "M" } else { "L" };
        // Writing into a string cannot fail.
        let _ = write!(path, "{letter}{} {}", short(x), short(y));
        before = Some((x, y));
    }
    path
}

impl Stroke {
    fn attributes(&self, palette: Palette) -> String {
        let dash = self.dash.map_or(String::new(), |(dash, gap)| {
            format!(" stroke-dasharray=\"{} {}\"", short(dash), short(gap))
        });
        format!(
            "stroke=\"{}\" stroke-width=\"{}\"{dash}",
            hex(palette.of(self.colour)),
            short(self.width)
        )
    }
}

impl Canvas {
    /// An empty document of a width, points.
    pub fn new(width: f64) -> Canvas {
        Canvas::printed(width, 1.0, Palette::default(), false)
    }

    /// An empty document of a width, points of print, that is drawn so many times as large as its coordinates say, in
    /// the colours of a palette; with letters as outlines where these are asked for.
    pub fn printed(width: f64, scale: f64, palette: Palette, outlines: bool) -> Canvas {
        Canvas { width: width / scale, scale, palette, outlines, body: String::new(), clips: 0 }
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

    /// The document on white paper of a height in its coordinates.
    pub fn finish(self, height: f64) -> String {
        let Canvas { width, scale, outlines, body, .. } = self;
        let (w, h) = (short(width), short(height));
        let (mm_w, mm_h) = (short(scale * width / MILLIMETRE), short(scale * height / MILLIMETRE));
        let document = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{mm_w}mm\" height=\"{mm_h}mm\" \
             viewBox=\"0 0 {w} {h}\">\n<rect width=\"{w}\" height=\"{h}\" fill=\"white\"/>\n{body}</svg>\n"
        );
        match outlines {
            // What is no document fails when its pixels are made.
            true => render::outlined(&document).unwrap_or(document),
            false => document,
        }
    }

    fn push(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    /// A filled rectangle.
    pub fn fill(&mut self, place: Place, colour: Colour) {
        self.fill_through(place, colour, 1.0);
    }

    /// A filled rectangle of an opacity.
    pub fn fill_through(&mut self, place: Place, colour: Colour, opacity: f64) {
        let Place { x, y, width, height } = place;
        let (x, y, width, height) = (short(x), short(y), short(width), short(height));
        let fill = hex(self.palette.of(colour));
        self.push(&format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{fill}\"{}/>",
            through(opacity)
        ));
    }

    /// The outline of a rectangle.
    pub fn outline(&mut self, place: Place, stroke: Stroke) {
        let Place { x, y, width, height } = place;
        let (x, y, width, height) = (short(x), short(y), short(width), short(height));
        self.push(&format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"none\" {}/>",
            stroke.attributes(self.palette)
        ));
    }

    /// A line through points.
    pub fn line(&mut self, points: impl IntoIterator<Item = Point>, stroke: Stroke) {
        let path = path(points);
        if !path.is_empty() {
            let attributes = stroke.attributes(self.palette);
            self.push(&format!(
                "<path d=\"{path}\" fill=\"none\" stroke-linejoin=\"round\" {attributes}/>"
            ));
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
        let (path, fill) = (path(points), hex(self.palette.of(colour)));
        self.push(&format!("<path d=\"{path}Z\" fill=\"{fill}\"{}/>", through(opacity)));
    }

    /// A filled circle.
    pub fn disc(&mut self, (x, y): Point, radius: f64, colour: Colour) {
        let (x, y, radius) = (short(x), short(y), short(radius));
        self.push(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{}\"/>",
            hex(self.palette.of(colour))
        ));
    }

    /// The outline of a circle.
    pub fn ring(&mut self, (x, y): Point, radius: f64, stroke: Stroke) {
        let (x, y, radius) = (short(x), short(y), short(radius));
        let attributes = stroke.attributes(self.palette);
        self.push(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"none\" {attributes}/>"
        ));
    }

    /// A PNG stretched over a place; with `sharp` its pixels are cells and stay so.
    pub fn image(&mut self, place: Place, png: &[u8], sharp: bool) {
        let Place { x, y, width, height } = place;
        let (x, y, width, height) = (short(x), short(y), short(width), short(height));
        let style = if sharp { " style=\"image-rendering:pixelated\"" } else { "" };
        let url = data_url(png);
        self.push(&format!(
            "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             preserveAspectRatio=\"none\"{style} href=\"{url}\"/>"
        ));
    }

    /// A line of text; of `at` the second number is that of its foot.
    pub fn text(&mut self, at: Point, style: Style, text: &str) {
        let (x, y) = (short(at.0), short(at.1));
        let anchor = match style.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let turned = if style.upwards {
            format!(" transform=\"rotate(-90 {x} {y})\"")
        } else {
            String::new()
        };
        let (size, fill) = (short(style.size), hex(self.palette.of(style.colour)));
        let text = text::marked_up(text, style.size);
        self.push(&format!(
            "<text x=\"{x}\" y=\"{y}\" font-family=\"{}\" font-weight=\"300\" font-size=\"{size}\" \
             fill=\"{fill}\"{anchor}{turned}>{text}</text>",
            super::font::FAMILY
        ));
    }

    /// What `paint` draws, cut at the edge of a place.
    pub fn clipped(&mut self, place: Place, paint: impl FnOnce(&mut Canvas)) {
        let Place { x, y, width, height } = place;
        let (x, y, width, height) = (short(x), short(y), short(width), short(height));
        let name = format!("clip{}", self.clips);
        self.clips += 1;
        self.push(&format!(
            "<clipPath id=\"{name}\"><rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/></clipPath>\
             <g clip-path=\"url(#{name})\">"
        ));
        paint(self);
        self.push("</g>");
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
