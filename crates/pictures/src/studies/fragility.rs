//! The pictures of a study: curves of one cell, medians along one axis, maps of theta and beta over two.

use crate::colours::palette::STATES;
use crate::colours::{BLACK, Colour};
use crate::drawing::canvas::{Canvas, Place, Point, dashed, stroke};
use crate::drawing::error::FigureError;
use crate::drawing::frame::{Axis, BELOW, BOTH, Frame, LEFT, Written};
use crate::drawing::legend::{self, Entry, entry};
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;
use crate::drawing::swatch::{Mark, Swatch};
use crate::drawing::{COLUMN, FONT, MARGIN, caption};
use topple::Written as _;
use topple::scene::grid;
use topple::scene::words;
use topple_studies::fragility::estimate::Estimate;
use topple_studies::fragility::study::{FragilityStudy, StateStudy};
use topple_studies::fragility::{Curve, HazardCurve, Lognormal};
use topple_studies::suites::intensity::Intensity;

/// Height of a plot of curves.
const HEIGHT: f64 = 150.0;
const MARKS: [Mark; 4] = [Mark::Disc, Mark::Triangle, Mark::Cross, Mark::Circle];
/// Points of a curve.
const POINTS: u32 = 200;
/// Width of a curve, and its dashes beyond the data.
const CURVE: f64 = 1.1;
const BEYOND: (f64, f64) = (3.2, 2.0);
/// Opacity of a band, and the width of its edges.
const BAND: f64 = 0.18;
const EDGE: f64 = 0.35;
/// How far the axis goes beyond the levels at most, where a hazard curve does: rates come from there, too.
const FURTHER: f64 = 4.0;

/// The title, what is fixed, and where the plot below begins.
pub(super) fn begin(study: &FragilityStudy, title: &str, print: Print) -> (Canvas, f64) {
    let mut canvas = print.canvas(COLUMN);
    let mut parts = words::fixed(&study.known());
    if let Some(unknown) = &study.settings.unknown {
        let varied = unknown.varied.iter().map(|varied| varied.parameter.entry().symbol);
        parts.push(format!("varied: {}", varied.collect::<Vec<_>>().join(", ")));
    }
    let top = caption::titled(&mut canvas, title, &parts);
    (canvas, top + MARGIN)
}

/// Draws the curves of a study of one cell: the shares of the records that fail at each level, by weight, and what the first
/// estimator makes of them, dashed where no data are: below the lowest level at which a record fails, above the highest level.
pub fn curves(study: &FragilityStudy, intensity: Intensity, print: Print) -> Picture {
    let title = format!("Fragility under {} motions", study.records().count());
    let (mut canvas, top) = begin(study, print.title.unwrap_or(&title), print);
    let wide = canvas.inner();
    let x = MARGIN + LEFT;
    let place = Place { x, y: top, width: canvas.inner() - x, height: HEIGHT };
    let levels = study.settings.levels.iter().flatten();
    let (low, high) =
        levels.fold((f64::MAX, 0.0_f64), |(low, high), level| (low.min(*level), high.max(*level)));
    let (low, high) = if high > 1.05 * low { (low, high) } else { (0.8 * low, 1.25 * high) };
    let (low, high) = match study.settings.hazard.as_ref().map(HazardCurve::ends) {
        Some([first, last]) => (first.clamp(low / FURTHER, low), last.clamp(high, FURTHER * high)),
        None => (low, high),
    };
    let axis = Axis::log(low, high, intensity.label());
    let frame = Frame::new(place, axis, Axis::new(0.0, 1.0, "probability"));
    let mut entries: Vec<Entry> = Vec::new();
    let level = |k: u32| low * (high / low).powf(f64::from(k) / f64::from(POINTS));
    // The curve with another theta: in ln x it is shifted.
    let through = |of: Curve, theta: f64, others: [f64; 2]| -> Vec<Point> {
        let mut points: Vec<f64> = (0..=POINTS).map(level).chain(others).collect();
        points.sort_by(f64::total_cmp);
        points
            .into_iter()
            .map(|x| frame.at((x.log10(), of.probability(x * (of.theta / theta)))))
            .collect()
    };
    let one = study.cells[0].states.iter().zip(&study.settings.states);
    canvas.clipped(place, |canvas| {
        let mut edges: Vec<(Vec<Point>, Colour)> = Vec::new();
        for (k, (of, _)) in one.clone().enumerate() {
            let fit = &of.estimates[0];
            // Curves between theta's bounds: beta is that of the fit.
            if let (Some(from), Some(to), Some(of), Some(_)) =
                (fit.theta_low, fit.theta_high, fit.curve, fit.beta)
            {
                let [left, right] = [from, to].map(|theta| through(of, theta, [low, high]));
                // One band does not hide another.
                let colour = STATES[k % STATES.len()].0;
                let around = left.iter().chain(right.iter().rev()).copied();
                canvas.polygon_through(around, colour, BAND);
                edges.extend([left, right].map(|edge| (edge, colour)));
            }
        }
        for (k, (of, state)) in one.clone().enumerate() {
            let (colour, _) = STATES[k % STATES.len()];
            let fit = &of.estimates[0];
            if let Some(theta) = fit.theta {
                let fails = of.stripes.iter().find(|stripe| stripe.z > 0.0);
                let ends = fails
                    .zip(of.stripes.last())
                    .map_or([high; 2], |(from, to)| [from.level, to.level]);
                let own = fit.curve.unwrap_or_else(|| Lognormal { theta, beta: 0.0 }.into());
                let line = through(own, theta, ends);
                let [from, to] = ends.map(|level| frame.at((level.log10(), 0.0)).0);
                let part = |within: &dyn Fn(f64) -> bool| -> Vec<Point> {
                    line.iter().copied().filter(|(x, _)| within(*x)).collect()
                };
                let beyond = dashed(colour, CURVE, BEYOND);
                if ends[0] > low {
                    canvas.line(part(&|x| x <= from), beyond);
                }
                if ends[1] < high {
                    canvas.line(part(&|x| x >= to), beyond);
                }
                canvas.line(part(&|x| (from..=to).contains(&x)), stroke(colour, CURVE));
            }
            let line = stroke(colour, CURVE);
            let swatch = match has_shares(of) {
                true => Swatch::Curve(line, MARKS[k % MARKS.len()]),
                false => Swatch::Line(line),
            };
            entries.push(entry(swatch, format!("{}: {}", state.words(), told(fit))));
        }
        // Where bands overlap, their edges tell them apart.
        for (edge, colour) in edges {
            canvas.line(edge, stroke(colour, EDGE));
        }
    });
    frame.draw(&mut canvas, BOTH);
    // Marks lie above the bands and the lines of all limit states, and whole on the frame.
    for (k, (of, _)) in one.enumerate().filter(|(_, (of, _))| has_shares(of)) {
        let ((colour, _), mark) = (STATES[k % STATES.len()], MARKS[k % MARKS.len()]);
        for stripe in &of.stripes {
            let at = frame.at((stripe.level.log10(), stripe.z / stripe.n));
            mark.draw(&mut canvas, at, 1.6, colour);
        }
    }
    let by = study.settings.estimators[0].key();
    let marks = match (has_shares(&study.cells[0].states[0]), study.is_weighted()) {
        (false, _) => "",
        (true, false) => "Marks: shares of the motions that make the block fail. ",
        (true, true) => "Marks: shares of the motions by weight that make the block fail. ",
    };
    let beyond = "dashed where no motion supports them: below the lowest level at which the block fails, and above the highest level";
    let lines = format!("{marks}Lines: curves fitted by the estimator {by}, {beyond}.");
    entries.push(entry(Swatch::None, lines));
    if has_bands(study) {
        entries.push(entry(Swatch::None, "Bands: the curve with θ anywhere in its 95 % interval."));
    }
    let at = (MARGIN, place.bottom() + BELOW + MARGIN);
    let end = legend::draw(&mut canvas, &entries, at, wide, 1);
    canvas.finish(end + MARGIN)
}

/// True where a curve has a band: an interval of θ with two ends.
fn has_bands(study: &FragilityStudy) -> bool {
    let fits = study.cells[0].states.iter().map(|of| &of.estimates[0]);
    let ends = |fit: &Estimate| fit.theta_low.and(fit.theta_high).and(fit.beta);
    fits.map(ends).any(|end| end.is_some())
}

/// True where levels have several runs, as stripes: one of a record at its own level is no share.
fn has_shares(of: &StateStudy) -> bool {
    of.counts.iter().any(|(_, records, _)| *records > 1)
}

/// A fit in words, two digits of beta.
fn told(fit: &Estimate) -> String {
    match (fit.theta, fit.beta) {
        (Some(theta), Some(beta)) => format!("θ = {}, β = {beta:.2}", digits(theta)),
        (Some(theta), None) => match (fit.theta_low, fit.theta_high) {
            (Some(low), Some(high)) => format!("θ from {} to {}", digits(low), digits(high)),
            _ => format!("θ about {}, no interval", digits(theta)),
        },
        _ => "no curve".into(),
    }
}

/// A number of three digits.
pub(super) fn digits(value: f64) -> String {
    topple::scene::record::rounded(value, 3).to_string()
}

/// Draws theta of each limit state along an axis, with its interval.
pub fn along(
    study: &FragilityStudy,
    axis: &grid::Axis,
    intensity: Intensity,
    print: Print,
) -> Picture {
    let title = format!("Median fragility under {} motions", study.records().count());
    let (mut canvas, top) = begin(study, print.title.unwrap_or(&title), print);
    let wide = canvas.inner();
    let x = MARGIN + LEFT;
    let place = Place { x, y: top, width: canvas.inner() - x, height: HEIGHT };
    let fits = |state: usize| study.cells.iter().map(move |cell| &cell.states[state].estimates[0]);
    let states = &study.settings.states;
    let most = (0..states.len())
        .flat_map(|state| fits(state).filter_map(|fit| fit.theta))
        .fold(0.0_f64, f64::max);
    let most = if most > 0.0 { 1.15 * most } else { 1.0 };
    let frame = Frame::new(
        place,
        Axis::of(Some(axis)),
        Axis::new(0.0, most, format!("θ: {}", intensity.label())),
    );
    let mut entries: Vec<Entry> = Vec::new();
    let place_of = |cell: usize, value: f64| frame.at((axis.values.coordinate(cell as f64), value));
    canvas.clipped(place, |canvas| {
        for k in 0..states.len() {
            let (_, band) = STATES[k % STATES.len()];
            for (cell, fit) in fits(k).enumerate() {
                if let (Some(low), Some(high)) = (fit.theta_low, fit.theta_high) {
                    canvas.line([place_of(cell, low), place_of(cell, high)], stroke(band, 2.0));
                }
            }
        }
        let points = |k: usize| -> Vec<Option<Point>> {
            let place = |(cell, fit): (usize, &Estimate)| Some(place_of(cell, fit.theta?));
            fits(k).enumerate().map(place).collect()
        };
        for (k, state) in states.iter().enumerate() {
            let (colour, _) = STATES[k % STATES.len()];
            for part in points(k).split(Option::is_none) {
                canvas.line(part.iter().flatten().copied(), stroke(colour, 0.9));
            }
            let swatch = Swatch::Curve(stroke(colour, 0.9), MARKS[k % MARKS.len()]);
            entries.push(entry(swatch, state.words()));
        }
        // Marks lie above the bars and the lines of all limit states.
        for k in 0..states.len() {
            let ((colour, _), mark) = (STATES[k % STATES.len()], MARKS[k % MARKS.len()]);
            for point in points(k).into_iter().flatten() {
                mark.draw(canvas, point, 1.4, colour);
            }
        }
    });
    frame.draw(&mut canvas, BOTH);
    let by = study.settings.estimators[0].key();
    entries.push(entry(Swatch::None, format!("Estimated by {by}; bars: 95 % intervals of θ.")));
    let at = (MARGIN, place.bottom() + BELOW + MARGIN);
    let end = legend::draw(&mut canvas, &entries, at, wide, 2);
    canvas.finish(end + MARGIN)
}

/// Draws maps of theta and of beta of a limit state, the state's number, beside each other; `target` are rates, with
/// all that may be missing, whose line is drawn, cell by cell, none where they are not known.
pub fn maps(
    study: &FragilityStudy,
    state: usize,
    intensity: Intensity,
    target: Option<(&[Option<f64>], f64)>,
    print: Print,
) -> Result<Picture, FigureError> {
    use super::shades::{Shades, paint};
    /// Between two plots.
    const APART: f64 = 14.0;
    let of = study.settings.states[state];
    let title = match print.title {
        Some(title) => format!("{title}: {}", of.words()),
        None => format!("Fragility of {} under {} motions", of.words(), study.records().count()),
    };
    let (mut canvas, top) = begin(study, &title, print);
    let wide = canvas.inner();
    let top = top + FONT;
    let width = (wide - LEFT - APART - 6.0) / 2.0;
    let grid = &study.sweep.grid;
    let fits = || study.cells.iter().map(|cell| &cell.states[state].estimates[0]);
    let thetas: Vec<Option<f64>> = fits().map(|fit| fit.theta).collect();
    let betas: Vec<Option<f64>> = fits().map(|fit| fit.beta).collect();
    let mut end = top;
    let label = format!("θ: {}", intensity.label());
    for (k, (values, label)) in [(&thetas, label.as_str()), (&betas, "β")].into_iter().enumerate()
    {
        let x = MARGIN + LEFT + k as f64 * (width + APART);
        let place = Place { x, y: top, width, height: width };
        let shades = Shades::over(values);
        let frame = Frame::new(place, Axis::of(Some(grid.x())), Axis::of(grid.y()));
        paint(&mut canvas, grid, values, &shades, &frame)?;
        if let Some((rates, target)) = target {
            let logarithms: Vec<Option<f64>> = rates
                .iter()
                .map(|rate| rate.map(|rate| rate.clamp(1.0e-300, 1.0e300).ln()))
                .collect();
            let lines = crate::map::boundaries::contours(grid, &logarithms, &[target.ln()]);
            canvas.clipped(place, |canvas| {
                for line in lines.iter().flatten() {
                    canvas.line(line.iter().map(|at| frame.at(*at)), stroke(BLACK, 1.1));
                }
            });
        }
        frame.draw(&mut canvas, Written { y: k == 0, x: true, beyond: 1.5 });
        end = shades.draw(&mut canvas, (x, place.bottom() + BELOW + MARGIN), width, label)?;
    }
    let mut entries: Vec<Entry> = Vec::new();
    if fits().any(|fit| fit.theta.is_none() || fit.beta.is_none()) {
        let text = "white: not known, as where no motion or every motion makes the block fail";
        entries.push(entry(Swatch::Fill([255, 255, 255]), text));
    }
    if let Some((_, target)) = target {
        let text = format!("annual rate of {target}, with what the hazard curve may leave out");
        entries.push(entry(Swatch::Line(stroke(BLACK, 1.1)), text));
    }
    let by = study.settings.estimators[0].key();
    entries.push(entry(Swatch::None, format!("Estimated by {by}.")));
    let end = legend::draw(&mut canvas, &entries, (MARGIN, end + MARGIN), wide, 2);
    Ok(canvas.finish(end + MARGIN))
}
