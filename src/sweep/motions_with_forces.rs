//! Motions in full contact with the contact forces inside their gaps, as many motions at once as a vector has lanes.
//!
//! All lanes go through a gap together, and through each of its steps. A lane whose step is cut at kinks of the Bouc-Wen
//! law takes more turns, and one that has more steps to a gap takes more of them; the others wait.

use fearless_simd::{Level, Simd};

use super::bounded_motions::{Gaps, add, bounds};
use super::shared_motion::{Direction, MotionBatch, SampledMotion, samples};
use super::vectors::vectorized;
use crate::model::dynamics::{Contact, Rates};
use crate::model::excitation::Cell;
use crate::model::motion::Motion;
use crate::model::real::{Real, Vector};
use crate::stepping::extremes::parabola;
use crate::stepping::lanes::{Job, Lanes, Shared};
use crate::stepping::log::Listener;
use crate::stepping::rk4::hermite;
use crate::stepping::state::RUNNING;

/// Steps of a gap from which on eighths of it are taken from them; with fewer, its quarters tell them.
const STEPS_FOR_EIGHTHS: u32 = 8;
/// Most parts that a gap is kept in.
const MOST_PARTS: usize = 8;

/// Integrates motions, no more than [`at_once`](super::bounded_motions::at_once), on the vectors of a level.
pub fn sample<R: Real>(batch: MotionBatch<R>, level: Level) -> Vec<SampledMotion<R>> {
    let zero = R::of(0.0);
    let mut sampled = Vec::new();
    vectorized!(level, simd => sampled = integrate(batch, zero.lanes(simd)));
    sampled
}

/// X or Y in the spans that each lane has taken: a step is one span, or more where z or u' changed its sign in it.
struct Spans<V> {
    direction: Direction,
    /// Spans of the step.
    count: V,
    /// In the middle of the last span and at its end.
    mid: V,
    end: V,
    /// The largest magnitude, or the least, of the gap's spans.
    crest: V,
}

impl<V: Vector> Listener<V> for Spans<V> {
    const FEELS: bool = true;

    #[inline(always)]
    fn feel(&mut self, lanes: V::Mask, [start, mid, end]: [Contact<V>; 3]) {
        let direction = self.direction;
        let (start, mid, end) = (direction.of(start), direction.of(mid), direction.of(end));
        let one = start.like(1.0);
        self.count = V::select(lanes, self.count + one, self.count);
        self.mid = V::select(lanes, mid, self.mid);
        self.end = V::select(lanes, end, self.end);
        self.crest = direction.crest(lanes, self.crest, [start, mid, end]);
    }
}

type Motions<'a, V> = Lanes<'a, V, Spans<V>>;

/// Ends of parts of gaps in one step, at most one of each lane.
struct PartEnds<V: Vector> {
    /// The part's number, from the gap's start, for each lane.
    numbers: Vec<usize>,
    /// Lanes that have one.
    lanes: V::Mask,
    /// At the start of the step, or halfway.
    at_start: V::Mask,
    halfway: V::Mask,
    /// How much of the step is before it.
    fraction: V,
}

/// A step of gaps.
struct GapStep<V: Vector> {
    /// Lanes that have so many steps to a gap, a bit each.
    lanes: u64,
    /// The ends of parts in it.
    ends: Vec<PartEnds<V>>,
}

/// The steps of a gap, in which its parts end as the lanes have `substeps`.
fn gap_steps<V: Vector>(parts: u32, substeps: &[u32], zero: V) -> Vec<GapStep<V>> {
    let most = substeps.iter().copied().max().unwrap_or(0);
    let nowhere = || vec![Vec::new(); most as usize];
    let in_steps = substeps.iter().map(|&substeps| {
        let mut ends = nowhere();
        for part in
            (parts_apart(parts, substeps)..parts).step_by(parts_apart(parts, substeps) as usize)
        {
            let (step, rest) = (part * substeps / parts, part * substeps % parts);
            ends[step as usize].push((part, rest));
        }
        ends
    });
    let in_steps: Vec<Vec<Vec<(u32, u32)>>> = in_steps.collect();
    let step = |step: usize| {
        let count = in_steps.iter().map(|ends| ends[step].len()).max().unwrap_or(0);
        let some = |number: usize| {
            let mut ends = PartEnds {
                numbers: vec![0; V::LANES],
                lanes: zero.mask(0),
                at_start: zero.mask(0),
                halfway: zero.mask(0),
                fraction: zero,
            };
            for (lane, in_steps) in in_steps.iter().enumerate() {
                let Some(&(part, rest)) = in_steps[step].get(number) else { continue };
                let bit = zero.mask(1 << lane);
                ends.numbers[lane] = part as usize;
                ends.lanes = ends.lanes | bit;
                if rest == 0 {
                    ends.at_start = ends.at_start | bit;
                }
                if 2 * rest == parts {
                    ends.halfway = ends.halfway | bit;
                }
                let fraction = f64::from(rest) / f64::from(parts);
                ends.fraction.put(lane, V::Element::of(fraction));
            }
            ends
        };
        let has = |(lane, &substeps): (usize, &u32)| u64::from(substeps as usize > step) << lane;
        let lanes = substeps.iter().enumerate().map(has).fold(0, |all, bit| all | bit);
        GapStep { lanes, ends: (0..count).map(some).collect() }
    };
    (0..most as usize).map(step).collect()
}

/// From one part whose end is taken from the steps to the next. With few steps to a gap every other part is told by those
/// beside it.
fn parts_apart(parts: u32, substeps: u32) -> u32 {
    if substeps < STEPS_FOR_EIGHTHS { parts / 4 } else { 1 }
}

#[inline(always)]
fn integrate<V: Vector>(batch: MotionBatch<V::Element>, zero: V) -> Vec<SampledMotion<V::Element>> {
    let MotionBatch { variant, direction, record, starts } = batch;
    let models: Vec<_> = starts.iter().map(|start| start.model).collect();
    let spans =
        Spans { direction, count: zero, mid: zero, end: zero, crest: direction.no_crest(zero) };
    let mut lanes = Lanes::new(Shared { variant, models: &models, record }, zero, spans);
    let parts = direction.parts();
    let substeps: Vec<u32> = starts.iter().map(|start| start.cell.substeps).collect();
    let steps = gap_steps(parts, &substeps, zero);
    let told = |&substeps: &u32| parts_apart(parts, substeps) == 1;
    let told = substeps
        .iter()
        .enumerate()
        .fold(0, |all, (lane, substeps)| all | u64::from(told(substeps)) << lane);
    let mut sampled = Vec::with_capacity(starts.len());
    for (number, start) in starts.iter().enumerate() {
        sampled.push(SampledMotion::of(samples(&start.cell), parts));
        // It ends with the excitation.
        let cell = Cell { body: number as u32, steps: start.cell.steps_forced, ..start.cell };
        if start.state.status == RUNNING && cell.steps > 0 {
            lanes.load(number, Job { number, cell, state: start.state });
        }
    }
    let mut values = [zero; MOST_PARTS + 1];
    let mut now = direction.of(lanes.contact());
    // A block that lifts at once, at a jump, has no forces on record.
    let (mut lowest, mut missed) = (Direction::Vertical.no_crest(zero), zero);
    for (lane, sampled) in sampled.iter_mut().enumerate() {
        add(sampled, &lanes, lane, direction, [now.lane(lane), lowest.lane(lane)]);
    }
    let mut through = lanes.running();
    while through != 0 {
        let mut gap = Gaps { now, least: now, most: now, change: zero };
        values[0] = now;
        lanes.log.crest = direction.no_crest(zero);
        let mut ended = 0;
        for GapStep { lanes: some, ends } in &steps {
            lanes.leave_off(!0);
            lanes.go_on(through & some & !ended);
            let [reached, over] = step(&mut lanes, ends, gap.now, &mut values);
            through &= reached | !some;
            ended |= over;
            let next = V::select(zero.mask(reached), lanes.log.end, gap.now);
            gap.change = gap.change.max((next - gap.now).abs());
            gap.least = gap.least.min(next);
            gap.most = gap.most.max(next);
            gap.now = next;
        }
        now = gap.now;
        values[parts as usize] = now;
        if parts == 8 && told != !0 {
            tell_others(&mut values, zero.mask(!told));
        }
        let crest = lanes.log.crest;
        let off = (kept_crest(direction, &values) - crest).abs();
        missed = V::select(zero.mask(through), missed.max(off), missed);
        lowest = lowest.min(crest);
        let [least, most] = bounds(&gap);
        for (lane, sampled) in sampled.iter_mut().enumerate() {
            if through >> lane & 1 == 1 {
                sampled.least.push(least.lane(lane));
                sampled.most.push(most.lane(lane));
                sampled.crest.push(crest.lane(lane));
                for (kept, value) in sampled.inside.iter_mut().zip(&values[1..]) {
                    kept.push(value.lane(lane));
                }
                add(sampled, &lanes, lane, direction, [now.lane(lane), lowest.lane(lane)]);
            }
        }
        through &= !ended;
    }
    let all = sampled.into_iter().zip(starts).enumerate();
    let finished = all.map(|(lane, (sampled, start))| {
        let allowed = direction.allowed(&sampled, start.model.gravity);
        sampled.filled(samples(&start.cell)).finish(missed.lane(lane) > allowed)
    });
    finished.collect()
}

/// Eighths of some lanes' gaps that quarters tell.
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

/// Takes the running lanes over a step, in which parts of a gap end: `values` at these ends. The lanes that
/// are at the step's end, and those that go on no more, a bit each.
#[inline(always)]
fn step<V: Vector>(
    lanes: &mut Motions<V>,
    ends: &[PartEnds<V>],
    now: V,
    values: &mut [V; MOST_PARTS + 1],
) -> [u64; 2] {
    let (direction, all) = (lanes.log.direction, lanes.running());
    let (zero, one) = (now.like(0.0), now.like(1.0));
    let y0 = *lanes.motion();
    let h = lanes.step_length();
    let (start, end) = (lanes.ground(zero), lanes.ground(one));
    let mut grounds = [start; MOST_PARTS];
    for (ground, PartEnds { fraction, .. }) in grounds.iter_mut().zip(ends) {
        *ground = lanes.ground(*fraction);
    }
    lanes.log.count = zero;
    let (mut reached, mut ended) = (0, 0);
    if lanes.yields() {
        while lanes.running() != 0 {
            let over = lanes.advance();
            let through = V::bits(lanes.between_steps());
            reached |= through;
            ended |= over;
            lanes.leave_off(through | over);
        }
    } else {
        reached = all;
        ended = lanes.stand();
    }
    let whole = one.ge(lanes.log.count);
    // The rates at both ends, where they are asked for.
    let mut known = None;
    for (ends, ground) in ends.iter().zip(grounds) {
        let by_mid = ends.halfway & whole;
        let mut value = V::select(by_mid, lanes.log.mid, now);
        let by_cubic = ends.lanes & !(by_mid | ends.at_start) & zero.mask(all);
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
        for (lane, &number) in ends.numbers.iter().enumerate() {
            if all & V::bits(ends.lanes) >> lane & 1 == 1 {
                values[number].put(lane, value.lane(lane));
            }
        }
    }
    [reached, ended]
}

/// The motion at a fraction of a step, by the cubics through its ends.
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

/// The largest |X| or the least Y of a gap, by parabolas through its parts' ends.
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
