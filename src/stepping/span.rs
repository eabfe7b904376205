//! The end of a span before any search for a root: the end of the step, the limit of stability, or an estimated
//! impact. Twin of `shaders/span.wgsl`.

use crate::model::CellEquations;
use crate::model::dynamics::Rates;
use crate::model::motion::Motion;
use crate::model::real::Vector;

use super::lanes::Lanes;

/// The longest span over the relaxation time u_y/(n |u'|) of z in (11): RK4 is stable up to 2.79.
pub const YIELD_LIMIT: f64 = 2.0;

/// The longest span against an end stop, or on a spring that hardens, times the rate of the motion there: 63 spans in
/// a period.
pub const STIFF_LIMIT: f64 = 0.1;

/// The share by which a span that is cut for an impact is longer than the estimated time to the impact, so that the
/// impact is inside it: the error of the estimate is mostly smaller.
pub const BEYOND: f64 = 5.0e-4;

/// The rate n |u'|/u_y at which z of (11) relaxes, 1/s.
#[inline(always)]
pub(super) fn settling_rate<V: Vector>(set: &CellEquations<V>, y: &Motion<V>) -> V {
    let n = y.du.like(f64::from(set.variant.bouc_wen_n));
    n * y.du.abs() * set.cell.horizontal.inverse_yield
}

impl<V: Vector> Lanes<'_, V> {
    /// Begins spans with the rest of the step. A span ends earlier where RK4 would be unstable for z, and where the
    /// block lands by an estimate from its rates.
    #[inline(always)]
    pub(super) fn begin_spans(&mut self, whole: V::Mask, k1: &Rates<V>) {
        let (zero, one) = (self.start.like(0.0), self.start.like(1.0));
        let (half, two) = (self.start.like(0.5), self.start.like(2.0));
        let step = self.forcing.step;
        let rest = one - self.start;
        self.span = V::select(whole, rest, self.span);
        self.cut = self.cut & !whole;
        let variant = self.shared.variant;
        if variant.devices {
            // The rate of the fastest motion: against the stop, or on the spring at its largest stiffness.
            let mut rate = zero;
            if variant.stops {
                rate = self.cell.horizontal.stop_rate * self.stop.abs();
            }
            if variant.hardens {
                let three = one.like(3.0);
                let tangent = three * self.cell.vertical.hardening_v * self.y.v * self.y.v;
                rate = rate.max((self.cell.vertical.stiffness_v + tangent).sqrt());
            }
            let turned = rate * step;
            let limit = one.like(STIFF_LIMIT);
            let long = whole & (turned * rest).gt(limit);
            if V::any(long) {
                self.span = V::select(long, limit / turned, self.span);
                self.cut = self.cut | long;
            }
        }
        if variant.kinks && variant.yields {
            let settling = settling_rate(&self.equations(), &self.y) * step;
            let limit = one.like(YIELD_LIMIT);
            let long = whole & (settling * self.span).gt(limit);
            if V::any(long) {
                self.span = V::select(long, limit / settling, self.span);
                self.cut = self.cut | long;
            }
        }
        // The angle is phi + d s + a s^2/2 after the fraction s of a step.
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
