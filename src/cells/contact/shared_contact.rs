//! The full contact that cells share: it takes a cell to the place where it may first lift. Twin of
//! `shaders/shared_contact.wgsl`; the motions are made in [`full_contact`](super::full_contact).

use super::motions::{
    ACCELERATION, LEAST_SO_FAR, LOWER, LOWER_SO_FAR, MAGNITUDE_SO_FAR, MINUS_LOWER_SO_FAR,
    MotionPair, UPPER, UPPER_SO_FAR,
};
use super::shared_friction::{at_samples, crests, within_gap};
use crate::model::CellEquations;
use crate::model::block::Model;
use crate::model::excitation::Cell;
use crate::model::number::Number;
use crate::model::real::{Real, Vector};
use crate::stepping::certificate::{STEPS_A_TRY, is_final};
use crate::stepping::state::{FINISHED, PROVED, State};
use crate::work::vectors::vectorized;

/// True where a cell with this lever, H times its share of u, may lift in a gap between samples: X of (14) lies
/// between two bounds, and Y lies above one.
#[inline(always)]
fn lifts<N: Number>(arms: [N; 2], lever: N, upper: N, lower: N, lower_y: N) -> N::Mask {
    // A negative lever exchanges the two bounds.
    let (one, other) = (lever * upper, lever * lower);
    one.max(other).gt(arms[0] * lower_y) | (-one).max(-other).gt(arms[1] * lower_y)
}

/// Takes a cell from its start to the first gap in which it may lift, to the step at which it is final, or to the end
/// of the motions. The cell is checked for being final at the same steps as in an integration of its own.
#[inline(always)]
pub(crate) fn full_contact<R: Real>(
    motions: &MotionPair<R>,
    model: &Model<R>,
    cell: &Cell<R>,
    state: &mut State<R>,
) {
    let (variant, set) =
        (motions.variant, CellEquations::of(motions.variant, model, cell, motions.record));
    // u is A_h times its value for A_h = 1.
    let scale = cell.drive.scale;
    let lever = model.height * scale;
    let arms = [model.left.arm, model.right.arm];
    let first = first_beyond(motions, arms, lever);
    // A search along rows of numbers, with the widest vectors of this machine.
    let (mut sample, none) = (first, R::of(0.0));
    vectorized!(motions.level, none => sample = first_lift(motions, arms, lever, first, none));
    let mut friction = none;
    // A motion that is continued after the excitation has one sample per step.
    let mut tried = cell.steps.steps_forced.saturating_add(STEPS_A_TRY);
    while variant.certificate && tried as usize <= sample && tried < cell.steps.steps {
        motions.move_to(scale, tried as usize, state);
        // The contact forces are treated as if they had no extreme yet: they take longer to become known.
        (state.extremes.friction, state.extremes.min_contact) = (R::of(MOST), R::of(-MOST));
        if stays_final(&set, state) {
            friction = friction_before(motions, &set, tried as usize, friction);
            meet_forces(motions, model, tried as usize, friction, state);
            if stays_final(&set, state) {
                (state.step, state.status) = (tried, PROVED);
                return;
            }
        }
        tried += STEPS_A_TRY;
    }
    friction = friction_before(motions, &set, sample, friction);
    motions.move_to(scale, sample, state);
    meet_forces(motions, model, sample, friction, state);
    // A sample is one step of the cell or several, and a cell has fewer than 2^32 steps.
    state.step = sample as u32 * cell.steps.substeps;
    if state.step >= cell.steps.steps {
        state.status = FINISHED;
    }
}

/// A number above any contact force, m/s^2, and above any friction, that every number type can hold.
const MOST: f64 = 1.0e30;

/// True where a block in full contact that has not lifted stays so, and all that is requested is final.
#[inline(always)]
fn stays_final<R: Real>(set: &CellEquations<R>, state: &State<R>) -> bool {
    let (none, tried) = (set.model.height.mask(0), set.model.height.mask(1));
    let (corner, extremes) = (&set.model.left, &state.extremes);
    R::any(is_final(set, corner, none, tried, none, &state.motion, extremes))
}

/// The largest friction demand before a sample, if one is known.
#[inline(always)]
fn friction_before<R: Real>(
    motions: &MotionPair<R>,
    set: &CellEquations<R>,
    sample: usize,
    known: R,
) -> R {
    let (mut friction, none, size) = (known, R::of(0.0), set.cell.drive.scale.abs());
    if !motions.variant.asked.forces || sample == 0 {
        return known;
    }
    if motions.still {
        let y = motions.up.field(ACCELERATION)[0];
        let magnitude = motions.across.field(MAGNITUDE_SO_FAR)[sample - 1];
        return if y > none { size * magnitude / y } else { none };
    }
    vectorized!(motions.level, none => {
        friction = at_samples(motions, size, sample, known, none);
        friction = crests(motions, size, sample, friction, none, |gap, friction| {
            within_gap(motions, set, gap, friction)
        });
    });
    friction
}

/// The contact forces up to a sample whose friction demand is known.
#[inline(always)]
fn meet_forces<R: Real>(
    motions: &MotionPair<R>,
    model: &Model<R>,
    sample: usize,
    friction: R,
    state: &mut State<R>,
) {
    (state.extremes.min_contact, state.extremes.friction) = (model.gravity, friction);
    if motions.variant.asked.forces {
        let v = motions.up;
        let least = v.field(LEAST_SO_FAR)[sample.min(v.length - 1)];
        state.extremes.min_contact = least.min(model.gravity);
    }
}

/// The first gap in which a cell may lift by the largest bounds of X and the least bound of Y so far, which are
/// monotonic from gap to gap; or the last sample, which ends no gap. The cell does not lift in an earlier gap.
fn first_beyond<R: Real>(motions: &MotionPair<R>, arms: [R; 2], lever: R) -> usize {
    let (h, v) = (motions.across, motions.up);
    let last = h.length - 1;
    let (upper_so_far, minus_lower_so_far) = (h.field(UPPER_SO_FAR), h.field(MINUS_LOWER_SO_FAR));
    let lower_so_far = v.field(LOWER_SO_FAR);
    let [left, right] = arms;
    let (rising, falling) = if lever < R::of(0.0) { (right, left) } else { (left, right) };
    let size = lever.abs();
    let (mut low, mut high) = (0, last);
    while low < high {
        let gap = low.midpoint(high);
        let lower_y = lower_so_far[v.gap(gap)];
        if size * upper_so_far[gap] > rising * lower_y
            || size * minus_lower_so_far[gap] > falling * lower_y
        {
            high = gap;
        } else {
            low = gap + 1;
        }
    }
    low
}

/// The first gap from a given one on in which a cell may lift, or the last sample: first vector by vector, then gap
/// by gap.
#[inline(always)]
fn first_lift<V: Vector>(
    motions: &MotionPair<V::Element>,
    arms: [V::Element; 2],
    lever: V::Element,
    first: usize,
    zero: V,
) -> usize {
    let (h, v) = (motions.across, motions.up);
    let (last, last_v) = (h.length - 1, v.length - 1);
    let (upper, lower) = (h.field(UPPER), h.field(LOWER));
    let lower_y = v.field(LOWER);
    let lever_of_all = zero.like(lever.to_f64());
    let arms_of_all = [zero.like(arms[0].to_f64()), zero.like(arms[1].to_f64())];
    let mut sample = first;
    while sample + V::LANES <= last.min(last_v) {
        let (upper, lower) = (zero.first_of(&upper[sample..]), zero.first_of(&lower[sample..]));
        let lower_y = zero.first_of(&lower_y[sample..]);
        if V::any(lifts(arms_of_all, lever_of_all, upper, lower, lower_y)) {
            break;
        }
        sample += V::LANES;
    }
    while sample < last {
        let lower_y = lower_y[v.gap(sample)];
        if lifts(arms, lever, upper[sample], lower[sample], lower_y) {
            break;
        }
        sample += 1;
    }
    sample
}

#[cfg(test)]
mod tests {
    use super::super::motions::{LEAST, MAGNITUDE};
    use super::super::shared_friction::{OVER, share};
    use super::*;
    use crate::cells::clock::DEFAULT_STEP;
    use crate::cells::plan::Plan;
    use crate::cells::ready::Cells;
    use crate::scene::record::synthetic;
    use crate::scene::{Grid, Parameter, Range, Scene, SceneBuilder};
    use crate::work::observer::Unwatched;

    /// The gaps that the bounds exclude have no effect: the gaps in which a cell may lift, and the samples and crests
    /// of the friction demand, are the same as those of a search of every gap.
    fn nothing_is_left_out<R: Real>(scene: &Scene) {
        let (plan, grid) = (Plan::new(scene, DEFAULT_STEP).unwrap(), Grid::of(scene));
        let record = plan.record::<R>();
        let cells: Vec<usize> = (0..grid.len()).collect();
        let all = Cells::<R>::of(&plan, &grid, &cells, &record, &Unwatched);
        let of = R::of;
        let mut lifted = 0;
        for (cell, scale) in (0..grid.len()).flat_map(|cell| {
            [0.02, -0.1, 0.35, -0.7, 1.0].into_iter().map(move |scale| (cell, scale))
        }) {
            let motions = all.motions_of(&all.tables.cell(cell)).unwrap();
            let mut numbers = all.tables.numbers(&all.tables.cell(cell));
            let model = &all.bodies()[numbers.body as usize];
            // The shared motion times the scale is the motion of such a cell.
            let ratio = of(scale) / numbers.drive.scale;
            numbers.drive.scale = of(scale);
            numbers.drive.amplitude_h = numbers.drive.amplitude_h * ratio;
            numbers.horizontal.hysteretic = numbers.horizontal.hysteretic * ratio.abs();
            numbers.horizontal.inverse_yield = numbers.horizontal.inverse_yield / ratio.abs();
            let set = CellEquations::of(motions.variant, model, &numbers, &record);
            let (h, v) = (motions.across, motions.up);
            let (arms, lever, size) = ([of(0.17), of(0.23)], of(scale), of(scale.abs()));
            let (lower_y, x, y) = (v.field(LOWER), h.field(ACCELERATION), v.field(ACCELERATION));
            let last = h.length - 1;
            let gap_v = |gap: usize| gap.min(v.length - 2);
            let may = |gap: &usize| {
                let (upper, lower) = (h.field(UPPER)[*gap], h.field(LOWER)[*gap]);
                lifts(arms, lever, upper, lower, lower_y[gap_v(*gap)])
            };
            let sample = (0..last).find(may).unwrap_or(last);
            lifted += usize::from(sample < last);
            let shares = (0..sample).map(|gap| share(size, x[gap], y[gap_v(gap)]));
            let friction = shares.fold(of(0.0), R::max);
            let (mut found, none) = ((0, of(0.0), of(0.0)), of(0.0));
            vectorized!(motions.level, none => {
                let first = first_beyond(&motions, arms, lever);
                let sample = first_lift(&motions, arms, lever, first, none);
                let at_samples = at_samples(&motions, size, sample, of(0.0), none);
                let crests = crests(&motions, size, sample, at_samples, none, |gap, friction| {
                    within_gap(&motions, &set, gap, friction)
                });
                found = (sample, at_samples, crests);
            });
            assert_eq!((found.0, found.1), (sample, friction), "cell {cell}, {scale}");
            let crest = (0..sample).fold(friction, |most, gap| {
                let (magnitude, least) = (h.field(MAGNITUDE)[gap], v.field(LEAST)[gap_v(gap)]);
                let looked = size * magnitude > of(1.0 + OVER) * friction * least;
                if looked { within_gap(&motions, &set, gap, most) } else { most }
            });
            // A gap that exceeds the largest friction so far by less than this is not searched.
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
