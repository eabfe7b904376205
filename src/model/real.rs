//! The number type of a sweep. Twin of `shaders/real_f32.wgsl` and `shaders/real_f64.wgsl`.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number type that a sweep can run in: `f32` or `f64`.
///
/// Sine and cosine are polynomials, the same here and in the shaders, because the built-in ones
/// of WGSL do not exist in `f64` and differ from driver to driver in `f32`.
pub trait Real:
    sealed::Sealed
    + bytemuck::Pod
    + Debug
    + PartialOrd
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A switch is located to within this fraction of its step.
    const EVENT_TOLERANCE: Self;
    /// A kink of the Bouc-Wen law is located to within this fraction of its step; what is left of
    /// its error is of second order in that.
    const KINK_TOLERANCE: Self;

    /// The nearest number of this type.
    fn of(value: f64) -> Self;

    /// The same number in `f64`, without loss.
    fn to_f64(self) -> f64;

    /// |x|.
    fn abs(self) -> Self;

    /// The larger of the two; `self` where `other` is not a number.
    fn max(self, other: Self) -> Self;

    /// The square root.
    fn sqrt(self) -> Self;

    /// sin x for |x| <= 1.65 rad, to the type's rounding.
    fn sine(self) -> Self;

    /// cos x for |x| <= 1.65 rad, to the type's rounding.
    fn cosine(self) -> Self;

    /// sin(2 pi tau) for 0 <= tau <= 1: tau is brought to within a quarter period, which is
    /// exact, before the polynomial sees it.
    fn pulse_sine(tau: Self) -> Self {
        let two_pi = Self::of(std::f64::consts::TAU);
        if tau > Self::of(0.75) {
            return (two_pi * (tau - Self::of(1.0))).sine();
        }
        if tau > Self::of(0.25) {
            return (two_pi * (Self::of(0.5) - tau)).sine();
        }
        (two_pi * tau).sine()
    }
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

// Chebyshev fits of sin(sqrt t)/sqrt t and cos(sqrt t) on 0 <= t <= 1.65^2, relative error 7e-9
// and 4e-10 in f32, below 1e-21 in f64.
impl Real for f32 {
    const EVENT_TOLERANCE: f32 = 1.0e-6;
    const KINK_TOLERANCE: f32 = 1.0e-3;

    #[inline(always)]
    fn of(value: f64) -> f32 {
        value as f32
    }

    fn to_f64(self) -> f64 {
        f64::from(self)
    }

    #[inline(always)]
    fn abs(self) -> f32 {
        f32::abs(self)
    }

    #[inline(always)]
    fn sqrt(self) -> f32 {
        f32::sqrt(self)
    }

    #[inline(always)]
    fn max(self, other: f32) -> f32 {
        if other > self { other } else { self }
    }

    #[inline(always)]
    fn sine(self) -> f32 {
        let t = self * self;
        let p = 2.589_973_2e-6;
        let p = -1.980_214_1e-4 + t * p;
        let p = 8.332_954e-3 + t * p;
        let p = -0.166_666_54 + t * p;
        self + self * t * p
    }

    #[inline(always)]
    fn cosine(self) -> f32 {
        let t = self * self;
        let p = -2.589_922_4e-7;
        let p = 2.475_126_5e-5 + t * p;
        let p = -1.388_818_2e-3 + t * p;
        let p = 4.166_662e-2 + t * p;
        let p = -0.5 + t * p;
        1.0 + t * p
    }
}

impl Real for f64 {
    const EVENT_TOLERANCE: f64 = 1.0e-10;
    const KINK_TOLERANCE: f64 = 1.0e-5;

    #[inline(always)]
    fn of(value: f64) -> f64 {
        value
    }

    fn to_f64(self) -> f64 {
        self
    }

    #[inline(always)]
    fn abs(self) -> f64 {
        f64::abs(self)
    }

    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn max(self, other: f64) -> f64 {
        if other > self { other } else { self }
    }

    #[inline(always)]
    fn sine(self) -> f64 {
        let t = self * self;
        let p = -7.958_279_660_715_478e-18;
        let p = 2.809_947_197_035_375_4e-15 + t * p;
        let p = -7.647_115_487_080_588e-13 + t * p;
        let p = 1.605_904_290_439_772e-10 + t * p;
        let p = -2.505_210_837_428_26e-8 + t * p;
        let p = 2.755_731_922_390_456_4e-6 + t * p;
        let p = -1.984_126_984_126_95e-4 + t * p;
        let p = 8.333_333_333_333_333e-3 + t * p;
        let p = -0.166_666_666_666_666_67 + t * p;
        self + self * t * p
    }

    #[inline(always)]
    fn cosine(self) -> f64 {
        let t = self * self;
        let p = 3.979_132_564_561_097e-19;
        let p = -1.561_086_776_882_122e-16 + t * p;
        let p = 4.779_446_574_523_71e-14 + t * p;
        let p = -1.147_074_490_094_021_5e-11 + t * p;
        let p = 2.087_675_697_772_315e-9 + t * p;
        let p = -2.755_731_922_389_101e-7 + t * p;
        let p = 2.480_158_730_158_675e-5 + t * p;
        let p = -1.388_888_888_888_888_7e-3 + t * p;
        let p = 4.166_666_666_666_666_4e-2 + t * p;
        let p = -0.5 + t * p;
        1.0 + t * p
    }
}

#[cfg(test)]
mod tests {
    use super::Real;

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

    #[test]
    fn the_pulse_starts_and_ends_at_exactly_zero() {
        assert_eq!(<f32 as Real>::pulse_sine(0.0), 0.0);
        assert_eq!(<f32 as Real>::pulse_sine(0.5), 0.0);
        assert_eq!(<f64 as Real>::pulse_sine(1.0), 0.0);
        for i in 0..=1000 {
            let tau = f64::from(i) / 1000.0;
            let error = <f64 as Real>::pulse_sine(tau) - (std::f64::consts::TAU * tau).sin();
            // The library's argument 2 pi tau is itself rounded: up to half an ulp of 2 pi.
            assert!(error.abs() < 4.0 * f64::EPSILON, "tau = {tau}: {error:e}");
        }
    }
}
