//! Maps of a value in greys with contour levels, in the manner of the paper's Figs. 4 and 6.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::super::Map;
use super::super::boundaries::{Boundary, Line, levels};
use super::document::{Place, compose};
use super::frame::{
    Area, Drawn, FINE, PLOT, Plot, SIZE, area, at, map_frame, outline, stroke, text,
};
use super::overturning::{hatch, hatch_labels};
use super::raster::png;
use super::{FigureError, tick};
use crate::integrate::outcome::{Class, Outcome, Status};

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

/// The rocking index and the displacements, a figure each.
pub const FIELDS: [Field; 3] = [
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
/// Steps of a scale at most.
const MOST_STEPS: f64 = 10.0;
/// Shades of the lightest and the darkest value.
const LIGHT: f64 = 0.96;
const DARK: f64 = 0.38;
/// Shade of overturned cells where their value is left out.
const FALLEN: u8 = 0x50;

/// The ends of a field's scale: round numbers around the values that count.
fn ends(map: &Map, field: &Field) -> (f64, f64) {
    if let Some(ends) = field.ends {
        return ends;
    }
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for cell in map.outcomes.iter().filter(|cell| counts(field, cell)) {
        let value = (field.value)(cell);
        (low, high) = (low.min(value), high.max(value));
    }
    if !(low <= high) {
        return (0.0, 1.0);
    }
    let span = (high - low).max(1.0e-9 + 1.0e-6 * high.abs());
    let step = level_step(low, low + span);
    ((low / step).floor() * step, (high / step).ceil() * step)
}

/// The step of a scale's levels: 1, 2 or 5 of a decimal place.
fn level_step(low: f64, high: f64) -> f64 {
    let rough = (high - low) / MOST_STEPS;
    let place = 10.0_f64.powf(rough.log10().floor());
    let digits = [1.0, 2.0, 5.0, 10.0];
    let fits = digits.into_iter().find(|digit| digit * place >= rough * (1.0 - 1.0e-9));
    fits.unwrap_or(10.0) * place
}

fn counts(field: &Field, cell: &Outcome) -> bool {
    cell.class != Class::Unresolved && !(field.standing_only && cell.class.overturned())
}

/// Draws a field as SVG.
///
/// # Errors
/// Any [`FigureError`].
pub fn draw(map: &Map, field: &Field) -> Result<String, FigureError> {
    let (columns, rows) = map.grid.shape();
    let (low, high) = ends(map, field);
    let shade = |value: f64| {
        let share = ((value - low) / (high - low)).clamp(0.0, 1.0);
        (255.0 * (LIGHT + (DARK - LIGHT) * share)) as u8
    };
    let cells = png(columns, rows, |column, row| {
        let cell = &map.outcomes[(rows - 1 - row) * columns + column];
        let grey = match cell.class {
            Class::Unresolved => 255,
            _ if counts(field, cell) => shade((field.value)(cell)),
            _ => FALLEN,
        };
        [grey, grey, grey, 255]
    })?;
    let scale = png(1, 256, |_, row| {
        let grey = shade(high - (high - low) * (row as f64 + 0.5) / 256.0);
        [grey, grey, grey, 255]
    })?;
    let mut images = vec![(PLOT, cells), (BAR, scale)];
    let beyond = |index: usize| map.beyond_the_model(&map.outcomes[index]);
    let unresolved = |index: usize| map.outcomes[index].class == Class::Unresolved;
    let any = |test: &dyn Fn(usize) -> bool| (0..map.outcomes.len()).any(test);
    let hatched = any(&beyond);
    if hatched || any(&unresolved) {
        images.push((PLOT, hatch(columns, rows, &beyond, &unresolved)?));
    }
    let mut drawing = String::new();
    frame(map, field, (low, high), hatched, &mut drawing)
        .map_err(|e| FigureError::Draw(e.to_string()))?;
    Ok(compose(SIZE, &images, &drawing))
}

/// Place of the scale of greys.
const BAR: Place = Place { x: 730, y: 110, width: 22, height: 300 };

fn frame(
    map: &Map,
    field: &Field,
    (low, high): (f64, f64),
    hatched: bool,
    drawing: &mut String,
) -> Drawn<()> {
    let root = area(drawing, SIZE);
    let mut plot = map_frame(&root, map, &format!("{}: {}", map.scene.title, field.title))?;
    let step = level_step(low, high);
    let count = ((high - low) / step).round() as usize;
    let values: Vec<f64> = (1..count).map(|k| low + step * k as f64).collect();
    let value = |cell: &Outcome| {
        (counts(field, cell) && !cell.class.overturned()).then(|| (field.value)(cell))
    };
    let mut labelled = Vec::new();
    for (level, lines) in values.iter().zip(levels(map, value, &values)) {
        for line in &lines {
            plot.draw_series(LineSeries::new(
                line.iter().copied(),
                stroke(RGBColor(40, 40, 40), 6),
            ))?;
        }
        if let Some(longest) = lines.into_iter().max_by_key(|line| line.len()) {
            labelled.push((tick(*level, high - low), longest));
        }
    }
    let thick = stroke(BLACK, 26);
    for line in Boundary::Overturning.lines(map) {
        plot.draw_series(LineSeries::new(line, thick))?;
    }
    for line in Boundary::FullContact.lines(map) {
        plot.draw_series(DashedLineSeries::new(line, (9 * FINE) as u32, (6 * FINE) as u32, thick))?;
    }
    let mut labels = Labels { map, field, placed: Vec::new() };
    for (text, line) in &labelled {
        labels.draw(&mut plot, line, text)?;
    }
    legend(&root, map, field, (low, high), hatched)?;
    root.present()?;
    Ok(())
}

/// Values written on their lines: none on top of another, none near a cell without a value.
struct Labels<'a> {
    map: &'a Map<'a>,
    field: &'a Field,
    /// Places taken, as shares of the axes.
    placed: Vec<(f64, f64)>,
}

impl Labels<'_> {
    /// Points that a line has at least to be labelled.
    const SHORTEST: usize = 12;
    /// Distance of two labels, as a share of the axes.
    const APART: (f64, f64) = (0.09, 0.04);
    /// Half of the room of a label, as a share of the axes.
    const ROOM: (f64, f64) = (0.035, 0.015);

    fn draw(&mut self, plot: &mut Plot, line: &Line, value: &str) -> Drawn<()> {
        if line.len() < Self::SHORTEST {
            return Ok(());
        }
        let middle = line.len() / 2;
        let outwards = (0..middle).flat_map(|k| [line[middle - k], line[middle + k]]);
        let Some(place) = outwards.into_iter().find(|place| self.free(self.share(*place))) else {
            return Ok(());
        };
        self.placed.push(self.share(place));
        let style = text(12).pos(Pos::new(HPos::Center, VPos::Center));
        let half = (4 * value.len() as i32 + 2) * FINE;
        plot.draw_series([EmptyElement::at(place)
            + Rectangle::new([(-half, -7 * FINE), (half, 7 * FINE)], WHITE.mix(0.8).filled())
            + Text::new(value.to_string(), (0, 0), style)])?;
        Ok(())
    }

    fn share(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let of = |range: &crate::scene::Range, value: f64| {
            (value - range.start) / (range.stop - range.start)
        };
        (of(&self.map.grid.x.range, x), of(&self.map.grid.y.range, y))
    }

    fn free(&self, (x, y): (f64, f64)) -> bool {
        let apart =
            |(a, b): &(f64, f64)| (x - a).abs() > Self::APART.0 || (y - b).abs() > Self::APART.1;
        if !self.placed.iter().all(apart) {
            return false;
        }
        let (columns, rows) = self.map.grid.shape();
        let cell = |share: f64, count: usize| (share * (count - 1) as f64).round();
        for dx in [-1.0, -0.5, 0.0, 0.5, 1.0] {
            for dy in [-1.0, 0.0, 1.0] {
                let i = cell(x + dx * Self::ROOM.0, columns);
                let j = cell(y + dy * Self::ROOM.1, rows);
                if !(i >= 0.0 && j >= 0.0 && i < columns as f64 && j < rows as f64) {
                    return false;
                }
                let outcome = &self.map.outcomes[j as usize * columns + i as usize];
                if outcome.class.overturned() || !counts(self.field, outcome) {
                    return false;
                }
            }
        }
        true
    }
}

fn legend(
    root: &Area,
    map: &Map,
    field: &Field,
    (low, high): (f64, f64),
    hatched: bool,
) -> Drawn<()> {
    let line = stroke(BLACK, 10);
    root.draw(&Text::new(field.label, at(BAR.x, BAR.y - 24), text(16)))?;
    outline(root, BAR, 10)?;
    let step = level_step(low, high);
    let count = ((high - low) / step).round() as i32;
    for k in 0..=count {
        let y = BAR.y + BAR.height - BAR.height * k / count.max(1);
        let value = low + step * f64::from(k);
        let right = BAR.x + BAR.width;
        root.draw(&PathElement::new(vec![at(right, y), at(right + 5, y)], line))?;
        let style = text(14).pos(Pos::new(HPos::Left, VPos::Center));
        root.draw(&Text::new(tick(value, high - low), at(right + 9, y), style))?;
    }
    let mut top = BAR.y + BAR.height + 34;
    let left = BAR.x;
    let has = |class: fn(&Outcome) -> bool| map.outcomes.iter().any(class);
    if has(|cell| cell.class.overturned()) {
        root.draw(&PathElement::new(vec![at(left, top), at(left + 30, top)], stroke(BLACK, 26)))?;
        root.draw(&Text::new("around overturning", at(left + 38, top - 8), text(14)))?;
        top += 26;
    }
    if has(|cell| cell.class == Class::FullContact) {
        for x in [left, left + 18] {
            let dash = vec![at(x, top), at(x + 12, top)];
            root.draw(&PathElement::new(dash, stroke(BLACK, 26)))?;
        }
        root.draw(&Text::new("around full contact", at(left + 38, top - 8), text(14)))?;
        top += 26;
    }
    if field.standing_only && has(|cell| cell.class.overturned()) {
        let swatch = [at(left, top - 8), at(left + 30, top + 8)];
        root.draw(&Rectangle::new(swatch, RGBColor(FALLEN, FALLEN, FALLEN).filled()))?;
        root.draw(&Text::new("overturned", at(left + 38, top - 8), text(14)))?;
        top += 26;
    }
    let mut notes: Vec<String> = Vec::new();
    if hatched {
        let [why, what] = hatch_labels(map);
        notes.push("hatched:".into());
        notes.push(why.replace("contact force tensile:", "contact force tensile,"));
        notes.push(what);
    }
    if has(|cell| cell.class == Class::Unresolved) {
        notes.push("crossed: unresolved".into());
    }
    let locked = map
        .outcomes
        .iter()
        .enumerate()
        .filter(|(_, cell)| cell.status == Status::VerticalLocked)
        .map(|(index, _)| map.grid.coordinates(index).1)
        .fold(f64::NEG_INFINITY, f64::max);
    if locked.is_finite() {
        notes.push(format!("up to T_v = {} s:", tick(locked, locked)));
        notes.push("vertically rigid for this".into());
        notes.push("record, direction locked".into());
    }
    for note in notes {
        root.draw(&Text::new(note, at(left, top - 8), text(14)))?;
        top += 20;
    }
    Ok(())
}
