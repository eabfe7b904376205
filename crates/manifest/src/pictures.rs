//! How the pictures of a run are printed.

use serde::{Deserialize, Serialize};
use topple::results::print_palette::Palette;

/// How pictures are printed, where it was asked for.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Pictures {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub font_size: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub palette: Option<Palette>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub outline_text: bool,
}

impl Pictures {
    pub fn is_plain(&self) -> bool {
        *self == Pictures::default()
    }
}
