//! Where methods fail: one test a way, each showing where it holds, where it breaks, and that the
//! sweep does the right thing there. What each measures it prints; docs/stability.md has the table.

mod bouc_wen;
mod boundaries;
mod events;
mod non_finite;
mod numbers;
mod restitution;
mod stiffness;

use topple::backend::cpu;
use topple::cells::clock::{DEFAULT_STEP, Resolution};
use topple::cells::plan::Plan;
use topple::model::CellEquations;
use topple::model::excitation::Cell;
use topple::model::real::Real;
use topple::scene::{Grid, Scene};
use topple::stepping::log::Log;
use topple::stepping::outcome::Outcome;
use topple::stepping::reference::{self, Settings};
use topple::stepping::single;
use topple::stepping::state::State;
use topple::work::observer::Unwatched;

/// The first cell of a scene with steps as they are requested, all of it simulated.
fn exactly<R: Real>(scene: &Scene, step: f64) -> Outcome {
    let plan = Plan::resolved(scene, Resolution::exactly(step)).unwrap().full_model();
    cpu::sweep(R::PRECISION, &plan, &Grid::of(scene), &[0], &Unwatched)[0]
}

/// The first cell of a scene as a sweep runs it.
fn swept<R: Real>(scene: &Scene) -> Outcome {
    all_swept::<R>(scene)[0]
}

/// Every cell of a scene as a sweep runs it.
fn all_swept<R: Real>(scene: &Scene) -> Vec<Outcome> {
    let plan = Plan::new(scene, DEFAULT_STEP).unwrap();
    let grid = Grid::of(scene);
    cpu::sweep(R::PRECISION, &plan, &grid, &crate::common::all(&grid), &Unwatched)
}

/// The reference's settings at a tolerance far tighter than its default.
fn tight() -> Settings {
    Settings { tolerance: 1.0e-12, ..Settings::default() }
}

/// The first cell of a scene by the reference so set.
fn truth(scene: &Scene) -> Outcome {
    reference::run(scene, &Grid::of(scene).case(0), &tight())
}

/// A scene of one block on the ground: a slender rectangle, its mass in the middle.
fn on_the_ground(rest: &str) -> Scene {
    crate::common::scene(&format!(
        "[block]\nhalf_width = 0.2\nheight = 1.0\n[base]\nisolation = \"none\"\n{rest}"
    ))
}

/// The first cell of a scene, altered before it runs.
fn altered<R: Real>(
    plan: &Plan,
    log: &mut impl Log<R>,
    alter: impl FnOnce(&mut Cell<R>, &mut State<R>),
) -> Outcome {
    let point = Grid::of(&plan.scene).case(0);
    let model = plan.model::<R>(&plan.scene.case());
    let record = plan.record::<R>();
    let (mut cell, mut state) = plan.cell::<R>(&point);
    alter(&mut cell, &mut state);
    let set = CellEquations::of(plan.variant(), &model, &cell, &record);
    let state = single::run(&set, &state, log);
    plan.outcome(&point, &state)
}

/// The value between a low end that is `true` of `holds` and a high one that is not, to a relative
/// width of `width`.
fn limit(mut low: f64, mut high: f64, width: f64, holds: impl Fn(f64) -> bool) -> f64 {
    assert!(holds(low), "does not hold at {low}");
    assert!(!holds(high), "still holds at {high}");
    while (high - low) > width * low.abs() {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
