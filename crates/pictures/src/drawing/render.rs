//! The pixels of an SVG.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{ImageHrefResolver, Options, Tree, WriteOptions};

use super::error::FigureError;
use super::{letters, raster};

/// Pixels an inch of a picture's PNG: what journals ask for.
const PRINT: f32 = 300.0;
/// Units an inch of a tree in points, and in the pixels of CSS.
pub(super) const POINTS: f32 = 72.0;
const CSS: f32 = 96.0;
/// Pixels an inch of an animation, which is shown on a screen.
const SCREEN: f32 = 150.0;

/// An SVG as a PNG of 300 pixels an inch, which it says itself: a layout program places it in the SVG's size.
///
/// # Errors
/// [`FigureError::Encode`].
pub fn png(svg: &str) -> Result<Vec<u8>, FigureError> {
    let pixmap = pixels(svg, PRINT)?;
    let (width, height) = (pixmap.width() as usize, pixmap.height() as usize);
    // The paper is white and opaque: no pixel's colour is scaled by its opacity.
    let (pixels, _) = pixmap.data().as_chunks::<4>();
    raster::encode((width, height), pixels, Some(PRINT))
}

/// The pixels of an SVG that is a frame of an animation, with 150 an inch: red, green, blue and opacity.
///
/// # Errors
/// [`FigureError::Encode`].
pub fn frame(svg: &str) -> Result<Pixmap, FigureError> {
    pixels(svg, SCREEN)
}

fn pixels(svg: &str, dpi: f32) -> Result<Pixmap, FigureError> {
    let failed = |e: String| FigureError::Encode(e);
    let tree = tree(svg, dpi)?;
    let size = tree.size();
    let mut pixmap = Pixmap::new(size.width().round() as u32, size.height().round() as u32)
        .ok_or_else(|| failed("no memory for the picture".into()))?;
    pixmap.fill(resvg::tiny_skia::Color::WHITE);
    resvg::render(&tree, Transform::identity(), &mut pixmap.as_mut());
    Ok(pixmap)
}

/// An SVG as it is drawn, of a given number of units an inch. Images that are files of their own are not read.
pub(super) fn tree(svg: &str, dpi: f32) -> Result<Tree, FigureError> {
    let resolver =
        ImageHrefResolver { resolve_string: Box::new(|_, _| None), ..ImageHrefResolver::default() };
    let options = Options {
        fontdb: letters::fonts(svg),
        dpi,
        image_href_resolver: resolver,
        ..Options::default()
    };
    Tree::from_str(svg, &options).map_err(|e| FigureError::Encode(e.to_string()))
}

/// The same picture in the same size without text: its letters are paths, so that it needs no font. A picture with letters that
/// no font of this machine has keeps its text. Nothing that acts or points out of the document is left in it.
///
/// # Errors
/// [`FigureError::Encode`]: no SVG.
pub fn outlined(svg: &str) -> Result<String, FigureError> {
    let options = WriteOptions {
        coordinates_precision: 3,
        preserve_text: letters::missing(svg).is_some(),
        ..WriteOptions::default()
    };
    let tree = tree(svg, CSS)?;
    let (width, height) = (tree.size().width(), tree.size().height());
    let text = tree.to_string(&options);
    // A length without a unit is of 1/96 inch in a browser, and a point in programs that lay out print.
    let (_, rest) =
        text.split_once(" xmlns=").ok_or_else(|| FigureError::Encode(NO_ROOT.into()))?;
    let millimetres = |length: f32| format!("{:.3}", 25.4 * length / CSS);
    let (mm_w, mm_h) = (millimetres(width), millimetres(height));
    Ok(format!(
        "<svg width=\"{mm_w}mm\" height=\"{mm_h}mm\" viewBox=\"0 0 {width} {height}\" xmlns={rest}"
    ))
}

const NO_ROOT: &str = "an SVG without its root";

/// Width and height of a picture, points.
///
/// # Errors
/// [`FigureError::Encode`]: no SVG.
pub fn size(svg: &str) -> Result<(f64, f64), FigureError> {
    let size = tree(svg, POINTS)?.size();
    Ok((size.width().into(), size.height().into()))
}
