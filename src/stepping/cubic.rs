//! The value of a guard over a span: the cubic through its ends, and the root of that cubic. Twin of
//! `shaders/cubic.wgsl`.

use crate::model::number::Number;

use super::guards::GuardSample;
use super::rk4::hermite;

/// A cubic polynomial in the fraction of a span, by its coefficients.
#[derive(Clone, Copy)]
pub struct Cubic<N> {
    /// The value at the start.
    pub c0: N,
    /// The slope at the start.
    pub c1: N,
    /// The coefficient of the square.
    pub c2: N,
    /// The coefficient of the cube.
    pub c3: N,
}

impl<N: Number> Cubic<N> {
    /// The cubic with these values and slopes at the ends of a span.
    #[inline(always)]
    pub fn through(start: GuardSample<N>, end: GuardSample<N>) -> Cubic<N> {
        let (two, three) = (end.value.like(2.0), end.value.like(3.0));
        let rise = end.value - start.value;
        Cubic {
            c0: start.value,
            c1: start.slope,
            c2: three * rise - two * start.slope - end.slope,
            c3: start.slope + end.slope - two * rise,
        }
    }

    /// Selects one of two cubics in each lane.
    #[inline(always)]
    pub fn select(mask: N::Mask, yes: &Cubic<N>, no: &Cubic<N>) -> Cubic<N> {
        Cubic {
            c0: N::select(mask, yes.c0, no.c0),
            c1: N::select(mask, yes.c1, no.c1),
            c2: N::select(mask, yes.c2, no.c2),
            c3: N::select(mask, yes.c3, no.c3),
        }
    }

    /// The root in a span at whose end the cubic is positive, and the slope at the root.
    #[inline(always)]
    pub fn root(&self) -> (N, N) {
        let (zero, one) = (self.c0.like(0.0), self.c0.like(1.0));
        let (two, three) = (self.c0.like(2.0), self.c0.like(3.0));
        let rise = self.c1 + self.c2 + self.c3;
        let slope1 = three.mul_add(self.c3, two.mul_add(self.c2, self.c1));
        // If the cubic rises at both ends, the first guess is the zero of the chord, improved by the inverse cubic,
        // which gives the place as a function of the value. If it falls at first, as the angle of a block does after
        // an impact, the first guess is the place where the parabola from the start returns to its first value.
        let rises = self.c1.gt(zero) & slope1.gt(zero);
        let slopes = self.c1 * slope1;
        let inverse = one / N::select(rises, rise * slopes, self.c2 + self.c3);
        let chord = N::select(rises, -self.c0 * slopes, -self.c1) * inverse;
        let per_slopes = rise * rise * inverse;
        let place = hermite(zero, slope1 * per_slopes, one, self.c1 * per_slopes, chord);
        let at = N::select(rises, place, chord);
        let inside = at.gt(zero) & one.gt(at);
        let at = N::select(inside, at, one);
        // One step of Newton's method.
        let value = at.mul_add(at.mul_add(at.mul_add(self.c3, self.c2), self.c1), self.c0);
        let slope = at.mul_add(three * at * self.c3 + two * self.c2, self.c1);
        let next = at - value / slope;
        let inside = next.gt(zero) & one.gt(next);
        (N::select(inside, next, at), slope)
    }
}
