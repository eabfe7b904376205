//! The guards of a phase: events that cut a step, whether one happens in a step, and when.

use super::EVENT_TIME;
use super::cubic::{Cubic, SAMPLED, SAMPLES, climb, crest};
use super::system::{DU, PHI, Pole, State, Z};
use super::trial::Trial;

/// The events that cut a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Guard {
    /// The uplift condition about a corner.
    Uplift,
    /// phi returns to zero.
    Impact,
    /// phi reaches the overturning angle.
    Overturn,
    /// u' changes sign.
    Velocity,
    /// z changes sign.
    Hysteretic,
    /// The base meets its end stop, or leaves it.
    Stop,
}

impl Guard {
    /// True where both crossings of a pair within a step count. Between two kinks that are that close the error of
    /// the step is small, or the step is refused.
    fn switches(self) -> bool {
        matches!(self, Guard::Uplift | Guard::Impact | Guard::Overturn | Guard::Stop)
    }
}

/// The value of a guard in a state at a time from the start of the step: positive after its event has happened.
fn value(trial: &Trial, guard: Guard, after: f64, y: &State) -> f64 {
    let side = trial.phase.map_or(0.0, Pole::sign);
    match guard {
        Guard::Uplift => trial.system.lift(trial.t + after, trial.drive, y).0,
        Guard::Impact => -side * y[PHI],
        Guard::Overturn => {
            let angle = trial.phase.map_or(f64::INFINITY, |p| trial.system.overturning_angle(p));
            side * y[PHI] - angle
        }
        Guard::Velocity => -trial.y[DU].signum() * y[DU],
        Guard::Stop => {
            let beyond = trial.system.beyond_stop(y);
            if trial.system.against == 0.0 { beyond } else { -beyond }
        }
        Guard::Hysteretic => -trial.y[Z].signum() * y[Z],
    }
}

/// The guards that can happen in a step.
fn guards(trial: &Trial) -> [Option<Guard>; 6] {
    let rocking = trial.phase.is_some();
    let yields = trial.system.yields();
    [
        (!rocking).then_some(Guard::Uplift),
        rocking.then_some(Guard::Impact),
        rocking.then_some(Guard::Overturn),
        (yields && trial.y[DU] != 0.0).then_some(Guard::Velocity),
        (yields && trial.y[Z] != 0.0).then_some(Guard::Hysteretic),
        trial.system.stop.is_some().then_some(Guard::Stop),
    ]
}

/// The first guard that happens in a step, and the time from its start just after the event. The guard is found by
/// samples along the cubic of the step and by the crests between them, and located on the step itself.
pub fn first_guard(trial: &Trial, cubic: &Cubic) -> Option<(Guard, f64)> {
    let states = SAMPLED.map(|x| cubic.at(x));
    let mut brackets = Vec::new();
    for guard in guards(trial).into_iter().flatten() {
        let at = |i: usize| value(trial, guard, SAMPLED[i] * cubic.h, &states[i]);
        let values: [f64; SAMPLES] = std::array::from_fn(at);
        if let Some(between) = bracket(trial, guard, &values, cubic.h) {
            brackets.push((guard, between));
        }
    }
    let one = brackets.len() == 1;
    let candidate = |(guard, between): (Guard, (f64, f64))| {
        // One guard by itself needs no order.
        let time = if one { 0.0 } else { root(trial, guard, 0.0, cubic, between) };
        (time, guard, (between.0 * cubic.h, between.1 * cubic.h))
    };
    let mut candidates: Vec<_> = brackets.into_iter().map(candidate).collect();
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut first: Option<(Guard, f64)> = None;
    for (_, guard, (low, high)) in candidates {
        let place = match first {
            // The order of events may be wrong on the cubic: on the step itself this one may come first.
            Some((_, place)) if has_happened(trial, guard, place) => {
                locate(trial, guard, (0.0, place))
            }
            Some(_) => None,
            // The cubic may show it slightly too early: then it happens in the rest of the step, or not at all.
            None => {
                locate(trial, guard, (low, high)).or_else(|| locate(trial, guard, (low, cubic.h)))
            }
        };
        first = place.map(|place| (guard, place)).or(first);
    }
    first
}

/// True where a guard has happened at a time from the start of the step, on the step itself.
fn has_happened(trial: &Trial, guard: Guard, after: f64) -> bool {
    value(trial, guard, after, &trial.step(after).0) > 0.0
}

/// The fractions of a step of length `h` between which a guard first happens: two samples, or one sample and a crest
/// beyond it, where a switch has happened and is undone at the next sample.
fn bracket(trial: &Trial, guard: Guard, values: &[f64; SAMPLES], h: f64) -> Option<(f64, f64)> {
    let happened = (1..SAMPLES).find(|&i| values[i] > 0.0);
    let sampled = happened.map(|i| (SAMPLED[i - 1], SAMPLED[i]));
    if !guard.switches() {
        return sampled;
    }
    let before = sampled.map_or(1.0, |(low, _)| low);
    let crests = (1..SAMPLES - 1).filter_map(|middle| crest(values, middle));
    for foretold in crests.filter(|crest| crest.most > 0.0 && crest.at < before) {
        let exact = |x: f64| value(trial, guard, x * h, &trial.step(x * h).0);
        let (at, most) = climb(foretold.at, exact);
        let low = SAMPLED.into_iter().rev().find(|x| *x < at);
        if let (true, Some(low)) = (most > 0.0, low) {
            return Some((low, at));
        }
    }
    sampled
}

/// The length of a bracket, s, at which the bisection of a cubic ends: a root of it is an estimate, and is moved by
/// more than that.
const ROOT_TIME: f64 = EVENT_TIME / 16.0;

/// The place at which a guard changes sign on a cubic that begins at the time `after` from the start of the step, by
/// bisection; `(low, high)` are fractions of the cubic.
fn root(
    trial: &Trial,
    guard: Guard,
    after: f64,
    cubic: &Cubic,
    (mut low, mut high): (f64, f64),
) -> f64 {
    while (high - low) * cubic.h > ROOT_TIME {
        let mid = 0.5 * (low + high);
        if value(trial, guard, after + mid * cubic.h, &cubic.at(mid)) > 0.0 {
            high = mid;
        } else {
            low = mid;
        }
    }
    0.5 * (low + high)
}

/// Locates a guard between two times from the start of the step. The step is computed again up to the estimate, and
/// the bracket is narrowed. Returns the later end, at which the guard has happened; `None` if it does not happen.
fn locate(trial: &Trial, guard: Guard, (mut low, mut high): (f64, f64)) -> Option<f64> {
    let redo = |x: f64| {
        let at = trial.step(x).0;
        let rate = trial.rate_of(x, &at);
        (at, rate)
    };
    let (mut y_low, mut d_low) = if low > 0.0 { redo(low) } else { (*trial.y, *trial.rate) };
    let (mut y_high, mut d_high) = redo(high);
    if value(trial, guard, high, &y_high) <= 0.0 {
        return None;
    }
    if low > 0.0 && value(trial, guard, low, &y_low) > 0.0 {
        // The cubic showed it slightly too late.
        (high, y_high, d_high) = (low, y_low, d_low);
        (low, y_low, d_low) = (0.0, *trial.y, *trial.rate);
    }
    let mut aside = -0.25;
    // Counts consecutive estimates that did not halve the bracket, as happens where the cubic across a kink is far
    // off.
    let mut poor = 0;
    while high - low > EVENT_TIME {
        let width = high - low;
        let cubic = Cubic::new((&y_low, &d_low), (&y_high, &d_high), width);
        let estimate = root(trial, guard, low, &cubic, (0.0, 1.0));
        // The estimate is moved slightly to either side in turn, so that the bracket is narrowed from both sides.
        let mut x = low + estimate * width + aside * EVENT_TIME;
        aside = -aside;
        if poor >= 2 || !(x > low && x < high) {
            x = low + 0.5 * width;
        }
        if x <= low || x >= high {
            break;
        }
        let (at, rate) = redo(x);
        if value(trial, guard, x, &at) > 0.0 {
            (high, y_high, d_high) = (x, at, rate);
        } else {
            (low, y_low, d_low) = (x, at, rate);
        }
        poor = if high - low > 0.5 * width { poor + 1 } else { 0 };
    }
    Some(high)
}
