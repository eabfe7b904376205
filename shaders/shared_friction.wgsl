// The friction demand of full contact, from the motions that cells share. Twin: src/cells/contact/shared_friction.rs.

// The friction demand at the samples before a given one, if it is known at some. The motion of a block grows until
// the block lifts, so the search goes backwards from the last sample, until the largest |X| so far over the least Y
// so far is not larger any more.
fn at_samples(h: u32, v: u32, last_v: u32, size: real, sample: u32, known: real) -> real {
    let x = h + ACCELERATION * tile.across.more;
    let y = v + ACCELERATION * tile.up.more;
    let magnitude_so_far = h + MAGNITUDE_SO_FAR * tile.across.more;
    let least_so_far = v + LEAST_SO_FAR * tile.up.more;
    var friction = known;
    for (var before = sample; before > 0u; before--) {
        let limit = size * motions[magnitude_so_far + before - 1u];
        if friction * motions[least_so_far + min(before, last_v)] >= limit {
            break;
        }
        let gap = before - 1u;
        let share = share(abs(motions[x + gap]), motions[y + gap_of_v(gap, last_v)]);
        friction = max(friction, size * share);
    }
    return friction;
}

// The share of the friction demand by which a gap must exceed it to be searched.
const OVER = 2.0e-4;

// The friction demand up to a sample, crests between samples included. Where the largest |X| of a gap over its least
// Y exceeds the largest demand so far, the demand is searched for within the gap, backwards as at the samples.
fn crests(pair: MotionPair, cell: Cell, sample: u32, friction_before: real) -> real {
    let over: real = 1.0 + OVER;
    let size = abs(cell.drive.scale);
    let all_h = tile.across.more;
    let all_v = tile.up.more;
    var friction = friction_before;
    for (var before = sample; before > 0u; before--) {
        let gap = before - 1u;
        let at = pair.h + gap;
        let magnitude = motions[at + MAGNITUDE * all_h];
        let least_y = motions[pair.v + gap_of_v(gap, pair.last_v) + LEAST * all_v];
        let least_so_far = motions[pair.v + min(before, pair.last_v) + LEAST_SO_FAR * all_v];
        if over * friction * least_so_far >= size * motions[at + MAGNITUDE_SO_FAR * all_h] {
            break;
        }
        if size * magnitude > over * friction * least_y {
            friction = within_gap(pair, cell, gap, friction);
        }
    }
    return friction;
}

// A sample of the record, where there is one.
fn record_at(sample: u32) -> Ground {
    let first = select(0u, 2u * sample, recorded);
    return Ground(numbers[first], numbers[first + 1u]);
}

// The friction demand so far and within a gap, of which a cell takes the steps from the shared motions at its start.
// They are not cut at the kinks of the Bouc-Wen law, across which z and u' are smooth enough for a gap.
fn within_gap(pair: MotionPair, cell: Cell, gap: u32, friction: real) -> real {
    let zero: real = 0.0;
    let half: real = 0.5;
    let one: real = 1.0;
    let corner = pivot(FULL_CONTACT);
    var state: State;
    move_to(pair, cell.drive.scale, gap, &state);
    state.extremes.friction = friction;
    var forcing = segment(cell, gap * cell.steps.substeps, record_at(gap), record_at(gap + 1u));
    for (var step = 0u; step < cell.steps.substeps; step++) {
        let ground_mid = ground_at(cell, forcing, half);
        let ground_end = ground_at(cell, forcing, one);
        let k1 = rates(cell, corner, false, state.motion, ground_at(cell, forcing, zero));
        let h = step_length(cell, forcing);
        let stepped = rk4(cell, corner, false, state.motion, k1, h, ground_mid, ground_end);
        let base = support(cell, stepped.y, ground_end);
        update_contact(&state, contact_of(k1), stepped.mid, Contact(base.f_h, base.f_v));
        state.motion = stepped.y;
        forcing.done += one;
    }
    return state.extremes.friction;
}
