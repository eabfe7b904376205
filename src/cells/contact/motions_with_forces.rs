//! Motions in full contact with the contact forces inside their gaps, as many motions at once as a vector has lanes.
//!
//! All lanes go through a gap together, and through each of its steps. A lane whose step is cut at kinks of the
//! Bouc-Wen law needs more turns, and so does a lane with more steps in a gap; the other lanes wait.

use fearless_simd::Level;

use super::gap_steps::{GapStep, PartEnds, by_quarters, gap_steps};
use super::motions::{
    EIGHTHS_V, LEAST, LEAST_SO_FAR, MAGNITUDE, MAGNITUDE_SO_FAR, QUARTERS_H, Slots,
};
use super::sampling::{Gaps, load};
use super::shared_motion::MotionSet;
use super::written_motions::{Row, WrittenMotions};
use crate::model::dynamics::Rates;
use crate::model::motion::Motion;
use crate::model::real::{Real, Vector};
use crate::stepping::extremes::parabola;
use crate::stepping::lanes::{Lanes, Shared};
use crate::stepping::rk4::hermite;
use crate::stepping::spans::Direction;
use crate::work::vectors::vectorized;

/// Most parts into which a gap is divided.
const MOST_PARTS: usize = 8;

/// Integrates motions on the vectors of a level, no more than it has [lanes](crate::work::vectors::lanes_of), and writes
/// them to their slots.
pub fn integrate<R: Real>(set: MotionSet<R>, slots: &mut [Slots<R>], level: Level) {
    let zero = R::of(0.0);
    vectorized!(level, zero => integrate_lanes(set, slots, zero));
}

/// What belongs to the contact forces in a row.
struct Forces<'a, V> {
    /// The crest of X or Y in the gap, and that of all gaps so far.
    crest: V,
    so_far: V,
    /// The values at the ends of the gap and of its parts.
    values: &'a [V; MOST_PARTS + 1],
}

impl<V: Vector> Forces<'_, V> {
    #[inline(always)]
    fn add_to(&self, row: &mut Row<V>, direction: Direction) {
        let Forces { crest, so_far, values } = *self;
        let inside = &values[1..direction.parts() as usize];
        let first = match direction {
            Direction::Horizontal => {
                (row[MAGNITUDE], row[MAGNITUDE_SO_FAR]) = (crest, so_far);
                QUARTERS_H
            }
            Direction::Vertical => {
                (row[LEAST], row[LEAST_SO_FAR]) = (crest, so_far);
                EIGHTHS_V
            }
        };
        row[first..first + inside.len()].copy_from_slice(inside);
    }
}

#[inline(always)]
fn integrate_lanes<V: Vector>(
    set: MotionSet<V::Element>,
    slots: &mut [Slots<V::Element>],
    zero: V,
) {
    let MotionSet { variant, direction, record, starts } = set;
    let models: Vec<_> = starts.iter().map(|start| start.model).collect();
    let none = direction.no_crest(zero);
    let mut lanes = Lanes::new(Shared { variant, models: &models, record }, zero);
    lanes.spans.direction = Some(direction);
    let parts = direction.parts();
    let substeps: Vec<u32> = starts.iter().map(|start| start.cell.substeps).collect();
    let steps = gap_steps(parts, &substeps, zero);
    let by_quarters = by_quarters(parts, &substeps);
    load(&mut lanes, &set);
    let mut values = [zero; MOST_PARTS + 1];
    let (all, mut missed) = (zero.mask(u64::MAX), zero);
    // A block that lifts at once, at a jump, has no forces on record.
    let mut so_far = none;
    let mut gap = Gaps::at(direction.of(lanes.contact()));
    let mut first = gap.end(zero.mask(0), &lanes, direction);
    Forces { crest: none, so_far, values: &values }.add_to(&mut first, direction);
    let mut written = WrittenMotions::begin(slots, (direction, true), &first);
    let mut through = lanes.running();
    while through != 0 {
        gap.begin(all);
        values[0] = gap.now;
        lanes.spans.crest = none;
        let mut ended = 0;
        for GapStep { lanes: some, ends } in &steps {
            lanes.run_only(through & some & !ended);
            let [reached, over] = if ends.is_empty() {
                step(&mut lanes)
            } else {
                step_with_ends(&mut lanes, (direction, ends), gap.now, &mut values)
            };
            through &= reached | !some;
            ended |= over;
            gap.take(zero.mask(reached), lanes.spans.end);
        }
        values[parts as usize] = gap.now;
        if by_quarters != 0 {
            tell_others(&mut values, zero.mask(by_quarters));
        }
        let crest = lanes.spans.crest;
        let off = (kept_crest(direction, &values) - crest).abs();
        missed = V::select(zero.mask(through), missed.max(off), missed);
        so_far = match direction {
            Direction::Horizontal => so_far.max(crest),
            Direction::Vertical => so_far.min(crest),
        };
        let mut row = gap.end(zero.mask(through), &lanes, direction);
        Forces { crest, so_far, values: &values }.add_to(&mut row, direction);
        written.add(through, &row);
        through &= !ended;
    }
    written.end(|lane, magnitude| {
        missed.lane(lane) > direction.allowed(magnitude, starts[lane].model.gravity)
    });
}

/// The eighths of the gaps of some lanes that are interpolated from quarters.
#[inline(always)]
fn tell_others<V: Vector>(values: &mut [V; MOST_PARTS + 1], lanes: V::Mask) {
    for half in [0, 4] {
        let (start, mid, end) = (values[half], values[half + 2], values[half + 4]);
        let first = parabola(start, mid, end, start.like(0.25));
        let second = parabola(start, mid, end, start.like(0.75));
        values[half + 1] = V::select(lanes, first, values[half + 1]);
        values[half + 3] = V::select(lanes, second, values[half + 3]);
    }
}

/// Takes the running lanes over a step. The result is the lanes at the end of the step and the lanes that have ended,
/// one bit each.
#[inline(always)]
fn step<V: Vector>(lanes: &mut Lanes<V>) -> [u64; 2] {
    lanes.spans.count = lanes.spans.count.like(0.0);
    if !lanes.has_kinks() {
        return [lanes.running(), lanes.stand()];
    }
    let (mut reached, mut ended) = (0, 0);
    while lanes.running() != 0 {
        let over = lanes.advance();
        let through = V::bits(lanes.between_steps());
        reached |= through;
        ended |= over;
        lanes.leave_off(through | over);
    }
    [reached, ended]
}

/// The same for a step in which parts of a gap end: `values` are the values at these ends, and `now` is the value at
/// the start of the step.
#[inline(always)]
fn step_with_ends<V: Vector>(
    lanes: &mut Lanes<V>,
    (direction, ends): (Direction, &[PartEnds<V>]),
    now: V,
    values: &mut [V; MOST_PARTS + 1],
) -> [u64; 2] {
    let running = lanes.running();
    let (zero, one) = (now.like(0.0), now.like(1.0));
    let y0 = *lanes.motion();
    let h = lanes.step_length();
    let (start, end) = (lanes.ground(zero), lanes.ground(one));
    let mut grounds = [start; MOST_PARTS];
    for (ground, PartEnds { fraction, .. }) in grounds.iter_mut().zip(ends) {
        *ground = lanes.ground(*fraction);
    }
    let over = step(lanes);
    let whole = one.ge(lanes.spans.count);
    // The rates at both ends, if they are requested.
    let mut known = None;
    for (ends, ground) in ends.iter().zip(grounds) {
        let by_mid = ends.halfway & whole;
        let mut value = V::select(by_mid, lanes.spans.mid, now);
        let by_cubic = ends.lanes & !(by_mid | ends.at_start) & zero.mask(running);
        if V::any(by_cubic) {
            let y1 = *lanes.motion();
            let [k0, k1] = match known {
                Some(rates) => rates,
                None => [lanes.standing_rates(&y0, start), lanes.standing_rates(&y1, end)],
            };
            known = Some([k0, k1]);
            let motion = between([&y0, &y1], [&k0, &k1], h, ends.fraction);
            let found = direction.of(lanes.standing_rates(&motion, ground).contact());
            value = V::select(by_cubic, found, value);
        }
        let those = running & V::bits(ends.lanes);
        for (lane, &number) in ends.numbers.iter().enumerate() {
            if those >> lane & 1 == 1 {
                values[number].put(lane, value.lane(lane));
            }
        }
    }
    over
}

/// The motion at a fraction of a step, by the cubic polynomials between its ends.
#[inline(always)]
fn between<V: Vector>(
    [y0, y1]: [&Motion<V>; 2],
    [k0, k1]: [&Rates<V>; 2],
    h: V,
    fraction: V,
) -> Motion<V> {
    Motion {
        u: hermite(y0.u, h * k0.du, y1.u, h * k1.du, fraction),
        du: hermite(y0.du, h * k0.ddu, y1.du, h * k1.ddu, fraction),
        v: hermite(y0.v, h * k0.dv, y1.v, h * k1.dv, fraction),
        dv: hermite(y0.dv, h * k0.ddv, y1.dv, h * k1.ddv, fraction),
        z: hermite(y0.z, h * k0.dz, y1.z, h * k1.dz, fraction),
        ..*y0
    }
}

/// The largest |X| or the least Y of a gap, by parabolas through the values at the ends of its parts.
#[inline(always)]
fn kept_crest<V: Vector>(direction: Direction, values: &[V; MOST_PARTS + 1]) -> V {
    let all = values[0].mask(u64::MAX);
    let mut so_far = direction.no_crest(values[0]);
    for start in (0..direction.parts() as usize).step_by(2) {
        let span = [values[start], values[start + 1], values[start + 2]];
        so_far = direction.crest(all, so_far, span);
    }
    so_far
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::contact::bounded_motions;
    use crate::cells::contact::motions::LOWER;
    use crate::cells::contact::shared_motion::Start;
    use crate::cells::plan::Plan;
    use crate::model::isolation::Variant;
    use crate::scene::record::synthetic;
    use crate::scene::{Grid, Parameter, Range, Scene, SceneBuilder};
    use crate::work::vectors::lanes_of;

    /// The numbers of motions, quantity by quantity, with the contact forces or without them.
    fn numbers<R: Real>(set: MotionSet<R>, level: Level, forces: bool) -> Vec<Vec<Vec<R>>> {
        let fields = set.direction.fields(forces);
        let motion = |start: &Start<R>| vec![vec![R::of(0.0); start.samples()]; fields];
        let mut motions: Vec<Vec<Vec<R>>> = set.starts.iter().map(motion).collect();
        let slots = motions.iter_mut().map(|motion| motion.iter_mut().map(|of| &mut of[..]));
        let mut slots: Vec<Slots<R>> = slots.map(Iterator::collect).collect();
        match forces {
            true => integrate(set, &mut slots, level),
            false => bounded_motions::integrate(set, &mut slots, level),
        }
        motions
    }

    /// Lanes that wait, that have ended or that have no motion do not change the other lanes. Without contact forces no lane
    /// waits, and what is kept is the same.
    fn each_is_what_it_is_alone<R: Real>(scene: &Scene, direction: Direction) {
        let plan = Plan::new(scene, 0.01).unwrap();
        let record = plan.record::<R>();
        let alone = match direction {
            Direction::Horizontal => plan.without_vertical(),
            Direction::Vertical => plan.without_horizontal(),
        };
        let recorded = scene.excitation.record().is_some();
        let (clock, after) = if recorded { (&alone, 0) } else { (&plan, 40) };
        let grid = Grid::of(scene);
        let cases = (0..grid.len().min(lanes_of::<R>(Level::new()))).map(|cell| grid.case(cell));
        let starts: Vec<Start<R>> =
            cases.map(|case| Start::of(clock, &case, direction, after)).collect();
        let variant = Variant { certificate: false, ..alone.variant() };
        let (record, level) = (&record[..], Level::new());
        let of = |starts, forces| {
            numbers(MotionSet { variant, direction, record, starts }, level, forces)
        };
        let [together, bounded] = [true, false].map(|forces| of(&starts, forces));
        assert_eq!(together.len(), starts.len());
        for (number, motion) in together.iter().enumerate() {
            let [lone] = &of(&starts[number..=number], true)[..] else { panic!("one motion") };
            assert_eq!(starts[number].after, after);
            assert!(motion == lone, "{direction:?} {number}");
            let bounded = &bounded[number];
            assert!(
                motion[..bounded.len()] == bounded[..],
                "{direction:?} {number} without forces"
            );
            let (gaps, beyond) = (motion[LOWER].len() - 1, R::of(-1.0e30));
            let is_shared = motion[LOWER][..gaps].iter().all(|lower| *lower > beyond);
            assert!(is_shared, "{direction:?} {number} is shared");
        }
    }

    /// Under pulses of many lengths the lanes end one after the other.
    #[test]
    fn motions_under_pulses_are_those_of_each_alone() {
        let scene = SceneBuilder::object(1)
            .with(Parameter::TH, 1.75)
            .with(Parameter::TV, 0.75)
            .with(Parameter::AV, 2.0)
            .with(Parameter::AH, 5.0)
            .with(Parameter::Omega, Range::even(0.5, 12.0, 16))
            .check()
            .unwrap();
        for direction in [Direction::Horizontal, Direction::Vertical] {
            each_is_what_it_is_alone::<f32>(&scene, direction);
            each_is_what_it_is_alone::<f64>(&scene, direction);
        }
    }

    /// Stiff bases have many steps to a gap, and others few.
    #[test]
    fn motions_under_a_record_are_those_of_each_alone() {
        let scene = |parameter, from, to| {
            let other = if parameter == Parameter::TH { Parameter::TV } else { Parameter::TH };
            SceneBuilder::object(1)
                .with(parameter, Range::even(from, to, 15))
                .with(other, 1.0)
                .check_under_motion(synthetic::pair())
                .unwrap()
        };
        each_is_what_it_is_alone::<f32>(&scene(Parameter::TV, 0.03, 1.2), Direction::Vertical);
        each_is_what_it_is_alone::<f64>(&scene(Parameter::TV, 0.03, 1.2), Direction::Vertical);
        each_is_what_it_is_alone::<f32>(&scene(Parameter::TH, 0.3, 4.0), Direction::Horizontal);
        each_is_what_it_is_alone::<f64>(&scene(Parameter::TH, 0.3, 4.0), Direction::Horizontal);
    }
}
