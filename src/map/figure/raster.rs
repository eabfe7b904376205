//! Cells as pixels.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::FigureError;

/// A colour.
pub type Rgba = [u8; 4];

/// An image of `width` by `height` pixels, the top row first, as a PNG.
///
/// # Errors
/// [`FigureError::Encode`].
pub fn png(
    width: usize,
    height: usize,
    pixel: impl Fn(usize, usize) -> Rgba,
) -> Result<Vec<u8>, FigureError> {
    let failed = |e: &dyn std::fmt::Display| FigureError::Encode(e.to_string());
    let side = |n: usize| u32::try_from(n).map_err(|e| failed(&e));
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side(width)?, side(height)?);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().map_err(|e| failed(&e))?;
    let mut data = Vec::with_capacity(width * height * 4);
    for row in 0..height {
        for column in 0..width {
            data.extend(pixel(column, row));
        }
    }
    writer.write_image_data(&data).map_err(|e| failed(&e))?;
    writer.finish().map_err(|e| failed(&e))?;
    Ok(bytes)
}

/// A PNG as the address of an embedded image.
pub fn data_url(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}
