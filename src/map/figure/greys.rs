//! The scale of greys of a value, and the keys beside it.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::super::Map;
use super::document::Place;
use super::fields::Field;
use super::frame::{Area, Drawn, at, outline, stroke, text};
use super::overturning::hatch_labels;
use super::raster::png;
use super::{FigureError, tick};
use crate::scene::Parameter;
use crate::stepping::outcome::{Class, Outcome, Status};

/// Steps of a scale at most.
const MOST_STEPS: f64 = 10.0;
/// Shades of the lightest and the darkest value.
const LIGHT: f64 = 0.96;
const DARK: f64 = 0.38;
/// Shade of overturned cells where their value is left out.
pub const FALLEN: u8 = 0x50;

/// A scale of greys: from where to where, in which steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Greys {
    low: f64,
    high: f64,
    step: f64,
}

impl Greys {
    /// The scale of a field over some maps: its own ends, or round numbers around the values that
    /// count.
    pub fn over<'a>(maps: impl IntoIterator<Item = &'a Map<'a>>, field: &Field) -> Greys {
        if let Some((low, high)) = field.ends {
            return Greys { low, high, step: level_step(low, high) };
        }
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for map in maps {
            for cell in map.outcomes.iter().filter(|cell| field.counts(cell)) {
                let value = (field.value)(cell);
                (low, high) = (low.min(value), high.max(value));
            }
        }
        if !(low <= high) {
            (low, high) = (0.0, 1.0);
        }
        let span = (high - low).max(1.0e-9 + 1.0e-6 * high.abs());
        let step = level_step(low, low + span);
        Greys { low: (low / step).floor() * step, high: (high / step).ceil() * step, step }
    }

    /// From the lowest value to the highest.
    pub fn width(&self) -> f64 {
        self.high - self.low
    }

    /// The values between the ends at which the scale has a tick.
    pub fn levels(&self) -> Vec<f64> {
        (1..self.count()).map(|k| self.low + self.step * f64::from(k)).collect()
    }

    fn count(&self) -> i32 {
        (self.width() / self.step).round() as i32
    }

    /// The grey of a value.
    pub fn shade(&self, value: f64) -> u8 {
        let share = ((value - self.low) / self.width()).clamp(0.0, 1.0);
        (255.0 * (LIGHT + (DARK - LIGHT) * share)) as u8
    }

    /// The scale as an image.
    ///
    /// # Errors
    /// [`FigureError::Encode`].
    pub fn bar(&self) -> Result<Vec<u8>, FigureError> {
        png(1, 256, |_, row| {
            let grey = self.shade(self.high - self.width() * (row as f64 + 0.5) / 256.0);
            [grey, grey, grey, 255]
        })
    }

    /// Draws the scale's name, frame and numbers around the image at `bar`.
    ///
    /// # Errors
    /// Those of the plotting library.
    pub fn draw(&self, root: &Area, bar: Place, name: &str, font: i32) -> Drawn<()> {
        root.draw(&Text::new(name.to_string(), at(bar.x, bar.y - font * 3 / 2), text(font)))?;
        outline(root, bar, 10)?;
        for k in 0..=self.count() {
            let y = bar.y + bar.height - bar.height * k / self.count().max(1);
            let value = self.low + self.step * f64::from(k);
            let right = bar.x + bar.width;
            let line = stroke(BLACK, 10);
            root.draw(&PathElement::new(vec![at(right, y), at(right + 5, y)], line))?;
            let style = text(font - 2).pos(Pos::new(HPos::Left, VPos::Center));
            root.draw(&Text::new(tick(value, self.width()), at(right + 9, y), style))?;
        }
        Ok(())
    }
}

/// The step of a scale's levels: 1, 2 or 5 of a decimal place.
fn level_step(low: f64, high: f64) -> f64 {
    let rough = (high - low) / MOST_STEPS;
    let place = 10.0_f64.powf(rough.log10().floor());
    let digits = [1.0, 2.0, 5.0, 10.0];
    let fits = digits.into_iter().find(|digit| digit * place >= rough * (1.0 - 1.0e-9));
    fits.unwrap_or(10.0) * place
}

/// Draws what lines, greys and hatches say, downwards from a place; returns where it ends.
///
/// # Errors
/// Those of the plotting library.
pub fn keys(
    root: &Area,
    maps: &[&Map],
    field: &Field,
    hatched: bool,
    (left, mut top): (i32, i32),
    font: i32,
) -> Drawn<i32> {
    let has = |class: fn(&Outcome) -> bool| maps.iter().any(|map| map.outcomes.iter().any(class));
    let row = font * 13 / 7;
    let beside = |top: i32| at(left + 38, top - font * 4 / 7);
    let thick = stroke(BLACK, 26);
    if has(|cell| cell.class.overturned()) {
        root.draw(&PathElement::new(vec![at(left, top), at(left + 30, top)], thick))?;
        root.draw(&Text::new("around overturning", beside(top), text(font)))?;
        top += row;
    }
    if has(|cell| cell.class == Class::FullContact) {
        for x in [left, left + 18] {
            root.draw(&PathElement::new(vec![at(x, top), at(x + 12, top)], thick))?;
        }
        root.draw(&Text::new("around full contact", beside(top), text(font)))?;
        top += row;
    }
    if field.standing_only && has(|cell| cell.class.overturned()) {
        let swatch = [at(left, top - 8), at(left + 30, top + 8)];
        root.draw(&Rectangle::new(swatch, RGBColor(FALLEN, FALLEN, FALLEN).filled()))?;
        root.draw(&Text::new("overturned", beside(top), text(font)))?;
        top += row;
    }
    let mut notes: Vec<String> = Vec::new();
    if hatched && let Some(map) = maps.first() {
        let [why, what] = hatch_labels(map);
        notes.push("hatched:".into());
        notes.push(why.replace("contact force tensile:", "contact force tensile,"));
        notes.push(what);
    }
    if has(|cell| cell.class == Class::Unresolved) {
        notes.push("crossed: unresolved".into());
    }
    let locked = maps.iter().filter_map(|map| locked_up_to(map)).fold(f64::NEG_INFINITY, f64::max);
    if locked.is_finite() {
        notes.push(format!("up to T_v = {} s:", tick(locked, locked)));
        notes.push("vertically rigid for this".into());
        notes.push("record, direction locked".into());
    }
    for note in notes {
        root.draw(&Text::new(note, at(left, top - font * 4 / 7), text(font)))?;
        top += font * 10 / 7;
    }
    Ok(top)
}

/// The largest T_v of a map at which the vertical direction was locked, s.
fn locked_up_to(map: &Map) -> Option<f64> {
    let cells = map.outcomes.iter().enumerate();
    cells
        .filter(|(_, cell)| cell.status == Status::VerticalLocked)
        .filter_map(|(index, _)| map.grid.value(Parameter::TV, index))
        .reduce(f64::max)
}
