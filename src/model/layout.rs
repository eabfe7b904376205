//! Structs that have the same layout here and in the memory of a device.

/// Declares a `#[repr(C)]` struct of reals and words that can be copied to a device, in both precisions; a struct
/// with padding does not compile.
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

/// Gives access to the reals of a struct in their order: to read them, to write them, or to make each anew. The words
/// of the struct are copied unchanged; of reals after a bar, which no equation has, each is only made anew.
macro_rules! reals {
    ($name:ident, $count:expr, $($field:ident)+ $(; $($word:ident)+)? $(| $($other:ident)+)?) => {
        impl<R: Copy> $name<R> {
            /// Copies of all reals, in order.
            #[inline(always)]
            pub fn reals(&self) -> [R; $count] {
                [$(self.$field),+]
            }

            /// References to all reals, in order.
            #[inline(always)]
            pub fn reals_ref(&self) -> [&R; $count] {
                [$(&self.$field),+]
            }

            /// Mutable references to all reals, in order.
            #[inline(always)]
            pub fn reals_mut(&mut self) -> [&mut R; $count] {
                [$(&mut self.$field),+]
            }

            /// The same struct in another number type: each number is made from the number in its place.
            #[inline(always)]
            pub fn map<Q>(&self, make: impl Fn(R) -> Q) -> $name<Q> {
                $name {
                    $($field: make(self.$field),)+
                    $($($word: self.$word,)+)?
                    $($($other: make(self.$other),)+)?
                }
            }

            /// The same struct, each number made from the two numbers in its place.
            #[inline(always)]
            pub fn zip<Q>(&self, other: &Self, make: impl Fn(R, R) -> Q) -> $name<Q> {
                $name {
                    $($field: make(self.$field, other.$field),)+
                    $($($word: self.$word,)+)?
                    $($($other: make(self.$other, other.$other),)+)?
                }
            }
        }
    };
}
pub(crate) use reals;

/// The same for a struct that holds such structs, then reals of its own, then words.
macro_rules! nested {
    ($name:ident, $($part:ident)+; $($field:ident)*; $($word:ident)*) => {
        impl<R: Copy> $name<R> {
            /// The same struct in another number type: each number is made from the number in its place.
            #[inline(always)]
            pub fn map<Q>(&self, make: impl Fn(R) -> Q) -> $name<Q> {
                $name {
                    $($part: self.$part.map(&make),)+
                    $($field: make(self.$field),)*
                    $($word: self.$word,)*
                }
            }

            /// Changes each real by means of the real in the same place of another.
            #[inline(always)]
            pub fn take<Q: Copy>(&mut self, from: &$name<Q>, mut change: impl FnMut(&mut R, Q)) {
                $(for (to, from) in self.$part.reals_mut().into_iter().zip(from.$part.reals()) {
                    change(to, from);
                })+
                $(change(&mut self.$field, from.$field);)*
            }
        }
    };
}
pub(crate) use nested;
