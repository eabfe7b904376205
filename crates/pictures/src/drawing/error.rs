//! Why a picture was not made.

/// Why a picture was not made.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The picture could not be encoded.
    #[error("the picture could not be encoded: {0}")]
    Encode(String),
}
