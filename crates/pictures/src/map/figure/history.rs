//! One cell's motion against time, below what shakes it.

use super::layout::{GAP, side};
use crate::colours::BLACK;
use crate::colours::palette::CURVES;
use crate::drawing::canvas::write;
use crate::drawing::canvas::{Place, Point, dashed, stroke};
use crate::drawing::error::FigureError;
use crate::drawing::frame::{Axis, BELOW, BOTH, Frame, Written};
use crate::drawing::legend::entry;
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;
use crate::drawing::swatch::{Mark, Swatch};
use crate::drawing::text::{style, wrapped};
use crate::drawing::{COLUMN, FONT, MARGIN, caption, legend};
use topple::backend::history::Row;
use topple::scene::{Case, Scene};
use topple::stepping::outcome::Outcome;
use topple::sweep::motion_of_cell::{self, What};

/// Height of a strip.
const HEIGHT: f64 = 44.0;
/// Radius of a mark.
const MARK: f64 = 1.5;

/// A coordinate of the motion: its symbol and unit, and its value in a row.
type Coordinate = (&'static str, fn(&Row) -> f64);

const COORDINATES: [Coordinate; 4] = [
    ("φ [rad]", |row| row.phi),
    ("u [m]", |row| row.u),
    ("v [m]", |row| row.v),
    ("z", |row| row.z),
];

/// A curve of the picture: symbol and unit, points, and its ends.
struct Strip {
    name: &'static str,
    points: Vec<Point>,
}

/// Draws the motion.
pub fn draw(
    scene: &Scene,
    case: &Case,
    rows: &[Row],
    outcome: &Outcome,
    print: Print,
) -> Result<Picture, FigureError> {
    let mut canvas = print.canvas(COLUMN);
    let wide = canvas.inner();
    let mut y = caption::heading(&mut canvas, scene, print.title.unwrap_or(&scene.title));
    let said = wrapped(&motion_of_cell::told(outcome), FONT, wide);
    y = write(&mut canvas, (MARGIN, y), style(FONT), &said) + GAP;
    let end = rows.last().map_or(1.0, |row| row.t).max(f64::MIN_POSITIVE);
    let [horizontal, vertical] = motion_of_cell::ground(scene, case, rows, end);
    let mut strips = vec![Strip { name: "ü_g [m/s²]", points: horizontal }];
    if vertical.iter().any(|(_, a)| *a != 0.0) {
        strips.push(Strip { name: "v\u{308}_g [m/s²]", points: vertical });
    }
    let rocking = strips.len();
    let moves = scene.isolation;
    let shown = [true, moves.moves_h(), moves.moves_v(), moves.moves_h()];
    let shown = COORDINATES.into_iter().zip(shown).filter(|(_, moves)| *moves);
    strips.extend(shown.map(|((name, value), _)| {
        let points = rows.iter().map(|row| (row.t, value(row))).collect();
        Strip { name, points }
    }));
    let critical = [1.0, -1.0].map(|side| side * case.overturning_angle(side));
    let switches = motion_of_cell::switches(rows);
    let of = |what: What| -> Vec<Point> {
        switches
            .iter()
            .filter(|switch| switch.what == what)
            .map(|switch| (switch.t, switch.phi))
            .collect()
    };
    let (uplifts, impacts) = (of(What::Uplift), of(What::Impact));
    let mut shows_critical = false;
    let count = strips.len();
    for (k, strip) in strips.iter().enumerate() {
        let (x, width) = side(&canvas);
        let place = Place { x, y, width, height: HEIGHT };
        let (low, high) = ends(&strip.points);
        let frame =
            Frame::new(place, Axis::new(0.0, end, "t [s]"), Axis::new(low, high, strip.name));
        let colour = if k < rocking { CURVES[2] } else { CURVES[0] };
        canvas.clipped(place, |canvas| {
            if k == rocking {
                for level in critical.into_iter().filter(|level| *level > low && *level < high) {
                    shows_critical = true;
                    canvas.line([(0.0, level), (end, level)].map(|at| frame.at(at)), CRITICAL);
                }
            }
            canvas.line(strip.points.iter().map(|point| frame.at(*point)), stroke(colour, 0.6));
        });
        if k == rocking {
            for at in &impacts {
                Mark::Circle.draw(&mut canvas, frame.at(*at), MARK, CURVES[1]);
            }
            for at in &uplifts {
                Mark::Triangle.draw(&mut canvas, frame.at(*at), MARK + 0.4, BLACK);
            }
        }
        frame.draw(&mut canvas, Written { x: k + 1 == count, ..BOTH });
        y += HEIGHT + GAP;
    }
    let marks = [
        (!uplifts.is_empty(), Swatch::Mark(Mark::Triangle, BLACK), "uplift"),
        (!impacts.is_empty(), Swatch::Mark(Mark::Circle, CURVES[1]), "impact"),
        (shows_critical, Swatch::Line(CRITICAL), "overturning angle"),
        (true, Swatch::Line(stroke(CURVES[2], 0.8)), "ground"),
        (true, Swatch::Line(stroke(CURVES[0], 0.8)), "block and base"),
    ];
    let shown = marks.into_iter().filter(|(shown, ..)| *shown);
    let entries: Vec<_> = shown.map(|(_, swatch, label)| entry(swatch, label)).collect();
    let top = y - GAP + BELOW + GAP;
    let bottom = legend::draw(&mut canvas, &entries, (MARGIN, top), wide, 3);
    Ok(canvas.finish(bottom + MARGIN))
}

/// The line at the angle at which the block counts as overturned.
const CRITICAL: crate::drawing::canvas::Stroke = dashed(CURVES[1], 0.5, (2.0, 1.5));

/// The ends of a strip: those of its values, and some room.
fn ends(points: &[Point]) -> (f64, f64) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (_, y) in points {
        (low, high) = (low.min(*y), high.max(*y));
    }
    let mut margin = 0.1 * (high - low);
    if !(margin > 0.0) {
        (low, high) = if low.is_finite() { (low, low) } else { (0.0, 0.0) };
        margin = 0.5 * low.abs().max(1.0e-3);
    }
    (low - margin, high + margin)
}
