//! One cell's motion against time.

use plotters::prelude::*;

use super::FigureError;
use super::document::compose;
use super::overturning::caption;
use super::tick;
use crate::integrate::outcome::Outcome;
use crate::scene::{Point, Scene};
use crate::sweep::history::Row;

const SIZE: (u32, u32) = (960, 820);

/// A strip of the figure: what it shows of a row, and in which unit.
type Strip = (&'static str, fn(&Row) -> f64);

const STRIPS: [Strip; 4] = [
    ("φ [rad]", |row| row.phi),
    ("u [m]", |row| row.u),
    ("v [m]", |row| row.v),
    ("z", |row| row.z),
];

/// Draws the motion as SVG.
///
/// # Errors
/// Any [`FigureError`].
pub fn draw(
    scene: &Scene,
    point: &Point,
    rows: &[Row],
    outcome: &Outcome,
) -> Result<String, FigureError> {
    let mut drawing = String::new();
    strips(scene, point, rows, outcome, &mut drawing)
        .map_err(|e| FigureError::Draw(e.to_string()))?;
    Ok(compose(SIZE, &[], &drawing))
}

fn strips(
    scene: &Scene,
    point: &Point,
    rows: &[Row],
    outcome: &Outcome,
    drawing: &mut String,
) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(drawing, SIZE).into_drawing_area();
    let text = |size: i32| ("sans-serif", size).into_font().color(&BLACK);
    let what = format!(
        "Ω = {} rad/s,  A_h = {} m/s²:  {}, {} impacts, ζ = {:.4}",
        point.omega,
        point.a_h,
        outcome.class.name().replace('_', " "),
        outcome.impacts,
        outcome.zeta
    );
    root.draw(&Text::new(what, (84, 16), text(20)))?;
    root.draw(&Text::new(caption(scene), (84, 44), text(15)))?;
    let end = rows.last().map_or(1.0, |row| row.t).max(f64::MIN_POSITIVE);
    let (_, below) = root.split_vertically(66);
    let areas = below.split_evenly((STRIPS.len(), 1));
    for (k, (area, (label, value))) in areas.iter().zip(STRIPS).enumerate() {
        let last = k + 1 == STRIPS.len();
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for y in rows.iter().map(value) {
            (low, high) = (low.min(y), high.max(y));
        }
        let mut margin = 0.08 * (high - low);
        if !(margin > 0.0) {
            (low, high) = if low.is_finite() { (low, low) } else { (0.0, 0.0) };
            margin = 0.5 * low.abs().max(1.0e-3);
        }
        let mut chart = ChartBuilder::on(area)
            .margin_right(24)
            .margin_left(16)
            .margin_top(8)
            .set_label_area_size(LabelAreaPosition::Left, 74)
            .set_label_area_size(LabelAreaPosition::Bottom, if last { 44 } else { 8 })
            .build_cartesian_2d(0.0..end, low - margin..high + margin)?;
        let format_y = |value: &f64| tick(*value, high - low);
        let format_x = |value: &f64| if last { tick(*value, end) } else { String::new() };
        let mut mesh = chart.configure_mesh();
        mesh.light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.12))
            .label_style(text(14))
            .axis_desc_style(text(16))
            .y_labels(5)
            .y_desc(label)
            .x_labels(10)
            .x_label_formatter(&format_x)
            .y_label_formatter(&format_y);
        if last {
            mesh.x_desc("t [s]");
        }
        mesh.draw()?;
        let line = rows.iter().map(|row| (row.t, value(row)));
        chart.draw_series(LineSeries::new(line, RGBColor(0x2c, 0x5f, 0xb8).stroke_width(1)))?;
        if k == 0 {
            // Where the phase changes: uplifts and impacts.
            let switches = rows.windows(2).filter(|pair| pair[0].mode != pair[1].mode);
            let dots =
                switches.map(|pair| Circle::new((pair[1].t, value(&pair[1])), 2, RED.filled()));
            chart.draw_series(dots)?;
        }
    }
    root.present()?;
    Ok(())
}
