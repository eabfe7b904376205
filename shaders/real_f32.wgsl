// The number type of a sweep, f32. Twin: src/model/real.rs.

alias real = f32;

// A switch is located to within this fraction of its step.
const EVENT_TOLERANCE = 1.0e-6;
// A kink of the Bouc-Wen law is located to within this fraction of its step.
const KINK_TOLERANCE = 1.0e-3;
// What rounding may make of a sum of a few products, of their size: a unit in the last place.
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

// e^-x for 0 <= x <= 44: x less as many ln 2 as it holds, by powers of two.
fn exponential(x: real) -> real {
    let ln_2: real = 0.6931471805599453;
    var rest = x;
    var power: real = 1.0;
    if rest >= 32.0 * ln_2 {
        rest -= 32.0 * ln_2;
        power *= 2.3283064365386963e-10;
    }
    if rest >= 16.0 * ln_2 {
        rest -= 16.0 * ln_2;
        power *= 1.52587890625e-05;
    }
    if rest >= 8.0 * ln_2 {
        rest -= 8.0 * ln_2;
        power *= 0.00390625;
    }
    if rest >= 4.0 * ln_2 {
        rest -= 4.0 * ln_2;
        power *= 0.0625;
    }
    if rest >= 2.0 * ln_2 {
        rest -= 2.0 * ln_2;
        power *= 0.25;
    }
    if rest >= 1.0 * ln_2 {
        rest -= 1.0 * ln_2;
        power *= 0.5;
    }
    var p: real = -2.7557319e-06;
    p = 2.4801587e-05 + rest * p;
    p = -0.0001984127 + rest * p;
    p = 0.0013888889 + rest * p;
    p = -0.0083333333 + rest * p;
    p = 0.041666667 + rest * p;
    p = -0.16666667 + rest * p;
    p = 0.5 + rest * p;
    p = -1 + rest * p;
    return (1.0 + rest * p) * power;
}
