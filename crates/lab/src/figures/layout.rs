//! Where the panels of a figure lie.

use super::Panel;
use super::letter;
use topple_pictures::drawing::canvas::write;
use topple_pictures::drawing::canvas::{Canvas, Place};
use topple_pictures::drawing::caption::listed;
use topple_pictures::drawing::frame::{BELOW, LEFT, Written};
use topple_pictures::drawing::text::{style, wrapped};
use topple_pictures::drawing::{FONT, LEADING, MARGIN, PAGE};

/// Space between panels that share an axis.
const GAP: f64 = 12.0;
/// From the number of an axis to the panel below it.
const APART: f64 = 4.0;
/// How far a number may reach beyond its panel: the last one of an axis and the first of the next stay apart.
const BEYOND: f64 = 1.0;
/// Room right of the last panel, for the end of a number.
const RIGHT: f64 = 6.0;
/// Side of a panel at most.
const WIDEST: f64 = 170.0;

/// Square panels in rows, and a picture as wide as they need.
#[derive(Debug, Clone, Copy)]
pub struct Panels {
    count: usize,
    columns: usize,
    side: f64,
    gap: f64,
    /// Width of the picture.
    pub width: f64,
}

/// A panel of a figure: where its plot lies, and which axes it writes.
#[derive(Debug, Clone, Copy)]
pub struct Plot {
    /// Where its plot lies.
    pub place: Place,
    /// What is written at its axes.
    pub written: Written,
}

impl Panels {
    /// So many panels in rows of `columns`; `inner`: one within a row writes its vertical axis.
    pub fn new(count: usize, columns: usize, inner: bool) -> Panels {
        let columns = columns.clamp(1, count.max(1));
        let gap = if inner { LEFT + GAP } else { GAP };
        let gaps = gap * (columns - 1) as f64;
        let edge = 2.0 * MARGIN + LEFT + RIGHT;
        let side = ((PAGE - edge - gaps) / columns as f64).min(WIDEST);
        Panels { count, columns, side, gap, width: edge + gaps + side * columns as f64 }
    }

    /// Writes the titles of the panels from a height on; where their plots lie, and where they end. `written`
    /// tells of a panel whether it writes its vertical and its horizontal axis.
    pub fn lay_out(
        &self,
        canvas: &mut Canvas,
        mut top: f64,
        titles: &[String],
        written: impl Fn(usize) -> (bool, bool),
    ) -> (Vec<Plot>, f64) {
        let mut plots = Vec::with_capacity(self.count);
        for (row, in_row) in titles.chunks(self.columns).enumerate() {
            let across = self.side + (self.gap - GAP).max(0.0);
            let lines: Vec<Vec<String>> =
                in_row.iter().map(|title| wrapped(title, FONT, across)).collect();
            let above = LEADING * FONT * lines.iter().map(Vec::len).max().unwrap_or(0) as f64;
            let mut has_numbers = false;
            for (column, lines) in lines.iter().enumerate() {
                let x = MARGIN + LEFT + column as f64 * (self.side + self.gap);
                let first = top + above - LEADING * FONT * lines.len() as f64;
                write(canvas, (x, first), style(FONT), lines);
                let (y, x_axis) = written(row * self.columns + column);
                has_numbers |= x_axis;
                plots.push(Plot {
                    place: Place { x, y: top + above + 1.5, width: self.side, height: self.side },
                    written: Written { y, x: x_axis, beyond: BEYOND },
                });
            }
            top += above + 1.5 + self.side + if has_numbers { BELOW } else { 0.0 } + APART;
        }
        (plots, top)
    }

    /// Columns of a legend below the panels.
    pub fn legend_columns(&self) -> usize {
        /// Room for the longest line of a legend.
        const WIDE: f64 = 120.0;
        ((self.width - 2.0 * MARGIN) / WIDE).floor().max(1.0) as usize
    }
}

/// What stands above a panel: its letter, and what sets it apart.
pub fn title(panel: &Panel, index: usize, own: &[String]) -> String {
    let mut parts: Vec<String> = Vec::new();
    parts.extend(panel.label.clone());
    parts.extend(panel.motion.clone());
    // No line ends within a parameter.
    parts.extend((!own.is_empty()).then(|| listed(own)));
    format!("({}) {}", letter(index), parts.join(", "))
}
