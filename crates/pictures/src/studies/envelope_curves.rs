//! The picture of an envelope along one axis: the share that stands, and the percentiles of the strokes with their
//! limits.

use super::of_standing;
use crate::colours::BLACK;
use crate::colours::palette::{CURVES, FEASIBLE};
use crate::drawing::canvas::{Canvas, Place, Point, Stroke, dashed, stroke};
use crate::drawing::frame::{Axis, BELOW, BOTH, Frame, LEFT, Written};
use crate::drawing::legend::{self, entry};
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;
use crate::drawing::share::given;
use crate::drawing::swatch::Swatch;
use crate::drawing::{COLUMN, MARGIN, caption};
use topple::scene::grid;
use topple::scene::words;
use topple_studies::suites::envelope::{CellEnvelope, Envelope, SHARES};

/// Height of a plot, and between two.
const HEIGHT: f64 = 70.0;
const GAP: f64 = 6.0;
/// A percentile each, and a limit.
const LINES: [Stroke; 3] =
    [stroke(CURVES[0], 0.6), dashed(CURVES[0], 0.9, (3.2, 2.0)), stroke(CURVES[0], 1.2)];
const LIMIT: Stroke = dashed(CURVES[1], 0.9, (1.2, 1.6));

/// A quantity with its percentiles or its one value, its name, and its limit.
struct Panel<'a> {
    values: &'a dyn Fn(&CellEnvelope) -> Vec<f64>,
    label: &'a str,
    limit: Option<f64>,
    most: Option<f64>,
}

/// Draws an envelope along the axis of its cells.
pub fn draw(envelope: &Envelope, axis: &grid::Axis, title: &str, print: Print) -> Picture {
    let mut canvas = print.canvas(COLUMN);
    let most = canvas.inner();
    let fixed = words::fixed(&envelope.known());
    let mut y = caption::titled(&mut canvas, print.title.unwrap_or(title), &fixed) + MARGIN;
    let limits = envelope.settings.limits;
    let moves = envelope.sweep.scene.isolation;
    let mut panels = vec![Panel {
        values: &|cell| vec![cell.standing],
        label: "share that stands",
        limit: Some(limits.standing),
        most: Some(1.0),
    }];
    if moves.moves_h() {
        let values: &dyn Fn(&CellEnvelope) -> Vec<f64> = &|cell| cell.max_u.to_vec();
        panels.push(Panel { values, label: "max |u| [m]", limit: limits.u, most: None });
    }
    if moves.moves_v() {
        let values: &dyn Fn(&CellEnvelope) -> Vec<f64> = &|cell| cell.stroke_v.to_vec();
        panels.push(Panel { values, label: "stroke of v [m]", limit: limits.v, most: None });
    }
    let count = panels.len();
    for (number, panel) in panels.iter().enumerate() {
        let x = MARGIN + LEFT;
        let place = Place { x, y, width: canvas.inner() - x, height: HEIGHT };
        paint(&mut canvas, envelope, axis, panel, place, number + 1 == count);
        y = place.bottom() + GAP;
    }
    let mut entries = vec![
        entry(Swatch::Fill(FEASIBLE.1), "all limits are kept"),
        entry(Swatch::Line(LIMIT), "a limit"),
    ];
    for (line, share) in LINES.iter().zip(SHARES) {
        let text = format!("not exceeded under {} of the motions", given(share));
        entries.push(entry(Swatch::Line(*line), text));
    }
    let at = (MARGIN, y - GAP + BELOW + MARGIN);
    let end = legend::draw(&mut canvas, &entries, at, most, 2);
    let end = of_standing(&mut canvas, envelope.cells.iter().filter(|_| count > 1), end, most);
    canvas.finish(end + MARGIN)
}

/// Draws a panel.
fn paint(
    canvas: &mut Canvas,
    envelope: &Envelope,
    axis: &grid::Axis,
    panel: &Panel,
    place: Place,
    last: bool,
) {
    let rows: Vec<Vec<f64>> = envelope.cells.iter().map(panel.values).collect();
    let known = rows.iter().flatten().copied().filter(|value| value.is_finite());
    let largest = known.chain(panel.limit).fold(0.0, f64::max);
    let most = panel.most.unwrap_or(if largest > 0.0 { largest } else { 1.0 });
    let frame = Frame::new(place, Axis::of(Some(axis)), Axis::new(0.0, 1.06 * most, panel.label));
    let edge = |cell: f64| frame.at((axis.values.coordinate(cell), 0.0)).0;
    canvas.clipped(place, |canvas| {
        for (k, _) in envelope.cells.iter().enumerate().filter(|(_, cell)| cell.feasible) {
            let (left, right) = (edge(k as f64 - 0.5), edge(k as f64 + 0.5));
            let (x, width) = (left.min(right), (right - left).abs());
            canvas.fill(Place { x, width, ..place }, FEASIBLE.1);
        }
        let lines =
            if rows.first().is_some_and(|row| row.len() == 1) { &LINES[2..] } else { &LINES };
        for (k, line) in lines.iter().enumerate() {
            let point = |(cell, row): (usize, &Vec<f64>)| -> Option<Point> {
                let at = (axis.values.coordinate(cell as f64), row[k]);
                row[k].is_finite().then(|| frame.at(at))
            };
            let points: Vec<Option<Point>> = rows.iter().enumerate().map(point).collect();
            for part in points.split(Option::is_none) {
                canvas.line(part.iter().flatten().copied(), *line);
            }
        }
        if let Some(limit) = panel.limit {
            let y = frame.at((axis.values.coordinate(0.0), limit)).1;
            canvas.line([(place.x, y), (place.right(), y)], LIMIT);
        }
    });
    canvas.outline(place, stroke(BLACK, 0.4));
    frame.draw(canvas, Written { x: last, ..BOTH });
}
