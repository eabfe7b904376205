//! The cubic through the ends of a step, and the crest of a quantity sampled along it.

use super::system::State;

/// The number of samples of a quantity in a step, its ends included, evenly apart.
pub const SAMPLES: usize = 5;

/// The fractions of a step at which the samples are taken.
pub const SAMPLED: [f64; SAMPLES] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// The cubic polynomial with the states and slopes at the two ends of an interval.
pub struct Cubic<'a> {
    /// The state at the start.
    pub y0: &'a State,
    /// The time derivative at the start.
    pub d0: &'a State,
    /// The state at the end.
    pub y1: &'a State,
    /// The time derivative at the end.
    pub d1: &'a State,
    /// The length of the interval, s.
    pub h: f64,
    powers: [State; 3],
}

impl<'a> Cubic<'a> {
    /// The cubic over an interval of length `h`.
    pub fn new(
        (y0, d0): (&'a State, &'a State),
        (y1, d1): (&'a State, &'a State),
        h: f64,
    ) -> Cubic<'a> {
        let rise = y1 - y0;
        let (s0, s1) = (d0 * h, d1 * h);
        let powers = [s0, rise * 3.0 - s0 * 2.0 - s1, s0 + s1 - rise * 2.0];
        Cubic { y0, d0, y1, d1, h, powers }
    }

    /// The state at a fraction of the interval; exact at both ends.
    pub fn at(&self, x: f64) -> State {
        if x == 1.0 {
            return *self.y1;
        }
        let [c1, c2, c3] = &self.powers;
        self.y0 + c1 * x + c2 * (x * x) + c3 * (x * x * x)
    }
}

/// A crest of a quantity that its samples indicate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crest {
    /// The place of the crest, as a fraction of the step.
    pub at: f64,
    /// An upper bound of the quantity at the crest: the crest of the parabola and a quarter of its second difference.
    /// The error of a cubic and of a parabola is of a higher order.
    pub most: f64,
}

/// The crest of the parabola through the samples beside the `middle` one; none where it lies outside of them, or
/// exceeds them by less than 1e-7 of its value.
pub fn crest(samples: &[f64; SAMPLES], middle: usize) -> Option<Crest> {
    let (low, mid, high) = (samples[middle - 1], samples[middle], samples[middle + 1]);
    let bend = 2.0 * mid - low - high;
    // At a distance of two spacings from the crest the parabola is 2 `bend` below it.
    if !(2.0 * bend > 1.0e-7 * mid.abs()) {
        return None;
    }
    let lean = 0.5 * (high - low);
    let from_middle = lean / bend;
    if from_middle.abs() > 1.0 {
        return None;
    }
    let value = mid + 0.5 * lean * from_middle;
    let at = SAMPLED[middle] + from_middle * (SAMPLED[1] - SAMPLED[0]);
    Some(Crest { at, most: value + 0.25 * bend })
}

/// The largest value of `of` near a crest at about the fraction `at` of a step: the largest of three points around it
/// and of the crest of the parabola through them. The error of its place is of second order in the distance of the
/// points, and the error of the value is of fourth order.
pub fn climb(at: f64, of: impl Fn(f64) -> f64) -> (f64, f64) {
    const APART: f64 = 1.0 / 32.0;
    let middle = at.clamp(APART, 1.0 - APART);
    let points = [middle - APART, middle, middle + APART].map(|x| (x, of(x)));
    let [(_, low), (_, mid), (_, high)] = points;
    let bend = 2.0 * mid - low - high;
    let mut best = points.into_iter().fold(points[0], |a, b| if b.1 > a.1 { b } else { a });
    if bend > 0.0 {
        let x = (middle + 0.5 * APART * (high - low) / bend).clamp(0.0, 1.0);
        let value = of(x);
        if value > best.1 {
            best = (x, value);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Crests of a sine in a step of a sixteenth of its period, wherever they lie in it.
    #[test]
    fn a_crest_is_found_wherever_it_lies() {
        for k in 1..200 {
            let place = f64::from(k) / 200.0;
            let wave = |x: f64| ((x - place) * std::f64::consts::TAU / 16.0).cos();
            let samples = SAMPLED.map(wave);
            let found = (1..SAMPLES - 1)
                .filter_map(|middle| crest(&samples, middle))
                .map(|crest| {
                    assert!(crest.most >= 1.0, "{place}: {crest:?}");
                    climb(crest.at, wave).1
                })
                .fold(f64::NEG_INFINITY, f64::max);
            assert!((found - 1.0).abs() < 1.0e-9, "{place}: {found}");
        }
    }

    #[test]
    fn what_rises_throughout_has_no_crest() {
        let samples = SAMPLED.map(|x| x * x);
        assert!((1..SAMPLES - 1).all(|middle| crest(&samples, middle).is_none()));
        assert!((1..SAMPLES - 1).all(|middle| crest(&[9.81; SAMPLES], middle).is_none()));
    }
}
