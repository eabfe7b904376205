//! The pixels of a picture.

use tiny_skia::{
    Color, ColorU8, FillRule, FilterQuality, LineJoin, Mask, Paint as Ink, Path, PathBuilder,
    Pattern, Pixmap, Rect, SpreadMode, StrokeDash, Transform,
};

use super::error::FigureError;
use super::picture::{Mark, Paint, Picture, Step};
use super::shapes::{Place, Stroke};
use super::{glyphs, raster};

/// Pixels an inch of a picture's PNG: what journals ask for.
const PRINT: f64 = 300.0;
/// Pixels an inch of an animation, which is shown on a screen.
const SCREEN: f64 = 150.0;
/// Millimetres of an inch.
const INCH: f64 = 25.4;

impl Picture {
    /// A PNG of 300 pixels an inch, which it says itself: a layout program places it in the SVG's size.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        let pixmap = self.pixels(PRINT)?;
        let (width, height) = (pixmap.width() as usize, pixmap.height() as usize);
        // The paper is white and opaque: no pixel's colour is scaled by its opacity.
        let (pixels, _) = pixmap.data().as_chunks::<4>();
        raster::encode((width, height), pixels, Some(PRINT as f32))
    }

    /// The pixels of a frame of an animation, with 150 an inch: red, green, blue and opacity.
    pub fn frame(&self) -> Result<Pixmap, FigureError> {
        self.pixels(SCREEN)
    }

    /// Its pixels, some an inch of paper.
    pub fn pixels(&self, per_inch: f64) -> Result<Pixmap, FigureError> {
        let side = |millimetres: f64| (millimetres / INCH * per_inch).round() as u32;
        let mut pixmap = Pixmap::new(side(self.paper.0), side(self.paper.1))
            .ok_or_else(|| FigureError::Encode("no memory for the picture".into()))?;
        pixmap.fill(Color::WHITE);
        let scale = (self.unit() / INCH * per_inch) as f32;
        let mut paper = Paper { pixmap, scale: Transform::from_scale(scale, scale) };
        paper.marks(&self.marks, None)?;
        Ok(paper.pixmap)
    }
}

/// Pixels, and how many of them a unit of the marks is.
struct Paper {
    pixmap: Pixmap,
    scale: Transform,
}

impl Paper {
    /// Draws marks, within a mask alone where there is one.
    fn marks(&mut self, marks: &[Mark], within: Option<&Mask>) -> Result<(), FigureError> {
        for mark in marks {
            match mark {
                Mark::Text { at, style, text } => {
                    let outline = glyphs::outline(*at, *style, text);
                    self.shape(&outline, Paint::Fill(style.colour, 1.0), false, within);
                }
                Mark::Image { place, png, sharp } => self.image(*place, png, *sharp, within)?,
                Mark::Clip(place, inner) => {
                    if let Some(mask) = self.cut(*place, within) {
                        self.marks(inner, Some(&mask))?;
                    }
                }
                Mark::Rectangle(..) | Mark::Path(..) | Mark::Circle(..) => {
                    if let Some((steps, paint, round)) = mark.shape() {
                        self.shape(&steps, paint, round, within);
                    }
                }
            }
        }
        Ok(())
    }

    fn shape(&mut self, steps: &[Step], paint: Paint, round: bool, within: Option<&Mask>) {
        let Some(path) = path(steps) else { return };
        let mut ink = Ink::default();
        match paint {
            Paint::Fill([r, g, b], opacity) => {
                ink.set_color_rgba8(r, g, b, (255.0 * opacity).round() as u8);
                self.pixmap.fill_path(&path, &ink, FillRule::Winding, self.scale, within);
            }
            Paint::Line(Stroke { colour: [r, g, b], width, dash }) => {
                ink.set_color_rgba8(r, g, b, 255);
                let dash = dash.map(|(dash, gap)| vec![dash as f32, gap as f32]);
                let dash = dash.and_then(|dash| StrokeDash::new(dash, 0.0));
                let line_join = if round { LineJoin::Round } else { LineJoin::Miter };
                let width = width as f32;
                let stroke = tiny_skia::Stroke { width, line_join, dash, ..Default::default() };
                self.pixmap.stroke_path(&path, &ink, &stroke, self.scale, within);
            }
        }
    }

    fn image(
        &mut self,
        place: Place,
        png: &[u8],
        sharp: bool,
        within: Option<&Mask>,
    ) -> Result<(), FigureError> {
        let ((width, height), colours) = raster::decode(png)?;
        let Some(mut pixels) = Pixmap::new(width, height) else { return Ok(()) };
        for (pixel, [r, g, b, opacity]) in pixels.pixels_mut().iter_mut().zip(colours) {
            *pixel = ColorU8::from_rgba(r, g, b, opacity).premultiply();
        }
        let (wide, high) = (width as f32, height as f32);
        let Some(area) = Rect::from_xywh(0.0, 0.0, wide, high) else { return Ok(()) };
        let quality = if sharp { FilterQuality::Nearest } else { FilterQuality::Bilinear };
        let whole = Transform::identity();
        let ink = Ink {
            shader: Pattern::new(pixels.as_ref(), SpreadMode::Pad, quality, 1.0, whole),
            ..Ink::default()
        };
        let (x, y) = (place.x as f32, place.y as f32);
        let [across, down] = [place.width as f32 / wide, place.height as f32 / high];
        let to = self.scale.pre_concat(Transform::from_row(across, 0.0, 0.0, down, x, y));
        self.pixmap.fill_rect(area, &ink, to, within);
        Ok(())
    }

    /// What lies in a place, and within the mask before.
    fn cut(&self, place: Place, within: Option<&Mask>) -> Option<Mask> {
        let path = path(&place.steps())?;
        let mask = match within {
            Some(mask) => {
                let mut mask = mask.clone();
                mask.intersect_path(&path, FillRule::Winding, true, self.scale);
                mask
            }
            None => {
                let mut mask = Mask::new(self.pixmap.width(), self.pixmap.height())?;
                mask.fill_path(&path, FillRule::Winding, true, self.scale);
                mask
            }
        };
        Some(mask)
    }
}

fn path(steps: &[Step]) -> Option<Path> {
    let mut path = PathBuilder::new();
    for step in steps {
        match *step {
            Step::Move((x, y)) => path.move_to(x as f32, y as f32),
            Step::Line((x, y)) => path.line_to(x as f32, y as f32),
            Step::Quad((a, b), (x, y)) => path.quad_to(a as f32, b as f32, x as f32, y as f32),
            Step::Cubic((a, b), (c, d), (x, y)) => {
                path.cubic_to(a as f32, b as f32, c as f32, d as f32, x as f32, y as f32);
            }
            Step::Close => path.close(),
        }
    }
    path.finish()
}
