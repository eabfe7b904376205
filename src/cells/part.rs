//! The cells of a list, divided into parts whose cells run one model each.

use super::body::body_parameters;
use super::cell_list::CellList;
use super::listing::{CellAt, Listing};
use super::plan::Plan;
use super::table::Table;
use crate::scene::{Grid, Parameter};

/// Cells that run the same model.
#[derive(Debug, Clone)]
pub struct Part {
    /// The plan of these cells.
    pub plan: Plan,
    /// Its cells, where they are not all of the list.
    some: Option<SomeCells>,
    /// The vertical isolation of these cells is rigid for the record, and is locked.
    pub vertical_locked: bool,
}

/// Some of the cells of a list.
#[derive(Debug, Clone, Default)]
struct SomeCells {
    /// The cells' numbers in the grid.
    cells: Vec<usize>,
    /// Their places in the list.
    places: Vec<usize>,
}

impl Part {
    /// Some cells of the grid of a plan in parts whose cells run one model each: cells whose base yields and cells
    /// whose base does not, cells of equal exponent n, and cells whose vertical isolation is rigid for the record,
    /// with that direction locked. The cells may be in any order. The model is decided once for each combination of the
    /// values that decide it, not for each cell.
    pub fn of(plan: &Plan, grid: &Grid, cells: CellList) -> Vec<Part> {
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
                parts.push(Part { plan, some: None, vertical_locked });
            }
        }
        if parts.len() == 1 {
            return parts;
        }
        for (number, cell) in cells.iter().enumerate() {
            let entry = table.index.of(&CellAt { number, place: grid.place(cell) });
            let some = parts[of_entries[entry]].some.get_or_insert_default();
            some.cells.push(cell);
            some.places.push(number);
        }
        // The table may have combinations that no cell has. Parts without a locked direction come first.
        parts.retain(|part| part.some.is_some());
        parts.sort_by_key(|part| part.vertical_locked);
        parts
    }

    /// Its cells, of the list that was divided into parts.
    pub fn cells<'a>(&'a self, list: CellList<'a>) -> CellList<'a> {
        self.some.as_ref().map_or(list, |some| CellList::from(&some.cells))
    }

    /// The places of its cells in that list; none where it has all of them, in order.
    pub fn places(&self) -> Option<&[usize]> {
        self.some.as_ref().map(|some| &some.places[..])
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
            let list = CellList::from(&cells);
            let parts = Part::of(&plan, &grid, list);
            assert_eq!(parts.len(), count);
            let mut places: Vec<usize> = Vec::new();
            for part in &parts {
                assert_eq!(part.plan.scene.isolation.moves_v(), !part.vertical_locked);
                let of_part: Vec<usize> = match part.places() {
                    Some(some) => some.to_vec(),
                    None => (0..cells.len()).collect(),
                };
                for (cell, &place) in part.cells(list).iter().zip(&of_part) {
                    let case = grid.case(cell);
                    assert_eq!(
                        (cells[place], part.vertical_locked),
                        (cell, plan.locks_vertical(&case))
                    );
                    assert_eq!(part.plan.laws, part.plan.laws_of(&case));
                }
                places.extend(of_part);
            }
            places.sort_unstable();
            assert!(places.into_iter().eq(0..cells.len()));
        }
    }
}
