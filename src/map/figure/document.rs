//! The SVG document: pictures of cells below, a drawn frame above; and its PNG.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use super::FigureError;
use super::raster::data_url;

/// Units of a drawing for each of the document's: the plotting library knows whole ones only.
pub const FINE: i32 = 8;

/// A rectangle of the document, px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Left edge.
    pub x: i32,
    /// Upper edge.
    pub y: i32,
    /// Width.
    pub width: i32,
    /// Height.
    pub height: i32,
}

/// Puts an SVG together: white paper, images at their places, and `drawing`, an SVG in
/// fine units, on top.
pub fn compose(size: (u32, u32), images: &[(Place, Vec<u8>)], drawing: &str) -> String {
    let (width, height) = size;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    for (place, png) in images {
        let Place { x, y, width, height } = place;
        svg.push_str(&format!(
            "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" href=\"{}\"/>\n",
            data_url(png)
        ));
    }
    // The drawing is in fine units: set to the document's size, its own view box scales it.
    let fine = FINE as u32;
    let own = format!("width=\"{}\" height=\"{}\"", width * fine, height * fine);
    let set = format!("width=\"{width}\" height=\"{height}\"");
    svg.push_str(&with_subscripts(&drawing.replacen(&own, &set, 1)));
    svg.push_str("</svg>\n");
    svg
}

/// Two documents side by side.
pub fn beside(size: (u32, u32), left: &str, right: &str) -> String {
    let (width, height) = size;
    let placed = right.replacen("<svg ", &format!("<svg x=\"{width}\" "), 1);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{height}\" \
         viewBox=\"0 0 {} {height}\">\n{left}{placed}</svg>\n",
        2 * width,
        2 * width
    )
}

/// Symbols with an index, set as such: `A_h` becomes A with a lowered h.
fn with_subscripts(drawing: &str) -> String {
    let mut text = drawing.to_string();
    for symbol in ["A_h", "A_v", "T_h", "T_v", "J_C", "m_h", "m_v", "ξ_h", "ξ_v", "α_y"] {
        let Some((letter, index)) = symbol.split_once('_') else { continue };
        let set =
            format!("{letter}<tspan baseline-shift=\"sub\" font-size=\"75%\">{index}</tspan>");
        text = text.replace(symbol, &set);
    }
    text
}

/// The fonts of the PNG: one that travels with topple, so that a picture is the same everywhere.
static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    fonts.set_sans_serif_family("Ubuntu");
    Arc::new(fonts)
});

/// Renders an SVG at `scale` pixels a unit, as a PNG.
///
/// # Errors
/// [`FigureError::Encode`].
pub fn render(svg: &str, scale: f32) -> Result<Vec<u8>, FigureError> {
    rasterise(svg, scale)?.encode_png().map_err(|e| FigureError::Encode(e.to_string()))
}

/// Renders an SVG at a pixel a unit: the pixels' red, green, blue and opacity.
///
/// # Errors
/// [`FigureError::Encode`].
pub fn pixels(svg: &str) -> Result<Vec<u8>, FigureError> {
    // The paper is white and opaque: no pixel's colour is scaled by its opacity.
    Ok(rasterise(svg, 1.0)?.take())
}

fn rasterise(svg: &str, scale: f32) -> Result<Pixmap, FigureError> {
    let failed = |e: String| FigureError::Encode(e);
    let options = Options { fontdb: Arc::clone(&FONTS), ..Options::default() };
    let tree = Tree::from_str(svg, &options).map_err(|e| failed(e.to_string()))?;
    let size = tree.size();
    let pixels = |length: f32| (length * scale).ceil() as u32;
    let mut pixmap = Pixmap::new(pixels(size.width()), pixels(size.height()))
        .ok_or_else(|| failed("no memory for the picture".into()))?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    Ok(pixmap)
}
