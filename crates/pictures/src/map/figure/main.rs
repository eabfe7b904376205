//! The picture that stands for a map.

use super::super::Map;
use super::{curves, field, fields, overturning, single};
use crate::drawing::error::FigureError;
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;

/// Draws the picture of a map that stands for all of it: its outcomes for a pulse, the rocking index for a
/// record where it was requested; of one axis curves, of one cell its values. `at` tells what the map is a slice at.
pub fn draw(map: &Map, at: &str, print: Print) -> Result<Picture, FigureError> {
    let rocking_index = &fields::FIELDS[0];
    if map.grid.len() == 1 {
        Ok(single::draw(map, at, print))
    } else if let Some(axis) = map.grid.line() {
        curves::draw(map, axis, print)
    } else if map.scene.excitation.record().is_none() || !map.columns.has(rocking_index.column) {
        overturning::draw(map, at, print)
    } else {
        field::draw(map, rocking_index, at, print)
    }
}
