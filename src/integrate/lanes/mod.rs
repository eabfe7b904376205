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
    /// Lanes that have a cell, a bit each.
    running: u64,
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

/// The lanes of a mask's bits.
#[inline(always)]
fn each(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        // Without a bit left there are 64 zeros.
        (bits != 0).then(|| {
            bits &= bits - 1;
            lane
        })
    })
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
        // The same number in all lanes.
        let number = |number: V::Element| zero.like(number.to_f64());
        Lanes {
            shared,
            lanes: (0..V::LANES).map(|_| idle()).collect(),
            running: 0,
            model: Model {
                left: one.left.map(number),
                right: one.right.map(number),
                height: number(one.height),
                mu_h: number(one.mu_h),
                mu_v: number(one.mu_v),
                gravity: number(one.gravity),
                inverse_mu_h: number(one.inverse_mu_h),
                inverse_mu_v: number(one.inverse_mu_v),
                least_arm: number(one.least_arm),
                topple_energy: number(one.topple_energy),
            },
            cell: Cell::<f32>::zeroed().map(|_| zero),
            corner: one.left.map(number),
            rocking: none,
            leg: Leg::new(zero),
            y: Motion::<f32>::zeroed().map(|_| zero),
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
            for lane in each(self.turn()) {
                self.store(lane);
                feed.done(&self.lanes[lane].job);
                self.running &= !(1 << lane);
                self.fill(lane, feed);
            }
        }
    }

    /// The numbers of all lanes' equations.
    #[inline(always)]
    fn equations(&self) -> Setting<'_, V> {
        let variant = self.shared.variant;
        Setting { variant, model: &self.model, cell: &self.cell, record: &[] }
    }
}
