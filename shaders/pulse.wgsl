// The pulses that can shake the base. Twin: src/model/pulse.rs.

override pulse_shape: u32 = 0u;
// A pulse may have more than one cycle.
override cycles: bool = false;

const ONE_SINE = 0u;
const ONE_COSINE = 1u;
const HALF_SINE = 2u;
const RECTANGLE = 3u;
const RICKER = 4u;
const RICKER_ANTISYMMETRIC = 5u;
const MAVROEIDIS_PAPAGEORGIOU = 6u;

// sin(2 pi tau) for 0 <= tau <= 1 (in the twin: src/model/number.rs).
fn pulse_sine(tau: real) -> real {
    let two_pi: real = 6.283185307179586;
    let quarter = select(select(tau, 0.5 - tau, tau > 0.25), tau - 1.0, tau > 0.75);
    return sine(two_pi * quarter);
}

// sin(2 pi x).
fn sine_of(x: real) -> real {
    return pulse_sine(x - floor(x));
}

// The remainder of a number after halvings, and the factor of these halvings.
struct Halved {
    rest: real,
    power: real,
}

// Takes a number of ln 2 off, if the number is that large, and applies their factor.
fn halve(x: Halved, halvings: real, share: real) -> Halved {
    let ln_2: real = 0.6931471805599453;
    let held = halvings * ln_2;
    if x.rest >= held {
        return Halved(x.rest - held, x.power * share);
    }
    return x;
}

// e^-x for 0 <= x <= 44: the whole multiple of ln 2 in x is taken off and becomes a power of two (in the twin:
// src/model/number.rs).
fn exponential(x: real) -> real {
    var halved = Halved(x, 1.0);
    halved = halve(halved, 32.0, 2.3283064365386963e-10);
    halved = halve(halved, 16.0, 1.52587890625e-5);
    halved = halve(halved, 8.0, 0.00390625);
    halved = halve(halved, 4.0, 0.0625);
    halved = halve(halved, 2.0, 0.25);
    halved = halve(halved, 1.0, 0.5);
    return series(halved.rest) * halved.power;
}

// Ricker's wavelet, x periods from its peak.
fn ricker(x: real) -> real {
    let pi: real = 3.141592653589793;
    let y = (pi * x) * (pi * x);
    return (1.0 - y - y) * exponential(y);
}

// Ricker's wavelet of third order, x periods from its zero.
fn ricker_antisymmetric(x: real) -> real {
    // 2 pi over the square root of 3, and 1 over the largest magnitude of the formula.
    let scale: real = 3.6275987284684357;
    let inverse_peak: real = 0.7245751754399925;
    let s = scale * x;
    let y = 0.5 * s * s;
    return (y + y - 3.0) * (s * inverse_peak) * exponential(y);
}

// The rate of [1 + cos(2 pi x/gamma)] cos(2 pi x + nu), over -2 pi, after `phase` periods: that of three
// cosines.
fn modulated(envelope: real, carrier: real, phase: real) -> real {
    let half: real = 0.5;
    let turn = phase + carrier;
    let modulation = phase * envelope - half;
    let faster = half + half * envelope;
    let slower = half - half * envelope;
    let sides = faster * sine_of(turn + modulation) + slower * sine_of(turn - modulation);
    return -(sine_of(turn) + sides);
}

// The acceleration of the ground over the amplitude, `phase` periods after the begin of the pulse. The wave of a
// modulated pulse has its peak as its largest magnitude, and the amplitude is divided by this peak.
fn wave(cell: Cell, phase: real) -> real {
    if pulse_shape == ONE_SINE || pulse_shape == HALF_SINE {
        if cycles {
            return sine_of(phase);
        }
        return pulse_sine(phase);
    }
    if pulse_shape == ONE_COSINE {
        return sine_of(phase + 0.25);
    }
    if pulse_shape == RECTANGLE {
        let one: real = 1.0;
        return one;
    }
    if pulse_shape == RICKER {
        return ricker(phase - 1.5);
    }
    if pulse_shape == RICKER_ANTISYMMETRIC {
        return ricker_antisymmetric(phase - 2.0);
    }
    return modulated(cell.drive.envelope, cell.drive.carrier, phase);
}
