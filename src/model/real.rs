//! The number types of a sweep and their vectors: each is defined by the other. Twin of `shaders/real_f32.wgsl` and
//! `shaders/real_f64.wgsl`.

use std::fmt::Debug;

use fearless_simd::{Simd, SimdBase, f32x16, f64x8};

use super::number::Number;
use super::polynomials::{
    COSINE_F32, COSINE_F64, EXPONENTIAL_F32, EXPONENTIAL_F64, SINE_F32, SINE_F64,
};
use super::precision::Precision;

/// A number type that a sweep can run in: `f32` or `f64`.
pub trait Real:
    Vector<Element = Self, Mask = bool>
    + sealed::Sealed
    + bytemuck::Pod
    + Debug
    + PartialOrd
    + Send
    + Sync
{
    /// The precision of this type. Generic code is compiled again in every crate that calls it; where that takes
    /// long, a function that is not generic is called with this constant.
    const PRECISION: Precision;
    /// A switch is located to within this fraction of its step.
    const EVENT_TOLERANCE: Self;
    /// A kink of the Bouc-Wen law is located to within this fraction of its step; the remaining error is of second
    /// order in this fraction.
    const KINK_TOLERANCE: Self;
    /// Relative rounding error of a sum of a few products: a unit in the last place.
    const ROUNDING: Self;

    /// The nearest number of this type.
    fn of(value: f64) -> Self;

    /// The same number in `f64`, without loss.
    fn to_f64(self) -> f64;

    /// A vector of as many of these numbers as the CPU path computes at once: 512 bits, in one register or several.
    type Lanes<S: Simd>: Vector<Element = Self>;

    /// The same number in all lanes.
    fn lanes<S: Simd>(self, simd: S) -> Self::Lanes<S>;
}

/// A number of several cells.
pub trait Vector: Number + Debug {
    /// The number type of a lane.
    type Element: Real;

    /// Number of lanes, 64 at most.
    const LANES: usize;

    /// The number in a lane.
    fn lane(&self, lane: usize) -> Self::Element;

    /// Changes the number in a lane.
    fn put(&mut self, lane: usize, value: Self::Element);

    /// The first numbers of a slice, one in each lane; `self` where the slice has fewer.
    fn first_of(self, numbers: &[Self::Element]) -> Self;

    /// Writes the numbers of all lanes to the begin of a slice, which has as many at least.
    fn write(&self, to: &mut [Self::Element]);

    /// A mask as one bit for each lane, the first lane lowest.
    fn bits(mask: Self::Mask) -> u64;

    /// The mask of such bits, for numbers of the same kind as `self`.
    fn mask(self, bits: u64) -> Self::Mask;

    /// Calls `run` compiled with the instructions of this kind of vector.
    fn with<T>(self, run: impl FnOnce() -> T) -> T;
}

mod sealed {
    /// Only `f32` and `f64` are `Real`: the layouts shared with the shaders rely on that.
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

macro_rules! scalar {
    ($type:ty, $precision:ident, $vector:ident, event: $event:expr, kink: $kink:expr, sine: $sine:expr, cosine: $cosine:expr, exponential: $exponential:expr) => {
        impl Real for $type {
            const PRECISION: Precision = Precision::$precision;
            const EVENT_TOLERANCE: $type = $event;
            const KINK_TOLERANCE: $type = $kink;
            const ROUNDING: $type = <$type>::EPSILON;

            #[inline(always)]
            fn of(value: f64) -> $type {
                value as $type
            }

            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }

            type Lanes<S: Simd> = $vector<S>;

            #[inline(always)]
            fn lanes<S: Simd>(self, simd: S) -> $vector<S> {
                $vector::splat(simd, self)
            }
        }

        impl Number for $type {
            type Mask = bool;

            const SINE: &'static [f64] = &$sine;
            const COSINE: &'static [f64] = &$cosine;
            const EXPONENTIAL: &'static [f64] = &$exponential;

            #[inline(always)]
            fn like(self, value: f64) -> $type {
                value as $type
            }

            #[inline(always)]
            fn mul_add(self, factor: $type, term: $type) -> $type {
                self * factor + term
            }

            #[inline(always)]
            fn abs(self) -> $type {
                <$type>::abs(self)
            }

            #[inline(always)]
            fn floor(self) -> $type {
                <$type>::floor(self)
            }

            #[inline(always)]
            fn sqrt(self) -> $type {
                <$type>::sqrt(self)
            }

            #[inline(always)]
            fn gt(self, other: $type) -> bool {
                self > other
            }

            #[inline(always)]
            fn ge(self, other: $type) -> bool {
                self >= other
            }

            #[inline(always)]
            fn select(mask: bool, yes: $type, no: $type) -> $type {
                if mask { yes } else { no }
            }

            #[inline(always)]
            fn any(mask: bool) -> bool {
                mask
            }
        }
    };
}

scalar!(f32, F32, f32x16, event: 1.0e-6, kink: 1.0e-3, sine: SINE_F32, cosine: COSINE_F32, exponential: EXPONENTIAL_F32);
scalar!(f64, F64, f64x8, event: 1.0e-10, kink: 1.0e-5, sine: SINE_F64, cosine: COSINE_F64, exponential: EXPONENTIAL_F64);

/// A number as a vector of one lane: the same code steps a single cell.
macro_rules! single {
    ($element:ty) => {
        impl Vector for $element {
            type Element = $element;

            const LANES: usize = 1;

            #[inline(always)]
            fn lane(&self, _: usize) -> $element {
                *self
            }

            #[inline(always)]
            fn put(&mut self, _: usize, value: $element) {
                *self = value;
            }

            #[inline(always)]
            fn first_of(self, numbers: &[$element]) -> $element {
                numbers.first().copied().unwrap_or(self)
            }

            #[inline(always)]
            fn write(&self, to: &mut [$element]) {
                to[0] = *self;
            }

            #[inline(always)]
            fn bits(mask: bool) -> u64 {
                u64::from(mask)
            }

            #[inline(always)]
            fn mask(self, bits: u64) -> bool {
                bits & 1 == 1
            }

            #[inline(always)]
            fn with<T>(self, run: impl FnOnce() -> T) -> T {
                run()
            }
        }
    };
}

single!(f32);
single!(f64);

#[cfg(test)]
mod tests {
    use super::{Number, Real};

    /// Horner's rounding: each step adds at most one unit in the last place of a value near 1.
    fn polynomials_follow_std<R: Real>(epsilon: f64) {
        for i in -1650..=1650 {
            let x = R::of(f64::from(i) * 1.0e-3);
            let exact = x.to_f64();
            assert!((x.sine().to_f64() - exact.sin()).abs() <= 2.0 * epsilon, "sin {exact}");
            assert!((x.cosine().to_f64() - exact.cos()).abs() <= 2.0 * epsilon, "cos {exact}");
        }
    }

    #[test]
    fn sine_and_cosine_are_right_to_rounding_in_f32() {
        polynomials_follow_std::<f32>(f64::from(f32::EPSILON));
    }

    #[test]
    fn sine_and_cosine_are_right_to_rounding_in_f64() {
        polynomials_follow_std::<f64>(f64::EPSILON);
    }

    /// Horner's rounding as above, and what is left out of the series (1e-8 in f32).
    fn exponentials_follow_std<R: Real>(allowed: f64) {
        for i in 0..=44_000 {
            let x = R::of(f64::from(i) * 1.0e-3);
            let exact = (-x.to_f64()).exp();
            // ln 2 is rounded to a unit in the last place of what is taken off.
            let error = (x.exponential().to_f64() - exact).abs();
            assert!(error <= allowed * (2.0 + x.to_f64()) * exact, "exp -{x:?}: {error:e}");
        }
    }

    #[test]
    fn the_exponential_is_right_to_rounding() {
        exponentials_follow_std::<f32>(f64::from(f32::EPSILON));
        exponentials_follow_std::<f64>(f64::EPSILON);
    }

    #[test]
    fn the_pulse_starts_and_ends_at_exactly_zero() {
        assert_eq!(<f32 as Number>::pulse_sine(0.0), 0.0);
        assert_eq!(<f32 as Number>::pulse_sine(0.5), 0.0);
        assert_eq!(<f64 as Number>::pulse_sine(1.0), 0.0);
        for i in 0..=1000 {
            let tau = f64::from(i) / 1000.0;
            let error = <f64 as Number>::pulse_sine(tau) - (std::f64::consts::TAU * tau).sin();
            // The library's argument 2 pi tau is itself rounded: up to half an ulp of 2 pi.
            assert!(error.abs() < 4.0 * f64::EPSILON, "tau = {tau}: {error:e}");
        }
    }
}
