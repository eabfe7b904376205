//! Where a span ends before anything is searched for. Twin of `shaders/span.wgsl`.

use crate::model::dynamics::Rates;
use crate::model::real::Vector;

use super::lanes::Lanes;
use super::log::Listener;

/// The most times itself that z of (11) may settle by in a span: RK4 is stable to 2.79.
pub const YIELD_LIMIT: f64 = 2.0;

/// Share of itself by which a span is longer than the way to the impact that it is cut for, so that
/// the impact is in it: what the rates leave out is mostly less.
pub const BEYOND: f64 = 5.0e-4;

impl<V: Vector, L: Listener<V::Element>> Lanes<'_, V, L> {
    /// Spans begin: what is left of the step. Where z would settle by more than the method bears they
    /// end early, and where the block is about to land they end there, as near as its rates tell.
    #[inline(always)]
    pub(super) fn begin_spans(&mut self, whole: V::Mask, k1: &Rates<V>) {
        let (zero, one) = (self.start.like(0.0), self.start.like(1.0));
        let (half, two) = (self.start.like(0.5), self.start.like(2.0));
        let step = self.forcing.step;
        let rest = one - self.start;
        self.span = V::select(whole, rest, self.span);
        self.cut = self.cut & !whole;
        if self.shared.variant.kinks {
            // z of (11) settles at the rate n |u'|/u_y.
            let n = one.like(f64::from(self.shared.variant.bouc_wen_n));
            let settling = n * self.y.du.abs() * self.cell.inverse_yield * step;
            let limit = one.like(YIELD_LIMIT);
            let long = whole & (settling * rest).gt(limit);
            if V::any(long) {
                self.span = V::select(long, limit / settling, self.span);
                self.cut = self.cut | long;
            }
        }
        // phi + d s + a s^2/2 after the fraction s of a step.
        let side = self.corner.side;
        let phi = side * self.y.phi;
        let d = side * self.y.dphi * step;
        let a = side * k1.ddphi * step * step;
        let end = self.span.mul_add((half * a).mul_add(self.span, d), phi);
        let lands = whole & self.rocking & zero.gt(end);
        if V::any(lands) {
            let root = (d * d - two * a * phi).max(zero).sqrt();
            let falls = zero.gt(d);
            let at = V::select(falls, two * phi, -(d + root)) / V::select(falls, root - d, a);
            let at = at * one.like(1.0 + BEYOND);
            let lands = lands & at.gt(zero) & self.span.gt(at);
            self.span = V::select(lands, at, self.span);
            self.cut = self.cut | lands;
        }
    }
}
