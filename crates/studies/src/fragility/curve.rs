//! The probability of failing as a function of the level, of one part or of two.

use super::bisection::bisected;
use crate::statistics::normal;

/// Phi(1): a lognormal curve has this probability at ln theta + beta.
const UPPER: f64 = 0.841_344_746_068_542_9;
/// Halvings of a bracket of ln x, which leave nothing but rounding.
const HALVINGS: u32 = 60;

/// A lognormal fragility: P(x) = Phi(ln(x/theta)/beta).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lognormal {
    /// The median: the level at which half of the records fail.
    pub theta: f64,
    /// The standard deviation of the logarithm of the level. Zero makes a step at theta.
    pub beta: f64,
}

impl Lognormal {
    /// From the logarithm of theta; `None` where theta or beta is beyond what numbers hold.
    pub fn of_logarithm(ln_theta: f64, beta: f64) -> Option<Lognormal> {
        let theta = ln_theta.exp();
        (is_level(theta) && beta >= 0.0 && beta.is_finite()).then_some(Lognormal { theta, beta })
    }

    /// The probability that the limit state fails at a level.
    pub fn probability(&self, level: f64) -> f64 {
        Curve::from(*self).probability(level)
    }
}

/// Whether a number can be a level. A subnormal number has lost digits: a median there would answer for another.
pub(super) fn is_level(number: f64) -> bool {
    number > 0.0 && number.is_normal()
}

/// How the probability of a part rises with u = (ln x - at)/scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    /// Phi(u).
    Normal,
    /// 1/(1 + exp(-u)).
    Logistic,
}

/// A part of a curve. A scale of zero makes a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Part {
    pub shape: Shape,
    /// ln x where it has the probability 1/2.
    pub at: f64,
    /// How much ln x grows while u grows by one.
    pub scale: f64,
}

/// A fragility: P = 1 - (1 - P_1)(1 - P_2), or P_1 alone. That of a lognormal curve is its one part; that of a cloud has a part for
/// the demand and one for collapse, and is not lognormal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curve {
    /// The level at which it passes 1/2.
    pub theta: f64,
    /// Half the distance in ln x between P = Phi(-1) and P = Phi(1): of a lognormal curve the standard deviation.
    pub beta: f64,
    first: Part,
    second: Option<Part>,
}

impl Shape {
    /// u at a share.
    fn quantile(self, share: f64) -> f64 {
        match self {
            Shape::Normal => normal::quantile(share),
            Shape::Logistic => (share / (1.0 - share)).ln(),
        }
    }

    /// The shares that fail and that stand at u, neither by a difference from one.
    fn shares(self, u: f64) -> [f64; 2] {
        match self {
            Shape::Normal => [normal::cdf(u), normal::cdf(-u)],
            Shape::Logistic => [1.0 / (1.0 + (-u).exp()), 1.0 / (1.0 + u.exp())],
        }
    }

    /// u below which less than 1e-60 fails, and u above which less than 1e-17 stands.
    fn ends(self) -> [f64; 2] {
        match self {
            Shape::Normal => [-16.5, 8.5],
            Shape::Logistic => [-140.0, 40.0],
        }
    }
}

impl Part {
    /// The shares that fail and that stand at a logarithm of the level.
    fn shares(&self, ln: f64) -> [f64; 2] {
        if self.scale > 0.0 {
            return self.shape.shares((ln - self.at) / self.scale);
        }
        // At the step itself half of the runs fail.
        let fails = if ln == self.at { 0.5 } else { f64::from(u8::from(ln > self.at)) };
        [fails, 1.0 - fails]
    }

    /// ln x at a share.
    fn level(&self, share: f64) -> f64 {
        if self.scale > 0.0 { self.at + self.scale * self.shape.quantile(share) } else { self.at }
    }

    /// ln x below which it has less than 1e-17.
    pub(super) fn begins(&self) -> f64 {
        self.at - self.scale * self.shape.ends()[1]
    }

    /// Where it begins and ends to change: below less than 1e-60 fails, above all do to rounding.
    pub(super) fn ends(&self) -> [f64; 2] {
        self.shape.ends().map(|u| self.at + self.scale * u)
    }
}

impl Curve {
    /// The curve of parts; none where theta or beta is beyond what numbers hold.
    pub(super) fn of(first: Part, second: Option<Part>) -> Option<Curve> {
        let mut curve = Curve { theta: 1.0, beta: 0.0, first, second };
        curve.theta = curve.level(0.5).exp();
        curve.beta = match (second, first.shape) {
            (None, Shape::Normal) => first.scale,
            _ => 0.5 * (curve.level(UPPER) - curve.level(1.0 - UPPER)),
        };
        (is_level(curve.theta) && curve.beta >= 0.0 && curve.beta.is_finite()).then_some(curve)
    }

    /// A step at a level.
    pub(super) fn step(theta: f64) -> Curve {
        Lognormal { theta, beta: 0.0 }.into()
    }

    /// The probability that the limit state fails at a level.
    pub fn probability(&self, level: f64) -> f64 {
        self.at(level.ln())
    }

    /// The lognormal curve of the same theta and beta, for a format that holds no other.
    pub fn lognormal(&self) -> Lognormal {
        Lognormal { theta: self.theta, beta: self.beta }
    }

    /// Its part, where it has one alone.
    pub(super) fn only(&self) -> Option<Part> {
        self.second.is_none().then_some(self.first)
    }

    /// Its parts.
    pub(super) fn parts(&self) -> impl Iterator<Item = Part> + Clone {
        std::iter::once(self.first).chain(self.second)
    }

    /// The probability at a logarithm of the level.
    pub(super) fn at(&self, ln: f64) -> f64 {
        fails(self.parts(), ln)
    }

    /// ln x where it has a probability, by bisection: P is at least each of its parts and at most their sum.
    fn level(&self, share: f64) -> f64 {
        let Some(second) = self.second else { return self.first.level(share) };
        let both = |share: f64| self.first.level(share).min(second.level(share));
        let ends = [both(0.5 * share), both(share)];
        let [low, high] = bisected(ends, HALVINGS, |middle| self.at(middle) < share);
        0.5 * (low + high)
    }
}

/// The share that fails by some parts of a curve.
pub(super) fn fails(parts: impl Iterator<Item = Part>, ln: f64) -> f64 {
    let both = parts.map(|part| part.shares(ln));
    both.reduce(|[p, stands], [q, others]| [p + q * stands, stands * others])
        .map_or(0.0, |[p, _]| p)
}

impl From<Lognormal> for Curve {
    fn from(Lognormal { theta, beta }: Lognormal) -> Curve {
        let first = Part { shape: Shape::Normal, at: theta.ln(), scale: beta };
        Curve { theta, beta, first, second: None }
    }
}
