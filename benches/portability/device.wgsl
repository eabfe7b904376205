// The operations in f32 of a device that makes use of what WGSL permits. Constants that are not set here
// are set by worst_device.rs, which puts calls of these functions in place of the operations.

const NEAREST = 0;
const TOWARD_ZERO = 1;
const EITHER_WAY = 2;

const MAGNITUDE = 0x7fffffffu;
const INFINITY = 0x7f800000u;
const LEAST_NORMAL = 0x00800000u;

// A number that follows from two numbers alone, as good as random.
fn device_hash(a: f32, b: f32) -> u32 {
    var hash = bitcast<u32>(a) ^ SEED;
    hash = (hash ^ (hash >> 16u)) * 0x9e3779b1u + bitcast<u32>(b);
    hash = (hash ^ (hash >> 15u)) * 0x85ebca77u;
    return hash ^ (hash >> 13u);
}

fn device_is_nan(x: f32) -> bool {
    return (bitcast<u32>(x) & MAGNITUDE) > INFINITY;
}

fn device_flushed(x: f32) -> f32 {
    let bits = bitcast<u32>(x);
    return select(x, bitcast<f32>(bits & ~MAGNITUDE), (bits & MAGNITUDE) < FLUSHED_BELOW);
}

// A normal number so many units in the last place larger in magnitude.
fn device_off(x: f32, ulp: i32) -> f32 {
    let bits = bitcast<u32>(x);
    let magnitude = bits & MAGNITUDE;
    let normal = magnitude >= LEAST_NORMAL && magnitude < INFINITY;
    return select(x, bitcast<f32>(bits + bitcast<u32>(ulp)), normal);
}

fn device_between(low: i32, high: i32, hash: u32) -> i32 {
    return low + i32(hash % u32(high - low + 1));
}

// What comes of a result: what is not finite may be any number.
fn device_result(x: f32, hash: u32) -> f32 {
    if INDETERMINATE && (bitcast<u32>(x) & MAGNITUDE) >= INFINITY {
        // Between -1 and 1.
        return f32(hash & 0xffffu) / 32768.0 - 1.0;
    }
    return device_flushed(x);
}

// An exact result, or what f64 has of it, rounded to one of its two neighbours.
fn device_rounded(exact: f64, hash: u32) -> f32 {
    let near = f32(exact);
    let error = exact - f64(near);
    if error == 0.0lf {
        return near;
    }
    let larger = (error > 0.0lf) == (near > 0.0);
    if ROUNDING == TOWARD_ZERO && !larger {
        return device_off(near, -1);
    }
    if ROUNDING == EITHER_WAY && (hash & 1u) == 1u {
        return device_off(near, select(-1, 1, larger));
    }
    return near;
}

fn device_sum(a: f32, b: f32) -> f32 {
    let x = device_flushed(a);
    let y = device_flushed(b);
    let hash = device_hash(x, y);
    return device_result(device_rounded(f64(x) + f64(y), hash), hash);
}

fn device_difference(a: f32, b: f32) -> f32 {
    return device_sum(a, -b);
}

fn device_product(a: f32, b: f32) -> f32 {
    let x = device_flushed(a);
    let y = device_flushed(b);
    let hash = device_hash(x, y);
    return device_result(device_rounded(f64(x) * f64(y), hash), hash);
}

// a b + c, rounded once.
fn device_fused(a: f32, b: f32, c: f32) -> f32 {
    let x = device_flushed(a);
    let y = device_flushed(b);
    let z = device_flushed(c);
    let hash = device_hash(x, y) ^ bitcast<u32>(z);
    return device_result(device_rounded(f64(x) * f64(y) + f64(z), hash), hash);
}

// a b - c.
fn device_fused_less(a: f32, b: f32, c: f32) -> f32 {
    return device_fused(a, b, -c);
}

// c - a b.
fn device_fused_from(a: f32, b: f32, c: f32) -> f32 {
    return device_fused(-a, b, c);
}

fn device_quotient(a: f32, b: f32) -> f32 {
    let x = device_flushed(a);
    let y = device_flushed(b);
    let hash = device_hash(x, y);
    return device_result(device_off(x / y, device_between(DIVISION_LOW, DIVISION_HIGH, hash)), hash);
}

fn device_root(a: f32) -> f32 {
    let x = device_flushed(a);
    let hash = device_hash(x, x);
    return device_result(device_off(sqrt(x), device_between(ROOT_LOW, ROOT_HIGH, hash)), hash);
}

// Comparisons: where one of the numbers is none, they may come out either way.

fn device_no_number(a: f32, b: f32) -> bool {
    return NANS_INVERTED && (device_is_nan(a) || device_is_nan(b));
}

fn device_less(a: f32, b: f32) -> bool {
    return device_no_number(a, b) || device_flushed(a) < device_flushed(b);
}

fn device_at_most(a: f32, b: f32) -> bool {
    return device_no_number(a, b) || device_flushed(a) <= device_flushed(b);
}

fn device_equal(a: f32, b: f32) -> bool {
    return device_no_number(a, b) || device_flushed(a) == device_flushed(b);
}

fn device_unequal(a: f32, b: f32) -> bool {
    return !device_equal(a, b);
}

// The lesser and the larger of two; where one is no number, it.

fn device_min(a: f32, b: f32) -> f32 {
    if device_no_number(a, b) {
        return select(b, a, device_is_nan(a));
    }
    return device_flushed(min(a, b));
}

fn device_max(a: f32, b: f32) -> f32 {
    if device_no_number(a, b) {
        return select(b, a, device_is_nan(a));
    }
    return device_flushed(max(a, b));
}
