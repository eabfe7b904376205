//! The fonts of a PDF: of each the glyphs alone that its pages have, as outlines, with the letters that they stand for.

use std::collections::HashMap;
use std::io::Write;
use std::ptr;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use pdf_writer::types::{SystemInfo, UnicodeCmap};
use pdf_writer::{Content, Filter, Name, Pdf, Rect, Ref, Str};
use skrifa::GlyphId;

use super::error::FigureError;
use super::font::Font;
use super::glyphs::{Glyph, Pen};
use super::picture::Step;
use super::shapes::Point;

/// Glyphs of a font of type 3, whose codes are bytes.
const MOST: usize = 256;
/// Units of the size of a font.
const UNITS: f64 = 1000.0;

/// The fonts; a glyph is by its font, its number and its letters.
#[derive(Default)]
pub struct Fonts {
    known: HashMap<(*const Font, u32, String), (usize, u8)>,
    fonts: Vec<Vec<Entry>>,
}

/// A glyph with its letters.
struct Entry {
    font: &'static Font,
    id: GlyphId,
    letters: String,
}

impl Fonts {
    /// The number of a glyph's font, and its code there.
    pub fn code(&mut self, glyph: &Glyph) -> (usize, u8) {
        let key = (ptr::from_ref(glyph.font), glyph.id.to_u32(), glyph.letters.clone());
        let fonts = &mut self.fonts;
        *self.known.entry(key).or_insert_with(|| {
            if fonts.last().is_none_or(|last| last.len() == MOST) {
                fonts.push(Vec::new());
            }
            let number = fonts.len() - 1;
            let entry = Entry { font: glyph.font, id: glyph.id, letters: glyph.letters.clone() };
            fonts[number].push(entry);
            // A font has no more glyphs than a byte has values.
            (number, (fonts[number].len() - 1) as u8)
        })
    }

    /// Writes them; `next` numbers what is written. The names of the fonts on a page, each with its number.
    pub fn write(
        &self,
        pdf: &mut Pdf,
        mut next: impl FnMut() -> Ref,
    ) -> Result<Vec<(String, Ref)>, FigureError> {
        let mut written = Vec::new();
        for (number, entries) in self.fonts.iter().enumerate() {
            let (id, unicode) = (next(), next());
            let glyphs: Vec<Ref> = entries.iter().map(|_| next()).collect();
            let names: Vec<String> = (0..entries.len()).map(|code| format!("g{code}")).collect();
            let mut map = UnicodeCmap::new(
                Name(b"Letters"),
                SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"UCS"), supplement: 0 },
            );
            for (code, (entry, glyph)) in entries.iter().zip(&glyphs).enumerate() {
                if !entry.letters.is_empty() {
                    map.pair_with_multiple(code as u8, entry.letters.chars());
                }
                let mut steps = Vec::new();
                let place = |x: f32, y: f32| (f64::from(x), f64::from(y));
                entry.font.draw(entry.id, UNITS, &mut Pen { steps: &mut steps, place });
                let [left, low, right, high] = bounds(&steps);
                let mut content = Content::new();
                content.start_shape_glyph(entry.width(), left, low, right, high);
                if !steps.is_empty() {
                    outline(&mut content, &steps);
                    content.fill_nonzero();
                }
                let data = deflated(&content.finish())?;
                pdf.stream(*glyph, &data).filter(Filter::FlateDecode);
            }
            let data = deflated(&map.finish())?;
            pdf.stream(unicode, &data).filter(Filter::FlateDecode);
            let mut font = pdf.type3_font(id);
            // Each glyph says what it lies in.
            font.bbox(Rect::new(0.0, 0.0, 0.0, 0.0));
            let unit = (1.0 / UNITS) as f32;
            font.matrix([unit, 0.0, 0.0, unit, 0.0, 0.0]);
            font.first_char(0).last_char((entries.len() - 1) as u8);
            font.widths(entries.iter().map(Entry::width));
            font.to_unicode(unicode);
            font.resources();
            let mut procedures = font.char_procs();
            for (name, glyph) in names.iter().zip(&glyphs) {
                procedures.pair(Name(name.as_bytes()), *glyph);
            }
            drop(procedures);
            let all = names.iter().map(|name| Name(name.as_bytes()));
            font.encoding_custom().differences().consecutive(0, all);
            written.push((name_of(number), id));
        }
        Ok(written)
    }
}

/// The name of a font on a page.
pub fn name_of(number: usize) -> String {
    format!("f{number}")
}

impl Entry {
    fn width(&self) -> f32 {
        (UNITS * self.font.advance(self.id)) as f32
    }
}

/// Least and largest coordinates of a path: left, low, right, high. Its curves lie within their control points.
fn bounds(steps: &[Step]) -> [f32; 4] {
    let points = || steps.iter().flat_map(|step| step.points());
    let least = |of: fn(Point) -> f64| points().map(of).reduce(f64::min).unwrap_or(0.0) as f32;
    let most = |of: fn(Point) -> f64| points().map(of).reduce(f64::max).unwrap_or(0.0) as f32;
    [least(|at| at.0), least(|at| at.1), most(|at| at.0), most(|at| at.1)]
}

/// Bytes as a stream of a PDF holds them.
pub(super) fn deflated(bytes: &[u8]) -> Result<Vec<u8>, FigureError> {
    let failed = |error: std::io::Error| FigureError::Encode(error.to_string());
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).map_err(failed)?;
    encoder.finish().map_err(failed)
}

/// Adds a path.
pub(super) fn outline(content: &mut Content, steps: &[Step]) {
    let single = |(x, y): Point| (x as f32, y as f32);
    let mut from = (0.0, 0.0);
    for step in steps {
        match *step {
            Step::Move(to) => {
                let (x, y) = single(to);
                content.move_to(x, y);
                from = to;
            }
            Step::Line(to) => {
                let (x, y) = single(to);
                content.line_to(x, y);
                from = to;
            }
            Step::Quad(by, to) => {
                // The same curve as a cubic one, which PDF knows alone.
                let third =
                    |a: Point| (a.0 + 2.0 / 3.0 * (by.0 - a.0), a.1 + 2.0 / 3.0 * (by.1 - a.1));
                let [(a, b), (c, d), (x, y)] = [third(from), third(to), to].map(single);
                content.cubic_to(a, b, c, d, x, y);
                from = to;
            }
            Step::Cubic(by, and, to) => {
                let [(a, b), (c, d), (x, y)] = [by, and, to].map(single);
                content.cubic_to(a, b, c, d, x, y);
                from = to;
            }
            Step::Close => {
                content.close_path();
            }
        }
    }
}
