//! The overturning map, in the manner of the paper's Fig. 11.

use super::super::Map;
use super::islands::islands;
use super::layout::{begin, frame, titled};
use super::overlay::Overlay;
use super::{keys, layout};
use crate::colours::Colour;
use crate::colours::palette::Kind;
use crate::drawing::canvas::{Canvas, Place};
use crate::drawing::error::FigureError;
use crate::drawing::frame::{BELOW, BOTH};
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;
use crate::drawing::raster::png;
use crate::drawing::{MARGIN, legend, swatch};
use topple::stepping::outcome::Outcome;

/// Draws the map; `at` tells what it is a slice at.
pub fn draw(map: &Map, at: &str, print: Print) -> Result<Picture, FigureError> {
    let (mut canvas, place) =
        begin(map, &titled(print.title.unwrap_or(&map.scene.title), at), print);
    let wide = canvas.inner();
    let overlay = Overlay::of(map, true);
    let rings = paint(&mut canvas, map, place, overlay, Kind::of, Kind::colour)?;
    frame(place, &map.grid).draw(&mut canvas, BOTH);
    let mut entries = keys::kinds(map.outcomes.iter(), true);
    entries.extend(keys::overlay(&[map], overlay));
    entries.extend((rings > 0).then(keys::ring));
    let top = place.bottom() + BELOW + layout::GAP;
    let end = legend::draw(&mut canvas, &entries, (MARGIN, top), wide, 2);
    Ok(canvas.finish(end + MARGIN))
}

/// Draws the cells of a map in the colours of their kinds, what lies over them, and rings around what is too
/// small; returns how many rings there are.
pub fn paint<K: PartialEq>(
    canvas: &mut Canvas,
    map: &Map,
    place: Place,
    overlay: Overlay,
    kind: impl Fn(&Outcome) -> K,
    colour: impl Fn(K) -> Colour,
) -> Result<usize, FigureError> {
    let palette = canvas.palette();
    canvas.image(place, &cells(map, |cell| palette.of(colour(kind(cell))))?, true);
    if let Some(image) = overlay.image(map, place, palette)? {
        canvas.image(place, &image, false);
    }
    let rings = islands(map, place, kind);
    canvas.clipped(place, |canvas| rings.iter().for_each(|at| swatch::ring(canvas, *at)));
    Ok(rings.len())
}

/// The cells of a map in the colours of their outcomes, as an image.
pub fn cells(map: &Map, colour: impl Fn(&Outcome) -> Colour) -> Result<Vec<u8>, FigureError> {
    let (columns, rows) = map.grid.shape();
    png((columns, rows), |column, row| {
        let [r, g, b] = colour(&map.outcomes[(rows - 1 - row) * columns + column]);
        [r, g, b, 255]
    })
}
