//! Pictures on the pages of a PDF: shapes, the images of maps, and text that can be sought, copied and read aloud.

use pdf_writer::types::{LineJoinStyle, Predictor};
use pdf_writer::{Content, Filter, Name, Pdf, Rect, Ref, Str, TextStr};

use super::error::FigureError;
use super::glyphs;
use super::pdf_fonts::{self, Fonts, deflated, outline};
use super::picture::{Mark, Paint, Picture, Step};
use super::raster::{self, Packed};
use super::shapes::{Place, Point, Stroke};
use super::text::Style;
use crate::colours::{Colour, WHITE};

/// A picture on a page: where its upper left corner lies from that of the page, points, and a factor on its size.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// The picture.
    pub picture: Picture,
    /// Its left edge.
    pub x: f64,
    /// Its upper edge.
    pub y: f64,
    /// The factor.
    pub scale: f64,
}

/// Size of a page, points.
pub type Size = (f64, f64);

/// The pages as a PDF; `creator` says what they are.
///
/// # Errors
/// [`FigureError::Encode`]: an image that cannot be read.
pub fn pages(
    pages: &[Vec<Placed>],
    size: Size,
    (title, creator): (&str, &str),
) -> Result<Vec<u8>, FigureError> {
    let mut writer = Writer { pdf: Pdf::new(), last: 0, fonts: Fonts::default() };
    let (catalog, tree, info) = (writer.next(), writer.next(), writer.next());
    writer.pdf.document_info(info).title(TextStr(title)).creator(TextStr(creator));
    let numbers: Vec<Ref> = pages.iter().map(|_| writer.next()).collect();
    writer.pdf.catalog(catalog).pages(tree).lang(TextStr("en"));
    writer.pdf.pages(tree).kids(numbers.iter().copied()).count(numbers.len() as i32);
    let mut drawn = Vec::new();
    for placed in pages {
        let mut page = Page::new(size.1);
        for Placed { picture, x, y, scale } in placed {
            let (width, height) = picture.size;
            let scale = scale * picture.points().0 / width;
            page.within([scale, 0.0, 0.0, scale, *x, *y], |page| {
                let paper = Place { x: 0.0, y: 0.0, width, height };
                page.shape(&paper.steps(), Paint::Fill(WHITE, 1.0), false);
                page.marks(&picture.marks, &mut writer)
            })?;
        }
        drawn.push(page);
    }
    // All pages together have the fonts.
    let Writer { pdf, last, fonts } = &mut writer;
    let fonts = fonts.write(pdf, || {
        *last += 1;
        Ref::new(*last)
    })?;
    for (number, page) in numbers.iter().zip(drawn) {
        let contents = writer.next();
        let data = deflated(&page.content.finish())?;
        writer.pdf.stream(contents, &data).filter(Filter::FlateDecode);
        let opacities: Vec<(String, Ref)> =
            page.opacities.iter().map(|opacity| (name_of(*opacity), writer.next())).collect();
        for (opacity, (_, id)) in page.opacities.iter().zip(&opacities) {
            let share = f32::from(*opacity) / 255.0;
            writer.pdf.ext_graphics(*id).non_stroking_alpha(share).stroking_alpha(share);
        }
        let mut written = writer.pdf.page(*number);
        written.media_box(Rect::new(0.0, 0.0, size.0 as f32, size.1 as f32));
        written.parent(tree).contents(contents);
        let mut resources = written.resources();
        let mut images = resources.x_objects();
        for (name, id) in &page.images {
            images.pair(Name(name.as_bytes()), *id);
        }
        drop(images);
        let mut states = resources.ext_g_states();
        for (name, id) in &opacities {
            states.pair(Name(name.as_bytes()), *id);
        }
        drop(states);
        let mut dictionary = resources.fonts();
        for (name, id) in &fonts {
            dictionary.pair(Name(name.as_bytes()), *id);
        }
    }
    Ok(writer.pdf.finish())
}

/// The document, the last number of an object in it, and its fonts.
struct Writer {
    pdf: Pdf,
    last: i32,
    fonts: Fonts,
}

impl Writer {
    fn next(&mut self) -> Ref {
        self.last += 1;
        Ref::new(self.last)
    }

    /// An image: one with a table of colours as it is packed, any other of red, green and blue with its opacity where it is not
    /// opaque.
    fn image(&mut self, png: &[u8]) -> Result<Ref, FigureError> {
        if let Some(Packed { size: (width, height), bits, table, data }) = raster::packed(png) {
            let (id, bits, width) = (self.next(), i32::from(bits), width as i32);
            let mut image = self.pdf.image_xobject(id, &data);
            image.width(width).height(height as i32).bits_per_component(bits);
            let last = (table.len() / 3) as i32 - 1;
            image.color_space().indexed(Name(b"DeviceRGB"), last, &table);
            image.filter(Filter::FlateDecode);
            let mut packing = image.decode_parms();
            packing.predictor(Predictor::PngOptimum).colors(1);
            packing.bits_per_component(bits).columns(width);
            return Ok(id);
        }
        let ((width, height), pixels) = raster::decode(png)?;
        let has_opacity = pixels.iter().any(|[.., opacity]| *opacity < 255);
        let colours: Vec<u8> = pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
        let opacity: Option<Vec<u8>> =
            has_opacity.then(|| pixels.iter().map(|[.., opacity]| *opacity).collect());
        let (width, height) = (width as i32, height as i32);
        let (id, mask) = (self.next(), opacity.as_ref().map(|_| self.next()));
        let data = deflated(&colours)?;
        let mut image = self.pdf.image_xobject(id, &data);
        image.width(width).height(height).bits_per_component(8);
        image.color_space().device_rgb();
        image.filter(Filter::FlateDecode);
        if let Some(mask) = mask {
            image.s_mask(mask);
        }
        drop(image);
        if let (Some(mask), Some(opacity)) = (mask, opacity) {
            let data = deflated(&opacity)?;
            let mut image = self.pdf.image_xobject(mask, &data);
            image.width(width).height(height).bits_per_component(8);
            image.color_space().device_gray();
            image.filter(Filter::FlateDecode);
        }
        Ok(id)
    }
}

/// The name of an opacity of a given number of 255ths.
fn name_of(opacity: u8) -> String {
    format!("a{opacity}")
}

/// What is drawn on a page.
struct Page {
    content: Content,
    images: Vec<(String, Ref)>,
    /// Opacities other than 1, in 255ths.
    opacities: Vec<u8>,
}

/// A colour as PDF writes it.
fn rgb(colour: Colour) -> [f32; 3] {
    colour.map(|value| f32::from(value) / 255.0)
}

impl Page {
    /// An empty page whose coordinates begin in the upper left corner, as those of a picture.
    fn new(height: f64) -> Page {
        let mut content = Content::new();
        content.transform([1.0, 0.0, 0.0, -1.0, 0.0, height as f32]);
        Page { content, images: Vec::new(), opacities: Vec::new() }
    }

    /// Draws in other coordinates, and comes back to those that were.
    fn within<T>(&mut self, by: [f64; 6], draw: impl FnOnce(&mut Page) -> T) -> T {
        self.content.save_state();
        self.content.transform(by.map(|number| number as f32));
        let done = draw(self);
        self.content.restore_state();
        done
    }

    fn marks(&mut self, marks: &[Mark], to: &mut Writer) -> Result<(), FigureError> {
        for mark in marks {
            match mark {
                Mark::Rectangle(..) | Mark::Path(..) | Mark::Circle(..) => {
                    if let Some((steps, paint, round)) = mark.shape() {
                        self.shape(&steps, paint, round);
                    }
                }
                Mark::Text { at, style, text } => self.text(*at, *style, text, &mut to.fonts),
                Mark::Image { place, png, .. } => self.image(*place, to.image(png)?),
                Mark::Clip(place, inner) => {
                    self.content.save_state();
                    outline(&mut self.content, &place.steps());
                    self.content.clip_nonzero().end_path();
                    self.marks(inner, to)?;
                    self.content.restore_state();
                }
            }
        }
        Ok(())
    }

    fn through(&mut self, opacity: f64) {
        let share = (255.0 * opacity).round() as u8;
        if !self.opacities.contains(&share) {
            self.opacities.push(share);
        }
        self.content.set_parameters(Name(name_of(share).as_bytes()));
    }

    fn shape(&mut self, steps: &[Step], paint: Paint, round: bool) {
        match paint {
            Paint::Fill(colour, opacity) => {
                self.through(opacity);
                let [r, g, b] = rgb(colour);
                self.content.set_fill_rgb(r, g, b);
                outline(&mut self.content, steps);
                self.content.fill_nonzero();
            }
            Paint::Line(Stroke { colour, width, dash }) => {
                self.through(1.0);
                let [r, g, b] = rgb(colour);
                self.content.set_stroke_rgb(r, g, b).set_line_width(width as f32);
                let join = if round { LineJoinStyle::RoundJoin } else { LineJoinStyle::MiterJoin };
                self.content.set_line_join(join);
                let dash = dash.map(|(dash, gap)| [dash as f32, gap as f32]);
                self.content.set_dash_pattern(dash.into_iter().flatten(), 0.0);
                outline(&mut self.content, steps);
                self.content.stroke();
            }
        }
    }

    fn text(&mut self, at: Point, style: Style, text: &str, fonts: &mut Fonts) {
        self.through(1.0);
        let [r, g, b] = rgb(style.colour);
        self.content.set_fill_rgb(r, g, b);
        self.content.begin_text();
        let line: Vec<(glyphs::Glyph, (usize, u8))> = glyphs::line(style, text)
            .into_iter()
            .map(|glyph| {
                let code = fonts.code(&glyph);
                (glyph, code)
            })
            .collect();
        // Glyphs of one font, of one size and on one line.
        let alike = line.chunk_by(|(one, (font, _)), (next, (other, _))| {
            font == other && one.size == next.size && one.at.1 == next.at.1
        });
        for part in alike {
            let [(first, (font, _)), ..] = part else { continue };
            let (x, y) = style.turned(at, first.at);
            let (x, y) = (x as f32, y as f32);
            // The page runs downwards, letters upwards.
            self.content.set_text_matrix(match style.upwards {
                true => [0.0, -1.0, -1.0, 0.0, x, y],
                false => [1.0, 0.0, 0.0, -1.0, x, y],
            });
            let size = first.size;
            self.content.set_font(Name(pdf_fonts::name_of(*font).as_bytes()), size as f32);
            let mut shown = self.content.show_positioned();
            let mut items = shown.items();
            // Where the next glyph would be by the font alone.
            let mut end = first.at.0;
            let mut codes = Vec::new();
            for (glyph, (_, code)) in part {
                let apart = (1000.0 * (end - glyph.at.0) / size).round();
                if apart != 0.0 {
                    items.show(Str(&std::mem::take(&mut codes)));
                    items.adjust(apart as f32);
                    end -= apart * size / 1000.0;
                }
                codes.push(*code);
                end += glyph.advance;
            }
            items.show(Str(&codes));
        }
        self.content.end_text();
    }

    fn image(&mut self, place: Place, id: Ref) {
        let name = format!("i{}", self.images.len());
        self.through(1.0);
        let Place { x, y, width, height } = place;
        // An image of PDF is a unit square that begins in its lower left corner.
        self.within([width, 0.0, 0.0, -height, x, y + height], |page| {
            page.content.x_object(Name(name.as_bytes()));
        });
        self.images.push((name, id));
    }
}
