// The search for the root of a guard in its span, one trial at a time: the method of Newton inside a bracket, started
// at the root of the cubic through the ends of the span. Twin: src/stepping/search.rs.

struct Search {
    sought: Sought,
    at: real,
    low: real,
    high: real,
    tries: u32,
    // Before the first trial: the slope at the root with which the search begins; afterwards the previous trial. The
    // twin has a variable for each, and flags for `last` and for a verified end.
    before: real,
    value_before: real,
}

fn no_search() -> Search {
    let zero: real = 0.0;
    let one: real = 1.0;
    return Search(
        NOTHING_SOUGHT,
        one,
        zero,
        zero,
        0u,
        zero,
        zero,
    );
}

// The distance beyond the root at which the next trial aims, so that it ends beyond the root. Zero for angles.
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
    (*search).before = root.slope;
}

// The distance before the end of a trial at which an angle passed its target, and the error of that distance.
struct StepBack {
    back: real,
    error: real,
}

// The distance to step back along the parabola that has the value, the slope and the bend of the angle at the end of
// a trial; `bend_before` is the bend at the start of the trial.
fn step_back(end: GuardSample, per_slope: real, bend_before: real) -> StepBack {
    let first = end.value * per_slope;
    let ratio = end.bend * per_slope;
    let second = 0.5 * first * first * ratio;
    let bends = (abs(end.bend) + abs(bend_before)) * abs(per_slope);
    let third = abs(second * ratio) + 0.16666666666666666 * first * first * bends;
    return StepBack(first + second, abs(first) * third);
}

// The distance of the guard from the end of a trial.
struct RootDistance {
    // True where the slope of the guard is not zero. Where it is zero there is no division by it, because devices
    // differ in NaN.
    steep: bool,
    // One over the slope.
    per_slope: real,
    // The distance to step back, for an angle.
    way: StepBack,
}

struct Arrived {
    done: bool,
    back: real,
}

// The distance of the guard from the end of a trial; `bend_before` is the bend of an angle at the start of the trial.
// The slope of an uplift moment is the secant from the previous trial.
fn reach_of(search: Search, end: GuardSample, bend_before: real) -> RootDistance {
    let one: real = 1.0;
    let by_secant = search.sought == SOUGHT_UPLIFT && search.tries > 0u;
    let first = select(end.slope, search.before, search.sought == SOUGHT_UPLIFT);
    let slope = select(first, end.value - search.value_before, by_secant);
    let steep = abs(slope) > 0.0;
    let per_slope = select(one, search.at - search.before, by_secant) / select(one, slope, steep);
    return RootDistance(steep, per_slope, step_back(end, per_slope, bend_before));
}

// Narrows the bracket with the result of the trial at `at`.
fn narrow(search: ptr<function, Search>, found: GuardSample, reach: RootDistance) -> Arrived {
    let zero: real = 0.0;
    let one: real = 1.0;
    let steep = reach.steep;
    let per_slope = reach.per_slope;
    let way = reach.way;
    let sought = (*search).sought;
    let angle = is_angle(sought);
    let tolerance = tolerance_of(sought);
    let at = (*search).at;
    let repeated = (*search).tries > 0u;
    (*search).before = at;
    (*search).value_before = found.value;
    let last = (*search).tries >= LOCATE_BOUND;
    (*search).tries += 1u;
    let beyond = found.value > 0.0;
    // The next trial aims beyond the root by the rounding error of the value; a value within twice that error counts
    // as found.
    let rounding = found.rounding;
    let change = select((found.value - rounding) * per_slope, way.back, angle);
    let off = (abs(found.value) - rounding - rounding) * abs(per_slope);
    let near = steep && tolerance >= select(off, way.error, angle);
    // A guard that has not happened at the upper end of its bracket does not happen at all; an upper end inside the
    // span is tried first.
    let nothing = !repeated && (*search).high < 1.0 && !beyond;
    let done = ((near && (beyond || angle)) || last) && !nothing;
    let high = select((*search).high, at, beyond);
    let low = select(at, (*search).low, beyond);
    (*search).high = high;
    (*search).low = low;
    var next = at - change + aim(sought);
    next = select(0.5 * (low + high), next, steep && next > low && next < high);
    let narrow = tolerance >= high - low || (*search).tries >= LOCATE_BOUND;
    // A bracket that is narrow enough counts as if all trials were made: the next trial is the last.
    (*search).tries = select((*search).tries, LOCATE_BOUND, narrow);
    (*search).at = select(next, high, narrow);
    if done || nothing {
        (*search).sought = select(NOTHING_SOUGHT, SOUGHT_AGAIN, nothing);
        (*search).at = one;
    }
    return Arrived(done, select(zero, change, done && angle && near));
}
