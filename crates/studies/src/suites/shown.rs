//! Numbers as tables show them, against limits.

use topple::scene::shown::decimal;

/// True where a number of a cell is beyond a limit as tables show it: with the digits that tell it from its neighbours. A limit that is
/// copied from a table is kept by the cell that it was copied from.
pub fn is_beyond(value: f32, limit: f64) -> bool {
    let own = f64::from(value);
    // What is shown lies between the neighbours.
    if (own - limit).abs() > own.abs() * f64::from(f32::EPSILON) {
        return own > limit;
    }
    decimal(value) > limit
}
