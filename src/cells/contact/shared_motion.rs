//! The motions in full contact that cells share: the data with which they begin. See
//! [`full_contact`](super::full_contact).

use crate::cells::plan::Plan;
use crate::model::block::Model;
use crate::model::excitation::{Cell, Ground};
use crate::model::isolation::Variant;
use crate::model::real::Real;
use crate::scene::Case;
use crate::stepping::spans::Direction;
use crate::stepping::state::State;

/// The share of its largest value by which an acceleration may exceed its values at the ends of steps: at 64 steps
/// per period it is at most 1.2e-3.
pub(crate) const SLACK: f64 = 2.0e-3;
/// The data with which the integration of a motion begins.
#[derive(Clone, Copy)]
pub struct Start<R> {
    /// A body whose uplift moments (14) are zero, because it has no lever arm.
    pub model: Model<R>,
    /// The numbers of a cell that shares the motion.
    pub cell: Cell<R>,
    /// The state at rest.
    pub state: State<R>,
    /// Steps after the excitation.
    pub after: u32,
}

impl<R: Real> Start<R> {
    /// The start of the motion of a case in one direction, in the steps of a plan, with at most so many steps after
    /// the excitation.
    pub fn of(plan: &Plan, case: &Case, direction: Direction, after: u32) -> Start<R> {
        let mut model = plan.model::<R>(case);
        (model.height, model.left.arm, model.right.arm) = (R::of(0.0), R::of(0.0), R::of(0.0));
        let (mut cell, state) = plan.cell::<R>(case);
        if direction == Direction::Horizontal {
            // X by itself: divided by g it is the friction demand where the ground does not move vertically.
            cell.drive.amplitude_v = R::of(0.0);
        }
        let after = after.min(cell.steps.steps - cell.steps.steps_forced);
        Start { model, cell, state, after }
    }

    /// Steps of the motion.
    pub fn steps(&self) -> u32 {
        self.cell.steps.steps_forced + self.after
    }

    /// The number of its samples, which end its gaps.
    pub fn samples(&self) -> usize {
        (self.steps() / self.cell.steps.substeps) as usize + 1
    }
}

/// Motions of one direction, under one record, that are integrated together.
#[derive(Clone, Copy)]
pub struct MotionSet<'a, R> {
    /// The variant that has this direction alone.
    pub variant: Variant,
    /// The direction.
    pub direction: Direction,
    /// The record.
    pub record: &'a [Ground<R>],
    /// The starts of the motions.
    pub starts: &'a [Start<R>],
}
