//! What a path through a map meets: impact counts, and outcomes as a strip.

use topple::scene::Values;
use topple_pictures::colours::palette::{Kind, Parity};
use topple_pictures::drawing::canvas::write;
use topple_pictures::drawing::canvas::{Canvas, Place};
use topple_pictures::drawing::caption::bounded;
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::frame::{Axis, BELOW, BOTH, Frame, LEFT, Written};
use topple_pictures::drawing::legend::{self, entry};
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::raster::png;
use topple_pictures::drawing::swatch::{Mark, Swatch};
use topple_pictures::drawing::text::{style, wrapped};
use topple_pictures::drawing::{COLUMN, FONT, MARGIN, TITLE};
use topple_pictures::map::Map;
use topple_pictures::map::figure::keys;

/// Heights of the plot and of the strip of outcomes below.
const HEIGHT: f64 = 100.0;
const STRIP: f64 = 11.0;
const GAP: f64 = 5.0;

/// Draws what a path meets: impact counts above, outcomes as a strip below. The map is one
/// column wide.
pub fn draw(title: &str, map: &Map, caption: &str) -> Result<Picture, FigureError> {
    let rows = map.grid.y().map_or_else(|| Values::from(0.0), |axis| axis.values.clone());
    let fallen = || map.outcomes.iter().enumerate().filter(|(_, cell)| cell.class.overturned());
    let most = fallen().map(|(_, cell)| cell.impacts).max().unwrap_or(1).max(10);
    let mut canvas = Canvas::new(COLUMN);
    let whole = COLUMN - 2.0 * MARGIN;
    let y = write(&mut canvas, (MARGIN, MARGIN), style(TITLE), &bounded(title, TITLE, whole));
    let y = write(&mut canvas, (MARGIN, y), style(FONT), &wrapped(caption, FONT, whole)) + GAP;
    let place = Place { x: MARGIN + LEFT, y, width: whole - LEFT - 6.0, height: HEIGHT };
    let x = Axis::new(rows.first(), rows.last(), "A_h [m/s²]");
    let impacts = Axis::log(0.9, 1.25 * f64::from(most), "impacts before overturning");
    let frame = Frame::new(place, x.clone(), impacts);
    for (row, cell) in fallen().filter(|(_, cell)| cell.impacts > 0) {
        let at = frame.at((rows.value(row), f64::from(cell.impacts).log10()));
        canvas.disc(at, 0.7, Parity::of(cell).colour());
    }
    frame.draw(&mut canvas, Written { x: false, ..BOTH });
    // The strip lies: a row of the map is a column of it.
    let strip = png((map.outcomes.len(), 1), |column, _| {
        let [r, g, b] = Kind::of(&map.outcomes[column]).colour();
        [r, g, b, 255]
    })?;
    let below = Place { y: place.bottom() + GAP, height: STRIP, ..place };
    canvas.image(below, &strip, true);
    Frame::new(below, x, Axis::of(None)).draw(&mut canvas, BOTH);
    let marks = [Parity::Odd, Parity::Even, Parity::Rested]
        .into_iter()
        .filter(|parity| fallen().any(|(_, cell)| cell.impacts > 0 && Parity::of(cell) == *parity));
    let marks =
        marks.map(|parity| entry(Swatch::Mark(Mark::Disc, parity.colour()), parity.label()));
    let entries: Vec<_> = marks.chain(keys::kinds(map.outcomes.iter(), true)).collect();
    let end = legend::draw(&mut canvas, &entries, (MARGIN, below.bottom() + BELOW + GAP), whole, 2);
    Ok(canvas.finish(end + MARGIN))
}
