//! Colours: of classes of cells, of curves, of numbers between two ends, and what stands for them in a print without colours.

pub mod palette;
pub mod print_palette;
pub mod ramp;

/// Red, green and blue.
pub type Colour = [u8; 3];

/// Black.
pub const BLACK: Colour = [0, 0, 0];
/// White.
pub const WHITE: Colour = [255, 255, 255];
