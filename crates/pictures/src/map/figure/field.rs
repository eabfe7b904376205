//! Maps of a value in greys with its levels, in the manner of the paper's Figs. 4 and 6.

use super::super::Map;
use super::super::boundaries::{Boundary, levels};
use super::fields::Field;
use super::greys::Greys;
use super::islands::islands;
use super::labels::{Labels, length};
use super::layout::{GAP, frame, side, titled};
use super::overlay::Overlay;
use super::{keys, overturning};
use crate::colours::palette::FALLEN;
use crate::colours::{BLACK, Colour, WHITE};
use crate::drawing::canvas::write;
use crate::drawing::canvas::{Canvas, Place, Point, Stroke, dashed, stroke};
use crate::drawing::error::FigureError;
use crate::drawing::frame::{BELOW, Frame, Written};
use crate::drawing::legend::{Entry, entry};
use crate::drawing::picture::Picture;
use crate::drawing::print::Print;
use crate::drawing::swatch::Swatch;
use crate::drawing::text::{style, wrapped};
use crate::drawing::ticks::rounded;
use crate::drawing::{COLUMN, FONT, LEADING, MARGIN, caption, legend, swatch};
use topple::stepping::outcome::{Class, Outcome};

/// The line around overturning, and the dashed one around full contact.
const AROUND: Stroke = stroke(BLACK, 0.9);
const CONTACT: Stroke = dashed(BLACK, 0.9, (3.2, 2.0));
/// A level's line, and one around a speck: where the motion is chaotic cells differ from their neighbours, and
/// thick lines around each would hide them.
const LEVEL: Stroke = stroke([0x28, 0x28, 0x28], 0.3);
/// Length of a line below which it goes around a speck, points of the page.
const SPECK: f64 = 12.0;

/// What the lines and marks of a map are, for its legend.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Shown {
    /// Cells overturn.
    pub fallen: bool,
    /// A line around overturning.
    pub overturning: bool,
    /// A line around full contact.
    pub contact: bool,
    /// Lines of equal values.
    pub levels: bool,
    /// A ring around a small region.
    pub rings: bool,
    /// What is drawn over the greys.
    pub overlay: Overlay,
}

impl Shown {
    /// What either of two maps shows.
    pub fn with(self, other: Shown) -> Shown {
        Shown {
            fallen: self.fallen || other.fallen,
            overturning: self.overturning || other.overturning,
            contact: self.contact || other.contact,
            levels: self.levels || other.levels,
            rings: self.rings || other.rings,
            overlay: self.overlay.with(other.overlay),
        }
    }

    /// The lines of its legend; `scales` are the values shown, and from one level of each to the next.
    pub fn entries(&self, maps: &[&Map], scales: &[(&str, f64)]) -> Vec<Entry> {
        let steps: Vec<String> = scales
            .iter()
            .map(|(label, step)| {
                let unit = label.split_once('[').map_or("", |(_, unit)| unit.trim_end_matches(']'));
                format!("{} {unit}", rounded(*step, 10.0 * step)).trim_end().to_string()
            })
            .collect();
        let crossed = self.overlay.crossed;
        let all = [
            (self.fallen, entry(Swatch::Fill(FALLEN), "overturned")),
            (self.overturning, entry(Swatch::Line(AROUND), "border of overturning")),
            (self.contact, entry(Swatch::Line(CONTACT), "border of full contact")),
            (
                self.levels,
                entry(
                    Swatch::Line(LEVEL),
                    format!("equal values, every {}", steps.join(", and every ")),
                ),
            ),
            (crossed, entry(Swatch::Crossed, "unresolved")),
        ];
        let mut entries: Vec<Entry> =
            all.into_iter().filter(|(shown, _)| *shown).map(|(_, entry)| entry).collect();
        entries.extend(keys::overlay(maps, self.overlay));
        entries.extend(self.rings.then(keys::ring));
        entries.extend(keys::locked(maps));
        let contact = |map: &&Map| map.outcomes.iter().all(|cell| cell.class == Class::FullContact);
        if maps.iter().all(contact) {
            entries.push(entry(Swatch::None, "Every block stays in full contact."));
        }
        entries
    }
}

/// Draws a field; `at` tells what the map is a slice at.
pub fn draw(map: &Map, field: &Field, at: &str, print: Print) -> Result<Picture, FigureError> {
    let title =
        titled(&format!("{}: {}", print.title.unwrap_or(&map.scene.title), field.title), at);
    beside(map, &[field], &title, print)
}

/// Draws fields of a map beside each other, with one legend.
pub fn beside(
    map: &Map,
    fields: &[&Field],
    title: &str,
    print: Print,
) -> Result<Picture, FigureError> {
    /// Between two plots.
    const APART: f64 = 12.0;
    let mut canvas = print.canvas(COLUMN);
    let mut top = caption::heading(&mut canvas, map.scene, title) + GAP;
    let (left, whole) = side(&canvas);
    let count = fields.len().max(1) as f64;
    let side = (whole - APART * (count - 1.0)) / count;
    let heads: Vec<Vec<String>> = match fields {
        [_] => vec![Vec::new()],
        several => several.iter().map(|field| wrapped(field.title, FONT, side)).collect(),
    };
    let lines = heads.iter().map(Vec::len).max().unwrap_or(0);
    top += LEADING * FONT * lines as f64;
    let mut shown = Shown::default();
    let (mut end, mut scales) = (top, Vec::new());
    for (k, field) in fields.iter().enumerate() {
        let place =
            Place { x: left + k as f64 * (side + APART), y: top, width: side, height: side };
        let head = &heads[k];
        write(&mut canvas, (place.x, top - LEADING * FONT * head.len() as f64), style(FONT), head);
        let greys = Greys::over([map], field);
        let frame = frame(place, &map.grid);
        shown = shown.with(paint(&mut canvas, map, field, &greys, &frame)?);
        let first = k == 0;
        frame.draw(
            &mut canvas,
            Written { y: first, x: true, beyond: if fields.len() > 1 { 1.5 } else { 6.0 } },
        );
        let bar = (place.x, place.bottom() + BELOW + GAP);
        end = greys.draw(&mut canvas, bar, side, field.label)?;
        scales.push((field.label, greys.step()));
    }
    let entries = shown.entries(&[map], &scales);
    let wide = canvas.inner();
    let end = legend::draw(&mut canvas, &entries, (MARGIN, end + GAP), wide, 2);
    Ok(canvas.finish(end + MARGIN))
}

/// Draws the cells of a map in the greys of a scale, its lines, and what lies over them.
pub fn paint(
    canvas: &mut Canvas,
    map: &Map,
    field: &Field,
    greys: &Greys,
    frame: &Frame,
) -> Result<Shown, FigureError> {
    let (place, palette) = (frame.place, canvas.palette());
    let colour = |cell: &Outcome| -> Colour {
        match cell.class {
            Class::Unresolved => WHITE,
            _ if Field::counts(cell) => [greys.shade(field.value(cell)); 3],
            _ => palette.of(FALLEN),
        }
    };
    canvas.image(place, &overturning::cells(map, colour)?, true);
    let overlay = Overlay::of(map, false);
    if let Some(image) = overlay.image(map, place, palette)? {
        canvas.image(place, &image, false);
    }
    let mut shown = Shown {
        fallen: map.outcomes.iter().any(|cell| cell.class.overturned()),
        overlay,
        ..Shown::default()
    };
    let rings = islands(map, place, |cell| (cell.class.overturned(), Field::counts(cell)));
    shown.rings = !rings.is_empty();
    let value = |cell: &Outcome| Field::counts(cell).then(|| field.value(cell));
    let values = greys.levels();
    let on_page = |line: &[Point]| {
        let points: Vec<Point> = line.iter().map(|point| frame.at(*point)).collect();
        length(&points)
    };
    let mut lines = levels(map, value, &values);
    for lines in &mut lines {
        lines.retain(|line| on_page(line) >= SPECK);
    }
    canvas.clipped(place, |canvas| {
        let mut line = |points: &[Point], stroke: Stroke| {
            canvas.line(points.iter().map(|point| frame.at(*point)), stroke);
        };
        for level in lines.iter().flatten() {
            line(level, LEVEL);
            shown.levels = true;
        }
        for points in Boundary::Overturning.lines(map) {
            line(&points, if on_page(&points) < SPECK { LEVEL } else { AROUND });
            shown.overturning = true;
        }
        for points in Boundary::FullContact.lines(map) {
            line(&points, CONTACT);
            shown.contact = true;
        }
        let mut labels = Labels::new(map, frame, &rings);
        for (level, lines) in values.iter().zip(&lines) {
            labels.draw(canvas, lines, &rounded(*level, greys.width()));
        }
        rings.iter().for_each(|at| swatch::ring(canvas, *at));
    });
    Ok(shown)
}
