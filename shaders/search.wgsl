// Where in its span a guard is, a trial at a time: Newton's method inside a bracket, from the cubic
// through the span's ends. Twin: src/stepping/search.rs.

struct Search {
    sought: Sought,
    again: bool,
    at: real,
    low: real,
    high: real,
    verified: bool,
    last: bool,
    tries: u32,
    before: real,
    value_before: real,
    slope: real,
}

fn no_search() -> Search {
    let zero: real = 0.0;
    let one: real = 1.0;
    return Search(
        nothing_sought(),
        false,
        one,
        zero,
        zero,
        false,
        false,
        0u,
        zero,
        zero,
        zero,
    );
}

// How far past a root to aim, so that the trial ends beyond it; not for angles.
fn aim(sought: Sought) -> real {
    let zero: real = 0.0;
    return select(0.5 * tolerance_of(sought), zero, is_angle(sought));
}

// Begins the search for a guard that has happened at `upper`.
fn begin_search(search: ptr<function, Search>, found: Sought, cubic: Cubic, upper: real) {
    let zero: real = 0.0;
    (*search).sought = found;
    let root = root(cubic);
    let whole = upper >= 1.0;
    (*search).at = select(upper, root.at + aim(found), whole);
    (*search).low = zero;
    (*search).high = upper;
    (*search).tries = 0u;
    (*search).slope = root.slope;
    (*search).verified = whole;
    (*search).last = false;
}

struct Arrived {
    done: bool,
    back: real,
}

// Takes in what the trial at `at` came to.
fn narrow(search: ptr<function, Search>, found: GuardSample) -> Arrived {
    let zero: real = 0.0;
    let one: real = 1.0;
    let sought = (*search).sought;
    let angle = is_angle(sought);
    let tolerance = tolerance_of(sought);
    let at = (*search).at;
    let secant = (found.value - (*search).value_before) / (at - (*search).before);
    let repeated = (*search).tries > 0u;
    let slope = select(found.slope, select((*search).slope, secant, repeated), sought.uplift);
    (*search).slope = slope;
    (*search).before = at;
    (*search).value_before = found.value;
    (*search).tries += 1u;
    // A guard without a slope tells no way to go; no device is asked for a NaN here.
    let steep = abs(slope) > 0.0;
    let change = found.value / select(one, slope, steep);
    let beyond = found.value > 0.0;
    // Going back along the slope misses half the bend times the square of the way.
    let missed = select(abs(change * slope), 0.5 * change * change * abs(found.bend), angle);
    let near = steep && tolerance * abs(slope) >= missed;
    // What has not happened at the upper end does not happen.
    let nothing = !(*search).verified && !beyond && at >= (*search).high;
    let done = ((near && (beyond || angle)) || (*search).last) && !nothing;
    let high = select((*search).high, at, beyond);
    let low = select(at, (*search).low, beyond);
    (*search).high = high;
    (*search).low = low;
    (*search).verified = (*search).verified || beyond;
    var next = at - change + aim(sought);
    next = select(0.5 * (low + high), next, steep && next > low && next < high);
    let narrow = tolerance >= high - low || (*search).tries >= LOCATE_BOUND;
    (*search).last = narrow;
    (*search).at = select(next, high, narrow);
    (*search).again = nothing;
    if done || nothing {
        (*search).sought = nothing_sought();
        (*search).at = one;
    }
    return Arrived(done, select(zero, change, done && angle && near));
}
