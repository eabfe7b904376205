//! The chart of a bench: errors against the time that they cost.

use plotters::coord::combinators::LogCoord;
use plotters::prelude::*;

use super::fit::slope;
use super::table::Row;
use crate::map::figure::FigureError;
use crate::map::figure::document::{FINE, compose};
use crate::map::figure::frame::{Area, Drawn, area, at, stroke, text};

const WIDTH: i32 = 1080;
const PANEL: (i32, i32) = (390, 344);
const TOP: i32 = 56;
const LEGEND: i32 = 790;

/// An error that is drawn: its title, its value in a row, and the least that its axis shows.
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
    colour: RGBColor,
    rows: Vec<&'a Row>,
}

const COLOURS: [RGBColor; 9] = [
    RGBColor(0x8c, 0xb8, 0xe8),
    RGBColor(0x2c, 0x5f, 0xb8),
    RGBColor(0xe3, 0x7c, 0x1e),
    RGBColor(0x7f, 0xc9, 0x7f),
    RGBColor(0x1b, 0x7a, 0x3a),
    RGBColor(0x30, 0x30, 0x30),
    RGBColor(0xb0, 0x3a, 0x8c),
    RGBColor(0x8c, 0x5a, 0x3c),
    RGBColor(0xc8, 0x1e, 0x2a),
];

/// The methods of topple have a colour each, on every chart; other programs take what is left.
fn colour(row: &Row, others: &mut usize) -> RGBColor {
    let own = match (row.method.as_str(), row.precision) {
        ("cpu", "f32") => 0,
        ("cpu", _) => 1,
        ("naive", _) => 2,
        ("shader", "f32") => 3,
        ("shader", _) => 4,
        ("reference", _) => 5,
        _ => {
            *others += 1;
            5 + *others
        }
    };
    COLOURS[own % COLOURS.len()]
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

/// Draws the chart of one bench as SVG.
///
/// # Errors
/// Any [`FigureError`].
pub fn draw(title: &str, rows: &[Row]) -> Result<String, FigureError> {
    let lines = lines(rows);
    let panels: Vec<&Panel> =
        PANELS.iter().filter(|panel| rows.iter().any(|row| (panel.value)(row).is_some())).collect();
    let rows_of_panels = (panels.len() as i32 + 1) / 2;
    let height = (TOP + rows_of_panels * PANEL.1 + 34).max(420);
    let size = (WIDTH as u32, height as u32);
    let mut drawing = String::new();
    chart(title, rows, &lines, &panels, size, &mut drawing)
        .map_err(|e| FigureError::Draw(e.to_string()))?;
    Ok(compose(size, &[], &drawing))
}

/// The whole decades around values.
fn decades(values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
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

fn chart(
    title: &str,
    rows: &[Row],
    lines: &[Line],
    panels: &[&Panel],
    size: (u32, u32),
    drawing: &mut String,
) -> Drawn<()> {
    let root = area(drawing, size);
    root.draw(&Text::new(title.to_string(), at(20, 16), text(20)))?;
    let times = decades(rows.iter().flat_map(|row| [row.seconds, row.device.unwrap_or(0.0)]));
    for (index, panel) in panels.iter().enumerate() {
        let (column, line) = (index as i32 % 2, index as i32 / 2);
        let corner = at(8 + column * PANEL.0, TOP + line * PANEL.1);
        let extent = at(PANEL.0 - 8, PANEL.1);
        let place = root.clone().shrink(corner, extent);
        draw_panel(&place, panel, lines, &times)?;
    }
    legend(&root, rows, lines)?;
    root.present()?;
    Ok(())
}

fn draw_panel(
    place: &Area,
    panel: &Panel,
    lines: &[Line],
    times: &std::ops::Range<f64>,
) -> Drawn<()> {
    let all = lines.iter().flat_map(|line| &line.rows);
    let errors = if panel.share {
        let cells = all.map(|row| row.errors.cells).max().unwrap_or(1);
        decades([0.5 / cells as f64, 1.0].into_iter())
    } else {
        decades(all.filter_map(|row| (panel.value)(row)).map(|value| value.max(LEAST)))
    };
    let (least, most) = (errors.start, errors.end);
    let mut chart = ChartBuilder::on(place)
        .caption(panel.title, text(15))
        .margin_top(10 * FINE)
        .margin_right(10 * FINE)
        .set_label_area_size(LabelAreaPosition::Left, 64 * FINE)
        .set_label_area_size(LabelAreaPosition::Bottom, 44 * FINE)
        .build_cartesian_2d(times.clone().log_scale(), errors.log_scale())?;
    // Zero added, for there is a negative one.
    let power = |value: &f64| format!("1e{}", value.log10().round() + 0.0);
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.1).stroke_width(FINE as u32))
        .axis_style(stroke(BLACK, 10))
        .label_style(text(12))
        .axis_desc_style(text(13))
        .x_desc("time a cell [s]")
        .x_label_formatter(&power)
        .y_label_formatter(&power)
        .set_all_tick_mark_size(4 * FINE)
        .draw()?;
    for line in lines {
        draw_line(&mut chart, panel, line, least, most)?;
    }
    Ok(())
}

type Log = LogCoord<f64>;
type LogPlot<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Log, Log>>;

fn draw_line(
    chart: &mut LogPlot<'_, '_>,
    panel: &Panel,
    line: &Line,
    least: f64,
    most: f64,
) -> Drawn<()> {
    let told = line.rows.iter().filter_map(|row| Some((*row, (panel.value)(row)?)));
    let told: Vec<(&Row, f64)> = told.collect();
    let place = |row: &Row, value: f64| (row.seconds, value.clamp(least, most));
    let path = told.iter().map(|(row, value)| place(row, *value));
    chart.draw_series(LineSeries::new(path, stroke(line.colour, 14)))?;
    // From the time in the shader to the whole time.
    let whiskers = told.iter().filter_map(|(row, value)| {
        let (whole, error) = place(row, *value);
        Some(PathElement::new(vec![(row.device?, error), (whole, error)], stroke(line.colour, 5)))
    });
    chart.draw_series(whiskers)?;
    for (row, value) in &told {
        // What is zero, or too small to be shown, is hollow, on the axis.
        let filled = *value >= least;
        let style = if filled { line.colour.filled() } else { stroke(line.colour, 12) };
        chart.draw_series([Circle::new(place(row, *value), 3 * FINE, style)])?;
    }
    // What failed is a cross: on the line where a part of the cells did, at the top where nothing
    // is left to judge.
    for row in &line.rows {
        let value = (panel.value)(row);
        if row.errors.failed > 0 || value.is_none() {
            let spot = place(row, value.unwrap_or(most));
            chart.draw_series([Cross::new(spot, 5 * FINE, stroke(RED, 18))])?;
        }
    }
    Ok(())
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
    Some(if steps { format!("h^{slope:.1}") } else { format!("time^{slope:.1}") })
}

fn legend(root: &Area, rows: &[Row], lines: &[Line]) -> Drawn<()> {
    let mut y = TOP + 16;
    for line in lines {
        let ends = [at(LEGEND, y + 8), at(LEGEND + 26, y + 8)];
        root.draw(&PathElement::new(ends.to_vec(), stroke(line.colour, 14)))?;
        root.draw(&Circle::new(at(LEGEND + 13, y + 8), 3 * FINE, line.colour.filled()))?;
        root.draw(&Text::new(line.name.clone(), at(LEGEND + 34, y), text(14)))?;
        let named = [("switch times", time as fn(&Row) -> Option<f64>), ("ζ", zeta)];
        let fits: Vec<String> = named
            .into_iter()
            .filter_map(|(name, value)| Some(format!("{name} {}", fitted(line, value)?)))
            .collect();
        if !fits.is_empty() {
            root.draw(&Text::new(fits.join(",  "), at(LEGEND + 34, y + 17), text(12)))?;
        }
        y += 40;
    }
    let cells = rows.iter().map(|row| row.errors.cells).max().unwrap_or(0);
    let mut notes = vec![
        format!("{cells} cells; hollow: none, or too small to show"),
        "red cross: cells that failed".into(),
    ];
    if rows.iter().any(|row| row.device.is_some()) {
        notes.push("bar to the left: time in the shader".into());
    }
    for note in notes {
        root.draw(&Text::new(note, at(LEGEND, y), text(12)))?;
        y += 18;
    }
    Ok(())
}
