//! What the user says of a record file.

use super::{Baseline, Units};

/// What the user says of a record file, where the file itself does not say it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RecordHints {
    /// Time between samples, s.
    pub dt: Option<f64>,
    /// Units of the values.
    pub units: Option<Units>,
    /// The record is scaled to a known peak, so that its own is not questioned.
    pub scaled: bool,
    /// Which component is wanted of a file with several channels: true for the vertical one; the first where nothing is
    /// said.
    pub vertical: Option<bool>,
    /// It is the second of two horizontal components.
    pub second: bool,
    /// The channel that is wanted of such a file: its number, or its direction.
    pub channel: Option<String>,
    /// Words of its heading that are not read, and may tell a sign or a factor, are accepted.
    pub force: bool,
    /// What is subtracted from its velocity.
    pub baseline: Option<Baseline>,
}

impl RecordHints {
    /// The key that chooses the channel.
    pub(super) fn channel_key(&self) -> &'static str {
        match (self.vertical, self.second) {
            (Some(true), _) => "vertical_channel",
            (_, true) => "horizontal_2_channel",
            _ => "horizontal_channel",
        }
    }
}
