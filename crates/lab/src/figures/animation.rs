//! Cells in motion, side by side, as an animated GIF: block, plates and corners above, the rocking
//! angle below.

use super::marks;
use topple::backend::history::Row;
use topple::scene::{Case, GRAVITY, Scene};
use topple::stepping::outcome::Outcome;
use topple_pictures::colours::palette::{CURVES, Kind};
use topple_pictures::colours::{BLACK, Colour};
use topple_pictures::drawing::canvas::{Canvas, Place, Point, Stroke, stroke};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::frame::{Axis, BOTH, Frame, LEFT};
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::shapes::spring;
use topple_pictures::drawing::text::style;
use topple_pictures::drawing::{FONT, TITLE};

/// Frames a second.
const RATE: f64 = 12.5;
/// Hundredths of a second that the last frame stays.
const HOLD: u16 = 200;
/// Width of a cell's column, points.
const COLUMN: f64 = 120.0;
/// Height of the figure.
const HEIGHT: f64 = 225.6;
/// Where the ground is.
const GROUND: f64 = 154.0;
/// Points of a metre.
const SCALE: f64 = 48.0;
/// Half of a plate's width, and its thickness, m.
const PLATE: (f64, f64) = (0.5, 0.05);
/// Height of the upper plate's foot above the ground at rest, m.
const REST: f64 = 0.32;
/// Colours of plates and blocks, and of what overturns.
const STEEL: Colour = [0x9a, 0xa3, 0xad];
const STONE: Colour = [0xf2, 0xe2, 0xc0];
const RED: Colour = CURVES[1];

/// A cell in motion.
#[derive(Debug, Clone)]
pub struct Moving<'a> {
    cell: &'a marks::Cell,
    scene: &'a Scene,
    rows: Vec<Row>,
    outcome: Outcome,
}

impl<'a> Moving<'a> {
    /// A cell with its scene, its motion, of which as much is shown as the cell says, and its
    /// outcome.
    pub fn new(
        cell: &'a marks::Cell,
        scene: &'a Scene,
        mut rows: Vec<Row>,
        outcome: Outcome,
    ) -> Moving<'a> {
        rows.retain(|row| row.t <= cell.seconds);
        Moving { cell, scene, rows, outcome }
    }

    /// The motion at a time, linear between its rows; its last row from then on.
    fn at(&self, t: f64) -> Option<Row> {
        let after = self.rows.partition_point(|row| row.t <= t);
        let before = self.rows.get(after.checked_sub(1)?)?;
        let Some(next) = self.rows.get(after) else { return Some(*before) };
        let share = (t - before.t) / (next.t - before.t);
        let mix = |a: f64, b: f64| a + (b - a) * share;
        Some(Row {
            t,
            u: mix(before.u, next.u),
            v: mix(before.v, next.v),
            phi: mix(before.phi, next.phi),
            ..*before
        })
    }
}

/// Draws cells as an animated GIF that runs for the longest of them, in their own time.
pub fn draw(title: &str, cells: &[Moving]) -> Result<Vec<u8>, FigureError> {
    let seconds = cells.iter().map(|moving| moving.cell.seconds).fold(0.0, f64::max);
    let frames = (seconds * RATE).ceil() as u32;
    let failed = |reason: String| FigureError::Encode(reason);
    let side = |length: u32| {
        u16::try_from(length).map_err(|_| failed(format!("{length} pixels are too many")))
    };
    let mut bytes = Vec::new();
    let first = still(title, cells, 0.0).frame()?;
    let (width, height) = (side(first.width())?, side(first.height())?);
    let mut encoder =
        gif::Encoder::new(&mut bytes, width, height, &[]).map_err(|e| failed(e.to_string()))?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(|e| failed(e.to_string()))?;
    let mut before: Option<Vec<u8>> = None;
    for k in 0..=frames {
        // The paper is white and opaque: no pixel's colour is scaled by its opacity.
        let mut rgba = still(title, cells, f64::from(k) / RATE).frame()?.take();
        let whole = rgba.clone();
        // A pixel that is as it was stays: it is transparent.
        for (pixel, old) in rgba.chunks_exact_mut(4).zip(before.iter().flat_map(|b| b.chunks(4))) {
            if pixel == old {
                pixel.fill(0);
            }
        }
        before = Some(whole);
        let mut frame = gif::Frame::from_rgba_speed(width, height, &mut rgba, 10);
        frame.dispose = gif::DisposalMethod::Keep;
        frame.delay = if k == frames { HOLD } else { (100.0 / RATE) as u16 };
        encoder.write_frame(&frame).map_err(|e| failed(e.to_string()))?;
    }
    drop(encoder);
    Ok(bytes)
}

/// The picture at a time.
pub fn still(title: &str, cells: &[Moving], t: f64) -> Picture {
    let mut canvas = Canvas::new(COLUMN * cells.len().max(1) as f64);
    canvas.text((7.0, 5.0 + TITLE), style(TITLE), &format!("{title}, t = {t:.2} s"));
    for (k, moving) in cells.iter().enumerate() {
        column(&mut canvas, COLUMN * k as f64, moving, t);
    }
    canvas.finish(HEIGHT)
}

fn column(canvas: &mut Canvas, left: f64, moving: &Moving, t: f64) {
    canvas.text((left + 7.0, 25.0), style(FONT), &Kind::of(&moving.outcome).label());
    let Some(now) = moving.at(t) else { return };
    let case = moving.scene.case();
    sketch(canvas, left + 0.5 * COLUMN, &case, &now);
    let critical = |side: f64| case.overturning_angle(side);
    let most = 1.15 * critical(1.0).max(critical(-1.0));
    let x = left + LEFT + 4.0;
    let place = Place { x, y: GROUND + 10.0, width: COLUMN - LEFT - 10.0, height: 40.0 };
    let end = moving.cell.seconds;
    let frame = Frame::new(place, Axis::new(0.0, end, "t [s]"), Axis::new(-most, most, "φ [rad]"));
    for side in [1.0, -1.0] {
        let level = [(0.0, side * critical(side)), (end, side * critical(side))];
        canvas.line(level.map(|point| frame.at(point)), stroke(RED, 0.4));
    }
    let past = moving.rows.iter().take_while(|row| row.t <= now.t);
    canvas.line(past.map(|row| frame.at((row.t, row.phi))), stroke(CURVES[0], 0.7));
    canvas.disc(frame.at((now.t.min(end), now.phi)), 1.4, CURVES[0]);
    frame.draw(canvas, BOTH);
    if moving.rows.last().is_some_and(|row| t >= row.t) && moving.outcome.class.overturned() {
        let red = topple_pictures::drawing::text::Style { colour: RED, ..style(FONT) };
        canvas.text((left + 7.0, 34.0), red, "overturned");
    }
}

/// Draws block, plates and isolators. The base's displacements are relative to the ground, the
/// vertical one to its static deflection.
fn sketch(canvas: &mut Canvas, middle: f64, case: &Case, now: &Row) {
    let (block, base) = (&case.block, &case.isolation);
    let static_v = base.vertical.as_ref().map_or(0.0, |law| {
        let omega_v = std::f64::consts::TAU / law.t_v;
        -GRAVITY / (omega_v * omega_v)
    });
    let (u, v) = (now.u, now.v - static_v);
    let place = |(x, y): Point| (middle + x * SCALE, GROUND - y * SCALE);
    let (half, thick) = PLATE;
    let black = |width: f64| -> Stroke { stroke(BLACK, width) };
    canvas.line([(-1.15, 0.0), (1.15, 0.0)].map(place), black(1.0));
    let plate = |x: f64, y: f64| {
        [(x - half, y), (x + half, y), (x + half, y + thick), (x - half, y + thick)].map(place)
    };
    let low = 0.04;
    canvas.polygon(plate(u, low), STEEL);
    canvas.polygon(plate(u, REST + v), STEEL);
    // Rollers and a spring to the left; springs between the plates.
    for x in [-0.35, 0.0, 0.35] {
        canvas.disc(place((u + x, low / 2.0)), 1.0, BLACK);
    }
    canvas.line([(-1.0, 0.0), (-1.0, 0.16)].map(place), black(0.8));
    let zigzag = |from: Point, to: Point| spring(from, to, 8, 0.035).map(place);
    let beside = zigzag((-1.0, low + thick / 2.0), (u - half, low + thick / 2.0));
    canvas.line(beside, black(0.45));
    for x in [-0.3, 0.3] {
        canvas.line(zigzag((u + x, low + thick), (u + x, REST + v)), black(0.45));
    }
    // The block turns about the left corner for phi > 0, about the right one for phi < 0.
    let b = block.half_width;
    let side = if now.phi >= 0.0 { -1.0 } else { 1.0 };
    let pivot = (u + side * b, REST + v + thick);
    let (sin, cos) = now.phi.sin_cos();
    let turned = |x: f64, y: f64| {
        let (dx, dy) = (x - side * b, y);
        place((pivot.0 + dx * cos - dy * sin, pivot.1 + dx * sin + dy * cos))
    };
    let top = 2.0 * block.height;
    let corners = [(-b, 0.0), (b, 0.0), (b, top), (-b, top), (-b, 0.0)].map(|(x, y)| turned(x, y));
    canvas.polygon(corners, STONE);
    canvas.line(corners, black(0.7));
    canvas.disc(turned(block.offset(), block.height), 1.9, BLACK);
    for (x, mode) in [(-b, "rocking_left"), (b, "rocking_right")] {
        canvas.disc(turned(x, 0.0), 1.4, if now.mode == mode { RED } else { BLACK });
    }
}
