//! The maximum of a concave function of two numbers, by Newton's method with step halving.

/// A concave function at a point.
#[derive(Debug, Clone, Copy)]
pub struct Point {
    /// Its value.
    pub value: f64,
    /// Its gradient.
    pub gradient: [f64; 2],
    /// Minus its second derivatives: by the first, by both, by the second number.
    pub curvature: [f64; 3],
}

/// Below this gain that Newton's model promises, the value no longer judges a step: differences of values are near
/// their rounding, and the method converges quadratically.
const QUADRATIC: f64 = 1.0e-9;
/// Below this promised gain one more step reaches machine precision, for the gain of the next is its square.
const LAST: f64 = 1.0e-16;
/// Steps before the search gives up. From any start of the tests it takes fewer than 40.
const STEPS: u32 = 200;

/// Where the function is largest, from a start. The values must be of order one (a mean over the data). `None` where the
/// function says that it is not defined at the start, or where no maximum is found.
pub fn maximum(start: [f64; 2], function: impl Fn([f64; 2]) -> Option<Point>) -> Option<[f64; 2]> {
    let mut at = start;
    let mut here = function(at)?;
    for _ in 0..STEPS {
        let (step, gain) = here.step()?;
        let full = [at[0] + step[0], at[1] + step[1]];
        if gain <= LAST {
            return full.iter().all(|number| number.is_finite()).then_some(full);
        }
        if gain < QUADRATIC
            && let Some(there) = function(full)
        {
            // Rounding of a flat function may keep the gain from falling: then this is the maximum it has.
            if there.step().is_none_or(|(_, next)| next >= 0.5 * gain) {
                return Some(at);
            }
            (at, here) = (full, there);
            continue;
        }
        (at, here) = ascent(at, here, step, gain, &function)?;
    }
    None
}

/// The longest of the halved steps that gains a part of what the slope promises.
fn ascent(
    at: [f64; 2],
    here: Point,
    step: [f64; 2],
    gain: f64,
    function: impl Fn([f64; 2]) -> Option<Point>,
) -> Option<([f64; 2], Point)> {
    let mut share = 1.0;
    for _ in 0..100 {
        let next = [at[0] + share * step[0], at[1] + share * step[1]];
        if let Some(there) = function(next)
            && there.value >= here.value + 1.0e-4 * share * gain
        {
            return Some((next, there));
        }
        share *= 0.5;
    }
    None
}

impl Point {
    /// Newton's step and the product of gradient and step, twice what the step gains in a quadratic function.
    fn step(&self) -> Option<([f64; 2], f64)> {
        let [aa, ab, bb] = self.curvature;
        let [a, b] = self.gradient;
        // Where the function is flat to rounding the matrix is singular; a small addition makes it a step uphill.
        let floor = f64::MIN_POSITIVE.sqrt() + 4.0 * f64::EPSILON * (aa + bb);
        let determinant = aa * bb - ab * ab;
        let (aa, bb, determinant) = if determinant > floor * (aa + bb) {
            (aa, bb, determinant)
        } else {
            let (aa, bb) = (aa + floor, bb + floor);
            (aa, bb, (aa * bb - ab * ab).max(floor * floor))
        };
        let step = [(bb * a - ab * b) / determinant, (aa * b - ab * a) / determinant];
        let gain = a * step[0] + b * step[1];
        gain.is_finite().then_some((step, gain))
    }
}
