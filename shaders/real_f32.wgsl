// The number type of a sweep, f32. Twin: src/model/real.rs.

alias real = f32;

// A switch is located to within this fraction of its step.
const EVENT_TOLERANCE = 1.0e-6;
// A kink of the Bouc-Wen law is located to within this fraction of its step.
const KINK_TOLERANCE = 1.0e-3;
// Relative rounding error of a sum of a few products: a unit in the last place.
const ROUNDING = 1.1920928955078125e-7;

// sin x for |x| <= 1.65 rad.
fn sine(x: real) -> real {
    let t = x * x;
    var p: real = 2.5899732e-6;
    p = -1.9802141e-4 + t * p;
    p = 8.332954e-3 + t * p;
    p = -0.16666654 + t * p;
    return x + x * t * p;
}

// cos x for |x| <= 1.65 rad.
fn cosine(x: real) -> real {
    let t = x * x;
    var p: real = -2.5899224e-7;
    p = 2.4751265e-5 + t * p;
    p = -1.3888182e-3 + t * p;
    p = 4.166662e-2 + t * p;
    p = -0.5 + t * p;
    return 1.0 + t * p;
}

// e^-x for 0 <= x <= ln 2.
fn series(x: real) -> real {
    var p: real = -2.7557319e-06;
    p = 2.4801587e-05 + x * p;
    p = -0.0001984127 + x * p;
    p = 0.0013888889 + x * p;
    p = -0.0083333333 + x * p;
    p = 0.041666667 + x * p;
    p = -0.16666667 + x * p;
    p = 0.5 + x * p;
    p = -1.0 + x * p;
    return 1.0 + x * p;
}
