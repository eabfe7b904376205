//! What cannot be refined.

use crate::scene::SceneError;

/// The key of the setting at fault.
pub const KEY: &str = "refine";

/// Why a map cannot be refined.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RefineError {
    /// More or fewer axes than two of several values.
    #[error(
        "a refined map has two axes of several values, this one has {0}; fix the other numbers"
    )]
    Axes(usize),
    /// An axis that is a list.
    #[error("`{0}` is a list, which has no values between; give start:stop:count")]
    List(&'static str),
    /// A finest grid that is too large.
    #[error(
        "the finest grid would have more than {} cells; give fewer levels, or fewer values of the axes",
        1_u64 << super::boxes::MOST_CELLS
    )]
    Large,
    /// No level.
    #[error("no level is nothing to refine; give 1 or more")]
    None,
}

impl From<RefineError> for SceneError {
    fn from(error: RefineError) -> SceneError {
        SceneError::new(KEY, error.to_string())
    }
}
