//! SVG documents on the pages of a PDF: paths, text as paths, and the images of maps. Any other paint than a colour has no
//! place in the pictures of topple and is left out.

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Filter, Name, Pdf, Rect, Ref, TextStr};
use png::{ColorType, Decoder, Transformations};
use resvg::tiny_skia::{self, PathSegment, Point, Transform};
use resvg::usvg::{FillRule, Group, Image, ImageKind, LineCap, LineJoin, Node, Paint, Path};

use super::error::FigureError;
use super::render;

/// An SVG on a page: where its upper left corner lies from that of the page, points, and a factor on its size.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// The document.
    pub svg: String,
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
/// [`FigureError::Encode`]: an SVG or an image that cannot be read.
pub fn pages(
    pages: &[Vec<Placed>],
    size: Size,
    (title, creator): (&str, &str),
) -> Result<Vec<u8>, FigureError> {
    let mut writer = Writer { pdf: Pdf::new(), last: 0 };
    let (catalog, tree, info) = (writer.next(), writer.next(), writer.next());
    writer.pdf.document_info(info).title(TextStr(title)).creator(TextStr(creator));
    let numbers: Vec<Ref> = pages.iter().map(|_| writer.next()).collect();
    writer.pdf.catalog(catalog).pages(tree);
    writer.pdf.pages(tree).kids(numbers.iter().copied()).count(numbers.len() as i32);
    for (number, placed) in numbers.iter().zip(pages) {
        let mut page = Page::new(size.1);
        for one in placed {
            let tree = render::tree(&one.svg, render::POINTS)?;
            let scale = one.scale as f32;
            let place = Transform::from_row(scale, 0.0, 0.0, scale, one.x as f32, one.y as f32);
            page.within(place, |page| page.group(tree.root(), &mut writer, 1.0))?;
        }
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
    }
    Ok(writer.pdf.finish())
}

/// The document, and the last number of an object in it.
struct Writer {
    pdf: Pdf,
    last: i32,
}

impl Writer {
    fn next(&mut self) -> Ref {
        self.last += 1;
        Ref::new(self.last)
    }

    /// An image of red, green and blue, and its opacity where it is not opaque.
    fn image(&mut self, png: &[u8]) -> Result<Ref, FigureError> {
        let failed = |error: png::DecodingError| FigureError::Encode(error.to_string());
        let mut decoder = Decoder::new(std::io::Cursor::new(png));
        decoder.set_transformations(Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().map_err(failed)?;
        let size = reader
            .output_buffer_size()
            .ok_or_else(|| FigureError::Encode("no memory for an image".into()))?;
        let mut bytes = vec![0; size];
        let frame = reader.next_frame(&mut bytes).map_err(failed)?;
        let channels = frame.color_type.samples();
        let is_grey = matches!(frame.color_type, ColorType::Grayscale | ColorType::GrayscaleAlpha);
        let has_opacity = matches!(frame.color_type, ColorType::Rgba | ColorType::GrayscaleAlpha);
        let pixels = bytes[..frame.buffer_size()].chunks_exact(channels);
        let colours: Vec<u8> = pixels
            .clone()
            .flat_map(|pixel| if is_grey { [pixel[0]; 3] } else { [pixel[0], pixel[1], pixel[2]] })
            .collect();
        let opacity: Option<Vec<u8>> =
            has_opacity.then(|| pixels.map(|pixel| pixel[channels - 1]).collect());
        let (width, height) = (frame.width as i32, frame.height as i32);
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

fn deflated(bytes: &[u8]) -> Result<Vec<u8>, FigureError> {
    let failed = |error: std::io::Error| FigureError::Encode(error.to_string());
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).map_err(failed)?;
    encoder.finish().map_err(failed)
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

impl Page {
    /// An empty page whose coordinates begin in the upper left corner, as those of an SVG.
    fn new(height: f64) -> Page {
        let mut content = Content::new();
        content.transform([1.0, 0.0, 0.0, -1.0, 0.0, height as f32]);
        Page { content, images: Vec::new(), opacities: Vec::new() }
    }

    /// Draws in other coordinates, and comes back to those that were.
    fn within<T>(&mut self, by: Transform, draw: impl FnOnce(&mut Page) -> T) -> T {
        self.content.save_state();
        self.content.transform([by.sx, by.ky, by.kx, by.sy, by.tx, by.ty]);
        let done = draw(self);
        self.content.restore_state();
        done
    }

    fn group(&mut self, group: &Group, to: &mut Writer, opacity: f32) -> Result<(), FigureError> {
        let opacity = opacity * group.opacity().get();
        self.within(group.transform(), |page| {
            if let Some(clip) = group.clip_path() {
                page.clip(clip.root(), clip.transform());
                page.content.clip_nonzero().end_path();
            }
            for node in group.children() {
                match node {
                    Node::Group(inner) => page.group(inner, to, opacity)?,
                    Node::Path(path) => page.path(path, opacity),
                    Node::Image(image) => page.image(image, to)?,
                    Node::Text(text) => page.group(text.flattened(), to, opacity)?,
                }
            }
            Ok(())
        })
    }

    /// Adds the paths of a clip to the current one.
    fn clip(&mut self, group: &Group, by: Transform) {
        let by = by.pre_concat(group.transform());
        for node in group.children() {
            match node {
                Node::Group(inner) => self.clip(inner, by),
                Node::Path(path) => {
                    if let Some(path) = path.data().clone().transform(by) {
                        self.outline(&path);
                    }
                }
                Node::Image(_) | Node::Text(_) => {}
            }
        }
    }

    fn outline(&mut self, path: &tiny_skia::Path) {
        let mut from = Point::zero();
        for segment in path.segments() {
            match segment {
                PathSegment::MoveTo(p) => {
                    self.content.move_to(p.x, p.y);
                    from = p;
                }
                PathSegment::LineTo(p) => {
                    self.content.line_to(p.x, p.y);
                    from = p;
                }
                PathSegment::QuadTo(q, p) => {
                    // The same curve as a cubic one, which PDF knows alone.
                    let third = |a: f32, b: f32| a + 2.0 / 3.0 * (b - a);
                    let (x1, y1) = (third(from.x, q.x), third(from.y, q.y));
                    let (x2, y2) = (third(p.x, q.x), third(p.y, q.y));
                    self.content.cubic_to(x1, y1, x2, y2, p.x, p.y);
                    from = p;
                }
                PathSegment::CubicTo(a, b, p) => {
                    self.content.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y);
                    from = p;
                }
                PathSegment::Close => {
                    self.content.close_path();
                }
            }
        }
    }

    fn through(&mut self, opacity: f32) {
        let share = (255.0 * opacity).round() as u8;
        if !self.opacities.contains(&share) {
            self.opacities.push(share);
        }
        self.content.set_parameters(Name(name_of(share).as_bytes()));
    }

    fn path(&mut self, path: &Path, opacity: f32) {
        if !path.is_visible() {
            return;
        }
        let share = |value: u8| f32::from(value) / 255.0;
        if let Some(fill) = path.fill()
            && let Paint::Color(colour) = fill.paint()
        {
            self.through(opacity * fill.opacity().get());
            let [r, g, b] = [colour.red, colour.green, colour.blue].map(share);
            self.content.set_fill_rgb(r, g, b);
            self.outline(path.data());
            match fill.rule() {
                FillRule::NonZero => self.content.fill_nonzero(),
                FillRule::EvenOdd => self.content.fill_even_odd(),
            };
        }
        if let Some(stroke) = path.stroke()
            && let Paint::Color(colour) = stroke.paint()
        {
            self.through(opacity * stroke.opacity().get());
            let [r, g, b] = [colour.red, colour.green, colour.blue].map(share);
            self.content.set_stroke_rgb(r, g, b).set_line_width(stroke.width().get());
            self.content.set_line_cap(match stroke.linecap() {
                LineCap::Butt => LineCapStyle::ButtCap,
                LineCap::Round => LineCapStyle::RoundCap,
                LineCap::Square => LineCapStyle::ProjectingSquareCap,
            });
            self.content.set_line_join(match stroke.linejoin() {
                LineJoin::Round => LineJoinStyle::RoundJoin,
                LineJoin::Bevel => LineJoinStyle::BevelJoin,
                _ => LineJoinStyle::MiterJoin,
            });
            let dashes = stroke.dasharray().unwrap_or_default();
            self.content.set_dash_pattern(dashes.iter().copied(), stroke.dashoffset());
            self.outline(path.data());
            self.content.stroke();
        }
    }

    fn image(&mut self, image: &Image, to: &mut Writer) -> Result<(), FigureError> {
        let ImageKind::PNG(bytes) = image.kind() else { return Ok(()) };
        let id = to.image(bytes)?;
        let name = format!("i{}", self.images.len());
        let (width, height) = (image.size().width(), image.size().height());
        self.through(1.0);
        // An image of PDF is a unit square that begins in its lower left corner.
        let place = Transform::from_row(width, 0.0, 0.0, -height, 0.0, height);
        self.within(place, |page| {
            page.content.x_object(Name(name.as_bytes()));
        });
        self.images.push((name, id));
        Ok(())
    }
}
