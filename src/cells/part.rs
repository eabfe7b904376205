//! The cells of a list, divided into parts whose cells run one model each.

use super::body::body_parameters;
use super::plan::Plan;
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
    /// with that direction locked. The cells may be in any order.
    pub fn of(plan: &Plan, grid: &Grid, cells: &[usize]) -> Vec<Part> {
        let stiffness = [Parameter::TH, Parameter::K1, Parameter::UY, Parameter::YieldForce];
        let mut deciding = vec![Parameter::Psi, Parameter::BoucWenN, Parameter::TV];
        deciding.extend([Parameter::K2, Parameter::Mu]);
        if plan.scene.numbers.has(Parameter::K2) {
            // psi is the quotient of two stiffnesses, and the parameters of both decide it.
            deciding.extend(stiffness);
            deciding.extend(body_parameters());
        }
        let Some(first) = cells.first() else { return Vec::new() };
        if !grid.sweeps(&deciding) && !plan.locks_vertical(&grid.case(*first)) {
            return vec![Part {
                plan: plan.clone(),
                cells: cells.to_vec(),
                places: (0..cells.len()).collect(),
                vertical_locked: false,
            }];
        }
        let mut parts: Vec<Part> = Vec::new();
        for (place, &cell) in cells.iter().enumerate() {
            let case = grid.case(cell);
            let vertical_locked = plan.locks_vertical(&case);
            let mut laws = plan.laws_of(&case);
            if vertical_locked {
                laws = laws.without_vertical();
            }
            if let Some(part) = parts.iter_mut().find(|part| part.plan.laws == laws) {
                part.cells.push(cell);
                part.places.push(place);
                continue;
            }
            let mut own = if vertical_locked { plan.without_vertical() } else { plan.clone() };
            own.laws = laws;
            parts.push(Part { plan: own, cells: vec![cell], places: vec![place], vertical_locked });
        }
        // Parts without a locked direction come first.
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
