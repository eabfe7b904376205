//! Cells in motion, side by side, as an animated GIF: block, plates and corners above, the rocking
//! angle below.

use plotters::prelude::*;

use super::marks;
use crate::map::figure::FigureError;
use crate::map::figure::document::{FINE, Place, pixels};
use crate::map::figure::frame::{Area, Axes, Drawn, Named, at, document, frame, stroke, text};
use crate::map::figure::palette::Kind;
use crate::scene::{Case, GRAVITY, Scene};
use crate::stepping::outcome::Outcome;
use crate::sweep::history::Row;

/// Frames a second.
const RATE: f64 = 12.5;
/// Hundredths of a second that the last frame stays.
const HOLD: u16 = 200;
/// Width of a cell's column.
const COLUMN: i32 = 250;
/// Height of the figure.
const HEIGHT: i32 = 470;
/// Where the ground is.
const GROUND: i32 = 320;
/// Units a metre.
const SCALE: f64 = 100.0;
/// Half of a plate's width, and its thickness, m.
const PLATE: (f64, f64) = (0.5, 0.05);
/// Height of the upper plate's foot above the ground at rest, m.
const REST: f64 = 0.32;

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
///
/// # Errors
/// Any [`FigureError`].
pub fn draw(title: &str, cells: &[Moving]) -> Result<Vec<u8>, FigureError> {
    let seconds = cells.iter().map(|moving| moving.cell.seconds).fold(0.0, f64::max);
    let frames = (seconds * RATE).ceil() as u32;
    let failed = |reason: String| FigureError::Encode(reason);
    let (width, height) = size(cells);
    let side = |length: u32| {
        u16::try_from(length).map_err(|_| failed(format!("{length} pixels are too many")))
    };
    let (width, height) = (side(width)?, side(height)?);
    let mut bytes = Vec::new();
    let mut encoder =
        gif::Encoder::new(&mut bytes, width, height, &[]).map_err(|e| failed(e.to_string()))?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(|e| failed(e.to_string()))?;
    for k in 0..=frames {
        let mut rgba = pixels(&still(title, cells, f64::from(k) / RATE)?)?;
        let mut frame = gif::Frame::from_rgba_speed(width, height, &mut rgba, 10);
        frame.delay = if k == frames { HOLD } else { (100.0 / RATE) as u16 };
        encoder.write_frame(&frame).map_err(|e| failed(e.to_string()))?;
    }
    drop(encoder);
    Ok(bytes)
}

/// Size of the picture.
fn size(cells: &[Moving]) -> (u32, u32) {
    ((COLUMN * cells.len() as i32) as u32, HEIGHT as u32)
}

/// The picture at a time, as SVG.
///
/// # Errors
/// Any [`FigureError`].
pub fn still(title: &str, cells: &[Moving], t: f64) -> Result<String, FigureError> {
    let size = size(cells);
    document(size, &[], |root| {
        root.draw(&Text::new(format!("{title}, t = {t:.2} s"), at(14, 10), text(16)))?;
        for (k, moving) in cells.iter().enumerate() {
            column(root, size, COLUMN * k as i32, moving, t)?;
        }
        Ok(())
    })
}

fn column(root: &Area, size: (u32, u32), left: i32, moving: &Moving, t: f64) -> Drawn<()> {
    root.draw(&Text::new(Kind::of(&moving.outcome).label(), at(left + 14, 38), text(14)))?;
    let Some(now) = moving.at(t) else { return Ok(()) };
    let case = moving.scene.case();
    sketch(root, left + COLUMN / 2, &case, &now)?;
    let critical = |side: f64| case.overturning_angle(side);
    let most = 1.15 * critical(1.0).max(critical(-1.0));
    let place = Place { x: left + 52, y: GROUND + 26, width: COLUMN - 66, height: 84 };
    let x = Named { ends: 0.0..moving.cell.seconds, name: "t [s]".into() };
    let y = Named { ends: -most..most, name: "φ [rad]".into() };
    let set = Axes { size, plot: place, room: (Some(46), Some(36)), font: 10 };
    let mut plot = frame(root, &set, (&x, &y))?;
    for side in [1.0, -1.0] {
        let level = [(0.0, side * critical(side)), (moving.cell.seconds, side * critical(side))];
        plot.draw_series(LineSeries::new(level, stroke(RGBColor(0xd6, 0x2f, 0x2a), 7)))?;
    }
    let past = moving.rows.iter().take_while(|row| row.t <= now.t);
    let blue = RGBColor(0x2c, 0x5f, 0xb8);
    plot.draw_series(LineSeries::new(past.map(|row| (row.t, row.phi)), stroke(blue, 14)))?;
    let dot = Circle::new((now.t.min(moving.cell.seconds), now.phi), 3 * FINE, blue.filled());
    plot.draw_series([dot])?;
    if moving.rows.last().is_some_and(|row| t >= row.t) && moving.outcome.class.overturned() {
        root.draw(&Text::new("overturned", at(left + 14, 58), text(13).color(&RED)))?;
    }
    Ok(())
}

/// Draws block, plates and isolators. The base's displacements are relative to the ground, the
/// vertical one to its static deflection.
fn sketch(root: &Area, middle: i32, case: &Case, now: &Row) -> Drawn<()> {
    let (block, base) = (&case.block, &case.isolation);
    let static_v = base.vertical.as_ref().map_or(0.0, |law| {
        let omega_v = std::f64::consts::TAU / law.t_v;
        -GRAVITY / (omega_v * omega_v)
    });
    let (u, v) = (now.u, now.v - static_v);
    let place = |x: f64, y: f64| {
        let unit = SCALE * f64::from(FINE);
        (middle * FINE + (x * unit) as i32, GROUND * FINE - (y * unit) as i32)
    };
    let (half, thick) = PLATE;
    let line = |points: &[(f64, f64)], width: i32| {
        let points: Vec<(i32, i32)> = points.iter().map(|(x, y)| place(*x, *y)).collect();
        PathElement::new(points, stroke(BLACK, width))
    };
    root.draw(&line(&[(-1.15, 0.0), (1.15, 0.0)], 20))?;
    let plate = |x: f64, y: f64| {
        let corners = [(x - half, y), (x + half, y), (x + half, y + thick), (x - half, y + thick)];
        let corners: Vec<(i32, i32)> = corners.iter().map(|(x, y)| place(*x, *y)).collect();
        Polygon::new(corners, RGBColor(0x9a, 0xa3, 0xad).filled())
    };
    let low = 0.04;
    root.draw(&plate(u, low))?;
    root.draw(&plate(u, REST + v))?;
    // Rollers and a spring to the left; springs between the plates.
    for x in [-0.35, 0.0, 0.35] {
        root.draw(&Circle::new(place(u + x, low / 2.0), 2 * FINE, BLACK.filled()))?;
    }
    root.draw(&line(&[(-1.0, 0.0), (-1.0, 0.16)], 16))?;
    root.draw(&line(&zigzag((-1.0, low + thick / 2.0), (u - half, low + thick / 2.0)), 9))?;
    for x in [-0.3, 0.3] {
        root.draw(&line(&zigzag((u + x, low + thick), (u + x, REST + v)), 9))?;
    }
    // The block turns about the left corner for phi > 0, about the right one for phi < 0.
    let b = block.half_width;
    let side = if now.phi >= 0.0 { -1.0 } else { 1.0 };
    let pivot = (u + side * b, REST + v + thick);
    let (sin, cos) = now.phi.sin_cos();
    let turned = |x: f64, y: f64| {
        let (dx, dy) = (x - side * b, y);
        (pivot.0 + dx * cos - dy * sin, pivot.1 + dx * sin + dy * cos)
    };
    let top = 2.0 * block.height;
    let corners = [(-b, 0.0), (b, 0.0), (b, top), (-b, top), (-b, 0.0)].map(|(x, y)| turned(x, y));
    let filled: Vec<(i32, i32)> = corners.iter().map(|(x, y)| place(*x, *y)).collect();
    root.draw(&Polygon::new(filled, RGBColor(0xf2, 0xe2, 0xc0).filled()))?;
    root.draw(&line(&corners, 14))?;
    let centre = turned(block.offset(), block.height);
    root.draw(&Circle::new(place(centre.0, centre.1), 4 * FINE, BLACK.filled()))?;
    for (x, mode) in [(-b, "rocking_left"), (b, "rocking_right")] {
        let at = turned(x, 0.0);
        let colour = if now.mode == mode { RED } else { BLACK };
        root.draw(&Circle::new(place(at.0, at.1), 3 * FINE, colour.filled()))?;
    }
    Ok(())
}

/// A spring from one point to another.
fn zigzag(from: (f64, f64), to: (f64, f64)) -> Vec<(f64, f64)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let length = dx.hypot(dy).max(f64::MIN_POSITIVE);
    let (nx, ny) = (-dy / length * 0.035, dx / length * 0.035);
    let bends = 8;
    (0..=bends)
        .map(|k| {
            let share = f64::from(k) / f64::from(bends);
            let off = match k {
                0 => 0.0,
                k if k == bends => 0.0,
                k if k % 2 == 0 => 1.0,
                _ => -1.0,
            };
            (from.0 + dx * share + off * nx, from.1 + dy * share + off * ny)
        })
        .collect()
}
