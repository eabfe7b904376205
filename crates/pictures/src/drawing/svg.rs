//! A picture as SVG: one element a line.

use std::fmt::Write as _;

use super::picture::{Mark, Paint, Picture, Step};
use super::raster::data_url;
use super::shapes::{Place, Stroke};
use super::text::{self, Anchor};
use super::{font, glyphs, letters};
use crate::colours::Colour;

/// A colour as SVG writes it.
pub(crate) fn hex([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A length with the digits that a print shows: hundredths of a point.
fn short(length: f64) -> String {
    let text = format!("{length:.2}");
    let plain = text.trim_end_matches('0').trim_end_matches('.');
    if plain == "-0" { "0".into() } else { plain.into() }
}

impl Place {
    fn attributes(&self) -> String {
        let [x, y, width, height] = [self.x, self.y, self.width, self.height].map(short);
        format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"")
    }
}

impl Paint {
    /// Its attributes; `join` are those of the corners of a line.
    fn attributes(&self, join: &str) -> String {
        match self {
            Paint::Fill(colour, 1.0) => format!("fill=\"{}\"", hex(*colour)),
            Paint::Fill(colour, opacity) => {
                format!("fill=\"{}\" fill-opacity=\"{}\"", hex(*colour), short(*opacity))
            }
            Paint::Line(Stroke { colour, width, dash }) => {
                let dash = dash.map_or(String::new(), |(dash, gap)| {
                    format!(" stroke-dasharray=\"{} {}\"", short(dash), short(gap))
                });
                let (colour, width) = (hex(*colour), short(*width));
                format!("fill=\"none\"{join} stroke=\"{colour}\" stroke-width=\"{width}\"{dash}")
            }
        }
    }
}

/// The corners of a line that is no rectangle and no circle.
const JOIN: &str = " stroke-linejoin=\"round\"";

/// The steps of a path.
fn path(steps: &[Step]) -> String {
    let mut path = String::new();
    for step in steps {
        path.push(match step {
            Step::Move(_) => 'M',
            Step::Line(_) => 'L',
            Step::Quad(..) => 'Q',
            Step::Cubic(..) => 'C',
            Step::Close => 'Z',
        });
        let points = step.points().into_iter();
        path += &points.flat_map(|(x, y)| [short(x), short(y)]).collect::<Vec<_>>().join(" ");
    }
    path
}

impl Picture {
    /// The document.
    pub fn svg(&self) -> String {
        self.document(false)
    }

    /// The document with letters as outlines, so that it needs no font. A text with letters that no font of this machine has
    /// stays one.
    pub fn outlined(&self) -> String {
        self.document(true)
    }

    fn document(&self, outlines: bool) -> String {
        let [w, h, mm_w, mm_h] = [self.size.0, self.size.1, self.paper.0, self.paper.1].map(short);
        let mut writer = Writer { body: String::new(), clips: 0, outlines };
        writer.marks(&self.marks);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{mm_w}mm\" height=\"{mm_h}mm\" \
             viewBox=\"0 0 {w} {h}\">\n<rect width=\"{w}\" height=\"{h}\" fill=\"white\"/>\n{}</svg>\n",
            writer.body
        )
    }
}

struct Writer {
    body: String,
    clips: usize,
    outlines: bool,
}

impl Writer {
    fn marks(&mut self, marks: &[Mark]) {
        for mark in marks {
            // Writing into a string cannot fail.
            let _ = match mark {
                Mark::Rectangle(place, paint) => {
                    writeln!(self.body, "<rect {} {}/>", place.attributes(), paint.attributes(""))
                }
                Mark::Path(steps, paint) => {
                    writeln!(self.body, "<path d=\"{}\" {}/>", path(steps), paint.attributes(JOIN))
                }
                Mark::Circle((x, y), radius, paint) => {
                    let [x, y, radius] = [*x, *y, *radius].map(short);
                    let paint = paint.attributes("");
                    writeln!(self.body, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" {paint}/>")
                }
                Mark::Image { place, png, sharp } => {
                    let style = if *sharp { " style=\"image-rendering:pixelated\"" } else { "" };
                    let (place, url) = (place.attributes(), data_url(png));
                    writeln!(
                        self.body,
                        "<image {place} preserveAspectRatio=\"none\"{style} href=\"{url}\"/>"
                    )
                }
                Mark::Text { at, style, text } if self.outlines && !letters::is_boxed(text) => {
                    let outline = path(&glyphs::outline(*at, *style, text));
                    writeln!(self.body, "<path d=\"{outline}\" fill=\"{}\"/>", hex(style.colour))
                }
                Mark::Text { at, style, text } => {
                    let (x, y) = (short(at.0), short(at.1));
                    let anchor = match style.anchor {
                        Anchor::Start => "",
                        Anchor::Middle => " text-anchor=\"middle\"",
                        Anchor::End => " text-anchor=\"end\"",
                    };
                    let turned = match style.upwards {
                        true => format!(" transform=\"rotate(-90 {x} {y})\""),
                        false => String::new(),
                    };
                    writeln!(
                        self.body,
                        "<text x=\"{x}\" y=\"{y}\" font-family=\"{}\" font-weight=\"300\" font-size=\"{}\" \
                         fill=\"{}\"{anchor}{turned}>{}</text>",
                        font::FAMILY,
                        short(style.size),
                        hex(style.colour),
                        text::marked_up(text, style.size)
                    )
                }
                Mark::Clip(place, inner) => {
                    let name = format!("clip{}", self.clips);
                    self.clips += 1;
                    let _ = writeln!(
                        self.body,
                        "<clipPath id=\"{name}\"><rect {}/></clipPath><g clip-path=\"url(#{name})\">",
                        place.attributes()
                    );
                    self.marks(inner);
                    writeln!(self.body, "</g>")
                }
            };
        }
    }
}
