//! Maps of a value in greys with contour levels, in the manner of the paper's Figs. 4 and 6.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::super::Map;
use super::super::boundaries::{Boundary, Line, levels};
use super::document::{Place, compose};
use super::frame::{Area, Drawn, FINE, PLOT, Plot, SIZE, area, at, map_frame, stroke, text};
use super::overturning::{TENSILE, hatch};
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

/// The four figures of a record's map.
pub const FIELDS: [Field; 5] = [
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
        name: "contact",
        title: "least contact force",
        label: "min N/M [m/s²]",
        value: |cell| cell.min_contact,
        ends: None,
        standing_only: true,
    },
    Field {
        name: "friction",
        title: "friction coefficient asked for",
        label: "max |horizontal| / N",
        value: |cell| cell.friction.min(FRICTION),
        ends: None,
        standing_only: true,
    },
];

/// Friction above which all values are alike: nothing holds there.
const FRICTION: f64 = 2.0;
/// Levels drawn between the ends of a scale.
const LEVELS: usize = 9;
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
    let unit = 10.0_f64.powf(span.log10().floor()) / 2.0;
    ((low / unit).floor() * unit, (high / unit).ceil() * unit)
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
    let tensile = |index: usize| map.outcomes[index].min_contact < 0.0;
    let unresolved = |index: usize| map.outcomes[index].class == Class::Unresolved;
    let any = |test: &dyn Fn(usize) -> bool| (0..map.outcomes.len()).any(test);
    if any(&tensile) || any(&unresolved) {
        images.push((PLOT, hatch(columns, rows, &tensile, &unresolved)?));
    }
    let mut drawing = String::new();
    frame(map, field, (low, high), any(&tensile), &mut drawing)
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
    let values: Vec<f64> =
        (1..=LEVELS).map(|k| low + (high - low) * k as f64 / (LEVELS + 1) as f64).collect();
    // A cell that does not count is far above every level, so that lines end at its edge.
    let value = |cell: &Outcome| if counts(field, cell) { (field.value)(cell) } else { high };
    for (level, lines) in values.iter().zip(levels(map, value, &values)) {
        for line in &lines {
            plot.draw_series(LineSeries::new(
                line.iter().copied(),
                stroke(RGBColor(40, 40, 40), 6),
            ))?;
        }
        if let Some(longest) = lines.iter().max_by_key(|line| line.len()) {
            label(&mut plot, longest, &tick(*level, high - low))?;
        }
    }
    let thick = stroke(BLACK, 26);
    for line in Boundary::Overturning.lines(map) {
        plot.draw_series(LineSeries::new(line, thick))?;
    }
    for line in Boundary::FullContact.lines(map) {
        plot.draw_series(DashedLineSeries::new(line, (9 * FINE) as u32, (6 * FINE) as u32, thick))?;
    }
    legend(&root, map, field, (low, high), hatched)?;
    root.present()?;
    Ok(())
}

/// Writes a level's value on its line.
fn label(plot: &mut Plot, line: &Line, value: &str) -> Drawn<()> {
    const SHORTEST: usize = 8;
    if line.len() < SHORTEST {
        return Ok(());
    }
    let (x, y) = line[line.len() / 2];
    let style = text(12).pos(Pos::new(HPos::Center, VPos::Center));
    let half = (4 * value.len() as i32 + 2) * FINE;
    plot.draw_series([EmptyElement::at((x, y))
        + Rectangle::new([(-half, -7 * FINE), (half, 7 * FINE)], WHITE.mix(0.8).filled())
        + Text::new(value.to_string(), (0, 0), style)])?;
    Ok(())
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
    let corner = at(BAR.x + BAR.width, BAR.y + BAR.height);
    root.draw(&Rectangle::new([at(BAR.x, BAR.y), corner], line))?;
    for k in 0..=5 {
        let y = BAR.y + BAR.height - BAR.height * k / 5;
        let value = low + (high - low) * f64::from(k) / 5.0;
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
        notes.push("hatched: contact force".into());
        notes.push(format!("tensile, {}", TENSILE[1]));
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
