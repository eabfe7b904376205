//! The pixels of an SVG.

use std::sync::{Arc, LazyLock};

use png::Compression;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use super::error::FigureError;
use super::{font, raster};

/// Pixels an inch of a picture's PNG: what journals ask for.
const PRINT: f32 = 300.0;
/// Pixels an inch of an animation, which is shown on a screen.
const SCREEN: f32 = 150.0;

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(font::BYTES.to_vec());
    fonts.set_sans_serif_family("Ubuntu");
    Arc::new(fonts)
});

/// An SVG as a PNG of 300 pixels an inch.
///
/// # Errors
/// [`FigureError::Encode`].
pub fn png(svg: &str) -> Result<Vec<u8>, FigureError> {
    let pixmap = pixels(svg, PRINT)?;
    let (width, height) = (pixmap.width() as usize, pixmap.height() as usize);
    // The paper is white and opaque: no pixel's colour is scaled by its opacity.
    let (pixels, _) = pixmap.data().as_chunks::<4>();
    raster::encode((width, height), pixels, Compression::High)
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
    let options = Options { fontdb: Arc::clone(&FONTS), dpi, ..Options::default() };
    let tree = Tree::from_str(svg, &options).map_err(|e| failed(e.to_string()))?;
    let size = tree.size();
    let mut pixmap = Pixmap::new(size.width().round() as u32, size.height().round() as u32)
        .ok_or_else(|| failed("no memory for the picture".into()))?;
    pixmap.fill(resvg::tiny_skia::Color::WHITE);
    resvg::render(&tree, Transform::identity(), &mut pixmap.as_mut());
    Ok(pixmap)
}
