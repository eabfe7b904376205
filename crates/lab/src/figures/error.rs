//! What is wrong with the text of a figure or a motion.

/// What is wrong with a figure or a motion, and where.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {problem}")]
pub struct ReadError {
    /// File, and panel if it is one's.
    pub place: String,
    /// What is wrong and what to do.
    pub problem: String,
}

impl ReadError {
    /// An error at a place.
    pub fn new(place: impl Into<String>, problem: impl Into<String>) -> ReadError {
        ReadError { place: place.into(), problem: problem.into() }
    }
}
