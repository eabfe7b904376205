//! The full contact that cells share: where it takes a cell before the cell lifts. Twin of
//! `shaders/shared_contact.wgsl`; the motions are made in [`full_contact`](super::full_contact).

use super::full_contact::FullContactMotions;
use super::motions::{
    ACCELERATION, BOTTOM, CREST, DEEPEST, DISPLACEMENT, EIGHTHS_V, HIGHEST, HYSTERETIC, LEAST,
    LIGHTEST, LOWEST, MOST, QUARTERS_H, STRONGEST, TOP, TROUGH, VELOCITY,
};
use super::vectors::vectorized;
use crate::model::block::Model;
use crate::model::excitation::Cell;
use crate::model::motion::Motion;
use crate::model::number::Number;
use crate::model::real::{Real, Vector};
use crate::scene::grid::Place;
use crate::stepping::extremes::{self, end_slopes, parabola};
use crate::stepping::state::{FINISHED, State};

/// True where a cell of this lever, H times its share of u, may lift in a gap between samples: X of
/// (14) is between two bounds, and Y above one.
#[inline(always)]
fn lifts<N: Number>(arms: [N; 2], lever: N, most: N, least: N, least_y: N) -> N::Mask {
    // A negative lever turns the bounds about.
    let (one, other) = (lever * most, lever * least);
    one.max(other).gt(arms[0] * least_y) | (-one).max(-other).gt(arms[1] * least_y)
}

/// Takes a cell from its start to the first gap in which it may lift, or to the end of the
/// excitation.
#[inline(always)]
pub(super) fn full_contact<R: Real>(
    motions: &FullContactMotions<R>,
    model: &Model<R>,
    place: &Place,
    scale: R,
    cell: &Cell<R>,
    state: &mut State<R>,
) {
    let zero = R::of(0.0);
    let (h, v) = (motions.across.at(place), motions.up.at(place));
    // u is A_h times what it is for A_h = 1.
    let lever = model.height * scale;
    let size = scale.abs();
    let arms = [model.left.arm, model.right.arm];
    // A motion of v at rest is as long as it is asked for.
    let last_v = v.length - 1;
    let first = first_beyond(motions, arms, place, lever);
    // A scan along rows of numbers, with the widest vectors that this machine has.
    let (mut sample, mut friction, none) = (first, zero, zero);
    vectorized!(motions.level, none => {
        sample = first_lift(motions, arms, place, lever, first, none);
        if motions.forces && !motions.still {
            friction = at_samples(motions, place, size, sample, none);
            friction = crests(motions, place, size, sample, friction, none);
        }
    });
    if motions.still && sample > 0 {
        let y = v.field(ACCELERATION)[0];
        let strongest = h.field(STRONGEST)[sample - 1];
        friction = if y > zero { size * strongest / y } else { zero };
    }
    let at = sample.min(last_v);
    let z = h.field(HYSTERETIC)[sample];
    state.motion = Motion {
        u: scale * h.field(DISPLACEMENT)[sample],
        du: scale * h.field(VELOCITY)[sample],
        v: v.field(DISPLACEMENT)[at],
        dv: v.field(VELOCITY)[at],
        z: if scale < zero { -z } else { z },
        phi: zero,
        dphi: zero,
    };
    state.max_u = scale.abs() * h.field(TOP)[sample];
    state.least_v = v.field(BOTTOM)[at];
    state.most_v = v.field(TOP)[at];
    let lowest = v.field(LOWEST)[at];
    if lowest < state.min_contact {
        state.min_contact = lowest;
    }
    state.friction = friction;
    // A sample is a step of the cell or more, of which there are fewer than 2^32.
    state.step = (sample as u32 * cell.substeps).min(cell.steps_forced);
    if state.step >= cell.steps {
        state.status = FINISHED;
    }
}

/// The first gap in which a cell may lift by the largest bounds of X and the least of Y so far, which do not fall and
/// do not rise from gap to gap; or the last sample, which ends no gap. It lifts in no gap before.
fn first_beyond<R: Real>(
    motions: &FullContactMotions<R>,
    arms: [R; 2],
    place: &Place,
    lever: R,
) -> usize {
    let (h, v) = (motions.across.at(place), motions.up.at(place));
    let (last, last_v) = (h.length - 1, v.length - 1);
    let (highest, deepest) = (h.field(HIGHEST), h.field(DEEPEST));
    let lightest = v.field(LIGHTEST);
    let [left, right] = arms;
    let (rising, falling) = if lever < R::of(0.0) { (right, left) } else { (left, right) };
    let size = lever.abs();
    let (mut low, mut high) = (0, last);
    while low < high {
        let gap = low.midpoint(high);
        let least_y = lightest[gap.min(last_v.saturating_sub(1))];
        if size * highest[gap] > rising * least_y || size * deepest[gap] > falling * least_y {
            high = gap;
        } else {
            low = gap + 1;
        }
    }
    low
}

/// The first gap in which a cell may lift, from a gap on, or the last sample: vector by vector, then gap by gap.
#[inline(always)]
fn first_lift<V: Vector>(
    motions: &FullContactMotions<V::Element>,
    arms: [V::Element; 2],
    place: &Place,
    lever: V::Element,
    first: usize,
    zero: V,
) -> usize {
    let (h, v) = (motions.across.at(place), motions.up.at(place));
    let (last, last_v) = (h.length - 1, v.length - 1);
    let (most, least) = (h.field(MOST), h.field(LEAST));
    let least_y = v.field(LEAST);
    let lever_of_all = zero.like(lever.to_f64());
    let arms_of_all = [zero.like(arms[0].to_f64()), zero.like(arms[1].to_f64())];
    let mut sample = first;
    while sample + V::LANES <= last.min(last_v) {
        let (most, least) = (zero.first_of(&most[sample..]), zero.first_of(&least[sample..]));
        let least_y = zero.first_of(&least_y[sample..]);
        if V::any(lifts(arms_of_all, lever_of_all, most, least, least_y)) {
            break;
        }
        sample += V::LANES;
    }
    while sample < last {
        let least_y = least_y[sample.min(last_v.saturating_sub(1))];
        if lifts(arms, lever, most[sample], least[sample], least_y) {
            break;
        }
        sample += 1;
    }
    sample
}

/// The gaps before one from which on vectors are read, and gap by gap before: v may be shorter than u.
fn in_vectors<V: Vector>(sample: usize, last_v: usize) -> usize {
    let both = sample.min(last_v);
    if both < V::LANES { 0 } else { both }
}

/// The friction asked for at the samples before one. A motion grows until the block lifts: from the last sample
/// backwards, until the largest |X| so far over the least Y so far exceeds no more.
#[inline(always)]
fn at_samples<V: Vector>(
    motions: &FullContactMotions<V::Element>,
    place: &Place,
    size: V::Element,
    sample: usize,
    zero: V,
) -> V::Element {
    let (h, v) = (motions.across.at(place), motions.up.at(place));
    let last_v = v.length - 1;
    let (x, y) = (h.field(ACCELERATION), v.field(ACCELERATION));
    let (strongest, lowest) = (h.field(STRONGEST), v.field(LOWEST));
    let sizes = zero.like(size.to_f64());
    // The largest in each lane.
    let mut frictions = zero;
    let mut before = in_vectors::<V>(sample, last_v);
    let mut friction = V::Element::of(0.0);
    for gap in before..sample {
        let y = y[gap.min(last_v.saturating_sub(1))];
        friction = friction.max(share(size, x[gap], y));
    }
    frictions.put(0, friction);
    while before > 0 {
        let limit = zero.like((size * strongest[before - 1]).to_f64());
        if V::any((frictions * zero.like(lowest[before].to_f64())).ge(limit)) {
            break;
        }
        // The first samples are looked at with some after them.
        before = before.saturating_sub(V::LANES);
        let (x, y) = (zero.first_of(&x[before..]), zero.first_of(&y[before..]));
        frictions = frictions.max(share(sizes, x, y));
    }
    for lane in 0..V::LANES {
        friction = friction.max(frictions.lane(lane));
    }
    friction
}

/// Share of the friction asked for by which a gap must exceed it to be looked into.
const OVER: f64 = 2.0e-4;

/// The least of the parabola through three values evenly apart, and at what fraction of the way.
#[inline(always)]
fn dip<N: Number>([start, mid, end]: [N; 3]) -> (N, N) {
    let (zero, one) = (start.like(0.0), start.like(1.0));
    let (rise, fall) = end_slopes(start, mid, end);
    let outside = N::select(start.gt(end), one, zero);
    let inside = zero.gt(rise) & fall.gt(zero);
    let at = N::select(inside, rise / (rise - fall), outside);
    (parabola(start, mid, end, at), at)
}

/// The friction asked for up to a sample, crests between samples included: in gaps where the largest
/// |X| over the least Y exceeds the largest so far it is looked for [within the gap](within_gaps), backwards as
/// [at the samples](at_samples).
#[inline(always)]
fn crests<V: Vector>(
    motions: &FullContactMotions<V::Element>,
    place: &Place,
    size: V::Element,
    sample: usize,
    friction: V::Element,
    zero: V,
) -> V::Element {
    let over = V::Element::of(1.0 + OVER);
    let (h, v) = (motions.across.at(place), motions.up.at(place));
    let (crest, trough) = (h.field(CREST), v.field(TROUGH));
    let (strongest, lowest) = (h.field(STRONGEST), v.field(LOWEST));
    let last_v = v.length - 1;
    let sizes = zero.like(size.to_f64());
    let mut friction = friction;
    let mut before = in_vectors::<V>(sample, last_v);
    for gap in (before..sample).rev() {
        let gap_v = gap.min(last_v.saturating_sub(1));
        if size * crest[gap] > over * friction * trough[gap_v] {
            friction = friction.max(within_gaps(motions, place, size, (gap, gap_v)));
        }
    }
    while before > 0 {
        if over * friction * lowest[before] >= size * strongest[before - 1] {
            break;
        }
        // The first gaps are looked at with some after them.
        let first = before.saturating_sub(V::LANES);
        let limits = zero.like((over * friction).to_f64());
        let bounds = sizes * zero.first_of(&crest[first..]);
        let beyond = V::bits(bounds.gt(limits * zero.first_of(&trough[first..])));
        if beyond != 0 {
            let within = within_gaps(motions, place, sizes, (first, first));
            for lane in (0..before - first).rev().filter(|lane| beyond >> lane & 1 == 1) {
                // Those after it may have raised the limit.
                let gap = first + lane;
                if size * crest[gap] > over * friction * trough[gap] {
                    friction = friction.max(within.lane(lane));
                }
            }
        }
        before = first;
    }
    friction
}

/// The friction asked for within gaps, from these of u and of v on, one in each lane: on parabolas through eighths of
/// them, and where Y is least. How small Y is there is known; the parabolas tell when.
#[inline(always)]
fn within_gaps<V: Vector>(
    motions: &FullContactMotions<V::Element>,
    place: &Place,
    size: V,
    (gap, gap_v): (usize, usize),
) -> V {
    let zero = size.like(0.0);
    let (h, v) = (motions.across.at(place), motions.up.at(place));
    let crest = zero.first_of(&h.field(CREST)[gap..]);
    let trough = zero.first_of(&v.field(TROUGH)[gap_v..]);
    let (xs, ys) = (&h.field(ACCELERATION)[gap..], &v.field(ACCELERATION)[gap_v..]);
    let mut quarters = [zero.first_of(xs); 5];
    for (number, quarter) in quarters[1..4].iter_mut().enumerate() {
        *quarter = zero.first_of(&h.field(QUARTERS_H + number)[gap..]);
    }
    quarters[4] = zero.first_of(&xs[1..]);
    let mut eighths = [zero.first_of(ys); 9];
    for (number, eighth) in eighths[1..8].iter_mut().enumerate() {
        *eighth = zero.first_of(&v.field(EIGHTHS_V + number)[gap_v..]);
    }
    eighths[8] = zero.first_of(&ys[1..]);
    // Of spans of two eighths each: the largest share, and |X| where Y is least.
    let mut ends = zero;
    let mut top = zero;
    let (mut least, mut x_there) = (eighths[0], quarters[0]);
    for span in 0..4 {
        let half = span / 2 * 2;
        let early = zero.like(if span % 2 == 0 { 0.25 } else { 0.75 });
        let between = parabola(quarters[half], quarters[half + 1], quarters[half + 2], early);
        let x = [quarters[span], between, quarters[span + 1]];
        let y = [eighths[2 * span], eighths[2 * span + 1], eighths[2 * span + 2]];
        let start = share(size, x[0], y[0]);
        let mid = share(size, x[1], y[1]);
        let end = share(size, x[2], y[2]);
        ends = ends.max(start).max(mid).max(end);
        top = top.max(extremes::crest(start, mid, end));
        let (lower, at) = dip(y);
        let deeper = least.gt(lower);
        x_there = V::select(deeper, parabola(x[0], x[1], x[2], at), x_there);
        least = V::select(deeper, lower, least);
    }
    // No more than the bound that the gap was looked into for.
    let bound = share(size, crest, trough).max(ends);
    let most = top.max(share(size, x_there, trough)).max(ends).min(bound);
    V::select(trough.gt(zero), most, ends)
}

#[inline(always)]
fn share<N: Number>(size: N, x: N, y: N) -> N {
    let zero = y.like(0.0);
    N::select(y.gt(zero), size * (x.abs() / y), zero)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::excitation::Ground;
    use crate::scene::record::synthetic;
    use crate::scene::{Grid, Parameter, Range, Scene, SceneBuilder};
    use crate::sweep::clock::DEFAULT_STEP;
    use crate::sweep::plan::Plan;
    use crate::sweep::progress::Unwatched;

    /// What bounds so far leave out changes nothing: gaps in which a cell may lift, samples and crests of the friction are
    /// those of a look at every gap.
    fn nothing_is_left_out<R: Real>(scene: &Scene) {
        let (plan, grid) = (Plan::new(scene, DEFAULT_STEP).unwrap(), Grid::of(scene));
        let record: Vec<Ground<R>> = plan.record();
        let motions = FullContactMotions::<R>::of(&plan, &grid, &record, &Unwatched).unwrap();
        let of = R::of;
        let mut lifted = 0;
        for (cell, scale) in (0..grid.len()).flat_map(|cell| {
            [0.02, -0.1, 0.35, -0.7, 1.0].into_iter().map(move |scale| (cell, scale))
        }) {
            let place = grid.place(cell);
            let (h, v) = (motions.across.at(&place), motions.up.at(&place));
            let (arms, lever, size) = ([of(0.17), of(0.23)], of(scale), of(scale.abs()));
            let (least_y, x, y) = (v.field(LEAST), h.field(ACCELERATION), v.field(ACCELERATION));
            let last = h.length - 1;
            let gap_v = |gap: usize| gap.min(v.length - 2);
            let may = |gap: &usize| {
                let (most, least) = (h.field(MOST)[*gap], h.field(LEAST)[*gap]);
                lifts(arms, lever, most, least, least_y[gap_v(*gap)])
            };
            let sample = (0..last).find(may).unwrap_or(last);
            lifted += usize::from(sample < last);
            let shares = (0..sample).map(|gap| share(size, x[gap], y[gap_v(gap)]));
            let friction = shares.fold(of(0.0), R::max);
            let (mut found, none) = ((0, of(0.0), of(0.0)), of(0.0));
            vectorized!(motions.level, none => {
                let first = first_beyond(&motions, arms, &place, lever);
                let sample = first_lift(&motions, arms, &place, lever, first, none);
                let at_samples = at_samples(&motions, &place, size, sample, none);
                found = (sample, at_samples, crests(&motions, &place, size, sample, at_samples, none));
            });
            assert_eq!((found.0, found.1), (sample, friction), "cell {cell}, {scale}");
            let crest = (0..sample).fold(friction, |most, gap| {
                let (crest, trough) = (h.field(CREST)[gap], v.field(TROUGH)[gap_v(gap)]);
                let looked = size * crest > of(1.0 + OVER) * friction * trough;
                let within = || within_gaps(&motions, &place, size, (gap, gap_v(gap)));
                if looked { most.max(within()) } else { most }
            });
            // A gap that exceeds the largest so far by less than this is not looked into.
            let most = crest.max(found.2).to_f64();
            assert!((crest - found.2).to_f64().abs() <= OVER * most, "cell {cell}, {scale}");
        }
        assert!(lifted > grid.len() / 2, "{lifted} lift");
    }

    #[test]
    fn bounds_so_far_leave_nothing_out_under_pulses() {
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, 1.75)
            .with(Parameter::TV, 0.75)
            .with(Parameter::AV, 4.0)
            .with(Parameter::AH, Range::even(9.0, 10.0, 12))
            .with(Parameter::Omega, Range::even(0.5, 12.0, 16))
            .check()
            .unwrap();
        nothing_is_left_out::<f32>(&scene);
        nothing_is_left_out::<f64>(&scene);
    }

    #[test]
    fn bounds_so_far_leave_nothing_out_under_a_record() {
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, Range::even(0.5, 4.0, 8))
            .with(Parameter::TV, Range::even(0.2, 1.5, 8))
            .check_under_motion(synthetic::pair())
            .unwrap();
        nothing_is_left_out::<f32>(&scene);
        nothing_is_left_out::<f64>(&scene);
    }
}
