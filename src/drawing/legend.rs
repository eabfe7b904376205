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
/// From one entry to the next.
const ROW: f64 = LEADING * FONT + 1.6;

/// Draws entries in columns from the place `at` on, `wide` points across; returns where they end.
pub fn draw(canvas: &mut Canvas, entries: &[Entry], at: Point, wide: f64, columns: usize) -> f64 {
    let count = columns.max(1);
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

/// Shares of a whole in tenths of a percent that sum to 100.0 %: those with the largest remainders are
/// rounded up. What is there but below a tenth is said to be.
pub fn shares(counts: &[usize]) -> Vec<String> {
    let total = counts.iter().sum::<usize>().max(1) as u128;
    let tenths = |count: usize| 1000 * count as u128;
    let mut floors: Vec<u128> = counts.iter().map(|count| tenths(*count) / total).collect();
    let mut order: Vec<usize> = (0..counts.len()).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(tenths(counts[k]) % total));
    let missing = 1000_u128.saturating_sub(floors.iter().sum()) as usize;
    for &k in order.iter().filter(|&&k| counts[k] > 0).take(missing) {
        floors[k] += 1;
    }
    let written = |(floor, count): (&u128, &usize)| match (floor, count) {
        (0, 1..) => "< 0.1 %".to_string(),
        (floor, _) => format!("{}.{} %", floor / 10, floor % 10),
    };
    floors.iter().zip(counts).map(written).collect()
}

#[cfg(test)]
mod tests {
    use super::shares;

    #[test]
    fn shares_sum_to_a_hundred_percent() {
        assert_eq!(shares(&[1, 1, 1]), ["33.4 %", "33.3 %", "33.3 %"]);
        assert_eq!(shares(&[999_999, 1]), ["100.0 %", "< 0.1 %"]);
        // Each rounded by itself these make 100.1 %.
        let counts = [3966, 517, 4105, 256, 876, 175, 44, 16, 6, 39];
        let sum: f64 = shares(&counts)
            .iter()
            .filter_map(|share| share.trim_end_matches(" %").parse::<f64>().ok())
            .sum();
        assert!((sum - 100.0).abs() < 1.0e-9, "{sum}");
    }
}
