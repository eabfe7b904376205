//! A hazard curve, and the annual rate of failure over it.

use super::fit::Lognormal;

/// Annual rates at which levels of the intensity measure are exceeded.
#[derive(Debug, Clone, PartialEq)]
pub struct HazardCurve {
    /// ln of the level and ln of the rate, by ascending level.
    points: Vec<[f64; 2]>,
}

/// Why a text is no hazard curve. Lines are counted from one, the header's.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HazardError {
    /// It does not begin with the names of the columns.
    #[error("line 1: the header is `{found}`; write `level,rate`")]
    Header {
        /// What is there.
        found: String,
    },
    /// A line that has not two columns.
    #[error("line {line}: it has {columns} columns; write a level and a rate")]
    Columns {
        /// Which line.
        line: u64,
        /// How many it has.
        columns: usize,
    },
    /// A text that cannot be split into columns.
    #[error("{problem}; write lines of a level and a rate, with a comma between them")]
    Csv {
        /// What is wrong with it.
        problem: String,
    },
    /// A level or a rate that is no number above zero.
    #[error(
        "line {line}: {name} `{text}` is no number above zero; write one, or leave the line out"
    )]
    Number {
        /// Which line.
        line: u64,
        /// `level` or `rate`.
        name: &'static str,
        /// What is there.
        text: String,
    },
    /// A level that is not above the one before.
    #[error("line {line}: the level is not above that of the line before; sort the lines by level")]
    Order {
        /// Which line.
        line: u64,
    },
    /// A rate that is above the one before.
    #[error(
        "line {line}: the rate is above that of a lower level; give the rates at which levels are exceeded"
    )]
    Rises {
        /// Which line.
        line: u64,
    },
    /// Fewer than two points.
    #[error("the curve has {count} points; give two at least")]
    TooFew {
        /// How many it has.
        count: usize,
    },
}

/// The annual rate of failure over a hazard curve, and what the ends of the curve leave open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnnualRate {
    /// The rate of failures by motions between the first and the last level of the curve, 1/year.
    pub rate: f64,
    /// Motions above the last level add no more than this, the rate of the last level. At least the probability of failing
    /// there times this rate is missing.
    pub missing_above: f64,
    /// The probability of failing at the first level. Motions below it add no more than this times their rate, which the
    /// curve does not tell: it should be small.
    pub probability_at_first: f64,
}

/// The probability that something of an annual rate happens in 50 years, 1 - exp(-50 rate).
pub fn in_50_years(rate: f64) -> f64 {
    -(-50.0 * rate).exp_m1()
}

/// Nodes and weights of Gauss and Legendre for four points on -1 to 1.
const GAUSS: [[f64; 2]; 4] = [
    [-0.861_136_311_594_052_6, 0.347_854_845_137_453_86],
    [-0.339_981_043_584_856_26, 0.652_145_154_862_546_1],
    [0.339_981_043_584_856_26, 0.652_145_154_862_546_1],
    [0.861_136_311_594_052_6, 0.347_854_845_137_453_86],
];
/// Beyond this many beta from ln theta the probability is zero or one to rounding.
const REACH: f64 = 8.5;

impl HazardCurve {
    /// Reads a table `level,rate`: the header, then a line a point, with ascending levels and rates that do not rise.
    pub fn parse(text: &str) -> Result<HazardCurve, HazardError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut reader = csv::ReaderBuilder::new()
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let csv = |error: csv::Error| HazardError::Csv { problem: error.to_string() };
        let header = reader.headers().map_err(csv)?;
        if header != vec!["level", "rate"] {
            let found = header.iter().collect::<Vec<_>>().join(",");
            return Err(HazardError::Header { found });
        }
        let mut points: Vec<[f64; 2]> = Vec::new();
        for row in reader.records() {
            let row = row.map_err(csv)?;
            let line = row.position().map_or(0, csv::Position::line);
            if row.len() != 2 {
                return Err(HazardError::Columns { line, columns: row.len() });
            }
            let number = |name: &'static str, text: &str| {
                let number = text.parse().ok().filter(|n: &f64| *n > 0.0 && n.is_finite());
                number.ok_or_else(|| HazardError::Number { line, name, text: text.into() })
            };
            let point = [number("level", &row[0])?.ln(), number("rate", &row[1])?.ln()];
            match points.last() {
                Some(before) if point[0] <= before[0] => return Err(HazardError::Order { line }),
                Some(before) if point[1] > before[1] => return Err(HazardError::Rises { line }),
                _ => points.push(point),
            }
        }
        if points.len() < 2 {
            return Err(HazardError::TooFew { count: points.len() });
        }
        Ok(HazardCurve { points })
    }

    /// The annual rate of failure, the integral of P(fail | x) |d lambda(x)| over the curve.
    ///
    /// Between its points the curve is a power of x, linear in ln x and ln lambda, as is usual. It is not extended beyond
    /// its ends. The sum over trapezoids in ln x of P |d lambda|, whose value depends on how far apart the points are,
    /// goes to this integral as points are put between them.
    ///
    /// Where P changes, within 8.5 beta of theta, four points of Gauss and Legendre serve each piece of ln x, no longer
    /// than h = 1/2 of the smaller of beta and 1/k, where k is the slope of ln lambda. Elsewhere P is 0 or 1. In units of h
    /// the eighth derivative of the integrand is below 2^-8 times 1e4, the rule's factor is 5.6e-10, so that the error
    /// is below 1e-7 of the rate.
    pub fn rate(&self, fragility: &Lognormal) -> AnnualRate {
        let [ends @ .., last] = self.points.as_slice() else {
            return AnnualRate { rate: 0.0, missing_above: 0.0, probability_at_first: 0.0 };
        };
        let segments = ends.iter().zip(&self.points[1..]);
        AnnualRate {
            rate: segments.map(|(from, to)| segment(*from, *to, fragility)).sum(),
            missing_above: last[1].exp(),
            probability_at_first: fragility.probability(self.points[0][0].exp()),
        }
    }
}

/// The integral between two points.
fn segment(from: [f64; 2], to: [f64; 2], fragility: &Lognormal) -> f64 {
    let k = (from[1] - to[1]) / (to[0] - from[0]);
    let lambda = |y: f64| (from[1] - k * (y - from[0])).exp();
    let middle = fragility.theta.ln();
    let reach = REACH * fragility.beta;
    let low = (middle - reach).clamp(from[0], to[0]);
    let high = (middle + reach).clamp(from[0], to[0]);
    // Above, all fail.
    let above = lambda(high) - to[1].exp();
    if !(high > low && k > 0.0) {
        return above.max(0.0);
    }
    let pieces = ((high - low) / (0.5 * fragility.beta.min(1.0 / k))).ceil().max(1.0);
    let half = 0.5 * (high - low) / pieces;
    let mut changing = 0.0;
    for piece in 0..pieces as u32 {
        let centre = low + half * f64::from(2 * piece + 1);
        for [node, weight] in GAUSS {
            let y = centre + half * node;
            let probability = super::normal::cdf((y - middle) / fragility.beta);
            changing += half * weight * probability * k * lambda(y);
        }
    }
    changing + above.max(0.0)
}
