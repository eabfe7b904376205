//! Maps side by side, with shared axes and one legend.

use std::collections::BTreeSet;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::layout::{ABOVE, LINE, Layout, Written};
use super::{Figure, Panel, Shows, letter, parameters};
use crate::map::Map;
use crate::map::figure::FigureError;
use crate::map::figure::document::{FINE, Place};
use crate::map::figure::field;
use crate::map::figure::fields::{FIELDS, Field};
use crate::map::figure::frame::{
    Area, Axes, Drawn, Plot, at, axes, document, outline, stroke, text,
};
use crate::map::figure::greys::{Greys, keys};
use crate::map::figure::overturning::{self, hatched};
use crate::map::figure::palette::{Kind, Parity};

/// Width of the lines around overturning and full contact, tenths of a unit.
const THICK: i32 = 14;
/// Size of the axes' numbers.
const FONT: i32 = 12;
/// Heights of a colour's line in the legend, of a scale of greys, and of what stands below.
const ENTRY: i32 = 22;
const BAR: i32 = 236;
const KEYS: i32 = 150;

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

/// Draws the panels of a figure as SVG; `maps` has one a panel, `caption` follows what the
/// figure says itself.
///
/// # Errors
/// Any [`FigureError`].
pub fn draw(figure: &Figure, maps: &[Map], caption: &[String]) -> Result<String, FigureError> {
    let columns = figure.columns;
    let scales = scales(figure, maps);
    let scale = |panel: &Panel| scales.iter().find(|scale| scale.shows == panel.shows);
    let written = written(columns, maps);
    let inner = Written {
        inner_y: (0..maps.len()).any(|k| k % columns != 0 && written[k].0),
        inner_x: (0..maps.len()).any(|k| k + columns < maps.len() && written[k].1),
    };
    let (shared, own) = parameters::split(figure.panels.iter().map(|panel| &panel.scene));
    let mut lines = vec![format!("{}.", shared.join(", "))];
    lines.extend(caption.iter().cloned());
    let height = ENTRY * entries(figure, maps).len() as i32 + BAR * scales.len() as i32 + KEYS;
    let layout = Layout::new(maps.len(), columns, inner, height, &lines);
    let mut images = Vec::new();
    for ((panel, map), place) in figure.panels.iter().zip(maps).zip(&layout.plots) {
        let cells = match (scale(panel), panel.shows) {
            (Some(scale), _) => field::cells(map, scale.field, &scale.greys)?,
            (None, Shows::Parity) => overturning::cells(map, |cell| Parity::of(cell).colour())?,
            (None, _) => overturning::cells(map, |cell| Kind::of(cell).colour())?,
        };
        images.push((*place, cells));
        images.extend(hatched(map, *place)?.map(|image| (*place, image)));
    }
    let mut bars = Vec::new();
    let (x, y) = layout.legend;
    let mut place = Place { x, y: y + 22, width: 18, height: BAR - 46 };
    for scale in &scales {
        images.push((place, scale.greys.bar()?));
        bars.push((place, scale));
        place.y += BAR;
    }
    document(layout.size, &images, |root| {
        let (x, y) = layout.title();
        root.draw(&Text::new(figure.title.clone(), at(x, y), text(19)))?;
        for (k, (panel, map)) in figure.panels.iter().zip(maps).enumerate() {
            let plot_place = layout.plots[k];
            label(root, plot_place, &title(panel, k, &own[k]))?;
            let room = Layout::room(written[k].0, written[k].1);
            let set = Axes { size: layout.size, plot: plot_place, room, font: FONT };
            let mut plot = axes(root, &map.grid, &set)?;
            if let Some(scale) = scale(panel) {
                field::lines(&mut plot, map, scale.field, &scale.greys, THICK)?;
            }
            mark(&mut plot, panel)?;
        }
        legend(root, figure, maps, &layout, &bars)?;
        for (k, line) in layout.lines.iter().enumerate() {
            let (x, y) = layout.caption;
            root.draw(&Text::new(line.clone(), at(x, y + LINE * k as i32), text(FONT)))?;
        }
        Ok(())
    })
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

/// What stands above a panel: its letter, and what sets it apart.
pub fn title(panel: &Panel, index: usize, own: &[String]) -> String {
    let mut parts: Vec<&str> = Vec::new();
    parts.extend(panel.label.as_deref());
    parts.extend(panel.motion.as_deref());
    parts.extend(own.iter().map(String::as_str));
    format!("({}) {}", letter(index), parts.join(", "))
}

/// Writes a panel's label above it.
pub fn label(root: &Area, place: Place, title: &str) -> Drawn<()> {
    root.draw(&Text::new(title.to_string(), at(place.x, place.y - ABOVE + 7), text(13)))?;
    Ok(())
}

/// Draws windows, points and paths.
fn mark(plot: &mut Plot, panel: &Panel) -> Drawn<()> {
    if let Some(window) = &panel.window {
        let ([x0, x1], [y0, y1]) = (window.x, window.y);
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)];
        let (dash, gap) = (6 * FINE as u32, 4 * FINE as u32);
        plot.draw_series(DashedLineSeries::new(corners, dash, gap, stroke(BLACK, 14)))?;
    }
    for path in &panel.paths {
        let line = [(path.omega, path.a_h.first()), (path.omega, path.a_h.last())];
        plot.draw_series(LineSeries::new(line, stroke(WHITE, 30)))?;
        plot.draw_series(LineSeries::new(line, stroke(BLACK, 14)))?;
        let side = Pos::new(HPos::Left, VPos::Top);
        let width = (8 + 6 * path.name.chars().count() as i32) * FINE;
        plot.draw_series([EmptyElement::at((path.omega, path.a_h.last()))
            + Rectangle::new(
                [(3 * FINE, 2 * FINE), (width, 16 * FINE)],
                WHITE.mix(0.85).filled(),
            )
            + Text::new(path.name.clone(), (5 * FINE, 4 * FINE), text(FONT).pos(side))])?;
    }
    for point in &panel.points {
        plot.draw_series([EmptyElement::at((point.x, point.y))
            + Circle::new((0, 0), 4 * FINE, WHITE.filled())
            + Circle::new((0, 0), 3 * FINE, BLACK.filled())
            + Text::new(point.name.clone(), (5 * FINE, -14 * FINE), text(FONT + 2))])?;
    }
    Ok(())
}

/// A colour and what it means.
type Entry = ([u8; 3], String);

/// The colours that the maps of a figure have, in the order of their meaning.
fn entries(figure: &Figure, maps: &[Map]) -> Vec<Entry> {
    let cells = |shows: Shows| {
        let these = figure.panels.iter().zip(maps).filter(move |(panel, _)| panel.shows == shows);
        these.flat_map(|(_, map)| map.outcomes.iter())
    };
    let kinds: BTreeSet<Kind> = cells(Shows::Outcomes).map(Kind::of).collect();
    let parities: BTreeSet<Parity> = cells(Shows::Parity).map(Parity::of).collect();
    let kinds = kinds.into_iter().map(|kind| (kind.colour(), kind.label()));
    let parities = parities.into_iter().map(|parity| (parity.colour(), parity.label().to_string()));
    kinds.chain(parities).collect()
}

fn legend(
    root: &Area,
    figure: &Figure,
    maps: &[Map],
    layout: &Layout,
    bars: &[(Place, &Scale)],
) -> Drawn<()> {
    let (left, mut top) = layout.legend;
    for (colour, name) in entries(figure, maps) {
        let [r, g, b] = colour;
        let swatch = [at(left, top), at(left + 22, top + 14)];
        root.draw(&Rectangle::new(swatch, RGBColor(r, g, b).filled()))?;
        outline(root, Place { x: left, y: top, width: 22, height: 14 }, 10)?;
        root.draw(&Text::new(name, at(left + 30, top + 1), text(13)))?;
        top += ENTRY;
    }
    for (place, scale) in bars {
        scale.greys.draw(root, *place, scale.field.label, 14)?;
        top = place.y + place.height + 26;
    }
    let beyond = |map: &Map| map.has_beyond_the_model();
    let all: Vec<&Map> = maps.iter().collect();
    match bars.last() {
        Some((_, scale)) => {
            keys(root, &all, scale.field, maps.iter().any(beyond), (left, top), 12)?;
        }
        None if maps.iter().any(beyond) => {
            top += 6;
            for line in ["hatched: contact force tensile,", "the model does not hold"] {
                root.draw(&Text::new(line, at(left, top), text(12)))?;
                top += LINE;
            }
        }
        None => {}
    }
    Ok(())
}
