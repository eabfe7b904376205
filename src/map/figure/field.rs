//! Maps of a value in greys with contour levels, in the manner of the paper's Figs. 4 and 6.

use plotters::prelude::*;

use super::super::Map;
use super::super::boundaries::{Boundary, levels};
use super::document::{Place, compose};
use super::frame::{Drawn, FINE, PLOT, Plot, SIZE, area, map_frame, stroke, titled};
use super::greys::{FALLEN, Greys, keys};
use super::labels::Labels;
use super::overturning::hatched;
use super::raster::png;
use super::{FigureError, tick};
use crate::stepping::outcome::{Class, Outcome};

/// A value that is drawn over the grid.
#[derive(Debug, Clone, Copy)]
pub struct Field {
    /// Name of the files.
    pub name: &'static str,
    /// Title of the figure.
    pub title: &'static str,
    /// Symbol and unit at the scale.
    pub label: &'static str,
    /// The value of a cell.
    pub value: fn(&Outcome) -> f64,
    /// Fixed ends of the scale; those of the values where there are none.
    pub ends: Option<(f64, f64)>,
    /// The value of an overturned cell tells how far it came, not how far it can: it is left out
    /// of the scale and of the levels.
    pub standing_only: bool,
}

/// The rocking index, the displacements and the vertical stroke, a figure each.
pub const FIELDS: [Field; 4] = [
    Field {
        name: "map",
        title: "rocking index",
        label: "ζ = max|φ| / α",
        value: |cell| cell.zeta,
        ends: Some((0.0, 1.0)),
        standing_only: false,
    },
    Field {
        name: "displacement_u",
        title: "horizontal displacement of the base",
        label: "max|u| [m]",
        value: |cell| cell.max_u,
        ends: None,
        standing_only: true,
    },
    Field {
        name: "displacement_v",
        title: "vertical displacement of the base",
        label: "max|v| [m]",
        value: |cell| cell.max_v,
        ends: None,
        standing_only: true,
    },
    Field {
        name: "stroke_v",
        title: "vertical stroke of the base about its static position",
        label: "max|v + g/ω_v²| [m]",
        value: |cell| cell.stroke_v,
        ends: None,
        standing_only: true,
    },
];

/// The contact forces, the two halves of a figure.
pub const CONTACT: [Field; 2] = [
    Field {
        name: "contact",
        title: "least contact force",
        label: "min N/M [m/s²]",
        value: |cell| cell.min_contact,
        ends: Some((0.0, 10.0)),
        standing_only: true,
    },
    Field {
        name: "friction",
        title: "friction coefficient asked for",
        label: "max |T| / N (up to 1)",
        value: |cell| cell.friction.min(FRICTION),
        ends: None,
        standing_only: true,
    },
];

/// Friction above which all values are alike: nothing holds there.
const FRICTION: f64 = 1.0;

impl Field {
    /// True where a cell's value has a place on the scale.
    pub fn counts(&self, cell: &Outcome) -> bool {
        cell.class != Class::Unresolved && !(self.standing_only && cell.class.overturned())
    }
}

/// Draws a field as SVG; `at` tells what the map is a slice at.
///
/// # Errors
/// Any [`FigureError`].
pub fn draw(map: &Map, field: &Field, at: &str) -> Result<String, FigureError> {
    let greys = Greys::over([map], field);
    let mut images = vec![(PLOT, cells(map, field, &greys)?), (BAR, greys.bar()?)];
    let hatch = hatched(map, PLOT)?;
    let has_hatch = map.has_beyond_the_model();
    images.extend(hatch.map(|image| (PLOT, image)));
    let mut drawing = String::new();
    frame((map, at), field, &greys, has_hatch, &mut drawing)
        .map_err(|e| FigureError::Draw(e.to_string()))?;
    Ok(compose(SIZE, &images, &drawing))
}

/// The cells of a map in the greys of their values, as an image.
///
/// # Errors
/// [`FigureError::Encode`].
pub fn cells(map: &Map, field: &Field, greys: &Greys) -> Result<Vec<u8>, FigureError> {
    let (columns, rows) = map.grid.shape();
    png(columns, rows, |column, row| {
        let cell = &map.outcomes[(rows - 1 - row) * columns + column];
        let grey = match cell.class {
            Class::Unresolved => 255,
            _ if field.counts(cell) => greys.shade((field.value)(cell)),
            _ => FALLEN,
        };
        [grey, grey, grey, 255]
    })
}

/// Place of the scale of greys.
const BAR: Place = Place { x: 730, y: 110, width: 22, height: 300 };

fn frame(
    (map, at): (&Map, &str),
    field: &Field,
    greys: &Greys,
    hatched: bool,
    drawing: &mut String,
) -> Drawn<()> {
    let root = area(drawing, SIZE);
    let title = titled(&format!("{}: {}", map.scene.title, field.title), at);
    let mut plot = map_frame(&root, map, &title)?;
    let named = lines(&mut plot, map, field, greys, 26)?;
    let mut labels = Labels::new(map, field);
    for (text, line) in &named {
        labels.draw(&mut plot, line, text)?;
    }
    greys.draw(&root, BAR, field.label, 16)?;
    keys(&root, &[map], field, hatched, (BAR.x, BAR.y + BAR.height + 34), 14)?;
    root.present()?;
    Ok(())
}

/// Points of a line below which it goes around a speck: where the motion is chaotic cells differ
/// from their neighbours, and thick lines around each would hide them.
const SPECK: usize = 16;

/// A level's value and the longest of its lines.
pub type Level = (String, Vec<(f64, f64)>);

/// Draws the levels of a value, and thick lines around overturning, dashed around full contact;
/// returns the levels, to be labelled. `thick` is in tenths of the document's units.
pub fn lines(
    plot: &mut Plot,
    map: &Map,
    field: &Field,
    greys: &Greys,
    thick: i32,
) -> Drawn<Vec<Level>> {
    let value = |cell: &Outcome| {
        (field.counts(cell) && !cell.class.overturned()).then(|| (field.value)(cell))
    };
    let thin = stroke(RGBColor(40, 40, 40), 6);
    let values = greys.levels();
    let mut named = Vec::new();
    for (level, lines) in values.iter().zip(levels(map, value, &values)) {
        for line in lines.iter().filter(|line| line.len() >= SPECK) {
            plot.draw_series(LineSeries::new(line.iter().copied(), thin))?;
        }
        if let Some(longest) = lines.into_iter().max_by_key(|line| line.len()) {
            named.push((tick(*level, greys.width()), longest));
        }
    }
    let around = stroke(BLACK, thick);
    for line in Boundary::Overturning.lines(map) {
        let style = if line.len() < SPECK { thin } else { around };
        plot.draw_series(LineSeries::new(line, style))?;
    }
    for line in Boundary::FullContact.lines(map) {
        let (dash, gap) = (9 * FINE * thick / 26, 6 * FINE * thick / 26);
        plot.draw_series(DashedLineSeries::new(line, dash as u32, gap as u32, around))?;
    }
    Ok(named)
}
