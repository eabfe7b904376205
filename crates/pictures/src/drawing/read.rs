//! A picture from the SVG that was written of it, for those who have the file alone.

use crate::colours::Colour;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::picture::{Mark, Paint, Picture, Step};
use super::shapes::{Place, Point, Stroke};
use super::text::{Anchor, Style};

impl Picture {
    /// The picture of an SVG; none of a document that is not to the last letter as [`Picture::svg`] writes it.
    pub fn of_svg(svg: &str) -> Option<Picture> {
        let mut lines = svg.lines();
        let root = lines.next()?;
        let (_, size) = root.split_once(" viewBox=\"0 0 ")?;
        let [width, height] = numbers(size.split_once('"')?.0)?[..] else { return None };
        let millimetres = |name| finite(attribute(root, name)?.strip_suffix("mm")?);
        let paper = (millimetres("width")?, millimetres("height")?);
        // White paper.
        lines.next()?;
        let marks = marks(&mut lines, DEEPEST)?;
        let picture = Picture { size: (width, height), paper, marks };
        let has_size = [width, height, paper.0, paper.1].iter().all(|side| *side > 0.0);
        (has_size && picture.svg() == svg).then_some(picture)
    }
}

/// Groups within groups: pictures have one.
const DEEPEST: usize = 8;

/// Marks up to where their group ends.
fn marks<'a>(lines: &mut impl Iterator<Item = &'a str>, deepest: usize) -> Option<Vec<Mark>> {
    let deepest = deepest.checked_sub(1)?;
    let mut marks = Vec::new();
    loop {
        let line = lines.next()?;
        let number = |name| number(line, name);
        marks.push(match line.split([' ', '>']).next()? {
            "</svg" | "</g" => return Some(marks),
            "<rect" => Mark::Rectangle(place(line)?, paint(line)?),
            "<path" => Mark::Path(path(attribute(line, "d")?)?, paint(line)?),
            "<circle" => Mark::Circle((number("cx")?, number("cy")?), number("r")?, paint(line)?),
            "<image" => Mark::Image {
                place: place(line)?,
                png: STANDARD.decode(attribute(line, "href")?.split_once(',')?.1).ok()?,
                sharp: line.contains(" style="),
            },
            "<text" => text(line)?,
            "<clipPath" => Mark::Clip(place(line)?, self::marks(lines, deepest)?),
            _ => return None,
        });
    }
}

fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let (_, value) = line.split_once(&format!(" {name}=\""))?;
    Some(value.split_once('"')?.0)
}

fn finite(number: &str) -> Option<f64> {
    number.parse().ok().filter(|number: &f64| number.is_finite())
}

fn number(line: &str, name: &str) -> Option<f64> {
    finite(attribute(line, name)?)
}

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(' ').map(finite).collect()
}

fn colour(text: &str) -> Option<Colour> {
    let number = u32::from_str_radix(text.strip_prefix('#')?, 16).ok()?;
    let [_, colour @ ..] = number.to_be_bytes();
    Some(colour)
}

fn place(line: &str) -> Option<Place> {
    let of = |name| number(line, name);
    Some(Place { x: of("x")?, y: of("y")?, width: of("width")?, height: of("height")? })
}

fn paint(line: &str) -> Option<Paint> {
    if let Some(fill) = colour(attribute(line, "fill")?) {
        return Some(Paint::Fill(fill, number(line, "fill-opacity").unwrap_or(1.0)));
    }
    let dash = attribute(line, "stroke-dasharray").and_then(numbers);
    Some(Paint::Line(Stroke {
        colour: colour(attribute(line, "stroke")?)?,
        width: number(line, "stroke-width")?,
        dash: dash.and_then(|dash| Some((*dash.first()?, *dash.last()?))),
    }))
}

fn path(text: &str) -> Option<Vec<Step>> {
    let mut path = Vec::new();
    let starts = text.char_indices().filter(|(_, c)| c.is_ascii_uppercase()).map(|(at, _)| at);
    let starts: Vec<usize> = starts.chain([text.len()]).collect();
    for pair in starts.windows(2) {
        let (letter, rest) = text[pair[0]..pair[1]].split_at(1);
        let numbers = if rest.is_empty() { Vec::new() } else { numbers(rest)? };
        let points: Vec<Point> = numbers.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect();
        path.push(match (letter, &points[..]) {
            ("M", [to]) => Step::Move(*to),
            ("L", [to]) => Step::Line(*to),
            ("Q", [by, to]) => Step::Quad(*by, *to),
            ("C", [by, and, to]) => Step::Cubic(*by, *and, *to),
            ("Z", []) => Step::Close,
            _ => return None,
        });
    }
    Some(path)
}

/// A line of text: what is lowered and raised in it as [`super::text::pieces`] reads it.
fn text(line: &str) -> Option<Mark> {
    let (head, marked) = line.strip_suffix("</text>")?.split_once('>')?;
    let anchor = match attribute(head, "text-anchor") {
        None => Anchor::Start,
        Some("middle") => Anchor::Middle,
        Some(_) => Anchor::End,
    };
    let style = Style {
        size: number(head, "font-size")?,
        anchor,
        upwards: head.contains(" transform="),
        colour: colour(attribute(head, "fill")?)?,
    };
    let mut pieces = marked.split("<tspan ");
    let mut text = pieces.next()?.to_string();
    for piece in pieces {
        let (inner, after) = piece.split_once('>')?.1.split_once("</tspan>")?;
        match piece.split('"').nth(1)? {
            "sub" => text.extend(["_", inner]),
            "super" => text.extend(["^{", inner, "}"]),
            _ => text.push(super::text::DOTS),
        }
        text += after;
    }
    let plain = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")];
    let text = plain.iter().fold(text, |text, (mark, letter)| text.replace(mark, letter));
    let at = (number(head, "x")?, number(head, "y")?);
    Some(Mark::Text { at, style, text })
}
