//! The picture of an envelope: the share of the motions under which the block stands, the limits, and what is
//! feasible.

use super::of_standing;
use crate::colours::BLACK;
use crate::colours::palette::{FEASIBLE, LIMITS};
use crate::colours::print_palette::Palette;
use crate::drawing::canvas::{Place, Point, Stroke, dashed, stroke};
use crate::drawing::error::FigureError;
use crate::drawing::frame::{Axis, BELOW, BOTH};
use crate::drawing::legend::{self, entry};
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;
use crate::drawing::raster::png;
use crate::drawing::share::given;
use crate::drawing::swatch::{Mark, Swatch};
use crate::drawing::{COLUMN, MARGIN, caption, scale};
use crate::map::boundaries::{Line, contours};
use crate::map::figure::layout::{frame, side};
use topple::scene::words;
use topple_studies::suites::envelope::{Best, Envelope};

/// Greys of a share of none and of all motions.
const NONE: f64 = 70.0;
const ALL: f64 = 248.0;
/// The same of all motions in greys, where what is feasible is white.
const ALL_IN_GREYS: f64 = 205.0;
/// Lines of the limits.
const STANDING: Stroke = stroke(BLACK, 0.9);
const LIMIT_U: Stroke = dashed(LIMITS[0], 0.9, (3.2, 2.0));
const LIMIT_V: Stroke = dashed(LIMITS[1], 0.9, (1.2, 1.6));

/// Differences of sums of weights that are roundings.
const ROUNDING: f64 = 1.0e-9;

/// The level of the line around the cells whose share is the least or more. A share that is just reached would lie on a line at
/// its own level: this one is in the middle of the gap below it, which is that to the next share of the map, and at most that of
/// one of the motions, if these have equal weights.
pub fn border(least: f64, shares: impl Iterator<Item = f64>, motions: usize) -> f64 {
    let gaps = shares.map(|share| least - share).filter(|gap| *gap > ROUNDING);
    least - 0.5 * gaps.fold(1.0 / motions as f64, f64::min)
}

/// Draws an envelope over two axes; none where there are not two of several values.
pub fn draw(
    envelope: &Envelope,
    title: &str,
    print: Print,
) -> Result<Option<Picture>, FigureError> {
    let grid = &envelope.sweep.grid;
    let (columns, rows) = grid.shape();
    if grid.axes().len() != 2 || columns < 2 || rows < 2 {
        return Ok(None);
    }
    let mut canvas = print.canvas(COLUMN);
    let most = canvas.inner();
    let top = caption::titled(
        &mut canvas,
        print.title.unwrap_or(title),
        &words::fixed(&envelope.known()),
    ) + MARGIN;
    let (x, side) = side(&canvas);
    let place = Place { x, y: top, width: side, height: side };
    let frame = frame(place, grid);
    // From a tenth below the least share on, so that large ones are told apart.
    let least = envelope.cells.iter().map(|cell| cell.standing).fold(1.0, f64::min);
    let from = ((10.0 * least).floor() / 10.0).min(0.9);
    let palette = canvas.palette();
    let all = if palette == Palette::Grey { ALL_IN_GREYS } else { ALL };
    let grey = move |share: f64| (NONE + (all - NONE) * (share - from) / (1.0 - from)) as u8;
    let [r, g, b] = palette.of(FEASIBLE.0);
    let feasible = [r, g, b, 255];
    let image = png((columns, rows), |column, row| {
        let cell = &envelope.cells[(rows - 1 - row) * columns + column];
        match cell.feasible {
            true => feasible,
            false => [grey(cell.standing), grey(cell.standing), grey(cell.standing), 255],
        }
    })?;
    canvas.image(place, &image, true);
    let limits = envelope.settings.limits;
    let lines = |value: fn(&topple_studies::suites::envelope::CellEnvelope) -> f64,
                 level: f64|
     -> Vec<Line> {
        let known: Vec<Option<f64>> =
            envelope.cells.iter().map(|cell| Some(value(cell)).filter(|v| !v.is_nan())).collect();
        contours(grid, &known, &[level]).pop().unwrap_or_default()
    };
    let shares = envelope.cells.iter().map(|cell| cell.standing);
    let border = border(limits.standing, shares, envelope.sweep.motions.len());
    let all = [
        (lines(|cell| cell.standing, border), STANDING),
        (limits.u.map_or(Vec::new(), |u| lines(|cell| cell.max_u[2], u)), LIMIT_U),
        (limits.v.map_or(Vec::new(), |v| lines(|cell| cell.stroke_v[2], v)), LIMIT_V),
    ];
    let best = envelope.best().first().map(|cell| grid.place(*cell));
    canvas.clipped(place, |canvas| {
        for (lines, stroke) in &all {
            for line in lines {
                canvas.line(line.iter().map(|point| frame.at(*point)), *stroke);
            }
        }
        if let Some(at) = best {
            let coordinate = |axis: usize| grid.axes()[axis].values.coordinate(at[axis] as f64);
            let point: Point = (coordinate(0), coordinate(1));
            Mark::Disc.draw(canvas, frame.at(point), 2.0, BLACK);
        }
    });
    frame.draw(&mut canvas, BOTH);
    let axis = Axis::new(from, 1.0, "share of the motions under which the block stands");
    let at = (place.x, place.bottom() + BELOW + MARGIN);
    let shade = |share: f64| [grey(from + (1.0 - from) * share); 3];
    let bottom = scale::draw(&mut canvas, at, side, axis, shade)?;
    let standing = match limits.standing {
        1.0 => "border of standing under all motions".to_string(),
        share => format!("border of standing under {} of the motions", given(share)),
    };
    let [around, of_u, of_v] = all.each_ref().map(|(lines, _)| !lines.is_empty());
    let feasible = best.is_some();
    let mut entries = Vec::new();
    entries.extend(feasible.then(|| entry(Swatch::Fill(FEASIBLE.0), "all limits are kept")));
    entries.extend(around.then(|| entry(Swatch::Line(STANDING), standing)));
    let limit = |of: &str, limit: f64| format!("limit of {of}: {limit} m");
    let u = limits.u.filter(|_| of_u);
    entries.extend(u.map(|u| entry(Swatch::Line(LIMIT_U), limit("max |u|", u))));
    let v = limits.v.filter(|_| of_v);
    entries.extend(v.map(|v| entry(Swatch::Line(LIMIT_V), limit("the stroke of v", v))));
    if !feasible {
        entries.push(entry(Swatch::None, "No cell keeps all limits."));
    }
    let which = match envelope.settings.best {
        Best::Reserve => {
            "the best of these: the most steps from a cell that does not keep all limits"
        }
        Best::StrokeU => "the best of these: the least |u|",
        Best::StrokeV => "the best of these: the least stroke of v",
    };
    entries.extend(best.map(|_| entry(Swatch::Mark(Mark::Disc, BLACK), which)));
    let at = (MARGIN, bottom + MARGIN);
    let end = legend::draw(&mut canvas, &entries, at, most, 2);
    let shown = u.or(v).is_some();
    let end = of_standing(&mut canvas, envelope.cells.iter().filter(|_| shown), end, most);
    Ok(Some(canvas.finish(end + MARGIN)))
}
