// The number type of a sweep, f64. Twin: src/model/real.rs.

alias real = f64;

// A switch is located to within this fraction of its step.
const EVENT_TOLERANCE = 1.0e-10;
// A kink of the Bouc-Wen law is located to within this fraction of its step.
const KINK_TOLERANCE = 1.0e-5;
// Relative rounding error of a sum of a few products: a unit in the last place.
const ROUNDING = 2.220446049250313e-16;

// sin x for |x| <= 1.65 rad.
fn sine(x: real) -> real {
    let t = x * x;
    var p: real = -7.958279660715478e-18;
    p = 2.8099471970353754e-15 + t * p;
    p = -7.647115487080588e-13 + t * p;
    p = 1.605904290439772e-10 + t * p;
    p = -2.50521083742826e-8 + t * p;
    p = 2.7557319223904564e-6 + t * p;
    p = -1.98412698412695e-4 + t * p;
    p = 8.333333333333333e-3 + t * p;
    p = -0.16666666666666667 + t * p;
    return x + x * t * p;
}

// cos x for |x| <= 1.65 rad.
fn cosine(x: real) -> real {
    let t = x * x;
    var p: real = 3.979132564561097e-19;
    p = -1.561086776882122e-16 + t * p;
    p = 4.77944657452371e-14 + t * p;
    p = -1.1470744900940215e-11 + t * p;
    p = 2.087675697772315e-9 + t * p;
    p = -2.755731922389101e-7 + t * p;
    p = 2.480158730158675e-5 + t * p;
    p = -1.3888888888888887e-3 + t * p;
    p = 4.1666666666666664e-2 + t * p;
    p = -0.5 + t * p;
    return 1.0 + t * p;
}

// e^-x for 0 <= x <= ln 2.
fn series(x: real) -> real {
    var p: real = -2.8114572543455206e-15;
    p = 4.779477332387385e-14 + x * p;
    p = -7.647163731819816e-13 + x * p;
    p = 1.1470745597729725e-11 + x * p;
    p = -1.6059043836821613e-10 + x * p;
    p = 2.08767569878681e-09 + x * p;
    p = -2.505210838544172e-08 + x * p;
    p = 2.755731922398589e-07 + x * p;
    p = -2.7557319223985893e-06 + x * p;
    p = 2.48015873015873e-05 + x * p;
    p = -0.0001984126984126984 + x * p;
    p = 0.001388888888888889 + x * p;
    p = -0.008333333333333333 + x * p;
    p = 0.041666666666666664 + x * p;
    p = -0.16666666666666666 + x * p;
    p = 0.5 + x * p;
    p = -1.0 + x * p;
    return 1.0 + x * p;
}
