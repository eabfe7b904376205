//! Drawings that are no maps: boundaries, shares, and what a path meets.

use plotters::prelude::*;

use super::boundary::Least;
use super::layout::{LINE, Layout, Written};
use super::shares::Shares;
use super::{Figure, panels, parameters};
use crate::map::figure::FigureError;
use crate::map::figure::frame::{
    Area, Axes, Drawn, Named, Plot, at, document, frame, outline, stroke, text,
};

/// Size of the axes' numbers.
const FONT: i32 = 12;
/// Colour of the isolated block's curve.
const ISOLATED: RGBColor = RGBColor(0x2c, 0x5f, 0xb8);
/// Colour of the curve of the block on the ground.
const FREE: RGBColor = RGBColor(0xd6, 0x2f, 0x2a);

/// A line of a legend.
type Entry = (RGBColor, String);

/// What a drawing of curves has in each panel.
struct Curves<'a> {
    figure: &'a Figure,
    /// Names and ends of the axes.
    axes: (Named, Named),
    legend: Vec<Entry>,
    caption: Vec<String>,
    /// Symbol of a parameter that an axis shows, and the caption then not.
    swept: Option<&'static str>,
}

impl Curves<'_> {
    /// Draws all panels; `paint` draws what is in one.
    fn draw(
        &self,
        mut paint: impl FnMut(usize, &mut Plot) -> Drawn<()>,
    ) -> Result<String, FigureError> {
        let figure = self.figure;
        let (mut shared, own) = parameters::split(figure.panels.iter().map(|panel| &panel.scene));
        shared.retain(|part| !self.swept.is_some_and(|symbol| part.starts_with(symbol)));
        let mut lines = vec![format!("{}.", shared.join(", "))];
        lines.extend(self.caption.iter().cloned());
        let (count, columns) = (figure.panels.len(), figure.columns);
        let written = Written { inner_y: false, inner_x: false };
        let layout = Layout::new(count, columns, written, 22 * self.legend.len() as i32, &lines);
        document(layout.size, &[], |root| {
            heading(root, &figure.title, &layout)?;
            for (k, panel) in figure.panels.iter().enumerate() {
                let place = layout.plots[k];
                panels::label(root, place, &panels::title(panel, k, &own[k]))?;
                let room = Layout::room(k % columns == 0, k + columns >= count);
                let (x, y) = (&self.axes.0, &self.axes.1);
                let set = Axes { size: layout.size, plot: place, room, font: FONT };
                let mut plot = frame(root, &set, (x, y))?;
                paint(k, &mut plot)?;
                outline(root, place, 10)?;
            }
            let (left, mut top) = layout.legend;
            for (colour, name) in &self.legend {
                let swatch = [at(left, top + 5), at(left + 22, top + 10)];
                root.draw(&Rectangle::new(swatch, colour.filled()))?;
                root.draw(&Text::new(name.clone(), at(left + 30, top + 1), text(13)))?;
                top += 22;
            }
            Ok(())
        })
    }
}

/// Writes title and caption.
fn heading(root: &Area, title: &str, layout: &Layout) -> Drawn<()> {
    let (x, y) = layout.title();
    root.draw(&Text::new(title.to_string(), at(x, y), text(19)))?;
    for (k, line) in layout.lines.iter().enumerate() {
        let (x, y) = layout.caption;
        root.draw(&Text::new(line.clone(), at(x, y + LINE * k as i32), text(FONT)))?;
    }
    Ok(())
}

/// Draws, for every panel, the least amplitude that overturns with isolation and without.
///
/// # Errors
/// Any [`FigureError`].
pub fn boundaries(
    figure: &Figure,
    curves: &[(Vec<Least>, Vec<Least>)],
    caption: &[String],
) -> Result<String, FigureError> {
    let all = || curves.iter().flat_map(|(with, without)| with.iter().chain(without));
    let last = all().map(|least| least.omega).fold(0.0, f64::max);
    let highest = all().filter_map(|least| least.a_h).fold(0.0, f64::max);
    let axes = (
        Named { ends: 0.0..last, name: "Ω [rad/s]".into() },
        Named {
            ends: 0.0..(1.02 * highest).max(1.0e-3),
            name: "least A_h that overturns [m/s²]".into(),
        },
    );
    let legend =
        vec![(ISOLATED, "dual isolation".to_string()), (FREE, "on the ground".to_string())];
    let drawn = Curves { figure, axes, legend, caption: caption.to_vec(), swept: None };
    drawn.draw(|k, plot| {
        for (curve, colour) in [(&curves[k].0, ISOLATED), (&curves[k].1, FREE)] {
            // A curve breaks where nothing overturns.
            for part in curve.split(|least| least.a_h.is_none()) {
                let points = part.iter().filter_map(|least| Some((least.omega, least.a_h?)));
                plot.draw_series(LineSeries::new(points, stroke(colour, 18)))?;
            }
        }
        Ok(())
    })
}

/// Colours and names of the shares, from the bottom up.
const SHARES: [(RGBColor, &str); 8] = [
    (RGBColor(0xc8, 0xe6, 0xb8), "full contact"),
    (RGBColor(0x4c, 0xa6, 0x4c), "rocking, stable"),
    (RGBColor(0xd6, 0x2f, 0x2a), "0 impacts, left corner"),
    (RGBColor(0x7d, 0x10, 0x22), "0 impacts, right corner"),
    (RGBColor(0x2c, 0x5f, 0xb8), "odd number of impacts"),
    (RGBColor(0xf5, 0x8f, 0x1e), "even number of impacts"),
    (RGBColor(0x2b, 0x2b, 0x2b), "at rest between impacts"),
    (RGBColor(0xf0, 0xf0, 0xf0), "unresolved"),
];

/// Draws, for every panel, the shares of the outcomes against the eccentricity.
///
/// # Errors
/// Any [`FigureError`].
pub fn shares(
    figure: &Figure,
    rows: &[Vec<(f64, Shares)>],
    caption: &[String],
) -> Result<String, FigureError> {
    let eccentricities = || rows.iter().flatten().map(|(eccentricity, _)| *eccentricity);
    let low = eccentricities().fold(f64::INFINITY, f64::min);
    let high = eccentricities().fold(f64::NEG_INFINITY, f64::max);
    let axes = (
        Named { ends: low..high, name: "ε".into() },
        Named { ends: 0.0..100.0, name: "share of the plane [%]".into() },
    );
    let has = |k: &usize| rows.iter().flatten().any(|(_, shares)| shares.all()[*k] > 0.0);
    let legend =
        (0..SHARES.len()).rev().filter(has).map(|k| (SHARES[k].0, SHARES[k].1.to_string()));
    let (legend, caption) = (legend.collect(), caption.to_vec());
    let drawn = Curves { figure, axes, legend, caption, swept: Some("ε") };
    drawn.draw(|panel, plot| {
        for (k, (colour, _)) in SHARES.iter().enumerate() {
            let edge = |shares: &Shares, k: usize| 100.0 * shares.all()[..k].iter().sum::<f64>();
            let of = |k: usize| rows[panel].iter().map(move |(e, shares)| (*e, edge(shares, k)));
            let outline: Vec<(f64, f64)> = of(k + 1).chain(of(k).rev()).collect();
            plot.draw_series([Polygon::new(outline, colour.filled())])?;
        }
        Ok(())
    })
}
