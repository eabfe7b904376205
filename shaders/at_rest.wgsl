// The state of a cell at rest. Twin: src/cells/at_rest.rs.

// The corner about which a block of this tilt turns.
fn mode_of(tilt: real) -> u32 {
    if tilt > 0.0 {
        return ROCKING_LEFT;
    }
    if tilt < 0.0 {
        return ROCKING_RIGHT;
    }
    return FULL_CONTACT;
}

// A state at rest, with the base in static equilibrium.
fn at_rest(finite: bool, tilt: real) -> State {
    var state = State();
    state.motion.phi = tilt;
    state.extremes.min_contact = model.gravity;
    state.mode = mode_of(tilt);
    if !finite {
        state.status = DIVERGED;
    }
    return state;
}
