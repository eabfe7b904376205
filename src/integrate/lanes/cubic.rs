//! A function over a span by the cubic through its ends, and where that is zero.

use crate::model::vector::Vector;

use super::super::rk4::hermite;

/// Newton's steps on the cubic.
const GUESSES: usize = 1;

/// What the lanes look for, a function of the place in the span that is positive beyond it.
#[derive(Clone, Copy)]
pub struct Beyond<V> {
    /// Its value.
    pub value: V,
    /// Its slope over the span.
    pub slope: V,
    /// Twice the coefficient of the square there: what a step along the slope misses.
    pub bend: V,
}

/// A cubic in the place in a span, by its coefficients.
#[derive(Clone, Copy)]
pub struct Cubic<V> {
    /// Value at the start.
    pub c0: V,
    /// Slope there.
    pub c1: V,
    /// Of the square.
    pub c2: V,
    /// Of the cube.
    pub c3: V,
}

impl<V: Vector> Cubic<V> {
    /// The cubic with these values and slopes at a span's ends.
    #[inline(always)]
    pub fn through(start: Beyond<V>, end: Beyond<V>) -> Cubic<V> {
        let (two, three) = (end.value.like(2.0), end.value.like(3.0));
        let rise = end.value - start.value;
        Cubic {
            c0: start.value,
            c1: start.slope,
            c2: three * rise - two * start.slope - end.slope,
            c3: start.slope + end.slope - two * rise,
        }
    }

    /// The one of two in each lane.
    #[inline(always)]
    pub fn pick(mask: V::Mask, yes: &Cubic<V>, no: &Cubic<V>) -> Cubic<V> {
        Cubic {
            c0: V::pick(mask, yes.c0, no.c0),
            c1: V::pick(mask, yes.c1, no.c1),
            c2: V::pick(mask, yes.c2, no.c2),
            c3: V::pick(mask, yes.c3, no.c3),
        }
    }

    /// The root in a span at whose end the cubic is positive, and the slope there.
    #[inline(always)]
    pub fn root(&self) -> (V, V) {
        let (zero, one) = (self.c0.like(0.0), self.c0.like(1.0));
        let (two, three) = (self.c0.like(2.0), self.c0.like(3.0));
        let rise = self.c1 + self.c2 + self.c3;
        let slope1 = three.times_plus(self.c3, two.times_plus(self.c2, self.c1));
        // Where it rises from end to end: where the chord is zero, then the place as a cubic in the
        // value. Where it falls first, as the angle of a block that has just landed does: where the
        // parabola from the start is as high as there again.
        let rises = self.c1.exceeds(zero) & slope1.exceeds(zero);
        let chord = V::pick(rises, -self.c0, -self.c1) / V::pick(rises, rise, self.c2 + self.c3);
        let inverse = hermite(zero, rise / self.c1, one, rise / slope1, chord);
        let at = V::pick(rises, inverse, chord);
        let inside = at.exceeds(zero) & one.exceeds(at);
        let mut at = V::pick(inside, at, one);
        let mut slope = one;
        for _ in 0..GUESSES {
            let value =
                at.times_plus(at.times_plus(at.times_plus(self.c3, self.c2), self.c1), self.c0);
            slope = at.times_plus(three * at * self.c3 + two * self.c2, self.c1);
            let next = at - value / slope;
            let inside = next.exceeds(zero) & one.exceeds(next);
            at = V::pick(inside, next, at);
        }
        (at, slope)
    }
}
