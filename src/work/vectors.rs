//! Code compiled for each kind of vector that a machine may have.

use fearless_simd::Level;

use crate::model::real::{Real, Vector};

/// Runs a statement with a number in all lanes of a level's vectors: `vectorized!(level, number => statement)`. The
/// name of the number is that of a number of one lane; where a machine has no vectors it stays that.
///
/// Vectors have 512 bits, in two or four registers where one is shorter: while one waits for its result another is
/// computed. With SSE2 they have 128: its sixteen registers would hold four numbers of 512 bits, and most of a turn
/// would be loads and stores.
macro_rules! vectorized {
    ($level:expr, $number:ident => $run:expr) => {{
        let level: fearless_simd::Level = $level;
        // SSE4.2 is left out: it has little beyond SSE2, and each level compiles the turn once more.
        #[cfg(all(target_arch = "x86_64", target_feature = "sse2", not(test)))]
        if let Some(simd) = level.as_avx512() {
            $crate::work::vectors::vectorized!(@run simd.lanes, $number => $run);
        } else if let Some(simd) = level.as_avx2() {
            $crate::work::vectors::vectorized!(@run simd.lanes, $number => $run);
        } else if let Some(simd) = level.as_sse2() {
            $crate::work::vectors::vectorized!(@run simd.few_lanes, $number => $run);
        }
        // The unit tests compile the turn for one level alone; `tests/engine/lanes.rs` has them all.
        #[cfg(all(target_arch = "x86_64", target_feature = "sse2", test))]
        if let Some(simd) = level.as_sse2() {
            $crate::work::vectors::vectorized!(@run simd.few_lanes, $number => $run);
        }
        #[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
        if let Some(simd) = level.as_neon() {
            $crate::work::vectors::vectorized!(@run simd.lanes, $number => $run);
        }
        #[cfg(not(any(
            all(target_arch = "x86_64", target_feature = "sse2"),
            all(target_arch = "aarch64", target_feature = "neon"),
        )))]
        {
            let _ = level;
            $run
        }
    }};
    (@run $simd:ident.$lanes:ident, $number:ident => $run:expr) => {
        fearless_simd::Simd::vectorize(
            $simd,
            #[inline(always)]
            || {
                let $number = $crate::model::real::Real::$lanes($number, $simd);
                $run
            },
        )
    };
}

pub(crate) use vectorized;

/// Lanes of a level's vectors.
pub fn lanes_of<R: Real>(level: Level) -> usize {
    fn of<V: Vector>(_: V) -> usize {
        V::LANES
    }
    let mut lanes = 0;
    let zero = R::of(0.0);
    vectorized!(level, zero => lanes = of(zero));
    lanes
}
