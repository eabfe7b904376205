//! Limit states: what a block is not to do.

use std::fmt;

use serde::{Serialize, Serializer};

use crate::suites::swept_motion::{SweptMotion, Values, as_kept};
use topple::stepping::outcome::Class;

/// A limit state of a block. A block that overturns does the others, too.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LimitState {
    /// It overturns.
    Overturning,
    /// It lifts.
    Uplift,
    /// The rocking index exceeds a value.
    Zeta(f64),
    /// max |u| exceeds a value, m.
    U(f64),
    /// The stroke of v exceeds a value, m.
    V(f64),
}

impl LimitState {
    /// The values that it limits, and the limit; none of those that are outcomes.
    fn limit(self) -> Option<(Values, f64)> {
        match self {
            LimitState::Overturning | LimitState::Uplift => None,
            LimitState::Zeta(limit) => Some((|motion| &motion.zeta, limit)),
            LimitState::U(limit) => Some((|motion| &motion.max_u, limit)),
            LimitState::V(limit) => Some((|motion| &motion.stroke_v, limit)),
        }
    }

    /// True where a cell of a motion exceeds it; `index` is its place among all levels.
    pub fn is_exceeded(self, motion: &SweptMotion, index: usize) -> bool {
        let class = motion.outcomes[index];
        let beyond = match self.limit() {
            Some((values, limit)) => values(motion)[index] > as_kept(limit),
            None => self == LimitState::Uplift && class != Class::FullContact,
        };
        class.overturned() || beyond
    }

    /// The demand over the limit, where it limits one and the block stands.
    pub fn demand(self, motion: &SweptMotion, index: usize) -> Option<f64> {
        let (values, limit) = self.limit().filter(|_| motion.outcomes[index].stands())?;
        Some(f64::from(values(motion)[index]) / limit)
    }

    /// Its probability in words: `overturning`.
    pub fn words(self) -> String {
        match self {
            LimitState::Overturning => "overturning".into(),
            LimitState::Uplift => "uplift".into(),
            LimitState::Zeta(limit) => format!("ζ > {limit}"),
            LimitState::U(limit) => format!("max |u| > {limit} m"),
            LimitState::V(limit) => format!("stroke of v > {limit} m"),
        }
    }

    /// What files of it alone are called.
    pub fn file(self) -> String {
        self.to_string().replace('>', "-")
    }
}

impl fmt::Display for LimitState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LimitState::Overturning => f.write_str("overturning"),
            LimitState::Uplift => f.write_str("uplift"),
            LimitState::Zeta(limit) => write!(f, "zeta>{limit}"),
            LimitState::U(limit) => write!(f, "max_u>{limit}"),
            LimitState::V(limit) => write!(f, "stroke_v>{limit}"),
        }
    }
}

impl Serialize for LimitState {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
