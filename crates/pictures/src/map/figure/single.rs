//! A map of one cell: its outcome and its values in words, for it has no axes.

use super::super::Map;
use super::fields::{self, Field};
use super::keys;
use super::layout::{GAP, titled};
use super::overlay::Overlay;
use crate::colours::BLACK;
use crate::drawing::canvas::stroke;
use crate::drawing::legend::{Entry, entry};
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;
use crate::drawing::swatch::Swatch;
use crate::drawing::ticks::rounded;
use crate::drawing::{COLUMN, MARGIN, caption, legend};
use topple::scene::builder::TITLES;

/// Draws the cell; `at` tells what it is a slice at.
pub fn draw(map: &Map, at: &str, print: Print) -> Picture {
    let own = map.scene.title.as_str();
    // What it is called where nobody names it is a map.
    let own = if TITLES.contains(&own) { "Outcome of one case" } else { own };
    let mut canvas = print.canvas(COLUMN);
    let end = caption::heading(&mut canvas, map.scene, &titled(print.title.unwrap_or(own), at));
    let wide = canvas.inner();
    canvas.line([(MARGIN, end + GAP), (MARGIN + wide, end + GAP)], stroke(BLACK, 0.5));
    let mut entries = keys::kinds(map.outcomes.iter(), false);
    let stands = map.outcomes.iter().all(Field::counts);
    entries.extend(stands.then(|| values(map)).into_iter().flatten());
    entries.extend(keys::overlay(&[map], Overlay::of(map, true)));
    entries.extend(keys::locked(&[map]));
    let top = (MARGIN, end + 2.0 * GAP);
    let end = legend::draw(&mut canvas, &entries, top, wide, 1);
    canvas.finish(end + MARGIN)
}

/// The values of a cell that stands, each with its symbol and its unit.
fn values(map: &Map) -> Vec<Entry> {
    let shown = fields::all()
        .filter(|field| field.moves(map.scene.isolation) && map.columns.has(field.column));
    let of = |field: &Field| {
        let value = map.outcomes.first().map_or(0.0, |cell| field.value(cell));
        let (symbol, unit) = field.label.split_once(" [").unwrap_or((field.label, ""));
        let value = rounded(value, value.abs());
        let text = format!("{}: {symbol} = {value} {}", field.title, unit.trim_end_matches(']'));
        entry(Swatch::None, text.trim_end())
    };
    shown.map(of).collect()
}
