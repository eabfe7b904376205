//! The scale of greys of a value.

use super::super::Map;
use super::fields::Field;
use crate::colours::ramp;
use crate::drawing::canvas::{Canvas, Point};
use crate::drawing::error::FigureError;
use crate::drawing::frame::Axis;
use crate::drawing::scale;

/// Steps of a scale at most.
const MOST_STEPS: f64 = 10.0;
/// Least width of a scale, over its values.
const ALIKE: f64 = 0.01;

/// A scale of greys: from where to where, in which steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Greys {
    low: f64,
    high: f64,
    step: f64,
    falls: bool,
}

impl Greys {
    /// The scale of a field over some maps: its own ends, or round numbers around the values that
    /// count.
    pub fn over<'a>(maps: impl IntoIterator<Item = &'a Map<'a>>, field: &Field) -> Greys {
        if let Some((low, high)) = field.ends {
            return Greys { low, high, step: level_step(low, high), falls: field.falls };
        }
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for map in maps {
            for cell in map.outcomes.iter().filter(|cell| Field::counts(cell)) {
                let value = field.value(cell);
                (low, high) = (low.min(value), high.max(value));
            }
        }
        if !(low <= high) {
            (low, high) = (0.0, 1.0);
        }
        // Values that are all alike still have a scale whose numbers differ.
        let span = (high - low).max(1.0e-9 + ALIKE * low.abs().max(high.abs()));
        let step = level_step(low, low + span);
        let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
        Greys { low, high, step, falls: field.falls }
    }

    /// From the lowest value to the highest.
    pub fn width(&self) -> f64 {
        self.high - self.low
    }

    /// From one level to the next.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The values between the ends at which maps have lines.
    pub fn levels(&self) -> Vec<f64> {
        let count = (self.width() / self.step).round() as i32;
        (1..count).map(|k| self.low + self.step * f64::from(k)).collect()
    }

    /// The grey of a value.
    pub fn shade(&self, value: f64) -> u8 {
        // Values that are all alike may have no width.
        let width = if self.width() > 0.0 { self.width() } else { 1.0 };
        let share = (value - self.low) / width;
        ramp::grey(if self.falls { 1.0 - share } else { share })
    }

    /// Draws the scale with its numbers and its name below; returns where it ends.
    pub fn draw(
        &self,
        canvas: &mut Canvas,
        at: Point,
        width: f64,
        name: &str,
    ) -> Result<f64, FigureError> {
        let axis = Axis::new(self.low, self.high, name);
        let grey = |share| [self.shade(self.low + self.width() * share); 3];
        scale::draw(canvas, at, width, axis, grey)
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
