//! The picture that stands for a map.

use super::super::Map;
use super::{curves, field, fields, overturning};
use crate::drawing::error::FigureError;

/// Draws the picture of a map that stands for all of it as SVG: its outcomes for a pulse, the rocking index for a
/// record; of one axis curves. `at` tells what the map is a slice at.
///
/// # Errors
/// Any [`FigureError`].
pub fn draw(map: &Map, at: &str) -> Result<String, FigureError> {
    if let Some(axis) = map.grid.line() {
        curves::draw(map, axis)
    } else if map.scene.excitation.record().is_none() {
        overturning::draw(map, at)
    } else {
        field::draw(map, &fields::FIELDS[0], at)
    }
}
