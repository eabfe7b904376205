// The turn: one Runge-Kutta trial, and how the cell uses its result. Twin: src/stepping/turn.rs.
//
// A trial is a step, the rest of a step after a switch, or a step of a root search. Every thread makes
// one in every turn, whatever it is for, so that no thread waits for another's switch: the call of `rk4`
// below is the only one. Every turn computes the rates at the start again.

struct Turn {
    forcing: Forcing,
    // Fraction of the step already done, and fraction that is looked at.
    start: real,
    span: real,
    // The span ends before the step does.
    cut: bool,
    // Switches and kinks in the step so far.
    events: u32,
    search: Search,
}

// A cell at the start of its step.
fn begin_turns(cell: Cell, state: State) -> Turn {
    let zero: real = 0.0;
    let one: real = 1.0;
    var turn: Turn;
    turn.forcing = begin_segment(cell, state.step);
    turn.start = zero;
    turn.span = one;
    turn.cut = false;
    turn.events = 0u;
    turn.search = no_search();
    return turn;
}

// True where a cell is at the start of a step, and nothing is searched for.
fn at_an_edge(turn: Turn) -> bool {
    return turn.start == 0.0 && turn.search.sought == NOTHING_SOUGHT;
}

fn turn(cell: Cell, state: ptr<function, State>, t: ptr<function, Turn>) {
    let zero: real = 0.0;
    let one: real = 1.0;
    let y = (*state).motion;
    let rocking = (*state).mode != FULL_CONTACT;
    let corner = pivot((*state).mode);
    let start = (*t).start;
    let step = step_length(cell, (*t).forcing);
    var search = (*t).search;
    let sought = search.sought;
    let seeking = is_any(sought);
    let again = sought == SOUGHT_AGAIN;
    let begun = !(seeking || again);
    if stops {
        stop = stop_side(cell, y);
    }
    let ground = ground_at(cell, (*t).forcing, start);
    let k1 = rates(cell, corner, rocking, y, ground);

    // The contact force at the start may already lift the block: such a cell only changes its phase.
    var lifts = false;
    var to_left = false;
    if begun && !rocking {
        let left = uplift_moment(model.left, contact_of(k1));
        let right = uplift_moment(model.right, contact_of(k1));
        lifts = left > 0.0 || right > 0.0;
        to_left = left >= right;
    }
    let whole = begun && !lifts;
    if whole {
        let span = begin_span(cell, corner, rocking, y, k1, start, step);
        (*t).span = span.length;
        (*t).cut = span.cut;
    }

    // The trial.
    var length = search.at * (*t).span;
    var h = length * step;
    let ground_mid = ground_at(cell, (*t).forcing, start + 0.5 * length);
    let ground_end = ground_at(cell, (*t).forcing, start + length);
    let stepped = rk4(cell, corner, rocking, y, k1, h, ground_mid, ground_end);
    var y1 = stepped.y;
    var k_end = stepped.k4;
    if !rocking {
        // The contact force of full contact at the end, so that the time of an uplift is as exact as the
        // motion.
        let base = support(cell, y1, ground_end);
        k_end.shear = base.f_h;
        k_end.normal = base.f_v;
    }

    // The distance to the guard that is searched for; without a search, to the impact.
    let whole_h = (*t).span * step;
    let end = sample_of(sought, cell, corner, y, y1, k_end, whole_h);
    let reach = reach_of(search, end, whole_h * whole_h * k1.ddphi);

    // The result of the search.
    var looked = whole;
    var kinked = false;
    var arrived = false;
    var switches = false;
    var overturned = false;
    var back = zero;
    if seeking {
        let found = narrow(&search, end, reach);
        kinked = found.done && is_kink(sought);
        arrived = found.done && sought == SOUGHT_UPLIFT;
        switches = found.done && is_angle(sought);
        overturned = found.done && sought == SOUGHT_OVERTURNING;
        back = found.back * (*t).span;
        // A kink and an uplift cut the step: the next turn goes on from there.
        if kinked || arrived {
            (*t).span = length;
            (*t).cut = true;
        }
        looked = looked || kinked;
    }
    var found = false;
    var landed = false;
    if looked {
        let stopped = kinked && sought == SOUGHT_STOP;
        let crossing = crossing_in(cell, corner, rocking, kinked, stopped, y, stepped, k1, k_end, h);
        // A span that was cut for an impact, and ends just beyond it, ends at the impact.
        if crossing.found == SOUGHT_IMPACT && !kinked {
            let allowed: real = EVENT_TOLERANCE;
            landed = crossing.upper >= 1.0 && reach.steep && allowed >= reach.way.error;
            back = select(back, reach.way.back * length, landed);
            switches = switches || landed;
        }
        found = is_any(crossing.found) && !landed;
        if found {
            begin_search(&search, crossing.found, crossing.cubic, crossing.upper);
        }
    }
    if switches {
        y1 = shift_back(y1, k1, k_end, back * step, h);
        length = length - back;
        h = length * step;
    }

    // Whether the cell moves on to the end of its trial.
    let plain = (looked && !found && !landed) || again;
    if again {
        search.sought = NOTHING_SOUGHT;
    }
    (*t).search = search;
    let moved = plain || switches || arrived;
    var fraction = start;
    if moved {
        update_motion(state, y, y1, h);
        if forces {
            update_contact(state, contact_of(k1), stepped.mid, contact_of(k_end));
        }
        if accelerations {
            update_accelerations(
                state,
                accelerations_of(k1.ddu, k1.ddv, contact_of(k1), ground),
                accelerations_of(stepped.mid_ddu, stepped.mid_ddv, stepped.mid, ground_mid),
                accelerations_of(k_end.ddu, k_end.ddv, contact_of(k_end), ground_end),
            );
        }
        if stop_values {
            let meets = abs(stop) <= 0.0 && abs(stop_side(cell, y1)) > 0.0;
            update_stop(state, stop_end(cell, y, k1), stop_end(cell, y1, k_end), h, meets);
        }
        (*state).motion = y1;
        fraction = start + length;
    }
    if lifts {
        (*t).events += 1u;
        lift(state, to_left, fraction);
    }
    if overturned {
        overturn(state, fraction);
    } else if switches {
        let apart = stop_values && abs(stop_side(cell, (*state).motion)) <= 0.0;
        land(cell, state, (*t).forcing, fraction);
        // An impact changes u', and with it the force of the stop's damper: the push may begin there.
        if apart && abs(stop_side(cell, (*state).motion)) > 0.0 {
            (*state).extremes.stop_hits += 1.0;
        }
    }
    let through = ((plain && !(*t).cut) || (moved && fraction >= 1.0)) && !overturned;
    if moved && !through {
        (*t).events += 1u;
    }
    let endless = (*t).events >= EVENT_BOUND;
    (*t).start = select(fraction, zero, through);
    var due = switches;
    var lost = false;
    if through {
        (*t).events = 0u;
        (*t).forcing.done += 1.0;
        lost = !is_finite((*state).motion);
        (*state).step += 1u;
        // The twin counts; a free segment begins where the forced steps end, or whole tries later.
        let steps_since_check = ((*state).step - cell.steps.steps_forced) % STEPS_A_TRY;
        due = due || (steps_since_check == 0u && (*state).mode == FULL_CONTACT);
    }
    if (*state).status != RUNNING {
        return;
    }
    if endless {
        (*state).status = EVENT_LIMIT;
    } else if lost {
        (*state).status = DIVERGED;
    } else if (*state).step >= cell.steps.steps {
        (*state).status = FINISHED;
    } else {
        if certificate && due && !(*t).forcing.forced {
            if is_final(cell, *state) {
                (*state).end_fraction = (*t).start;
                (*state).status = PROVED;
            } else if switches && (*state).mode != FULL_CONTACT && rests_early(cell, *state) {
                (*state).motion = come_to_rest(pivot((*state).mode), (*state).motion);
                (*state).mode = FULL_CONTACT;
            }
        }
        if (*state).status == RUNNING && through && (*t).forcing.done >= (*t).forcing.steps {
            (*t).forcing = begin_segment(cell, (*state).step);
        }
    }
}
