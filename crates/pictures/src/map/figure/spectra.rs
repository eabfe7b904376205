//! The spectra of a map: the least values of the second axis at which the block lifts and overturns, and the rocking index at some
//! values of it.

use super::super::Map;
use super::super::spectrum::Spectrum;
use super::fields::{FIELDS, Field};
use super::layout::{GAP, side};
use crate::colours::BLACK;
use crate::colours::palette::STATES;
use crate::drawing::canvas::{Canvas, Place, Point, Stroke, dashed, stroke};
use crate::drawing::error::FigureError;
use crate::drawing::frame::{Axis, BELOW, BOTH, Frame, Written};
use crate::drawing::legend::{Entry, entry};
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;
use crate::drawing::swatch::Swatch;
use crate::drawing::ticks::rounded;
use crate::drawing::{COLUMN, MARGIN, caption, legend};
use topple::scene::Values;
use topple::scene::builder::TITLES;
use topple::scene::values::spread;

/// Heights of the plots.
const LEAST: f64 = 120.0;
const INDEX: f64 = 90.0;
/// Between them, for the numbers at their ends.
const APART: f64 = 9.0;
/// Values of the second axis at which the rocking index is drawn, at most, each with its own line.
const VALUES: usize = 5;

/// The lines of the least values.
const LIFTS: Stroke = stroke(STATES[1].0, 1.1);
const OVERTURNS: Stroke = dashed(STATES[0].0, 1.1, (4.0, 2.4));

fn line_of(number: usize) -> Stroke {
    match number {
        0 => stroke(BLACK, 0.5),
        1 => dashed(BLACK, 0.7, (1.0, 1.4)),
        2 => dashed(BLACK, 0.7, (3.2, 1.6)),
        3 => stroke(BLACK, 1.0),
        _ => dashed(BLACK, 1.0, (5.0, 1.5)),
    }
}

/// Draws the spectra of a map; none of a map that has not two axes.
pub fn draw(map: &Map, print: Print) -> Result<Option<Picture>, FigureError> {
    let (Some(spectrum), Some(y_axis)) = (Spectrum::of(map), map.grid.y()) else { return Ok(None) };
    let x_axis = map.grid.x();
    let mut canvas = print.canvas(COLUMN);
    let wide = canvas.inner();
    let along = format!(
        "Least {} that lifts and overturns, over {}",
        y_axis.entry().symbol,
        x_axis.entry().symbol
    );
    let title = match (print.title, map.scene.title.as_str()) {
        (Some(title), _) => title.into(),
        (None, title) if TITLES.contains(&title) => along,
        (None, title) => format!("{title}: {}", along.replacen('L', "l", 1)),
    };
    let (x, width) = side(&canvas);
    let mut y = caption::heading(&mut canvas, map.scene, &title) + GAP;
    let place = Place { x, y, width, height: LEAST };
    let frame = Frame::new(place, Axis::of(Some(x_axis)), Axis::of(Some(y_axis)));
    let shows_index = map.columns.has(FIELDS[0].column);
    let mut entries: Vec<Entry> = Vec::new();
    // Where both are the same, the lower line shows between the dashes of the upper one.
    let curves = [
        (&spectrum.lifts, LIFTS, "lifts from here on"),
        (&spectrum.overturns, OVERTURNS, "overturns from here on; above it may stand again"),
    ];
    canvas.clipped(place, |canvas| {
        for (least, line, _) in &curves {
            let point = |(column, row): (usize, &Option<usize>)| -> Option<Point> {
                let at = |values: &Values, place: usize| values.coordinate(place as f64);
                Some(frame.at((at(&x_axis.values, column), at(&y_axis.values, (*row)?))))
            };
            let points: Vec<Option<Point>> = least.iter().enumerate().map(point).collect();
            parts(canvas, &points, *line);
        }
    });
    for (least, line, text) in curves {
        if least.iter().any(Option::is_some) {
            entries.push(entry(Swatch::Line(line), text));
        }
    }
    frame.draw(&mut canvas, Written { x: !shows_index, ..BOTH });
    y += LEAST;
    if shows_index {
        y += APART;
        let place = Place { x, y, width, height: INDEX };
        entries.extend(index(&mut canvas, map, place));
        y += INDEX;
    }
    let top = (MARGIN, y + BELOW + GAP);
    let end = legend::draw(&mut canvas, &entries, top, wide, 1);
    Ok(Some(canvas.finish(end + MARGIN)))
}

/// Draws the rocking index of cells that stand along the first axis, at some values of the second; their legend.
fn index(canvas: &mut Canvas, map: &Map, place: Place) -> Vec<Entry> {
    let (columns, rows) = map.grid.shape();
    let (x_axis, Some(y_axis)) = (map.grid.x(), map.grid.y()) else { return Vec::new() };
    let field: &Field = &FIELDS[0];
    let frame = Frame::new(place, Axis::of(Some(x_axis)), Axis::new(0.0, 1.0, field.label));
    let count = rows.min(VALUES);
    let mut entries = Vec::new();
    canvas.clipped(place, |canvas| {
        for number in 0..count {
            let row = spread(number, count, rows);
            let cells = &map.outcomes[row * columns..(row + 1) * columns];
            let point = |(column, cell)| {
                let at = (x_axis.values.coordinate(column as f64), field.value(cell));
                Field::counts(cell).then(|| frame.at(at))
            };
            let points: Vec<Option<Point>> = cells.iter().enumerate().map(point).collect();
            parts(canvas, &points, line_of(number));
            let value = y_axis.values.value(row);
            let of = y_axis.entry();
            let text = format!("ζ at {} = {} {}", of.symbol, rounded(value, value.abs()), of.unit);
            entries.push(entry(Swatch::Line(line_of(number)), text.trim_end()));
        }
    });
    frame.draw(canvas, BOTH);
    entries.push(entry(Swatch::None, "ζ is drawn where the block stands."));
    entries
}

/// Draws lines through points that follow each other; a point alone as a short line.
fn parts(canvas: &mut Canvas, points: &[Option<Point>], stroke: Stroke) {
    for part in points.split(Option::is_none) {
        let mut part: Vec<Point> = part.iter().flatten().copied().collect();
        if let [(x, y)] = part[..] {
            part = vec![(x - 0.8, y), (x + 0.8, y)];
        }
        canvas.line(part, stroke);
    }
}
