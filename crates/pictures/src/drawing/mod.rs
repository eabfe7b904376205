//! How every picture is drawn: maps, curves, histories, the paper's figures and charts.
//!
//! A picture is a list of marks, of which an SVG is written in points of its printed size, [`COLUMN`] wide where it is to stand in a column of a
//! journal, a PNG of the same with 300 pixels an inch, and a place on a page of a PDF. Letters are of [`FONT`] or larger, indices of
//! [`SMALLEST`], as journals ask for, unless a [print](print::Print) asks for another width or size: coordinates
//! are then in points of a picture whose letters are of [`FONT`]. The colours of outcomes are there for other pictures, too.

pub mod canvas;
pub mod caption;
pub mod error;
pub(crate) mod font;
pub mod frame;
mod glyphs;
pub mod legend;
pub mod letters;
pub mod pdf;
mod pdf_fonts;
pub mod picture;
mod pixels;
pub mod print;
pub mod raster;
mod read;
pub(crate) mod scale;
pub mod shapes;
pub mod share;
pub(crate) mod svg;
pub mod swatch;
pub mod text;
pub mod ticks;

/// Points of a millimetre.
pub const MILLIMETRE: f64 = 72.0 / 25.4;
/// Width of a picture for a column of a journal: 90 mm.
pub const COLUMN: f64 = 90.0 * MILLIMETRE;
/// Width of a picture across both columns: 190 mm.
pub const PAGE: f64 = 190.0 * MILLIMETRE;
/// Size of letters, points.
pub const FONT: f64 = 7.0;
/// Size of a title's letters.
pub const TITLE: f64 = 8.0;
/// Size of the letters of an index: the least that journals accept.
pub const SMALLEST: f64 = 6.0;
/// From one line of text to the next, over its size.
pub const LEADING: f64 = 1.3;
/// White margin around a picture.
pub const MARGIN: f64 = 5.0;
