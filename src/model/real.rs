//! The number type of a sweep. Twin of `shaders/real_f32.wgsl` and `shaders/real_f64.wgsl`.

use std::fmt::Debug;

use fearless_simd::{Simd, SimdBase, f32x16, f64x8};

use super::number::Number;
use super::vector::Vector;

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
    /// A switch is located to within this fraction of its step.
    const EVENT_TOLERANCE: Self;
    /// A kink of the Bouc-Wen law is located to within this fraction of its step; what is left of
    /// its error is of second order in that.
    const KINK_TOLERANCE: Self;
    /// What rounding may make of a sum of a few products, of their size: a unit in the last place.
    const ROUNDING: Self;

    /// The nearest number of this type.
    fn of(value: f64) -> Self;

    /// The same number in `f64`, without loss.
    fn to_f64(self) -> f64;

    /// As many of these numbers as the CPU path takes at once.
    type Lanes<S: Simd>: Vector<Element = Self>;

    /// The same number in all lanes.
    fn lanes<S: Simd>(self, simd: S) -> Self::Lanes<S>;
}

mod sealed {
    /// Only `f32` and `f64` are `Real`: the layouts shared with the shaders rest on it.
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// Declares a `#[repr(C)]` struct of reals and words fit to be copied to a device, in both
/// precisions; a struct with padding does not compile.
macro_rules! pod {
    ($name:ident, reals: $reals:expr, words: $words:expr) => {
        const _: () = assert!(size_of::<$name<f32>>() == 4 * $reals + 4 * $words);
        const _: () = assert!(size_of::<$name<f64>>() == 8 * $reals + 4 * $words);
        // SAFETY: repr(C), only Pod fields, and by the assertions above no padding in either of
        // the two types that are `Real`, a sealed trait.
        unsafe impl<R: $crate::model::real::Real> bytemuck::Pod for $name<R> {}
    };
}
pub(crate) use pod;

/// Gives a struct its reals in order, to be read, written or made anew one by one; words that it
/// has besides go along.
macro_rules! reals {
    ($name:ident, $count:expr, $($field:ident)+ $(; $($word:ident)+)?) => {
        impl<R: Copy> $name<R> {
            /// All reals, in order.
            #[inline(always)]
            pub fn reals(&self) -> [R; $count] {
                [$(self.$field),+]
            }

            /// All reals, in order, where they lie.
            #[inline(always)]
            pub fn reals_ref(&self) -> [&R; $count] {
                [$(&self.$field),+]
            }

            /// All reals, in order, to be written.
            #[inline(always)]
            pub fn reals_mut(&mut self) -> [&mut R; $count] {
                [$(&mut self.$field),+]
            }

            /// The same struct of other numbers, each made of the one in its place.
            #[inline(always)]
            pub fn map<Q>(&self, make: impl Fn(R) -> Q) -> $name<Q> {
                $name { $($field: make(self.$field),)+ $($($word: self.$word,)+)? }
            }

            /// The same struct of numbers made of two in their places.
            #[inline(always)]
            pub fn zip<Q>(&self, other: &Self, make: impl Fn(R, R) -> Q) -> $name<Q> {
                $name {
                    $($field: make(self.$field, other.$field),)+
                    $($($word: self.$word,)+)?
                }
            }
        }
    };
}
pub(crate) use reals;

macro_rules! scalar {
    ($type:ty, $vector:ident, event: $event:expr, kink: $kink:expr, sine: $sine:expr, cosine: $cosine:expr, exponential: $exponential:expr) => {
        impl Real for $type {
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

// Chebyshev fits of sin(sqrt t)/sqrt t and cos(sqrt t) on 0 <= t <= 1.65^2, relative error 7e-9
// and 4e-10 in f32, below 1e-21 in f64.
pub(crate) const SINE_F32: [f64; 4] =
    [2.589_973_2e-6, -1.980_214_1e-4, 8.332_954e-3, -0.166_666_54];
pub(crate) const COSINE_F32: [f64; 5] =
    [-2.589_922_4e-7, 2.475_126_5e-5, -1.388_818_2e-3, 4.166_662e-2, -0.5];
pub(crate) const SINE_F64: [f64; 9] = [
    -7.958_279_660_715_478e-18,
    2.809_947_197_035_375_4e-15,
    -7.647_115_487_080_588e-13,
    1.605_904_290_439_772e-10,
    -2.505_210_837_428_26e-8,
    2.755_731_922_390_456_4e-6,
    -1.984_126_984_126_95e-4,
    8.333_333_333_333_333e-3,
    -0.166_666_666_666_666_67,
];
pub(crate) const COSINE_F64: [f64; 10] = [
    3.979_132_564_561_097e-19,
    -1.561_086_776_882_122e-16,
    4.779_446_574_523_71e-14,
    -1.147_074_490_094_021_5e-11,
    2.087_675_697_772_315e-9,
    -2.755_731_922_389_101e-7,
    2.480_158_730_158_675e-5,
    -1.388_888_888_888_888_7e-3,
    4.166_666_666_666_666_4e-2,
    -0.5,
];

// Taylor's for e^-x: what they leave out at ln 2 is below 1e-8 in f32, below 1e-18 in f64.
pub(crate) const EXPONENTIAL_F32: [f64; 9] = [
    -2.755_731_9e-6,
    2.480_158_7e-5,
    -0.000_198_412_7,
    0.001_388_888_9,
    -0.008_333_333_3,
    0.041_666_667,
    -0.166_666_67,
    0.5,
    -1.0,
];
pub(crate) const EXPONENTIAL_F64: [f64; 17] = [
    -2.811_457_254_345_520_6e-15,
    4.779_477_332_387_385e-14,
    -7.647_163_731_819_816e-13,
    1.147_074_559_772_972_5e-11,
    -1.605_904_383_682_161_3e-10,
    2.087_675_698_786_81e-9,
    -2.505_210_838_544_172e-8,
    2.755_731_922_398_589e-7,
    -2.755_731_922_398_589_3e-6,
    2.480_158_730_158_73e-5,
    -0.000_198_412_698_412_698_4,
    0.001_388_888_888_888_889,
    -0.008_333_333_333_333_333,
    0.041_666_666_666_666_664,
    -0.166_666_666_666_666_66,
    0.5,
    -1.0,
];

scalar!(f32, f32x16, event: 1.0e-6, kink: 1.0e-3, sine: SINE_F32, cosine: COSINE_F32, exponential: EXPONENTIAL_F32);
scalar!(f64, f64x8, event: 1.0e-10, kink: 1.0e-5, sine: SINE_F64, cosine: COSINE_F64, exponential: EXPONENTIAL_F64);

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
