//! The order in which the CPU begins the cells of a list.
//!
//! A cell begins with a search along its two motions in full contact. Cells with the same motions follow one another,
//! so that these motions stay in the fastest caches: in a map whose first axis changes the motions, each cell of a
//! row would otherwise read other motions from memory. Under a record cells with short steps take longest. They begin
//! first, so that the last cells do not keep few lanes busy for long.

use crate::cells::cell_list::CellList;
use crate::cells::listing::{CellAt, Index};
use crate::scene::Grid;
use crate::work::parallel;

/// The number of motions of u that stay in the cache of a core while the motions of v are read.
const STRIP: usize = 8;

/// The places of the cells of a list in the order in which they begin: by the powers of 2 in their numbers of steps in a
/// gap, by strips of motions of u, and in each strip by motions of v. `motions` tells where cells find their motions, if they
/// share any.
pub fn begin_order(
    motions: Option<&[Index; 2]>,
    (grid, cells): (&Grid, CellList),
    substeps: impl Fn(&CellAt) -> u32 + Sync,
) -> Vec<u32> {
    let keys: Vec<[u32; 3]> = parallel::each(cells.len(), parallel::LOOKUPS, |number| {
        let cell = CellAt { number, place: grid.place(cells.at(number)) };
        let of = motions.map(|of| of.each_ref().map(|motions| motions.of(&cell)));
        let [across, up] = of.unwrap_or_default();
        // The memory limit keeps the motions below 2^32.
        [substeps(&cell).leading_zeros(), (across / STRIP) as u32, up as u32]
    });
    // A list has fewer than 2^32 cells: it is a batch of a sweep, or the cells that a refined map requests.
    let order = (0..cells.len() as u32).collect();
    [2, 1, 0]
        .into_iter()
        .fold(order, |order, digit| sorted(order, |place| keys[place as usize][digit]))
}

/// Sorts by counting; the order of equal keys is kept.
fn sorted(order: Vec<u32>, key: impl Fn(u32) -> u32) -> Vec<u32> {
    let most = order.iter().map(|place| key(*place)).max().unwrap_or(0);
    let mut starts = vec![0; most as usize + 2];
    for place in &order {
        starts[key(*place) as usize + 1] += 1;
    }
    let mut sum = 0;
    for start in &mut starts {
        sum += *start;
        *start = sum;
    }
    let mut sorted = vec![0; order.len()];
    for place in order {
        let to = &mut starts[key(place) as usize];
        sorted[*to] = place;
        *to += 1;
    }
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::clock::DEFAULT_STEP;
    use crate::cells::plan::Plan;
    use crate::cells::ready::Cells;
    use crate::scene::{Parameter, Range, SceneBuilder};
    use crate::work::observer::Unwatched;

    /// Cells with the same motions are neighbours, and each cell occurs once, also in a list that omits some cells.
    #[test]
    fn cells_of_the_same_motions_come_together() {
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, 1.75)
            .with(Parameter::TV, 0.75)
            .with(Parameter::AV, 2.0)
            .with(Parameter::Omega, Range::even(2.0, 6.0, 23))
            .with(Parameter::AH, Range::even(1.0, 9.0, 17))
            .check()
            .unwrap();
        let plan = Plan::new(&scene, DEFAULT_STEP).unwrap();
        let grid = Grid::of(&scene);
        let cells: Vec<usize> = (0..grid.len()).filter(|cell| cell % 5 != 3).collect();
        let motions = Cells::<f32>::of(&plan, &grid, &cells, &[], &Unwatched).of_motions.unwrap();
        let order = begin_order(Some(&motions), (&grid, (&cells).into()), |_| 1);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..cells.len() as u32).collect::<Vec<u32>>());
        let columns: Vec<usize> =
            order.iter().map(|place| grid.place(cells[*place as usize])[0]).collect();
        assert!(columns.is_sorted(), "{columns:?}");
        // The rows of a column keep their order.
        let pairs = order.windows(2).zip(columns.windows(2));
        for (places, columns) in pairs.filter(|(_, columns)| columns[0] == columns[1]) {
            assert!(places[0] < places[1], "column {}", columns[0]);
        }
    }

    /// The cells with the most steps in a gap begin first, also where no motions are shared.
    #[test]
    fn short_steps_come_first() {
        let range = |from, to| Range::even(from, to, 5);
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, range(1.0, 3.0))
            .with(Parameter::TV, range(0.2, 1.0))
            .with(Parameter::Omega, 5.0)
            .with(Parameter::AH, 5.0)
            .check()
            .unwrap();
        let grid = Grid::of(&scene);
        let cells: Vec<usize> = (0..grid.len()).collect();
        let substeps = |cell: &CellAt| 1 + cell.number as u32 % 7;
        let order = begin_order(None, (&grid, (&cells).into()), substeps);
        let powers: Vec<u32> = order.iter().map(|place| (1 + place % 7).ilog2()).collect();
        assert!(powers.is_sorted_by(|one, next| one >= next), "{powers:?}");
        assert_eq!(powers.len(), cells.len());
    }
}
