//! The chart of a bench: errors against the time that they cost.

use std::ops::Range;

use super::fit::slope;
use super::table::Row;
use topple_pictures::colours::Colour;
use topple_pictures::drawing::canvas::write;
use topple_pictures::drawing::canvas::{Canvas, Place, stroke};
use topple_pictures::drawing::caption::bounded;
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::frame::{Axis, BELOW, Frame, LEFT, Written};
use topple_pictures::drawing::legend::entry;
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::swatch::{Mark, Swatch};
use topple_pictures::drawing::text::{style, wrapped};
use topple_pictures::drawing::{COLUMN, FONT, LEADING, MARGIN, TITLE, legend};

/// Panels in a row, the height of one, and the space between two.
const COLUMNS: usize = 2;
const HEIGHT: f64 = 88.0;
const APART: f64 = 7.0;
/// Radius of a point.
const POINT: f64 = 1.3;
/// Colour of the cross of what failed.
const FAILED: Colour = [0xff, 0, 0];

/// An error that is drawn: its title, and its value in a row.
struct Panel {
    title: &'static str,
    value: fn(&Row) -> Option<f64>,
    share: bool,
}

const PANELS: [Panel; 6] = [
    Panel { title: "cells with another outcome", value: |row| Some(row.wrong()), share: true },
    Panel { title: "cells with other switches", value: Row::other_sequence, share: true },
    Panel { title: "time of a switch, median error [s]", value: time, share: false },
    Panel { title: "motion after a switch, median error", value: motion, share: false },
    Panel { title: "ζ, median error", value: zeta, share: false },
    Panel { title: "ζ, 99th percentile of its error", value: zeta_p99, share: false },
];

fn time(row: &Row) -> Option<f64> {
    Some(row.errors.time?.median)
}

fn motion(row: &Row) -> Option<f64> {
    Some(row.errors.motion?.median)
}

fn zeta(row: &Row) -> Option<f64> {
    Some(row.errors.zeta?.median)
}

fn zeta_p99(row: &Row) -> Option<f64> {
    Some(row.errors.zeta?.p99)
}

/// Least error shown; anything below is drawn there.
const LEAST: f64 = 1.0e-13;

/// A line of the chart: a method in a precision.
struct Line<'a> {
    name: String,
    colour: Colour,
    rows: Vec<&'a Row>,
}

impl Line<'_> {
    /// True where cells of a row failed, or none is left to judge by a value that the method computes at other steps.
    fn failed(&self, row: &Row, value: fn(&Row) -> Option<f64>) -> bool {
        let computed = self.rows.iter().any(|row| value(row).is_some());
        row.errors.failed > 0 || computed && value(row).is_none()
    }
}

const COLOURS: [Colour; 13] = [
    [0x8c, 0xb8, 0xe8],
    [0x2c, 0x5f, 0xb8],
    [0xe3, 0x7c, 0x1e],
    [0x7f, 0xc9, 0x7f],
    [0x1b, 0x7a, 0x3a],
    [0x30, 0x30, 0x30],
    [0xb0, 0x3a, 0x8c],
    [0x8c, 0x5a, 0x3c],
    [0xc8, 0x1e, 0x2a],
    [0x4c, 0xc4, 0xc4],
    [0x00, 0x7a, 0x7a],
    [0xb3, 0xa2, 0xd6],
    [0x6a, 0x51, 0xa3],
];

/// The methods of topple have a colour each, on every chart; other programs take what is left.
fn colour(row: &Row, others: &mut usize) -> Colour {
    let own = match (row.method.as_str(), row.precision) {
        ("cpu", "f32") => 0,
        ("cpu", _) => 1,
        ("naive", _) => 2,
        ("shader", "f32") => 3,
        ("shader", _) => 4,
        ("reference", _) => 5,
        ("cpu with shortcuts", "f32") => 9,
        ("cpu with shortcuts", _) => 10,
        ("cpu outcome only", "f32") => 11,
        ("cpu outcome only", _) => 12,
        _ => {
            *others += 1;
            6 + (*others - 1) % 3
        }
    };
    COLOURS[own]
}

fn lines(rows: &[Row]) -> Vec<Line<'_>> {
    let mut lines: Vec<Line> = Vec::new();
    let mut others = 0;
    for row in rows {
        let name = format!("{} {}", row.method, row.precision);
        match lines.iter_mut().find(|line| line.name == name) {
            Some(line) => line.rows.push(row),
            None => {
                let colour = colour(row, &mut others);
                lines.push(Line { name, colour, rows: vec![row] });
            }
        }
    }
    lines
}

/// Draws the chart of one bench.
pub fn draw(title: &str, rows: &[Row]) -> Result<Picture, FigureError> {
    let lines = lines(rows);
    let panels: Vec<&Panel> =
        PANELS.iter().filter(|panel| rows.iter().any(|row| (panel.value)(row).is_some())).collect();
    let mut canvas = Canvas::new(COLUMN);
    let whole = COLUMN - 2.0 * MARGIN;
    let title = bounded(title, TITLE, whole);
    let mut y = write(&mut canvas, (MARGIN, MARGIN), style(TITLE), &title) + 2.0;
    let times = decades(rows.iter().flat_map(|row| [row.seconds, row.device.unwrap_or(0.0)]));
    let left = LEFT - 4.0;
    let width = (whole - COLUMNS as f64 * left - APART) / COLUMNS as f64;
    let last = panels.len().saturating_sub(1) / COLUMNS;
    for (number, in_row) in panels.chunks(COLUMNS).enumerate() {
        let titles: Vec<Vec<String>> =
            in_row.iter().map(|panel| wrapped(panel.title, FONT, width + 10.0)).collect();
        let high = LEADING * FONT * titles.iter().map(Vec::len).max().unwrap_or(0) as f64;
        for (column, (panel, title)) in in_row.iter().zip(&titles).enumerate() {
            let x = MARGIN + left + column as f64 * (width + left + APART);
            let above = high - LEADING * FONT * title.len() as f64;
            write(&mut canvas, (x - 4.0, y + above), style(FONT), title);
            let place = Place { x, y: y + high + 1.0, width, height: HEIGHT };
            // The times stand below the lowest panel of each column.
            let below = number == last || number * COLUMNS + column + COLUMNS >= panels.len();
            draw_panel(&mut canvas, place, panel, &lines, &times, below);
        }
        y += high + 1.0 + HEIGHT + APART;
    }
    y += BELOW - APART + 6.0;
    let end = draw_legend(&mut canvas, rows, &lines, y);
    Ok(canvas.finish(end + MARGIN))
}

/// The whole decades around values.
fn decades(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for value in values.filter(|value| value.is_finite() && *value > 0.0) {
        (low, high) = (low.min(value), high.max(value));
    }
    if !(low <= high) {
        (low, high) = (1.0e-3, 1.0);
    }
    let (from, to) = (low.log10().floor(), high.log10().ceil());
    10.0_f64.powf(from)..10.0_f64.powf(to.max(from + 1.0))
}

fn draw_panel(
    canvas: &mut Canvas,
    place: Place,
    panel: &Panel,
    lines: &[Line],
    times: &Range<f64>,
    below: bool,
) {
    let all = lines.iter().flat_map(|line| &line.rows);
    let errors = if panel.share {
        let cells = all.map(|row| row.errors.cells).max().unwrap_or(1);
        decades([0.5 / cells as f64, 1.0].into_iter())
    } else {
        decades(all.filter_map(|row| (panel.value)(row)).map(|value| value.max(LEAST)))
    };
    // Room for marks on the first and the last decade.
    let room = |ends: &Range<f64>| (ends.end / ends.start).powf(0.04);
    let x = Axis::log(times.start / room(times), times.end * room(times), "time a cell [s]");
    // The panel's title names the value.
    let y = Axis::log(errors.start / room(&errors), errors.end * room(&errors), " ");
    let frame = Frame::new(place, x, y);
    frame.draw_grid(canvas);
    frame.draw(canvas, Written { y: true, x: below, beyond: 5.0 });
    canvas.clipped(place, |canvas| {
        for line in lines {
            draw_line(canvas, &frame, panel, line, (errors.start, errors.end));
        }
    });
}

fn draw_line(
    canvas: &mut Canvas,
    frame: &Frame,
    panel: &Panel,
    line: &Line,
    (least, most): (f64, f64),
) {
    let at =
        |seconds: f64, value: f64| frame.at((seconds.log10(), value.clamp(least, most).log10()));
    let told: Vec<(&Row, f64)> =
        line.rows.iter().filter_map(|row| Some((*row, (panel.value)(row)?))).collect();
    canvas.line(told.iter().map(|(row, value)| at(row.seconds, *value)), stroke(line.colour, 0.7));
    for (row, value) in &told {
        // From the time in the shader to the whole time.
        if let Some(device) = row.device {
            canvas.line([at(device, *value), at(row.seconds, *value)], stroke(line.colour, 0.3));
        }
        // What is zero, or too small to be shown, is hollow, on the lowest decade.
        let mark = if *value >= least { Mark::Disc } else { Mark::Circle };
        mark.draw(canvas, at(row.seconds, *value), POINT, line.colour);
    }
    // What failed is a cross: on the line where a part of the cells did, at the top where nothing
    // is left to judge.
    for row in &line.rows {
        let value = (panel.value)(row);
        if line.failed(row, panel.value) {
            Mark::Cross.draw(canvas, at(row.seconds, value.unwrap_or(most)), 1.7 * POINT, FAILED);
        }
    }
}

/// The order of a line in its steps, or its slope over time where it has no steps.
fn fitted(line: &Line, value: fn(&Row) -> Option<f64>) -> Option<String> {
    let steps = line.rows.first()?.steps;
    let points: Vec<(f64, f64)> = line
        .rows
        .iter()
        .filter_map(|row| Some((if steps { row.setting } else { row.seconds }, value(row)?)))
        .collect();
    let slope = slope(&points)?;
    Some(if steps { format!("h^{{{slope:.1}}}") } else { format!("time^{{{slope:.1}}}") })
}

fn draw_legend(canvas: &mut Canvas, rows: &[Row], lines: &[Line], top: f64) -> f64 {
    let of = |line: &Line| {
        let named = [("switch times", time as fn(&Row) -> Option<f64>), ("ζ", zeta)];
        let fits: Vec<String> = named
            .into_iter()
            .filter_map(|(name, value)| Some(format!("{name}\u{a0}{}", fitted(line, value)?)))
            .collect();
        let colon = if fits.is_empty() { "" } else { ": " };
        let label = format!("{}{colon}{}", line.name, fits.join(", "));
        entry(Swatch::Curve(stroke(line.colour, 0.8), Mark::Disc), label)
    };
    let mut entries: Vec<_> = lines.iter().map(of).collect();
    entries.push(entry(Swatch::Mark(Mark::Circle, [0; 3]), "none, or too small to show"));
    if lines.iter().any(|line| line.rows.iter().any(|row| line.failed(row, zeta))) {
        entries.push(entry(Swatch::Mark(Mark::Cross, FAILED), "cells failed, or none to judge"));
    }
    if rows.iter().any(|row| row.device.is_some()) {
        entries.push(entry(Swatch::None, "Bar to the left: time in the shader."));
    }
    let cells = rows.iter().map(|row| row.errors.cells).max().unwrap_or(0);
    let cells = if cells == 1 { "1 cell".into() } else { format!("{cells} cells") };
    entries.push(entry(Swatch::None, format!("{cells}.")));
    legend::draw(canvas, &entries, (MARGIN, top), COLUMN - 2.0 * MARGIN, 2)
}
