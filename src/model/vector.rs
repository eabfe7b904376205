//! Vectors of numbers, one cell in each lane. The instructions are chosen at run time by
//! [`fearless_simd::Level`].

use fearless_simd::{ExtractToken, Select, Simd, SimdBase, SimdFloat, SimdMask, f32x16, f64x8};

use super::number::Number;
use super::polynomials::{
    COSINE_F32, COSINE_F64, EXPONENTIAL_F32, EXPONENTIAL_F64, SINE_F32, SINE_F64,
};
use super::real::Vector;

macro_rules! vector {
    ($vector:ident, $element:ty, $lanes:expr, $sine:expr, $cosine:expr, $exponential:expr) => {
        impl<S: Simd> Number for $vector<S> {
            type Mask = <Self as SimdBase<S>>::Mask;

            const SINE: &'static [f64] = &$sine;
            const COSINE: &'static [f64] = &$cosine;
            const EXPONENTIAL: &'static [f64] = &$exponential;

            #[inline(always)]
            fn like(self, value: f64) -> Self {
                Self::splat(self.token(), value as $element)
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                SimdFloat::mul_add(self, factor, term)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                SimdBase::abs(self)
            }

            #[inline(always)]
            fn floor(self) -> Self {
                SimdFloat::floor(self)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                SimdFloat::sqrt(self)
            }

            #[inline(always)]
            fn gt(self, other: Self) -> Self::Mask {
                self.simd_gt(other)
            }

            #[inline(always)]
            fn ge(self, other: Self) -> Self::Mask {
                self.simd_ge(other)
            }

            #[inline(always)]
            fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
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
            fn first_of(self, numbers: &[$element]) -> Self {
                match numbers.first_chunk::<$lanes>() {
                    Some(numbers) => Self::from_slice(self.token(), numbers),
                    None => self,
                }
            }

            #[inline(always)]
            fn write(&self, to: &mut [$element]) {
                to[..$lanes].copy_from_slice(self.as_slice());
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

vector!(f32x16, f32, 16, SINE_F32, COSINE_F32, EXPONENTIAL_F32);
vector!(f64x8, f64, 8, SINE_F64, COSINE_F64, EXPONENTIAL_F64);
