// The change of the phase at a switch: uplift, impact, rest, overturning. Twin: src/stepping/switching.rs.

// The block lifts about the left or the right corner.
fn lift(state: ptr<function, State>, left: bool, fraction: real) {
    if (*state).uplifts == 0u {
        (*state).uplift_step = (*state).step;
        (*state).uplift_fraction = fraction;
    }
    (*state).uplifts += 1u;
    (*state).mode = select(ROCKING_RIGHT, ROCKING_LEFT, left);
    switched(state, select(UPLIFT_RIGHT, UPLIFT_LEFT, left), fraction);
}

// The block lands and turns about its other corner. A block that is too slow to lift again comes to rest on both
// corners, unless the contact force lifts it there. Where the law of impact gives no rebound (eta_phi <= 0) it always
// comes to rest.
fn land(cell: Cell, state: ptr<function, State>, forcing: Forcing, fraction: real) {
    let y = (*state).motion;
    let leaving = pivot((*state).mode);
    let other = select(ROCKING_RIGHT, ROCKING_LEFT, (*state).mode == ROCKING_RIGHT);
    let landing = pivot(other);
    (*state).impacts += 1u;
    let rebound = abs(landing.eta_phi * y.dphi);
    let rebounds = rebound >= cell.steps.rest_speed && landing.eta_phi > 0.0;
    var rests = false;
    if !rebounds {
        let resting = come_to_rest(leaving, y);
        if stops {
            stop = stop_side(cell, resting);
        }
        let base = support(cell, resting, ground_at(cell, forcing, fraction));
        let lifts = largest_uplift_moment(Contact(base.f_h, base.f_v)) > 0.0;
        rests = !(lifts && landing.eta_phi > 0.0);
    }
    if rests {
        (*state).motion = come_to_rest(leaving, y);
        (*state).mode = FULL_CONTACT;
    } else {
        (*state).motion = change_corner(landing, y);
        (*state).mode = other;
    }
    switched(state, IMPACT, fraction);
}

// The block overturns about the corner that it turns about.
fn overturn(state: ptr<function, State>, fraction: real) {
    (*state).end_fraction = fraction;
    (*state).status = select(OVERTURNED_RIGHT, OVERTURNED_LEFT, (*state).mode == ROCKING_LEFT);
    switched(state, OVERTURN, fraction);
}
