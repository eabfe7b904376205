//! One cell's motion against time.

use plotters::prelude::*;

use super::document::{FINE, compose};
use super::frame::{Drawn, area, at, caption, stroke, text};
use super::{FigureError, tick};
use crate::scene::{Case, Excitation, Scene, Shaking};
use crate::stepping::outcome::Outcome;
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
    case: &Case,
    rows: &[Row],
    outcome: &Outcome,
) -> Result<String, FigureError> {
    let mut drawing = String::new();
    strips(scene, case, rows, outcome, &mut drawing)
        .map_err(|e| FigureError::Draw(e.to_string()))?;
    Ok(compose(SIZE, &[], &drawing))
}

fn strips(
    scene: &Scene,
    case: &Case,
    rows: &[Row],
    outcome: &Outcome,
    drawing: &mut String,
) -> Drawn<()> {
    let root = area(drawing, SIZE);
    let cell = match (&scene.excitation, case.shaking) {
        (Excitation::Record(pair), _) => pair.title.clone(),
        (_, Shaking::Pulse(pulse)) => {
            format!("Ω = {} rad/s,  A_h = {} m/s²", pulse.omega, pulse.a_h)
        }
        (Excitation::Pulse(_), Shaking::Record { .. }) => String::new(),
    };
    let what = format!(
        "{cell}:  {}, {} impacts, ζ = {:.4}",
        outcome.class.name().replace('_', " "),
        outcome.impacts,
        outcome.zeta
    );
    root.draw(&Text::new(what, at(84, 16), text(20)))?;
    root.draw(&Text::new(caption(scene), at(84, 44), text(15)))?;
    let end = rows.last().map_or(1.0, |row| row.t).max(f64::MIN_POSITIVE);
    let (_, below) = root.split_vertically(66 * FINE);
    let areas = below.split_evenly((STRIPS.len(), 1));
    for (k, (strip, (label, value))) in areas.iter().zip(STRIPS).enumerate() {
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
        let mut chart = ChartBuilder::on(strip)
            .margin_right(24 * FINE)
            .margin_left(16 * FINE)
            .margin_top(8 * FINE)
            .set_label_area_size(LabelAreaPosition::Left, 74 * FINE)
            .set_label_area_size(LabelAreaPosition::Bottom, if last { 44 } else { 8 } * FINE)
            .build_cartesian_2d(0.0..end, low - margin..high + margin)?;
        let format_y = |value: &f64| tick(*value, high - low);
        let format_x = |value: &f64| if last { tick(*value, end) } else { String::new() };
        let mut mesh = chart.configure_mesh();
        mesh.light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.12).stroke_width(FINE as u32))
            .set_all_tick_mark_size(5 * FINE)
            .axis_style(stroke(BLACK, 10))
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
        chart.draw_series(LineSeries::new(line, stroke(RGBColor(0x2c, 0x5f, 0xb8), 12)))?;
        if k == 0 {
            // Where the phase changes: uplifts and impacts.
            let switches = rows.windows(2).filter(|pair| pair[0].mode != pair[1].mode);
            let dots = switches
                .map(|pair| Circle::new((pair[1].t, value(&pair[1])), 2 * FINE, RED.filled()));
            chart.draw_series(dots)?;
        }
    }
    root.present()?;
    Ok(())
}
