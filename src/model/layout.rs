//! Structs that lie in the memory of a device as they lie here.

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
