//! A sweep of one axis: the rocking index and the displacements as curves, the outcomes as a strip.

use std::borrow::Cow;

use super::super::Map;
use super::fields::{FIELDS, Field};
use super::layout::{GAP, side};
use super::overlay::Overlay;
use super::{keys, overturning};
use crate::colours::BLACK;
use crate::colours::palette::{CURVES, Kind};
use crate::drawing::canvas::{Canvas, Place, Point, stroke};
use crate::drawing::error::FigureError;
use crate::drawing::frame::{Axis, BELOW, BOTH, Frame, Written};
use crate::drawing::legend::{Entry, entry};
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;
use crate::drawing::swatch::Swatch;
use crate::drawing::text::style;
use crate::drawing::{COLUMN, FONT, MARGIN, caption, legend};
use topple::scene::builder::TITLES;
use topple::scene::grid;
use topple::stepping::outcome::Status;

/// Height of a curve's plot, and of the strip of outcomes.
const HEIGHT: f64 = 64.0;
const STRIP: f64 = 12.0;
/// Most cells whose points are marked.
const MARKED: usize = 60;

/// What is drawn: max |v|, which holds the static deflection, tells less than the stroke.
const SHOWN: [&Field; 3] = [&FIELDS[0], &FIELDS[1], &FIELDS[3]];

/// Draws the curves along the axis of a map's cells.
pub fn draw(map: &Map, axis: &grid::Axis, print: Print) -> Result<Picture, FigureError> {
    let mut canvas = print.canvas(COLUMN);
    let wide = canvas.inner();
    let along = format!("Rocking index, displacements and outcomes along {}", axis.entry().symbol);
    let title = match (print.title, map.scene.title.as_str()) {
        (Some(title), _) => title.into(),
        // What it is called where nobody names it is a map.
        (None, title) if TITLES.contains(&title) => along,
        (None, title) => format!("{title}: {}", along.replacen('R', "r", 1)),
    };
    let (x, width) = side(&canvas);
    let mut y = caption::heading(&mut canvas, map.scene, &title) + GAP;
    let directions = map.scene.isolation;
    let shown = |field: &&Field| field.moves(directions) && map.columns.has(field.column);
    for field in SHOWN.into_iter().filter(shown) {
        let place = Place { x, y, width, height: HEIGHT };
        paint(&mut canvas, map, axis, field, place);
        y += HEIGHT + GAP;
    }
    let place = Place { x, y, width, height: STRIP };
    let line = map.grid.along_line().unwrap_or_else(|| map.grid.clone());
    let outcomes = Cow::Borrowed(&map.outcomes[..]);
    let line = Map { scene: map.scene, grid: line, outcomes, columns: map.columns };
    let overlay = Overlay::of(&line, true);
    overturning::paint(&mut canvas, &line, place, overlay, Kind::of, Kind::colour)?;
    Frame::new(place, Axis::of(Some(axis)), Axis::of(None)).draw(&mut canvas, BOTH);
    let mut entries = keys::kinds(map.outcomes.iter(), true);
    entries.extend(keys::overlay(&[&line], overlay));
    entries.extend(remarks(map));
    let top = place.bottom() + BELOW + GAP;
    let end = legend::draw(&mut canvas, &entries, (MARGIN, top), wide, 2);
    Ok(canvas.finish(end + MARGIN))
}

/// Draws a curve with its axes: points that belong together with a line between.
fn paint(canvas: &mut Canvas, map: &Map, axis: &grid::Axis, field: &Field, place: Place) {
    let known =
        map.outcomes.iter().filter(|cell| Field::counts(cell)).map(|cell| field.value(cell));
    let most = known.fold(0.0, f64::max);
    // Where no cell stands, or nothing moves, there is no scale to go by.
    let most = if most > 0.0 { most } else { 1.0 };
    let frame = Frame::new(place, Axis::of(Some(axis)), Axis::new(0.0, 1.06 * most, field.label));
    let points: Vec<Option<Point>> = map
        .outcomes
        .iter()
        .enumerate()
        .map(|(i, cell)| {
            let at = (axis.values.coordinate(i as f64), field.value(cell));
            Field::counts(cell).then(|| frame.at(at))
        })
        .collect();
    for part in points.split(Option::is_none) {
        canvas.line(part.iter().flatten().copied(), stroke(CURVES[0], 0.8));
    }
    for (k, point) in points.iter().enumerate() {
        // A point between two that have no value would not be seen.
        let beside = |k: Option<usize>| k.and_then(|k| points.get(k)).is_some_and(Option::is_some);
        let alone = !beside(k.checked_sub(1)) && !beside(Some(k + 1));
        if let Some(point) = point
            && (points.len() <= MARKED || alone)
        {
            canvas.disc(*point, 1.0, BLACK);
        }
    }
    if points.iter().all(Option::is_none) {
        let middle = (place.x + 0.5 * place.width, place.y + 0.5 * place.height);
        canvas.text(middle, style(FONT).middle(), "no cell stands");
    }
    frame.draw(canvas, Written { x: false, ..BOTH });
}

/// What is said below the classes.
fn remarks(map: &Map) -> Vec<Entry> {
    let mut remarks = Vec::new();
    if map.outcomes.iter().any(|cell| cell.class.overturned()) {
        remarks.push(entry(Swatch::None, "Curves are of the cells that stand."));
    }
    if map.outcomes.iter().any(|cell| cell.status == Status::VerticalLocked) {
        let locked = "Of some cells the vertical isolation is rigid for this record: it is locked.";
        remarks.push(entry(Swatch::None, locked));
    }
    remarks
}
