//! What is wrong with the text of a figure or a motion.

/// The fault of a figure or a motion, and its place.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {problem}")]
pub struct ReadError {
    /// File, and panel if it is one's.
    pub place: String,
    /// The fault and the remedy.
    pub problem: String,
}

impl ReadError {
    /// An error at a place.
    pub fn new(place: impl Into<String>, problem: impl Into<String>) -> ReadError {
        ReadError { place: place.into(), problem: problem.into() }
    }
}
