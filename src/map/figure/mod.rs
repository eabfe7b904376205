//! Pictures: a raster of the cells under a vector frame, as SVG, and the same as PNG.

pub mod curves;
pub mod document;
pub mod field;
pub mod fields;
pub mod frame;
pub mod greys;
pub mod history;
pub mod labels;
pub mod overturning;
pub mod palette;
pub mod raster;

/// A tick's label on an axis that is `width` wide: no more digits than tell ticks apart.
pub(super) fn tick(value: f64, width: f64) -> String {
    if value.abs() < 1.0e-9 * width {
        return "0".into();
    }
    let digits = (2.0 - width.log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.digits$}");
    if digits == 0 {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

/// Why a picture was not made.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The plotting library refused.
    #[error("the figure could not be drawn: {0}")]
    Draw(String),
    /// The picture could not be encoded.
    #[error("the picture could not be encoded: {0}")]
    Encode(String),
}
