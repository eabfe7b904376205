//! A cell by the reference.

use crate::cells::plan::Plan;
use crate::scene::Case;
use crate::stepping::outcome::Outcome;
use crate::stepping::reference::{self, Settings};

/// The outcome of a cell by the reference, with the directions locked that a sweep locks; none if `go_on` ends the
/// computation.
pub fn by_reference(
    plan: &Plan,
    case: &Case,
    settings: &Settings,
    go_on: &dyn Fn() -> bool,
) -> Option<Outcome> {
    reference::run_while(&plan.scene, &plan.as_run(case), settings, go_on)
}
