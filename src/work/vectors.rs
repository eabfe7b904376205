//! Code compiled for each kind of vector that a machine may have.

use fearless_simd::Level;

use crate::model::real::{Real, Vector};

/// Runs a statement with a number in all lanes of a level's vectors: `vectorized!(level, number => statement)`. The
/// name of the number is that of a number of one lane; where a machine has no vectors it stays that.
///
/// Vectors have 512 bits, in two or four registers where one is shorter: while one waits for its result another is
/// computed. Each level compiles the statement once more, so processors of x86 without AVX2 (made before 2013) have
/// one lane.
macro_rules! vectorized {
    ($level:expr, $number:ident => $run:expr) => {{
        let level: fearless_simd::Level = $level;
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = level.as_avx512() {
            $crate::work::vectors::vectorized!(@run simd, $number => $run);
        } else if let Some(simd) = level.as_avx2() {
            $crate::work::vectors::vectorized!(@run simd, $number => $run);
        } else {
            $run;
        }
        #[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
        if let Some(simd) = level.as_neon() {
            $crate::work::vectors::vectorized!(@run simd, $number => $run);
        }
        #[cfg(not(any(
            target_arch = "x86_64",
            all(target_arch = "aarch64", target_feature = "neon"),
        )))]
        {
            let _ = level;
            $run
        }
    }};
    (@run $simd:ident, $number:ident => $run:expr) => {
        fearless_simd::Simd::vectorize(
            $simd,
            #[inline(always)]
            || {
                let $number = $crate::model::real::Real::lanes($number, $simd);
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
