//! The cells of a list, divided into parts whose cells run one model each.

use super::body::body_parameters;
use super::listing::{CellAt, Listing};
use super::plan::Plan;
use super::table::Table;
use crate::results::block::Block;
use crate::scene::{Grid, Parameter};
use crate::stepping::outcome::Status;

/// Cells that run the same model.
#[derive(Debug, Clone)]
pub struct Part {
    /// The plan of these cells.
    pub plan: Plan,
    /// The cells' numbers in the grid.
    pub cells: Vec<usize>,
    /// Their places in the list that was divided into parts.
    pub places: Vec<usize>,
    /// The vertical isolation of these cells is rigid for the record, and is locked.
    pub vertical_locked: bool,
}

impl Part {
    /// Some cells of the grid of a plan in parts whose cells run one model each: cells whose base yields and cells
    /// whose base does not, cells of equal exponent n, and cells whose vertical isolation is rigid for the record,
    /// with that direction locked. The cells may be in any order. The model is decided once for each combination of the
    /// values that decide it, not for each cell.
    pub fn of(plan: &Plan, grid: &Grid, cells: &[usize]) -> Vec<Part> {
        let stiffness = [Parameter::TH, Parameter::K1, Parameter::UY, Parameter::YieldForce];
        let mut deciding = vec![Parameter::Psi, Parameter::BoucWenN, Parameter::TV];
        deciding.extend([Parameter::K2, Parameter::Mu]);
        if plan.scene.numbers.has(Parameter::K2) {
            // psi is the quotient of two stiffnesses, and the parameters of both decide it.
            deciding.extend(stiffness);
            deciding.extend(body_parameters());
        }
        if cells.is_empty() {
            return Vec::new();
        }
        let list = Listing::of(grid, cells);
        let table =
            Table::of(&list, &deciding, |case| (plan.locks_vertical(case), plan.laws_of(case)));
        let mut parts: Vec<Part> = Vec::new();
        // The part of each entry of the table.
        let mut of_entries: Vec<usize> = Vec::with_capacity(table.entries.len());
        for &(vertical_locked, laws) in &table.entries {
            let laws = if vertical_locked { laws.without_vertical() } else { laws };
            let known = parts.iter().position(|part| part.plan.laws == laws);
            of_entries.push(known.unwrap_or(parts.len()));
            if known.is_none() {
                let mut plan = if vertical_locked { plan.without_vertical() } else { plan.clone() };
                plan.laws = laws;
                parts.push(Part { plan, cells: Vec::new(), places: Vec::new(), vertical_locked });
            }
        }
        if let [only] = &mut parts[..] {
            (only.cells, only.places) = (cells.to_vec(), (0..cells.len()).collect());
            return parts;
        }
        for (number, &cell) in cells.iter().enumerate() {
            let entry = table.index.of(&CellAt { number, place: grid.place(cell) });
            let part = &mut parts[of_entries[entry]];
            part.cells.push(cell);
            part.places.push(number);
        }
        // The table may have combinations that no cell has. Parts without a locked direction come first.
        parts.retain(|part| !part.cells.is_empty());
        parts.sort_by_key(|part| part.vertical_locked);
        parts
    }

    /// The outcomes of its cells, marked where the vertical direction is locked.
    pub(crate) fn mark_locked(&self, mut block: Block) -> Block {
        if self.vertical_locked {
            block.recode(|_, class, status| match status {
                Status::Ok | Status::Proved => (class, Status::VerticalLocked),
                other => (class, other),
            });
        }
        block
    }

    /// The outcomes of its cells among those of a list of so many cells, of which the others have not run.
    pub(crate) fn scatter_into(&self, count: usize, block: Block) -> Block {
        if block.len() == count {
            // A single part holds every cell, in order.
            return block;
        }
        let mut all = Block::pending(count, block.precision());
        all.scatter(&self.places, &block);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::record::synthetic;
    use crate::scene::{Excitation, Range, SceneBuilder, Values};

    /// Of lists of all cells, of few and of scattered ones, in any order: each cell is in the part of its own model, at its place.
    #[test]
    fn each_cell_is_in_the_part_of_its_model() {
        let pair = synthetic::pair();
        let rigid = 0.2 * pair.dt;
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, Range::even(1.0, 3.0, 40))
            .with(Parameter::TV, Range::even(0.1 * rigid, 4.0 * rigid, 41))
            .with(Parameter::Psi, "0.1,0.5,1".parse::<Values>().unwrap())
            .with(Parameter::BoucWenN, "2,3".parse::<Values>().unwrap())
            .check_under(Excitation::Record(pair))
            .unwrap();
        let (plan, grid) = (Plan::new(&scene, 0.01).unwrap(), Grid::of(&scene));
        let all: Vec<usize> = (0..grid.len()).collect();
        let scattered: Vec<usize> = (0..90).map(|k| (k * 7919 + 13) % grid.len()).rev().collect();
        for (cells, count) in [(all, 8), (scattered, 8), (vec![5, 3], 1), (Vec::new(), 0)] {
            let parts = Part::of(&plan, &grid, &cells);
            assert_eq!(parts.len(), count);
            let mut places: Vec<usize> = Vec::new();
            for part in &parts {
                assert_eq!(part.plan.scene.isolation.moves_v(), !part.vertical_locked);
                for (&cell, &place) in part.cells.iter().zip(&part.places) {
                    let case = grid.case(cell);
                    assert_eq!(
                        (cells[place], part.vertical_locked),
                        (cell, plan.locks_vertical(&case))
                    );
                    assert_eq!(part.plan.laws, part.plan.laws_of(&case));
                }
                places.extend(&part.places);
            }
            places.sort_unstable();
            assert!(places.into_iter().eq(0..cells.len()));
        }
    }
}
