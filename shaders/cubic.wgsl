// The value of a guard over a span: the cubic through its ends, and the root of that cubic. Twin:
// src/stepping/cubic.rs.

struct Cubic {
    c0: real,
    c1: real,
    c2: real,
    c3: real,
}

// The cubic with these values and slopes at the ends of a span.
fn cubic_through(start: GuardSample, end: GuardSample) -> Cubic {
    let rise = end.value - start.value;
    return Cubic(
        start.value,
        start.slope,
        3.0 * rise - 2.0 * start.slope - end.slope,
        start.slope + end.slope - 2.0 * rise,
    );
}

struct Root {
    at: real,
    slope: real,
}

// The root in a span at whose end the cubic is positive, and the slope at the root.
fn root(cubic: Cubic) -> Root {
    let zero: real = 0.0;
    let one: real = 1.0;
    let rise = cubic.c1 + cubic.c2 + cubic.c3;
    let slope1 = 3.0 * cubic.c3 + (2.0 * cubic.c2 + cubic.c1);
    // If the cubic rises at both ends, the first guess is the zero of the chord, improved by the inverse cubic, which
    // gives the place as a function of the value. If it falls at first, the first guess is the place where the
    // parabola from the start returns to its first value.
    let rises = cubic.c1 > 0.0 && slope1 > 0.0;
    let slopes = cubic.c1 * slope1;
    let inverse = 1.0 / select(cubic.c2 + cubic.c3, rise * slopes, rises);
    let chord = select(-cubic.c1, -cubic.c0 * slopes, rises) * inverse;
    let per_slopes = rise * rise * inverse;
    let place = hermite(zero, slope1 * per_slopes, one, cubic.c1 * per_slopes, chord);
    var at = select(chord, place, rises);
    at = select(one, at, at > 0.0 && at < 1.0);
    // One step of Newton's method.
    let value = cubic.c0 + at * (cubic.c1 + at * (cubic.c2 + at * cubic.c3));
    let slope = cubic.c1 + at * (3.0 * at * cubic.c3 + 2.0 * cubic.c2);
    let next = at - value / slope;
    return Root(select(at, next, next > 0.0 && next < 1.0), slope);
}
