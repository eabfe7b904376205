//! Numbers as tables show them, against limits.

use topple::scene::shown::decimal;

/// True where a number of a cell is beyond a limit as tables show it: with the digits that tell it from its neighbours. A limit that is
/// copied from a table is kept by the cell that it was copied from.
pub(crate) fn is_beyond(value: f32, limit: f64) -> bool {
    let own = f64::from(value);
    // What is shown lies between the neighbours.
    if (own - limit).abs() > own.abs() * f64::from(f32::EPSILON) {
        return own > limit;
    }
    decimal(value) > limit
}

#[cfg(test)]
mod tests {
    use super::is_beyond;

    #[test]
    fn a_limit_is_compared_with_the_digits_of_the_table() {
        // 0.19098502 is shown of a number 5e-9 larger, 0.1 of one 1.5e-9 larger, 0.3 of one 1.2e-8 larger.
        for shown in ["0.19098502", "0.1", "0.3", "1.7e-5", "16777217", "0.7"] {
            let (value, limit) = (shown.parse::<f32>().unwrap(), value_of(shown));
            assert!(!is_beyond(value, limit), "{shown}");
            assert!(is_beyond(value, limit * (1.0 - 1.0e-9)), "{shown}");
            assert!(!is_beyond(value, limit * (1.0 + 1.0e-9)), "{shown}");
        }
        assert!(is_beyond(f32::INFINITY, 1.0) && !is_beyond(f32::NAN, 1.0));
        assert!(is_beyond(0.2, 0.1) && !is_beyond(0.1, 0.2) && !is_beyond(0.0, 0.0));
    }

    /// The number that somebody gives who copies what is shown.
    fn value_of(shown: &str) -> f64 {
        shown.parse::<f32>().unwrap().to_string().parse().unwrap()
    }
}
