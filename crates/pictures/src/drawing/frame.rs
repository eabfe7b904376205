//! The frame of a plot: its outline, its axes with their numbers and names.

use super::canvas::{Canvas, Place, Point, stroke};
use super::text::{self, MIDDLE, style, width};
use super::ticks::{self, Scale, Tick};
use super::{FONT, LEADING};
use crate::colours::BLACK;
use topple::scene::{Values, grid};

/// Room left of a plot for the name and numbers of its axis, points.
pub const LEFT: f64 = 30.0;
/// Room below a plot for the same.
pub const BELOW: f64 = 21.0;
/// Length of a tick, and of a small one.
const TICK: f64 = 2.5;
const SMALL: f64 = 1.5;
/// From a plot's left edge to the foot of the name: at least, and at most where numbers are wide.
const NAME: (f64, f64) = (20.0, 27.5);
/// From the numbers to the name.
const BESIDE: f64 = 3.0;
/// Width of a frame's lines.
pub const LINE: f64 = 0.5;
/// Least distance of two numbers, over the size of their letters.
const APART: f64 = 0.8;

/// An axis: its ends, how values lie along it, and its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Coordinate where it begins.
    pub from: f64,
    /// Coordinate where it ends; it may be the lower one.
    pub to: f64,
    /// How values lie along it.
    pub scale: Scale,
    /// Symbol and unit.
    pub name: String,
}

impl Axis {
    /// An even axis.
    pub fn new(from: f64, to: f64, name: impl Into<String>) -> Axis {
        Axis { from, to, scale: Scale::Linear, name: name.into() }
    }

    /// A logarithmic axis; its coordinates are decimal logarithms.
    pub fn log(from: f64, to: f64, name: impl Into<String>) -> Axis {
        let scale = Scale::Log { negative: false };
        Axis { scale, ..Axis::new(from.log10(), to.log10(), name) }
    }

    /// The axis of a sweep, half a cell beyond its first and last value; without one an empty axis.
    pub fn of(axis: Option<&grid::Axis>) -> Axis {
        let Some(axis) = axis else { return Axis::new(0.0, 1.0, "") };
        let (from, to) = extent(&axis.values);
        let scale = match &axis.values {
            Values::List(values) => Scale::List(values.clone()),
            Values::Range(range) if range.log => Scale::Log { negative: range.start < 0.0 },
            Values::Range(_) => Scale::Linear,
        };
        Axis { from, to, scale, name: axis.entry().label() }
    }
}

/// The two ends of an axis in its coordinates, half a cell beyond its first and last value.
pub fn extent(values: &Values) -> (f64, f64) {
    let last = (values.count() - 1) as f64;
    if last == 0.0 {
        let only = values.coordinate(0.0);
        let half = (only.abs() * 0.05).max(0.05);
        return (only - half, only + half);
    }
    (values.coordinate(-0.5), values.coordinate(last + 0.5))
}

/// What is written at the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Written {
    /// Numbers and name left of the plot; small marks only where a neighbour has them.
    pub y: bool,
    /// Numbers and name below it.
    pub x: bool,
    /// Room beside the plot into which a number of the horizontal axis may reach.
    pub beyond: f64,
}

/// Both axes written, with room beside the plot.
pub const BOTH: Written = Written { y: true, x: true, beyond: 6.0 };

/// A plot in the units of its axes.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Where it lies.
    pub place: Place,
    x: Axis,
    y: Axis,
}

impl Frame {
    /// A plot with its axes.
    pub fn new(place: Place, x: Axis, y: Axis) -> Frame {
        Frame { place, x, y }
    }

    /// The place of a point, by its coordinates.
    pub fn at(&self, (x, y): Point) -> Point {
        (self.x_at(x), self.y_at(y))
    }

    fn x_at(&self, x: f64) -> f64 {
        self.place.x + self.place.width * (x - self.x.from) / (self.x.to - self.x.from)
    }

    fn y_at(&self, y: f64) -> f64 {
        self.place.bottom() - self.place.height * (y - self.y.from) / (self.y.to - self.y.from)
    }

    /// Where a number of the horizontal axis begins and ends: about its mark, moved to where there is room.
    fn across(&self, tick: &Tick, beyond: f64) -> (f64, f64) {
        let wide = width(&tick.text, FONT);
        let (least, most) = (self.place.x - beyond, self.place.right() + beyond - wide);
        let left = (self.x_at(tick.at) - 0.5 * wide).min(most).max(least);
        (left, left + wide)
    }

    /// The marks of the horizontal axis, none of whose numbers touch.
    fn x_ticks(&self, beyond: f64) -> Vec<Tick> {
        ticks::of(&self.x.scale, (self.x.from, self.x.to), |ticks| {
            let named = ticks.iter().filter(|tick| !tick.text.is_empty());
            let mut taken: Vec<(f64, f64)> = named.map(|tick| self.across(tick, beyond)).collect();
            taken.sort_by(|a, b| a.0.total_cmp(&b.0));
            taken.windows(2).all(|pair| pair[1].0 - pair[0].1 >= APART * FONT)
        })
    }

    /// The marks of the vertical axis, none of whose numbers touch.
    fn y_ticks(&self) -> Vec<Tick> {
        ticks::of(&self.y.scale, (self.y.from, self.y.to), |ticks| {
            let named = ticks.iter().filter(|tick| !tick.text.is_empty());
            let mut feet: Vec<f64> = named.clone().map(|tick| self.y_at(tick.at)).collect();
            feet.sort_by(f64::total_cmp);
            feet.windows(2).all(|pair| pair[1] - pair[0] >= 1.3 * LEADING * FONT)
                && named
                    .into_iter()
                    .all(|tick| width(&tick.text, FONT) <= NAME.1 - TICK - 1.5 - BESIDE)
        })
    }

    /// Light lines across the plot at the numbers of the axes.
    pub fn draw_grid(&self, canvas: &mut Canvas) {
        let Place { x, y, .. } = self.place;
        let light = stroke([0xdd, 0xdd, 0xdd], 0.3);
        for tick in self.x_ticks(BOTH.beyond).iter().filter(|tick| !tick.text.is_empty()) {
            let at = self.x_at(tick.at);
            canvas.line([(at, y), (at, self.place.bottom())], light);
        }
        for tick in self.y_ticks().iter().filter(|tick| !tick.text.is_empty()) {
            let at = self.y_at(tick.at);
            canvas.line([(x, at), (self.place.right(), at)], light);
        }
    }

    /// Draws the outline and what is written at the axes.
    pub fn draw(&self, canvas: &mut Canvas, written: Written) {
        let Place { x, height, .. } = self.place;
        let (bottom, line) = (self.place.bottom(), stroke(BLACK, LINE));
        let length = |tick: &Tick| if tick.text.is_empty() { SMALL } else { TICK };
        if !self.x.name.is_empty() {
            for tick in self.x_ticks(written.beyond) {
                let at = self.x_at(tick.at);
                canvas.line([(at, bottom), (at, bottom + length(&tick))], line);
                if written.x && !tick.text.is_empty() {
                    let left = self.across(&tick, written.beyond).0;
                    canvas.text((left, bottom + TICK + 1.0 + 0.8 * FONT), style(FONT), &tick.text);
                }
            }
        }
        if written.x {
            let middle = self.place.x + 0.5 * self.place.width;
            canvas.text((middle, bottom + BELOW - 3.0), style(FONT).middle(), &self.x.name);
        }
        let mut widest = 0.0_f64;
        if !self.y.name.is_empty() {
            for tick in self.y_ticks() {
                let at = self.y_at(tick.at);
                widest = widest.max(width(&tick.text, FONT));
                canvas.line([(x - length(&tick), at), (x, at)], line);
                if written.y {
                    let foot = (x - TICK - 1.5, at + MIDDLE * FONT);
                    canvas.text(foot, style(FONT).end(), &tick.text);
                }
            }
        }
        if written.y {
            let middle = self.place.y + 0.5 * height;
            let lines = text::wrapped(&self.y.name, FONT, 1.4 * height.max(FONT));
            for (k, part) in lines.iter().rev().enumerate() {
                let name = (widest + TICK + 1.5 + BESIDE).clamp(NAME.0, NAME.1);
                let foot = (x - name - LEADING * FONT * k as f64, middle);
                canvas.text(foot, style(FONT).middle().upwards(), part);
            }
        }
        canvas.outline(self.place, line);
    }
}
