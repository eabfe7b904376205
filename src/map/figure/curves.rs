//! A sweep of one axis: the rocking index and the displacements as curves, the outcomes as a strip.

use std::borrow::Cow;
use std::collections::BTreeSet;

use plotters::prelude::*;

use super::super::Map;
use super::FigureError;
use super::document::{FINE, Place};
use super::fields::{FIELDS, Field};
use super::frame::{
    Area, Axes, Drawn, Named, along, at, document, extent, frame, heading, outline, stroke, text,
};
use super::overturning::{hatch_labels, hatched};
use super::palette::Kind;
use super::raster::png;
use crate::scene::grid::Axis;
use crate::stepping::outcome::{Class, Outcome, Status};

/// Size of the figure.
const SIZE: (u32, u32) = (960, 758);
/// Size of the axes' numbers.
const FONT: i32 = 13;
/// The plots' left ends, their width, and the top of the first.
const LEFT: i32 = 96;
const WIDTH: i32 = 604;
const TOP: i32 = 76;
/// Height of a curve's plot, and distance of two.
const HEIGHT: i32 = 168;
const APART: i32 = 14;
/// Height of the strip of outcomes.
const STRIP: i32 = 26;

/// What is drawn: max|v|, which holds the static deflection, tells less than the stroke.
const SHOWN: [&Field; 3] = [&FIELDS[0], &FIELDS[1], &FIELDS[3]];

/// Where the k-th plot lies.
fn plot(k: usize) -> Place {
    Place { x: LEFT, y: TOP + k as i32 * (HEIGHT + APART), width: WIDTH, height: HEIGHT }
}

/// Where the strip lies.
fn strip() -> Place {
    Place { y: TOP + SHOWN.len() as i32 * (HEIGHT + APART), height: STRIP, ..plot(0) }
}

/// Draws the curves along the axis of a map's cells as SVG.
///
/// # Errors
/// Any [`FigureError`].
pub fn draw(map: &Map, axis: &Axis) -> Result<String, FigureError> {
    let colours = png(map.outcomes.len(), 1, |column, _| {
        let [r, g, b] = Kind::of(&map.outcomes[column]).colour();
        [r, g, b, 255]
    })?;
    let kinds: BTreeSet<Kind> = map.outcomes.iter().map(Kind::of).collect();
    let line = map.grid.along_line().unwrap_or_else(|| map.grid.clone());
    let line = Map { scene: map.scene, grid: line, outcomes: Cow::Borrowed(&map.outcomes) };
    let mut images = vec![(strip(), colours)];
    images.extend(hatched(&line, strip())?.map(|hatch| (strip(), hatch)));
    document(SIZE, &images, |root| {
        heading(root, LEFT, map.scene, &map.scene.title)?;
        for (k, field) in SHOWN.iter().enumerate() {
            paint(root, (map, axis), field, plot(k))?;
        }
        let below = Axes { size: SIZE, plot: strip(), room: (None, Some(48)), font: FONT };
        along(root, axis, &below)?;
        legend(root, map, &kinds)
    })
}

/// Draws a curve with its axes: points that belong together with a line between.
fn paint(root: &Area, (map, axis): (&Map, &Axis), field: &Field, place: Place) -> Drawn<()> {
    let values = &axis.values;
    let known = map.outcomes.iter().filter(|cell| field.counts(cell)).map(field.value);
    let most = known.fold(0.0, f64::max);
    // Where no cell stands, or nothing moves, there is no scale to go by.
    let most = if most > 0.0 { most } else { 1.0 };
    let x = Named { ends: extent(values), name: String::new() };
    let y = Named { ends: 0.0..1.06 * most, name: field.label.into() };
    let set = Axes { size: SIZE, plot: place, room: (Some(LEFT - 16), None), font: FONT };
    let mut plot = frame(root, &set, (&x, &y))?;
    let points: Vec<Option<(f64, f64)>> = map
        .outcomes
        .iter()
        .enumerate()
        .map(|(i, cell)| {
            field.counts(cell).then(|| (values.coordinate(i as f64), (field.value)(cell)))
        })
        .collect();
    for part in points.split(Option::is_none) {
        let line = part.iter().flatten().copied();
        plot.draw_series(LineSeries::new(line, stroke(RGBColor(0x2c, 0x5f, 0xb8), 14)))?;
    }
    if points.len() <= WIDTH as usize / 6 {
        let dots =
            points.iter().flatten().map(|point| Circle::new(*point, 2 * FINE, BLACK.filled()));
        plot.draw_series(dots)?;
    }
    outline(root, place, 10)
}

fn legend(root: &Area, map: &Map, kinds: &BTreeSet<Kind>) -> Drawn<()> {
    let (left, mut top) = (LEFT + WIDTH + 22, TOP + 4);
    for kind in kinds {
        let [r, g, b] = kind.colour();
        let swatch = [at(left, top), at(left + 24, top + 16)];
        root.draw(&Rectangle::new(swatch, RGBColor(r, g, b).filled()))?;
        outline(root, Place { x: left, y: top, width: 24, height: 16 }, 10)?;
        root.draw(&Text::new(kind.label(), at(left + 32, top + 1), text(15)))?;
        top += 25;
    }
    let has = |test: fn(&Outcome) -> bool| map.outcomes.iter().any(test);
    let mut notes: Vec<String> = Vec::new();
    if map.has_beyond_the_model() {
        notes.push("hatched:".into());
        notes.extend(hatch_labels(map).map(|label| label.trim_end_matches(':').to_string()));
    }
    if has(|cell| cell.class == Class::Unresolved) {
        notes.push("crossed: unresolved".into());
    }
    if has(|cell| cell.status == Status::VerticalLocked) {
        notes.push("some vertically rigid for".into());
        notes.push("this record: locked".into());
    }
    if has(|cell| cell.class.overturned()) {
        notes.push("u and v of cells that stand".into());
    }
    for note in notes {
        top += 20;
        root.draw(&Text::new(note, at(left, top), text(14)))?;
    }
    Ok(())
}
