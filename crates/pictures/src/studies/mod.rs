//! Pictures of studies: a suite's spectra, an envelope, a fragility, a hazard curve, a probability.

pub mod comparison;
pub mod envelope;
pub mod envelope_curves;
pub mod fragility;
pub mod hazard;
pub mod probability;
pub(crate) mod shades;
pub mod suite;

use crate::drawing::MARGIN;
use crate::drawing::canvas::Canvas;
use crate::drawing::legend::{self, entry};
use crate::drawing::swatch::Swatch;
use topple_studies::suites::envelope::CellEnvelope;

/// Says below a legend that strokes leave out the motions that overturn the block, where some do; returns where the legend ends.
fn of_standing<'a>(
    canvas: &mut Canvas,
    mut cells: impl Iterator<Item = &'a CellEnvelope>,
    end: f64,
    wide: f64,
) -> f64 {
    if !cells.any(|cell| cell.overturned > 0.0) {
        return end;
    }
    let text = "Strokes: of the motions under which the block stands. A motion that overturns it is left out, and may move the base farther.";
    legend::draw(canvas, &[entry(Swatch::None, text)], (MARGIN, end), wide, 1)
}
