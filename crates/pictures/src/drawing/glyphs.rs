//! A line of text as glyphs: which of which font, and where.

use std::ptr;

use harfrust::{ShapeOptions, UnicodeBuffer};
use skrifa::GlyphId;
use skrifa::outline::OutlinePen;

use super::font::{self, Font};
use super::letters;
use super::picture::Step;
use super::shapes::Point;
use super::text::{self, Anchor, Stand, Style};

/// A glyph of a line.
pub struct Glyph {
    pub font: &'static Font,
    pub id: GlyphId,
    /// Its place from that of the text, upright and to the right of it, the second number downwards.
    pub at: Point,
    /// How far it is to the next one by the font alone.
    pub advance: f64,
    pub size: f64,
    /// The letters that it stands for; none where the glyph before it does.
    pub letters: String,
}

/// The glyphs of a text, in their order from left to right.
pub fn line(style: Style, text: &str) -> Vec<Glyph> {
    let Some(own) = &*font::OWN else { return Vec::new() };
    let others = letters::fonts(text);
    let font_of = |letter: char| others.get(&letter).copied().flatten().unwrap_or(own);
    let mut glyphs = Vec::new();
    let mut x = 0.0;
    for run in text::runs(text, style.size) {
        let y = match run.stand {
            Stand::Line => 0.0,
            Stand::Back(length) => {
                x -= length;
                0.0
            }
            Stand::Below => own.shifts.0 * run.size,
            Stand::Above => -own.shifts.1 * run.size,
        };
        let mut rest = run.text.as_str();
        while !rest.is_empty() {
            let (font, part, after) = alike(rest, font_of);
            x = shape(&mut glyphs, font, part, (x, y), run.size);
            rest = after;
        }
    }
    let left = match style.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5 * x,
        Anchor::End => x,
    };
    glyphs.iter_mut().for_each(|glyph| glyph.at.0 -= left);
    glyphs
}

/// True of letters that are written from right to left.
fn is_leftward(letter: char) -> bool {
    matches!(letter, '\u{590}'..='\u{8ff}' | '\u{fb1d}'..='\u{fdff}' | '\u{fe70}'..='\u{feff}' | '\u{10800}'..='\u{10fff}' | '\u{1e800}'..='\u{1efff}')
}

/// The first letters of a text that are of one font and of one direction, with the spaces between them, and those after them.
fn alike(text: &str, font_of: impl Fn(char) -> &'static Font) -> (&'static Font, &str, &str) {
    let first = text.chars().next().unwrap_or(' ');
    let (font, leftward) = (font_of(first), is_leftward(first));
    let mut end = first.len_utf8().min(text.len());
    for (at, letter) in text.char_indices().filter(|(_, letter)| *letter != ' ') {
        if !ptr::eq(font_of(letter), font) || is_leftward(letter) != leftward {
            break;
        }
        end = at + letter.len_utf8();
    }
    let (part, after) = text.split_at(end);
    (font, part, after)
}

/// Adds the glyphs of letters of one font; returns where they end.
fn shape(
    glyphs: &mut Vec<Glyph>,
    font: &'static Font,
    text: &str,
    (mut x, y): Point,
    size: f64,
) -> f64 {
    let mut buffer = UnicodeBuffer::new();
    buffer.push_str(text);
    buffer.guess_segment_properties();
    let shaped = font.shaper.shaper(&font.face).build().shape(buffer, ShapeOptions::new());
    let infos = shaped.glyph_infos();
    let scaled = |length: i32| size * f64::from(length) / font.units;
    // Where the letters of glyphs begin, and where the last of them end.
    let mut clusters: Vec<usize> = infos.iter().map(|info| info.cluster as usize).collect();
    clusters.push(text.len());
    clusters.sort_unstable();
    for (number, (info, place)) in infos.iter().zip(shaped.glyph_positions()).enumerate() {
        let from = info.cluster as usize;
        let is_first = number == 0 || infos[number - 1].cluster != info.cluster;
        let to = clusters[clusters.partition_point(|end| *end <= from)];
        let id = GlyphId::new(info.glyph_id);
        glyphs.push(Glyph {
            font,
            id,
            at: (x + scaled(place.x_offset), y - scaled(place.y_offset)),
            advance: size * font.advance(id),
            size,
            letters: if is_first { text[from..to].into() } else { String::new() },
        });
        x += scaled(place.x_advance);
    }
    x
}

impl Style {
    /// Where a place of a line of text lies in the picture.
    pub fn turned(self, (x, y): Point, (right, down): Point) -> Point {
        if self.upwards { (x + down, y - right) } else { (x + right, y + down) }
    }
}

/// The outlines of a text's letters.
pub fn outline(at: Point, style: Style, text: &str) -> Vec<Step> {
    let mut steps = Vec::new();
    for glyph in line(style, text) {
        let place = |x: f32, y: f32| {
            let (right, down) = (glyph.at.0 + f64::from(x), glyph.at.1 - f64::from(y));
            style.turned(at, (right, down))
        };
        glyph.font.draw(glyph.id, glyph.size, &mut Pen { steps: &mut steps, place });
    }
    steps
}

/// Writes steps of a path, each point in its place.
pub struct Pen<'a, F> {
    pub steps: &'a mut Vec<Step>,
    pub place: F,
}

impl<F: Fn(f32, f32) -> Point> OutlinePen for Pen<'_, F> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.steps.push(Step::Move((self.place)(x, y)));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.steps.push(Step::Line((self.place)(x, y)));
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.steps.push(Step::Quad((self.place)(cx, cy), (self.place)(x, y)));
    }

    fn curve_to(&mut self, ax: f32, ay: f32, bx: f32, by: f32, x: f32, y: f32) {
        let place = &self.place;
        self.steps.push(Step::Cubic(place(ax, ay), place(bx, by), place(x, y)));
    }

    fn close(&mut self) {
        self.steps.push(Step::Close);
    }
}
