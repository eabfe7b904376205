//! How a picture is printed: its title, how wide it is, how large its letters are, and its colours.

use super::canvas::Canvas;
use super::{COLUMN, FONT, MILLIMETRE};
use crate::colours::print_palette::Palette;

/// Widths that a picture may have, mm. An image of the widest takes a quarter of a gigabyte.
const WIDTHS: [f64; 2] = [40.0, 600.0];
/// Sizes that letters may have, points.
const SIZES: [f64; 2] = [4.0, 40.0];
/// Least width of a picture over the size of its letters: numbers of axes and lines of legends need it.
const LEAST: f64 = 23.0;

/// How pictures are printed. Lines and marks are as large beside letters as in a picture of which nothing is asked.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Print<'a> {
    /// The title, in the place of the picture's own.
    pub title: Option<&'a str>,
    /// Width, mm.
    width: Option<f64>,
    /// Size of letters, points.
    font_size: Option<f64>,
    /// The colours.
    pub palette: Palette,
}

/// What cannot be printed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PrintError {
    /// A width out of bounds.
    #[error("a picture is {low} to {high} mm wide, not {0}", low = WIDTHS[0], high = WIDTHS[1])]
    Width(f64),
    /// A size of letters out of bounds.
    #[error("letters are of {low} to {high} pt, not {0}", low = SIZES[0], high = SIZES[1])]
    FontSize(f64),
    /// Letters too large for the width.
    #[error("letters of {size} pt need a picture that is {least} mm wide, not {width}")]
    Narrow {
        /// Size of letters, points.
        size: f64,
        /// Width of the picture, mm.
        width: f64,
        /// Least width for these letters, mm.
        least: f64,
    },
}

impl Print<'_> {
    /// Pictures of a width, mm, with letters of a size, points; the defaults where none is given.
    pub fn new(width: Option<f64>, font_size: Option<f64>) -> Result<Print<'static>, PrintError> {
        let outside = |value: &f64, [low, high]: [f64; 2]| !(low..=high).contains(value);
        if let Some(width) = width.filter(|width| outside(width, WIDTHS)) {
            return Err(PrintError::Width(width));
        }
        if let Some(size) = font_size.filter(|size| outside(size, SIZES)) {
            return Err(PrintError::FontSize(size));
        }
        let (size, wide) = (font_size.unwrap_or(FONT), width.unwrap_or(COLUMN / MILLIMETRE));
        let least = (LEAST * size / MILLIMETRE).ceil();
        if wide < least {
            return Err(PrintError::Narrow { size, width: wide, least });
        }
        Ok(Print { width, font_size, ..Print::default() })
    }

    /// An empty picture, so many points wide where no width is requested.
    pub fn canvas(self, usual: f64) -> Canvas {
        let width = self.width.map_or(usual, |width| width * MILLIMETRE);
        let scale = self.font_size.map_or(1.0, |size| size / FONT);
        Canvas::printed(width, scale, self.palette)
    }
}
