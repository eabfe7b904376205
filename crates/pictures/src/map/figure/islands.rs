//! Regions of a map that are too small to be seen in print.

use std::collections::HashMap;

use super::super::Map;
use crate::drawing::canvas::{Place, Point};
use crate::drawing::swatch::RING;
use topple::stepping::outcome::Outcome;

/// A region of this many points a side, or larger, is seen.
const SEEN: f64 = 1.6;

/// More small regions than this, in a square of three times `NEAR`, are a crowd.
const CROWD: usize = 6;
const NEAR: f64 = 3.0 * RING;

/// The middles of the regions that are too small to be seen at a place: those that lie within one other
/// region and no crowd, and one of each kind of which nothing else is seen. Of those whose rings would overlap it
/// is the first. `kind` tells what a region is one of.
pub fn islands<K: PartialEq>(map: &Map, place: Place, kind: impl Fn(&Outcome) -> K) -> Vec<Point> {
    let (columns, rows) = map.grid.shape();
    if columns < 2 || rows < 2 {
        return Vec::new();
    }
    let (wide, high) = (place.width / columns as f64, place.height / rows as f64);
    let most = |cell: f64| (SEEN / cell).ceil() as usize;
    let (across, up) = (most(wide) - 1, most(high) - 1);
    if across == 0 || up == 0 {
        return Vec::new();
    }
    let kinds: Vec<K> = map.outcomes.iter().map(kind).collect();
    let at = |(i, j): (usize, usize)| &kinds[j * columns + i];
    let around = |(i, j): (usize, usize)| {
        let left = i.saturating_sub(1)..=(i + 1).min(columns - 1);
        left.flat_map(move |a| (j.saturating_sub(1)..=(j + 1).min(rows - 1)).map(move |b| (a, b)))
    };
    let mut found: Vec<Point> = Vec::new();
    let apart = |found: &[Point], (x, y): Point| {
        found.iter().all(|(a, b)| (a - x).hypot(b - y) > 2.0 * RING)
    };
    let bucket = |(x, y): Point| ((x / NEAR).floor() as i64, (y / NEAR).floor() as i64);
    let mut crowd: HashMap<(i64, i64), usize> = HashMap::new();
    let mut within: Vec<(&K, Point)> = Vec::new();
    // Kinds that are seen, and regions that are not.
    let (mut seen, mut unseen): (Vec<&K>, Vec<(&K, Point)>) = (Vec::new(), Vec::new());
    for j in 0..rows {
        for i in 0..columns {
            // A region is met at its first cell; others have one of theirs before them.
            let before = around((i, j)).any(|(a, b)| (b, a) < (j, i) && at((a, b)) == at((i, j)));
            if before {
                continue;
            }
            let own = at((i, j));
            let Some((low, last, within_one)) = small((i, j), (across, up), &around, &at) else {
                if !seen.contains(&own) {
                    seen.push(own);
                }
                continue;
            };
            let middle = |low: usize, end: usize, size: f64| 0.5 * (low + end + 1) as f64 * size;
            let x = place.x + middle(low.0, last.0, wide);
            let y = place.bottom() - middle(low.1, last.1, high);
            if within_one {
                *crowd.entry(bucket((x, y))).or_default() += 1;
                within.push((own, (x, y)));
            } else {
                unseen.push((own, (x, y)));
            }
        }
    }
    for (own, place) in within {
        // Where there are many the ground is seen to be speckled, and rings would hide it.
        let (a, b) = bucket(place);
        let near = (a - 1..=a + 1).flat_map(|a| (b - 1..=b + 1).map(move |b| (a, b)));
        let many = near.filter_map(|beside| crowd.get(&beside)).sum::<usize>() > CROWD;
        if many || !apart(&found, place) {
            unseen.push((own, place));
            continue;
        }
        found.push(place);
        if !seen.contains(&own) {
            seen.push(own);
        }
    }
    for (own, place) in unseen {
        if !seen.contains(&own) {
            seen.push(own);
            found.push(place);
        }
    }
    found
}

/// A cell's column and row.
type Cell = (usize, usize);

/// The lowest and the highest corner of the region of a cell, where it is small, and whether it lies within one
/// other.
fn small<'a, K: PartialEq + 'a, N: Iterator<Item = Cell>>(
    first: Cell,
    (across, up): (usize, usize),
    around: &impl Fn(Cell) -> N,
    at: &impl Fn(Cell) -> &'a K,
) -> Option<(Cell, Cell, bool)> {
    let mut cells = vec![first];
    let (mut low, mut high) = (first, first);
    let mut outside: Option<&K> = None;
    let mut within_one = true;
    let mut next = 0;
    while let Some(&cell) = cells.get(next) {
        next += 1;
        for beside in around(cell) {
            let kind = at(beside);
            if kind != at(first) {
                // Beside two others it is a part of their boundary.
                within_one &= outside.is_none_or(|known| known == kind);
                outside = Some(kind);
            } else if !cells.contains(&beside) {
                low = (low.0.min(beside.0), low.1.min(beside.1));
                high = (high.0.max(beside.0), high.1.max(beside.1));
                if high.0 - low.0 >= across || high.1 - low.1 >= up {
                    return None;
                }
                cells.push(beside);
            }
        }
    }
    Some((low, high, within_one))
}
