//! Vectors of numbers, a cell a lane. Which instructions they are made of is found out at run time,
//! by [`fearless_simd::Level`].

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use fearless_simd::{ExtractToken, Select, Simd, SimdBase, SimdFloat, SimdMask, f32x16, f64x8};

use super::number::Number;
use super::real::{COSINE_F32, COSINE_F64, Real, SINE_F32, SINE_F64};

/// A number of several cells.
pub trait Vector: Number + std::fmt::Debug {
    /// What a lane holds.
    type Element: Real;

    /// Number of lanes, 64 at most.
    const LANES: usize;

    /// The number in a lane.
    fn lane(&self, lane: usize) -> Self::Element;

    /// Changes the number in a lane.
    fn put(&mut self, lane: usize, value: Self::Element);

    /// A mask as a bit a lane, the first lane the lowest.
    fn bits(mask: Self::Mask) -> u64;

    /// The mask of such bits, for numbers of the same kind as `self`.
    fn mask(self, bits: u64) -> Self::Mask;

    /// Runs something with the instructions that this kind of vector is made of.
    fn with<T>(self, run: impl FnOnce() -> T) -> T;
}

macro_rules! vector {
    ($vector:ident, $element:ty, $lanes:expr, $sine:expr, $cosine:expr) => {
        impl<S: Simd> Number for $vector<S> {
            type Mask = <Self as SimdBase<S>>::Mask;

            const SINE: &'static [f64] = &$sine;
            const COSINE: &'static [f64] = &$cosine;

            #[inline(always)]
            fn like(self, value: f64) -> Self {
                Self::splat(self.token(), value as $element)
            }

            #[inline(always)]
            fn times_plus(self, factor: Self, term: Self) -> Self {
                self.mul_add(factor, term)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                SimdBase::abs(self)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                SimdFloat::sqrt(self)
            }

            #[inline(always)]
            fn exceeds(self, other: Self) -> Self::Mask {
                self.simd_gt(other)
            }

            #[inline(always)]
            fn reaches(self, other: Self) -> Self::Mask {
                self.simd_ge(other)
            }

            #[inline(always)]
            fn pick(mask: Self::Mask, yes: Self, no: Self) -> Self {
                mask.select(yes, no)
            }

            #[inline(always)]
            fn any(mask: Self::Mask) -> bool {
                mask.any_true()
            }
        }

        impl<S: Simd> Vector for $vector<S> {
            type Element = $element;

            const LANES: usize = $lanes;

            #[inline(always)]
            fn lane(&self, lane: usize) -> $element {
                self[lane]
            }

            #[inline(always)]
            fn put(&mut self, lane: usize, value: $element) {
                self[lane] = value;
            }

            #[inline(always)]
            fn bits(mask: Self::Mask) -> u64 {
                mask.to_bitmask()
            }

            #[inline(always)]
            fn mask(self, bits: u64) -> Self::Mask {
                SimdMask::from_bitmask(self.token(), bits)
            }

            #[inline(always)]
            fn with<T>(self, run: impl FnOnce() -> T) -> T {
                self.token().vectorize(run)
            }
        }
    };
}

vector!(f32x16, f32, 16, SINE_F32, COSINE_F32);
vector!(f64x8, f64, 8, SINE_F64, COSINE_F64);

/// Two vectors side by side: while one waits for a result, the other computes.
#[derive(Debug, Clone, Copy)]
pub struct Pair<V>(pub V, pub V);

impl<M: BitAnd<Output = M>> BitAnd for Pair<M> {
    type Output = Pair<M>;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Pair(self.0 & other.0, self.1 & other.1)
    }
}

impl<M: BitOr<Output = M>> BitOr for Pair<M> {
    type Output = Pair<M>;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Pair(self.0 | other.0, self.1 | other.1)
    }
}

impl<M: Not<Output = M>> Not for Pair<M> {
    type Output = Pair<M>;

    #[inline(always)]
    fn not(self) -> Self {
        Pair(!self.0, !self.1)
    }
}

macro_rules! both {
    ($trait:ident, $operation:ident) => {
        impl<V: $trait<Output = V>> $trait for Pair<V> {
            type Output = Pair<V>;

            #[inline(always)]
            fn $operation(self, other: Self) -> Self {
                Pair(self.0.$operation(other.0), self.1.$operation(other.1))
            }
        }
    };
}

both!(Add, add);
both!(Sub, sub);
both!(Mul, mul);
both!(Div, div);

impl<V: Neg<Output = V>> Neg for Pair<V> {
    type Output = Pair<V>;

    #[inline(always)]
    fn neg(self) -> Self {
        Pair(-self.0, -self.1)
    }
}

impl<V: Vector> Number for Pair<V> {
    type Mask = Pair<V::Mask>;

    const SINE: &'static [f64] = V::SINE;
    const COSINE: &'static [f64] = V::COSINE;

    #[inline(always)]
    fn like(self, value: f64) -> Self {
        let both = self.0.like(value);
        Pair(both, both)
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        Pair(self.0.times_plus(factor.0, term.0), self.1.times_plus(factor.1, term.1))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Pair(self.0.abs(), self.1.abs())
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Pair(self.0.sqrt(), self.1.sqrt())
    }

    #[inline(always)]
    fn exceeds(self, other: Self) -> Self::Mask {
        Pair(self.0.exceeds(other.0), self.1.exceeds(other.1))
    }

    #[inline(always)]
    fn reaches(self, other: Self) -> Self::Mask {
        Pair(self.0.reaches(other.0), self.1.reaches(other.1))
    }

    #[inline(always)]
    fn pick(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Pair(V::pick(mask.0, yes.0, no.0), V::pick(mask.1, yes.1, no.1))
    }

    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        V::any(mask.0) | V::any(mask.1)
    }
}

impl<V: Vector> Vector for Pair<V> {
    type Element = V::Element;

    const LANES: usize = 2 * V::LANES;

    #[inline(always)]
    fn lane(&self, lane: usize) -> V::Element {
        if lane < V::LANES { self.0.lane(lane) } else { self.1.lane(lane - V::LANES) }
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, value: V::Element) {
        if lane < V::LANES {
            self.0.put(lane, value);
        } else {
            self.1.put(lane - V::LANES, value);
        }
    }

    #[inline(always)]
    fn bits(mask: Self::Mask) -> u64 {
        V::bits(mask.0) | V::bits(mask.1) << V::LANES
    }

    #[inline(always)]
    fn mask(self, bits: u64) -> Self::Mask {
        let one = (1 << V::LANES) - 1;
        Pair(self.0.mask(bits & one), self.1.mask(bits >> V::LANES & one))
    }

    #[inline(always)]
    fn with<T>(self, run: impl FnOnce() -> T) -> T {
        self.0.with(run)
    }
}
