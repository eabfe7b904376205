//! A block that stands, on a base that does not yield: steps in which no guard can happen, so that no
//! root is searched for. The same result as [`turn`](super::turn) at less cost.

use super::extremes::{peak, range};
use super::forcing::Forcing;
use super::rk4::rk4;
use super::state::State;
use crate::model::CellEquations;
use crate::model::block::{Corner, FULL_CONTACT, pivot};
use crate::model::dynamics::{Contact, rates};
use crate::model::isolation::support;
use crate::model::motion::Motion;
use crate::model::real::Real;

/// A cell in full contact under excitation.
pub struct Standing<'a, R: Real> {
    set: &'a CellEquations<'a, R>,
    corner: Corner<R>,
    forcing: Forcing<R>,
    /// The step that it is at.
    pub step: u32,
    /// Its motion there.
    pub motion: Motion<R>,
    /// Largest |u| so far, m.
    pub max_u: R,
    /// Least and largest v so far, m.
    pub range_v: [R; 2],
}

impl<'a, R: Real> Standing<'a, R> {
    /// A cell at a state, under excitation.
    pub fn new(set: &'a CellEquations<'a, R>, state: &State<R>) -> Standing<'a, R> {
        let mut forcing = Forcing::new(R::of(0.0));
        forcing.begin(0, set, state.step, false);
        Standing {
            set,
            corner: pivot(set.model, FULL_CONTACT),
            forcing,
            step: state.step,
            motion: state.motion,
            max_u: state.max_u,
            range_v: [state.least_v, state.most_v],
        }
    }

    /// Takes the next step, which must be one under excitation: the contact forces at its start, in its
    /// middle and at its end.
    #[inline(always)]
    pub fn step(&mut self) -> [Contact<R>; 3] {
        let set = self.set;
        if self.forcing.done >= self.forcing.steps {
            self.forcing.begin(0, set, self.step, true);
        }
        let at = |fraction: f64| self.forcing.ground(set.variant, set.cell, R::of(fraction));
        let (start, mid, end) = (at(0.0), at(0.5), at(1.0));
        let (y, h) = (self.motion, self.forcing.step);
        let k1 = rates(set, &self.corner, false, &y, start);
        let stepped = rk4(set, &self.corner, false, &y, &k1, h, [mid, end]);
        let y1 = stepped.y;
        let base = support(set, &y1, end);
        self.max_u = peak(true, self.max_u, y.u, y.du, y1.u, y1.du, h);
        self.range_v = range(true, self.range_v, y.v, y.dv, y1.v, y1.dv, h);
        self.motion = y1;
        self.step += 1;
        self.forcing.done = self.forcing.done + R::of(1.0);
        [k1.contact(), stepped.mid, Contact { shear: base.f_h, normal: base.f_v }]
    }
}
