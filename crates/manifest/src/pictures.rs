//! How the pictures of a run are printed.

use serde::{Deserialize, Serialize};
use topple_pictures::colours::print_palette::Palette;

/// How pictures are printed, where it was asked for.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Pictures {
    /// Their title.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Their width, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// Size of their letters, points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub font_size: Option<f64>,
    /// Their colours.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub palette: Option<Palette>,
}

impl Pictures {
    /// True where nothing was asked for.
    pub fn is_plain(&self) -> bool {
        *self == Pictures::default()
    }
}
