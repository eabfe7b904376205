//! A picture from the SVG that was written of it, for those who have the file alone.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use topple::results::colour::Colour;

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
        let picture = Picture { size: (width, height), paper, outlines: false, marks };
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

#[cfg(test)]
mod tests {
    use crate::drawing::canvas::{Canvas, Place, dashed, stroke};
    use crate::drawing::picture::Picture;
    use crate::drawing::raster::png;
    use crate::drawing::text::style;

    /// A picture with all kinds of marks.
    fn picture() -> Picture {
        let mut canvas = Canvas::new(144.0);
        let place = Place { x: 4.004, y: 20.0, width: 30.128, height: 12.0 };
        canvas.fill(place, [1, 2, 3]);
        canvas.fill_through(place, [200, 100, 0], 0.85);
        canvas.outline(place, stroke([0, 0, 0], 0.5));
        canvas.line([(3.0, 4.0), (-0.001, 5.0), (6.0, 7.25)], dashed([9, 9, 9], 0.5, (2.0, 1.5)));
        canvas.polygon_through([(50.0, 20.0), (60.0, 20.0), (55.0, 29.0)], [0, 128, 0], 0.5);
        canvas.disc((70.0, 25.0), 3.0, [0, 0, 255]);
        canvas.ring((80.0, 25.0), 3.0, stroke([255, 0, 0], 0.4));
        canvas.image(place, &png((2, 2), |x, y| [x as u8, y as u8, 0, 255]).unwrap(), true);
        canvas.clipped(place, |canvas| {
            canvas.image(place, &png((1, 1), |_, _| [1, 1, 1, 9]).unwrap(), false);
            canvas.clipped(place, |canvas| canvas.disc((20.0, 25.0), 9.0, [7, 7, 7]));
        });
        canvas.text(
            (4.0, 10.0),
            style(7.0),
            "T_h = 2 s, v\u{308}_g, 10^{-3} & \"<b>'s\" AT_h AVAT",
        );
        canvas.text((140.0, 60.0), style(8.0).end(), "a\u{a0}b &amp; ω_v²");
        canvas.text((100.0, 40.0), style(7.0).middle().upwards(), "u [m]");
        canvas.finish(72.0)
    }

    #[test]
    fn a_picture_is_read_from_its_svg_with_text_or_with_outlines() {
        let picture = picture();
        for svg in [picture.svg(), picture.outlined()] {
            let read = Picture::of_svg(&svg).unwrap();
            assert_eq!(read.svg(), svg);
        }
        assert_eq!(picture.svg().matches("<text").count(), 3);
        assert_eq!(picture.outlined().matches("<text").count(), 0);
    }

    /// The outlines of letters lie where the letters do.
    #[test]
    fn outlines_look_as_text_does() {
        let picture = picture();
        let outlined = Picture::of_svg(&picture.outlined()).unwrap();
        let [text, outlines] = [&picture, &outlined].map(|picture| picture.frame().unwrap());
        assert_eq!((text.width(), text.height()), (300, 150));
        let pixels = || text.data().iter().zip(outlines.data());
        let apart = pixels().filter(|(a, b)| a.abs_diff(**b) > 32).count();
        assert!(apart * 1000 < text.data().len(), "{apart}");
    }

    #[test]
    fn what_is_not_as_it_was_written_is_no_picture() {
        let svg = picture().svg();
        let (script, link) = ("<script>alert(1)</script>\n</svg>", "href=\"https://a.b/c.png\"/>");
        let embedded = svg.split("href=").nth(1).unwrap().split_once("/>").unwrap().0;
        let changed = [
            svg.replace("</svg>", script),
            svg.replace(&format!("href={embedded}/>"), link),
            svg.replace("<circle ", "<circle onclick=\"a()\" "),
            svg.replace("<rect width", "<rect  width"),
            svg.replace("</svg>\n", ""),
            svg.replace("T<tspan", "<a>T</a><tspan"),
            svg.replace("viewBox=\"0 0 144 ", "viewBox=\"0 0 0 "),
            svg.replace("cx=\"70\"", "cx=\"NaN\""),
            svg.replace("r=\"3\"", "r=\"inf\""),
            "<svg/>".into(),
            String::new(),
        ];
        for changed in changed {
            assert!(changed != svg && Picture::of_svg(&changed).is_none(), "{changed}");
        }
    }
}
