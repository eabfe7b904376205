//! Maps side by side, with shared axes and one legend.

use std::collections::BTreeSet;

use super::layout::{Panels, Plot, title};
use super::{Figure, Panel, Shows, parameters};
use topple_pictures::colours::palette::{Kind, Parity};
use topple_pictures::colours::{BLACK, WHITE};
use topple_pictures::drawing::canvas::write;
use topple_pictures::drawing::canvas::{Canvas, dashed, stroke};
use topple_pictures::drawing::caption::{bounded, listed};
use topple_pictures::drawing::error::FigureError;
use topple_pictures::drawing::frame::{Frame, LEFT};
use topple_pictures::drawing::legend::{self, Entry, entry};
use topple_pictures::drawing::picture::Picture;
use topple_pictures::drawing::text::{style, width, wrapped};
use topple_pictures::drawing::{FONT, MARGIN, TITLE};
use topple_pictures::map::Map;
use topple_pictures::map::figure::field::{self, Shown};
use topple_pictures::map::figure::fields::{FIELDS, Field};
use topple_pictures::map::figure::greys::Greys;
use topple_pictures::map::figure::overlay::Overlay;
use topple_pictures::map::figure::{keys, layout, overturning};

/// Between the panels, the scales, the legend and the caption.
const APART: f64 = 4.0;
/// Width of a scale of greys at most.
const SCALE: f64 = 180.0;

/// The field that a panel shows in greys, if it does.
fn field_of(shows: Shows) -> Option<&'static Field> {
    let [rocking, displacement_u, displacement_v, _] = &FIELDS;
    match shows {
        Shows::Rocking => Some(rocking),
        Shows::DisplacementU => Some(displacement_u),
        Shows::DisplacementV => Some(displacement_v),
        _ => None,
    }
}

/// What the panels of a figure show together, for its legend.
#[derive(Default)]
struct Seen {
    fields: Option<Shown>,
    overlay: Overlay,
    rings: bool,
}

/// Draws the panels of a figure; `maps` has one a panel, `caption` follows what the
/// figure says itself.
pub fn draw(figure: &Figure, maps: &[Map], caption: &[String]) -> Result<Picture, FigureError> {
    let columns = figure.columns;
    let scales = scales(figure, maps);
    let written = written(columns, maps);
    let inner = (0..maps.len()).any(|k| k % columns != 0 && written[k].0);
    let panels = Panels::new(maps.len(), columns, inner);
    let (shared, own) = parameters::split(figure.panels.iter().map(|panel| &panel.scene));
    let titles: Vec<String> =
        figure.panels.iter().enumerate().map(|(k, panel)| title(panel, k, &own[k])).collect();
    let mut canvas = Canvas::new(panels.width);
    let whole = panels.width - 2.0 * MARGIN;
    let head = bounded(&figure.title, TITLE, whole);
    let top = write(&mut canvas, (MARGIN, MARGIN), style(TITLE), &head) + APART;
    let (plots, mut y) = panels.lay_out(&mut canvas, top, &titles, |k| written[k]);
    let mut seen = Seen::default();
    for ((panel, map), plot) in figure.panels.iter().zip(maps).zip(&plots) {
        let scale = scales.iter().find(|scale| scale.shows == panel.shows);
        paint(&mut canvas, panel, map, plot, scale, &mut seen)?;
    }
    let across = SCALE.min((whole - LEFT) / scales.len().max(1) as f64 - LEFT);
    let mut end = y;
    for (k, Scale { field, greys, .. }) in scales.iter().enumerate() {
        let left = MARGIN + LEFT + k as f64 * (across + LEFT);
        end = greys.draw(&mut canvas, (left, y + APART), across, field.label)?;
    }
    y = end;
    let mut entries = colours(figure, maps);
    let all: Vec<&Map> = maps.iter().collect();
    if let Some(shown) = seen.fields {
        let steps: Vec<(&str, f64)> =
            scales.iter().map(|scale| (scale.field.label, scale.greys.step())).collect();
        entries.extend(shown.entries(&all, &steps));
    }
    let of_fields = seen.fields.map_or(Overlay::default(), |shown| shown.overlay);
    let overlay = Overlay { hatched: seen.overlay.hatched && !of_fields.hatched, ..seen.overlay };
    entries.extend(keys::overlay(&all, overlay));
    let has_ring = seen.fields.is_some_and(|shown| shown.rings);
    entries.extend((seen.rings && !has_ring).then(keys::ring));
    let at = (MARGIN, y + APART);
    y = legend::draw(&mut canvas, &entries, at, whole, panels.legend_columns());
    let mut lines = wrapped(&format!("{}.", listed(&shared)), FONT, whole);
    lines.extend(caption.iter().flat_map(|text| wrapped(text, FONT, whole)));
    let end = write(&mut canvas, (MARGIN, y + APART), style(FONT), &lines);
    Ok(canvas.finish(end + MARGIN))
}

/// Draws a panel, and notes what it shows.
fn paint(
    canvas: &mut Canvas,
    panel: &Panel,
    map: &Map,
    Plot { place, written }: &Plot,
    scale: Option<&Scale>,
    seen: &mut Seen,
) -> Result<(), FigureError> {
    let frame = layout::frame(*place, &map.grid);
    if let Some(Scale { field, greys, .. }) = scale {
        let shown = field::paint(canvas, map, field, greys, &frame)?;
        seen.fields = Some(seen.fields.map_or(shown, |before| before.with(shown)));
    } else {
        let parity = panel.shows == Shows::Parity;
        let overlay = Overlay::of(map, !parity);
        let rings = if parity {
            overturning::paint(canvas, map, *place, overlay, Parity::of, Parity::colour)?
        } else {
            overturning::paint(canvas, map, *place, overlay, Kind::of, Kind::colour)?
        };
        seen.overlay = seen.overlay.with(overlay);
        seen.rings |= rings > 0;
    }
    canvas.clipped(*place, |canvas| mark(canvas, &frame, panel));
    frame.draw(canvas, *written);
    Ok(())
}

/// A field with the scale that its panels share.
struct Scale {
    shows: Shows,
    field: &'static Field,
    greys: Greys,
}

/// The scales of the fields that a figure shows.
fn scales(figure: &Figure, maps: &[Map]) -> Vec<Scale> {
    let mut scales: Vec<Scale> = Vec::new();
    for Panel { shows, .. } in &figure.panels {
        if let Some(field) = field_of(*shows)
            && scales.iter().all(|scale| scale.shows != *shows)
        {
            let alike = figure.panels.iter().zip(maps).filter(|(other, _)| other.shows == *shows);
            let greys = Greys::over(alike.map(|(_, map)| map), field);
            scales.push(Scale { shows: *shows, field, greys });
        }
    }
    scales
}

/// Which panels write numbers on their vertical and on their horizontal axis: those at the edge,
/// and those whose neighbour has another axis.
fn written(columns: usize, maps: &[Map]) -> Vec<(bool, bool)> {
    let left = |k: usize| (!k.is_multiple_of(columns)).then(|| &maps[k - 1]);
    let below = |k: usize| maps.get(k + columns);
    (0..maps.len())
        .map(|k| {
            let grid = &maps[k].grid;
            let y = left(k).is_none_or(|other| other.grid.y() != grid.y());
            let x = below(k).is_none_or(|other| other.grid.x() != grid.x());
            (y, x)
        })
        .collect()
}

/// Draws windows, points and paths.
fn mark(canvas: &mut Canvas, frame: &Frame, panel: &Panel) {
    let letters = style(FONT);
    if let Some(window) = &panel.window {
        let ([x0, x1], [y0, y1]) = (window.x, window.y);
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)];
        canvas.line(corners.map(|corner| frame.at(corner)), stroke(WHITE, 1.4));
        let line = dashed(BLACK, 0.7, (2.4, 1.6));
        canvas.line(corners.map(|corner| frame.at(corner)), line);
    }
    for path in &panel.paths {
        let ends = [(path.omega, path.a_h.first()), (path.omega, path.a_h.last())];
        canvas.line(ends.map(|end| frame.at(end)), stroke(WHITE, 1.4));
        canvas.line(ends.map(|end| frame.at(end)), stroke(BLACK, 0.7));
        let (x, y) = frame.at(ends[1]);
        let wide = width(&path.name, FONT) + 2.0;
        let high = FONT + 1.5;
        let place = topple_pictures::drawing::canvas::Place {
            x: x + 1.5,
            y: y + 0.5,
            width: wide,
            height: high,
        };
        canvas.fill_through(place, WHITE, 0.85);
        canvas.text((x + 2.5, y + FONT), letters, &path.name);
    }
    for point in &panel.points {
        let at = frame.at((point.x, point.y));
        canvas.disc(at, 2.0, WHITE);
        canvas.disc(at, 1.4, BLACK);
        let place = topple_pictures::drawing::canvas::Place {
            x: at.0 + 2.0,
            y: at.1 - FONT - 1.0,
            width: width(&point.name, FONT) + 1.5,
            height: FONT,
        };
        canvas.fill_through(place, WHITE, 0.85);
        canvas.text((at.0 + 2.7, at.1 - 2.0), letters, &point.name);
    }
}

/// The colours that the maps of a figure have, in the order of their meaning.
fn colours(figure: &Figure, maps: &[Map]) -> Vec<Entry> {
    let cells = |shows: Shows| {
        let these = figure.panels.iter().zip(maps).filter(move |(panel, _)| panel.shows == shows);
        these.flat_map(|(_, map)| map.outcomes.iter())
    };
    let parities: BTreeSet<Parity> = cells(Shows::Parity).map(Parity::of).collect();
    let parities = parities.into_iter();
    let parities = parities.map(|parity| entry(keys::parity_swatch(parity), parity.label()));
    keys::kinds(cells(Shows::Outcomes), false).into_iter().chain(parities).collect()
}
