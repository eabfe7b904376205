//! The picture of a comparison: one row per device, with the shares of its motions, its strokes, and how much stronger the motions may
//! be.

use super::of_standing;
use crate::colours::palette::{CURVES, FALLEN, Kind, LIMITS};
use crate::colours::{BLACK, Colour};
use crate::drawing::canvas::{Canvas, Place, Stroke, dashed, stroke};
use crate::drawing::frame::{Axis, BELOW, Frame, Written};
use crate::drawing::legend::{self, Entry, entry};
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;
use crate::drawing::share::given;
use crate::drawing::swatch::{Mark, Swatch};
use crate::drawing::text::{MIDDLE, shortened, style, width};
use crate::drawing::{FONT, MARGIN, MILLIMETRE, caption};
use topple::scene::{Parameter, Scene, Values};
use topple_studies::comparison::{Compared, Comparison};
use topple_studies::suites::envelope::{CellEnvelope, SHARES};

/// Most devices that are drawn.
pub const MOST: usize = 100;
/// Width of the picture, points.
const WIDTH: f64 = 140.0 * MILLIMETRE;
/// Share of it that names take at most.
const NAMES: f64 = 0.3;
/// Height of a row, and of a bar in it.
const ROW: f64 = 15.0;
const BAR: f64 = 8.0;
/// Between two panels.
const GAP: f64 = 12.0;
/// From the least to the largest of a device's strokes.
const SPAN: Stroke = stroke(CURVES[0], 0.9);
/// Around a bar: in greys the lightest one is that of the paper.
const EDGE: Stroke = stroke(BLACK, 0.4);
/// The marks of the percentiles.
const MARKS: [Mark; 3] = [Mark::Circle, Mark::Triangle, Mark::Disc];
const LIMIT_U: Stroke = dashed(LIMITS[0], 0.9, (3.2, 2.0));
const LIMIT_V: Stroke = dashed(LIMITS[1], 0.9, (1.2, 1.6));
/// Where the motions are as they are.
const PLAIN: Stroke = dashed(BLACK, 0.5, (1.2, 1.6));

/// What a panel has of a device.
enum Shown<'a> {
    Shares,
    Strokes(&'a dyn Fn(&CellEnvelope) -> [f64; 3], Option<(f64, Stroke)>),
    Reserve,
}

/// A panel with its name.
struct Panel<'a> {
    name: &'a str,
    shown: Shown<'a>,
}

/// Draws a comparison; none of more devices than [`MOST`].
pub fn draw(comparison: &Comparison, title: &str, print: Print) -> Option<Picture> {
    let count = comparison.devices.len();
    if count > MOST {
        return None;
    }
    let limits = comparison.settings.limits;
    let rows: Vec<(&str, &Compared)> = comparison.rows().collect();
    let mut canvas = print.canvas(WIDTH);
    let whole = canvas.inner();
    let motions = motions(&comparison.sweep.scene);
    let told = [standing(limits.standing), motions.clone()];
    let top = caption::titled(&mut canvas, print.title.unwrap_or(title), &told) + 2.0 * MARGIN;
    let names: Vec<String> =
        rows.iter().map(|(name, _)| shortened(name, FONT, NAMES * canvas.width())).collect();
    let left = names.iter().map(|name| width(name, FONT)).fold(0.0, f64::max);
    let left = MARGIN + left + 4.0;
    let moves =
        |of: fn(&CellEnvelope) -> [f64; 3]| rows.iter().any(|(_, row)| of(&row.cell)[2] > 0.0);
    let mut panels = vec![Panel { name: "share of the motions", shown: Shown::Shares }];
    if moves(|cell| cell.max_u) {
        let limit = limits.u.map(|limit| (limit, LIMIT_U));
        panels
            .push(Panel { name: "max |u| [m]", shown: Shown::Strokes(&|cell| cell.max_u, limit) });
    }
    if moves(|cell| cell.stroke_v) {
        let limit = limits.v.map(|limit| (limit, LIMIT_V));
        let shown = Shown::Strokes(&|cell| cell.stroke_v, limit);
        panels.push(Panel { name: "stroke of v [m]", shown });
    }
    if !comparison.settings.scales.is_empty() {
        panels.push(Panel { name: "reserve", shown: Shown::Reserve });
    }
    let wide = (whole - left - GAP * (panels.len() - 1) as f64) / panels.len() as f64;
    let height = ROW * count as f64;
    for (at, name) in names.iter().enumerate() {
        let y = top + ROW * (at as f64 + 0.5) + MIDDLE * FONT;
        canvas.text((left - 4.0, y), style(FONT).end(), name);
    }
    for (number, panel) in panels.iter().enumerate() {
        let x = left + (wide + GAP) * number as f64;
        paint(&mut canvas, comparison, panel, Place { x, y: top, width: wide, height });
    }
    let at = (MARGIN, top + height + BELOW + MARGIN);
    let end = legend::draw(&mut canvas, &entries(&panels, &motions), at, whole, 3);
    let strokes = panels.iter().any(|panel| matches!(panel.shown, Shown::Strokes(..)));
    let cells = rows.iter().filter(|_| strokes).map(|(_, row)| &row.cell);
    let end = of_standing(&mut canvas, cells, end, whole);
    Some(canvas.finish(end + MARGIN))
}

/// The motions in words: by what they are multiplied.
fn motions(scene: &Scene) -> String {
    let of = |one: Parameter| scene.numbers.get(one).and_then(Values::single);
    match (of(Parameter::Scale).filter(|scale| *scale != 1.0), of(Parameter::Pga)) {
        (Some(scale), _) => format!("each motion times {scale}"),
        (None, Some(pga)) => format!("each motion scaled to a PGA of {pga} m/s²"),
        (None, None) => "the motions as they are".into(),
    }
}

/// What must stand, in words.
fn standing(share: f64) -> String {
    match share {
        1.0 => "the block is to stand under all motions".into(),
        share => format!("the block is to stand under {} of the motions", given(share)),
    }
}

/// Draws a panel: one row per device.
fn paint(canvas: &mut Canvas, comparison: &Comparison, panel: &Panel, place: Place) {
    let rows = &comparison.devices;
    let most = match &panel.shown {
        Shown::Shares => 1.0,
        Shown::Strokes(of, limit) => {
            let known = rows.iter().flat_map(|row| of(&row.cell)).filter(|value| value.is_finite());
            let limit = limit.map(|(limit, _)| limit);
            1.06 * known.chain(limit).fold(0.0, f64::max)
        }
        Shown::Reserve => 1.06 * comparison.settings.scales.last().copied().unwrap_or(1.0).max(1.0),
    };
    let x = Axis::new(0.0, if most > 0.0 { most } else { 1.0 }, panel.name);
    let frame = Frame::new(place, x, Axis::new(0.0, 1.0, ""));
    frame.draw_grid(canvas);
    let across = |value: f64| frame.at((value, 0.0)).0;
    let bar = |canvas: &mut Canvas, row: usize, (from, to): (f64, f64), colour: Colour| {
        let y = place.y + ROW * (row as f64 + 0.5) - 0.5 * BAR;
        let (x, width) = (across(from), across(to) - across(from));
        // Nothing has no edge.
        if width > 0.0 {
            canvas.fill(Place { x, y, width, height: BAR }, colour);
            canvas.outline(Place { x, y, width, height: BAR }, EDGE);
        }
    };
    canvas.clipped(place, |canvas| {
        for (row, device) in rows.iter().enumerate() {
            let y = place.y + ROW * (row as f64 + 0.5);
            let cell = &device.cell;
            match &panel.shown {
                Shown::Shares => {
                    let contact = (cell.standing - cell.rocked).max(0.0);
                    bar(canvas, row, (0.0, contact), Kind::FullContact.colour());
                    bar(canvas, row, (contact, cell.standing), Kind::Rocking.colour());
                    bar(canvas, row, (1.0 - cell.overturned, 1.0), FALLEN);
                }
                Shown::Strokes(of, _) => {
                    let values = of(cell);
                    // A base that does not move has no stroke.
                    if values[2] > 0.0 {
                        canvas.line([(across(values[0]), y), (across(values[2]), y)], SPAN);
                        // The largest lies over the others where they are the same.
                        for (value, mark) in values.iter().zip(MARKS) {
                            mark.draw(canvas, (across(*value), y), 1.9, CURVES[0]);
                        }
                    }
                }
                Shown::Reserve => {
                    let keeps = device.reserve.and_then(|reserve| reserve.keeps).unwrap_or(0.0);
                    bar(canvas, row, (0.0, keeps), CURVES[0]);
                }
            }
        }
        let line = match &panel.shown {
            Shown::Strokes(_, limit) => *limit,
            Shown::Reserve => Some((1.0, PLAIN)),
            Shown::Shares => None,
        };
        if let Some((value, line)) = line {
            let x = across(value);
            canvas.line([(x, place.y), (x, place.bottom())], line);
        }
    });
    frame.draw(canvas, Written { x: true, y: false, beyond: 5.0 });
}

/// The legend of what is drawn.
fn entries(panels: &[Panel], motions: &str) -> Vec<Entry> {
    let mut entries = vec![
        entry(Swatch::Fill(Kind::FullContact.colour()), "full contact"),
        entry(Swatch::Fill(Kind::Rocking.colour()), "rocks and stands"),
        entry(Swatch::Fill(FALLEN), "overturns"),
    ];
    let strokes = |panel: &&Panel| matches!(panel.shown, Shown::Strokes(..));
    if panels.iter().any(|panel| strokes(&panel)) {
        for (mark, share) in MARKS.into_iter().zip(SHARES) {
            let text = format!("not exceeded under {} of the motions", given(share));
            entries.push(entry(Swatch::Mark(mark, CURVES[0]), text));
        }
    }
    for panel in panels {
        if let Shown::Strokes(_, Some((limit, line))) = panel.shown {
            let of = panel.name.trim_end_matches(" [m]");
            entries.push(entry(Swatch::Line(line), format!("limit of {of}: {limit} m")));
        }
        if matches!(panel.shown, Shown::Reserve) {
            let text =
                "reserve: largest further factor on the motions up to which all limits are kept";
            entries.push(entry(Swatch::Fill(CURVES[0]), text));
            entries.push(entry(Swatch::Line(PLAIN), format!("factor 1: {motions}")));
        }
    }
    entries
}
