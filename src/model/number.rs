//! The operations on numbers that the equations need. A number belongs to one cell, or is a vector with one cell in
//! each lane.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// Numbers n of halvings, and the factor 2^-n of each.
const HALVINGS: [(f64, f64); 6] = [
    (32.0, 2.328_306_436_538_696_3e-10),
    (16.0, 1.525_878_906_25e-5),
    (8.0, 3.906_25e-3),
    (4.0, 0.0625),
    (2.0, 0.25),
    (1.0, 0.5),
];

/// A number of one cell, `f32` or `f64`, or of as many cells as a vector has lanes.
///
/// Sine and cosine are polynomials, the same here and in the shaders, because the built-in ones
/// of WGSL do not exist in `f64` and differ from driver to driver in `f32`.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The result of a comparison: true or false in each lane.
    type Mask: Copy
        + BitAnd<Output = Self::Mask>
        + BitOr<Output = Self::Mask>
        + Not<Output = Self::Mask>;

    /// Coefficients of the sine's polynomial in x^2, from the highest power down.
    const SINE: &'static [f64];
    /// Those of the cosine's, down to that of x^2.
    const COSINE: &'static [f64];
    /// Those of e^-x on 0 <= x <= ln 2, down to that of x.
    const EXPONENTIAL: &'static [f64];

    /// The nearest number to `value` that is of the same kind as `self`, in all lanes.
    fn like(self, value: f64) -> Self;

    /// `self * factor + term`, as the shaders spell it; in vectors with one rounding where there is
    /// an instruction for that.
    fn mul_add(self, factor: Self, term: Self) -> Self;

    /// |x|.
    fn abs(self) -> Self;

    /// The largest whole number that is not above.
    fn floor(self) -> Self;

    /// The square root.
    fn sqrt(self) -> Self;

    /// True where `self` is the larger.
    fn gt(self, other: Self) -> Self::Mask;

    /// True where `self` is the larger, or both are equal.
    fn ge(self, other: Self) -> Self::Mask;

    /// `yes` where the mask is true, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// True where the mask is true in at least one lane.
    fn any(mask: Self::Mask) -> bool;

    /// The larger of the two; `self` where `other` is not a number.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(other.gt(self), other, self)
    }

    /// The smaller of the two; `self` where `other` is not a number.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(self.gt(other), other, self)
    }

    /// sin x for |x| <= 1.65 rad, to the type's rounding.
    #[inline(always)]
    fn sine(self) -> Self {
        let t = self * self;
        let mut p = self.like(Self::SINE[0]);
        for &coefficient in &Self::SINE[1..] {
            p = t.mul_add(p, self.like(coefficient));
        }
        (self * t).mul_add(p, self)
    }

    /// cos x for |x| <= 1.65 rad, to the type's rounding.
    #[inline(always)]
    fn cosine(self) -> Self {
        let t = self * self;
        let mut p = self.like(Self::COSINE[0]);
        for &coefficient in &Self::COSINE[1..] {
            p = t.mul_add(p, self.like(coefficient));
        }
        t.mul_add(p, self.like(1.0))
    }

    /// e^-x for 0 <= x <= 44, to the rounding of the type: the whole multiple of ln 2 in x is taken off and becomes a
    /// power of two.
    #[inline(always)]
    fn exponential(self) -> Self {
        let mut rest = self;
        let mut power = self.like(1.0);
        for (halvings, share) in HALVINGS {
            let held = self.like(halvings * std::f64::consts::LN_2);
            let holds = rest.ge(held);
            rest = Self::select(holds, rest - held, rest);
            power = Self::select(holds, power * self.like(share), power);
        }
        let mut p = self.like(Self::EXPONENTIAL[0]);
        for &coefficient in &Self::EXPONENTIAL[1..] {
            p = rest.mul_add(p, self.like(coefficient));
        }
        rest.mul_add(p, self.like(1.0)) * power
    }

    /// sin(2 pi tau) for 0 <= tau <= 1: tau is first reduced to a quarter period, which is exact.
    #[inline(always)]
    fn pulse_sine(tau: Self) -> Self {
        let last = tau.gt(tau.like(0.75));
        let middle = tau.gt(tau.like(0.25));
        let quarter = Self::select(middle, tau.like(0.5) - tau, tau);
        let quarter = Self::select(last, tau - tau.like(1.0), quarter);
        (tau.like(std::f64::consts::TAU) * quarter).sine()
    }
}
