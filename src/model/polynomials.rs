//! Coefficients of the polynomials that stand for sine, cosine and exponential; see
//! [`Number`](super::number::Number).

// Chebyshev fits of sin(sqrt t)/sqrt t and cos(sqrt t) on 0 <= t <= 1.65^2, relative error 7e-9
// and 4e-10 in f32, below 1e-21 in f64.
/// Coefficients of the sine in f32, the highest first.
pub const SINE_F32: [f64; 4] = [2.589_973_2e-6, -1.980_214_1e-4, 8.332_954e-3, -0.166_666_54];
/// Coefficients of the cosine in f32, the highest first.
pub const COSINE_F32: [f64; 5] =
    [-2.589_922_4e-7, 2.475_126_5e-5, -1.388_818_2e-3, 4.166_662e-2, -0.5];
/// Coefficients of the sine in f64, the highest first.
pub const SINE_F64: [f64; 9] = [
    -7.958_279_660_715_478e-18,
    2.809_947_197_035_375_4e-15,
    -7.647_115_487_080_588e-13,
    1.605_904_290_439_772e-10,
    -2.505_210_837_428_26e-8,
    2.755_731_922_390_456_4e-6,
    -1.984_126_984_126_95e-4,
    8.333_333_333_333_333e-3,
    -0.166_666_666_666_666_67,
];
/// Coefficients of the cosine in f64, the highest first.
pub const COSINE_F64: [f64; 10] = [
    3.979_132_564_561_097e-19,
    -1.561_086_776_882_122e-16,
    4.779_446_574_523_71e-14,
    -1.147_074_490_094_021_5e-11,
    2.087_675_697_772_315e-9,
    -2.755_731_922_389_101e-7,
    2.480_158_730_158_675e-5,
    -1.388_888_888_888_888_7e-3,
    4.166_666_666_666_666_4e-2,
    -0.5,
];

// The Taylor series of e^-x: the terms that are left out are below 1e-8 at x = ln 2 in f32, and below 1e-18 in f64.
/// Coefficients of the exponential in f32, the highest first.
pub const EXPONENTIAL_F32: [f64; 9] = [
    -2.755_731_9e-6,
    2.480_158_7e-5,
    -0.000_198_412_7,
    0.001_388_888_9,
    -0.008_333_333_3,
    0.041_666_667,
    -0.166_666_67,
    0.5,
    -1.0,
];
/// Coefficients of the exponential in f64, the highest first.
pub const EXPONENTIAL_F64: [f64; 17] = [
    -2.811_457_254_345_520_6e-15,
    4.779_477_332_387_385e-14,
    -7.647_163_731_819_816e-13,
    1.147_074_559_772_972_5e-11,
    -1.605_904_383_682_161_3e-10,
    2.087_675_698_786_81e-9,
    -2.505_210_838_544_172e-8,
    2.755_731_922_398_589e-7,
    -2.755_731_922_398_589_3e-6,
    2.480_158_730_158_73e-5,
    -0.000_198_412_698_412_698_4,
    0.001_388_888_888_888_889,
    -0.008_333_333_333_333_333,
    0.041_666_666_666_666_664,
    -0.166_666_666_666_666_66,
    0.5,
    -1.0,
];
