//! Drawings of several panels that are no maps: boundaries and shares.

use super::boundary::Least;
use super::layout::{Panels, title};
use super::shares::Shares;
use super::{Figure, parameters};
use topple_pictures::colours::Colour;
use topple_pictures::colours::palette::{CURVES, Kind, Parity};
use topple_pictures::drawing::canvas::write;
use topple_pictures::drawing::canvas::{Canvas, stroke};
use topple_pictures::drawing::caption::{bounded, listed};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::frame::{Axis, Frame};
use topple_pictures::drawing::legend::{self, Entry, entry};
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::swatch::Swatch;
use topple_pictures::drawing::text::{style, wrapped};
use topple_pictures::drawing::{FONT, MARGIN, TITLE};

/// Between the panels, the legend and the caption.
const APART: f64 = 4.0;

/// What a drawing of curves has in each panel.
struct Curves<'a> {
    figure: &'a Figure,
    /// The axes.
    axes: (Axis, Axis),
    legend: Vec<Entry>,
    caption: Vec<String>,
    /// Symbol of a parameter that an axis shows, and the caption then not.
    swept: Option<&'static str>,
}

impl Curves<'_> {
    /// Draws all panels; `paint` draws what is in one.
    fn draw(&self, paint: impl Fn(usize, &mut Canvas, &Frame)) -> Picture {
        let figure = self.figure;
        let (mut shared, own) = parameters::split(figure.panels.iter().map(|panel| &panel.scene));
        shared.retain(|part| !self.swept.is_some_and(|symbol| part.starts_with(symbol)));
        let (count, columns) = (figure.panels.len(), figure.columns);
        let titles: Vec<String> =
            figure.panels.iter().enumerate().map(|(k, panel)| title(panel, k, &own[k])).collect();
        let panels = Panels::new(count, columns, false);
        let mut canvas = Canvas::new(panels.width);
        let whole = panels.width - 2.0 * MARGIN;
        let head = bounded(&figure.title, TITLE, whole);
        let top = write(&mut canvas, (MARGIN, MARGIN), style(TITLE), &head) + APART;
        let edge = |k: usize| (k.is_multiple_of(columns), k + columns >= count);
        let (plots, y) = panels.lay_out(&mut canvas, top, &titles, edge);
        for (k, plot) in plots.iter().enumerate() {
            let frame = Frame::new(plot.place, self.axes.0.clone(), self.axes.1.clone());
            canvas.clipped(plot.place, |canvas| paint(k, canvas, &frame));
            frame.draw(&mut canvas, plot.written);
        }
        let (at, columns) = ((MARGIN, y + APART), panels.legend_columns());
        let y = legend::draw(&mut canvas, &self.legend, at, whole, columns);
        let mut lines = wrapped(&format!("{}.", listed(&shared)), FONT, whole);
        lines.extend(self.caption.iter().flat_map(|text| wrapped(text, FONT, whole)));
        let end = write(&mut canvas, (MARGIN, y + APART), style(FONT), &lines);
        canvas.finish(end + MARGIN)
    }
}

/// Draws, for every panel, the least amplitude that overturns with isolation and without.
pub fn boundaries(
    figure: &Figure,
    curves: &[(Vec<Least>, Vec<Least>)],
    caption: &[String],
) -> Result<Picture, FigureError> {
    let all = || curves.iter().flat_map(|(with, without)| with.iter().chain(without));
    let last = all().map(|least| least.omega).fold(0.0, f64::max);
    let highest = all().filter_map(|least| least.a_h).fold(0.0, f64::max);
    let axes = (
        Axis::new(0.0, last, "Ω [rad/s]"),
        Axis::new(0.0, (1.02 * highest).max(1.0e-3), "least A_h that overturns [m/s²]"),
    );
    let [isolated, free] = [CURVES[0], CURVES[1]].map(|colour| stroke(colour, 0.9));
    let legend = vec![
        entry(Swatch::Line(isolated), "dual isolation"),
        entry(Swatch::Line(free), "on the ground"),
    ];
    let drawn = Curves { figure, axes, legend, caption: caption.to_vec(), swept: None };
    Ok(drawn.draw(|k, canvas, frame| {
        for (curve, stroke) in [(&curves[k].0, isolated), (&curves[k].1, free)] {
            // A curve breaks where nothing overturns.
            for part in curve.split(|least| least.a_h.is_none()) {
                let points = part.iter().filter_map(|least| Some((least.omega, least.a_h?)));
                canvas.line(points.map(|point| frame.at(point)), stroke);
            }
        }
    }))
}

/// Colours and names of the shares, from the bottom up.
fn classes() -> [(Colour, String); 8] {
    let kind = |kind: Kind| (kind.colour(), kind.label());
    let parity = |parity: Parity| (parity.colour(), parity.label().to_string());
    [
        kind(Kind::FullContact),
        kind(Kind::Rocking),
        kind(Kind::DirectLeft),
        kind(Kind::DirectRight),
        parity(Parity::Odd),
        parity(Parity::Even),
        parity(Parity::Rested),
        parity(Parity::Unresolved),
    ]
}

/// Draws, for every panel, the shares of the outcomes against the eccentricity.
pub fn shares(
    figure: &Figure,
    rows: &[Vec<(f64, Shares)>],
    caption: &[String],
) -> Result<Picture, FigureError> {
    let eccentricities = || rows.iter().flatten().map(|(eccentricity, _)| *eccentricity);
    let low = eccentricities().fold(f64::INFINITY, f64::min);
    let high = eccentricities().fold(f64::NEG_INFINITY, f64::max);
    let axes = (Axis::new(low, high, "ε"), Axis::new(0.0, 100.0, "share of the plane [%]"));
    let classes = classes();
    let has = |k: &usize| rows.iter().flatten().any(|(_, shares)| shares.all()[*k] > 0.0);
    let line = |k: usize| entry(Swatch::Fill(classes[k].0), classes[k].1.clone());
    let legend = (0..classes.len()).filter(has).map(line).collect();
    let drawn = Curves { figure, axes, legend, caption: caption.to_vec(), swept: Some("ε") };
    Ok(drawn.draw(|panel, canvas, frame| {
        for (k, (colour, _)) in classes.iter().enumerate() {
            let edge = |shares: &Shares, k: usize| 100.0 * shares.all()[..k].iter().sum::<f64>();
            let of = |k: usize| rows[panel].iter().map(move |(e, shares)| (*e, edge(shares, k)));
            canvas.polygon(of(k + 1).chain(of(k).rev()).map(|point| frame.at(point)), *colour);
        }
    }))
}
