//! Why a text is no distribution.

/// Why a text is no distribution.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DistributionError {
    /// No form that is known.
    #[error(
        "'{0}' is no distribution; give normal(MEAN,DEVIATION), uniform(LOW,HIGH) or lognormal(MEDIAN,BETA)"
    )]
    Form(String),
    /// The wrong count of numbers.
    #[error(
        "'{0}' has {1} numbers; {2} has two, {3}, and two more, LOW,HIGH, where it is to be cut off"
    )]
    Count(String, usize, &'static str, &'static str),
    /// An item that is no number.
    #[error(
        "'{0}' in '{1}' is not a finite number; decimals have a point, commas separate numbers"
    )]
    Number(String, String),
    /// A spread or a median that is not above zero.
    #[error("{0} {1} in '{2}' must be a positive number")]
    NotPositive(&'static str, String, String),
    /// Ends in the wrong order.
    #[error("'{2}': the low end {0} must lie below the high end {1}")]
    Order(String, String, String),
    /// A cut that leaves nothing.
    #[error("'{2}': nothing of it lies between {0} and {1}; move the ends")]
    Empty(String, String, String),
}
