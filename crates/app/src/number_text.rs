//! A flag's number that is no range.

/// A number by itself.
pub fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "no number such as 0.0004 or 4e-4; give it without its unit".into())
}
