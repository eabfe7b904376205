//! What became of a grid's cells under one motion.

use super::verified::Verified;
use topple::stepping::outcome::Class;

/// The cells of a grid under a motion: level by level, in the grid's order.
#[derive(Debug, Clone, PartialEq)]
pub struct SweptMotion {
    /// The motion's id.
    pub id: String,
    /// How much it counts.
    pub weight: f64,
    /// Outcomes.
    pub outcomes: Vec<Class>,
    /// max |u|, m.
    pub max_u: Vec<f32>,
    /// The largest displacement of v from its static position, m.
    pub stroke_v: Vec<f32>,
    /// The rocking index.
    pub zeta: Vec<f32>,
    /// Further requested columns, in their order.
    pub others: Vec<Vec<f32>>,
    /// The reference's results for a sample.
    pub verified: Verified,
}

/// The values of a motion's cells.
pub type Values = fn(&SweptMotion) -> &[f32];
