//! What the colours, hatches, lines and marks of a picture mean.

use super::canvas::{Canvas, Point, write};
use super::swatch::{SIZE, Swatch};
use super::text::{self, style};
use super::{FONT, LEADING};

/// A line of a legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// What it explains.
    pub swatch: Swatch,
    /// What that means.
    pub label: String,
    /// How much of the picture it is.
    pub share: Option<String>,
}

/// A line of a legend without a share.
pub fn entry(swatch: Swatch, label: impl Into<String>) -> Entry {
    Entry { swatch, label: label.into(), share: None }
}

/// From a swatch to its label, and from one column to the next.
const GAP: f64 = 4.0;
const APART: f64 = 10.0;
/// A column is no narrower where there is more than one.
const NARROWEST: f64 = 60.0;
/// From one entry to the next.
const ROW: f64 = LEADING * FONT + 1.6;

/// Draws entries in a given number of columns, fewer where they have no room, from the place `at` on, `wide` points across; returns where they end.
pub fn draw(canvas: &mut Canvas, entries: &[Entry], at: Point, wide: f64, columns: usize) -> f64 {
    let room = ((wide + APART) / (NARROWEST + APART)) as usize;
    let count = columns.min(room).max(1);
    let column = (wide - APART * (count - 1) as f64) / count as f64;
    let lines = |entry: &Entry| {
        let share = entry.share.as_ref().map_or(0.0, |share| text::width(share, FONT) + GAP);
        // A remark begins where swatches do.
        let left = if entry.swatch == Swatch::None { 0.0 } else { SIZE.0 + GAP };
        (left, text::wrapped(&entry.label, FONT, column - left - share))
    };
    let height = |entry: &Entry| ROW + LEADING * FONT * (lines(entry).1.len() - 1) as f64;
    let whole: f64 = entries.iter().map(height).sum();
    // The first columns are filled first, each up to its part of the whole.
    let (mut x, mut y, mut done, mut lowest) = (at.0, at.1, 0.0, at.1);
    let mut number = 1;
    for entry in entries {
        if number < count && done >= whole * number as f64 / count as f64 - 0.1 {
            (x, y, number) = (x + column + APART, at.1, number + 1);
        }
        let (left, lines) = lines(entry);
        entry.swatch.draw(canvas, (x, y + 0.5));
        if let Some(share) = &entry.share {
            canvas.text((x + column, y + 0.9 * FONT), style(FONT).end(), share);
        }
        write(canvas, (x + left, y - 0.1 * FONT), style(FONT), &lines);
        y += height(entry);
        done += height(entry);
        lowest = f64::max(lowest, y);
    }
    lowest
}
