//! The fixed-step method on vectors, a cell a lane.
//!
//! Every turn each lane makes one Runge-Kutta trial of its own: a step, what is left of one after a
//! switch, or a try at where a switch is. Masks decide what each made of it, so that no lane waits
//! for another's switch; a lane whose cell is done takes the next. The equations are those of
//! [`model`](crate::model), switches and proofs those of the scalar path, a lane at a time.

mod crossing;
mod cubic;
mod judge;
pub mod leg;
mod seek;
mod seen;
mod service;

use bytemuck::Zeroable;

use self::leg::Leg;
use self::seek::Seek;
use self::seen::Seen;
use super::state::State;
use crate::model::Setting;
use crate::model::block::{Corner, Model};
use crate::model::dynamics::{Motion, Rates};
use crate::model::excitation::{Cell, Ground};
use crate::model::isolation::Variant;
use crate::model::real::Real;
use crate::model::vector::Vector;

/// A cell that a lane is on.
#[derive(Debug, Clone, Copy)]
pub struct Job<R> {
    /// Its number in the queue.
    pub number: usize,
    /// Its numbers.
    pub cell: Cell<R>,
    /// Its state when it began, and when it is done.
    pub state: State<R>,
}

/// Where lanes get their cells, and where these go.
pub trait Feed<R> {
    /// The next cell, if there is one.
    fn next(&mut self) -> Option<Job<R>>;

    /// Takes a cell that has ended.
    fn done(&mut self, job: &Job<R>);
}

/// A lane's own.
struct Lane<R> {
    job: Job<R>,
    /// First step of its leg.
    leg_start: u32,
}

/// What all cells of a sweep share.
#[derive(Clone, Copy)]
pub struct Shared<'a, R> {
    /// What is switched on.
    pub variant: Variant,
    /// The block and its base.
    pub model: &'a Model<R>,
    /// The record.
    pub record: &'a [Ground<R>],
}

impl<'a, R> Shared<'a, R> {
    /// The numbers of a cell's equations.
    #[inline(always)]
    fn setting<'b>(&self, cell: &'b Cell<R>) -> Setting<'b, R>
    where
        'a: 'b,
    {
        Setting { variant: self.variant, model: self.model, cell, record: self.record }
    }
}

/// As many cells as a vector has lanes.
pub struct Lanes<'a, V: Vector> {
    shared: Shared<'a, V::Element>,
    lanes: Vec<Lane<V::Element>>,
    /// Lanes that have a cell, a bit each, and as a mask.
    running: u64,
    alive: V::Mask,
    model: Model<V>,
    cell: Cell<V>,
    corner: Corner<V>,
    /// Lanes whose block rocks.
    rocking: V::Mask,
    leg: Leg<V>,
    /// The motion where the span begins, and its rates.
    y: Motion<V>,
    k1: Rates<V>,
    /// Fraction of the step already done.
    start: V,
    /// Fraction of the step that is looked at.
    span: V,
    /// The span ends before the step does.
    cut: V::Mask,
    /// Switches and kinks in the step so far.
    events: V,
    seek: Seek<V>,
    /// What is looked for: an overturning, not an impact; an uplift about the left corner, not the
    /// right; a zero of z, not of du.
    overturning: V::Mask,
    left: V::Mask,
    of_z: V::Mask,
    /// Lanes whose phase or ground has changed: `k1` is not theirs.
    fresh: V::Mask,
    seen: Seen<V>,
}

/// The same number in all lanes.
#[inline(always)]
fn all<V: Vector>(zero: V, number: V::Element) -> V {
    zero.like(number.to_f64())
}

#[inline(always)]
fn corner_of<V: Vector>(zero: V, corner: &Corner<V::Element>) -> Corner<V> {
    Corner {
        side: all(zero, corner.side),
        arm: all(zero, corner.arm),
        inertia: all(zero, corner.inertia),
        overturn: all(zero, corner.overturn),
        eta_phi: all(zero, corner.eta_phi),
        eta_u: all(zero, corner.eta_u),
        eta_v: all(zero, corner.eta_v),
    }
}

impl<'a, V: Vector> Lanes<'a, V> {
    /// Lanes without cells; `zero` tells the kind of vector.
    #[inline(always)]
    pub fn new(shared: Shared<'a, V::Element>, zero: V) -> Lanes<'a, V> {
        let one = shared.model;
        let idle = || Lane {
            job: Job { number: 0, cell: Cell::zeroed(), state: State::zeroed() },
            leg_start: 0,
        };
        let none = zero.mask(0);
        Lanes {
            shared,
            lanes: (0..V::LANES).map(|_| idle()).collect(),
            running: 0,
            alive: none,
            model: Model {
                left: corner_of(zero, &one.left),
                right: corner_of(zero, &one.right),
                height: all(zero, one.height),
                mu_h: all(zero, one.mu_h),
                mu_v: all(zero, one.mu_v),
                gravity: all(zero, one.gravity),
                inverse_mu_h: all(zero, one.inverse_mu_h),
                inverse_mu_v: all(zero, one.inverse_mu_v),
                least_arm: all(zero, one.least_arm),
                topple_energy: all(zero, one.topple_energy),
            },
            cell: Cell {
                post_yield: zero,
                hysteretic: zero,
                damping_h: zero,
                inverse_yield: zero,
                stiffness_v: zero,
                damping_v: zero,
                amplitude_h: zero,
                amplitude_v: zero,
                phase_step: zero,
                step_forced: zero,
                step_free: zero,
                rest_speed: zero,
                yield_energy: zero,
                deflection: zero,
                reach_h: zero,
                reach_v: zero,
                steps_forced: 0,
                steps: 0,
                substeps: 0,
                padding: 0,
            },
            corner: corner_of(zero, &one.left),
            rocking: none,
            leg: Leg::new(zero),
            y: Motion { u: zero, du: zero, v: zero, dv: zero, z: zero, phi: zero, dphi: zero },
            k1: Rates {
                du: zero,
                ddu: zero,
                dv: zero,
                ddv: zero,
                dz: zero,
                dphi: zero,
                ddphi: zero,
                normal: zero,
                shear: zero,
            },
            start: zero,
            span: zero.like(1.0),
            cut: none,
            events: zero,
            seek: Seek::new(zero),
            overturning: none,
            left: none,
            of_z: none,
            fresh: none,
            seen: Seen::new(zero),
        }
    }

    /// Runs all cells of a feed.
    #[inline(always)]
    pub fn run(&mut self, feed: &mut impl Feed<V::Element>) {
        for lane in 0..V::LANES {
            self.fill(lane, feed);
        }
        while self.running != 0 {
            let mut ended = self.turn();
            while ended != 0 {
                let lane = ended.trailing_zeros() as usize;
                ended &= ended - 1;
                self.store(lane);
                feed.done(&self.lanes[lane].job);
                self.running &= !(1 << lane);
                self.fill(lane, feed);
            }
        }
    }
}
