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

/// A limit in the digits of a motion's numbers: that of one which was read in a table is the number itself.
pub fn as_kept(limit: f64) -> f32 {
    limit as f32
}

#[cfg(test)]
mod tests {
    use super::as_kept;

    #[test]
    fn a_limit_that_was_read_in_a_table_is_the_number_in_it() {
        for number in [0.19098502_f32, 0.1, 0.3, 1.0e-3] {
            let read: f64 = number.to_string().parse().unwrap();
            assert_eq!(as_kept(read), number);
        }
        // In double precision it is another one, as often above as below.
        assert!(f64::from(0.19098502_f32) > 0.19098502);
    }
}
