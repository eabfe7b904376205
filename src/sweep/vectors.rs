//! Code compiled for each kind of vector that a machine may have.

/// Runs a statement with the widest vectors of a level: `vectorized!(level, simd => statement)`.
macro_rules! vectorized {
    ($level:expr, $simd:ident => $run:expr) => {{
        let level = $level;
        // SSE4.2 is left out: it has little beyond SSE2, and each level compiles the turn once more.
        #[cfg(target_arch = "x86_64")]
        if let Some($simd) = level.as_avx512() {
            $simd.vectorize(
                #[inline(always)]
                || $run,
            );
        } else if let Some($simd) = level.as_avx2() {
            $simd.vectorize(
                #[inline(always)]
                || $run,
            );
        } else if let Some($simd) = level.as_sse2() {
            $simd.vectorize(
                #[inline(always)]
                || $run,
            );
        }
        #[cfg(not(target_arch = "x86_64"))]
        fearless_simd::dispatch!(level, $simd => $run);
    }};
}

pub(super) use vectorized;
