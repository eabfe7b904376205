//! Values written on the lines of a map.

use super::super::Map;
use super::super::boundaries::Line;
use super::fields::Field;
use crate::colours::WHITE;
use crate::drawing::FONT;
use crate::drawing::canvas::{Canvas, Place, Point};
use crate::drawing::frame::Frame;
use crate::drawing::swatch::RING;
use crate::drawing::text::{MIDDLE, style, width};

/// Values written on their lines: none beside another in a heap, none over a boundary of overturning. A line without room for its
/// value has none; the legend tells the step from one line to the next.
pub struct Labels<'a> {
    map: &'a Map<'a>,
    frame: &'a Frame,
    /// Places that are taken, and by which value.
    placed: Vec<(Place, String)>,
}

/// White around a number.
const EDGE: f64 = 0.8;
/// Free space around a number, points; and to the next one of the same value, over the width of the plot.
const CLEAR: f64 = 5.0;
const ALIKE: f64 = 0.35;
/// A line is labelled where it is this long at least, over the width of the number.
const LONG: f64 = 2.4;
/// A second line of a level is labelled where it is this long at least, over the width of the plot.
const ANOTHER: f64 = 0.4;
/// Lines of a level that are tried, the longest first.
const TRIED: usize = 8;
/// Places along a line that are tried.
const PLACES: usize = 24;

impl<'a> Labels<'a> {
    /// None placed yet; rings are not written on.
    pub fn new(map: &'a Map<'a>, frame: &'a Frame, rings: &[Point]) -> Labels<'a> {
        let around = |(x, y): &Point| Place {
            x: x - RING,
            y: y - RING,
            width: 2.0 * RING,
            height: 2.0 * RING,
        };
        let placed = rings.iter().map(|ring| (around(ring), String::new())).collect();
        Labels { map, frame, placed }
    }

    /// Writes a value on its longest line that has room for it, and on other long ones, as near to the middle
    /// of each as there is room.
    pub fn draw(&mut self, canvas: &mut Canvas, lines: &[Line], value: &str) {
        let size = (width(value, FONT) + 2.0 * EDGE, FONT + 2.0 * EDGE - 1.0);
        let mut drawn: Vec<Vec<Point>> = lines
            .iter()
            .map(|line| line.iter().map(|point| self.frame.at(*point)).collect())
            .collect();
        drawn.sort_by(|a, b| length(b).total_cmp(&length(a)));
        let mut written = false;
        for line in drawn.iter().take(TRIED) {
            let least = if written { ANOTHER * self.frame.place.width } else { LONG * size.0 };
            if length(line) < least {
                break;
            }
            written |= self.label(canvas, line, size, value);
        }
    }

    /// Writes a value on a line; true where there was room.
    fn label(
        &mut self,
        canvas: &mut Canvas,
        line: &[Point],
        size: (f64, f64),
        value: &str,
    ) -> bool {
        let middle = line.len() / 2;
        let step = (middle / PLACES).max(1);
        let places = (0..middle).step_by(step).flat_map(|k| [line[middle - k], line[middle + k]]);
        let around = |(x, y): Point| Place {
            x: x - 0.5 * size.0,
            y: y - 0.5 * size.1,
            width: size.0,
            height: size.1,
        };
        let Some(place) = places.map(around).find(|place| self.is_free(place, value)) else {
            return false;
        };
        canvas.fill_through(place, WHITE, 0.85);
        let middle = (place.x + 0.5 * place.width, place.y + 0.5 * place.height + MIDDLE * FONT);
        canvas.text(middle, style(FONT).middle(), value);
        self.placed.push((place, value.to_string()));
        true
    }

    fn is_free(&self, place: &Place, value: &str) -> bool {
        let plot = self.frame.place;
        let apart = |(other, its): &(Place, String)| {
            let clear = match its.as_str() {
                // A ring may touch it.
                "" => 0.0,
                its if its == value => ALIKE * plot.width,
                _ => CLEAR,
            };
            place.x > other.right() + clear
                || place.right() < other.x - clear
                || place.y > other.bottom() + clear
                || place.bottom() < other.y - clear
        };
        let inside = place.x > plot.x
            && place.y > plot.y
            && place.right() < plot.right()
            && place.bottom() < plot.bottom();
        if !inside || !self.placed.iter().all(apart) {
            return false;
        }
        let (columns, rows) = self.map.grid.shape();
        let cell = |from: f64, whole: f64, count: usize| {
            ((from / whole * count as f64) as usize).min(count - 1)
        };
        let column = |x: f64| cell(x - plot.x, plot.width, columns);
        let row = |y: f64| cell(plot.bottom() - y, plot.height, rows);
        (row(place.bottom())..=row(place.y)).all(|j| {
            (column(place.x)..=column(place.right()))
                .all(|i| Field::counts(&self.map.outcomes[j * columns + i]))
        })
    }
}

/// How long a line is.
pub fn length(line: &[Point]) -> f64 {
    line.windows(2).map(|pair| (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1)).sum()
}
