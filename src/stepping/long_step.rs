//! Long steps of blocks that stand: the steps of a cell are as short as the rocking of its block requires, and in full
//! contact longer ones are as exact.
//!
//! In full contact u and v are not coupled, (5). u takes a step of Runge-Kutta, as long as its own period and law allow. The law
//! of v is linear, v'' + 2 xi omega v' + omega^2 v = -a(t), and so is the ground's acceleration a(t) between two samples of a
//! record. So v and v' change in a step by a matrix times v, v' and a at the start and at the end of the step, which is exact.
//! The matrix is of the *changes*: a base that swings slowly moves in a step by far less than a/omega^2, and a matrix with a 1 on
//! its diagonal, or a motion in proportion to a/omega^2, would lose the changes in the rounding of f32.
//!
//! The guards are those of a [turn](super::turn). In a step in which one of them happens the cell does not move: it goes on by
//! turns, in its own steps.

use super::extremes::bend;
use super::guards::crosses;
use super::lanes::Lanes;
use super::span::{YIELD_LIMIT, settling_rate};
use super::state::is_finite;
use super::turn::select_motion;
use crate::model::CellEquations;
use crate::model::block::Corner;
use crate::model::dynamics::{Contact, uplift_moment};
use crate::model::excitation::Ground;
use crate::model::isolation::{hysteretic_rate, support};
use crate::model::layout::reals;
use crate::model::motion::Motion;
use crate::model::real::{Real, Vector};

/// The fewest long steps in a period of v: the cubics through both ends of a step miss its force by (2 pi/32)^4/384 of its
/// amplitude, and the parabola through the start, the middle and the end by 6e-5.
pub const LONG_STEPS_A_PERIOD: f64 = 32.0;

/// The changes of v and v' over a step, from v, v' and the ground's acceleration at both ends of the step, to which each is
/// proportional.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing<R> {
    /// Of v from v at the start.
    pub v_from_v: R,
    /// Of v from v', s.
    pub v_from_dv: R,
    /// Of v from the acceleration at the start, s^2.
    pub v_from_start: R,
    /// Of v from the acceleration at the end, s^2.
    pub v_from_end: R,
    /// Of v' from v, 1/s.
    pub dv_from_v: R,
    /// Of v' from v'.
    pub dv_from_dv: R,
    /// Of v' from the acceleration at the start, s.
    pub dv_from_start: R,
    /// Of v' from the acceleration at the end, s.
    pub dv_from_end: R,
}

reals!(
    Swing, 8, v_from_v v_from_dv v_from_start v_from_end dv_from_v dv_from_dv dv_from_start dv_from_end
);

/// v after a unit impulse at the start of a time, and its first and second integral over this time.
#[derive(Debug, Clone, Copy)]
struct Impulse {
    /// v, s.
    response: f64,
    /// Its integral, s^2.
    once: f64,
    /// The integral of that, s^3.
    twice: f64,
}

/// Terms of the series of an impulse: the last one is below the rounding of f64 where the arguments are at most 1/2.
const TERMS: i32 = 20;
/// The most doublings: those of a time of 2^32 periods.
const DOUBLINGS: i32 = 32;

impl Impulse {
    /// After `time` s with omega_v^2 and 2 xi_v omega_v: by a series over a time that is short enough, which is then doubled.
    fn over(time: f64, stiffness: f64, damping: f64) -> Impulse {
        let mut doublings = 0;
        let mut short = time;
        let is_long = |time: f64| damping * time > 0.5 || stiffness * time * time > 0.5;
        while is_long(short) && doublings < DOUBLINGS {
            short *= 0.5;
            doublings += 1;
        }
        // The derivatives of the response at the start, times powers of the time: g'' = -2 xi omega g' - omega^2 g.
        let (mut before, mut term) = (0.0, 1.0);
        let (mut factorial, mut sums) = (1.0, [0.0; 3]);
        for n in 1..=TERMS {
            let n = f64::from(n);
            factorial *= n;
            let share = term / factorial;
            sums[0] += share;
            sums[1] += share / (n + 1.0);
            sums[2] += share / ((n + 1.0) * (n + 2.0));
            (before, term) = (term, -damping * short * term - stiffness * short * short * before);
        }
        let [response, once, twice] = sums;
        let mut impulse = Impulse {
            response: short * response,
            once: short * short * once,
            twice: short * short * short * twice,
        };
        for _ in 0..doublings {
            let Impulse { response, once, twice } = impulse;
            let speed = 1.0 - stiffness * once - damping * response;
            // The motion goes on from v and v' at half of the time.
            let from_v = [response + damping * once, once + damping * twice];
            impulse = Impulse {
                response: response * (speed + damping * response + speed),
                once: once + response * from_v[0] + speed * once,
                twice: twice + short * once + response * from_v[1] + speed * twice,
            };
            short *= 2.0;
        }
        impulse
    }
}

impl<R: Real> Swing<R> {
    /// That of a base with omega_v^2 and 2 xi_v omega_v, both zero where it does not move vertically, over `time` s.
    pub fn over(time: f64, stiffness: f64, damping: f64) -> Swing<R> {
        let Impulse { response, once, twice } = Impulse::over(time, stiffness, damping);
        // The share of the acceleration at the end grows evenly from 0 to 1.
        let (v_from_end, dv_from_end) = (-twice / time, -once / time);
        Swing {
            v_from_v: R::of(-stiffness * once),
            v_from_dv: R::of(response),
            v_from_start: R::of(-once - v_from_end),
            v_from_end: R::of(v_from_end),
            dv_from_v: R::of(-stiffness * response),
            dv_from_dv: R::of(-stiffness * once - damping * response),
            dv_from_start: R::of(-response - dv_from_end),
            dv_from_end: R::of(dv_from_end),
        }
    }
}

/// The long steps of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LongSteps<R> {
    /// The number of its own steps in one.
    pub steps: R,
    /// The motion of v over a long step.
    pub whole: Swing<R>,
    /// The same over the last step in a gap, which may be shorter.
    pub last: Swing<R>,
}

impl<R: Real> LongSteps<R> {
    /// Those of a cell with `substeps` steps of `step` seconds in a gap, of which u alone requires `substeps_h`, on a
    /// base with omega_v^2 and 2 xi_v omega_v.
    pub fn of(
        step: f64,
        [substeps, substeps_h]: [u32; 2],
        [stiffness, damping]: [f64; 2],
    ) -> LongSteps<R> {
        let periods = f64::from(substeps) * step * stiffness.sqrt() / std::f64::consts::TAU;
        // `as` saturates; no number of steps is that large.
        let least = substeps_h.max((LONG_STEPS_A_PERIOD * periods).ceil() as u32);
        let steps = (substeps / least.max(1)).max(1);
        let over = |steps: u32| Swing::over(f64::from(steps) * step, stiffness, damping);
        let whole = over(steps);
        let last = match substeps % steps {
            0 => whole,
            rest => over(rest),
        };
        LongSteps { steps: R::of(f64::from(steps)), whole, last }
    }
}

impl<V: Vector> LongSteps<V> {
    /// No long steps in any lane.
    #[inline(always)]
    pub fn none(zero: V) -> LongSteps<V> {
        let swing = Swing {
            v_from_v: zero,
            v_from_dv: zero,
            v_from_start: zero,
            v_from_end: zero,
            dv_from_v: zero,
            dv_from_dv: zero,
            dv_from_start: zero,
            dv_from_end: zero,
        };
        LongSteps { steps: zero.like(1.0), whole: swing, last: swing }
    }

    /// Puts the long steps of a cell on a lane.
    #[inline(always)]
    pub fn put(&mut self, lane: usize, of: &LongSteps<V::Element>) {
        self.steps.put(lane, of.steps);
        for (to, from) in self.whole.reals_mut().into_iter().zip(of.whole.reals()) {
            to.put(lane, from);
        }
        for (to, from) in self.last.reals_mut().into_iter().zip(of.last.reals()) {
            to.put(lane, from);
        }
    }
}

/// The rates of the horizontal motion: u', u'' and z'.
#[inline(always)]
fn rates_h<V: Vector>(set: &CellEquations<V>, y: &Motion<V>, ground: Ground<V>) -> [V; 3] {
    let mut dz = y.z.like(0.0);
    if set.variant.yields {
        dz = hysteretic_rate(set, y);
    }
    [y.du, support(set, y, ground).f_h - ground.h, dz]
}

/// The motion after a time `h` at these rates.
#[inline(always)]
fn shift_h<V: Vector>(y: &Motion<V>, [du, ddu, dz]: [V; 3], h: V) -> Motion<V> {
    Motion { u: h.mul_add(du, y.u), du: h.mul_add(ddu, y.du), z: h.mul_add(dz, y.z), ..*y }
}

/// A step of `h` seconds of the horizontal motion, from its rates at the start.
#[inline(always)]
fn step_h<V: Vector>(
    set: &CellEquations<V>,
    y: &Motion<V>,
    k1: [V; 3],
    h: V,
    [mid, end]: [Ground<V>; 2],
) -> Motion<V> {
    let (two, half) = (h.like(2.0), h.like(0.5) * h);
    let k2 = rates_h(set, &shift_h(y, k1, half), mid);
    let k3 = rates_h(set, &shift_h(y, k2, half), mid);
    let k4 = rates_h(set, &shift_h(y, k3, h), end);
    let sixth = h.like(1.0 / 6.0) * h;
    let mut mean = k1;
    for (k, mean) in mean.iter_mut().enumerate() {
        *mean = two.mul_add(k2[k] + k3[k], k1[k] + k4[k]);
    }
    shift_h(y, mean, sixth)
}

/// v and v' after a step from `y`, under these accelerations of the ground at its ends.
#[inline(always)]
fn step_v<V: Vector>(swing: &Swing<V>, y: &Motion<V>, [start, end]: [V; 2]) -> [V; 2] {
    let change = |from_v: V, from_dv: V, from_start: V, from_end: V| {
        let by_ground = from_start.mul_add(start, from_end * end);
        from_dv.mul_add(y.dv, from_v.mul_add(y.v, by_ground))
    };
    let Swing { v_from_v, v_from_dv, v_from_start, v_from_end, .. } = *swing;
    let Swing { dv_from_v, dv_from_dv, dv_from_start, dv_from_end, .. } = *swing;
    [
        y.v + change(v_from_v, v_from_dv, v_from_start, v_from_end),
        y.dv + change(dv_from_v, dv_from_dv, dv_from_start, dv_from_end),
    ]
}

/// The lanes in which the block does not lift about a corner, by the parabola through its moments (14).
#[inline(always)]
fn stands<V: Vector>(
    set: &CellEquations<V>,
    corner: &Corner<V>,
    [start, mid, end]: &[Contact<V>; 3],
) -> V::Mask {
    let start = uplift_moment(set, corner, *start);
    let mid = uplift_moment(set, corner, *mid);
    let end = uplift_moment(set, corner, *end);
    let most = start.max(mid).max(end) + bend(start, mid, end);
    most.like(0.0).gt(most)
}

impl<V: Vector> Lanes<'_, V> {
    /// Takes a long step in every lane in which no guard happens. All lanes are between two steps under a record, and
    /// their blocks stand. The result is the lanes that have moved, and those whose cell has ended, one bit each.
    #[inline(never)]
    pub(super) fn stand_long(&mut self, long: &LongSteps<V>) -> [u64; 2] {
        self.start.with(
            #[inline(always)]
            || self.stand_long_lanes(long),
        )
    }

    #[inline(always)]
    fn stand_long_lanes(&mut self, long: &LongSteps<V>) -> [u64; 2] {
        let (zero, one, half) = (self.start.like(0.0), self.start.like(1.0), self.start.like(0.5));
        let eighth = zero.like(0.125);
        let left = self.forcing.steps - self.forcing.done;
        let ends = long.steps.ge(left);
        let steps = V::select(ends, left, long.steps);
        let h = steps * self.forcing.step;
        let (start, mid, end) = (self.ground(zero), self.ground(half * steps), self.ground(steps));
        let set = self.equations();
        let (variant, asked, y) = (set.variant, set.variant.asked, &self.y);
        let mut moves = zero.mask(self.running);
        // Both ends of the step, and the motion halfway on the cubics through them.
        let (mut y1, mut halfway) = (*y, *y);
        if variant.isolated_v {
            let swing = long.last.zip(&long.whole, |last, whole| V::select(ends, last, whole));
            [y1.v, y1.dv] = step_v(&swing, y, [start.v, end.v]);
        }
        if variant.isolated_h {
            let k1 = rates_h(&set, y, start);
            y1 = step_h(&set, &y1, k1, h, [mid, end]);
            if variant.kinks {
                let settling = settling_rate(&set, y) * h;
                let kinked = crosses(y.du, y1.du) | crosses(y.z, y1.z);
                moves = moves & one.like(YIELD_LIMIT).ge(settling) & !kinked;
            }
            let [du, ddu, dz] = rates_h(&set, &y1, end);
            let lean = eighth * h;
            halfway.u = half.mul_add(y.u + y1.u, lean * (k1[0] - du));
            halfway.du = half.mul_add(y.du + y1.du, lean * (k1[1] - ddu));
            halfway.z = half.mul_add(y.z + y1.z, lean * (k1[2] - dz));
        }
        let first = support(&set, y, start);
        let last = support(&set, &y1, end);
        if variant.isolated_v {
            let lean = eighth * h;
            let less = (first.f_v - start.v) - (last.f_v - end.v);
            halfway.v = half.mul_add(y.v + y1.v, lean * (y.dv - y1.dv));
            halfway.dv = half.mul_add(y.dv + y1.dv, lean * less);
        }
        let middle = support(&set, &halfway, mid);
        let contacts = [
            Contact { shear: first.f_h, normal: first.f_v },
            Contact { shear: middle.f_h, normal: middle.f_v },
            Contact { shear: last.f_h, normal: last.f_v },
        ];
        moves = moves & stands(&set, &self.model.left, &contacts);
        moves = moves & stands(&set, &self.model.right, &contacts) & is_finite(&y1);
        if !V::any(moves) {
            return [0; 2];
        }
        let stand = (zero.mask(0), self.corner.side);
        self.extremes.update_motion(asked, moves, stand, &self.y, &y1, h);
        if asked.forces {
            let [start, mid, end] = contacts;
            self.extremes.update_contact(moves, start, mid, end);
        }
        self.y = select_motion(moves, &y1, &self.y);
        self.forcing.done = V::select(moves, self.forcing.done + steps, self.forcing.done);
        let left = V::bits(self.end_gaps(moves)) & self.running;
        let ended = if left == 0 { 0 } else { self.end_segments_and_cells(left, 0, 0, 0) };
        [V::bits(moves), ended]
    }
}
