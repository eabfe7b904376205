//! The method that a chart shows the worth of the other by: steps of RK4 whose switches are moved to the
//! step's end, kinks stepped across.

use bytemuck::Zeroable;

use topple::cells::plan::Plan;
use topple::model::CellEquations;
use topple::model::asked::Asked;
use topple::model::block::{FULL_CONTACT, ROCKING_LEFT, ROCKING_RIGHT, pivot};
use topple::model::dynamics::{largest_uplift_moment, rates, uplift_moment};
use topple::model::excitation::Ground;
use topple::model::impact::{change_corner, come_to_rest};
use topple::scene::{Case, Grid};
use topple::stepping::forcing::ground_at;
use topple::stepping::guards::{IMPACT, NOTHING, OVERTURN, UPLIFT_LEFT, UPLIFT_RIGHT};
use topple::stepping::log::{Event, FirstSwitches, Log};
use topple::stepping::outcome::Outcome;
use topple::stepping::rk4::rk4;
use topple::stepping::state::{
    DIVERGED, FINISHED, OVERTURNED_LEFT, OVERTURNED_RIGHT, RUNNING, State, is_finite,
};
use topple::work::parallel;

/// Runs cells of a grid on all cores, each with its first `events_kept` switches.
pub fn sweep(
    plan: &Plan,
    grid: &Grid,
    cells: &[usize],
    events_kept: usize,
) -> (Vec<Outcome>, Vec<Event<f64>>) {
    let run = |number: usize| run(plan, &grid.case(cells[number]), events_kept);
    let ran: Vec<(Outcome, FirstSwitches<f64>)> = parallel::each(cells.len(), parallel::SHORT, run);
    let (outcomes, events): (Vec<Outcome>, Vec<FirstSwitches<f64>>) = ran.into_iter().unzip();
    (outcomes, events.into_iter().flat_map(|kept| kept.0).collect())
}

fn run(plan: &Plan, case: &Case, events_kept: usize) -> (Outcome, FirstSwitches<f64>) {
    let model = plan.model::<f64>(case);
    let record = plan.record::<f64>();
    let (cell, mut state) = plan.cell::<f64>(case);
    let set = CellEquations::of(plan.variant(), &model, &cell, &record);
    let mut log = FirstSwitches(vec![Event::zeroed(); events_kept]);
    while state.status == RUNNING {
        let kind = step(&set, &mut state);
        log.switched(kind, 1.0, &state);
        state.step += 1;
        if state.step >= cell.steps.steps && state.status == RUNNING {
            state.status = FINISHED;
        }
    }
    (plan.outcome(case, &state), log)
}

/// One whole step, and the switch that its end asks for.
fn step(set: &CellEquations<f64>, state: &mut State<f64>) -> u32 {
    let rocking = state.mode != FULL_CONTACT;
    let corner = pivot(set.model, state.mode);
    let forced = state.step < set.cell.steps.steps_forced;
    let h = if forced { set.cell.steps.step_forced } else { set.cell.steps.step_free };
    let index = state.step;
    let ground = |fraction| ground_at(set, index, fraction);
    let y = state.motion;
    let k1 = rates(set, &corner, rocking, &y, ground(0.0));
    let stepped = rk4(set, &corner, rocking, &y, &k1, h, [ground(0.5), ground(1.0)]);
    let k_end = rates(set, &corner, rocking, &stepped.y, ground(1.0));
    let extremes = &mut state.extremes;
    extremes.update_motion(Asked::ALL, true, (true, corner.side), &y, &stepped.y, h);
    extremes.update_contact(true, k1.contact(), stepped.mid, k_end.contact());
    state.motion = stepped.y;
    if !is_finite(&stepped.y) {
        state.status = DIVERGED;
        return NOTHING;
    }
    if rocking {
        return land_or_overturn(set, state, ground(1.0));
    }
    let moment = |corner| uplift_moment(set, corner, k_end.contact());
    let (left, right) = (moment(&set.model.left), moment(&set.model.right));
    if left.max(right) <= 0.0 {
        return NOTHING;
    }
    if state.uplifts == 0 {
        (state.uplift_step, state.uplift_fraction) = (state.step, 1.0);
    }
    state.uplifts += 1;
    state.mode = if left >= right { ROCKING_LEFT } else { ROCKING_RIGHT };
    if left >= right { UPLIFT_LEFT } else { UPLIFT_RIGHT }
}

/// The switch that a rocking block's angle asks for at the end of a step.
fn land_or_overturn(set: &CellEquations<f64>, state: &mut State<f64>, ground: Ground<f64>) -> u32 {
    let leaving = pivot(set.model, state.mode);
    let phi = leaving.side * state.motion.phi;
    if phi >= leaving.overturn {
        let left = state.mode == ROCKING_LEFT;
        state.status = if left { OVERTURNED_LEFT } else { OVERTURNED_RIGHT };
        state.end_fraction = 1.0;
        return OVERTURN;
    }
    if phi >= 0.0 {
        return NOTHING;
    }
    state.impacts += 1;
    let other = if state.mode == ROCKING_RIGHT { ROCKING_LEFT } else { ROCKING_RIGHT };
    let landing = pivot(set.model, other);
    let resting = come_to_rest(set, &leaving, &state.motion);
    let rebound = (landing.eta_phi * state.motion.dphi).abs();
    let k = rates(set, &leaving, false, &resting, ground);
    let lifts = largest_uplift_moment(set, k.contact()) > 0.0;
    if landing.eta_phi <= 0.0 || (rebound < set.cell.steps.rest_speed && !lifts) {
        (state.motion, state.mode) = (resting, FULL_CONTACT);
    } else {
        (state.motion, state.mode) = (change_corner(&landing, &state.motion), other);
    }
    IMPACT
}
