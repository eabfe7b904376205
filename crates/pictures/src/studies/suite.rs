//! The picture of a suite: response spectra of its motions, their median and the band of 16 % to 84 %.

use crate::colours::palette::{CURVES, MANY};
use crate::drawing::canvas::{Canvas, Place, Point, stroke};
use crate::drawing::caption::bounded;
use crate::drawing::frame::{Axis, BELOW, BOTH, Frame, LEFT, Written};
use crate::drawing::legend::{self, entry};
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;
use crate::drawing::swatch::Swatch;
use crate::drawing::text::{style, wrapped};
use crate::drawing::{COLUMN, FONT, LEADING, MARGIN, TITLE};
use topple::scene::record::Pair;
use topple_studies::statistics::quantile::Sorted;
use topple_studies::suites::read::Suite;
use topple_studies::suites::spectrum::spectrum;

/// Periods of a spectrum: so many, each the same factor larger, s.
const PERIODS: u32 = 60;
const FROM: f64 = 0.02;
const TO: f64 = 10.0;
/// Fewest motions that have a band.
const BANDED: usize = 3;
/// Height of a panel, points.
const HEIGHT: f64 = 130.0;

/// A component of a motion: its samples.
type Component = fn(&Pair) -> &[f64];

/// Draws the spectra of both components.
pub fn draw(suite: &Suite, print: Print) -> Picture {
    let mut canvas = print.canvas(COLUMN);
    let wide = canvas.inner();
    let title = format!("Suite of {} motions", suite.motions().count());
    let mut y = MARGIN + 0.8 * TITLE;
    let title = bounded(print.title.unwrap_or(&title), TITLE, wide);
    for line in &title {
        canvas.text((MARGIN, y), style(TITLE), line);
        y += LEADING * TITLE;
    }
    y += 0.1 * TITLE;
    for line in wrapped("Pseudo-acceleration at 5 % of the critical damping", FONT, wide) {
        canvas.text((MARGIN, y), style(FONT), &line);
        y += LEADING * FONT;
    }
    y += 0.6 * TITLE - LEADING * FONT;
    let components: [(&str, Component); 2] =
        [("horizontal", |pair| &pair.horizontal), ("vertical", |pair| &pair.vertical)];
    for (number, (name, component)) in components.into_iter().enumerate() {
        y += LEADING * FONT;
        canvas.text((MARGIN + LEFT, y), style(FONT), name);
        let x = MARGIN + LEFT;
        let place = Place { x, y: y + 3.0, width: canvas.inner() - x, height: HEIGHT };
        panel(&mut canvas, place, suite, component, number == 1);
        y = place.bottom();
    }
    let mut entries = vec![
        entry(Swatch::Line(stroke(MANY.0, 0.3)), "a motion"),
        entry(Swatch::Line(stroke(CURVES[0], 1.2)), "median"),
    ];
    if suite.motions().count() >= BANDED {
        entries.push(entry(Swatch::Fill(MANY.1), "16 % to 84 % of the motions"));
    }
    let at = (MARGIN, y + BELOW + MARGIN);
    let end = legend::draw(&mut canvas, &entries, at, wide, 2);
    canvas.finish(end + MARGIN)
}

/// Draws the spectra of a component; `written` says whether the periods stand below.
fn panel(canvas: &mut Canvas, place: Place, suite: &Suite, component: Component, written: bool) {
    let periods: Vec<f64> = (0..PERIODS)
        .map(|k| FROM * (TO / FROM).powf(f64::from(k) / f64::from(PERIODS - 1)))
        .collect();
    // A component that does not move has none.
    let spectra: Vec<Vec<f64>> = suite
        .motions()
        .map(|(_, motion)| spectrum(component(&motion.pair), motion.pair.dt, &periods))
        .filter(|sa| sa.iter().all(|value| *value > 0.0))
        .collect();
    let most = spectra.iter().flatten().fold(0.0, |most: f64, value| most.max(*value));
    let most = if most > 0.0 { most } else { 1.0 };
    let least = spectra.iter().flatten().fold(most, |least: f64, value| least.min(*value));
    // Five decades hold all that is of weight.
    let (low, high) = ((0.7 * least).max(1.0e-5 * most), 1.5 * most);
    let axes = (Axis::log(FROM, TO, "T [s]"), Axis::log(low, high, "Sa [m/s²]"));
    let frame = Frame::new(place, axes.0, axes.1);
    let at = |(period, sa): (&f64, f64)| frame.at((period.log10(), sa.max(low).log10()));
    let curve =
        |sa: &[f64]| -> Vec<Point> { periods.iter().zip(sa.iter().copied()).map(at).collect() };
    let share = |share: f64| -> Vec<f64> {
        (0..periods.len())
            .map(|k| Sorted::of(spectra.iter().map(|sa| sa[k]).collect()).quantile(share))
            .map(|sa| sa.unwrap_or(0.0))
            .collect()
    };
    canvas.clipped(place, |canvas| {
        let edges = if spectra.len() >= BANDED { &[0.16, 0.84][..] } else { &[] };
        let edges: Vec<Vec<Point>> = edges.iter().map(|edge| curve(&share(*edge))).collect();
        if let [lower, upper] = &edges[..] {
            canvas.polygon(upper.iter().chain(lower.iter().rev()).copied(), MANY.1);
        }
        for sa in &spectra {
            canvas.line(curve(sa), stroke(MANY.0, 0.25));
        }
        for edge in edges {
            canvas.line(edge, stroke(CURVES[0], 0.5));
        }
        if !spectra.is_empty() {
            canvas.line(curve(&share(0.5)), stroke(CURVES[0], 1.2));
        }
    });
    if spectra.is_empty() {
        let middle = (place.x + 0.5 * place.width, place.y + 0.5 * place.height);
        canvas.text(middle, style(FONT).middle(), "no motion");
    }
    frame.draw(canvas, Written { x: written, ..BOTH });
}
