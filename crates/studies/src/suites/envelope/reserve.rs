//! How far cells lie from those that do not keep all limits.

use std::collections::VecDeque;

use topple::scene::Grid;
use topple::scene::grid::{AXES, Place};

/// Of each cell the steps to the nearest one that is not feasible: the largest of the steps along the axes, so that a base
/// with a reserve of n keeps all limits where every axis is n - 1 steps off at once. What lies beyond the grid is not known and does
/// not count. None of every cell where all are feasible.
pub fn of(grid: &Grid, feasible: &[bool]) -> Vec<Option<u32>> {
    let mut steps: Vec<Option<u32>> = feasible.iter().map(|kept| (!kept).then_some(0)).collect();
    let mut next: VecDeque<usize> = (0..steps.len()).filter(|cell| !feasible[*cell]).collect();
    let counts: Vec<usize> = grid.axes().iter().map(|axis| axis.count()).collect();
    // Cells are reached in the order of their distance, each from all that touch it, at a corner, too.
    while let Some(cell) = next.pop_front() {
        let reached = steps[cell].map(|steps| steps + 1);
        for beside in around(&grid.place(cell), &counts) {
            let beside = grid.cell(&beside);
            if steps[beside].is_none() {
                steps[beside] = reached;
                next.push_back(beside);
            }
        }
    }
    steps
}

/// The places that are no more than a step away along every axis.
fn around(place: &Place, counts: &[usize]) -> Vec<Place> {
    let mut all = vec![[0; AXES]];
    for (axis, count) in counts.iter().enumerate() {
        let at = place[axis];
        let along = at.saturating_sub(1)..=(at + 1).min(count - 1);
        all = all
            .iter()
            .flat_map(|beside| {
                along.clone().map(move |at| {
                    let mut moved = *beside;
                    moved[axis] = at;
                    moved
                })
            })
            .collect();
    }
    all
}
