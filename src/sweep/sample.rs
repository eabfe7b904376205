//! The cells of a sweep that the reference runs again: half of them beside a boundary between outcomes.

use std::io;

use crate::results::columns::Column;
use crate::results::outcomes::{BLOCK, Outcomes};
use crate::scene::Grid;
use crate::stepping::outcome::Outcome;

/// A cell to be run again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chosen {
    /// Its number.
    pub cell: usize,
    /// True where a neighbour has another outcome.
    pub beside_boundary: bool,
    /// The sweep's outcome.
    pub outcome: Outcome,
}

/// Goes through all cells and says of each whether a neighbour has another outcome. Only a few rows are in memory at a time.
pub(crate) fn beside_boundary<E: From<io::Error>>(
    grid: &Grid,
    outcomes: &dyn Outcomes,
    mut tell: impl FnMut(usize, bool) -> Result<(), E>,
) -> Result<(), E> {
    let (columns, rows) = grid.shape();
    let height = (BLOCK / columns).max(1);
    for first in (0..rows).step_by(height) {
        let last = (first + height).min(rows);
        let (below, above) = (first.saturating_sub(1), (last + 1).min(rows));
        let read = outcomes.read(below * columns..above * columns, &[Column::Outcome])?;
        for j in first..last {
            for i in 0..columns {
                let cell = j * columns + i;
                let class = |cell: usize| read[cell - below * columns].class;
                tell(cell, grid.neighbours(cell).any(|other| class(other) != class(cell)))?;
            }
        }
    }
    Ok(())
}

/// The places of `count` elements that are spread evenly over a list.
fn spread(length: usize, count: usize) -> impl Iterator<Item = usize> {
    let count = count.min(length);
    (0..count).map(move |k| (2 * k + 1) * length / (2 * count))
}

/// The cells to run again: half of them lie beside a boundary and half do not; where there are too few of one kind, more of the
/// other kind are taken. Any part of the list is spread over the whole map, so that the first cells of the list represent all.
///
/// # Errors
/// Those of reading the outcomes.
pub fn sample(grid: &Grid, outcomes: &dyn Outcomes, size: usize) -> io::Result<Vec<Chosen>> {
    let mut beside = 0;
    beside_boundary(grid, outcomes, |_, is_beside| {
        beside += usize::from(is_beside);
        Ok::<(), io::Error>(())
    })?;
    let elsewhere = grid.len() - beside;
    let from_beside = (size / 2).max(size.saturating_sub(elsewhere)).min(beside);
    let mut places = [
        spread(elsewhere, size.saturating_sub(from_beside)).peekable(),
        spread(beside, from_beside).peekable(),
    ];
    let (mut chosen, mut seen) = (Vec::new(), [0; 2]);
    beside_boundary(grid, outcomes, |cell, beside_boundary| {
        let kind = usize::from(beside_boundary);
        if places[kind].next_if_eq(&seen[kind]).is_some() {
            chosen.push((cell, beside_boundary));
        }
        seen[kind] += 1;
        Ok::<(), io::Error>(())
    })?;
    let read = |(cell, beside_boundary)| {
        let outcome = outcomes.read(cell..cell + 1, &Column::ALL)?[0];
        Ok(Chosen { cell, beside_boundary, outcome })
    };
    let read: io::Result<Vec<Chosen>> = chosen.into_iter().map(read).collect();
    let mut numbered: Vec<(usize, Chosen)> = read?.into_iter().enumerate().collect();
    numbered.sort_by_key(|(number, _)| number.reverse_bits());
    Ok(numbered.into_iter().map(|(_, chosen)| chosen).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Parameter, Range, SceneBuilder};
    use crate::stepping::outcome::Class;

    /// Of a map whose lower half overturns: half of the sample beside the boundary, and any quarter of it from
    /// all quarters of the map's width.
    #[test]
    fn a_beginning_of_the_sample_stands_for_all() {
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, 1.75)
            .with(Parameter::TV, 0.75)
            .with(Parameter::Omega, Range::even(1.0, 8.0, 64))
            .with(Parameter::AH, Range::even(1.0, 8.0, 64))
            .check()
            .unwrap();
        let grid = Grid::of(&scene);
        let class = |cell| if cell < 32 * 64 { Class::OverturnedLeft } else { Class::Rocking };
        let outcomes: Vec<Outcome> = (0..grid.len())
            .map(|cell| Outcome { class: class(cell), ..Outcome::PENDING })
            .collect();
        let chosen = sample(&grid, &outcomes, 64).unwrap();
        assert_eq!(chosen.len(), 64);
        for one in &chosen {
            assert_eq!(one.beside_boundary, [31, 32].contains(&(one.cell / 64)), "{one:?}");
            assert_eq!(one.outcome.class, class(one.cell));
        }
        assert_eq!(chosen.iter().filter(|one| one.beside_boundary).count(), 32);
        for quarter in chosen.chunks(16) {
            let beside = quarter.iter().filter(|one| one.beside_boundary).count();
            assert!((6..=10).contains(&beside), "{beside} of 16 beside the boundary");
            for k in 0..4 {
                let inside = quarter.iter().filter(|one| one.cell / 16 / 64 == k).count();
                assert!(inside >= 1, "none of rows {} on", 16 * k);
            }
        }
    }
}
